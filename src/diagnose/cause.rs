//! Why the colours are as they are.

mod search;
mod spared;
mod unexplained;
mod worth;

use super::constants::ChangedConstant;
use super::inside::{self, Finding, Repaired};
use super::listed::WrongNumbers;
use super::{CONSTANTS_CHANGED, Evidence, Fresh, addends};
use crate::compare::COLOUR_TOLERANCE;
use crate::render::Sample;
use crate::report::{Hypothesis, UNEXPLAINED};
use glam::DVec3;
use reference::Assignment;
use reference::assignment::RubricItem;
use reference::derived::{definition, is_derived};
use reference::equation::{DISCARDED, Reads};
use reference::fit::{Alternatives, FeatureDefect, FeatureExplanation, TermJudgement, judge_terms};
use reference::mistake::{FoundMistake, Mistake};

pub(super) use search::{cause, is_there, leaves_little};
use unexplained::with_features;
pub use worth::{belongs, kept};

const HARD_CODED: &str = "hard-coded";
pub(super) const NEARLY_RIGHT: &str = "nearly-right";
pub(super) const FEW_PIXELS: &str = "few-pixels";
/// Every fragment is thrown away.
pub(super) const NOTHING_DRAWN: &str = "nothing-drawn";
pub(super) const PART_MISSING: &str = "part-missing";
pub(super) const PART_SCALED: &str = "part-scaled";
pub(super) const PART_ABSENT: &str = "part-absent";

/// Colours that are off by no more than this everywhere are nearly right: each of three terms is off by one step of 8 bits.
///
/// Noise: [`COLOUR_TOLERANCE`]. Defect to catch: the faintest known mistake differs by more than 2e-2 at some probe.
const NEARLY: f64 = 3.0 / 255.0;

/// Why the colours are as they are.
pub(super) enum Cause {
    Right,
    /// Known mistakes explain every sample, perhaps on top of changed constants.
    Known {
        constants: Vec<ChangedConstant>,
        found: Vec<FoundMistake>,
        /// Ids of the lines that these cost nothing: the text computes what they judge.
        spared: Vec<String>,
    },
    /// All is right but for some features, and a known mistake where there is one.
    Parts(FeatureExplanation),
    /// The colour does not come from the equation at all.
    HardCoded,
    /// Every fragment is thrown away, and the homework does not say why.
    NothingDrawn,
    /// Nothing known explains it, but it is never off by much; the ids of lines that have nothing to do with it.
    NearlyRight(Vec<String>),
    /// It is right at every probe, and in the pictures but for a few pixels.
    FewPixels,
    /// Nothing known explains it, and these changes of the text make it right; the ids of the lines that each one costs points.
    Repaired(Vec<(Vec<String>, Repaired)>),
    /// Nothing known explains it.
    Unexplained {
        /// Each term as far as it stands alone.
        terms: Vec<TermJudgement>,
        /// Where in the text the mistakes stand.
        findings: Vec<Finding>,
        /// Ids of the lines of which nothing is seen, see [`inside::absent_lines`].
        absent: Vec<String>,
    },
}

/// The homework with the student's own constants; `None` where no definitions are made of them.
fn with_constants(assignment: &Assignment, constants: &[ChangedConstant]) -> Option<Assignment> {
    if assignment.equation.reads() == Reads::Outputs {
        return None;
    }
    let changes: Vec<_> = constants.iter().map(|constant| (constant.name.as_str(), constant.found.clone())).collect();
    assignment.with_constants(&changes).ok()
}

/// Each term as far as it stands alone, or shows by itself.
pub(super) fn terms_alone(evidence: &Evidence<'_>) -> Vec<TermJudgement> {
    let Evidence { assignment, probes, .. } = *evidence;
    let samples: Vec<[f64; 3]> = evidence.samples.iter().map(Sample::colour_f64).collect();
    let terms = judge_terms(assignment, probes, &samples, COLOUR_TOLERANCE);
    with_features(&Alternatives::new(assignment, probes), &samples, terms)
}

impl Cause {
    fn known(found: Vec<FoundMistake>) -> Self {
        Self::Known { constants: Vec::new(), found, spared: Vec::new() }
    }

    fn unexplained(terms: Vec<TermJudgement>, findings: Vec<Finding>) -> Self {
        Self::Unexplained { terms, findings, absent: Vec::new() }
    }

