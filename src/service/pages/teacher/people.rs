//! The class as people: what each has handed in, and the best of it.

use crate::report::Verdict;
use crate::service::State;
use crate::service::clock::Millis;
use crate::service::errors::Problem;
use crate::service::store::{ClassRow, State as Progress};
use std::collections::HashMap;

/// One person of the class.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::service::pages) struct Person {
    /// What tells them apart: the student's id, the browser's, or the submission's own.
    pub key: String,
    /// Student number, or what stands for it.
    pub number: String,
    /// Name, where it is known.
    pub name: String,
    /// Everything handed in, the newest first.
    pub rows: Vec<ClassRow>,
}

impl Person {
    /// The attempt with the most points; of equals the first.
    pub fn best(&self) -> Option<&ClassRow> {
        let graded = self.rows.iter().rev().filter(|row| row.row.score.is_some());
        graded.reduce(|best, next| if next.row.score > best.row.score { next } else { best })
    }

    /// How they stand.
    pub fn standing(&self) -> Standing {
        match (self.best().and_then(|best| best.row.verdict), self.rows.first()) {
            (Some(verdict), _) => Standing::Graded(verdict),
            (None, None) => Standing::Nothing,
            (None, Some(row)) if row.row.submission.state == Progress::Failed => Standing::Failed,
            (None, Some(_)) => Standing::Queued,
        }
    }

    /// When they handed in last.
    pub fn latest(&self) -> Option<Millis> {
        self.rows.first().map(|row| row.row.submission.received_at)
    }
}

/// How somebody stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::service::pages) enum Standing {
    /// By the verdict of the best attempt.
    Graded(Verdict),
    /// Being graded.
    Queued,
    /// Our fault.
    Failed,
    /// On the roster, and nothing handed in.
    Nothing,
}

impl Standing {
    /// Its name in an address.
    pub fn id(self) -> &'static str {
        match self {
            Self::Graded(Verdict::Correct) => "correct",
            Self::Graded(Verdict::Wrong) => "wrong",
            Self::Graded(Verdict::Rejected) => "rejected",
            Self::Graded(Verdict::Stopped) => "stopped",
            Self::Queued => "queued",
            Self::Failed => "failed",
            Self::Nothing => "nothing",
        }
    }

    /// All, from the best to the least.
    pub const ALL: [Self; 7] = [
        Self::Graded(Verdict::Correct),
        Self::Graded(Verdict::Wrong),
        Self::Graded(Verdict::Rejected),
        Self::Graded(Verdict::Stopped),
        Self::Queued,
        Self::Failed,
        Self::Nothing,
    ];
}

/// Everyone who handed in for the assignment or is on the roster; of one batch where that is given.
pub(in crate::service::pages) async fn people(state: &State, batch: Option<&str>) -> Result<Vec<Person>, Problem> {
    let assignment = &state.assignment.id;
    let rows = state.store.class(assignment, batch).await?;
    let roster = match batch {
        None => state.store.students().await?.into_iter().filter(|student| student.on_roster != 0).collect(),
        Some(_) => Vec::new(),
    };
    let mut named = HashMap::new();
    for known in state.store.batches(assignment).await? {
        if batch.is_some_and(|id| id != known.id) {
            continue;
        }
        for entry in state.store.batch_entries(&known.id).await? {
            if let Some(submission) = entry.submission_id {
                named.insert(submission, (known.id.clone(), entry.student));
            }
        }
    }
    let mut people: Vec<Person> = roster
        .into_iter()
        .map(|student| Person { key: student.id, number: student.number, name: student.name, rows: Vec::new() })
        .collect();
    let mut places: HashMap<String, usize> =
        people.iter().enumerate().map(|(index, person)| (person.key.clone(), index)).collect();
    for row in rows {
        let submission = &row.row.submission;
        let in_batch = named.get(&submission.id);
        let key = match (&submission.student_id, in_batch, &submission.owner_id) {
            (Some(student), _, _) => student.clone(),
            (None, Some((batch, student)), _) => format!("{batch}/{}", student.key),
            (None, None, Some(owner)) => owner.clone(),
            (None, None, None) => submission.id.clone(),
        };
        let place = *places.entry(key.clone()).or_insert_with(|| {
            let (number, name) = match in_batch {
                Some((_, student)) if row.number.is_none() => (student.key.clone(), student.name.clone()),
                _ => (row.number.clone().unwrap_or_default(), row.student_name.clone().unwrap_or_default()),
            };
            people.push(Person { key, number, name, rows: Vec::new() });
            people.len() - 1
        });
        people[place].rows.push(row);
    }
    Ok(people)
}

#[cfg(test)]
pub(super) mod samples {
    use super::*;
    use crate::diagnose::Hints;
    use crate::service::store::{HistoryRow, Submission, Via};

    /// Somebody with files of (time, points of 100, mistake), in the order of time.
    pub fn person(key: &str, files: &[(Millis, f64, &str)]) -> Person {
        let row = |(at, score, mistake): &(Millis, f64, &str)| ClassRow {
            row: HistoryRow {
                submission: Submission {
                    id: format!("{key}-{at}"),
                    assignment: "ggsample06".into(),
                    sha256: String::new(),
                    name: "ggsample06.vert".into(),
                    owner_id: None,
                    student_id: Some(key.to_owned()),
                    batch_id: None,
                    via: Via::Page,
                    seed: 1,
                    hints: Hints::Full,
                    received_at: *at,
                    state: Progress::Graded,
                    fault: None,
                },
                verdict: Some(if *score >= 100.0 { Verdict::Correct } else { Verdict::Wrong }),
                score: Some(*score),
                max_score: Some(100.0),
            },
            mistakes: mistake.split_whitespace().map(str::to_owned).collect(),
            number: Some(key.to_owned()),
            student_name: None,
        };
        let rows = files.iter().rev().map(row).collect();
        Person { key: key.to_owned(), number: key.to_owned(), name: String::new(), rows }
    }
}

#[cfg(test)]
mod tests {
    use super::samples::person;
    use super::*;

    #[test]
    fn the_best_attempt_is_the_first_with_the_most_points() {
        let best =
            |files: &[(Millis, f64, &str)]| person("a", files).best().map(|best| best.row.submission.received_at);
        assert_eq!(best(&[(1, 50.0, ""), (2, 80.0, ""), (3, 80.0, ""), (4, 0.0, "")]), Some(2));
        assert_eq!(best(&[]), None);
        assert_eq!(person("a", &[]).standing(), Standing::Nothing);
        assert_eq!(person("a", &[(1, 100.0, ""), (2, 0.0, "")]).standing(), Standing::Graded(Verdict::Correct));
    }
}
