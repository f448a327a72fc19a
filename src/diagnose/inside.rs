//! Where in the student's own text a mistake stands.
//!
//! The interpreter of `reference` runs the student's text and the right answer at some of the probes, and keeps every value of
//! every expression. What the right answer computes on its way are the right quantities. From the output one walks back to what
//! it is made of, as far as that is not right yet. Where one of these values is replaced by a right quantity, and everything
//! that is seen becomes right by that, there the mistake stands. A value that is right whatever it is called, is never accused.

mod abrupt;
mod additive;
mod around;
mod blame;
mod candidates;
mod chain;
mod features;
mod finding;
mod given;
mod influence;
mod interpolated;
mod own_values;
mod quantities;
mod recording;
mod repair;
mod search;
mod walk;
mod words;

use super::Evidence;
use super::columns::is_colour;
use super::locate::{Located, MistakeOrigin, is_handed_out};
use super::trials::{FUEL_OF_TRACE, Trials};
use crate::compare::POSITION_TOLERANCE;
pub(super) use abrupt::decision;
pub(super) use given::{absent_lines, ignores_all, looks_up};
use glam::DVec3;
pub(super) use own_values::own_values;
use quantities::Quantities;
pub use recording::Recorded;
use recording::Recording;
use reference::Assignment;
use reference::interpreter::trace::{Site, Trace, What};
use reference::interpreter::{Binary, Stage};
use reference::mistake::FoundMistake;
use reference::traced::{Place, Seen, TracedProgram};
pub(super) use repair::{RepairAim, Repaired};
use search::{Search, is_right};
pub(super) use walk::made_of;
pub(super) use words::{left_behind, overwrites};

/// Where a mistake stands.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Finding {
    /// The stage whose text it is.
    pub stage: Stage,
    /// The line, from 1.
    pub line: u32,
    /// The variable that is given the value, or read.
    pub name: Option<String>,
    /// What the value stands for: a definition of the right answer, where it has a name.
    pub quantity: Option<String>,
    /// The first definition of the right answer that the value is, or that is computed from it.
    pub serves: Option<String>,
    /// Whether the value is right by itself, and used where another one belongs.
    pub is_use: bool,
    /// The variables of the right answer that it is computed from, it is, and that are computed from it.
    pub touches: Vec<String>,
    /// Whether all that it is computed from is right.
    pub is_settled: bool,
    /// Whether it is all that is seen, which can always be mended.
    pub is_whole: bool,
    /// Whether the mistake stands there: it is not only what is seen of it, nor where a variable only begins.
    pub is_telling: bool,
    /// Whether it moves the position.
    pub touches_position: bool,
    /// What is wrong with it.
    pub flaw: Flaw,
    /// The ids of the lines of the rubric within whose features it is, where that is known.
    pub features: Vec<String>,
    /// What it should be, and what it is, at a place that shows it.
    pub expected: Vec<f64>,
    pub found: Vec<f64>,
}

/// What is wrong with a value.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Flaw {
    /// It is not what it should be.
    Value,
    /// A sum lacks these of its addends, by the names of their definitions.
    Lacks(Vec<String>),
    /// It writes over what belongs to a sum.
    Overwrites,
    /// What should become of it is computed and thrown away.
    ThrownAway,
    /// It decides the wrong way.
    Condition,
    /// It is declared to be interpolated in another way than it should be.
    Interpolation,
}

/// Looks for the places that have to be mended for what is seen to be right.
pub(super) fn find(evidence: &Evidence<'_>) -> Vec<Finding> {
    let Some(recording) = evidence.recorded.of(evidence) else { return Vec::new() };
    recording.findings.get_or_init(|| find_in(evidence, evidence.assignment)).clone()
}

/// The same where a right answer is the one with these mistakes in it.
pub(super) fn find_beside(evidence: &Evidence<'_>, others: &[FoundMistake]) -> Vec<Finding> {
    if others.is_empty() {
        return find(evidence);
    }
    within(evidence, evidence.assignment, others, &[], |search| search.findings()).unwrap_or_default()
}

/// The same in the homework with other constants.
pub(super) fn find_in(evidence: &Evidence<'_>, assignment: &Assignment) -> Vec<Finding> {
    within(evidence, assignment, &[], &[], |search| search.findings()).unwrap_or_default()
}

/// The same, and the changes of the text by which all becomes right, where there are such. `goes_on`: whether several are looked for,
/// where one is not enough.
pub(super) fn account(evidence: &Evidence<'_>, goes_on: &mut dyn FnMut() -> bool) -> (Vec<Finding>, Vec<Repaired>) {
    let findings = find(evidence);
    let repairs = within(evidence, evidence.assignment, &[], &[], |search| search.repairs(&findings, goes_on))
        .unwrap_or_default();
    (findings, repairs)
}

/// The places that have to be mended, and the one slip of the text without which all is right, where there is one.
pub(super) fn slip(evidence: &Evidence<'_>) -> (Vec<Finding>, Option<Located>) {
    slip_beside(evidence, &[])
}

/// The same where a right answer is the one with these mistakes in it.
fn slip_beside(evidence: &Evidence<'_>, others: &[FoundMistake]) -> (Vec<Finding>, Option<Located>) {
    let both = |search: &mut Search<'_, '_>| {
        let findings = search.places();
        // What is thrown away, written over or declared is a slip of its own.
        let is_its_own =
            |first: &Finding| matches!(first.flaw, Flaw::ThrownAway | Flaw::Overwrites | Flaw::Interpolation);
        let is_value = !findings.first().is_some_and(is_its_own);
        let slip = if is_value { search.slip(&findings) } else { None };
        (findings, slip)
    };
    within(evidence, evidence.assignment, others, &[], both).unwrap_or_default()
}

