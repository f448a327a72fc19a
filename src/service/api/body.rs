//! The files out of a request: parts of a form, or the whole body.

use crate::hand_in::{HandIn, HandedInFile};
use crate::service::errors::Problem;
use axum::Json;
use axum::body::Bytes;
use axum::extract::{FromRequest, Multipart, Request};
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use std::collections::HashMap;

/// Parts that a form may have, and the longest text in one, in bytes.
const MOST_PARTS: usize = 16;
const LONGEST_TEXT: usize = 4096;

/// What a request brought.
#[derive(Debug, Default)]
pub(in crate::service) struct RequestForm {
    /// The files, each with its name where it has one.
    pub files: Vec<(Option<String>, Bytes)>,
    /// The other parts.
    pub fields: HashMap<String, String>,
}

impl RequestForm {
    /// Reads a form with parts `file`, or a body that is the file.
    pub async fn read<S: Send + Sync>(request: Request, state: &S) -> Result<Self, Problem> {
        let kind =
            request.headers().get(header::CONTENT_TYPE).and_then(|value| value.to_str().ok()).unwrap_or_default();
        let kind = kind.split(';').next().unwrap_or_default().trim().to_ascii_lowercase();
        match kind.as_str() {
            "multipart/form-data" => Self::of_parts(request, state).await,
            "text/plain" | "application/octet-stream" => {
                let bytes = Bytes::from_request(request, state).await.map_err(other)?;
                Ok(Self { files: vec![(None, bytes)], ..Self::default() })
            }
            _ => Err(Problem::new(
                StatusCode::UNSUPPORTED_MEDIA_TYPE,
                "unsupported-media-type",
                "Send the file as multipart/form-data (part `file`, one for each file), or one file as the body with Content-Type: text/plain.",
                "ファイルは multipart/form-data の `file`（ファイルごとに 1 つ）として、または 1 つだけなら Content-Type: text/plain の本文として送ってください。",
            )),
        }
    }

    /// The files; `name` is that of a file without one.
    pub fn hand_in(&self, name: Option<String>) -> HandIn {
        let named = |(own, bytes): &(Option<String>, Bytes)| {
            HandedInFile::new(own.clone().or(name.clone()).unwrap_or_default(), bytes.to_vec())
        };
        HandIn { files: self.files.iter().map(named).collect() }
    }

    async fn of_parts<S: Send + Sync>(request: Request, state: &S) -> Result<Self, Problem> {
        let mut parts = Multipart::from_request(request, state).await.map_err(other)?;
        let mut form = Self::default();
        for _ in 0..=MOST_PARTS {
            let Some(part) = parts.next_field().await.map_err(other)? else {
                return if !form.files.is_empty() { Ok(form) } else { Err(no_file()) };
            };
            let name = part.name().unwrap_or_default().to_owned();
            if name == "file" {
                let name = part.file_name().map(str::to_owned);
                form.files.push((name, part.bytes().await.map_err(other)?));
                continue;
            }
            let text = part.bytes().await.map_err(other)?;
            if name.len() > LONGEST_TEXT || text.len() > LONGEST_TEXT {
                return Err(Problem::unprocessable("A part of the form is too long.", "フォームの項目が長すぎます。"));
            }
            form.fields.insert(name, String::from_utf8_lossy(&text).into_owned());
        }
        Err(Problem::unprocessable("The form has too many parts.", "フォームの項目が多すぎます。"))
    }
}

fn no_file() -> Problem {
    Problem::unprocessable("The form has no part `file`.", "フォームに `file` がありません。")
}

/// An error of the framework's in our form.
pub(in crate::service) fn other(rejection: impl IntoResponse + std::fmt::Display) -> Problem {
    let said = rejection.to_string();
    Problem::of_status(rejection.into_response().status(), &said)
}

/// An answer of which nobody keeps a copy: it is another one soon, or for one person.
pub(super) fn unkept(json: impl serde::Serialize) -> Response {
    ([(header::CACHE_CONTROL, "no-store")], Json(json)).into_response()
}
