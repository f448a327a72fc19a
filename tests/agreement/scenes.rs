//! Programs of which the fragment stage is handed in: what ggrade paints and computes, against a real OpenGL driver.

#[path = "scenes/homework.rs"]
pub mod homework;

use super::opengl::{OpenGl, Version, Window};
use ggrade::render::{AdapterKind, Device, DrawCall, Pixel, RenderScene, Renderer};
use ggrade::translate;
use homework::{SIZE, batch, numbers, sheets, texture};
use reference::Values;
use reference::interpreter::{Scalar, Type};

/// Largest difference of a channel, in 1/255: rounding at .5.
const PIXEL_TOLERANCE: f32 = 1.01 / 255.0;
/// Share of the pixels that may differ more: those at which a decision depends on the last bit of an interpolated value.
const DOUBTFUL: usize = 500;
/// The same for numbers that are computed from the same inputs.
const NUMBER_TOLERANCE: f32 = 1e-4;

/// What stands above each program's `main`.
const HEAD: &str = "in vec3 normal;\nin vec2 uv;\nnoperspective in vec2 screen;\nflat in int number;\nflat in uvec2 marks;\n\
    flat in vec3 tint;\ncentroid in float wave;\nin mat3 frame;\nin float steps[2];\nin Bundle { vec3 at; vec4 clip; } own;\n\
    struct Light { bool on; vec3 at; vec3 colours[2]; };\nuniform Light lights[2];\nuniform mat3 turn;\nuniform mat2 squeeze;\n\
    uniform int count;\nuniform uvec2 mask;\nuniform float weights[3];\nuniform bvec3 switches;\n\
    layout(std140) uniform Surface { vec4 ambient; float shine; mat4 basis; } surface;\n\
    struct Skin { float gloss; sampler2D map; };\nuniform sampler2D first, second, pair[2];\nuniform Skin skin;\n\
    out vec4 colour;\n";

