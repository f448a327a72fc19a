//! Valid shaders that take more than the two passes, and what only drivers refuse.

use super::{HomeworkProgram, LinkedInterface, Stage, Translation, TranslationRefusal, translate};
use crate::diagnostic::Severity;
use crate::source;

fn interface() -> LinkedInterface {
    LinkedInterface::of(reference::assignment("ggsample06").expect("it is built in")).expect("it is whole")
}

/// Translates a right shader at this version, with these globals, from line 5 on, and this body.
fn run(version: &str, globals: &str, body: &str) -> Result<Translation, TranslationRefusal> {
    let text = format!(
        "#version {version}\nin vec4 pv, cv;\nuniform mat4 mw, mc, mg;\nout vec4 vc;\n{globals}\n\
         void main() {{\nvc = mg * cv + mw * pv;\n{body}\ngl_Position = mc * pv;\n}}\n"
    );
    let source = source::read("a.vert", text.as_bytes()).expect("a text");
    translate(&source, &interface())
}

/// The places of the warnings of a shader that must be accepted.
fn warnings(version: &str, globals: &str, body: &str) -> Vec<(Option<u32>, Option<u32>)> {
    let translation = run(version, globals, body).unwrap_or_else(|refusal| panic!("{globals}{body}: {refusal:?}"));
    let warnings = translation.diagnostics.iter().filter(|d| d.severity == Severity::Warning);
    warnings.map(|warning| (warning.line, warning.column)).collect()
}

/// The places of the errors of a shader that must be rejected.
fn errors(version: &str, globals: &str, body: &str) -> Vec<(Option<u32>, Option<u32>)> {
    match run(version, globals, body) {
        Err(TranslationRefusal::Rejected(diagnostics)) => diagnostics.iter().map(|d| (d.line, d.column)).collect(),
        other => panic!("{globals}{body}: {:?}", other.map(|_| "accepted")),
    }
}

#[test]
fn stray_semicolons_are_warned_of_where_they_stand() {
    let expected = [(Some(5), Some(1)), (Some(5), Some(25))];
    assert_eq!(warnings("410", "; struct S { float a; };;", ""), expected);
    assert_eq!(warnings("460", ";", ""), []);
}

#[test]
fn a_continued_line_is_warned_of_before_4_20() {
    assert_eq!(warnings("410", "#define ONE \\\n 1.0", "vc *= ONE;"), [(Some(5), Some(13))]);
    assert_eq!(warnings("420", "#define ONE \\\n 1.0", "vc *= ONE;"), []);
}

#[test]
fn several_concessions_go_together() {
    let globals = ";\n#define ONE \\\n 1.0\nfloat shared = ONE;\nstruct S { float length; };";
    let places = warnings("410", globals, "S s; s.length = shared; vc *= s.length;");
    assert!(places.contains(&(Some(5), Some(1))) && places.contains(&(Some(6), Some(13))), "{places:?}");
}

#[test]
fn names_that_are_taken_later_are_no_errors() {
    assert_eq!(warnings("410", "float shared = 1.0, buffer = 1.0;", "vc *= shared * buffer;"), []);
    assert_eq!(warnings("410", "struct S { float length; };", "S s; s.length = length(pv); vc *= s.length;"), []);
    errors("430", "float shared = 1.0;", "");
}

#[test]
fn a_mistake_beside_a_concession_stays_one() {
    assert_eq!(errors("410", ";", "vc = nothing;"), [(Some(8), Some(6))]);
}

#[test]
fn own_functions_may_be_called_as_built_in_ones() {
    let globals = "float max(float a, float b) { return a > b ? a : b; }\nvec3 normalize(vec3 a) { return a; }";
    assert_eq!(warnings("410", globals, "vc *= max(vc.x, 0) * normalize(pv.xyz).x;"), []);
}

#[test]
fn what_the_compiler_lacks_is_our_fault() {
    let subroutine =
        "subroutine float F(float a);\nsubroutine(F) float f(float a) { return a; }\nsubroutine uniform F g;";
    assert!(matches!(run("410", subroutine, "vc *= g(1.0);"), Err(TranslationRefusal::Fault(_))));
    let shadow = "uniform sampler2DShadow t;";
    let with_a_bias = "vc *= shadow2D(t, pv.xyz) + shadow2D(t, pv.xyz, 1.0);";
    assert!(matches!(run("410", shadow, with_a_bias), Err(TranslationRefusal::Fault(_))));
    // The student's own function of that name is none of the compiler's.
    assert_eq!(warnings("410", "vec4 texture2D(vec2 a) { return a.xyxy; }", "vc *= texture2D(pv.xy);"), []);
}

