//! `results.jsonl`: a line for each finished entry, written as it is finished.
//!
//! The first line is the [`JournalHeader`], each other one a [`JournalRecord`]. A line is appended by one write, so that a run that is
//! killed leaves at most its last line torn, and that line counts as not written.

mod found;

pub use found::{FoundJournal, UnreadableJournal, read};

use super::shard::Shard;
use crate::class::Outcome;
use crate::class::folder::{OutputFolder, unwritable};
use crate::class::roll::GradingCandidate;
use crate::fault::Fault;
use crate::intake::Student;
use crate::language::Language;
use crate::report::Hints;
use serde::{Deserialize, Serialize};
use std::fs::{File, OpenOptions};
use std::io::{self, Write};
use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Name of the file in the output folder.
pub const NAME: &str = "results.jsonl";

/// Name and version of the format.
pub const SCHEMA: &str = "ggrade/batch/v1";

/// How much of the journal a power failure may cost. A killed process costs nothing that was written.
const SYNC_EVERY: Duration = Duration::from_secs(2);

/// What a class is graded with: two runs with the same header give the same results.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct JournalHeader {
    /// [`SCHEMA`].
    pub schema: String,
    /// Id of the assignment.
    pub assignment: String,
    /// The digest of its folder; empty where an older version of ggrade did not write it.
    #[serde(default)]
    pub assignment_digest: String,
    /// Version of ggrade.
    pub ggrade: String,
    /// Seed of the fresh probes, one for the whole class.
    pub seed: u64,
    /// How much the messages help.
    pub hints: Hints,
    /// Seconds that a grading may take.
    pub deadline: f64,
    /// What renders.
    pub adapter: String,
    /// Language of the students' pages.
    pub language: Language,
    /// Whether names are pseudonyms.
    pub anonymous: bool,
    /// Which part of the class this is; `None` for all of it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shard: Option<Shard>,
}

/// What became of one student's submission.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct JournalRecord {
    /// Who.
    pub student: Student,
    /// Where the files were; `None` where there were none.
    pub path: Option<String>,
    /// The digest of the hand-in in hexadecimal; `None` where there was none.
    pub sha256: Option<String>,
    /// What became of it, with the report in both languages.
    pub outcome: Outcome,
}

/// The same, of what belongs to others: this is what is written.
#[derive(Clone, Debug, Serialize)]
pub struct RecordOf<'a> {
    /// Who.
    pub student: &'a Student,
    /// Where the files were.
    pub path: Option<String>,
    /// The digest of the hand-in.
    pub sha256: Option<&'a str>,
    /// What became of it.
    pub outcome: &'a Outcome,
}

impl<'a> RecordOf<'a> {
    /// What is written down of a candidate.
    pub fn new(candidate: &'a GradingCandidate, outcome: &'a Outcome) -> Self {
        let GradingCandidate { hand_in, sha256, .. } = candidate;
        Self { student: &hand_in.student, path: hand_in.path(), sha256: sha256.as_deref(), outcome }
    }
}

impl JournalRecord {
    /// As it is written.
    pub fn view(&self) -> RecordOf<'_> {
        let Self { student, path, sha256, outcome } = self;
        RecordOf { student, path: path.clone(), sha256: sha256.as_deref(), outcome }
    }
}

/// A journal that is being written.
#[derive(Debug)]
pub struct Journal {
    path: PathBuf,
    file: Mutex<JournalFile>,
}

#[derive(Debug)]
struct JournalFile {
    file: File,
    synced: Instant,
}

impl Journal {
    /// A journal that has these records already, in place of the one that may be there.
    pub fn start(folder: &OutputFolder, header: &JournalHeader, records: &[RecordOf]) -> Result<Self, Fault> {
        write(folder, header, records)?;
        let path = folder.at(NAME);
        let file = OpenOptions::new().append(true).open(&path).map_err(|error| unwritable(&path, &error))?;
        Ok(Self { path, file: Mutex::new(JournalFile { file, synced: Instant::now() }) })
    }

    /// Adds what became of one submission.
    pub fn append(&self, record: &RecordOf) -> Result<(), Fault> {
        let line = line(record).map_err(|error| unwritable(&self.path, &error))?;
        let mut written = self.lock();
        let due = written.synced.elapsed() > SYNC_EVERY;
        let done = written.file.write_all(&line).and_then(|()| if due { written.file.sync_data() } else { Ok(()) });
        if due {
            written.synced = Instant::now();
        }
        done.map_err(|error| unwritable(&self.path, &error))
    }

    /// Has everything on the disk.
    pub fn sync(&self) -> Result<(), Fault> {
        self.lock().file.sync_data().map_err(|error| unwritable(&self.path, &error))
    }

