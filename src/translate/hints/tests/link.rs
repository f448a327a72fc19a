//! What the linker refuses, and what it should.

use super::{HintCase, RIGHT, broken, check, diagnostics};
use crate::diagnostic::DiagnosticStage;

const CASES: &[HintCase] = &[
    ("out vec4 colour", "vec4 §colour", "not declared as an output", "出力変数 (`out`)"),
    ("void main", "void §Main", "no function `main`|`Main`", "`main`|`Main`"),
    ("  return normalize(a.xyz);", "  return §unit(a);", "calls itself|recursion", "再帰"),
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
