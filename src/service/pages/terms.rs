//! The pictures of single terms of the equation, which the service's pages show as the offline page does.

use super::frame;
use super::result::{png, report_of};
use crate::fault::Fault;
use crate::pictures::Terms;
use crate::report::html::TermFilm;
use crate::report::{Report, pictures};
use crate::service::errors::Problem;
use crate::service::{Service, State};
use crate::source::Source;
use axum::extract::{Path, State as Shared};
use axum::response::Response;
use std::sync::Arc;

/// The terms of a report with the addresses of their pictures.
pub(super) fn addresses(state: &State, id: &str, report: &Report, sources: &[Source]) -> Arc<[TermFilm]> {
    if report.frames.is_empty() {
        return Arc::default();
    }
    let terms = Terms::of(&state.assignment, report.explanation.as_deref(), sources.first());
    // Another seed may explain the file in another way: a browser does not keep these pictures for those.
    let seed = report.probes.seed;
    let name = |term: &str, whose: &str| frame::picture(Some(&state.assignment), id, &format!("terms/{term}-{whose}"));
    let address = |term: &str, whose| format!("{}&seed={seed}", name(term, whose)).into();
    let scenes = terms.scenes();
    let terms = scenes.iter().map(|scene| TermFilm {
        id: scene.id().to_owned(),
        t: scene.t(),
        yours: scene.is_explained().then(|| address(scene.id(), "yours")),
        expected: address(scene.id(), "expected"),
    });
    terms.collect()
}

/// `GET /r/{id}/terms/{picture}`, such as `diffuse-yours.png`. What is drawn comes from the report, not from the shader:
/// nothing is run again.
pub(super) async fn picture(
    Shared(service): Shared<Service>,
    Path((id, picture)): Path<(String, String)>,
) -> Result<Response, Problem> {
    let name = picture.strip_suffix(".png").and_then(|name| name.rsplit_once('-'));
    let Some((term, whose @ ("yours" | "expected"))) = name else { return Err(Problem::not_found()) };
    let (term, is_theirs) = (term.to_owned(), whose == "yours");
    let (state, report, hand_in) = report_of(&service, &id).await?;
    let digest = report.sha256();
    let shown = format!("{picture} {}", serde_json::to_string(&report.explanation).unwrap_or_default());
    let draw = move |state: &State| draw(state, &report, &hand_in.readable(), &term, is_theirs);
    let drawn = state.gallery.of_report(&state, &digest, shown, draw).await?;
    drawn.first().cloned().map(png).ok_or_else(Problem::not_found)
}

fn draw(
    state: &State,
    report: &Report,
    sources: &[Source],
    term: &str,
    is_theirs: bool,
) -> Result<Option<Vec<u8>>, Fault> {
    if report.frames.is_empty() {
        return Ok(None);
    }
    let terms = Terms::of(&state.assignment, report.explanation.as_deref(), sources.first());
    let scenes = terms.scenes();
    let Some(scene) = scenes.iter().find(|scene| scene.id() == term) else { return Ok(None) };
    let picture = if is_theirs { terms.yours(scene) } else { terms.expected(scene) };
    picture.as_ref().map(pictures::png).transpose()
}
