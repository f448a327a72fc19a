//! Steps of the translation that the fuzzer enters from the side; in no other build.

use super::verdict::{Submitted, first_pass};
use super::{LinkedInterface, gate, spirv};
use crate::ffi::glslang::{Stage, StageText};
use crate::source::Source;

/// The words that the compiler writes for a file that it accepts.
pub fn words(source: &Source, interface: &LinkedInterface) -> Option<Vec<u32>> {
    gate::check_text(source).ok()?;
    let mut stages = [Submitted::new(Stage::Vertex, source, interface)];
    first_pass(&mut stages, &[StageText::plain(Stage::Fragment, &interface.fragment)]).ok()?;
    stages[0].second_pass().ok()
}

/// Bounds and reworks any words, damaged ones too.
pub fn bear(words: &[u32], source: &Source) {
    // A refusal is as good an answer as any here.
    let _ = gate::check_words(words, source, Stage::Vertex, &[]);
    for poisons in [false, true] {
        let _ = spirv::rework(
            words,
            spirv::How { set: &["mw", "mc", "mg"], has_textures: true, alike: None, is_split: true, poisons },
        );
    }
}
