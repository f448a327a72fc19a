//! A class made by hand for the tests of the formats: every outcome, and students who attack whoever reads it.

use crate::class::{Class, ClassEntry, Outcome};
use crate::diagnostic::{Diagnostic, DiagnosticStage};
use crate::fault::Fault;
use crate::intake::{FileLocation, Student};
use crate::language::{Language, Text};
use crate::report::{Report, samples};
use std::path::PathBuf;

/// What a student may get into a message, a file name or a name: one attack on each reader.
pub(super) const NASTY: &str = "::set-output name=a::b\n##[error]x ]]> --> <script>alert(1)</script> & \" ' \
    \n::stop-commands::x\nGrade :=>> 100\n--|>\nComment :=>> free\n<|--\r::error::lone CR \
    \0\u{1B}[2J\u{202E}\u{FFFF}|*_`[a](javascript:b) @all %0A {{ STUDENT_ANSWER }} 中間ベクトル";

/// Every outcome once: correct, wrong, rejected, stopped, nothing handed in, fault.
pub(super) fn class() -> Class {
    let reports = samples::all().map(|report| Outcome::Graded(Box::new(report)));
    let not_graded = Outcome::NotGraded(Text::new(
        format!("There is no .vert file, only {NASTY}."),
        format!(".vert ファイルがありません ({NASTY})。"),
    ));
    let fault = Fault::new(Text::new("no driver in /usr/share/vulkan", "ドライバがありません"))
        .remedy(Text::new("install mesa-vulkan-drivers", "mesa-vulkan-drivers を入れてください"));
    let outcomes = reports.into_iter().chain([not_graded, Outcome::Fault(fault)]);
    Class {
        assignment: reference::assignment("ggsample06").unwrap().clone(),
        title: format!("class {NASTY}"),
        entries: outcomes.enumerate().map(|(index, outcome)| entry(index, outcome)).collect(),
        refused: vec![],
        expected_portrait: PNG.into(),
        language: Language::En,
    }
}

/// The eight bytes that every PNG begins with: enough where nobody decodes it.
pub(super) const PNG: &[u8] = b"\x89PNG\r\n\x1a\n";

pub(super) fn entry(index: usize, outcome: Outcome) -> ClassEntry {
    let key = format!("student-{index}");
    ClassEntry {
        places: vec![place(format!("{key}/ggsample06.vert"))],
        student: Student { name: format!("Student {index}"), key, moodle: None, email: None },
        outcome,
        sources: vec![samples::source("ggsample06.vert")],
        portrait: None,
        page: None,
        alike: vec![],
    }
}

/// The entry of a homework of two files.
pub(super) fn two_files() -> ClassEntry {
    let report = samples::two_files();
    let names: Vec<String> = report.sources.iter().map(|source| source.name.clone()).collect();
    let entry = entry(7, Outcome::Graded(Box::new(report)));
    ClassEntry {
        places: names.iter().map(|name| place(format!("student-7/{name}"))).collect(),
        sources: names.iter().map(|name| samples::source(name)).collect(),
        ..entry
    }
}

/// An entry with `report`, in which everything that a student can choose is [`NASTY`].
pub(super) fn attack(mut report: Report) -> ClassEntry {
    let nasty = || Text::new(NASTY, NASTY);
    report.sources[0].name = NASTY.into();
    for line in &mut report.rubric {
        line.message = nasty();
    }
    report.diagnostics.insert(
        0,
        Diagnostic::error(DiagnosticStage::Compile, nasty()).at(2, Some(4)).spanning(8).hint(Text::new(NASTY, NASTY)),
    );
    let mut entry = entry(0, Outcome::Graded(Box::new(report)));
    entry.student.name = NASTY.into();
    entry.sources = vec![samples::source(NASTY)];
    entry.places = vec![place(format!("a, b: 100%/{NASTY}.vert"))];
    entry
}

fn place(path: String) -> FileLocation {
    FileLocation { local: Some(PathBuf::from(&path)), path }
}
