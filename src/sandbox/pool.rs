//! Workers kept warm, each submission graded by one of them.

use super::check::{self, CheckedFolder};
use super::child::Worker;
use super::drawings::Drawings;
use super::ending::{Blame, Ending};
use super::protection::Protection;
use super::protocol::{Answered, GradingRequest, Reply};
use super::roster::{Roster, WorkerKind, WorkerPermit};
use super::task::{GradedSubmission, GradingTask};
use super::{JUDGING, Policy, Settings, memory};
use crate::diagnostic::{Diagnostic, DiagnosticStage};
use crate::fault::Fault;
use crate::language::Text;
use crate::report::{Environment, Report, Verdict};
use reference::Assignment;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// How often a grading that fails by no doing of the file's is begun.
const ATTEMPTS: u32 = 3;

/// The share of the deadline that must be left for a crash to be confirmed by a second worker. A file that crashes as
/// late as that has used the time of a grading anyway.
const LEFT_TO_CONFIRM: f64 = 0.4;

/// Workers. Any number of threads may grade at once, for any assignments; each takes a worker of its own, and those for
/// whom there is none wait.
#[derive(Debug)]
pub struct Pool {
    settings: Settings,
    roster: Roster,
    next_id: AtomicU64,
    environment: Environment,
    protection: Protection,
    drawings: Drawings,
}

impl Pool {
    /// Starts a pool in which `workers` submissions are graded at once, and waits until its first worker is confined and
    /// has a device. While that one reads the assignment, submissions can come already.
    pub fn start(settings: Settings, workers: usize) -> Result<Self, Fault> {
        let (roster, environment, protection) = Roster::start(settings.clone(), workers)?;
        Ok(Self {
            settings,
            roster,
            next_id: AtomicU64::new(1),
            environment,
            protection,
            drawings: Drawings::default(),
        })
    }

    /// The assignment that every worker reads at its start.
    pub fn assignment(&self) -> &Arc<Assignment> {
        &self.settings.assignment
    }

    /// Waits until a worker has read the assignment, and nothing but a submission is missing.
    pub fn warm(&self) -> Result<(), Fault> {
        let place = self.roster.place();
        let worker = place.take(WorkerKind::Any)?;
        place.give_back(worker);
        Ok(())
    }

    /// What grades.
    pub fn environment(&self) -> &Environment {
        &self.environment
    }

    /// What holds the workers.
    pub fn protection(&self) -> &Protection {
        &self.protection
    }

    /// What is missing from the sandbox and was to be said: nothing where it is complete, or was required and closed.
    pub fn notice(&self) -> Option<Text> {
        match self.settings.policy {
            Policy::Required => None,
            Policy::BestEffort => self.protection.notice(),
        }
    }

    /// The processes of the workers that wait for a submission; each is a process group of its own.
    pub fn idle_processes(&self) -> Vec<u32> {
        self.roster.idle(Worker::id)
    }

    /// Whether an archive has the folder of a homework, see [`CheckedFolder`]; what to tell its teacher, where it has none. No
    /// submission waits for it: the worker is one of its own.
    pub fn check(&self, archive: &[u8]) -> Result<Result<CheckedFolder, Text>, Fault> {
        check::check(&self.settings, archive)
    }

    /// Grades one submission. A fault is ours; whatever the file does to a worker is a verdict.
    pub fn grade(&self, submission: GradingTask<'_>) -> Result<GradedSubmission, Fault> {
        self.grade_or_let_pass(submission, &mut || {})
    }

    /// The same. `passed` is called where the file takes long, so that another one has got its place: one more is graded at once.
    pub fn grade_or_let_pass(
        &self,
        submission: GradingTask<'_>,
        passed: &mut dyn FnMut(),
    ) -> Result<GradedSubmission, Fault> {
        let place = self.roster.place();
        let mut grading = Grading { pool: self, place, submission, passed, blamed: None };
        let mut wanted = WorkerKind::Any;
        let mut attempts = 0;
        loop {
            attempts += 1;
            match grading.attempt(wanted)? {
                Attempted::Done(answer) => return Ok(*answer),
                Attempted::NotDone(_) if attempts < ATTEMPTS => wanted = WorkerKind::Fresh,
                Attempted::NotDone(fault) => return Err(fault),
            }
        }
    }

    fn stopped(&self, submission: GradingTask<'_>, ending: &Ending, environment: Environment) -> Report {
        let message = ending.message(self.settings.deadline_of(submission.assignment), self.settings.memory);
        crate::grade::unfinished(
            submission.assignment,
            crate::grade::sources(submission.assignment, submission.hand_in),
            Verdict::Stopped,
            vec![Diagnostic::error(DiagnosticStage::Run, message)],
            environment,
        )
    }
}

/// One submission on its way through one or more workers.
struct Grading<'a> {
    pool: &'a Pool,
    place: WorkerPermit<'a>,
    submission: GradingTask<'a>,
    passed: &'a mut dyn FnMut(),
    /// An ending that a fresh worker has to confirm, and when the attempt began that ended so.
    blamed: Option<(Ending, Instant)>,
}

enum Attempted {
    Done(Box<GradedSubmission>),
    /// No verdict yet; the fault if no further attempt is made.
    NotDone(Fault),
}

