//! A canary: one shader writes a pattern wherever a shader can write, the next one in the same worker reads whatever it
//! never wrote. Nothing of the pattern may show.

use super::neighbours::{hand_in, lasting};
use super::settings;
use super::workers::grade;
use ggrade::report::Verdict;
use ggrade::sandbox::{Pool, Settings};

/// So many workers meet the writers, each its part of them.
const WORKERS: usize = 2;

/// Shaders that write `P` where they can: what stands before `main`, and in it.
const WRITERS: [(&str, &str, &str); 14] = [
    (
        "every pixel",
        "",
        "vc = P4; gl_Position = vec4(gl_VertexID % 3 == 1 ? 3 : -1, gl_VertexID % 3 == 2 ? 3 : -1, 0, 1);",
    ),
    ("colours that are no numbers", "", "vc = vec4(uintBitsToFloat(0x7FC05A5Au));"),
    ("positions", "", "vc = P4; gl_Position = P4;"),
    ("a local array", "", "vec4 a[24]; for (int i = 0; i < 24; i++) a[i] = P4; vc = a[any % 24];"),
    (
        "many locals",
        "",
        "float a[48], b[48]; for (int i = 0; i < 48; i++) { a[i] = P; b[i] = P; } vc = vec4(a[any % 48], b[any % 48], P, P);",
    ),
    (
        "global variables",
        "vec4 g[24]; mat4 m; float f;",
        "for (int i = 0; i < 24; i++) g[i] = P4; m = mat4(P4, P4, P4, P4); f = P; vc = g[any % 24] + m[any % 4] + f;",
    ),
    (
        "matrices and structs",
        "struct S { mat4 m; float x[7]; dvec2 d; };",
        "S s; s.m = mat4(P4, P4, P4, P4); for (int i = 0; i < 7; i++) s.x[i] = P; s.d = dvec2(P); vc = s.m[any % 4] + s.x[any % 7] + float(s.d.x);",
    ),
    (
        "outside a local array",
        "",
        "vec4 a[4]; a[0] = P4; for (int i = -64; i < 64; i++) a[i + any] = P4; vc = a[any % 4];",
    ),
    (
        "outside a global array",
        "float g[4];",
        "for (int i = -200; i < 200; i++) g[i + any] = P; vc = vec4(g[any % 4]);",
    ),
    (
        "outside a matrix and a vector",
        "",
        "mat4 m = mat4(P4, P4, P4, P4); vec4 u = P4; for (int i = -16; i < 16; i++) { m[i + any] = P4; u[i + any] = P; } vc = m[any % 4] + u;",
    ),
    (
        "more outputs",
        "out vec4 o0, o1, o2, o3, o4, o5; out vec4 list[4];",
        "o0 = o1 = o2 = o3 = o4 = o5 = P4; for (int i = -4; i < 8; i++) list[i + any % 4] = P4; vc = P4;",
    ),
    (
        "what the rasteriser reads",
        "out float gl_ClipDistance[8];",
        "gl_PointSize = P; for (int i = 0; i < 8; i++) gl_ClipDistance[i] = P; vc = P4;",
    ),
    (
        "parameters and results",
        "vec4 f(inout vec4 x, out mat4 y) { x = P4; y = mat4(P4, P4, P4, P4); return P4; }",
        "vec4 u; mat4 m; vc = f(u, m) + u + m[any % 4];",
    ),
    ("a buffer", "buffer Data { vec4 data[]; };", "for (int i = 0; i < 64; i++) data[i] = P4; vc = P4;"),
];

/// Shaders that show what they read without having written it.
const READERS: [(&str, &str, &str); 16] = [
    ("a colour never written", "", ""),
    ("a colour written in part", "", "vc.g = right.g;"),
    ("a colour before it is written", "", "vc = vc + right;"),
    ("a position never written", "", "vc = right; gl_Position = gl_Position;"),
    ("a local variable", "", "float x; vec4 u; mat4 m; vc = right + x + u + m[2];"),
    ("a local array", "", "vec4 a[24]; vc = right; for (int i = 0; i < 24; i++) vc += a[i];"),
    ("locals in turns", "", "vc = right; for (int i = 0; i < 9; i++) { vec4 u; vc += u; u = vec4(1); }"),
    (
        "global variables",
        "vec4 g[24]; mat4 m; float f;",
        "vc = right + m[any % 4] + f; for (int i = 0; i < 24; i++) vc += g[i];",
    ),
    (
        "structs and doubles",
        "struct S { mat4 m; float x[7]; dvec2 d; };",
        "S s; vc = right + s.m[any % 4] + s.x[any % 7] + float(s.d.y);",
    ),
    (
        "outside a local array",
        "",
        "vec4 a[4] = vec4[4](right, right, right, right); vc = vec4(0); for (int i = -64; i < 64; i++) vc += a[i + any];",
    ),
    ("outside a global array", "float g[4];", "vc = right; for (int i = -200; i < 200; i++) vc += g[i + any];"),
    (
        "outside the uniforms",
        "uniform vec4 list[4];",
        "vc = right; for (int i = -64; i < 64; i++) vc += list[i + any] + mw[i + any];",
    ),
    ("outside a vector", "", "vec4 u = right; vc = vec4(0); for (int i = -16; i < 16; i++) vc += u[i + any];"),
    (
        "what nobody feeds",
        "in vec4 extra; uniform mat4 more; uniform sampler2D picture;",
        "vc = right + vec4(extra.xyz, 0) + more[1] + texture(picture, n.xy);",
    ),
    (
        "outputs",
        "out vec4 o0, list[4]; out float gl_ClipDistance[2];",
        "vc = right + o0 + list[any % 4] + gl_PointSize + gl_ClipDistance[any % 2];",
    ),
    (
        "results and parameters",
        "vec4 f(float x) { if (x > 5.0) return vec4(1); } void g(out vec4 x) {}",
        "vec4 u; g(u); vc = right + f(n.x) + u + vec4(1 / int(n.x * 0.0));",
    ),
];

