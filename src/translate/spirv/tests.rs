//! What the compiler writes for small shaders, before and after.

use super::code::{SpirvCode, SpirvInstruction};
use super::{How, Reworked, Unworkable, op, op::storage, rework};
use crate::ffi::glslang::{self, GlslangRequest, GlslangRules, Reached, Stage, StageText};
use std::collections::HashSet;
use std::ffi::CString;

/// SPIR-V of a shader whose `main` has this body, below these globals.
fn words(globals: &str, body: &str) -> Vec<u32> {
    let text = format!(
        "#version 450\nuniform mat4 m;\nin vec4 a;\nout vec4 c;\n{globals}\n\
         void main() {{ c = vec4(0.0); gl_Position = m * a;\n{body}\n}}\n"
    );
    let text = CString::new(text).expect("no NUL");
    let stages = [StageText::plain(Stage::Vertex, &text)];
    let outcome =
        glslang::compile(&GlslangRequest { stages: &stages, rules: GlslangRules::SpirV, emit: Stage::Vertex });
    assert_eq!(outcome.reached, Reached::Done, "{}{}", outcome.log(Stage::Vertex), outcome.link_log);
    outcome.spirv
}

/// The reworked shader, which naga must take and find valid.
fn reworked(globals: &str, body: &str) -> (SpirvCode, Reworked) {
    let done = rework(&words(globals, body), How { set: &["m"], ..How::default() }).expect("whole words");
    let options = naga::front::spv::Options { adjust_coordinate_space: false, ..Default::default() };
    let module = naga::front::spv::Frontend::new(done.words.iter().copied(), &options).parse().expect("naga takes it");
    use naga::valid::{Capabilities, ValidationFlags, Validator};
    Validator::new(ValidationFlags::all(), Capabilities::all()).validate(&module).expect("naga finds it valid");
    (SpirvCode::parse(&done.words).expect("whole words"), done)
}

fn count(code: &SpirvCode, opcode: u16) -> usize {
    code.functions.iter().filter(|instruction| instruction.opcode == opcode).count()
}

#[test]
fn code_comes_out_as_it_went_in() {
    let first = words("float f(float x) { return x * 2.0; }", "c.x = f(a.x);");
    let code = SpirvCode::parse(&first).expect("whole words");
    let (again, lines) = code.encode();
    // Only the lines have moved: into the table.
    assert!(!again.windows(4).any(|w| w[0] == 4 << 16 | u32::from(op::LINE)));
    assert_eq!(SpirvCode::parse(&again).expect("whole words").encode().0, again);
    let store = again.iter().rposition(|&word| word == 3 << 16 | u32::from(op::STORE)).expect("a store");
    // The statement of the body stands on line 7 of the text.
    let at = store as u32 * 4;
    assert_eq!(lines.line(naga::Span::new(at, at + 4)), Some(7));
}

#[test]
fn cut_words_are_refused() {
    let whole = words("", "");
    // The first instruction behind the five words of the header is an `OpCapability` of two words.
    assert_eq!(rework(&whole[..6], How::default()).err(), Some(Unworkable::Damaged));
    assert_eq!(rework(&whole[..3], How::default()).err(), Some(Unworkable::Damaged));
}

#[test]
fn every_id_is_defined_once() {
    let body = "int k = 0; switch (int(a.x)) { case 0: k += int(a.y) > 2 && k < 9 ? 1 : 2; case 1: k *= 3; \
                case 2: for (int i = 0; i < 3; i++) { if (i == k) continue; k++; } default: k--; } c.x = float(k);";
    let (code, _) = reworked("", body);
    let mut seen = HashSet::new();
    for (_, id) in code.functions.iter().filter_map(SpirvInstruction::result) {
        assert!(seen.insert(id), "%{id} is defined twice");
    }
    // The loop stands in the case itself and in the copies for the two cases before it.
    assert_eq!(count(&code, op::LOOP_MERGE), 3);
}

#[test]
fn a_case_that_ends_is_not_copied() {
    let body = "switch (int(a.x)) { case 0: c.x = 1.0; break; case 1: case 2: c.y = 1.0; break; default: c.z = 1.0; }";
    let (code, _) = reworked("", body);
    let before = SpirvCode::parse(&words("", body)).expect("whole words");
    assert_eq!(count(&code, op::LABEL), count(&before, op::LABEL));
}

#[test]
fn labels_beside_default_are_left_to_it() {
    let (code, _) = reworked("", "switch (int(a.x)) { case 0: c.x = 1.0; break; case 1: default: c.z = 1.0; }");
    let switch = code.functions.iter().find(|i| i.opcode == op::SWITCH).expect("a switch");
    // Selector, default, and the one label that has a block of its own.
    assert_eq!(switch.operands.len(), 4);
}

