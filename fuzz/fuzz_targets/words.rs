//! Damaged SPIR-V through bounds and rework: ours must bear any words, since it reads what a compiler wrote for an
//! untrusted file.
#![no_main]

use ggrade::translate::fuzzing;
use ggrade_fuzz::{INTERFACE, program};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let (edits, seed) = bytes.split_at(bytes.len() / 3);
    let text = program::program(seed);
    let Ok(source) = ggrade::source::read("a.vert", text.as_bytes()) else { return };
    let Some(mut words) = fuzzing::words(&source, &INTERFACE) else { return };
    for edit in edits.chunks_exact(4) {
        let place = usize::from(u16::from_le_bytes([edit[0], edit[1]])) % words.len();
        words[place] = match edit[2] % 4 {
            0 => words[place].wrapping_add(u32::from(edit[3])),
            1 => words[place] ^ (1 << (edit[3] % 32)),
            2 => u32::from(edit[3]),
            _ => words[usize::from(edit[3]) % words.len()],
        };
    }
    fuzzing::bear(&words, &source);
});
