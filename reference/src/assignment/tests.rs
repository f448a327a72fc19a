use super::*;
use crate::built_in::{assignment, assignments, names};
use crate::mistake::FoundMistake;
use std::path::Path;

mod meshes;
mod passes;
mod textures;

/// The assignment with a change in one of its files.
fn loaded(changed: &str, change: impl Fn(&str) -> String) -> Result<Assignment, AssignmentError> {
    let mut folder = ggsample06();
    let text = change(folder.text(changed)?);
    folder.files.insert(changed.into(), text.into());
    Assignment::load(folder)
}

fn ggsample06() -> Folder {
    Folder::clone(&assignment("ggsample06").expect("built in").folder)
}

/// A homework of the project's tests.
fn homework(name: &str) -> Folder {
    Folder::read(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/homeworks").join(name)).expect("a folder")
}

/// A folder with a text of a file replaced.
fn changed(mut folder: Folder, file: &str, from: &str, to: &str) -> Folder {
    let text = folder.text(file).expect("a text");
    assert!(text.contains(from), "{from}");
    let text = text.replacen(from, to, 1);
    folder.files.insert(file.into(), text.into());
    folder
}

fn refused(folder: Folder) -> Text {
    AssignmentError { column: None, ..Assignment::load(folder).expect_err("a broken folder") }.text()
}

/// What is said; tests of the error itself look at the column.
fn without_column(error: AssignmentError) -> String {
    AssignmentError { column: None, ..error }.to_string()
}

/// The error that replacing `from` by `to` in a file leads to.
fn broken_in(file: &str, from: &str, to: &str) -> String {
    let change = |text: &str| {
        assert!(text.contains(from), "{from}");
        text.replacen(from, to, 1)
    };
    without_column(loaded(file, change).expect_err(to))
}

/// The same in `assignment.toml`.
fn broken(from: &str, to: &str) -> String {
    broken_in(MANIFEST, from, to)
}

/// Where a text stands in `assignment.toml`.
fn line_of(text: &str) -> usize {
    ggsample06().text(MANIFEST).expect("text").lines().position(|line| line.contains(text)).expect(text) + 1
}

/// The place of an entry of `assignment.toml`.
fn entry(kind: &str, id: &str) -> String {
    format!("assignment.toml, line {}, {kind} `{id}`", line_of(&format!("id = \"{id}\"")))
}

#[test]
fn the_built_in_assignment_is_what_the_homework_says() {
    let a = assignment("ggsample06").expect("built in");
    assert_eq!(a.max_score(), 100.0);
    let points: Vec<_> = a.rubric.iter().map(|l| (l.id.as_str(), l.points)).collect();
    assert_eq!(points, [("shape", 10.0), ("ambient", 20.0), ("diffuse", 30.0), ("specular", 40.0)]);
    assert!(a.files[0].starter.contains("vc = cv;"));
    assert!(assignment("ggsample07").is_none());
}

#[test]
fn constants_are_read_from_the_solution() {
    let a = assignment("ggsample06").expect("built in");
    let constant = |name: &str| a.constants.iter().find(|c| c.name == name).expect(name).value.clone();
    assert_eq!(constant("lamb"), Value::from(glam::DVec4::new(0.2, 0.2, 0.2, 1.0)));
    assert_eq!(constant("kshi"), Value::from(80.0));
    assert_eq!(
        broken_in("starter.vert", "float kshi = 80.0", "float kshi = 8.0"),
        "starter.vert, line 17: `kshi` is not what it is in solution.vert, line 16: write the same in both"
    );
}

#[test]
fn a_folder_loads_as_the_built_in_one() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("assignments/ggsample06");
    let folder = Folder::read(&folder).expect("a folder");
    assert_eq!(folder, ggsample06());
    let loaded = Assignment::load(folder).expect("the same files");
    assert_eq!((loaded.id.as_str(), loaded.digest), ("ggsample06", ggsample06().digest()));
    let error = Folder::read(Path::new("/nonexistent")).expect_err("no folder");
    assert_eq!(error.file, MANIFEST);
}

