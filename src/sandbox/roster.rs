//! The workers of a pool: who is idle, who is on the way, and a thread that starts the next one ahead of need.

mod keeper;

use super::Settings;
use super::child::{NotStarted, Worker, end_group};
use super::library::PictureLibrary;
use super::protection::Protection;
use crate::fault::Fault;
use crate::report::Environment;
use keeper::{keep, no_thread};
use std::cell::Cell;
use std::collections::HashSet;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

/// How often a start that may end otherwise is tried, and the pause before the second try; it doubles each time.
const TRIES: u32 = 3;
const PAUSE: Duration = Duration::from_millis(100);

/// Which worker is wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum WorkerKind {
    /// Any; one that has graded before rather than one that has not.
    Any,
    /// One that has met no file yet.
    Fresh,
}

/// Keeps workers ready.
#[derive(Debug)]
pub(super) struct Roster {
    shared: Arc<SharedRoster>,
    keeper: Option<JoinHandle<()>>,
}

#[derive(Debug)]
struct SharedRoster {
    settings: Settings,
    /// How many may grade at once.
    places: usize,
    library: PictureLibrary,
    state: Mutex<RosterState>,
    changed: Condvar,
}

#[derive(Debug, Default)]
struct RosterState {
    idle: Vec<Worker>,
    /// How many workers are in callers' hands, and how many callers hold a place.
    lent: usize,
    places_taken: usize,
    /// Workers in the hands of callers who have given their places to others.
    overtime: usize,
    /// How many are to be started; the processes of those on the way, and the threads that wait for them.
    ordered: usize,
    starting: Vec<u32>,
    ushers: usize,
    /// What the first worker said of itself.
    greeting: Option<(Environment, Protection)>,
    /// The digests of further assignments at which a worker ended, or that it refused. Whoever hands in for one of them learns
    /// why; the others do not wait for it.
    unreadable: HashSet<String>,
    /// Starts that failed in a row, and the last one's fault where no further try is made.
    failures: u32,
    fault: Option<Fault>,
    closing: bool,
}

/// The right to have one worker at a time.
#[derive(Debug)]
pub(super) struct WorkerPermit<'a> {
    shared: &'a SharedRoster,
    /// Whether it goes without a place: another caller has that.
    overtime: Cell<bool>,
}

impl Roster {
    /// Starts workers for `places` callers and the spares, and waits until the first is confined and has a device. That it
    /// has read the assignment is for callers to wait for.
    pub fn start(settings: Settings, places: usize) -> Result<(Self, Environment, Protection), Fault> {
        let shared = SharedRoster {
            settings,
            places: places.max(1),
            library: PictureLibrary::default(),
            state: Mutex::default(),
            changed: Condvar::new(),
        };
        let shared = Arc::new(shared);
        let for_keeper = Arc::clone(&shared);
        // Workers die with the thread that has started them, so it is this one for as long as there is a pool.
        let keeper = std::thread::Builder::new().name("keeper".into()).spawn(move || keep(&for_keeper));
        let roster = Self { keeper: Some(keeper.map_err(|error| no_thread(&error))?), shared };
        let (environment, protection) = roster.shared.greeting()?;
        Ok((roster, environment, protection))
    }

    /// What is known of the assignments.
    pub fn library(&self) -> &PictureLibrary {
        &self.shared.library
    }

    /// Waits for a place.
    pub fn place(&self) -> WorkerPermit<'_> {
        let mut state = self.shared.lock();
        while state.places_taken >= self.shared.places {
            state = self.shared.wait(state);
        }
        state.places_taken += 1;
        WorkerPermit { shared: &self.shared, overtime: Cell::new(false) }
    }

    /// What holds the workers, and the processes of those that wait for work.
    pub fn idle<T>(&self, view: impl Fn(&Worker) -> T) -> Vec<T> {
        self.shared.lock().idle.iter().map(view).collect()
    }
}

impl Drop for Roster {
    fn drop(&mut self) {
        let mut state = self.shared.lock();
        state.closing = true;
        let idle = std::mem::take(&mut state.idle);
        for process in idle.iter().map(Worker::id).chain(state.starting.iter().copied()) {
            end_group(process);
        }
        drop(state);
        self.shared.changed.notify_all();
        drop(idle);
        if let Some(keeper) = self.keeper.take() {
            let _ = keeper.join();
        }
        let mut state = self.shared.lock();
        while state.ushers > 0 {
            state = self.shared.wait(state);
        }
    }
}

