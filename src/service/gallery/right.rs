//! The pictures of right answers, which each homework has once.

use crate::class::portrait::{self, Portraits};
use crate::fault::Fault;
use crate::pictures::expected_pictures;
use crate::report::pictures;
use crate::service::blocking::blocking;
use crate::service::errors::Problem;
use crate::service::{Service, State, pages};
use reference::Assignment;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// What a right answer to a homework draws, encoded when it is first asked for.
#[derive(Debug)]
pub struct RightPictures {
    assignment: Arc<Assignment>,
    /// What the homework's pages load.
    of_pages: Once<()>,
    poses: Once<Vec<Vec<u8>>>,
    portraits: Once<Portraits>,
    moving: Once<Vec<u8>>,
    /// Who waits for them waits here, where that takes no thread.
    turn: tokio::sync::Mutex<()>,
}

/// What is made when it is first asked for; whoever asks meanwhile gets the same.
#[derive(Debug)]
struct Once<T> {
    made: OnceLock<T>,
    turn: Mutex<()>,
}

impl<T> Once<T> {
    fn new() -> Self {
        Self { made: OnceLock::new(), turn: Mutex::new(()) }
    }

    fn get(&self, make: impl FnOnce() -> Result<T, Fault>) -> Result<&T, Fault> {
        if let Some(made) = self.made.get() {
            return Ok(made);
        }
        let _turn = self.turn.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(made) = self.made.get() {
            return Ok(made);
        }
        let made = make()?;
        Ok(self.made.get_or_init(|| made))
    }
}

impl RightPictures {
    /// Those of a homework.
    pub fn new(assignment: Arc<Assignment>) -> Self {
        let (of_pages, poses, portraits, moving) = (Once::new(), Once::new(), Once::new(), Once::new());
        Self { assignment, of_pages, poses, portraits, moving, turn: tokio::sync::Mutex::default() }
    }

    /// How portraits are made, and the right one. Making them takes a second or two.
    pub fn portraits(&self) -> Result<&Portraits, Fault> {
        self.portraits.get(|| Portraits::new(&self.assignment))
    }

    /// What a right answer draws, small and moving.
    fn moving(&self) -> Result<&Vec<u8>, Fault> {
        self.moving.get(|| portrait::moving(&self.assignment))
    }

    /// One pose, from 0.
    pub(super) fn pose(&self, index: usize) -> Result<Option<Vec<u8>>, Fault> {
        let all = || expected_pictures(&self.assignment).iter().map(pictures::png).collect();
        Ok(self.poses.get(all)?.get(index).cloned())
    }

    fn draw_for_pages(&self) -> Result<(), Fault> {
        let draw = || {
            pages::warm(&self.assignment);
            Ok(())
        };
        self.of_pages.get(draw).copied()
    }
}

/// Does work with the right pictures of a homework, one after another.
async fn in_turn<T: Send + 'static>(
    state: &State,
    work: impl FnOnce(&RightPictures) -> Result<T, Fault> + Send + 'static,
) -> Result<T, Problem> {
    let right = Arc::clone(&state.right);
    let _turn = right.turn.lock().await;
    blocking(state, move |state| work(&state.right)).await
}

/// What a right answer to a homework draws, small and moving.
pub async fn goal(state: &State) -> Result<Vec<u8>, Problem> {
    match state.right.moving.made.get() {
        Some(made) => Ok(made.clone()),
        None => in_turn(state, |right| right.moving().cloned()).await,
    }
}

/// The same at one pose, as portraits of what was handed in show it.
pub async fn portrait_of_right(state: &State) -> Result<Vec<u8>, Problem> {
    match state.right.portraits.made.get() {
        Some(made) => Ok(made.expected.clone()),
        None => in_turn(state, |right| Ok(right.portraits()?.expected.clone())).await,
    }
}

/// Draws what the pages of a homework load, where that is not done yet: a page has its address, which is made of it.
pub async fn drawn(state: &State) -> Result<(), Problem> {
    match state.right.of_pages.made.get() {
        Some(()) => Ok(()),
        None => in_turn(state, RightPictures::draw_for_pages).await,
    }
}

/// Draws all of it for every homework, one after another, so that the first who look do not wait.
pub async fn draw_all(service: Service) {
    for state in service.everywhere().iter().flat_map(|course| course.homeworks().collect::<Vec<_>>()) {
        if service.is_ending() {
            return;
        }
        let all = async {
            portrait_of_right(&state).await?;
            goal(&state).await?;
            drawn(&state).await
        };
        if let Err(problem) = all.await {
            tracing::error!(assignment = state.assignment.id, problem = problem.detail.en, "no right pictures");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicUsize, Ordering};

    #[test]
    fn what_many_ask_for_at_once_is_made_once() {
        let (once, makings) = (Once::new(), AtomicUsize::new(0));
        let make = || {
            std::thread::sleep(std::time::Duration::from_millis(50));
            Ok(makings.fetch_add(1, Ordering::SeqCst))
        };
        std::thread::scope(|scope| {
            for _ in 0..8 {
                scope.spawn(|| assert_eq!(once.get(make).expect("made"), &0));
            }
        });
        assert_eq!(makings.load(Ordering::SeqCst), 1);
    }
}
