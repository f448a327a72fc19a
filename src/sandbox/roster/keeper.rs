//! The thread that starts workers, and those that wait until a worker is ready.

use super::{PAUSE, SharedRoster, TRIES};
use crate::fault::Fault;
use crate::language::Text;
use crate::sandbox::child::{NotStarted, Worker};
use std::sync::Arc;

/// Starts what is ordered, until the pool closes.
pub(super) fn keep(shared: &Arc<SharedRoster>) {
    let mut state = shared.lock();
    loop {
        while state.ordered == 0 && !state.closing {
            state = shared.wait(state);
        }
        if state.closing {
            return;
        }
        state.ordered -= 1;
        match Worker::spawn(&shared.settings) {
            Ok(worker) => {
                state.starting.push(worker.id());
                state.ushers += 1;
                drop(state);
                let for_usher = Arc::clone(shared);
                let usher = std::thread::Builder::new().name("usher".into());
                if let Err(error) = usher.spawn(move || receive(&for_usher, worker)) {
                    // The worker went with the closure.
                    shared.lock().ushers -= 1;
                    fail(shared, NotStarted { fault: no_thread(&error), transient: true });
                }
            }
            Err(failure) => {
                drop(state);
                fail(shared, failure);
            }
        }
        state = shared.lock();
    }
}

/// Waits until the worker is ready, and has it join the others.
fn receive(shared: &SharedRoster, mut worker: Worker) {
    let greeted = worker.greet(&shared.settings).and_then(|()| {
        let greeting = (worker.environment.clone(), worker.protection.clone());
        shared.lock().greeting.get_or_insert(greeting);
        shared.changed.notify_all();
        worker.read(&shared.settings.assignment, &shared.library, &shared.settings)?;
        shared.have_further_read(&mut worker)
    });
    let process = worker.id();
    let mut state = shared.lock();
    state.starting.retain(|&other| other != process);
    match greeted {
        Ok(()) if !state.closing => {
            state.failures = 0;
            state.idle.push(worker);
            drop(state);
        }
        Ok(()) => {
            drop(state);
            drop(worker);
        }
        Err(failure) => {
            // Not counted as gone before the next try is ordered.
            state.lent += 1;
            drop(state);
            drop(worker);
            fail(shared, failure);
            shared.lock().lent -= 1;
        }
    }
    shared.lock().ushers -= 1;
    shared.changed.notify_all();
}

/// Orders another try after a pause, or gives the fault to whoever waits.
fn fail(shared: &SharedRoster, failure: NotStarted) {
    let failures = shared.lock().failures;
    if failure.transient && failures + 1 < TRIES {
        std::thread::sleep(PAUSE * 2_u32.pow(failures));
    }
    shared.failed(&mut shared.lock(), failure);
    shared.changed.notify_all();
}

pub(super) fn no_thread(error: &std::io::Error) -> Fault {
    Fault::new(Text::new(format!("no thread can be started: {error}"), format!("スレッドを起動できません: {error}")))
}
