//! What a class's grades became since an earlier grading of it: who gains, who loses, and why.

use super::class::{Class, Entry, Outcome, Student};
use super::journal::{Header, Record};
use crate::report::{Report, RubricLine, Verdict};
use serde::Serialize;
use std::collections::{HashMap, HashSet};

/// Name and version of the format of `changes.json`.
pub const SCHEMA: &str = "ggrade/changes/v1";

/// Points that differ by less are the same: sums of fractions of points are rounded.
const SAME_POINTS: f64 = 1e-6;

/// What changed, student by student.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Changes {
    /// [`SCHEMA`].
    pub schema: &'static str,
    /// What the earlier grading was done with.
    pub before: Header,
    /// What this one was done with.
    pub after: Header,
    /// Who has more points, the largest gain first.
    pub gains: Vec<Change>,
    /// Who has fewer points, the largest loss first.
    pub losses: Vec<Change>,
    /// Who has the same points for other reasons.
    pub otherwise: Vec<Change>,
    /// Whom one of the gradings has no result for, by a fault of ggrade's or because there was nothing to grade.
    pub unclear: Vec<Change>,
    /// How many are as they were.
    pub unchanged: usize,
    /// Who was not in the earlier grading.
    pub new: Vec<Student>,
    /// Who is not in this one.
    pub gone: Vec<Student>,
}

/// One student's change.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Change {
    /// Who.
    pub student: Student,
    /// Whether another file was graded; else the same file was graded otherwise.
    pub is_new_file: bool,
    /// The earlier result.
    pub before: Standing,
    /// This one.
    pub after: Standing,
    /// The lines of the rubric whose points or mistakes differ.
    pub rubric: Vec<LineChange>,
}

/// A result in short.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Standing {
    /// `graded`, `not_graded` or `fault`.
    pub outcome: &'static str,
    /// The verdict, where it was graded.
    pub verdict: Option<Verdict>,
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
    /// The earlier points and mistake; none where there was no such line.
    pub before: Option<Earned>,
    /// These points and mistake.
    pub after: Option<Earned>,
}

/// What a line of the rubric earned.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Earned {
    /// Points.
    pub points: f64,
    /// The mistake that costs the others, where it is known.
    pub mistake: Option<String>,
}

