//! What the linker refuses, and what it should.

use super::{HintCase, RIGHT, broken, check, diagnostics, diagnostics_of, interface};
use crate::diagnostic::DiagnosticStage;
use crate::translate::{LinkedInterface, Variable};

const CASES: &[HintCase] = &[
    ("out vec4 colour", "vec4 §colour", "not declared as an output", "出力変数 (`out`)"),
    ("void main", "void §Main", "no function `main`|`Main`", "`main`|`Main`"),
    ("  return normalize(a.xyz);", "  return §unit(a);", "`unit` calls itself here|recursion", "再帰"),
    (
        "vec3 unit(vec4 a)\n{",
        "vec3 unit(vec3 a) { return a; }\nvec3 unit(vec4 a)\n{\n  vec3 b = §unit(a);",
        "calls itself|recursion",
        "再帰",
    ),
    ("out vec4 colour", "flat out vec4 §colour", "`flat`", "`flat`"),
    ("out vec4 colour;", "out Data { vec4 §colour; };", "no output `colour`", "出力変数 `colour` がありません"),
    ("a.xyz", "a.§xyz2", "`2`", "`2`"),
    ("#version 410 core", "§#version 300 es", "OpenGL ES", "OpenGL ES"),
];

#[test]
fn points_at_the_declaration() {
    for case in CASES {
        check(case);
    }
}

#[test]
fn an_output_of_another_name_is_found() {
    for name in ["color", "Colour", "vertexColour", "vc"] {
        let all = diagnostics(&RIGHT.replace("colour", name));
        assert_eq!((all[0].stage, all[0].line, all[0].column), (DiagnosticStage::Link, Some(12), Some(10)), "{name}");
        let hint = all[0].hint.as_ref().map(|hint| hint.en.clone()).unwrap_or_default();
        assert!(all[0].message.en.contains(&format!("`{name}`")) && hint.contains("out vec4 colour;"), "{hint}");
    }
}

#[test]
fn an_output_of_another_type_is_found() {
    for (declaration, ty, value) in [("out vec3 colour", "vec3", ".xyz"), ("out vec4 colour[1]", "vec4[]", "")] {
        let (text, _) = broken("out vec4 colour", declaration);
        let text = match value {
            "" => text.replace("  colour =", "  colour[0] ="),
            part => text.replace("lightAmbient + pow(cosine, shine)", &format!("lightAmbient{part}")),
        };
        let all = diagnostics(&text);
        assert_eq!((all[0].stage, all[0].line), (DiagnosticStage::Link, Some(12)), "{ty}");
        assert!(all[0].message.en.contains(ty), "{}", all[0].message.en);
    }
}

#[test]
fn each_output_is_held_against_the_input_of_its_name() {
    let two = LinkedInterface {
        outputs: ["colour", "foam"].map(|name| Variable { name: name.into(), ty: "vec4".into() }).to_vec(),
        fragment: c"#version 410 core\nin vec4 colour, foam;\nout vec4 c;\nvoid main() { c = colour + foam; }\n"
            .to_owned(),
        ..interface()
    };
    let said = |declaration: &str, value: &str| {
        let text = RIGHT.replace("out vec4 colour;", &format!("out vec4 colour;\n{declaration}"));
        let text = text.replace("  colour =", &format!("  {value}\n  colour ="));
        let first = diagnostics_of(&text, &two).into_iter().next().map(|first| (first.line, first.message.en));
        first.unwrap_or_default()
    };
    assert_eq!(said("out vec4 foam;", "foam = vec4(1.0);").0, None);
    for (declaration, value, about) in [
        ("out vec2 foam;", "foam = vec2(1.0);", "has type vec2"),
        ("flat out vec4 foam;", "foam = vec4(1.0);", "differ in `flat`"),
        ("out vec4 foams;", "foams = vec4(1.0);", "reads `foam`, but this output is called `foams`"),
        ("vec4 foam;", "foam = vec4(1.0);", "`foam` is not declared as an output"),
    ] {
        let (line, message) = said(declaration, value);
        assert_eq!(line, Some(13), "{declaration}: {message}");
        assert!(message.contains(about), "{declaration}: {message}");
    }
}

#[test]
fn an_output_that_is_nowhere_is_said_to_be_needed() {
    let (text, _) = broken("out vec4 colour;\n", "");
    let all = diagnostics(&text.replace("  colour = lightAmbient + pow(cosine, shine);\n", ""));
    assert_eq!((all[0].stage, all[0].line), (DiagnosticStage::Link, None));
    assert!(all[0].hint.as_ref().is_some_and(|hint| hint.ja.contains("out vec4 colour;")));
}

#[test]
fn a_function_without_a_body_is_found_where_it_is_declared() {
    let (text, place) = broken("vec3 unit(", "float §later(float x);\nvec3 unit(");
    let all = diagnostics(&text.replace("max(dot(n, h), 0.0)", "later(0.0)"));
    assert_eq!(all[0].line.zip(all[0].column), place);
    assert!(all[0].message.en.contains("no body"));
}

#[test]
fn what_is_valid_is_not_refused_here() {
    for (from, to) in [
        ("out vec4 colour", "smooth out vec4 colour"),
        ("#version 410 core", "#version 330"),
        ("vec3 unit(", "struct S { vec4 b2; };\nvec3 unit("),
        ("  // 合計", "  cosine *= gl_DepthRange.far;"),
        ("vec3 unit(", "#define FIRST xyz\nvec3 unit("),
    ] {
        let (text, _) = broken(from, to);
        let text = text
            .replace("normalize(a.xyz)", if to.contains("FIRST") { "normalize(a.FIRST)" } else { "normalize(a.rgb)" });
        assert_eq!(diagnostics(&text), [], "{to:?}");
    }
}
