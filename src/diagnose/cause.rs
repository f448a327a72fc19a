//! Why the colours are as they are.

mod spared;
mod worth;

use super::constants::{self, ChangedConstant};
use super::inside::{self, Finding, Repaired};
use super::listed::Listed;
use super::locate::{self, TracedProbes};
use super::{CONSTANTS_CHANGED, Evidence, Fresh, POSITION_CHANGED, addends, hard_coded, plain};
use crate::compare::{COLOUR_TOLERANCE, POSITION_TOLERANCE, position_difference};
use crate::render::Sample;
use crate::report::{FrameResult, Hypothesis};
use glam::{DVec3, DVec4};
use reference::Assignment;
use reference::derived::{definition, is_derived};
use reference::equation::{DISCARDED, Reads};
use reference::fit::{
    Alternatives, FeatureExplanation, Fit, MOST_MISTAKES, TermJudgement, explain_derived, explain_parts, is_right,
    judge_factor, judge_features, judge_terms, program_of, programs_of,
};
use reference::mistake::{FoundMistake, Mistake};
use reference::probes::ProbeSet;

pub use worth::{belongs, kept};

const HARD_CODED: &str = "hard-coded";
/// Nothing that is known explains a wrong answer.
pub const UNEXPLAINED: &str = "unexplained";
pub(super) const NEARLY_RIGHT: &str = "nearly-right";
/// Every fragment is thrown away.
pub(super) const NOTHING_DRAWN: &str = "nothing-drawn";
pub(super) const PART_MISSING: &str = "part-missing";
pub(super) const PART_SCALED: &str = "part-scaled";

/// Colours that are off by no more than this everywhere are nearly right: each of three terms is off by one step of 8 bits.
///
/// Noise: [`COLOUR_TOLERANCE`]. Defect to catch: the faintest known mistake differs by more than 2e-2 at some probe.
const NEARLY: f64 = 3.0 / 255.0;

/// Whether a picture is off by no more than what is nearly right.
fn is_hardly_off(frame: &FrameResult) -> bool {
    frame.max_difference <= NEARLY * 255.0
}

/// Why the colours are as they are.
pub(super) enum Cause {
    Right,
    /// Known mistakes explain every sample, perhaps on top of changed constants.
    Known {
        constants: Vec<ChangedConstant>,
        found: Vec<FoundMistake>,
        /// Ids of the lines that derived mistakes cost nothing: the text computes what they judge.
        spared: Vec<String>,
    },
    /// All is right but for some features, and a known mistake where there is one.
    Parts(FeatureExplanation),
    /// The colour does not come from the equation at all.
    HardCoded,
    /// Every fragment is thrown away, and the homework does not say why.
    NothingDrawn,
    /// Nothing known explains it, but it is never off by much.
    NearlyRight,
    /// Nothing known explains it, and these changes of the text make it right; the ids of the lines that each one costs points.
    Repaired(Vec<(Vec<String>, Repaired)>),
    /// Nothing known explains it; each term as far as it stands alone, and where in the text the mistakes stand.
    Unexplained {
        terms: Vec<TermJudgement>,
        findings: Vec<Finding>,
    },
}

