//! `/api/v1/folders`: homeworks that come by the network.

use super::archive::UploadedArchive;
use super::body::unkept;
use super::caller::{Caller, check};
use super::refusals::{Errors, NotFound, Refusals};
use super::schema::time;
use crate::service::Service;
use crate::service::acts::Detail;
use crate::service::errors::{Problem, ProblemJson};
use crate::service::folders::{self, Publication};
use crate::service::identity::Teacher;
use crate::service::store::{StaffRole, UploadedFolder};
use axum::Json;
use axum::extract::{Path, Request, State as Shared};
use axum::http::StatusCode;
use axum::response::{IntoResponse, Response};
use serde::{Deserialize, Serialize};

/// A homework's folder that was uploaded and checked.
#[derive(Serialize, utoipa::ToSchema)]
pub(super) struct FolderJson {
    /// Id.
    id: String,
    /// Id of the homework.
    assignment: String,
    /// Digest of its files: another version has another.
    digest: String,
    /// When it was uploaded.
    #[schema(format = DateTime)]
    uploaded_at: String,
    /// Whether students see it now.
    is_served: bool,
    /// Points that its own solution got.
    solution_score: f64,
    /// Points that the files got which it hands out.
    handed_out_score: f64,
    /// Points of a right answer.
    max_score: f64,
}

impl FolderJson {
    fn of(service: &Service, folder: &UploadedFolder) -> Self {
        Self {
            id: folder.id.clone(),
            assignment: folder.assignment.clone(),
            digest: folder.digest.clone(),
            uploaded_at: time(folder.uploaded_at),
            is_served: folders::is_served(service, folder),
            solution_score: folder.solution.score,
            handed_out_score: folder.handed_out.score,
            max_score: folder.solution.max_score,
        }
    }
}

/// The uploaded folders.
#[derive(Serialize, utoipa::ToSchema)]
pub(super) struct FoldersJson {
    /// The newest first.
    folders: Vec<FolderJson>,
}

/// A form with a folder.
#[derive(Deserialize, utoipa::ToSchema)]
#[serde(deny_unknown_fields)]
#[allow(dead_code, reason = "only its description is used")]
pub(super) struct FolderForm {
    /// The ZIP of a folder with an `assignment.toml`.
    #[schema(content_media_type = "application/zip", min_length = 1)]
    file: String,
}

/// What became of a folder that was to be published.
#[derive(Serialize, utoipa::ToSchema)]
pub(super) struct PublicationJson {
    /// Whether students see it now.
    is_served: bool,
    /// Id of the regrading by it, whose adoption publishes it; none where nothing was handed in before.
    regrading: Option<String>,
}

fn done(folder: &UploadedFolder, act: &str, answer: Response) -> Response {
    let digest: String = folder.digest.chars().take(8).collect();
    Detail { assignment: Some(folder.assignment.clone()), ..Detail::of(format!("{act} {digest}")) }.on(answer)
}

/// The uploaded folders
///
/// With a token of one homework those of that homework.
#[utoipa::path(
    get, operation_id = "list_folders", path = "/api/v1/folders", tag = "batches", security(("teacher" = [])),
    responses((status = 200, description = "Each with what its own files got", body = FoldersJson), Refusals, Errors)
)]
pub(super) async fn list(teacher: Teacher, Shared(service): Shared<Service>) -> Result<Response, Problem> {
    let folders = folders::all(&service, &teacher).await?;
    let folders = folders.iter().map(|folder| FolderJson::of(&service, folder)).collect();
    Ok(unkept(FoldersJson { folders }))
}

/// Upload the folder of a homework
///
/// It is unpacked, read and its own files are graded in a process of its own; what is no homework that grades is refused (422) with
/// the file and the line. Nobody sees it before it is published. The same folder, sent again, is there once. A token of one homework
/// is good for versions of that homework.
#[utoipa::path(
    post, operation_id = "create_folder", path = "/api/v1/folders", tag = "batches", security(("teacher" = [])),
    request_body(content((FolderForm = "multipart/form-data"), (Vec<u8> = "application/zip"))),
    responses((status = 201, description = "Checked and kept", body = FolderJson), Refusals, Errors)
)]
pub(super) async fn create(
    caller: Caller,
    Shared(service): Shared<Service>,
    request: Request,
) -> Result<Response, Problem> {
    check(&caller, &service, StaffRole::Lecturer)?;
    let archive = UploadedArchive::read(request, &service).await?;
    let folder = folders::upload(&service, &archive.path, &caller.0).await?;
    let answer = (StatusCode::CREATED, Json(FolderJson::of(&service, &folder))).into_response();
    Ok(done(&folder, "uploaded", answer))
}

