//! `/api/v1/submissions`.

use super::body::{RequestForm, unkept};
use super::refusals::{Errors, NotFound, Refusals};
use super::schema::{IdempotencyKey, SubmissionJson};
use crate::language::Language;
use crate::report::Hints;
use crate::service::acts::Detail;
use crate::service::download;
use crate::service::errors::Problem;
use crate::service::idempotency::{self, RequestKey};
use crate::service::identity::{
    Identity, Teacher, Visitor, course_secret, equal_secrets, is_own_page, normal_number, with_code,
};
use crate::service::language::Lang;
use crate::service::limits::Client;
use crate::service::roster::not_on_roster;
use crate::service::store::{StaffRole, StoredSubmission, Via};
use crate::service::submit::{Receipt, Upload, submit};
use crate::service::{Service, State};
use axum::Json;
use axum::extract::rejection::QueryRejection;
use axum::extract::{Path, Query, Request, State as Shared};
use axum::http::{HeaderMap, HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use serde::Deserialize;

/// What may be said about a file; in a form, parts of the same names go before.
#[derive(Clone, Debug, Default, Deserialize, utoipa::IntoParams)]
#[serde(default)]
#[into_params(parameter_in = Query)]
pub(super) struct About {
    /// Language of the messages: `ja` or `en`.
    #[param(inline)]
    lang: Option<Language>,
    /// Id of the assignment; where the service has one only, it may be left out.
    assignment: Option<String>,
    /// Name of the file, where the body is the file.
    name: Option<String>,
    /// How much the messages help; never more than the course allows.
    #[param(inline)]
    hints: Option<Hints>,
    /// Number of the student for whom it is handed in.
    /// Needs `course` with `code`, or the token of a teacher who is no assistant. Where the class has a roster, the number must be on it.
    #[param(pattern = "^[A-Za-z0-9._-]{1,32}$")]
    student: Option<String>,
    /// Secret of the course link.
    course: Option<String>,
    /// Personal code of the student, with `course`.
    code: Option<String>,
    /// A draft: in no history, no attempt, removed after a day.
    draft: Option<bool>,
}

/// A form with the files.
#[derive(Deserialize, utoipa::ToSchema)]
#[serde(deny_unknown_fields)]
#[allow(dead_code, reason = "only its description is used")]
pub(super) struct FileForm {
    /// The shader; as many parts of this name as the homework has files, or a ZIP of them.
    #[schema(content_media_type = "application/octet-stream", min_length = 1)]
    file: String,
    /// Id of the assignment; where the service has one only, it may be left out.
    #[schema(nullable = false)]
    assignment: Option<String>,
    /// How much the messages help.
    #[schema(inline, nullable = false)]
    hints: Option<Hints>,
    /// Number of the student for whom it is handed in.
    #[schema(pattern = "^[A-Za-z0-9._-]{1,32}$", nullable = false)]
    student: Option<String>,
    /// Secret of the course link.
    #[schema(nullable = false)]
    course: Option<String>,
    /// Personal code of the student, with `course`.
    #[schema(nullable = false)]
    code: Option<String>,
    /// In place of the header `Idempotency-Key`.
    #[schema(nullable = false, pattern = "^[!-~]([ -~]{0,253}[!-~])?$")]
    idempotency_key: Option<String>,
}

/// The file itself.
#[derive(utoipa::ToSchema)]
#[schema(value_type = String, min_length = 1, example = "#version 410 core\nvoid main() { }\n")]
#[allow(dead_code, reason = "only its description is used")]
pub(super) struct FileText(String);

/// Hand in a file, or the files of a homework that has several
///
/// They are stored before anything else. 201: here is its report. 202: it is stored and will be graded; ask again at
/// the Location. Where no answer comes, send it again with the same `Idempotency-Key`: it is stored once.
#[utoipa::path(
    post, operation_id = "create_submission", path = "/api/v1/submissions", tag = "submissions", params(About, IdempotencyKey), security((), ("teacher" = [])),
    request_body(content(
        (FileForm = "multipart/form-data"),
        (FileText = "text/plain"),
        (FileText = "application/octet-stream"),
    )),
    responses(
        (status = 201, description = "Graded", body = SubmissionJson, headers(
            ("Location" = String, description = "The submission"),
            ("RateLimit-Policy" = String, description = "How much may be sent"),
            ("RateLimit" = String, description = "What is left of it"))),
        (status = 202, description = "Stored, not graded yet", body = SubmissionJson, headers(
            ("Location" = String, description = "The submission"),
            ("Retry-After" = u64, description = "Seconds after which to ask again"))),
        NotFound, Refusals, Errors
    )
)]
pub(super) async fn create(
    Shared(service): Shared<Service>,
    Lang(language): Lang,
    client: Client,
    visitor: Visitor,
    teacher: Option<Teacher>,
    about: Result<Query<About>, QueryRejection>,
    request: Request,
) -> Result<Response, Problem> {
    let Query(about) = about.map_err(super::body::other)?;
    let headers = request.headers().clone();
    let form = RequestForm::read(request, &service).await?;
    let key = RequestKey::read(&headers, form.fields.get(idempotency::FIELD).map(String::as_str), &client)?;
    let about = about.with(&form)?;
    let state = service.named(about.assignment.as_deref())?;
    let identity = identity(&state, &about, visitor, teacher, &headers).await?;
    let is_teachers = about.student.is_some() && about.course.is_none();
    let student_id = identity.student_id().filter(|_| is_teachers).map(str::to_owned);
    let receipt = submit(
        &state,
        Upload {
            hand_in: form.hand_in(about.name),
            identity,
            via: if about.draft == Some(true) { Via::Editor } else { Via::Api },
            hints: about.hints,
            key,
            address: client.address,
        },
    )
    .await?;
    let answer = answer(&state, &receipt, language).await?;
    // What a teacher hands in for somebody is in the log of acts.
    let assignment = Some(state.assignment.id.clone());
    Ok(match student_id {
        Some(id) => Detail { assignment, ..Detail::about(&id) }.on(answer),
        None => answer,
    })
}