impl WorkerPermit<'_> {
    /// Takes a worker, waiting for one to be started where none is ready.
    pub fn take(&self, wanted: WorkerKind) -> Result<Worker, Fault> {
        let mut state = self.shared.lock();
        // Tries that failed were told to whom they concerned, and this caller is worth new ones. Those under way go on.
        if state.ordered == 0 && state.ushers == 0 {
            state.failures = 0;
            state.fault = None;
        }
        loop {
            self.shared.order(&mut state);
            if let Some(worker) = state.pick(wanted) {
                state.lent += 1;
                return Ok(worker);
            }
            if let Some(fault) = state.fault.take() {
                return Err(fault);
            }
            if state.ordered == 0 && state.starting.is_empty() {
                // There are workers enough, but not of the kind that is wanted.
                state.ordered = 1;
                self.shared.changed.notify_all();
            }
            state = self.shared.wait(state);
        }
    }

    /// Gives the place to another caller and keeps the worker: its file takes long. Only as long as a spare can do the other's work;
    /// whether it can.
    pub fn let_pass(&self) -> bool {
        let mut state = self.shared.lock();
        if self.overtime.get() || state.overtime >= self.shared.settings.spares {
            return false;
        }
        state.overtime += 1;
        state.places_taken -= 1;
        self.overtime.set(true);
        drop(state);
        self.shared.changed.notify_all();
        true
    }

    /// Makes a worker that has graded cleanly ready for the next caller.
    pub fn give_back(&self, worker: Worker) {
        let mut state = self.shared.lock();
        state.lent -= 1;
        let excess = if state.alive() < self.shared.target() {
            state.idle.push(worker);
            None
        } else {
            Some(worker)
        };
        drop(state);
        self.shared.changed.notify_all();
        drop(excess);
    }

    /// Ends a worker, while the next is on its way.
    pub fn give_up(&self, worker: Worker) {
        let mut state = self.shared.lock();
        state.lent -= 1;
        self.shared.order(&mut state);
        drop(state);
        drop(worker);
    }
}

impl Drop for WorkerPermit<'_> {
    fn drop(&mut self) {
        let mut state = self.shared.lock();
        let held = if self.overtime.get() { &mut state.overtime } else { &mut state.places_taken };
        *held -= 1;
        drop(state);
        self.shared.changed.notify_all();
    }
}

impl RosterState {
    /// All workers that there are or will be.
    fn alive(&self) -> usize {
        self.idle.len() + self.lent + self.ordered + self.starting.len()
    }

    fn pick(&mut self, wanted: WorkerKind) -> Option<Worker> {
        let is_fresh = |worker: &Worker| worker.gradings == 0;
        let fresh = self.idle.iter().position(is_fresh);
        let index = match wanted {
            WorkerKind::Fresh => fresh,
            WorkerKind::Any => self.idle.iter().position(|worker| !is_fresh(worker)).or(fresh),
        };
        index.map(|index| self.idle.remove(index))
    }
}

impl SharedRoster {
    fn lock(&self) -> MutexGuard<'_, RosterState> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn wait<'a>(&self, state: MutexGuard<'a, RosterState>) -> MutexGuard<'a, RosterState> {
        self.changed.wait(state).unwrap_or_else(PoisonError::into_inner)
    }

    /// What the first worker says of itself, once there is one.
    fn greeting(&self) -> Result<(Environment, Protection), Fault> {
        let mut state = self.lock();
        self.order(&mut state);
        loop {
            if let Some(greeting) = &state.greeting {
                return Ok(greeting.clone());
            }
            if let Some(fault) = state.fault.take() {
                return Err(fault);
            }
            state = self.wait(state);
        }
    }

    fn target(&self) -> usize {
        self.places + self.settings.spares
    }

    /// Has the keeper start what is missing; after a failure, one at a time.
    fn order(&self, state: &mut RosterState) {
        let missing = self.target().saturating_sub(state.alive());
        if missing > 0 && state.failures == 0 && !state.closing {
            state.ordered += missing;
            self.changed.notify_all();
        }
    }

    /// Has a new worker read the further assignments.
    fn have_further_read(&self, worker: &mut Worker) -> Result<(), NotStarted> {
        for assignment in &self.settings.further {
            if self.lock().unreadable.contains(&assignment.digest) {
                continue;
            }
            worker.read(assignment, &self.library, &self.settings).map_err(|failure| {
                self.lock().unreadable.insert(assignment.digest.clone());
                // The next try leaves it out.
                NotStarted { transient: true, ..failure }
            })?;
        }
        Ok(())
    }

    fn failed(&self, state: &mut RosterState, failure: NotStarted) {
        state.failures += 1;
        if failure.transient && state.failures < TRIES {
            state.ordered += 1;
        } else {
            state.fault = Some(failure.fault);
        }
    }
}
