//! The table of `docs/performance.md`: what was measured, how, and whether it is within the limit.

use std::fmt::Write as _;
use std::path::PathBuf;
use std::process::ExitCode;

const START: &str = "<!-- table: limits -->\n";
const END: &str = "<!-- end of table -->";
/// How much worse than in the committed table a ratio may be: runs on a busy machine differ by a tenth.
const TOLERANCE: f64 = 1.25;

/// What each figure is.
const MEANINGS: [(&str, &str); 31] = [
    ("bare-driver", "CPU time of the bare driver for one submission, median"),
    ("grade", "CPU time of a whole grading in one process, in turns with the above"),
    ("grade-to-bare", "the one against the other"),
    ("pool-cpu", "CPU time a submission of a class in the sandbox's pool, all processes, start and end included"),
    ("pool-parent-cpu", "the parent's part of it"),
    ("pool-to-bare", "that against the bare driver"),
    ("pool-rate", "submissions a second by the clock, two workers"),
    ("pool-rate-cpu", "submissions a second that two cores have the CPU time for"),
    ("growth", "CPU time of the class against that of a quarter of it"),
    ("batch-rate", "submissions a second of `ggrade batch --formats csv`, by the clock, its start and end included"),
    ("batch-growth", "time of that against the time for a quarter of the class"),
    ("batch-rate-pages", "the same with a page for each student, `--formats csv,html`"),
    (
        "upload-p50",
        "`POST /api/v1/submissions` of a new file to a warm service until its report is there, 20 a second, median",
    ),
    ("upload-p99", "the longest but one in a hundred of these"),
    ("upload-known-p50", "the same of a file that was graded before, median"),
    ("queue-1", "gradings of 20 ms of sleep that one grader takes from PostgreSQL, 20,000 waiting"),
    ("queue-4", "the same of 4 services on one database, against that"),
    ("queue-16", "the same of 16"),
    ("queue-database", "CPU time of PostgreSQL for each of these"),
    (
        "queue-start",
        "from the end of an upload's storing to the beginning of its grading in another process that is idle, the longest but one in a hundred",
    ),
    (
        "hostile-p50",
        "how much longer 33 people wait for a report, each with a new file every 2 s, beside 17 who send the hostile samples, median",
    ),
    ("hostile-p99", "the same of the longest but one in a hundred"),
    ("hostile-busy-p50", "how much longer they wait when all send the next file as soon as a report is there, median"),
    ("hostile-busy-p99", "the same of the longest but one in a hundred"),
    ("flood-p50", "how much longer 20 people wait beside one who sends as fast as the rates allow, median"),
    ("flood-p99", "the same of the longest but one in a hundred"),
    ("command", "`ggrade grade FILE` by the clock, median"),
    ("memory", "resident memory of parent and two workers, the most at any time; what they share counts for each"),
    ("memory-with-spare", "the same with the worker that is kept ready"),
    ("memory-growth", "mean of the last tenth of the first of these against that of the second"),
    (
        "memory-shared-once",
        "memory of parent, two workers and the one that is kept ready, the most at any time; what they share counts once (`Pss`)",
    ),
];

/// One figure.
#[derive(Clone, Debug)]
pub struct Row {
    id: &'static str,
    unit: &'static str,
    value: f64,
    limit: Option<Limit>,
}

#[derive(Clone, Copy, Debug)]
enum Limit {
    AtMost(f64),
    AtLeast(f64),
}

impl Row {
    /// A cost without a limit of its own.
    pub fn milliseconds(id: &'static str, value: f64) -> Self {
        Self { id, unit: "ms", value, limit: None }
    }

    /// Submissions a second, without a limit of its own.
    pub fn rate(id: &'static str, value: f64) -> Self {
        Self { id, unit: "submissions/s", value, limit: None }
    }

    /// An amount of memory without a limit of its own.
    pub fn mebibytes(id: &'static str, value: f64) -> Self {
        Self { id, unit: "MiB", value, limit: None }
    }

