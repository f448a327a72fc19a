use super::*;
use crate::built_in::{assignment, assignments, names};
use crate::mistake::FoundMistake;
use std::path::Path;

mod about;
mod costs;
mod meshes;
mod passes;
mod refusals;
mod rounding;
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

/// A folder with another rubric in place of all that stands from the first line of its own on.
fn with_rubric(mut folder: Folder, rubric: &str) -> Folder {
    let manifest = folder.text(MANIFEST).expect("a manifest").to_owned();
    let start = manifest.find("[[rubric]]").expect("a rubric");
    folder.files.insert(MANIFEST.into(), format!("{}{rubric}", &manifest[..start]).into());
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

/// A homework that says no more than it has to: a folder of the project's tests.
fn waves() -> Assignment {
    Assignment::load(homework("waves")).expect("an assignment")
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