#[test]
fn every_built_in_folder_is_an_assignment_of_its_name() {
    let ids: Vec<_> = assignments().map(|assignment| assignment.id.clone()).collect();
    assert_eq!(ids, names().collect::<Vec<_>>());
    assert!(ids.contains(&"ggsample06".to_owned()));
}

#[test]
fn a_changed_file_makes_another_assignment() {
    let changed = loaded("starter.vert", |text| format!("{text}\n")).expect("valid");
    assert_ne!(changed.digest, assignment("ggsample06").expect("built in").digest);
}

#[test]
fn what_contradicts_itself_is_refused_with_its_place() {
    assert!(broken("cycle = 5", "cycles = 5").contains("there is no key `cycles`: write `cycle`;"));
    for id in ["a b", "", ".hidden", "課題6", "{x}"] {
        let said = broken("id = \"ggsample06\"", &format!("id = \"{id}\""));
        let place = format!(
            "assignment.toml, line {}: the id `{id}` cannot stand in an address",
            line_of("id = \"ggsample06\"")
        );
        assert!(said.starts_with(&place), "{said}");
    }
    assert_eq!(
        broken("keeps = { ambient = 0.5 }", "keeps = { ambient = 1.5 }"),
        format!("{}: keeps 1.5 of `ambient`: write a fraction, 0 to 1", entry("mistake", "ambient-added"))
    );
    assert!(broken("title = { en = \"No ambient term\", ", "title = { ").contains("`en` is missing: write `en = …`"));
    assert_eq!(
        broken("ja = \"環境光の項がない\"", "ja = \" \""),
        format!("{}: the title needs 1 to 60 characters in each language", entry("mistake", "ambient-missing"))
    );
    assert_eq!(
        broken("en = \"No ambient term\"", "en = \"Handed in unchanged\""),
        format!(
            "{}: another mistake has the same title: lists name it by the title alone",
            entry("mistake", "ambient-missing")
        )
    );
    assert_eq!(
        broken("name = \"kshi\"", "name = \"shininess\""),
        format!(
            "assignment.toml, line {}, constant `shininess`: solution.vert has no `const type shininess = …;`: write it there, or \
             correct the name",
            line_of("name = \"kshi\"")
        )
    );
    assert_eq!(
        broken("id = \"ambient-added\"", "id = \"ambient-missing\""),
        format!("{}: stands twice: give one another name", entry("mistake", "ambient-missing"))
    );
    assert_eq!(
        broken("far = 15", "far = 0.5"),
        format!(
            "assignment.toml, line {}, scene: the camera, the window or the number of poses makes no picture: look at `near`, \
             `far`, `fovy` and `poses`",
            line_of("[scene]")
        )
    );
    assert_eq!(
        broken("starter = \"starter.vert\"", "starter = \"other.vert\""),
        "other.vert: is not in the folder, which has assignment.toml, fixed.frag, solution.vert, starter.vert: add it, or correct the name"
    );
}

