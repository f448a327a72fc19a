//! What a class's grades became since an earlier grading of it: who gains, who loses, and why.

use super::journal::{JournalHeader, JournalRecord};
use crate::class::folder::OutputFolder;
use crate::class::standing::Standing;
use crate::class::{Class, ClassEntry, Outcome};
use crate::fault::Fault;
use crate::intake::Student;
use crate::language::Text;
use crate::report::{Report, RubricLine};
use serde::Serialize;
use std::collections::{HashMap, HashSet};

/// Name of the file.
pub const NAME: &str = "changes.json";

/// Name and version of the format of [`NAME`].
pub const SCHEMA: &str = "ggrade/changes/v1";

/// Points that differ by less are the same: sums of fractions of points are rounded.
const SAME_POINTS: f64 = 1e-6;

/// What changed, student by student.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Changes {
    /// [`SCHEMA`].
    pub schema: &'static str,
    /// What the earlier grading was done with.
    pub before: JournalHeader,
    /// What this one was done with.
    pub after: JournalHeader,
    /// Who has more points, the largest gain first.
    pub gains: Vec<StudentChange>,
    /// Who has fewer points, the largest loss first.
    pub losses: Vec<StudentChange>,
    /// Who has the same points for other reasons.
    pub otherwise: Vec<StudentChange>,
    /// Whom one of the gradings has no result for, by a fault of ggrade's or because there was nothing to grade.
    pub unclear: Vec<StudentChange>,
    /// How many are as they were.
    pub unchanged: usize,
    /// Who was not in the earlier grading.
    pub new: Vec<Student>,
    /// Who is not in this one.
    pub gone: Vec<Student>,
}

/// One student's change.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StudentChange {
    /// Who.
    pub student: Student,
    /// Whether another file was graded; else the same file was graded otherwise.
    pub is_new_file: bool,
    /// The earlier result.
    pub before: GradeSummary,
    /// This one.
    pub after: GradeSummary,
    /// The lines of the rubric whose points or mistakes differ, where both shaders were drawn.
    pub rubric: Vec<LineChange>,
}

/// A result in short.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct GradeSummary {
    /// What became of the file.
    pub standing: Standing,
    /// The points, where it was graded.
    pub score: Option<f64>,
    /// Ids of the mistakes.
    pub mistakes: Vec<String>,
}

/// One line of the rubric, before and after.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LineChange {
    /// Its id.
    pub id: String,
    /// The earlier points and mistake; `None` where there was no such line.
    pub before: Option<EarnedPoints>,
    /// These points and mistake.
    pub after: Option<EarnedPoints>,
}

/// What a line of the rubric earned.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct EarnedPoints {
    /// Points.
    pub points: f64,
    /// The mistake that costs the others, where it is known.
    pub mistake: Option<String>,
}

impl Changes {
    /// Holds a class against an earlier journal.
    pub fn between(before: (JournalHeader, Vec<JournalRecord>), after: &JournalHeader, class: &Class) -> Self {
        let (header, records) = before;
        let mut changes = Self {
            schema: SCHEMA,
            before: header,
            after: after.clone(),
            gains: Vec::new(),
            losses: Vec::new(),
            otherwise: Vec::new(),
            unclear: Vec::new(),
            unchanged: 0,
            new: Vec::new(),
            gone: Vec::new(),
        };
        let earlier: HashMap<&str, &JournalRecord> = records.iter().map(|r| (r.student.key.as_str(), r)).collect();
        for entry in &class.entries {
            match earlier.get(entry.student.key.as_str()) {
                Some(record) => changes.add(record, entry),
                None => changes.new.push(entry.student.clone()),
            }
        }
        let now: HashSet<&str> = class.entries.iter().map(|entry| entry.student.key.as_str()).collect();
        changes.gone = records.iter().map(|r| &r.student).filter(|s| !now.contains(s.key.as_str())).cloned().collect();
        changes.gains.sort_by(|a, b| b.difference().total_cmp(&a.difference()));
        changes.losses.sort_by(|a, b| a.difference().total_cmp(&b.difference()));
        changes
    }

