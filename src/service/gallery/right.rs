//! The pictures of right answers, which each homework has once.

use crate::batch::portrait::{self, Portraits};
use crate::fault::Fault;
use crate::pictures::expected_pictures;
use crate::report::pictures;
use crate::service::State;
use crate::service::blocking::blocking;
use crate::service::errors::Problem;
use reference::Assignment;
use std::sync::{Arc, OnceLock};

/// What a right answer to a homework draws, encoded when it is first asked for.
#[derive(Debug)]
pub struct RightPictures {
    assignment: Arc<Assignment>,
    poses: OnceLock<Vec<Vec<u8>>>,
    portraits: OnceLock<Portraits>,
    moving: OnceLock<Vec<u8>>,
}

impl RightPictures {
    /// Those of a homework.
    pub fn new(assignment: Arc<Assignment>) -> Self {
        Self { assignment, poses: OnceLock::new(), portraits: OnceLock::new(), moving: OnceLock::new() }
    }

    /// How portraits are made, and the right one.
    pub fn portraits(&self) -> Result<&Portraits, Fault> {
        if let Some(portraits) = self.portraits.get() {
            return Ok(portraits);
        }
        let portraits = Portraits::new(&self.assignment)?;
        Ok(self.portraits.get_or_init(|| portraits))
    }

    /// What a right answer draws, small and moving.
    fn moving(&self) -> Result<Vec<u8>, Fault> {
        if let Some(moving) = self.moving.get() {
            return Ok(moving.clone());
        }
        let moving = portrait::moving(&self.assignment)?;
        Ok(self.moving.get_or_init(|| moving).clone())
    }

    /// One pose, from 0.
    pub(super) fn pose(&self, index: usize) -> Result<Option<Vec<u8>>, Fault> {
        if let Some(poses) = self.poses.get() {
            return Ok(poses.get(index).cloned());
        }
        let all = expected_pictures(&self.assignment).iter().map(pictures::png).collect::<Result<_, _>>()?;
        Ok(self.poses.get_or_init(|| all).get(index).cloned())
    }
}

/// What a right answer to a homework draws, small and moving.
pub async fn goal(state: &State) -> Result<Vec<u8>, Problem> {
    blocking(state, |state| state.right.moving()).await
}
