//! Any bytes as a file: reading and writing about it never panics, what is said points into the file, and nothing that it
//! holds is obeyed by a terminal or a browser.
#![no_main]

use ggrade_fuzz::{check_diagnostics, check_source, written};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| match ggrade::source::read("a.vert", bytes) {
    Ok(source) => {
        check_source(&source);
        written::check(bytes, Some(&source), &source.notes);
    }
    Err(refusal) => {
        assert!(!refusal.diagnostics.is_empty());
        let lines = refusal.source.as_ref().map_or(u32::MAX, |source| source.line_count());
        check_diagnostics(&refusal.diagnostics, lines);
        written::check(bytes, refusal.source.as_ref(), &refusal.diagnostics);
        if let Some(source) = &refusal.source {
            check_source(source);
        }
    }
});
