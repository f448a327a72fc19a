//! Hostile files, and what is promised of each: those of `submissions/ggsample06/hostile`, and the big ones, which are
//! made here.
//!
//! A test of another surface (`ggrade batch`, the service) includes this file with
//! `#[path = "hostile/files.rs"] mod files;`, hands in [`all`], and holds each answer against [`Hostile::check`].

// Each test program uses a part of it.
#![allow(dead_code)]

use ggrade::corpus::Expectation;
use ggrade::diagnostic::{DiagnosticStage, Severity};
use ggrade::report::{Report, Verdict};
use std::path::{Path, PathBuf};
use std::{fs, io};

#[path = "big.rs"]
pub mod big;

/// A file that means harm.
#[derive(Clone)]
pub struct Hostile {
    /// What it does; also its file name, without an extension.
    pub name: String,
    /// Its content.
    pub bytes: Vec<u8>,
    /// What is promised of it.
    pub promise: Promise,
}

/// What a report must say.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Promise {
    /// The verdict.
    pub verdict: Verdict,
    /// Where the first error comes from, where there is one.
    pub stage: Option<DiagnosticStage>,
    /// What its English message contains.
    pub says: String,
}

/// What a surface has said of a file.
#[derive(Clone, Debug)]
pub struct Seen {
    /// The verdict.
    pub verdict: Verdict,
    /// Stage and English message of each error.
    pub errors: Vec<(DiagnosticStage, String)>,
}

impl Seen {
    /// What a report says.
    pub fn of(report: &Report) -> Self {
        let errors = report.diagnostics.iter().filter(|diagnostic| diagnostic.severity == Severity::Error);
        let errors = errors.map(|error| (error.stage, error.message.en.clone())).collect();
        Self { verdict: report.verdict, errors }
    }

    /// What a report in JSON says (`ggrade/report/v1`, in English).
    pub fn of_json(report: &serde_json::Value) -> Option<Self> {
        let part = |value: &serde_json::Value, key: &str| serde_json::from_value(value.get(key)?.clone()).ok();
        let errors = report.get("diagnostics")?.as_array()?.iter().filter(|error| error["severity"] == "error");
        let errors = errors
            .map(|error| Some((serde_json::from_value(error["stage"].clone()).ok()?, part(error, "message")?)))
            .collect::<Option<Vec<(DiagnosticStage, String)>>>()?;
        Some(Self { verdict: serde_json::from_value(report.get("verdict")?.clone()).ok()?, errors })
    }
}

impl Hostile {
    /// Whether this is what was promised; says what is not.
    pub fn check(&self, seen: &Seen) -> Result<(), String> {
        let first = seen.errors.first();
        let is_kept = seen.verdict == self.promise.verdict
            && first.map(|(stage, _)| *stage) == self.promise.stage
            && first.is_none_or(|(_, message)| message.contains(&self.promise.says));
        let is_named = match seen.verdict {
            Verdict::Correct | Verdict::Wrong => true,
            Verdict::Rejected | Verdict::Stopped => first.is_some_and(|(_, message)| !message.trim().is_empty()),
        };
        if is_kept && is_named {
            return Ok(());
        }
        Err(format!("{}: promised {:?}, seen {:?} {first:?}", self.name, self.promise, seen.verdict))
    }
}

/// Every hostile file there is.
pub fn all() -> Vec<Hostile> {
    let mut files = samples();
    files.extend(big::files());
    files
}

/// Of each folder of samples so many, and one of so many big ones, so that each construct is among them.
const OF_A_FOLDER: usize = 2;
const OF_BIG_ONES: usize = 4;

/// Some of them, of every kind.
pub fn some() -> Vec<Hostile> {
    let folder = |file: &Hostile| file.name.splitn(3, "--").take(2).map(str::to_owned).collect::<Vec<_>>();
    let samples = samples();
    let folders = samples.chunk_by(|a, b| folder(a) == folder(b));
    let mut some: Vec<Hostile> = folders.flat_map(|own| own.iter().take(OF_A_FOLDER).cloned()).collect();
    some.extend(big::files().into_iter().step_by(OF_BIG_ONES));
    some
}

/// The samples, with what stands beside them.
pub fn samples() -> Vec<Hostile> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("submissions/ggsample06/hostile");
    let mut files = Vec::new();
    for folder in entries(&root).iter().flat_map(|verdict| entries(verdict)) {
        for path in entries(&folder) {
            if path.extension().is_none_or(|extension| extension == "json") {
                continue;
            }
            let expected = fs::read_to_string(path.with_extension("json"));
            let expected: Expectation = serde_json::from_str(&expected.unwrap()).unwrap();
            let error = expected.diagnostics.iter().find(|place| place.severity == Severity::Error);
            let promise =
                Promise { verdict: expected.verdict, stage: error.map(|place| place.stage), says: String::new() };
            let name = path.strip_prefix(&root).unwrap().with_extension("").display().to_string().replace('/', "--");
            files.push(Hostile { name, bytes: fs::read(&path).unwrap(), promise });
        }
    }
    // The issue asks for 120; an empty folder would be a test that cannot fail.
    assert!(files.len() >= 120, "only {} hostile samples", files.len());
    files
}

fn entries(folder: &Path) -> Vec<PathBuf> {
    let entries: io::Result<Vec<_>> = fs::read_dir(folder).unwrap().map(|entry| Ok(entry?.path())).collect();
    let mut entries = entries.unwrap();
    entries.sort();
    entries
}