/// Finds it. `shape`: whether everything stands where it should.
pub(super) fn cause(evidence: &Evidence<'_>, shape: bool) -> Cause {
    let Evidence { assignment, probes, .. } = *evidence;
    let samples: Vec<[f64; 3]> = evidence.samples.iter().map(Sample::colour_f64).collect();
    let frames_agree = evidence.frames.iter().all(FrameResult::agrees);
    let all_right = is_right(probes, &samples, COLOUR_TOLERANCE);
    if let (true, Some(_), Some(mistake)) = (all_right, evidence.undefined, assignment.undefined_power()) {
        let found = vec![FoundMistake { id: mistake.id.clone(), form: 0, parameter: None }];
        return Cause::known(found);
    }
    let alternatives = Alternatives::new(assignment, probes);
    let program = || program_of(&alternatives, &samples, &is_there(evidence), COLOUR_TOLERANCE);
    if let Some(found) = (!(all_right && shape)).then(program).flatten() {
        return Cause::known(vec![found]);
    }
    if all_right {
        // Right at every probe and in place, but not in the frames: the course's own poses are treated apart.
        return match assignment.equation.reads() {
            _ if frames_agree || !shape => Cause::Right,
            // What the last digits decide is not judged.
            Reads::Attributes if hard_coded::are_at_steps(assignment, evidence.frames) => Cause::Right,
            Reads::Attributes => Cause::HardCoded,
            // Not all that a fragment stage reads is probed.
            Reads::Varyings | Reads::Outputs => Cause::Unexplained { terms: Vec::new(), findings: Vec::new() },
        };
    }
    let constants = constants::changed(evidence.source, assignment);
    if let Some(found) = explained_by(&constants, evidence, &samples) {
        return Cause::Known { constants, found, spared: Vec::new() };
    }
    // Numbers that a program lists are known one by one: nothing is looked up, and the course's own light hides what is wrong.
    let is_listed = assignment.files.iter().any(|file| file.program.is_some());
    let frames_agree = frames_agree && !is_listed;
    let shows_a_table = !is_listed && hard_coded::is_lookup(evidence.source, probes, evidence.samples);
    let by_term = || {
        let terms = judge_terms(assignment, probes, &samples, COLOUR_TOLERANCE);
        unexplained(evidence, &alternatives, &samples, terms)
    };
    if shows_a_table && addends::is_finite_nowhere(evidence) {
        return by_term();
    }
    let is_lookup = shows_a_table && !addends::is_computed(evidence);
    // Without the normals the course's own poses can only be right if they are treated apart.
    let is_made_for_the_poses = || frames_agree && hard_coded::ignores_normals(probes, evidence.samples);
    let is_nearly_right = || is_right(probes, &samples, NEARLY) && evidence.frames.iter().all(is_hardly_off);
    // Of fragments there are no twins with one number: the text says whether anything is computed.
    let is_made_of_nothing = || {
        let is_known = assignment.mistake(HARD_CODED).is_some() && assignment.equation.reads() == Reads::Outputs;
        is_known && !is_dark(evidence.samples) && inside::ignores_all(evidence)
    };
    match plain::explained(assignment, evidence.source, probes, &samples, COLOUR_TOLERANCE) {
        // What computes a right term has it multiplied by 0, or left out.
        Fit::Explained(found)
            if shows_a_table
                && hard_coded::is_coincidence(assignment, probes, evidence.samples, &found)
                && !addends::computes_a_term(evidence) =>
        {
            if is_lookup {
                Cause::HardCoded
            } else {
                by_term()
            }
        }
        // The course's own poses are treated apart from what explains all others.
        Fit::Explained(found) if frames_agree && hard_coded::leaves_nothing(assignment, &found) => Cause::HardCoded,
        // Some mistakes together come near to nearly anything.
        Fit::Explained(found) if found.len() > 1 && is_nearly_right() => Cause::NearlyRight,
        Fit::Explained(found) if found.len() == MOST_MISTAKES && !is_borne_out(evidence, &found) => by_term(),
        Fit::Explained(found) if is_dark(evidence.samples) && stands_elsewhere(evidence, &found) => by_term(),
        Fit::Explained(found) => Cause::known(found),
        Fit::Unexplained(_) if is_lookup || is_made_for_the_poses() => Cause::HardCoded,
        Fit::Unexplained(_) if is_made_of_nothing() => Cause::HardCoded,
        Fit::Unexplained(_) if is_nearly_right() => Cause::NearlyRight,
        Fit::Unexplained(terms) => unexplained(evidence, &alternatives, &samples, terms),
    }
}

