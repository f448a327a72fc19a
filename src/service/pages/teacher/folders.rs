//! The homeworks' folders: uploaded, looked at, published, taken out of service.

pub(super) mod preview;

use super::super::datetime::TimeElement;
use super::super::frame::PageFrame;
use super::super::student::DIGITS;
use super::super::{assets, shown, student};
use super::{Tab, refused};
use crate::report::Report;
use crate::report::html::rich::{MessagePiece, pieces};
use crate::report::text::number;
use crate::service::acts::Detail;
use crate::service::api::archive::UploadedArchive;
use crate::service::courses::at;
use crate::service::errors::Problem;
use crate::service::folders::{self, Publication};
use crate::service::identity::{LecturerPage, Teacher};
use crate::service::store::UploadedFolder;
use crate::service::{Service, State};
use askama::Template;
use axum::Form;
use axum::extract::{Path, Request, State as Shared};
use axum::response::{IntoResponse, Redirect, Response};
use serde::Deserialize;

#[derive(Template)]
#[template(path = "service/pages/templates/folders.html")]
struct FoldersPage {
    frame: PageFrame,
    place: Tab,
    csrf: String,
    problem: Option<String>,
    archive_mib: u64,
    homeworks: Vec<ServedHomework>,
    folders: Vec<FolderLine>,
}

/// A homework that is served.
struct ServedHomework {
    title: String,
    id: String,
    href: String,
    /// Whether its folder was uploaded here.
    is_uploaded: bool,
}

/// An uploaded folder.
struct FolderLine {
    id: String,
    homework: String,
    digest: String,
    at: TimeElement,
    uploader: String,
    standing: &'static str,
}

#[derive(Template)]
#[template(path = "service/pages/templates/folder.html")]
struct FolderPage {
    frame: PageFrame,
    place: Tab,
    csrf: String,
    problem: Option<String>,
    line: FolderLine,
    title: String,
    files: String,
    task: Vec<MessagePiece>,
    /// The pictures of a right answer, and how they move.
    expected: String,
    motion: String,
    /// The page that students will have.
    page: String,
    solution: FileResult,
    handed_out: FileResult,
    rubric: Vec<RubricRow>,
    is_served: bool,
    /// Whether it may be removed.
    is_new: bool,
    /// Whether publishing it begins with grading what was handed in.
    has_reports: bool,
    /// The page of a grading by it that was not adopted yet.
    regrading: Option<String>,
}

/// What one of the folder's own files got.
struct FileResult {
    score: String,
    max_score: String,
    took: String,
}

/// A line of the rubric, and what it says to who hands in what is handed out.
struct RubricRow {
    label: String,
    points: String,
    max_points: String,
    message: Vec<MessagePiece>,
}

/// A form of a folder's page. `wish` says which.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::service::pages) struct FolderAction {
    csrf: String,
    wish: String,
}

fn line(service: &Service, frame: &PageFrame, folder: &UploadedFolder) -> FolderLine {
    let standing = match folder.published_at {
        _ if folders::is_served(service, folder) => frame.say("published", "公開中"),
        Some(_) => frame.say("replaced", "差し替え済み"),
        None => frame.say("not published", "未公開"),
    };
    FolderLine {
        id: folder.id.clone(),
        homework: folder.assignment.clone(),
        digest: folder.digest.chars().take(DIGITS).collect(),
        at: frame.datetime(folder.uploaded_at),
        uploader: folder.uploader.clone().unwrap_or_default(),
        standing,
    }
}

async fn view_list(
    service: &Service,
    teacher: &Teacher,
    frame: PageFrame,
    problem: Option<String>,
) -> Result<Response, Problem> {
    let uploaded = folders::all(service, teacher).await?;
    let homework = |state: State| ServedHomework {
        title: student::title(&state.assignment, frame.language),
        id: state.assignment.id.clone(),
        href: format!("{}/teacher", state.base()),
        is_uploaded: uploaded.iter().any(|folder| folder.digest == state.assignment.digest),
    };
    let homeworks = service.homeworks().filter(|state| teacher.may_see(&state.assignment.id)).map(homework).collect();
    let folders = uploaded.iter().map(|folder| line(service, &frame, folder)).collect();
    let (csrf, archive_mib) = (teacher.csrf(service), service.config.archive_mib);
    shown(FoldersPage { place: Tab::Folders, csrf, problem, archive_mib, homeworks, folders, frame }.render())
}

/// `GET /teacher/folders`.
pub(in crate::service::pages) async fn list(
    Shared(service): Shared<Service>,
    LecturerPage(teacher): LecturerPage,
    frame: PageFrame,
) -> Result<Response, Problem> {
    view_list(&service, &teacher, frame, None).await
}

