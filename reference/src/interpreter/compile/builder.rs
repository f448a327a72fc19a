//! Slots and instructions; what is known already is computed at once.

use crate::interpreter::Refusal;
use crate::interpreter::code::{ArithmeticClass, CodeConstant, Instruction, Node, Operation, Slot};
use crate::interpreter::run::{Undefined, scalar, undefined_lanes};
use crate::interpreter::types::Scalar;
use crate::text::both;
use std::collections::HashMap;

/// Most scalars that a program's variables and constants have; ggrade's gate refuses far smaller ones before.
const MAX_SLOTS: usize = 1 << 18;
/// Most instructions of a program.
const MAX_NODES: usize = 1 << 20;

/// What a scalar's arithmetic is.
pub fn class(scalar: Scalar) -> ArithmeticClass {
    match scalar {
        Scalar::Int => ArithmeticClass::Int,
        Scalar::Uint | Scalar::Bool => ArithmeticClass::Uint,
        Scalar::Float => ArithmeticClass::Float,
        Scalar::Double => ArithmeticClass::Double,
    }
}

/// Hands out slots and collects what is to be done.
#[derive(Default)]
pub struct CodeBuilder {
    pub constants: Vec<Option<CodeConstant>>,
    pool: HashMap<(u64, bool), Slot>,
    /// What is done by the block that is being compiled.
    pub nodes: Vec<Node>,
    count: usize,
    free: Vec<Slot>,
    in_use: Vec<Slot>,
    /// Where the program is being compiled.
    pub line: u32,
}

impl CodeBuilder {
    /// Consecutive slots of a variable.
    pub fn allocate(&mut self, count: usize) -> Result<Slot, Refusal> {
        let first = self.constants.len();
        if first.saturating_add(count) > MAX_SLOTS || self.is_full() {
            return Err(Refusal::limit(
                self.line,
                both("this program has too many variables or instructions", "プログラムの変数または命令が多すぎます"),
            ));
        }
        self.constants.resize(first + count, None);
        Ok(first as Slot)
    }

    /// Consecutive slots of known values.
    pub fn allocate_constants(&mut self, values: &[CodeConstant]) -> Result<Slot, Refusal> {
        let first = self.allocate(values.len())?;
        for (slot, value) in self.constants[first as usize..].iter_mut().zip(values) {
            *slot = Some(*value);
        }
        Ok(first)
    }

    /// Whether instructions were left out because there are too many.
    pub fn is_full(&self) -> bool {
        self.count > MAX_NODES || self.constants.len() > MAX_SLOTS + MAX_NODES
    }

    /// A slot until the end of the statement.
    pub fn temporary(&mut self) -> Slot {
        let slot = self.free.pop().unwrap_or_else(|| {
            self.constants.push(None);
            (self.constants.len() - 1) as Slot
        });
        self.in_use.push(slot);
        slot
    }

    /// How many temporary slots are in use.
    pub fn mark(&self) -> usize {
        self.in_use.len()
    }

    /// Gives back the temporary slots since a mark.
    pub fn release(&mut self, mark: usize) {
        self.free.extend(self.in_use.drain(mark..));
    }

    /// Begins a function: its slots are its own, because those of the functions that it calls are in use beside them.
    pub fn begin_function(&mut self) {
        self.free.clear();
        self.in_use.clear();
    }

    /// Adds something to be done.
    pub fn push(&mut self, node: Node) {
        self.count += 1;
        if !self.is_full() {
            self.nodes.push(node);
        }
    }

    /// The slot of a known number.
    pub fn constant(&mut self, value: f64, is_float: bool) -> Slot {
        *self.pool.entry((value.to_bits(), is_float)).or_insert_with(|| {
            self.constants.push(Some(CodeConstant { value, is_float }));
            (self.constants.len() - 1) as Slot
        })
    }

    /// A number of type `float`.
    pub fn float(&mut self, value: f64) -> Slot {
        self.constant(value, true)
    }

    /// A whole number or truth value.
    pub fn whole(&mut self, value: f64) -> Slot {
        self.constant(value, false)
    }

    /// A number of this class.
    pub fn number(&mut self, class: ArithmeticClass, value: f64) -> Slot {
        self.constant(value, class == ArithmeticClass::Float)
    }

    /// What a slot holds, if that is known.
    pub fn known(&self, slot: Slot) -> Option<f64> {
        self.constants[slot as usize].map(|constant| constant.value)
    }

