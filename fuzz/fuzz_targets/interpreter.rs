//! Programs that compile, in the interpreter: whatever they do, it ends and does not panic. Arbitrary text as well, which it
//! refuses with a line of the file.
#![no_main]

use ggrade_fuzz::program;
use libfuzzer_sys::fuzz_target;
use reference::interpreter::{Precision, Program, Stage};

/// Few: a program that loops for ever is found out soon.
const FUEL: u64 = 3_000_000;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(text) = std::str::from_utf8(bytes) {
        for stage in [Stage::Vertex, Stage::Fragment] {
            match Program::compile(text, stage) {
                Ok(program) => drop(program.run(4).fuel(FUEL).outputs()),
                Err(refusal) => assert!(refusal.line as usize <= text.split(['\n', '\r']).count(), "{refusal}"),
            }
        }
    }
    let text = program::program(bytes);
    let program = Program::compile(&text, Stage::Vertex).unwrap_or_else(|refusal| panic!("{refusal}\n{text}"));
    let column: Vec<f64> = (0..12).map(|n| f64::from(n) / 4.0 - 1.5).collect();
    let vector = [column.as_slice(); 4];
    for precision in [Precision::Exact, Precision::Single] {
        let run = program.run(column.len()).fuel(FUEL).precision(precision);
        let run = run.input("pv", &vector).expect("a vec4").input("cv", &vector).expect("a vec4");
        if let Ok(outputs) = run.outputs() {
            let sound = outputs.outputs.iter().flat_map(|output| &output.values).all(|values| values.len() == 12);
            assert!(sound, "a value for each sample\n{text}");
        }
    }
});
