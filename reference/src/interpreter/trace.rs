//! What a program computes on its way: every value of every expression, and what happens when one of them is another.

use super::run::{Mismatch, Prepared, Stopped};
use super::syntax::Binary;
use super::types::Type;
use std::collections::HashMap;

/// A place in the text that computes a value.
#[derive(Clone, Debug, PartialEq)]
pub struct Site {
    /// The line on which it is written, from 1: within a macro, that of the macro.
    pub line: u32,
    /// What it does.
    pub what: What,
    /// The type of its value.
    pub kind: Type,
    /// The sites of its operands.
    pub operands: Vec<usize>,
    /// The function that it stands in; `None` outside of functions.
    pub function: Option<String>,
    /// Whether its value goes anywhere.
    pub is_used: bool,
    /// Whether it is not the whole of a variable that it reads.
    pub is_part: bool,
}

/// What a site does.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs, reason = "they are what they are called")]
pub enum What {
    Literal,
    /// Reads a variable, or a part of it.
    Read(String),
    /// `-x`, `!x`
    Unary,
    /// `++x`, `x--`
    Step,
    Binary(Binary),
    Conditional,
    /// A function or constructor by its name.
    Call(String),
    /// A part of a value.
    Part,
    /// Gives a variable its value, or a part of it.
    Assign {
        name: String,
        is_part: bool,
    },
}

/// A value that was computed.
#[derive(Clone, Debug, PartialEq)]
pub struct Event {
    /// The number of its site.
    pub site: usize,
    /// Its scalars, each for all samples; not a number where it is undefined.
    pub values: Vec<Vec<f64>>,
    /// The samples for which it was computed.
    pub lanes: Vec<bool>,
    /// The events that it is computed from.
    pub from: Vec<usize>,
    /// The conditions that decided that it is computed.
    pub under: Vec<usize>,
}

/// What is put in the place of a site's values: one for each time that it is reached, or one for all.
#[derive(Clone, Debug, PartialEq)]
pub struct ValueChange {
    /// The number of the site.
    pub site: usize,
    /// The scalars of each value, each for all samples.
    pub values: Vec<Vec<Vec<f64>>>,
}

/// Most numbers that a trace holds: 16 MiB.
const MOST_NUMBERS: usize = 1 << 21;

/// Records values, and changes some.
#[derive(Debug, Default)]
pub struct Recorder {
    /// What was computed, in that order.
    pub events: Vec<Event>,
    /// Whether there was more than it can hold.
    pub is_full: bool,
    /// Whether values are recorded at all.
    pub is_recording: bool,
    /// Beyond this a value becomes 0, and so does what is no number; `None` where values stay as they are.
    pub most: Option<f64>,
    /// What is changed, and how often it was.
    changes: Vec<(ValueChange, usize)>,
    numbers: usize,
    /// The last event of each site.
    pub last: HashMap<usize, usize>,
    /// The events that gave each slot its value.
    writers: HashMap<u32, Vec<usize>>,
    /// The conditions around what is computed now.
    pub conditions: Vec<usize>,
    /// Those under which something left a loop or a function: they decide over all that follows.
    pub left_under: Vec<usize>,
}

impl Recorder {
    /// Makes ready for a run.
    pub fn begin(&mut self, is_recording: bool, changes: &[ValueChange]) {
        let changes = changes.iter().map(|change| (change.clone(), 0)).collect();
        *self = Self { is_recording, changes, most: self.most, ..Self::default() };
    }

    /// What is put in the place of a site's value now.
    pub fn change(&mut self, site: usize) -> Option<&Vec<Vec<f64>>> {
        let (change, turns) = self.changes.iter_mut().find(|(change, _)| change.site == site)?;
        let turn = std::mem::replace(turns, *turns + 1);
        if change.values.len() == 1 { change.values.first() } else { change.values.get(turn) }
    }

    /// Notes a value.
    pub fn record(&mut self, site: &Site, number: usize, read: [&[u32]; 2], values: Vec<Vec<f64>>, lanes: Vec<bool>) {
        self.numbers += values.len() * lanes.len() + 8;
        if self.numbers > MOST_NUMBERS {
            self.is_full = true;
            return;
        }
        let [slots, sources] = read;
        let operands = site.operands.iter().filter_map(|operand| self.last.get(operand)).copied();
        let read = sources.iter().filter_map(|slot| self.writers.get(slot)).flatten().copied();
        let mut from: Vec<usize> = operands.chain(read).collect();
        from.sort_unstable();
        from.dedup();
        let under = self.conditions.iter().chain(&self.left_under).copied().collect();
        let event = self.events.len();
        self.events.push(Event { site: number, values, lanes, from, under });
        self.last.insert(number, event);
        for slot in slots {
            self.writers.insert(*slot, vec![event]);
        }
    }

    /// Notes that a slot was given the last value of a site, in some samples or in all.
    pub fn wrote(&mut self, site: usize, slot: u32, in_all: bool) {
        let Some(&event) = self.last.get(&site) else { return };
        let writers = self.writers.entry(slot).or_default();
        if in_all {
            writers.clear();
        }
        if !writers.contains(&event) {
            writers.push(event);
        }
    }

    /// Notes that a slot was given what another one was, in some samples or in all.
    pub fn handed_on(&mut self, to: u32, from: u32, in_all: bool) {
        let given = self.writers.get(&from).cloned().unwrap_or_default();
        let writers = self.writers.entry(to).or_default();
        if in_all {
            writers.clear();
        }
        writers.extend(given);
    }

    /// The event that gave a condition its value.
    pub fn enter(&mut self, condition: u32) {
        let event = self.writers.get(&condition).and_then(|writers| writers.last()).copied();
        self.conditions.push(event.unwrap_or(usize::MAX));
    }

    /// Something goes on without those that left here.
    pub fn leave(&mut self) {
        let own: Vec<usize> = self.conditions.iter().copied().filter(|c| !self.left_under.contains(c)).collect();
        self.left_under.extend(own);
    }

    /// The events that gave slots their values.
    pub fn written(&self, slots: impl Iterator<Item = u32>) -> Vec<usize> {
        let mut all: Vec<usize> = slots.filter_map(|slot| self.writers.get(&slot)).flatten().copied().collect();
        all.extend(&self.left_under);
        all.retain(|event| *event < self.events.len());
        all.sort_unstable();
        all.dedup();
        all
    }
}

/// What a run with a recorder computed.
#[derive(Clone, Debug, Default)]
pub struct Trace {
    /// Every value, in the order in which they are computed.
    pub events: Vec<Event>,
    /// For each output of the stage the events that gave it its value, and what decided that.
    pub outputs: Vec<Vec<usize>>,
}

impl Prepared<'_> {
    /// Runs, and gives every value. `None` where there are more than a trace holds.
    ///
    /// # Errors
    /// The steps are used up.
    pub fn trace(&mut self, changes: &[ValueChange]) -> Result<Option<(super::Outputs, Trace)>, Stopped> {
        let outputs = self.again(true, changes)?;
        Ok(self.traced().map(|trace| (outputs, trace)))
    }

    /// Runs with some values changed.
    ///
    /// # Errors
    /// The steps are used up.
    pub fn outputs(&mut self, changes: &[ValueChange]) -> Result<super::Outputs, Stopped> {
        self.again(false, changes)
    }

    /// Gives an input, or a uniform by its path, a column for each of its scalars.
    ///
    /// # Errors
    /// There is no such input, or it has another number of scalars or samples.
    pub fn feed(&mut self, name: &str, columns: &[Vec<f64>]) -> Result<(), Mismatch> {
        self.give(name, columns)
    }
}
