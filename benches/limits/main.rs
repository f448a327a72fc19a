//! What a class costs, as ratios: one grading against the bare driver, the pool of workers, one command, memory.
//!
//! `script/bench` runs it, prints the table and writes it to `docs/performance.md`; `script/bench --check` holds the
//! ratios against the table that is there. How each figure is measured is said beside it, in [`table`].

mod bare;
mod class;
mod crowd;
mod machine;
mod measure;
mod queue;
mod surfaces;
mod table;

use std::process::ExitCode;
use table::{Row, Table};

/// What is measured, and how often.
#[derive(Clone, Copy, Debug)]
struct Size {
    /// Distinct shaders, for the comparison with the bare driver.
    shaders: usize,
    /// Distinct submissions of a class.
    class: usize,
    /// Gradings over which memory is watched.
    gradings: usize,
    /// Commands.
    commands: usize,
    /// Uploads.
    uploads: usize,
    /// Seconds for which a crowd is watched.
    watched: f64,
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|argument| argument != "--bench").collect();
    let has = |name: &str| arguments.iter().any(|argument| argument == name);
    if let Some(unknown) =
        arguments.iter().find(|a| !["--check", "--write", "--quick", "--queue", "--crowd"].contains(&a.as_str()))
    {
        eprintln!("unknown argument {unknown}: there are --check, --write, --quick, --queue and --crowd");
        return ExitCode::from(2);
    }
    if (has("--queue") || has("--crowd")) && has("--write") {
        eprintln!("--write takes the whole table");
        return ExitCode::from(2);
    }
    // The driver reads its settings from the environment: both sides of the comparison run with the workers' own.
    if !measure::has_driver_settings() {
        return measure::again_with_driver_settings(&arguments);
    }
    let size = if has("--quick") {
        Size { shaders: 12, class: 100, gradings: 400, commands: 5, uploads: 40, watched: 10.0 }
    } else {
        Size { shaders: 100, class: 1000, gradings: 10_000, commands: 20, uploads: 400, watched: 60.0 }
    };
    let mut machine = machine::describe();
    machine.push(format!(
        "{} shaders, classes of {} and {}, {} gradings for memory, {} commands, {} uploads, crowds for {} s",
        size.shaders,
        size.class / 4,
        size.class,
        size.gradings,
        size.commands,
        size.uploads,
        size.watched
    ));
    let rows = match () {
        () if has("--queue") => queue::rows(),
        () if has("--crowd") => crowd::rows(size.watched),
        () => rows(size),
    };
    let table = Table { machine, rows };
    print!("{}", table.text());
    if has("--check") {
        return table.check();
    }
    if has("--write") {
        return table.write();
    }
    ExitCode::SUCCESS
}

fn rows(size: Size) -> Vec<Row> {
    // Before this process itself grades anything and keeps the memory.
    let memory = measure::memory(&class::submissions(size.gradings.min(1000)), size.gradings);
    let shaders = class::right_answers(size.shaders);
    let (grade, bare) = measure::grade_and_bare(&shaders);
    let mut rows = vec![
        Row::milliseconds("bare-driver", bare),
        Row::milliseconds("grade", grade),
        Row::ratio("grade-to-bare", grade / bare, 1.5),
    ];
    let small = measure::pool(&class::submissions(size.class / 4));
    let large = measure::pool(&class::submissions(size.class));
    rows.extend([
        Row::milliseconds("pool-cpu", large.cpu / size.class as f64),
        Row::milliseconds("pool-parent-cpu", large.parent / size.class as f64),
        Row::ratio("pool-to-bare", large.cpu / size.class as f64 / bare, 1.5),
        Row::at_least("pool-rate", "submissions/s", size.class as f64 / large.wall, 100.0),
        Row::at_least("pool-rate-cpu", "submissions/s", measure::CORES * 1e3 * size.class as f64 / large.cpu, 100.0),
        Row::ratio("growth", large.cpu / small.cpu, 4.2),
    ]);
    rows.extend(on_surfaces(size));
    rows.extend(queue::rows());
    rows.extend(crowd::rows(size.watched));
    rows.push(Row::at_most("command", "ms", measure::command(&shaders[..size.commands]), 300.0));
    rows.extend([
        Row::at_most("memory", "MiB", memory.most, 400.0),
        Row::mebibytes("memory-with-spare", memory.with_spare),
        Row::ratio("memory-growth", memory.growth, 1.05),
    ]);
    rows.extend(memory.shared_once.map(|most| Row::at_most("memory-shared-once", "MiB", most, 450.0)));
    if let Some(times) = measure::script(&shaders[..size.commands], large.cpu / size.class as f64) {
        rows.push(Row::at_least("script", "times", times, 10.0));
    }
    rows
}

/// By the clock: what people wait for.
fn on_surfaces(size: Size) -> Vec<Row> {
    let (small, large) = (class::submissions(size.class / 4), class::submissions(size.class));
    let rate = |seconds: f64| size.class as f64 / seconds;
    let (quarter, whole) = (surfaces::batch(&small, "csv"), surfaces::batch(&large, "csv"));
    let pages = surfaces::batch(&large, "csv,html");
    let latency = surfaces::service(&class::submissions(size.uploads + 8));
    let [p50, p99] = [0.5, 0.99].map(|part| measure::percentile(&latency.new, part));
    vec![
        Row::at_least("batch-rate", "submissions/s", rate(whole), 100.0),
        Row::ratio("batch-growth", whole / quarter, 4.2),
        Row::rate("batch-rate-pages", rate(pages)),
        Row::at_most("upload-p50", "ms", p50, 40.0),
        Row::at_most("upload-p99", "ms", p99, 120.0),
        Row::at_most("upload-known-p50", "ms", measure::percentile(&latency.known, 0.5), 3.0),
    ]
}
