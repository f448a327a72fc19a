//! The graders: one task for each file that is graded at once.

use super::{GradingResult, cross_checks, news};
use crate::fault::Fault;
use crate::grade::Order;
use crate::hand_in::HandIn;
use crate::language::Text;
use crate::report::Report;
use crate::sandbox;
use crate::service::clock::{Millis, millis};
use crate::service::store::{Claimed, News, Priority, StoreError, Submission};
use crate::service::{Config, Service, State, folders, metrics};
use reference::Assignment;
use std::sync::Arc;
use std::time::{Duration, Instant};
use tokio::sync::Notify;
use tokio::task::JoinSet;

/// How often graders look for files that nobody tells of: those of processes that have gone, and those that failed.
const LOOK: Duration = Duration::from_secs(2);

/// Pause after the database failed.
const PAUSE: Duration = Duration::from_millis(500);

/// The running graders.
#[derive(Debug)]
pub struct Graders {
    service: Service,
    tasks: JoinSet<()>,
}

impl Graders {
    /// Starts them, and takes over what earlier processes left.
    pub async fn start(service: &Service) -> Result<Self, StoreError> {
        take_over(service).await?;
        let workers = service.config.workers;
        service.queue.set_workers(workers);
        let mut tasks = JoinSet::new();
        tasks.spawn(news::hear(service.clone()));
        if !service.config.role.grades() {
            return Ok(Self { service: service.clone(), tasks });
        }
        for _ in 0..workers {
            tasks.spawn(run(service.clone()));
        }
        tasks.spawn(keep_claims(service.clone()));
        if service.config.cross_check {
            tasks.spawn(cross_checks::run(service.clone()));
        }
        Ok(Self { service: service.clone(), tasks })
    }

    /// Lets the files under way be finished and leaves the rest to whoever comes next. [`Service::end`] comes before.
    pub async fn finish(mut self) {
        while self.tasks.join_next().await.is_some() {}
        for course in self.service.everywhere() {
            if let Err(error) = course.store.release_claims(Some(&course.instance)).await {
                tracing::error!(%error, "claims are left to end by themselves");
            }
        }
    }
}

/// Takes over what earlier processes left of a course.
pub(in crate::service) async fn take_over(course: &Service) -> Result<(), StoreError> {
    if course.store.is_exclusive() {
        let left = course.store.release_claims(None).await?;
        if left > 0 {
            tracing::info!(files = left, "taking over what was not graded");
        }
    }
    // What failed by a fault of the machine or of an earlier version may succeed now.
    course.store.retry_failed(course.clock.now()).await?;
    Ok(())
}

async fn run(service: Service) {
    // Which course is asked first: each in turn, so that none waits for another one's whole queue.
    let mut turn = 0;
    // Gradings that take long go on beside the next ones.
    let mut overtime = JoinSet::new();
    while !service.is_ending() {
        let woken = service.queue.wakes.notified();
        turn += 1;
        while overtime.try_join_next().is_some() {}
        match take_anywhere(&service, turn, &mut overtime).await {
            Ok(true) => continue,
            Ok(false) => {}
            Err(error) => {
                tracing::error!(%error, "no file could be claimed");
                tokio::time::sleep(PAUSE).await;
                continue;
            }
        }
        tokio::select! {
            () = woken => {}
            () = service.ended() => {}
            () = tokio::time::sleep(LOOK) => {}
        }
    }
    while overtime.join_next().await.is_some() {}
}

/// Grades one file of any course; whether there was one.
async fn take_anywhere(service: &Service, turn: usize, overtime: &mut JoinSet<()>) -> Result<bool, StoreError> {
    let mut courses = service.everywhere();
    let first = turn % courses.len();
    courses.rotate_left(first);
    for course in courses {
        if take(&course, overtime).await? {
            return Ok(true);
        }
    }
    Ok(false)
}

/// Grades one file that nobody holds, or one that is to be graded again; whether there was one. A grading that takes long is
/// left to `overtime`.
async fn take(service: &Service, overtime: &mut JoinSet<()>) -> Result<bool, StoreError> {
    let (now, until) = lease(service);
    if let Some((claimed, is_suspect)) = claim(service, now, until).await? {
        // Where there was one there may be more, and one wake may have stood for several.
        service.queue.wakes.notify_one();
        let passed = Arc::new(Notify::new());
        let mut grading = Box::pin(grade(service.clone(), claimed, is_suspect, now, Arc::clone(&passed)));
        tokio::select! {
            () = &mut grading => {}
            () = passed.notified() => drop(overtime.spawn(grading)),
        }
        return Ok(true);
    }
    let Some(again) = service.store.claim_again(&served(&service.ids()), &service.instance, now, until).await? else {
        return Ok(false);
    };
    service.queue.wakes.notify_one();
    let id = again.submission.id.clone();
    let judged = match again.folder {
        None => judge(service, again.submission, again.hand_in, None).await,
        Some(folder) => match folders::read(service, &folder).await {
            Ok(assignment) => judge_by(service, assignment, again.submission, again.hand_in, None).await,
            Err(problem) => Err(Fault::new(problem.detail)),
        },
    };
    if let Err(fault) = &judged {
        tracing::error!(fault = kind_of(fault), submission = id, "grading again failed");
    }
    // As with a first grading: a claim that is kept up must come to an end.
    while let Err(error) = service.store.finish_again(&again.regrading_id, &id, judged.as_ref().ok()).await {
        tracing::error!(%error, submission = id, "a report could not be stored");
        if service.is_ending() {
            break;
        }
        tokio::time::sleep(PAUSE).await;
    }
    Ok(true)
}

fn served(ids: &[String]) -> Vec<&str> {
    ids.iter().map(String::as_str).collect()
}

