use super::{Interpreter, Invocation, Site, Value};
use crate::source::{self, Source};
use crate::translate::{self, Program, Stage, Variable};
use reference::Assignment;
use reference::interpreter::Texture;

fn read(text: &str) -> Source {
    source::read("a.vert", text.as_bytes()).expect("a vertex shader")
}

fn assignment() -> &'static Assignment {
    reference::assignment("ggsample06").expect("it is built in")
}

fn interpreter(source: &Source) -> Interpreter {
    let interface = crate::translate::Interface::of(assignment()).expect("its interface");
    let translation = translate::translate(source, &interface).expect("the shader compiles");
    translation.steps.interpreter(source).expect("the interpreter knows the shader")
}

/// The handed-out file with `lines` in place of the line that is to be replaced.
fn answer(lines: &str) -> Source {
    read(&assignment().files[0].starter.replace("vc = cv;", lines))
}

fn given(seed: u64, place: usize) -> Invocation<'static> {
    let assignment = assignment();
    let probes = assignment.probes(seed);
    let probe = &probes.probes[place];
    let uniforms = assignment.interface.uniforms.iter().zip(probes.uniforms(probe));
    let attributes = assignment.interface.inputs.iter().zip(&probe.attributes);
    let uniforms = uniforms.map(|(u, value)| (u.path.as_str(), Value::of_columns(value.numbers(), 4)));
    let attributes = attributes.map(|(a, value)| (a.name.as_str(), Value::of_floats(value.numbers())));
    Invocation { inputs: uniforms.chain(attributes).collect(), ..Invocation::default() }
}

const RIGHT: &str = "vec3 h = normalize(l + v);\n  vec4 a = kamb * lamb;\n  vc = a;\n  vc += max(dot(n, l), 0.0) * kdiff * ldiff;\n  vc += pow(max(dot(n, h), 0.0), kshi) * kspec * lspec;";

#[test]
fn a_right_answer_computes_what_the_reference_computes() {
    let shader = interpreter(&answer(RIGHT));
    let probes = assignment().probes(3);
    for (place, probe) in probes.iter().enumerate() {
        let written = shader.run(&given(3, place), "vc", &mut |_, _| None).expect("it runs");
        for (found, expected) in written.output.iter().zip(probe.colour.to_array()) {
            assert!((found - expected).abs() < 1e-5, "probe {place}: {found} instead of {expected}");
        }
        let position = written.position.expect("a position");
        for (found, expected) in position.iter().zip(probe.position.to_array()) {
            assert!((found - expected).abs() < 1e-4, "probe {place}: {found} instead of {expected}");
        }
    }
}

#[test]
fn functions_loops_branches_structures_and_arrays_run() {
    let source = read(
        "#version 410 core\nin vec4 pv;\nout vec4 vc;\nstruct S { float a[3]; vec3 b; };\nfloat f(in float x, inout float y) { y += 1.0; if (x > 2.0 && y < 100.0) return x * y; return -x; }\n\
         void main() {\n  S s;\n  s.b = vec3(1.0, 2.0, 3.0);\n  float y = 0.0;\n  for (int i = 0; i < 3; ++i) s.a[i] = f(s.b[i], y);\n\
         mat2 m = mat2(1.0, 2.0, 3.0, 4.0);\n  vec2 q = m * vec2(1.0, 1.0);\n  int k = 7 % 4;\n  switch (k) { case 3: q.x += 0.5; break; default: q.x = 0.0; }\n\
         vc = vec4(s.a[0], s.a[1], s.a[2], q.x);\n  vc.w += float(k) + (q.y < 0.0 ? 1.0 : 2.0);\n  gl_Position = pv;\n}\n",
    );
    let written = interpreter(&source).run(&Invocation::default(), "vc", &mut |_, _| None).expect("it runs");
    // y is 1, 2, 3 in turn; x over 2 only in the third. q = (1 + 3, 2 + 4), k = 3.
    assert_eq!(written.output, [-1.0, -2.0, 9.0, 4.5 + 3.0 + 2.0]);
}

#[test]
fn values_have_their_lines_and_names_and_can_be_changed() {
    let source = answer(RIGHT);
    let shader = interpreter(&source);
    let line_of = |part: &str| source.text.lines().position(|line| line.contains(part)).expect("a line") as u32 + 1;
    let mut places: Vec<(Site, Vec<f64>)> = Vec::new();
    let look = &mut |place: Site, value: &Value| {
        places.extend(value.floats().map(|floats| (place, floats)));
        None
    };
    let plain = shader.run(&given(1, 0), "vc", look).expect("it runs");
    // Constants are variables: their product is computed where it is written.
    let product = |(place, value): &&(Site, Vec<f64>)| {
        !shader.is_copy(*place) && value.len() == 4 && (value[0] - 0.12).abs() < 1e-6 && value[1] == 0.0
    };
    let (ambient, _) = places.iter().find(product).expect("kamb * lamb");
    assert_eq!(shader.line(*ambient), Some(line_of("vec4 a = ")));
    assert_eq!(shader.variable(*ambient), Some("a"));
    let change = &mut |place: Site, _: &Value| (place == *ambient).then(|| Value::of_floats(&[1.12, 0.0, 0.0, 1.0]));
    let changed = shader.run(&given(1, 0), "vc", change).expect("it runs");
    assert!((changed.output[0] - plain.output[0] - 1.0).abs() < 1e-6);
    let brighter = Invocation { kept: vec![("lamb", Value::of_floats(&[1.2, 1.2, 1.2, 1.0]))], ..given(1, 0) };
    let brighter = shader.run(&brighter, "vc", &mut |_, _| None).expect("it runs");
    assert!((brighter.output[0] - plain.output[0] - 0.6).abs() < 1e-6);
}

