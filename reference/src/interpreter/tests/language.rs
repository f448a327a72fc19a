//! Types, operators, statements and functions.

use super::{is, outputs, result, results};

#[test]
fn integers_wrap_and_shift() {
    is("int", "2147483647 + 1", &[-2_147_483_648.0]);
    is("uint", "0u - 1u", &[4_294_967_295.0]);
    is("int", "65536 * 65537", &[65_536.0]);
    is("ivec3", "ivec3(-7 / 2, 7 % 4, -8 >> 1)", &[-3.0, 3.0, -4.0]);
    is("uvec3", "uvec3(0xF0u ^ 0xFFu, ~0u >> 28, 1u << 31)", &[15.0, 15.0, 2_147_483_648.0]);
    is("ivec2", "ivec2(-2.9, 2.9)", &[-2.0, 2.0]);
    is("uint", "uint(-1)", &[4_294_967_295.0]);
}

#[test]
fn large_whole_numbers_are_rounded_as_floats() {
    is("int", "int(16777217.0)", &[16_777_216.0]);
    is("float", "float(16777217)", &[16_777_216.0]);
    is("double", "double(16777217)", &[16_777_217.0]);
}

#[test]
fn constructors_take_what_they_need() {
    is("mat3", "mat3(mat2(1.0, 2.0, 3.0, 4.0))", &[1.0, 2.0, 0.0, 3.0, 4.0, 0.0, 0.0, 0.0, 1.0]);
    is("mat2x3", "mat2x3(2.0)", &[2.0, 0.0, 0.0, 0.0, 2.0, 0.0]);
    is("vec4", "vec4(vec2(1.0, 2.0), ivec3(3, 4, 5))", &[1.0, 2.0, 3.0, 4.0]);
    is("vec2", "vec2(mat2(1.0, 2.0, 3.0, 4.0))", &[1.0, 2.0]);
    is("float", "float[3](1.0, 2.0, 3.0)[1]", &[2.0]);
    is("int", "int[][2](int[2](1, 2), int[2](3, 4)).length()", &[2.0]);
    is("float", "float(vec3(7.0, 8.0, 9.0))", &[7.0]);
    is("bvec2", "bvec2(0.5, 0)", &[1.0, 0.0]);
}

#[test]
fn matrices_multiply_as_in_linear_algebra() {
    // Columns (1, 2) and (3, 4): the rows are (1, 3) and (2, 4).
    is("vec2", "mat2(1.0, 2.0, 3.0, 4.0) * vec2(5.0, 6.0)", &[23.0, 34.0]);
    is("vec2", "vec2(5.0, 6.0) * mat2(1.0, 2.0, 3.0, 4.0)", &[17.0, 39.0]);
    is("mat2", "mat2(1.0, 2.0, 3.0, 4.0) * mat2(0.0, 1.0, 1.0, 0.0)", &[3.0, 4.0, 1.0, 2.0]);
    is("vec3", "mat2x3(1.0, 2.0, 3.0, 4.0, 5.0, 6.0) * vec2(1.0, 10.0)", &[41.0, 52.0, 63.0]);
    is("mat2", "1.0 / mat2(1.0, 2.0, 4.0, 8.0)", &[1.0, 0.5, 0.25, 0.125]);
}

#[test]
fn swizzles_are_places() {
    assert_eq!(
        result("vec4", "vec4 v = vec4(1, 2, 3, 4); v.xy = v.yx; v.wz += v.xy; result = v.rgba.abgr;", 0.0),
        [6.0, 4.0, 1.0, 2.0]
    );
    assert_eq!(
        result("vec3", "vec3 v = vec3(1, 2, 3); v.zyx.xy = vec2(8, 9); v[0]++; result = v;", 0.0),
        [2.0, 9.0, 8.0]
    );
    assert_eq!(
        result("mat2", "mat2 m = mat2(0); m[1].x = 3.0; int i = 0; m[i].ts = vec2(5, 6); result = m;", 0.0),
        [6.0, 5.0, 3.0, 0.0]
    );
}

#[test]
fn arrays_of_structures_are_indexed() {
    let text = "#version 460\nin float x; out vec2 result; struct Lamp { vec2 at; float power[2]; };\n\
        const Lamp lamps[] = { { vec2(1, 2), { 3, 4 } }, { vec2(5, 6), { 7, 8 } } };\n\
        void main() { int i = int(x); Lamp copy[2] = lamps; copy[i].power[1 - i] = 9.0; copy[1 - i] = copy[i];\n\
        result = vec2(lamps[i].at.y, copy[1 - i].power[1 - i]); }";
    let result = outputs(text, &[0.0, 1.0]);
    let result = result.get("result").expect("the output");
    assert_eq!([result.sample(0), result.sample(1)], [[2.0, 9.0], [6.0, 9.0]]);
}