    /// One instruction; its result is known at once where its operands are and GLSL defines it.
    pub fn emit(&mut self, operation: Operation, class: ArithmeticClass, operands: &[Slot]) -> Slot {
        let of: [Slot; 3] = std::array::from_fn(|index| operands.get(index).copied().unwrap_or(operands[0]));
        if let [Some(a), Some(b), Some(c)] = of.map(|slot| self.known(slot)) {
            let is_defined = undefined_lanes(operation, class, [&[a], &[b], &[c]]).is_none();
            let result = scalar(operation, class, [a, b, c]);
            if is_defined && !result.is_nan() {
                return self.constant(result, class == ArithmeticClass::Float);
            }
        }
        let to = self.temporary();
        let line = self.line;
        self.push(Node::Do(Instruction { operation, class, to, of, line }));
        to
    }

    /// The same for each of many operands.
    pub fn each1(&mut self, operation: Operation, class: ArithmeticClass, a: &[Slot]) -> Vec<Slot> {
        a.iter().map(|&a| self.emit(operation, class, &[a])).collect()
    }

    /// The same for each pair; one of the two may be a single operand for all.
    pub fn each2(&mut self, operation: Operation, class: ArithmeticClass, a: &[Slot], b: &[Slot]) -> Vec<Slot> {
        let count = a.len().max(b.len());
        (0..count).map(|n| self.emit(operation, class, &[pick(a, n), pick(b, n)])).collect()
    }

    /// The same for each triple; any of them may be a single operand for all.
    pub fn each3(&mut self, operation: Operation, class: ArithmeticClass, [a, b, c]: [&[Slot]; 3]) -> Vec<Slot> {
        let count = a.len().max(b.len()).max(c.len());
        (0..count).map(|n| self.emit(operation, class, &[pick(a, n), pick(b, n), pick(c, n)])).collect()
    }

    /// Copies, which keep their values when a variable changes.
    pub fn copies(&mut self, slots: &[Slot]) -> Vec<Slot> {
        slots.iter().map(|&slot| if self.known(slot).is_some() { slot } else { self.copy(slot) }).collect()
    }

    /// A copy, of what is known as well.
    pub fn own_copy(&mut self, slot: Slot) -> Slot {
        self.copy(slot)
    }

    fn copy(&mut self, slot: Slot) -> Slot {
        let (to, line) = (self.temporary(), self.line);
        self.push(Node::Do(Instruction {
            operation: Operation::Copy,
            class: ArithmeticClass::Double,
            to,
            of: [slot; 3],
            line,
        }));
        to
    }

    /// A scalar as another scalar type.
    pub fn convert(&mut self, slot: Slot, from: Scalar, to: Scalar) -> Slot {
        match (from, to) {
            _ if from == to => slot,
            (_, Scalar::Bool) => {
                let zero = self.whole(0.0);
                self.emit(Operation::NotEqual, class(from), &[slot, zero])
            }
            (Scalar::Int | Scalar::Uint | Scalar::Double, Scalar::Float) | (Scalar::Float, Scalar::Double) => {
                self.narrow(slot)
            }
            (Scalar::Bool, Scalar::Float) => match self.known(slot) {
                Some(value) => self.float(value),
                None => slot,
            },
            (Scalar::Bool, _) | (_, Scalar::Double) => slot,
            (Scalar::Float, _) => self.emit(Operation::Truncate, class(to), &[slot]),
            (Scalar::Double, _) => self.emit(Operation::TruncateDouble, class(to), &[slot]),
            _ => self.emit(Operation::Reinterpret, class(to), &[slot]),
        }
    }

    /// The nearest float: what a `float` becomes a `double` from, and what any other number becomes as a `float`.
    fn narrow(&mut self, slot: Slot) -> Slot {
        match self.known(slot) {
            Some(value) => self.float(f64::from(value as f32)),
            None => self.emit(Operation::Narrow, ArithmeticClass::Float, &[slot]),
        }
    }

    /// From here on a variable has no value.
    pub fn undefine(&mut self, base: Slot, count: usize, what: Undefined) {
        if count > 0 {
            let line = self.line;
            self.push(Node::Undefine { base, count: count as u32, what, line });
        }
    }
}

fn pick(of: &[Slot], index: usize) -> Slot {
    of[if of.len() == 1 { 0 } else { index }]
}