/// The slip of the text that is one of the mistakes that were found, where there is one.
pub(super) fn slip_of(evidence: &Evidence<'_>, found: &[FoundMistake], index: usize) -> Option<Located> {
    slip_beside(evidence, &others(found, index)).1
}

/// The one change of a kind by which all is right.
pub(super) fn only_change(evidence: &Evidence<'_>, aim: RepairAim) -> Option<Repaired> {
    only_change_beside(evidence, &[], aim)
}

/// The same where a right answer is the one with these mistakes in it.
pub(super) fn only_change_beside(evidence: &Evidence<'_>, others: &[FoundMistake], aim: RepairAim) -> Option<Repaired> {
    within(evidence, evidence.assignment, others, &[], |search| search.only(&[], aim))?
}

/// Looks for the place of one of the mistakes that were found: where a right answer is the one with the others in it.
pub(super) fn find_one(
    evidence: &Evidence<'_>,
    assignment: &Assignment,
    found: &[FoundMistake],
    index: usize,
) -> Option<Finding> {
    let findings = within(evidence, assignment, &others(found, index), &[], |search| search.findings())?;
    // A mistake may be made in two places: each is one that is to be mended.
    findings.into_iter().next()
}

/// The others of the mistakes that were found.
pub(super) fn others(found: &[FoundMistake], index: usize) -> Vec<FoundMistake> {
    found.iter().enumerate().filter(|(at, _)| *at != index).map(|(_, other)| other.clone()).collect()
}

/// Whether the text computes what the right answer computes by this name, on the way of what is seen.
pub(super) fn computes(evidence: &Evidence<'_>, definition: &str) -> bool {
    within(evidence, evidence.assignment, &[], &[], |search| search.computes(definition)).unwrap_or_default()
}

/// The ids of the rubric's lines of which the text computes the very value that they judge, on the way of what is seen.
pub(super) fn computed_lines(evidence: &Evidence<'_>) -> Vec<String> {
    within(evidence, evidence.assignment, &[], &[], |search| search.computed_lines()).unwrap_or_default()
}

/// The ids of the lines whose terms the text has as a right answer has them, whatever else is seen.
pub(super) fn right_terms(evidence: &Evidence<'_>) -> Vec<String> {
    within(evidence, evidence.assignment, &[], &[], |search| search.right_terms()).unwrap_or_default()
}

/// The ids of those of which it computes the value of some turns of a loop, and not of all.
pub(super) fn lines_of_some_turns(evidence: &Evidence<'_>) -> Vec<String> {
    within(evidence, evidence.assignment, &[], &[], |search| search.lines_of_some_turns()).unwrap_or_default()
}

/// The ids of those of which the text also adds that value to what is seen as it is.
pub(super) fn added_lines(evidence: &Evidence<'_>) -> Vec<String> {
    within(evidence, evidence.assignment, &[], &[], |search| search.added_lines()).unwrap_or_default()
}

/// The ids of the lines of the rubric within whose features all places of mistakes are.
pub(super) fn features_of_all(evidence: &Evidence<'_>) -> Vec<String> {
    let mut features = find(evidence).into_iter().map(|finding| finding.features);
    let first = features.next().unwrap_or_default();
    if features.all(|other| other == first) { first } else { Vec::new() }
}

/// The one place that all is mended at, where these are such a place.
pub(super) fn only(findings: Vec<Finding>) -> Option<Finding> {
    match <[Finding; 1]>::try_from(findings) {
        Ok([finding]) if finding.is_settled && !finding.is_whole => Some(finding),
        _ => None,
    }
}

impl Finding {
    /// The place as others name it.
    pub fn located(&self) -> Located {
        Located { line: self.line, name: self.name.clone(), role: MistakeOrigin::Wrong, stage: Some(self.stage) }
    }
}

/// The variable that the value of a site is given to, or read from as it is.
pub(super) fn variable(sites: &[Site], site: usize) -> Option<String> {
    match &sites[site].what {
        What::Assign { name, .. } | What::Read(name) => return Some(name.clone()),
        _ => {}
    }
    let user = sites.iter().position(|other| other.operands.contains(&site))?;
    match &sites[user].what {
        What::Assign { name, .. } => Some(name.clone()),
        What::Unary | What::Part => variable(sites, user),
        _ => None,
    }
}

/// Looks into the text by `look`, at some of the probes and at these places after them; what it finds where nothing is wrong there, is
/// nothing. `others`: mistakes that a right answer has, as far as `look` is concerned.
fn within<T: Default>(
    evidence: &Evidence<'_>,
    assignment: &Assignment,
    others: &[FoundMistake],
    more: &[Place<'_>],
    look: impl FnOnce(&mut Search<'_, '_>) -> T,
) -> Option<T> {
    let theirs = evidence.traced?;
    let own;
    let is_usual = others.is_empty() && more.is_empty() && std::ptr::eq(assignment, evidence.assignment);
    let recording = match is_usual {
        true => evidence.recorded.of(evidence)?,
        false => {
            own = Recording::of(evidence, assignment, others, more)?;
            &own
        }
    };
    if is_right(&recording.wanted, &recording.own, recording.own.colours.len()) {
        return Some(T::default());
    }
    let places = recording.places(evidence, more);
    let mut search = Search {
        evidence,
        assignment,
        others,
        places: &places,
        in_quads: recording.in_quads,
        theirs,
        traces: &recording.traces,
        own: &recording.own,
        wanted: &recording.wanted,
        quantities: &recording.quantities,
        trials: Trials::new(assignment, theirs, &places, recording.in_quads)?,
        count: places.len(),
        base: Default::default(),
        chain: &recording.chain,
        features: &recording.features,
    };
    Some(look(&mut search))
}
