//! Runs that are killed, and runs that are asked to stop.

use crate::class::{Place, RIGHT, sample};
use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use std::fs;
use std::hash::{BuildHasher, RandomState};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// Formats whose files say nothing of the time that a grading took.
const FORMATS: [&str; 4] = ["--formats", "html,csv,vpl,sarif", "--seed", "11"];

/// One right and wrong answer in twelve: about 25 students.
const STRIDE: usize = 12;

/// How long a test waits for what is sure to come.
const PATIENCE: Duration = Duration::from_secs(120);

fn begin(place: &Place, out: &str, options: &[&str]) -> Child {
    Command::new(env!("CARGO_BIN_EXE_ggrade"))
        .current_dir(place.at(""))
        .args(["batch", "class", "--out", out, "--deadline", "10"])
        .args(FORMATS)
        .args(options)
        .env("LANG", "C")
        .env_remove("GGRADE_LANG")
        .env_remove("LC_ALL")
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

/// Results that are in the journal.
fn results(out: &Path) -> usize {
    let text = fs::read(out.join("results.jsonl")).unwrap_or_default();
    text.iter().filter(|byte| **byte == b'\n').count().saturating_sub(1)
}

/// Waits until there are at least so many results, or the run is over.
fn wait_for(child: &mut Child, out: &Path, count: usize) {
    let end = Instant::now() + PATIENCE;
    while results(out) < count && child.try_wait().unwrap().is_none() {
        assert!(Instant::now() < end, "{} results of {count}", results(out));
        std::thread::sleep(Duration::from_millis(1));
    }
}

fn signal(child: &Child, signal: Signal) {
    kill(Pid::from_raw(child.id().try_into().unwrap()), signal).unwrap();
}

#[test]
fn killed_at_any_moment_and_resumed_everyone_is_there_once() {
    let place = Place::of_many(STRIDE);
    place.batch("quiet").args(FORMATS).assert().code(1);
    let quiet = place.files("quiet");
    let students = place.journal("quiet").len() - 1;
    assert!(students > 20);

    // After every few results a kill, a few random microseconds later.
    let mut kept = 0;
    let mut kills = 0;
    let out = place.at("out");
    for due in (0..students).step_by(5) {
        let mut child = begin(&place, "out", &["--resume"]);
        wait_for(&mut child, &out, due);
        std::thread::sleep(Duration::from_micros(RandomState::new().hash_one(due) % 40_000));
        let was_running = child.try_wait().unwrap().is_none();
        child.kill().unwrap();
        child.wait().unwrap();
        kills += usize::from(was_running);
        assert!(results(&out) >= kept, "{} of {kept} results are left", results(&out));
        kept = results(&out);
    }
    assert!(kills >= 3, "{kills} kills show nothing");
    place.batch("out").args(FORMATS).arg("--resume").assert().code(1);
    let resumed = place.files("out");
    assert_eq!(resumed.keys().collect::<Vec<_>>(), quiet.keys().collect::<Vec<_>>());
    for (name, bytes) in &quiet {
        assert!(resumed[name] == *bytes, "{} is not what it is after a quiet run", name.display());
    }
}

#[test]
fn a_torn_line_is_graded_again() {
    let place = Place::of_many(4 * STRIDE);
    place.batch("out").args(FORMATS).assert().code(1);
    let (whole, files) = (fs::read(place.at("out/results.jsonl")).unwrap(), place.files("out"));
    let last = whole[..whole.len() - 1].iter().rposition(|byte| *byte == b'\n').unwrap() + 1;
    fs::write(place.at("out/results.jsonl"), &whole[..(last + whole.len()) / 2]).unwrap();
    place.batch("out").args(FORMATS).arg("--resume").assert().code(1).stderr(predicates::str::contains("1 torn"));
    assert_eq!(place.files("out"), files);
}

#[test]
fn ctrl_c_keeps_what_is_graded_and_says_how_to_go_on() {
    for (number, stop) in [Signal::SIGINT, Signal::SIGTERM].into_iter().enumerate() {
        let place = Place::of_many(STRIDE);
        let out = place.at("out");
        let mut child = begin(&place, "out", &[]);
        wait_for(&mut child, &out, 3);
        signal(&child, stop);
        let output = child.wait_with_output().unwrap();
        let text = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(130), "{text}");
        assert!(text.contains("--resume"), "{text}");
        let students = fs::read_dir(place.at("class")).unwrap().count();
        let done = results(&out);
        assert!(done >= 3 && done < students, "{done} of {students}");
        // Half a grade book would look like a whole one.
        assert!(!out.join("grades.csv").exists());
        if number == 0 {
            place.batch("out").args(FORMATS).arg("--resume").assert().code(1);
            assert_eq!(results(&out), students);
            assert!(out.join("grades.csv").is_file());
        }
    }
}

#[test]
fn a_second_ctrl_c_ends_at_once() {
    // A shader that takes the whole deadline keeps a run from ending by itself.
    let place = Place::new();
    place.hand_in("a", &sample(RIGHT));
    for number in 0..8 {
        let mut endless = sample("hostile/stopped/loops/counter-forgotten.vert");
        endless.extend(format!("// {number}\n").bytes());
        place.hand_in(&format!("endless-{number}"), &endless);
    }
    let out = place.at("out");
    let mut child = begin(&place, "out", &[]);
    wait_for(&mut child, &out, 1);
    signal(&child, Signal::SIGINT);
    std::thread::sleep(Duration::from_millis(20));
    let is_over = child.try_wait().unwrap().is_some();
    if !is_over {
        signal(&child, Signal::SIGINT);
    }
    assert_eq!(child.wait().unwrap().code(), Some(130));
}