impl About {
    /// The same with what a form says.
    fn with(mut self, form: &RequestForm) -> Result<Self, Problem> {
        let field = |name: &str| form.fields.get(name).cloned();
        self.assignment = field("assignment").or(self.assignment);
        self.student = field("student").or(self.student);
        self.course = field("course").or(self.course);
        self.code = field("code").or(self.code);
        if let Some(word) = field("hints") {
            let hints = serde_json::from_value(word.into());
            self.hints = Some(hints.map_err(|_| {
                Problem::unprocessable("hints is none, gentle or full.", "hints は none、gentle、full のいずれかです。")
            })?);
        }
        Ok(self)
    }
}

/// Who hands in: the student who is named by somebody with the right to name them, or the browser.
async fn identity(
    state: &State,
    about: &About,
    visitor: Visitor,
    teacher: Option<Teacher>,
    headers: &HeaderMap,
) -> Result<Identity, Problem> {
    let Some(number) = &about.student else {
        return browser(state, visitor, headers).await;
    };
    if let Some(course) = &about.course {
        return with_course(state, number, course, about.code.as_deref().unwrap_or_default()).await;
    }
    let teacher = teacher.ok_or_else(not_their_name)?;
    teacher.check(&state.assignment.id)?;
    teacher.check_role(StaffRole::Lecturer)?;
    let number = normal_number(number).ok_or_else(|| {
        Problem::unprocessable(
            "student is no student number: it has letters, digits, `-`, `_` or `.`, and not dots alone.",
            "student が学籍番号の形式ではありません。英数字、`-`、`_`、`.` で指定してください（`.` だけは不可）。",
        )
    })?;
    let student = state.store.student(&number, state.clock.now()).await?;
    Ok(Identity::OnBehalf(student.ok_or_else(|| not_on_roster(&number))?))
}

/// The student whom the secret of the course link and a personal code name.
pub(super) async fn with_course(state: &State, number: &str, course: &str, code: &str) -> Result<Identity, Problem> {
    if !equal_secrets(course, &course_secret(state).await?) {
        return Err(not_their_name());
    }
    Ok(Identity::OnBehalf(with_code(state, number, code).await?))
}

