//! Files that are too big to be kept: nesting, repetition, expansion and size, from harmless to absurd.
//!
//! What is promised follows from the bounds that `docs/security.md` lists, not from what ggrade answers: each size stands
//! far on one side of its bound.

use super::{Hostile, Promise};
use ggrade::diagnostic::DiagnosticStage;
use ggrade::report::Verdict;

/// The largest file that is read, in bytes.
const MAX_BYTES: usize = 65_536;

/// What the answers name.
const NESTED: &str = "nested more than 256 deep";
const CONDITIONS: &str = "nested more than 64 deep (limit of the grader)";
const TOKENS: &str = "expand to more than 100000 tokens";
const OPERATIONS: &str = "operations when all calls and array accesses are written out";
const MEMORY: &str = "memory limit of the grader";
const TURNS: &str = "times: it was stopped";
const SIZE: &str = "at most 64 KiB are read";

/// Every big file.
pub fn files() -> Vec<Hostile> {
    [nested(), repeated(), expanded(), declared(), looped(), sized()].into_iter().flatten().collect()
}

fn right() -> Promise {
    Promise { verdict: Verdict::Correct, stage: None, says: String::new() }
}

fn stopped(says: &str) -> Promise {
    Promise { verdict: Verdict::Stopped, stage: Some(DiagnosticStage::Compile), says: says.into() }
}

fn rejected(stage: DiagnosticStage, says: &str) -> Promise {
    Promise { verdict: Verdict::Rejected, stage: Some(stage), says: says.into() }
}

/// A right answer in which `globals` stands before `main` and `body` at its begin, where `s` is a float that the colour
/// is multiplied by, 1.
fn answer(globals: &str, body: &str) -> String {
    format!(
        "#version 430 core\n{globals}\nin vec4 pv, cv;\nuniform mat4 mw, mc, mg;\nout vec4 vc;\nvoid main()\n{{\n\
         \x20 float s = 1.0;\n  vec3 n = normalize((mg * cv).xyz);\n{body}\n\
         \x20 vec3 v = normalize(-(mw * pv).xyz), h = normalize(vec3(0.0, 0.0, 1.0) + v);\n\
         \x20 vec3 red = vec3(0.6, 0.0, 0.0);\n\
         \x20 vc = vec4(0.2 * red + max(n.z, 0.0) * red + pow(max(dot(n, h), 0.0), 80.0) * 0.4, 1.0) * s;\n\
         \x20 gl_Position = mc * pv;\n}}\n"
    )
}

/// The file, with the promise that holds for every file that is too large.
fn file(name: String, text: String, promise: Promise) -> Hostile {
    let promise = if text.len() > MAX_BYTES { rejected(DiagnosticStage::Source, SIZE) } else { promise };
    Hostile { name, bytes: text.into_bytes(), promise }
}

