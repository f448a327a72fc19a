//! The class as people: what each has handed in, and what of it counts.

use super::PersonStanding;
use crate::intake::Participant;
use crate::language::Text;
use crate::service::State;
use crate::service::clock::Millis;
use crate::service::counting::{Counting, counted};
use crate::service::errors::Problem;
use crate::service::store::{BatchEntry, ClassRow, StudentRecord, SubmissionState as Progress};
use std::collections::{HashMap, HashSet};

/// One person of the class.
#[derive(Clone, Debug, PartialEq)]
pub struct Person {
    /// What tells them apart: the student's id, the browser's, the batch's with the position in it, or the submission's own.
    pub key: String,
    /// Student number, or what stands for it.
    pub number: String,
    /// Name, where it is known.
    pub name: String,
    /// Everything handed in, the newest first.
    pub rows: Vec<ClassRow>,
    /// How Moodle names them, where an archive of Moodle's has them.
    pub moodle: Option<Participant>,
    /// Why an archive had nothing to grade for them, where it had not.
    pub note: Option<Text>,
    /// Whether nothing at all is known of them: a file that a program handed in for nobody.
    pub is_anonymous: bool,
    /// Which of the attempts counts.
    pub counting: Counting,
}

impl Person {
    fn new(key: String) -> Self {
        let (number, name, counting) = Default::default();
        Self { key, number, name, rows: Vec::new(), moodle: None, note: None, is_anonymous: false, counting }
    }

    /// The attempt that counts.
    pub fn counted(&self) -> Option<&ClassRow> {
        counted(&self.rows, self.counting, |row| &row.row)
    }

    /// The attempt with the most points; of equals the first.
    pub fn best(&self) -> Option<&ClassRow> {
        counted(&self.rows, Counting::Best, |row| &row.row)
    }

    /// How they stand.
    pub fn standing(&self) -> PersonStanding {
        match (self.counted().and_then(|it| it.row.verdict), self.rows.first()) {
            (Some(verdict), _) => PersonStanding::Graded(verdict),
            (None, None) if self.note.is_some() => PersonStanding::Ungraded,
            (None, None) => PersonStanding::Nothing,
            (None, Some(row)) if row.row.submission.state == Progress::Failed => PersonStanding::Failed,
            (None, Some(_)) => PersonStanding::Queued,
        }
    }

    /// Whether driver and interpreter disagree on something of theirs.
    pub fn is_disputed(&self) -> bool {
        self.rows.iter().any(|row| row.differs)
    }

    /// When they handed in last.
    pub fn latest(&self) -> Option<Millis> {
        self.rows.first().map(|row| row.row.submission.received_at)
    }
}

/// Everyone, as far as they are told apart.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct People {
    /// The class: who is on the roster; without a roster, whoever handed in as somebody.
    pub class: Vec<Person>,
    /// Files of nobody in the class: without any name, or of somebody who is not on the roster.
    pub apart: Vec<Person>,
}

impl People {
    /// Everyone of both.
    pub fn all(&self) -> impl Iterator<Item = &Person> {
        self.class.iter().chain(&self.apart)
    }
}

/// The people of the assignment.
pub async fn people(state: &State) -> Result<People, Problem> {
    let roster = state.store.roster().await?;
    let has_roster = !roster.is_empty();
    let mut gathered = Gathered::of(state).await?;
    for student in &roster {
        let StudentRecord { id, number, name, .. } = student.clone();
        gathered.add(Person { number, name, ..Person::new(id) });
    }
    let class: HashSet<String> = roster.into_iter().map(|student| student.id).collect();
    for batch in state.store.batches(&state.assignment.id).await? {
        gathered.batch(&batch.id, state.store.batch_entries(&batch.id).await?);
    }
    gathered.files(state.store.class(&state.assignment.id, None).await?);
    let (class, apart) = gathered
        .people
        .into_iter()
        .partition(|person| if has_roster { class.contains(&person.key) } else { !person.is_anonymous });
    Ok(People { class, apart })
}

/// Everyone of one archive, in its order.
pub async fn of_batch(state: &State, id: &str) -> Result<Vec<Person>, Problem> {
    let mut gathered = Gathered::of(state).await?;
    gathered.batch(id, state.store.batch_entries(id).await?);
    gathered.files(state.store.class(&state.assignment.id, Some(id)).await?);
    // Who is on the roster stands there by number and name.
    let roster: HashMap<String, StudentRecord> =
        state.store.roster().await?.into_iter().map(|student| (student.id.clone(), student)).collect();
    for person in &mut gathered.people {
        if let Some(student) = roster.get(&person.key) {
            person.number.clone_from(&student.number);
            if !student.name.is_empty() {
                person.name.clone_from(&student.name);
            }
        }
    }
    Ok(gathered.people)
}

