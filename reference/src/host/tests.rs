//! What is read of programs.

use super::*;

const SHADER: &str =
    "#version 410 core\nuniform float lx;  // its place\nvoid main()\n{\n    // ggrade: numbers\n    done();\n}\n";

fn array() -> HostArray {
    let mut array = HostArray::new("m", "ms", 4);
    array.given.insert("lp".into(), ["lx", "ly", "lz", "1.0"].map(str::to_owned).to_vec());
    array.given.insert("light.position".into(), ["ex", "ey", "ez", "ew"].map(str::to_owned).to_vec());
    array.with_shader(SHADER).expect("a shader")
}

/// The four numbers as the shader has them, of a program with this behind its first line.
fn numbers(program: &str) -> Result<[String; 4], UnreadableProgram> {
    let listing = array().read(&format!("#include \"GgApp.h\"\n{program}"))?;
    Ok([0, 1, 2, 3].map(|at| {
        let from = listing.shader.find(&format!("m{at} = ")).expect("a number") + 5;
        let end = listing.shader[from..].find(';').expect("an end");
        listing.shader[from..from + end].to_owned()
    }))
}

#[test]
fn numbers_stand_on_their_own_lines() {
    let text = "// one\n// two\n  const GLfloat m[] =\n  {\n    lp[1], 0.0f,\n    -lp[0],\n    4\n  };\n  const GgMatrix ms(m);\n";
    let listing = array().read(text).expect("a program");
    let lines: Vec<&str> = listing.shader.lines().collect();
    assert_eq!(
        lines,
        [
            "#version 410 core",
            "",
            "uniform float lx; void main() {",
            "",
            " float m0 = (ly); float m1 = 0.0;",
            " float m2 = (-(lx));",
            " float m3 = 4.0;",
            " done(); }"
        ]
    );
    assert_eq!(listing.literals, [0.0, 4.0]);
    assert_eq!(listing.names.iter().collect::<Vec<_>>(), ["lx", "ly"]);
}

#[test]
fn a_program_is_written_in_many_ways() {
    for (program, expected) in [
        ("float m[4] = { 1, 2.f, .5, 1e2f };", ["1.0", "2.0", "0.5", "100.0"]),
        ("constexpr GLfloat m[]{ lp[0] * lp[1], (lp[2]), +lp[3], -1 };", ["((lx) * (ly))", "(lz)", "(1.0)", "(-1.0)"]),
        ("std::array<GLfloat, 4> m = {{ 1, 2, 3, 4 }};", ["1.0", "2.0", "3.0", "4.0"]),
        ("GLfloat m[2][2] = { { 1, 2 }, { 3, 4 } };", ["1.0", "2.0", "3.0", "4.0"]),
        // What is not said of an array is 0.
        ("GLfloat m[4] = { 7 };", ["7.0", "0.0", "0.0", "0.0"]),
        ("GLfloat m[4]; m[0] = 1; m[1] = 2; m[3] = lp[1]; m[2] = 3;", ["1.0", "2.0", "3.0", "(ly)"]),
        ("GLfloat m[] = { 1, 2, 3, 4 }; m[3] = -lp[0];", ["1.0", "2.0", "3.0", "(-(lx))"]),
        // The one that is handed out is a comment, or not compiled.
        ("/* GLfloat m[] = { 9, 9, 9, 9 }; */ GLfloat m[] = { 1, 2, 3, 4 };", ["1.0", "2.0", "3.0", "4.0"]),
        (
            "#if 0\nGLfloat m[] = { 9, 9, 9, 9 };\n#else\nGLfloat m[] = { 1, 2, 3, 4 };\n#endif",
            ["1.0", "2.0", "3.0", "4.0"],
        ),
        (
            "#if 1\nGLfloat m[] = { 1, 2, 3, 4 };\n#else\nGLfloat m[] = { 9, 9, 9, 9 };\n#endif",
            ["1.0", "2.0", "3.0", "4.0"],
        ),
        ("GLfloat shadow[] = { 1, 2, 3, 4 }; GgMatrix ms{ shadow };", ["1.0", "2.0", "3.0", "4.0"]),
        (
            "float m[] = { 9, 9 }; GLfloat shadow[] = { 1, 2, 3, 4 }; GgMatrix ms{ shadow };",
            ["1.0", "2.0", "3.0", "4.0"],
        ),
        ("GgMatrix ms{ 1, 2, 3, 4 };", ["1.0", "2.0", "3.0", "4.0"]),
        // Names, and what they stand for.
        (
            "const GLfloat Lx = lp[0], Ly{ lp[1] }; float z(lp[2]); float m[] = { Lx, Ly, z, -Lx };",
            ["(lx)", "(ly)", "(lz)", "(-(lx))"],
        ),
        ("const auto& l = lp; float m[] = { l[0], l[1], l[2], l[3] };", ["(lx)", "(ly)", "(lz)", "(1.0)"]),
        ("const GLfloat* l = lp.data(); float m[] = { l[0], l[1], l[2], l[3] };", ["(lx)", "(ly)", "(lz)", "(1.0)"]),
        (
            "float n[] = { 0, 1, 0 }; float m[] = { n[0], n[1] * lp[1], n[2], 0 };",
            ["0.0", "(1.0 * (ly))", "0.0", "0.0"],
        ),
        (
            "#define HEIGHT 4.0f // of the light\nfloat m[] = { HEIGHT, -HEIGHT, 0, 0 };",
            ["4.0", "(-4.0)", "0.0", "0.0"],
        ),
        ("float m[] = { light.position[0], light.position[1], 0, 0 };", ["(ex)", "(ey)", "0.0", "0.0"]),
        ("float m[] = { (GLfloat)4, static_cast<float>(lp[1]), GLfloat(2), float{3} };", ["4.0", "(ly)", "2.0", "3.0"]),
        ("float m[] = { lp.at(0), -lp.at(1), lp.z, light.position.at(3) };", ["(lx)", "(-(ly))", "(lz)", "(ew)"]),
        // Whole numbers are divided as C++ does it.
        ("float m[] = { 1 / 4, 1.0f / 4, -1.0f / lp[1], 3 - 2 - 1 };", ["0.0", "0.25", "((-1.0) / (ly))", "0.0"]),
        ("float m[] = { 1, 2, 3, 4 }; GgMatrix ms{ GgMatrix(m).transpose() };", ["1.0", "3.0", "2.0", "4.0"]),
    ] {
        assert_eq!(numbers(program).unwrap_or_else(|wrong| panic!("{program}: {wrong:?}")), expected, "{program}");
    }
}

