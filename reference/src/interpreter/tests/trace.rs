//! What is recorded of a program, and what a changed value becomes.

use crate::interpreter::syntax::Binary;
use crate::interpreter::trace::{Event, Trace, ValueChange, What};
use crate::interpreter::{Outputs, Program, Stage};

const FUEL: u64 = 1_000_000;

fn traced(text: &str) -> Program {
    Program::traced(text, Stage::Vertex).unwrap_or_else(|refusal| panic!("{refusal}\n{text}"))
}

fn trace(program: &Program, x: &[f64]) -> (Outputs, Trace) {
    let mut prepared = program.prepared(x.len(), &[], FUEL);
    prepared.feed("x", &[x.to_vec()]).expect("x is a float");
    prepared.trace(&[]).expect("it ends").expect("it is short")
}

/// The values that a variable is given, in order.
fn given(program: &Program, trace: &Trace, wanted: &str) -> Vec<(u32, Vec<f64>)> {
    let events = trace.events.iter().filter_map(|event| {
        let site = &program.sites()[event.site];
        let is_it = matches!(&site.what, What::Assign { name, .. } if name == wanted);
        is_it.then(|| (site.line, event.values[0].clone()))
    });
    events.collect()
}

#[test]
fn a_traced_program_computes_what_it_computes_otherwise() {
    let text = "#version 460\nin float x;\nout vec3 y;\nconst int N = 2;\nfloat twice(float a) { return 2.0 * a; }\n\
        void main() {\n float a[N];\n for (int i = 0; i < N; i++) a[i] = twice(x) + float(i);\n\
        y = vec3(a[0], a[1], x > 1.0 ? 1.0 : -1.0);\n}";
    let program = traced(text);
    let (outputs, _) = trace(&program, &[1.0, 3.0]);
    assert_eq!(outputs.get("y").unwrap().values, [[2.0, 6.0], [3.0, 7.0], [-1.0, 1.0]]);
}

#[test]
fn values_have_the_line_on_which_they_are_written() {
    let text = "#version 460\nin float x;\nout float y;\n#define TWICE(a) (2.0 * (a))\nvoid main() {\n  float b = TWICE(x)\n    + 1.0;\n  y = b;\n}";
    let program = traced(text);
    let (_, trace) = trace(&program, &[3.0]);
    assert_eq!(given(&program, &trace, "b"), [(6, vec![7.0])]);
    let product = trace.events.iter().find(|event| event.values == [[6.0]]).expect("the product");
    assert_eq!(program.sites()[product.site].line, 4);
}

#[test]
fn what_a_macro_writes_several_times_has_one_site() {
    let text = "#version 460\nin float x;\nout float y;\n#define SHARE(a) ((a) / (3.0 - 2.0 * (a)))\nvoid main() {\n  float b = \
        SHARE(\n    x * 0.5);\n  float c = SHARE(x);\n  y = b + c;\n}";
    let program = traced(text);
    let (_, trace) = trace(&program, &[1.0]);
    let halves: Vec<&Event> = trace.events.iter().filter(|event| program.sites()[event.site].line == 7).collect();
    // Twice each: the variable, the number, their product.
    assert_eq!(halves.len(), 6);
    assert!(halves[..3].iter().zip(&halves[3..]).all(|(one, other)| one.site == other.site));
    // The body has one `3.0` for both uses, and a quotient for each.
    let of = |what: &What| program.sites().iter().filter(|site| site.line == 4 && site.what == *what).count();
    assert_eq!((of(&What::Literal), of(&What::Binary(Binary::Divide))), (2, 2));
}

#[test]
fn branches_have_the_samples_that_run_them_and_the_condition_that_decides() {
    let text = "#version 460\nin float x;\nout float y;\nvoid main() {\n  y = 0.0;\n  if (x > 1.0)\n    y = x;\n}";
    let program = traced(text);
    let (_, trace) = trace(&program, &[1.0, 3.0]);
    let within = trace.events.iter().rfind(|event| program.sites()[event.site].line == 7).expect("the branch");
    assert_eq!(within.lanes, [false, true]);
    let condition = &trace.events[within.under[0]];
    assert_eq!((program.sites()[condition.site].line, condition.values[0].as_slice()), (6, &[0.0, 1.0][..]));
    // The output may come from both.
    assert_eq!(trace.outputs[0].len(), 2);
}

