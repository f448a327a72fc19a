//! Global variables as wgpu takes them: uniforms that are set in one block, all others private.

use super::code::{Code, Instruction};
use super::images;
use super::op::{self, built_in, decoration, execution_mode, storage};
use std::collections::HashMap;

/// Name of the block of OpenGL's default-block uniforms.
pub const DEFAULT_BLOCK: &str = "gl_DefaultUniformBlock";

/// The built-in uniform that holds the range of depth in window coordinates.
const DEPTH_RANGE: &str = "gl_DepthRange";

/// A uniform variable or block of which the shader reads and the program sets nothing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unset {
    /// Its name, or that of the block.
    pub name: String,
    /// The GLSL type of a variable, as far as it has a short one; `block` for a block.
    pub ty: &'static str,
}

/// Where a global variable goes.
enum Place {
    /// Member of the default block, by its number.
    Member(u32),
    /// Private, with what is its initial value anyhow.
    Private,
}

/// Reworks the global variables; gives the uniforms that nothing sets.
pub(super) fn rework(code: &mut Code, set: &[&str]) -> Vec<Unset> {
    images::plain_types(code);
    uncaught(code);
    let names = code.names();
    let never_set = draw_parameters(code);
    let variables: Vec<Instruction> = code.globals.iter().filter(|i| i.opcode == op::VARIABLE).cloned().collect();
    let mut places = HashMap::new();
    let mut members = Vec::new();
    let mut unset = Vec::new();
    let mut initials = HashMap::new();
    for variable in &variables {
        let [pointer, id, class, ..] = variable.operands[..] else { continue };
        let Some(pointee) = pointee(code, pointer) else { continue };
        if never_set.contains(&id) {
            places.insert(id, (Place::Private, pointee));
        }
        if !matches!(class, storage::UNIFORM_CONSTANT | storage::UNIFORM) || !has_size(code, pointee) {
            continue;
        }
        let is_block = class == storage::UNIFORM;
        let name_of = |id| names.get(&id).cloned().unwrap_or_default();
        let name = name_of(if is_block { element(code, pointee) } else { id });
        if !is_block && set.contains(&name.as_str()) && is_numeric(code, pointee) {
            places.insert(id, (Place::Member(members.len() as u32), pointee));
            members.push((name, pointee));
        } else if name == DEPTH_RANGE {
            places.insert(id, (Place::Private, pointee));
            initials.insert(id, depth_range(code, pointee));
        } else {
            places.insert(id, (Place::Private, pointee));
            unset.push(Unset { name, ty: if is_block { "block" } else { short_name(code, pointee) } });
        }
    }
    let block = (!members.is_empty()).then(|| default_block(code, &members));
    for variable in &variables {
        if let Some((place, pointee)) = places.get(&variable.operands[1]) {
            let initial = initials.get(&variable.operands[1]).or(variable.operands.get(3)).copied();
            replace(code, variable, place, *pointee, initial);
        }
    }
    uses(code, &places, block);
    unset
}

/// Takes away what says which outputs transform feedback catches: the program catches none.
fn uncaught(code: &mut Code) {
    use decoration::{OFFSET, XFB_BUFFER, XFB_STRIDE};
    code.heads.retain(|head| {
        !matches!(
            (head.opcode, &head.operands[..]),
            (op::EXECUTION_MODE, [_, execution_mode::XFB, ..])
                | (op::DECORATE, [_, OFFSET | XFB_BUFFER | XFB_STRIDE, ..])
                | (op::MEMBER_DECORATE, [_, _, XFB_BUFFER | XFB_STRIDE, ..])
        )
    });
}

