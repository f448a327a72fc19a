//! The pictures of a submission, drawn again when somebody looks at them.
//!
//! A grading keeps no pictures: drawing them again takes as long as a grading, keeping them would take a hundred times
//! the room of everything else. [`Gallery::frames`] is the only place that runs a file for its pictures; all others are
//! made of what it gives. What was made lately is kept in memory, whoever handed the file in, and many who ask at once
//! wait for one drawing.

mod right;

pub use right::{RightPictures, draw_all, drawn, goal, portrait_of_right};

use super::State;
use super::blocking::blocking;
use super::errors::Problem;
use super::store::Submission;
use crate::fault::Fault;
use crate::grade::Order;
use crate::pictures::expected_pictures;
use crate::report::html::{Film, FilmUse};
use crate::report::{Picture, Pictures, pictures};
use crate::sandbox;
use moka::future::Cache;
use std::future::Future;
use std::sync::Arc;
use tokio::sync::Semaphore;

/// Bytes of pictures that are kept in memory.
const ROOM: u64 = 96 << 20;

/// Which pictures.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, serde::Deserialize, utoipa::ToSchema)]
#[serde(rename_all = "lowercase")]
#[schema(as = View)]
pub enum PictureSet {
    /// What the student's shader draws.
    #[default]
    Yours,
    /// What a right answer draws.
    Expected,
    /// Where the two differ.
    Difference,
    /// The three side by side.
    All,
}

/// Encoded pictures that belong together; none where nothing is drawn.
pub type Pngs = Vec<Vec<u8>>;

/// What is kept: pictures of one kind of one hand-in.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct GalleryKey {
    /// The digest of the homework's folder: the same hand-in draws something else for another one.
    assignment: String,
    /// The digest of the hand-in; empty for pictures of a right answer.
    sha256: String,
    kind: GalleryItem,
}

#[derive(Clone, Debug, PartialEq, Eq, Hash)]
enum GalleryItem {
    /// Each pose as the shader draws it.
    Frames,
    /// Where each pose differs.
    Differences,
    /// The two sheets of the moving pictures: yours, difference.
    Film,
    /// All poses as one animated PNG.
    Animation(PictureSet),
    /// What a report says of the file, in pictures: which, and the part of the report that they show.
    Report(String),
}

/// The pictures made lately.
#[derive(Debug)]
pub struct Gallery {
    kept: Cache<GalleryKey, Arc<Pngs>>,
    /// One file is run at a time: who looks does not take the processors from who hands in.
    turn: Semaphore,
}

impl Default for Gallery {
    fn default() -> Self {
        let weight = |_: &GalleryKey, pngs: &Arc<Pngs>| {
            u32::try_from(pngs.iter().map(Vec::len).sum::<usize>()).unwrap_or(u32::MAX)
        };
        Self { kept: Cache::builder().max_capacity(ROOM).weigher(weight).build(), turn: Semaphore::new(1) }
    }
}

impl GalleryKey {
    fn new(state: &State, sha256: &str, kind: GalleryItem) -> Self {
        Self { assignment: state.assignment.digest.clone(), sha256: sha256.to_owned(), kind }
    }
}

impl Gallery {
    /// Each pose as the shader draws it. None where the file was refused or stopped: it is not run again for who looks.
    async fn frames(&self, state: &State, submission: &Submission) -> Result<Arc<Pngs>, Problem> {
        if !state.store.is_drawn(&submission.id).await? {
            return Ok(Arc::default());
        }
        let run = async {
            let hand_in = state.store.hand_in(&submission.id).await?.ok_or_else(Problem::not_found)?;
            let order = Order { seed: submission.seed, hints: submission.hints, ..Order::default() };
            self.in_turn(state, move |state| {
                let assignment = &state.assignment;
                let submission = sandbox::GradingTask { assignment, hand_in: &hand_in, order, wants_frames: true };
                let frames = state.pool.grade(submission)?.frames;
                frames.iter().map(pictures::png).collect()
            })
            .await
        };
        self.once(GalleryKey::new(state, &submission.sha256, GalleryItem::Frames), run).await
    }

