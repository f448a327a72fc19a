//! The columns of a block of lanes, and for each value why it is undefined, if it is.
//!
//! A cause is kept for each value and not for each lane, because most programs that leave something undefined never use
//! it. That costs little: a slot that is defined in all lanes, as nearly all are, has no column of causes.

use super::kernel;
use super::mask::Mask;
use super::rounding::{Precision, is_subnormal};
use super::undefined::{self, Undefined};
use crate::interpreter::code::{CodeConstant, Instruction, Operation, Slot};

/// Why a value is undefined.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct UndefinedCause {
    /// What is left open.
    pub what: Undefined,
    /// The line that does it.
    pub line: u32,
}

/// Number of a cause, from 1; 0 is none.
pub(super) type CauseNumber = u16;

/// All columns of a block.
pub(super) struct Memory {
    lanes: usize,
    columns: Vec<Vec<f64>>,
    /// Whether a slot is undefined in any lane; its causes are valid only then.
    undefined: Vec<bool>,
    causes: Vec<Vec<CauseNumber>>,
    known: Vec<UndefinedCause>,
    precision: Precision,
}

impl Memory {
    pub fn new(constants: &[Option<CodeConstant>], lanes: usize, precision: Precision) -> Self {
        let column = |constant: &Option<CodeConstant>| {
            let value = match constant {
                Some(constant) if constant.is_float && precision != Precision::Exact => {
                    let value = f64::from(constant.value as f32);
                    let is_zero = matches!(precision, Precision::Noisy(_)) && is_subnormal(value);
                    if is_zero { 0.0 } else { value }
                }
                Some(constant) => constant.value,
                None => 0.0,
            };
            vec![value; lanes]
        };
        Self {
            lanes,
            columns: constants.iter().map(column).collect(),
            undefined: vec![false; constants.len()],
            causes: vec![Vec::new(); constants.len()],
            known: Vec::new(),
            precision,
        }
    }

    /// Begins a block of at most as many lanes as before. Constants and uniforms keep their values.
    pub fn begin(&mut self, lanes: usize) {
        if lanes != self.lanes {
            self.columns.iter_mut().for_each(|column| column.truncate(lanes));
            self.causes.iter_mut().for_each(|causes| causes.truncate(lanes));
            self.lanes = lanes;
        }
        self.undefined.fill(false);
    }

    /// Gives constants their values again.
    pub fn restore(&mut self, constants: &[Option<CodeConstant>]) {
        for (column, constant) in self.columns.iter_mut().zip(constants) {
            constant.iter().for_each(|constant| column.fill(constant.value));
        }
    }

    pub fn column(&self, slot: Slot) -> &[f64] {
        &self.columns[slot as usize]
    }

    pub fn column_mut(&mut self, slot: Slot) -> &mut [f64] {
        self.undefined[slot as usize] = false;
        &mut self.columns[slot as usize]
    }

    /// The cause in one lane, or 0.
    pub fn cause(&self, slot: Slot, lane: usize) -> CauseNumber {
        if self.undefined[slot as usize] { self.causes[slot as usize][lane] } else { 0 }
    }

    pub fn is_undefined(&self, slot: Slot) -> bool {
        self.undefined[slot as usize]
    }

    pub fn known(&self, number: CauseNumber) -> Option<UndefinedCause> {
        self.known.get(usize::from(number).checked_sub(1)?).copied()
    }

    pub fn number(&mut self, cause: UndefinedCause) -> CauseNumber {
        let index = self.known.iter().position(|known| *known == cause).unwrap_or_else(|| {
            self.known.push(cause);
            self.known.len() - 1
        });
        // More causes than that, of a program of as many lines, share the last number.
        CauseNumber::try_from(index + 1).unwrap_or(CauseNumber::MAX)
    }

    /// Marks lanes of a slot as undefined; those that are already keep their cause.
    pub fn mark(&mut self, slot: Slot, cause: CauseNumber, is_marked: impl Fn(usize) -> bool) {
        let causes = self.causes_mut(slot);
        for (lane, known) in causes.iter_mut().enumerate() {
            if *known == 0 && is_marked(lane) {
                *known = cause;
            }
        }
    }

