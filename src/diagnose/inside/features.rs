//! The lines of the rubric whose value the text computes right.

use super::quantities::at_last_corner;
use super::search::Search;
use super::walk::{made_of, roots};
use super::{FUEL_OF_TRACE, Stage};
use crate::diagnose::addends::{ADDED, OVERFLOWING, passes, raised};
use crate::diagnose::columns::{ScalarColumns, is_constant, is_number, is_same};
use crate::diagnose::trials::StageChanges;
use glam::DVec3;
use reference::feature::FeatureValue;
use reference::interpreter::trace::{Event, Trace};
use reference::traced::{Bench, Seen};

/// A loop of more turns is not followed.
const MOST_TURNS: usize = 16;

/// What a line judges.
struct FeatureTrace {
    /// What the text may compute, turn by turn of a loop: the value, what it has more than what is there without the feature, or what that
    /// makes of all.
    values: Vec<Vec<ScalarColumns>>,
    /// Where each turn is computed.
    lanes: Vec<Vec<bool>>,
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
            search.computing(feature).into_iter().any(|(stage, events)| search.adds(stage, &events, feature))
        })
    }

    /// The ids of those of which it computes the value of some turns of a loop, and not of all.
    pub fn lines_of_some_turns(&self) -> Vec<String> {
        self.lines_with(|search, feature| {
            let count = feature.lanes.len();
            let way = |trace| -> Vec<usize> { made_of(trace, &roots(trace)).into_iter().collect() };
            let traces = [Stage::Vertex, Stage::Fragment].into_iter().filter_map(|stage| search.trace(stage));
            let ways: Vec<(&Trace, Vec<usize>)> = traces.map(|trace| (trace, way(trace))).collect();
            let has = |turn: usize| {
                ways.iter().any(|(trace, way)| way.iter().any(|at| is_it(&trace.events[*at], feature, turn)))
            };
            let computed = (0..count).filter(|turn| has(*turn)).count();
            0 < computed && computed < count
        })
    }

    fn lines_with(&self, is_it: impl Fn(&Self, &FeatureTrace) -> bool) -> Vec<String> {
        let rubric = self.assignment.rubric.iter().enumerate();
        let has_it = |line: usize| {
            let Some(programs) = self.assignment.feature_values(line) else { return false };
            self.feature(&programs).is_some_and(|own| is_it(self, &own))
                || self.contribution(&programs).is_some_and(|own| is_it(self, &own))
        };
        let own = rubric.filter(|(line, _)| has_it(*line));
        own.map(|(_, line)| line.id.clone()).collect()
    }

    fn feature(&self, [with, without]: &[FeatureValue; 2]) -> Option<FeatureTrace> {
        let (turns, moves) = self.value_of(with)?;
        let (instead, _) = self.value_of(without)?;
        if turns.len() != instead.len() {
            return None;
        }
        let less = |(own, less): (&Vec<f64>, &Vec<f64>)| own.iter().zip(less).map(|(own, less)| own - less).collect();
        // One number is the same in all channels.
        let more =
            |(own, instead): (&Event, &Event)| own.values.iter().zip(instead.values.iter().cycle()).map(less).collect();
        let more: Vec<ScalarColumns> = turns.iter().zip(&instead).map(more).collect();
        let is_telling = |turns: &Vec<ScalarColumns>| !turns.iter().all(is_any_number);
        let values = [turns.iter().map(|turn| turn.values.clone()).collect(), more];
        let values: Vec<Vec<ScalarColumns>> = values.into_iter().filter(is_telling).collect();
        let feature = FeatureTrace { values, lanes: turns.into_iter().map(|turn| turn.lanes).collect(), moves };
        (!feature.values.is_empty()).then_some(feature)
    }

    /// What the line's feature adds to all that is seen: a text may sum up what the solution adds piece by piece.
    fn contribution(&self, programs: &[FeatureValue; 2]) -> Option<FeatureTrace> {
        if self.in_quads {
            return None;
        }
        let [with, without] = programs.each_ref().map(|own| {
            let bench = Bench::new(self.assignment, &own.program, self.places, self.in_quads, FUEL_OF_TRACE)?;
            Some(bench.bounded(OVERFLOWING).with(&StageChanges::default())?.colours)
        });
        let more: Vec<DVec3> = with?.iter().zip(without?).map(|(with, without)| *with - without).collect();
        let channel = |at: usize| more.iter().map(|more| more[at]).collect();
        let values: ScalarColumns = (0..3).map(channel).collect();
        let is_telling = !is_any_number(&values);
        let moves = vec![DVec3::from(ADDED); more.len()];
        is_telling.then(|| FeatureTrace { values: vec![vec![values]], lanes: vec![vec![true; more.len()]], moves })
    }

    /// The same where the fragment stage is handed what the vertex stage of a right answer computes: of the last corner.
    fn at_the_last_corner(&self, feature: &FeatureTrace) -> Option<FeatureTrace> {
        let lanes = self.trace(Stage::Fragment)?.events.first()?.lanes.len();
        let is_flat = self.quantities.all.iter().any(|own| own.stage != own.computed_in);
        let turn = |value: &ScalarColumns| value.iter().map(|own| at_last_corner(own, lanes)).collect();
        let values = feature.values.iter().map(|turns| turns.iter().map(turn).collect());
        let at_corner = |turn: &Vec<bool>| at_last_corner(turn, lanes);
        is_flat.then(|| FeatureTrace {
            values: values.collect(),
            lanes: feature.lanes.iter().map(at_corner).collect(),
            moves: feature.moves.clone(),
        })
    }

    /// The values of a site, turn by turn, and by how much all that is seen moves when something is added to each.
    fn value_of(&self, FeatureValue { program, stage, site, .. }: &FeatureValue) -> Option<(Vec<Event>, Vec<DVec3>)> {
        let mut bench = Bench::new(self.assignment, program, self.places, self.in_quads, FUEL_OF_TRACE)?;
        let (before, traces) = bench.trace(&StageChanges::default())?;
        let trace = traces[*stage as usize].as_ref()?;
        let turns: Vec<usize> = (0..trace.events.len()).filter(|at| trace.events[*at].site == *site).collect();
        if turns.is_empty() || turns.len() > MOST_TURNS {
            return None;
        }
        let after = bench.with(&raised(*stage, trace, &turns))?;
        Some((turns.into_iter().map(|at| trace.events[at].clone()).collect(), moved(&before, &after)))
    }

    /// Where the text computes the value: each time an event for each turn.
    fn computing(&self, feature: &FeatureTrace) -> Vec<(Stage, Vec<usize>)> {
        let handed_over = self.at_the_last_corner(feature);
        let mut found = Vec::new();
        for stage in [Stage::Vertex, Stage::Fragment] {
            let Some(trace) = self.trace(stage) else { continue };
            let alike = std::iter::once(feature).chain(handed_over.as_ref().filter(|_| stage == Stage::Fragment));
            let way: Vec<usize> = made_of(trace, &roots(trace)).into_iter().collect();
            found.extend(alike.flat_map(|feature| computing(trace, &way, feature)).map(|events| (stage, events)));
        }
        found
    }

    /// Whether all that is seen moves as a right answer's does when something is added to events. What is cut off tells nothing.
    fn adds(&self, stage: Stage, events: &[usize], feature: &FeatureTrace) -> bool {
        let Some(trace) = self.trace(stage) else { return false };
        let Some(after) = self.seen_raised(stage, trace, events) else { return false };
        let places = self.own.colours.iter().zip(&after.colours).zip(&feature.moves);
        let passed: Vec<Option<bool>> =
            places.map(|((before, after), wanted)| passes(*before, *after, *wanted)).collect();
        !passed.contains(&Some(false)) && passed.contains(&Some(true))
    }

    fn seen_raised(&self, stage: Stage, trace: &Trace, events: &[usize]) -> Option<Seen> {
        let is_own = |(at, event): (usize, &Event)| {
            events.contains(&at) || !events.iter().any(|own| trace.events[*own].site == event.site)
        };
        let mut bench = Bench::new(self.assignment, self.theirs, self.places, self.in_quads, FUEL_OF_TRACE)?;
        trace.events.iter().enumerate().all(is_own).then(|| bench.with(&raised(stage, trace, events)))?
    }
}

