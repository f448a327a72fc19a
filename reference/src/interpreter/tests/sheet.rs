//! Definitions, computed one by one: they are what the whole program computes.

use crate::interpreter::{Draft, Program, Refusal, Sheet, Stage, Texture, Type, constant};

/// Every kind of statement and operation that a definition may come to.
const TEXT: &str = "#version 410
struct Both { float a; vec3 b[2]; };
const float twice = 2.0;
in float x;
uniform vec2 u;
out vec4 result;
float branches(float a) { if (a > 1.0) return a; else if (a < -1.0) { return -a; } return a * a; }
float loops(int n) { float sum = 0.0; for (int i = 0; i < n; ++i) { if (i == 2) continue; if (i == 5) break; sum += float(i); } return sum; }
int cases(int n) { int r = 0; switch (n) { case 0: r = 1; case 1: r += 10; break; default: r = 7; } return r; }
float places(int i, float a) { float all[3]; for (int k = 0; k < 3; k++) all[k] = a * float(k); all[i] += 0.5; return all[i] + all[2]; }
void both(in float a, out Both b, inout float c) { b.a = a; b.b[0] = vec3(a); b.b[1] = vec3(1.0, a, 2.0); c += a; }
float through(float a) { Both b; float c = 1.0; both(a, b, c); return b.a + dot(b.b[1], b.b[0]) + c; }
float until(float a) { int n = 0; do { a *= 2.0; ++n; } while (a < 20.0 && n < 9); return a; }
void main() {
    vec3 v = vec3(x, u);
    vec3 w = v.zyx * 2.0 - v;
    mat3 m = mat3(v, w, vec3(1.0, 0.5, x));
    vec3 mw = m * w;
    vec4 wide = vec4(cross(v, w), dot(v, w)) / 3.0;
    float chosen = x > 0.5 ? wide.x : wide.w;
    float branched = branches(x * twice);
    float looped = loops(int(abs(x) * 4.0));
    int which = cases(int(x));
    uint bits = uint(which) << 3u | 5u;
    float placed = places(int(abs(x)) % 3, x);
    float both = through(x);
    float doubled = until(abs(x) + 0.1);
    mat3 turned = inverse(m + mat3(4.0));
    bool any = isnan(x) || any(lessThan(v, w)) && !(x == 0.0);
    float unary = -x + sqrt(abs(x)) + pow(abs(x) + 0.1, 1.5) + max(x, 0.25) + fract(x);
    vec4 same = vec4(x);
    vec4 end = wide + same * float(bits) + unary;
    result = end;
}";

/// What is undefined for some `x`, and what takes no notice of that.
const UNDEFINED: &str = "in float x; out vec4 r;
float asks(float a) { if (sqrt(a) > 1.0) return 1.0; return 2.0; }
float leaves(float a) { if (a > 0.0) return a; }
float index(int i) { float all[2] = float[2](1.0, 2.0); return all[i]; }
float ends(float a) { while (a > 0.0) ; return a; }
void main() {
    float power = pow(x, 2.0);
    float root = sqrt(x);
    float most = max(root, 0.0);
    float chosen = x > 0.0 ? root : 1.0;
    bool either = x < 0.0 || root > 0.0;
    float asked = asks(x);
    float left = leaves(x);
    float indexed = index(int(x));
    float ended = ends(x);
    vec4 all = vec4(x);
    r = all;
}";

fn draft(text: &str) -> Draft {
    Draft::read(text, Stage::Vertex, &["twice"]).unwrap_or_else(|refusal| panic!("{refusal}"))
}

fn refusal(text: &str) -> Refusal {
    Draft::read(text, Stage::Vertex, &[]).err().expect("a refusal")
}

fn cell(sheet: &Sheet, name: &str) -> usize {
    sheet.cells().iter().position(|cell| cell.name == name).expect(name)
}

/// The numbers of all definitions, by their names.
fn computed(sheet: &Sheet, given: &[(&str, &[f64])]) -> Vec<(String, Vec<f64>)> {
    let mut registers = sheet.registers();
    given.iter().for_each(|(name, values)| sheet.set(cell(sheet, name), values, &mut registers));
    let one = |formula| {
        sheet.compute(formula, &mut registers);
        (sheet.cells()[formula.cell()].name.clone(), sheet.get(formula.cell(), &registers).to_vec())
    };
    sheet.formulas().iter().map(one).collect()
}

#[test]
fn definitions_are_what_the_program_computes() {
    let sheet = draft(TEXT).finish([].into()).expect("a sheet");
    let program = Program::compile(TEXT, Stage::Vertex).expect("valid");
    for x in [-3.25, -1.0, -0.3, 0.0, 0.75, 1.5, 2.0, 7.9] {
        let found = computed(&sheet, &[("x", &[x]), ("u", &[0.5, -2.0])]);
        let names: Vec<&str> = found.iter().map(|(name, _)| name.as_str()).collect();
        let columns: [&[f64]; 1] = [&[x]];
        let run = program.run(1).input("x", &columns).expect("x").uniform("u", &[0.5, -2.0]).expect("u");
        let expected = run.outputs_and_locals(&names).expect("an end");
        assert_eq!(expected.locals.len(), found.len());
        for ((name, found), expected) in found.iter().zip(&expected.locals) {
            assert_eq!(*found, expected.sample(0), "{name} for {x}");
        }
    }
}

