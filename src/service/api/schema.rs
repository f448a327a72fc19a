//! The shapes of requests and answers.

use crate::class::formats::ClassFormat;
use crate::intake::Refused;
use crate::language::Language;
use crate::report::Report;
use crate::report::json::{self, JsonReport};
use crate::service::courses::at;
use crate::service::store::{Batch, BatchEntry, Progress, Submission, SubmissionState, Via};
use clap::ValueEnum;
use serde::Serialize;
use utoipa::openapi::RefOr;
use utoipa::openapi::schema::{ObjectBuilder, Schema, Type};
use utoipa::openapi::security::{HttpAuthScheme, HttpBuilder, SecurityScheme};

/// What was handed in, and what came of it.
#[derive(Debug, Serialize, utoipa::ToSchema)]
pub(super) struct SubmissionJson<'a> {
    /// Unguessable: who has it may read the report.
    pub id: &'a str,
    /// Id of the assignment.
    pub assignment: &'a str,
    /// `queued` (come back), `graded` (there is a report) or `failed` (our fault; it is tried again, and costs nothing).
    pub state: SubmissionState,
    /// The way by which it came.
    pub via: Via,
    /// File name as handed in; the names of several files are joined by commas, and `report.sources` has each.
    pub name: &'a str,
    /// When it came.
    #[schema(format = DateTime)]
    pub received_at: String,
    /// Position in the queue, while it waits there.
    pub position: Option<u64>,
    /// The report.
    pub report: Option<JsonReport<'a>>,
    /// Why it could not be graded.
    pub fault: Option<FaultJson<'a>>,
    /// Where else to look.
    pub links: Links,
}

/// Our failure.
#[derive(Debug, Serialize, utoipa::ToSchema)]
pub(super) struct FaultJson<'a> {
    /// What failed.
    pub message: &'a str,
    /// What to do about it.
    pub remedy: Option<&'a str>,
}

/// Addresses of one submission.
#[derive(Debug, Serialize, utoipa::ToSchema)]
pub(super) struct Links {
    /// This object.
    #[serde(rename = "self")]
    pub itself: String,
    /// The report as a page.
    pub page: String,
    /// Its pictures.
    pub frames: String,
    /// The pictures as one animation.
    pub animation: String,
    /// The file as handed in; several as a ZIP.
    pub source: String,
}

impl Links {
    fn of(id: &str) -> Self {
        let itself = at(&format!("/api/v1/submissions/{id}"));
        Self {
            page: at(&format!("/r/{id}")),
            frames: format!("{itself}/frames"),
            animation: format!("{itself}/animation.png"),
            source: format!("{itself}/source"),
            itself,
        }
    }
}

impl<'a> SubmissionJson<'a> {
    /// The object for a client.
    pub fn of(
        submission: &'a Submission,
        report: Option<&'a Report>,
        fault: Option<&'a crate::fault::Fault>,
        position: Option<u64>,
        language: Language,
    ) -> Self {
        let state = match (report, fault) {
            (Some(_), _) => SubmissionState::Graded,
            (None, Some(_)) => SubmissionState::Failed,
            (None, None) => SubmissionState::Queued,
        };
        Self {
            id: &submission.id,
            assignment: &submission.assignment,
            state,
            via: submission.via,
            name: &submission.name,
            received_at: time(submission.received_at),
            position,
            report: report.map(|report| json::view(report, language)),
            fault: fault.map(|fault| FaultJson {
                message: fault.message.get(language),
                remedy: fault.remedy.as_ref().map(|remedy| remedy.get(language)),
            }),
            links: Links::of(&submission.id),
        }
    }
}

/// A time in RFC 3339.
pub(super) fn time(millis: i64) -> String {
    crate::service::clock::rfc3339(millis)
}

/// A whole class that a teacher handed in.
#[derive(Debug, Serialize, utoipa::ToSchema)]
pub(super) struct BatchJson {
    /// Its id.
    pub id: String,
    /// Name of the archive.
    pub title: String,
    /// When it came.
    #[schema(format = DateTime)]
    pub received_at: String,
    /// How far it is.
    pub progress: Progress,
    /// Everyone, in the order of the archive.
    pub students: Vec<BatchStudentJson>,
    /// Members of the archive that were left out, and why.
    pub refused: Vec<RefusedJson>,
    /// Where else to look.
    pub links: BatchLinks,
}

/// One student of a batch.
#[derive(Debug, Serialize, utoipa::ToSchema)]
pub(super) struct BatchStudentJson {
    /// Tells them apart.
    pub key: String,
    /// As the archive names them.
    pub name: String,
    /// Where the file was.
    pub path: Option<String>,
    /// Address of the submission; none where there was nothing to grade.
    pub submission: Option<String>,
    /// Why there was nothing to grade.
    pub note: Option<String>,
}