/// Bodies of `main`, each with what only fragment stages have, or only homeworks with uniforms of all types.
const BODIES: &[(&str, &str)] = &[
    ("smooth", "colour = vec4(abs(normal), 1.0);"),
    ("noperspective", "colour = vec4(fract(screen), fract(uv * 3.0).x, 1.0);"),
    ("flat", "colour = vec4(float(number + 2) / 4.0, vec2(marks) / 11.0, 1.0);"),
    ("flat-vector", "colour = vec4(tint, 1.0);"),
    ("centroid", "colour = vec4(wave * 0.5 + 0.5);"),
    ("matrix", "colour = vec4(abs(frame * vec3(0.3, 0.2, 0.1)), 1.0);"),
    ("array", "colour = vec4(abs(steps[0]), abs(steps[1]), 0.0, 1.0);"),
    ("block", "colour = vec4(abs(own.at) * 0.3, own.clip.w * 0.2);"),
    ("place", "colour = vec4(gl_FragCoord.xy / vec2(120.0, 90.0), gl_FragCoord.z, gl_FragCoord.w);"),
    ("checker", "ivec2 at = ivec2(gl_FragCoord.xy); colour = vec4((at.x / 5 + at.y / 3) % 2 == 0 ? 1.0 : 0.25);"),
    ("depth", "colour = vec4(vec3(gl_FragCoord.z * gl_FragCoord.z), 1.0);"),
    ("facing", "colour = gl_FrontFacing ? vec4(1.0, 0.5, 0.0, 1.0) : vec4(0.0, 0.5, 1.0, 1.0);"),
    ("discard", "if (fract(gl_FragCoord.x * 0.25) < 0.5) discard; colour = vec4(uv, 0.5, 1.0);"),
    ("discard-in-function", "colour = vec4(kept(uv.x), 0.0, 0.0, 1.0);"),
    ("derivatives", "colour = vec4(abs(dFdx(uv)) * 8.0, abs(dFdy(uv)) * 8.0);"),
    ("derivatives-signed", "colour = vec4(dFdx(own.at.xy) * 8.0 + 0.5, dFdy(own.at.yz) * 8.0 + 0.5);"),
    ("facet", "colour = vec4(normalize(cross(dFdx(own.at), dFdy(own.at))) * 0.5 + 0.5, 1.0);"),
    ("fwidth", "colour = vec4(fwidth(uv.x * 5.0));"),
    ("dfdy-of-place", "colour = vec4(dFdy(gl_FragCoord.y), dFdx(gl_FragCoord.x), dFdx(gl_FragCoord.y), 1.0);"),
    (
        "structs",
        "vec3 c = vec3(0.0); for (int i = 0; i < 2; i++) if (lights[i].on) c += lights[i].colours[1] * \
        max(dot(normalize(normal), normalize(lights[i].at)), 0.0) + lights[i].colours[0] * 0.2; colour = vec4(c, 1.0);",
    ),
    (
        "struct-copy",
        "Light l = lights[0]; Light m = lights[1]; colour = vec4(l.colours[0] * float(l.on) + m.colours[1] * float(!m.on), 1.0);",
    ),
    ("struct-array-copy", "Light l[2] = lights; colour = vec4(l[0].colours[1], l[1].on ? 1.0 : 0.5);"),
    ("matrices", "colour = vec4(abs(turn * normal), abs((squeeze * uv).x));"),
    ("integers", "colour = vec4(float(-count) * 0.25, float(mask.x) / 8.0, float(mask.y >> 31), 1.0);"),
    ("array-by-variable", "int i = number & 1; colour = vec4(weights[i], weights[2], weights[int(mask.x) - 5], 1.0);"),
    ("array-copy", "float w[3] = weights; w[1] += 0.125; colour = vec4(w[0], w[1], w[2], 1.0);"),
    ("bools", "colour = vec4(vec3(switches), any(switches) && !all(switches) ? 1.0 : 0.0);"),
    ("std140", "colour = surface.ambient * 0.5 + vec4(surface.shine * 0.1) + abs(surface.basis[2]) * 0.25;"),
    (
        "loop",
        "float x = uv.x; for (int i = 0; i < 12; i++) { x = x * x * 1.5 - 0.7; if (x > 1.0) break; } colour = vec4(abs(x));",
    ),
    (
        "fractal",
        "vec2 z = vec2(0.0), c = own.at.xy * 1.5; int n = 0; while (n < 40 && dot(z, z) < 4.0) \
        { z = vec2(z.x * z.x - z.y * z.y, 2.0 * z.x * z.y) + c; n++; } colour = vec4(float(n) / 40.0);",
    ),
    (
        "switch",
        "switch (number) { case -2: colour = vec4(1.0); break; case 0: colour = vec4(0.5); case 1: colour = vec4(0.2); break; default: colour = vec4(0.7); }",
    ),
    ("early-return", "colour = vec4(0.2); if (uv.x > 0.5) return; colour = vec4(uv, 1.0, 1.0);"),
    ("huge", "colour = vec4(1e30, -1e30, 3e9, 1.0);"),
    ("gradient-edge", "float e = abs(fract(uv.x * 4.0) - 0.5) / fwidth(uv.x * 4.0); colour = vec4(min(e, 1.0));"),
    ("written-depth", "gl_FragDepth = fract(gl_FragCoord.x / 16.0); colour = vec4(uv, 1.0, 1.0);"),
    ("texture", "colour = texture(first, uv * 2.0 - 0.5);"),
    ("texture-nearest", "colour = texture(second, uv * 1.4 - 0.2);"),
    ("textures-mixed", "colour = mix(texture(first, uv), texture(second, uv), 0.25);"),
    ("texture-in-struct", "colour = texture(skin.map, uv * 3.0) * (1.0 + skin.gloss);"),
    ("texture-in-array", "colour = texture(pair[0], uv) * 0.5 + texture(pair[1], -uv) * 0.5;"),
    (
        "texture-as-argument",
        "colour = looked(first, uv) * 0.5 + looked(skin.map, uv) * 0.25 + looked(pair[1], uv) * 0.25;",
    ),
    ("texture-fetch", "colour = texelFetch(second, ivec2(uv * 4.9), 0);"),
    ("texture-size", "colour = vec4(vec2(textureSize(first, 0)) / 8.0, 0.0, 1.0);"),
    ("texture-lod", "colour = textureLod(first, uv, 0.0) * 0.5 + textureOffset(second, uv, ivec2(1, -1)) * 0.5;"),
    (
        "texture-proj",
        "colour = textureProj(first, vec3(uv, 1.5)) * 0.5 + textureProj(second, vec4(uv, 9.0, 0.7)) * 0.5;",
    ),
    ("texture-gather", "colour = textureGather(second, uv, 1);"),
    ("texture-gradient", "colour = textureGrad(first, uv, dFdx(uv), dFdy(uv)) + texture(second, uv, 0.5) * 0.1;"),
    (
        "texture-derivative",
        "colour = vec4(fwidth(texture(first, uv * 4.0).xyz) + fwidth(texelFetch(second, ivec2(uv * 4.9), 0).x), 1.0);",
    ),
    ("texture-size-derivative", "colour = vec4(fwidth(uv * vec2(textureSize(first, 0))), 0.0, 1.0);"),
    (
        "texture-in-loop",
        "colour = vec4(0.0); for (int x = -1; x <= 1; x++) for (int y = -1; y <= 1; y++) \
        colour += texture(first, uv + vec2(x, y) / vec2(textureSize(first, 0))) / 9.0;",
    ),
    ("point", "colour = vec4(uv, float(gl_PointCoord.x > -1.0), 1.0);"),
];