impl Grading<'_> {
    fn deadline(&self) -> Duration {
        self.pool.settings.deadline_of(self.submission.assignment)
    }

    fn attempt(&mut self, wanted: WorkerKind) -> Result<Attempted, Fault> {
        let Pool { settings, next_id, .. } = self.pool;
        let mut worker = self.place.take(wanted)?;
        let GradingTask { assignment, hand_in, order, wants_frames } = self.submission;
        if !worker.has_read(assignment) {
            if !worker.may_read(assignment, self.pool.roster.library()) {
                self.place.give_up(worker);
                worker = self.place.take(WorkerKind::Fresh)?;
            }
            if let Err(failure) = worker.read(assignment, self.pool.roster.library(), settings) {
                self.place.give_up(worker);
                return if failure.transient { Ok(Attempted::NotDone(failure.fault)) } else { Err(failure.fault) };
            }
        }
        let was_fresh = worker.gradings == 0;
        let id = next_id.fetch_add(1, Ordering::Relaxed);
        let request = GradingRequest::new(id, &assignment.digest, hand_in, order, wants_frames);
        let frames_bytes = if wants_frames { self.submission.frames_bytes() } else { 0 };
        let start = Instant::now();
        // Confirming a crash takes what it left of the deadline: no file has twice the time.
        let spent = self.blamed.as_ref().map_or(Duration::ZERO, |(_, began)| began.elapsed());
        let deadline = self.deadline().saturating_sub(spent);
        let Self { place, passed, .. } = self;
        let mut overtime = || {
            if place.let_pass() {
                passed();
            }
        };
        let times = [deadline, JUDGING * assignment.time];
        let answered = worker.grade(&request, hand_in, frames_bytes, times, &mut overtime);
        let environment = worker.environment.clone();
        let ending = match answered {
            Ok((reply, body)) => return self.answered(worker, was_fresh, reply, &body),
            Err(ending) => ending,
        };
        self.place.give_up(worker);
        self.ended(ending, was_fresh, start, environment)
    }

    fn answered(&mut self, worker: Worker, was_fresh: bool, reply: Reply, body: &[u8]) -> Result<Attempted, Fault> {
        let (report, frames) = match reply.outcome {
            Answered::Graded { report, frames } => {
                (*report, self.pool.drawings.of(&self.submission.assignment.scene, &frames, body))
            }
            Answered::Loaded | Answered::Drawn | Answered::Checked { .. } | Answered::Refused(_) => {
                self.place.give_up(worker);
                return Ok(Attempted::NotDone(Ending::Garbled("the answer to another question".into()).fault()));
            }
            Answered::Failed(fault) => {
                self.place.give_up(worker);
                if let Some(shortage) = self.shortage(&fault.message).filter(|_| is_for_want_of_memory(&fault)) {
                    return Err(shortage);
                }
                // An earlier file may have used up what this one lacked.
                return if was_fresh { Err(fault) } else { Ok(Attempted::NotDone(fault)) };
            }
        };
        let Some(frames) = frames else {
            self.place.give_up(worker);
            return Ok(Attempted::NotDone(Ending::Garbled("frames that do not fit".into()).fault()));
        };
        let is_spent = reply.spent || worker.gradings >= self.pool.settings.gradings_per_worker;
        if is_spent {
            self.place.give_up(worker);
        } else {
            self.place.give_back(worker);
        }
        Ok(Attempted::Done(Box::new(GradedSubmission { report, frames })))
    }

    fn ended(
        &mut self,
        ending: Ending,
        was_fresh: bool,
        began: Instant,
        environment: Environment,
    ) -> Result<Attempted, Fault> {
        if matches!(ending, Ending::Memory | Ending::Crash(_)) {
            let message = ending.message(self.deadline(), self.pool.settings.memory);
            // A file may have all the memory that it is promised: where it cannot, its end is none of its doing.
            if let Some(shortage) = self.shortage(&message) {
                return Err(shortage);
            }
        }
        match ending.blame() {
            Blame::File => {}
            Blame::FileIfRepeated if self.is_certain(&ending, was_fresh, began) => {}
            Blame::FileIfRepeated => {
                let fault = ending.fault();
                self.blamed = Some((ending, began));
                return Ok(Attempted::NotDone(fault));
            }
            Blame::Ours if ending.is_for_good() => return Err(ending.fault()),
            Blame::Ours => return Ok(Attempted::NotDone(ending.fault())),
        }
        let (ending, began) = match (ending, self.blamed.take()) {
            // The confirmation ran out of the little time that was left: the crash is what happened.
            (Ending::Deadline, Some(blamed)) => blamed,
            (ending, Some((_, began))) => (ending, began),
            (ending, None) => (ending, began),
        };
        let mut report = self.pool.stopped(self.submission, &ending, environment);
        report.elapsed_ms = began.elapsed().as_secs_f64() * 1e3;
        Ok(Attempted::Done(Box::new(GradedSubmission { report, frames: Arc::default() })))
    }

    /// The fault where this machine gives a grading less memory than it is promised.
    fn shortage(&self, detail: &Text) -> Option<Fault> {
        let Settings { adapter, memory, .. } = self.pool.settings;
        memory::shortage(adapter, memory::Phase::Grading(memory), detail)
    }

    /// Whether an ending is the file's doing beyond doubt. A limit met by a worker that has seen nothing else is; a
    /// crash needs a second one, since any process can send its signal.
    fn is_certain(&self, ending: &Ending, was_fresh: bool, began: Instant) -> bool {
        let is_limit = was_fresh && !matches!(ending, Ending::Crash(_));
        let is_late = began.elapsed() > self.deadline().mul_f64(1.0 - LEFT_TO_CONFIRM);
        is_limit || self.blamed.is_some() || is_late
    }
}

/// What Vulkan's errors say where an allocation failed, or the driver died of that.
fn is_for_want_of_memory(fault: &Fault) -> bool {
    let message = fault.message.en.to_lowercase();
    ["out of memory", "not enough memory", "is lost"].iter().any(|words| message.contains(words))
}
