//! Runs a shader on the CPU, one vertex or fragment at a time, and lets one look at every value on its way and change it.
//!
//! What is drawn and judged comes from the driver. This is for questions about the student's text: which statement
//! computes what a message speaks of, and what the shader would do with other input. It knows what answers to shading
//! homework are made of; for anything else there is no answer, and whoever asks says less.

mod lookup;
mod operations;
mod parse;
mod value;

pub use value::Value;

use super::spirv::code::Instruction;
use super::spirv::op;
use parse::{Class, TypeShape};
use reference::interpreter::Texture;
use std::collections::HashMap;

/// A shader that can be run step by step.
#[derive(Debug)]
pub struct Interpreter {
    instructions: Vec<Instruction>,
    /// Constants by id.
    constants: Vec<Option<Value>>,
    shapes: HashMap<u32, TypeShape>,
    names: HashMap<u32, String>,
    /// Names of members, by structure and number.
    members: HashMap<(u32, u32), String>,
    variables: Vec<Variable>,
    /// From functions and labels to where they begin.
    starts: HashMap<u32, usize>,
    main: u32,
    /// From the type of a structure to the member that is `gl_Position`.
    position: Option<(u32, usize)>,
    bound: usize,
}

/// A global variable.
#[derive(Debug)]
struct Variable {
    id: u32,
    /// What has its name: itself, or the type of a block.
    named: u32,
    shape: u32,
    class: Class,
    initial: Option<u32>,
    /// Whether it is the number of the vertex.
    is_vertex_number: bool,
}

/// What a shader is run with.
#[derive(Clone, Debug, Default)]
pub struct Invocation<'a> {
    /// Inputs of the stage and uniforms, by name or path, `lamps[0].colour`; the others are 0. A sampler is the number of a texture.
    pub inputs: Vec<(&'a str, Value)>,
    /// What samplers read.
    pub textures: &'a [Texture],
    /// Global variables that keep this value whatever the shader assigns at its start.
    pub kept: Vec<(&'a str, Value)>,
    /// `gl_VertexID`.
    pub vertex: u32,
    /// Whether the output is held in fixed point, from 0 to 1.
    pub clamps: bool,
}

/// What a shader wrote.
#[derive(Clone, Debug, PartialEq)]
pub struct Written {
    /// The output that was asked for.
    pub output: Vec<f64>,
    /// `gl_Position`.
    pub position: Option<Vec<f64>>,
    /// How many instructions it took.
    pub steps: u32,
}

/// A value on its way: the result of an instruction, or a constant that it takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Site {
    /// The instruction, in the order of the text.
    pub instruction: u32,
    /// How often it was reached before.
    pub turn: u32,
    /// 0 for the result; from 1 for that operand.
    pub operand: u8,
}

/// Looks at a value, and gives another to be taken instead.
pub type Watch<'w> = dyn FnMut(Site, &Value) -> Option<Value> + 'w;

/// A run has no more steps than this; a homework's answer has a few hundred.
const MAX_STEPS: u32 = 10_000;
/// GLSL has no recursion; functions nest no deeper than this.
const MAX_CALLS: u32 = 64;

impl Interpreter {
    /// Runs the shader, with `watch` beside it. `None` for what it does not know, or does not end.
    pub fn run(&self, given: &Invocation<'_>, output: &str, watch: &mut Watch<'_>) -> Option<Written> {
        let mut run = Run {
            of: self,
            watch,
            textures: given.textures,
            values: vec![None; self.bound],
            turns: vec![0; self.instructions.len()],
            memory: Vec::new(),
            kept: 0,
            steps: 0,
            calls: 0,
        };
        run.start(given)?;
        run.call(self.main, Vec::new())?;
        let find = |name: &str| self.variables.iter().position(|v| v.class == Class::Output && self.name(v.id) == name);
        let mut output = run.memory.get(find(output)?)?.floats()?;
        if given.clamps {
            output.iter_mut().for_each(|number| *number = number.clamp(0.0, 1.0));
        }
        let block = self.position.and_then(|(shape, member)| {
            let at = self.variables.iter().position(|v| v.shape == shape)?;
            run.memory.get(at)?.at(&[member])
        });
        let position = block.or_else(|| run.memory.get(find("gl_Position")?)).and_then(Value::floats);
        Some(Written { output, position, steps: run.steps })
    }