/// The variables of `gl_BaseVertex`, `gl_BaseInstance` and `gl_DrawID`, zero in a plain draw; renames
/// OpenGL's built-ins to those that naga knows.
fn draw_parameters(code: &mut Code) -> Vec<u32> {
    let mut found = Vec::new();
    for instruction in code.heads.iter_mut().filter(|i| i.opcode == op::DECORATE) {
        let [id, decoration::BUILT_IN, which] = &mut instruction.operands[..] else { continue };
        match *which {
            built_in::VERTEX_ID => *which = built_in::VERTEX_INDEX,
            built_in::INSTANCE_ID => *which = built_in::INSTANCE_INDEX,
            built_in::BASE_VERTEX..=built_in::DRAW_INDEX => found.push(*id),
            _ => {}
        }
    }
    code.heads.retain(|i| i.opcode != op::EXTENSION);
    // naga knows one origin of window coordinates; a fragment stage that reads none is the same with either.
    for mode in code.heads.iter_mut().filter(|i| i.opcode == op::EXECUTION_MODE) {
        if let [_, mode @ execution_mode::ORIGIN_LOWER_LEFT] = &mut mode.operands[..] {
            *mode = execution_mode::ORIGIN_UPPER_LEFT;
        }
    }
    for entry in code.heads.iter_mut().filter(|i| i.opcode == op::ENTRY_POINT) {
        let name =
            2 + entry.operands[2..].iter().position(|word| word.to_le_bytes()[3] == 0).map_or(0, |last| last + 1);
        let interface = entry.operands.split_off(name.min(entry.operands.len()));
        entry.operands.extend(interface.into_iter().filter(|id| !found.contains(id)));
    }
    found
}

/// `near`, `far` and `diff` as they are where a program sets nothing: 0, 1, 1.
fn depth_range(code: &mut Code, ty: u32) -> u32 {
    let float = code.ty(op::TYPE_FLOAT, &[32]);
    let [near, far] = [0.0f32, 1.0].map(|depth| code.constant(op::CONSTANT, float, &[depth.to_bits()]));
    code.constant(op::CONSTANT_COMPOSITE, ty, &[near, far, far])
}

fn pointee(code: &Code, pointer: u32) -> Option<u32> {
    code.global(pointer).filter(|i| i.opcode == op::TYPE_POINTER).and_then(|i| i.operands.get(2).copied())
}

/// What an array of arrays has in it, or the type itself where it is none.
fn element(code: &Code, mut ty: u32) -> u32 {
    while let Some(array) = code.global(ty).filter(|declared| declared.opcode == op::TYPE_ARRAY) {
        ty = array.operands[1];
    }
    ty
}

/// Whether it has a size, so that a private variable can hold it.
fn has_size(code: &Code, ty: u32) -> bool {
    code.global(ty).is_some_and(|declared| match declared.opcode {
        op::TYPE_RUNTIME_ARRAY => false,
        op::TYPE_ARRAY => has_size(code, declared.operands[1]),
        op::TYPE_STRUCT => declared.operands[1..].iter().all(|&member| has_size(code, member)),
        _ => true,
    })
}

/// Whether it is a scalar, vector or matrix of numbers.
fn is_numeric(code: &Code, ty: u32) -> bool {
    code.global(ty).is_some_and(|declared| match declared.opcode {
        op::TYPE_INT | op::TYPE_FLOAT => true,
        op::TYPE_VECTOR | op::TYPE_MATRIX => is_numeric(code, declared.operands[1]),
        _ => false,
    })
}

fn short_name(code: &Code, ty: u32) -> &'static str {
    match code.global(ty).map(|declared| (declared.opcode, declared.operands.get(2).copied().unwrap_or(0))) {
        Some((op::TYPE_BOOL, _)) => "bool",
        Some((op::TYPE_VECTOR, 2)) => "bvec2",
        Some((op::TYPE_VECTOR, 3)) => "bvec3",
        Some((op::TYPE_VECTOR, 4)) => "bvec4",
        Some((op::TYPE_ARRAY, _)) => "array",
        _ => "struct",
    }
}

/// Declares the block and its variable; gives the variable.
fn default_block(code: &mut Code, members: &[(String, u32)]) -> u32 {
    let (block, variable) = (code.fresh(), code.fresh());
    code.name(&[block], DEFAULT_BLOCK);
    code.decorate(&[block], &[decoration::BLOCK]);
    code.decorate(&[variable], &[decoration::DESCRIPTOR_SET, 0]);
    code.decorate(&[variable], &[decoration::BINDING, 0]);
    let mut offset = 0;
    for (number, (name, ty)) in (0..).zip(members) {
        code.name(&[block, number], name);
        let Layout { size, alignment, column } = layout(code, *ty);
        offset = u32::next_multiple_of(offset, alignment);
        code.decorate(&[block, number], &[decoration::OFFSET, offset]);
        if let Some(stride) = column {
            code.decorate(&[block, number], &[decoration::COL_MAJOR]);
            code.decorate(&[block, number], &[decoration::MATRIX_STRIDE, stride]);
        }
        offset += size;
    }
    let types = std::iter::once(block).chain(members.iter().map(|member| member.1)).collect();
    code.globals.push(Instruction::new(op::TYPE_STRUCT, types));
    let pointer = code.ty(op::TYPE_POINTER, &[storage::UNIFORM, block]);
    code.globals.push(Instruction::new(op::VARIABLE, vec![pointer, variable, storage::UNIFORM]));
    variable
}

