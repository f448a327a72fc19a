//! One run, instruction by instruction.

use super::parse::{Class, TypeShape};
use super::{Interpreter, Invocation, Site, Value, Watch, lookup, operations};
use crate::translate::spirv::code::Instruction;
use crate::translate::spirv::op;
use reference::interpreter::Texture;

/// A run has no more steps than this; a homework's answer has a few hundred.
const MAX_STEPS: u32 = 10_000;
/// GLSL has no recursion; functions nest no deeper than this.
const MAX_CALLS: u32 = 64;

/// One run.
pub(super) struct Run<'a, 'w> {
    of: &'a Interpreter,
    watch: &'a mut Watch<'w>,
    textures: &'a [Texture],
    values: Vec<Option<Value>>,
    turns: Vec<u32>,
    pub memory: Vec<Value>,
    /// The variables that keep their value, as bits.
    kept: u128,
    pub steps: u32,
    calls: u32,
}

/// How an instruction goes on.
enum Flow {
    Next,
    Branch(u32),
    Return(Option<Value>),
}

impl<'a, 'w> Run<'a, 'w> {
    pub fn new(of: &'a Interpreter, given: &Invocation<'a>, watch: &'a mut Watch<'w>) -> Self {
        Self {
            of,
            watch,
            textures: given.textures,
            values: vec![None; of.bound],
            turns: vec![0; of.instructions.len()],
            memory: Vec::new(),
            kept: 0,
            steps: 0,
            calls: 0,
        }
    }
}

impl Run<'_, '_> {
    /// Fills the global variables.
    pub fn start(&mut self, given: &Invocation<'_>) -> Option<()> {
        for (slot, variable) in self.of.variables.iter().enumerate() {
            let name = self.of.name(variable.named);
            let by_name = |named: &[(&str, Value)]| named.iter().find(|(n, _)| *n == name).map(|(_, v)| v.clone());
            let kept = by_name(&given.kept).filter(|_| variable.class == Class::Private && slot < 128);
            self.kept |= u128::from(kept.is_some()) << slot.min(127);
            let is_given = |given: &str| match given.strip_prefix(name) {
                Some(rest) => variable.class == Class::Input && (rest.is_empty() || rest.starts_with(['.', '['])),
                None => false,
            };
            let is_fed = given.inputs.iter().any(|(name, _)| is_given(name));
            let input = if is_fed { Some(self.of.fed(variable.shape, name, &given.inputs)?) } else { None };
            let initial = variable.initial.and_then(|id| self.of.constants.get(id as usize)?.clone());
            let zero = self.of.zero(variable.shape)?;
            let value = match kept.or(input).or(initial) {
                Some(value) => fitted(value, &zero)?,
                None if variable.is_vertex_number => Value::Int(given.vertex),
                None => zero,
            };
            self.memory.push(value);
            self.values[variable.id as usize] = Some(Value::Pointer(slot, Vec::new()));
        }
        Some(())
    }

    pub fn call(&mut self, function: u32, arguments: Vec<Value>) -> Option<Option<Value>> {
        self.calls += 1;
        if self.calls > MAX_CALLS {
            return None;
        }
        let locals = self.memory.len();
        let mut at = *self.of.starts.get(&function)? + 1;
        let mut arguments = arguments.into_iter();
        let (mut block, mut before) = (0, 0);
        let result = loop {
            self.steps += 1;
            let instruction = self.of.instructions.get(at).filter(|_| self.steps <= MAX_STEPS)?;
            match instruction.opcode {
                op::FUNCTION_PARAMETER => {
                    *self.values.get_mut(*instruction.operands.get(1)? as usize)? = Some(arguments.next()?);
                }
                op::LABEL => (before, block) = (block, *instruction.operands.first()?),
                op::PHI => {
                    let pairs = instruction.operands.get(2..)?.chunks_exact(2);
                    let value = pairs.into_iter().find(|pair| pair[1] == before)?[0];
                    let value = self.value(value)?;
                    *self.values.get_mut(instruction.operands[1] as usize)? = Some(value);
                }
                _ => match self.step(at, instruction)? {
                    Flow::Next => {}
                    Flow::Branch(label) => {
                        at = *self.of.starts.get(&label)?;
                        continue;
                    }
                    Flow::Return(value) => break value,
                },
            }
            at += 1;
        };
        self.memory.truncate(locals);
        self.calls -= 1;
        Some(result)
    }

