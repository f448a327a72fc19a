//! What no known mistake explains alone: the parts of the solution, changes of it, and then the text itself.

use super::search::{is_dark, is_there};
use super::{Cause, spared, with_constants, worth};
use crate::compare::COLOUR_TOLERANCE;
use crate::diagnose::constants::{self, ChangedConstant};
use crate::diagnose::inside::{self, Finding, Flaw, RepairAim, Repaired};
use crate::diagnose::listed::WrongNumbers;
use crate::diagnose::locate::{self, TracedProbes};
use crate::diagnose::{Evidence, addends, plain};
use reference::Assignment;
use reference::assignment::RubricItem;
use reference::equation::Reads;
use reference::fit::{
    Alternatives, FeatureDefect, FeatureExplanation, Fit, MOST_MISTAKES, TermJudgement, explain_derived, explain_parts,
    judge_factor, judge_features, programs_of,
};
use reference::interpreter::Operator;
use reference::mistake::{FoundMistake, Mistake};
use reference::probes::ProbeSet;

/// What else may be the cause where no single one explains everything.
pub(super) struct Others {
    /// Features that are missing or scaled, perhaps with a known mistake.
    parts: Option<FeatureExplanation>,
    /// Two known mistakes.
    pair: Option<Vec<FoundMistake>>,
    /// A derived mistake that the text does not bear out.
    doubtful: Option<Cause>,
}

/// The one mistake that nobody wrote down, or the one feature that is missing, by which all is explained.
pub(super) fn alone(
    evidence: &Evidence<'_>,
    alternatives: &Alternatives<'_>,
    samples: &[[f64; 3]],
) -> Result<Cause, Box<Others>> {
    if let Some(listed) = WrongNumbers::of(evidence) {
        return Ok(Cause::unexplained(listed.terms(evidence), Vec::new()));
    }
    let parts = match explain_parts(alternatives, samples, &is_there(evidence), COLOUR_TOLERANCE) {
        Some(parts) if parts.found.is_empty() && parts.is_missing() => {
            return Ok(unless_gated(evidence, Cause::Parts(parts)));
        }
        parts => parts,
    };
    // What a lecturer wrote down says more than that a feature is missing.
    let numbers = evidence.numbers();
    let pair = match programs_of(alternatives, samples, &numbers, &is_there(evidence), COLOUR_TOLERANCE) {
        Some(found) if found.len() == 1 => return Ok(Cause::known(found)),
        found => found,
    };
    let parts = match parts {
        Some(parts) if parts.found.is_empty() && pair.is_none() => return Ok(Cause::Parts(parts)),
        parts => parts,
    };
    // What the text itself becomes right by says more than a change of the solution that the text does not bear out.
    let alone = (!is_dark(evidence.samples)).then(|| derived(1, evidence, samples)).flatten();
    match alone {
        Some(cause) if !cause.is_contradicted(evidence) => Ok(cause),
        doubtful => Err(Box::new(Others { parts, pair, doubtful })),
    }
}

/// The cause, or the one condition by which the parts are missing, where they show elsewhere as they should.
fn unless_gated(evidence: &Evidence<'_>, cause: Cause) -> Cause {
    let Cause::Parts(parts) = &cause else { return cause };
    let lines: Vec<&RubricItem> = parts.parts.iter().map(|(line, _)| &evidence.assignment.rubric[*line]).collect();
    let shows = spared::shows_at(evidence);
    let condition =
        lines.iter().all(|line| shows(line)[0]).then(|| inside::only_change(evidence, RepairAim::Condition)).flatten();
    let lines = lines.into_iter().map(|line| line.id.clone()).collect();
    condition.map_or(cause, |condition| Cause::Repaired(vec![(lines, condition)]))
}

