//! Formulas without branches and calls: their instructions in a row.

use crate::interpreter::code::{ArithmeticClass, Instruction, Node, Operation, Slot};
use crate::interpreter::run::defined;
use std::collections::{HashMap, HashSet};
use std::ops::Range;

/// The same instruction on as many scalars as a vector has, which lie in a row; an operand may be one for all of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct VectorInstruction {
    operation: Operation,
    class: ArithmeticClass,
    count: u8,
    /// How far each operand goes on from scalar to scalar: 0 or 1.
    strides: [u8; 3],
    to: Slot,
    of: [Slot; 3],
}

impl VectorInstruction {
    /// Does it.
    #[inline]
    pub(super) fn run(&self, registers: &mut [f64]) {
        // Those that are used most are known to the compiler one by one, which makes them three times as fast.
        macro_rules! quick {
            ($($operation:ident $operands:literal),*) => {
                match (self.operation, self.class) {
                    $((Operation::$operation, ArithmeticClass::Float) => {
                        self.each::<$operands>(registers, |of| defined(Operation::$operation, ArithmeticClass::Float, of));
                    })*
                    (Operation::Copy, _) => self.each::<1>(registers, |[a, _, _]| a),
                    (operation, class) => self.each::<3>(registers, |of| defined(operation, class, of)),
                }
            };
        }
        quick!(Add 2, Subtract 2, Multiply 2, Divide 2, MultiplyAdd 3, Maximum 2);
    }

    /// Reads so many operands for each scalar.
    #[inline(always)]
    fn each<const OPERANDS: usize>(&self, registers: &mut [f64], of: impl Fn([f64; 3]) -> f64) {
        for index in 0..usize::from(self.count) {
            let mut operands = [0.0; 3];
            for at in 0..OPERANDS {
                operands[at] = registers[self.of[at] as usize + index * usize::from(self.strides[at])];
            }
            registers[self.to as usize + index] = of(operands);
        }
    }

    /// Whether an instruction does the same to the next scalar.
    fn goes_on_with(&mut self, next: &Instruction) -> bool {
        let count = Slot::from(self.count);
        if (next.operation, next.class, next.to) != (self.operation, self.class, self.to + count)
            || self.count == u8::MAX
        {
            return false;
        }
        let mut strides = self.strides;
        for ((stride, first), next) in strides.iter_mut().zip(self.of).zip(next.of) {
            // A first instruction goes on either way.
            let fits = |by: Slot| next == first + by * count;
            match [0, 1].into_iter().find(|&by| fits(by) && (self.count == 1 || by == Slot::from(*stride))) {
                Some(by) => *stride = by as u8,
                None => return false,
            }
        }
        if next.of.iter().any(|slot| (self.to..next.to).contains(slot)) {
            return false;
        }
        (self.strides, self.count) = (strides, self.count + 1);
        true
    }
}

/// The nodes as steps one after the other, without those that `target` does not need; `None` where they branch.
/// `temporaries`: where values may be kept on the way.
pub(super) fn steps(nodes: &[Node], target: Range<Slot>, temporaries: Range<Slot>) -> Option<Vec<VectorInstruction>> {
    let mut instructions = in_a_row(nodes, &target)?;
    keep_needed(&mut instructions, target.clone());
    move_together(&mut instructions, &target, temporaries);
    let mut steps: Vec<VectorInstruction> = Vec::with_capacity(instructions.len());
    for one in &instructions {
        if !steps.last_mut().is_some_and(|last| last.goes_on_with(one)) {
            let Instruction { operation, class, to, of, .. } = *one;
            steps.push(VectorInstruction { operation, class, count: 1, strides: [0; 3], to, of });
        }
    }
    Some(steps)
}

fn in_a_row(nodes: &[Node], target: &Range<Slot>) -> Option<Vec<Instruction>> {
    let mut instructions: Vec<Instruction> = Vec::with_capacity(nodes.len());
    for node in nodes {
        match node {
            Node::Do(one) => instructions.push(*one),
            Node::Store { to, from } => match instructions.iter().rposition(|one| one.to == *from) {
                // What is computed for the target goes there at once.
                Some(place) if !target.contains(from) => {
                    instructions[place].to = *to;
                    let later = instructions[place + 1..].iter_mut().flat_map(|one| &mut one.of);
                    later.filter(|slot| **slot == *from).for_each(|slot| *slot = *to);
                    // It may be stored once more.
                    instructions.push(copy(*from, *to));
                }
                _ => instructions.push(copy(*to, *from)),
            },
            _ => return None,
        }
    }
    Some(instructions)
}

fn copy(to: Slot, from: Slot) -> Instruction {
    Instruction { operation: Operation::Copy, class: ArithmeticClass::Double, to, of: [from; 3], line: 0 }
}

fn keep_needed(instructions: &mut Vec<Instruction>, target: Range<Slot>) {
    let mut needed: HashSet<Slot> = target.collect();
    let mut is_needed: Vec<bool> = Vec::with_capacity(instructions.len());
    for one in instructions.iter().rev() {
        is_needed.push(needed.remove(&one.to));
        if is_needed.last() == Some(&true) {
            needed.extend(one.of);
        }
    }
    instructions.retain(|_| is_needed.pop().unwrap_or(true));
}

/// Values that are computed one after the other lie one after the other.
fn move_together(instructions: &mut [Instruction], target: &Range<Slot>, mut temporaries: Range<Slot>) {
    let mut moved: HashMap<Slot, Slot> = HashMap::new();
    for one in instructions {
        one.of.iter_mut().for_each(|slot| *slot = moved.get(slot).copied().unwrap_or(*slot));
        if !target.contains(&one.to)
            && let Some(place) = temporaries.next()
        {
            moved.insert(one.to, place);
            one.to = place;
        }
    }
}
