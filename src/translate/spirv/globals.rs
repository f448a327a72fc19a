//! Global variables as wgpu takes them: uniforms that are set in one block, all others private.

use super::code::{SpirvCode, SpirvInstruction};
use super::declared::{Beginning, DeclaredUniform, declare, element, fits_block, has_size, short_name};
use super::images;
use super::io::{self, Io};
use super::memory::{MemoryTypes, forget_places, place_members};
use super::op::{self, decoration, storage};
use super::textures::SamplerTypes;
use super::{How, built_ins};
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

/// What became of the uniforms.
#[derive(Clone, Debug, Default)]
pub struct UniformVariables {
    /// Those that the program sets, part by part.
    pub declared: Vec<DeclaredUniform>,
    /// Those that nothing sets.
    pub unset: Vec<Unset>,
}

/// Where a global variable goes.
enum Destination {
    /// Member of the default block, by its number.
    Member(u32),
    /// Where it is: a block of the student's own that the program sets.
    Block,
    /// Private, with what is its initial value anyhow.
    Private,
}

/// Reworks the global variables. `set` are the uniforms and blocks that the program sets, as a whole or in part.
/// Where `is_split`, inputs and outputs become plain variables.
pub(super) fn rework(code: &mut SpirvCode, how: How<'_>, samplers: &SamplerTypes) -> (UniformVariables, Vec<Io>) {
    let How { set, is_split, .. } = how;
    images::plain_types(code);
    built_ins::uncaught(code);
    let io = if is_split {
        built_ins::numbers_as_inputs(code);
        io::find(code)
    } else {
        Vec::new()
    };
    let names = code.names();
    let sample = built_ins::sample_position(code);
    let mut plain = built_ins::draw_parameters(code);
    plain.extend(io.iter().map(|(id, _)| *id));
    let variables: Vec<SpirvInstruction> = code.globals.iter().filter(|i| i.opcode == op::VARIABLE).cloned().collect();
    let mut places = HashMap::new();
    let mut members = Vec::new();
    let mut blocks = Vec::new();
    let mut uniforms = UniformVariables::default();
    let mut initials = HashMap::new();
    for variable in &variables {
        let [pointer, id, class, ..] = variable.operands[..] else { continue };
        let Some(pointee) = pointee(code, pointer) else { continue };
        if plain.contains(&id) {
            places.insert(id, (Destination::Private, pointee));
        }
        if sample == Some(id) {
            initials.insert(id, floats(code, pointee, &[0.5, 0.5]));
        }
        if !matches!(class, storage::UNIFORM_CONSTANT | storage::UNIFORM) || !has_size(code, pointee) {
            continue;
        }
        let is_block = class == storage::UNIFORM;
        let name_of = |id| names.get(&id).cloned().unwrap_or_default();
        let name = name_of(if is_block { element(code, pointee) } else { id });
        if !is_block && set.contains(&name.as_str()) && fits_block(code, pointee) {
            places.insert(id, (Destination::Member(members.len() as u32), pointee));
            declare(code, samplers, pointee, name.clone(), None, &mut uniforms.declared);
            members.push((name, pointee));
        } else if is_block && set.contains(&name.as_str()) && is_array_of_blocks(code, pointee) {
            // wgpu binds no array of blocks: it is an array of structures in the block of all others.
            declare(code, samplers, pointee, name.clone(), Some(Beginning::OF_BLOCK), &mut uniforms.declared);
            forget_places(code, pointee);
            code.undecorate(element(code, pointee));
            places.insert(id, (Destination::Member(members.len() as u32), pointee));
            members.push((name, pointee));
        } else if is_block && is_set_block(code, set, pointee, &name) {
            declare(code, samplers, pointee, name, Some(Beginning::OF_BLOCK), &mut uniforms.declared);
            places.insert(id, (Destination::Block, pointee));
            blocks.push(pointee);
        } else if name == DEPTH_RANGE {
            places.insert(id, (Destination::Private, pointee));
            // `near`, `far` and `diff` where a program sets nothing.
            initials.insert(id, floats(code, pointee, &[0.0, 1.0, 1.0]));
        } else {
            places.insert(id, (Destination::Private, pointee));
            uniforms.unset.push(Unset { name, ty: if is_block { "block" } else { short_name(code, pointee) } });
        }
    }
    let mut memory = MemoryTypes::default();
    blocks.iter().for_each(|ty| forget_places(code, *ty));
    blocks.iter().for_each(|ty| _ = memory.of(code, *ty));
    let block = (!members.is_empty()).then(|| default_block(code, &mut memory, &members));
    for variable in &variables {
        if let Some((place, pointee)) = places.get(&variable.operands[1]) {
            let initial = initials.get(&variable.operands[1]).or(variable.operands.get(3)).copied();
            replace(code, &memory, variable, place, *pointee, initial);
        }
    }
    uses(code, &memory, &places, block);
    (uniforms, io.into_iter().map(|(_, io)| io).collect())
}

