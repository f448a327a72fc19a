//! What requests share: the [`Service`], and the [`State`] of one homework in it.

use super::Config;
use super::classes::Jobs;
use super::clock::Clock;
use super::errors::Problem;
use super::folders::{self, FolderCache};
use super::gallery::{Gallery, RightPictures};
use super::grading::{CrossChecks, Judge, Queue};
use super::identity::{new_id, new_token};
use super::limits::{Limits, Proxies};
use super::lti::Connections;
use super::preview::FolderVersion;
use super::store::{Store, Stored, Submission};
use crate::fault::Fault;
use crate::language::Text;
use reference::Assignment;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, OnceLock, PoisonError, RwLock};
use tokio::sync::{Semaphore, watch};

/// What every request shares, whatever homework it is about; cheap to clone.
#[derive(Clone, Debug)]
pub struct Service(Arc<Shared>);

/// The service as the requests about one homework see it; cheap to clone. Whatever takes a [`Service`] takes this as well.
#[derive(Clone, Debug)]
pub struct State {
    service: Service,
    /// The homework.
    pub assignment: Arc<Assignment>,
    /// What a right answer draws.
    pub right: Arc<RightPictures>,
}

impl std::ops::Deref for Service {
    type Target = Shared;

    fn deref(&self) -> &Shared {
        &self.0
    }
}

impl std::ops::Deref for State {
    type Target = Service;

    fn deref(&self) -> &Service {
        &self.service
    }
}

/// The parts of a [`Service`].
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
    /// What is kept of learning platforms between requests.
    pub lti: Connections,
    /// The homeworks that the command line names.
    named: Vec<Arc<Assignment>>,
    /// The homeworks that are served, each with its right pictures.
    homeworks: RwLock<Vec<(Arc<Assignment>, Arc<RightPictures>)>>,
    /// Counts how often they have changed.
    generation: AtomicU64,
    /// The folders that were read to grade everything again by them.
    pub(super) folders: FolderCache,
    /// One uploaded folder is checked at a time.
    pub(super) check_turn: Semaphore,
    /// The teacher's token, where there is one.
    pub teacher_token: Option<String>,
    /// What a preview of a folder says beside the student's page; nothing in a service for students.
    pub preview: OnceLock<FolderVersion>,
    pub(super) proxies: Proxies,
    /// Whose word is taken on who somebody is.
    pub(super) identity_proxies: Proxies,
    /// The key of the tokens in forms.
    pub(super) key: Vec<u8>,
    /// One password is checked at a time.
    pub(super) login_turn: Semaphore,
    /// Tells this process's claims from others'.
    pub(super) instance: String,
    /// Turns true when the service is told to end.
    pub(super) ending: watch::Sender<bool>,
}

impl Service {
    /// A service for these homeworks, whose ids differ, and for those that were published. What was published goes before what
    /// is named.
    pub async fn serving(
        assignments: Vec<Arc<Assignment>>,
        config: Config,
        store: Store,
        pool: Arc<dyn Judge>,
        clock: Clock,
    ) -> Result<Self, Fault> {
        let failed = |error| Fault::new(Text::verbatim(format!("the database: {error}")));
        let key = store.setting_or("csrf_key", &new_token()).await.map_err(failed)?;
        let served = folders::served(&store, &assignments).await.map_err(failed)?;
        for assignment in &served {
            store.assignment(&assignment.id).await.map_err(failed)?;
        }
        Ok(Self(Arc::new(Shared {
            limits: Limits::new(&config, &clock),
            lti: Connections::default(),
            preview: OnceLock::new(),
            proxies: Proxies::parse("trusted_proxies", &config.trusted_proxies)?,
            identity_proxies: Proxies::parse("identity_proxies", &config.identity_proxies)?,
            queue: Queue::new(config.queue),
            cross_checks: CrossChecks::default(),
            gallery: Gallery::default(),
            downloads: Jobs::default(),
            teacher_token: config.teacher_token.clone(),
            key: key.into_bytes(),
            login_turn: Semaphore::new(1),
            instance: new_id(),
            ending: watch::Sender::new(false),
            named: assignments,
            homeworks: RwLock::new(served.into_iter().map(with_pictures).collect()),
            generation: AtomicU64::new(0),
            folders: FolderCache::default(),
            check_turn: Semaphore::new(1),
            config,
            store,
            pool,
            clock,
        })))
    }

