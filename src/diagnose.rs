//! Samples → which terms are right, which known mistakes explain the rest, and what that is worth. Pure.

mod addends;
pub mod advice;
mod cause;
mod columns;
pub mod constants;
mod fresh;
mod hard_coded;
mod inside;
mod listed;
mod locate;
mod message;
mod plain;
mod trials;

use crate::compare::{COLOUR_TOLERANCE, POSITION_TOLERANCE, colour_difference, position_difference};
use crate::language::Text;
use crate::render::Sample;
use crate::report::{AdviceLine, FrameResult, Hints, Hypothesis, OwnValues, ProbeResult, Repair, RubricLine};
use crate::source::Source;
use advice::Beyond;
use cause::{Cause, belongs, cause, kept};
pub use fresh::Fresh;
pub use inside::Recorded;
use message::Facts;
use reference::Assignment;
use reference::equation::DISCARDED;
use reference::interpreter::Stage;
use reference::probes::{Crossings, EdgeDefect, Pictured, Probe, ProbeSet};
use reference::traced::TracedProgram;

/// Mistakes that are told from other things than the colours alone.
const POSITION_CHANGED: &str = "position-changed";
const CONSTANTS_CHANGED: &str = "constants-changed";

/// What a rendering showed.
#[derive(Clone, Copy, Debug)]
pub struct Evidence<'a> {
    /// The homework.
    pub assignment: &'a Assignment,
    /// The student's text.
    pub source: &'a Source,
    /// All that was handed in, each text with its stage.
    pub sources: &'a [(Stage, &'a Source)],
    /// The frames, compared.
    pub frames: &'a [FrameResult],
    /// The probes that judge.
    pub probes: &'a ProbeSet,
    /// What the shader computed at each of them, in their order.
    pub samples: &'a [Sample],
    /// Those that nobody knows beforehand.
    pub fresh: Fresh<'a>,
    /// Rows of probes across edges, and what the shader computed there; `None` where the homework does not judge by them.
    pub across: Option<(&'a Crossings, &'a [Sample])>,
    /// The line where a negative number was raised to a power, where one was.
    pub undefined: Option<u32>,
    /// The program, to be run step by step; `None` where it has something that the interpreter does not know.
    pub traced: Option<&'a TracedProgram>,
    /// What it computes at some of the probes, beside what the right answer computes.
    pub recorded: &'a Recorded,
    /// The probes that advice comes from.
    pub beyond: &'a [Beyond],
    /// How much the messages help.
    pub hints: Hints,
}

impl<'a> Evidence<'a> {
    /// The numbers that stand in the texts.
    fn numbers(&self) -> Vec<f64> {
        let texts = self.sources.iter().map(|(_, source)| source.code());
        texts.flat_map(reference::interpreter::numbers).collect()
    }

    /// The text of a stage, and the file that was handed out for it.
    fn text(&self, stage: Option<Stage>) -> (&'a Source, &'a str) {
        let own = |known: Stage| stage == Some(known);
        let source = self.sources.iter().find(|(known, _)| own(*known)).map_or(self.source, |(_, source)| source);
        let files = &self.assignment.files;
        let file = files.iter().find(|file| own(file.stage)).unwrap_or(&files[0]);
        (source, file.starter_shader())
    }
}

impl Evidence<'_> {
    /// The text of the fragment stage, where it has the word `discard`.
    fn source_that_discards(&self) -> Option<&Source> {
        let fragment = self.sources.iter().find(|(stage, _)| *stage == Stage::Fragment);
        fragment.map(|(_, source)| *source).filter(|source| source.words().any(|(_, word)| word == "discard"))
    }
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
    pub advice: Vec<AdviceLine>,
    /// The changes of the text by which all becomes right, where they are known.
    pub repairs: Vec<Repair>,
    /// The equation that computes what the shader computes, where one is known.
    pub explanation: Option<Vec<Hypothesis>>,
    /// The probes in figures.
    pub probes: ProbeResult,
}

impl Diagnosis {
    /// What it is worth.
    pub fn points(&self) -> f64 {
        self.rubric.iter().map(|line| line.points).sum()
    }
}

