//! What programs compute, derived by hand from the specification.

mod functions;
mod language;
mod limits;
mod sheet;
mod stages;
mod trace;
mod undefined;

use super::{Outputs, Precision, Program, Refusal, Stage};

/// Runs a vertex shader whose `float x` is this column, and gives its outputs.
fn outputs(text: &str, x: &[f64]) -> Outputs {
    let program = Program::compile(text, Stage::Vertex).unwrap_or_else(|refusal| panic!("{refusal}\n{text}"));
    let mut run = program.run(x.len());
    if program.inputs().iter().any(|input| input.name == "x") {
        run = run.input("x", &[x]).expect("x is a float");
    }
    run.outputs().unwrap_or_else(|stopped| panic!("stopped at line {}\n{text}", stopped.line))
}

/// The scalars of `result` for each `x`, of a body that sets it.
fn results(kind: &str, body: &str, x: &[f64]) -> Vec<Vec<f64>> {
    let text = format!("#version 460\nin float x;\nout {kind} result;\nvoid main() {{\n{body}\n}}");
    let outputs = outputs(&text, x);
    let result = outputs.get("result").expect("the output");
    (0..x.len()).map(|sample| result.sample(sample)).collect()
}

/// The same for one sample.
fn result(kind: &str, body: &str, x: f64) -> Vec<f64> {
    results(kind, body, &[x]).remove(0)
}

/// The value of an expression.
#[track_caller]
fn is(kind: &str, expression: &str, expected: &[f64]) {
    let found = result(kind, &format!("result = {expression};"), 0.0);
    let apart = |(a, b): (&f64, &f64)| (a - b).abs() > 1e-12 * b.abs().max(1.0) && a != b;
    let differs = found.len() != expected.len() || found.iter().zip(expected).any(apart);
    assert!(!differs, "{expression} is {found:?}, not {expected:?}");
    // The same with operands that are not known before the program runs.
    let text = format!(
        "#version 460\nin float x;\nout {kind} result;\nfloat zero;\nvoid main() {{ zero = x; result = {}; }}",
        hidden(expression)
    );
    let hidden = outputs(&text, &[0.0]);
    let found = hidden.get("result").expect("the output").sample(0);
    assert!(!found.iter().zip(expected).any(apart), "{text} is {found:?}, not {expected:?}");
}

/// An expression with `+ zero` behind each of its float literals.
fn hidden(expression: &str) -> String {
    let mut text = String::new();
    let mut word = String::new();
    for character in expression.chars().chain([' ']) {
        if character.is_ascii_alphanumeric() || character == '.' || character == '_' {
            word.push(character);
            continue;
        }
        let is_float = word.starts_with(|c: char| c.is_ascii_digit()) && word.contains('.') && !word.contains('f');
        text += &if is_float { format!("({word} + zero)") } else { word.clone() };
        word.clear();
        text.push(character);
    }
    text
}

fn refusal(text: &str) -> Refusal {
    Program::compile(text, Stage::Vertex).expect_err("a refusal")
}

#[test]
fn a_program_runs_for_more_samples_than_fit_a_block() {
    let x: Vec<f64> = (0..1001).map(f64::from).collect();
    let results = results("float", "result = 0.0; for (int i = 0; i < int(x) % 7; i++) result += x;", &x);
    for (x, result) in x.iter().zip(results) {
        assert_eq!(result, [x % 7.0 * x]);
    }
}

#[test]
fn rounding_to_single_precision_can_be_asked_for() {
    let program =
        Program::compile("in float x; out float y; void main() { y = x + 1.0; }", Stage::Vertex).expect("valid");
    let run = |precision| {
        let run = program.run(1).input("x", &[&[1e-9]]).expect("x").precision(precision);
        run.outputs().expect("an end").get("y").expect("y").sample(0)
    };
    assert_eq!(run(Precision::Exact), [1.000_000_001]);
    assert_eq!(run(Precision::Single), [1.0]);
    let number = |expression: &str, precision| {
        let text = format!("in float x; out float y; void main() {{ float one = x; y = {expression}; }}");
        let program = Program::compile(&text, Stage::Vertex).expect("valid");
        let run = program.run(1).input("x", &[&[1.0]]).expect("x").precision(precision);
        run.outputs().expect("an end").get("y").expect("y").sample(0)[0]
    };
    for way in 0..4 {
        // 2^-133 has no leading 1 as a float, and may be 0 for a driver.
        for small in ["one * 1e-30 * 1e-10", "intBitsToFloat(int(one) << 16)", "one * 1e-40"] {
            let small = format!("{small} * 1e38 * 100.0");
            assert!(number(&small, Precision::Exact) > 0.5, "{small}");
            assert_eq!(number(&small, Precision::Noisy(way)), 0.0, "{small}");
        }
        // A large angle, and a large whole number that need not be rounded, are a driver's own.
        let moved =
            |expression| (number(expression, Precision::Noisy(way)) - number(expression, Precision::Exact)).abs();
        assert!(moved("sin(one * 67108864.0)") > 1e-3);
        assert_eq!(moved("float(int(float(int(one) * 16777217)) - 16777216)"), 1.0);
        assert_eq!(moved("float(int(float(int(one) * 1000)))"), 0.0);
    }
    // What is no float becomes one that is near.
    for way in 0..4 {
        let noisy = run(Precision::Noisy(way))[0];
        assert!(noisy != 1.0 && (noisy - 1.0).abs() < 2e-6 && f64::from(noisy as f32) == noisy, "{noisy}");
    }
}
