//! Classes made by hand, for the tests of the formats.

use crate::class::{Class, ClassEntry, Outcome};
use crate::fault::Fault;
use crate::intake::{FileLocation, Participant, Refused, Student};
use crate::language::{Language, Text};
use crate::report::samples;

/// Names that break careless writers.
pub(super) const NASTY: [&str; 12] = [
    "山田 太郎",
    "O'Brien, \"Bob\"",
    "=cmd|' /C calc'!A0",
    "+81;=1+1",
    "@SUM(A1:A9)",
    "line\r\nbreak\u{0}\u{1b}[31m",
    "🎨👩‍🎓",
    "שלום \u{202e}gnp.exe",
    "</script><script>alert(1)</script>",
    "＝HYPERLINK(\"x\")",
    "<img src=x onerror=alert(1)>",
    "a\\\"b]]>--><!--",
];

/// A student of each outcome under each name; numbers of Moodle from 1001.
pub(super) fn class(language: Language) -> Class {
    let outcomes: Vec<Outcome> = samples::all()
        .into_iter()
        .map(|report| Outcome::Graded(Box::new(report)))
        .chain([
            Outcome::NotGraded(Text::new("Two files: `a.vert`, `b.vert`.", "`.vert` が 2 つあります。")),
            Outcome::Fault(Fault::new(Text::new("No driver.", "ドライバがありません。"))),
        ])
        .collect();
    let entries = NASTY.iter().enumerate().map(|(index, name)| {
        let number = 1001 + index as u64;
        let outcome = outcomes[index % outcomes.len()].clone();
        ClassEntry {
            student: Student {
                key: format!("s{number}"),
                name: (*name).to_owned(),
                moodle: Some(Participant { name: (*name).to_owned(), number: Some(number) }),
                email: None,
            },
            places: vec![FileLocation {
                path: format!("class.zip/{name}_{number}_assignsubmission_file/ggsample06.vert"),
                local: None,
            }],
            sources: vec![samples::source("ggsample06.vert")],
            portrait: None,
            page: None,
            alike: vec![],
            outcome,
        }
    });
    Class {
        assignment: reference::assignment("ggsample06").unwrap().clone(),
        title: "class.zip".into(),
        entries: entries.collect(),
        refused: vec![Refused {
            path: "class.zip/../../etc/<b>passwd".into(),
            reason: Text::new("It leads out of the archive.", "書庫の外を指しています。"),
        }],
        expected_portrait: vec![],
        language,
    }
}