#[test]
fn a_lookup_of_old_glsl_is_taken_as_drivers_take_it() {
    let lookup = "vc *= texture2D(t, pv.xy);";
    assert!(warnings("410", "uniform sampler2D t;", lookup).contains(&(Some(8), Some(7))));
    assert_eq!(errors("420", "uniform sampler2D t;", lookup), [(Some(8), Some(7))]);
    // One that compares gives a vector, unlike that of today.
    let compared = "vc *= shadow2DProj(t, vec4(pv.xy, max(pv.z, 0.0), pv.w)).r;";
    assert!(warnings("410", "uniform sampler2DShadow t;", compared).contains(&(Some(8), Some(7))));
    assert_eq!(errors("420", "uniform sampler2DShadow t;", compared), [(Some(8), Some(7))]);
}

#[test]
fn what_drivers_surely_refuse_is_refused() {
    assert_eq!(errors("410", "layout(location = 1, location = 2) in vec4 a;", ""), [(Some(5), Some(22))]);
    assert_eq!(errors("410", "layout(location = 1) layout(location = 2) in vec4 a;", ""), [(Some(5), Some(29))]);
    assert_eq!(errors("410", "precise float f() { return 1.0; }", ""), [(Some(5), Some(1))]);
    assert_eq!(warnings("420", "layout(location = 1, location = 2) in vec4 a;", ""), []);
    assert_eq!(warnings("410", "layout(location = 1) in vec4 a; precise float b;", ""), []);
}

/// The places of the warnings of a whole text.
fn warnings_of(text: &str) -> Vec<(Option<u32>, Option<u32>)> {
    let source = source::read("a.vert", text.as_bytes()).expect("a text");
    let translation = translate(&source, &interface()).unwrap_or_else(|refusal| panic!("{text}: {refusal:?}"));
    translation.diagnostics.iter().map(|warning| (warning.line, warning.column)).collect()
}

#[test]
fn what_some_drivers_refuse_is_warned_of() {
    let rest = "in vec4 pv;\nvoid main() { vc = pv; gl_Position = pv; }\n";
    let at = |first: &str| warnings_of(&format!("{first}\n{rest}"));
    assert_eq!(at("#version 410\nout vec4 vc;"), []);
    assert_eq!(at("#version 410\nsmooth out vec4 vc;"), [(Some(2), Some(1))]);
    assert_eq!(at("#version 440\nsmooth out vec4 vc;"), []);
    assert_eq!(at("#version 410\nout vec4 vc; invariant vc;"), [(Some(2), Some(14))]);
    assert_eq!(at("#version 410\nlayout(location = 2) out vec4 vc;"), [(Some(2), Some(8))]);
    assert_eq!(at("#version 410\n#pragma STDGL invariant(all)\nout vec4 vc;"), [(Some(2), Some(15))]);
    assert_eq!(at("#version 130\nout vec4 vc;"), [(Some(1), Some(10))]);
    assert_eq!(at("#version 150\nout vec4 vc;"), []);
    assert_eq!(at("#version 410 compatibility\nout vec4 vc;"), [(Some(1), Some(14))]);
    assert_eq!(at("#version 410\nout vec4 vc;\n#extension GL_ARB_gpu_shader5 : enable"), [(Some(3), Some(12))]);
}

/// Translates a right shader that the program sets these uniforms for as well.
fn with_uniforms(set: &[(&str, &str)], globals: &str, body: &str) -> Result<Translation, TranslationRefusal> {
    let text = format!(
        "#version 410\nin vec4 pv, cv;\nuniform mat4 mw, mc, mg;\nout vec4 vc;\n{globals}\n\
         void main() {{\nvc = mg * cv + mw * pv;\n{body}\ngl_Position = mc * pv;\n}}\n"
    );
    let mut interface = interface();
    let variable = |(name, ty): &(&str, &str)| super::Variable { name: (*name).into(), ty: (*ty).into() };
    interface.uniforms.extend(set.iter().map(variable));
    translate(&source::read("a.vert", text.as_bytes()).expect("a text"), &interface)
}

