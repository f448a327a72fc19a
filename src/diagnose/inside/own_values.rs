//! What the student's own statements compute at a few places, beside what they should.
//!
//! A statement should compute what the right answer has a name for, where it does so at every place that is looked at, or where
//! all that is seen becomes right with that in its place. Of any other statement nothing is said: it may be another way to the
//! same end.

mod places;
mod standing;
mod written;

use super::search::Search;
use super::{Evidence, Stage, What, within};
use crate::report::{Hints, OwnValues, ValueLine, ValuePlace};
use glam::DVec3;
use places::{ShownPlace, shown_in, shown_of_probes};
use reference::equation::DISCARDED;
use reference::interpreter::Scalar;
use reference::interpreter::trace::{Event, Site};
use reference::probes::Pictured;
use reference::traced::Place;
use standing::{StatementStanding, Trial};
use written::numbers;

/// So many statements are shown at most, so that a report stays small.
const MOST_LINES: usize = 40;

/// With more statements than these only the first place and the last are shown, for the same reason.
const LINES_OF_ALL_PLACES: usize = 24;

/// Larger values, as arrays are, have no place in a table: a matrix has so many numbers at most.
const MOST_NUMBERS: usize = 16;

/// What a wrong answer computes at some of these places of a frame; at probes, where the frame shows nothing wrong. `lines`: those that
/// the report speaks of. `None` where the text cannot be run, or nothing is wrong at any place that is looked at.
pub(in crate::diagnose) fn own_values(
    evidence: &Evidence<'_>,
    frame: u32,
    pictured: &[Pictured],
    lines: &[(Stage, u32)],
) -> Option<OwnValues> {
    let all: Vec<ShownPlace<'_>> = match shown_in(evidence, pictured) {
        found if found.iter().any(|shown| !shown.is_right) => found,
        _ => shown_of_probes(evidence)?,
    };
    let places: Vec<Place<'_>> = all.iter().map(|shown| shown.place).collect();
    let look = |search: &mut Search<'_, '_>| {
        let first = search.count - all.len();
        let mut found = search.followed(first, lines);
        found.truncate(MOST_LINES);
        let seen = |seen: &[DVec3], at: usize| match seen[first + at] {
            DISCARDED => Vec::new(),
            colour => numbers(&colour.to_array()),
        };
        let place = |(at, shown): (usize, &ShownPlace<'_>)| ValuePlace {
            frame: shown.at.map(|_| frame),
            at: shown.at.map(|at| at.map(|side| (side * 1e4).round() / 1e4)),
            pixel: shown.pixel,
            yours: seen(&search.own.colours, at),
            right: seen(&search.wanted.colours, at),
            agrees: shown.is_right,
        };
        Some(OwnValues { places: all.iter().enumerate().map(place).collect(), lines: found })
    };
    let mut found = within(evidence, evidence.assignment, &[], &places, look)??;
    if found.lines.len() > LINES_OF_ALL_PLACES {
        found.keep_ends();
    }
    (!found.lines.is_empty()).then_some(found)
}
impl Search<'_, '_> {
    /// The statements of all stages with their values from the place `first` on.
    fn followed(&mut self, first: usize, said: &[(Stage, u32)]) -> Vec<ValueLine> {
        let mut found = Vec::new();
        let mut trial = Trial { left: standing::MOST_TRIED, before: self.own.colours.clone() };
        for stage in [Stage::Vertex, Stage::Fragment] {
            for (site, events) in self.statements(stage) {
                let own = &self.theirs.stage(stage).sites()[site];
                let (is_constant, is_said) = (own.function.is_none(), said.contains(&(stage, own.line)));
                let standing = match self.evidence.hints {
                    Hints::Full => self.standing(stage, site, &events, is_said, &mut trial),
                    Hints::None | Hints::Gentle => StatementStanding::Unknown,
                };
                // Constants of the file are given before anything runs: they count where they are wrong.
                if !is_constant || matches!(standing, StatementStanding::Wrong(_)) {
                    found.extend(self.line(stage, site, &events, &standing, first));
                }
            }
        }
        found
    }

    /// The assignments that are reached, and what functions give back, each with its events, in the order in which they run last.
    fn statements(&self, stage: Stage) -> Vec<(usize, Vec<usize>)> {
        let Some(trace) = self.trace(stage) else { return Vec::new() };
        let sites = self.theirs.stage(stage).sites();
        let mut is_operand = vec![false; sites.len()];
        sites.iter().flat_map(|site| &site.operands).for_each(|operand| is_operand[*operand] = true);
        let is_returned = |number: usize, site: &Site| {
            let is_called = site.function.as_deref().is_some_and(|function| function != "main");
            is_called && site.is_used && !is_operand[number] && site.kind.scalar() == Some(Scalar::Float)
        };
        let is_shown = |number: usize| {
            let site = &sites[number];
            site.line > 0 && (matches!(site.what, What::Assign { .. }) || is_returned(number, site))
        };
        let mut found: Vec<(usize, Vec<usize>)> = Vec::new();
        for (number, event) in trace.events.iter().enumerate().filter(|(_, event)| is_shown(event.site)) {
            match found.iter_mut().find(|(site, _)| *site == event.site) {
                Some((_, events)) => events.push(number),
                None if event.values.len() <= MOST_NUMBERS => found.push((event.site, vec![number])),
                None => {}
            }
        }
        found.sort_by_key(|(_, events)| events.last().copied());
        found
    }

    /// The lane of a place: of a vertex stage before a fragment stage, that of the corner which is nearest.
    pub(super) fn lane(&self, stage: Stage, event: &Event, at: usize) -> usize {
        let each = event.lanes.len() / self.count.max(1);
        let corner = match &self.places[at].probe.spot {
            Some(spot) if stage == Stage::Vertex => {
                let shares = spot.weights;
                (0..each.min(3)).rev().max_by(|a, b| shares[*a].total_cmp(&shares[*b])).unwrap_or(0)
            }
            _ => 0,
        };
        at * each + corner
    }
}

/// The variable that a statement gives a value, and whether it gives a part of it; `return` where a function gives it back.
fn variable(site: &Site) -> (&str, bool) {
    match &site.what {
        What::Assign { name, is_part } => (name, *is_part),
        _ => ("return", false),
    }
}
