//! Reports of hand-ins that were not rendered to the end.

use crate::diagnostic::Diagnostic;
use crate::hand_in::{HandIn, HandedInFile};
use crate::language::Text;
use crate::report::{Environment, Hints, ProbeResult, Report, RubricLine, SourceInfo, Verdict};
use crate::slots::{self, Trust};
use crate::source;
use reference::Assignment;
use reference::interpreter::Stage;

/// The report of a hand-in that was not rendered to the end: no points, and the diagnostics say why.
pub fn unfinished(
    assignment: &Assignment,
    sources: Vec<SourceInfo>,
    verdict: Verdict,
    diagnostics: Vec<Diagnostic>,
    environment: Environment,
) -> Report {
    let message = match verdict {
        Verdict::Stopped => Text::new("not judged: the shader was stopped", "処理が打ち切られたため、採点していません"),
        _ => Text::new("not judged: the file was rejected", "ファイルを受け付けられなかったため、採点していません"),
    };
    let rubric = assignment
        .rubric
        .iter()
        .map(|line| RubricLine {
            id: line.id.clone(),
            label: Text::new(&line.label.en, &line.label.ja),
            points: 0.0,
            max_points: line.points,
            mistake: None,
            message: message.clone(),
            file: None,
            line: None,
            graded: None,
        })
        .collect();
    Report {
        assignment: assignment.id.clone(),
        assignment_digest: assignment.digest.clone(),
        sources,
        verdict,
        score: 0.0,
        max_score: assignment.max_score(),
        rubric,
        mistakes: Vec::new(),
        advice: Vec::new(),
        repairs: Vec::new(),
        explanation: None,
        diagnostics,
        frames: Vec::new(),
        probes: ProbeResult::default(),
        map_lookup: None,
        own_values: None,
        cross_check: None,
        environment,
        hints: Hints::default(),
        elapsed_ms: 0.0,
        lateness: None,
        comments: Vec::new(),
    }
}

/// What is known of the files of a hand-in: those that the assignment asks for, in its order; or else all of them.
pub fn sources(assignment: &Assignment, hand_in: &HandIn) -> Vec<SourceInfo> {
    described(assignment, hand_in, slots::arrange(&assignment.files, hand_in, Trust::Named).as_ref().ok())
}

/// The same where it is known how the files are arranged, if they can be.
pub(super) fn described(assignment: &Assignment, hand_in: &HandIn, arranged: Option<&HandIn>) -> Vec<SourceInfo> {
    match arranged {
        Some(arranged) => {
            let files = arranged.files.iter().zip(&assignment.files);
            files.map(|(file, slot)| info(file, Some(slot.stage))).collect()
        }
        None => hand_in.files.iter().map(|file| info(file, None)).collect(),
    }
}

fn info(file: &HandedInFile, stage: Option<Stage>) -> SourceInfo {
    SourceInfo {
        name: file.name.clone(),
        stage,
        sha256: file.sha256(),
        bytes: file.bytes.len(),
        encoding: source::encoding(&file.bytes).map_or_else(|| "binary".into(), |encoding| encoding.label().to_owned()),
    }
}
