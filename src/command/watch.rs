//! `ggrade watch FILE…`: a report for every save, for a student at their desk.
//!
//! [`super::saves`] tells when a file was saved, [`change`] what a save changed, [`screen`] shows it. One pool with one warm
//! worker grades all of them, with the same seed, so that a changed score comes from the files.

mod change;
mod screen;

use super::end_signals::EndSignals;
use super::saves::{self, Save, Saves};
use super::view::{ReportView, has_colour};
use super::{ExitStatus, deadline, files, language, warn};
use crate::cli::{ViewFormat, WatchArguments};
use crate::fault::Fault;
use crate::grade::Order;
use crate::hand_in::HandIn;
use crate::intake::{self, HandInContent, IntakeOptions};
use crate::language::{Language, Text};
use crate::report::{Report, Verdict};
use crate::sandbox::{GradingTask, Pool, Settings};
use screen::WatchScreen;
use std::sync::Arc;

/// Grades the hand-in whenever a file of it is saved, until it is interrupted; then the last report says how it ends.
pub fn run(arguments: &WatchArguments) -> Result<ExitStatus, Fault> {
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build().map_err(|e| broken(&e))?;
    let outcome = runtime.block_on(watch(arguments));
    // A grading that is under way ends with its worker, and the worker with this process.
    runtime.shutdown_background();
    outcome
}

async fn watch(arguments: &WatchArguments) -> Result<ExitStatus, Fault> {
    let mut ends = EndSignals::listen().map_err(|error| broken(&error))?;
    let language = language(arguments.lang);
    let Some(deadline) = deadline(arguments.deadline, language) else { return Ok(ExitStatus::Usage) };
    for path in &arguments.files {
        if let Err(error) = std::fs::File::open(path) {
            anstream::eprintln!("ggrade: {}", files::unreadable(path, &error).get(language));
            return Ok(ExitStatus::Nothing);
        }
    }
    let asked = arguments.machine.assignment.as_deref();
    let Some(assignment) = super::assignment(asked, &arguments.files, language) else { return Ok(ExitStatus::Usage) };
    let mut saves = Saves::of(&arguments.files);
    let settings = Settings { adapter: arguments.machine.adapter, deadline, ..Settings::new(Arc::clone(&assignment)) };
    // The spare is for the save after an endless loop, which costs a worker.
    let pool = Arc::new(Pool::start(arguments.sandbox.apply(settings), 1)?);
    warn(&pool, language);
    let mut session = WatchSession {
        pool,
        options: IntakeOptions::new(&assignment),
        order: Order {
            seed: arguments.seed.unwrap_or_else(crate::grade::random_seed),
            hints: arguments.hints,
            ..Order::default()
        },
        language,
        screen: WatchScreen::new(saves.name(), language),
        last: None,
        outcome: ExitStatus::Nothing,
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

/// What goes on between the saves.
struct WatchSession {
    pool: Arc<Pool>,
    options: IntakeOptions,
    order: Order,
    language: Language,
    screen: WatchScreen,
    /// The report before the next.
    last: Option<Report>,
    outcome: ExitStatus,
}

impl WatchSession {
    /// Waits for the next save and shows its report.
    async fn next(&mut self, saves: &mut Saves) {
        let given = match saves.next().await {
            Save::Content(given) => given,
            Save::Gone => return self.screen.note(&saves::gone(saves.name())),
            Save::Unreadable(reason) => return self.screen.note(&reason),
        };
        let hand_in = match intake::one(given, &self.options) {
            HandInContent::Files { hand_in, .. } => hand_in,
            HandInContent::Nothing(why) => return self.screen.note(&why),
        };
        let (pool, order) = (Arc::clone(&self.pool), self.order);
        let graded = tokio::task::spawn_blocking(move || {
            let assignment = pool.assignment();
            let answer = pool.grade(GradingTask { assignment, hand_in: &hand_in, order, wants_frames: false });
            (answer, hand_in)
        });
        let (answer, hand_in) = match graded.await {
            Ok(graded) => graded,
            Err(error) => return self.fault(&broken(&error)),
        };
        // A report on what is no longer in the file helps nobody: the latest save wins.
        if saves.is_outdated() {
            return;
        }
        match answer {
            Ok(answer) => self.show(answer.report, &hand_in),
            Err(fault) => self.fault(&fault),
        }
    }

    fn show(&mut self, report: Report, hand_in: &HandIn) {
        let sources = hand_in.readable();
        let assignment = self.pool.assignment();
        let view =
            ReportView { assignment, report: &report, sources: &sources, pictures: None, language: self.language };
        match view.document(ViewFormat::Text, has_colour()) {
            Ok(document) => {
                let change = self
                    .last
                    .as_ref()
                    .map(|last| change::between(assignment, &last.for_student(), &report.for_student()));
                self.screen.report(&document, change.as_ref().map(|change| change.get(self.language)));
                let is_correct = report.verdict == Verdict::Correct;
                self.outcome = if is_correct { ExitStatus::FullMarks } else { ExitStatus::Graded };
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
