//! Generated fragment programs through the interpreter and a real OpenGL driver: derivatives, discard, textures.

use super::opengl::{Given, Matrix, OpenGl, Texels, Version};
use super::programs::{Random, program};
use super::scenes::homework::texture;
use ggrade::cross_check::{self, DriverOutput};
use ggrade::language::Text;
use ggrade::report::{CrossCheck, Opinion};
use reference::interpreter::{Outputs, Precision, Program, Stage, Texture};

/// How many programs there are.
const PROGRAMS: u64 = 300;
/// Pixels of a row of the window that each runs for, and rows.
const SIDE: usize = 8;
/// Texels of a row of the picture that programs look things up in: no power of two, and rows are shorter.
const PICTURE: [usize; 2] = [6, 5];
/// Steps that the interpreter may take.
const FUEL: u64 = 60_000_000;
/// What stands where a fragment is thrown away; no program writes it.
const UNTOUCHED: [f32; 4] = [-12345.5; 4];

/// Everything that a program is given, for OpenGL and for the interpreter.
struct Scene {
    matrices: [(&'static str, Matrix); 3],
    textures: [(&'static str, Texels); 3],
}

impl Scene {
    fn new() -> Self {
        let mut random = Random(2);
        let mut texels = |width: usize, height: usize, is_linear: bool| Texels {
            width,
            height,
            texels: (0..width * height).map(|_| [(); 4].map(|()| random.float())).collect(),
            is_linear,
            repeats: is_linear,
        };
        let textures = [
            ("given_pv", texels(SIDE, SIDE, false)),
            ("given_cv", texels(SIDE, SIDE, false)),
            ("picture", texels(PICTURE[0], PICTURE[1], true)),
        ];
        let matrices = ["mw", "mc", "mg"].map(|name| (name, [(); 16].map(|()| random.float())));
        Self { matrices, textures }
    }

    fn given(&self) -> Given<'_> {
        Given { matrices: &self.matrices, textures: &self.textures }
    }

    /// The textures as the interpreter has them.
    fn read(&self) -> Vec<Texture> {
        self.textures.iter().map(|(_, from)| texture(from)).collect()
    }

    /// What the interpreter computes for the pixels in its own order, 2 × 2 after 2 × 2.
    fn run(&self, program: &Program, textures: &[Texture], precision: Precision) -> Result<Outputs, CrossCheck> {
        let places = || quads().map(|(x, y)| [x as f64 + 0.5, y as f64 + 0.5, 0.5, 1.0]);
        let coordinates: [Vec<f64>; 4] = std::array::from_fn(|axis| places().map(|place| place[axis]).collect());
        let front = vec![1.0; SIDE * SIDE];
        let mut run = program.run(SIDE * SIDE).textures(textures).precision(precision).fuel(FUEL);
        for input in program.inputs() {
            run = match input.name.as_str() {
                "gl_FragCoord" => run.input("gl_FragCoord", &coordinates.each_ref().map(Vec::as_slice)),
                name => run.input(name, &[&front]),
            }
            .expect("an input");
        }
        let is_used = |name: &str| program.uniforms().iter().any(|uniform| uniform.name == name);
        for (name, matrix) in self.matrices.iter().filter(|(name, _)| is_used(name)) {
            run = run.uniform(name, &matrix.map(f64::from)).expect("a matrix");
        }
        for (number, (name, _)) in self.textures.iter().enumerate().filter(|(_, (name, _))| is_used(name)) {
            run = run.uniform(name, &[number as f64]).expect("a sampler");
        }
        run.outputs()
            .map_err(|stopped| CrossCheck::not_run(Text::verbatim("its steps are used up"), Some(stopped.line)))
    }
}

/// The pixels 2 × 2 after 2 × 2, each row by row from below.
fn quads() -> impl Iterator<Item = (usize, usize)> {
    let corners = (0..SIDE).step_by(2).flat_map(|y| (0..SIDE).step_by(2).map(move |x| (x, y)));
    corners.flat_map(|(x, y)| [(x, y), (x + 1, y), (x, y + 1), (x + 1, y + 1)])
}

/// 300 programs with derivatives, lookups and `discard` compute the same in the interpreter and on OpenGL, or say that
/// GLSL leaves it open.
#[test]
fn generated_fragment_programs_agree() {
    let gl = OpenGl::with_version(Version::Raised460).unwrap_or_else(|missing| panic!("{missing}"));
    let scene = Scene::new();
    let textures = scene.read();
    let (mut agreeing, mut open, mut thrown_away, mut not_run, mut wrong) = (0, 0, 0, 0, Vec::new());
    for seed in 0..PROGRAMS {
        let mut random = Random(seed + 1000);
        let bytes: Vec<u8> = (0..200 + seed as usize).map(|_| random.next() as u8).collect();
        let text = program::fragment(&bytes);
        let pixels = gl.shade(&text, scene.given(), SIDE, UNTOUCHED);
        let pixels = pixels.unwrap_or_else(|rejection| panic!("{rejection:?}\n{text}"));
        let pixels: Vec<[f32; 4]> = quads().map(|(x, y)| pixels[y * SIDE + x]).collect();
        let discarded: Vec<bool> = pixels.iter().map(|pixel| *pixel == UNTOUCHED).collect();
        thrown_away += discarded.iter().filter(|discarded| **discarded).count();
        let interpreted =
            Program::compile(&text, Stage::Fragment).unwrap_or_else(|refusal| panic!("{refusal}\n{text}"));
        let drawn = DriverOutput { outputs: vec![("vc", pixels)], discarded };
        let checked = cross_check::compare(&drawn, |precision| scene.run(&interpreted, &textures, precision));
        agreeing += checked.agreeing;
        open += checked.undefined + checked.unsettled;
        not_run += u32::from(checked.opinion == Opinion::NotRun);
        if checked.opinion == Opinion::Differs {
            wrong.push(format!("program {seed}: {checked:?}\n{text}"));
        }
    }
    eprintln!("{not_run} not run: {agreeing} fragments agree, {open} are open, {thrown_away} thrown away");
    assert!(wrong.is_empty(), "{} differ\n{}", wrong.len(), wrong.concat());
    assert!(u64::from(not_run) < PROGRAMS / 4, "{not_run} were not run");
    // What is held against each other is there, thrown away or not.
    assert!(agreeing > (PROGRAMS as u32) * (SIDE * SIDE) as u32 / 3, "only {agreeing} fragments are defined");
    assert!(thrown_away > SIDE * SIDE, "only {thrown_away} fragments are thrown away");
}
