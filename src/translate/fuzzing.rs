//! Steps of the translation that the fuzzer enters from the side; in no other build.

use super::{Interface, first_pass, gate, second_pass, spirv, text};
use crate::source::Source;

/// The words that the compiler writes for a file that it accepts.
pub fn words(source: &Source, interface: &Interface) -> Option<Vec<u32>> {
    gate::check_text(source).ok()?;
    let accepted = first_pass(source, interface).ok()?;
    second_pass(&accepted.text, text::version(source.code())).ok()
}

/// Bounds and reworks any words, damaged ones too.
pub fn bear(words: &[u32], source: &Source) {
    // A refusal is as good an answer as any here.
    let _ = gate::check_words(words, source);
    for poisons in [false, true] {
        let _ = spirv::rework(words, &["mw", "mc", "mg"], poisons);
    }
}
