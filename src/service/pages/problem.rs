//! A problem as a page.

use super::frame::PageFrame;
use crate::language::Language;
use crate::service::course::Course;
use crate::service::errors::{Problem, RefusedForm};
use askama::Template;
use axum::http::Uri;
use axum::response::Html;

#[derive(Template)]
#[template(path = "service/pages/templates/problem.html")]
struct ProblemPage {
    frame: PageFrame,
    status: u16,
    heading: &'static str,
    detail: String,
    is_teachers: bool,
    form: Option<RefusedForm>,
}

/// A problem as a page; its button leads to the pages among which `path` is, the teacher's or the student's, or back to the form
/// that was refused.
pub fn problem(problem: &Problem, language: Language, path: &str) -> Html<String> {
    // Of one of several homeworks the teacher's pages stand below `/a/{assignment}`.
    let within = path.strip_prefix("/a/").and_then(|rest| rest.find('/').map(|slash| &rest[slash..])).unwrap_or(path);
    let is_teachers = within == "/teacher" || within.starts_with("/teacher/");
    let frame = PageFrame::new(language, Course::default(), Uri::from_static("/"), None);
    let heading = match problem.status.as_u16() {
        401 | 403 => frame.say("Not possible here", "この操作はできません"),
        404 => frame.say("Nothing here", "ページが見つかりません"),
        413 => frame.say("Too large", "ファイルが大きすぎます"),
        429 => frame.say("A moment, please", "少しお待ちください"),
        status if status >= 500 => frame.say("Our fault", "サーバ側の障害です"),
        _ => frame.say("That did not work", "処理できませんでした"),
    };
    let detail = problem.detail.get(language).replace('`', "");
    let status = problem.status.as_u16();
    let form = problem.form.as_deref().cloned();
    // A string of a template of ours: there is nothing that could fail.
    Html(ProblemPage { frame, status, heading, detail, is_teachers, form }.render().unwrap_or_default())
}