    /// A ratio, which other machines have too.
    pub fn ratio(id: &'static str, value: f64, most: f64) -> Self {
        Self { id, unit: "×", value, limit: Some(Limit::AtMost(most)) }
    }

    /// What may not be more.
    pub fn at_most(id: &'static str, unit: &'static str, value: f64, most: f64) -> Self {
        Self { id, unit, value, limit: Some(Limit::AtMost(most)) }
    }

    /// What may not be less.
    pub fn at_least(id: &'static str, unit: &'static str, value: f64, least: f64) -> Self {
        Self { id, unit, value, limit: Some(Limit::AtLeast(least)) }
    }

    fn verdict(&self) -> &'static str {
        let holds = match self.limit {
            None => return "",
            Some(Limit::AtMost(most)) => self.value <= most,
            Some(Limit::AtLeast(least)) => self.value >= least,
        };
        if holds { "yes" } else { "**no**" }
    }

    fn goal(&self) -> String {
        match self.limit {
            None => String::new(),
            Some(Limit::AtMost(most)) => format!("≤ {most} {}", self.unit),
            Some(Limit::AtLeast(least)) => format!("≥ {least} {}", self.unit),
        }
    }
}

/// All of them, and the machine.
pub struct Table {
    pub machine: Vec<String>,
    pub rows: Vec<Row>,
}

impl Table {
    /// The table as it stands in the documentation.
    pub fn text(&self) -> String {
        let mut text =
            String::from("| figure | measured | goal | reached | what it is |\n| --- | --- | --- | --- | --- |\n");
        for row in &self.rows {
            let meaning = MEANINGS.iter().find(|(id, _)| *id == row.id).map_or(SCRIPT, |(_, meaning)| meaning);
            let Row { id, unit, value, .. } = row;
            // Writing to a string does not fail.
            let _ = writeln!(text, "| `{id}` | {value:.2} {unit} | {} | {} | {meaning} |", row.goal(), row.verdict());
        }
        text.push('\n');
        for line in &self.machine {
            let _ = writeln!(text, "- {line}");
        }
        text
    }

    /// Writes it to the documentation.
    pub fn write(&self) -> ExitCode {
        let (before, _, after) = committed();
        let text = format!("{before}{START}{}{END}{after}", self.text());
        match std::fs::write(path(), text) {
            Ok(()) => ExitCode::SUCCESS,
            Err(error) => {
                eprintln!("{}: {error}", path().display());
                ExitCode::from(3)
            }
        }
    }

    /// Holds the ratios against the committed ones.
    pub fn check(&self) -> ExitCode {
        let (_, table, _) = committed();
        let mut worse = false;
        for row in self.rows.iter().filter(|row| row.unit == "×") {
            let line = table.lines().find(|line| line.starts_with(&format!("| `{}` |", row.id)));
            let before = line.and_then(|line| line.split('|').nth(2)?.split_whitespace().next()?.parse::<f64>().ok());
            let Some(before) = before else {
                eprintln!("{}: not in docs/performance.md", row.id);
                worse = true;
                continue;
            };
            if row.value > before * TOLERANCE {
                eprintln!("{}: {:.2}, was {before:.2}", row.id, row.value);
                worse = true;
            }
        }
        ExitCode::from(u8::from(worse))
    }
}

const SCRIPT: &str =
    "CPU time of a Python script that renders one file in an OpenGL context of its own, against that of a grading";

fn path() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("docs/performance.md")
}

/// The documentation before, in and behind the table.
fn committed() -> (String, String, String) {
    let text = std::fs::read_to_string(path()).unwrap_or_else(|error| panic!("{}: {error}", path().display()));
    let (before, rest) = text.split_once(START).expect("the table's place");
    let (table, after) = rest.split_once(END).expect("the table's end");
    (before.to_owned(), table.to_owned(), after.to_owned())
}
