//! Ctrl-C and SIGTERM: the first ends a run in order, the second at once.

use crate::fault::Fault;
use crate::language::Text;
use nix::sys::signal::{SigSet, Signal};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// Exit code of a program that was ended by Ctrl-C, as shells have it.
pub const EXIT_CODE: u8 = 130;

/// Watches for the signals.
#[derive(Clone)]
pub struct Interrupt {
    shared: Arc<InterruptState>,
}

struct InterruptState {
    happened: AtomicBool,
    stop: AtomicBool,
    /// What the first signal is answered with; without it, a signal ends the program at once.
    answer: Mutex<Option<Handler>>,
}

type Handler = Box<dyn FnOnce() + Send>;

impl Interrupt {
    /// Watches from now on. No other thread may have been started before, for it would still be ended by the signals.
    pub fn watch() -> Result<Self, Fault> {
        let shared =
            InterruptState { happened: AtomicBool::new(false), stop: AtomicBool::new(false), answer: Mutex::new(None) };
        let interrupt = Self { shared: Arc::new(shared) };
        let signals: SigSet = [Signal::SIGINT, Signal::SIGTERM].into_iter().collect();
        signals.thread_block().map_err(|error| cannot(&error.to_string()))?;
        let watching = interrupt.clone();
        let thread = std::thread::Builder::new().name("signals".into());
        thread
            .spawn(move || {
                while signals.wait().is_ok() {
                    watching.answer();
                }
            })
            .map_err(|error| cannot(&error.to_string()))?;
        Ok(interrupt)
    }

    /// From now on the first signal sets [`Self::stop`] and calls `answer`; the second ends the program.
    pub fn defer(&self, answer: impl FnOnce() + Send + 'static) {
        *self.shared.answer.lock().unwrap_or_else(PoisonError::into_inner) = Some(Box::new(answer));
    }

    /// From now on a signal ends the program at once.
    pub fn resume(&self) {
        self.shared.answer.lock().unwrap_or_else(PoisonError::into_inner).take();
    }

    /// Whether work is to be stopped; work that fails sets it too.
    pub fn stop(&self) -> &AtomicBool {
        &self.shared.stop
    }

    /// Whether a signal came.
    pub fn happened(&self) -> bool {
        self.shared.happened.load(Ordering::Relaxed)
    }

    fn answer(&self) {
        let answer = self.shared.answer.lock().unwrap_or_else(PoisonError::into_inner).take();
        let Some(answer) = answer else { std::process::exit(i32::from(EXIT_CODE)) };
        self.shared.happened.store(true, Ordering::Relaxed);
        self.shared.stop.store(true, Ordering::Relaxed);
        answer();
    }
}

fn cannot(detail: &str) -> Fault {
    Fault::new(Text::new(
        format!("Ctrl-C cannot be watched for: {detail}"),
        format!("Ctrl-C を監視できません: {detail}"),
    ))
}