/// A function that throws fragments away.
const KEPT: &str = "float kept(float x) { if (x < 0.4) { discard; } return x; }\n\
    vec4 looked(sampler2D map, vec2 at) { return texture(map, at); }\n";

fn text(body: &str) -> String {
    format!("#version 410\n{HEAD}{KEPT}void main() {{\n{body}\n}}\n")
}

pub fn renderer() -> Renderer {
    let assignment = reference::assignment("ggsample06").unwrap();
    let interface = ggrade::translate::LinkedInterface::of(assignment).unwrap();
    let fixed = translate::fixed_stage(&interface, assignment.files[0].starter_shader()).unwrap();
    let device = Device::open(AdapterKind::Software).unwrap_or_else(|fault| panic!("{fault}"));
    Renderer::new(device, Some(&fixed)).unwrap()
}

#[test]
fn fragment_stages_paint_what_opengl_paints() {
    let gl = OpenGl::with_version(Version::Raised460).unwrap_or_else(|missing| panic!("{missing}"));
    let mut renderer = renderer();
    let homework = sheets();
    let scene = homework.scene();
    let window = Window {
        width: SIZE[0],
        height: SIZE[1],
        background: scene.background.map(|channel| f32::from(channel) / 255.0),
        is_float: false,
    };
    let mut wrong = Vec::new();
    for (name, body) in BODIES {
        let text = text(body);
        let linked = homework.translate(&text).unwrap_or_else(|refusal| panic!("{name}: {refusal:?}"));
        let rendering = renderer.render_program(&linked, &scene).unwrap_or_else(|fault| panic!("{name}: {fault}"));
        assert_eq!(rendering.of_fragments.ran_out, None, "{name}");
        let ours = rendering.frames.picture(0);
        let textures: Vec<_> = homework.textures.iter().map(|(name, texels)| (*name, texture(texels))).collect();
        let textures: Vec<_> = textures.iter().map(|(name, texture)| (*name, texture)).collect();
        let theirs = gl.driver().scene([homework.vertex, &text], &homework.draws, &textures, window, 1);
        let theirs = theirs.unwrap_or_else(|rejection| panic!("{name}: {rejection:?}")).remove(0);
        let painted = ours.rgba.chunks_exact(4).filter(|pixel| pixel[3] != 0).count();
        let differing = (0..SIZE[1])
            .flat_map(|y| (0..SIZE[0]).map(move |x| (x, y)))
            .filter(|(x, y)| {
                let at = ((SIZE[1] - 1 - y) * SIZE[0] + x) * 4;
                let theirs = &theirs[y * SIZE[0] + x];
                (0..3).any(|axis| (f32::from(ours.rgba[at + axis]) / 255.0 - theirs[axis]).abs() > PIXEL_TOLERANCE)
            })
            .count();
        if differing > SIZE[0] * SIZE[1] / DOUBTFUL || painted < SIZE[0] * SIZE[1] / 8 {
            wrong.push(format!("{name}: {differing} pixels differ, {painted} are painted"));
        }
    }
    assert!(wrong.is_empty(), "{} of {} differ\n{}", wrong.len(), BODIES.len(), wrong.join("\n"));
}

