//! A complete vertex shader for the equation or any hypothesis about it, to be run on real drivers.

use crate::assignment::{Assignment, Stage};
use crate::expression::Value;
use crate::mistake::Found;
use std::fmt::Write;

/// The vertex shader that computes the equation with these mistakes in it: interface and constants as handed out, then one
/// statement for each definition. `None` if a mistake is not known or has no such form.
pub fn answer(assignment: &Assignment, mistakes: &[Found]) -> Option<String> {
    let variant = assignment.variant(mistakes)?;
    let mut text = preamble(assignment);
    let mut names: Vec<_> = mistakes
        .iter()
        .filter(|found| found.parameter.is_some())
        .filter_map(|found| Some(assignment.mistake(&found.id)?.fit.as_ref()?.name.as_str()))
        .collect();
    names.dedup();
    line(&mut text, "void main()");
    line(&mut text, "{");
    names.iter().for_each(|name| line(&mut text, &format!("    float {name};")));
    let definitions = assignment.equation.definitions();
    let values = variant.expressions().iter().zip(variant.parameters());
    for (definition, (expression, parameter)) in definitions.iter().zip(values) {
        if !parameter.is_nan() {
            names.iter().for_each(|name| line(&mut text, &format!("    {name} = {};", number(*parameter))));
        }
        let kind = expression.kind().glsl();
        let (name, value) = (&definition.name, expression.text());
        line(&mut text, &format!("    {kind} {name} = {value};"));
    }
    for output in &assignment.interface.outputs {
        line(&mut text, &format!("    {} = {};", output.name, output.carries));
    }
    let position = crate::equation::POSITION;
    line(&mut text, &format!("    gl_Position = {position};"));
    line(&mut text, "}");
    Some(text)
}

/// Version, constants and interface.
fn preamble(assignment: &Assignment) -> String {
    let vertex = assignment.files.iter().find(|f| f.stage == Stage::Vertex);
    let version = vertex.and_then(|f| f.starter.lines().find(|l| l.starts_with("#version")));
    let mut text = String::new();
    line(&mut text, version.unwrap_or("#version 410 core"));
    for c in &assignment.constants {
        let kind = c.kind.glsl();
        line(&mut text, &format!("const {kind} {} = {};", c.name, literal(&c.value)));
    }
    for i in &assignment.interface.inputs {
        line(&mut text, &format!("in {} {};", i.kind.glsl(), i.name));
    }
    for u in &assignment.interface.uniforms {
        line(&mut text, &format!("uniform {} {};", u.kind.glsl(), u.name));
    }
    for o in &assignment.interface.outputs {
        line(&mut text, &format!("out {} {};", o.kind.glsl(), o.name));
    }
    text
}

fn line(text: &mut String, content: &str) {
    // Writing to a String cannot fail.
    let _ = writeln!(text, "{content}");
}

fn literal(value: &Value) -> String {
    let numbers: Vec<String> = value.numbers().into_iter().map(number).collect();
    match value {
        Value::Float(_) => numbers.join(""),
        _ => format!("{}({})", value.kind().glsl(), numbers.join(", ")),
    }
}

/// A float literal: always with a point or an exponent.
fn number(x: f64) -> String {
    format!("{x:?}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assignment;

    #[test]
    fn a_right_answer_is_the_interface_and_one_statement_for_each_definition() {
        let assignment = assignment("ggsample06").expect("built in");
        let text = answer(assignment, &[]).expect("no mistakes");
        assert!(text.starts_with("#version 410 core\nconst vec4 pl = vec4(0.0, 0.0, 1.0, 0.0);\n"));
        assert!(text.contains("const float kshi = 80.0;\n"));
        assert!(text.contains("in vec4 cv;\nuniform mat4 mw;\n"));
        assert!(text.contains("    float lambert = max(nl, 0.0);\n"));
        assert!(text.ends_with("    vc = colour;\n    gl_Position = position;\n}\n"));
    }

    #[test]
    fn a_mistake_stands_in_its_statement_and_its_parameter_before() {
        let assignment = assignment("ggsample06").expect("built in");
        let found = Found { id: "specular-wrong-exponent".into(), form: 0, parameter: Some(20.0) };
        let text = answer(assignment, &[found]).expect("a known mistake");
        assert!(text.contains("void main()\n{\n    float x;\n"));
        assert!(text.contains("    x = 20.0;\n    float highlight = pow(facing, x);\n"));
    }

    #[test]
    fn an_unknown_mistake_has_no_shader() {
        let assignment = assignment("ggsample06").expect("built in");
        let found = Found { id: "no-such-mistake".into(), form: 0, parameter: None };
        assert_eq!(answer(assignment, &[found]), None);
    }
}
