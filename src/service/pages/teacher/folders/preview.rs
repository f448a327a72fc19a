//! The student's page of a folder that is looked at, with all that it asks of the service.

use crate::service::errors::Problem;
use crate::service::folders;
use crate::service::identity::{LecturerPage, Teacher, Visitor};
use crate::service::pages::frame::PageFrame;
use crate::service::pages::hand_in;
use crate::service::{Service, State};
use axum::extract::{Multipart, Path, Query, State as Shared};
use axum::http::StatusCode;
use axum::response::Response;

/// The homework in a folder, for a lecturer who looks at it.
async fn looked_at(service: &Service, teacher: &Teacher, id: &str) -> Result<State, Problem> {
    let folder = folders::found(service, teacher, id).await?;
    folders::previewed(service, &folder).await
}

/// `GET /teacher/folders/{id}/page`: the student's page, as it will be.
pub(in crate::service::pages) async fn student_page(
    Shared(service): Shared<Service>,
    LecturerPage(teacher): LecturerPage,
    Path(id): Path<String>,
    frame: PageFrame,
    visitor: Visitor,
) -> Result<Response, Problem> {
    let state = looked_at(&service, &teacher, &id).await?;
    let frame = frame.of(&state);
    hand_in::desk(Shared(state), Query::default(), frame, visitor).await
}

/// `GET /teacher/folders/{id}/page/starter`.
pub(in crate::service::pages) async fn starter(
    Shared(service): Shared<Service>,
    LecturerPage(teacher): LecturerPage,
    Path(id): Path<String>,
    wanted: Query<hand_in::StarterQuery>,
) -> Result<Response, Problem> {
    hand_in::starter(Shared(looked_at(&service, &teacher, &id).await?), wanted).await
}

/// `POST /teacher/folders/{id}/page/read`.
pub(in crate::service::pages) async fn read(
    Shared(service): Shared<Service>,
    LecturerPage(teacher): LecturerPage,
    Path(id): Path<String>,
    visitor: Visitor,
    form: Multipart,
) -> Result<Response, Problem> {
    hand_in::read(Shared(looked_at(&service, &teacher, &id).await?), visitor, form).await
}

/// `POST /teacher/folders/{id}/page`: what a student does there is not done at a page that is looked at.
pub(in crate::service::pages) async fn not_handed_in(LecturerPage(_): LecturerPage) -> Problem {
    Problem::new(
        StatusCode::CONFLICT,
        "preview",
        "This is a preview: nothing was handed in, and nothing is graded. Publish the homework first.",
        "プレビューのため、提出も採点も行っていません。先に課題を公開してください。",
    )
}
