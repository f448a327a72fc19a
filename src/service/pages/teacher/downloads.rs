//! Downloads of a class: a link where the file is there at once, a page with progress where it takes seconds.

use super::super::frame::PageFrame;
use super::super::shown;
use super::{Tab, batches};
use crate::class::formats::ClassFormat;
use crate::language::Text;
use crate::service::State;
use crate::service::api::batches::{WatchedJob as Watched, named, progress, saved};
use crate::service::classes::{self, Download, DownloadJob, DownloadOptions, DownloadSelection, Pick, is_slow};
use crate::service::errors::Problem;
use crate::service::identity::TeacherPage;
use crate::service::store::Progress;
use askama::Template;
use axum::Form;
use axum::extract::{Path, State as Shared};
use axum::response::sse::{KeepAlive, Sse};
use axum::response::{IntoResponse, Redirect, Response};
use clap::ValueEnum;
use serde::Deserialize;
use std::sync::Arc;

/// A format to download.
pub(super) struct DownloadOffer {
    pub id: &'static str,
    pub what: String,
    pub is_slow: bool,
}

/// The formats that need a file of Moodle's first.
const BY_WORKSHEET: [ClassFormat; 2] = [ClassFormat::MoodleWorksheet, ClassFormat::MoodleFeedback];

/// The formats that need none.
pub(super) fn formats(frame: &PageFrame) -> Vec<DownloadOffer> {
    let here = ClassFormat::value_variants().iter().filter(|format| !BY_WORKSHEET.contains(format));
    let offer = |format: &ClassFormat| {
        let what = format.description().get(frame.language).replace('`', "");
        DownloadOffer { id: format.id(), what, is_slow: is_slow(*format) }
    };
    here.map(offer).collect()
}

#[derive(Template)]
#[template(path = "service/pages/templates/download.html")]
struct DownloadsPage {
    frame: PageFrame,
    place: Tab,
    csrf: String,
    format: String,
    back: String,
    address: String,
    progress: Progress,
    /// Name and size of the file.
    made: Option<(String, String)>,
    /// What the teacher should know of the file.
    notes: Vec<String>,
    problem: Option<String>,
}

/// The form of a download.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::service::pages) struct DownloadForm {
    csrf: String,
    /// Id of a batch; the class where it is empty.
    batch: String,
    format: String,
}

/// `POST /teacher/downloads`: begins.
pub(in crate::service::pages) async fn start(
    Shared(state): Shared<State>,
    TeacherPage(teacher): TeacherPage,
    frame: PageFrame,
    Form(wish): Form<DownloadForm>,
) -> Result<Response, Problem> {
    teacher.check_csrf(&state, &wish.csrf)?;
    let format = named(&wish.format)?;
    let (whose, back) = match wish.batch.as_str() {
        "" => (DownloadSelection::Students(Pick::Counted), frame.teacher()),
        id => {
            let batch = batches::found(&state, id).await?;
            (DownloadSelection::Batch(batch), format!("{}/batches/{id}", frame.teacher()))
        }
    };
    let language = classes::language(&state, format, None, frame.language).await?;
    Ok(begun(&state, whose, DownloadOptions { format, sheet: None, language, with_pages: true }, back))
}

/// Begins to make it, and leads to its page.
pub(super) fn begun(state: &State, whose: DownloadSelection, wanted: DownloadOptions, back: String) -> Response {
    let job = state.downloads.start(state, whose, wanted, back);
    Redirect::to(&format!("{}/teacher/downloads/{}", state.base(), job.id)).into_response()
}

fn found(state: &State, id: &str) -> Result<Arc<DownloadJob>, Problem> {
    let of_this = |job: &Arc<DownloadJob>| job.assignment == state.assignment.id;
    state.downloads.get(id).filter(of_this).ok_or_else(Problem::not_found)
}

/// `GET /teacher/downloads/{id}`.
pub(in crate::service::pages) async fn page(
    Shared(state): Shared<State>,
    TeacherPage(teacher): TeacherPage,
    Path(id): Path<String>,
    frame: PageFrame,
) -> Result<Response, Problem> {
    let job = found(&state, &id)?;
    let said = |text: &Text| text.get(frame.language).replace('`', "");
    let (made, notes, problem) = match job.made() {
        None => (None, Vec::new(), None),
        Some(Ok(made)) => (Some((made.name.clone(), size(made.bytes))), made.notes.iter().map(said).collect(), None),
        Some(Err(problem)) => (None, Vec::new(), Some(said(&problem.detail))),
    };
    shown(
        DownloadsPage {
            place: Tab::Class,
            csrf: teacher.csrf(&state),
            format: said(&job.what),
            back: job.back.clone(),
            address: format!("{}/downloads/{id}", frame.teacher()),
            progress: job.progress(),
            made,
            notes,
            problem,
            frame,
        }
        .render(),
    )
}

/// A size as people read it.
fn size(bytes: usize) -> String {
    match bytes {
        0..1_000_000 => format!("{} kB", bytes.div_ceil(1000)),
        _ => format!("{:.1} MB", bytes as f64 / 1e6),
    }
}

/// `GET /teacher/downloads/{id}/events`.
pub(in crate::service::pages) async fn events(
    Shared(state): Shared<State>,
    _: TeacherPage,
    Path(id): Path<String>,
) -> Result<Response, Problem> {
    let job = found(&state, &id)?;
    Ok(Sse::new(progress(state.service(), Watched::Download(job))).keep_alive(KeepAlive::default()).into_response())
}

/// `GET /teacher/downloads/{id}/file`.
pub(in crate::service::pages) async fn file(
    Shared(state): Shared<State>,
    _: TeacherPage,
    Path(id): Path<String>,
) -> Result<Response, Problem> {
    let job = found(&state, &id)?;
    let Some(Ok(made)) = job.made() else { return Err(Problem::not_found()) };
    let bytes = tokio::fs::read(&made.path).await.map_err(|error| Problem::internal(&error))?;
    saved(Download { name: made.name.clone(), bytes, notes: Vec::new() })
}
