//! The lines of the rubric whose value the text computes right.

use super::quantities::at_last_corner;
use super::search::Search;
use super::walk::{made_of, roots};
use super::{FUEL_OF_TRACE, Stage};
use crate::diagnose::addends::{ADDED, OVERFLOWING, passes, raised};
use crate::diagnose::columns::{ScalarColumns, is_constant, is_equal, is_number, is_same};
use crate::diagnose::trials::StageChanges;
use glam::DVec3;
use reference::interpreter::trace::{Event, Trace};
use reference::traced::{Bench, Seen, TracedProgram};

/// The solution with a feature's value or with what is there instead, and the stage and the site of that.
type FeatureValue = (TracedProgram, Stage, usize);

/// What a line judges.
struct Feature {
    /// What the text may compute: the value, what it has more than what is there without the feature, or what that makes of all.
    values: Vec<ScalarColumns>,
    lanes: Vec<bool>,
    /// By how much all that is seen moves when something is added to the value.
    moves: Vec<DVec3>,
}

impl Search<'_, '_> {
    /// The ids of the lines of which the text computes, on the way of what is seen, the value that a solution without them lacks.
    pub fn computed_lines(&self) -> Vec<String> {
        self.lines_with(|search, feature| !search.computing(feature).is_empty())
    }

    /// The ids of those of which it also adds the value to what is seen as it is.
    pub fn added_lines(&self) -> Vec<String> {
        self.lines_with(|search, feature| {
            search.computing(feature).into_iter().any(|(stage, at)| search.adds(stage, at, feature))
        })
    }

    /// The id of the line whose feature a value is in: of those on the way of whose value it is, the one with the shortest way.
    pub fn line_around(&self, value: &ScalarColumns) -> Option<String> {
        let way = |line: usize| {
            let [(program, stage, site), _] = self.assignment.feature_values(line)?;
            let mut bench = Bench::new(self.assignment, &program, self.places, self.in_quads, FUEL_OF_TRACE)?;
            let trace = bench.trace(&StageChanges::default())?.1[stage as usize].take()?;
            let events: Vec<usize> = (0..trace.events.len()).filter(|at| trace.events[*at].site == site).collect();
            let way = made_of(&trace, &events);
            let has_it = way.iter().any(|event| is_equal(&trace.events[*event].values, value));
            has_it.then_some(way.len())
        };
        let rubric = self.assignment.rubric.iter().enumerate();
        let mut around: Vec<(usize, &str)> =
            rubric.filter_map(|(number, line)| Some((way(number)?, line.id.as_str()))).collect();
        around.sort_unstable();
        match around[..] {
            [(shortest, id), ref others @ ..] if others.first().is_none_or(|(other, _)| *other > shortest) => {
                Some(id.to_owned())
            }
            _ => None,
        }
    }

    fn lines_with(&self, is_it: impl Fn(&Self, &Feature) -> bool) -> Vec<String> {
        let rubric = self.assignment.rubric.iter().enumerate();
        let has_it = |line: usize| {
            let Some(programs) = self.assignment.feature_values(line) else { return false };
            self.feature(&programs).is_some_and(|own| is_it(self, &own))
                || self.contribution(&programs).is_some_and(|own| is_it(self, &own))
        };
        let own = rubric.filter(|(line, _)| has_it(*line));
        own.map(|(_, line)| line.id.clone()).collect()
    }

    fn feature(&self, [with, without]: &[FeatureValue; 2]) -> Option<Feature> {
        let (event, moves) = self.value_of(with)?;
        let (instead, _) = self.value_of(without)?;
        let more =
            |(own, instead): (&Vec<f64>, &Vec<f64>)| own.iter().zip(instead).map(|(own, less)| own - less).collect();
        let more: ScalarColumns = event.values.iter().zip(&instead.values).map(more).collect();
        let is_telling = |columns: &ScalarColumns| !is_any_number(columns);
        let values: Vec<ScalarColumns> = [event.values, more].into_iter().filter(is_telling).collect();
        let feature = Feature { values, lanes: event.lanes, moves };
        (!feature.values.is_empty()).then_some(feature)
    }

    /// What the line's feature adds to all that is seen: a text may sum up what the solution adds piece by piece.
    fn contribution(&self, programs: &[FeatureValue; 2]) -> Option<Feature> {
        if self.in_quads {
            return None;
        }
        let [with, without] = programs.each_ref().map(|(program, ..)| {
            let bench = Bench::new(self.assignment, program, self.places, self.in_quads, FUEL_OF_TRACE)?;
            Some(bench.bounded(OVERFLOWING).with(&StageChanges::default())?.colours)
        });
        let more: Vec<DVec3> = with?.iter().zip(without?).map(|(with, without)| *with - without).collect();
        let channel = |at: usize| more.iter().map(|more| more[at]).collect();
        let values: ScalarColumns = (0..3).map(channel).collect();
        let is_telling = !is_any_number(&values);
        let moves = vec![DVec3::from(ADDED); more.len()];
        is_telling.then(|| Feature { values: vec![values], lanes: vec![true; more.len()], moves })
    }