/// How a numeric type lies in a block, in bytes; `column` is the stride of a matrix.
struct Layout {
    size: u32,
    alignment: u32,
    column: Option<u32>,
}

fn layout(code: &Code, ty: u32) -> Layout {
    let scalar = Layout { size: 4, alignment: 4, column: None };
    let Some(declared) = code.global(ty) else { return scalar };
    let operand = |at: usize| declared.operands.get(at).copied().unwrap_or_default();
    match declared.opcode {
        op::TYPE_INT | op::TYPE_FLOAT => Layout { size: operand(1) / 8, alignment: operand(1) / 8, column: None },
        op::TYPE_VECTOR => {
            let Layout { size, .. } = layout(code, operand(1));
            let padded = if operand(2) == 2 { 2 } else { 4 };
            Layout { size: size * operand(2), alignment: size * padded, column: None }
        }
        op::TYPE_MATRIX => {
            let Layout { alignment, .. } = layout(code, operand(1));
            Layout { size: alignment * operand(2), alignment, column: Some(alignment) }
        }
        _ => scalar,
    }
}

/// Takes away a variable that becomes a member, and declares one that becomes private anew.
fn replace(code: &mut Code, variable: &Instruction, place: &Place, pointee: u32, initial: Option<u32>) {
    let id = variable.operands[1];
    code.undecorate(id);
    code.globals.retain(|i| i.opcode != op::VARIABLE || i.operands[1] != id);
    if matches!(place, Place::Member(_)) {
        return;
    }
    if variable.operands[2] != storage::UNIFORM_CONSTANT {
        code.undecorate(pointee);
    }
    let initial = initial.unwrap_or_else(|| code.null(pointee));
    let pointer = code.ty(op::TYPE_POINTER, &[storage::PRIVATE, pointee]);
    code.globals.push(Instruction::new(op::VARIABLE, vec![pointer, id, storage::PRIVATE, initial]));
}

/// Leads every use of the variables, and of pointers into them, to their new places.
fn uses(code: &mut Code, places: &HashMap<u32, (Place, u32)>, block: Option<u32>) {
    let mut classes: HashMap<u32, u32> = HashMap::new();
    for (id, (place, _)) in places {
        classes.insert(*id, if matches!(place, Place::Private) { storage::PRIVATE } else { storage::UNIFORM });
    }
    let functions = std::mem::take(&mut code.functions);
    let mut out = Vec::with_capacity(functions.len());
    for mut instruction in functions {
        let at = match instruction.opcode {
            op::LOAD | op::ACCESS_CHAIN | op::IN_BOUNDS_ACCESS_CHAIN | op::COPY_OBJECT => 2,
            _ => {
                out.push(instruction);
                continue;
            }
        };
        let base = instruction.operands[at];
        let Some(&class) = classes.get(&base) else {
            out.push(instruction);
            continue;
        };
        if instruction.opcode != op::LOAD {
            classes.insert(instruction.operands[1], class);
            if let Some(pointee) = pointee(code, instruction.operands[0]) {
                instruction.operands[0] = code.ty(op::TYPE_POINTER, &[class, pointee]);
            }
        }
        if let (Some((Place::Member(number), pointee)), Some(block)) = (places.get(&base), block) {
            let number = index(code, *number);
            if instruction.opcode == op::LOAD {
                let pointer = code.ty(op::TYPE_POINTER, &[class, *pointee]);
                let member = code.fresh();
                let mut chain = Instruction::new(op::ACCESS_CHAIN, vec![pointer, member, block, number]);
                chain.line = instruction.line;
                out.push(chain);
                instruction.operands[at] = member;
            } else {
                instruction.operands[at] = block;
                instruction.operands.insert(at + 1, number);
            }
        }
        out.push(instruction);
    }
    code.functions = out;
}

fn index(code: &mut Code, number: u32) -> u32 {
    let int = code.ty(op::TYPE_INT, &[32, 1]);
    code.constant(op::CONSTANT, int, &[number])
}
