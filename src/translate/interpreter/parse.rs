//! What the compiler wrote → an [`Interpreter`].

use super::{Interpreter, Value, Variable};
use crate::translate::spirv::code::{Code, Instruction};
use crate::translate::spirv::op;
use std::collections::HashMap;

/// What a type consists of.
#[derive(Clone, Debug)]
pub(super) enum TypeShape {
    Bool,
    Int,
    Float,
    /// So many of one type: a vector, a matrix, an array.
    Repeated(u32, usize),
    Structure(Vec<u32>),
    Pointer(u32),
    /// The number of a texture; -1 for none.
    Sampler,
}

/// Where a global variable gets its value from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Class {
    /// From the program: attributes, uniforms.
    Input,
    Output,
    /// From the shader.
    Private,
}

/// Numbers of SPIR-V, section 3.7.
mod storage {
    pub const INPUT: u32 = 1;
    pub const OUTPUT: u32 = 3;
    pub const PRIVATE: u32 = 6;
}

/// The built-in variable `gl_Position`, SPIR-V, section 3.21.
const POSITION: u32 = 0;

/// Variables have no more components than this: every load copies them.
const MAX_COMPONENTS: usize = 1024;

impl Interpreter {
    /// Reads words; `None` for what is not known here.
    pub fn new(words: &[u32]) -> Option<Self> {
        let code = Code::parse(words)?;
        let shapes = shapes(&code)?;
        let mut interpreter = Self {
            constants: Vec::new(),
            shapes,
            names: code.names(),
            members: code.member_names(),
            variables: Vec::new(),
            starts: HashMap::new(),
            main: *code.heads.iter().find(|i| i.opcode == op::ENTRY_POINT)?.operands.get(1)?,
            position: position(&code),
            bound: code.bound() as usize,
            instructions: code.functions,
        };
        interpreter.constants = vec![None; interpreter.bound];
        for instruction in &code.globals {
            interpreter.global(instruction, &code.heads)?;
        }
        let is_large =
            |shape: &TypeShape| matches!(shape, TypeShape::Pointer(of) if interpreter.size(*of) > MAX_COMPONENTS);
        if interpreter.shapes.values().any(is_large) {
            return None;
        }
        for (at, instruction) in interpreter.instructions.iter().enumerate() {
            match instruction.opcode {
                op::FUNCTION => interpreter.starts.insert(*instruction.operands.get(1)?, at),
                op::LABEL => interpreter.starts.insert(*instruction.operands.first()?, at),
                _ => None,
            };
        }
        Some(interpreter)
    }

    /// How many components a value of a type has.
    fn size(&self, shape: u32) -> usize {
        match self.shapes.get(&shape) {
            Some(TypeShape::Repeated(part, count)) => self.size(*part).saturating_mul(*count),
            Some(TypeShape::Structure(parts)) => {
                parts.iter().map(|part| self.size(*part)).fold(0, usize::saturating_add)
            }
            _ => 1,
        }
    }

    /// Takes a constant or a global variable.
    fn global(&mut self, instruction: &Instruction, heads: &[Instruction]) -> Option<()> {
        let operands = &instruction.operands;
        let value = match instruction.opcode {
            op::VARIABLE => {
                let TypeShape::Pointer(shape) = *self.shapes.get(operands.first()?)? else { return None };
                let class = match *operands.get(2)? {
                    storage::PRIVATE => Class::Private,
                    storage::OUTPUT => Class::Output,
                    storage::INPUT | op::storage::UNIFORM_CONSTANT | op::storage::UNIFORM => Class::Input,
                    _ => return None,
                };
                let id = operands[1];
                let built_in = |number: u32| {
                    let is_it = |i: &Instruction| {
                        i.opcode == op::DECORATE && i.operands == [id, op::decoration::BUILT_IN, number]
                    };
                    heads.iter().any(is_it)
                };
                let is_vertex_number = built_in(op::built_in::VERTEX_ID) || built_in(op::built_in::VERTEX_INDEX);
                let initial = operands.get(3).copied();
                let named = if operands[2] == op::storage::UNIFORM { shape } else { id };
                self.variables.push(Variable { id, named, shape, class, initial, is_vertex_number });
                return Some(());
            }
            op::CONSTANT_TRUE => Value::Bool(true),
            op::CONSTANT_FALSE => Value::Bool(false),
            op::CONSTANT => self.number(*operands.first()?, operands.get(2..)?)?,
            op::CONSTANT_NULL | op::UNDEF => self.zero(*operands.first()?)?,
            op::CONSTANT_COMPOSITE => {
                let part = |id: &u32| self.constants.get(*id as usize)?.clone();
                Value::Composite(operands.get(2..)?.iter().map(part).collect::<Option<_>>()?)
            }
            _ => return Some(()),
        };
        *self.constants.get_mut(*operands.get(1)? as usize)? = Some(value);
        Some(())
    }

    fn number(&self, shape: u32, words: &[u32]) -> Option<Value> {
        match (self.shapes.get(&shape)?, words) {
            (TypeShape::Int, [bits]) => Some(Value::Int(*bits)),
            (TypeShape::Float, [bits]) => Some(Value::Float(f64::from(f32::from_bits(*bits)))),
            (TypeShape::Float, [low, high]) => {
                Some(Value::Float(f64::from_bits(u64::from(*high) << 32 | u64::from(*low))))
            }
            _ => None,
        }
    }
}

/// The types by id; those that nothing here computes with are left out.
fn shapes(code: &Code) -> Option<HashMap<u32, TypeShape>> {
    let mut shapes = HashMap::new();
    for instruction in &code.globals {
        let operands = &instruction.operands;
        let count = |at: usize| operands.get(at).map(|count| *count as usize);
        let shape = match instruction.opcode {
            op::TYPE_BOOL => TypeShape::Bool,
            op::TYPE_INT => TypeShape::Int,
            op::TYPE_FLOAT => TypeShape::Float,
            op::TYPE_VECTOR | op::TYPE_MATRIX => TypeShape::Repeated(*operands.get(1)?, count(2)?),
            op::TYPE_ARRAY => {
                let length =
                    code.globals.iter().find(|i| i.opcode == op::CONSTANT && i.operands.get(1) == operands.get(2));
                TypeShape::Repeated(*operands.get(1)?, *length?.operands.get(2)? as usize)
            }
            op::TYPE_STRUCT => TypeShape::Structure(operands.get(1..)?.to_vec()),
            op::TYPE_SAMPLED_IMAGE => TypeShape::Sampler,
            op::TYPE_POINTER => TypeShape::Pointer(*operands.get(2)?),
            _ => continue,
        };
        shapes.insert(*operands.first()?, shape);
    }
    Some(shapes)
}

/// The structure and its member that is `gl_Position`.
fn position(code: &Code) -> Option<(u32, usize)> {
    let is_it = |i: &&Instruction| {
        i.opcode == op::MEMBER_DECORATE && i.operands.get(2..) == Some(&[op::decoration::BUILT_IN, POSITION])
    };
    let found = code.heads.iter().find(is_it)?;
    Some((found.operands[0], found.operands[1] as usize))
}
