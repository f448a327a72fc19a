//! The server around the router: from a configuration to a service that listens, until it is told to end.

mod connections;
mod health;
mod steady;

pub use connections::accept;
pub use health::{readiness_address, ready};

use super::clock::Clock;
use super::grading::Graders;
use super::identity::new_token;
use super::store::{Store, StoreError};
use super::{Config, Service, api, app, folders, gallery, layered, lti, metrics, upkeep};
use crate::fault::Fault;
use crate::language::Text;
use crate::sandbox::{Pool, Settings};
use reference::Assignment;
use std::net::SocketAddr;
use std::sync::Arc;
use tokio::net::TcpListener;
use tokio::signal::unix::{SignalKind, signal};

/// How often the workers are started before the service gives up.
const MOST_STARTS: u32 = 4;

/// A service that listens.
#[derive(Debug)]
pub struct Started {
    /// Where.
    pub address: SocketAddr,
    /// What its requests share.
    pub service: Service,
    /// The teacher's token, where nobody set a password or a token: it is new at each start.
    pub one_time_token: Option<String>,
    listener: TcpListener,
    graders: Graders,
}

/// Opens the database, starts the workers, takes over what was left, and listens; serves nothing yet.
pub async fn start(mut config: Config, assignments: Vec<Arc<Assignment>>) -> Result<Started, Fault> {
    metrics::install();
    let store = open(&config).await?;
    let one_time_token = match !config.role.serves_pages() || has_teacher(&config, &store).await? {
        true => None,
        false => Some(new_token()[..32].to_owned()),
    };
    if one_time_token.is_some() {
        config.teacher_token.clone_from(&one_time_token);
    }
    if config.public_url.is_none() && !config.trusted_proxies.is_empty() {
        tracing::warn!(
            "behind a proxy and without public_url: cookies are not Secure, and links begin with the address by which each page is asked for"
        );
    }
    let (listener, address) = listen(config.listen).await?;
    let served = folders::served(&store, &assignments).await.map_err(|error| database(&error))?;
    let pool = pool(&config, &served).await?;
    let service = Service::serving(assignments, config, store, Arc::new(pool), Clock::system()).await?;
    let graders = Graders::start(&service).await.map_err(|error| database(&error))?;
    tokio::spawn(upkeep::run(service.clone()));
    if service.config.role.serves_pages() {
        tokio::spawn(lti::scores::run(service.clone()));
        tokio::spawn(gallery::draw_all(service.clone()));
    }
    Ok(Started { address, service, one_time_token, listener, graders })
}

impl Started {
    /// Serves until SIGTERM or SIGINT; then lets what is under way be finished.
    pub async fn serve(self) -> Result<(), Fault> {
        let failed = |error| Fault::new(Text::verbatim(format!("signals: {error}")));
        let mut terminate = signal(SignalKind::terminate()).map_err(failed)?;
        let mut interrupt = signal(SignalKind::interrupt()).map_err(failed)?;
        let service = self.service.clone();
        tokio::spawn(async move {
            tokio::select! { _ = terminate.recv() => {}, _ = interrupt.recv() => {} }
            tracing::info!("told to end: finishing what is under way");
            service.end();
        });
        let Self { service, listener, graders, .. } = self;
        let routes = match service.config.role.serves_pages() {
            true => app(service.clone()),
            false => layered(service.clone(), api::for_operators()),
        };
        accept(listener, routes, service.clone()).await;
        graders.finish().await;
        for course in service.everywhere() {
            course.store.close().await;
        }
        tracing::info!("ended");
        Ok(())
    }
}

/// Listens, and says where: port 0 is a free one.
pub(super) async fn listen(asked: SocketAddr) -> Result<(TcpListener, SocketAddr), Fault> {
    let listener = TcpListener::bind(asked).await.map_err(|error| cannot_listen(asked, &error))?;
    let address = listener.local_addr().map_err(|error| cannot_listen(asked, &error))?;
    Ok((listener, address))
}

/// Opens the database of a configuration.
pub async fn open(config: &Config) -> Result<Store, Fault> {
    Store::open(&config.location()?).await.map_err(|error| {
        let place = config.location().map(|location| location.to_string()).unwrap_or_default();
        Fault::new(Text::new(
            format!("the database {place} cannot be opened: {error}"),
            format!("データベース {place} を開けません: {error}"),
        ))
    })
}

/// The ids of the homeworks whose folders were uploaded to the first course of a configuration's database.
pub async fn uploaded(config: &Config) -> Result<Vec<String>, Fault> {
    let store = open(config).await?;
    let folders = store.folders().await.map_err(|error| database(&error))?;
    store.close().await;
    Ok(folders.into_iter().map(|folder| folder.assignment).collect())
}

async fn has_teacher(config: &Config, store: &Store) -> Result<bool, Fault> {
    if config.teacher_token.is_some() || config.teacher_password_hash.is_some() {
        return Ok(true);
    }
    let password = store.setting(super::identity::PASSWORD_SETTING).await.map_err(|error| database(&error))?;
    let has_administrator = store.has_administrator().await.map_err(|error| database(&error))?;
    Ok(password.is_some() || has_administrator)
}

/// One worker more than files are graded at once draws pictures for who looks at reports, and has the second opinions.
pub(super) async fn pool(config: &Config, assignments: &[Arc<Assignment>]) -> Result<Pool, Fault> {
    let Some((first, further)) = assignments.split_first() else {
        return Err(Fault::new(Text::verbatim("there is no assignment to serve")));
    };
    let settings = Settings {
        deadline: Config::span(config.deadline),
        policy: config.sandbox,
        further: further.to_vec(),
        ..Settings::new(Arc::clone(first))
    };
    let settings = if config.single_use_workers { settings.with_single_use_workers() } else { settings };
    let workers = if config.role.grades() { config.workers + 1 } else { 1 };
    let started = tokio::task::spawn_blocking(move || start_pool(&settings, workers)).await;
    let pool = started.map_err(|error| Fault::new(Text::verbatim(error.to_string())))??;
    if let Some(notice) = pool.notice() {
        tracing::warn!(notice = notice.en, "the sandbox is not closed");
    }
    Ok(pool)
}

/// Starts the workers; a machine that is busy with starting everything else gets more than one chance.
fn start_pool(settings: &Settings, workers: usize) -> Result<Pool, Fault> {
    let mut attempts = 1;
    loop {
        match Pool::start(settings.clone(), workers) {
            Ok(pool) => return Ok(pool),
            Err(fault) if attempts >= MOST_STARTS => return Err(fault),
            Err(fault) => tracing::warn!(fault = fault.message.en, "the workers did not start"),
        }
        attempts += 1;
    }
}

fn cannot_listen(address: SocketAddr, error: &std::io::Error) -> Fault {
    Fault::new(Text::new(
        format!("cannot listen on {address}: {error}"),
        format!("{address} で待ち受けできません: {error}"),
    ))
    .remedy(Text::new("Choose another port with --listen.", "--listen で別のポートを指定してください。"))
}

pub(super) fn database(error: &StoreError) -> Fault {
    Fault::new(Text::new(format!("the database: {error}"), format!("データベースの障害: {error}")))
}

/// Keeps the hash of the teacher's password, and ends every teacher's session.
pub async fn set_teacher_password(config: &Config, password: &str) -> Result<(), Fault> {
    let store = open(config).await?;
    let hash = super::identity::hash_password(password)?;
    let kept = store.set_setting(super::identity::PASSWORD_SETTING, &hash).await;
    kept.map_err(|error| database(&error))?;
    store.close_session(None).await.map_err(|error| database(&error))?;
    store.close().await;
    Ok(())
}
