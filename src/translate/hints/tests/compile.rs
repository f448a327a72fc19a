//! What the compiler refuses.

use super::{HintCase, broken, check, diagnostics};
use crate::diagnostic::Severity;

const TOLD: &[HintCase] = &[
    ("float cosine = ", "§switch (shine) { case 1: break; }\n  float cosine = ", "`int`", "`int`"),
    ("float cosine = ", "switch (1) { case 1: break; §case 1: break; }\n  float cosine = ", "same value", "同じ値"),
    ("float cosine = ", "int two = 2; float list[§two];\n  float cosine = ", "`const int`", "`const int`"),
    ("out vec4 colour;", "uniform Block { vec4 one; } block§\nout vec4 colour;", "A `;` is missing|`block`", "`;`"),
    ("float cosine = ", "§discard;\n  float cosine = ", "another kind of shader", "この種類のシェーダ"),
];

#[test]
fn rules_are_told_in_words() {
    TOLD.iter().for_each(check);
}

const NAMES: &[HintCase] = &[
    ("max(dot", "§Max(dot", "no function `Max`|`max`", "`Max` という関数はありません|`max`"),
    ("max(dot(n, h), 0.0)", "§Max(dot(n, h),\n  0.0)", "`max`", "`max`"),
    ("normalize(light", "§normalise(light", "`normalize`", "`normalize`"),
    ("pow(cosine", "pow(§cosin", "`cosine`|line 25", "`cosine`|25 行目"),
    ("cosine, shine", "cosine, §Shine", "`shine`|line 6", "`shine`|6 行目"),
    ("(mv * nv)", "(mv * §cv)", "attributes|`nv` (vec4, line 9)", "頂点属性|`nv` (vec4、9 行目)"),
    ("(mv * nv)", "(mv * §normal)", "attributes", "頂点属性"),
    ("(mv * nv)", "(mv * vec4(§gl_Normal, 0.0))", "before version 1.40|`nv`", "古い GLSL|`nv`"),
    ("mvp * position;", "§ftransform();", "before version 1.40|`mvp`", "古い GLSL"),
    ("colour = light", "§gl_FragColor = light", "fragment shaders|`colour`", "フラグメントシェーダ|`colour`"),
    ("vec3 h =", "§float3 h =", "HLSL|`vec3`", "HLSL|`vec3`"),
    (
        "normalize(light",
        "§get_unit(light",
        "no function `get_unit`|Did you mean `unit`, declared on line 14",
        "`unit`|14 行目",
    ),
    ("normalize(light", "§unit_of(light", "Did you mean `unit`, declared on line 14", "`unit`|14 行目"),
    ("normalize(light", "§halfway(light", "the function `halfway`. Was it deleted", "関数 `halfway`|消して"),
    ("float cosine = ", "§boolean ok = true;\n  float cosine = ", "`bool`", "`bool`"),
    ("float cosine = ", "§string name;\n  float cosine = ", "no texts", "文字列"),
    ("max(dot(n, h), 0.0)", "§saturate(dot(n, h))", "HLSL|`clamp`", "HLSL|`clamp`"),
    ("mv * position", "§mul(mv, position)", "HLSL", "HLSL"),
    ("float cosine", "§flaot cosine", "`float`", "`float`"),
    ("uniform mat4 mv;", "§unifrom mat4 mv;", "`uniform`", "`uniform`"),
    ("const float", "const §Float", "`float`", "`float`"),
    ("void main", "§viod main", "`void`", "`void`"),
    ("void main", "§main", "void main()", "void main()"),
    ("  vec3 h =", "  §h =", "begins with its type", "型を付けて"),
    ("  vec3 h =", "  §sum of both\n  vec3 h =", "`//`", "`//`"),
    ("normalize(light", "std§::max(light", "namespaces", "名前空間"),
    ("normalize(lightPosition.xyz + v)", "§normalize lightPosition.xyz + v", "parentheses", "括弧"),
    ("float cosine = ", "float §half = ", "keeps for itself", "予約語"),
    ("float cosine = ", "float §sample = ", "word of the language", "キーワード"),
    ("float cosine = ", "float §gl_c = ", "`gl_`", "`gl_`"),
    ("float cosine", "float §v", "twice|line 22", "2 回|22 行目"),
    ("in vec4 nv", "§flat in vec4 nv", "nothing is interpolated|fragment shader", "補間がない|フラグメントシェーダ"),
    ("float cosine", "§continue;\n  float cosine", "only in a loop", "ループの中"),
    ("float cosine", "§break;\n  float cosine", "a loop or a `switch`", "`switch`"),
    ("float cosine", "struct P { float a, b; };\n  P p = §P(1.0);\n  float cosine", "each member", "メンバ"),
    ("float cosine", "§sampler2D map;\n  float cosine", "A texture is no value", "値ではありません"),
];

