//! The functions that look-ups become: what the compiler makes of `textures.glsl`, put into a module.

use super::{CommonTexture, OURS, TEXTURES};
use crate::ffi::glslang::{GlslangRequest, GlslangRules, Reached, Stage, StageText, compile};
use crate::translate::spirv::code::{SpirvCode, SpirvInstruction};
use crate::translate::spirv::op::{self, decoration, storage};
use std::collections::HashMap;
use std::ffi::CString;
use std::sync::{Arc, Mutex, PoisonError};

/// What the compiler makes of `textures.glsl` for textures that are alike in this way, or in none.
type TextureLibrary = (Option<CommonTexture>, Option<Arc<SpirvCode>>);

/// What the compiler makes of `textures.glsl`, once a process for each homework.
pub(super) fn library(alike: Option<CommonTexture>) -> Option<Arc<SpirvCode>> {
    static LIBRARIES: Mutex<Vec<TextureLibrary>> = Mutex::new(Vec::new());
    let mut libraries = LIBRARIES.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((_, known)) = libraries.iter().find(|(known, _)| *known == alike) {
        return known.clone();
    }
    let made = compiled(alike).map(Arc::new);
    libraries.push((alike, made.clone()));
    made
}

fn compiled(alike: Option<CommonTexture>) -> Option<SpirvCode> {
    let (version, text) = include_str!("textures.glsl").split_once('\n')?;
    let preamble = alike.map_or_else(String::new, |alike| alike.preamble());
    let text = CString::new(format!("{version}\n{preamble}{text}")).ok()?;
    let stages = [StageText::plain(Stage::Fragment, &text)];
    let outcome = compile(&GlslangRequest { stages: &stages, rules: GlslangRules::SpirV, emit: Stage::Fragment });
    let code = (outcome.reached == Reached::Done).then(|| SpirvCode::parse(&outcome.spirv)).flatten();
    debug_assert!(code.is_some(), "{}{}", outcome.log(Stage::Fragment), outcome.link_log);
    code
}

/// Adds the functions of the library; gives their ids and the types of their results, by name.
pub(super) fn splice(
    code: &mut SpirvCode,
    is_fragment: bool,
    alike: Option<CommonTexture>,
) -> Option<HashMap<String, (u32, u32)>> {
    let library = library(alike)?;
    let names = library.names();
    let name = |id: u32| names.get(&id).and_then(|name| name.split('(').next()).unwrap_or_default();
    let is_left_out = |id: u32| name(id) == "main" || !is_fragment && name(id) == "detail_here";
    let first = code.bound();
    code.reserve(library.bound());
    // naga knows one type without a value.
    let void = |code: &SpirvCode| code.globals.iter().find(|i| i.opcode == op::TYPE_VOID).map(|i| i.operands[0]);
    let (own_set, set, own_void, void) = (library.glsl(), code.glsl(), void(&library)?, void(code)?);
    // A picture that is read without a sampler is an image alone.
    let pictures: HashMap<u32, u32> = library
        .globals
        .iter()
        .filter(|global| global.opcode == op::TYPE_SAMPLED_IMAGE)
        .map(|global| (global.operands[0], global.operands[1]))
        .collect();
    let moved = |id: u32| match pictures.get(&id).copied().unwrap_or(id) {
        id if id == own_set => set,
        id if id == own_void => void,
        id => id + first,
    };
    for head in library.heads.iter().filter(|head| matches!(head.opcode, op::DECORATE | op::MEMBER_DECORATE)) {
        code.heads.push(renumbered(head, &moved));
    }
    for global in library.globals.iter().filter(|i| !matches!(i.opcode, op::TYPE_VOID | op::TYPE_SAMPLED_IMAGE)) {
        // Inputs and outputs are those of its own `main`.
        if global.opcode == op::VARIABLE && global.operands[2] != storage::UNIFORM_CONSTANT {
            code.heads.retain(|head| head.operands.first() != Some(&(global.operands[1] + first)));
            continue;
        }
        if global.opcode == op::VARIABLE {
            code.decorate(&[global.operands[1] + first], &[decoration::DESCRIPTOR_SET, TEXTURES.0]);
        }
        code.globals.push(renumbered(global, &moved));
    }
    let mut functions = HashMap::new();
    let mut is_kept = false;
    for instruction in &library.functions {
        if instruction.opcode == op::FUNCTION {
            let (ty, id) = (instruction.operands[0], instruction.operands[1]);
            is_kept = !is_left_out(id);
            if is_kept {
                functions.insert(name(id).to_owned(), (moved(id), moved(ty)));
                code.name(&[moved(id)], &format!("{}{OURS}", name(id)));
            }
        }
        if is_kept {
            let mut own = SpirvInstruction { line: None, ..renumbered(instruction, &moved) };
            if own.opcode == op::IMAGE {
                own.opcode = op::COPY_OBJECT;
            }
            code.functions.push(own);
        }
    }
    Some(functions)
}

/// The instruction with other ids. Which operands are ids, the specification says.
pub(super) fn renumbered(instruction: &SpirvInstruction, moved: &dyn Fn(u32) -> u32) -> SpirvInstruction {
    let leading = match instruction.opcode {
        op::DECORATE | op::MEMBER_DECORATE | op::TYPE_INT | op::TYPE_FLOAT | op::SELECTION_MERGE => 1,
        op::CONSTANT | op::TYPE_VECTOR | op::TYPE_MATRIX | op::TYPE_IMAGE | op::VARIABLE | op::LOOP_MERGE => 2,
        op::COMPOSITE_EXTRACT => 3,
        op::COMPOSITE_INSERT | op::VECTOR_SHUFFLE => 4,
        _ => usize::MAX,
    };
    let is_literal = |at: usize| match instruction.opcode {
        op::TYPE_POINTER => at == 1,
        op::FUNCTION => at == 2,
        op::EXT_INST => at == 3,
        op::IMAGE_FETCH => at == 4,
        _ => at >= leading,
    };
    let operands = instruction.operands.iter().enumerate();
    let operands = operands.map(|(at, &word)| if is_literal(at) { word } else { moved(word) }).collect();
    SpirvInstruction { opcode: instruction.opcode, operands, line: instruction.line }
}
