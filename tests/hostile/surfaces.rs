//! A hostile file gets the verdict that is promised by `ggrade grade` as well. The tests of `ggrade batch` and of the service hand in all
//! of them, and the corpus holds every word that is said of the samples.

use super::files::{self, Hostile, Seen};
use super::workers::GGRADE;
use std::process::Command;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Hands in files one by one, from several threads; what goes wrong is said in words.
type Surface<'a> = &'a (dyn Fn(&Hostile) -> Result<Seen, String> + Sync);

/// Files handed in at once.
const CALLERS: usize = 2;

/// A process of its own for each file: what is in the file makes no difference to that, so some of every kind are enough.
#[test]
fn the_command_gives_each_file_its_verdict() {
    let folder = tempfile::tempdir().unwrap();
    let files = files::some();
    assert!(files.len() > 100, "only {} files", files.len());
    hold(&files, &|file| {
        let path = folder.path().join(format!("{}.vert", file.name));
        std::fs::write(&path, &file.bytes).map_err(|error| error.to_string())?;
        let command = ["grade", "--format", "json", "--lang", "en", "--seed", "7", "--deadline", "60"];
        let output = Command::new(GGRADE).args(command).arg(&path).output().map_err(|error| error.to_string())?;
        let json = serde_json::from_slice(&output.stdout).ok().and_then(|json| Seen::of_json(&json));
        json.ok_or_else(|| String::from_utf8_lossy(&output.stderr).into_owned())
    });
}

/// Hands in every file, and holds each answer against what was promised.
fn hold(files: &[Hostile], surface: Surface<'_>) {
    let (next, broken) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    std::thread::scope(|scope| {
        for _ in 0..CALLERS {
            scope.spawn(|| {
                while let Some(file) = files.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let seen = surface(file).map_err(|error| format!("{}: no verdict: {error}", file.name));
                    if let Err(complaint) = seen.and_then(|seen| file.check(&seen)) {
                        broken.lock().unwrap().push(complaint);
                    }
                }
            });
        }
    });
    let broken = broken.into_inner().unwrap();
    assert!(broken.is_empty(), "{} of {} files:\n{}", broken.len(), files.len(), broken.join("\n"));
}

#[test]
fn a_broken_promise_is_noticed() {
    let files = files::big::files();
    let file = files.iter().find(|file| file.name == "parentheses-1000").unwrap();
    let said = |verdict, message: &str| Seen {
        verdict,
        errors: vec![(ggrade::diagnostic::DiagnosticStage::Compile, message.to_owned())],
    };
    use ggrade::report::Verdict::{Rejected, Stopped};
    assert!(file.check(&said(Stopped, "… are nested more than 256 deep …")).is_ok());
    assert!(file.check(&said(Stopped, "the shader did not finish within 2 s (time limit)")).is_err());
    assert!(file.check(&said(Rejected, "… are nested more than 256 deep …")).is_err());
    assert!(file.check(&Seen { verdict: Stopped, errors: Vec::new() }).is_err());
}
