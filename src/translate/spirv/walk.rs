//! Walking over words without taking them apart.

const HEADER_WORDS: usize = 5;

/// One instruction: its opcode and its words, the first included.
pub(in crate::translate) struct Instruction<'a> {
    pub opcode: u16,
    pub words: &'a [u32],
}

/// The instructions behind the header.
pub(in crate::translate) fn instructions(words: &[u32]) -> impl Iterator<Item = Instruction<'_>> {
    let mut at = HEADER_WORDS;
    std::iter::from_fn(move || {
        let first = *words.get(at)?;
        let length = ((first >> 16) as usize).max(1);
        let instruction = Instruction { opcode: first as u16, words: words.get(at..at + length)? };
        at += length;
        Some(instruction)
    })
}

/// A text of SPIR-V: bytes of UTF-8 in words, ended by a zero.
pub(in crate::translate) fn text(words: &[u32]) -> String {
    let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).take_while(|byte| *byte != 0).collect();
    String::from_utf8_lossy(&bytes).into_owned()
}
