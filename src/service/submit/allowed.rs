//! Whether somebody may hand in now.

use super::Upload;
use crate::service::State;
use crate::service::courses::archived;
use crate::service::errors::Problem;
use crate::service::identity::{Identity, code_needed};
use crate::service::roster::not_on_roster;
use crate::service::store::{self, Audience, Via};
use axum::http::StatusCode;

pub(super) async fn may_hand_in(
    state: &State,
    assignment: &store::AssignmentSettings,
    upload: &Upload,
) -> Result<(), Problem> {
    let forbidden = |kind, en: &str, ja: &str| Err(Problem::new(StatusCode::FORBIDDEN, kind, en, ja));
    let now = state.clock.now();
    if assignment.is_archived {
        return Err(archived());
    }
    if !assignment.is_shown(now) {
        return Err(not_shown());
    }
    if assignment.opens_at.is_some_and(|opens| now < opens) {
        return forbidden("not-open", "Handing in has not begun yet.", "提出の受付はまだ始まっていません。");
    }
    let is_draft = upload.via == Via::Editor;
    if assignment.is_closed(now) && !(is_draft && assignment.practice) {
        return Err(closed());
    }
    // What somebody hands in under a number that they have not proved counts for nobody: they must learn that now.
    if !is_draft && let Some(student) = upload.identity.claimed() {
        return Err(code_needed(student));
    }
    if assignment.audience == Audience::Number && upload.identity.student().is_none() {
        return forbidden(
            "no-number",
            "Open the course link first and give your student number.",
            "先に授業のリンクを開き、学籍番号を入力してください。",
        );
    }
    // A number from before the roster counts for nobody; whoever hands in under it must learn that now.
    if !is_draft
        && let Some(student) = upload.identity.student()
        && is_stranger(state, student).await?
    {
        return Err(not_on_roster(&student.number));
    }
    if is_draft && !assignment.grades_drafts(now) {
        return forbidden(
            "no-drafts",
            "The number of attempts is limited, so nothing is graded while you type: hand in to be graded.",
            "提出回数に制限があるため、入力中の採点は行いません。提出すると採点します。",
        );
    }
    let Some(limit) = assignment.attempts.filter(|_| !is_draft) else { return Ok(()) };
    let student = upload.identity.student().map(|student| student.id.as_str());
    let made = match (upload.identity.owner_id(), student) {
        (None, None) => {
            return forbidden(
                "no-number",
                "The number of attempts is limited: hand in on the page, or say for which student.",
                "提出回数に制限があります。ページから提出するか、学生を指定してください。",
            );
        }
        (owner, student) => state.store.attempts(&assignment.id, owner.unwrap_or_default(), student).await?,
    };
    // Storing counts again, where nobody stores at the same time. Here it spares who has no attempt left the way there.
    if made >= limit { Err(no_attempt_left(limit)) } else { Ok(()) }
}

/// The answer to who has made all attempts.
pub(super) fn no_attempt_left(limit: u64) -> Problem {
    Problem::new(
        StatusCode::FORBIDDEN,
        "attempts",
        format!("All {limit} attempts are used up."),
        format!("提出できる回数 ({limit} 回) を使い切りました。"),
    )
}

/// The answer about a homework that students do not see yet.
pub fn not_shown() -> Problem {
    Problem::new(
        StatusCode::NOT_FOUND,
        "not-shown",
        "This homework is not shown yet. Your teacher says when it is.",
        "この課題はまだ公開されていません。公開日は担当教員に確認してください。",
    )
}

/// The answer after the end.
pub fn closed() -> Problem {
    Problem::new(StatusCode::FORBIDDEN, "closed", "Handing in is over.", "提出の受付は終了しました。")
}

/// Lets somebody pass who does something with what they handed in: it is theirs, they are in the class, and students see the
/// homework.
pub async fn check_own(state: &State, identity: &Identity, submission: &store::Submission) -> Result<(), Problem> {
    if !identity.has_handed_in(submission) {
        return Err(Problem::not_found());
    }
    if !state.store.assignment(&submission.assignment).await?.is_shown(state.clock.now()) {
        return Err(not_shown());
    }
    match identity.student() {
        Some(student) if is_stranger(state, student).await? => Err(not_on_roster(&student.number)),
        _ => Ok(()),
    }
}

/// Whether there is a roster, and this student is not on it.
pub async fn is_stranger(state: &State, student: &store::StudentRecord) -> Result<bool, Problem> {
    Ok(!student.is_on_roster() && state.store.has_roster().await?)
}
