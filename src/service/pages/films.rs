//! The moving pictures of a submission: drawn when a page first shows them, kept for a while.

use crate::grade::Order;
use crate::homework::expected_pictures;
use crate::report::Picture;
use crate::report::html::Film;
use crate::sandbox;
use crate::service::State;
use crate::service::errors::Problem;
use crate::service::gallery::blocking;
use crate::service::store::Submission;
use std::collections::VecDeque;
use std::sync::{Arc, Mutex, PoisonError};
use tokio::sync::{OnceCell, Semaphore};

/// Films that are kept; the largest has some hundred kilobytes.
const MOST: usize = 128;

type Cell = Arc<OnceCell<Option<Arc<Film>>>>;

/// The films drawn lately.
#[derive(Debug)]
pub struct Films {
    recent: Mutex<VecDeque<(String, Cell)>>,
    /// One is drawn at a time: who looks leaves the other processors to who hands in.
    turn: Semaphore,
}

impl Default for Films {
    fn default() -> Self {
        Self { recent: Mutex::default(), turn: Semaphore::new(1) }
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
}

/// The film of a submission, drawn once for all who ask at once; none where nothing is drawn.
pub(super) async fn film(state: &State, submission: &Submission) -> Result<Option<Arc<Film>>, Problem> {
    let cell = state.films.cell(&submission.sha256);
    let film = cell.get_or_try_init(|| async {
        let yours = frames(state, submission).await?;
        let film = blocking(state, move |state| {
            if yours.is_empty() { Ok(None) } else { Film::of(&yours, &expected_pictures(state.assignment), 1) }
        });
        Ok::<_, Problem>(film.await?.map(Arc::new))
    });
    film.await.cloned()
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
