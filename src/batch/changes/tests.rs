//! Tests of what changed.

use super::*;
use crate::language::Language;
use crate::report::samples;

fn header(version: &str) -> JournalHeader {
    JournalHeader {
        schema: crate::batch::journal::SCHEMA.into(),
        assignment: "ggsample06".into(),
        assignment_digest: String::new(),
        ggrade: version.into(),
        seed: 1,
        hints: crate::report::Hints::default(),
        deadline: 2.0,
        adapter: "software".into(),
        language: Language::En,
        anonymous: false,
        shard: None,
    }
}

fn student(key: &str) -> Student {
    Student { key: key.into(), name: key.to_uppercase(), moodle: None, email: None }
}

fn graded(report: Report) -> Outcome {
    Outcome::Graded(Box::new(report))
}

fn changes(before: &[(&str, Outcome)], after: &[(&str, Outcome)]) -> Changes {
    let records = before.iter().map(|(key, outcome)| JournalRecord {
        student: student(key),
        path: None,
        sha256: sha256(outcome),
        outcome: outcome.clone(),
    });
    let entries = after.iter().map(|(key, outcome)| ClassEntry {
        student: student(key),
        places: Vec::new(),
        outcome: outcome.clone(),
        sources: Vec::new(),
        portrait: None,
        page: None,
        alike: Vec::new(),
    });
    let class = Class {
        assignment: reference::assignment("ggsample06").unwrap().clone(),
        title: String::new(),
        entries: entries.collect(),
        refused: Vec::new(),
        expected_portrait: Vec::new(),
        language: Language::En,
    };
    Changes::between((header("0.1.0"), records.collect()), &header("0.2.0"), &class)
}

fn keys(list: &[StudentChange]) -> Vec<&str> {
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
    assert_eq!(line.before, Some(EarnedPoints { points: 20.0, mistake: mistake.clone() }));
    assert_eq!(line.after, Some(EarnedPoints { points: 0.0, mistake }));
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
    mended.sources[0].sha256 = "another".into();
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
