use super::*;
use crate::built_in::{assignment, assignments, names};
use crate::mistake::FoundMistake;
use std::path::Path;

mod meshes;
mod passes;
mod solutions;
mod texts;
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
