//! Several mistakes, each in a place of its own.
//!
//! A mistake hides those further on: what is computed from a wrong value is no right quantity, whatever is done with it. So the
//! first place is looked for whose value is wrong and whose operands are right, the right value is put there, and then the
//! next one is looked for, until everything that is seen is right.

use super::candidates::Mend;
use super::quantities::leaves;
use super::search::{Search, is_right};
use super::walk::{Suspect, suspects};
use super::{Finding, Stage, TracedProgram, What, variable};
use crate::diagnose::addends::OVERFLOWING;
use crate::diagnose::columns::{ScalarColumns, is_constant, is_equal, is_same};
use crate::diagnose::trials::{FUEL_OF_TRACE, StageChanges, Trials};
use reference::interpreter::trace::{Event, Trace};
use reference::traced::{Bench, Seen};
use std::cell::OnceCell;

/// So many places are looked for.
const MOST: usize = 4;

/// So many values are tried in one place, those that fit best.
const MOST_VALUES: usize = 8;

/// So many times a value of the text is compared with one of the right answer, and so many times for one place: some tenths of a second.
/// Loops of many turns would take more.
const MOST_COMPARED: usize = 6_000_000;
const MOST_COMPARED_AT_ONCE: usize = 60_000;

/// A place of a mistake, where the earlier ones are put right.
#[derive(Clone, Debug)]
pub(super) struct Link {
    pub mend: Mend,
    pub finding: Finding,
    /// The lines of what is written there, and of the numbers that it is computed from.
    pub lines: Vec<u32>,
    /// What is seen where it is put right as well, and the same before it is kept within the bounds of a colour; none of the last
    /// one, with which all is right.
    pub seen: Option<[Seen; 2]>,
    /// Whether something is computed there, and the text has all that it is to be computed from.
    pub is_computed: bool,
}

/// How much a value of the right answer has to do with a place. More is greater.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
struct Kinship {
    /// The right answer calls it by the name that is given the value there.
    is_called: bool,
    /// How much of what is used in the place is on its way, in twelfths.
    on_its_way: usize,
    /// How much of that it is computed from at once, in twelfths of both.
    alike: usize,
    /// Whether it is computed at once from what stands in the place.
    is_next: bool,
}

impl Search<'_, '_> {
    /// The places that mend everything together, in the order in which they are computed; none where not all is mended by that.
    pub(super) fn chain(&self) -> &[Link] {
        self.chain.get_or_init(|| self.links().unwrap_or_default())
    }

    fn links(&self) -> Option<Vec<Link>> {
        let each = self.comparisons();
        if each > MOST_COMPARED_AT_ONCE {
            return None;
        }
        let mut tries = MOST_COMPARED / each.max(1);
        let mut base = StageChanges::default();
        let mut found: Vec<Link> = Vec::new();
        loop {
            tries = tries.checked_sub(1)?;
            let (own, traces) = self.traced_with(&base)?;
            if is_right(self.wanted, &own, self.count) {
                return Some(found);
            }
            if let Some(before) = found.last_mut() {
                before.seen = Some([own.clone(), self.unclamped(self.theirs, &base)?]);
            }
            if found.len() == MOST {
                return None;
            }
            let trials = Trials::new(self.assignment, self.theirs, self.places, self.in_quads)?;
            let chain = OnceCell::new();
            let after = Search { traces: &traces, own: &own, base: base.clone(), trials, chain, ..*self };
            let link = after.next_link(&mut tries)?;
            base[link.mend.stage as usize].push(link.mend.change());
            found.push(link);
        }
    }

    /// How often a value is compared with another one to know which are right.
    fn comparisons(&self) -> usize {
        let events: usize = self.traces.iter().flatten().map(|trace| trace.events.len()).sum();
        let values: usize = self.quantities.all.iter().map(|own| own.turns.len()).sum();
        events * values
    }

    fn traced_with(&self, changes: &StageChanges) -> Option<(Seen, [Option<Trace>; 2])> {
        Bench::new(self.assignment, self.theirs, self.places, self.in_quads, FUEL_OF_TRACE)?.trace(changes)
    }