/// What no known mistake explains: by the features, or else each term as far as it stands alone, or shows by itself. `begun`: what
/// [`alone`] gave, where it was asked already.
pub(super) fn unexplained(
    evidence: &Evidence<'_>,
    alternatives: &Alternatives<'_>,
    samples: &[[f64; 3]],
    terms: Vec<TermJudgement>,
    begun: Option<Result<Cause, Box<Others>>>,
) -> Cause {
    let Evidence { assignment, probes, .. } = *evidence;
    let others = match begun.unwrap_or_else(|| alone(evidence, alternatives, samples)) {
        Ok(cause) if cause.is_of_several_terms(assignment) => {
            let lacking = lacking(assignment, &inside::find(evidence));
            return lacking.map_or(cause, |lacking| unless_gated(evidence, lacking));
        }
        Ok(cause) => return cause,
        Err(others) => others,
    };
    let Others { parts, pair, doubtful } = *others;
    let is_dark = is_dark(evidence.samples);
    if let Some(cause) = pair.map(Cause::known).or(parts.map(Cause::Parts)) {
        return cause;
    }
    // What one change of the text does not mend, several mistakes may explain, and then two changes.
    let several = || several(evidence, samples, is_dark);
    let mut sought = doubtful.map(Some);
    let mut beside = None;
    let (findings, repairs) = inside::account(evidence, &mut || {
        beside = beside_what_is_missing(evidence, alternatives, samples);
        beside.is_none() && sought.get_or_insert_with(several).is_none()
    });
    if let Some(cause) = beside.filter(|_| repairs.is_empty()) {
        return cause;
    }
    if repairs.is_empty()
        && let Some(cause) = sought.get_or_insert_with(several).take()
    {
        return cause;
    }
    // Several terms that are not added are several mistakes, though one change of the text adds them all. What is written over is lost,
    // and what writes over it is right.
    let is_one = |cause: &Cause| matches!(cause, Cause::Parts(own) if own.parts.len() == 1);
    let is_lost = || findings.iter().any(|finding| finding.flaw == Flaw::Overwrites);
    let is_in_a_body = matches!(&repairs[..], [only] if only.is_of_a_body());
    let lacking = lacking(assignment, &findings).filter(|_| !is_in_a_body);
    if let Some(cause) = lacking.filter(|cause| repairs.is_empty() || is_lost() || !is_one(cause)) {
        return unless_gated(evidence, cause);
    }
    let terms = match judge_factor(assignment, probes, samples, COLOUR_TOLERANCE) {
        Some(terms) => terms,
        None => {
            let terms = with_features(alternatives, samples, terms);
            spared::by_outputs(evidence, spared::beside(evidence, addends::credit(evidence, terms), &findings))
        }
    };
    let terms = spared::computed(evidence, spared::beside_holes(evidence, terms));
    let repairs = repairs.into_iter().map(|repaired| (worth::charged(assignment, &terms, &repaired), repaired));
    let repairs: Vec<(Vec<String>, Repaired)> = repairs.collect();
    if repairs.is_empty() || repairs.iter().any(|(lines, _)| lines.is_empty()) {
        let cause = sought.unwrap_or_else(several).or_else(|| made_otherwise(evidence, &terms, &findings));
        return cause.unwrap_or(Cause::unexplained(terms, findings));
    }
    Cause::Repaired(repairs)
}

/// So many parts are taken for missing, one after the other, in search of what else is wrong: some tenths of a second each.
const MOST_MISSING: usize = 2;

/// A part of which nothing is right wherever it shows, which a known mistake takes away as a whole, and the one slip of the text without
/// which all is as it is in a right answer that lacks this part.
fn beside_what_is_missing(
    evidence: &Evidence<'_>,
    alternatives: &Alternatives<'_>,
    samples: &[[f64; 3]],
) -> Option<Cause> {
    let assignment = evidence.assignment;
    if assignment.equation.reads() != Reads::Outputs {
        return None;
    }
    let terms = judge_features(alternatives, samples, COLOUR_TOLERANCE);
    let is_missing = |line: &&RubricItem| {
        terms.iter().any(|term| term.line == line.id && term.judged > 0 && 10 * term.matched <= term.judged)
    };
    let lost_by = |mistake: &Mistake| -> Vec<&RubricItem> {
        assignment.rubric.iter().filter(|line| mistake.keeps(&line.id) < 1.0).collect()
    };
    let alone = assignment.mistakes.iter().filter_map(|mistake| match lost_by(mistake)[..] {
        [line] if mistake.keeps(&line.id) == 0.0 => Some((mistake, line)),
        _ => None,
    });
    alone.filter(|(_, line)| is_missing(line)).take(MOST_MISSING).find_map(|(mistake, line)| {
        let found = [FoundMistake { id: mistake.id.clone(), form: 0, parameter: None }];
        let repaired = inside::only_change_beside(evidence, &found, RepairAim::Slip)?;
        let mut lines = worth::charged(assignment, &terms, &repaired);
        lines.retain(|own| *own != line.id);
        let missing = (vec![line.id.clone()], Repaired::of(mistake.clone()));
        (!lines.is_empty()).then(|| Cause::Repaired(vec![missing, (lines, repaired)]))
    })
}

/// The first place of a mistake, where the text computes all that the lines judge: what it makes of that is not what it should be.
fn made_otherwise(evidence: &Evidence<'_>, terms: &[TermJudgement], findings: &[Finding]) -> Option<Cause> {
    let assignment = evidence.assignment;
    let wrong: Vec<&TermJudgement> = terms.iter().filter(|term| !term.is_right()).collect();
    let first = findings.first().filter(|_| assignment.is_told_by_features() && !wrong.is_empty())?;
    let computed = inside::computed_lines(evidence);
    if !wrong.iter().all(|term| computed.contains(&term.line)) {
        return None;
    }
    let mistake = assignment.repaired(Operator::Otherwise, None, false);
    let repaired = Repaired { located: Some(first.located()), ..Repaired::of(mistake) };
    Some(Cause::Repaired(vec![(wrong.into_iter().map(|term| term.line.clone()).collect(), repaired)]))
}

