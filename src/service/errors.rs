//! Every error as `application/problem+json` (RFC 9457), or as a page for who came for a page.
//!
//! A [`Problem`] travels in its response's extensions to [`render`], the outermost layer, which knows the language and
//! the form that the client takes. Errors that other layers make (a body too long, no such method) get the same form
//! there.

use super::language::of_request;
use crate::fault::Fault;
use crate::language::{Language, Text};
use axum::body::{Body, to_bytes};
use axum::extract::Request;
use axum::http::{HeaderValue, StatusCode, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use serde::Serialize;

/// What went wrong with a request.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// HTTP status.
    pub status: StatusCode,
    /// Its name in the `type` member, such as `queue-full`.
    pub kind: &'static str,
    /// What is the matter, and what to do.
    pub detail: Text,
    /// Seconds after which it may be tried again.
    pub retry_after: Option<u64>,
    /// Position in the queue that a further upload would have.
    pub position: Option<u64>,
    /// The form that was refused, where a page shall say what stood in it.
    pub form: Option<Box<RefusedForm>>,
}

/// A form that was refused.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RefusedForm {
    /// The address of the page that it stands on.
    pub page: String,
    /// The text that was typed.
    pub typed: String,
}

/// The object that a client sees.
#[derive(Debug, Serialize, utoipa::ToSchema)]
pub struct ProblemJson {
    /// A name for this kind of problem: `urn:ggrade:problem:` and a word.
    #[serde(rename = "type")]
    pub kind: String,
    /// The status in words.
    pub title: String,
    /// HTTP status.
    pub status: u16,
    /// What is the matter, and what to do, in the language of the request.
    pub detail: String,
    /// Seconds after which to try again.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub retry_after: Option<u64>,
    /// Position in the queue that the upload would have had.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub position: Option<u64>,
}

impl Problem {
    /// A problem.
    pub fn new(status: StatusCode, kind: &'static str, en: impl Into<String>, ja: impl Into<String>) -> Self {
        Self { status, kind, detail: Text::new(en, ja), retry_after: None, position: None, form: None }
    }

    /// The same of one file among several.
    pub fn about(mut self, file: &str) -> Self {
        self.detail = Text::new(format!("{file}: {}", self.detail.en), format!("{file}: {}", self.detail.ja));
        self
    }

    /// The same of a form: its page says how to get back to `page`, and what was typed.
    pub fn of_form(self, page: &str, typed: &str) -> Self {
        let form = RefusedForm { page: page.to_owned(), typed: typed.to_owned() };
        Self { form: Some(Box::new(form)), ..self }
    }

    /// The same, to be tried again later.
    pub fn retry_after(mut self, seconds: u64) -> Self {
        self.retry_after = Some(seconds.max(1));
        self
    }

    /// There is nothing here, or nothing for this client: the two are not told apart.
    pub fn not_found() -> Self {
        Self::new(
            StatusCode::NOT_FOUND,
            "not-found",
            "There is nothing at this address. Check the link; an old report may have been removed.",
            "このアドレスには何もありません。リンクを確認してください。古いレポートは削除されていることがあります。",
        )
    }

    /// There is no homework of this id among those that are served.
    pub fn not_served(id: &str, served: &[String]) -> Self {
        let id: String = id.chars().filter(|c| !c.is_control()).take(LONGEST_ID).collect();
        let (en, ja) = listed(served);
        Self::new(
            StatusCode::NOT_FOUND,
            "not-found",
            format!("There is no homework `{id}` here. {en}"),
            format!("課題 `{id}` はこのサービスにありません。{ja}"),
        )
    }

    /// A request does not say which of several homeworks it is for.
    pub fn which_homework(served: &[String]) -> Self {
        let (en, ja) = listed(served);
        Self::unprocessable(
            format!("Which homework is it for? Say so with `assignment=NAME`. {en}"),
            format!("どの課題か分かりません。`assignment=名前` で指定してください。{ja}"),
        )
    }

