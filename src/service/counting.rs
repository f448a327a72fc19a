//! Which of somebody's hand-ins counts.

use super::State;
use super::errors::Problem;
use super::identity::Identity;
use super::store::{HistoryRow, Submission, Via};
use super::submit::{check_own, closed};
use axum::http::StatusCode;
use serde::{Deserialize, Serialize};

/// The rule by which one hand-in of several counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, utoipa::ToSchema)]
#[serde(rename_all = "lowercase")]
pub enum Counting {
    /// The one with the most points after what lateness takes off; of equals the first.
    #[default]
    Best,
    /// The last one.
    Last,
    /// The one that was chosen; the last one, until somebody chooses.
    Chosen,
}

/// The hand-in that counts, of those that are graded. They stand with the newest first; `row` is one's line of the history.
pub fn counted<T>(rows: &[T], counting: Counting, row: impl Fn(&T) -> &HistoryRow) -> Option<&T> {
    let graded = || rows.iter().filter(|it| row(it).score.is_some());
    let chosen = || graded().filter(|it| row(it).chosen_at.is_some()).max_by_key(|it| row(it).chosen_at);
    match counting {
        Counting::Best => graded().rev().reduce(|best, it| if row(it).total() > row(best).total() { it } else { best }),
        Counting::Last => graded().next(),
        Counting::Chosen => chosen().or_else(|| graded().next()),
    }
}

/// What can count of a browser's history: of a student's what has their number.
pub fn countable<'a>(rows: &'a [HistoryRow], student_id: Option<&str>) -> Vec<&'a HistoryRow> {
    rows.iter().filter(|row| student_id.is_none() || row.submission.student_id.as_deref() == student_id).collect()
}

/// Lets whoever handed it in choose that it counts, until handing in ends.
pub async fn choose_own(state: &State, identity: &Identity, submission: &Submission) -> Result<(), Problem> {
    check_own(state, identity, submission).await?;
    let settings = state.store.assignment_for(&state.assignment.id, identity.student_id()).await?;
    if settings.is_closed(state.clock.now()) {
        return Err(closed());
    }
    choose(state, submission).await
}

/// Lets a submission count, where those count that are chosen.
pub async fn choose(state: &State, submission: &Submission) -> Result<(), Problem> {
    let id = &state.assignment.id;
    if submission.assignment != *id || submission.via == Via::Editor {
        return Err(Problem::not_found());
    }
    if state.store.assignment(id).await?.counting != Counting::Chosen {
        return Err(Problem::new(
            StatusCode::CONFLICT,
            "not-chosen",
            "In this homework nobody chooses which hand-in counts; a lecturer can change that in the settings.",
            "この課題では、成績に反映する提出を選べません。教員が設定ページで変更できます。",
        ));
    }
    Ok(state.store.choose(&submission.id, state.clock.now()).await?)
}
