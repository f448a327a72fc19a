//! `ggrade watch FILE`: a report for every save, for a student at their desk.
//!
//! [`saves`] tells when the file was saved, [`change`] what a save changed, [`screen`] shows it. One pool with one warm
//! worker grades all of them, with the same seed, so that a changed score comes from the file.

mod change;
mod saves;
mod screen;

use super::view::{View, has_colour, readable};
use super::{Outcome, deadline, grade, language, warn};
use crate::cli::{Reading, Watch};
use crate::fault::Fault;
use crate::grade::Order;
use crate::hand_in::HandIn;
use crate::language::{Language, Text};
use crate::report::{Report, Verdict};
use crate::sandbox::{Pool, Settings, Submission};
use saves::{Save, Saves};
use screen::Screen;
use std::sync::Arc;
use tokio::signal::unix::{Signal, SignalKind, signal};

/// Grades the file whenever it is saved, until it is interrupted; then the last report says how it ends.
pub fn run(arguments: &Watch) -> Result<Outcome, Fault> {
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build().map_err(|e| broken(&e))?;
    let outcome = runtime.block_on(watch(arguments));
    // A grading that is under way ends with its worker, and the worker with this process.
    runtime.shutdown_background();
    outcome
}

async fn watch(arguments: &Watch) -> Result<Outcome, Fault> {
    let mut ends = Ends::listen().map_err(|error| broken(&error))?;
    let language = language(arguments.lang);
    let Some(deadline) = deadline(arguments.deadline) else { return Ok(Outcome::Usage) };
    if let Err(error) = std::fs::File::open(&arguments.file) {
        anstream::eprintln!("ggrade: {}", grade::unreadable(&arguments.file, &error).get(language));
        return Ok(Outcome::Nothing);
    }
    let mut saves = Saves::of(&arguments.file);
    let settings =
        Settings { adapter: arguments.machine.adapter, deadline, ..Settings::new(&arguments.machine.assignment) };
    // The spare is for the save after an endless loop, which costs a worker.
    let pool = Arc::new(Pool::start(arguments.sandbox.apply(settings), 1)?);
    warn(&pool, language);
    let mut session = Session {
        pool,
        order: Order {
            seed: arguments.seed.unwrap_or_else(crate::grade::random_seed),
            hints: arguments.hints,
            ..Order::default()
        },
        language,
        screen: Screen::new(saves.name(), language),
        last: None,
        outcome: Outcome::Nothing,
    };
    while !session.screen.is_closed() {
        tokio::select! {
            () = ends.any() => break,
            () = session.next(&mut saves) => {}
        }
    }
    session.screen.end();
    Ok(session.outcome)
}

/// The signals that end the watching.
struct Ends {
    interrupt: Signal,
    terminate: Signal,
    hang_up: Signal,
}

impl Ends {
    fn listen() -> std::io::Result<Self> {
        Ok(Self {
            interrupt: signal(SignalKind::interrupt())?,
            terminate: signal(SignalKind::terminate())?,
            hang_up: signal(SignalKind::hangup())?,
        })
    }

    async fn any(&mut self) {
        tokio::select! {
            _ = self.interrupt.recv() => {}
            _ = self.terminate.recv() => {}
            _ = self.hang_up.recv() => {}
        }
    }
}

/// What goes on between the saves.
struct Session {
    pool: Arc<Pool>,
    order: Order,
    language: Language,
    screen: Screen,
    /// The report before the next.
    last: Option<Report>,
    outcome: Outcome,
}

impl Session {
    /// Waits for the next save and shows its report.
    async fn next(&mut self, saves: &mut Saves) {
        let bytes = match saves.next().await {
            Save::Content(bytes) => bytes,
            Save::Gone => return self.screen.note(&saves::gone(saves.name())),
            Save::Unreadable(reason) => return self.screen.note(&reason),
        };
        let (pool, order, name) = (Arc::clone(&self.pool), self.order, saves.name().to_owned());
        let graded = tokio::task::spawn_blocking(move || {
            let answer =
                pool.grade(Submission { hand_in: &HandIn::of_one(name, bytes.as_slice()), order, wants_frames: false });
            (answer, bytes)
        });
        let (answer, bytes) = match graded.await {
            Ok(graded) => graded,
            Err(error) => return self.fault(&broken(&error)),
        };
        // A report on what is no longer in the file helps nobody: the latest save wins.
        if saves.is_outdated() {
            return;
        }
        match answer {
            Ok(answer) => self.show(answer.report, saves.name(), &bytes),
            Err(fault) => self.fault(&fault),
        }
    }

    fn show(&mut self, report: Report, name: &str, bytes: &[u8]) {
        let source = readable(name, bytes);
        // Neither an equation nor pictures: it is shown in a terminal.
        let view =
            View { report: &report, source: source.as_ref(), equation: None, pictures: None, language: self.language };
        match view.document(Reading::Text, has_colour()) {
            Ok(document) => {
                let change = self.last.as_ref().map(|last| change::between(&last.for_student(), &report.for_student()));
                self.screen.report(&document, change.as_ref().map(|change| change.get(self.language)));
                let is_correct = report.verdict == Verdict::Correct;
                self.outcome = if is_correct { Outcome::FullMarks } else { Outcome::Graded };
                self.last = Some(report);
            }
            Err(fault) => self.fault(&fault),
        }
    }

    /// Our own failure costs this report only: the next save may go well.
    fn fault(&mut self, fault: &Fault) {
        self.outcome = super::report_fault(fault);
    }
}

fn broken(error: &dyn std::error::Error) -> Fault {
    Fault::new(Text::new(format!("cannot watch: {error}"), format!("ファイルを見守れません: {error}")))
}