/// Whether the program sets a block, by its name or a member's. Whether it has an instance name is the shader's own affair.
fn is_set_block(code: &SpirvCode, set: &[&str], ty: u32, name: &str) -> bool {
    if code.global(ty).is_none_or(|declared| declared.opcode != op::TYPE_STRUCT) {
        return false;
    }
    set.contains(&name) || io::member_names(code, ty).iter().any(|(_, member)| set.contains(&member.as_str()))
}

/// Whether it is an array of blocks.
fn is_array_of_blocks(code: &SpirvCode, ty: u32) -> bool {
    code.global(ty).is_some_and(|declared| declared.opcode == op::TYPE_ARRAY) && fits_block(code, ty)
}

/// A vector or structure of these numbers.
fn floats(code: &mut SpirvCode, ty: u32, numbers: &[f32]) -> u32 {
    let float = code.ty(op::TYPE_FLOAT, &[32]);
    let parts: Vec<u32> =
        numbers.iter().map(|number| code.constant(op::CONSTANT, float, &[number.to_bits()])).collect();
    code.constant(op::CONSTANT_COMPOSITE, ty, &parts)
}

pub(super) fn pointee(code: &SpirvCode, pointer: u32) -> Option<u32> {
    code.global(pointer).filter(|i| i.opcode == op::TYPE_POINTER).and_then(|i| i.operands.get(2).copied())
}

/// Declares the block and its variable; gives the variable.
fn default_block(code: &mut SpirvCode, memory: &mut MemoryTypes, members: &[(String, u32)]) -> u32 {
    let (block, variable) = (code.fresh(), code.fresh());
    code.name(&[block], DEFAULT_BLOCK);
    code.decorate(&[block], &[decoration::BLOCK]);
    code.decorate(&[variable], &[decoration::DESCRIPTOR_SET, 0]);
    code.decorate(&[variable], &[decoration::BINDING, 0]);
    for (number, (name, _)) in (0..).zip(members) {
        code.name(&[block, number], name);
    }
    let own: Vec<u32> = members.iter().map(|member| memory.of(code, member.1)).collect();
    place_members(code, block, &own);
    let types = std::iter::once(block).chain(own).collect();
    code.globals.push(SpirvInstruction::new(op::TYPE_STRUCT, types));
    let pointer = code.ty(op::TYPE_POINTER, &[storage::UNIFORM, block]);
    code.globals.push(SpirvInstruction::new(op::VARIABLE, vec![pointer, variable, storage::UNIFORM]));
    variable
}

/// Takes away a variable that becomes a member, and declares one that becomes private anew.
fn replace(
    code: &mut SpirvCode,
    memory: &MemoryTypes,
    variable: &SpirvInstruction,
    place: &Destination,
    pointee: u32,
    initial: Option<u32>,
) {
    let id = variable.operands[1];
    if matches!(place, Destination::Block) {
        let pointer = code.ty(op::TYPE_POINTER, &[storage::UNIFORM, memory.known(pointee)]);
        code.globals.retain(|i| i.opcode != op::VARIABLE || i.operands[1] != id);
        code.globals.push(SpirvInstruction::new(op::VARIABLE, vec![pointer, id, storage::UNIFORM]));
        return;
    }
    code.undecorate(id);
    code.globals.retain(|i| i.opcode != op::VARIABLE || i.operands[1] != id);
    if matches!(place, Destination::Member(_)) {
        return;
    }
    if variable.operands[2] != storage::UNIFORM_CONSTANT {
        code.undecorate(pointee);
    }
    let initial = initial.unwrap_or_else(|| code.null(pointee));
    let pointer = code.ty(op::TYPE_POINTER, &[storage::PRIVATE, pointee]);
    code.globals.push(SpirvInstruction::new(op::VARIABLE, vec![pointer, id, storage::PRIVATE, initial]));
}