#[test]
fn the_parts_of_a_statement_on_several_lines_have_their_own_lines() {
    let source =
        answer("vc = kamb * lamb\n    + max(dot(n, l), 0.0)\n      * kdiff * ldiff\n    + vec4(pow(0.5,\n      2.0));");
    let shader = interpreter(&source);
    let mut lines = Vec::new();
    let look = &mut |place: Site, value: &Value| {
        if place.operand == 0 && !shader.is_copy(place) && value.floats().is_some() {
            lines.extend(shader.line(place));
        }
        None
    };
    shader.run(&given(1, 0), "vc", look).expect("it runs");
    let first = source.text.lines().position(|line| line.contains("vc = kamb")).expect("a line") as u32 + 1;
    let relative: Vec<u32> =
        lines.iter().filter(|line| (first..first + 5).contains(*line)).map(|line| line - first).collect();
    eprintln!("{relative:?}");
    assert!(relative.contains(&0) && relative.contains(&1) && relative.contains(&2));
}

#[test]
fn a_loop_without_an_end_gives_no_answer() {
    let source = read(
        "#version 410 core\nin vec4 pv;\nout vec4 vc;\nvoid main() { vc = pv; while (vc.x < 1.0) vc.x -= 1.0; gl_Position = pv; }\n",
    );
    assert_eq!(interpreter(&source).run(&Invocation::default(), "vc", &mut |_, _| None), None);
}

/// A fragment shader as a homework has it: structures by path, a block, a texture, and what is handed over.
const FRAGMENT: &str = "#version 420 core
struct Lamp { vec3 colour; float strength; };
uniform Lamp lamps[2];
layout(std140) uniform Fog { vec3 haze; float share; };
uniform sampler2D paint;
in vec2 at;
out vec4 seen;
void main()
{
  vec3 base = texture(paint, at).rgb;
  vec3 texel = texelFetch(paint, ivec2(1, 0), 0).rgb;
  vec3 sum = base * lamps[1].colour * lamps[1].strength + texel;
  seen = vec4(mix(sum, haze, share), 2.0);
}
";

#[test]
fn a_fragment_shader_runs_with_textures_and_paths() {
    let source = source::read_stage(Stage::Fragment, "a.frag", FRAGMENT.as_bytes()).expect("a fragment shader");
    let interface = translate::Interface {
        uniforms: [
            ("lamps[1].colour", "vec3"),
            ("lamps[1].strength", "float"),
            ("Fog.haze", "vec3"),
            ("Fog.share", "float"),
            ("paint", "sampler2D"),
        ]
        .map(|(name, ty)| Variable { name: name.into(), ty: ty.into() })
        .into(),
        ..translate::Interface::of(assignment()).expect("an interface")
    };
    let own = "#version 420 core\nout vec2 at;\nvoid main() { at = vec2(0.0); gl_Position = vec4(0.0); }\n";
    let program = Program::new(interface, Some((Stage::Vertex, own))).expect("a program");
    let linked = program.translate(&[(Stage::Fragment, &source)]).expect("it links");
    let shader = linked.steps[0].interpreter(&source).expect("the interpreter knows the shader");
    let texels = vec![[0.5, 0.25, 0.125, 1.0], [0.1, 0.2, 0.3, 1.0]];
    let textures = [Texture::two_dimensional(2, 1, texels)];
    let inputs = [
        ("lamps[1].colour", vec![1.0, 2.0, 4.0]),
        ("lamps[1].strength", vec![0.5]),
        ("Fog.haze", vec![1.0; 3]),
        ("Fog.share", vec![0.5]),
        ("paint", vec![0.0]),
        ("at", vec![0.25, 0.5]),
    ];
    let inputs = inputs.iter().map(|(name, numbers)| (*name, Value::of_floats(numbers))).collect();
    let given = Invocation { inputs, textures: &textures, clamps: true, ..Invocation::default() };
    let written = shader.run(&given, "seen", &mut |_, _| None).expect("it runs");
    // The sum is (0.25, 0.25, 0.25) of the left texel and the right texel, and half of it fog; alpha is clamped.
    for (found, expected) in written.output.iter().zip([0.675, 0.725, 0.775, 1.0]) {
        assert!((found - expected).abs() < 1e-6, "{:?}", written.output);
    }
}