    /// The line of the student's file that an instruction comes from.
    pub fn line(&self, place: Site) -> Option<u32> {
        self.instructions.get(place.instruction as usize)?.line
    }

    /// Whether an instruction only moves a value.
    pub fn is_copy(&self, place: Site) -> bool {
        let opcode = self.opcode(place);
        place.operand > 0
            || matches!(
                opcode,
                Some(
                    op::LOAD
                        | op::COMPOSITE_EXTRACT
                        | op::COMPOSITE_CONSTRUCT
                        | op::VECTOR_SHUFFLE
                        | op::COPY_OBJECT
                        | op::FUNCTION_CALL
                )
            )
    }

    /// Whether an instruction adds or subtracts.
    pub fn is_sum(&self, place: Site) -> bool {
        place.operand == 0 && matches!(self.opcode(place), Some(op::F_ADD | op::F_SUB))
    }

    fn opcode(&self, place: Site) -> Option<u16> {
        Some(self.instructions.get(place.instruction as usize)?.opcode)
    }

    /// The variable that the result of an instruction is loaded from, or stored in as it is.
    pub fn variable(&self, place: Site) -> Option<&str> {
        let instruction = self.instructions.get(place.instruction as usize)?;
        let variable = match (instruction.opcode, place.operand) {
            (op::LOAD, 0) => *instruction.operands.get(2)?,
            (op::STORE, _) => *instruction.operands.first()?,
            _ => {
                let (_, result) = instruction.result()?;
                let after = self.instructions.get(place.instruction as usize + 1..)?;
                let is_store = |i: &&Instruction| i.opcode == op::STORE && i.operands.get(1) == Some(&result);
                *after.iter().find(is_store)?.operands.first()?
            }
        };
        let name = self.names.get(&variable)?.as_str();
        // The compiler's own variables, those that carry arguments among them, have names that no line shows.
        (!name.is_empty() && name != "param").then_some(name)
    }

    /// Whether an instruction stores something in the variable `name`.
    pub fn stores_in(&self, place: Site, name: &str) -> bool {
        self.opcode(place) == Some(op::STORE) && self.base_of_store(place).is_some_and(|id| self.name(id) == name)
    }

    /// Whether an instruction reads the whole of the variable `name`.
    pub fn is_load_of(&self, place: Site, name: &str) -> bool {
        self.opcode(place) == Some(op::LOAD) && self.variable(place) == Some(name)
    }

    /// The last statement that assigns to the whole of the variable `name`, or to part of it where none does.
    pub fn last_store(&self, name: &str) -> Option<Site> {
        let all = (0..self.instructions.len() as u32).map(|instruction| Site { instruction, turn: 0, operand: 2 });
        let stores: Vec<Site> = all.filter(|place| self.stores_in(*place, name)).collect();
        let is_whole = |place: &&Site| self.variable(**place) == Some(name);
        stores.iter().rfind(is_whole).or(stores.last()).copied()
    }

    /// Whether the shader has a global variable of this name that it sets itself.
    pub fn has_variable(&self, name: &str) -> bool {
        self.variables.iter().any(|variable| variable.class == Class::Private && self.name(variable.id) == name)
    }

    /// The line of the last statement that assigns to `gl_Position`.
    pub fn last_position(&self) -> Option<u32> {
        let block = self.variables.iter().find(|v| self.position.is_some_and(|(shape, _)| shape == v.shape));
        let mut all = (0..self.instructions.len() as u32).map(|instruction| Site { instruction, turn: 0, operand: 2 });
        let is_it = |place: &Site| {
            self.opcode(*place) == Some(op::STORE)
                && self
                    .base_of_store(*place)
                    .is_some_and(|id| block.is_some_and(|b| b.id == id) || self.name(id) == "gl_Position")
        };
        self.line(all.rfind(is_it)?)
    }

