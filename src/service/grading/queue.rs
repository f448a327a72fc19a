//! What a process knows of the queue, which itself is in the database: who waits here for which report, and what is under
//! way here.

use crate::fault::Fault;
use crate::report::Report;
use std::collections::HashMap;
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

/// No further file is taken now.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Full {
    /// The position that it would have had.
    pub position: u64,
    /// Seconds after which there is likely to be room.
    pub retry_after: u64,
}

/// The queue, as this process sees it.
#[derive(Debug)]
pub struct Queue {
    capacity: usize,
    inner: Mutex<Inner>,
    /// Wakes one idle grader of this process.
    pub(super) wakes: Notify,
}

#[derive(Debug, Default)]
struct Inner {
    /// Places that are promised to files on their way into the database.
    reserved: usize,
    /// Files that are graded here right now.
    running: usize,
    /// Graders that hold a suspect file, or look for one.
    suspects: usize,
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
    /// A queue with room for so many uploads.
    pub fn new(capacity: usize) -> Self {
        let inner = Inner { pace: 0.05, workers: 1, ..Inner::default() };
        Self { capacity, inner: Mutex::new(inner), wakes: Notify::new() }
    }

    fn lock(&self) -> MutexGuard<'_, Inner> {
        // Nothing in here is left half done by a panic.
        self.inner.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// How many uploads may wait.
    pub fn capacity(&self) -> usize {
        self.capacity
    }

    /// Takes a place for a file that is about to be stored, behind `waiting` others, or says how full it is.
    pub fn reserve(&self, waiting: usize) -> Result<Reservation<'_>, Full> {
        let mut inner = self.lock();
        let ahead = waiting + inner.reserved;
        if ahead >= self.capacity {
            let seconds = ahead as f64 * inner.pace / inner.workers.max(1) as f64;
            return Err(Full { position: ahead as u64 + 1, retry_after: seconds.ceil().clamp(1.0, 60.0) as u64 });
        }
        inner.reserved += 1;
        Ok(Reservation { queue: self })
    }

    /// Files that are graded here right now.
    pub fn running(&self) -> usize {
        self.lock().running
    }

    /// Whether nobody has waited here for a grading for so long: a file that waits is taken at once where nothing runs.
    pub fn is_quiet(&self, span: Duration) -> bool {
        let inner = self.lock();
        let is_idle = inner.reserved == 0 && inner.running == 0;
        is_idle && inner.ended.is_none_or(|ended| ended.elapsed() >= span)
    }

    /// Listens for what comes of a file.
    pub fn listen(&self, id: &str) -> broadcast::Receiver<GradingResult> {
        self.lock().listeners.entry(id.to_owned()).or_insert_with(|| broadcast::Sender::new(1)).subscribe()
    }

    /// Whether somebody here listens for what comes of a file.
    pub(super) fn has_listener(&self, id: &str) -> bool {
        self.lock().listeners.get(id).is_some_and(|sender| sender.receiver_count() > 0)
    }

    /// The files that somebody here listens for.
    pub(super) fn expected(&self) -> Vec<String> {
        self.lock().listeners.keys().cloned().collect()
    }

    /// Forgets listeners who have gone.
    pub fn tidy(&self) {
        self.lock().listeners.retain(|_, sender| sender.receiver_count() > 0);
    }

    /// Tells who listens what came of a file.
    pub(super) fn tell(&self, id: &str, outcome: GradingResult) {
        if let Some(sender) = self.lock().listeners.remove(id) {
            // Nobody may be waiting any more.
            let _ = sender.send(outcome);
        }
    }

    /// Whether a grader may look for a suspect file as well: as long as one other grader is left for everybody else.
    /// [`Self::leave_suspects`] gives it back.
    pub(super) fn enter_suspects(&self) -> bool {
        let mut inner = self.lock();
        let may = inner.workers == 1 || inner.suspects + 1 < inner.workers;
        inner.suspects += usize::from(may);
        may
    }

    pub(super) fn leave_suspects(&self) {
        let mut inner = self.lock();
        inner.suspects = inner.suspects.saturating_sub(1);
    }

    pub(super) fn begin(&self) {
        self.lock().running += 1;
    }

    pub(super) fn end(&self, took: Duration) {
        /// The share of the newest grading in the mean.
        const SHARE: f64 = 0.1;
        let mut inner = self.lock();
        inner.running = inner.running.saturating_sub(1);
        inner.ended = Some(Instant::now());
        inner.pace += SHARE * (took.as_secs_f64() - inner.pace);
    }

    pub(super) fn set_workers(&self, workers: usize) {
        self.lock().workers = workers;
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
        let place = queue.reserve(0).expect("a place");
        assert!(!is_quiet());
        drop(place);
        queue.begin();
        assert!(!is_quiet());
        queue.end(Duration::ZERO);
        assert!(is_quiet() && !queue.is_quiet(Duration::MAX));
    }

    #[test]
    fn the_place_after_the_last_is_refused_with_its_number() {
        let queue = Queue::new(3);
        let first = queue.reserve(1).expect("a place");
        let _second = queue.reserve(1).expect("a place");
        let full = queue.reserve(1).expect_err("no place");
        assert_eq!(full.position, 4);
        assert!(full.retry_after >= 1);
        drop(first);
        assert!(queue.reserve(1).is_ok());
    }
}