    /// The same where the fragment stage is handed what the vertex stage of a right answer computes: of the last corner.
    fn at_the_last_corner(&self, feature: &Feature) -> Option<Feature> {
        let lanes = self.trace(Stage::Fragment)?.events.first()?.lanes.len();
        let is_flat = self.quantities.all.iter().any(|own| own.stage != own.computed_in);
        let values = feature.values.iter().map(|value| value.iter().map(|own| at_last_corner(own, lanes)).collect());
        let lanes = at_last_corner(&feature.lanes, lanes);
        is_flat.then(|| Feature { values: values.collect(), lanes, moves: feature.moves.clone() })
    }

    /// The only value of a site, and by how much all that is seen moves when something is added to it.
    fn value_of(&self, (program, stage, site): &FeatureValue) -> Option<(Event, Vec<DVec3>)> {
        let mut bench = Bench::new(self.assignment, program, self.places, self.in_quads, FUEL_OF_TRACE)?;
        let (before, traces) = bench.trace(&StageChanges::default())?;
        let trace = traces[*stage as usize].as_ref()?;
        let mut events = (0..trace.events.len()).filter(|at| trace.events[*at].site == *site);
        let (at, None) = (events.next()?, events.next()) else { return None };
        let after = bench.with(&raised(*stage, trace, at))?;
        Some((trace.events[at].clone(), moved(&before, &after)))
    }

    /// Where the text computes the value.
    fn computing(&self, feature: &Feature) -> Vec<(Stage, usize)> {
        let handed_over = self.at_the_last_corner(feature);
        let mut found = Vec::new();
        for stage in [Stage::Vertex, Stage::Fragment] {
            let Some(trace) = self.trace(stage) else { continue };
            let alike = std::iter::once(feature).chain(handed_over.as_ref().filter(|_| stage == Stage::Fragment));
            let is_one = |at: &usize| alike.clone().any(|feature| is_it(&trace.events[*at], feature));
            found.extend(made_of(trace, &roots(trace)).into_iter().filter(is_one).map(|at| (stage, at)));
        }
        found
    }

    /// Whether all that is seen moves as a right answer's does when something is added to an event. What is cut off tells nothing.
    fn adds(&self, stage: Stage, at: usize, feature: &Feature) -> bool {
        let Some(trace) = self.trace(stage) else { return false };
        let Some(after) = self.seen_raised(stage, trace, at) else { return false };
        let places = self.own.colours.iter().zip(&after.colours).zip(&feature.moves);
        let passed: Vec<Option<bool>> =
            places.map(|((before, after), wanted)| passes(*before, *after, *wanted)).collect();
        !passed.contains(&Some(false)) && passed.contains(&Some(true))
    }

    fn seen_raised(&self, stage: Stage, trace: &Trace, at: usize) -> Option<Seen> {
        let event = &trace.events[at];
        let is_only = trace.events.iter().filter(|other| other.site == event.site).count() == 1;
        let mut bench = Bench::new(self.assignment, self.theirs, self.places, self.in_quads, FUEL_OF_TRACE)?;
        if is_only { bench.with(&raised(stage, trace, at)) } else { None }
    }
}

fn moved(before: &Seen, after: &Seen) -> Vec<DVec3> {
    before.colours.iter().zip(&after.colours).map(|(before, after)| *after - *before).collect()
}

/// Whether an event is the value. What is nothing need not be computed.
fn is_it(event: &Event, feature: &Feature) -> bool {
    let is_value = |value: &ScalarColumns| {
        let is_nothing = |lane: usize| value.iter().take(3).all(|column| column[lane] == 0.0);
        let mut lanes = event.lanes.iter().zip(&feature.lanes).enumerate();
        event.lanes.len() == feature.lanes.len()
            && lanes.all(|(lane, (own, right))| *own || !right || is_nothing(lane))
            && is_same(event, value)
    };
    feature.values.iter().any(is_value)
}

/// Whether a value is the same everywhere, and no colour of three different channels: such a value is equal by chance.
fn is_any_number(columns: &ScalarColumns) -> bool {
    let channels: Vec<f64> = columns.iter().take(3).filter_map(|column| column.first().copied()).collect();
    let is_colour = matches!(channels[..], [red, green, blue] if !is_number(red, green) && !is_number(green, blue));
    is_constant(columns) && !is_colour
}
