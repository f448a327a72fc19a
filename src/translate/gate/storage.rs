//! The look at the compiler's SPIR-V: variables that the homework's program never provides.
//!
//! A stage of a homework reads inputs, uniforms, and textures by samplers. Buffers that shaders write, images, textures and
//! atomic counters compile on real drivers, but the program binds none, so what a shader makes of them is chance.

use super::bounds::{MAX_SCALARS, MAX_UNIFORM_BYTES, too_many_uniforms, too_much_memory};
use crate::diagnostic::{Diagnostic, DiagnosticStage};
use crate::ffi::glslang::Stage as GlslStage;
use crate::language::Text;
use crate::source::Source;
use crate::translate::TranslationRefusal;
use crate::translate::interface::place;
use crate::translate::spirv::{RawInstruction, instructions, op, text};
use std::collections::{HashMap, HashSet};

/// What the program does not provide.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum StorageKind {
    Texture,
    Buffer,
    Shared,
    Other,
}

/// Refuses a shader that uses such a variable, `set` being those that the program sets. One that only declares it draws the same picture without it.
pub(in crate::translate) fn check_words(
    words: &[u32],
    source: &Source,
    stage: GlslStage,
    set: &[&str],
) -> Result<(), TranslationRefusal> {
    let names: HashMap<u32, String> = instructions(words).filter_map(|i| name(&i)).collect();
    let buffers: HashSet<u32> = instructions(words)
        .filter_map(|i| match (i.opcode, i.words) {
            (op::DECORATE, [_, id, BUFFER_BLOCK, ..]) => Some(*id),
            _ => None,
        })
        .collect();
    check_sizes(words, &names, source, stage)?;
    let mut textures = HashSet::new();
    let mut pointers = HashMap::new();
    let mut arrays = HashMap::new();
    let mut found = HashMap::new();
    let mut in_function = false;
    for instruction in instructions(words) {
        let words = instruction.words;
        match (instruction.opcode, words) {
            (op::TYPE_IMAGE, [_, id, ..]) => {
                textures.insert(*id);
            }
            (op::TYPE_ARRAY, [_, id, element, ..]) => {
                arrays.insert(*id, *element);
            }
            (op::TYPE_POINTER, [_, id, _, pointee]) => {
                pointers.insert(*id, *pointee);
            }
            (op::VARIABLE, [_, ty, id, class, ..]) if !in_function => {
                let pointee = pointers.get(ty).map(|ty| arrays.get(ty).unwrap_or(ty));
                let is = |set: &HashSet<u32>| pointee.is_some_and(|ty| set.contains(ty));
                let is_set = names.get(id).is_some_and(|name| set.contains(&name.as_str()));
                if let Some(kind) = kind(*class, is(&textures) && !is_set, is(&buffers)) {
                    found.insert(*id, (kind, pointee.copied().unwrap_or(0)));
                }
            }
            (op::FUNCTION, _) => in_function = true,
            _ if in_function => {
                if let Some((id, (kind, ty))) = words[1..].iter().find_map(|id| found.get_key_value(id)) {
                    let name = names.get(id).filter(|name| !name.is_empty()).or_else(|| names.get(ty));
                    return Err(refusal(*kind, name.map_or("", String::as_str), source, stage));
                }
            }
            _ => {}
        }
    }
    Ok(())
}

/// What an instruction names, and how.
fn name(instruction: &RawInstruction<'_>) -> Option<(u32, String)> {
    match (instruction.opcode, instruction.words) {
        (op::NAME, [_, id, name @ ..]) => Some((*id, text(name))),
        _ => None,
    }
}

/// Refuses a variable that is too large by itself; naga counts bytes in 32 bits and gives up beyond.
fn check_sizes(
    words: &[u32],
    names: &HashMap<u32, String>,
    source: &Source,
    stage: GlslStage,
) -> Result<(), TranslationRefusal> {
    let mut lengths: HashMap<u32, u64> = HashMap::new();
    let mut sizes: HashMap<u32, u64> = HashMap::new();
    for instruction in instructions(words) {
        let size = |id: &u32| sizes.get(id).copied().unwrap_or(1);
        let (id, scalars) = match (instruction.opcode, instruction.words) {
            (op::CONSTANT, [_, _, id, value, ..]) => {
                lengths.insert(*id, u64::from(*value));
                continue;
            }
            (op::TYPE_VECTOR | op::TYPE_MATRIX, [_, id, part, count]) => {
                (*id, size(part).saturating_mul(u64::from(*count)))
            }
            (op::TYPE_ARRAY, [_, id, element, length]) => {
                (*id, size(element).saturating_mul(lengths.get(length).copied().unwrap_or(1)))
            }
            (op::TYPE_STRUCT, [_, id, members @ ..]) => (*id, members.iter().map(size).fold(0, u64::saturating_add)),
            (op::TYPE_POINTER, [_, id, _, pointee]) => (*id, size(pointee)),
            (op::VARIABLE, [_, ty, id, class, ..]) => {
                let name = names.get(id).map_or("", String::as_str);
                match class {
                    0 | 2 if size(ty).saturating_mul(4) > MAX_UNIFORM_BYTES => {
                        return Err(too_many_uniforms(size(ty).saturating_mul(4)));
                    }
                    0 | 2 => {}
                    _ if size(ty) > MAX_SCALARS => {
                        return Err(too_much_memory(size(ty).saturating_mul(4), name, source, stage));
                    }
                    _ => {}
                }
                continue;
            }
            _ => continue,
        };
        sizes.insert(id, scalars);
    }
    Ok(())
}

/// `BufferBlock` (SPIR-V specification, section 3.20).
const BUFFER_BLOCK: u32 = 3;

/// What a variable in this storage class is (SPIR-V specification, section 3.7).
///
/// A plain uniform of OpenGL's default block is in the class of textures.
fn kind(class: u32, is_texture: bool, is_buffer: bool) -> Option<StorageKind> {
    match class {
        0 if is_texture => Some(StorageKind::Texture),
        2 if is_buffer => Some(StorageKind::Buffer),
        12 => Some(StorageKind::Buffer),
        4 => Some(StorageKind::Shared),
        5 | 9 | 10 | 11 => Some(StorageKind::Other),
        _ => None,
    }
}

fn refusal(kind: StorageKind, name: &str, source: &Source, stage: GlslStage) -> TranslationRefusal {
    let (en, ja) = match kind {
        StorageKind::Texture => ("a texture or an image", "テクスチャや画像"),
        StorageKind::Buffer => {
            ("a shader storage buffer or an atomic counter", "シェーダストレージバッファやアトミックカウンタ")
        }
        StorageKind::Shared => ("shared memory", "共有メモリ"),
        StorageKind::Other => ("a resource", "リソース"),
    };
    let (to, to_ja) = match stage {
        GlslStage::Vertex => ("vertex shader", "頂点シェーダ"),
        GlslStage::Fragment => ("fragment shader", "フラグメントシェーダ"),
    };
    let message = Text::new(
        format!("`{name}` is {en}, and the program provides none to the {to}"),
        format!("`{name}` は{ja}ですが、プログラムはそのようなものを{to_ja}に用意していません"),
    );
    let hint = Text::new(
        "This homework needs only the attributes and uniforms of the handed-out file.",
        "この課題は、配布されたファイルにある頂点属性と uniform 変数だけで解けます。",
    );
    TranslationRefusal::Rejected(vec![place(
        Diagnostic::error(DiagnosticStage::Interface, message).hint(hint),
        source,
        name,
    )])
}