/// One construct in itself, 10^2 to 10^6 deep: fine, too deep, too large.
fn nested() -> Vec<Hostile> {
    // Name, what stands before the middle, the middle, what stands behind it.
    let shapes = [
        ("parentheses", "(", "s", ")"),
        ("brackets", "a[", "0", "]"),
        ("calls", "f(", "s", ")"),
        ("conditionals", "n.z>9.?2.:", "s", ""),
        ("conditionals-between", "n.z<9.?", "s", ":2."),
        ("signs", "- ", "s", ""),
        ("nots", "!!", "bool(s)", ""),
        ("complements", "~~", "int(s)", ""),
        ("assignments", "t=", "s", ""),
        ("constructors", "float(", "s", ")"),
        ("commas-in-parentheses", "(0.,", "s", ")"),
    ];
    let globals = "const int a[1] = int[1](0); float f(float x) { return x; }";
    let mut files = Vec::new();
    for depth in [100, 1_000, 10_000, 100_000, 1_000_000] {
        let promise = if depth == 100 { right() } else { stopped(NESTED) };
        for (name, before, middle, behind) in shapes {
            let value = format!("{}{middle}{}", before.repeat(depth), behind.repeat(depth));
            let body = match name {
                "brackets" => format!("  s += float({value});"),
                _ => format!("  float t;\n  s = float({value});"),
            };
            files.push(file(format!("{name}-{depth}"), answer(globals, &body), promise.clone()));
        }
        let statements = [
            ("blocks", "{", "s = 1.0;", "}"),
            ("ifs", "if (n.z < 9.0) ", "s = 1.0;", ""),
            ("ifs-with-blocks", "if (n.z < 9.0) {", "s = 1.0;", "}"),
            ("elses", "if (n.z > 9.0) s = 2.0; else ", "s = 1.0;", ""),
            ("unclosed-blocks", "{", "", ""),
            ("unclosed-parentheses", "(", "", ""),
        ];
        for (name, before, middle, behind) in statements {
            let body = format!("  {}{middle}{}", before.repeat(depth), behind.repeat(depth));
            let promise = match (name, depth) {
                ("unclosed-blocks" | "unclosed-parentheses", 100) => rejected(DiagnosticStage::Compile, ""),
                _ => promise.clone(),
            };
            files.push(file(format!("{name}-{depth}"), answer("", &body), promise));
        }
        let conditions = format!("{}{}", "#if 1\n".repeat(depth), "#endif\n".repeat(depth));
        files.push(file(format!("conditions-{depth}"), answer(&conditions, ""), stopped(CONDITIONS)));
        let condition = format!("#if {}1{}\n#endif\n", "(".repeat(depth), ")".repeat(depth));
        files.push(file(format!("parentheses-in-a-condition-{depth}"), answer(&condition, ""), promise.clone()));
    }
    files
}

/// One construct after the other: a parser's tree of these leans to one side, as deep as there are.
fn repeated() -> Vec<Hostile> {
    // Text, how many are fine, and how many cost more than is compiled.
    let expressions = [
        ("sums", "+n.x-n.x", 500, 6_000),
        ("products", "*n.x/n.x", 500, 6_000),
        ("roots", "+sqrt(n.z)-sqrt(n.z)", 100, 2_500),
        ("powers", "+pow(n.z,n.y)", 50, 2_500),
    ];
    let mut files = Vec::new();
    for (name, term, few, many) in expressions {
        let sum = |count: usize| {
            answer("", &format!("  float t = n.x{};\n  s += 0.0 * clamp(t, 0.0, 1.0);", term.repeat(count)))
        };
        files.push(file(format!("{name}-{few}"), sum(few), right()));
        files.push(file(format!("{name}-{many}"), sum(many), stopped(OPERATIONS)));
    }
    let flat = [
        ("semicolons-60000", ";".repeat(60_000)),
        ("spaces-60000", " ".repeat(60_000)),
        ("lines-60000", "\n".repeat(60_000)),
        ("continued-lines-30000", "\\\n".repeat(30_000)),
        ("empty-blocks-20000", "{}".repeat(20_000)),
        ("comments-10000", "/**/".repeat(10_000)),
        ("comment-of-10000-combining-marks", format!("// e{}", "\u{301}".repeat(10_000))),
        ("constants-folded-5000", format!("  s += 0.0{};", "+1.0-1.0".repeat(5_000))),
        ("swizzles-5000", format!("  s += 0.0 * vec4(n, 1.0){}.x;", ".xyzw".repeat(5_000))),
    ];
    for (name, body) in flat {
        files.push(file(name.into(), answer("", &body), right()));
    }
    let marks = answer("", &format!("  float e{} = 1.0;", "\u{301}".repeat(10_000)));
    files.push(file("name-of-10000-combining-marks".into(), marks, rejected(DiagnosticStage::Source, "")));
    let undeclared = answer("", &"x;".repeat(30_000));
    files.push(file("undeclared-names-30000".into(), undeclared, rejected(DiagnosticStage::Compile, "x")));
    let name = "x".repeat(30_000);
    let long = answer("", &format!("  float {name} = 1.0;\n  s = {name};"));
    files.push(file("name-of-30000-characters".into(), long, rejected(DiagnosticStage::Compile, "")));
    let error = answer(&format!("#error {}", "no ".repeat(20_000)), "");
    files.push(file("error-of-60000-characters".into(), error, rejected(DiagnosticStage::Compile, "#error")));
    files
}

