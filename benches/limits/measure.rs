//! How each figure is taken. Costs are CPU time of all threads and processes, so that a busy machine does not blur them;
//! only what a person waits for is measured by the clock.

use crate::bare::{Bare, Stage};
use crate::class::Submission;
use ggrade::grade::{Grader, Order};
use ggrade::hand_in::HandIn;
use ggrade::render::AdapterKind;
use ggrade::sandbox::{self, Pool, Settings};
use nix::sys::resource::{UsageWho, getrusage};
use nix::sys::time::TimeVal;
use std::process::{Command, ExitCode, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// The cores that the goals are stated for, and the workers that are started.
pub const CORES: f64 = 2.0;
pub const WORKERS: usize = 2;
/// The seed of a class.
const ORDER: Order = Order { seed: 1, hints: ggrade::report::Hints::Full, cross_check: false };
/// Set in the process that has the driver's settings.
const MARK: &str = "GGRADE_BENCH_SETTINGS";

/// Whether this process was started with the environment of a worker.
pub fn has_driver_settings() -> bool {
    std::env::var_os(MARK).is_some()
}

/// Runs this program once more, with the environment of a worker on top of its own.
pub fn again_with_driver_settings(arguments: &[String]) -> ExitCode {
    let program = std::env::current_exe().expect("this program has a path");
    let settings = sandbox::driver_settings(AdapterKind::Software);
    let status = Command::new(program).args(arguments).envs(settings).env(MARK, "1").status();
    let code = status.expect("this program can be started").code();
    ExitCode::from(u8::try_from(code.unwrap_or(3)).unwrap_or(3))
}

/// CPU milliseconds of this process so far, or of its children that have ended.
fn cpu(of: UsageWho) -> f64 {
    let usage = getrusage(of).expect("the kernel counts");
    let milliseconds = |time: TimeVal| time.tv_sec() as f64 * 1e3 + time.tv_usec() as f64 / 1e3;
    milliseconds(usage.user_time()) + milliseconds(usage.system_time())
}

fn median(values: Vec<f64>) -> f64 {
    percentile(&values, 0.5)
}

/// CPU milliseconds of `work`.
fn cost<T>(work: impl FnOnce() -> T) -> f64 {
    let before = cpu(UsageWho::RUSAGE_SELF);
    std::hint::black_box(work());
    cpu(UsageWho::RUSAGE_SELF) - before
}

/// Medians of a whole grading and of the bare driver's part of it, in CPU milliseconds, taken in turns.
pub fn grade_and_bare(shaders: &[Submission]) -> (f64, f64) {
    let assignment = reference::assignment("ggsample06").expect("the assignment");
    let mut grader = Grader::open(assignment.clone(), AdapterKind::Software).expect("a grader");
    let bare = Bare::open();
    let (mut grades, mut bares) = (Vec::new(), Vec::new());
    // The first two of each warm the device.
    for (index, shader) in shaders[..2].iter().chain(shaders).enumerate() {
        let Some(stage) = Stage::of(shader) else { continue };
        let bare = cost(|| bare.run(&stage));
        let grade =
            cost(|| grader.grade(&HandIn::of_one(&shader.name, shader.text.as_bytes()), ORDER).expect("a grade"));
        if index >= 2 {
            bares.push(bare);
            grades.push(grade);
        }
    }
    assert!(bares.len() * 2 >= shaders.len(), "only {} of {} are comparable", bares.len(), shaders.len());
    (median(grades), median(bares))
}

fn start() -> Pool {
    // A busy machine slows what is measured by the clock, and is to end nothing.
    let deadline = Duration::from_secs(60);
    let settings = Settings {
        program: Some(program()),
        deadline,
        ..Settings::new(reference::assignment("ggsample06").expect("the assignment").clone())
    };
    let pool = Pool::start(settings, WORKERS).and_then(|pool| pool.warm().map(|()| pool));
    pool.unwrap_or_else(|fault| panic!("{}", fault.message.en))
}

/// ggrade itself.
pub fn program() -> std::path::PathBuf {
    env!("CARGO_BIN_EXE_ggrade").into()
}

/// A command with the environment that this program was started with, not the driver's settings.
pub fn clean(program: impl AsRef<std::ffi::OsStr>) -> Command {
    let mut command = Command::new(program);
    command.env_remove(MARK);
    for (name, _) in sandbox::driver_settings(AdapterKind::Software) {
        command.env_remove(name);
    }
    command
}

/// The value that so great a part of `values` is not above.
pub fn percentile(values: &[f64], part: f64) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let place = (part * sorted.len() as f64).ceil() as usize;
    sorted.get(place.saturating_sub(1)).copied().unwrap_or(f64::NAN)
}

