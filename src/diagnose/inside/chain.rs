//! Several mistakes, each in a place of its own.
//!
//! A mistake hides those further on: what is computed from a wrong value is no right quantity, whatever is done with it. So the
//! first place is looked for whose value is wrong and whose operands are right, the right value is put there, and then the
//! next one is looked for, until everything that is seen is right.

mod belonging;

use super::candidates::Mend;
use super::search::{Search, is_right};
use super::walk::{Suspect, suspects};
use super::{Finding, Stage, TracedProgram, What};
use crate::diagnose::addends::OVERFLOWING;
use crate::diagnose::columns::{ScalarColumns, is_constant, is_equal, is_same};
use crate::diagnose::trials::{FUEL_OF_TRACE, StageChanges, Trials};
use reference::interpreter::trace::{Event, Trace};
use reference::traced::{Bench, Seen};
use std::cell::OnceCell;

/// So many places are looked for.
const MOST: usize = 4;

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
    /// What is seen where it is put right as well, and the same before it is kept within the bounds of a colour; `None` for the last
    /// one, with which all is right.
    pub seen: Option<[Seen; 2]>,
    /// Whether something is computed there, and the text has all that it is to be computed from.
    pub is_computed: bool,
}

/// The places of several mistakes.
#[derive(Debug, Default)]
pub(super) struct Chain {
    /// In the order in which they are computed.
    pub links: Vec<Link>,
    /// Whether all is right when all of them are put right.
    pub is_whole: bool,
}

impl Search<'_, '_> {
    /// The places that mend everything together, or the first of them.
    pub(super) fn chain(&self) -> &Chain {
        self.chain.get_or_init(|| {
            let mut chain = Chain::default();
            chain.is_whole = self.follow(&mut chain.links).is_some();
            chain
        })
    }

    /// Looks for one place after the other. `None` where not all is mended by them.
    fn follow(&self, found: &mut Vec<Link>) -> Option<()> {
        let each = self.comparisons();
        if each > MOST_COMPARED_AT_ONCE {
            return None;
        }
        let mut tries = MOST_COMPARED / each.max(1);
        let mut base = StageChanges::default();
        loop {
            tries = tries.checked_sub(1)?;
            let (own, traces) = self.traced_with(&base)?;
            if is_right(self.wanted, &own, self.count) {
                return Some(());
            }
            if let Some(before) = found.last_mut() {
                before.seen = Some([own.clone(), self.unclamped(self.theirs, &base)?]);
            }
            if found.len() == MOST {
                return None;
            }
            let trials = Trials::new(self.assignment, self.theirs, self.places, self.in_quads)?;
            let chain = OnceCell::new();
            let after = Search { traces: &traces, own: &own, base: base.clone(), trials, chain: &chain, ..*self };
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

    /// The first place whose value is wrong although its operands are right, with what belongs there. A place comes last where little
    /// else becomes right by it: that may be by chance.
    fn next_link(&self, tries: &mut usize) -> Option<Link> {
        let mut doubtful: Option<Mend> = None;
        for stage in [Stage::Vertex, Stage::Fragment] {
            let Some(trace) = self.trace(stage) else { continue };
            let is_changed = |one: &Suspect| self.base[stage as usize].iter().any(|change| change.site == one.site);
            let open: Vec<Suspect> =
                named_suspects(self, stage, trace).into_iter().filter(|one| !is_changed(one)).collect();
            for suspect in open.into_iter().filter(|one| self.is_students(stage, one)) {
                let place = Mend { stage, suspect: suspect.clone(), quantity: None, values: Vec::new() };
                if !self.is_settled(&place) && !self.is_ready(&place) {
                    continue;
                }
                // A value that is right may be given to the wrong variable.
                let is_known = suspect.is_right || suspect.gives_right || is_right_there(self, stage, trace, &suspect);
                match self.belonging(stage, &suspect, is_known, tries) {
                    Some((mend, 1)) if is_known => doubtful = doubtful.or(Some(mend)),
                    Some((mend, _)) => return self.link(mend),
                    None => {}
                }
            }
        }
        self.link(doubtful?)
    }

    fn link(&self, mend: Mend) -> Option<Link> {
        let is_computed = self.is_computed(&mend);
        let (finding, lines) = (self.finding(&mend)?, self.lines_of(&mend));
        Some(Link { mend, finding, lines, seen: None, is_computed })
    }

    /// Whether the statement of a place, or what was written of it so far, has only what is right to go by: what it reads, and what it goes
    /// on from, as `sum += x` does.
    fn is_ready(&self, mend: &Mend) -> bool {
        let (Some(near), Some(trace)) = (self.operands(mend), self.trace(mend.stage)) else { return false };
        let sites = self.theirs.stage(mend.stage).sites();
        let is_read = |event: &Event| matches!(sites[event.site].what, What::Read(_));
        let is_given = |event: &Event| matches!(sites[event.site].what, What::Assign { .. });
        let is_right = |event: &Event| is_constant(&event.values) || self.quantities.is_right(mend.stage, event);
        near.into_iter().map(|event| &trace.events[event]).all(|event| {
            let mut from = event.from.iter().map(|from| &trace.events[*from]);
            match is_read(event) {
                // What is read of a value that is right is right.
                true => is_right(event) || !event.from.is_empty() && from.all(is_right),
                false => from.all(|from| !is_given(from) || is_right(from)),
            }
        })
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

/// The suspects of a stage. Components are known by themselves, and what has the name of another value is not.
fn named_suspects(search: &Search<'_, '_>, stage: Stage, trace: &Trace) -> Vec<Suspect> {
    let program = search.theirs.stage(stage);
    let is_misnamed = |event: &Event| search.quantities.is_misnamed(stage, &program.sites()[event.site].what, event);
    suspects(program, trace, &|event| search.quantities.is_right(stage, event) && !is_misnamed(event))
}

/// Whether all its values are what a right answer computes, or components of that.
fn is_right_there(search: &Search<'_, '_>, stage: Stage, trace: &Trace, suspect: &Suspect) -> bool {
    let mut events = suspect.events.iter().map(|event| &trace.events[*event]);
    events.all(|event| search.quantities.is_right(stage, event))
}
