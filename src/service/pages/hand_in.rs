//! The student's page and its forms: looking, trying, handing in.

use super::frame::Frame;
use super::standing::StudentStanding;
use super::student::{Desk, LISTED};
use super::{result, shown};
use crate::grade::handed_out;
use crate::hand_in::{HandIn, HandedInFile};
use crate::service::State;
use crate::service::download;
use crate::service::errors::Problem;
use crate::service::idempotency::{self, RequestKey};
use crate::service::identity::Visitor;
use crate::service::limits::Client;
use crate::service::roster::not_on_roster;
use crate::service::store::{self, Audience, Submission, Via};
use crate::service::submit::{Receipt, Upload, asked_for, is_stranger, submit};
use crate::slots::wording;
use crate::source;
use axum::Router;
use axum::extract::{Multipart, Query, State as Shared};
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Redirect, Response};
use axum::routing::{get, post};
use serde::Deserialize;

/// What the page may be asked to show.
#[derive(Debug, Default, Deserialize)]
pub(super) struct Wish {
    /// Id of a submission whose text to go on with.
    from: Option<String>,
}

/// The routes of a homework, below its own address.
pub(super) fn router() -> Router<State> {
    Router::new()
        .route("/", get(desk).post(hand_in))
        .route("/draft", post(draft))
        .route("/read", post(read))
        .route("/starter", get(starter))
}

/// `GET /a/{assignment}`.
pub(super) async fn desk(
    Shared(state): Shared<State>,
    Query(wish): Query<Wish>,
    frame: Frame,
    visitor: Visitor,
) -> Result<Response, Problem> {
    let id = &state.assignment.id;
    let settings = state.store.assignment(id).await?;
    let identity = &visitor.identity;
    let (mut history, mut used) = (Vec::new(), 0);
    if let Some(owner) = identity.owner_id() {
        history = state.store.history(id, owner, LISTED).await?;
        used = state.store.attempts(id, owner, identity.student().map(|student| student.id.as_str())).await?;
    }
    let needs_number = settings.audience == Audience::Number && identity.student().is_none();
    let stranger = match identity.student() {
        Some(student) if is_stranger(&state, student).await? => Some(not_on_roster(&student.number).detail),
        _ => None,
    };
    let notice = match &stranger {
        Some(detail) => Some(detail.get(frame.language)),
        None => needs_number.then(|| {
            frame.say(
                "To hand in, open the link that your teacher gave you and enter your student number.",
                "提出するには、教員から伝えられたリンクを開き、学籍番号を入力してください。",
            )
        }),
    };
    let own = match &wish.from {
        Some(submission) => text_of(&state, submission).await?.map(|text| (submission.clone(), text)),
        None => None,
    };
    let lost = (wish.from.is_some() && own.is_none()).then(|| {
        frame.say(
            "The text to go on with is no longer kept; below is the handed-out file, or your newest draft.",
            "開こうとした提出の内容は残っていません。配布ファイルまたは最新の下書きを表示しています。",
        )
    });
    let desk = Desk {
        frame,
        homework: std::sync::Arc::clone(&state.assignment),
        standing: StudentStanding {
            settings: &settings,
            now: state.clock.now(),
            may_hand_in: !needs_number && stranger.is_none(),
            used,
        },
        who: identity.student().map(|student| student.number.clone()),
        csrf: visitor.csrf(&state),
        history: &history,
        own,
        notice: notice.or(lost).map(str::to_owned),
    };
    shown(desk.render())
}

/// The text of a submission, where it is one that the editor can go on with.
async fn text_of(state: &State, id: &str) -> Result<Option<String>, Problem> {
    let Some(hand_in) = state.store.hand_in(id).await? else { return Ok(None) };
    let [only] = hand_in.files.as_slice() else { return Ok(None) };
    Ok(source::readable(only).map(|source| source.text))
}

/// `GET /a/{assignment}/starter`: the handed-out file; several as a ZIP.
pub(super) async fn starter(Shared(state): Shared<State>) -> Result<Response, Problem> {
    let [file] = state.assignment.files.as_slice() else {
        return download::files(&state.assignment.id, &handed_out(&state.assignment));
    };
    let headers = [(header::CONTENT_TYPE, "text/plain; charset=utf-8"), (header::CACHE_CONTROL, "no-cache")];
    Ok((headers, file.starter.clone()).into_response())
}