    /// Does work that takes a worker and that nobody who hands in waits for: one at a time.
    pub async fn in_turn<T: Send + 'static>(
        &self,
        state: &State,
        work: impl FnOnce(&State) -> Result<T, Fault> + Send + 'static,
    ) -> Result<T, Problem> {
        let _turn = self.turn.acquire().await;
        blocking(state, work).await
    }

    /// What is kept under a key; made where nothing is, once for all who ask meanwhile.
    async fn once(
        &self,
        key: GalleryKey,
        make: impl Future<Output = Result<Pngs, Problem>>,
    ) -> Result<Arc<Pngs>, Problem> {
        let made = self.kept.try_get_with(key, async { make.await.map(Arc::new) });
        made.await.map_err(|problem: Arc<Problem>| Problem::clone(&problem))
    }

    /// Pictures that are made of the frames; none where there are no frames.
    async fn made_of_frames(
        &self,
        state: &State,
        submission: &Submission,
        kind: GalleryItem,
        make: impl FnOnce(Arc<[Picture]>, &Arc<[Picture]>) -> Result<Pngs, Fault> + Send + 'static,
    ) -> Result<Arc<Pngs>, Problem> {
        let frames = self.frames(state, submission).await?;
        if frames.is_empty() {
            return Ok(frames);
        }
        let make = blocking(state, move |state| make(decoded(&frames)?, &expected_pictures(&state.assignment)));
        self.once(GalleryKey::new(state, &submission.sha256, kind), make).await
    }

    /// One picture of a pose, from 0; none where there is no such pose, or nothing was drawn.
    pub async fn frame(
        &self,
        state: &State,
        submission: &Submission,
        view: PictureSet,
        index: usize,
    ) -> Result<Option<Vec<u8>>, Problem> {
        let all = match view {
            PictureSet::Expected => return blocking(state, move |state| state.right.pose(index)).await,
            PictureSet::Yours | PictureSet::All => self.frames(state, submission).await?,
            PictureSet::Difference => {
                let differences = |yours: Arc<[Picture]>, expected: &Arc<[Picture]>| {
                    yours.iter().zip(expected.iter()).map(|(a, b)| pictures::difference_png(a, b)).collect()
                };
                self.made_of_frames(state, submission, GalleryItem::Differences, differences).await?
            }
        };
        if view != PictureSet::All {
            return Ok(all.get(index).cloned());
        }
        blocking(state, move |state| {
            let Some(yours) = all.get(index) else { return Ok(None) };
            let assignment = &state.assignment;
            let expected = expected_pictures(assignment).get(index).cloned();
            let (yours, expected) = ([pictures::decode(yours)?].into(), expected.into_iter().collect());
            let cycle = assignment.scene.cycle;
            pictures::animation(&Pictures { yours, expected, terms: Arc::default(), cycle }).map(Some)
        })
        .await
    }

    /// All poses of a view as one animated PNG; none where nothing was drawn.
    pub async fn animation(
        &self,
        state: &State,
        submission: &Submission,
        view: PictureSet,
    ) -> Result<Option<Vec<u8>>, Problem> {
        let kind = GalleryItem::Animation(view);
        let cycle = state.assignment.scene.cycle;
        let drawn = if view == PictureSet::Expected {
            let make = blocking(state, move |state| {
                Ok(vec![pictures::animated(&expected_pictures(&state.assignment), cycle)?])
            });
            self.once(GalleryKey::new(state, "", kind), make).await?
        } else {
            let make = move |yours, expected: &Arc<[Picture]>| {
                let pictures = Pictures { yours, expected: Arc::clone(expected), terms: Arc::default(), cycle };
                Ok(vec![match view {
                    PictureSet::Difference => pictures::animated(&differences(&pictures)?, cycle)?,
                    PictureSet::All => pictures::animation(&pictures)?,
                    PictureSet::Yours | PictureSet::Expected => pictures::animated(&pictures.yours, cycle)?,
                }])
            };
            self.made_of_frames(state, submission, kind, make).await?
        };
        Ok(drawn.first().cloned())
    }

    /// The two sheets of the moving pictures, yours and difference; none where nothing was drawn.
    pub async fn film(&self, state: &State, submission: &Submission) -> Result<Arc<Pngs>, Problem> {
        let make = |yours: Arc<[Picture]>, expected: &Arc<[Picture]>| {
            let film = Film::of(&yours, expected, FilmUse::Served)?;
            Ok(film.map(|film| vec![film.yours.clone(), film.difference.clone()]).unwrap_or_default())
        };
        self.made_of_frames(state, submission, GalleryItem::Film, make).await
    }

    /// What was drawn, as a report's own page takes it; empty where nothing was.
    pub async fn decoded(&self, state: &State, submission: &Submission) -> Result<Arc<[Picture]>, Problem> {
        let frames = self.frames(state, submission).await?;
        blocking(state, move |_| decoded(&frames)).await
    }

    /// A picture of what a report says of a file; the file is not run for it. `shown` tells it from others.
    pub async fn of_report(
        &self,
        state: &State,
        sha256: &str,
        shown: String,
        draw: impl FnOnce(&State) -> Result<Option<Vec<u8>>, Fault> + Send + 'static,
    ) -> Result<Arc<Pngs>, Problem> {
        let make = blocking(state, move |state| Ok(draw(state)?.into_iter().collect()));
        self.once(GalleryKey::new(state, sha256, GalleryItem::Report(shown)), make).await
    }

    /// The small picture of a submission for class tables, a PNG: kept in the database, since a table shows hundreds. None
    /// where nothing is drawn.
    pub async fn portrait(&self, state: &State, submission: &Submission) -> Result<Option<Vec<u8>>, Problem> {
        let (assignment, sha256) = (&state.assignment.digest, &submission.sha256);
        if let Some(kept) = state.store.portrait(assignment, sha256).await?.flatten()
            && state.store.is_drawn(&submission.id).await?
        {
            return Ok(Some(kept));
        }
        let frames = self.frames(state, submission).await?;
        if frames.is_empty() {
            return Ok(None);
        }
        let portrait = blocking(state, move |state| state.right.portraits()?.of(&decoded(&frames)?)).await?;
        state.store.set_portrait(assignment, sha256, portrait.as_deref()).await?;
        Ok(portrait)
    }

    /// Forgets every picture of a file.
    pub async fn forget(&self, sha256: &str) {
        let keys: Vec<Arc<GalleryKey>> =
            self.kept.iter().map(|(key, _)| key).filter(|key| key.sha256 == sha256).collect();
        for key in keys {
            self.kept.invalidate(&*key).await;
        }
    }
}

fn decoded(pngs: &Pngs) -> Result<Arc<[Picture]>, Fault> {
    pngs.iter().map(|png| pictures::decode(png)).collect()
}

fn differences(pictures: &Pictures) -> Result<Vec<Picture>, Fault> {
    let pairs = pictures.yours.iter().zip(pictures.expected.iter());
    pairs.map(|(a, b)| pictures::decode(&pictures::difference_png(a, b)?)).collect()
}
