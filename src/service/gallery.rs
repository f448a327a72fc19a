//! The pictures of a submission, drawn again when somebody looks at them.
//!
//! A grading keeps no pictures: drawing them again takes as long as a grading, keeping them would take a hundred times
//! the room of everything else. What was drawn lately is kept in memory, whoever handed the file in.

use super::State;
use super::errors::Problem;
use super::store::Submission;
use crate::batch::portrait::Portraits;
use crate::fault::Fault;
use crate::grade::Order;
use crate::report::{Picture, Pictures, pictures};
use crate::sandbox;
use reference::Assignment;
use std::collections::VecDeque;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use tokio::sync::{OnceCell, Semaphore};

/// Bytes of pictures that are kept in memory.
const ROOM: usize = 96 << 20;

/// Files whose pictures are kept, however small they are.
const MOST: usize = 512;

/// Which pictures.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Deserialize, utoipa::ToSchema)]
#[serde(rename_all = "lowercase")]
pub enum View {
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

/// The pictures of one file, encoded.
#[derive(Debug, Default)]
pub struct Drawn {
    /// What the student's shader draws, a PNG for each pose; empty where it draws nothing.
    pub yours: Vec<Vec<u8>>,
    /// Where that differs from the right pictures.
    pub difference: Vec<Vec<u8>>,
    animations: [OnceLock<Vec<u8>>; 4],
}

/// The pictures of a file, or the place where those wait who asked for them.
type Cell = Arc<OnceCell<Arc<Drawn>>>;

/// The pictures drawn lately.
#[derive(Debug)]
pub struct Gallery {
    assignment: &'static Assignment,
    expected: OnceLock<Expected>,
    portraits: OnceLock<Portraits>,
    /// By SHA-256 of the file; those looked at last come last.
    recent: Mutex<VecDeque<(String, Cell)>>,
    /// One file is drawn at a time.
    turn: Semaphore,
}

#[derive(Debug)]
struct Expected {
    pictures: Arc<[Picture]>,
    encoded: Vec<Vec<u8>>,
}

impl Gallery {
    /// An empty gallery.
    pub fn new(assignment: &'static Assignment) -> Self {
        Self {
            assignment,
            expected: OnceLock::new(),
            portraits: OnceLock::new(),
            recent: Mutex::default(),
            turn: Semaphore::new(1),
        }
    }

    /// The pictures of a submission: from memory, or drawn anew. Many who ask at once wait for one drawing.
    pub async fn drawn(&self, state: &State, submission: &Submission) -> Result<Arc<Drawn>, Problem> {
        // What was refused or stopped once is not run again for who looks at it.
        if !state.store.is_drawn(&submission.id).await? {
            return Ok(Arc::default());
        }
        let cell = self.cell(&submission.sha256);
        let drawn = cell.get_or_try_init(|| self.draw(state, submission)).await.cloned();
        self.make_room();
        drawn
    }

    /// One picture of a pose, from 0; none where there is no such pose, or nothing was drawn.
    pub async fn frame(
        &self,
        state: &State,
        submission: &Submission,
        view: View,
        index: usize,
    ) -> Result<Option<Vec<u8>>, Problem> {
        if view == View::Expected {
            return blocking(state, move |state| Ok(state.gallery.expected()?.encoded.get(index).cloned())).await;
        }
        let drawn = self.drawn(state, submission).await?;
        if view == View::All {
            return blocking(state, move |state| {
                let Some(yours) = drawn.yours.get(index) else { return Ok(None) };
                let expected = state.gallery.expected()?.pictures.get(index).cloned();
                let pictures = Pictures {
                    yours: vec![pictures::decode(yours)?],
                    expected: expected.into_iter().collect(),
                    terms: Arc::default(),
                };
                pictures::animation(&pictures).map(Some)
            })
            .await;
        }
        let all = if view == View::Yours { &drawn.yours } else { &drawn.difference };
        Ok(all.get(index).cloned())
    }

    /// All poses of a view as one animated PNG; none where nothing was drawn.
    pub async fn animation(
        &self,
        state: &State,
        submission: &Submission,
        view: View,
    ) -> Result<Option<Vec<u8>>, Problem> {
        let drawn = self.drawn(state, submission).await?;
        if drawn.yours.is_empty() && view != View::Expected {
            return Ok(None);
        }
        blocking(state, move |state| state.gallery.animated(&drawn, view).map(Some)).await
    }

    /// What was drawn and what is expected, as the report's own page takes it.
    pub async fn pictures(&self, state: &State, submission: &Submission) -> Result<Option<Pictures>, Problem> {
        let drawn = self.drawn(state, submission).await?;
        if drawn.yours.is_empty() {
            return Ok(None);
        }
        blocking(state, move |state| {
            let yours = drawn.yours.iter().map(|png| pictures::decode(png)).collect::<Result<_, _>>()?;
            let expected = state.gallery.expected()?.pictures.clone();
            Ok(Some(Pictures { yours, expected, terms: Arc::default() }))
        })
        .await
    }