    fn step(&mut self, at: usize, instruction: &Instruction) -> Option<Flow> {
        let turn = self.turns[at];
        self.turns[at] += 1;
        let place = Site { instruction: at as u32, turn, operand: 0 };
        let operands = &instruction.operands;
        match instruction.opcode {
            op::STORE => {
                let value = self.operand(operands[1], Site { operand: 2, ..place })?;
                let Value::Pointer(slot, way) = self.value(operands[0])? else { return None };
                if slot >= 128 || self.kept >> slot & 1 == 0 {
                    *self.memory.get_mut(slot)?.at_mut(&way)? = value;
                }
            }
            op::LOOP_MERGE | op::SELECTION_MERGE => {}
            op::BRANCH => return Some(Flow::Branch(operands[0])),
            op::BRANCH_CONDITIONAL => {
                let truth = self.operand(operands[0], Site { operand: 1, ..place })?.bool()?;
                return Some(Flow::Branch(operands[if truth { 1 } else { 2 }]));
            }
            op::SWITCH => {
                let chosen = self.value(operands[0])?.int()?;
                let case = operands.get(2..)?.chunks_exact(2).find(|case| case[0] == chosen);
                return Some(Flow::Branch(case.map_or(operands[1], |case| case[1])));
            }
            op::RETURN => return Some(Flow::Return(None)),
            op::RETURN_VALUE => {
                let value = self.operand(operands[0], Site { operand: 1, ..place })?;
                return Some(Flow::Return(Some(value)));
            }
            _ => {
                let (_, id) = instruction.result()?;
                let Some(mut value) = self.result(instruction, place)? else { return Some(Flow::Next) };
                if !matches!(value, Value::Pointer(..))
                    && let Some(other) = (self.watch)(place, &value)
                {
                    value = other;
                }
                *self.values.get_mut(id as usize)? = Some(value);
            }
        }
        Some(Flow::Next)
    }