/// An uploaded folder
#[utoipa::path(
    get, operation_id = "read_folder", path = "/api/v1/folders/{id}", tag = "batches", security(("teacher" = [])),
    params(("id" = String, Path, description = "Id of the folder")),
    responses((status = 200, description = "With what its own files got", body = FolderJson), NotFound, Refusals, Errors)
)]
pub(super) async fn read(
    teacher: Teacher,
    Shared(service): Shared<Service>,
    Path(id): Path<String>,
) -> Result<Response, Problem> {
    let folder = folders::found(&service, &teacher, &id).await?;
    Ok(unkept(FolderJson::of(&service, &folder)))
}

/// Delete a folder that was never published
#[utoipa::path(
    delete, operation_id = "delete_folder", path = "/api/v1/folders/{id}", tag = "batches", security(("teacher" = [])),
    params(("id" = String, Path, description = "Id of the folder")),
    responses(
        (status = 204, description = "It is gone"),
        (status = 409, description = "It was published", body = ProblemJson, content_type = "application/problem+json"),
        NotFound, Refusals, Errors
    )
)]
pub(super) async fn remove(
    caller: Caller,
    Shared(service): Shared<Service>,
    Path(id): Path<String>,
) -> Result<Response, Problem> {
    check(&caller, &service, StaffRole::Lecturer)?;
    let folder = folders::found(&service, &caller.0, &id).await?;
    folders::remove(&service, &id).await?;
    Ok(done(&folder, "remove", StatusCode::NO_CONTENT.into_response()))
}

/// Publish a folder
///
/// Students see it from now on (200). Where something was handed in for another version, that is graded by this one first (202):
/// adopting the results publishes it.
#[utoipa::path(
    post, operation_id = "publish_folder", path = "/api/v1/folders/{id}/publication", tag = "batches", security(("teacher" = [])),
    params(("id" = String, Path, description = "Id of the folder")),
    responses(
        (status = 200, description = "Students see it", body = PublicationJson),
        (status = 202, description = "Everything is graded by it first", body = PublicationJson), NotFound, Refusals, Errors
    )
)]
pub(super) async fn publish(
    caller: Caller,
    Shared(service): Shared<Service>,
    Path(id): Path<String>,
) -> Result<Response, Problem> {
    check(&caller, &service, StaffRole::Lecturer)?;
    let folder = folders::found(&service, &caller.0, &id).await?;
    let (status, regrading) = match folders::publish(&service, &id).await? {
        Publication::Served => (StatusCode::OK, None),
        Publication::Regrading(regrading) => (StatusCode::ACCEPTED, Some(regrading.id)),
    };
    let body = PublicationJson { is_served: regrading.is_none(), regrading };
    Ok(done(&folder, "publish", (status, Json(body)).into_response()))
}

/// Take a homework out of service
///
/// As far as it was published here: what the command line names is served as it is there. Nothing that was handed in is lost.
#[utoipa::path(
    delete, operation_id = "withdraw_folder", path = "/api/v1/folders/{id}/publication", tag = "batches", security(("teacher" = [])),
    params(("id" = String, Path, description = "Id of the folder")),
    responses(
        (status = 204, description = "It is not served any more"),
        (status = 409, description = "It is the only homework, or files were graded by it", body = ProblemJson, content_type = "application/problem+json"),
        NotFound, Refusals, Errors
    )
)]
pub(super) async fn withdraw(
    caller: Caller,
    Shared(service): Shared<Service>,
    Path(id): Path<String>,
) -> Result<Response, Problem> {
    check(&caller, &service, StaffRole::Lecturer)?;
    let folder = folders::found(&service, &caller.0, &id).await?;
    folders::withdraw(&service, &id).await?;
    Ok(done(&folder, "withdraw", StatusCode::NO_CONTENT.into_response()))
}