#[test]
fn an_expression_of_a_mistake_is_refused_with_its_line_and_what_to_write() {
    let (form, place) = ("forms = [{ ambient = \"kamb + lamb\" }]", "mistake `ambient-added`, form 0, `ambient`");
    let error = |expression: &str| broken(form, &format!("forms = [{{ ambient = \"{expression}\" }}]"));
    let start = format!("assignment.toml, line {}, {place}: ", line_of(form));
    let known = "`pl`, `lamb`, `ldiff`, `lspec`, `kamb`, `kdiff`, `kspec`, `kshi`, `mw`, `mc`, `mg`, `pv`, `cv`, `p`, \
                 `v`, `l`, `n`, `h`, `nl`, `lambert`, `nh`, `facing`, `highlight`";
    let wanted = format!("write an expression of type vec4 with {known}");
    assert_eq!(error("kamb + lam"), format!("{start}there is no variable `lam`: {wanted}"));
    assert_eq!(error("nl"), format!("{start}float is not vec4: {wanted}"));
    assert_eq!(error("kamb +"), format!("{start}an expression is expected before the end of the file: {wanted}"));
    assert_eq!(error("kamb; lamb"), format!("{start}the end of the expression is expected before `;`: {wanted}"));
    assert_eq!(error("specular"), format!("{start}uses `specular`, which is defined later: use only {known}"));
    let changed = error("(p = lamb)");
    assert!(changed.starts_with(&format!("{start}this changes `p`, which has a value already")), "{changed}");
    let unknown = broken("{ facing = \"nh\" }", "{ facings = \"nh\" }");
    let line = line_of("{ facing = \"nh\" }");
    let start = format!("assignment.toml, line {line}, mistake `specular-unclamped`, form 0, `facings`: there is no");
    assert!(
        unknown.starts_with(&format!("{start} definition `facings` in solution.vert, which has `p`, ")),
        "{unknown}"
    );
    let taken = broken("fit = { name = \"x\", from = 0.1, to = 5", "fit = { name = \"nl\", from = 0.1, to = 5");
    assert!(taken.ends_with("`nl` is taken, means something in GLSL, or is not a name"), "{taken}");
}

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
                     roots, powers, branches, `normalize` of nothing, and `smoothstep` whose first edge is not the smaller one";
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

#[test]
fn a_changed_constant_changes_the_equation() {
    let a = assignment("ggsample06").expect("built in");
    let changed = a.with_constants(&[("kshi", Value::from(20.0))]).expect("a constant");
    let probes = a.probes(1);
    let differs = probes.iter().any(|p| {
        let outcome = changed.equation.right().evaluate(probes.uniforms(p), &p.attributes);
        (outcome.colour() - p.colour).abs().max_element() > 0.05
    });
    assert!(differs);
    assert!(a.with_constants(&[("kshi", Value::from(glam::DVec4::ONE))]).is_err());
    assert!(a.with_constants(&[("shininess", Value::from(1.0))]).is_err());
}

/// What is said must be said in both languages, and a placeholder must not be left over when its value is not known.
#[test]
fn every_text_stands_in_both_languages_and_can_do_without_values() {
    let a = assignment("ggsample06").expect("built in");
    // A definition is always known, by the student's name or by its symbol.
    let definitions = a.equation.definitions().iter();
    let names: Vec<(&str, &str)> =
        definitions.filter_map(|one| Some((one.name.as_str(), one.symbol.as_deref()?))).collect();
    for mistake in &a.mistakes {
        for text in [&mistake.seen, &mistake.equation, &mistake.look] {
            let bare = text.fill(&names);
            for wording in [&bare.en, &bare.ja] {
                assert!(!wording.trim().is_empty(), "{}", mistake.id);
                assert!(!wording.contains(['{', '⟨', '⟩']) && !wording.contains("  "), "{}: {wording}", mistake.id);
            }
            assert!(bare.en.is_ascii() || !bare.en.contains(['。', '、']));
            assert!(bare.ja.contains(['。', '?']), "{}: {}", mistake.id, bare.ja);
            let places = [("line", "7"), ("name", "h"), ("expected", "1"), ("found", "2"), ("frames", "25")];
            let full = text.fill(&[&places[..], &names].concat());
            assert!(!full.en.contains('{') && !full.ja.contains('{'));
        }
    }
}

