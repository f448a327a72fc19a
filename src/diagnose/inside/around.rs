//! The lines of the rubric within whose features a mistake is, by the values that come of it.

use super::FUEL_OF_TRACE;
use super::candidates::Mend;
use super::search::Search;
use super::walk::{made_of, roots};
use crate::diagnose::columns::{ScalarColumns, is_constant, is_equal};
use crate::diagnose::trials::StageChanges;
use reference::Assignment;
use reference::assignment::RubricItem;
use reference::feature::FeatureValue;
use reference::interpreter::trace::Trace;
use reference::traced::Bench;

/// Programs with more events are not compared.
const MOST_EVENTS: usize = 4_000;

/// A value that comes of a mistake.
#[derive(Clone, Copy, Debug)]
pub(super) struct ReachedValue<'v> {
    pub values: &'v ScalarColumns,
    /// Whether it is made of what is wrong, so that it is wrong as a whole: what a condition only decides of, and what is all that is
    /// seen, need not be.
    pub is_made_there: bool,
}

/// What the value of a line's feature is made of.
#[derive(Debug)]
pub(super) struct FeatureWay {
    /// The line's id.
    line: String,
    /// The value, turn by turn.
    values: Vec<ScalarColumns>,
    way: Vec<ScalarColumns>,
    /// What of that nothing else is made of.
    own: Vec<ScalarColumns>,
    /// What is computed in the text of the feature.
    within: Vec<ScalarColumns>,
    with: Trace,
    without: Trace,
}

impl FeatureWay {
    /// Whether another one is made of it.
    fn leads_to(&self, other: &Self) -> bool {
        self.values.iter().all(|value| has(&other.way, value))
    }

    /// Whether a value is computed in the solution and not without the feature.
    fn moves(&self, value: &ScalarColumns) -> bool {
        let computes = |trace: &Trace| trace.events.iter().any(|event| is_equal(&event.values, value));
        computes(&self.with) && !computes(&self.without)
    }
}

fn has(values: &[ScalarColumns], value: &ScalarColumns) -> bool {
    values.iter().any(|own| is_equal(own, value))
}

/// The one that goes into all the others.
fn innermost<'w>(around: &[&'w FeatureWay]) -> Option<&'w FeatureWay> {
    let is_it = |way: &&&FeatureWay| around.iter().all(|other| way.line == other.line || way.leads_to(other));
    around.iter().find(is_it).copied()
}

impl Search<'_, '_> {
    /// The ids of the lines within whose features values are that come of one mistake, in their order: of the first value that tells.
    /// One that only a feature is made of is within that, unless a later one is within another feature beside it. One that stands in
    /// a feature's text is within that as well, and one that is made of features concerns the last of these. Numbers that are the
    /// same everywhere tell nothing.
    pub fn lines_around<'v>(&self, values: impl IntoIterator<Item = ReachedValue<'v>>) -> Vec<String> {
        // All goes through what a line judges by a definition, such as a term.
        if !self.assignment.is_told_by_features() {
            return Vec::new();
        }
        let ways = self.features.get_or_init(|| self.feature_ways());
        // Beside a feature of which no value is known, only the first value tells.
        let is_known = |line: &RubricItem| ways.iter().any(|way| way.line == line.id);
        let mut rubric = self.assignment.rubric.iter().enumerate().filter(|(number, line)| {
            self.assignment.features[*number].is_some() && !self.assignment.judges_position(line)
        });
        let all_are_known = rubric.all(|(_, line)| is_known(line));
        let values = values.into_iter().take(if all_are_known { usize::MAX } else { 1 });
        let mut around: Vec<&FeatureWay> = Vec::new();
        for ReachedValue { values, is_made_there } in values.filter(|value| !is_constant(value.values)) {
            let owners: Vec<&FeatureWay> = ways.iter().filter(|way| has(&way.own, values)).collect();
            if let Some(way) = innermost(&owners) {
                around.push(way);
            } else if around.is_empty() && owners.is_empty() && is_made_there {
                let concerned = concerned(self.assignment, ways, values, all_are_known);
                if !concerned.is_empty() {
                    return concerned;
                }
            }
        }
        let Some(first) = around.first() else { return Vec::new() };
        // One goes into the other, or is a part of it.
        let is_related = |other: &&FeatureWay| first.leads_to(other) || other.leads_to(first);
        if around.iter().all(is_related) { vec![first.line.clone()] } else { Vec::new() }
    }

    /// What has to stand in a place.
    pub fn mended<'v>(&self, mend: &'v Mend) -> Option<ReachedValue<'v>> {
        let is_made_there = !self.is_whole(mend);
        mend.values.first().map(|values| ReachedValue { values, is_made_there })
    }

    fn feature_ways(&self) -> Vec<FeatureWay> {
        let traced = |FeatureValue { program, stage, .. }: &FeatureValue| -> Option<Trace> {
            let mut bench = Bench::new(self.assignment, program, self.places, self.in_quads, FUEL_OF_TRACE)?;
            let trace = bench.trace(&StageChanges::default())?.1[*stage as usize].take()?;
            Some(trace).filter(|trace| trace.events.len() <= MOST_EVENTS)
        };
        let way = |line: &RubricItem, number: usize| {
            let [own, instead] = self.assignment.feature_values(number)?;
            let (with, without) = (traced(&own)?, traced(&instead)?);
            let at = |is_it: &dyn Fn(usize) -> bool| -> Vec<usize> {
                (0..with.events.len()).filter(|event| is_it(with.events[*event].site)).collect()
            };
            let value = |event: usize| with.events[event].values.clone();
            let events = at(&|site| site == own.site);
            let within = at(&|site| own.within.contains(&site)).into_iter().map(value).collect();
            let way: Vec<ScalarColumns> = made_of(&with, &events).into_iter().map(value).collect();
            let left = made_of(&without, &roots(&without));
            let is_left =
                |value: &ScalarColumns| left.iter().any(|event| is_equal(&without.events[*event].values, value));
            let only = way.iter().filter(|value| !is_left(value)).cloned().collect();
            let values = events.into_iter().map(value).collect();
            Some(FeatureWay { line: line.id.clone(), values, way, own: only, within, with, without })
        };
        let rubric = self.assignment.rubric.iter().enumerate();
        rubric.filter_map(|(number, line)| way(line, number)).collect()
    }
}

/// The lines in whose text a value of the solution stands, or else of whose features it is made, where no other one of these comes later.
fn concerned(assignment: &Assignment, ways: &[FeatureWay], value: &ScalarColumns, all_are_known: bool) -> Vec<String> {
    let moving: Vec<&FeatureWay> = ways.iter().filter(|way| way.moves(value)).collect();
    let within: Vec<&FeatureWay> = moving.iter().filter(|way| has(&way.within, value)).copied().collect();
    if !within.is_empty() || !all_are_known {
        return innermost(&within).map(|way| way.line.clone()).into_iter().collect();
    }
    let is_last = |way: &&&FeatureWay| {
        let mut later = moving.iter().filter(|other| way.leads_to(other));
        later.all(|other| other.leads_to(way))
    };
    let last: Vec<String> = moving.iter().filter(is_last).map(|way| way.line.clone()).collect();
    // What one feature goes into is the rest of the colour, where a line judges that.
    if last.len() < 2 && assignment.rubric.iter().any(|line| assignment.judges_the_rest(line)) {
        return Vec::new();
    }
    last
}
