//! Which line of the student's file a message speaks of, where the message is about a definition of the right answer.
//!
//! The interpreter of `reference` runs the text at some of the probes. A search for names in the text would not see that a
//! statement further down changes a value, or that a function or a variable of another name computes it.

use super::columns::{ScalarColumns, is_colour, is_constant, is_same, of_places};
use super::inside::{self, Finding, Flaw};
use super::trials::{FUEL_OF_TRACE, StageChanges, Trials, chosen, is_drawn, place};
use super::{Evidence, advice::Beyond};
use crate::source::Source;
use glam::DVec3;
use reference::Assignment;
use reference::equation::EquationVariant;
use reference::interpreter::Stage;
use reference::interpreter::trace::{Event, Site, Trace, ValueChange, What};
use reference::mistake::FoundMistake;
use reference::traced::{Bench, Place, TracedProgram};

mod lines;
mod search;

pub(super) use lines::{Words, is_handed_out};

/// A place in the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Located {
    /// The line, from 1.
    pub line: u32,
    /// The variable that is given the value there.
    pub name: Option<String>,
    /// What the value is to the colour.
    pub role: MistakeOrigin,
    /// The stage whose text it is; `None` where there is only one.
    pub stage: Option<Stage>,
}

impl Located {
    /// A line of which no more is known.
    pub fn at(line: u32) -> Self {
        Self { line, name: None, role: MistakeOrigin::Wrong, stage: None }
    }
}

/// How the shader comes by what the mistake is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum MistakeOrigin {
    /// The place computes it, and what it computes is not right.
    Wrong,
    /// The place computes it, and it is 0 at every probe.
    Zero,
    /// Nothing that the colour depends on stands for it; the place is the sum in which it is missing.
    Absent,
    /// It makes no difference to the colour, and it is not known why; the place is the sum.
    Lost,
    /// The place writes over it.
    Overwritten,
    /// The place writes over what is right, and makes nothing of it.
    LeftBehind,
}

/// The line of the last statement that gives the position.
pub(super) fn last_position(program: &TracedProgram) -> Option<u32> {
    let gives = |site: &&Site| matches!(&site.what, What::Assign { name, .. } if name == "gl_Position");
    program.stage(Stage::Vertex).sites().iter().rfind(gives).map(|site| site.line)
}

/// The file's only stage at some of the probes, with every value on the way to the colour.
pub(super) struct TracedProbes<'a> {
    /// The homework, with the student's own constants.
    pub assignment: &'a Assignment,
    source: &'a Source,
    stage: Stage,
    sites: &'a [Site],
    trace: Trace,
    trials: Trials<'a>,
    places: Vec<Place<'a>>,
    /// What is seen at each place.
    seen: Vec<DVec3>,
    /// How many samples each place has.
    each: usize,
}

impl<'a> TracedProbes<'a> {
    /// Runs it at wrong and at right samples. `None` where the answer is known by no definitions, or does not compute what
    /// the driver computed.
    pub fn new(evidence: &Evidence<'a>, assignment: &'a Assignment) -> Option<Self> {
        let chosen = chosen(evidence);
        let places = chosen.iter().map(|at| place(evidence, *at)).collect();
        let source = evidence.text(assignment.equation.reads().stage()).0;
        let points = Self::of(source, evidence.traced?, assignment, places)?;
        is_drawn(evidence, &chosen, &points.seen).then_some(points)
    }

    /// Runs it under a circumstance of advice. `program`: the text with the circumstance's constants.
    pub fn beyond(evidence: &Evidence<'a>, beyond: &'a Beyond, program: &'a TracedProgram) -> Option<Self> {
        Self::of(evidence.source, program, &beyond.assignment, beyond.places())
    }

    fn of(
        source: &'a Source,
        program: &'a TracedProgram,
        assignment: &'a Assignment,
        places: Vec<Place<'a>>,
    ) -> Option<Self> {
        let stage = assignment.equation.reads().stage()?;
        if places.is_empty() {
            return None;
        }
        let in_quads = program.needs_quads(assignment);
        let mut bench = Bench::new(assignment, program, &places, in_quads, FUEL_OF_TRACE)?;
        let (seen, mut traces) = bench.trace(&StageChanges::default())?;
        let trace = traces[stage as usize].take()?;
        let trials = Trials::new(assignment, program, &places, in_quads)?;
        let sites = program.stage(stage).sites();
        let each = if in_quads { 4 } else { 1 };
        let seen = seen.colours;
        Some(Self { assignment, source, stage, sites, trace, trials, places, seen, each })
    }

