//! `/api/v1/submissions/{id}/frames` and `animation.png`.

use super::refusals::{Errors, NotFound};
use super::schema::{FrameJson, FramesJson};
use super::submissions::find;
use crate::service::Service;
use crate::service::courses::at;
use crate::service::errors::Problem;
use crate::service::gallery::PictureSet;
use axum::Json;
use axum::extract::rejection::QueryRejection;
use axum::extract::{Path, Query, State as Shared};
use axum::http::header;
use axum::response::{IntoResponse, Response};
use serde::Deserialize;

/// Which pictures.
#[derive(Clone, Copy, Debug, Default, Deserialize, utoipa::IntoParams)]
#[serde(default)]
#[into_params(parameter_in = Query)]
pub(in crate::service) struct ViewQuery {
    /// `yours` (what the shader draws), `expected`, `difference`, or `all`: the three side by side.
    #[param(inline)]
    pub view: PictureSet,
}

/// The pictures of a submission
#[utoipa::path(
    get, operation_id = "list_frames", path = "/api/v1/submissions/{id}/frames", tag = "submissions",
    params(("id" = String, Path, description = "Id of the submission")),
    responses((status = 200, description = "Their addresses", body = FramesJson), NotFound, Errors)
)]
pub(super) async fn list(Shared(service): Shared<Service>, Path(id): Path<String>) -> Result<Response, Problem> {
    let report = find(&service, &id).await?.report;
    let frames = report.map(|report| report.frames).unwrap_or_default();
    let frames = frames.iter().zip(0..).map(|(frame, index)| {
        let address = |view| at(&format!("/api/v1/submissions/{id}/frames/{index}.png?view={view}"));
        FrameJson {
            index,
            t: frame.t,
            yours: address("yours"),
            expected: address("expected"),
            difference: address("difference"),
        }
    });
    Ok(Json(FramesJson { frames: frames.collect() }).into_response())
}

/// One picture
#[utoipa::path(
    get, operation_id = "read_frame", path = "/api/v1/submissions/{id}/frames/{frame}", tag = "submissions",
    params(
        ("id" = String, Path, description = "Id of the submission"),
        ("frame" = String, Path, description = "Number of the pose from 0, and `.png`", pattern = r"^[0-9]+\.png$"),
        ViewQuery
    ),
    responses(
        (status = 200, description = "The picture", body = Vec<u8>, content_type = "image/png"), NotFound, Errors
    )
)]
pub(super) async fn frame(
    Shared(service): Shared<Service>,
    Path((id, frame)): Path<(String, String)>,
    view: Result<Query<ViewQuery>, QueryRejection>,
) -> Result<Response, Problem> {
    let Query(ViewQuery { view }) = view.map_err(super::body::other)?;
    frame_of(&service, &id, &frame, view).await
}

/// The pictures as one animated PNG
#[utoipa::path(
    get, operation_id = "read_animation", path = "/api/v1/submissions/{id}/animation.png", tag = "submissions",
    params(("id" = String, Path, description = "Id of the submission"), ViewQuery),
    responses(
        (status = 200, description = "The animation", body = Vec<u8>, content_type = "image/png"), NotFound, Errors
    )
)]
pub(super) async fn animation(
    Shared(service): Shared<Service>,
    Path(id): Path<String>,
    view: Result<Query<ViewQuery>, QueryRejection>,
) -> Result<Response, Problem> {
    let Query(ViewQuery { view }) = view.map_err(super::body::other)?;
    animation_of(&service, &id, view).await
}

/// The picture `{n}.png` of a submission.
pub(in crate::service) async fn frame_of(
    service: &Service,
    id: &str,
    frame: &str,
    view: PictureSet,
) -> Result<Response, Problem> {
    let index = frame.strip_suffix(".png").filter(|n| n.bytes().all(|byte| byte.is_ascii_digit()));
    let index: usize = index.and_then(|index| index.parse().ok()).ok_or_else(Problem::not_found)?;
    let (state, submission) = service.submission(id).await?;
    png(state.gallery.frame(&state, &submission, view, index).await?)
}

/// The animation of a submission.
pub(in crate::service) async fn animation_of(
    service: &Service,
    id: &str,
    view: PictureSet,
) -> Result<Response, Problem> {
    let (state, submission) = service.submission(id).await?;
    png(state.gallery.animation(&state, &submission, view).await?)
}

fn png(bytes: Option<Vec<u8>>) -> Result<Response, Problem> {
    let bytes = bytes.ok_or_else(Problem::not_found)?;
    // A submission never changes, and neither does what it draws.
    let headers = [(header::CONTENT_TYPE, "image/png"), (header::CACHE_CONTROL, "private, max-age=86400, immutable")];
    Ok((headers, bytes).into_response())
}