/// The refusal of who names a student without the right to.
fn not_their_name() -> Problem {
    Problem::new(
        StatusCode::UNAUTHORIZED,
        "unauthorized",
        "To hand in for a student, send the secret of the course link as `course` and the student's personal code as \
         `code`, or the teacher's token.",
        "学生を指定して提出するには、授業リンクの秘密を `course`、個人コードを `code` で送るか、教員用トークンが必要です。",
    )
}

/// The browser, where the request comes from a page of ours: nobody else's page hands in under its cookie.
async fn browser(state: &State, visitor: Visitor, headers: &HeaderMap) -> Result<Identity, Problem> {
    if visitor.is_new() || !is_own_page(state, headers) {
        return Ok(Identity::Nobody);
    }
    Ok(visitor.known(state).await?.identity)
}

async fn answer(state: &State, receipt: &Receipt, language: Language) -> Result<Response, Problem> {
    let submission = &receipt.submission;
    let (report, fault) = (receipt.report(), receipt.fault());
    let position = match (report, fault) {
        (None, None) => state.store.position(&submission.id, state.clock.now()).await?,
        _ => None,
    };
    let body = SubmissionJson::of(submission, report.map(|r| &**r), fault.map(|f| &**f), position, language);
    let location = body.links.itself.clone();
    let status = if report.is_some() { StatusCode::CREATED } else { StatusCode::ACCEPTED };
    let mut response = (status, Json(body)).into_response();
    let headers = response.headers_mut();
    if let Ok(location) = HeaderValue::from_str(&location) {
        headers.insert(header::LOCATION, location);
    }
    if report.is_none() {
        headers.insert(header::RETRY_AFTER, HeaderValue::from(if fault.is_some() { 10 } else { 1 }));
    }
    headers.insert(header::CACHE_CONTROL, HeaderValue::from_static("no-store"));
    Ok(response)
}

/// Language of the messages.
#[derive(Clone, Copy, Debug, Default, Deserialize, utoipa::IntoParams)]
#[into_params(parameter_in = Query)]
#[allow(dead_code, reason = "checked here, and read by the extractor of languages")]
pub(super) struct LangQuery {
    /// Language of the messages: `ja` or `en`.
    #[param(inline)]
    lang: Option<Language>,
}

/// A submission and its report
#[utoipa::path(
    get, operation_id = "read_submission", path = "/api/v1/submissions/{id}", tag = "submissions",
    params(("id" = String, Path, description = "Id of the submission"), LangQuery),
    responses((status = 200, description = "How far it is", body = SubmissionJson), NotFound, Errors)
)]
pub(super) async fn read(
    Shared(service): Shared<Service>,
    teacher: Option<Teacher>,
    Lang(language): Lang,
    Path(id): Path<String>,
    asked: Result<Query<LangQuery>, QueryRejection>,
) -> Result<Response, Problem> {
    asked.map_err(super::body::other)?;
    let StoredSubmission { submission, mut report, cross_check } = find(&service, &id).await?;
    let is_teachers = teacher.is_some_and(|teacher| teacher.may_see(&submission.assignment));
    if let Some(report) = report.as_mut().filter(|_| is_teachers) {
        report.cross_check = cross_check;
    }
    let position = match report {
        None => service.store.position(&id, service.clock.now()).await?,
        Some(_) => None,
    };
    let body = SubmissionJson::of(&submission, report.as_ref(), submission.fault.as_ref(), position, language);
    Ok(unkept(body))
}

/// The submission with this id.
pub(super) async fn find(service: &Service, id: &str) -> Result<StoredSubmission, Problem> {
    service.store.stored(id).await?.ok_or_else(Problem::not_found)
}

/// The file as handed in; several as a ZIP
#[utoipa::path(
    get, operation_id = "read_source", path = "/api/v1/submissions/{id}/source", tag = "submissions",
    params(("id" = String, Path, description = "Id of the submission")),
    responses(
        (status = 200, description = "The bytes", body = Vec<u8>, content_type = "application/octet-stream"), NotFound, Errors
    )
)]
pub(super) async fn source(Shared(service): Shared<Service>, Path(id): Path<String>) -> Result<Response, Problem> {
    download::hand_in(&service, &id).await
}