#[test]
fn copies_that_explode_are_refused() {
    // Each case runs into all that follow: n cases make n(n + 1)/2 copies of a body, and nesting makes powers of that.
    let cases = |inner: &str| (0..60).map(|k| format!("case {k}: {inner}\n")).collect::<String>();
    let inner = format!("switch (int(a.y)) {{ {} }}", cases("c.x += sin(c.x);"));
    let outer = format!("switch (int(a.x)) {{ {} }}", cases(&inner));
    let Err(Unworkable::Cases(Some(line))) = rework(&words("", &outer), How::default()) else {
        panic!("it is refused")
    };
    // The body begins on line 7 of the text, and an inner switch with its 60 cases has 61 lines.
    assert_eq!((line - 7) % 61, 0, "line {line} begins an inner switch");
}

#[test]
fn a_uniform_that_is_set_is_a_member_and_others_are_private() {
    let globals = "uniform float s = 2.0; uniform bool q; uniform vec3 list[3]; uniform B { vec4 w; mat2 n; } block;";
    let body = "c = vec4(s, list[int(a.x)].y, block.n[1].x, q ? 1.0 : 0.0) + block.w;";
    let (code, done) = reworked(globals, body);
    let classes: Vec<u32> =
        code.globals.iter().filter(|i| i.opcode == op::VARIABLE).map(|variable| variable.operands[2]).collect();
    assert_eq!(classes.iter().filter(|&&class| class == storage::UNIFORM).count(), 1);
    assert_eq!(classes.iter().filter(|&&class| class == storage::PRIVATE).count(), 4);
    let mut unset: Vec<_> = done.uniforms.unset.iter().map(|unset| (unset.name.as_str(), unset.ty)).collect();
    unset.sort_unstable();
    assert_eq!(unset, [("B", "block"), ("list", "array"), ("q", "bool"), ("s", "struct")]);
}

#[test]
fn instructions_that_naga_lacks_are_gone() {
    let body = "uint lo, hi, carry; int e; float w; uint u = uint(a.x); int i = int(a.y);\n\
                umulExtended(u, u, hi, lo); c.x = float(uaddCarry(u, u, carry) + hi + lo + carry); int j, k;\n\
                imulExtended(i, i, j, k); c.y = modf(a.y, w) + frexp(a.z, e) + w + float(e + j + k + i % 3);\n\
                c.z = normalize(a.x) + reflect(a.x, a.y) + refract(a.x, a.y, a.z) + faceforward(a.x, a.y, a.z);\n\
                c.w = outerProduct(a.xy, a.xyz)[2].y + float(bitCount(u) + findLSB(u) + findMSB(u));\n\
                c += unpackHalf2x16(u).xyxy * float(packSnorm4x8(a));";
    let (code, _) = reworked("", body);
    for opcode in [op::I_ADD_CARRY, op::U_MUL_EXTENDED, op::S_MUL_EXTENDED, op::OUTER_PRODUCT, op::S_MOD] {
        assert_eq!(count(&code, opcode), 0, "opcode {opcode}");
    }
}

#[test]
fn textures_are_plain_variables() {
    let globals = "uniform sampler2D t; uniform samplerBuffer b; uniform samplerCube q[2];\n\
                   vec4 read(sampler2D s) { return texture(s, vec2(0.0)) + vec4(textureSize(s, 0), 0, 0); }";
    let (code, _) = reworked(globals, "c = read(t) + texelFetch(b, 1) + texture(q[1], vec3(1.0));");
    assert!(code.functions.iter().all(|i| !(op::SAMPLED_IMAGE..=op::IMAGE_LAST).contains(&i.opcode)));
}

#[test]
fn damaged_words_are_refused() {
    let whole = words("struct S { vec3 v; float a[3]; }; S s;", "s.v = a.xyz; s.a[int(a.x)] = 1.0; c = s.v.xyzz;");
    assert!(rework(&whole, How::default()).is_ok());
    let refused = |words: &[u32]| rework(words, How::default()).err() == Some(Unworkable::Damaged);
    let place = |opcode: u16| {
        let mut at = 5;
        while whole[at] as u16 != opcode {
            at += (whole[at] >> 16) as usize;
        }
        at
    };
    let changed = |at: usize, word: u32| {
        let mut words = whole.clone();
        words[at] = word;
        words
    };
    // A length of one word takes the operands away, and their words are instructions of no known kind.
    assert!(refused(&changed(place(op::TYPE_FLOAT), 1 << 16 | u32::from(op::TYPE_FLOAT))));
    let vector = place(op::TYPE_VECTOR);
    // A vector of vectors of vectors, one of two thousand million, and a structure in itself.
    assert!(refused(&changed(vector + 2, whole[vector + 1])));
    assert!(refused(&changed(vector + 3, 2_000_000_000)));
    let structure = place(op::TYPE_STRUCT);
    assert!(refused(&changed(structure + 2, whole[structure + 1])));
    // The bound of all ids, from which new ones are counted.
    assert!(refused(&changed(3, u32::MAX)));
}