    /// What is seen of a program before it is kept within the bounds of a colour, which hide much of it.
    pub(super) fn unclamped(&self, program: &TracedProgram, changes: &StageChanges) -> Option<Seen> {
        let bench = Bench::new(self.assignment, program, self.places, self.in_quads, FUEL_OF_TRACE)?;
        bench.bounded(OVERFLOWING).with(changes)
    }

    /// The first place whose value is wrong although its operands are right, with what belongs there.
    fn next_link(&self, tries: &mut usize) -> Option<Link> {
        for stage in [Stage::Vertex, Stage::Fragment] {
            let Some(trace) = self.trace(stage) else { continue };
            let is_changed = |one: &Suspect| self.base[stage as usize].iter().any(|change| change.site == one.site);
            let open: Vec<Suspect> =
                named_suspects(self, stage, trace).into_iter().filter(|one| !is_changed(one)).collect();
            for suspect in open.into_iter().filter(|one| self.is_students(stage, one)) {
                let place = Mend { stage, suspect: suspect.clone(), quantity: None, values: Vec::new() };
                if !self.is_settled(&place) {
                    continue;
                }
                // A value that is right may be given to the wrong variable.
                let is_known = suspect.is_right || suspect.gives_right || is_known(self, stage, trace, &suspect);
                let Some(mend) = self.belonging(stage, &suspect, is_known, tries) else { continue };
                let is_computed = self.is_computed(&mend);
                let (finding, lines) = (self.finding(&mend)?, self.lines_of(&mend));
                return Some(Link { mend, finding, lines, seen: None, is_computed });
            }
        }
        None
    }

    /// What belongs in a place whose operands are right: what the right answer makes of them, or calls by this name. What makes more of
    /// the values further on right comes first. `is_known`: the value is right by itself, so that the next step is missing, or it has the
    /// name of another one.
    fn belonging(&self, stage: Stage, suspect: &Suspect, is_known: bool, tries: &mut usize) -> Option<Mend> {
        let all = self.candidates(stage, suspect).into_iter().map(|mend| (self.kinship(&mend), mend));
        let is_akin =
            |kinship: &Kinship| kinship.is_called || if is_known { kinship.is_next } else { kinship.on_its_way > 0 };
        let mut akin: Vec<(Kinship, Mend)> = all.filter(|(kinship, _)| is_akin(kinship)).collect();
        akin.sort_by_key(|(kinship, _)| std::cmp::Reverse(*kinship));
        akin.truncate(MOST_VALUES);
        let before = if akin.is_empty() { 0 } else { count_wrong(self, self.traces) };
        let mut best: Option<((bool, bool, usize, Kinship), Mend)> = None;
        for (kinship, mend) in akin {
            *tries = tries.checked_sub(1)?;
            let Some(gained) = self.gained(before, &mend) else { continue };
            // Its own place becomes right whatever it is.
            let (is_more, key) = (gained > 1, (gained > 1, kinship.is_called, gained, kinship));
            let is_good = is_more || kinship.is_called && !is_known;
            if is_good && best.as_ref().is_none_or(|(other, _)| *other < key) {
                best = Some((key, mend));
            }
        }
        best.map(|(_, mend)| mend)
    }

    fn kinship(&self, mend: &Mend) -> Kinship {
        let quantity = mend.quantity.map(|number| &self.quantities.all[number]);
        let event = mend.suspect.events.first();
        let (Some(quantity), Some(trace), Some(&event)) = (quantity, self.trace(mend.stage), event) else {
            return Kinship::default();
        };
        let sites = self.theirs.stage(mend.stage).sites();
        let what = &sites[mend.suspect.site].what;
        let is_called = matches!(what, What::Assign { name, .. } if quantity.names.contains(name));
        let own = leaves(trace, event, &|site| &sites[site].what);
        let right = self.quantities.made_from(quantity);
        let way = self.quantities.way(quantity);
        let among = |all: &[&ScalarColumns]| own.iter().filter(|own| all.iter().any(|one| is_equal(own, one))).count();
        let shared = among(&right);
        let all = own.len() + right.len() - shared.min(right.len());
        let value = &trace.events[event].values;
        // What a variable is given has its next step where the variable is read.
        let is_used = matches!(what, What::Read(_))
            || !matches!(what, What::Assign { .. }) && variable(sites, mend.suspect.site).is_none();
        Kinship {
            is_called,
            on_its_way: 12 * among(&way) / own.len().max(1),
            alike: 12 * shared / all.max(1),
            is_next: is_used && !is_constant(value) && right.iter().any(|one| is_equal(value, one)),
        }
    }