    /// The cause; a lookup where the shader does something else at probes that nobody knows beforehand.
    pub(super) fn unless_refuted(self, evidence: &Evidence<'_>) -> Self {
        match self {
            _ if !self.is_refuted(evidence) => self,
            _ if let Some(listed) = WrongNumbers::of(evidence) => Self::unexplained(listed.terms(evidence), Vec::new()),
            Self::Known { .. } | Self::NearlyRight(_) | Self::FewPixels if addends::is_computed(evidence) => {
                let samples: Vec<[f64; 3]> = evidence.samples.iter().map(Sample::colour_f64).collect();
                let Evidence { assignment, probes, .. } = *evidence;
                let terms = judge_terms(assignment, probes, &samples, COLOUR_TOLERANCE);
                let findings = inside::find(evidence);
                Self::unexplained(terms, findings)
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
            Self::Right | Self::FewPixels => fresh.refutes(assignment, &[], COLOUR_TOLERANCE),
            Self::NearlyRight(_) => fresh.refutes(assignment, &[], NEARLY),
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
            None => Self::unexplained(Vec::new(), Vec::new()),
        }
    }

    /// The cause, or that parts of a right answer are not there at all: a mistake that makes nothing of them would show the same, and
    /// leave them their points.
    pub(super) fn unless_absent(self, evidence: &Evidence<'_>, shape: bool) -> Self {
        let assignment = evidence.assignment;
        let is_in_a_body = self.repairs().any(Repaired::is_of_a_body);
        if !matches!(self, Self::Known { .. } | Self::Parts(_) | Self::Repaired(_)) || is_in_a_body {
            return self;
        }
        let ids = self.ids();
        let left =
            |line: &RubricItem| ids.iter().map(|id| kept(assignment, line, shape, &self, id)).fold(1.0, f64::min);
        let terms = std::cell::LazyCell::new(|| terms_alone(evidence));
        let is_right = |line: &str| terms.iter().any(|term| term.line == line && term.is_right());
        let absent = inside::absent_lines(evidence, &is_right);
        // What a mistake of the table leaves of a line that is not there is the lecturer's affair, but not all of it, nor of several.
        let absent_lines = assignment.rubric.iter().filter(|line| absent.contains(&line.id));
        if absent_lines.map(left).sum::<f64>() < 1.0 {
            return self;
        }
        let findings = inside::find(evidence);
        // What lacks these parts may be right otherwise.
        if let Some(Self::Parts(mut lacking)) = unexplained::lacking(assignment, &findings) {
            let is_known = |line: &usize| lacking.parts.iter().any(|(known, _)| known == line);
            let lines = (0..assignment.rubric.len()).filter(|line| absent.contains(&assignment.rubric[*line].id));
            let more: Vec<usize> = lines.filter(|line| !is_known(line)).collect();
            lacking.parts.extend(more.into_iter().map(|line| (line, FeatureDefect::Missing)));
            return Self::Parts(lacking);
        }
        let terms = terms.clone();
        Self::Unexplained { terms, findings, absent }
    }

    /// The cause; one mistake costs nothing of terms that the text has right, unless these are all.
    pub(super) fn but_for_right_terms(mut self, evidence: &Evidence<'_>) -> Self {
        let assignment = evidence.assignment;
        let Self::Known { constants, found, spared } = &mut self else { return self };
        let ([], [only]) = (&constants[..], &found[..]) else { return self };
        let is_cost = |line: &&RubricItem| {
            !assignment.judges_position(line) && assignment.keeps(only, line) < 1.0 && !spared.contains(&line.id)
        };
        let costs: Vec<&RubricItem> = assignment.rubric.iter().filter(is_cost).collect();
        if costs.len() > 1 {
            let terms = inside::right_terms(evidence);
            let right = costs.iter().filter(|line| terms.contains(&line.id)).map(|line| line.id.clone());
            let right: Vec<String> = right.collect();
            if right.len() < costs.len() {
                spared.extend(right);
            }
        }
        self
    }

    /// The cause, or that it is not known: a mistake that nobody wrote down and that costs nothing does not make an answer wrong.
    pub(super) fn unless_free(self, evidence: &Evidence<'_>, shape: bool) -> Self {
        let ids = self.ids();
        let costs = |line: &RubricItem| ids.iter().any(|id| kept(evidence.assignment, line, shape, &self, id) < 1.0);
        if ids.is_empty() || self.is_written() || evidence.assignment.rubric.iter().any(costs) {
            return self;
        }
        Self::unexplained(terms_alone(evidence), inside::find(evidence))
    }

    /// Whether the text computes right what a derived mistake would have wrong, where only all together is seen.
    fn is_contradicted(&self, evidence: &Evidence<'_>) -> bool {
        let Self::Known { found, .. } = self else { return false };
        let mut definitions = found.iter().filter_map(|found| definition(&found.id));
        evidence.assignment.equation.reads() == Reads::Outputs
            && definitions.any(|name| inside::computes(evidence, name))
    }

    /// Whether it is a derived mistake in what several lines of the rubric go into, and leaves none of them as they are.
    fn is_of_several_terms(&self, assignment: &Assignment) -> bool {
        let Self::Known { found, spared, .. } = self else { return false };
        spared.is_empty() && spared::is_of_several_terms(assignment, found)
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
            Self::Known { found, .. } => {
                let of =
                    |own: &FoundMistake| Hypothesis { id: own.id.clone(), form: own.form, parameter: own.parameter };
                Some(found.iter().map(of).collect())
            }
            _ => None,
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
            Self::NearlyRight(_) => vec![NEARLY_RIGHT.into()],
            Self::FewPixels => vec![FEW_PIXELS.into()],
            Self::Repaired(_) => {
                let mut ids: Vec<String> = self.repairs().map(|repaired| repaired.mistake.id.clone()).collect();
                ids.dedup();
                ids
            }
            Self::Unexplained { absent, .. } if absent.is_empty() => vec![UNEXPLAINED.into()],
            Self::Unexplained { terms, absent, .. } => {
                let is_wrong = |term: &TermJudgement| !term.is_right() && !absent.contains(&term.line);
                let others = terms.iter().any(is_wrong).then_some(UNEXPLAINED);
                [PART_ABSENT].into_iter().chain(others).map(Into::into).collect()
            }
        }
    }
}
