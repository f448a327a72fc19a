//! The preview of a homework whose folder its teacher still writes: one address, and behind it the folder as it is.
//!
//! Each version of the folder has a [`Service`] of its own on the one database, so that no request sees two versions. Where
//! the folder is none of an assignment, every address answers with what is wrong. Pages hear of a new version by
//! server-sent events, which outlive the versions.

use super::clock::Clock;
use super::grading::{Graders, Judge};
use super::identity::Identity;
use super::pages;
use super::store::Via;
use super::submit::{Receipt, Upload, submit};
use super::{Config, Service, State, app, layered, server};
use crate::fault::Fault;
use crate::hand_in::HandIn;
use crate::language::Text;
use crate::sandbox::{GradedSubmission, GradingTask};
use crate::slots::{handed_out, solution};
use axum::Router;
use axum::extract::{Query, Request, State as Shared};
use axum::response::sse::{Event, KeepAlive, Sse};
use axum::response::{IntoResponse, Response};
use axum::routing::get;
use reference::Assignment;
use serde::Deserialize;
use std::convert::Infallible;
use std::net::SocketAddr;
use std::sync::{Arc, OnceLock};
use tokio::sync::watch;
use tokio::task::JoinHandle;
use tower::ServiceExt;

/// Where pages hear that the folder has changed.
const EVENTS: &str = "/preview/events";

/// A running preview.
#[derive(Debug)]
pub struct Preview {
    /// Where it listens.
    pub address: SocketAddr,
    /// What answers where there is no homework; it ends with the preview.
    shell: Service,
    front: watch::Sender<Front>,
    serving: JoinHandle<()>,
    /// The homework that is shown, and what grades for it.
    homework: Option<(Service, Graders)>,
}

/// What stands behind the address.
#[derive(Clone, Debug)]
struct Front {
    /// Counts the versions of the folder.
    version: u64,
    /// Whether the folder's own files are graded.
    is_graded: bool,
    shown: PreviewedFolder,
}

#[derive(Clone, Debug)]
enum PreviewedFolder {
    Homework(Router),
    Broken(Text),
}

/// What the pages of a homework know of the folder that they preview.
#[derive(Debug)]
pub struct FolderVersion {
    /// Which version of the folder it is.
    pub version: u64,
    /// What came of its own files, as soon as they are graded.
    pub own: OnceLock<OwnFiles>,
}

/// The folder's own files, handed in as drafts.
#[derive(Clone, Debug)]
pub struct OwnFiles {
    /// The solution, which has to have full marks.
    pub solution: Receipt,
    /// What is handed out, which has to run and not to be right.
    pub starter: Receipt,
}

/// Grades nothing: there is no homework.
#[derive(Debug)]
struct NoGrading;

impl Judge for NoGrading {
    fn grade(&self, _: GradingTask<'_>) -> Result<GradedSubmission, Fault> {
        Err(Fault::new(Text::verbatim("a preview without a homework grades nothing")))
    }
}

impl Preview {
    /// Opens the database and listens. Until the first version is shown, pages say that the folder is being read.
    pub async fn start(config: Config) -> Result<Self, Fault> {
        let store = server::open(&config).await?;
        let (listener, address) = server::listen(config.listen).await?;
        let shell = Service::serving(Vec::new(), config, store, Arc::new(NoGrading), Clock::system()).await?;
        let reading = Text::new("The folder is being read.", "フォルダを読み込んでいます。");
        let front = watch::Sender::new(Front { version: 0, is_graded: false, shown: PreviewedFolder::Broken(reading) });
        let door = door(&shell, &front);
        let serving = tokio::spawn(server::accept(listener, door, shell.clone()));
        Ok(Self { address, shell, front, serving, homework: None })
    }

    /// Shows what a folder is now. What came of its own files, where it is an assignment.
    pub async fn show(&mut self, folder: Result<Arc<Assignment>, Text>) -> Result<Option<OwnFiles>, Fault> {
        let assignment = match folder {
            Ok(assignment) => assignment,
            Err(why) => {
                self.replace(PreviewedFolder::Broken(why), None);
                return Ok(None);
            }
        };
        let config = self.shell.config.clone();
        let pool = Arc::new(server::pool(&config, &[Arc::clone(&assignment)]).await?);
        let (store, clock) = (self.shell.store.clone(), Clock::system());
        let service = Service::serving(vec![Arc::clone(&assignment)], config, store, pool.clone(), clock).await?;
        let graders = Graders::start(&service).await.map_err(|error| server::database(&error))?;
        // The page is shown with its pictures, and when there is somebody to grade, not before.
        let warmed = tokio::task::spawn_blocking(move || {
            pages::warm(&assignment);
            pool.warm()
        });
        warmed.await.map_err(|panic| Fault::new(Text::verbatim(panic.to_string())))??;
        let version = self.front.borrow().version + 1;
        let _ = service.preview.set(FolderVersion { version, own: OnceLock::new() });
        self.replace(PreviewedFolder::Homework(app(service.clone())), Some((service.clone(), graders)));
        let Some(state) = service.only() else { return Ok(None) };
        let own = own_files(&state).await?;
        if let Some(shown) = service.preview.get() {
            let _ = shown.own.set(own.clone());
        }
        self.front.send_modify(|front| front.is_graded = true);
        Ok(Some(own))
    }

