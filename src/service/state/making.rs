//! How a service comes to be: the first course from what it is started with, another one beside it.

use super::homeworks::with_pictures;
use super::{Service, ServiceParts};
use crate::fault::Fault;
use crate::service::Config;
use crate::service::classes::Jobs;
use crate::service::clock::Clock;
use crate::service::courses::{self, CoursePlan, Courses};
use crate::service::folders::{self, FolderCache};
use crate::service::gallery::Gallery;
use crate::service::grading::{CrossChecks, Judge, Queue};
use crate::service::identity::{new_id, new_token};
use crate::service::limits::{Proxies, RateLimits};
use crate::service::lti::Connections;
use crate::service::server::database;
use crate::service::store::{Result as StoreResult, Store};
use reference::Assignment;
use std::sync::atomic::AtomicU64;
use std::sync::{Arc, OnceLock, RwLock};
use tokio::sync::{Semaphore, watch};

/// What the courses of a service have in common.
struct CourseResources {
    config: Config,
    pool: Arc<dyn Judge>,
    clock: Clock,
    limits: Arc<RateLimits>,
    proxies: Proxies,
    identity_proxies: Proxies,
    queue: Arc<Queue>,
    cross_checks: Arc<CrossChecks>,
    login_turn: Arc<Semaphore>,
    instance: String,
    ending: watch::Sender<bool>,
}

impl Service {
    /// A service for these homeworks, whose ids differ, for those that were published, and for the other courses that were made.
    /// What was published goes before what is named.
    pub async fn serving(
        assignments: Vec<Arc<Assignment>>,
        config: Config,
        store: Store,
        pool: Arc<dyn Judge>,
        clock: Clock,
    ) -> Result<Self, Fault> {
        let common = CourseResources {
            limits: Arc::new(RateLimits::new(&config, &clock)),
            proxies: Proxies::parse("trusted_proxies", &config.trusted_proxies)?,
            identity_proxies: Proxies::parse("identity_proxies", &config.identity_proxies)?,
            queue: Arc::new(Queue::new(config.queue)),
            cross_checks: Arc::default(),
            login_turn: Arc::new(Semaphore::new(1)),
            instance: new_id(),
            ending: watch::Sender::new(false),
            config,
            pool,
            clock,
        };
        let service = Self::made(common, assignments, store, None).await.map_err(|error| database(&error))?;
        courses::follow(&service).await.map_err(|error| database(&error))?;
        Ok(service)
    }

    /// Another course of this service, in tables of its own. It chooses among what is built in and what the command line names.
    pub(in crate::service) async fn beside(&self, id: &str) -> StoreResult<Self> {
        let store = self.store.open_course(id).await?;
        // Tokens of single homeworks are for those of the first course.
        let config = Config { homework_tokens: Default::default(), ..self.config.clone() };
        let common = CourseResources {
            config,
            pool: Arc::clone(&self.pool),
            clock: self.clock.clone(),
            limits: Arc::clone(&self.limits),
            proxies: self.proxies.clone(),
            identity_proxies: self.identity_proxies.clone(),
            queue: Arc::clone(&self.queue),
            cross_checks: Arc::clone(&self.cross_checks),
            login_turn: Arc::clone(&self.login_turn),
            instance: self.instance.clone(),
            ending: self.ending.clone(),
        };
        let mut offered = self.named.clone();
        let built_in = reference::assignments().filter(|one| self.named.iter().all(|known| known.id != one.id));
        offered.extend(built_in.cloned());
        Self::made(common, offered, store, Some((id, self))).await
    }

    async fn made(
        common: CourseResources,
        named: Vec<Arc<Assignment>>,
        store: Store,
        other: Option<(&str, &Self)>,
    ) -> StoreResult<Self> {
        let key = store.setting_or("csrf_key", &new_token()).await?;
        // An earlier version kept nothing of the zone, and a tz database may be newer than what is kept.
        store.keep_zone(store.course().await?.zone()).await?;
        let plan = CoursePlan::read(&store).await?;
        let (root, first_course) = other.map(|(id, first)| (courses::root_of_id(id), first)).unzip();
        let first = first_course.map(|first| first.store.clone());
        let first_course = first_course.map(|Self(first)| Arc::downgrade(first));
        let root = root.unwrap_or_default();
        let chosen = plan.chosen(&named, root.is_empty());
        let served = folders::served(&store, &chosen).await?;
        for assignment in &served {
            store.assignment(&assignment.id).await?;
        }
        let CourseResources { config, pool, clock, limits, .. } = common;
        let CourseResources { proxies, identity_proxies, queue, cross_checks, login_turn, instance, ending, .. } =
            common;
        Ok(Self(Arc::new(ServiceParts {
            root,
            first,
            courses: Courses::default(),
            first_course,
            plan: RwLock::new(plan),
            limits,
            lti: Connections::default(),
            preview: OnceLock::new(),
            proxies,
            identity_proxies,
            queue,
            cross_checks,
            gallery: Gallery::default(),
            downloads: Jobs::default(),
            teacher_token: config.teacher_token.clone(),
            key: key.into_bytes(),
            login_turn,
            instance,
            ending,
            named,
            homeworks: RwLock::new(served.into_iter().map(with_pictures).collect()),
            generation: AtomicU64::new(0),
            folders: FolderCache::default(),
            served_turn: Semaphore::new(1),
            course_turn: Semaphore::new(1),
            check_turn: Semaphore::new(1),
            config,
            store,
            pool,
            clock,
        })))
    }
}
