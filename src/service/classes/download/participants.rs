//! Who of the class the participants of Moodle's worksheet are.

use crate::class::formats::worksheet::{ListedParticipant, listed};
use crate::intake::{Participant, Student};
use crate::service::State;
use crate::service::errors::Problem;
use crate::service::roster::Matcher;
use std::collections::HashMap;

/// The participants of a worksheet by the ids of the students that they are. They are matched to the roster as the members of an
/// archive are: by student number, by Moodle's number and by name.
pub(super) async fn participants(state: &State, sheet: &[u8]) -> Result<HashMap<String, Participant>, Problem> {
    let listed = listed(sheet).map_err(|fault| Problem::unprocessable(fault.message.en, fault.message.ja))?;
    let matcher = Matcher::new(&state.store.roster().await?);
    let entries: Vec<Student> = listed.iter().map(entry).collect();
    let found = matcher.of_batch(entries.iter().map(|entry| (entry, None)));
    let known = found.into_iter().zip(listed).filter_map(|(id, one)| Some((id?, one.participant)));
    Ok(known.collect())
}

/// A participant as an archive would have them.
fn entry(ListedParticipant { known_as, participant }: &ListedParticipant) -> Student {
    Student {
        key: participant.number.unwrap_or_default().to_string(),
        name: known_as.clone(),
        moodle: Some(Participant { name: known_as.clone(), number: participant.number }),
        email: None,
    }
}