#[test]
fn a_changed_value_changes_what_is_made_of_it_and_only_in_that_run() {
    let text = "#version 460\nin float x;\nout float y;\nconst float K = 2.0;\nvoid main() {\n  float a = K * x;\n  y = a + K;\n}";
    let program = traced(text);
    let mut prepared = program.prepared(1, &[], FUEL);
    prepared.feed("x", &[vec![3.0]]).unwrap();
    let site = |wanted: &str| {
        let is_it = |what: &What| matches!(what, What::Assign { name, .. } if name == wanted);
        program.sites().iter().position(|site| is_it(&site.what)).expect("the variable")
    };
    let mut with = |site: usize, number: f64| {
        let change = ValueChange { site, values: vec![vec![vec![number]]] };
        prepared.outputs(&[change]).unwrap().get("y").unwrap().values[0][0]
    };
    assert_eq!(with(site("a"), 10.0), 12.0);
    // A constant is changed wherever it is used.
    assert_eq!(with(site("K"), 5.0), 20.0);
    assert_eq!(with(site("a"), 6.0), 8.0);
}

#[test]
fn what_a_function_leaves_in_its_parameter_comes_from_there() {
    let text = "#version 460\nin float x;\nout float y;\nvoid set(out float a) {\n  a = 3.0 * x;\n}\nvoid main() {\n  float b;\n  set(b);\n  y = b;\n}";
    let program = traced(text);
    let (_, trace) = trace(&program, &[2.0]);
    let mut open = trace.outputs[0].clone();
    let mut lines = Vec::new();
    while let Some(event) = open.pop() {
        lines.push(program.sites()[trace.events[event].site].line);
        open.extend(&trace.events[event].from);
    }
    assert!(lines.contains(&5), "{lines:?}");
}

#[test]
fn a_result_that_goes_nowhere_is_known() {
    let text =
        "#version 460\nin float x;\nout float y;\nvoid main() {\n  vec2 a = vec2(x);\n  normalize(a);\n  y = a.x;\n}";
    let program = traced(text);
    let unused: Vec<u32> = program.sites().iter().filter(|site| !site.is_used).map(|site| site.line).collect();
    assert_eq!(unused, [6]);
}

#[test]
fn a_trace_that_is_too_long_is_none() {
    let text = "#version 460\nin float x;\nout float y;\nvoid main() {\n  y = x;\n  for (int i = 0; i < 200000; i++) y += 1.0;\n}";
    let program = traced(text);
    let mut prepared = program.prepared(1, &[], 1 << 30);
    prepared.feed("x", &[vec![1.0]]).unwrap();
    assert!(prepared.trace(&[]).expect("it ends").is_none());
    assert!(program.prepared(1, &[], 1_000).trace(&[]).is_err());
}

#[test]
fn each_turn_of_a_loop_has_its_value_and_its_change() {
    let text = "#version 460\nin float x;\nout float y;\nuniform float k[2];\nvoid main() {\n  y = 0.0;\n  for (int i = 0; i < 2; i++) {\n    float a = k[i] * x;\n    y += a;\n  }\n}";
    let program = traced(text);
    let mut prepared = program.prepared(2, &[], FUEL);
    prepared.feed("x", &[vec![1.0, 2.0]]).unwrap();
    prepared.feed("k[0]", &[vec![3.0; 2]]).unwrap();
    prepared.feed("k[1]", &[vec![5.0; 2]]).unwrap();
    let (outputs, trace) = prepared.trace(&[]).unwrap().unwrap();
    assert_eq!(outputs.get("y").unwrap().values, [[8.0, 16.0]]);
    assert_eq!(given(&program, &trace, "a"), [(8, vec![3.0, 6.0]), (8, vec![5.0, 10.0])]);
    let site = trace.events.iter().find(|event| event.values == [[5.0, 10.0]]).unwrap().site;
    let change = ValueChange { site, values: vec![vec![vec![1.0; 2]], vec![vec![2.0; 2]]] };
    assert_eq!(prepared.outputs(&[change]).unwrap().get("y").unwrap().values, [[3.0, 3.0]]);
    let is_bound = |site: &usize| {
        let events = trace.events.iter().filter(|event| event.site == *site);
        program.sites()[*site].what == What::Literal && events.into_iter().any(|event| event.values == [[2.0; 2]])
    };
    let bound = (0..program.sites().len()).find(is_bound).unwrap();
    let mut with =
        |site: usize, number: f64| prepared.outputs(&[ValueChange { site, values: vec![vec![vec![number; 2]]] }]);
    assert_eq!(with(bound, 1.0).unwrap().get("y").unwrap().values, [[3.0, 6.0]]);
    // A counter that never comes to its end does not take the steps of the runs after it.
    let counter = program.sites().iter().position(|site| site.what == What::Read("i".into())).unwrap();
    assert!((0..100).all(|_| with(counter, 0.0).is_err()));
    assert_eq!(with(bound, 1.0).unwrap().get("y").unwrap().values, [[3.0, 6.0]]);
}