/// That parts are missing: a sum at the one place of a mistake lacks terms, each of which a line judges, and is right otherwise; or
/// nothing stands where one of these terms should.
pub(super) fn lacking(assignment: &Assignment, findings: &[Finding]) -> Option<Cause> {
    let [Finding { flaw, touches, quantity, found, is_whole, .. }] = findings else { return None };
    let is_nothing = !is_whole && !found.is_empty() && found.iter().take(3).all(|number| *number == 0.0);
    let missing = match (flaw, quantity) {
        (Flaw::Lacks(_) | Flaw::Overwrites, _) => touches.as_slice(),
        (Flaw::Value, Some(term)) if is_nothing => std::slice::from_ref(term),
        _ => return None,
    };
    let judges = |name: &String| assignment.rubric.iter().position(|line| line.judges == *name);
    let lines: Vec<usize> = missing.iter().map(judges).collect::<Option<_>>()?;
    let parts: Vec<_> = lines.into_iter().map(|line| (line, FeatureDefect::Missing)).collect();
    (!parts.is_empty()).then_some(Cause::Parts(FeatureExplanation { found: Vec::new(), parts }))
}

/// The judgements; of a line with a feature it is judged where that shows.
pub(super) fn with_features(
    alternatives: &Alternatives<'_>,
    samples: &[[f64; 3]],
    mut terms: Vec<TermJudgement>,
) -> Vec<TermJudgement> {
    for feature in judge_features(alternatives, samples, COLOUR_TOLERANCE) {
        terms.retain(|term| term.line != feature.line);
        terms.push(feature);
    }
    terms
}

/// Several mistakes at once that explain the samples: three that are written down, or two of which one is derived.
fn several(evidence: &Evidence<'_>, samples: &[[f64; 3]], is_dark: bool) -> Option<Cause> {
    let Evidence { assignment, probes, sources, .. } = *evidence;
    let counts = MOST_MISTAKES..=MOST_MISTAKES;
    match plain::explained(counts, assignment, sources, probes, samples, COLOUR_TOLERANCE) {
        Fit::Explained(found) if is_borne_out(evidence, &found) => Some(Cause::known(found)),
        _ if is_dark => None,
        _ => derived(2, evidence, samples).filter(|cause| !cause.is_contradicted(evidence)),
    }
}

/// So many mistakes, one of them derived, that explain the samples, also those that nobody knows beforehand; perhaps on top of changed
/// constants.
fn derived(count: usize, evidence: &Evidence<'_>, samples: &[[f64; 3]]) -> Option<Cause> {
    let constants = constants::changed(evidence.sources.iter().copied(), evidence.assignment);
    let explained = |assignment: &Assignment, probes: &ProbeSet, constants: Vec<ChangedConstant>| {
        let found = explain_derived(count, assignment, probes, samples, &is_there(evidence), COLOUR_TOLERANCE)?;
        let is_borne_out = plain::is_borne_out(assignment, evidence.sources, &found);
        let spared = spared::by_text(evidence, &found);
        let cause = Cause::Known { constants, found, spared };
        (is_borne_out && !cause.is_refuted(evidence)).then_some(cause)
    };
    if let Some(changed) = with_constants(evidence.assignment, &constants).filter(|_| !constants.is_empty()) {
        let cause = explained(&changed, &changed.reprobe(evidence.probes), constants);
        if cause.is_some() {
            return cause;
        }
    }
    explained(evidence.assignment, evidence.probes, Vec::new())
}

/// Whether the text has a place for each of these mistakes, another one for those that touch the same lines of the rubric. So
/// many mistakes together explain much by chance.
fn is_borne_out(evidence: &Evidence<'_>, found: &[FoundMistake]) -> bool {
    let assignment = evidence.assignment;
    let mut points = TracedProbes::new(evidence, assignment);
    if points.is_none() {
        return true;
    }
    let known = locate::KnownPlaces::default();
    let mut line = |index: usize| Some(locate::mistake(evidence, assignment, &mut points, found, index, known)?.line);
    let places: Vec<_> = (0..found.len()).map(&mut line).collect();
    let clash = |a: usize, b: usize| assignment.share_a_line(&found[a], &found[b]) && places[a] == places[b];
    places.iter().all(Option::is_some) && !(0..found.len()).any(|b| (0..b).any(|a| clash(a, b)))
}