/// People as they are found.
#[derive(Debug, Default)]
struct Gathered {
    people: Vec<Person>,
    places: HashMap<String, usize>,
    /// Keys of people by the submission that came for them in an archive.
    named: HashMap<String, String>,
    counting: Counting,
}

impl Gathered {
    async fn of(state: &State) -> Result<Self, Problem> {
        let counting = state.store.assignment(&state.assignment.id).await?.counting;
        Ok(Self { counting, ..Self::default() })
    }

    fn add(&mut self, person: Person) -> &mut Person {
        let place = *self.places.entry(person.key.clone()).or_insert(self.people.len());
        if place == self.people.len() {
            self.people.push(Person { counting: self.counting, ..person });
        }
        &mut self.people[place]
    }

    /// Everyone of an archive, with what it says of them.
    fn batch(&mut self, id: &str, entries: Vec<BatchEntry>) {
        for entry in entries {
            let BatchEntry { student, submission_id, note, student_id, position, .. } = entry;
            let key = student_id.unwrap_or_else(|| format!("{id}/{position}"));
            if let Some(submission) = submission_id {
                self.named.insert(submission, key.clone());
            }
            let person = self.add(Person { number: student.key, name: student.name, ..Person::new(key) });
            person.moodle = person.moodle.take().or(student.moodle);
            person.note = person.note.take().or(note);
        }
    }

    /// Files, the newest first.
    fn files(&mut self, rows: Vec<ClassRow>) {
        for row in rows {
            let submission = &row.row.submission;
            let key = match (&submission.student_id, self.named.get(&submission.id), &submission.owner_id) {
                (Some(student), ..) => student.clone(),
                (None, Some(key), _) => key.clone(),
                (None, None, Some(owner)) => owner.clone(),
                (None, None, None) => submission.id.clone(),
            };
            let is_anonymous = key == submission.id;
            let (number, name) = (row.number.clone().unwrap_or_default(), row.student_name.clone().unwrap_or_default());
            self.add(Person { number, name, is_anonymous, ..Person::new(key) }).rows.push(row);
        }
    }
}

#[cfg(test)]
pub(in crate::service) mod samples {
    use super::*;
    use crate::report::Hints;
    use crate::report::Verdict;
    use crate::service::store::{HistoryRow, Submission, Via};

    /// Somebody with files of (time, points of 100, mistake), in the order of time.
    pub fn person(key: &str, files: &[(Millis, f64, &str)]) -> Person {
        let row = |(at, score, mistake): &(Millis, f64, &str)| ClassRow {
            differs: false,
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
                lateness: None,
                chosen_at: None,
            },
            mistakes: mistake.split_whitespace().map(str::to_owned).collect(),
            number: Some(key.to_owned()),
            student_name: None,
        };
        let rows = files.iter().rev().map(row).collect();
        Person { number: key.to_owned(), rows, ..Person::new(key.to_owned()) }
    }
}

#[cfg(test)]
mod tests {
    use super::samples::person;
    use super::*;
    use crate::report::{Lateness, Verdict};

    #[test]
    fn the_rule_says_which_attempt_counts() {
        let late = |penalty| Some(Lateness { milliseconds: 1, penalty });
        let mut one = person("a", &[(1, 70.0, ""), (2, 80.0, ""), (3, 60.0, ""), (4, 0.0, "")]);
        // The newest stands first, and is still being graded.
        one.rows[0].row.score = None;
        let mut counts = |counting, change: &dyn Fn(&mut Vec<ClassRow>)| {
            change(&mut one.rows);
            one.counting = counting;
            one.counted().map(|it| it.row.submission.received_at)
        };
        assert_eq!(counts(Counting::Best, &|_| ()), Some(2));
        assert_eq!(counts(Counting::Best, &|rows| rows[2].row.lateness = late(10.0)), Some(1), "of equals the first");
        assert_eq!(counts(Counting::Last, &|_| ()), Some(3));
        assert_eq!(counts(Counting::Chosen, &|_| ()), Some(3), "nobody has chosen yet");
        assert_eq!(counts(Counting::Chosen, &|rows| rows[3].row.chosen_at = Some(5)), Some(1));
        assert_eq!(counts(Counting::Chosen, &|rows| rows[2].row.chosen_at = Some(6)), Some(2), "the latest choice");
        assert_eq!(counts(Counting::Last, &|_| ()), Some(3));
    }

    #[test]
    fn the_best_attempt_is_the_first_with_the_most_points() {
        let best =
            |files: &[(Millis, f64, &str)]| person("a", files).best().map(|best| best.row.submission.received_at);
        assert_eq!(best(&[(1, 50.0, ""), (2, 80.0, ""), (3, 80.0, ""), (4, 0.0, "")]), Some(2));
        assert_eq!(best(&[]), None);
        assert_eq!(person("a", &[]).standing(), PersonStanding::Nothing);
        assert_eq!(person("a", &[(1, 100.0, ""), (2, 0.0, "")]).standing(), PersonStanding::Graded(Verdict::Correct));
    }
}