/// A member that was left out.
#[derive(Debug, Serialize, utoipa::ToSchema)]
pub(super) struct RefusedJson {
    /// Where it was.
    pub path: String,
    /// Why.
    pub reason: String,
}

/// Addresses of a batch.
#[derive(Debug, Serialize, utoipa::ToSchema)]
pub(super) struct BatchLinks {
    /// This object.
    #[serde(rename = "self")]
    pub itself: String,
    /// Its events.
    pub events: String,
    /// Its files by the name of the format.
    pub files: Vec<String>,
}

impl BatchJson {
    /// The object for a client.
    pub fn of(batch: Batch, progress: Progress, entries: Vec<BatchEntry>, language: Language) -> Self {
        let itself = at(&format!("/api/v1/batches/{}", batch.id));
        let student = |entry: BatchEntry| BatchStudentJson {
            key: entry.student.key,
            name: entry.student.name,
            path: entry.path,
            submission: entry.submission_id.map(|id| at(&format!("/api/v1/submissions/{id}"))),
            note: entry.note.map(|note| note.get(language).to_owned()),
        };
        let refused =
            |refused: Refused| RefusedJson { path: refused.path, reason: refused.reason.get(language).to_owned() };
        let files = ClassFormat::value_variants().iter().map(|format| format!("{itself}/files/{}", format.id()));
        Self {
            title: batch.title,
            received_at: time(batch.created_at),
            progress,
            students: entries.into_iter().map(student).collect(),
            refused: batch.refused.into_iter().map(refused).collect(),
            links: BatchLinks { events: format!("{itself}/events"), files: files.collect(), itself: itself.clone() },
            id: batch.id,
        }
    }
}

/// The name of a format of `ggrade batch` that is made of the class alone.
pub(super) struct FormatName;

/// The name of a format that is made by the worksheet that Moodle gives.
pub(super) struct FilledFormatName;

fn format_names(is_wanted: fn(&ClassFormat) -> bool) -> RefOr<Schema> {
    let all = ClassFormat::value_variants().iter().filter(|format| is_wanted(format));
    ObjectBuilder::new().schema_type(Type::String).enum_values(Some(all.map(|format| format.id()))).into()
}

impl utoipa::PartialSchema for FormatName {
    fn schema() -> RefOr<Schema> {
        format_names(|format| *format != ClassFormat::MoodleWorksheet)
    }
}

impl utoipa::ToSchema for FormatName {}

impl utoipa::PartialSchema for FilledFormatName {
    fn schema() -> RefOr<Schema> {
        format_names(|format| matches!(format, ClassFormat::MoodleWorksheet | ClassFormat::MoodleFeedback))
    }
}

impl utoipa::ToSchema for FilledFormatName {}

/// The pictures of a submission.
#[derive(Debug, Serialize, utoipa::ToSchema)]
pub(super) struct FramesJson {
    /// One for each pose; empty when nothing was drawn.
    pub frames: Vec<FrameJson>,
}

/// The pictures of a pose.
#[derive(Debug, Serialize, utoipa::ToSchema)]
pub(super) struct FrameJson {
    /// From 0.
    pub index: u32,
    /// Fraction of the animation cycle, in [0, 1).
    pub t: f64,
    /// What the shader draws.
    pub yours: String,
    /// What a right answer draws.
    pub expected: String,
    /// Where they differ.
    pub difference: String,
}

/// The key of a request that may be sent again.
#[derive(serde::Deserialize, utoipa::IntoParams)]
#[into_params(parameter_in = Header)]
#[allow(dead_code, reason = "only its description is used")]
pub(super) struct IdempotencyKey {
    /// Made up anew for each file, such as a UUID, and sent again with the same file where no answer came: the same
    /// answer comes, and nothing is stored twice. Known for a day.
    #[serde(rename = "Idempotency-Key")]
    #[param(pattern = "^[!-~]([ -~]{0,253}[!-~])?$", example = "\"8e03978e-40d5-43e8-bc93-6894a57f9324\"")]
    idempotency_key: Option<String>,
}

/// The teacher's token.
pub(super) struct Security;

impl utoipa::Modify for Security {
    fn modify(&self, document: &mut utoipa::openapi::OpenApi) {
        let scheme = HttpBuilder::new()
            .scheme(HttpAuthScheme::Bearer)
            .description(Some("The teacher's token, or one of a person's own"))
            .build();
        let components = document.components.get_or_insert_default();
        components.add_security_scheme("teacher", SecurityScheme::Http(scheme));
    }
}