    /// A teacher of one homework asks for what belongs to another one, or to the whole course.
    pub fn not_this_teachers() -> Self {
        Self::new(
            StatusCode::FORBIDDEN,
            "other-class",
            "You are logged in, or send a token, for another homework's class. Log out, and log in with the password of the \
             service or the token of this homework; a program sends a token that is good for it.",
            "別の課題の教員としてログインしているか、別の課題のトークンを使っています。一度ログアウトし、サービスのパスワードまたは\
             この課題のトークンでログインしてください。プログラムからは、この課題で使えるトークンを送ってください。",
        )
    }

    /// The request makes no sense.
    pub fn bad_request(en: impl Into<String>, ja: impl Into<String>) -> Self {
        Self::new(StatusCode::BAD_REQUEST, "bad-request", en, ja)
    }

    /// The request is understood and cannot be carried out as it stands.
    pub fn unprocessable(en: impl Into<String>, ja: impl Into<String>) -> Self {
        Self::new(StatusCode::UNPROCESSABLE_ENTITY, "unprocessable", en, ja)
    }

    /// Something of ours failed. The log says what; the client does not learn it.
    pub fn internal(error: &dyn std::fmt::Display) -> Self {
        tracing::error!(%error, "request failed");
        Self::new(
            StatusCode::INTERNAL_SERVER_ERROR,
            "internal",
            "Something failed on our side; it is no fault of yours and costs no points. Please try again later.",
            "サーバ側の障害です。あなたの誤りではなく、減点にもなりません。しばらくしてからもう一度試してください。",
        )
    }

    /// A fault of ours. What it says after its colon may quote a student's file, which the log must not.
    pub fn of_fault(fault: &Fault) -> Self {
        Self::internal(&fault.message.en.split(':').next().unwrap_or_default())
    }

    /// The object for a client.
    pub fn json(&self, language: Language) -> ProblemJson {
        ProblemJson {
            kind: format!("urn:ggrade:problem:{}", self.kind),
            title: self.status.canonical_reason().unwrap_or("Error").into(),
            status: self.status.as_u16(),
            detail: self.detail.get(language).into(),
            retry_after: self.retry_after,
            position: self.position,
        }
    }

    /// The problem that a bare status of another layer stands for.
    pub(super) fn of_status(status: StatusCode, said: &str) -> Self {
        let (kind, en, ja) = match status {
            StatusCode::NOT_FOUND => return Self::not_found(),
            StatusCode::METHOD_NOT_ALLOWED => (
                "method-not-allowed",
                "This address does not take this method; the Allow header lists those that it takes.",
                "このアドレスでは使えないメソッドです。使えるメソッドは Allow ヘッダに示しています。",
            ),
            StatusCode::PAYLOAD_TOO_LARGE => (
                "too-large",
                "The upload is too large. A shader has a few kilobytes; hand in the source file itself.",
                "アップロードが大きすぎます。シェーダは数キロバイトです。ソースファイルそのものを提出してください。",
            ),
            StatusCode::UNSUPPORTED_MEDIA_TYPE => (
                "unsupported-media-type",
                "This address does not take this Content-Type; /api/docs tells which it takes.",
                "この Content-Type は受け付けていません。受け付ける形式は /api/docs にあります。",
            ),
            StatusCode::REQUEST_TIMEOUT => (
                "timeout",
                "The request took too long to arrive or to be answered. Please try again.",
                "時間内にリクエストの受信または処理が終わりませんでした。もう一度試してください。",
            ),
            status if status.is_server_error() => return Self { status, ..Self::internal(&said) },
            _ => ("bad-request", "The request cannot be understood.", "リクエストを解釈できません。"),
        };
        let mut problem = Self::new(status, kind, en, ja);
        if kind == "bad-request" && !said.is_empty() {
            problem.detail = Text::new(format!("{en} ({said})"), format!("{ja} ({said})"));
        }
        problem
    }
}

