//! What each stage of a grading costs, on a shader that the driver has not seen before where that matters.

use divan::Bencher;
use ggrade::compare;
use ggrade::cross_check;
use ggrade::expected;
use ggrade::grade::{Grader, Order};
use ggrade::hand_in::HandIn;
use ggrade::render::{AdapterKind, Device, Renderer};
use ggrade::source::{self, Source};
use ggrade::translate::{self, LinkedInterface, Shader};
use reference::Assignment;
use reference::interpreter::{Program, Stage};
use std::cell::RefCell;
use std::sync::Arc;

fn main() {
    divan::main();
}

fn assignment() -> &'static Arc<Assignment> {
    reference::assignment("ggsample06").expect("the assignment is built in")
}

fn interface() -> LinkedInterface {
    ggrade::translate::LinkedInterface::of(assignment()).expect("the assignment is whole")
}

/// A right answer that no cache has seen: another constant in code that does nothing.
fn text() -> String {
    use std::sync::atomic::{AtomicU32, Ordering};
    static NUMBER: AtomicU32 = AtomicU32::new(0);
    let number = NUMBER.fetch_add(1, Ordering::Relaxed);
    let answer = &assignment().files[0].solution.text;
    answer
        .replacen("void main", &format!("float nothing(float x) {{ return x * {number}.5; }}\nvoid main"), 1)
        .replacen("gl_Position =", "if (nothing(pv.w) < -1.0) vc *= 0.5;\n  gl_Position =", 1)
}

fn read(text: &str) -> Source {
    source::read("bench.vert", text.as_bytes()).expect("a right answer")
}

fn shader(source: &Source, interface: &LinkedInterface) -> Shader {
    translate::translate(source, interface).expect("a right answer").shader
}

fn renderer() -> Renderer {
    let interface = interface();
    let fixed = translate::fixed_stage(&interface, &assignment().files[0].starter).expect("the starter links");
    Renderer::new(Device::open(AdapterKind::Software).expect("a software driver"), Some(&fixed)).expect("a renderer")
}

#[divan::bench]
fn read_source(bencher: Bencher<'_, '_>) {
    bencher.with_inputs(text).bench_refs(|text| read(text));
}

#[divan::bench]
fn translate_source(bencher: Bencher<'_, '_>) {
    let interface = interface();
    translate::warm(&interface, &assignment().files[0].starter);
    shader(&read(&text()), &interface);
    bencher.with_inputs(|| read(&text())).bench_refs(|source| shader(source, &interface));
}

#[divan::bench(sample_count = 30)]
fn render_25_frames_and_probes(bencher: Bencher<'_, '_>) {
    let interface = interface();
    let renderer = RefCell::new(renderer());
    let scene = ggrade::render::RenderScene::of(assignment(), &[&assignment().probes(1)]);
    bencher
        .with_inputs(|| shader(&read(&text()), &interface))
        .bench_local_refs(|shader| renderer.borrow_mut().render(shader, &scene).expect("a rendering"));
}

#[divan::bench]
fn compare_25_frames(bencher: Bencher<'_, '_>) {
    let (expected, _) = expected::prepared(assignment(), None, None).expect("in memory");
    let mut renderer = renderer();
    let scene = ggrade::render::RenderScene::of(assignment(), &[&assignment().probes(1)]);
    let rendering = renderer.render(&shader(&read(&text()), &interface()), &scene).expect("a rendering");
    bencher.bench_local(|| {
        expected
            .iter()
            .zip(0..)
            .map(|(frame, index)| compare::frame(frame, &rendering.frames, index))
            .collect::<Vec<_>>()
    });
}

#[divan::bench]
fn make_probes(bencher: Bencher<'_, '_>) {
    bencher.bench_local(|| assignment().probes(1));
}

#[divan::bench(sample_count = 30)]
fn whole_grade_of_a_new_right_answer(bencher: Bencher<'_, '_>) {
    let grader = RefCell::new(Grader::open(assignment().clone(), AdapterKind::Software).expect("a grader"));
    bencher.with_inputs(text).bench_local_refs(|text| {
        grader
            .borrow_mut()
            .grade(&HandIn::of_one("bench.vert", text.as_bytes()), Order { seed: 1, ..Order::default() })
            .expect("a grade")
    });
}

/// A second opinion on what a grading draws, compiled and run with both precisions.
#[divan::bench]
fn interpret_frames_and_probes(bencher: Bencher<'_, '_>) {
    let mut renderer = renderer();
    let scene = ggrade::render::RenderScene::of(assignment(), &[&assignment().probes(1)]);
    let text = text();
    let rendering = renderer.render(&shader(&read(&text), &interface()), &scene).expect("a rendering");
    let batches: Vec<_> = scene.frames.iter().flatten().chain(&scene.probes).collect();
    let samples: Vec<_> = rendering.frame_samples.iter().chain(&rendering.probe_samples).map(Vec::as_slice).collect();
    bencher.bench_local(|| cross_check::check(&text, "vc", &assignment().interface, &batches, &samples));
}

/// One of the 25 frames of a solution that lights each pixel, all of them covered.
#[divan::bench(sample_count = 10)]
fn interpret_640_by_480_pixels(bencher: Bencher<'_, '_>) {
    let program = Program::compile(PIXELS, Stage::Fragment).expect("a solution");
    let columns: [Vec<f64>; 3] =
        [3, 5, 7].map(|step| (0..640 * 480).map(|n| f64::from(n * step % 1000) / 500.0 - 1.0).collect());
    let columns = columns.each_ref().map(Vec::as_slice);
    bencher.bench_local(|| {
        let run = program.run(640 * 480).uniform("light", &[1.0, 2.0, 3.0]).expect("a vec3");
        let run = run.input("n", &columns).expect("a vec3").input("p", &columns).expect("a vec3");
        run.outputs().expect("an end")
    });
}

const PIXELS: &str = "#version 410
in vec3 n, p; uniform vec3 light; out vec4 colour;
void main() {
    vec3 N = normalize(n), L = normalize(light - p), V = normalize(-p), H = normalize(L + V);
    vec3 c = vec3(0.12, 0.02, 0.02) + max(dot(N, L), 0.0) * vec3(0.6, 0.2, 0.1);
    c += pow(max(dot(N, H), 0.0), 80.0) * vec3(0.4);
    if (dot(N, V) < 0.25) c *= 0.5;
    colour = vec4(c, 1.0);
}";

#[divan::bench(sample_count = 5)]
fn start_a_grader() -> Grader {
    Grader::open(assignment().clone(), AdapterKind::Software).expect("a grader")
}
