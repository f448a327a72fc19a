//! What requests share: the [`Service`], and the [`State`] of one homework in it. [`making`] is how one comes to be.

mod homeworks;
mod making;

use super::Config;
use super::classes::Jobs;
use super::clock::Clock;
use super::courses::{CoursePlan, Courses};
use super::errors::Problem;
use super::folders::FolderCache;
use super::gallery::{Gallery, RightPictures};
use super::grading::{CrossChecks, Judge, Queue};
use super::limits::{Proxies, RateLimits};
use super::lti::Connections;
use super::preview::FolderVersion;
use super::store::{Store, StoredSubmission, Submission};
use reference::Assignment;
use std::sync::atomic::AtomicU64;
use std::sync::{Arc, OnceLock, RwLock, Weak};
use tokio::sync::{Semaphore, watch};

/// What every request shares, whatever homework it is about; cheap to clone.
#[derive(Clone, Debug)]
pub struct Service(Arc<ServiceParts>);

/// The service as the requests about one homework see it; cheap to clone. Whatever takes a [`Service`] takes this as well.
#[derive(Clone, Debug)]
pub struct State {
    service: Service,
    /// The homework.
    pub assignment: Arc<Assignment>,
    /// What a right answer draws.
    pub right: Arc<RightPictures>,
    /// Id of the uploaded folder that is looked at, where the homework is none that is served.
    folder: Option<String>,
}

impl std::ops::Deref for Service {
    type Target = ServiceParts;

    fn deref(&self) -> &ServiceParts {
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
pub struct ServiceParts {
    /// The configuration.
    pub config: Config,
    /// The database.
    pub store: Store,
    /// What grades.
    pub pool: Arc<dyn Judge>,
    /// What time it is.
    pub clock: Clock,
    /// The files that wait to be graded, and who waits for them.
    pub queue: Arc<Queue>,
    /// The reports that wait for a second opinion.
    pub cross_checks: Arc<CrossChecks>,
    /// The pictures of submissions.
    pub gallery: Gallery,
    /// The downloads that take a while to make.
    pub downloads: Jobs,
    /// Rates.
    pub limits: Arc<RateLimits>,
    /// What is kept of learning platforms between requests.
    pub lti: Connections,
    /// What the addresses of a course begin with: nothing for the first one, `/c/COURSE` for another.
    pub(super) root: String,
    /// Where accounts and sessions of another course than the first are: with the first one.
    pub(super) first: Option<Store>,
    /// The courses beside the first one, which alone has them.
    pub(super) courses: Courses,
    /// The first course, where this is another one; it outlives this.
    pub(super) first_course: Option<Weak<ServiceParts>>,
    /// The homeworks that the command line names, or those from which another course chooses.
    named: Vec<Arc<Assignment>>,
    /// Which of them the course has, and in which order.
    pub(super) plan: RwLock<CoursePlan>,
    /// The homeworks that are served, each with its right pictures.
    homeworks: RwLock<Vec<(Arc<Assignment>, Arc<RightPictures>)>>,
    /// Counts how often they have changed.
    generation: AtomicU64,
    /// The folders that were read to grade everything again by them.
    pub(super) folders: FolderCache,
    /// What is served changes in one place at a time, in the database and here: what was read of it before is not served after.
    pub(super) served_turn: Semaphore,
    /// One course is made at a time.
    pub(super) course_turn: Semaphore,
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
    pub(super) login_turn: Arc<Semaphore>,
    /// Tells this process's claims from others'.
    pub(super) instance: String,
    /// Turns true when the service is told to end.
    pub(super) ending: watch::Sender<bool>,
}

impl Service {
    /// What the addresses of the course begin with: nothing for the first one, `/c/COURSE` for another.
    pub fn root(&self) -> &str {
        &self.root
    }

    /// Whether it is another course than the first.
    pub fn is_beside(&self) -> bool {
        !self.root.is_empty()
    }

    /// The first course.
    pub(super) fn first_course(&self) -> Option<Self> {
        match &self.first_course {
            None => Some(self.clone()),
            Some(first) => first.upgrade().map(Self),
        }
    }

    /// Where accounts and sessions are: with the first course.
    pub fn accounts(&self) -> &Store {
        self.first.as_ref().unwrap_or(&self.store)
    }

    /// The submission with this id, and its homework.
    pub async fn submission(&self, id: &str) -> Result<(State, Submission), Problem> {
        let submission = self.store.submission(id).await?.ok_or_else(Problem::not_found)?;
        Ok((self.homework_of(&submission.assignment)?, submission))
    }

    /// The submission with this id with its report, and its homework.
    pub async fn stored(&self, id: &str) -> Result<(State, StoredSubmission), Problem> {
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

impl State {
    /// The homework as another course has it, whatever version of it that serves.
    pub(super) fn in_course(&self, other: &Service) -> Self {
        Self { service: other.clone(), ..self.clone() }
    }

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
        format!("{}{}", self.root, self.place())
    }

    /// The same within its course.
    pub fn place(&self) -> String {
        match &self.folder {
            Some(folder) => format!("/teacher/folders/{folder}/page"),
            None => format!("/a/{}", self.assignment.id),
        }
    }

    /// Id of the uploaded folder that is looked at, where the homework is none that is served.
    pub fn looked_at(&self) -> Option<&str> {
        self.folder.as_deref()
    }

    /// The query that names this homework to the API; nothing where it is the only one.
    pub fn query(&self) -> String {
        if self.has_several() { format!("?assignment={}", self.assignment.id) } else { String::new() }
    }
}