impl IntoResponse for Problem {
    fn into_response(self) -> Response {
        let mut response = self.status.into_response();
        response.extensions_mut().insert(self);
        response
    }
}

impl From<super::store::StoreError> for Problem {
    fn from(error: super::store::StoreError) -> Self {
        tracing::error!(%error, "the database failed");
        Self::new(
            StatusCode::SERVICE_UNAVAILABLE,
            "unavailable",
            "The database does not answer at the moment; nothing was stored. Please try again in a minute.",
            "現在データベースが応答しません。何も保存されていません。1 分ほどしてからもう一度試してください。",
        )
        .retry_after(30)
    }
}

/// Longest name of a homework that is quoted, in characters.
const LONGEST_ID: usize = 64;

/// The homeworks that are served, in a sentence of each language.
fn listed(served: &[String]) -> (String, String) {
    let names = served.iter().map(|id| format!("`{id}`")).collect::<Vec<_>>().join(", ");
    (format!("The homeworks of this service: {names}."), format!("このサービスの課題: {names}。"))
}

/// Longest message of another layer that is passed on.
const LONGEST_SAID: usize = 400;

/// The outermost layer: gives every error its form.
pub async fn render(request: Request, next: Next) -> Response {
    let language = of_request(request.headers(), request.uri());
    let has_token = super::identity::bearer(request.headers()).is_some();
    let wants_page = !request.uri().path().starts_with("/api/") && accepts_html(request.headers());
    let path = request.uri().path().to_owned();
    let response = next.run(request).await;
    let status = response.status();
    if !(status.is_client_error() || status.is_server_error()) {
        return response;
    }
    let (mut parts, body) = response.into_parts();
    let problem = match parts.extensions.remove::<Problem>() {
        Some(problem) => problem,
        None if is_finished(&parts.headers) => return Response::from_parts(parts, body),
        None => Problem::of_status(status, &said(body).await),
    };
    for name in [header::CONTENT_TYPE, header::CONTENT_LENGTH] {
        parts.headers.remove(name);
    }
    if let Some(seconds) = problem.retry_after {
        parts.headers.insert(header::RETRY_AFTER, HeaderValue::from(seconds));
    }
    if problem.status == StatusCode::UNAUTHORIZED {
        parts.headers.insert(header::WWW_AUTHENTICATE, HeaderValue::from_static(challenge(has_token)));
    }
    parts.headers.insert(header::CACHE_CONTROL, HeaderValue::from_static("no-store"));
    parts.status = problem.status;
    if wants_page {
        let page = super::pages::problem(&problem, language, &path);
        return (parts.status, parts.headers, page).into_response();
    }
    parts.headers.insert(header::CONTENT_TYPE, HeaderValue::from_static("application/problem+json"));
    let json = serde_json::to_vec(&problem.json(language)).unwrap_or_default();
    Response::from_parts(parts, Body::from(json))
}

/// What a client is asked for that is not let in (RFC 6750); `has_token` says that it sent a token, which is wrong.
fn challenge(has_token: bool) -> &'static str {
    if has_token { "Bearer realm=\"ggrade\", error=\"invalid_token\"" } else { "Bearer realm=\"ggrade\"" }
}

/// Whether a handler has given the error a page of its own.
fn is_finished(headers: &axum::http::HeaderMap) -> bool {
    let kind = headers.get(header::CONTENT_TYPE).and_then(|value| value.to_str().ok()).unwrap_or_default();
    kind.starts_with("text/html") || kind.starts_with("application/problem+json")
}

fn accepts_html(headers: &axum::http::HeaderMap) -> bool {
    headers.get(header::ACCEPT).and_then(|value| value.to_str().ok()).is_some_and(|accept| accept.contains("text/html"))
}

async fn said(body: Body) -> String {
    let bytes = to_bytes(body, LONGEST_SAID).await.unwrap_or_default();
    String::from_utf8_lossy(&bytes).chars().filter(|c| !c.is_control()).collect()
}