    fn base_of_store(&self, place: Site) -> Option<u32> {
        let pointer = *self.instructions.get(place.instruction as usize)?.operands.first()?;
        let chain = |i: &&Instruction| {
            matches!(i.opcode, op::ACCESS_CHAIN | op::IN_BOUNDS_ACCESS_CHAIN) && i.operands.get(1) == Some(&pointer)
        };
        Some(self.instructions.iter().find(chain).and_then(|i| i.operands.get(2)).copied().unwrap_or(pointer))
    }

    /// The function that an instruction stands in, by the number of its first instruction.
    pub fn function(&self, place: Site) -> usize {
        let before = &self.instructions[..=place.instruction as usize];
        before.iter().rposition(|i| i.opcode == op::FUNCTION).unwrap_or(0)
    }

    /// Whether a constant is what a global variable begins with.
    pub fn is_initial(&self, place: Site) -> bool {
        let is_global = |id: u32| self.variables.iter().any(|v| v.id == id && v.class == Class::Private);
        place.operand > 0 && self.opcode(place) == Some(op::STORE) && self.base_of_store(place).is_some_and(is_global)
    }

    /// The number of the first instruction of `main`.
    pub fn function_of_main(&self) -> usize {
        self.starts.get(&self.main).copied().unwrap_or(0)
    }

    /// Whether two values are computed in the same way on the same line.
    pub fn is_alike(&self, a: Site, b: Site) -> bool {
        self.line(a) == self.line(b) && self.opcode(a) == self.opcode(b)
    }

    fn name(&self, id: u32) -> &str {
        self.names.get(&id).map_or("", String::as_str)
    }

    /// The zero of a type.
    fn zero(&self, shape: u32) -> Option<Value> {
        Some(match self.shapes.get(&shape)? {
            TypeShape::Bool => Value::Bool(false),
            TypeShape::Int => Value::Int(0),
            TypeShape::Float => Value::Float(0.0),
            TypeShape::Repeated(part, count) => Value::Composite(vec![self.zero(*part)?; *count]),
            TypeShape::Structure(parts) => {
                Value::Composite(parts.iter().map(|part| self.zero(*part)).collect::<Option<_>>()?)
            }
            TypeShape::Sampler => Value::Float(-1.0),
            TypeShape::Pointer(_) => return None,
        })
    }

    /// A value of a type, of what is given by paths below `path`.
    fn fed(&self, shape: u32, path: &str, inputs: &[(&str, Value)]) -> Option<Value> {
        let zero = self.zero(shape)?;
        if let Some((_, value)) = inputs.iter().find(|(name, _)| *name == path) {
            return fitted(value.clone(), &zero);
        }
        match self.shapes.get(&shape)? {
            TypeShape::Structure(parts) => {
                let part = |(number, part): (u32, &u32)| {
                    let name = self.members.get(&(shape, number)).map_or("", String::as_str);
                    self.fed(*part, &format!("{path}.{name}"), inputs)
                };
                (0..).zip(parts).map(part).collect::<Option<_>>().map(Value::Composite)
            }
            // The parts of vectors and matrices are no variables.
            TypeShape::Repeated(part, count)
                if inputs.iter().any(|(name, _)| name.starts_with(&format!("{path}["))) =>
            {
                let part = |at| self.fed(*part, &format!("{path}[{at}]"), inputs);
                (0..*count).map(part).collect::<Option<_>>().map(Value::Composite)
            }
            _ => Some(zero),
        }
    }
}

/// One run.
struct Run<'a, 'w> {
    of: &'a Interpreter,
    watch: &'a mut Watch<'w>,
    textures: &'a [Texture],
    values: Vec<Option<Value>>,
    turns: Vec<u32>,
    memory: Vec<Value>,
    /// The variables that keep their value, as bits.
    kept: u128,
    steps: u32,
    calls: u32,
}

/// How an instruction goes on.
enum Flow {
    Next,
    Branch(u32),
    Return(Option<Value>),
}

impl Run<'_, '_> {
    /// Fills the global variables.
    fn start(&mut self, given: &Invocation<'_>) -> Option<()> {
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

    fn call(&mut self, function: u32, arguments: Vec<Value>) -> Option<Option<Value>> {
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
fn fitted(value: Value, wanted: &Value) -> Option<Value> {
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

#[cfg(test)]
mod tests;
