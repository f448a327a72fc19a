//! What ends early, and what is not taken.

use super::refusal;
use crate::interpreter::{Program, Stage};

#[test]
fn a_loop_without_end_runs_out_of_fuel() {
    for body in ["while (true) { }", "for (;;) ;", "int i = 0; do { i++; } while (i != -1 && x < 1.0);"] {
        let text = format!("in float x;\nout float y;\nvoid main() {{ y = 1.0;\n{body}\n}}");
        let program = Program::compile(&text, Stage::Vertex).expect("valid");
        let run = program.run(1).input("x", &[&[0.0]]).expect("x").fuel(100_000);
        assert_eq!(run.outputs().map_err(|stopped| stopped.line).err(), Some(4), "{body}");
    }
}

#[test]
fn a_program_that_calls_itself_is_not_taken() {
    let refusal = refusal("float f(int n) { return n < 1 ? 0.0 : f(n - 1); } void main() { f(3); }");
    assert!(!refusal.is_limit() && refusal.to_string().contains("calls itself"), "{refusal}");
}

#[test]
fn what_is_not_supported_is_named_with_its_line() {
    let refused = refusal("#version 430\nbuffer B { float a[]; };\nout float y;\nvoid main() {\n y = a[0];\n}");
    assert!(refused.is_limit() && refused.line == 5 && refused.to_string().contains("storage buffers"), "{refused}");
    let refused = refusal("void main() {\n float y = noise1(1.0);\n}");
    assert!(refused.is_limit() && refused.line == 2 && refused.to_string().contains("noise1"), "{refused}");
}

#[test]
fn what_is_wrong_is_named_with_its_line() {
    for (text, line, what) in [
        ("void main() {\n float x = 1.0\n}", 3, "`,` or `;` is expected"),
        ("void main() {\n vec3 v = vec2(1.0);\n}", 2, "vec2 is not vec3"),
        ("void main() {\n y = 1.0;\n}", 2, "no variable `y`"),
        ("float f();\nvoid main() { f(); }", 0, "not defined"),
        ("const int n = 3;\nvoid main() {\n n = 4;\n}", 3, "constant"),
        ("#if 1\nvoid main() { }", 1, "#endif"),
        ("out float y;", 0, "main"),
    ] {
        let refused = refusal(text);
        assert!(refused.line == line && refused.to_string().contains(what) && !refused.is_limit(), "{text}: {refused}");
    }
}

#[test]
fn nesting_without_measure_is_a_limit() {
    for text in [
        format!("void main() {{ float x = {}1.0{}; }}", "(".repeat(5000), ")".repeat(5000)),
        format!("void main() {{ {} {} }}", "{".repeat(5000), "}".repeat(5000)),
        format!("void main() {{ float x = {}1.0; }}", "- ".repeat(5000)),
        format!("void main() {{ {} }}", "if (true) ".repeat(5000) + ";"),
        format!("void main() {{ float a; a {}; }}", "= a ".repeat(5000)),
        "void main() { float a[100000000]; }".to_owned(),
    ] {
        assert!(refusal(&text).is_limit());
    }
    // What is long and not deep is taken.
    let sum = format!("out float y; void main() {{ y = 0.0{}; }}", " + 1.0".repeat(20_000));
    assert!(Program::compile(&sum, Stage::Vertex).is_ok());
}

#[test]
fn what_a_host_gives_must_fit() {
    let program = Program::compile("in vec2 p; uniform mat2 m; out vec2 y; void main() { y = m * p; }", Stage::Vertex);
    let program = program.expect("valid");
    assert!(program.run(1).uniform("n", &[0.0]).is_err());
    assert!(program.run(1).uniform("m", &[0.0]).is_err());
    assert!(program.run(1).input("p", &[&[0.0]]).is_err());
    assert!(program.run(2).input("p", &[&[0.0], &[0.0]]).is_err());
    assert!(program.run(1).input("p", &[&[0.0], &[0.0]]).is_ok());
}
