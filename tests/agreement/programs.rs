//! Generated programs through the interpreter, through wgpu and through a real OpenGL driver.

use super::{Bench, opengl, poses};
use ggrade::cross_check;
use ggrade::render::{DrawCall, RenderScene, Sample};
use ggrade::report::{CrossCheck, Opinion};
use ggrade::source::{self, Source};
use ggrade::translate::{self, TranslationRefusal};
use opengl::{Mesh, Vertex};
use reference::interpreter::Type;
use reference::{Value, Values};

#[path = "../../fuzz/src/program.rs"]
pub mod program;

/// How many programs there are.
const PROGRAMS: u64 = 300;
/// Vertices that each runs for, in each of two poses.
const VERTICES: usize = 12;

/// What the interpreter says of what OpenGL recorded.
pub fn interpreted(source: &Source, batches: &[DrawCall], captured: &[Vec<Vertex>]) -> CrossCheck {
    let sample = |vertex: &Vertex| Sample { position: vertex.position, colour: vertex.vc };
    let samples: Vec<Vec<Sample>> = captured.iter().map(|vertices| vertices.iter().map(sample).collect()).collect();
    cross_checked(source, batches, &samples)
}

fn cross_checked(source: &Source, batches: &[DrawCall], samples: &[Vec<Sample>]) -> CrossCheck {
    let samples: Vec<&[Sample]> = samples.iter().map(Vec::as_slice).collect();
    let interface = &reference::assignment("ggsample06").expect("a homework").interface;
    cross_check::check(&source.text, "vc", interface, &batches.iter().collect::<Vec<_>>(), &samples)
}

/// Knuth's MMIX generator, as for the poses: the same on every machine.
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        self.0 >> 33
    }

    pub fn float(&mut self) -> f32 {
        (self.next() % 4001) as f32 / 1000.0 - 2.0
    }
}

/// 300 programs, made of every kind of statement, type and built-in function, compute the same in the interpreter, on wgpu
/// and on OpenGL, or say that GLSL leaves it open.
#[test]
fn generated_programs_agree() {
    let mut bench = Bench::new();
    let mut random = Random(1);
    let places: Vec<[[f32; 3]; 2]> =
        (0..VERTICES).map(|_| [(); 2].map(|()| [(); 3].map(|()| random.float()))).collect();
    let [positions, normals] = [0, 1].map(|which| places.iter().map(|place| place[which]).collect::<Vec<_>>());
    let mut scene = bench.scene(&poses(&bench.assignment, 1, 1));
    for batch in scene.frames.iter_mut().flatten() {
        for (name, values) in &mut batch.attributes {
            let drawn = if name == "pv" { &positions } else { &normals };
            let numbers = drawn.iter().flatten().map(|number| f64::from(*number)).collect();
            *values = Values { kind: Type::vector(3), numbers };
        }
    }
    let (mut agreeing, mut open, mut compared, mut not_run, mut wrong) = (0, 0, 0, 0, Vec::new());
    for seed in 0..PROGRAMS {
        let mut random = Random(seed);
        let bytes: Vec<u8> = (0..200 + seed as usize).map(|_| random.next() as u8).collect();
        let text = program::program(&bytes);
        let source = source::read("generated.vert", text.as_bytes()).unwrap();
        let Some(results) = run(&mut bench, &source, &scene, Mesh { positions: &positions, normals: &normals }) else {
            continue;
        };
        compared += 1;
        for (driver, checked) in results {
            agreeing += checked.agreeing;
            open += checked.undefined + checked.unsettled;
            // A program may take more steps than a second opinion has.
            not_run += u32::from(checked.opinion == Opinion::NotRun);
            if checked.opinion == Opinion::Differs {
                wrong.push(format!("{driver}, program {seed}: {checked:?}\n{text}"));
            }
        }
    }
    eprintln!("{compared} programs, {not_run} not run: {agreeing} vertices agree, {open} are open");
    assert!(wrong.is_empty(), "{} differ\n{}", wrong.len(), wrong.concat());
    assert!(u64::from(not_run) < PROGRAMS / 4, "{not_run} second opinions were not given");
    // What is held against each other is there: most programs, and more that is defined than a few values. One of nine
    // loops for so long that ggrade stops it.
    assert!(compared > PROGRAMS * 8 / 10, "only {compared} programs ran everywhere");
    assert!(
        agreeing > 5 * VERTICES as u32 * PROGRAMS as u32 / 10,
        "only {agreeing} vertices are defined; {open} are not"
    );
}

/// What the interpreter says of each driver's values; none where ggrade stops the program.
fn run(
    bench: &mut Bench,
    source: &Source,
    scene: &RenderScene,
    mesh: Mesh<'_>,
) -> Option<[(&'static str, CrossCheck); 2]> {
    let shader = match translate::translate(source, &bench.interface) {
        Ok(translation) => translation.shader,
        Err(TranslationRefusal::Stopped(_)) => return None,
        Err(refusal) => panic!("{refusal:?}\n{}", source.text),
    };
    let rendering = bench.renderer.compute(&shader, scene).unwrap();
    if rendering.ran_out.is_some() {
        return None;
    }
    let program = bench.program(source).unwrap_or_else(|rejection| panic!("{rejection:?}\n{}", source.text));
    let captured: Vec<Vec<Vertex>> = scene
        .frames
        .iter()
        .flatten()
        .map(|batch| {
            let matrix = |value: &Value| std::array::from_fn(|at| value.numbers()[at] as f32);
            let uniforms: Vec<_> = batch.uniforms.iter().map(|(name, value)| (name.as_str(), matrix(value))).collect();
            bench.gl.capture(&program, &uniforms, mesh).unwrap()
        })
        .collect();
    Some([
        ("OpenGL", interpreted(source, &scene.frames.concat(), &captured)),
        ("wgpu", cross_checked(source, &scene.frames.concat(), &rendering.frame_samples)),
    ])
}