/// What no known mistake explains: by the features, or else each term as far as it stands alone, or shows by itself.
fn unexplained(
    evidence: &Evidence<'_>,
    alternatives: &Alternatives<'_>,
    samples: &[[f64; 3]],
    mut terms: Vec<TermJudgement>,
) -> Cause {
    let Evidence { assignment, probes, .. } = *evidence;
    if let Some(listed) = Listed::of(evidence) {
        return Cause::Unexplained { terms: listed.terms(evidence), findings: Vec::new() };
    }
    let parts = explain_parts(alternatives, samples, &is_there(evidence), COLOUR_TOLERANCE);
    match parts {
        Some(parts) if parts.found.is_empty() && parts.is_missing() => return Cause::Parts(parts),
        parts => {
            // What a lecturer wrote down says more than that a feature is missing.
            let numbers = evidence.numbers();
            if let Some(found) = programs_of(alternatives, samples, &numbers, &is_there(evidence), COLOUR_TOLERANCE) {
                return Cause::known(found);
            }
            if let Some(parts) = parts {
                return Cause::Parts(parts);
            }
        }
    }
    // What the text itself becomes right by says more than a change of the solution that the text does not bear out.
    let doubtful = match (!is_dark(evidence.samples)).then(|| derived(evidence, samples)).flatten() {
        Some(cause) if !cause.is_contradicted(evidence) => return cause,
        doubtful => doubtful,
    };
    let (findings, repairs) = inside::account(evidence);
    let terms = match judge_factor(assignment, probes, samples, COLOUR_TOLERANCE) {
        Some(terms) => terms,
        None => {
            for feature in judge_features(alternatives, samples, COLOUR_TOLERANCE) {
                terms.retain(|term| term.line != feature.line);
                terms.push(feature);
            }
            spared::beside(evidence, addends::credit(evidence, terms), &findings)
        }
    };
    let wrong = if repairs.is_empty() { terms.clone() } else { spared::computed(evidence, terms.clone()) };
    let repairs = repairs.into_iter().map(|repaired| (worth::charged(assignment, &wrong, &repaired), repaired));
    let repairs: Vec<(Vec<String>, Repaired)> = repairs.collect();
    if repairs.is_empty() || repairs.iter().any(|(lines, _)| lines.is_empty()) {
        return doubtful.unwrap_or(Cause::Unexplained { terms, findings });
    }
    Cause::Repaired(repairs)
}