const SYNTAX: &[HintCase] = &[
    ("shine = 80.0;", "shine = 80.0§", "`;`|after `80.0`|line 8", "`;`|8 行目"),
    ("out vec4 colour;", "out vec4 colour§\n// 光\n", "`;`", "`;`"),
    ("0.0);\n  // 合計", "0.0)§  // 光\n  // 合計", "`;`|`colour` on line 27", "`;`|27 行目"),
    ("mvp * position;", "mvp * position§", "`;`", "`;`"),
    ("+ v);", "+ v)§:", "`:` where a `;`", "`;` を書くところに `:`"),
    ("out vec4 colour;", "out vec4 colour §: SV_Position;", "HLSL", "HLSL"),
    ("max(dot(n, h), 0.0)", "max§(dot(n, h), 0.0", "never closed|`)`", "`)` がありません"),
    ("+ v);", "+ v)§);", "closes nothing", "対応する `(`"),
    ("void main()\n{", "void main()\n§{ if (true) {", "`}` is missing", "`}` がありません"),
    ("  // 合計\n", "  if (cosine > 0.0) §{\n    cosine = 1.0;\n", "never closed", "対応する `}`"),
    ("  // 合計\n", "  cosine = 1.0;\n  §}\n", "closes nothing", "対応する `{`"),
    ("void main()\n{", "void main()§\n", "`{`", "`{`"),
    ("void main()\n{", "void main()§;\n{", "ends the function", "本体"),
    ("0.2, 0.2, 0.2, 1.0", "0.2, 0.2 §0.2, 1.0", "comma", "コンマ"),
    ("lightAmbient + pow", "lightAmbient §pow", "operator is missing", "演算子がありません"),
    ("lightAmbient + pow", "lightAmbient\n  §pow", "operator is missing", "演算子がありません"),
    ("pow(cosine, shine)", "cosine *§* shine", "pow(x, y)", "pow(x, y)"),
    ("float cosine", "float §*cosine", "pointers", "ポインタ"),
    ("  // 合計", "  §/ 合計", "`//`", "`//`"),
    ("  // 合計", "  §*/", "`/*`", "`/*`"),
    ("  // 合計", "  §else { cosine = 1.0; }", "no `if`", "対応する `if`"),
    ("  // 合計", "  for (int i = 0; i < 3, ++i§) cosine += 1.0;", "`for`", "`for`"),
    ("shine = 80.0;", "shine = 80.0§,", "`,` where a `;`", "`;` を書くところに `,`"),
    ("const float shine", "const §shine", "type of `shine`", "`shine` の型"),
    ("unit(vec4 a)", "unit(§a)", "type of `a`", "`a` の型"),
    ("  vec3 h", "  vec3 §twice(vec3 a) { return 2.0 * a; }\n  vec3 h", "inside another function", "関数の中"),
];