#[test]
fn what_is_undefined_is_not_a_number() {
    let sheet = draft(UNDEFINED).finish([].into()).expect("a sheet");
    let program = Program::compile(UNDEFINED, Stage::Vertex).expect("valid");
    let undefined = |x: f64| -> Vec<String> {
        let all = computed(&sheet, &[("x", &[x])]).into_iter();
        all.filter(|(_, numbers)| numbers[0].is_nan()).map(|(name, _)| name).collect()
    };
    assert_eq!(undefined(-4.0), ["power", "root", "most", "asked", "left", "indexed"]);
    assert_eq!(undefined(4.0), ["indexed", "ended"]);
    // The program says so as well.
    let names = ["power", "root", "most", "chosen", "either", "left"];
    let run = program.run(1).input("x", &[&[-4.0]]).expect("x").outputs_and_locals(&names).expect("an end");
    let causes: Vec<bool> = run.locals.iter().map(|local| local.undefined(0, 0).is_some()).collect();
    // One question that is undefined makes all of the program's values so, which a definition by itself does not know.
    assert_eq!(causes, [true; 6]);
}

#[test]
fn what_is_too_large_for_a_float_stays_a_number() {
    let text =
        "in float x; out vec4 r; void main() { float a = pow(x, 80.0); float b = a * x; vec4 c = vec4(b); r = c; }";
    let found = computed(&draft(text).finish([].into()).expect("a sheet"), &[("x", &[20.0])]);
    assert!((found[1].1[0] / 20f64.powi(81) - 1.0).abs() < 1e-12, "{found:?}");
}

#[test]
fn a_formula_says_what_it_uses_and_takes_other_values() {
    let mut draft = draft(TEXT);
    let at = |draft: &Draft, name: &str| draft.cells().iter().position(|cell| cell.name == name).expect(name);
    let (x, twice, branched, wide) = (at(&draft, "x"), at(&draft, "twice"), at(&draft, "branched"), at(&draft, "wide"));
    let other = draft.replacement(branched, "branches(wide.x) * twice * free", Some("free")).expect("valid");
    let free = draft.cells().len() - 1;
    assert_eq!(other.uses(), [twice, wide, free]);
    let sheet = draft.finish([].into()).expect("a sheet");
    let known = sheet.formulas().iter().find(|formula| formula.cell() == branched).expect("a definition");
    assert_eq!(known.uses(), [twice, x]);
    let mut registers = sheet.registers();
    sheet.set(twice, &[3.0], &mut registers);
    sheet.set(wide, &[5.0, 0.0, 0.0, 0.0], &mut registers);
    sheet.set(free, &[0.5], &mut registers);
    sheet.compute(&other, &mut registers);
    assert_eq!(sheet.get(branched, &registers), [7.5]);
}

#[test]
fn what_is_no_list_of_definitions_is_refused_with_its_line() {
    let main = |body: &str| {
        refusal(&format!(
            "in float x; out float y;\nfloat f(inout float a) {{ return a++; }}\nvoid main() {{\n{body}\n}}"
        ))
    };
    for (body, what) in [
        ("for (;;) ;", "put this into a function"),
        ("float a;", "`a` has no value"),
        ("float a = x; a = 2.0;", "`a` has a value already"),
        ("float a = x; float b = (a = 2.0);", "this changes `a`"),
        ("float a = x; float b = f(a);", "this changes `a`"),
        ("float a = x, a = 1.0;", "`a` is the name of something else"),
        ("float x = 1.0;", "`x` is the name of something else"),
        ("float a = float(gl_VertexID);", "does not know `gl_VertexID`"),
        ("y = x; y = x;", "`y` has a value already"),
        ("y = vec2(x);", "vec2"),
        ("float a = texture(s, vec2(0.0)).x;", "there is no variable `s`"),
    ] {
        let refusal = main(body);
        assert!(refusal.line == 4 && refusal.what().en.contains(what), "{body}: {refusal}");
    }
    assert_eq!(refusal("float a() { return 1.0; }").line, 0);
    let circle = "float a(); float b() { return a(); } float a() { return b(); } void main() { float c = a(); }";
    assert!(refusal(circle).what().en.contains("calls itself"));
}

#[test]
fn an_output_that_is_given_an_expression_is_a_definition() {
    let text = "in float x; out float y, z; void main() { y = 2.0 * x; float a = y + 1.0; z = a; }";
    let sheet = Draft::read(text, Stage::Vertex, &[]).expect("definitions").finish([].into()).expect("a sheet");
    let found = computed(&sheet, &[("x", &[3.0])]);
    assert_eq!(found, [("y".into(), vec![6.0]), ("a".into(), vec![7.0])]);
}

#[test]
fn a_definition_reads_textures() {
    let text = "uniform sampler2D s; in vec2 at; out vec4 c; void main() { c = 2.0 * texture(s, at); }";
    let texture = Texture::two_dimensional(2, 1, vec![[1.0, 2.0, 3.0, 4.0], [5.0; 4]]);
    let sheet = Draft::read(text, Stage::Fragment, &[]).expect("definitions").finish([texture].into());
    let sheet = sheet.expect("a sheet");
    // The centre of the left texel is at 1/4; a number that is none reads none.
    let found = |u: f64| computed(&sheet, &[("s", &[0.0]), ("at", &[u, 0.5])]).remove(0).1;
    assert_eq!(found(0.25), [2.0, 4.0, 6.0, 8.0]);
    assert!(found(f64::NAN).iter().all(|number| number.is_nan()));
}

#[test]
fn constants_that_stand_by_themselves_have_values() {
    assert_eq!(constant("vec4(vec3(0.2), 40 / 80)", &Type::VEC4).expect("valid"), [0.2, 0.2, 0.2, 0.0]);
    assert_eq!(constant("80", &Type::FLOAT).expect("valid"), [80.0]);
    for text in ["a", "vec3(1.0)", "1.0; 2.0", "pow(-1.0, 2.0)", ""] {
        assert!(constant(text, &Type::FLOAT).is_err(), "{text}");
    }
}
