//! SPIR-V as instructions, with what a pass over them needs: new ids, types, constants.

use super::{LineTable, op, sound, text};
use std::collections::{BTreeMap, HashMap};

const HEADER_WORDS: usize = 5;
/// Where the header holds the bound of all ids.
const BOUND: usize = 3;

/// One instruction.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SpirvInstruction {
    pub opcode: u16,
    /// Its words without the first.
    pub operands: Vec<u32>,
    /// The line of the source that it comes from.
    pub line: Option<u32>,
}

impl SpirvInstruction {
    pub fn new(opcode: u16, operands: Vec<u32>) -> Self {
        Self { opcode, operands, line: None }
    }

    /// Type and id of its result, where it has both.
    pub fn result(&self) -> Option<(u32, u32)> {
        let has_none = matches!(
            self.opcode,
            op::STORE
                | op::FUNCTION_END
                | op::LABEL
                | op::LOOP_MERGE
                | op::SELECTION_MERGE
                | op::BRANCH..=op::UNREACHABLE
                | 63 // OpCopyMemory
                | op::IMAGE_WRITE
                | op::TYPE_VOID..=op::TYPE_FUNCTION
                | 218..=225 // geometry streams, barriers
        );
        if has_none { None } else { Some((*self.operands.first()?, *self.operands.get(1)?)) }
    }
}

/// A module in SPIR-V.
#[derive(Debug)]
pub struct SpirvCode {
    header: [u32; HEADER_WORDS],
    /// All that stands before the types: capabilities, entry points, names, decorations.
    pub heads: Vec<SpirvInstruction>,
    /// Types, constants and global variables.
    pub globals: Vec<SpirvInstruction>,
    /// The functions.
    pub functions: Vec<SpirvInstruction>,
}

impl SpirvCode {
    /// Reads words; `None` where they are not sound. Lines move from `OpLine` into the instructions.
    pub fn parse(words: &[u32]) -> Option<Self> {
        let header = words.get(..HEADER_WORDS)?.try_into().ok()?;
        let mut code = Self { header, heads: Vec::new(), globals: Vec::new(), functions: Vec::new() };
        let mut line = None;
        let mut at = HEADER_WORDS;
        while let Some(first) = words.get(at) {
            let length = (first >> 16) as usize;
            let operands = words.get(at + 1..at + length.max(1))?.to_vec();
            at += length.max(1);
            match *first as u16 {
                op::LINE => line = operands.get(1).copied(),
                op::NO_LINE => line = None,
                opcode => code.place(SpirvInstruction { opcode, operands, line }),
            }
        }
        sound::is_sound(&code).then_some(code)
    }

    fn place(&mut self, mut instruction: SpirvInstruction) {
        if instruction.opcode == op::FUNCTION || !self.functions.is_empty() {
            if matches!(instruction.opcode, op::FUNCTION | op::FUNCTION_END) {
                instruction.line = None;
            }
            self.functions.push(instruction);
        } else if (op::TYPE_VOID..op::FUNCTION).contains(&instruction.opcode)
            || matches!(instruction.opcode, op::VARIABLE | op::UNDEF)
        {
            self.globals.push(instruction);
        } else {
            self.heads.push(instruction);
        }
    }

    /// The words, and from which line each comes.
    pub fn encode(&self) -> (Vec<u32>, LineTable) {
        let mut words = self.header.to_vec();
        let mut lines = BTreeMap::new();
        let mut last = None;
        for instruction in self.heads.iter().chain(&self.globals).chain(&self.functions) {
            if instruction.line != last {
                last = instruction.line;
                lines.insert(words.len() as u32 * 4, last);
            }
            words.push((instruction.operands.len() as u32 + 1) << 16 | u32::from(instruction.opcode));
            words.extend_from_slice(&instruction.operands);
        }
        (words, LineTable(lines))
    }

    /// Whether the entry point is one of fragments (SPIR-V specification, section 3.3).
    pub fn is_fragment(&self) -> bool {
        self.heads.iter().any(|head| head.opcode == op::ENTRY_POINT && head.operands[0] == 4)
    }

    /// Whether an entry point asks for this.
    pub fn has_mode(&self, mode: u32) -> bool {
        self.heads.iter().any(|head| head.opcode == op::EXECUTION_MODE && head.operands.get(1) == Some(&mode))
    }

    /// Takes away what entry points ask for.
    pub fn drop_modes(&mut self, modes: &[u32]) {
        let is_one = |head: &SpirvInstruction| head.operands.get(1).is_some_and(|mode| modes.contains(mode));
        self.heads.retain(|head| head.opcode != op::EXECUTION_MODE || !is_one(head));
    }

    /// How many words the functions have.
    pub fn function_words(&self) -> usize {
        self.functions.iter().map(|instruction| instruction.operands.len() + 1).sum()
    }