    fn lock(&self) -> MutexGuard<'_, JournalFile> {
        self.file.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Writes a whole journal at once: each record once, in this order.
pub fn write(folder: &OutputFolder, header: &JournalHeader, records: &[RecordOf]) -> Result<(), Fault> {
    let failed = |error: io::Error| unwritable(&folder.at(NAME), &error);
    let mut bytes = line(header).map_err(failed)?;
    for record in records {
        bytes.extend(line(record).map_err(failed)?);
    }
    folder.write(NAME, &bytes).map(|_| ())
}

fn line(value: &impl Serialize) -> io::Result<Vec<u8>> {
    // JSON has no raw line feed in it.
    let mut line = serde_json::to_vec(value)?;
    line.push(b'\n');
    Ok(line)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::Text;
    use crate::report::samples;

    fn header() -> JournalHeader {
        JournalHeader {
            schema: SCHEMA.into(),
            assignment: "ggsample06".into(),
            assignment_digest: String::new(),
            ggrade: "0.1.0".into(),
            seed: 7,
            hints: Hints::default(),
            deadline: 2.0,
            adapter: "software".into(),
            language: Language::En,
            anonymous: false,
            shard: None,
        }
    }

    fn record(key: &str, outcome: Outcome) -> JournalRecord {
        let student = Student { key: key.into(), name: "田中\n花子".into(), moodle: None, email: None };
        JournalRecord { student, path: Some("a/b.vert".into()), sha256: Some("00".into()), outcome }
    }

    fn folder() -> (tempfile::TempDir, OutputFolder) {
        let place = tempfile::tempdir().unwrap();
        let folder = OutputFolder::open(place.path()).unwrap();
        (place, folder)
    }

    #[test]
    fn what_is_written_is_read() {
        let (_place, folder) = folder();
        let graded = samples::all().into_iter().map(|report| Outcome::Graded(Box::new(report)));
        let others = [Outcome::NotGraded(Text::verbatim("none")), Outcome::Fault(Fault::new(Text::verbatim("ours")))];
        let records: Vec<_> = graded.chain(others).zip(0..).map(|(o, n)| record(&format!("s{n}"), o)).collect();
        let journal = Journal::start(&folder, &header(), &[records[0].view()]).unwrap();
        for record in &records[1..] {
            journal.append(&record.view()).unwrap();
        }
        journal.sync().unwrap();
        let found = read(&folder.at(NAME)).unwrap();
        assert_eq!((found.header, found.records, found.torn), (header(), records, 0));
    }

    #[test]
    fn a_number_is_read_to_its_last_digit() {
        let (_place, folder) = folder();
        let mut report = samples::wrong();
        // Met in the values of a file that raises a small number to a power.
        report.elapsed_ms = 1.769_599_999_999_999_6e-40;
        let record = record("small", Outcome::Graded(Box::new(report)));
        write(&folder, &header(), &[record.view()]).unwrap();
        assert_eq!(read(&folder.at(NAME)).unwrap().records, [record]);
    }

    #[test]
    fn wherever_the_last_line_is_torn_the_others_are_read() {
        let (_place, folder) = folder();
        let [one, two] = ["one", "two"].map(|key| record(key, Outcome::NotGraded(Text::verbatim("無し"))));
        write(&folder, &header(), &[one.view(), two.view()]).unwrap();
        let whole = folder.read(NAME).unwrap().unwrap();
        let last = whole.len() - line(&two.view()).unwrap().len();
        for end in last..whole.len() {
            folder.write(NAME, &whole[..end]).unwrap();
            let found = read(&folder.at(NAME)).unwrap();
            // Without its line feed alone, the line is all there.
            let both = [one.clone(), two.clone()];
            let expected = if end + 1 == whole.len() { &both[..] } else { &both[..1] };
            assert_eq!(found.records, expected, "{end} of {}", whole.len());
        }
    }

    #[test]
    fn the_last_record_of_a_student_counts() {
        let (_place, folder) = folder();
        let records = ["1", "2", "3"].map(|text| record("same", Outcome::NotGraded(Text::verbatim(text))));
        write(&folder, &header(), &records.each_ref().map(JournalRecord::view)).unwrap();
        assert_eq!(read(&folder.at(NAME)).unwrap().records, [records[2].clone()]);
    }

    #[test]
    fn what_is_no_journal_is_named() {
        let (_place, folder) = folder();
        assert!(matches!(read(&folder.at(NAME)), Err(UnreadableJournal::Missing)));
        for text in ["", "{}\n", "{\"schema\":\"ggrade/report/v1\"}\n", "\u{1b}]0;x\n"] {
            folder.write(NAME, text.as_bytes()).unwrap();
            let Err(UnreadableJournal::Foreign(message)) = read(&folder.at(NAME)) else { panic!("{text}") };
            assert!(message.en.contains("ggrade/batch/v1") && !message.en.contains('\u{1b}'));
        }
    }
}