/// Judges the evidence.
pub fn diagnose(evidence: &Evidence<'_>) -> Diagnosis {
    let probes = compare_probes(evidence);
    // A fragment stage moves nothing: what it does to the picture is the colour's affair.
    let shape = shape_agrees(evidence, &probes) || !evidence.assignment.hands_in(Stage::Vertex);
    let cause = cause(evidence, shape).unless_refuted(evidence).unless_nothing_is_drawn(evidence);
    let cause = cause.unless_absent(evidence, shape).but_for_right_terms(evidence).unless_free(evidence, shape);
    let mut mistakes = cause.ids();
    // Where no line of the rubric is about the position, a mistake that is found says what moved.
    let Evidence { assignment, .. } = *evidence;
    let mut of_position = assignment.rubric.iter().filter(|line| assignment.judges_position(line)).peekable();
    let is_said = match of_position.peek() {
        Some(_) => of_position.any(|line| mistakes.iter().any(|id| kept(assignment, line, shape, &cause, id) < 1.0)),
        None => !mistakes.is_empty(),
    };
    if !shape && !is_said {
        mistakes.insert(0, POSITION_CHANGED.into());
    }
    let course = course(evidence, mistakes.is_empty());
    mistakes.extend(course.filter(|id| !mistakes.iter().any(|other| share_a_line(evidence.assignment, id, other))));
    let lines = &evidence.assignment.rubric;
    let facts = if mistakes.is_empty() { Facts::default() } else { Facts::of(evidence, &cause, &mistakes) };
    let judged = lines.iter().map(|line| judge(evidence, &facts, line, shape, &cause, &mistakes));
    let rubric: Vec<RubricLine> = judged.collect();
    let advice = if mistakes.is_empty() && evidence.hints > Hints::None { advice::find(evidence) } else { Vec::new() };
    Diagnosis {
        is_right: mistakes.is_empty(),
        rubric,
        advice,
        mistakes,
        repairs: cause.repairs().filter_map(|repaired| repaired.shown(evidence)).collect(),
        explanation: cause.explanation(),
        probes: probes.result,
    }
}

/// The diagnosis of an answer that agrees everywhere; `None` for any other, without a search for mistakes.
pub fn agreement(evidence: &Evidence<'_>) -> Option<Diagnosis> {
    let agrees = evidence.frames.iter().all(FrameResult::agrees) && agrees_at_probes(evidence);
    agrees.then(|| diagnose(evidence)).filter(|diagnosis| diagnosis.is_right)
}

/// Whether every sample has the colour that is right at its probe.
pub fn agrees_at_probes(evidence: &Evidence<'_>) -> bool {
    let samples: Vec<[f64; 3]> = evidence.samples.iter().map(Sample::colour_f64).collect();
    reference::fit::is_right(evidence.probes, &samples, COLOUR_TOLERANCE)
}

/// What a wrong answer computes on its way at places of a frame, beside what it should. `rubric`: what the report says of its lines.
pub fn own_values(
    evidence: &Evidence<'_>,
    frame: u32,
    pictured: &[Pictured],
    rubric: &[RubricLine],
) -> Option<OwnValues> {
    let stage = |line: &RubricLine| {
        let named = evidence.sources.iter().find(|(_, source)| line.file.as_ref() == Some(&source.facts.name));
        named.or(evidence.sources.first()).map(|(stage, _)| *stage)
    };
    let said: Vec<_> = rubric.iter().filter_map(|line| Some((stage(line)?, line.line?))).collect();
    inside::own_values(evidence, frame, pictured, &said)
}

/// The mistake that the way over edges shows. That of an answer that is wrong elsewhere may go back for that reason.
fn course(evidence: &Evidence<'_>, is_right_elsewhere: bool) -> Option<String> {
    let gradual = evidence.assignment.gradual.as_ref()?;
    let (crossings, samples) = evidence.across?;
    let colours: Vec<[f64; 3]> = samples.iter().map(Sample::colour_f64).collect();
    match crossings.course(&colours)? {
        EdgeDefect::Abrupt => Some(gradual.abrupt.clone()),
        EdgeDefect::Uneven => is_right_elsewhere.then(|| gradual.uneven.clone()),
    }
}

/// Whether two mistakes cost points of the same line: then what explains the samples says more than their course.
fn share_a_line(assignment: &Assignment, a: &str, b: &str) -> bool {
    let costs = |id: &str, line: &str| assignment.mistake(id).is_some_and(|mistake| mistake.keeps(line) < 1.0);
    assignment.rubric.iter().any(|line| costs(a, &line.id) && costs(b, &line.id))
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
        seed: evidence.fresh.probes.seed,
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
    let scale = position_scale(evidence);
    let is_elsewhere =
        |probe: &Probe, sample: &Sample| position_difference(probe.position, sample, scale) > POSITION_TOLERANCE;
    // What is thrown away leaves holes in what is drawn, what is kept fills them, and neither moves anything.
    let is_hole =
        |(probe, sample): (&Probe, &Sample)| (probe.colour == DISCARDED) != (DISCARDED == sample.colour_f64().into());
    let has_other_holes = evidence.probes.iter().zip(evidence.samples).any(is_hole);
    probes.positions_agree
        && (has_other_holes || evidence.frames.iter().all(FrameResult::shape_agrees))
        && !evidence.fresh.refutes_each(is_elsewhere)
}

/// Judges one line of the rubric.
fn judge(
    evidence: &Evidence<'_>,
    facts: &Facts,
    line: &reference::assignment::RubricItem,
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
        file: told.file,
        line: told.line,
        graded: None,
    }
}