/// What macros write.
fn expanded() -> Vec<Hostile> {
    let doubling = |levels: usize| {
        let mut macros = String::from("#define M0 n.x\n");
        for level in 1..=levels {
            macros += &format!("#define M{level} M{0}+M{0}\n", level - 1);
        }
        answer(&macros, &format!("  s += 0.0 * (M{levels});"))
    };
    let by_argument = |levels: usize| {
        let call = format!("{}n.x{}", "D(".repeat(levels), ")".repeat(levels));
        answer("#define D(x) x+x\n", &format!("  s += 0.0 * ({call});"))
    };
    let definitions: String = (0..2_000).map(|n| format!("#define N{n} {n}\n")).collect();
    let parameters: Vec<String> = (0..1_000).map(|n| format!("p{n}")).collect();
    let arguments = vec!["n.x"; 1_000].join(",");
    let many = format!("#define F({}) p7\n", parameters.join(","));
    let pasted = format!("#define P(a, b) a ## b\n#define Q {}\n", "P(s,s) ".repeat(5_000));
    vec![
        // 2^5 = 32 terms, 2^20 and more.
        file("macros-double-5".into(), doubling(5), right()),
        file("macros-double-20".into(), doubling(20), stopped(TOKENS)),
        file("macros-double-60".into(), doubling(60), stopped(TOKENS)),
        file("macros-double-1000".into(), doubling(1_000), stopped(TOKENS)),
        file("arguments-double-5".into(), by_argument(5), right()),
        file("arguments-double-20".into(), by_argument(20), stopped(TOKENS)),
        file("arguments-double-1000".into(), by_argument(1_000), stopped(TOKENS)),
        file("definitions-2000".into(), answer(&definitions, ""), right()),
        file("parameters-1000".into(), answer(&many, &format!("  s += 0.0 * F({arguments});")), right()),
        file("pastes-5000".into(), answer(&pasted, ""), right()),
        file("pragmas-3000".into(), answer(&"#pragma of mine\n".repeat(3_000), ""), right()),
    ]
}

