//! What an answer that is wrong somewhere keeps, for its text computes that right.

use crate::diagnose::Evidence;
use crate::diagnose::inside::{self, Finding};
use reference::assignment::RubricLine;
use reference::derived::is_derived;
use reference::equation::Reads;
use reference::fit::TermJudgement;
use reference::mistake::FoundMistake;

/// The judgements; right are also the terms that no place of a mistake has to do with: with the right values in these places,
/// everything is right.
pub fn beside(evidence: &Evidence<'_>, terms: Vec<TermJudgement>, findings: &[Finding]) -> Vec<TermJudgement> {
    let assignment = evidence.assignment;
    let is_touched = |term: &TermJudgement| {
        let line = assignment.rubric.iter().find(|line| line.id == term.line);
        line.is_some_and(|line| findings.iter().any(|finding| finding.touches.contains(&line.judges)))
    };
    // Of a program of no definitions it is not known what a value has to do with. All that is seen has to do with everything.
    let is_known = assignment.equation.reads() != Reads::Outputs && !findings.iter().any(|finding| finding.is_whole);
    if !is_known || !terms.iter().any(is_touched) {
        return terms;
    }
    let judged = evidence.samples.len();
    let worst = terms.iter().find_map(|term| term.worst);
    let is_any_wrong = terms.iter().any(|term| is_touched(term) && !term.is_right());
    let spared = terms.iter().map(|term| match is_touched(term) {
        false => TermJudgement::right(&term.line, judged),
        // What is wrong may not show where the term stands alone.
        true if !is_any_wrong => {
            TermJudgement { matched: judged.saturating_sub(1), worst, ..TermJudgement::right(&term.line, judged) }
        }
        true => term.clone(),
    });
    spared.collect()
}

/// The ids of the lines that derived mistakes cost nothing, for the text computes what they judge; none where these are all.
pub fn by_text(evidence: &Evidence<'_>, found: &[FoundMistake]) -> Vec<String> {
    let assignment = evidence.assignment;
    if assignment.equation.reads() != Reads::Outputs || !found.iter().all(|found| is_derived(&found.id)) {
        return Vec::new();
    }
    let spared = inside::computed_lines(evidence);
    let costs = |line: &&RubricLine| found.iter().any(|found| assignment.keeps(found, line) < 1.0);
    let is_all = assignment.rubric.iter().filter(costs).all(|line| spared.contains(&line.id));
    if is_all { Vec::new() } else { spared }
}

/// The judgements; right are also the lines of which the text computes what they judge, unless these are all.
pub fn computed(evidence: &Evidence<'_>, terms: Vec<TermJudgement>) -> Vec<TermJudgement> {
    if evidence.assignment.equation.reads() != Reads::Outputs {
        return terms;
    }
    let lines = inside::computed_lines(evidence);
    let judged = evidence.samples.len();
    let credited = terms.iter().map(|term| match lines.contains(&term.line) {
        true => TermJudgement::right(&term.line, judged),
        false => term.clone(),
    });
    let credited: Vec<TermJudgement> = credited.collect();
    if credited.iter().all(TermJudgement::is_right) { terms } else { credited }
}
