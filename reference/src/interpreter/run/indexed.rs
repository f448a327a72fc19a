//! Reading and writing what an index selects.

use super::machine::Machine;
use super::memory::{CauseNumber, UndefinedCause};
use super::undefined::Undefined;
use crate::interpreter::code::{Indexed, Slot};

impl Machine<'_> {
    /// `to = before + index * stride`, not a number where the index is out of range.
    pub(super) fn offset(&mut self, to: Slot, before: Option<Slot>, index: Slot, [count, stride]: [u32; 2], line: u32) {
        let offsets: Vec<f64> = (0..self.lanes)
            .map(|lane| {
                let index = self.memory.column(index)[lane];
                let before = before.map_or(0.0, |slot| self.memory.column(slot)[lane]);
                let is_inside = index >= 0.0 && index < f64::from(count);
                if is_inside { before + index * f64::from(stride) } else { f64::NAN }
            })
            .collect();
        let causes: Vec<CauseNumber> = (0..self.lanes)
            .map(|lane| {
                let before = before.map_or(0, |slot| self.memory.cause(slot, lane));
                if before == 0 { self.memory.cause(index, lane) } else { before }
            })
            .collect();
        let outside = self.memory.number(UndefinedCause { what: Undefined::Index, line });
        self.memory.column_mut(to).copy_from_slice(&offsets);
        if causes.iter().any(|&cause| cause != 0) || offsets.iter().any(|offset| offset.is_nan()) {
            self.memory.causes_mut(to).copy_from_slice(&causes);
            self.memory.mark(to, outside, |lane| offsets[lane].is_nan());
        }
    }

    /// `to = indexed`
    pub(super) fn gather(&mut self, to: Slot, Indexed { base, offset }: Indexed) {
        let read = |machine: &Self, lane: usize| {
            let distance = machine.memory.column(offset)[lane];
            if distance.is_nan() {
                return (0.0, machine.memory.cause(offset, lane));
            }
            let slot = base + distance as Slot;
            let cause = machine.memory.cause(offset, lane);
            let cause = if cause == 0 { machine.memory.cause(slot, lane) } else { cause };
            (machine.memory.column(slot)[lane], cause)
        };
        let (values, causes): (Vec<f64>, Vec<CauseNumber>) = (0..self.lanes).map(|lane| read(self, lane)).unzip();
        self.memory.column_mut(to).copy_from_slice(&values);
        if causes.iter().any(|&cause| cause != 0) {
            self.memory.causes_mut(to).copy_from_slice(&causes);
        }
    }

    /// `indexed = from`. A write to nowhere may overwrite anything on a driver, so that the lane strays.
    pub(super) fn scatter(&mut self, Indexed { base, offset }: Indexed, from: Slot) {
        for lane in 0..self.lanes {
            if !self.active.has(lane) {
                continue;
            }
            let distance = self.memory.column(offset)[lane];
            let strayed = self.memory.cause(offset, lane);
            if strayed != 0 && self.strayed[lane] == 0 {
                self.strayed[lane] = strayed;
            }
            if !distance.is_nan() {
                let slot = base + distance as Slot;
                let (value, cause) = (self.memory.column(from)[lane], self.memory.cause(from, lane));
                self.memory.write(slot, lane, value, cause);
            }
        }
    }
}