    /// Every homework that is served: those of the command line in their order, and then the others.
    pub fn homeworks(&self) -> impl Iterator<Item = State> + '_ {
        let homeworks = self.homeworks.read().unwrap_or_else(PoisonError::into_inner).clone();
        homeworks.into_iter().map(|(assignment, right)| State { service: self.clone(), assignment, right })
    }

    /// The ids of the homeworks that are served.
    pub fn ids(&self) -> Vec<String> {
        self.homeworks().map(|state| state.assignment.id.clone()).collect()
    }

    /// The homework that is served, where it is one.
    pub fn only(&self) -> Option<State> {
        let mut homeworks = self.homeworks();
        homeworks.next().filter(|_| homeworks.next().is_none())
    }

    /// Whether several homeworks are served.
    pub fn has_several(&self) -> bool {
        self.homeworks().count() > 1
    }

    /// A homework that is not served, to be looked at.
    pub(super) fn unserved(&self, assignment: Arc<Assignment>) -> State {
        let (assignment, right) = with_pictures(assignment);
        State { service: self.clone(), assignment, right }
    }

    /// How often the homeworks have changed that are served.
    pub fn generation(&self) -> u64 {
        self.generation.load(Ordering::Acquire)
    }

    /// Serves a homework from now on, in the place of the one with the same id.
    pub(super) fn serve(&self, assignment: Arc<Assignment>) {
        let mut homeworks = self.homeworks.write().unwrap_or_else(PoisonError::into_inner);
        let place = homeworks.iter().position(|(known, _)| known.id == assignment.id);
        match place {
            Some(place) => homeworks[place] = with_pictures(assignment),
            None => homeworks.push(with_pictures(assignment)),
        }
        drop(homeworks);
        self.generation.fetch_add(1, Ordering::Release);
    }

    /// Serves the homework with this id no more, or as the command line names it.
    pub(super) fn withdraw(&self, id: &str) {
        if let Some(named) = self.named_as(id) {
            return self.serve(Arc::clone(named));
        }
        self.homeworks.write().unwrap_or_else(PoisonError::into_inner).retain(|(known, _)| known.id != id);
        self.generation.fetch_add(1, Ordering::Release);
    }

    /// The homeworks as the command line names them.
    pub(super) fn named_ones(&self) -> &[Arc<Assignment>] {
        &self.named
    }

    /// The homework with this id as the command line names it.
    pub(super) fn named_as(&self, id: &str) -> Option<&Arc<Assignment>> {
        self.named.iter().find(|known| known.id == id)
    }

    /// The homework with this id.
    pub fn homework(&self, id: &str) -> Option<State> {
        self.homeworks().find(|state| state.assignment.id == id)
    }

    /// The homework with this id, of which something is stored; a problem where it is not served any more.
    pub fn homework_of(&self, id: &str) -> Result<State, Problem> {
        self.homework(id).ok_or_else(|| Problem::not_served(id, &self.ids()))
    }

    /// The homework that a request names; without a name the only one.
    pub fn named(&self, id: Option<&str>) -> Result<State, Problem> {
        match (id, self.only()) {
            (None, Some(only)) => Ok(only),
            (Some(id), Some(only)) => Some(only).filter(|only| only.assignment.id == id).ok_or_else(Problem::not_found),
            (Some(id), None) => self.homework_of(id),
            (None, None) => Err(Problem::which_homework(&self.ids())),
        }
    }

    /// The submission with this id, and its homework.
    pub async fn submission(&self, id: &str) -> Result<(State, Submission), Problem> {
        let submission = self.store.submission(id).await?.ok_or_else(Problem::not_found)?;
        Ok((self.homework_of(&submission.assignment)?, submission))
    }

    /// The submission with this id with its report, and its homework.
    pub async fn stored(&self, id: &str) -> Result<(State, Stored), Problem> {
        let stored = self.store.stored(id).await?.ok_or_else(Problem::not_found)?;
        Ok((self.homework_of(&stored.submission.assignment)?, stored))
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
        // The sender lives as long as this service.
        let _ = ending.wait_for(|ending| *ending).await;
    }
}

/// A homework with what a right answer draws.
fn with_pictures(assignment: Arc<Assignment>) -> (Arc<Assignment>, Arc<RightPictures>) {
    let right = Arc::new(RightPictures::new(Arc::clone(&assignment)));
    (assignment, right)
}

impl State {
    /// The service.
    pub fn service(&self) -> &Service {
        &self.service
    }

    /// What the addresses of this homework's pages begin with, the student's page aside: nothing where it is the only one.
    pub fn base(&self) -> String {
        if self.has_several() { self.page() } else { String::new() }
    }

    /// The address of the student's page.
    pub fn page(&self) -> String {
        format!("/a/{}", self.assignment.id)
    }

    /// The query that names this homework to the API; nothing where it is the only one.
    pub fn query(&self) -> String {
        if self.has_several() { format!("?assignment={}", self.assignment.id) } else { String::new() }
    }
}