/// Leads every use of the variables, and of pointers into them, to their new places.
fn uses(code: &mut SpirvCode, memory: &MemoryTypes, places: &HashMap<u32, (Destination, u32)>, block: Option<u32>) {
    let mut classes: HashMap<u32, u32> = HashMap::new();
    for (id, (place, _)) in places {
        classes.insert(*id, if matches!(place, Destination::Private) { storage::PRIVATE } else { storage::UNIFORM });
    }
    let functions = std::mem::take(&mut code.functions);
    let mut out = Vec::with_capacity(functions.len());
    for mut instruction in functions {
        if instruction.opcode == op::FUNCTION_CALL {
            hand_over(code, &mut out, &mut instruction, &classes, places, block);
        }
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
        let own = |ty: u32| if class == storage::UNIFORM { memory.known(ty) } else { ty };
        if instruction.opcode != op::LOAD {
            classes.insert(instruction.operands[1], class);
            if let Some(pointee) = pointee(code, instruction.operands[0]) {
                instruction.operands[0] = code.ty(op::TYPE_POINTER, &[class, own(pointee)]);
            }
        }
        if let (Some((Destination::Member(number), pointee)), Some(block)) = (places.get(&base), block) {
            let number = index(code, *number);
            if instruction.opcode == op::LOAD {
                let pointer = code.ty(op::TYPE_POINTER, &[class, own(*pointee)]);
                let member = code.fresh();
                let mut chain = SpirvInstruction::new(op::ACCESS_CHAIN, vec![pointer, member, block, number]);
                chain.line = instruction.line;
                out.push(chain);
                instruction.operands[at] = member;
            } else {
                instruction.operands[at] = block;
                instruction.operands.insert(at + 1, number);
            }
        }
        let (ty, id) = (instruction.operands[0], instruction.operands[1]);
        if instruction.opcode == op::LOAD && own(ty) != ty {
            let loaded = code.fresh();
            (instruction.operands[0], instruction.operands[1]) = (own(ty), loaded);
            let line = instruction.line;
            out.push(instruction);
            memory.value(code, &mut out, line, (ty, id), loaded);
        } else {
            out.push(instruction);
        }
    }
    code.functions = out;
}

/// A sampler in the block, handed to a function by a pointer: a variable of its own takes its place.
fn hand_over(
    code: &mut SpirvCode,
    out: &mut Vec<SpirvInstruction>,
    call: &mut SpirvInstruction,
    classes: &HashMap<u32, u32>,
    places: &HashMap<u32, (Destination, u32)>,
    block: Option<u32>,
) {
    for at in 3..call.operands.len() {
        let given = call.operands[at];
        if classes.get(&given) != Some(&storage::UNIFORM) {
            continue;
        }
        let uint = code.ty(op::TYPE_INT, &[32, 0]);
        let mut pointer = given;
        if let (Some((Destination::Member(number), _)), Some(block)) = (places.get(&given), block) {
            let (number, ty) = (index(code, *number), code.ty(op::TYPE_POINTER, &[storage::UNIFORM, uint]));
            pointer = code.fresh();
            let operands = vec![ty, pointer, block, number];
            out.push(SpirvInstruction { opcode: op::ACCESS_CHAIN, operands, line: call.line });
        }
        let (loaded, variable) = (code.fresh(), code.fresh());
        let ty = code.ty(op::TYPE_POINTER, &[storage::PRIVATE, uint]);
        let null = code.null(uint);
        code.globals.push(SpirvInstruction::new(op::VARIABLE, vec![ty, variable, storage::PRIVATE, null]));
        out.push(SpirvInstruction { opcode: op::LOAD, operands: vec![uint, loaded, pointer], line: call.line });
        out.push(SpirvInstruction { opcode: op::STORE, operands: vec![variable, loaded], line: call.line });
        call.operands[at] = variable;
    }
}

fn index(code: &mut SpirvCode, number: u32) -> u32 {
    let int = code.ty(op::TYPE_INT, &[32, 1]);
    code.constant(op::CONSTANT, int, &[number])
}
