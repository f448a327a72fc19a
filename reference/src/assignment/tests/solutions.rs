//! Solutions, and answers that are accepted besides them.

use super::*;

#[test]
fn a_solution_is_refused_with_its_line_and_what_to_write() {
    // A program without definitions is a solution, but not one of which the rubric can name any.
    let error = |from: &str, to: &str| {
        let error = broken_in("solution.vert", from, to);
        let named = "; rubric `ambient`, names the definition `ambient`";
        error.strip_suffix(named).map(str::to_owned).unwrap_or(error)
    };
    let half = "vec3 h = normalize(l + v);";
    assert_eq!(error(half, "vec3 h = normalize(l + vv);"), "solution.vert, line 34: there is no variable `vv`");
    assert_eq!(error(half, "vec3 h;"), "solution.vert, line 34: `h` has no value: write `h = …` where it is declared");
    let only = "solution.vert, line 34: `main` has only definitions `type name = expression;`, and then \
                `output = name;`: put this into a function";
    assert_eq!(error(half, &format!("{half} if (true) {{ }}")), only);
    assert_eq!(
        error(half, &format!("{half} n = h;")),
        "solution.vert, line 34: `n` has a value already: give the new one a name of its own"
    );
    assert_eq!(
        error("vc = colour;", ""),
        "solution.vert: no output has a value: declare `out vec4 a_name;`, and write `a_name = …;` at the end of `main`"
    );
    assert_eq!(
        error("uniform mat4 mw;", "const mat4 mw = mat4(1.0);"),
        format!(
            "assignment.toml, line {}, uniform `mw`: there is no such uniform in solution.vert or fixed.frag: \
             declare `uniform type mw;` there, or write `type = …` here",
            line_of("name = \"mw\"")
        )
    );
    assert_eq!(
        error("out vec4 vc;", "out vec4 vc; uniform float gain;"),
        "solution.vert, line 25: `gain` is neither [[input]] nor [[uniform]] in assignment.toml: remove it here, or write there, with a value of \
         yours:\n[[uniform]]\nname = \"gain\"\nvalue = 0.8"
    );
    assert_eq!(
        error("out vec4 vc;", "out vec4 vc; float gain = 1.0;"),
        "solution.vert, line 25: `gain` is not known before `main`: write `const` before it, or move it there"
    );
}

#[test]
fn a_solution_that_is_undefined_is_refused() {
    // N·L is negative in some of the pictures.
    let error = broken_in("solution.vert", "float lambert = max(nl, 0.0);", "float lambert = pow(nl, 2.0);");
    let text = assignment("ggsample06").expect("built in").files[0].solution.text.clone();
    let line = text.lines().position(|line| line.contains("float lambert")).expect("there") + 1;
    assert!(
        error.starts_with(&format!("solution.vert, line {line}, at t = 0."))
            && error.contains("is undefined, or no number"),
        "{error}"
    );
}

/// The homework with another answer that is right as well.
fn with_accepted(answer: &str) -> Result<Assignment, AssignmentError> {
    let line = "solution = \"solution.vert\"\n";
    let mut folder = ggsample06();
    let manifest = folder.text(MANIFEST)?.replace(line, &format!("{line}accepted = [\"other.vert\"]\n"));
    folder.files.extend([("other.vert".into(), answer.into()), (MANIFEST.into(), manifest.into())]);
    Assignment::load(folder)
}

#[test]
fn an_accepted_answer_is_a_shader_of_any_form() {
    // The reflection vector in place of the half vector, and a loop that GLSL does not need.
    let folder = ggsample06();
    let answer = folder
        .text("solution.vert")
        .expect("there")
        .replace("dot(n, h)", "dot(reflect(-l, n), v)")
        .replace("vc = colour;", "for (int i = 0; i < 4; ++i) vc[i] = colour[i];");
    let other = with_accepted(&answer).expect("valid");
    let phong = [FoundMistake { id: "specular-phong".into(), form: 0, parameter: None }];
    let variant = other.variant(&phong).expect("a known mistake");
    let (probes, right) = (other.probes(1), other.accepted().next().expect("one"));
    for (probe, theirs) in probes.iter().zip(&other.probes_of(right, &probes)) {
        let expected = variant.evaluate(probes.uniforms(probe), &probe.attributes);
        assert!((theirs.colour - expected.colour()).abs().max_element() < 1e-9);
        assert!((theirs.position - expected.position()).abs().max_element() < 1e-9);
    }
    let pose = other.scene.pose(0.2);
    assert_eq!(other.frame_of(right, &pose).pixels, other.frame(&pose, &variant).pixels);
}

#[test]
fn an_accepted_answer_that_cannot_be_right_is_refused() {
    let error = |answer: &str| without_column(with_accepted(answer).expect_err(answer));
    assert_eq!(error("in vec4 pv;\nvoid main() { vc = pv; }"), "other.vert, line 2: there is no variable `vc`");
    assert_eq!(
        error("uniform float gain;\nout vec4 vc; void main() { vc = vec4(gain); gl_Position = vc; }"),
        "other.vert, line 1: `gain` is not among the inputs and uniforms of assignment.toml: remove it"
    );
    let undefined = "other.vert, at t = 0: the colour or the position is undefined, or no number: look at divisions, \
                     roots, powers, branches, loops that do not end, `normalize` of nothing, and `smoothstep` whose first edge is not the smaller one";
    assert_eq!(error("out vec4 vc; void main() { vc = vec4(1.0); }"), undefined);
}

#[test]
fn a_solution_may_have_functions_with_branches() {
    let helper = "vec3 unit(vec3 x) { if (length(x) == 0.0) return x; return normalize(x); }\nvoid main()";
    let change = |text: &str| text.replace("void main()", helper).replace("normalize(l + v)", "unit(l + v)");
    let (other, known) = (loaded("solution.vert", change).expect("valid"), assignment("ggsample06").expect("built in"));
    let probes = known.probes(1);
    for (a, b) in other.probes(1).iter().zip(&probes) {
        assert_eq!((a.colour, a.position), (b.colour, b.position));
    }
}