/// Declarations in numbers.
fn declared() -> Vec<Hostile> {
    let each = |count: usize, line: &dyn Fn(usize) -> String| (0..count).map(line).collect::<String>();
    let functions = each(1_000, &|n| format!("float f{n}(float x) {{ return x; }}\n"));
    let calls = |count| format!("  s *= {};", (0..count).map(|n| format!("f{n}(s)")).collect::<Vec<_>>().join("*"));
    let chain = |count| {
        let links = each(count, &|n| format!("float g{}(float x) {{ return g{n}(x); }}\n", n + 1));
        answer(&format!("float g0(float x) {{ return x; }}\n{links}"), &format!("  s *= g{count}(1.0);"))
    };
    let tree = |levels| {
        let links = each(levels, &|n| format!("float t{}(float x) {{ return t{n}(x) + t{n}(x + 1.0); }}\n", n + 1));
        let root = "float t0(float x) { return sin(x); }\n";
        answer(&format!("{root}{links}"), &format!("  s += 0.0 * t{levels}(n.x);"))
    };
    let members = each(1_000, &|n| format!("float m{n};\n"));
    let outputs =
        |count| answer(&each(count, &|n| format!("out vec4 o{n};\n")), &each(count, &|n| format!("o{n} = pv;")));
    let uniforms = each(2_000, &|n| format!("uniform mat4 u{n};\n"));
    let used = (0..2_000).map(|n| format!("u{n}[0].x")).collect::<Vec<_>>().join("+");
    vec![
        file("functions-1000".into(), answer(&functions, ""), right()),
        file("functions-1000-of-which-50-are-called".into(), answer(&functions, &calls(50)), right()),
        // A call counts ten operations at least.
        file(
            "functions-1000-all-called-twice".into(),
            answer(&functions, &calls(1_000).repeat(2)),
            stopped(OPERATIONS),
        ),
        file("call-chain-100".into(), chain(100), right()),
        file("call-chain-1200".into(), chain(1_200), stopped(OPERATIONS)),
        // 2^3 sines, and 2^14, 2^100, 2^900 of them.
        file("call-tree-3".into(), tree(3), right()),
        file("call-tree-14".into(), tree(14), stopped(OPERATIONS)),
        file("call-tree-100".into(), tree(100), stopped(OPERATIONS)),
        file("call-tree-900".into(), tree(900), stopped(OPERATIONS)),
        file(
            "struct-of-1000-members".into(),
            answer(&format!("struct S {{ {members} }};"), "  S t;\n  t.m7 = s;\n  s = t.m7;"),
            right(),
        ),
        file(
            "array-of-1000000000".into(),
            answer("", "  float a[1000000000];\n  a[int(n.x)] = s;\n  s += 0.0 * a[int(n.y)];"),
            stopped(MEMORY),
        ),
        file("array-of-100000-doubles".into(), answer("double a[100000];", "  a[int(n.x)] = 1.0lf;"), stopped(MEMORY)),
        file("outputs-10".into(), outputs(10), right()),
        // Reading and writing four floats counts eight, 1,500 times.
        file("outputs-1500".into(), outputs(1_500), stopped(OPERATIONS)),
        // What the program does not set is the shader's own, 64 bytes each.
        file("uniforms-2000".into(), answer(&uniforms, &format!("  s += 0.0 * ({used});")), stopped(MEMORY)),
    ]
}

/// Loops over the driver's silent cut, which comes after 65,535 turns, and loops in loops.
fn looped() -> Vec<Hostile> {
    let stopped = Promise { verdict: Verdict::Stopped, stage: Some(DiagnosticStage::Run), says: TURNS.into() };
    let turns = |count: u64| {
        answer(
            "",
            &format!(
                "  int turns = 0;\n  for (int i = 0; i < int(float({count}) * pv.w); i++) turns++;\n  s = turns == {count} ? 1.0 : 0.0;"
            ),
        )
    };
    let within = |depth: usize| {
        let heads: String =
            (0..depth).map(|n| format!("for (int i{n} = 0; i{n} < int(10.0 * pv.w); i{n}++) ")).collect();
        answer("", &format!("  int turns = 0;\n  {heads}turns++;\n  s += 0.0 * float(turns);"))
    };
    let mut files: Vec<Hostile> = [65_000, 65_534, 65_535, 65_536, 100_000, 16_000_000]
        .map(|count| file(format!("turns-{count}"), turns(count), stopped.clone()))
        .into();
    files.push(file("turns-1000".into(), turns(1_000), right()));
    // 10^2 turns; 10^6 and 10^8 of them.
    files.push(file("loops-in-loops-2".into(), within(2), right()));
    files.push(file("loops-in-loops-6".into(), within(6), stopped.clone()));
    files.push(file("loops-in-loops-8".into(), within(8), stopped));
    files
}

/// Files of a right answer and a comment, up to the largest that is read and beyond.
fn sized() -> Vec<Hostile> {
    let padded = |bytes: usize| {
        let answer = answer("", "");
        let comment = bytes - answer.len() - "/**/\n".len();
        format!("{answer}/*{}*/\n", "x".repeat(comment))
    };
    [60_000, MAX_BYTES - 1, MAX_BYTES, MAX_BYTES + 1, 1 << 20]
        .map(|bytes| {
            let text = padded(bytes);
            assert_eq!(text.len(), bytes);
            file(format!("bytes-{bytes}"), text, right())
        })
        .into()
}