/// `POST /teacher/folders`: checks and keeps a folder. One that is no homework leads back to the form.
pub(in crate::service::pages) async fn upload(
    Shared(service): Shared<Service>,
    LecturerPage(teacher): LecturerPage,
    frame: PageFrame,
    request: Request,
) -> Result<Response, Problem> {
    let archive = UploadedArchive::read(request, &service).await?;
    teacher.check_csrf(&service, archive.fields.get("csrf").map(String::as_str).unwrap_or_default())?;
    match folders::upload(&service, &archive.path, &teacher).await {
        Ok(folder) => {
            let answer = Redirect::to(&format!("/teacher/folders/{}", folder.id)).into_response();
            Ok(detail(&folder, "uploaded").on(answer))
        }
        Err(problem) if problem.status.is_client_error() => {
            let said = problem.detail.get(frame.language).replace('`', "");
            Ok(refused(view_list(&service, &teacher, frame, Some(said)).await?, problem.status))
        }
        Err(problem) => Err(problem),
    }
}

fn detail(folder: &UploadedFolder, act: &str) -> Detail {
    let digest: String = folder.digest.chars().take(DIGITS).collect();
    Detail { assignment: Some(folder.assignment.clone()), ..Detail::of(format!("{act} {digest}")) }
}

async fn view_one(
    service: &Service,
    teacher: &Teacher,
    frame: PageFrame,
    folder: &UploadedFolder,
    problem: Option<String>,
) -> Result<Response, Problem> {
    let assignment = folders::previewed(service, folder).await?.assignment;
    let served = service.homework(&folder.assignment);
    let mut regrading = None;
    if let Some(state) = &served {
        let mut by_this = state.store.regradings(&folder.assignment).await?.into_iter();
        let open = by_this.find(|one| one.folder.as_deref() == Some(&folder.id) && one.adopted_at.is_none());
        regrading = open.map(|one| format!("{}/teacher/regradings/{}", state.base(), one.id));
    }
    let earned = |report: &Report| FileResult {
        score: number(report.score),
        max_score: number(report.max_score),
        took: format!("{:.2}", report.elapsed_ms / 1e3),
    };
    let rubric = folder.handed_out.rubric.iter().map(|row| RubricRow {
        label: row.label.get(frame.language).to_owned(),
        points: number(row.points),
        max_points: number(row.max_points),
        message: pieces(row.message.get(frame.language)),
    });
    shown(
        FolderPage {
            place: Tab::Folders,
            csrf: teacher.csrf(service),
            problem,
            line: line(service, &frame, folder),
            title: student::title(&assignment, frame.language),
            files: student::file_names(&assignment),
            task: student::task(&assignment, &frame),
            expected: assets::expected(&assignment),
            motion: assets::motion(&assignment),
            page: at(&format!("/teacher/folders/{}/page", folder.id)),
            solution: earned(&folder.solution),
            handed_out: earned(&folder.handed_out),
            rubric: rubric.collect(),
            is_served: folders::is_served(service, folder),
            is_new: folder.published_at.is_none(),
            has_reports: served.is_some() && service.store.has_reports(&folder.assignment).await?,
            regrading,
            frame,
        }
        .render(),
    )
}

/// `GET /teacher/folders/{id}`: what students will see of it.
pub(in crate::service::pages) async fn one(
    Shared(service): Shared<Service>,
    LecturerPage(teacher): LecturerPage,
    Path(id): Path<String>,
    frame: PageFrame,
) -> Result<Response, Problem> {
    let folder = folders::found(&service, &teacher, &id).await?;
    view_one(&service, &teacher, frame, &folder, None).await
}

/// `POST /teacher/folders/{id}`.
pub(in crate::service::pages) async fn change(
    Shared(service): Shared<Service>,
    LecturerPage(teacher): LecturerPage,
    Path(id): Path<String>,
    frame: PageFrame,
    Form(wish): Form<FolderAction>,
) -> Result<Response, Problem> {
    teacher.check_csrf(&service, &wish.csrf)?;
    let folder = folders::found(&service, &teacher, &id).await?;
    let own = format!("/teacher/folders/{id}");
    let done = match wish.wish.as_str() {
        "publish" => folders::publish(&service, &id).await.map(|publication| match publication {
            Publication::Served => own,
            Publication::Regrading(regrading) => {
                let base = service.homework(&regrading.assignment).map(|state| state.base()).unwrap_or_default();
                format!("{base}/teacher/regradings/{}", regrading.id)
            }
        }),
        "withdraw" => folders::withdraw(&service, &id).await.map(|()| own),
        "remove" => folders::remove(&service, &id).await.map(|()| "/teacher/folders".to_owned()),
        _ => Err(Problem::unprocessable("There is no such change.", "その操作はありません。")),
    };
    match done {
        Ok(next) => Ok(detail(&folder, &wish.wish).on(Redirect::to(&next).into_response())),
        Err(problem) if problem.status.is_client_error() => {
            let said = problem.detail.get(frame.language).replace('`', "");
            Ok(refused(view_one(&service, &teacher, frame, &folder, Some(said)).await?, problem.status))
        }
        Err(problem) => Err(problem),
    }
}
