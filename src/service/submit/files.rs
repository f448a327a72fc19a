//! The files of an upload: which of them are asked for, and whether they are texts.

use super::{MAX_UPLOAD, Upload, file_name, may_hand_in, too_large};
use crate::diagnostic::Diagnostic;
use crate::hand_in::{HandIn, HandedInFile};
use crate::intake::{self, HandInContent, HandInPart};
use crate::language::Text;
use crate::service::State;
use crate::service::blocking::aside;
use crate::service::errors::Problem;
use crate::service::store;
use crate::slots::Slot;
use crate::source;
use axum::http::StatusCode;

/// The files that the homework asks for, where they may be handed in at all.
pub(super) async fn checked(state: &State, upload: &Upload) -> Result<(store::AssignmentSettings, HandIn), Problem> {
    if state.is_ending() {
        return Err(Problem::new(
            StatusCode::SERVICE_UNAVAILABLE,
            "ending",
            "The service is being restarted; nothing was stored. Please try again in a minute.",
            "サービスを再起動しています。何も保存されていません。1 分ほどしてからもう一度試してください。",
        )
        .retry_after(10));
    }
    let hand_in = asked_for(state, upload.hand_in.clone()).await?;
    let assignment = state.store.assignment_for(&state.assignment.id, upload.identity.student_id()).await?;
    may_hand_in(state, &assignment, upload).await?;
    Ok((assignment, hand_in))
}

/// The files that the homework asks for among those that somebody sent, archives opened. What is missing, double or no
/// text is named; it is not stored and costs no attempt.
pub(super) async fn asked_for(state: &State, sent: HandIn) -> Result<HandIn, Problem> {
    let given = given(state, sent.files);
    let options = intake::IntakeOptions::new(&state.assignment);
    let hand_in = match aside(move || intake::one(given, &options)).await? {
        HandInContent::Files { hand_in, .. } => hand_in,
        HandInContent::Nothing(why) => return Err(unfilled(&why)),
    };
    for (file, slot) in hand_in.files.iter().zip(&state.assignment.files) {
        check_text(slot, &file.bytes).map_err(|problem| match hand_in.files.len() {
            1 => problem,
            _ => problem.about(&file.name),
        })?;
    }
    Ok(hand_in)
}

/// What there is for which slot among the files that somebody chose, archives opened, see [`intake::some`].
pub async fn for_slots(
    state: &State,
    sent: Vec<HandedInFile>,
    shown: usize,
) -> Result<impl Iterator<Item = (usize, HandedInFile)>, Problem> {
    let given = given(state, sent);
    let options = intake::IntakeOptions::new(&state.assignment);
    let placed = aside(move || intake::some(given, shown, &options)).await?.map_err(|why| unfilled(&why))?;
    Ok((0..).zip(placed).filter_map(|(slot, file)| Some((slot, file?))))
}

pub(super) fn given(state: &State, sent: Vec<HandedInFile>) -> Vec<HandInPart> {
    let named = |(index, file): (usize, HandedInFile)| {
        let name = file_name(&file.name, state.assignment.files.get(index));
        HandInPart::File { file: HandedInFile { name, ..file }, local: None }
    };
    sent.into_iter().enumerate().map(named).collect()
}

/// The answer to files of which the homework's slots cannot be filled.
pub(super) fn unfilled(why: &Text) -> Problem {
    Problem::new(
        StatusCode::UNPROCESSABLE_ENTITY,
        "files",
        format!("{} Nothing was stored.", why.en),
        format!("{}何も保存されていません。", why.ja),
    )
}

/// Whether the file for a slot can be read as text. What cannot is not stored and costs no attempt.
pub fn check_text(slot: &Slot, bytes: &[u8]) -> Result<(), Problem> {
    if bytes.is_empty() {
        return Err(Problem::unprocessable(
            "The file is empty. Save it in your text editor and choose it again.",
            "ファイルが空です。テキストエディタで保存してから、もう一度選んでください。",
        ));
    }
    if bytes.len() > MAX_UPLOAD {
        return Err(too_large());
    }
    let Some(Diagnostic { message, hint, .. }) = source::not_text(slot, bytes) else { return Ok(()) };
    let (en, ja) = hint.map(|hint| (format!("{} ", hint.en), hint.ja)).unwrap_or_default();
    Err(Problem::new(
        StatusCode::UNPROCESSABLE_ENTITY,
        "not-text",
        format!("{} {en}Nothing was stored.", message.en),
        format!("{}{ja}何も保存されていません。", message.ja),
    ))
}