const TYPES: &[HintCase] = &[
    ("vec3 h =", "vec4 h §=", "type vec3|type vec4", "vec3|vec4 型"),
    ("colour = light", "colour §= n; colour = light", "vec3|vec4(…, 1.0)", "vec3|vec4(…, 1.0)"),
    ("float cosine = max(dot(n, h), 0.0)", "float cosine §= lightAmbient", "4 components", "4 つの成分"),
    ("float cosine =", "int cosine §=", "`int(…)`", "`int(…)`"),
    ("dot(n, h)", "§dot(n, p)", "(vec3, vec4)|same size", "(vec3, vec4)|同じ成分数"),
    ("pow(cosine", "§pow(p", "(vec4, float)|same type", "(vec4, float)|同じ型"),
    ("unit(mv * nv)", "§unit(v)", "(vec3)|Line 14|unit(vec4 a)", "(vec3)|14 行目"),
    ("lightPosition.xyz + v", "lightPosition §+ v", "vec4 with vec3", "vec4 と vec3"),
    ("unit(mv * nv)", "unit(mv §* v)", "mat4 with vec3", "mat4 と vec3"),
    ("pow(cosine, shine)", "(cosine §^ shine)", "pow(x, y)", "pow(x, y)"),
    ("vec4(0.2, 0.2, 0.2, 1.0)", "§vec4(0.2, 0.2, 1.0)", "4 numbers|3", "4 個|3 個"),
    ("vec4(0.2, 0.2, 0.2, 1.0)", "§vec4(0.2, 0.2, 0.2, 1.0, 1.0)", "5", "5 個"),
    ("p.xyz / p.w", "p.§xyq / p.w", "different sets|`stpq`", "異なる組"),
    ("xyz + v", "xyz + v.§xyw", "does not have", "ない成分"),
    ("pow(cosine", "pow(cosine.§x", "no components", "成分はありません"),
    ("normalize(p.xyz / p.w)", "normalize(p.xyz / p.§shine)", "no components `shine`", "成分はありません"),
    ("p.xyz / p.w", "p.xyz / p.§v", "no components `v`", "成分はありません"),
    ("dot(n, h)", "n.§dot(h)", "dot(a, b)", "dot(a, b)"),
    ("  // 合計", "  if (cosine §= 1.0) cosine = 0.0;", "`==`", "`==`"),
    ("  // 合計", "  if (§cosine) cosine = 0.0;", "type float", "float 型"),
    ("return normalize(a.xyz)", "§return a", "returns vec3|type vec4", "vec3|vec4"),
    ("p.xyz / p.w", "p.xyz / p§[4]", "index 4", "添字 4"),
];

const RULES: &[HintCase] = &[
    ("  // 合計", "  §nv.w = 0.0;", "input of the shader|line 9", "入力変数|9 行目"),
    ("  // 合計", "  §mv = mvp;", "a uniform|line 10", "uniform 変数"),
    ("  // 合計", "  §shine *= 2.0;", "a constant|line 6", "定数"),
    ("  // 合計", "  float whole = §modf(cosine, shine);", "`modf`|variable of your own", "`modf`|書き換えられる変数"),
    ("position;\n}", "position;\n  §return 0;\n}", "no value", "値を返せません"),
    ("void main", "§int main", "`void main()`", "`void main()`"),
    ("shine = 80.0", "shine = §(float) 80", "float(x)", "float(x)"),
    ("  // 合計", "  float a[2] = §{1.0, 2.0};", "float[3](", "float[3]("),
    ("  // 合計", "  §\"光\";", "quotes", "文字列"),
    ("colour = light", "colour = §@light", "`@`", "`@`"),
    ("const float shine = 80.0", "const float §shine", "no value", "値がありません"),
    ("const float shine = 80.0", "uniform float s;\nconst float shine §= s", "compiled", "コンパイル時"),
    ("out vec4 colour", "in vec4 §colour", "`out`|`out vec4 colour;`", "`out`|`out vec4 colour;`"),
];

const DIRECTIVES: &[HintCase] = &[
    ("  // 合計", "§#if\n#endif", "not complete", "書き方が正しくありません"),
    ("#version 410 core\n", "§#version 411 core\n", "no GLSL of this version|#version 410 core", "この番号"),
    ("#version 410 core\n", "§#verson 410 core\n", "`#version`", "`#version`"),
    ("#version 410 core\n", "const int a = 1;\n§#version 410 core\n", "first line", "先頭"),
    ("#version 410 core\n", "§#version 410 cor\n", "`core`", "`core`"),
    ("#version 410 core\n", "§#version 410core\n", "space is missing", "空白"),
    ("#version 410 core\n", "§\n", "no `#version`|1.10", "1.10"),
    ("\n// 光源", "§#include \"light.h\"", "no `#include`", "`#include`"),
    ("  // 合計", "§#if 1", "`#endif`", "`#endif`"),
    ("  // 合計", "§#endif", "no `#if`", "`#if`"),
    ("  // 合計", "  §/* 合計", "never ends", "閉じる `*/`"),
    ("// 光源", "§/* 光源", "hides the code|line 21", "21 行目まで"),
];

#[test]
fn names_that_are_not_there() {
    cases(NAMES);
}

#[test]
fn what_the_parser_stumbles_over() {
    cases(SYNTAX);
}

#[test]
fn types_that_do_not_fit() {
    cases(TYPES);
}

#[test]
fn rules_that_are_broken() {
    cases(RULES);
}

#[test]
fn preprocessor_lines_and_comments() {
    cases(DIRECTIVES);
}

