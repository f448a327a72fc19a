//! What every request shares.

use super::Config;
use super::classes::Jobs;
use super::clock::Clock;
use super::gallery::Gallery;
use super::grading::{CrossChecks, Judge, Queue};
use super::identity::{new_id, new_token};
use super::limits::{Limits, Proxies};
use super::store::Store;
use crate::fault::Fault;
use crate::language::Text;
use reference::Assignment;
use std::sync::Arc;
use tokio::sync::{Semaphore, watch};

/// What every request shares; cheap to clone.
#[derive(Clone, Debug)]
pub struct State(Arc<Shared>);

impl std::ops::Deref for State {
    type Target = Shared;

    fn deref(&self) -> &Shared {
        &self.0
    }
}

/// The parts of a [`State`].
#[derive(Debug)]
pub struct Shared {
    /// The configuration.
    pub config: Config,
    /// The database.
    pub store: Store,
    /// What grades.
    pub pool: Arc<dyn Judge>,
    /// What time it is.
    pub clock: Clock,
    /// The files that wait to be graded, and who waits for them.
    pub queue: Queue,
    /// The reports that wait for a second opinion.
    pub cross_checks: CrossChecks,
    /// The pictures of submissions.
    pub gallery: Gallery,
    /// The downloads that take a while to make.
    pub downloads: Jobs,
    /// Rates.
    pub limits: Limits,
    /// The homework that is served.
    pub assignment: Arc<Assignment>,
    /// The teacher's token, where there is one.
    pub teacher_token: Option<String>,
    pub(super) proxies: Proxies,
    /// The key of the tokens in forms.
    pub(super) key: Vec<u8>,
    /// One password is checked at a time.
    pub(super) login_turn: Semaphore,
    /// Tells this process's claims from others'.
    pub(super) instance: String,
    /// Turns true when the service is told to end.
    pub(super) ending: watch::Sender<bool>,
}

impl State {
    /// The state of a service; `teacher_token` goes before the configured one.
    pub async fn serving(
        assignment: Arc<Assignment>,
        config: Config,
        store: Store,
        pool: Arc<dyn Judge>,
        clock: Clock,
    ) -> Result<Self, Fault> {
        let failed = |error| Fault::new(Text::verbatim(format!("the database: {error}")));
        let key = store.setting_or("csrf_key", &new_token()).await.map_err(failed)?;
        store.assignment(&assignment.id).await.map_err(failed)?;
        Ok(Self(Arc::new(Shared {
            limits: Limits::new(&config, &clock),
            proxies: Proxies::parse(&config.trusted_proxies)?,
            queue: Queue::new(config.queue),
            cross_checks: CrossChecks::default(),
            gallery: Gallery::new(Arc::clone(&assignment)),
            downloads: Jobs::default(),
            teacher_token: config.teacher_token.clone(),
            key: key.into_bytes(),
            login_turn: Semaphore::new(1),
            instance: new_id(),
            ending: watch::Sender::new(false),
            assignment,
            config,
            store,
            pool,
            clock,
        })))
    }

    /// Whether the service is about to end.
    pub fn is_ending(&self) -> bool {
        *self.ending.borrow()
    }

    /// Tells everybody that the service is about to end.
    pub fn end(&self) {
        self.ending.send_replace(true);
    }

    /// Waits until the service is told to end.
    pub async fn ended(&self) {
        let mut ending = self.ending.subscribe();
        // The sender lives as long as this state.
        let _ = ending.wait_for(|ending| *ending).await;
    }
}
