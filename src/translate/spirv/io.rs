//! What goes into a stage and comes out of it by the student's own names: plain variables here, which the entry point
//! fills and reads part by part, for naga takes no structure, array or matrix as an input.

use super::code::{SpirvCode, SpirvInstruction};
use super::op::{self, decoration, storage};
use super::text;
use std::collections::HashSet;

/// How an input of the fragment stage comes from the values at the corners.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum InputInterpolation {
    /// Perspective-correct.
    #[default]
    Smooth,
    /// Linear in the window.
    NoPerspective,
    /// That of the last corner.
    Flat,
}

/// The qualifiers of an input or output.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct InterfaceQualifiers {
    /// How it is interpolated.
    pub interpolation: InputInterpolation,
    /// Whether it is `centroid`.
    pub centroid: bool,
    /// Whether it is `sample`.
    pub sample: bool,
}

/// An input or output of the student's own.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Io {
    /// The name that its plain variable has in the module.
    pub variable: String,
    /// Its name, or that of its block.
    pub name: String,
    /// Whether it goes in.
    pub is_input: bool,
    /// Whether the stage reads or writes it.
    pub is_used: bool,
    /// Its location, given or assigned by the compiler.
    pub location: u32,
    /// Whether it is the second colour of a blend.
    pub is_second: bool,
    /// Its qualifiers.
    pub qualifiers: InterfaceQualifiers,
    /// Those of the members of a block, or of each block of an array.
    pub members: Vec<InterfaceQualifiers>,
}

/// Inputs and outputs that are to be plain variables: their ids, and what they are.
pub(super) fn find(code: &mut SpirvCode) -> Vec<(u32, Io)> {
    let used: HashSet<u32> = code.functions.iter().flat_map(|i| i.operands.iter().copied()).collect();
    let names = code.names();
    let variables: Vec<SpirvInstruction> = code.globals.iter().filter(|i| i.opcode == op::VARIABLE).cloned().collect();
    let mut found = Vec::new();
    for variable in variables {
        let [pointer, id, class, ..] = variable.operands[..] else { continue };
        let Some(pointee) = super::globals::pointee(code, pointer) else { continue };
        if !matches!(class, storage::INPUT | storage::OUTPUT) || is_built_in(code, id, pointee) {
            continue;
        }
        // Of an array of blocks each is one by itself.
        let single = super::declared::element(code, pointee);
        let is_block = decorations(code, single).any(|own| own.first() == Some(&decoration::BLOCK));
        let members =
            code.global(single).filter(|ty| ty.opcode == op::TYPE_STRUCT).map_or(0, |ty| ty.operands.len() - 1);
        let name_of = |id: u32| names.get(&id).cloned().unwrap_or_default();
        let own: Vec<&[u32]> = decorations(code, id).collect();
        let value = |which: u32| own.iter().find(|own| own[0] == which).and_then(|own| own.get(1).copied());
        let name = name_of(if is_block { single } else { id });
        let io = Io {
            variable: format!("{name}@{}", found.len()),
            is_input: class == storage::INPUT,
            is_used: used.contains(&id),
            location: value(decoration::LOCATION).or_else(|| member_location(code, single)).unwrap_or(0),
            is_second: value(decoration::INDEX) == Some(1),
            qualifiers: qualifiers(own.iter().map(|own| own[0])),
            members: (0..members as u32)
                .map(|number| qualifiers(member_decorations(code, single, number).map(|own| own[0])))
                .collect(),
            name,
        };
        found.push((id, io));
    }
    for (id, io) in &found {
        code.heads.retain(|head| !(head.opcode == op::NAME && head.operands[0] == *id));
        code.name(&[*id], &io.variable);
    }
    found
}

/// Whether the compiler's own rules say what it holds.
fn is_built_in(code: &SpirvCode, id: u32, pointee: u32) -> bool {
    let mut ty = pointee;
    while let Some(array) = code.global(ty).filter(|declared| declared.opcode == op::TYPE_ARRAY) {
        ty = array.operands[1];
    }
    code.heads.iter().any(|head| match (head.opcode, &head.operands[..]) {
        (op::DECORATE, [target, decoration::BUILT_IN, ..]) => *target == id,
        (op::MEMBER_DECORATE, [target, _, decoration::BUILT_IN, ..]) => *target == ty,
        _ => false,
    })
}

fn decorations(code: &SpirvCode, id: u32) -> impl Iterator<Item = &[u32]> {
    let own = code.heads.iter().filter(move |head| head.opcode == op::DECORATE && head.operands[0] == id);
    own.map(|head| &head.operands[1..])
}

fn member_decorations(code: &SpirvCode, ty: u32, number: u32) -> impl Iterator<Item = &[u32]> {
    let is_own = move |head: &&SpirvInstruction| {
        head.opcode == op::MEMBER_DECORATE && head.operands[..2] == [ty, number] && head.operands.len() > 2
    };
    code.heads.iter().filter(is_own).map(|head| &head.operands[2..])
}

fn member_location(code: &SpirvCode, ty: u32) -> Option<u32> {
    member_decorations(code, ty, 0).find(|own| own[0] == decoration::LOCATION).and_then(|own| own.get(1).copied())
}

fn qualifiers(decorations: impl Iterator<Item = u32>) -> InterfaceQualifiers {
    let mut found = InterfaceQualifiers::default();
    for one in decorations {
        match one {
            decoration::FLAT => found.interpolation = InputInterpolation::Flat,
            decoration::NO_PERSPECTIVE => found.interpolation = InputInterpolation::NoPerspective,
            decoration::CENTROID => found.centroid = true,
            decoration::SAMPLE => found.sample = true,
            _ => {}
        }
    }
    found
}

/// The names of the members of a structure, by number.
pub(super) fn member_names(code: &SpirvCode, ty: u32) -> Vec<(u32, String)> {
    let own = code.heads.iter().filter(|head| head.opcode == op::MEMBER_NAME && head.operands[0] == ty);
    own.map(|head| (head.operands[1], text(&head.operands[2..]))).collect()
}
