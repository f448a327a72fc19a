//! The gradebook of the course, as a page and as a file.

use super::super::frame::PageFrame;
use super::super::shown;
use super::Tab;
use crate::service::Service;
use crate::service::errors::Problem;
use crate::service::gradebook::{Gradebook, rounded};
use crate::service::identity::TeacherPage;
use askama::Template;
use axum::extract::State as Shared;
use axum::response::Response;

#[derive(Template)]
#[template(path = "service/pages/templates/gradebook.html")]
struct GradebookPage {
    frame: PageFrame,
    place: Tab,
    csrf: String,
    /// Title and most points of each homework.
    homeworks: Vec<(String, String)>,
    most: String,
    lines: Vec<GradebookLine>,
}

/// One person, with points as they are shown.
struct GradebookLine {
    number: String,
    name: String,
    points: Vec<String>,
    total: String,
}

/// `GET /teacher/gradebook`.
pub(in crate::service::pages) async fn page(
    Shared(service): Shared<Service>,
    TeacherPage(teacher): TeacherPage,
    frame: PageFrame,
) -> Result<Response, Problem> {
    teacher.check_course()?;
    let book = Gradebook::of(&service, frame.language).await?;
    let line = |line: &crate::service::gradebook::GradebookPerson| GradebookLine {
        number: line.number.clone(),
        name: line.name.clone(),
        points: line.points.iter().map(|points| points.map_or_else(|| "–".to_owned(), rounded)).collect(),
        total: rounded(line.total()),
    };
    shown(
        GradebookPage {
            place: Tab::Gradebook,
            csrf: teacher.csrf(&service),
            most: rounded(book.most()),
            lines: book.lines.iter().map(line).collect(),
            homeworks: book.homeworks.into_iter().map(|one| (one.title, rounded(one.points))).collect(),
            frame,
        }
        .render(),
    )
}

/// `GET /teacher/gradebook/file`.
pub(in crate::service::pages) async fn file(
    Shared(service): Shared<Service>,
    TeacherPage(teacher): TeacherPage,
    frame: PageFrame,
) -> Result<Response, Problem> {
    teacher.check_course()?;
    let book = Gradebook::of(&service, frame.language).await?;
    book.file(&format!("{}-gradebook.csv", service.course_id().unwrap_or("course")))
}
