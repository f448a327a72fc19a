//! Samples → which terms are right, which known mistakes explain the rest, and what that is worth. Pure.

pub mod advice;
pub mod constants;
mod hard_coded;
mod locate;
mod message;
mod plain;

use crate::compare::{COLOUR_TOLERANCE, POSITION_TOLERANCE, colour_difference, position_difference};
use crate::language::Text;
use crate::render::Sample;
pub use crate::report::Hints;
use crate::report::{Advice, FrameResult, Hypothesis, ProbeResult, RubricLine};
use crate::source::Source;
use crate::translate::Interpreter;
use advice::Beyond;
use constants::ChangedConstant;
use message::Facts;
use reference::Assignment;
use reference::fit::{Fit, TermJudgement, is_right};
use reference::mistake::Found;
use reference::probes::ProbeSet;

/// The rubric line that is judged by where things are drawn, not by their colour.
const SHAPE: &str = "shape";
/// Mistakes that are told from other things than the colours alone.
const POSITION_CHANGED: &str = "position-changed";
const CONSTANTS_CHANGED: &str = "constants-changed";
const HARD_CODED: &str = "hard-coded";
const UNEXPLAINED: &str = "unexplained";
const NEARLY_RIGHT: &str = "nearly-right";
/// What a negative base of a power is called, also where this driver hides that its result is undefined.
const UNDEFINED_POWER: &str = "specular-unclamped";

/// Colours that are off by no more than this everywhere are nearly right: each of three terms is off by one step of 8 bits.
///
/// Noise: [`COLOUR_TOLERANCE`]. Defect to catch: the faintest known mistake differs by more than 2e-2 at some probe.
const NEARLY: f64 = 3.0 / 255.0;

/// What a rendering showed.
#[derive(Clone, Copy, Debug)]
pub struct Evidence<'a> {
    /// The homework.
    pub assignment: &'a Assignment,
    /// The student's text.
    pub source: &'a Source,
    /// The frames, compared.
    pub frames: &'a [FrameResult],
    /// The probes.
    pub probes: &'a ProbeSet,
    /// What the shader computed at each probe, in their order.
    pub samples: &'a [Sample],
    /// The line where a negative number was raised to a power, where one was.
    pub undefined: Option<u32>,
    /// The shader, to be run step by step; none where it has something that the interpreter does not know.
    pub interpreter: Option<&'a Interpreter>,
    /// The probes that advice comes from.
    pub beyond: &'a [Beyond],
    /// How much the messages help.
    pub hints: Hints,
}

/// What is to be said and credited.
#[derive(Clone, Debug)]
pub struct Diagnosis {
    /// Whether all frames and all probes agree.
    pub is_right: bool,
    /// The rubric, judged.
    pub rubric: Vec<RubricLine>,
    /// Ids of the mistakes found.
    pub mistakes: Vec<String>,
    /// What would break elsewhere, where all is right.
    pub advice: Vec<Advice>,
    /// The equation that computes what the shader computes, where one is known.
    pub explanation: Option<Vec<Hypothesis>>,
    /// The probes in figures.
    pub probes: ProbeResult,
}

/// Why the colours are as they are.
enum Cause {
    Right,
    /// Known mistakes explain every sample, perhaps on top of changed constants.
    Known {
        constants: Vec<ChangedConstant>,
        found: Vec<Found>,
    },
    /// The colour does not come from the equation at all.
    HardCoded,
    /// Nothing known explains it, but it is never off by much.
    NearlyRight,
    /// Nothing known explains it; each term as far as it stands alone.
    Unexplained(Vec<TermJudgement>),
}

/// Judges the evidence.
pub fn diagnose(evidence: &Evidence<'_>) -> Diagnosis {
    let probes = compare_probes(evidence);
    let shape = shape_agrees(evidence, &probes);
    let cause = cause(evidence, shape);
    let mut mistakes = cause.ids();
    if !shape && !mistakes.iter().any(|id| costs(evidence.assignment, id, SHAPE)) {
        mistakes.insert(0, POSITION_CHANGED.into());
    }
    let lines = &evidence.assignment.rubric;
    let facts = if mistakes.is_empty() { Facts::default() } else { Facts::of(evidence, &cause) };
    let judged = lines.iter().map(|line| judge(evidence, &facts, line, shape, &cause, &mistakes));
    let rubric: Vec<RubricLine> = judged.collect();
    let advice = if mistakes.is_empty() && evidence.hints > Hints::None { advice::find(evidence) } else { Vec::new() };
    Diagnosis {
        is_right: mistakes.is_empty(),
        rubric,
        advice,
        mistakes,
        explanation: cause.explanation(),
        probes: probes.result,
    }
}