    /// The id of the instructions of `GLSL.std.450`, which the compiler imports whether or not it uses one.
    pub fn glsl(&self) -> u32 {
        let import = self.heads.iter().find(|i| i.opcode == op::EXT_INST_IMPORT);
        import.and_then(|import| import.operands.first()).copied().unwrap_or_default()
    }

    /// The number above all ids.
    pub fn bound(&self) -> u32 {
        self.header[BOUND]
    }

    /// Sets so many ids aside.
    pub fn reserve(&mut self, count: u32) {
        self.header[BOUND] = self.header[BOUND].saturating_add(count);
    }

    /// An id that nothing has.
    pub fn fresh(&mut self) -> u32 {
        self.header[BOUND] += 1;
        self.header[BOUND] - 1
    }

    /// The type with these operands, made where there is none.
    pub fn ty(&mut self, opcode: u16, operands: &[u32]) -> u32 {
        let known = self.globals.iter().find(|i| i.opcode == opcode && i.operands[1..] == *operands);
        if let Some(known) = known {
            return known.operands[0];
        }
        let id = self.fresh();
        let operands = std::iter::once(id).chain(operands.iter().copied()).collect();
        self.globals.push(SpirvInstruction::new(opcode, operands));
        id
    }

    /// The constant with these operands, made where there is none.
    pub fn constant(&mut self, opcode: u16, ty: u32, operands: &[u32]) -> u32 {
        let is_it = |i: &&SpirvInstruction| i.opcode == opcode && i.operands[0] == ty && i.operands[2..] == *operands;
        if let Some(known) = self.globals.iter().find(is_it) {
            return known.operands[1];
        }
        let id = self.fresh();
        let operands = [ty, id].into_iter().chain(operands.iter().copied()).collect();
        self.globals.push(SpirvInstruction::new(opcode, operands));
        id
    }

    /// The zero of a type.
    pub fn null(&mut self, ty: u32) -> u32 {
        self.constant(op::CONSTANT_NULL, ty, &[])
    }

    /// The declaration of a type or global.
    pub fn global(&self, id: u32) -> Option<&SpirvInstruction> {
        self.globals.iter().find(|i| {
            let at = usize::from(!(op::TYPE_VOID..=op::TYPE_FUNCTION).contains(&i.opcode));
            i.operands.get(at) == Some(&id)
        })
    }

    /// From every value to its type.
    pub fn value_types(&self) -> HashMap<u32, u32> {
        let all = self.globals.iter().chain(&self.functions);
        all.filter_map(SpirvInstruction::result).map(|(ty, id)| (id, ty)).collect()
    }

    /// From ids to the names that the source gives them.
    pub fn names(&self) -> HashMap<u32, String> {
        let names = self.heads.iter().filter(|i| i.opcode == op::NAME);
        names.filter_map(|i| Some((*i.operands.first()?, text(i.operands.get(1..)?)))).collect()
    }
    /// Gives `target` (an id, or an id and the number of a member) a name.
    pub fn name(&mut self, target: &[u32], name: &str) {
        let opcode = if target.len() == 1 { op::NAME } else { op::MEMBER_NAME };
        // Names stand before decorations.
        let is_decoration = |i: &SpirvInstruction| matches!(i.opcode, op::DECORATE | op::MEMBER_DECORATE);
        let at = self.heads.iter().position(is_decoration).unwrap_or(self.heads.len());
        self.heads.insert(at, SpirvInstruction::new(opcode, [target, &literal(name)].concat()));
    }

    /// The operands of a decoration of a type or, with its number, of a member.
    pub fn decoration(&self, target: &[u32], decoration: u32) -> Option<&[u32]> {
        let opcode = if target.len() > 1 { op::MEMBER_DECORATE } else { op::DECORATE };
        let own = self.heads.iter().filter(|head| head.opcode == opcode);
        own.filter_map(|head| head.operands.strip_prefix(target)?.strip_prefix(&[decoration])).next()
    }

    /// Decorates `target` (an id, or an id and the number of a member).
    pub fn decorate(&mut self, target: &[u32], decoration: &[u32]) {
        let opcode = if target.len() == 1 { op::DECORATE } else { op::MEMBER_DECORATE };
        self.heads.push(SpirvInstruction::new(opcode, [target, decoration].concat()));
    }

    /// Drops all decorations of `id` and its members.
    pub fn undecorate(&mut self, id: u32) {
        let is_decoration = |opcode| matches!(opcode, op::DECORATE | op::MEMBER_DECORATE);
        self.heads.retain(|i| !(is_decoration(i.opcode) && i.operands.first() == Some(&id)));
    }
}

/// The words of a literal text.
fn literal(text: &str) -> Vec<u32> {
    let mut bytes = text.as_bytes().to_vec();
    bytes.resize(text.len() / 4 * 4 + 4, 0);
    bytes.chunks_exact(4).map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]])).collect()
}
