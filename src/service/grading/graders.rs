//! The graders: one task for each file that is graded at once.

use super::{Job, Outcome, cross_checks};
use crate::fault::Fault;
use crate::grade::Order;
use crate::language::Text;
use crate::report::Report;
use crate::sandbox;
use crate::service::clock::{Millis, millis};
use crate::service::store::{StoreError, Submission};
use crate::service::{Config, State, metrics};
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};
use tokio::task::JoinSet;

/// How often graders look for files that nobody told them of: those of processes that have gone.
const LOOK: Duration = Duration::from_secs(2);

/// Pause after the database failed.
const PAUSE: Duration = Duration::from_millis(500);

/// The running graders.
#[derive(Debug)]
pub struct Graders {
    state: State,
    tasks: JoinSet<()>,
}

impl Graders {
    /// Starts them, and takes over what earlier processes left.
    pub async fn start(state: &State) -> Result<Self, StoreError> {
        if state.store.is_exclusive() {
            let left = state.store.release_claims(None).await?;
            if left > 0 {
                tracing::info!(files = left, "taking over what was not graded");
            }
        }
        // What failed by a fault of the machine or of an earlier version may succeed now.
        state.store.retry_failed().await?;
        let workers = state.config.workers;
        state.queue.set_workers(workers);
        let mut tasks = JoinSet::new();
        for _ in 0..workers {
            tasks.spawn(run(state.clone()));
        }
        tasks.spawn(keep_claims(state.clone()));
        if state.config.cross_check {
            tasks.spawn(cross_checks::run(state.clone()));
        }
        Ok(Self { state: state.clone(), tasks })
    }

    /// Lets the files under way be finished and leaves the rest to whoever comes next. [`State::end`] comes before.
    pub async fn finish(mut self) {
        while self.tasks.join_next().await.is_some() {}
        if let Err(error) = self.state.store.release_claims(Some(&self.state.instance)).await {
            tracing::error!(%error, "claims are left to end by themselves");
        }
    }
}

async fn run(state: State) {
    while !state.is_ending() {
        let woken = state.queue.wakes.notified();
        if let Some(job) = state.queue.next() {
            grade(&state, job).await;
            continue;
        }
        if state.queue.more.load(Ordering::Relaxed) {
            match take_from_database(&state).await {
                Ok(true) => continue,
                Ok(false) => state.queue.more.store(false, Ordering::Relaxed),
                Err(error) => {
                    tracing::error!(%error, "no file could be claimed");
                    tokio::time::sleep(PAUSE).await;
                    continue;
                }
            }
        }
        tokio::select! {
            () = woken => {}
            () = state.ended() => {}
            () = tokio::time::sleep(LOOK) => state.queue.more.store(true, Ordering::Relaxed),
        }
    }
}

/// Grades one file that nobody holds, or one that is to be graded again; whether there was one.
async fn take_from_database(state: &State) -> Result<bool, StoreError> {
    if let Some(job) = claim(state).await? {
        state.queue.begin();
        grade(state, job).await;
        return Ok(true);
    }
    let (now, until) = lease(state);
    let Some(again) = state.store.claim_again(&state.instance, now, until).await? else { return Ok(false) };
    let id = again.submission.id.clone();
    let judged =
        judge(state, Job { submission: again.submission, hand_in: again.hand_in, since: Instant::now() }).await;
    if let Err(fault) = &judged {
        tracing::error!(fault = kind_of(fault), submission = id, "grading again failed");
    }
    // As with a first grading: a claim that is kept up must come to an end.
    while let Err(error) = state.store.finish_again(&again.regrading_id, &id, judged.as_ref().ok()).await {
        tracing::error!(%error, submission = id, "a report could not be stored");
        if state.is_ending() {
            break;
        }
        tokio::time::sleep(PAUSE).await;
    }
    Ok(true)
}

/// Now, and when a claim made now ends.
fn lease(state: &State) -> (Millis, Millis) {
    let now = state.clock.now();
    (now, now + millis(Config::span(state.config.limits.lease)))
}

async fn claim(state: &State) -> Result<Option<Job>, StoreError> {
    let (now, until) = lease(state);
    let claimed = state.store.claim(&state.instance, now, until).await?;
    Ok(claimed.map(|claimed| Job { submission: claimed.submission, hand_in: claimed.hand_in, since: Instant::now() }))
}

/// Keeps the claims of this process from ending while their files wait.
async fn keep_claims(state: State) {
    let lease = Config::span(state.config.limits.lease);
    loop {
        tokio::select! {
            () = tokio::time::sleep(lease / 3) => {}
            () = state.ended() => return,
        }
        let until = state.clock.now() + millis(lease);
        if let Err(error) = state.store.extend_claims(&state.instance, until).await {
            tracing::error!(%error, "claims could not be extended");
        }
    }
}

async fn grade(state: &State, job: Job) {
    let start = Instant::now();
    let submission = job.submission.clone();
    metrics::stage("wait", job.since.elapsed());
    let judged = judge(state, job).await;
    metrics::stage("grade", start.elapsed());
    let stored = Instant::now();
    let outcome = keep(state, &submission, judged).await;
    metrics::stage("store", stored.elapsed());
    metrics::graded(&submission, outcome.as_ref());
    if let Some(Outcome::Graded(report)) = &outcome {
        state.cross_checks.expect(&submission, report);
    }
    state.queue.done(&submission.id, outcome, start.elapsed());
}

async fn judge(state: &State, job: Job) -> Result<Report, Fault> {
    let (pool, assignment) = (Arc::clone(&state.pool), Arc::clone(&state.assignment));
    let graded = tokio::task::spawn_blocking(move || {
        let Submission { seed, hints, .. } = &job.submission;
        let order = Order { seed: *seed, hints: *hints, ..Order::default() };
        let hand_in = &job.hand_in;
        pool.grade(sandbox::Submission { assignment: &assignment, hand_in, order, wants_frames: false })
    });
    match graded.await {
        Ok(answer) => answer.map(|answer| answer.report),
        Err(panic) => Err(Fault::new(Text::verbatim(panic.to_string()))),
    }
}

/// Stores what came of a grading, however long the database does not answer: until then nothing else is graded here.
/// When the service ends before, the claim ends with it, and the file is graded again.
async fn keep(state: &State, submission: &Submission, judged: Result<Report, Fault>) -> Option<Outcome> {
    if let Err(fault) = &judged {
        tracing::error!(fault = kind_of(fault), submission = submission.id, "grading failed");
    }
    loop {
        let now = state.clock.now();
        let kept = match &judged {
            Ok(report) => state.store.finish(&submission.id, report, now).await.map(drop),
            Err(fault) => state.store.fail(&submission.id, fault, now).await,
        };
        match kept {
            Ok(()) => break,
            Err(error) => tracing::error!(%error, submission = submission.id, "a report could not be stored"),
        }
        if state.is_ending() {
            return None;
        }
        tokio::time::sleep(PAUSE).await;
    }
    Some(match judged {
        Ok(report) => Outcome::Graded(Arc::new(report)),
        Err(fault) => Outcome::Failed(Arc::new(fault)),
    })
}

/// What a fault says of itself. What follows the colon may quote the file, which the log must not; the database has it.
fn kind_of(fault: &Fault) -> &str {
    fault.message.en.split(':').next().unwrap_or_default()
}