#[test]
fn probes_of_fragment_stages_are_what_opengl_computes() {
    let gl = OpenGl::with_version(Version::Raised460).unwrap_or_else(|missing| panic!("{missing}"));
    let renderer = renderer();
    let homework = sheets();
    let fragment = "#version 410\nin vec3 normal;\nflat in int number;\nin mat3 frame;\nuniform Light { vec4 a; } l;\n\
        struct Lamp { bool on; vec3 at; vec3 colours[2]; };\nuniform Lamp lights[2];\n\
        layout(location = 1) out vec3 second;\nlayout(location = 0) out vec4 colour;\nlayout(location = 2) out ivec2 third;\n\
        void main() {\n  if (number == 3) discard;\n  colour = vec4(normal * 5.0, float(gl_FrontFacing)) + float(lights[0].on) + dFdx(normal.x);\n\
        second = frame * normal + gl_FragCoord.xyz;\n  third = ivec2(number, 7);\n}\n";
    let linked = homework.translate(fragment).unwrap_or_else(|refusal| panic!("{refusal:?}"));
    let normals = numbers(5, 3 * 70, -2.0, 2.0);
    let columns: Vec<Vec<f64>> = (0..3).map(|column| numbers(6 + column, 3 * 70, -1.0, 1.0)).collect();
    let labels: Vec<f64> = (0..70).map(|n| f64::from(n % 5)).collect();
    let places: Vec<f64> = (0..70).flat_map(|n| [f64::from(n) + 0.5, 40.5, 0.25, 1.0]).collect();
    let facing: Vec<f64> = (0..70).map(|n| f64::from(n % 3 / 2)).collect();
    let column =
        |name: &str, kind: Type, numbers: &[f64]| (name.to_owned(), Values { kind, numbers: numbers.to_vec() });
    let vec3 = || Type::Vector(Scalar::Float, 3);
    let probes = DrawCall {
        uniforms: batch(&homework.draws[0]).uniforms,
        attributes: vec![
            column("normal", vec3(), &normals),
            column("number", Type::INT, &labels),
            column("frame[0]", vec3(), &columns[0]),
            column("frame[1]", vec3(), &columns[1]),
            column("frame[2]", vec3(), &columns[2]),
            column("gl_FragCoord", Type::VEC4, &places),
            column("gl_FrontFacing", Type::FLOAT, &facing),
        ],
        ..DrawCall::default()
    };
    let scene = RenderScene { pixels: vec![probes], ..RenderScene::default() };
    let rendering = renderer.compute_pixels(&linked.fragment, &scene).unwrap();
    let outputs: Vec<&str> = linked.fragment.outputs.iter().map(|output| output.name.as_str()).collect();
    let output = |pixel: &Pixel, name: &str| pixel.outputs[outputs.iter().position(|own| *own == name).unwrap()];
    assert_eq!(rendering.pixels[0].len(), 70);
    for (index, pixel) in rendering.pixels[0].iter().enumerate() {
        assert_eq!(pixel.is_discarded, index % 5 == 3, "pixel {index}");
        if pixel.is_discarded {
            continue;
        }
        let normal: Vec<f32> = normals[3 * index..3 * index + 3].iter().map(|x| *x as f32).collect();
        let frame = |column: usize, row: usize| columns[column][3 * index + row] as f32;
        let place = [index as f32 + 0.5, 40.5, 0.25];
        let front = f32::from(u8::from(index % 3 == 2));
        let colour = [normal[0] * 5.0 + 1.0, normal[1] * 5.0 + 1.0, normal[2] * 5.0 + 1.0, front + 1.0];
        let second: [f32; 3] = std::array::from_fn(|row| {
            (0..3).map(|column| frame(column, row) * normal[column]).sum::<f32>() + place[row]
        });
        let near = |a: &[f32], b: &[f32]| a.iter().zip(b).all(|(a, b)| (a - b).abs() <= NUMBER_TOLERANCE);
        assert!(near(&output(pixel, "colour"), &colour), "pixel {index}: {pixel:?}, not {colour:?}");
        assert!(near(&output(pixel, "second")[..3], &second), "pixel {index}: {pixel:?}, not {second:?}");
        assert_eq!(output(pixel, "third")[..2], [(index % 5) as f32, 7.0], "pixel {index}");
    }
    drop(gl);
}
