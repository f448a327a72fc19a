//! Reports of files that were not rendered to the end.

use crate::diagnose::Hints;
use crate::diagnostic::Diagnostic;
use crate::language::Text;
use crate::report::{Environment, ProbeResult, Report, RubricLine, SourceInfo, Verdict};
use crate::source::{self, Facts};
use reference::Assignment;

/// The report of a file that was not rendered to the end: no points, and the diagnostics say why.
pub fn unfinished(
    assignment: &Assignment,
    source: SourceInfo,
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
            line: None,
        })
        .collect();
    Report {
        assignment: assignment.id.clone(),
        source,
        verdict,
        score: 0.0,
        max_score: assignment.max_score(),
        rubric,
        mistakes: Vec::new(),
        advice: Vec::new(),
        explanation: None,
        diagnostics,
        frames: Vec::new(),
        probes: ProbeResult::default(),
        cross_check: None,
        environment,
        hints: Hints::default(),
        elapsed_ms: 0.0,
    }
}

/// What is known of a file without reading it as text.
pub fn source_info(name: &str, bytes: &[u8]) -> SourceInfo {
    match source::read(name, bytes) {
        Ok(source) => info(&source.facts),
        Err(refusal) => info(&refusal.facts),
    }
}

pub(super) fn info(facts: &Facts) -> SourceInfo {
    SourceInfo {
        name: facts.name.clone(),
        sha256: facts.sha256.clone(),
        bytes: facts.bytes,
        encoding: facts.encoding.map_or_else(|| "binary".into(), |encoding| encoding.label().to_owned()),
    }
}
