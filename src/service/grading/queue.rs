//! The files that wait, in the order in which they came, and who waits for their reports.

use crate::fault::Fault;
use crate::hand_in::HandIn;
use crate::report::Report;
use crate::service::store::Submission;
use std::collections::{HashMap, VecDeque};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};
use tokio::sync::{Notify, broadcast};

/// What came of a grading.
#[derive(Clone, Debug)]
pub enum GradingResult {
    /// The report.
    Graded(Arc<Report>),
    /// Our failure.
    Failed(Arc<Fault>),
}

/// A hand-in to grade.
#[derive(Clone, Debug)]
pub struct Job {
    /// What was handed in.
    pub submission: Submission,
    /// Its files.
    pub hand_in: HandIn,
    /// Since when it waits in this process.
    pub since: Instant,
}

/// No further file is taken now.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Full {
    /// The position that it would have had.
    pub position: u64,
    /// Seconds after which there is likely to be room.
    pub retry_after: u64,
}

/// The queue.
#[derive(Debug)]
pub struct Queue {
    capacity: usize,
    inner: Mutex<Inner>,
    pub(super) wakes: Notify,
    /// Whether there may be files in the database that nobody holds.
    pub(super) more: AtomicBool,
}

#[derive(Debug, Default)]
struct Inner {
    /// Places that are promised to files on their way into the database.
    reserved: usize,
    waiting: VecDeque<Job>,
    /// Files that are graded right now.
    running: usize,
    listeners: HashMap<String, broadcast::Sender<GradingResult>>,
    /// When the last grading ended; none before the first.
    ended: Option<Instant>,
    /// Mean seconds of a grading, lately.
    pace: f64,
    workers: usize,
}

/// A place in the queue, taken before a file is stored.
#[derive(Debug)]
pub struct Reservation<'a> {
    queue: &'a Queue,
}

impl Queue {
    /// An empty queue.
    pub fn new(capacity: usize) -> Self {
        let inner = Inner { pace: 0.05, workers: 1, ..Inner::default() };
        Self { capacity, inner: Mutex::new(inner), wakes: Notify::new(), more: AtomicBool::new(true) }
    }

    fn lock(&self) -> MutexGuard<'_, Inner> {
        // Nothing in here is left half done by a panic.
        self.inner.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Takes a place for a file that is about to be stored, or says how full it is.
    pub fn reserve(&self) -> Result<Reservation<'_>, Full> {
        let mut inner = self.lock();
        let ahead = inner.waiting.len() + inner.reserved;
        if ahead >= self.capacity {
            let seconds = ahead as f64 * inner.pace / inner.workers.max(1) as f64;
            return Err(Full { position: ahead as u64 + 1, retry_after: seconds.ceil().clamp(1.0, 60.0) as u64 });
        }
        inner.reserved += 1;
        Ok(Reservation { queue: self })
    }

    /// Tells the graders that there are files in the database that nobody holds.
    pub fn look(&self) {
        self.more.store(true, Ordering::Relaxed);
        self.wakes.notify_waiters();
    }

    /// Files that wait, and files that are graded right now.
    pub fn lengths(&self) -> (usize, usize) {
        let inner = self.lock();
        (inner.waiting.len(), inner.running)
    }

    /// Whether nobody has waited for a grading for so long.
    pub fn is_quiet(&self, span: Duration) -> bool {
        let inner = self.lock();
        let is_idle = inner.waiting.is_empty() && inner.reserved == 0 && inner.running == 0;
        is_idle && inner.ended.is_none_or(|ended| ended.elapsed() >= span)
    }

    /// The position of a file that waits, from 1.
    pub fn position(&self, id: &str) -> Option<u64> {
        self.lock().waiting.iter().position(|job| job.submission.id == id).map(|index| index as u64 + 1)
    }

    /// Listens for what comes of a file.
    pub fn listen(&self, id: &str) -> broadcast::Receiver<GradingResult> {
        self.lock().listeners.entry(id.to_owned()).or_insert_with(|| broadcast::Sender::new(1)).subscribe()
    }

    /// Forgets listeners who have gone.
    pub fn tidy(&self) {
        self.lock().listeners.retain(|_, sender| sender.receiver_count() > 0);
    }

    pub(super) fn next(&self) -> Option<Job> {
        let mut inner = self.lock();
        let job = inner.waiting.pop_front()?;
        inner.running += 1;
        Some(job)
    }

    pub(super) fn begin(&self) {
        self.lock().running += 1;
    }

    pub(super) fn done(&self, id: &str, outcome: Option<GradingResult>, took: Duration) {
        /// The share of the newest grading in the mean.
        const SHARE: f64 = 0.1;
        let mut inner = self.lock();
        inner.running = inner.running.saturating_sub(1);
        inner.ended = Some(Instant::now());
        inner.pace += SHARE * (took.as_secs_f64() - inner.pace);
        if let (Some(sender), Some(outcome)) = (inner.listeners.remove(id), outcome) {
            // Nobody may be waiting any more.
            let _ = sender.send(outcome);
        }
    }

    pub(super) fn set_workers(&self, workers: usize) {
        self.lock().workers = workers;
    }
}

impl Reservation<'_> {
    /// Puts the stored file there.
    pub fn fill(self, job: Job) {
        self.queue.lock().waiting.push_back(job);
        self.queue.wakes.notify_one();
    }
}

impl Drop for Reservation<'_> {
    fn drop(&mut self) {
        let mut inner = self.queue.lock();
        inner.reserved = inner.reserved.saturating_sub(1);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn who_is_graded_or_about_to_be_breaks_the_quiet() {
        let queue = Queue::new(2);
        let is_quiet = || queue.is_quiet(Duration::ZERO);
        assert!(queue.is_quiet(Duration::MAX));
        let place = queue.reserve().expect("a place");
        assert!(!is_quiet());
        drop(place);
        queue.begin();
        assert!(!is_quiet());
        queue.done("", None, Duration::ZERO);
        assert!(is_quiet() && !queue.is_quiet(Duration::MAX));
    }

    #[test]
    fn the_place_after_the_last_is_refused_with_its_number() {
        let queue = Queue::new(2);
        let first = queue.reserve().expect("a place");
        let _second = queue.reserve().expect("a place");
        let full = queue.reserve().expect_err("no place");
        assert_eq!(full.position, 3);
        assert!(full.retry_after >= 1);
        drop(first);
        assert!(queue.reserve().is_ok());
    }
}
