//! The moving pictures of a submission and its portrait: drawn when a page first shows them, kept for a while.

use crate::fault::Fault;
use crate::grade::Order;
use crate::report::html::Film;
use crate::report::{Picture, Pictures, pictures};
use crate::sandbox;
use crate::service::State;
use crate::service::errors::Problem;
use crate::service::store::Submission;
use std::collections::VecDeque;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use tokio::sync::{OnceCell, Semaphore};

/// Films that are kept; the largest has some hundred kilobytes.
const MOST: usize = 128;

/// The pose of a portrait: at its beginning the animation shows the face from the front, with all terms of the equation.
const POSE: usize = 0;

/// Every how many pixels one is taken for a portrait: 160 × 120 of the course's 640 × 480.
const PORTRAIT_STEP: usize = 4;

type Cell = Arc<OnceCell<Option<Arc<Film>>>>;

/// The films drawn lately.
#[derive(Debug)]
pub struct Films {
    recent: Mutex<VecDeque<(String, Cell)>>,
    expected: OnceLock<Arc<Vec<Picture>>>,
    /// One is drawn at a time: who looks leaves the other processors to who hands in.
    turn: Semaphore,
}

impl Default for Films {
    fn default() -> Self {
        Self { recent: Mutex::default(), expected: OnceLock::new(), turn: Semaphore::new(1) }
    }
}

impl Films {
    fn cell(&self, sha256: &str) -> Cell {
        let mut recent = self.recent.lock().unwrap_or_else(PoisonError::into_inner);
        let known = recent.iter().position(|(key, _)| key == sha256).and_then(|index| recent.remove(index));
        let entry = known.unwrap_or_else(|| (sha256.to_owned(), Cell::default()));
        recent.push_back(entry.clone());
        while recent.len() > MOST {
            recent.pop_front();
        }
        entry.1
    }

    fn expected(&self, state: &State) -> Arc<Vec<Picture>> {
        Arc::clone(self.expected.get_or_init(|| Arc::new(crate::homework::expected_pictures(state.assignment))))
    }
}

/// The film of a submission, drawn once for all who ask at once; none where nothing is drawn.
pub(super) async fn film(state: &State, submission: &Submission) -> Result<Option<Arc<Film>>, Problem> {
    let cell = state.films.cell(&submission.sha256);
    let film = cell.get_or_try_init(|| async {
        let yours = frames(state, submission).await?;
        let film = blocking(state, move |state| {
            let expected = state.films.expected(state).as_ref().clone();
            if yours.is_empty() { Ok(None) } else { Film::of(&Pictures { yours, expected, terms: Vec::new() }, 1) }
        });
        Ok::<_, Problem>(film.await?.map(Arc::new))
    });
    film.await.cloned()
}

/// The small picture of a submission, drawn once and kept in the database; none where nothing is drawn.
pub(super) async fn portrait(state: &State, submission: &Submission) -> Result<Option<Vec<u8>>, Problem> {
    let Submission { assignment, sha256, .. } = submission;
    if let Some(kept) = state.store.portrait(assignment, sha256).await? {
        return Ok(kept);
    }
    let drawn = frames(state, submission).await?;
    let png = blocking(state, move |_| drawn.get(POSE).map(|picture| pictures::png(&smaller(picture))).transpose());
    let png = png.await?;
    state.store.set_portrait(assignment, sha256, png.as_deref()).await?;
    Ok(png)
}

/// What a right answer's portrait looks like.
pub(super) fn expected_portrait(state: &State) -> Result<Option<Vec<u8>>, Fault> {
    state.films.expected(state).get(POSE).map(|picture| pictures::png(&smaller(picture))).transpose()
}

/// Every so manieth pixel of every so manieth row: no colour is invented.
fn smaller(picture: &Picture) -> Picture {
    let row = picture.width as usize * 4;
    let rows = picture.rgba.chunks_exact(row.max(1)).step_by(PORTRAIT_STEP);
    let rgba = rows.flat_map(|row| row.chunks_exact(4).step_by(PORTRAIT_STEP).flatten().copied());
    let side = |side: u32| side.div_ceil(PORTRAIT_STEP as u32);
    Picture { width: side(picture.width), height: side(picture.height), rgba: rgba.collect() }
}

async fn frames(state: &State, submission: &Submission) -> Result<Vec<Picture>, Problem> {
    let bytes = state.store.upload(&submission.sha256).await?.ok_or_else(Problem::not_found)?;
    let order = Order { seed: submission.seed, hints: submission.hints };
    let _turn = state.films.turn.acquire().await;
    blocking(state, move |state| {
        let submission = sandbox::Submission { name: "", bytes: &bytes, order, wants_frames: true };
        Ok(state.pool.grade(submission)?.frames)
    })
    .await
}

/// Does work that takes a processor for a while.
async fn blocking<T: Send + 'static>(
    state: &State,
    work: impl FnOnce(&State) -> Result<T, Fault> + Send + 'static,
) -> Result<T, Problem> {
    let state = state.clone();
    match tokio::task::spawn_blocking(move || work(&state)).await {
        Ok(result) => result.map_err(|fault| Problem::internal(&fault)),
        Err(panic) => Err(Problem::internal(&panic)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_portrait_has_every_fourth_pixel() {
        // Nine pixels wide, five high, numbered along the rows in their red.
        let rgba = (0..45u8).flat_map(|index| [index, 0, 0, 255]).collect();
        let small = smaller(&Picture { width: 9, height: 5, rgba });
        assert_eq!((small.width, small.height), (3, 2));
        let reds: Vec<u8> = small.rgba.chunks_exact(4).map(|pixel| pixel[0]).collect();
        assert_eq!(reds, [0, 4, 8, 36, 40, 44]);
    }
}