/// Grades all, on as many threads as there are workers, and calls `after` with the number that are done.
fn grade_all(pool: &Pool, submissions: &[Submission], count: usize, after: impl Fn(usize) + Sync) {
    let next = AtomicUsize::new(0);
    std::thread::scope(|scope| {
        for _ in 0..WORKERS {
            scope.spawn(|| {
                loop {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    if index >= count {
                        break;
                    }
                    let Submission { name, text } = &submissions[index % submissions.len()];
                    let submission = sandbox::GradingTask {
                        assignment: pool.assignment(),
                        hand_in: &HandIn::of_one(name, text.as_bytes()),
                        order: ORDER,
                        wants_frames: false,
                    };
                    pool.grade(submission).unwrap_or_else(|fault| panic!("{name}: {}", fault.message.en));
                    after(index + 1);
                }
            });
        }
    });
}

/// What a class costs.
pub struct Pooled {
    /// CPU milliseconds of all processes, start and end of the workers included.
    pub cpu: f64,
    /// Those of the parent alone.
    pub parent: f64,
    /// Seconds from the first submission to the last report.
    pub wall: f64,
}

/// Grades a class in the pool.
pub fn pool(submissions: &[Submission]) -> Pooled {
    let all = || cpu(UsageWho::RUSAGE_SELF) + cpu(UsageWho::RUSAGE_CHILDREN);
    let before = all();
    let pool = start();
    let (began, parent) = (Instant::now(), cpu(UsageWho::RUSAGE_SELF));
    grade_all(&pool, submissions, submissions.len(), |_| {});
    let wall = began.elapsed().as_secs_f64();
    let parent = cpu(UsageWho::RUSAGE_SELF) - parent;
    // A child's time counts once it has ended.
    drop(pool);
    Pooled { cpu: all() - before, parent, wall }
}

/// Median milliseconds from the start of `ggrade grade FILE` to its end, by the clock.
pub fn command(submissions: &[Submission]) -> f64 {
    let folder = tempfile::tempdir().expect("a folder");
    let times = submissions.iter().map(|submission| {
        let file = folder.path().join(&submission.name);
        std::fs::write(&file, &submission.text).expect("a file");
        let began = Instant::now();
        let output = clean(program()).arg("grade").arg(&file).output().expect("ggrade starts");
        assert!(matches!(output.status.code(), Some(0 | 1)), "{}", String::from_utf8_lossy(&output.stderr));
        began.elapsed().as_secs_f64() * 1e3
    });
    median(times.collect())
}

/// Memory of parent and workers.
pub struct Memory {
    /// The most that is resident at any time, in MiB: of the parent and the two largest workers.
    pub most: f64,
    /// The same with the worker that is kept ready.
    pub with_spare: f64,
    /// The same where a page that several processes share counts once; none where the kernel does not tell who asks.
    pub shared_once: Option<f64>,
    /// That of the last tenth as a multiple of that of the second tenth.
    pub growth: f64,
}

