//! The form of the student's page as a browser or a script of the page sends it.

use crate::hand_in::{HandIn, HandedInFile};
use crate::service::errors::Problem;
use crate::service::idempotency;
use crate::slots::{self, Slot, wording};
use axum::extract::Multipart;
use axum::extract::multipart::{Field, MultipartError};
use axum::http::StatusCode;

/// The form as it came.
#[derive(Default)]
pub(super) struct UploadForm {
    pub csrf: String,
    /// The key by which the service knows a form that comes twice.
    pub key: Option<String>,
    /// Files of which nobody has said for which slot they are.
    pub files: Vec<HandedInFile>,
    /// The slot whose editor is in sight, counted from 0.
    pub shown: usize,
    /// What is in the editors, in the order of the slots: a file that was chosen, or a text without a name.
    editors: Vec<HandedInFile>,
    send: Option<Sent>,
}

/// Which of the two a browser without scripts hands in: its form has the texts as well as the files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Sent {
    Files,
    Texts,
}

impl UploadForm {
    pub async fn read(mut parts: Multipart) -> Result<Self, Problem> {
        let mut form = Self::default();
        while let Some(field) = parts.next_field().await.map_err(|error| unreadable(&error))? {
            match field.name().unwrap_or_default() {
                idempotency::FIELD => form.key = Some(text(field).await?),
                "csrf" => form.csrf = text(field).await?,
                "text" => form.editors.push(content(field).await?),
                "shown" => form.shown = text(field).await?.parse().unwrap_or_default(),
                "send" => {
                    form.send = match text(field).await?.as_str() {
                        "file" => Some(Sent::Files),
                        "text" => Some(Sent::Texts),
                        _ => None,
                    }
                }
                "file" => {
                    // A browser sends a field without a name where no file is chosen.
                    let file = file(field).await?;
                    form.files.extend(Some(file).filter(|file| !file.name.is_empty()));
                }
                _ => {}
            }
        }
        Ok(form)
    }

    /// What is handed in: what the person chose of files and texts, else the files, else the texts.
    pub fn hand_in(self, slots: &[Slot]) -> Result<HandIn, Problem> {
        let wanted = wording::wanted(slots);
        let has_files = !self.files.is_empty() && self.send != Some(Sent::Texts);
        if has_files {
            return Ok(HandIn { files: self.files });
        }
        if self.send == Some(Sent::Files) {
            return Err(Problem::bad_request(
                format!("No file is chosen. Go back and choose {}, or hand in the text of the editor.", wanted.en),
                format!(
                    "ファイルが選ばれていません。前のページに戻って {} を選ぶか、エディタの内容を提出してください。",
                    wanted.ja
                ),
            ));
        }
        if self.editors.len() != slots.len() {
            return Err(Problem::bad_request(
                format!("The form has no file and no text. Choose {}, or type in the editor.", wanted.en),
                format!("ファイルもテキストも送られていません。{} を選ぶか、エディタに入力してください。", wanted.ja),
            ));
        }
        let named = |(file, slot): (HandedInFile, &Slot)| match file.name.as_str() {
            "" => HandedInFile { name: slot.name.clone(), ..file },
            _ => file,
        };
        Ok(slots::keep_order(slots, HandIn { files: self.editors.into_iter().zip(slots).map(named).collect() }))
    }
}

async fn text(field: Field<'_>) -> Result<String, Problem> {
    field.text().await.map_err(|error| unreadable(&error))
}

async fn file(field: Field<'_>) -> Result<HandedInFile, Problem> {
    let name = field.file_name().unwrap_or_default().to_owned();
    let bytes = field.bytes().await.map_err(|error| unreadable(&error))?;
    Ok(HandedInFile::new(name, bytes))
}

/// What an editor holds: a file byte by byte, or a text, which browsers send with CRLF.
async fn content(field: Field<'_>) -> Result<HandedInFile, Problem> {
    if field.file_name().is_some_and(|name| !name.is_empty()) {
        return file(field).await;
    }
    Ok(HandedInFile::new("", text(field).await?.replace("\r\n", "\n")))
}

fn unreadable(error: &MultipartError) -> Problem {
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
