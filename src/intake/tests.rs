mod archives;
mod builder;
mod choices;
mod hostile;
mod layouts;
mod mutations;
mod sets;

use super::*;
use std::fs;
use tempfile::TempDir;

fn options() -> IntakeOptions {
    IntakeOptions::new(reference::assignment("ggsample06").unwrap())
}

fn take(inputs: &[PathBuf]) -> Intake {
    read(inputs, &options()).unwrap()
}

/// A folder with these files; a name that ends with `/` is an empty folder.
fn folder(files: &[(&str, &str)]) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, content) in files {
        let path = folder.path().join("class").join(name);
        if name.ends_with('/') {
            fs::create_dir_all(path).unwrap();
        } else {
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, content).unwrap();
        }
    }
    folder
}

fn take_folder(files: &[(&str, &str)]) -> Intake {
    let folder = folder(files);
    take(&[folder.path().join("class")])
}

/// The archive `class.zip` with these bytes.
fn take_archive(bytes: &[u8]) -> Intake {
    take_archive_within(bytes, IntakeLimits::default())
}

fn take_archive_within(bytes: &[u8], limits: IntakeLimits) -> Intake {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("class.zip");
    fs::write(&path, bytes).unwrap();
    read(&[path], &IntakeOptions { limits, ..options() }).unwrap()
}

/// Limits of bytes and entries in all.
fn within(bytes: u64, entries: u64) -> IntakeLimits {
    IntakeLimits { total: Budget { bytes, entries, refusals: 1000 }, ..IntakeLimits::default() }
}

/// Everyone: name, and the file's content or the English reason why there is none.
fn everyone(intake: &Intake) -> Vec<(&str, Result<&str, &str>)> {
    intake
        .hand_ins
        .iter()
        .map(|hand_in| {
            let content = match &hand_in.content {
                HandInContent::Files { hand_in, .. } => Ok(std::str::from_utf8(&hand_in.files[0].bytes).unwrap()),
                HandInContent::Nothing(reason) => Err(reason.en.as_str()),
            };
            (hand_in.student.name.as_str(), content)
        })
        .collect()
}

fn names(intake: &Intake) -> Vec<&str> {
    intake.hand_ins.iter().map(|hand_in| hand_in.student.name.as_str()).collect()
}

/// What was refused, and the English reasons.
fn refused(intake: &Intake) -> Vec<(&str, &str)> {
    intake.refused.iter().map(|refused| (refused.path.as_str(), refused.reason.en.as_str())).collect()
}

/// The reason why the file of this name was refused; `None` where it was not.
fn reason<'a>(intake: &'a Intake, name: &str) -> Option<&'a str> {
    let found = intake.refused.iter().find(|refused| refused.path.ends_with(name))?;
    assert!(!found.reason.ja.is_empty());
    Some(&found.reason.en)
}

/// Where the first file is on this machine.
fn local(work: &StudentWork) -> Option<&Path> {
    match &work.content {
        HandInContent::Files { places, .. } => places[0].local.as_deref(),
        HandInContent::Nothing(_) => None,
    }
}