#[test]
fn parts_of_uniforms_are_held_against_what_the_program_sets() {
    let light = "struct L { vec3 at; bool on[2]; float far; };\nuniform L l[2];\nuniform K { vec4 ambient; };";
    let body = "if (l[1].on[0]) vc.xyz += l[0].at * l[1].far + ambient.xyz;";
    let set =
        [("l[0].at", "vec3"), ("l[1].on[0]", "bool"), ("l[1].far", "float"), ("K.ambient", "vec4"), ("gone", "int")];
    let translation = with_uniforms(&set, light, body).expect("all is as the program sets it");
    let members: Vec<_> = translation.shader.uniforms.iter().flat_map(|block| &block.members).collect();
    let offset = |path: &str| members.iter().find(|member| member.paths().any(|own| own == path)).map(|one| one.offset);
    // By std140: three floats, from 16 on two integers 16 bytes apart, a float at 48; 64 bytes in all.
    let first = offset("l[0].at").expect("a member");
    assert_eq!(offset("l[0].on[1]").map(|at| at - first), Some(32));
    assert_eq!(offset("l[1].far").map(|at| at - first), Some(64 + 48));
    assert_eq!((offset("K.ambient"), offset("ambient")), (Some(0), Some(0)));

    let place = |set: &[(&str, &str)]| match with_uniforms(set, light, body) {
        Err(TranslationRefusal::Rejected(diagnostics)) => (diagnostics[0].line, diagnostics[0].message.en.clone()),
        other => panic!("{:?}", other.map(|_| "accepted")),
    };
    let (line, message) = place(&[("l[0].at", "vec4")]);
    assert_eq!(line, Some(5));
    assert_eq!(message, "`l[0].at` is declared as `vec3`, but the program passes a `vec4`");
    assert_eq!(place(&[("l", "float")]).0, Some(6));
    assert_eq!(
        place(&[("ambient.x", "float")]).1,
        "`ambient` is declared as `vec4`, but the program passes a `struct`"
    );
}

#[test]
fn what_is_declared_with_another_name_or_type_is_told_once() {
    let sun = "struct S { vec3 dir; };\nuniform S sun;";
    let told = with_uniforms(&[("sun.direction", "vec3")], sun, "vc.xyz += sun.dir;").expect("it runs");
    let messages: Vec<&str> = told.diagnostics.iter().map(|one| one.message.en.as_str()).collect();
    assert!(messages.iter().any(|message| message.contains("never sets the uniform `sun.dir`")), "{messages:?}");
    // Both elements of an array have the type that is declared once.
    let lamps = "struct L { int far; };\nuniform L l[2];";
    let set = [("l[0].far", "float"), ("l[1].far", "float")];
    let refused = with_uniforms(&set, lamps, "vc.x += float(l[0].far + l[1].far);").map(|_| "accepted");
    let Err(TranslationRefusal::Rejected(errors)) = refused else { panic!("it is refused") };
    assert_eq!(errors.iter().map(|error| error.line).collect::<Vec<_>>(), [Some(5)]);
}

/// The program of a homework with this fixed vertex shader, or one of which both stages are handed in.
fn program(vertex: Option<&str>) -> HomeworkProgram {
    let mut interface = interface();
    interface.fragment = c"".to_owned();
    HomeworkProgram::new(interface, vertex.map(|text| (Stage::Vertex, text))).expect("the fixed stage is right")
}

/// Line and message of the first error of these stages; `None` where they are taken.
fn refused(program: &HomeworkProgram, texts: &[(Stage, &str)]) -> Option<(Stage, Option<u32>, String)> {
    let read = |(stage, text): &(Stage, &str)| source::read_stage(*stage, "a", text.as_bytes()).expect("a text");
    let sources: Vec<_> = texts.iter().map(read).collect();
    let stages: Vec<_> = texts.iter().zip(&sources).map(|((stage, _), source)| (*stage, source)).collect();
    let refused = program.translate(&stages).err()?;
    match refused.refusal {
        TranslationRefusal::Rejected(diagnostics) => {
            Some((refused.stage, diagnostics[0].line, diagnostics[0].message.en.clone()))
        }
        other => panic!("{other:?}"),
    }
}

const FIXED: &str = "#version 330\nin vec4 pv;\nuniform mat4 mc;\nout vec3 n;\nflat out int k;\n\
    void main() { n = pv.xyz; k = 1; gl_Position = mc * pv; }\n";

