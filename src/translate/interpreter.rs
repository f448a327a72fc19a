//! Runs a shader on the CPU, one vertex or fragment at a time, and lets one look at every value on its way and change it.
//!
//! What is drawn and judged comes from the driver. This is for questions about the student's text: which statement
//! computes what a message speaks of, and what the shader would do with other input. It knows what answers to shading
//! homework are made of; for anything else there is no answer, and whoever asks says less.

mod lookup;
mod operations;
mod parse;
mod run;
mod value;

pub use value::Value;

use super::spirv::code::Instruction;
use super::spirv::op;
use parse::{Class, TypeShape};
use reference::interpreter::Texture;
use run::{Run, fitted};
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

impl Interpreter {
    /// Runs the shader, with `watch` beside it. `None` for what it does not know, or does not end.
    pub fn run(&self, given: &Invocation<'_>, output: &str, watch: &mut Watch<'_>) -> Option<Written> {
        let mut run = Run::new(self, given, watch);
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

#[cfg(test)]
mod tests;