#[test]
fn the_mistakes_of_the_contract_are_there() {
    let a = assignment("ggsample06").expect("built in");
    for id in [
        "unchanged",
        "ambient-missing",
        "ambient-added",
        "diffuse-missing",
        "diffuse-unclamped",
        "diffuse-abs",
        "diffuse-factor-missing",
        "specular-missing",
        "specular-phong",
        "specular-half-unnormalized",
        "specular-no-exponent",
        "specular-wrong-exponent",
        "specular-unclamped",
        "specular-view-reversed",
        "specular-uses-diffuse-colour",
        "specular-gated",
        "normal-not-transformed",
        "normal-wrong-transform",
        "position-changed",
        "constants-changed",
        "hard-coded",
        "flat-per-triangle",
        "gamma",
        "clamped-early",
        "unexplained",
    ] {
        let mistake = a.mistake(id).expect(id);
        assert!(mistake.keeps.iter().any(|(_, kept)| *kept < 1.0), "{id} costs nothing");
    }
    for line in &a.rubric {
        assert_eq!(a.mistake("unchanged").expect("there").keeps(&line.id), 0.0);
    }
}

#[test]
fn regions_and_designs_speak_of_the_solution() {
    let says = |from: &str, to: &str, message: &str| {
        let found = broken(from, to);
        assert!(found.starts_with("assignment.toml, line ") && found.ends_with(message), "{found}");
    };
    let line = line_of("when = \"nl < -0.02 && highlight < 1e-6\"");
    let found = broken("nl < -0.02 && highlight < 1e-6", "nl < -0.02 && shine < 1e-6");
    let start = format!("assignment.toml, line {line}, region `ambient-only`: there is no variable `shine`");
    assert!(found.starts_with(&start), "{found}");
    let found = broken("nl < -0.02 && highlight < 1e-6", "nl");
    assert!(found.contains("write an expression of type bool with `pl`, `lamb`"), "{found}");
    says(
        "alone_in = [\"ambient-only\"]",
        "alone_in = [\"dusk\"]",
        "rubric `ambient`: there is no region `dusk`, only `facing-away`, `ambient-only`, `diffuse-only`, \
         `highlight`, `highlight-behind`, `between`",
    );
    says("axis = \"l\"", "axis = \"nl\"", "probes: `nl` is a float, and has to be a vec3");
    says(
        "lobe = \"h\"",
        "lobe = \"n\"",
        "probes: the lobe depends on the normal by `n`: name a direction that does not",
    );
    says("power = \"kshi\"", "power = \"pl\"", "probes: there is no float constant `pl`: `raised` needs it as `power`");
    says("angle = [2, 25]", "angle = [2, 250]", "probes, design 1: [2, 250] is no range within [0, 180]");
    says("raised = [0.85, 1], ", "", "probes, design 1: write one of `cosine` and `raised`: how the normal stands");
    let found = broken("within = { nl =", "within = { nl2 =");
    assert!(found.contains("probes, design 1: there is no definition `nl2`"), "{found}");
}

/// A homework that says no more than it has to: a folder of the project's tests.
fn waves() -> Assignment {
    Assignment::load(homework("waves")).expect("an assignment")
}