    /// The small picture of a submission for class tables, a PNG: kept in the database, since a table shows hundreds. None
    /// where nothing is drawn.
    pub async fn portrait(&self, state: &State, submission: &Submission) -> Result<Option<Vec<u8>>, Problem> {
        let Submission { assignment, sha256, .. } = submission;
        if !state.store.is_drawn(&submission.id).await? {
            return Ok(None);
        }
        if let Some(kept) = state.store.portrait(assignment, sha256).await? {
            return Ok(kept);
        }
        let bytes = state.store.upload(sha256).await?.ok_or_else(Problem::not_found)?;
        let _turn = self.turn.acquire().await;
        let order = Order { seed: submission.seed, hints: submission.hints };
        let portrait = blocking(state, move |state| {
            let submission = sandbox::Submission { name: "", bytes: &bytes, order, wants_frames: true };
            let frames = state.pool.grade(submission)?.frames;
            state.gallery.portraits()?.of(&frames)
        });
        let portrait = portrait.await?;
        state.store.set_portrait(assignment, sha256, portrait.as_deref()).await?;
        Ok(portrait)
    }

    /// How portraits are made, and the right one.
    pub fn portraits(&self) -> Result<&Portraits, Fault> {
        if let Some(portraits) = self.portraits.get() {
            return Ok(portraits);
        }
        let made = Portraits::new(self.assignment)?;
        Ok(self.portraits.get_or_init(|| made))
    }

    fn animated(&self, drawn: &Drawn, view: View) -> Result<Vec<u8>, Fault> {
        let cell = &drawn.animations[view as usize];
        if let Some(bytes) = cell.get() {
            return Ok(bytes.clone());
        }
        let decoded = |all: &[Vec<u8>]| all.iter().map(|png| pictures::decode(png)).collect::<Result<Vec<_>, _>>();
        let expected = &self.expected()?.pictures;
        let bytes = match view {
            View::Yours => pictures::animated(&decoded(&drawn.yours)?)?,
            View::Expected => pictures::animated(expected)?,
            View::Difference => pictures::animated(&decoded(&drawn.difference)?)?,
            View::All => {
                let yours = decoded(&drawn.yours)?;
                pictures::animation(&Pictures { yours, expected: expected.clone(), terms: Arc::default() })?
            }
        };
        Ok(cell.get_or_init(|| bytes).clone())
    }

    fn expected(&self) -> Result<&Expected, Fault> {
        if let Some(expected) = self.expected.get() {
            return Ok(expected);
        }
        let all = crate::homework::expected_pictures(self.assignment);
        let encoded = all.iter().map(pictures::png).collect::<Result<_, _>>()?;
        Ok(self.expected.get_or_init(|| Expected { pictures: all, encoded }))
    }

    async fn draw(&self, state: &State, submission: &Submission) -> Result<Arc<Drawn>, Problem> {
        let bytes = state.store.upload(&submission.sha256).await?.ok_or_else(Problem::not_found)?;
        // Who looks does not take the processors from who hands in.
        let _turn = self.turn.acquire().await;
        let order = Order { seed: submission.seed, hints: submission.hints };
        let drawn = blocking(state, move |state| {
            let submission = sandbox::Submission { name: "", bytes: &bytes, order, wants_frames: true };
            let yours = state.pool.grade(submission)?.frames;
            let expected = &state.gallery.expected()?.pictures;
            let pairs = yours.iter().zip(expected.iter());
            Ok(Drawn {
                difference: pairs.map(|(a, b)| pictures::difference_png(a, b)).collect::<Result<_, _>>()?,
                yours: yours.iter().map(pictures::png).collect::<Result<_, _>>()?,
                animations: Default::default(),
            })
        });
        drawn.await.map(Arc::new)
    }

    fn cell(&self, sha256: &str) -> Cell {
        let mut recent = self.recent.lock().unwrap_or_else(PoisonError::into_inner);
        let known = recent.iter().position(|(key, _)| key == sha256).and_then(|index| recent.remove(index));
        let entry = known.unwrap_or_else(|| (sha256.to_owned(), Arc::default()));
        recent.push_back(entry.clone());
        entry.1
    }

    /// Forgets what was not looked at for longest, until the rest has room.
    fn make_room(&self) {
        let mut recent = self.recent.lock().unwrap_or_else(PoisonError::into_inner);
        let size = |cell: &Cell| cell.get().map_or(0, |drawn| drawn.size());
        let mut total: usize = recent.iter().map(|(_, cell)| size(cell)).sum();
        while (total > ROOM || recent.len() > MOST) && recent.len() > 1 {
            if let Some((_, cell)) = recent.pop_front() {
                total -= size(&cell);
            }
        }
    }
}

impl Drawn {
    fn size(&self) -> usize {
        let animations = self.animations.iter().filter_map(OnceLock::get);
        self.yours.iter().chain(&self.difference).chain(animations).map(Vec::len).sum()
    }
}

/// Does work that takes a processor for a while.
pub async fn blocking<T: Send + 'static>(
    state: &State,
    work: impl FnOnce(&State) -> Result<T, Fault> + Send + 'static,
) -> Result<T, Problem> {
    let state = state.clone();
    match tokio::task::spawn_blocking(move || work(&state)).await {
        Ok(result) => result.map_err(|fault| Problem::of_fault(&fault)),
        Err(panic) => Err(Problem::internal(&panic)),
    }
}