/// The diagnosis of an answer that agrees everywhere; none of any other, without a search for mistakes.
pub fn agreement(evidence: &Evidence<'_>) -> Option<Diagnosis> {
    let samples: Vec<[f64; 3]> = evidence.samples.iter().map(Sample::colour_f64).collect();
    let frames_agree = evidence.frames.iter().all(FrameResult::agrees);
    let agrees = frames_agree && is_right(evidence.probes, &samples, COLOUR_TOLERANCE);
    agrees.then(|| diagnose(evidence)).filter(|diagnosis| diagnosis.is_right)
}

fn costs(assignment: &Assignment, id: &str, line: &str) -> bool {
    assignment.mistake(id).is_some_and(|mistake| mistake.keeps(line) < 1.0)
}

struct ComparedProbes {
    result: ProbeResult,
    positions_agree: bool,
}

fn compare_probes(evidence: &Evidence<'_>) -> ComparedProbes {
    let scale = position_scale(evidence);
    let mut mismatched = 0;
    let mut largest: f64 = 0.0;
    let mut positions_agree = true;
    for (probe, sample) in evidence.probes.iter().zip(evidence.samples) {
        let colour = colour_difference(probe.colour, sample);
        let position = position_difference(probe.position, sample, scale);
        largest = largest.max(colour);
        positions_agree &= position <= POSITION_TOLERANCE;
        mismatched += u32::from(colour > COLOUR_TOLERANCE || position > POSITION_TOLERANCE);
    }
    let result = ProbeResult {
        seed: evidence.probes.seed,
        samples: evidence.probes.probes.len() as u32,
        mismatched,
        max_difference: largest.is_finite().then_some(largest),
    };
    ComparedProbes { result, positions_agree }
}

/// The factor that all positions have in common; 1 where there is none that keeps the picture.
fn position_scale(evidence: &Evidence<'_>) -> f64 {
    let first = evidence.probes.iter().zip(evidence.samples).next();
    let scale = first.map_or(1.0, |(probe, sample)| {
        let found = glam::DVec4::from_array(sample.position.map(f64::from));
        found.dot(probe.position) / probe.position.length_squared()
    });
    if scale.is_finite() && scale > 0.0 { scale } else { 1.0 }
}

/// Whether everything stands where it should, in the pictures and at the probes.
fn shape_agrees(evidence: &Evidence<'_>, probes: &ComparedProbes) -> bool {
    probes.positions_agree && evidence.frames.iter().all(FrameResult::shape_agrees)
}

fn cause(evidence: &Evidence<'_>, shape: bool) -> Cause {
    let Evidence { assignment, probes, .. } = *evidence;
    let samples: Vec<[f64; 3]> = evidence.samples.iter().map(Sample::colour_f64).collect();
    let frames_agree = evidence.frames.iter().all(FrameResult::agrees);
    let is_right = is_right(probes, &samples, COLOUR_TOLERANCE);
    if is_right && evidence.undefined.is_some() {
        let found = vec![Found { id: UNDEFINED_POWER.into(), form: 0, parameter: None }];
        return Cause::Known { constants: Vec::new(), found };
    }
    if is_right {
        // Right at every probe and in place, but not in the frames: the course's own poses are treated apart.
        return if frames_agree || !shape { Cause::Right } else { Cause::HardCoded };
    }
    let constants = constants::changed(evidence.source, assignment);
    if let Some(found) = explained_by(&constants, evidence, &samples) {
        return Cause::Known { constants, found };
    }
    let is_lookup = hard_coded::is_lookup(probes, evidence.samples);
    // Without the normals the course's own poses can only be right if they are treated apart.
    let is_made_for_the_poses = || frames_agree && hard_coded::ignores_normals(probes, evidence.samples);
    match plain::explained(assignment, evidence.source, probes, &samples, COLOUR_TOLERANCE) {
        Fit::Explained(found)
            if is_lookup && hard_coded::is_coincidence(assignment, probes, evidence.samples, &found) =>
        {
            Cause::HardCoded
        }
        // The course's own poses are treated apart from what explains all others.
        Fit::Explained(found) if frames_agree && hard_coded::leaves_nothing(assignment, &found) => Cause::HardCoded,
        Fit::Explained(found) => Cause::Known { constants: Vec::new(), found },
        Fit::Unexplained(_) if is_lookup || is_made_for_the_poses() => Cause::HardCoded,
        Fit::Unexplained(_) if reference::fit::is_right(probes, &samples, NEARLY) => Cause::NearlyRight,
        Fit::Unexplained(terms) => Cause::Unexplained(terms),
    }
}

