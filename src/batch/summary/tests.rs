//! Tests of the summary.

use super::*;
use crate::class::ClassEntry;
use crate::fault::Fault;
use crate::intake::{Refused, Student};
use crate::report::samples;

fn entry(name: &str, outcome: Outcome) -> ClassEntry {
    ClassEntry {
        student: Student { key: name.into(), name: name.into(), moodle: None, email: None },
        places: Vec::new(),
        outcome,
        sources: Vec::new(),
        portrait: None,
        page: None,
        alike: Vec::new(),
    }
}

fn class(language: Language) -> Class {
    let mut outcomes: Vec<_> = samples::all().into_iter().map(|report| Outcome::Graded(Box::new(report))).collect();
    outcomes.push(Outcome::NotGraded(Text::new("No file was handed in.", "ファイルが提出されていません。")));
    outcomes.push(Outcome::Fault(Fault::new(Text::verbatim("no processor"))));
    let names = ["佐藤 花子", "b", "c", "d", "evil\u{1b}[2J\nname", "f"];
    Class {
        assignment: reference::assignment("ggsample06").unwrap().clone(),
        title: "課題6\u{202e}".into(),
        entries: names.into_iter().zip(outcomes).map(|(name, outcome)| entry(name, outcome)).collect(),
        refused: vec![Refused { path: "../\u{7}x.vert".into(), reason: Text::verbatim("leads out of the archive") }],
        expected_portrait: Vec::new(),
        language,
    }
}

fn render(language: Language, width: usize) -> String {
    let written = WrittenFiles {
        folder: "out".into(),
        files: vec![("grades.csv".into(), Text::new("A table", "表"))],
        notes: vec![Text::verbatim("a note")],
    };
    let styled = super::render(&class(language), None, &written, width);
    anstream::adapter::strip_str(&styled).to_string()
}

#[test]
fn everything_that_happened_is_told() {
    let text = render(Language::En, 80);
    for line in [
        "✓ Correct               1   17 %",
        "! Grading failed        1   17 %",
        // The samples have 100, 80, 0 and 0 points.
        "  mean 45.0 · median 40.0 · 4 graded",
        "      1  ━━━━━━━━━━━━  Half vector not normalised",
        "    No file was handed in.",
        "    no processor",
        "    leads out of the archive",
        "  grades.csv  A table",
        "a note",
    ] {
        assert!(text.contains(line), "{line:?} in\n{text}");
    }
}

#[test]
fn no_line_is_too_wide_and_none_steers_the_terminal() {
    for language in [Language::En, Language::Ja] {
        for width in [40, 64, 100] {
            let text = render(language, width);
            for line in text.lines() {
                assert!(columns(line) <= width, "{width}: {line:?}");
            }
            assert!(!text.contains(['\u{1b}', '\u{202e}', '\u{7}']));
        }
    }
}

#[test]
fn nothing_is_told_by_colour_alone() {
    // A stretch of the bar for each of the six, of its own sign.
    let text = render(Language::En, 80);
    let bar = text.lines().find(|line| line.contains('━')).unwrap();
    let mut signs: Vec<char> = bar.chars().collect();
    signs.dedup();
    assert_eq!(signs, ['━', '╌', '═', '▪', '·', '!']);
}

#[test]
fn every_count_has_a_column_and_the_bar_its_width() {
    for counts in [[1, 0, 0, 0, 0, 0], [998, 0, 0, 0, 1, 1], [1, 1, 1, 1, 1, 1], [0, 3, 0, 996, 1, 0]] {
        let bar = anstream::adapter::strip_str(&stacked(&counts, counts.iter().sum(), 60)).to_string();
        assert!((60..=62).contains(&columns(&bar)), "{counts:?}: {bar}");
        let kinds: std::collections::HashSet<char> = bar.chars().collect();
        assert_eq!(kinds.len(), counts.iter().filter(|count| **count > 0).count(), "{counts:?}: {bar}");
    }
}
