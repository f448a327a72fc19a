//! What the compiler wrote, made into what naga's front end takes, with the same meaning.

mod built_ins;
pub(super) mod code;
mod declared;
mod globals;
mod images;
mod infinite;
mod integers;
mod io;
mod lower;
mod memory;
pub(super) mod op;
mod packing;
mod poison;
mod sound;
mod switch;
#[cfg(test)]
mod tests;
mod textures;
mod walk;

pub(super) use declared::DeclaredUniform;
pub(super) use globals::{DEFAULT_BLOCK, UniformVariables};
pub(super) use io::Io;
pub use io::{InputInterpolation, InterfaceQualifiers};
pub(super) use poison::NEGATIVE;
pub(super) use textures::is_ours;
pub use textures::{CommonTexture, DESCRIPTION, TEXTURES, descriptions};
pub(super) use walk::{RawInstruction, instructions, rename, text};

use code::SpirvCode;
use reference::interpreter::WindowCoordinates;
use std::collections::BTreeMap;

/// What the compiler wrote, as naga's front end takes it.
pub(super) struct Reworked {
    /// The words, with the same meaning.
    pub words: Vec<u32>,
    /// Which line of the source each instruction comes from.
    pub lines: LineTable,
    /// What became of the uniforms.
    pub uniforms: UniformVariables,
    /// Inputs and outputs that are plain variables.
    pub io: Vec<Io>,
    /// Whether textures are read.
    pub reads_textures: bool,
    /// How places in the window are counted.
    pub window: WindowCoordinates,
}

/// Why words are not reworked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unworkable {
    /// They are damaged.
    Damaged,
    /// The cases of the `switch` on this line, each with all that it runs into, grow beyond reason.
    Cases(Option<u32>),
}

/// How words are reworked.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct How<'a> {
    /// The uniforms and blocks that the program sets, as a whole or in part.
    pub set: &'a [&'a str],
    /// Whether there are textures among them.
    pub has_textures: bool,
    /// What all textures have in common, where they do.
    pub alike: Option<CommonTexture>,
    /// Whether inputs and outputs become plain variables.
    pub is_split: bool,
    /// Whether what is undefined becomes a number that shows.
    pub poisons: bool,
}

/// Reworks `words`.
///
/// - Uniforms that the program sets become members of one block; any other is a private variable with
///   its initial value, for nothing ever sets it ([`globals`]).
/// - Cases of a `switch` that run into the next get a copy of it ([`switch`]).
/// - Instructions that naga does not know, or takes for something else, become others
///   ([`lower`], [`integers`]).
/// - Constants that are infinite or no numbers are made where they are used ([`infinite`]).
/// - Inputs and outputs become plain variables ([`io`]), samplers of textures numbers ([`textures`]).
/// - Where asked for, what is undefined becomes a number that shows ([`poison`]).
/// - `OpUndef` (a path that ends without `return`) becomes a null constant: any value is allowed
///   there, and zero is the same each time.
/// - `OpMemoryBarrier` goes: a shader here shares no memory with anybody.
pub(super) fn rework(words: &[u32], how: How<'_>) -> Result<Reworked, Unworkable> {
    let mut code = SpirvCode::parse(words).ok_or(Unworkable::Damaged)?;
    let samplers = if how.has_textures { textures::SamplerTypes::take(&mut code) } else { Default::default() };
    let window = built_ins::window(&mut code);
    let is_fragment = code.is_fragment();
    let (uniforms, io) = globals::rework(&mut code, how, &samplers);
    undefined(&mut code);
    code.functions.retain(|instruction| instruction.opcode != op::MEMORY_BARRIER);
    switch::separate_cases(&mut code)?;
    let reads_textures = textures::lower(&mut code, &samplers, is_fragment, how.alike);
    lower::lower(&mut code);
    if how.poisons {
        poison::poison(&mut code);
    }
    infinite::rework(&mut code);
    let (words, lines) = code.encode();
    Ok(Reworked { words, lines, uniforms, io, reads_textures, window })
}

fn undefined(code: &mut SpirvCode) {
    let mut moved = Vec::new();
    code.functions.retain(|instruction| {
        let keep = instruction.opcode != op::UNDEF;
        if !keep {
            moved.push(instruction.clone());
        }
        keep
    });
    code.globals.extend(moved);
    for instruction in code.globals.iter_mut().filter(|instruction| instruction.opcode == op::UNDEF) {
        instruction.opcode = op::CONSTANT_NULL;
        instruction.line = None;
    }
}

/// From a byte of the words to the line of the source.
#[derive(Clone, Debug, Default)]
pub struct LineTable(BTreeMap<u32, Option<u32>>);

impl LineTable {
    /// The line, from 1, of what stands at `span` of a module made from these words.
    pub fn line(&self, span: naga::Span) -> Option<u32> {
        let range = span.to_range()?;
        self.0.range(..=range.start as u32).next_back().and_then(|(_, line)| *line)
    }
}
