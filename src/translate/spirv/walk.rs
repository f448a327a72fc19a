//! Walking over words without taking them apart.

use super::op;

const HEADER_WORDS: usize = 5;

/// One instruction: its opcode and its words, the first included.
pub(in crate::translate) struct RawInstruction<'a> {
    pub opcode: u16,
    pub words: &'a [u32],
}

/// The instructions behind the header.
pub(in crate::translate) fn instructions(words: &[u32]) -> impl Iterator<Item = RawInstruction<'_>> {
    let mut at = HEADER_WORDS;
    std::iter::from_fn(move || {
        let first = *words.get(at)?;
        let length = ((first >> 16) as usize).max(1);
        let instruction = RawInstruction { opcode: first as u16, words: words.get(at..at + length)? };
        at += length;
        Some(instruction)
    })
}

/// A text of SPIR-V: bytes of UTF-8 in words, ended by a zero.
pub(in crate::translate) fn text(words: &[u32]) -> String {
    let bytes: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).take_while(|byte| *byte != 0).collect();
    String::from_utf8_lossy(&bytes).into_owned()
}

/// Gives variables, members and the like that are called `name` another name of the same length.
pub(in crate::translate) fn rename(words: &mut [u32], name: &str, other: &str) {
    let mut at = HEADER_WORDS;
    while let Some(first) = words.get(at).copied() {
        let length = ((first >> 16) as usize).max(1);
        let skipped = match first as u16 {
            op::NAME => 2,
            op::MEMBER_NAME => 3,
            _ => length,
        };
        if let Some(own) = words.get_mut(at + skipped..at + length).filter(|own| !own.is_empty() && text(own) == name) {
            let bytes = other.bytes().chain(std::iter::repeat(0)).take(own.len() * 4).collect::<Vec<u8>>();
            for (word, bytes) in own.iter_mut().zip(bytes.as_chunks().0) {
                *word = u32::from_le_bytes(*bytes);
            }
        }
        at += length;
    }
}
