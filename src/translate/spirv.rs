//! Words of SPIR-V: walks the instructions, and reworks the few that naga's front end refuses.

use std::collections::BTreeMap;

const HEADER_WORDS: usize = 5;

/// Opcodes that are looked at here (SPIR-V specification, section 3.42).
pub(super) mod op {
    pub const UNDEF: u16 = 1;
    pub const NAME: u16 = 5;
    pub const LINE: u16 = 8;
    pub const TYPE_VECTOR: u16 = 23;
    pub const TYPE_MATRIX: u16 = 24;
    pub const TYPE_ARRAY: u16 = 28;
    pub const TYPE_STRUCT: u16 = 30;
    pub const TYPE_POINTER: u16 = 32;
    pub const CONSTANT: u16 = 43;
    pub const CONSTANT_NULL: u16 = 46;
    pub const FUNCTION: u16 = 54;
    pub const VARIABLE: u16 = 59;
    pub const DECORATE: u16 = 71;
    pub const MEMORY_BARRIER: u16 = 225;
    pub const LOOP_MERGE: u16 = 246;
    pub const NO_LINE: u16 = 317;
}

/// One instruction: its opcode and its words, the first included.
pub(super) struct Instruction<'a> {
    pub opcode: u16,
    pub words: &'a [u32],
}

/// The instructions behind the header.
pub(super) fn instructions(words: &[u32]) -> impl Iterator<Item = Instruction<'_>> {
    let mut at = HEADER_WORDS;
    std::iter::from_fn(move || {
        let first = *words.get(at)?;
        let length = (first >> 16) as usize;
        let slice = words.get(at..at + length.max(1))?;
        let instruction = Instruction { opcode: first as u16, words: slice };
        at += length.max(1);
        Some(instruction)
    })
}

/// A text of SPIR-V: bytes of UTF-8 in words, ended by a zero.
pub(super) fn text(words: &[u32]) -> String {
    let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).take_while(|byte| *byte != 0).collect();
    String::from_utf8_lossy(&bytes).into_owned()
}

/// What the compiler wrote, as naga's front end takes it.
pub(super) struct Reworked {
    /// The words, with the same meaning.
    pub words: Vec<u32>,
    /// Which line of the source each instruction comes from.
    pub lines: Lines,
}

/// Makes of the compiler's output what naga's front end takes, with the same meaning.
///
/// - `OpUndef` (a path that ends without `return`) becomes a null constant before the first
///   function: any value is allowed there, and zero is the same each time.
/// - `OpMemoryBarrier` goes: a vertex shader here shares no memory with anybody.
/// - `OpLine`, which naga takes in functions only, moves to a table beside the words.
pub(super) fn rework(words: &[u32]) -> Reworked {
    let nulls: Vec<u32> = instructions(words)
        .filter(|i| i.opcode == op::UNDEF)
        .flat_map(|i| [3 << 16 | u32::from(op::CONSTANT_NULL), i.words[1], i.words[2]])
        .collect();
    let mut out = words[..HEADER_WORDS.min(words.len())].to_vec();
    let mut lines = BTreeMap::new();
    let mut placed = false;
    for instruction in instructions(words) {
        match instruction.opcode {
            op::UNDEF => continue,
            op::LINE => {
                lines.insert(out.len() as u32 * 4, instruction.words.get(2).copied());
                continue;
            }
            op::NO_LINE | op::MEMORY_BARRIER => continue,
            op::FUNCTION => {
                lines.insert(out.len() as u32 * 4, None);
                if !placed {
                    out.extend_from_slice(&nulls);
                    placed = true;
                }
            }
            _ => {}
        }
        out.extend_from_slice(instruction.words);
    }
    Reworked { words: out, lines: Lines(lines) }
}

/// From a byte of the words to the line of the source.
#[derive(Clone, Debug, Default)]
pub struct Lines(BTreeMap<u32, Option<u32>>);

impl Lines {
    /// The line, from 1, of what stands at `span` of a module made from these words.
    pub fn line(&self, span: naga::Span) -> Option<u32> {
        let range = span.to_range()?;
        self.0.range(..=range.start as u32).next_back().and_then(|(_, line)| *line)
    }
}