    /// What an instruction computes; an inner `None` where that is nothing.
    fn result(&mut self, instruction: &Instruction, place: Site) -> Option<Option<Value>> {
        let operands = &instruction.operands;
        let ids = operands.get(2..)?;
        Some(Some(match instruction.opcode {
            op::VARIABLE => {
                let TypeShape::Pointer(shape) = self.of.shapes.get(&operands[0])? else { return None };
                let initial = operands.get(3).map(|id| self.value(*id));
                self.memory.push(initial.unwrap_or_else(|| self.of.zero(*shape))?);
                Value::Pointer(self.memory.len() - 1, Vec::new())
            }
            op::LOAD => {
                let Value::Pointer(slot, way) = self.value(ids[0])? else { return None };
                self.memory.get(slot)?.at(&way)?.clone()
            }
            op::ACCESS_CHAIN | op::IN_BOUNDS_ACCESS_CHAIN => {
                let Value::Pointer(slot, mut way) = self.value(ids[0])? else { return None };
                for id in &ids[1..] {
                    way.push(self.value(*id)?.int()? as usize);
                }
                Value::Pointer(slot, way)
            }
            op::UNDEF => self.of.zero(operands[0])?,
            op::FUNCTION_CALL => {
                let arguments: Option<Vec<Value>> = ids[1..].iter().map(|id| self.value(*id)).collect();
                return self.call(ids[0], arguments?);
            }
            op::COMPOSITE_EXTRACT => {
                let way: Vec<usize> = ids[1..].iter().map(|index| *index as usize).collect();
                self.value(ids[0])?.at(&way)?.clone()
            }
            op::COMPOSITE_INSERT => {
                let (part, mut whole) = (self.value(ids[0])?, self.value(ids[1])?);
                let way: Vec<usize> = ids[2..].iter().map(|index| *index as usize).collect();
                *whole.at_mut(&way)? = part;
                whole
            }
            op::COMPOSITE_CONSTRUCT => self.construct(operands[0], ids, place)?,
            op::VECTOR_SHUFFLE => {
                let both = [self.operand(ids[0], place_of(place, 1))?, self.operand(ids[1], place_of(place, 2))?];
                let parts: Vec<&Value> = both.iter().flat_map(|v| v.parts().unwrap_or_default()).collect();
                let chosen = ids[2..].iter().map(|index| Some((*parts.get(*index as usize)?).clone()));
                Value::Composite(chosen.collect::<Option<_>>()?)
            }
            op::IMAGE => self.value(ids[0])?,
            op::IMAGE_SAMPLE_FIRST..=op::IMAGE_FETCH => {
                let coordinates = self.operand(ids[1], place_of(place, 2))?;
                let extra = ids.get(2..).unwrap_or_default();
                let operand = |number: usize| self.value(*extra.get(number)?);
                lookup::read(
                    self.textures,
                    instruction.opcode,
                    &self.value(ids[0])?,
                    &coordinates,
                    extra.first().copied(),
                    &operand,
                )?
            }
            op::EXT_INST => {
                let arguments: Option<Vec<Value>> =
                    ids[2..].iter().zip(1..).map(|(id, at)| self.operand(*id, place_of(place, at))).collect();
                operations::extended(ids[1], &arguments?)?
            }
            opcode => {
                let operands: Option<Vec<Value>> =
                    ids.iter().zip(1..).map(|(id, at)| self.operand(*id, place_of(place, at))).collect();
                operations::compute(opcode, &operands?)?
            }
        }))
    }

    /// A vector may be made of vectors; anything else is made of its parts.
    fn construct(&mut self, shape: u32, ids: &[u32], place: Site) -> Option<Value> {
        let mut parts = Vec::new();
        for (id, at) in ids.iter().zip(1..) {
            parts.push(self.operand(*id, place_of(place, at))?);
        }
        let TypeShape::Repeated(part, count) = self.of.shapes.get(&shape)? else {
            return Some(Value::Composite(parts));
        };
        if parts.len() == *count || matches!(self.of.shapes.get(part)?, TypeShape::Repeated(..)) {
            return Some(Value::Composite(parts));
        }
        let flat = parts.into_iter().flat_map(|part| match part {
            Value::Composite(parts) => parts,
            scalar => vec![scalar],
        });
        Some(Value::Composite(flat.collect()))
    }

    fn value(&self, id: u32) -> Option<Value> {
        let value = self.values.get(id as usize)?.as_ref();
        value.or_else(|| self.of.constants.get(id as usize)?.as_ref()).cloned()
    }

    /// The value of an operand; a constant is shown to the watch, for no instruction computes it.
    fn operand(&mut self, id: u32, place: Site) -> Option<Value> {
        let value = self.value(id)?;
        let is_constant = self.of.constants.get(id as usize).is_some_and(Option::is_some);
        let is_condition = place.operand == 1 && self.of.opcode(place) == Some(op::BRANCH_CONDITIONAL);
        if !(is_constant || is_condition) {
            return Some(value);
        }
        Some((self.watch)(place, &value).unwrap_or(value))
    }
}

/// As many numbers as a shader takes, of those that there are.
pub(super) fn fitted(value: Value, wanted: &Value) -> Option<Value> {
    Some(match (value, wanted) {
        (Value::Composite(mut parts), Value::Composite(wanted)) => {
            parts.truncate(wanted.len());
            Value::Composite(parts)
        }
        (Value::Composite(parts), _) => parts.into_iter().next()?,
        (scalar, _) => scalar,
    })
}

fn place_of(place: Site, operand: u8) -> Site {
    Site { operand, ..place }
}
