//! Programs that compile, through all stages before the driver: the module with gate, fuel and capture in it is valid.
#![no_main]

use ggrade::translate::{TranslationRefusal, translate};
use ggrade_fuzz::{INTERFACE, check_module, program};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let text = program::program(bytes);
    let source = ggrade::source::read("a.vert", text.as_bytes()).expect("plain ASCII");
    match translate(&source, &INTERFACE) {
        Ok(translation) => check_module(&translation, &text),
        Err(TranslationRefusal::Rejected(diagnostics)) => panic!("{}\n{text}", diagnostics[0].message.en),
        Err(TranslationRefusal::Stopped(_)) => {}
        Err(TranslationRefusal::Fault(fault)) => panic!("{}\n{text}", fault.message.en),
    }
});