    /// The student's own names for the definitions, in the equation's order: of what is right, or else of what it is with these mistakes.
    pub fn names(&self, found: &[FoundMistake]) -> Vec<Option<&'a str>> {
        let right = self.definitions(&self.assignment.equation.right());
        let wrong = self.assignment.variant(found).map(|variant| self.definitions(&variant)).unwrap_or_default();
        // What is the same everywhere, or no number, equals much by chance.
        let is_telling = |own: &ScalarColumns| !is_constant(own) && own.iter().flatten().all(|value| value.is_finite());
        let name = |(at, right): (usize, &ScalarColumns)| {
            let is_other = |wrong: &&ScalarColumns| *wrong != right && is_telling(wrong);
            self.name_of(right).or_else(|| wrong.get(at).filter(is_other).and_then(|own| self.name_of(own)))
        };
        right.iter().enumerate().map(name).collect()
    }

    /// The name of a variable that holds a definition at every point.
    fn name_of(&self, right: &ScalarColumns) -> Option<&'a str> {
        // A colour may have three components instead of four, and nothing else.
        let fits = |event: &&Event| event.values.len() <= right.len() && is_same(event, right);
        let mut holding = self.trace.events.iter().filter(fits);
        holding.find_map(|event| match &self.sites[event.site] {
            Site { what: What::Assign { name, is_part: false }, .. } => Some(name.as_str()),
            Site { what: What::Read(name), is_part: false, .. } => Some(name.as_str()),
            _ => None,
        })
    }

    /// The definitions of a variant of the equation at each point, in the equation's order.
    fn definitions(&self, variant: &EquationVariant<'_>) -> Vec<ScalarColumns> {
        let outcomes: Vec<_> =
            self.places.iter().map(|at| variant.evaluate(at.uniforms, &at.probe.attributes)).collect();
        let columns = |name: &str| -> ScalarColumns {
            let values: Vec<_> = outcomes.iter().filter_map(|outcome| outcome.get(name)).collect();
            of_places(&values, self.each)
        };
        self.assignment.equation.definitions().iter().map(|definition| columns(&definition.name)).collect()
    }

    /// The colours that a variant shows.
    fn colours(&self, variant: &EquationVariant<'_>) -> Vec<DVec3> {
        let colour = |at: &Place<'_>| variant.evaluate(at.uniforms, &at.probe.attributes).colour();
        self.places.iter().map(colour).collect()
    }

    /// Whether the colour is `wanted` at every point when this is changed.
    fn becomes(&mut self, wanted: &[DVec3], change: impl IntoIterator<Item = ValueChange>) -> bool {
        let mut changes = StageChanges::default();
        changes[self.stage as usize].extend(change);
        self.trials.holds(&changes, &|seen, count| {
            seen.colours.iter().zip(wanted).take(count).all(|(own, wanted)| is_colour(*wanted, *own))
        })
    }

    /// Whether the student wrote the line: what was handed out is right.
    fn is_own(&self, event: &Event) -> bool {
        let files = &self.assignment.files;
        let file = files.iter().find(|file| file.stage == self.stage).unwrap_or(&files[0]);
        !is_handed_out(self.source, self.sites[event.site].line, file.starter_shader())
    }

    /// The place of an event.
    fn located(&self, event: usize, role: MistakeOrigin) -> Located {
        let site = self.trace.events[event].site;
        let name = inside::variable(self.sites, site);
        Located { line: self.sites[site].line, name, role, stage: None }
    }
}

/// What is known of the places of all mistakes together.
#[derive(Clone, Copy, Default)]
pub(super) struct KnownPlaces<'k> {
    /// The one slip of the text without which all is right.
    pub slip: Option<&'k Located>,
    /// The one place at which all is mended.
    pub only: Option<&'k Finding>,
}

/// Where mistake `index` of those that were found stands: the place of a value, or of what is 0 or missing. `points`: where the
/// answer is known by definitions.
pub(super) fn mistake(
    evidence: &Evidence<'_>,
    assignment: &Assignment,
    points: &mut Option<TracedProbes<'_>>,
    found: &[FoundMistake],
    index: usize,
    known: KnownPlaces<'_>,
) -> Option<Located> {
    let missing = points.as_mut().and_then(|points| points.missing(found, index));
    let is_zero = missing.as_ref().is_some_and(|missing| missing.role == MistakeOrigin::Zero);
    // One slip of the text is what the student did, also where it shows as several mistakes, or in what is made of it.
    if let Some(slip) = known.slip {
        let role = if is_zero { MistakeOrigin::Zero } else { MistakeOrigin::Wrong };
        return Some(Located { role, ..slip.clone() });
    }
    if is_zero {
        return missing;
    }
    // What returns early is missing wherever a condition holds.
    if let Some(condition) = points.as_ref().and_then(|points| points.condition(found, index)) {
        return Some(condition);
    }
    let one = known.only.cloned().or_else(|| inside::find_one(evidence, assignment, found, index));
    match (missing, one) {
        (_, Some(one)) if one.flaw == Flaw::Overwrites => {
            Some(Located { role: MistakeOrigin::Overwritten, ..one.located() })
        }
        (Some(missing), _) => Some(missing),
        (None, one) => one.filter(|one| one.is_telling).map(|one| one.located()),
    }
}