#[test]
fn what_cannot_be_read_is_named_by_its_line() {
    for (program, line, part) in [
        ("int main() {}", None, "no array `m` of 4 numbers"),
        ("float m[] = { 1, 2, 3 };", Some(2), "has 3 numbers"),
        // Not the light, which has as many numbers as a matrix.
        ("L light{ { 1, 2 }, { 3, 4 } };\nfloat m[] = {\n1, 2\n-3, 4 };\nGgMatrix ms{ m };", Some(4), "has 3 numbers"),
        ("L light{ { 1, 2 }, { 3, 4 } };\nfloat m[] = {\n1, 2, 3 };\nGgMatrix ms{ m };", Some(3), "has 3 numbers"),
        ("float m[] = { 1, lp.at(4), 3, 4 };", Some(2), "no element 4"),
        ("float m[] = { 1, 2,\n 3, sin(lp[0]) };", Some(3), "`sin`"),
        ("float m[] = { 1, 2, 3, 4 5 };", Some(2), "`5`"),
        ("float m[] = { 1, 2, 3, lp };", Some(2), "`lp`"),
        ("float m[] = { 1, 2, 3, lp[4] };", Some(2), "no element 4"),
        ("float m[] = { 1, 2, 3, height };", Some(2), "what number `height` is"),
        ("float a = b; float b = a;\nfloat m[] = { 1, 2, 3, b };", Some(3), "what number"),
        ("float a = a; float m[] = { 1, 2, 3, a };", Some(2), "in a circle"),
        ("float m[] = { 1, 2, 3, 1 / 0 };", Some(2), "no number"),
        ("float m[] = { 1, 2, 3, 1e39f };", Some(2), "`1e39f`"),
        ("float m[4];\nm[0] = 1;", Some(2), "`m[1]` has no value"),
        ("float m[] = { 1, 2, 3, 4 };\nfor (int i = 0; i < 4; ++i) m[i] *= 2;", Some(3), "changed here"),
        ("float m[] = { 1, 2, 3, 4 };\nconst GgMatrix ms{ mps * mvs };", Some(3), "does not make `ms`"),
        ("float m[] = { 1, 2, 3, (4 };", None, "no array"),
    ] {
        let wrong = numbers(program).expect_err(program);
        assert!(
            wrong.line == line && wrong.message.en.contains(part) && !wrong.message.ja.is_empty(),
            "{program}: {wrong:?}"
        );
    }
}

#[test]
fn a_circle_and_a_mountain_of_names_end() {
    let doubled: String = (1..200).map(|at| format!("float a{at} = a{0} + a{0};\n", at - 1)).collect();
    let wrong = numbers(&format!("float a0 = 1;\n{doubled}float m[] = {{ a199, 0, 0, 0 }};")).expect_err("too much");
    assert!(wrong.message.en.contains("too many parts"), "{wrong:?}");
    let deep = "(".repeat(20_000);
    assert!(numbers(&format!("float m[] = {{ {deep}, 0, 0, 0 }};")).is_err());
    assert!(numbers(&format!("float m[] = {{ {}1, 0, 0, 0 }};", "-".repeat(20_000))).is_err());
}

#[test]
fn the_shader_has_one_mark_and_begins_with_its_version() {
    for text in ["", "void main() {}", "#version 410\nvoid main() {}", "#version 410\n#define A\n// ggrade: numbers"] {
        assert!(HostArray::new("m", "ms", 4).with_shader(text).is_err(), "{text}");
    }
}