    /// The causes of a slot, to be written.
    pub fn causes_mut(&mut self, slot: Slot) -> &mut [CauseNumber] {
        let slot = slot as usize;
        if !self.undefined[slot] {
            self.undefined[slot] = true;
            self.causes[slot].clear();
            self.causes[slot].resize(self.lanes, 0);
        }
        &mut self.causes[slot]
    }

    /// Does an instruction in all lanes.
    pub fn execute(&mut self, instruction: &Instruction) {
        let Instruction { operation, class, to, of, line } = *instruction;
        let [a, b, c] = of.map(|slot| slot as usize);
        let mut result = std::mem::take(&mut self.columns[to as usize]);
        let operands = [&*self.columns[a], &*self.columns[b], &*self.columns[c]];
        kernel::run(operation, class, self.precision, &mut result, operands);
        let found = undefined::lanes(operation, class, operands);
        self.columns[to as usize] = result;
        self.undefined[to as usize] = false;
        if self.undefined[a] || self.undefined[b] || self.undefined[c] {
            self.inherit(operation, to, of);
        }
        if let Some((what, lanes)) = found {
            let cause = self.number(UndefinedCause { what, line });
            self.mark(to, cause, |lane| lanes[lane]);
        }
    }

    /// The result is undefined where an operand is that decides it.
    fn inherit(&mut self, operation: Operation, to: Slot, [a, b, c]: [Slot; 3]) {
        let first = |causes: [CauseNumber; 2]| if causes[0] == 0 { causes[1] } else { causes[0] };
        let is_true = |slot: Slot, lane: usize| self.columns[slot as usize][lane] != 0.0;
        let causes: Vec<CauseNumber> = (0..self.lanes)
            .map(|lane| {
                let [of_a, of_b, of_c] = [a, b, c].map(|slot| self.cause(slot, lane));
                match operation {
                    Operation::Select => first([of_a, if is_true(a, lane) { of_b } else { of_c }]),
                    // The second operand counts where the first does not decide.
                    Operation::And if of_a == 0 && !is_true(a, lane) => 0,
                    Operation::Or if of_a == 0 && is_true(a, lane) => 0,
                    _ => first([of_a, first([of_b, of_c])]),
                }
            })
            .collect();
        if causes.iter().any(|&cause| cause != 0) {
            self.causes_mut(to).copy_from_slice(&causes);
        }
    }

    /// `to = from` in the lanes of the mask.
    pub fn store(&mut self, to: Slot, from: Slot, mask: &Mask) {
        if to == from {
            return;
        }
        let mut column = std::mem::take(&mut self.columns[to as usize]);
        mask.copy(&mut column, &self.columns[from as usize]);
        self.columns[to as usize] = column;
        if mask.all() && !self.is_undefined(from) {
            self.undefined[to as usize] = false;
        } else if self.is_undefined(from) || self.is_undefined(to) {
            let causes: Vec<_> =
                (0..self.lanes).map(|lane| self.cause(if mask.has(lane) { from } else { to }, lane)).collect();
            self.causes_mut(to).copy_from_slice(&causes);
        }
    }

    /// Writes one value.
    pub fn write(&mut self, slot: Slot, lane: usize, value: f64, cause: CauseNumber) {
        self.columns[slot as usize][lane] = value;
        if cause != 0 || self.undefined[slot as usize] {
            self.causes_mut(slot)[lane] = cause;
        }
    }

    /// Leaves slots without a value in the lanes of the mask.
    pub fn undefine(&mut self, base: Slot, count: u32, cause: UndefinedCause, mask: &Mask) {
        let cause = self.number(cause);
        for slot in base..base + count {
            let column = &mut self.columns[slot as usize];
            (0..column.len()).filter(|&lane| mask.has(lane)).for_each(|lane| column[lane] = 0.0);
            let causes = self.causes_mut(slot);
            (0..causes.len()).filter(|&lane| mask.has(lane)).for_each(|lane| causes[lane] = cause);
        }
    }
}