/// The derived mistakes that explain the samples, also those that nobody knows beforehand; perhaps on top of changed constants.
fn derived(evidence: &Evidence<'_>, samples: &[[f64; 3]]) -> Option<Cause> {
    let constants = constants::changed(evidence.source, evidence.assignment);
    let explained = |assignment: &Assignment, probes: &ProbeSet, constants: Vec<ChangedConstant>| {
        let found = explain_derived(assignment, probes, samples, &is_there(evidence), COLOUR_TOLERANCE)?;
        let is_borne_out = plain::is_borne_out(assignment, evidence.source, &found);
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

/// Whether a sample has a given position, but for the factor that all have in common where they are right.
fn is_there<'e>(evidence: &'e Evidence<'_>) -> impl Fn(usize, DVec4) -> bool + 'e {
    let scale = super::position_scale(evidence);
    move |place, position| {
        let sample = evidence.samples.get(place);
        let is_at = |scale| sample.is_some_and(|s| position_difference(position, s, scale) <= POSITION_TOLERANCE);
        is_at(1.0) || is_at(scale)
    }
}

/// Whether the text has a place for each of these mistakes, another one for those that touch the same lines of the rubric. So
/// many mistakes together explain much by chance.
fn is_borne_out(evidence: &Evidence<'_>, found: &[FoundMistake]) -> bool {
    let assignment = evidence.assignment;
    let mut points = TracedProbes::new(evidence, assignment);
    if points.is_none() {
        return true;
    }
    let mut line = |index: usize| Some(locate::mistake(evidence, assignment, &mut points, found, index, None)?.line);
    let places: Vec<_> = (0..found.len()).map(&mut line).collect();
    let clash = |a: usize, b: usize| assignment.share_a_line(&found[a], &found[b]) && places[a] == places[b];
    places.iter().all(Option::is_some) && !(0..found.len()).any(|b| (0..b).any(|a| clash(a, b)))
}

/// Whether all that is drawn is black, or no number: then the colours say little of the cause.
fn is_dark(samples: &[Sample]) -> bool {
    let is_drawn = |colour: &[f64; 3]| DVec3::from(*colour) != DISCARDED;
    let mut drawn = samples.iter().map(Sample::colour_f64).filter(is_drawn).peekable();
    drawn.peek().is_some() && drawn.flatten().all(|channel| channel == 0.0 || channel.is_nan())
}

/// Whether the places at which all is mended serve definitions that have nothing of what the mistakes have wrong.
fn stands_elsewhere(evidence: &Evidence<'_>, found: &[FoundMistake]) -> bool {
    let Evidence { assignment: Assignment { equation, .. }, .. } = *evidence;
    let forms = found.iter().filter_map(|found| evidence.assignment.mistake(&found.id)?.forms.get(found.form));
    let wrong: Vec<usize> = forms.flat_map(|form| &form.overrides).map(|changed| changed.definition).collect();
    let place = |name: String| equation.definitions().iter().position(|known| known.name == name);
    let places: Vec<usize> =
        inside::find(evidence).into_iter().filter_map(|finding| finding.serves).filter_map(place).collect();
    let is_apart = |place: &usize| !wrong.iter().any(|wrong| equation.depends(*place, *wrong));
    !places.is_empty() && places.iter().all(is_apart)
}

/// The homework with the student's own constants.
fn with_constants(assignment: &Assignment, constants: &[ChangedConstant]) -> Option<Assignment> {
    let changes: Vec<_> = constants.iter().map(|constant| (constant.name.as_str(), constant.found.clone())).collect();
    assignment.with_constants(&changes).ok()
}

/// The mistakes that explain the samples when the equation has the student's own constants.
fn explained_by(
    constants: &[ChangedConstant],
    evidence: &Evidence<'_>,
    samples: &[[f64; 3]],
) -> Option<Vec<FoundMistake>> {
    if constants.is_empty() {
        return None;
    }
    let changed = with_constants(evidence.assignment, constants)?;
    let probes = changed.reprobe(evidence.probes);
    match plain::explained(&changed, evidence.source, &probes, samples, COLOUR_TOLERANCE) {
        Fit::Explained(found) => Some(found),
        Fit::Unexplained(_) => None,
    }
}

impl Cause {
    fn known(found: Vec<FoundMistake>) -> Self {
        Self::Known { constants: Vec::new(), found, spared: Vec::new() }
    }

    /// The cause; a lookup where the shader does something else at probes that nobody knows beforehand.
    pub(super) fn unless_refuted(self, evidence: &Evidence<'_>) -> Self {
        match self {
            _ if !self.is_refuted(evidence) => self,
            _ if let Some(listed) = Listed::of(evidence) => {
                Self::Unexplained { terms: listed.terms(evidence), findings: Vec::new() }
            }
            Self::Known { .. } | Self::NearlyRight if addends::is_computed(evidence) => {
                let samples: Vec<[f64; 3]> = evidence.samples.iter().map(Sample::colour_f64).collect();
                let Evidence { assignment, probes, .. } = *evidence;
                let terms = judge_terms(assignment, probes, &samples, COLOUR_TOLERANCE);
                let (findings, _) = inside::account(evidence);
                Self::Unexplained { terms, findings }
            }
            _ => Self::HardCoded,
        }
    }

    /// Whether the shader does something else at probes that nobody knows beforehand.
    fn is_refuted(&self, evidence: &Evidence<'_>) -> bool {
        let Evidence { assignment, fresh, .. } = *evidence;
        match self {
            // What an undefined power gives depends on the driver.
            Self::Known { .. } if evidence.undefined.is_some() => false,
            Self::Known { constants, found, .. } if constants.is_empty() => {
                fresh.refutes(assignment, found, COLOUR_TOLERANCE)
            }
            Self::Known { constants, found, .. } => with_constants(assignment, constants).is_some_and(|assignment| {
                let probes = assignment.reprobe(fresh.probes);
                Fresh { probes: &probes, ..fresh }.refutes(&assignment, found, COLOUR_TOLERANCE)
            }),
            Self::Right => fresh.refutes(assignment, &[], COLOUR_TOLERANCE),
            Self::NearlyRight => fresh.refutes(assignment, &[], NEARLY),
            Self::HardCoded | Self::NothingDrawn | Self::Parts(_) | Self::Repaired(_) | Self::Unexplained { .. } => {
                false
            }
        }
    }

    /// The cause, or that nothing is drawn: what an answer that throws everything away is short of being right is worth nothing, for no
    /// part of it is seen.
    pub(super) fn unless_nothing_is_drawn(self, evidence: &Evidence<'_>) -> Self {
        let is_gone = |colour: DVec3| colour == DISCARDED;
        let is_all_gone = evidence.samples.iter().all(|sample| is_gone(sample.colour_f64().into()));
        let is_right = evidence.probes.iter().all(|probe| is_gone(probe.colour));
        match evidence.source_that_discards() {
            _ if !is_all_gone || is_right || self.is_written() => self,
            Some(_) => Self::NothingDrawn,
            // Nothing is ever written.
            None => Self::Unexplained { terms: Vec::new(), findings: Vec::new() },
        }
    }

    /// Whether the text computes right what a derived mistake would have wrong, where only all together is seen.
    fn is_contradicted(&self, evidence: &Evidence<'_>) -> bool {
        let Self::Known { found, .. } = self else { return false };
        let mut definitions = found.iter().filter_map(|found| definition(&found.id));
        evidence.assignment.equation.reads() == Reads::Outputs
            && definitions.any(|name| inside::computes(evidence, name))
    }

    /// Whether the homework says what it is worth.
    fn is_written(&self) -> bool {
        let found: &[FoundMistake] = match self {
            Self::Known { found, .. } | Self::Parts(FeatureExplanation { found, .. }) => found,
            _ => &[],
        };
        found.iter().any(|found| !is_derived(&found.id))
    }

    /// The equation that computes what the shader computes, where one is known.
    pub(super) fn explanation(&self) -> Option<Vec<Hypothesis>> {
        match self {
            Self::Right => Some(Vec::new()),
            Self::Known { found, .. } => Some(
                found
                    .iter()
                    .map(|found| Hypothesis { id: found.id.clone(), form: found.form, parameter: found.parameter })
                    .collect(),
            ),
            Self::HardCoded
            | Self::NothingDrawn
            | Self::Parts(_)
            | Self::NearlyRight
            | Self::Repaired(_)
            | Self::Unexplained { .. } => None,
        }
    }

    /// The changes that make it right.
    pub(super) fn repairs(&self) -> impl Iterator<Item = &Repaired> {
        let repairs: &[_] = if let Self::Repaired(repairs) = self { repairs } else { &[] };
        repairs.iter().map(|(_, repaired)| repaired)
    }

    /// A mistake by its id: one that a repair names, or one of the homework.
    pub(super) fn mistake<'a>(&'a self, assignment: &'a Assignment, id: &str) -> Option<&'a Mistake> {
        let repaired = self.repairs().map(|repaired| &repaired.mistake).find(|mistake| mistake.id == id);
        repaired.or_else(|| assignment.mistake(id))
    }

    /// Ids of the mistakes.
    pub(super) fn ids(&self) -> Vec<String> {
        match self {
            Self::Right => Vec::new(),
            Self::Known { constants, found, .. } => {
                let changed = (!constants.is_empty()).then(|| CONSTANTS_CHANGED.to_owned());
                changed.into_iter().chain(found.iter().map(|mistake| mistake.id.clone())).collect()
            }
            Self::Parts(FeatureExplanation { found, parts }) => {
                let mut ids: Vec<String> = found.iter().map(|found| found.id.clone()).collect();
                let kinds = parts.iter().map(|(_, part)| worth::part_id(*part).to_owned());
                ids.extend(kinds);
                ids.dedup();
                ids
            }
            Self::HardCoded => vec![HARD_CODED.into()],
            Self::NothingDrawn => vec![NOTHING_DRAWN.into()],
            Self::NearlyRight => vec![NEARLY_RIGHT.into()],
            Self::Repaired(_) => {
                let mut ids: Vec<String> = self.repairs().map(|repaired| repaired.mistake.id.clone()).collect();
                ids.dedup();
                ids
            }
            Self::Unexplained { .. } => vec![UNEXPLAINED.into()],
        }
    }
}
