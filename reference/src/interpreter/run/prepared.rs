//! A program that is run again and again, with its values looked at or changed.

use super::machine::Machine;
use super::{Column, Mismatch, Outputs, Precision, ProgramVariable, Stopped, leaves, slots};
use crate::interpreter::code::{Code, ObservedValue, Slot};
use crate::interpreter::texture::Texture;
use crate::interpreter::trace::{Trace, ValueChange};
use crate::interpreter::types::Scalar;
use std::fmt;
use std::ops::Range;

/// A run of one block that is made again and again.
pub struct Prepared<'a> {
    machine: Machine<'a>,
    samples: usize,
    inputs: Vec<(Slot, Vec<f64>)>,
    /// The steps that are left, and how many of them one run may take.
    fuel: u64,
    most: u64,
}

/// A run with changes may take so many times as many steps as the first one: a changed counter never comes to its end.
const SLACK: u64 = 4;

impl fmt::Debug for Prepared<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Prepared").field("samples", &self.samples).finish_non_exhaustive()
    }
}

impl<'a> Prepared<'a> {
    pub(crate) fn new(code: &'a Code, samples: usize, textures: &'a [Texture], fuel: u64) -> Self {
        let mut machine = Machine::new(code, textures, samples, Precision::Exact, fuel);
        machine.recorder = Some(Box::default());
        for &(slot, value) in &code.defaults {
            machine.memory.column_mut(slot).fill(value);
        }
        Self { machine, samples, inputs: Vec::new(), fuel, most: u64::MAX }
    }
}

impl Prepared<'_> {
    /// Gives an input, or a uniform by its path, a column for each of its scalars.
    pub(crate) fn give(&mut self, path: &str, columns: &[Vec<f64>]) -> Result<(), Mismatch> {
        let code = self.machine.code;
        let input = code.inputs.iter().find(|input| input.name == path);
        let own: Vec<Slot> = match input {
            Some(input) => slots(input).collect(),
            None => leaves(&code.uniforms, path).flat_map(slots).collect(),
        };
        if own.len() != columns.len() || columns.iter().any(|column| column.len() != self.samples) {
            return Err(Mismatch(format!("{path} has {} scalars of {} samples", own.len(), self.samples)));
        }
        self.inputs.retain(|(slot, _)| !own.contains(slot));
        self.inputs.extend(own.into_iter().zip(columns.iter().cloned()));
        Ok(())
    }

    /// From now on a value becomes 0 where it is no number, or beyond `most`.
    pub(crate) fn bound(&mut self, most: f64) {
        self.machine.recorder.iter_mut().for_each(|recorder| recorder.most = Some(most));
    }

    pub(crate) fn again(&mut self, is_recording: bool, changes: &[ValueChange]) -> Result<Outputs, Stopped> {
        let Self { machine, samples, inputs, fuel, most } = self;
        machine.fuel = (*fuel).min(*most);
        let given = machine.fuel;
        machine.begin(*samples);
        machine.recorder.iter_mut().for_each(|recorder| recorder.begin(is_recording, changes));
        for (slot, values) in inputs {
            machine.memory.column_mut(*slot).copy_from_slice(values);
        }
        let ran = machine.run();
        let used = given - machine.fuel;
        *fuel -= used;
        if *most == u64::MAX {
            *most = SLACK * used;
        }
        machine.memory.restore(&machine.code.constants);
        ran?;
        let column = |variable: &ProgramVariable| {
            let count = variable.kind.slots().unwrap_or(0);
            let mut column = Column {
                name: variable.name.clone(),
                kind: variable.kind.clone(),
                values: vec![Vec::with_capacity(*samples); count],
                undefined: vec![Vec::new(); count],
            };
            column.collect(machine, variable);
            column
        };
        Ok(Outputs {
            outputs: machine.code.outputs.iter().map(column).collect(),
            locals: Vec::new(),
            discarded: (0..*samples).map(|lane| machine.discarded.has(lane)).collect(),
            lookups: Vec::new(),
        })
    }

    pub(crate) fn traced(&mut self) -> Option<Trace> {
        let outputs = &self.machine.code.outputs;
        let recorder = self.machine.recorder.as_mut().filter(|recorder| !recorder.is_full)?;
        let outputs = outputs.iter().map(|output| recorder.written(slots(output))).collect();
        let mut events = std::mem::take(&mut recorder.events);
        let count = events.len();
        events.iter_mut().for_each(|event| event.under.retain(|condition| *condition < count));
        Some(Trace { events, outputs })
    }
}

impl Machine<'_> {
    pub(super) fn record(&mut self, record: &ObservedValue) {
        let Some(recorder) = self.recorder.as_mut() else { return };
        if let Some(values) = recorder.change(record.site) {
            for (slot, values) in record.slots.iter().zip(values) {
                let column = self.memory.column_mut(*slot);
                self.active.copy(column, values);
            }
        }
        if let Some(most) = recorder.most.filter(|_| self.code.sites[record.site].kind.scalar() == Some(Scalar::Float))
        {
            for slot in &record.slots {
                let is_usual = |x: &f64| x.abs() < most;
                if self.memory.column(*slot).iter().all(is_usual) {
                    continue;
                }
                let column = self.memory.column_mut(*slot);
                let bound: Vec<f64> = column.iter().map(|x| if is_usual(x) { *x } else { 0.0 }).collect();
                self.active.copy(column, &bound);
            }
        }
        if !recorder.is_recording || recorder.is_full {
            return;
        }
        let value = |slot: &Slot| {
            let column = self.memory.column(*slot).iter().enumerate();
            let defined = |(lane, value): (usize, &f64)| {
                if self.memory.cause(*slot, lane) == 0 { *value } else { f64::NAN }
            };
            column.map(defined).collect()
        };
        let values = record.slots.iter().map(value).collect();
        let lanes = (0..self.lanes).map(|lane| self.active.has(lane)).collect();
        let site = &self.code.sites[record.site];
        recorder.record(site, record.site, [&record.slots, &record.sources], values, lanes);
    }

    pub(super) fn wrote(&mut self, site: usize, slots: Range<Slot>) {
        let in_all = self.active.all();
        let Some(recorder) = self.recorder.as_mut().filter(|recorder| recorder.is_recording) else { return };
        slots.for_each(|slot| recorder.wrote(site, slot, in_all));
    }

    pub(super) fn handed_on(&mut self, to: Slot, from: Slot) {
        let in_all = self.active.all();
        let Some(recorder) = self.recorder.as_mut().filter(|recorder| recorder.is_recording) else { return };
        recorder.handed_on(to, from, in_all);
    }

    pub(super) fn enter(&mut self, condition: Slot) {
        if let Some(recorder) = &mut self.recorder {
            recorder.enter(condition);
        }
    }

    pub(super) fn leave_condition(&mut self) {
        if let Some(recorder) = &mut self.recorder {
            recorder.conditions.pop();
        }
    }
}