/// The whole shader; the pattern's bytes are 5A each, and `any` is an index that no compiler knows.
fn shader((_, globals, body): &(&str, &str, &str)) -> Vec<u8> {
    let text = format!(
        "#version 430 core\nconst float P = uintBitsToFloat(0x5A5A5A5Au);\nconst vec4 P4 = vec4(P);\nin vec4 pv, cv;\n\
         uniform mat4 mw, mc, mg;\nout vec4 vc;\n{globals}\nvoid main()\n{{\n  gl_Position = mc * pv;\n\
         \x20 int any = gl_VertexID;\n  vec3 n = normalize((mg * cv).xyz);\n\
         \x20 vec3 h = normalize(vec3(0, 0, 1) - normalize((mw * pv).xyz)), red = vec3(0.6, 0, 0);\n\
         \x20 vec4 right = vec4(0.2 * red + max(n.z, 0) * red + pow(max(dot(n, h), 0), 80) * 0.4, 1);\n  {body}\n}}\n"
    );
    text.into_bytes()
}

#[test]
fn nothing_of_a_shader_shows_in_the_next() {
    let fresh: Vec<String> = {
        let pool = Pool::start(settings().with_single_use_workers(), 1).unwrap();
        READERS.iter().map(|reader| lasting(hand_in(&pool, reader.0, &shader(reader)))).collect()
    };
    // A worker is used again until it has grown by a file's memory: here each stays to the end.
    let fresh = &fresh;
    std::thread::scope(|scope| {
        for writers in WRITERS.chunks(WRITERS.len().div_ceil(WORKERS)) {
            scope.spawn(move || {
                let settings = Settings { spares: 0, gradings_per_worker: u32::MAX, memory: 4 << 30, ..settings() };
                let pool = Pool::start(settings, 1).unwrap();
                pool.warm().unwrap();
                let worker = pool.idle_processes();
                assert_eq!(worker.len(), 1);
                writers.iter().for_each(|writer| leaves_nothing(&pool, writer, fresh));
                assert_eq!(pool.idle_processes(), worker, "one worker met them all");
            });
        }
    });
}

/// Each reader says after the writer what it says in a fresh process.
fn leaves_nothing(pool: &Pool, writer: &(&str, &str, &str), fresh: &[String]) {
    for (reader, fresh) in READERS.iter().zip(fresh) {
        let written = grade(pool, &shader(writer)).unwrap().report;
        let was_drawn = matches!(written.verdict, Verdict::Correct | Verdict::Wrong);
        assert_eq!(was_drawn, writer.0 != "a buffer", "{}: {:?}", writer.0, written.diagnostics);
        let read = hand_in(pool, reader.0, &shader(reader));
        assert!(!read.frames.is_empty(), "{} was not drawn: {:?}", reader.0, read.report.diagnostics);
        assert!(lasting(read) == *fresh, "{} shows after {}", reader.0, writer.0);
    }
}

/// The pattern is there to be found: it fills the pictures of the shader that paints with it, and it is not the right
/// answer's colour.
#[test]
fn the_pattern_would_show() {
    let pool = Pool::start(settings(), 1).unwrap();
    let painted = hand_in(&pool, WRITERS[0].0, &shader(&WRITERS[0])).frames;
    // 5A5A5A5A is 1.5e16 as a float: white, in every pixel.
    assert!(painted.iter().all(|picture| picture.rgba.chunks_exact(4).all(|pixel| pixel[..3] == [255; 3])));
    let quiet = lasting(hand_in(&pool, "a", &shader(&("", "", "vc = right;"))));
    let leaking = lasting(hand_in(&pool, "a", &shader(&("", "", "vc = right + (any == 41 ? P : 0.0);"))));
    assert!(quiet != leaking, "one vertex of one probe shows");
}
