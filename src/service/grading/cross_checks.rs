//! Second opinions while nobody waits: what the driver drew is held against what the interpreter computes, for the teacher.
//!
//! The report stands before this begins, and no grading waits for it: it runs one file at a time, in the worker that
//! draws pictures for who looks at reports, and only when nobody has waited for a grading for a second. What it meets is
//! the student's text, so it runs in a worker like a grading, under the same deadline.

use crate::fault::Fault;
use crate::grade::Order;
use crate::hand_in::HandIn;
use crate::language::Text;
use crate::report::{CrossCheck, Opinion, Report};
use crate::sandbox;
use crate::service::store::{StoreError, Submission, Via, word};
use crate::service::{Service, State, courses, metrics};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;
use tokio::sync::{Mutex, mpsc};

/// How long nobody must have waited for a grading.
const QUIET: Duration = Duration::from_secs(1);
/// How often that is asked.
const LOOK: Duration = Duration::from_millis(200);
/// How often the database is asked for reports of other processes, which nobody here told of.
const OTHERS: Duration = Duration::from_secs(60);
/// Pause after the database failed.
const PAUSE: Duration = Duration::from_secs(5);
/// Reports that are taken from the database at once.
const PAGE: u32 = 64;
/// Submissions that are remembered; of more, the database knows.
const REMEMBERED: usize = 1024;

/// The submissions whose second opinion is still to come.
#[derive(Debug)]
pub struct CrossChecks {
    sender: mpsc::Sender<String>,
    receiver: Mutex<mpsc::Receiver<String>>,
    /// Whether the database may have reports that nobody told of.
    more: AtomicBool,
}

impl Default for CrossChecks {
    fn default() -> Self {
        let (sender, receiver) = mpsc::channel(REMEMBERED);
        Self { sender, receiver: Mutex::new(receiver), more: AtomicBool::new(true) }
    }
}

impl CrossChecks {
    /// Tells of a report that is stored.
    pub fn expect(&self, submission: &Submission, report: &Report) {
        let is_drawn = report.verdict.is_drawn();
        if is_drawn && submission.via != Via::Editor && self.sender.try_send(submission.id.clone()).is_err() {
            self.look();
        }
    }

    /// Tells that reports have come which nobody names.
    pub fn look(&self) {
        self.more.store(true, Ordering::Relaxed);
        // Whoever waits for an id wakes up by an empty one; where there is no room, nobody waits.
        let _ = self.sender.try_send(String::new());
    }
}

/// Runs until the service is told to end.
pub(super) async fn run(service: Service) {
    let Ok(mut receiver) = service.cross_checks.receiver.try_lock() else { return };
    loop {
        let id = tokio::select! {
            id = next(&service, &mut receiver) => id,
            () = service.ended() => return,
        };
        match id {
            Ok(id) => {
                quiet(&service).await;
                if service.is_ending() {
                    return;
                }
                if let Err(error) = check(&service, &id).await {
                    tracing::error!(%error, submission = id, "a second opinion could not be stored");
                    tokio::time::sleep(PAUSE).await;
                }
            }
            Err(error) => {
                tracing::error!(%error, "no report could be read for a second opinion");
                tokio::time::sleep(PAUSE).await;
            }
        }
    }
}

/// The next submission; waits until there is one.
async fn next(service: &Service, receiver: &mut mpsc::Receiver<String>) -> Result<String, StoreError> {
    let checks = &service.cross_checks;
    loop {
        match receiver.try_recv() {
            Ok(id) if !id.is_empty() => return Ok(id),
            Ok(_) => continue,
            Err(_) => {}
        }
        if checks.more.swap(false, Ordering::Relaxed) {
            for course in service.everywhere() {
                for assignment in course.ids() {
                    let found =
                        course.store.not_cross_checked(&assignment, PAGE).await.inspect_err(|_| checks.look())?;
                    // A full page may not be all.
                    checks.more.fetch_or(found.len() == PAGE as usize, Ordering::Relaxed);
                    found.into_iter().for_each(|id| drop(checks.sender.try_send(id)));
                }
            }
            continue;
        }
        // The sender lives as long as this service.
        match tokio::time::timeout(OTHERS, receiver.recv()).await {
            Ok(Some(id)) if !id.is_empty() => return Ok(id),
            Ok(_) => {}
            Err(_) => checks.more.store(!service.store.is_exclusive(), Ordering::Relaxed),
        }
    }
}

/// Waits until nobody has waited for a grading for a while.
async fn quiet(service: &Service) {
    while !service.queue.is_quiet(QUIET) && !service.is_ending() {
        tokio::time::sleep(LOOK).await;
    }
}

async fn check(service: &Service, id: &str) -> Result<(), StoreError> {
    let Some((service, stored)) = courses::holding(service, id).await? else { return Ok(()) };
    if stored.cross_check.is_some() || stored.report.is_none() {
        return Ok(());
    }
    let submission = stored.submission;
    let Some(hand_in) = service.store.hand_in(id).await? else { return Ok(()) };
    // Of a homework that is not served any more, nothing is run.
    let Some(state) = service.homework(&submission.assignment) else { return Ok(()) };
    let checked = cross_check(&state, &submission, hand_in).await;
    service.store.set_cross_check(id, submission.seed, &checked).await?;
    metrics::cross_checked(&submission, checked.opinion);
    if checked.opinion == Opinion::Differs {
        tracing::warn!(submission = id, vertices = checked.differing, "driver and interpreter disagree");
    }
    Ok(())
}

/// Runs the file once more with the interpreter beside the driver.
async fn cross_check(state: &State, submission: &Submission, hand_in: HandIn) -> CrossCheck {
    let order = Order { seed: submission.seed, hints: submission.hints, cross_check: true };
    let graded = state.gallery.in_turn(state, move |state| {
        let assignment = &state.assignment;
        let submission = sandbox::GradingTask { assignment, hand_in: &hand_in, order, wants_frames: false };
        Ok(state.pool.grade(submission).map(|answer| answer.report))
    });
    match graded.await {
        Ok(Ok(Report { cross_check: Some(checked), .. })) => checked,
        // Time ran out, or the worker ended: the report stands all the same.
        Ok(Ok(report)) => {
            let verdict = word(&report.verdict);
            let why = Text::new(
                format!("its second run ended as {verdict}"),
                format!("2 回目の実行の結果が {verdict} でした"),
            );
            CrossCheck::not_run(why, None)
        }
        Ok(Err(Fault { message, .. })) => CrossCheck::not_run(message, None),
        Err(problem) => CrossCheck::not_run(problem.detail, None),
    }
}