#[test]
fn a_fragment_stage_takes_what_the_vertex_stage_hands_over() {
    let program = program(Some(FIXED));
    let refused = |version: &str, input: &str, body: &str| {
        let text = format!("#version {version}\n{input}\nout vec4 c;\nvoid main() {{ c = {body}; }}\n");
        refused(&program, &[(Stage::Fragment, &text)])
    };
    assert_eq!(refused("330", "in vec3 n;", "vec4(n, 1.0)"), None);
    assert_eq!(refused("330", "flat in int k;", "vec4(float(k))"), None);
    // What is declared and not read needs nobody who writes it.
    assert_eq!(refused("330", "in vec3 other;", "vec4(1.0)"), None);
    let missing = refused("330", "in vec3 other;", "vec4(other, 1.0)").expect("nobody writes it");
    assert_eq!((missing.0, missing.1), (Stage::Fragment, Some(2)), "{missing:?}");
    let wider = refused("330", "in vec4 n;", "n").expect("it is a vec3");
    assert_eq!((wider.1, &*wider.2), (Some(2), "`n` has type vec4 here, but the vertex shader writes vec3."));
    for version in ["330", "410"] {
        let differs = refused(version, "flat in vec3 n;", "vec4(n, 1.0)").expect("a qualifier that the other has not");
        assert_eq!(differs.1, Some(2), "{differs:?}");
        assert!(refused(version, "noperspective in vec3 n;", "vec4(n, 1.0)").is_some());
        // As Mesa links the two.
        assert_eq!(refused(version, "centroid in vec3 n;", "vec4(n, 1.0)"), None);
    }
    let each_sample = refused("410", "sample in vec3 n;", "vec4(n, 1.0)").expect("a qualifier that the other has not");
    assert!(each_sample.2.starts_with("`n` is `sample` here and `smooth` in the vertex shader;"), "{each_sample:?}");
    assert_eq!(refused("440", "flat in vec3 n;", "vec4(n, 1.0)"), None);
    let broken = refused("330", "in vec3 n;\n", "n + x").expect("an undeclared name");
    assert_eq!((broken.0, broken.1), (Stage::Fragment, Some(5)));
}

#[test]
fn a_word_that_only_one_of_two_stages_has_is_warned_of() {
    let program = program(None);
    let warned = |out: &str, input: &str, version: &str| {
        let vertex = format!(
            "#version {version}\nin vec4 pv;\nuniform mat4 mc;\n{out} vec3 a;\nvoid main() {{ a = pv.xyz; gl_Position = mc * pv; }}\n"
        );
        let fragment =
            format!("#version {version}\n{input} vec3 a;\nout vec4 c;\nvoid main() {{ c = vec4(a, 1.0); }}\n");
        let read = |stage, text: &str| source::read_stage(stage, "a", text.as_bytes()).expect("a text");
        let (vertex, fragment) = (read(Stage::Vertex, &vertex), read(Stage::Fragment, &fragment));
        let linked =
            program.translate(&[(Stage::Vertex, &vertex), (Stage::Fragment, &fragment)]).expect("both are right");
        linked.diagnostics.iter().map(|(stage, warning)| (*stage, warning.line)).collect::<Vec<_>>()
    };
    assert_eq!(warned("out", "smooth in", "430"), [(Stage::Fragment, Some(2))]);
    assert_eq!(warned("smooth out", "in", "430"), [(Stage::Vertex, Some(4))]);
    assert_eq!(warned("smooth out", "smooth in", "430"), []);
    assert_eq!(warned("out", "in", "430"), []);
    assert_eq!(warned("out", "smooth in", "440"), []);
}

#[test]
fn between_two_stages_that_are_handed_in_the_names_are_free() {
    let program = program(None);
    let vertex = "#version 410\nin vec4 pv;\nuniform mat4 mc;\nout Own { vec3 a; mat3 b; } own;\nout float unread;\n\
        void main() { own.a = pv.xyz; own.b = mat3(mc); unread = 1.0; gl_Position = mc * pv; }\n";
    let fragment = "#version 410\nin Own { vec3 a; mat3 b; } mine;\nuniform mat4 mw;\nout vec4 c;\n\
        void main() { c = mw * vec4(mine.b * mine.a, 1.0); }\n";
    assert_eq!(refused(&program, &[(Stage::Vertex, vertex), (Stage::Fragment, fragment)]), None);
    let broken = vertex.replace("own.a = pv.xyz", "own.a = pw.xyz");
    let first = refused(&program, &[(Stage::Vertex, &broken), (Stage::Fragment, fragment)]).expect("a wrong name");
    assert_eq!((first.0, first.1), (Stage::Vertex, Some(6)));
    let other = fragment
        .replace("uniform mat4 mw", "uniform mat3 mw")
        .replace("mw * vec4(mine.b * mine.a, 1.0)", "vec4(mw * mine.b * mine.a, 1.0)");
    let wrong = refused(&program, &[(Stage::Vertex, vertex), (Stage::Fragment, &other)]).expect("another type");
    assert_eq!((wrong.0, wrong.1), (Stage::Fragment, Some(3)));
}
