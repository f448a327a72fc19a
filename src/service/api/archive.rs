//! An archive out of a request, onto the disk: it may be larger than memory should be.

use super::body::other;
use crate::hand_in::hexadecimal;
use crate::service::Service;
use crate::service::errors::Problem;
use crate::service::idempotency::{self, RequestKey};
use crate::service::limits::Client;
use crate::service::store::StoredKey;
use crate::source::lookalikes::is_bidi;
use axum::body::Bytes;
use axum::extract::{FromRequest, Multipart, Request};
use axum::http::{HeaderMap, StatusCode, header};
use futures_util::{Stream, StreamExt};
use sha2::{Digest, Sha256};
use std::collections::HashMap;
use tempfile::TempPath;
use tokio::io::AsyncWriteExt;

/// Parts that a form may have, and the longest text in one, in bytes.
const MOST_PARTS: usize = 16;
const LONGEST_TEXT: usize = 4096;

/// Bytes of an archive that is too large which are read all the same and dropped.
const MOST_DROPPED: u64 = 512 << 20;

/// An archive that somebody uploaded; it is removed from the disk with this.
#[derive(Debug)]
pub(in crate::service) struct UploadedArchive {
    /// Where it is.
    pub path: TempPath,
    /// Name that it came with.
    pub name: String,
    /// SHA-256 of its bytes in hexadecimal.
    pub sha256: String,
    /// The other parts of the form.
    pub fields: HashMap<String, String>,
}

impl UploadedArchive {
    /// Reads a form with a part `file`, or a body that is the archive. The route must have no limit of its own
    /// ([`axum::extract::DefaultBodyLimit::disable`]).
    pub async fn read(request: Request, service: &Service) -> Result<Self, Problem> {
        let kind =
            request.headers().get(header::CONTENT_TYPE).and_then(|value| value.to_str().ok()).unwrap_or_default();
        match kind.split(';').next().unwrap_or_default().trim().to_ascii_lowercase().as_str() {
            "multipart/form-data" => Self::of_parts(request, service).await,
            "application/zip" | "application/octet-stream" | "application/x-zip-compressed" => {
                let (path, sha256) = saved(request.into_body().into_data_stream(), broken_off, service).await?;
                Ok(Self { path, name: String::new(), sha256, fields: HashMap::new() })
            }
            _ => Err(Problem::new(
                StatusCode::UNSUPPORTED_MEDIA_TYPE,
                "unsupported-media-type",
                "Send the archive as multipart/form-data (part `file`), or as the body with Content-Type: application/zip.",
                "アーカイブは multipart/form-data の `file` として、または Content-Type: application/zip の本文として送ってください。",
            )),
        }
    }

    async fn of_parts(request: Request, service: &Service) -> Result<Self, Problem> {
        let mut parts = Multipart::from_request(request, service).await.map_err(other)?;
        let mut archive = None;
        let mut fields = HashMap::new();
        for _ in 0..=MOST_PARTS {
            let Some(mut part) = parts.next_field().await.map_err(other)? else { break };
            let name = part.name().unwrap_or_default().to_owned();
            if name == "file" {
                let title = part.file_name().unwrap_or_default().to_owned();
                archive = Some((saved(&mut part, other, service).await?, title));
                continue;
            }
            let mut text = Vec::new();
            while let Some(chunk) = part.chunk().await.map_err(other)? {
                text.extend(chunk);
                if text.len() > LONGEST_TEXT {
                    return Err(Problem::unprocessable(
                        "A part of the form is too long.",
                        "フォームの項目が長すぎます。",
                    ));
                }
            }
            fields.insert(name, String::from_utf8_lossy(&text).into_owned());
        }
        let Some(((path, sha256), name)) = archive else {
            return Err(Problem::unprocessable("The form has no part `file`.", "フォームに `file` がありません。"));
        };
        Ok(Self { path, name, sha256, fields })
    }

    /// The key with which it may come again.
    /// `assignment` is whose class it is.
    pub fn key(&self, assignment: &str, headers: &HeaderMap, client: &Client) -> Result<Option<StoredKey>, Problem> {
        let field = self.fields.get(idempotency::FIELD).map(String::as_str);
        let given = RequestKey::read(headers, field, client)?;
        Ok(given.map(|given| given.of_teacher(&[assignment, &self.title(), &self.sha256])))
    }

    /// The name as a title: the last part, without its extension, of a bearable length.
    pub fn title(&self) -> String {
        let last = self.name.rsplit(['/', '\\']).next().unwrap_or_default();
        let stem = last.strip_suffix(".zip").unwrap_or(last);
        stem.chars().filter(|c| !c.is_control() && !is_bidi(*c)).take(100).collect()
    }
}

/// Writes a stream to a temporary file, as long as it is no longer than an archive may be; where that is, and its hash.
async fn saved<E>(
    mut stream: impl Stream<Item = Result<Bytes, E>> + Unpin,
    problem: impl Fn(E) -> Problem,
    service: &Service,
) -> Result<(TempPath, String), Problem> {
    let disk = |error: std::io::Error| Problem::internal(&error);
    let (file, path) = tempfile::Builder::new().suffix(".zip").tempfile().map_err(disk)?.into_parts();
    let mut file = tokio::fs::File::from_std(file);
    let mut digest = Sha256::new();
    let mut room = service.config.archive_mib.saturating_mul(1 << 20);
    while let Some(chunk) = stream.next().await {
        let chunk = chunk.map_err(&problem)?;
        let Some(left) = room.checked_sub(chunk.len() as u64) else {
            // A browser that still sends does not read the answer: the rest is taken, as far as that is bearable.
            let mut bearable = MOST_DROPPED;
            while let Some(Ok(chunk)) = stream.next().await
                && let Some(left) = bearable.checked_sub(chunk.len() as u64)
            {
                bearable = left;
            }
            return Err(too_large(service));
        };
        room = left;
        digest.update(&chunk);
        file.write_all(&chunk).await.map_err(disk)?;
    }
    file.flush().await.map_err(disk)?;
    Ok((path, hexadecimal(&digest.finalize())))
}

fn broken_off(_: axum::Error) -> Problem {
    Problem::bad_request("The upload broke off.", "アップロードが途中で切れました。")
}

fn too_large(service: &Service) -> Problem {
    let most = service.config.archive_mib;
    Problem::new(
        StatusCode::PAYLOAD_TOO_LARGE,
        "too-large",
        format!("The archive is larger than {most} MiB. Leave out what is no shader, or upload it in parts."),
        format!("アーカイブが {most} MiB を超えています。シェーダ以外を除くか、分けてアップロードしてください。"),
    )
}
