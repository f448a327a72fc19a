//! The pages that people see.

use super::State;
use super::errors::Problem;
use super::identity::visit;
use crate::language::Language;
use axum::Router;
use axum::response::Html;

/// The routes of all pages.
pub fn router(state: &State) -> Router<State> {
    Router::new().layer(axum::middleware::from_fn_with_state(state.clone(), visit))
}

/// A problem as a page.
pub fn problem(problem: &Problem, language: Language) -> Html<String> {
    let json = problem.json(language);
    Html(format!(
        "<!doctype html><title>{0}</title><h1>{0}</h1><p>{1}</p>",
        escaped(&json.title),
        escaped(&json.detail)
    ))
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
