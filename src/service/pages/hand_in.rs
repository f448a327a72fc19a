//! The student's page and its forms: looking, trying, handing in.

use super::form::UploadForm;
use super::frame::{PageFrame, SignInLink};
use super::standing::{StudentStanding, number_notice};
use super::student::{LISTED, StudentPageParts};
use super::{preview, result, shown};
use crate::service::State;
use crate::service::counting;
use crate::service::courses::at;
use crate::service::download;
use crate::service::errors::Problem;
use crate::service::gallery;
use crate::service::idempotency::RequestKey;
use crate::service::identity::{Teacher, Visitor, code_needed};
use crate::service::limits::Client;
use crate::service::roster::not_on_roster;
use crate::service::store::{self, Audience, Submission, Via};
use crate::service::submit::{Receipt, Upload, check_text, for_slots, is_stranger, not_shown, submit};
use crate::slots::handed_out;
use crate::source;
use axum::extract::{Multipart, Query, Request, State as Shared};
use axum::http::{HeaderMap, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Redirect, Response};
use axum::routing::{get, post};
use axum::{Json, Router};
use base64::prelude::{BASE64_STANDARD, Engine};
use reference::Assignment;
use serde::{Deserialize, Serialize};

/// What the page may be asked to show.
#[derive(Debug, Default, Deserialize)]
pub(super) struct HandInQuery {
    /// Id of a submission whose texts to go on with.
    from: Option<String>,
}

/// The routes of a homework, below its own address.
pub(super) fn router() -> Router<State> {
    Router::new()
        .route("/", get(desk).post(hand_in))
        .route("/draft", post(draft))
        .route("/choose", post(choose))
        .route("/read", post(read))
        .route("/starter", get(starter))
        .route("/goal.png", get(goal))
        .route("/portrait.png", get(portrait))
}

/// The layer around a homework's pages: students find them once they are shown, whoever teaches it before.
pub(super) async fn seen(Shared(state): Shared<State>, request: Request, next: Next) -> Result<Response, Problem> {
    let settings = state.store.assignment(&state.assignment.id).await?;
    if !settings.is_shown(state.clock.now()) {
        let teacher = Teacher::of(&state, request.headers()).await?;
        if !teacher.is_some_and(|teacher| teacher.may_see(&settings.id)) {
            return Err(not_shown());
        }
    }
    Ok(next.run(request).await)
}

/// The layer around pages that load the right pictures of a homework.
pub(super) async fn drawn(Shared(state): Shared<State>, request: Request, next: Next) -> Result<Response, Problem> {
    gallery::drawn(&state).await?;
    Ok(next.run(request).await)
}

/// `GET /a/{assignment}`.
pub(super) async fn desk(
    Shared(state): Shared<State>,
    Query(wish): Query<HandInQuery>,
    frame: PageFrame,
    visitor: Visitor,
) -> Result<Response, Problem> {
    let id = &state.assignment.id;
    let identity = &visitor.identity;
    let settings = state.store.assignment_for(id, identity.student_id()).await?;
    let (mut history, mut used) = (Vec::new(), 0);
    if let Some(owner) = identity.owner_id() {
        history = state.store.history(id, owner, identity.student_id(), LISTED).await?;
        used = state.store.attempts(id, owner, identity.student_id()).await?;
    }
    let asker = identity.student_id().or(identity.owner_id());
    let appeal = match asker {
        Some(asker) => state.store.appeal_of(id, asker).await?,
        None => None,
    };
    let needs_number = settings.audience == Audience::Number && identity.student().is_none();
    let stranger = match identity.student() {
        Some(student) if is_stranger(&state, student).await? => Some(not_on_roster(&student.number).detail),
        Some(_) => None,
        None => identity.claimed().map(|student| code_needed(student).detail),
    };
    let notice = match &stranger {
        Some(detail) => Some(detail.get(frame.language)),
        None => number_notice(&state, &frame, identity, needs_number).await?,
    };
    let own = match &wish.from {
        Some(submission) => texts_of(&state, submission).await?.map(|texts| (submission.clone(), texts)),
        None => None,
    };
    let lost = (wish.from.is_some() && own.is_none()).then(|| {
        frame.say(
            "The hand-in to go on with is no longer kept; below is what was handed out, or your newest draft.",
            "開こうとした提出の内容は残っていません。配布ファイルまたは最新の下書きを表示しています。",
        )
    });
    let desk = StudentPageParts {
        preview: preview::panel(&state, &frame),
        frame,
        state: &state,
        standing: StudentStanding {
            settings: &settings,
            now: state.clock.now(),
            may_hand_in: !needs_number && stranger.is_none(),
            used,
        },
        who: identity.student().cloned(),
        csrf: visitor.csrf(&state),
        history: &history,
        appeal,
        own,
        notice: notice.or(lost).map(str::to_owned),
        sign_ins: SignInLink::all(&state, Some(id)),
    };
    shown(desk.render())
}