/// `POST /a/{assignment}/read`: the text of a file as grading reads it, for the editor. Nothing is stored.
pub(super) async fn read(Shared(state): Shared<State>, visitor: Visitor, form: Multipart) -> Result<Response, Problem> {
    let form = Form::read(form).await?;
    visitor.check_csrf(&state, &form.csrf)?;
    let hand_in = asked_for(&state, form.hand_in(&state)?).await?;
    let text = hand_in.files.first().and_then(source::readable).map(|source| source.text);
    let text = text.ok_or_else(|| Problem::internal(&"a text without a text"))?;
    let headers = [(header::CONTENT_TYPE, "text/plain; charset=utf-8"), (header::CACHE_CONTROL, "no-store")];
    Ok((headers, text).into_response())
}

/// `POST /a/{assignment}`: hands in, and goes to the report. A script gets the receipt as a part of its page.
pub(super) async fn hand_in(
    Shared(state): Shared<State>,
    frame: Frame,
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
    frame: Frame,
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
    let mut form = Form::read(form).await?;
    visitor.check_csrf(state, &form.csrf)?;
    let field = form.key.take();
    let visitor = visitor.known(state).await?;
    let hand_in = form.hand_in(state)?;
    // A page that stays open may be sent again with another text, and first to try it: those are other requests.
    let field = field.map(|field| format!("{field} {} {}", store::word(&via), hand_in.sha256()));
    let key = RequestKey::read(headers, field.as_deref(), &client)?;
    submit(state, Upload { hand_in, identity: visitor.identity, via, hints: None, key }).await
}

/// The form as it came.
#[derive(Default)]
struct Form {
    csrf: String,
    key: Option<String>,
    files: Vec<HandedInFile>,
    text: Option<String>,
    send: Option<Sent>,
}

/// Which of the two a browser without scripts hands in: its form has the text as well as the files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Sent {
    File,
    Text,
}

impl Form {
    async fn read(mut parts: Multipart) -> Result<Self, Problem> {
        let mut form = Self::default();
        while let Some(field) = parts.next_field().await.map_err(|error| unreadable(&error))? {
            match field.name().unwrap_or_default() {
                idempotency::FIELD => form.key = Some(field.text().await.map_err(|error| unreadable(&error))?),
                "csrf" => form.csrf = field.text().await.map_err(|error| unreadable(&error))?,
                "text" => form.text = Some(field.text().await.map_err(|error| unreadable(&error))?),
                "send" => {
                    form.send = match field.text().await.map_err(|error| unreadable(&error))?.as_str() {
                        "file" => Some(Sent::File),
                        "text" => Some(Sent::Text),
                        _ => None,
                    }
                }
                "file" => {
                    let name = field.file_name().unwrap_or_default().to_owned();
                    let bytes = field.bytes().await.map_err(|error| unreadable(&error))?;
                    // A browser sends a field without a name where no file is chosen.
                    if !name.is_empty() {
                        form.files.push(HandedInFile::new(name, bytes.to_vec()));
                    }
                }
                _ => {}
            }
        }
        Ok(form)
    }

    /// What is handed in: the one of files and text that the person chose, else the files, else the text, which browsers
    /// send with CRLF.
    fn hand_in(self, state: &State) -> Result<HandIn, Problem> {
        let slots = &state.assignment.files;
        let wanted = wording::wanted(slots);
        let has_files = !self.files.is_empty() && self.send != Some(Sent::Text);
        match (has_files, self.text, self.send) {
            (true, ..) => Ok(HandIn { files: self.files }),
            (false, _, Some(Sent::File)) => Err(Problem::bad_request(
                format!("No file is chosen. Go back and choose {}, or hand in the text of the editor.", wanted.en),
                format!(
                    "ファイルが選ばれていません。前のページに戻って {} を選ぶか、エディタの内容を提出してください。",
                    wanted.ja
                ),
            )),
            (false, Some(text), _) => {
                let name = slots.first().map(|slot| slot.name.clone()).unwrap_or_default();
                Ok(HandIn::of_one(name, text.replace("\r\n", "\n")))
            }
            (false, None, _) => Err(Problem::bad_request(
                format!("The form has no file and no text. Choose {}, or type in the editor.", wanted.en),
                format!("ファイルもテキストも送られていません。{} を選ぶか、エディタに入力してください。", wanted.ja),
            )),
        }
    }
}

fn unreadable(error: &axum::extract::multipart::MultipartError) -> Problem {
    match error.status() {
        StatusCode::PAYLOAD_TOO_LARGE => Problem::new(
            StatusCode::PAYLOAD_TOO_LARGE,
            "too-large",
            "The file is too large. A shader has a few kilobytes: is it the right file?",
            "ファイルが大きすぎます。シェーダは数キロバイトです。ファイルが正しいか確認してください。",
        ),
        _ => Problem::bad_request(
            "The upload arrived incomplete. Please send it again.",
            "アップロードが途中で切れました。もう一度送信してください。",
        ),
    }
}
