//! What is handed out of a class names no folder of the machine.

use crate::class::{Place, REJECTED, RIGHT, WRONG, ggrade, sample};
use predicates::prelude::*;
use std::fs;
use std::io::Read;
use std::path::Path;

/// Every text below a folder, with the name of its file; archives are looked into.
fn texts(folder: &Path) -> Vec<(String, String)> {
    let mut found = Vec::new();
    for entry in walkdir::WalkDir::new(folder) {
        let path = entry.unwrap().into_path();
        if path.extension().is_some_and(|extension| extension == "zip") {
            let mut archive = zip::ZipArchive::new(fs::File::open(&path).unwrap()).unwrap();
            for index in 0..archive.len() {
                let mut text = String::new();
                let mut member = archive.by_index(index).unwrap();
                member.read_to_string(&mut text).unwrap();
                found.push((path.display().to_string(), format!("{}\n{text}", member.name().unwrap())));
            }
        } else if path.is_file() {
            found.push((path.display().to_string(), String::from_utf8_lossy(&fs::read(&path).unwrap()).into_owned()));
        }
    }
    found
}

#[test]
fn a_class_named_by_its_whole_path_is_written_without_it() {
    let place = Place::of(&[("佐藤 花子", &sample(RIGHT)), ("tanaka", &sample(WRONG)), ("suzuki", &sample(REJECTED))]);
    fs::create_dir(place.at("class/empty")).unwrap();
    std::os::unix::fs::symlink("/etc/passwd", place.at("class/empty/ggsample06.vert")).unwrap();
    fs::write(place.at("class/notes.docx"), "PK").unwrap();
    let mut command = ggrade();
    command.current_dir("/").arg("batch").arg(place.at("class")).arg("--out").arg(place.at("out"));
    let output = command.args(["--deadline", "20", "--json-lines"]).output().unwrap();
    assert_eq!(output.status.code(), Some(1), "{}", String::from_utf8_lossy(&output.stderr));
    let folder = place.at("").canonicalize().unwrap().display().to_string();
    let (written, lines) = (texts(&place.at("out")), String::from_utf8(output.stdout).unwrap());
    assert!(written.len() > 20, "too few files to prove anything");
    for (name, text) in written.iter().chain([&("standard output".to_owned(), lines)]) {
        assert!(!text.contains(&folder), "{name}");
    }
    let table = fs::read_to_string(place.at("out/grades.csv")).unwrap();
    assert!(table.contains(",tanaka/ggsample06.vert,") && table.contains(",佐藤 花子/ggsample06.vert,"), "{table}");
    let sarif = fs::read_to_string(place.at("out/report.sarif")).unwrap();
    assert!(sarif.contains("\"uri\": \"suzuki/ggsample06.vert\""), "{sarif}");
}

#[test]
fn in_ci_a_file_is_named_from_the_working_folder_on() {
    let place = Place::of(&[("tanaka", &sample(REJECTED))]);
    let file = place.at("class/tanaka/ggsample06.vert");
    for (input, from) in [("class", ""), ("../class", "class")] {
        let mut command = ggrade();
        command.current_dir(place.at(from)).args([
            "batch",
            input,
            "--formats",
            "github",
            "--formats",
            "sarif",
            "--force",
        ]);
        command.arg("--out").arg(place.at("out")).args(["--deadline", "20"]).assert().code(1);
        let named = if from.is_empty() { "class/tanaka/ggsample06.vert" } else { "tanaka/ggsample06.vert" };
        let annotations = fs::read_to_string(place.at("out/github-annotations.txt")).unwrap();
        assert!(annotations.contains(&format!("file={named},")), "{annotations}");
    }
    for format in ["sarif", "github", "junit"] {
        let mut command = ggrade();
        command.current_dir("/").arg("grade").arg(&file).args(["--format", format, "--deadline", "20"]);
        let folder = place.at("").display().to_string();
        command.assert().code(1).stdout(predicate::str::contains(folder).not());
    }
}