#[test]
fn lanes_part_ways_and_meet_again() {
    let x = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0];
    let values = |body: &str| results("float", body, &x).concat();
    assert_eq!(
        values("if (x < 2.0) result = 1.0; else if (x < 4.0) result = 2.0; else result = 3.0;"),
        [1.0, 1.0, 2.0, 2.0, 3.0, 3.0]
    );
    // Sums of the odd numbers up to x, without 3, until 5.
    let body = "result = 0.0; for (int i = 0; i <= int(x); ++i) { if (i % 2 == 0) continue; if (i == 3) continue; if (i == 5) break; result += float(i); }";
    assert_eq!(values(body), [0.0, 1.0, 1.0, 1.0, 1.0, 1.0]);
    assert_eq!(
        values("int i = int(x), n = 0; do { n++; if (n > 9) break; } while (i-- > 1); result = float(n);"),
        [1.0, 1.0, 2.0, 3.0, 4.0, 5.0]
    );
    assert_eq!(
        values("int i = 0; while (true) { if (++i > int(x)) { result = float(i); return; } }"),
        [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]
    );
    let body = "result = 0.0; switch (int(x)) { case 1: result += 1.0; case 2: result += 2.0; break; default: result += 10.0; case 3: result += 3.0; break; case 4: break; }";
    assert_eq!(values(body), [13.0, 3.0, 2.0, 3.0, 0.0, 13.0]);
}

#[test]
fn a_loop_in_a_switch_in_a_loop_breaks_its_own() {
    let body = "result = 0.0; for (int i = 0; i < 3; ++i) { switch (i) { case 1: while (true) { result += 1.0; if (result > x) break; } break; case 2: continue; } result += 10.0; }";
    assert_eq!(results("float", body, &[0.0, 12.0]).concat(), [21.0, 23.0]);
}

#[test]
fn parameters_are_copied_in_and_out() {
    let text = "#version 410\nin float x; out vec4 result; float total = 1.0;\n\
        void swap(inout float a, inout float b) { float c = a; a = b; b = c; }\n\
        float add(float a, out float twice) { total += a; twice = 2.0 * a; a = 0.0; return total; }\n\
        float add(int a);\n\
        void main() { vec4 v = vec4(x, 2, 3, 4); swap(v.x, v.w); int i = 1; swap(v[i], v[i + 1]);\n\
        float t; result = vec4(add(v.x, t) + add(v.y, t), t, v.z, add(7)); }\n\
        float add(int a) { return float(a) + total; }";
    let result = outputs(text, &[1.0]);
    // v becomes (4, 3, 2, 1); total 1 + 4 = 5, then 8; 5 + 8, 2 · 3, 2, and 7 + 8.
    assert_eq!(result.get("result").expect("the output").sample(0), [13.0, 6.0, 2.0, 15.0]);
}

#[test]
fn operands_are_evaluated_once_and_from_the_left() {
    assert_eq!(result("vec2", "float a = 1.0; float b = a++ + a * (a = 5.0); result = vec2(a, b);", 0.0), [5.0, 11.0]);
    assert_eq!(result("float", "float a = 1.0; a += (a = 4.0); result = a;", 0.0), [8.0]);
    assert_eq!(
        result(
            "float",
            "float n = 0.0; bool b = false && ++n > 0.0 || true || ++n > 0.0; b = b ? n > 9.0 : ++n > 0.0; result = n;",
            0.0
        ),
        [0.0]
    );
    assert_eq!(
        result("float", "int a[3] = int[](5, 6, 7), i = 0; a[i++] += 10; result = float(a[0] + i);", 0.0),
        [16.0]
    );
}

#[test]
fn names_hide_names() {
    let text = "#version 410\nin float x; out float result; float max(float a, float b) { return a + b; } struct S { float x; };\n\
        void main() { float S = x; { float x = 3.0; S += x; } for (int x = 0; x < 2; x++) S += float(x); result = max(S, 1.0); }";
    assert_eq!(outputs(text, &[2.0]).get("result").expect("the output").sample(0), [7.0]);
}

#[test]
fn variables_of_main_can_be_looked_at() {
    let program = super::Program::compile(
        "out float y; void main() { vec2 half_sum = vec2(1, 2); { float inner = 1.0; } y = half_sum.x; }",
        super::Stage::Vertex,
    );
    let program = program.expect("valid");
    assert_eq!(program.locals().iter().map(|local| local.name.as_str()).collect::<Vec<_>>(), ["half_sum"]);
    let outputs = program.run(1).outputs_and_locals(&["half_sum"]).expect("an end");
    assert_eq!(outputs.locals[0].sample(0), [1.0, 2.0]);
}
