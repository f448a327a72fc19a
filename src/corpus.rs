//! Samples beside what is expected of them: `NAME.vert` and `NAME.json` in one folder. A sample of several files is a
//! folder: `NAME/` with its files, and `NAME.json` beside it.
//!
//! An expectation without a sample, and a sample without one, are errors; so is a folder without any.

mod expectation;

pub use expectation::Expectation;

use crate::fault::Fault;
use crate::grade::Order;
use crate::hand_in::{HandIn, HandedInFile};
use crate::language::Text;
use crate::parallel;
use crate::report::{CrossCheck, Opinion};
use crate::sandbox::{GradingTask, Pool};
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use std::{fs, io};

/// The seed that samples are graded with.
pub const SEED: u64 = 1;
/// Extension of an expected report.
const EXPECTED: &str = "json";

/// How one sample came out.
#[derive(Clone, Debug)]
pub struct CheckedSample {
    /// The sample.
    pub sample: PathBuf,
    /// What is expected of it; `None` where the file is missing.
    pub expected: Option<Expectation>,
    /// What was found, or why nothing was.
    pub found: Result<Expectation, Fault>,
    /// What the interpreter computes for it, where that was asked for and the sample was drawn.
    pub cross_check: Option<CrossCheck>,
}

impl CheckedSample {
    /// Whether all is as expected.
    pub fn agrees(&self) -> bool {
        let (Some(expected), Ok(found)) = (&self.expected, &self.found) else { return false };
        expected.agrees(found)
    }

    /// Whether the interpreter computes other values than the driver.
    pub fn is_disputed(&self) -> bool {
        self.cross_check.as_ref().is_some_and(|checked| checked.opinion == Opinion::Differs)
    }

    /// Writes what was found as what is expected.
    pub fn bless(&self) -> Result<(), Fault> {
        let found = self.found.clone()?;
        let path = expectation_of(&self.sample);
        let mut json = serde_json::to_string_pretty(&found).map_err(|error| unreadable(&path, &error.to_string()))?;
        json.push('\n');
        fs::write(&path, json).map_err(|error| unreadable(&path, &error.to_string()))
    }
}

/// Grades every sample below `folder` on all cores, and holds each against its expectation and, where that is asked for,
/// the driver's values against the interpreter's.
pub fn check(folder: &Path, pool: &Pool, cross_check: bool) -> Result<Vec<CheckedSample>, Fault> {
    let samples = samples(folder)?;
    let stop = AtomicBool::new(false);
    let checked = parallel::map(&samples, parallel::processors(), &stop, |sample| check_one(sample, pool, cross_check));
    let panicked = || Err(unreadable(folder, "a thread panicked"));
    let results: Result<Vec<CheckedSample>, Fault> =
        checked.into_iter().map(|one| one.unwrap_or_else(panicked)).collect();
    let mut results = results?;
    results.sort_by(|a, b| a.sample.cmp(&b.sample));
    Ok(results)
}

fn check_one(sample: &Path, pool: &Pool, cross_check: bool) -> Result<CheckedSample, Fault> {
    let hand_in = HandIn { files: files_of(sample)? };
    let path = expectation_of(sample);
    let expected = match fs::read_to_string(&path) {
        // An empty one is made by hand for a new folder, so that it is a sample.
        Ok(json) if json.trim().is_empty() => None,
        Ok(json) => Some(serde_json::from_str(&json).map_err(|error| unreadable(&path, &error.to_string()))?),
        Err(error) if error.kind() == io::ErrorKind::NotFound => None,
        Err(error) => return Err(unreadable(&path, &error.to_string())),
    };
    let order = Order { seed: SEED, cross_check, ..Order::default() };
    let answer =
        pool.grade(GradingTask { assignment: pool.assignment(), hand_in: &hand_in, order, wants_frames: false });
    let cross_check = answer.as_ref().ok().and_then(|answer| answer.report.cross_check.clone());
    let found = answer.map(|answer| Expectation::of(&answer.report));
    Ok(CheckedSample { sample: sample.into(), expected, found, cross_check })
}