impl Changes {
    /// Holds a class against an earlier journal.
    pub fn between(before: (Header, Vec<Record>), after: &Header, class: &Class) -> Self {
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
        let earlier: HashMap<&str, &Record> = records.iter().map(|r| (r.student.key.as_str(), r)).collect();
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

    fn add(&mut self, record: &Record, entry: &Entry) {
        let change = Change {
            student: entry.student.clone(),
            is_new_file: record.sha256.as_deref() != sha256(&entry.outcome),
            before: Standing::of(&record.outcome),
            after: Standing::of(&entry.outcome),
            rubric: rubric(report(&record.outcome), entry.report()),
        };
        let differs = change.before != change.after || !change.rubric.is_empty();
        match change.before.score.zip(change.after.score) {
            Some((before, after)) if after - before > SAME_POINTS => self.gains.push(change),
            Some((before, after)) if before - after > SAME_POINTS => self.losses.push(change),
            Some(_) if differs => self.otherwise.push(change),
            None if change.before.outcome != change.after.outcome => self.unclear.push(change),
            _ => self.unchanged += 1,
        }
    }

    /// Whether everything is as it was.
    pub fn is_empty(&self) -> bool {
        let lists = [&self.gains, &self.losses, &self.otherwise, &self.unclear];
        lists.iter().all(|list| list.is_empty()) && self.new.is_empty() && self.gone.is_empty()
    }
}

impl Change {
    /// How many points more there are.
    pub fn difference(&self) -> f64 {
        self.after.score.unwrap_or_default() - self.before.score.unwrap_or_default()
    }
}

impl Standing {
    fn of(outcome: &Outcome) -> Self {
        let without = |outcome| Self { outcome, verdict: None, score: None, mistakes: Vec::new() };
        match outcome {
            Outcome::Graded(report) => Self {
                outcome: "graded",
                verdict: Some(report.verdict),
                score: Some(report.score),
                mistakes: report.mistakes.clone(),
            },
            Outcome::NotGraded(_) => without("not_graded"),
            Outcome::Fault(_) => without("fault"),
        }
    }
}

fn report(outcome: &Outcome) -> Option<&Report> {
    match outcome {
        Outcome::Graded(report) => Some(report),
        _ => None,
    }
}

fn sha256(outcome: &Outcome) -> Option<&str> {
    report(outcome).map(|report| report.source.sha256.as_str())
}

/// The lines that differ; none where one of the sides has no rubric, since then nothing is known of the lines.
fn rubric(before: Option<&Report>, after: Option<&Report>) -> Vec<LineChange> {
    let (Some(before), Some(after)) = (before, after) else { return Vec::new() };
    let find = |report: &Report, id: &str| report.rubric.iter().find(|line| line.id == id).map(earned);
    let added = after.rubric.iter().filter(|line| before.rubric.iter().all(|other| other.id != line.id));
    let ids = before.rubric.iter().chain(added).map(|line| &line.id);
    let lines = ids.map(|id| LineChange { id: id.clone(), before: find(before, id), after: find(after, id) });
    lines.filter(LineChange::differs).collect()
}

fn earned(line: &RubricLine) -> Earned {
    Earned { points: line.points, mistake: line.mistake.clone() }
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
mod tests {
    use super::*;
    use crate::fault::Fault;
    use crate::language::{Language, Text};
    use crate::report::samples;

    fn header(version: &str) -> Header {
        Header {
            schema: super::super::journal::SCHEMA.into(),
            assignment: "ggsample06".into(),
            ggrade: version.into(),
            seed: 1,
            hints: crate::diagnose::Hints::default(),
            deadline: 2.0,
            adapter: "software".into(),
            language: Language::En,
            anonymous: false,
        }
    }

    fn student(key: &str) -> Student {
        Student { key: key.into(), name: key.to_uppercase(), moodle: None }
    }

    fn graded(report: Report) -> Outcome {
        Outcome::Graded(Box::new(report))
    }

    fn changes(before: &[(&str, Outcome)], after: &[(&str, Outcome)]) -> Changes {
        let records = before.iter().map(|(key, outcome)| Record {
            student: student(key),
            path: None,
            sha256: sha256(outcome).map(str::to_owned),
            outcome: outcome.clone(),
        });
        let entries = after.iter().map(|(key, outcome)| Entry {
            student: student(key),
            path: None,
            local: None,
            outcome: outcome.clone(),
            source: None,
            portrait: None,
            page: None,
            shares_with: Vec::new(),
        });
        let class = Class {
            assignment: "ggsample06".into(),
            title: String::new(),
            entries: entries.collect(),
            refused: Vec::new(),
            expected_portrait: Vec::new(),
            language: Language::En,
        };
        Changes::between((header("0.1.0"), records.collect()), &header("0.2.0"), &class)
    }

    fn keys(list: &[Change]) -> Vec<&str> {
        list.iter().map(|change| change.student.key.as_str()).collect()
    }

    /// The sample with 80 points, of which the line `specular` lacks 20.
    fn wrong(specular: f64) -> Report {
        let mut report = samples::wrong();
        report.score += specular - report.rubric[3].points;
        report.rubric[3].points = specular;
        report
    }

    #[test]
    fn gains_and_losses_are_told_line_by_line() {
        let before = [("a", graded(wrong(20.0))), ("b", graded(wrong(20.0))), ("c", graded(wrong(20.0)))];
        let after = [("a", graded(wrong(25.0))), ("b", graded(wrong(0.0))), ("c", graded(wrong(40.0)))];
        let changes = changes(&before, &after);
        assert_eq!((keys(&changes.gains), keys(&changes.losses)), (vec!["c", "a"], vec!["b"]));
        assert_eq!((changes.gains[1].difference(), changes.losses[0].difference()), (5.0, -20.0));
        assert!(!changes.gains[0].is_new_file);
        let [line] = changes.losses[0].rubric.as_slice() else { panic!("one line differs") };
        let mistake = Some("specular-half-unnormalized".to_owned());
        assert_eq!(line.before, Some(Earned { points: 20.0, mistake: mistake.clone() }));
        assert_eq!(line.after, Some(Earned { points: 0.0, mistake }));
    }

    #[test]
    fn the_same_points_for_another_mistake_are_told() {
        let mut other = wrong(20.0);
        other.mistakes = vec!["specular-phong".into()];
        other.rubric[3].mistake = Some("specular-phong".into());
        let changes = changes(
            &[("a", graded(wrong(20.0))), ("b", graded(wrong(20.0)))],
            &[("a", graded(other)), ("b", graded(wrong(20.0)))],
        );
        assert_eq!((keys(&changes.otherwise), changes.unchanged), (vec!["a"], 1));
        assert!(changes.gains.is_empty() && changes.losses.is_empty());
    }

    #[test]
    fn another_file_is_told_apart_from_another_judgement() {
        let mut mended = wrong(40.0);
        mended.source.sha256 = "another".into();
        assert!(changes(&[("a", graded(wrong(20.0)))], &[("a", graded(mended))]).gains[0].is_new_file);
    }

    #[test]
    fn a_fault_is_no_loss() {
        let fault = || Outcome::Fault(Fault::new(Text::verbatim("ours")));
        let none = || Outcome::NotGraded(Text::verbatim("no file"));
        let before = [("a", graded(wrong(20.0))), ("b", fault()), ("c", none())];
        let changes = changes(&before, &[("a", fault()), ("b", graded(wrong(20.0))), ("c", none())]);
        assert_eq!((keys(&changes.unclear), changes.unchanged), (vec!["a", "b"], 1));
    }

    #[test]
    fn who_comes_and_who_goes_is_named() {
        let changes = changes(&[("a", graded(wrong(20.0)))], &[("b", graded(wrong(20.0)))]);
        assert_eq!((&changes.new[0].key, &changes.gone[0].key), (&"b".to_owned(), &"a".to_owned()));
        assert!(!changes.is_empty());
    }
}