/// The texts of a submission's files in the order of the slots, where the editors can go on with them.
async fn texts_of(state: &State, id: &str) -> Result<Option<Vec<String>>, Problem> {
    let submission = state.store.submission(id).await?;
    if submission.is_none_or(|submission| submission.assignment != state.assignment.id) {
        return Ok(None);
    }
    let sources = state.store.hand_in(id).await?.unwrap_or_default().readable();
    let texts: Vec<String> = sources.into_iter().map(|source| source.text).collect();
    Ok(Some(texts).filter(|texts| texts.len() == state.assignment.files.len()))
}

/// Which of the files that are handed out is asked for.
#[derive(Debug, Default, Deserialize)]
pub(super) struct StarterQuery {
    /// Its name.
    file: Option<String>,
}

/// `GET /a/{assignment}/starter`: the handed-out file, or the one that is named; several as a ZIP.
pub(super) async fn starter(
    Shared(state): Shared<State>,
    Query(wanted): Query<StarterQuery>,
) -> Result<Response, Problem> {
    let file = match (state.assignment.files.as_slice(), wanted.file) {
        (slots, Some(name)) => slots.iter().find(|slot| slot.name == name).ok_or_else(Problem::not_found)?,
        ([only], None) => only,
        _ => return download::files(&state.assignment.id, &handed_out(&state.assignment)),
    };
    let headers = [(header::CONTENT_TYPE, "text/plain; charset=utf-8"), (header::CACHE_CONTROL, "no-cache")];
    Ok((headers, file.starter.clone()).into_response())
}

/// The address of a picture of what a right answer draws: its address has the digest of the homework.
pub(super) fn picture(homework: &Assignment, name: &str) -> String {
    at(&format!("/a/{}/{name}.png?v={}", homework.id, &homework.digest[..16]))
}

/// `GET /a/{assignment}/goal.png`: what a right answer draws, small and moving.
async fn goal(Shared(state): Shared<State>) -> Result<Response, Problem> {
    Ok(kept(gallery::goal(&state).await?))
}

/// `GET /a/{assignment}/portrait.png`: the same at one pose.
async fn portrait(Shared(state): Shared<State>) -> Result<Response, Problem> {
    Ok(kept(gallery::portrait_of_right(&state).await?))
}

fn kept(png: Vec<u8>) -> Response {
    let headers = [(header::CONTENT_TYPE, "image/png"), (header::CACHE_CONTROL, "private, max-age=86400, immutable")];
    (headers, png).into_response()
}

/// A file as the editor of its slot takes it.
#[derive(Debug, Serialize)]
struct EditorFile {
    /// Which slot, counted from 0.
    slot: usize,
    name: String,
    /// Its text as grading reads it.
    text: String,
    /// Its bytes in base64: they are what is handed in as long as nobody changes the text.
    bytes: String,
}

