//! The interpreter of `reference`. Whatever bytes it is given, it ends and does not panic, and refuses with a line of the file.
//! What the compiler accepts it takes too, or says that it is a limit of its own, and where it gives values they are those
//! of the driver.
#![no_main]

use ggrade::cross_check;
use ggrade::render::{AdapterKind, Device, DrawCall, RenderScene, Renderer};
use ggrade::report::Opinion;
use ggrade::source;
use ggrade::translate;
use ggrade_fuzz::{INTERFACE, assignment, program};
use libfuzzer_sys::fuzz_target;
use reference::interpreter::{Program, Stage, Type};
use reference::{Value, Values};

/// Few: a program that loops for ever is found out soon.
const FUEL: u64 = 3_000_000;

thread_local! {
    static RENDERER: Renderer = renderer();
}

fn renderer() -> Renderer {
    let fixed = translate::fixed_stage(&INTERFACE, &assignment().files[0].starter).expect("the starter links");
    Renderer::new(Device::open(AdapterKind::Software).expect("a software driver"), Some(&fixed)).expect("a renderer")
}

fuzz_target!(|bytes: &[u8]| {
    if let Ok(text) = std::str::from_utf8(bytes) {
        ends(text, Stage::Fragment);
        ends(text, Stage::Vertex);
        agrees(text);
    }
    let text = program::program(bytes);
    if let Err(refusal) = Program::compile(&text, Stage::Vertex) {
        panic!("{refusal}\n{text}");
    }
    agrees(&text);
});

fn ends(text: &str, stage: Stage) {
    match Program::compile(text, stage) {
        Ok(program) => drop(program.run(4).fuel(FUEL).outputs()),
        Err(refusal) => assert!(refusal.line as usize <= text.split(['\n', '\r']).count(), "{refusal}"),
    }
}

/// What the compiler accepts as a whole hand-in, through interpreter and driver.
fn agrees(text: &str) {
    let Ok(source) = source::read("fuzz.vert", text.as_bytes()) else { return };
    let Ok(translation) = translate::translate(&source, &INTERFACE) else { return };
    if let Err(refusal) = Program::compile(&source.text, Stage::Vertex) {
        assert!(refusal.is_limit(), "{refusal}\n{text}");
        return;
    }
    let scene = scene();
    // What ggrade's own way does not support is no matter of the interpreter's.
    let Ok(rendering) = RENDERER.with(|renderer| renderer.compute(&translation.shader, &scene)) else { return };
    if rendering.ran_out.is_some() {
        return;
    }
    let batches: Vec<&DrawCall> = scene.frames.iter().flatten().collect();
    let samples: Vec<_> = rendering.frame_samples.iter().map(Vec::as_slice).collect();
    let checked = cross_check::check(&source.text, &INTERFACE.output.name, &assignment().interface, &batches, &samples);
    assert_ne!(checked.opinion, Opinion::Differs, "{checked:?}\n{text}");
}

/// Two draws of six vertices that no assignment has, with matrices whose elements are all different.
fn scene() -> RenderScene {
    // Exact in f32, as all that a draw is given.
    let number = |seed: usize| f64::from((seed * 37 % 101) as f32 / 25.0 - 2.0);
    let draw = |draw: usize| DrawCall {
        uniforms: ["mw", "mc", "mg"]
            .into_iter()
            .enumerate()
            .map(|(which, name)| {
                let numbers = (0..16).map(|n| number(50 * draw + 17 * which + n)).collect();
                (name.into(), Value::new(Type::MAT4, numbers).expect("16 numbers"))
            })
            .collect(),
        attributes: ["pv", "cv"]
            .into_iter()
            .enumerate()
            .map(|(which, name)| {
                let numbers = (0..18).map(|n| number(90 * draw + 31 * which + n)).collect();
                (name.into(), Values { kind: Type::vector(3), numbers })
            })
            .collect(),
        ..DrawCall::default()
    };
    let frames = vec![vec![draw(0)], vec![draw(1)]];
    RenderScene { width: 4, height: 4, frames, ..RenderScene::default() }
}
