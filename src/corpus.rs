//! Samples beside what is expected of them: `NAME.vert` and `NAME.json` in one folder.
//!
//! An expectation without a sample, and a sample without one, are errors; so is a folder without any.

mod expectation;

pub use expectation::Expectation;

use crate::cross_check::{CrossCheck, Opinion};
use crate::fault::Fault;
use crate::grade::Order;
use crate::hand_in::HandIn;
use crate::language::Text;
use crate::parallel;
use crate::sandbox::{Pool, Submission};
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use std::{fs, io};

/// The seed that samples are graded with.
pub const SEED: u64 = 1;
/// Extension of an expected report.
const EXPECTED: &str = "json";

/// How one sample came out.
#[derive(Clone, Debug)]
pub struct Checked {
    /// The sample.
    pub sample: PathBuf,
    /// What is expected of it; none where the file is missing.
    pub expected: Option<Expectation>,
    /// What was found, or why nothing was.
    pub found: Result<Expectation, Fault>,
    /// What the interpreter computes for it, where that was asked for and the sample was drawn.
    pub cross_check: Option<CrossCheck>,
}

impl Checked {
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
        let path = self.sample.with_extension(EXPECTED);
        let mut json = serde_json::to_string_pretty(&found).map_err(|error| unreadable(&path, &error.to_string()))?;
        json.push('\n');
        fs::write(&path, json).map_err(|error| unreadable(&path, &error.to_string()))
    }
}

/// Grades every sample below `folder` on all cores, and holds each against its expectation and, where that is asked for,
/// the driver's values against the interpreter's.
pub fn check(folder: &Path, pool: &Pool, cross_check: bool) -> Result<Vec<Checked>, Fault> {
    let samples = samples(folder)?;
    let stop = AtomicBool::new(false);
    let checked = parallel::map(&samples, parallel::processors(), &stop, |sample| check_one(sample, pool, cross_check));
    let panicked = || Err(unreadable(folder, "a thread panicked"));
    let results: Result<Vec<Checked>, Fault> = checked.into_iter().map(|one| one.unwrap_or_else(panicked)).collect();
    let mut results = results?;
    results.sort_by(|a, b| a.sample.cmp(&b.sample));
    Ok(results)
}

fn check_one(sample: &Path, pool: &Pool, cross_check: bool) -> Result<Checked, Fault> {
    let bytes = fs::read(sample).map_err(|error| unreadable(sample, &error.to_string()))?;
    let path = sample.with_extension(EXPECTED);
    let expected = match fs::read_to_string(&path) {
        Ok(json) => Some(serde_json::from_str(&json).map_err(|error| unreadable(&path, &error.to_string()))?),
        Err(error) if error.kind() == io::ErrorKind::NotFound => None,
        Err(error) => return Err(unreadable(&path, &error.to_string())),
    };
    let name = sample.file_name().unwrap_or_default().to_string_lossy();
    let answer = pool.grade(Submission {
        hand_in: &HandIn::of_one(name, bytes),
        order: Order { seed: SEED, cross_check, ..Order::default() },
        wants_frames: false,
    });
    let cross_check = answer.as_ref().ok().and_then(|answer| answer.report.cross_check.clone());
    let found = answer.map(|answer| Expectation::of(&answer.report));
    Ok(Checked { sample: sample.into(), expected, found, cross_check })
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
    let mut keys: Vec<PathBuf> = samples.iter().map(|sample| sample.with_extension("")).collect();
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

fn walk(folder: &Path, files: &mut Vec<PathBuf>) -> Result<(), Fault> {
    let entries = fs::read_dir(folder).map_err(|error| unreadable(folder, &error.to_string()))?;
    for entry in entries {
        let path = entry.map_err(|error| unreadable(folder, &error.to_string()))?.path();
        if path.is_dir() {
            walk(&path, files)?;
        } else {
            files.push(path);
        }
    }
    Ok(())
}

fn unreadable(path: &Path, detail: &str) -> Fault {
    Fault::new(Text::verbatim(format!("{}: {detail}", path.display())))
}
