//! What is asked of the workers, and what comes of it.

use crate::grade::Order;
use crate::hand_in::HandIn;
use crate::report::{Picture, Report};
use reference::Assignment;
use std::sync::Arc;

/// What is to be graded.
#[derive(Clone, Copy, Debug)]
pub struct GradingTask<'a> {
    /// The homework.
    pub assignment: &'a Arc<Assignment>,
    /// Its files.
    pub hand_in: &'a HandIn,
    /// How it is to be graded.
    pub order: Order,
    /// Whether the frames are wanted, not only their comparison.
    pub wants_frames: bool,
}

/// A graded submission.
#[derive(Clone, Debug)]
pub struct GradedSubmission {
    /// The report.
    pub report: Report,
    /// The student's frames, where they were wanted and drawn. Gradings that draw alike share them.
    pub frames: Arc<[Picture]>,
}

impl GradingTask<'_> {
    /// Bytes of all frames of a grading.
    pub(super) fn frames_bytes(&self) -> usize {
        let scene = &self.assignment.scene;
        scene.all_poses().len() * scene.width as usize * scene.height as usize * 4
    }
}