/// Watches the memory of parent and workers over `count` gradings.
pub fn memory(submissions: &[Submission], count: usize) -> Memory {
    let pool = start();
    let readings = std::sync::Mutex::new(Vec::new());
    let step = (count / 200).max(1);
    grade_all(&pool, submissions, count, |done| {
        if done % step == 0 {
            let children = children();
            let mut workers: Vec<f64> = children.iter().map(|process| resident(process)).collect();
            workers.sort_by(f64::total_cmp);
            let parent = resident("self");
            let all = parent + workers.iter().sum::<f64>();
            let two = parent + workers.iter().rev().take(WORKERS).sum::<f64>();
            let processes = children.iter().map(String::as_str).chain(["self"]);
            let shares = processes.map(share).collect::<Option<Vec<f64>>>();
            let shared_once = shares.map(|shares| shares.iter().sum::<f64>());
            readings.lock().expect("no thread panicked").push((done, two, all, shared_once));
        }
    });
    let readings = readings.into_inner().expect("no thread panicked");
    let mean = |from: usize, to: usize| {
        let these: Vec<f64> =
            readings.iter().filter(|(done, ..)| (from..=to).contains(done)).map(|(_, two, ..)| *two).collect();
        these.iter().sum::<f64>() / these.len().max(1) as f64
    };
    let most = readings.iter().map(|(_, two, ..)| *two).fold(0.0, f64::max);
    let with_spare = readings.iter().map(|(_, _, all, _)| *all).fold(0.0, f64::max);
    // A worker that ends while it is looked at has no figure.
    let shared_once = readings.iter().filter_map(|(.., shared_once)| *shared_once).reduce(f64::max);
    let growth = mean(count - count / 10, count) / mean(count / 10, count / 5);
    Memory { most, with_spare, shared_once, growth }
}

/// Resident MiB of a process.
fn resident(process: &str) -> f64 {
    mebibytes(process, "status", "VmRSS:").unwrap_or(0.0)
}

/// MiB of a process where a page that so many processes have counts as so manieth part for each. Only root may ask of a worker.
fn share(process: &str) -> Option<f64> {
    mebibytes(process, "smaps_rollup", "Pss:")
}

fn mebibytes(process: &str, file: &str, name: &str) -> Option<f64> {
    let text = std::fs::read_to_string(format!("/proc/{process}/{file}")).ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix(name))?;
    Some(line.trim().trim_end_matches(" kB").parse::<f64>().ok()? / 1024.0)
}

/// Each process that this one started.
fn children() -> Vec<String> {
    let tasks = std::fs::read_dir("/proc/self/task").into_iter().flatten().flatten();
    let lists = tasks.filter_map(|task| std::fs::read_to_string(task.path().join("children")).ok());
    lists.flat_map(|list| list.split_whitespace().map(str::to_owned).collect::<Vec<_>>()).collect()
}

/// How many times the cost of a grading a script with one OpenGL context a file has, where one is named: the command
/// `GGRADE_BENCH_SCRIPT` is called as `COMMAND FILE --out FOLDER --poses 25`.
pub fn script(submissions: &[Submission], grade: f64) -> Option<f64> {
    let command = std::env::var("GGRADE_BENCH_SCRIPT").ok()?;
    let mut words = command.split_whitespace();
    let program = words.next()?;
    let words: Vec<&str> = words.collect();
    let folder = tempfile::tempdir().expect("a folder");
    let before = cpu(UsageWho::RUSAGE_CHILDREN);
    for submission in submissions {
        let file = folder.path().join(&submission.name);
        std::fs::write(&file, &submission.text).expect("a file");
        let mut script = clean(program);
        script.args(&words).arg(&file).arg("--out").arg(folder.path().join("out")).args(["--poses", "25"]);
        let status = script.stdout(Stdio::null()).stderr(Stdio::null()).status();
        assert!(status.is_ok_and(|status| status.success()), "{command} {}", submission.name);
    }
    Some((cpu(UsageWho::RUSAGE_CHILDREN) - before) / submissions.len() as f64 / grade)
}
