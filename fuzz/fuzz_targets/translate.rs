//! Any text through text gate, compiler, rework, gate and fuel: a shader whose module is valid, or a refusal with a
//! place in the file.
#![no_main]

use ggrade::translate::{TranslationRefusal, translate};
use ggrade_fuzz::{INTERFACE, check_diagnostics, check_module, written};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let Ok(source) = ggrade::source::read("a.vert", bytes) else { return };
    match translate(&source, &INTERFACE) {
        Ok(translation) => {
            check_diagnostics(&translation.diagnostics, source.line_count());
            check_module(&translation, &source.text);
        }
        Err(TranslationRefusal::Rejected(diagnostics) | TranslationRefusal::Stopped(diagnostics)) => {
            assert!(!diagnostics.is_empty());
            check_diagnostics(&diagnostics, source.line_count());
            written::check(bytes, Some(&source), &diagnostics);
        }
        Err(TranslationRefusal::Fault(fault)) => assert!(!fault.message.en.is_empty()),
    }
});