/// The mistakes that explain the samples when the equation has the student's own constants.
fn explained_by(constants: &[ChangedConstant], evidence: &Evidence<'_>, samples: &[[f64; 3]]) -> Option<Vec<Found>> {
    if constants.is_empty() {
        return None;
    }
    let changes: Vec<_> = constants.iter().map(|constant| (constant.name.as_str(), constant.found.clone())).collect();
    let changed = evidence.assignment.with_constants(&changes).ok()?;
    let probes = changed.reprobe(evidence.probes);
    match plain::explained(&changed, evidence.source, &probes, samples, COLOUR_TOLERANCE) {
        Fit::Explained(found) => Some(found),
        Fit::Unexplained(_) => None,
    }
}

impl Cause {
    fn explanation(&self) -> Option<Vec<Hypothesis>> {
        match self {
            Self::Right => Some(Vec::new()),
            Self::Known { found, .. } => Some(
                found
                    .iter()
                    .map(|found| Hypothesis { id: found.id.clone(), form: found.form, parameter: found.parameter })
                    .collect(),
            ),
            Self::HardCoded | Self::NearlyRight | Self::Unexplained(_) => None,
        }
    }

    fn ids(&self) -> Vec<String> {
        match self {
            Self::Right => Vec::new(),
            Self::Known { constants, found } => {
                let changed = (!constants.is_empty()).then(|| CONSTANTS_CHANGED.to_owned());
                changed.into_iter().chain(found.iter().map(|mistake| mistake.id.clone())).collect()
            }
            Self::HardCoded => vec![HARD_CODED.into()],
            Self::NearlyRight => vec![NEARLY_RIGHT.into()],
            Self::Unexplained(_) => vec![UNEXPLAINED.into()],
        }
    }
}

/// Judges one line of the rubric.
fn judge(
    evidence: &Evidence<'_>,
    facts: &Facts,
    line: &reference::assignment::RubricLine,
    shape: bool,
    cause: &Cause,
    mistakes: &[String],
) -> RubricLine {
    let keeps = |id: &&str| kept(evidence.assignment, line, shape, cause, id);
    let mut culprits: Vec<&str> = mistakes.iter().map(String::as_str).filter(|id| keeps(id) < 1.0).collect();
    let kept: f64 = culprits.iter().map(keeps).product();
    // What is not there at all is not wrong in some way as well.
    if let Some(fatal) = culprits.iter().find(|id| keeps(id) == 0.0) {
        culprits = vec![*fatal];
    }
    let told = message::tell(evidence, facts, line, cause, &culprits);
    RubricLine {
        id: line.id.clone(),
        label: Text::new(&line.label.en, &line.label.ja),
        // Half points are the finest that a rubric shows.
        points: (line.points * kept * 2.0).round() / 2.0,
        max_points: line.points,
        mistake: culprits.first().map(|id| (*id).to_owned()),
        message: told.text,
        line: told.line,
    }
}

/// Fraction of the line's points that the mistake leaves in this answer.
fn kept(
    assignment: &Assignment,
    line: &reference::assignment::RubricLine,
    shape: bool,
    cause: &Cause,
    id: &str,
) -> f64 {
    let is_touched = match (cause, id) {
        (_, POSITION_CHANGED) => !shape && line.id == SHAPE,
        (Cause::Unexplained(terms), UNEXPLAINED) => terms.iter().any(|term| term.line == line.id && !term.is_right()),
        (Cause::Known { constants, .. }, CONSTANTS_CHANGED) => {
            constants.iter().any(|changed| belongs(assignment, &changed.name, line))
        }
        (Cause::Known { found, .. }, _) if let Some(found) = found.iter().find(|found| found.id == id) => {
            return assignment.keeps(found, line);
        }
        _ => true,
    };
    if is_touched { assignment.mistake(id).map_or(1.0, |mistake| mistake.keeps(&line.id)) } else { 1.0 }
}

/// Whether the constant is one of the line's.
fn belongs(assignment: &Assignment, constant: &str, line: &reference::assignment::RubricLine) -> bool {
    assignment.constants.iter().any(|known| known.name == constant && known.line == line.id)
}