    /// Puts another version in the place of the one that is shown, whose gradings end.
    fn replace(&mut self, shown: PreviewedFolder, homework: Option<(Service, Graders)>) {
        self.front.send_modify(|front| {
            *front = Front { version: front.version + 1, is_graded: false, shown };
        });
        if let Some((service, graders)) = std::mem::replace(&mut self.homework, homework) {
            service.end();
            tokio::spawn(graders.finish());
        }
    }

    /// Lets what is under way be finished, and closes the database.
    pub async fn end(mut self) {
        if let Some((service, graders)) = self.homework.take() {
            service.end();
            graders.finish().await;
        }
        self.shell.end();
        let _ = self.serving.await;
        self.shell.store.close().await;
    }
}

/// Grades the folder's own files, each as somebody who tries it.
async fn own_files(state: &State) -> Result<OwnFiles, Fault> {
    let receipt = async |hand_in: HandIn| {
        let address = std::net::Ipv6Addr::LOCALHOST.into();
        let upload = Upload { hand_in, identity: Identity::Nobody, via: Via::Editor, hints: None, key: None, address };
        submit(state, upload).await.map_err(|problem| Fault::new(problem.detail))
    };
    let solution = receipt(solution(&state.assignment)).await?;
    let starter = receipt(handed_out(&state.assignment)).await?;
    Ok(OwnFiles { solution, starter })
}

/// The addresses of a preview.
fn door(shell: &Service, front: &watch::Sender<Front>) -> Router {
    let at = front.clone();
    let watched = front.clone();
    let routes = pages::router(shell)
        .route(
            EVENTS,
            get(async move |Shared(shell): Shared<Service>, Query(seen): Query<PreviewQuery>| {
                events(shell, watched.subscribe(), seen)
            }),
        )
        .fallback(async move |frame: pages::PageFrame| {
            let front = at.borrow().clone();
            let why = match front.shown {
                PreviewedFolder::Broken(why) => why,
                // The folder was mended this very moment.
                PreviewedFolder::Homework(_) => Text::default(),
            };
            pages::broken_folder(frame, &why, front.version)
        });
    let shell = layered(shell.clone(), routes);
    let front = front.clone();
    Router::new().fallback(async move |request: Request| -> Result<Response, Infallible> {
        let shown = front.borrow().shown.clone();
        match shown {
            PreviewedFolder::Homework(app) if request.uri().path() != EVENTS => app.oneshot(request).await,
            _ => shell.oneshot(request).await,
        }
    })
}

/// What a page knows already.
#[derive(Clone, Copy, Debug, Deserialize)]
struct PreviewQuery {
    version: u64,
    #[serde(default)]
    graded: bool,
}

/// Server-sent events: `folder` where another version is shown than the page has, `graded` where that version's own files
/// are graded and the page does not show it.
fn events(shell: Service, front: watch::Receiver<Front>, seen: PreviewQuery) -> Response {
    let changes = futures_util::stream::unfold((shell, front, seen), async |(shell, mut front, mut seen)| {
        loop {
            let (version, is_graded) = {
                let now = front.borrow_and_update();
                (now.version, now.is_graded)
            };
            let event = |name| Some(Ok::<_, Infallible>(Event::default().event(name).data("{}")));
            let news = if version != seen.version {
                seen = PreviewQuery { version, graded: false };
                event("folder")
            } else if is_graded && !seen.graded {
                seen.graded = true;
                event("graded")
            } else {
                None
            };
            if let Some(news) = news {
                return Some((news, (shell, front, seen)));
            }
            tokio::select! {
                changed = front.changed() => changed.ok()?,
                () = shell.ended() => return None,
            }
        }
    });
    Sse::new(changes).keep_alive(KeepAlive::default()).into_response()
}
