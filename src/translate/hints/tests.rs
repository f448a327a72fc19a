//! Broken shaders through the real compiler: where the first diagnostic points, and what it says.

mod compile;
mod link;
mod robustness;

use crate::diagnostic::Diagnostic;
use crate::ffi::glslang::{self, CompilerOutput, GlslangRequest, GlslangRules, Stage, StageText};
use crate::translate::hints::overlooked_errors;
use crate::translate::log::{link_diagnostics, stage_diagnostics};
use crate::translate::{LinkedInterface, Variable};
use std::ffi::CString;

/// A right shader for an assignment of its own.
const RIGHT: &str = "#version 410 core

// 光源
const vec4 lightPosition = vec4(0.0, 0.0, 1.0, 0.0);    // 位置
const vec4 lightAmbient = vec4(0.2, 0.2, 0.2, 1.0);     // 環境光
const float shine = 80.0;

in vec4 position;                                       // 頂点の位置
in vec4 nv;                                             // 法線
uniform mat4 mv;
uniform mat4 mvp;
out vec4 colour;

vec3 unit(vec4 a)
{
  return normalize(a.xyz);
}

void main()
{
  vec4 p = mv * position;                               /* 視点座標系 */
  vec3 v = -normalize(p.xyz / p.w);
  vec3 n = unit(mv * nv);
  vec3 h = normalize(lightPosition.xyz + v);
  float cosine = max(dot(n, h), 0.0);
  // 合計
  colour = lightAmbient + pow(cosine, shine);
  gl_Position = mvp * position;
}
";

/// The interface of that assignment: its names are those of no real one.
pub fn interface() -> LinkedInterface {
    let variable = |name: &str, ty: &str| Variable { name: name.to_owned(), ty: ty.to_owned() };
    LinkedInterface {
        stage: Stage::Vertex,
        inputs: vec![variable("position", "vec4"), variable("nv", "vec4")],
        attributes: Vec::new(),
        uniforms: vec![variable("mv", "mat4"), variable("mvp", "mat4")],
        outputs: vec![variable("colour", "vec4")],
        constants: ["lightPosition", "lightAmbient", "shine"].map(str::to_owned).to_vec(),
        functions: ["unit", "halfway"].map(str::to_owned).to_vec(),
        placed: Vec::new(),
        version: "#version 410 core".to_owned(),
        alike: None,
        fragment: c"#version 410 core\nin vec4 colour;\nout vec4 c;\nvoid main() { c = colour; }\n".to_owned(),
    }
}

fn outcome(text: &str, interface: &LinkedInterface) -> CompilerOutput {
    let vertex = CString::new(text).expect("no test has a NUL");
    let stages = [StageText::plain(Stage::Vertex, &vertex), StageText::plain(Stage::Fragment, &interface.fragment)];
    glslang::compile(&GlslangRequest { stages: &stages, rules: GlslangRules::OpenGl, emit: Stage::Vertex })
}

/// Everything that is said about `text`.
fn diagnostics(text: &str) -> Vec<Diagnostic> {
    diagnostics_of(text, &interface())
}

fn diagnostics_of(text: &str, interface: &LinkedInterface) -> Vec<Diagnostic> {
    let outcome = outcome(text, interface);
    let mut all = stage_diagnostics(outcome.log(Stage::Vertex), text, None, interface);
    all.extend(link_diagnostics(&outcome.link_log, text, interface));
    all.extend(overlooked_errors(text, interface));
    all
}

/// What to put in place of what in the right shader, `§` in front of the mistake; then words of the English and the
/// Japanese wording.
type HintCase = (&'static str, &'static str, &'static str, &'static str);

/// `RIGHT` with the first `from` replaced, without the mark, and the line and column of the mark.
fn broken(from: &str, to: &str) -> (String, Option<(u32, u32)>) {
    assert!(RIGHT.contains(from), "the right shader has no {from:?}");
    let marked = RIGHT.replacen(from, to, 1);
    let place = marked.find('§').map(|at| {
        let before = &marked[..at];
        let line = before.matches('\n').count() + 1;
        let column = before.rsplit('\n').next().unwrap_or_default().chars().count() + 1;
        (u32::try_from(line).expect("short"), u32::try_from(column).expect("short"))
    });
    (marked.replace('§', ""), place)
}

fn check(&(from, to, en, ja): &HintCase) {
    let (text, place) = broken(from, to);
    let all = diagnostics(&text);
    let first = all.first().unwrap_or_else(|| panic!("{to:?}: nothing is said"));
    let said = first.line.zip(first.column);
    assert_eq!(said, place, "{to:?}: {}", first.message.en);
    let hint = first.hint.clone().unwrap_or_default();
    let (all_en, all_ja) = (format!("{} {}", first.message.en, hint.en), format!("{} {}", first.message.ja, hint.ja));
    for (wording, words) in [(all_en, en), (all_ja, ja)] {
        for word in words.split('|') {
            assert!(wording.contains(word), "{to:?}: {word:?} is not in {wording:?}");
        }
    }
}

#[test]
fn nothing_is_said_about_a_right_shader() {
    assert_eq!(diagnostics(RIGHT), []);
}
