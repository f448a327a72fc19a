//! Any bytes as a file: reading never panics, and what it says points into the file.
#![no_main]

use ggrade_fuzz::{check_diagnostics, check_source};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| match ggrade::source::read("a.vert", bytes) {
    Ok(source) => check_source(&source),
    Err(refusal) => {
        assert!(!refusal.diagnostics.is_empty());
        let lines = refusal.source.as_ref().map_or(u32::MAX, |source| source.line_count());
        check_diagnostics(&refusal.diagnostics, lines);
        if let Some(source) = &refusal.source {
            check_source(source);
        }
    }
});