fn moved(before: &Seen, after: &Seen) -> Vec<DVec3> {
    before.colours.iter().zip(&after.colours).map(|(before, after)| *after - *before).collect()
}

/// The events on the way of what is seen that are the value, for each time an event for each turn: those of one statement, or one of
/// each written out.
fn computing(trace: &Trace, way: &[usize], feature: &FeatureTrace) -> Vec<Vec<usize>> {
    let is_turn = |at: &usize, turn: usize| is_it(&trace.events[*at], feature, turn);
    let count = feature.lanes.len();
    if count == 1 {
        return way.iter().filter(|at| is_turn(at, 0)).map(|at| vec![*at]).collect();
    }
    let first = way.iter().filter(|at| is_turn(at, 0));
    let of_loop = first.filter_map(|first| {
        let is_same = |at: &&usize| trace.events[**at].site == trace.events[*first].site;
        let events: Vec<usize> = way.iter().filter(is_same).copied().collect();
        (events.len() == count && events.iter().enumerate().all(|(turn, at)| is_turn(at, turn))).then_some(events)
    });
    let of_loops: Vec<Vec<usize>> = of_loop.collect();
    if !of_loops.is_empty() {
        return of_loops;
    }
    let written_out = (0..count).map(|turn| way.iter().copied().find(|at| is_turn(at, turn)));
    written_out.collect::<Option<Vec<usize>>>().into_iter().collect()
}

/// Whether an event is the value of a turn. What is nothing need not be computed.
fn is_it(event: &Event, feature: &FeatureTrace, turn: usize) -> bool {
    let lanes_of_right = &feature.lanes[turn];
    let is_value = |turns: &Vec<ScalarColumns>| {
        let value = &turns[turn];
        let is_nothing = |lane: usize| value.iter().take(3).all(|column| column[lane] == 0.0);
        let mut lanes = event.lanes.iter().zip(lanes_of_right).enumerate();
        event.lanes.len() == lanes_of_right.len()
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
