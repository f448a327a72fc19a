//! What GLSL leaves open, and that nothing else is said to be.

use super::outputs;
use crate::interpreter::Undefined;

/// Why `result` is undefined, for each `x`, and the line.
fn causes(body: &str, x: &[f64]) -> Vec<Option<(Undefined, u32)>> {
    let text = format!(
        "in float x; out float result; float f(float a) {{ if (a > 0.0) return a; }}\nvoid main() {{\n{body}\n}}"
    );
    let outputs = outputs(&format!("#version 460\n{text}"), x);
    let result = outputs.get("result").expect("the output");
    // Three lines stand before the body: a cause in the second of them, where `f` and `result` are, is one in line 0.
    (0..x.len())
        .map(|sample| result.undefined(0, sample).map(|cause| (cause.what, cause.line.saturating_sub(3))))
        .collect()
}

#[track_caller]
fn only_second(body: &str, x: [f64; 2], what: Undefined, line: u32) {
    assert_eq!(causes(body, &x), [None, Some((what, line))], "{body}");
}

#[test]
fn values_that_glsl_leaves_open_are_told_with_their_line() {
    only_second("result = pow(x, 2.0);", [1.0, -1.0], Undefined::Power, 1);
    only_second("float zero = 0.0;\nresult = pow(zero, x);", [1.0, 0.0], Undefined::Power, 2);
    only_second("result = sqrt(x);", [0.0, -1.0], Undefined::Domain, 1);
    only_second("result = log(x);", [1.0, 0.0], Undefined::Domain, 1);
    only_second("result = normalize(vec2(x)).x;", [1.0, 0.0], Undefined::Domain, 1);
    only_second("result = float(1 / int(x));", [1.0, 0.0], Undefined::Division, 1);
    only_second("result = float(int(x) % 3);", [1.0, -1.0], Undefined::Remainder, 1);
    only_second("result = float(1 << int(x));", [31.0, 32.0], Undefined::Shift, 1);
    only_second("result = float(int(x));", [2e9, 3e9], Undefined::Conversion, 1);
    only_second("float a[3] = float[](1.0, 2.0, 3.0);\n\nresult = a[int(x)];", [2.0, 3.0], Undefined::Index, 3);
    only_second("result = f(x);", [1.0, 0.0], Undefined::NoResult, 0);
    only_second("float y;\nif (x > 0.0) y = 1.0;\nresult = y;", [1.0, 0.0], Undefined::Uninitialised, 1);
    only_second("result = smoothstep(x, 1.0, 0.5);", [0.0, 1.0], Undefined::Bounds, 1);
    only_second("if (x > 0.0) result = 1.0;", [1.0, 0.0], Undefined::Unwritten, 0);
}

#[test]
fn an_undefined_value_that_is_not_used_does_no_harm() {
    for body in [
        "float y; y = 1.0; result = y;",
        "float y; result = x > 0.0 ? y : 1.0;",
        "float a[2] = float[](1.0, 2.0); int i = 7; result = i < 2 ? a[i] : 0.0;",
        "vec2 v; v.x = 1.0; result = v.x;",
        "bool b; result = float(x > 0.0 && b);",
        "float y = sqrt(-1.0 + x); y = 2.0; result = y;",
    ] {
        assert_eq!(causes(body, &[0.0]), [None], "{body}");
    }
}

#[test]
fn what_an_undefined_value_decides_is_undefined() {
    for body in
        ["float y; result = 1.0; if (y > 0.0) result = 1.0;", "int a[2] = int[](0, 1); int i; a[i] = 2; result = 1.0;"]
    {
        assert_eq!(causes(body, &[0.0]), [Some((Undefined::Uninitialised, 1))], "{body}");
    }
    // A write to nowhere may hit anything.
    assert_eq!(causes("int a[2] = int[](0, 1); a[int(x)] = 2; result = 1.0;", &[5.0]), [Some((Undefined::Index, 1))]);
}

#[test]
fn infinity_is_defined_and_what_is_not_a_number_is_not() {
    assert_eq!(causes("result = 1e38 * 1e38 * (x + 1.0);", &[0.0]), [None]);
    let infinite = "float i = 1e38 * 1e38 * (x + 1.0);\n";
    assert!(matches!(causes(&format!("{infinite}result = i - i;"), &[0.0])[..], [Some((Undefined::NotANumber, _))]));
    let least = causes(&format!("{infinite}float n = i - i;\nresult = max(n, 0.0);"), &[0.0]);
    assert_eq!(least, [Some((Undefined::NotANumber, 3))]);
}

#[test]
fn a_division_by_zero_may_give_anything() {
    only_second("result = 1.0 / x;", [1.0, 0.0], Undefined::Division, 1);
    only_second("result = mod(1.0, x);", [1.0, 0.0], Undefined::Division, 1);
    only_second("result = float(1.0lf / double(x));", [1.0, 0.0], Undefined::Division, 1);
    // 1 to an infinite power is exp2(inf * log2(1)).
    let infinite = "float i = 1e38 * 1e38;\n";
    only_second(&format!("{infinite}result = pow(2.0, x < 1.0 ? i : x);"), [2.0, 0.0], Undefined::Power, 2);
}