/// Claims what is next, and says whether the grader counts among those that hold a suspect file: files that take the whole
/// deadline never hold all graders.
async fn claim(service: &Service, now: Millis, until: Millis) -> Result<Option<(Claimed, bool)>, StoreError> {
    let with_suspects = service.queue.enter_suspects();
    let but = (!with_suspects).then_some(Priority::Suspect);
    let claimed = service.store.claim(&served(&service.ids()), but, &service.instance, now, until).await;
    let is_suspect = matches!(&claimed, Ok(Some(claimed)) if claimed.is_suspect);
    if with_suspects && !is_suspect {
        service.queue.leave_suspects();
    }
    Ok(claimed?.map(|claimed| (claimed, is_suspect)))
}

/// Now, and when a claim made now ends.
fn lease(service: &Service) -> (Millis, Millis) {
    let now = service.clock.now();
    (now, now + millis(Config::span(service.config.limits.lease)))
}

/// Keeps the claims of this process from ending while their files wait.
async fn keep_claims(service: Service) {
    let lease = Config::span(service.config.limits.lease);
    loop {
        tokio::select! {
            () = tokio::time::sleep(lease / 3) => {}
            () = service.ended() => return,
        }
        let until = service.clock.now() + millis(lease);
        for course in service.everywhere() {
            if let Err(error) = course.store.extend_claims(&course.instance, until).await {
                tracing::error!(%error, "claims could not be extended");
            }
        }
    }
}

async fn grade(service: Service, claimed: Claimed, is_suspect: bool, now: Millis, passed: Arc<Notify>) {
    grade_and_tell(&service, claimed, now, passed).await;
    if is_suspect {
        service.queue.leave_suspects();
    }
}

async fn grade_and_tell(service: &Service, claimed: Claimed, now: Millis, passed: Arc<Notify>) {
    let start = Instant::now();
    service.queue.begin();
    let submission = claimed.submission.clone();
    metrics::stage("wait", Duration::from_millis((now - submission.received_at).max(0).unsigned_abs()));
    let judged = match claimed.is_given_up {
        true => Err(given_up()),
        false => judge(service, claimed.submission, claimed.hand_in, Some(passed)).await,
    };
    metrics::stage("grade", start.elapsed());
    let stored = Instant::now();
    let outcome = keep(service, &submission, judged).await;
    metrics::stage("store", stored.elapsed());
    metrics::graded(&submission, outcome.as_ref());
    service.queue.end(start.elapsed());
    let Some(outcome) = outcome else { return };
    if let GradingResult::Graded(report) = &outcome {
        service.cross_checks.expect(&submission, report);
    }
    service.queue.tell(&submission.id, outcome);
    news::tell(service, &News::Finished(submission.id)).await;
}

/// What is said of a file whose graders have ended again and again.
fn given_up() -> Fault {
    Fault::new(Text::new(
        "every process that began to grade this file has ended",
        "このファイルの採点を始めたプロセスが毎回終了しました",
    ))
}

/// Grades by the folder that is served. `passed` is notified where the file takes so long that another one has got its place.
async fn judge(
    service: &Service,
    submission: Submission,
    hand_in: HandIn,
    passed: Option<Arc<Notify>>,
) -> Result<Report, Fault> {
    let not_served = || Fault::new(Text::verbatim("a claimed file is of no homework that is served"));
    let State { assignment, .. } = service.homework(&submission.assignment).ok_or_else(not_served)?;
    judge_by(service, assignment, submission, hand_in, passed).await
}

/// Grades by a version of the homework's folder.
async fn judge_by(
    service: &Service,
    assignment: Arc<Assignment>,
    submission: Submission,
    hand_in: HandIn,
    passed: Option<Arc<Notify>>,
) -> Result<Report, Fault> {
    let pool = Arc::clone(&service.pool);
    let graded = tokio::task::spawn_blocking(move || {
        let Submission { seed, hints, .. } = submission;
        let order = Order { seed, hints, ..Order::default() };
        let task = sandbox::GradingTask { assignment: &assignment, hand_in: &hand_in, order, wants_frames: false };
        pool.grade_or_let_pass(task, &mut || passed.iter().for_each(|passed| passed.notify_one()))
    });
    match graded.await {
        Ok(answer) => answer.map(|answer| answer.report),
        Err(panic) => Err(Fault::new(Text::verbatim(panic.to_string()))),
    }
}

/// Stores what came of a grading, however long the database does not answer: until then nothing else is graded here.
/// When the service ends before, the claim ends with it, and the file is graded again.
async fn keep(service: &Service, submission: &Submission, judged: Result<Report, Fault>) -> Option<GradingResult> {
    if let Err(fault) = &judged {
        tracing::error!(fault = kind_of(fault), submission = submission.id, "grading failed");
    }
    loop {
        let now = service.clock.now();
        let kept = match &judged {
            Ok(report) => service.store.finish(&submission.id, report, now).await.map(drop),
            Err(fault) => service.store.fail(&submission.id, fault, now).await,
        };
        match kept {
            Ok(()) => break,
            Err(error) => tracing::error!(%error, submission = submission.id, "a report could not be stored"),
        }
        if service.is_ending() {
            return None;
        }
        tokio::time::sleep(PAUSE).await;
    }
    Some(match judged {
        Ok(report) => GradingResult::Graded(Arc::new(report)),
        Err(fault) => GradingResult::Failed(Arc::new(fault)),
    })
}

/// What a fault says of itself. What follows the colon may quote the file, which the log must not; the database has it.
fn kind_of(fault: &Fault) -> &str {
    fault.message.en.split(':').next().unwrap_or_default()
}