fn cases(all: &[HintCase]) {
    for case in all {
        check(case);
    }
}

#[test]
fn a_macro_that_ends_with_a_semicolon_is_to_blame() {
    let (text, place) = broken("void main()", "#define ZERO 0.0§;\nvoid main()");
    let all = diagnostics(&text.replace("h), 0.0)", "h), ZERO)"));
    assert_eq!(all[0].line.zip(all[0].column), place);
    assert!(all[0].message.en.contains("`ZERO`") && all[0].message.ja.contains("`ZERO`"));
}

#[test]
fn a_function_is_defined_before_it_is_called() {
    let (text, place) = broken("unit(mv * nv)", "§late(mv)");
    let all = diagnostics(&format!("{text}\nvec3 late(mat4 m) {{ return m[0].xyz; }}\n"));
    assert_eq!(all[0].line.zip(all[0].column), place);
    // The right shader has 29 lines; an empty one and the definition follow.
    assert!(all[0].message.en.contains("line 31") && all[0].message.ja.contains("31 行目"), "{}", all[0].message.en);
}

#[test]
fn a_declaration_of_the_interface_that_is_missing_is_asked_for() {
    let (text, _) = broken("in vec4 nv;", "");
    let hint = diagnostics(&text)[0].hint.clone().unwrap_or_default();
    assert!(hint.en.contains("`in vec4 nv;`") && hint.ja.contains("`in vec4 nv;`"), "{hint:?}");
}

#[test]
fn one_mistake_is_told_once() {
    for (from, to) in [
        ("(mv * nv)", "(mv * vec4(gl_Normal, 0.0))"),
        ("vec3 h =", "float3 h ="),
        ("float cosine = ", "float half = "),
        ("vec3 n = unit(mv * nv)", "vec4 n = unit(mv * nv)"),
        ("dot(n, h)", "cross(p, p).xyz"),
        ("dot(n, h)", "dot[n, h]"),
        ("  // 合計", "  cosine = 1.0;\n  }\n"),
    ] {
        let (text, _) = broken(from, to);
        let all = diagnostics(&text);
        assert_eq!(all.len(), 1, "{to:?}: {all:#?}");
    }
}

#[test]
fn two_mistakes_are_told_in_order() {
    let (text, _) = broken("max(dot(n, h), 0.0);", "Max(dot(n, h), 0.0);\n  cosine = kosine;");
    let lines: Vec<_> = diagnostics(&text).iter().map(|one| one.line).collect();
    assert_eq!(lines, [Some(25), Some(26)]);
}

#[test]
fn a_mistake_in_a_macro_is_told_where_it_is_written() {
    let (text, _) = broken("void main()", "#define UP(a) \\\n  maximum(a, 0.0)\nvoid main()");
    let all = diagnostics(&text.replace("max(dot(n, h), 0.0)", "UP(dot(n, h))"));
    // The body stands on the line after that of #define, which is line 19; the use moves from line 25 to 27.
    assert_eq!((all[0].line, all[0].column), (Some(20), Some(3)));
    assert!(all[0].message.en.contains("line 27"), "{}", all[0].message.en);
    assert_eq!(all[1].severity, Severity::Warning, "a continued line is a warning");
}

#[test]
fn a_semicolon_that_ends_nothing_is_a_warning() {
    let (text, place) = broken("a.xyz);\n}", "a.xyz);\n}§;");
    let all = diagnostics(&text);
    assert_eq!((all.len(), all[0].severity, all[0].line.zip(all[0].column)), (1, Severity::Warning, place));
}

/// From where a name is missed on, the compiler takes it for a number.
#[test]
fn what_follows_from_a_missing_name_is_not_said() {
    let (text, _) = broken("  float cosine = ", "  vec3 own = lamp.xyz;\n  float cosine = lamp.w + own.z + ");
    let said: Vec<String> = diagnostics(&text).into_iter().map(|one| one.message.en).collect();
    assert_eq!(said, ["`lamp` is not declared."]);
}

#[test]
fn old_words_that_drivers_still_take_are_warnings() {
    let (text, _) = broken("in vec4 nv;", "attribute vec4 nv;");
    let all = diagnostics(&text);
    assert_eq!(all.len(), 1);
    assert_eq!((all[0].severity, all[0].line, all[0].length), (Severity::Warning, Some(9), 9));
    assert!(all[0].message.en.contains("`in`"));
}