/// `POST /a/{assignment}/read`: which of the files that somebody chose is for which slot, and their texts, for the editors.
/// Nothing is stored.
pub(super) async fn read(Shared(state): Shared<State>, visitor: Visitor, form: Multipart) -> Result<Response, Problem> {
    let form = UploadForm::read(form).await?;
    visitor.check_csrf(&state, &form.csrf)?;
    let mut files = Vec::new();
    for (slot, file) in for_slots(&state, form.files, form.shown).await? {
        check_text(&state.assignment.files[slot], &file.bytes).map_err(|problem| problem.about(&file.name))?;
        let text = source::readable(&file).map(|source| source.text);
        let text = text.ok_or_else(|| Problem::internal(&"a text without a text"))?;
        files.push(EditorFile { slot, name: file.name, text, bytes: BASE64_STANDARD.encode(&file.bytes) });
    }
    Ok(([(header::CACHE_CONTROL, "no-store")], Json(files)).into_response())
}

/// `POST /a/{assignment}`: hands in, and goes to the report. A script gets the receipt as a part of its page.
pub(super) async fn hand_in(
    Shared(state): Shared<State>,
    frame: PageFrame,
    client: Client,
    visitor: Visitor,
    headers: HeaderMap,
    form: Multipart,
) -> Result<Response, Problem> {
    let receipt = take(&state, client, visitor, &headers, form, Via::Page).await?;
    if headers.contains_key("x-part") {
        return result::handed_in(&state, &frame, &receipt.submission, receipt.report().map(AsRef::as_ref)).await;
    }
    Ok(Redirect::to(&format!("/r/{}", receipt.submission.id)).into_response())
}

/// `POST /a/{assignment}/draft`: grades without handing in. A script gets the report as a part of its page.
pub(super) async fn draft(
    Shared(state): Shared<State>,
    frame: PageFrame,
    client: Client,
    visitor: Visitor,
    headers: HeaderMap,
    form: Multipart,
) -> Result<Response, Problem> {
    let receipt = take(&state, client, visitor, &headers, form, Via::Editor).await?;
    let Submission { id, .. } = &receipt.submission;
    if !headers.contains_key("x-part") {
        return Ok(Redirect::to(&format!("/r/{id}")).into_response());
    }
    match (receipt.report(), receipt.fault()) {
        (Some(report), _) => result::draft_part(&state, &frame, &receipt.submission, report).await,
        (None, Some(fault)) => Err(Problem::internal(&fault.message.en)),
        (None, None) => Ok(result::come_back(id)),
    }
}

async fn take(
    state: &State,
    client: Client,
    visitor: Visitor,
    headers: &HeaderMap,
    form: Multipart,
    via: Via,
) -> Result<Receipt, Problem> {
    let mut form = UploadForm::read(form).await?;
    visitor.check_csrf(state, &form.csrf)?;
    let field = form.key.take();
    let visitor = visitor.known(state).await?;
    let hand_in = form.hand_in(&state.assignment.files)?;
    // A page that stays open may be sent again with another text, and first to try it: those are other requests.
    let field = field.map(|field| format!("{field} {} {}", store::word(&via), hand_in.sha256()));
    let key = RequestKey::read(headers, field.as_deref(), &client)?;
    submit(state, Upload { hand_in, identity: visitor.identity, via, hints: None, key, address: client.address }).await
}

/// The form by which somebody chooses what counts.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
struct CountedSubmissionForm {
    csrf: String,
    submission: String,
}

/// `POST /a/{assignment}/choose`: lets one of the attempts of whoever sits there count.
async fn choose(
    Shared(state): Shared<State>,
    visitor: Visitor,
    axum::Form(chosen): axum::Form<CountedSubmissionForm>,
) -> Result<Response, Problem> {
    visitor.check_csrf(&state, &chosen.csrf)?;
    let (_, submission) = state.submission(&chosen.submission).await?;
    counting::choose_own(&state, &visitor.identity, &submission).await?;
    Ok(Redirect::to(&format!("{}#attempts", state.page())).into_response())
}