/// The files of a sample: those of its folder, or the one that it is.
fn files_of(sample: &Path) -> Result<Vec<HandedInFile>, Fault> {
    let mut paths = vec![sample.to_owned()];
    if sample.is_dir() {
        paths = entries(sample)?;
        paths.sort();
    }
    let file = |path: &PathBuf| {
        let bytes = fs::read(path).map_err(|error| unreadable(path, &error.to_string()))?;
        Ok(HandedInFile::new(path.file_name().unwrap_or_default().to_string_lossy(), bytes))
    };
    paths.iter().map(file).collect()
}

/// Where the expected report of a sample is.
fn expectation_of(sample: &Path) -> PathBuf {
    key(sample).with_added_extension(EXPECTED)
}

/// The sample without its extension; a folder has none.
fn key(sample: &Path) -> PathBuf {
    if sample.is_dir() { sample.into() } else { sample.with_extension("") }
}

/// The samples below `folder`, in order of name.
fn samples(folder: &Path) -> Result<Vec<PathBuf>, Fault> {
    let mut files = Vec::new();
    walk(folder, &mut files)?;
    let (expectations, mut samples): (Vec<_>, Vec<_>) =
        files.into_iter().partition(|path| path.extension().is_some_and(|extension| extension == EXPECTED));
    samples.sort();
    if samples.is_empty() {
        return Err(unreadable(folder, "there is no sample in it"));
    }
    let mut keys: Vec<PathBuf> = samples.iter().map(|sample| key(sample)).collect();
    // An extension sorts otherwise than the end of a name.
    keys.sort();
    if let Some(pair) = keys.windows(2).find(|pair| pair[0] == pair[1]) {
        return Err(unreadable(&pair[0], "two samples have this name"));
    }
    for expectation in expectations {
        if keys.binary_search(&expectation.with_extension("")).is_err() {
            return Err(unreadable(&expectation, "it is an expectation without a sample"));
        }
    }
    Ok(samples)
}

/// Everything below a folder; a folder that is a sample is one.
fn walk(folder: &Path, files: &mut Vec<PathBuf>) -> Result<(), Fault> {
    for path in entries(folder)? {
        if path.is_dir() && !expectation_of(&path).exists() {
            walk(&path, files)?;
        } else {
            files.push(path);
        }
    }
    Ok(())
}

fn entries(folder: &Path) -> Result<Vec<PathBuf>, Fault> {
    let entries = fs::read_dir(folder).map_err(|error| unreadable(folder, &error.to_string()))?;
    entries.map(|entry| Ok(entry.map_err(|error| unreadable(folder, &error.to_string()))?.path())).collect()
}

fn unreadable(path: &Path, detail: &str) -> Fault {
    Fault::new(Text::verbatim(format!("{}: {detail}", path.display())))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder(files: &[&str]) -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        for name in files {
            let path = folder.path().join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, name).unwrap();
        }
        folder
    }

    #[test]
    fn a_folder_beside_its_expectation_is_one_sample_of_several_files() {
        let folder = folder(&[
            "wrong/one.vert",
            "wrong/one.json",
            "wrong/two.x/a.vert",
            "wrong/two.x/a.frag",
            "wrong/two.x.json",
        ]);
        let found = samples(folder.path()).unwrap();
        let wrong = folder.path().join("wrong");
        assert_eq!(found, [wrong.join("one.vert"), wrong.join("two.x")]);
        assert_eq!(expectation_of(&found[1]), wrong.join("two.x.json"));
        let names = |sample: &Path| HandIn { files: files_of(sample).unwrap() }.names();
        assert_eq!((names(&found[0]), names(&found[1])), ("one.vert".into(), "a.frag, a.vert".into()));
    }

    #[test]
    fn an_expectation_without_a_sample_is_an_error() {
        let folder = folder(&["one.vert", "one.json", "two.json"]);
        assert!(
            samples(folder.path()).unwrap_err().message.en.ends_with("two.json: it is an expectation without a sample")
        );
        let folder = self::folder(&["one.vert", "one.json", "one/a.vert"]);
        assert!(samples(folder.path()).unwrap_err().message.en.ends_with("two samples have this name"));
    }
}
