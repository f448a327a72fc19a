//! Uniforms, blocks, textures, derivatives, `discard`.

use crate::interpreter::{Compare, Filter, Program, Stage, Texture, Undefined, Wrap};

fn fragment(text: &str) -> Program {
    Program::compile(&format!("#version 460\n{text}"), Stage::Fragment).unwrap_or_else(|refusal| panic!("{refusal}"))
}

#[test]
fn uniforms_are_set_by_their_paths() {
    let program = fragment(
        "struct Lamp { vec3 colour; float power[2]; }; uniform Lamp lamps[2]; uniform float k = 0.5;\n\
        layout(std140) uniform Light { vec4 lamb; mat2 turn; } light; uniform Plain { float plain; };\n\
        out vec4 result; void main() { result = vec4(lamps[1].colour.y * lamps[0].power[1], light.turn[1].x, plain + light.lamb.w, k); }",
    );
    let run = program.run(1);
    let run = run.uniform("lamps[1].colour", &[1.0, 2.0, 3.0]).expect("a vector");
    let run = run.uniform("lamps[0].power[1]", &[7.0]).expect("an element");
    let run = run.uniform("Light.turn", &[1.0, 2.0, 3.0, 4.0]).expect("a matrix of a block");
    let run = run.uniform("Light.lamb", &[0.0, 0.0, 0.0, 5.0]).expect("a vector of a block");
    let run = run.uniform("plain", &[6.0]).expect("a member of a block without a name");
    assert_eq!(run.outputs().expect("an end").outputs[0].sample(0), [14.0, 3.0, 11.0, 0.5]);
    // A whole structure: its scalars in order.
    let run = program.run(1).uniform("lamps[1]", &[0.0, 2.0, 0.0, 0.0, 0.0]).expect("a structure");
    let run = run.uniform("lamps[0].power", &[0.0, 3.0]).expect("an array");
    assert_eq!(run.outputs().expect("an end").outputs[0].sample(0)[0], 6.0);
}

/// 2 × 2 pixels and what lies in them.
const X: [f64; 4] = [0.0, 1.0, 0.0, 1.0];
const Y: [f64; 4] = [0.0, 0.0, 1.0, 1.0];

#[test]
fn derivatives_are_differences_in_two_by_two_pixels() {
    let program = fragment(
        "in vec2 p; out vec4 result; void main() { float f = p.x * (2.0 + p.y) + 5.0 * p.y; result = vec4(dFdx(f), dFdy(f), fwidth(f), dFdxCoarse(f)); }",
    );
    let outputs = program.run(4).input("p", &[&X, &Y]).expect("p").outputs().expect("an end");
    let samples: Vec<_> = (0..4).map(|sample| outputs.outputs[0].sample(sample)).collect();
    assert_eq!(samples, [[2.0, 5.0, 7.0, 2.0], [2.0, 6.0, 8.0, 2.0], [3.0, 5.0, 8.0, 2.0], [3.0, 6.0, 9.0, 2.0]]);
}

#[test]
fn a_derivative_in_a_branch_that_not_all_pixels_take_is_undefined() {
    let program =
        fragment("in vec2 p; out float result; void main() { result = 0.0; if (p.x > 0.5) result = dFdx(p.x); }");
    let outputs = program.run(4).input("p", &[&X, &Y]).expect("p").outputs().expect("an end");
    let what = |sample: usize| outputs.outputs[0].undefined(0, sample).map(|cause| cause.what);
    assert_eq!([0, 1, 2, 3].map(what), [None, Some(Undefined::Derivative), None, Some(Undefined::Derivative)]);
}

#[test]
fn discarded_pixels_end() {
    let program =
        fragment("in vec2 p; out float result; void main() { result = 1.0; if (p.x > 0.5) discard; result = 2.0; }");
    let outputs = program.run(4).input("p", &[&X, &Y]).expect("p").outputs().expect("an end");
    assert_eq!(outputs.discarded, [false, true, false, true]);
    assert_eq!(outputs.outputs[0].values[0], [2.0, 1.0, 2.0, 1.0]);
}

#[test]
fn textures_are_read_by_every_function() {
    // 2 × 2 texels: red 1, 2 in the lower row and 3, 4 in the upper.
    let texels = [1.0, 2.0, 3.0, 4.0].map(|red| [red, 0.0, 0.0, 1.0]).to_vec();
    let mut texture = Texture::two_dimensional(2, 2, texels);
    texture.wrap = [Wrap::ClampToEdge; 3];
    let program = fragment(
        "uniform sampler2D t; in vec2 p; out vec4 a, b; out ivec2 size; void main() {\n\
        a = vec4(texture(t, p).r, textureProj(t, vec4(p * 2.0, 9.0, 2.0)).r, textureLod(t, p, 0.0).r, texelFetch(t, ivec2(p), 0).r);\n\
        b = vec4(textureOffset(t, vec2(0.25), ivec2(1, 0)).r, textureGather(t, vec2(0.5)).xy, textureGrad(t, p, vec2(0), vec2(0)).r);\n\
        size = textureSize(t, 0); }",
    );
    let textures = [texture];
    let run = program.run(4).uniform("t", &[0.0]).expect("t").textures(&textures);
    let outputs =
        run.input("p", &[&[0.1, 0.9, 0.1, 1.0], &[0.1, 0.1, 0.9, 1.0]]).expect("p").outputs().expect("an end");
    let a: Vec<_> = (0..4).map(|sample| outputs.outputs[0].sample(sample)).collect();
    assert_eq!(a, [[1.0, 1.0, 1.0, 1.0], [2.0, 2.0, 2.0, 1.0], [3.0, 3.0, 3.0, 1.0], [4.0, 4.0, 4.0, 4.0]]);
    assert_eq!(outputs.outputs[1].sample(1), [2.0, 3.0, 4.0, 2.0]);
    assert_eq!(outputs.outputs[2].sample(0), [2.0, 2.0]);
}

