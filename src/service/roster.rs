//! The roster: the list of students that is the class.
//!
//! [`read`] reads the file that a teacher imports, whose columns [`heading`] tells apart, [`matching`] says who of the roster an entry of an archive is.

mod heading;
mod matching;
mod read;

pub use matching::Matcher;
pub use read::{RosterFile, read};

use super::Service;
use super::errors::Problem;
use super::store::{BatchEntry, EntryMatch, RosterLine};
use std::collections::HashSet;

/// How many students another roster changes.
#[derive(Clone, Copy, Debug, Default)]
pub struct RosterChange {
    /// Not on the one before.
    pub new: usize,
    /// On the one before, and not on this one.
    pub gone: usize,
}

/// Takes a roster in place of the last one, and matches every archive to it.
pub async fn import(service: &Service, roster: &[RosterLine]) -> Result<RosterChange, Problem> {
    let store = &service.store;
    let before: HashSet<String> = store.roster().await?.into_iter().map(|student| student.number).collect();
    store.set_roster(roster, service.clock.now()).await?;
    let stays = roster.iter().filter(|line| before.contains(&line.number)).count();
    let change = RosterChange { new: roster.len() - stays, gone: before.len() - stays };
    let matcher = Matcher::new(&store.roster().await?);
    let mut changed = Vec::new();
    for batch in store.all_batches().await? {
        let entries = store.batch_entries(&batch.id).await?;
        let found = matcher.of_batch(entries.iter().map(who));
        let differs = entries.iter().zip(found).filter(|(entry, found)| entry.student_id != *found);
        changed.extend(differs.map(|(entry, student_id)| EntryMatch {
            batch_id: batch.id.clone(),
            position: entry.position,
            student_id,
        }));
    }
    store.set_matches(&changed).await?;
    Ok(change)
}

/// What an entry says of whose it is.
fn who(entry: &BatchEntry) -> (&crate::intake::Student, Option<&str>) {
    (&entry.student, entry.path.as_deref())
}

/// The refusal of a number that is not on the roster.
pub fn not_on_roster(number: &str) -> Problem {
    Problem::new(
        axum::http::StatusCode::UNPROCESSABLE_ENTITY,
        "not-on-roster",
        format!(
            "The student number {number} is not on the class's roster. Check it for typing errors; if it is right, ask your teacher to add it. If you came from a learning platform, open the homework there again."
        ),
        format!(
            "学籍番号 {number} はこのクラスの名簿にありません。入力の誤りがないか確認し、正しい場合は担当教員に登録を依頼してください。学習プラットフォームから来た場合は、そこで課題を開き直してください。"
        ),
    )
}
