//! The hostile stages, each with the end that it is promised.

/// What becomes of a hostile stage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// It runs to its end.
    Runs,
    /// It is stopped while it runs, for want of fuel.
    OutOfFuel,
    /// It is stopped before it runs.
    TooMuch,
    /// It is refused, as drivers do or because the program has nothing of the kind.
    Refused,
}
use End::{OutOfFuel, Refused, Runs, TooMuch};

const HEAD: &str = "#version 430\nin vec2 uv;\nin vec3 normal;\nflat in int number;\nuniform int count;\nuniform bvec3 switches;\n\
    uniform sampler2D first;\nout vec4 colour;\n";

/// Globals, and the body of `main`.
pub const STAGES: &[(&str, End, &str, &str)] = &[
    ("while-true", OutOfFuel, "", "while (true) {} colour = vec4(1.0);"),
    ("for-ever", OutOfFuel, "", "for (;;) colour.x += 0.1;"),
    ("do-while", OutOfFuel, "", "do { colour.x += uv.x; } while (colour.x >= 0.0 || colour.x < 1.0);"),
    ("count-up-for-ever", OutOfFuel, "", "for (int i = 0; i >= 0; i++) { i = i % 5; } colour = vec4(1.0);"),
    ("nested", OutOfFuel, "", "for (int i = 0; i < 1000; i++) for (int j = 0; j < 1000; j++) colour.x += uv.x;"),
    (
        "thrice-nested",
        OutOfFuel,
        "",
        "for (int i = 0; i < 99; i++) for (int j = 0; j < 99; j++) for (int k = 0; k < 99; k++) colour += uv.xyxy;",
    ),
    (
        "in-a-function",
        OutOfFuel,
        "float f(float x) { while (x >= 0.0) x += 1.0; return x; }",
        "colour = vec4(f(uv.x));",
    ),
    (
        "in-a-switch",
        OutOfFuel,
        "",
        "switch (number) { case 0: while (true) colour.x += 1.0; default: while (true) colour.y += 1.0; }",
    ),
    (
        "one-pixel",
        OutOfFuel,
        "",
        "if (int(gl_FragCoord.x) == 60 && int(gl_FragCoord.y) == 45) while (true) {} colour = vec4(1.0);",
    ),
    ("by-derivative", OutOfFuel, "", "float d = dFdx(uv.x); while (d < 1e30) { d = d * 0.5; } colour = vec4(d);"),
    ("by-texture", OutOfFuel, "", "while (texture(first, uv).x < 2.0) colour.x += 1.0;"),
    ("then-discard", OutOfFuel, "", "while (uv.x < 9.0) { colour.x += 1.0; } discard;"),
    ("discard-that-never-comes", OutOfFuel, "", "for (int i = 0; ; i++) if (i < -1) discard;"),
    ("discard-in-function-behind", OutOfFuel, "void f() { discard; }", "while (uv.x < 9.0) colour.x += 1.0; f();"),
    (
        "return-behind",
        OutOfFuel,
        "",
        "while (uv.x < 9.0) { colour.x += 1.0; } if (uv.x < 2.0) return; colour = vec4(1.0);",
    ),
    ("continue-for-ever", OutOfFuel, "", "int i = 0; while (i < 5) { if (uv.x < 9.0) continue; i++; }"),
    ("loop-by-uniform", OutOfFuel, "", "for (int i = 0; i != count; i += 2) colour.x += 1.0;"),
    (
        "long-body",
        OutOfFuel,
        "",
        "for (int i = 0; i < 40000; i++) { colour = sin(cos(tan(exp(sin(cos(tan(colour + uv.xyxy))))))); \
        colour = pow(abs(colour), uv.xyxy) + atan(colour) + sin(cos(tan(exp(sin(cos(tan(colour))))))); }",
    ),
    (
        "two-loops",
        OutOfFuel,
        "",
        "for (int i = 0; i < 30000; i++) colour.x += uv.x; for (int i = 0; i < 30000; i++) colour.y += uv.y;",
    ),
    (
        "fetch-in-loop",
        OutOfFuel,
        "",
        "for (int i = 0; i < 60000; i++) colour += texelFetch(first, ivec2(i % 6, i % 5), 0);",
    ),
    (
        "derivatives-in-endless-loop",
        OutOfFuel,
        "",
        "vec2 a = uv; while (a.x < 1e9) { a += dFdx(a) * 0.0 + fwidth(a) * 0.0; } colour = a.xyxy;",
    ),
    ("discard-all", Runs, "", "discard;"),
    ("discard-all-behind-a-write", Runs, "", "colour = vec4(1.0); discard;"),
    (
        "discard-behind-early-tests",
        Runs,
        "layout(early_fragment_tests) in;",
        "if (uv.x < 0.5) discard; colour = vec4(1.0);",
    ),
    ("depth-behind-early-tests", Runs, "layout(early_fragment_tests) in;", "gl_FragDepth = uv.x; colour = vec4(1.0);"),
    (
        "discard-at-random",
        Runs,
        "",
        "if (fract(sin(dot(gl_FragCoord.xy, vec2(12.9898, 78.233))) * 43758.5453) < 0.5) discard; colour = vec4(1.0);",
    ),
    (
        "discard-in-loop",
        Runs,
        "",
        "for (int i = 0; i < 100; i++) if (float(i) > uv.x * 50.0) discard; colour = vec4(1.0);",
    ),
    ("discard-in-function", Runs, "float f(float x) { if (x < 2.0) discard; return x; }", "colour = vec4(f(uv.x));"),
    (
        "discard-in-depth",
        Runs,
        "float f(float x) { if (x < 2.0) discard; return x; } float g(float x) { return f(f(x)); }",
        "colour = vec4(g(g(uv.x)));",
    ),
    ("nothing-written", Runs, "", ""),
    ("half-written", Runs, "", "if (uv.x < 0.5) colour = vec4(1.0);"),
    ("not-a-number", Runs, "", "colour = vec4(0.0 / (uv.x * 0.0), sqrt(-1.0 - uv.x), log(-uv.x), 1.0);"),
    ("infinite", Runs, "", "colour = vec4(1.0 / (uv.x * 0.0), -1.0 / (uv.y * 0.0), 1e38 * (uv.x + 9.0), 1.0);"),
    ("depth-not-a-number", Runs, "", "gl_FragDepth = 0.0 / (uv.x * 0.0); colour = vec4(1.0);"),
    ("divided-by-zero", Runs, "", "colour = vec4(float(number / (count + 3)), float(number % (count + 3)), 0.0, 1.0);"),
    ("shifted-too-far", Runs, "", "colour = vec4(float(number << (count * 50)), float(number >> 99), 0.0, 1.0);"),
    ("negative-power", Runs, "", "colour = vec4(pow(uv.x - 2.0, 0.5));"),
    ("array-of-all", TooMuch, "", "float a[100000]; a[number & 1] = uv.x; colour = vec4(a[count & 3]);"),
    (
        "arrays-of-arrays",
        TooMuch,
        "",
        "vec4 a[64][64][64]; a[1][2][number & 1] = uv.xyxy; colour = a[number & 3][1][2];",
    ),
    ("global-array", TooMuch, "mat4 a[9000];", "a[number & 7][1] = uv.xyxy; colour = a[count & 7][1];"),
    (
        "array-by-index",
        TooMuch,
        "",
        "float a[4000]; for (int i = 0; i < 4000; i++) a[i] = uv.x; colour = vec4(a[number & 1023]);",
    ),
    (
        "constant-array",
        Runs,
        "",
        "const float a[8] = float[8](1., 2., 3., 4., 5., 6., 7., 8.); colour = vec4(a[number & 7] / 8.0);",
    ),
    (
        "index-out-of-range",
        Runs,
        "",
        "float a[4] = float[4](1., 2., 3., 4.); colour = vec4(a[number * 1000], a[-number * 77], 0.0, 1.0);",
    ),
    (
        "structures-of-structures",
        TooMuch,
        "struct A { vec4 a[40]; }; struct B { A a[40]; }; struct C { B b[40]; };",
        "C c; c.b[number & 1].a[1].a[2] = uv.xyxy; colour = c.b[1].a[number & 1].a[2];",
    ),
    ("derivatives-in-a-row", Runs, "#define D(x) dFdx(x) + dFdy(x)\n#define E(x) D(D(D(x)))\n", "colour = E(uv.xyxy);"),
    (
        "derivative-storm",
        TooMuch,
        "#define D(x) (dFdx(x) + dFdy(x) + fwidth(x))\n#define E(x) D(D(D(D(D(D(D(x)))))))\n",
        "colour = E(sin(uv.xyxy));",
    ),
    (
        "derivatives-in-branches",
        Runs,
        "",
        "if (uv.x < 0.5) colour = dFdx(uv.xyxy); else colour = dFdy(uv.xyxy) + fwidth(normal.xyzx);",
    ),
    ("derivatives-in-loop", Runs, "", "for (int i = 0; i < 200; i++) colour += dFdx(uv.xyxy * float(i));"),
    (
        "texture-storm",
        TooMuch,
        "#define T(x) texture(first, x).xy\n#define U(x) T(T(T(T(T(T(T(T(x))))))))\n#define V(x) U(U(U(U(x))))\n",
        "colour = V(V(V(uv))).xyxy;",
    ),
    ("texture-at-nowhere", Runs, "", "colour = texture(first, vec2(0.0 / (uv.x * 0.0), 1.0 / (uv.x * 0.0)));"),
    ("texture-far-away", Runs, "", "colour = texture(first, uv * 1e30) + texture(first, -uv * 3e9);"),
    ("fetch-outside", Runs, "", "colour = texelFetch(first, ivec2(-2147483647, 2147483647), number * 9);"),
    (
        "fetch-everywhere",
        Runs,
        "",
        "for (int i = 0; i < 300; i++) colour += texelFetch(first, ivec2(i * 99991, -i * 77773), 0);",
    ),
    ("sampler-that-nobody-sets", Runs, "uniform sampler3D other;", "colour = texture(other, normal);"),
    (
        "image-store",
        Refused,
        "layout(rgba8) uniform image2D target;",
        "imageStore(target, ivec2(uv), vec4(1.0)); colour = vec4(1.0);",
    ),
    (
        "buffer",
        Refused,
        "layout(std430, binding = 0) buffer All { uint words[]; };",
        "words[number] = 7u; colour = vec4(1.0);",
    ),
    (
        "buffer-of-ours",
        Refused,
        "layout(std430, binding = 1) buffer All { uint words[]; };",
        "colour = vec4(float(words[99999999]));",
    ),
    (
        "counter",
        Refused,
        "layout(binding = 0) uniform atomic_uint counter;",
        "colour = vec4(float(atomicCounterIncrement(counter)));",
    ),
    ("recursion", Refused, "float f(float x) { return x < 0.0 ? x : f(x - 1.0); }", "colour = vec4(f(uv.x));"),
    (
        "recursion-by-two",
        Refused,
        "float g(float x); float f(float x) { return g(x); } float g(float x) { return f(x); }",
        "colour = vec4(f(uv.x));",
    ),
    (
        "macro-bomb",
        TooMuch,
        "#define A uv.x + uv.x + uv.x + uv.x\n#define B A + A + A + A\n#define C B + B + B + B\n#define D C + C + C + C\n\
        #define E D + D + D + D\n#define F E + E + E + E\n#define G F + F + F + F\n#define H G + G + G + G\n",
        "colour = vec4(H);",
    ),
    (
        "call-bomb",
        TooMuch,
        "float a(float x) { return sin(x) + cos(x); } float b(float x) { return a(a(a(a(x)))) + a(x); }\n\
        float c(float x) { return b(b(b(b(x)))) + b(x); } float d(float x) { return c(c(c(c(x)))) + c(x); }\n\
        float e(float x) { return d(d(d(d(x)))) + d(x); }",
        "colour = vec4(e(e(uv.x)));",
    ),
    (
        "many-outputs",
        Runs,
        "layout(location = 1) out vec4 b; layout(location = 2) out vec4 c; layout(location = 3) out vec4 d;",
        "b = c = d = uv.xyxy; colour = vec4(1.0);",
    ),
    (
        "matrices",
        Runs,
        "",
        "mat4 m = mat4(uv.x); for (int i = 0; i < 300; i++) m = inverse(m + mat4(0.5)) * transpose(m); colour = m[1];",
    ),
    ("sample-mask", Runs, "", "gl_SampleMask[0] = number; colour = vec4(1.0);"),
    ("sample-position", Runs, "", "colour = vec4(gl_SamplePosition, float(gl_SampleID), 1.0);"),
    ("own-header", Refused, "layout(std430) buffer capture { uint ran_out; };", "ran_out = 0u; colour = vec4(1.0);"),
    (
        "names-of-ours",
        Runs,
        "vec4 look_up(vec2 at) { return texture(first, at); } float detail_here = 1.0;",
        "colour = look_up(uv) * detail_here;",
    ),
];

pub fn text(globals: &str, body: &str) -> String {
    format!("{HEAD}{globals}\nvoid main() {{\n{body}\n}}\n")
}