    fn add(&mut self, record: &JournalRecord, entry: &ClassEntry) {
        let (before, after) = (GradeSummary::of(&record.outcome), GradeSummary::of(&entry.outcome));
        let change = StudentChange {
            student: entry.student.clone(),
            is_new_file: record.sha256 != sha256(&entry.outcome),
            rubric: if before.is_drawn() && after.is_drawn() {
                rubric(report(&record.outcome), entry.report())
            } else {
                Vec::new()
            },
            before,
            after,
        };
        let differs = change.before != change.after || !change.rubric.is_empty();
        match change.before.score.zip(change.after.score) {
            Some((before, after)) if after - before > SAME_POINTS => self.gains.push(change),
            Some((before, after)) if before - after > SAME_POINTS => self.losses.push(change),
            Some(_) if differs => self.otherwise.push(change),
            None if differs => self.unclear.push(change),
            _ => self.unchanged += 1,
        }
    }

    /// Writes [`NAME`]. Gives its name, and what it is.
    pub fn write(&self, folder: &OutputFolder) -> Result<(String, Text), Fault> {
        // Strings, numbers and lists under constant keys: there is nothing that could fail.
        let mut json = serde_json::to_vec_pretty(self).unwrap_or_default();
        json.push(b'\n');
        folder.write(NAME, &json)?;
        Ok((NAME.into(), Text::new("What changed, for programs", "前回からの変化 (プログラム用)")))
    }

    /// Whether everything is as it was.
    pub fn is_empty(&self) -> bool {
        let lists = [&self.gains, &self.losses, &self.otherwise, &self.unclear];
        lists.iter().all(|list| list.is_empty()) && self.new.is_empty() && self.gone.is_empty()
    }
}

impl StudentChange {
    /// How many points more there are.
    pub fn difference(&self) -> f64 {
        self.after.score.unwrap_or_default() - self.before.score.unwrap_or_default()
    }
}

impl GradeSummary {
    fn of(outcome: &Outcome) -> Self {
        let report = report(outcome);
        Self {
            standing: Standing::of(outcome),
            score: report.map(|report| report.score),
            mistakes: report.map(|report| report.mistakes.clone()).unwrap_or_default(),
        }
    }

    /// Whether the rubric tells something of each of its lines: the shader was drawn.
    fn is_drawn(&self) -> bool {
        matches!(self.standing, Standing::Correct | Standing::Wrong)
    }
}

fn report(outcome: &Outcome) -> Option<&Report> {
    match outcome {
        Outcome::Graded(report) => Some(report),
        _ => None,
    }
}

fn sha256(outcome: &Outcome) -> Option<String> {
    report(outcome).map(Report::sha256)
}

/// The lines that differ.
fn rubric(before: Option<&Report>, after: Option<&Report>) -> Vec<LineChange> {
    let (Some(before), Some(after)) = (before, after) else { return Vec::new() };
    let find = |report: &Report, id: &str| report.rubric.iter().find(|line| line.id == id).map(earned);
    let added = after.rubric.iter().filter(|line| before.rubric.iter().all(|other| other.id != line.id));
    let ids = before.rubric.iter().chain(added).map(|line| &line.id);
    let lines = ids.map(|id| LineChange { id: id.clone(), before: find(before, id), after: find(after, id) });
    lines.filter(LineChange::differs).collect()
}

fn earned(line: &RubricLine) -> EarnedPoints {
    EarnedPoints { points: line.points, mistake: line.mistake.clone() }
}

impl LineChange {
    fn differs(&self) -> bool {
        match (&self.before, &self.after) {
            (Some(a), Some(b)) => (a.points - b.points).abs() > SAME_POINTS || a.mistake != b.mistake,
            _ => true,
        }
    }
}

#[cfg(test)]
mod tests;