    /// How many more values are right with this in its place.
    fn gained(&self, before: usize, mend: &Mend) -> Option<usize> {
        let mut base = self.base.clone();
        base[mend.stage as usize].push(mend.change());
        let (own, traces) = self.traced_with(&base)?;
        let after = if is_right(self.wanted, &own, self.count) { 0 } else { count_wrong(self, &traces) };
        Some(before.saturating_sub(after))
    }

    /// Whether something is computed in a place, and the text has all that it is to be computed from; none of the numbers that it is
    /// computed from has a name and is unknown.
    fn is_computed(&self, mend: &Mend) -> bool {
        let quantity = mend.quantity.map(|number| &self.quantities.all[number]);
        let (Some(trace), Some(quantity)) = (self.trace(mend.stage), quantity) else { return false };
        let sites = self.theirs.stage(mend.stage).sites();
        let is_there = |value: &&ScalarColumns| trace.events.iter().any(|event| is_equal(&event.values, value));
        let mut own = mend.suspect.events.iter().map(|event| &trace.events[*event].values);
        let is_named = |event: &&Event| matches!(sites[event.site].what, What::Read(_)) && is_constant(&event.values);
        let is_unknown = |event: &Event| {
            let mut turns = self.quantities.all.iter().flat_map(|own| &own.turns);
            !event.from.is_empty() && !turns.any(|turn| is_same(event, turn))
        };
        let near = self.operands(mend).unwrap_or_default();
        let mut numbers = near.iter().map(|event| &trace.events[*event]).filter(is_named);
        own.any(|values| !is_constant(values))
            && self.quantities.needed_for(quantity).iter().all(is_there)
            && !numbers.any(is_unknown)
    }

    fn lines_of(&self, mend: &Mend) -> Vec<u32> {
        let sites = self.theirs.stage(mend.stage).sites();
        let mut lines = vec![sites[mend.suspect.site].line];
        let Some(trace) = self.trace(mend.stage) else { return lines };
        let mut open = mend.suspect.events.clone();
        while let Some(event) = open.pop() {
            let numbers = trace.events[event].from.iter().filter(|from| is_constant(&trace.events[**from].values));
            for number in numbers {
                let line = sites[trace.events[*number].site].line;
                if !lines.contains(&line) {
                    lines.push(line);
                }
                open.push(*number);
            }
        }
        lines
    }
}

fn count_wrong(search: &Search<'_, '_>, traces: &[Option<Trace>; 2]) -> usize {
    let of_stage = |stage: Stage| {
        let Some(trace) = &traces[stage as usize] else { return 0 };
        let all = named_suspects(search, stage, trace);
        let is_wrong = |one: &&Suspect| !one.is_right && !one.gives_right && !is_known(search, stage, trace, one);
        all.iter().filter(is_wrong).count()
    };
    of_stage(Stage::Vertex) + of_stage(Stage::Fragment)
}

/// The suspects of a stage, also those of the right answer's names that have the value of another one.
fn named_suspects(search: &Search<'_, '_>, stage: Stage, trace: &Trace) -> Vec<Suspect> {
    let program = search.theirs.stage(stage);
    let is_misnamed = |event: &Event| search.quantities.is_misnamed(stage, &program.sites()[event.site].what, event);
    suspects(stage, program, trace, search.quantities, &is_misnamed)
}

/// Whether all its values are what a right answer computes.
fn is_known(search: &Search<'_, '_>, stage: Stage, trace: &Trace, suspect: &Suspect) -> bool {
    let mut events = suspect.events.iter().map(|event| &trace.events[*event]);
    events.all(|event| search.quantities.equal_to(stage, event).is_some())
}