#[test]
fn shadows_are_compared() {
    let mut texture = Texture::two_dimensional(2, 1, vec![[0.25; 4], [0.75; 4]]);
    (texture.compare, texture.wrap) = (Some(Compare::LessOrEqual), [Wrap::ClampToEdge; 3]);
    let program = fragment(
        "uniform sampler2DShadow s; in vec3 q; out vec3 lit; float look(sampler2DShadow map, vec3 at) { return texture(map, at); }\n\
        void main() { lit = vec3(look(s, q), textureProj(s, vec4(q, 1.0) * 2.0), textureGather(s, q.xy, q.z).x); }",
    );
    let textures = [texture.clone()];
    let run = |textures: &[Texture]| {
        let run = program.run(2).uniform("s", &[0.0]).expect("s").textures(textures);
        let run = run.input("q", &[&[0.25, 0.75], &[0.5, 0.5], &[0.5, 0.5]]).expect("q");
        run.outputs().expect("an end").outputs.remove(0)
    };
    let lit = run(&textures);
    assert_eq!([lit.sample(0)[..2].to_vec(), lit.sample(1)[..2].to_vec()], [[0.0, 0.0], [1.0, 1.0]]);
    texture.magnify = Filter::Linear;
    texture.minify = Filter::Linear;
    // At the middles of the texels a linear filter gives the same.
    assert_eq!(run(&[texture.clone()]).sample(1)[0], 1.0);
    // Without a comparison the result is open.
    texture.compare = None;
    assert_eq!(run(&[texture]).undefined(0, 0).map(|cause| cause.what), Some(Undefined::Texture));
}

#[test]
fn lookups_of_old_glsl_are_those_of_today() {
    let texture = |compare| {
        let mut texture = Texture::two_dimensional(2, 1, vec![[0.25; 4], [0.75; 4]]);
        (texture.compare, texture.wrap) = (compare, [Wrap::ClampToEdge; 3]);
        texture
    };
    let program = fragment(
        "uniform sampler2D t; uniform sampler2DShadow s; in vec3 q; out vec4 a, b; void main() {\n\
        a = vec4(texture2D(t, q.xy).r, texture2DProj(t, vec3(q.xy, 1.0)).r, texture2DProj(t, vec4(q, 1.0) * 2.0).r, texture2DLod(t, q.xy, 0.0).r);\n\
        b = vec4(shadow2D(s, q).rgb, shadow2DProj(s, vec4(q, 1.0) * 2.0).a); }",
    );
    let textures = [texture(None), texture(Some(Compare::LessOrEqual))];
    let run = program.run(2).uniform("t", &[0.0]).expect("t").uniform("s", &[1.0]).expect("s").textures(&textures);
    let outputs = run.input("q", &[&[0.25, 0.75], &[0.5, 0.5], &[0.5, 0.5]]).expect("q").outputs().expect("an end");
    assert_eq!([0, 1].map(|at| outputs.outputs[0].sample(at)), [[0.25; 4], [0.75; 4]]);
    assert_eq!([0, 1].map(|at| outputs.outputs[1].sample(at)), [[0.0; 4], [1.0; 4]]);
}

#[test]
fn built_in_variables_are_inputs_and_outputs() {
    let program = fragment(
        "out vec4 result; void main() { result = vec4(gl_FragCoord.xy, gl_FrontFacing ? 1.0 : 0.0, gl_PointCoord.x); gl_FragDepth = gl_FragCoord.z; }",
    );
    let names = |all: &[super::super::ProgramVariable]| all.iter().map(|one| one.name.clone()).collect::<Vec<_>>();
    assert_eq!(names(program.inputs()), ["gl_FragCoord", "gl_FrontFacing", "gl_PointCoord"]);
    assert_eq!(names(program.outputs()), ["result", "gl_FragDepth"]);
    let text = "out vec4 y; void main() { y = vec4(gl_VertexID, gl_InstanceID, gl_MaxVertexAttribs, gl_DepthRange.far); gl_Position = y; }";
    let vertex = Program::compile(text, Stage::Vertex).expect("valid");
    let run = vertex.run(2).input("gl_VertexID", &[&[3.0, 4.0]]).expect("an input");
    assert_eq!(run.outputs().expect("an end").outputs[0].sample(1), [4.0, 0.0, 16.0, 1.0]);
}