#[test]
fn what_is_wrong_with_an_interface_is_said_in_both_languages() {
    let folder = Folder::clone(&waves().folder);
    for (from, to) in [
        ("value = 0.15", "value = [1, 2]"),
        ("value = 0.15", "value = \"a lot\""),
        ("value = 0.15", "value = 1e60"),
        ("value = 0.15\n", "\n"),
        ("value = 0.15", "value = 0.15\ncarries = \"model\""),
        ("probe = { within = [0.05, 0.4] }", "probe = { within = [0.05] }"),
        ("probe = { within = [0.05, 0.4] }", "probe = { within = [0.4, 0.05] }"),
        ("probe = { within = [0.05, 0.4] }", "probe = { within = [0.05, 0.4], also = 1 }"),
        ("probe = { within = [0.05, 0.4] }", "probe = 0.4"),
        ("probe = { within = [0.05, 0.4] }", "probe = { from = 1 }"),
        ("name = \"time\"", "name = \"hour\""),
        ("name = \"time\"", "name = \"time\"\ntype = \"clock\""),
        ("name = \"time\"", "name = \"time\"\ntype = \"vec2\""),
        ("is = \"t * 6.2831853\"", "is = \"t *\""),
        ("name = \"time\"\nis = \"t * 6.2831853\"", "name = \"time\"\ncarries = \"model\""),
        ("name = \"waves[1].length\"", "name = \"waves[0].length\""),
        ("[[uniform]]\nname = \"time\"\nis = \"t * 6.2831853\"\n", ""),
        ("name = \"position\"\ncarries = \"position\"", "name = \"place\"\ncarries = \"position\""),
        ("name = \"position\"\ncarries = \"position\"", "name = \"position\"\nvalues = [1, 2, 3]"),
        ("name = \"position\"\ncarries = \"position\"", "name = \"position\""),
        (
            "[[uniform]]\nname = \"model\"",
            "[[input]]\nname = \"position\"\ncarries = \"position\"\n\n[[uniform]]\nname = \"model\"",
        ),
        ("eye = [0, 2, 4]", "eye = \"t t\""),
    ] {
        let mut folder = folder.clone();
        let manifest = folder.text(MANIFEST).expect("text");
        assert!(manifest.contains(from), "{from}");
        folder.files.insert(MANIFEST.into(), manifest.replacen(from, to, 1).into());
        let Text { en, ja } = Assignment::load(folder).expect_err(to).message;
        assert!(en.is_ascii() || en.contains('…'), "{to}: {en}");
        assert!(ja.contains(|c| ('ぁ'..='ん').contains(&c)), "{to}: {ja}");
    }
}

#[test]
fn a_homework_needs_neither_designs_nor_mistakes() {
    let waves = waves();
    let probes = waves.judging_probes();
    assert_eq!(probes.probes.len(), 560);
    assert!(probes.iter().all(|probe| probe.colour.is_finite() && probe.position.is_finite()));
    let right: Vec<[f64; 3]> = probes.iter().map(|probe| probe.colour.to_array()).collect();
    assert!(crate::fit::is_right(&probes, &right, crate::fit::TOLERANCE));
    let wrong: Vec<[f64; 3]> = probes.iter().map(|probe| (probe.colour * 0.9).to_array()).collect();
    assert!(!crate::fit::is_right(&probes, &wrong, crate::fit::TOLERANCE));
    // A uniform that probes may draw is drawn; one that they may not is the homework's own.
    let numbers = |path| {
        let place = waves.interface.uniforms.iter().position(|uniform| uniform.path == path).expect(path);
        probes.groups.iter().map(|group| group.uniforms[place].numbers()[0]).collect::<Vec<f64>>()
    };
    let amplitudes = numbers("waves[0].amplitude");
    assert!(amplitudes.iter().all(|amplitude| (0.05..=0.4).contains(amplitude)));
    assert!(amplitudes.iter().any(|amplitude| (amplitude - amplitudes[0]).abs() > 0.1));
    assert!(numbers("waves[0].direction").iter().all(|x| *x == 1.0));
}

#[test]
fn what_goes_wrong_in_any_homework_has_texts_until_a_folder_has_its_own() {
    let (waves, lecture) = (waves(), assignment("ggsample06").expect("built in"));
    for id in ["position-changed", "constants-changed", "hard-coded", "nearly-right", "unexplained"] {
        let (general, own) = (waves.mistake(id).expect(id), lecture.mistake(id).expect(id));
        assert_ne!(general.seen, own.seen, "{id}");
    }
    let kept = |id: &str, line: &str| waves.mistake(id).expect(id).keeps(line);
    assert_eq!([kept("position-changed", "surface"), kept("position-changed", "colour")], [0.0, 1.0]);
    assert_eq!([kept("unexplained", "surface"), kept("unexplained", "colour")], [1.0, 0.0]);
}
