//! What right answers draw, as pictures: the whole, and each term on its own.

mod terms;

pub use terms::{Terms, term_pictures};

use crate::expected;
use crate::report::{Picture, SILHOUETTE};
use reference::Assignment;
use reference::rasteriser::{Coverage, Frame};
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};

/// What is drawn once a process, by the digest of the assignment. While one is drawn, nobody waits who wants another.
pub struct DrawnOnce<T>(Mutex<BTreeMap<String, OnceOfOne<T>>>);

type OnceOfOne<T> = Arc<OnceLock<Arc<[T]>>>;

impl<T> DrawnOnce<T> {
    /// Nothing is drawn yet.
    pub const fn empty() -> Self {
        Self(Mutex::new(BTreeMap::new()))
    }

    /// What is drawn for an assignment, drawn now where it is not there.
    pub fn of(&self, assignment: &Assignment, draw: impl FnOnce() -> Arc<[T]>) -> Arc<[T]> {
        let drawn = Arc::clone(self.locked().entry(assignment.digest.clone()).or_default());
        Arc::clone(drawn.get_or_init(draw))
    }

    /// All that is drawn by now.
    pub fn all(&self) -> Vec<Arc<[T]>> {
        self.locked().values().filter_map(|drawn| drawn.get().cloned()).collect()
    }

    fn locked(&self) -> MutexGuard<'_, BTreeMap<String, OnceOfOne<T>>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The reference's frames as pictures, drawn once a process.
pub fn expected_pictures(assignment: &Assignment) -> Arc<[Picture]> {
    static DRAWN: DrawnOnce<Picture> = DrawnOnce::empty();
    DRAWN.of(assignment, || expected::of_solution(assignment).map(|frame| picture(&frame)).collect())
}

/// A right picture; its alpha says where it may be drawn otherwise.
pub fn picture(frame: &Frame) -> Picture {
    let pixels = frame.pixels.iter().zip(&frame.coverage);
    let pixels: Vec<[u8; 4]> = pixels
        .map(|([r, g, b, _], coverage)| {
            [*r, *g, *b, if *coverage == Coverage::Silhouette { SILHOUETTE } else { u8::MAX }]
        })
        .collect();
    let blank = frame.pixels.iter().zip(&frame.coverage).find(|(_, coverage)| **coverage == Coverage::Outside);
    let blank = blank.map_or([u8::MAX; 4], |([r, g, b, _], _)| [*r, *g, *b, u8::MAX]);
    Picture::whole(frame.width, frame.height, pixels.into_flattened()).cut(blank)
}

/// The pose at which the picture says most: where the weakest term of the equation shows best. The brightness that each
/// term alone brings into the picture is held against the most that it brings at any pose, and the least of these shares
/// is what a pose is worth.
pub fn telling_pose(assignment: &Assignment) -> usize {
    static TOLD: DrawnOnce<usize> = DrawnOnce::empty();
    TOLD.of(assignment, || [told_pose(assignment)].into())[0]
}

fn told_pose(assignment: &Assignment) -> usize {
    let right = assignment.equation.right();
    let poses = assignment.scene.all_poses();
    let terms = assignment.rubric.iter().filter(|line| !line.alone_in.is_empty());
    let mut worth = vec![1.0_f64; poses.len()];
    for term in terms {
        let brightness: Vec<f64> = poses
            .iter()
            .map(|pose| assignment.term_frame(pose, &right, &term.judges).map_or(0.0, |frame| brightness(&frame)))
            .collect();
        let most = brightness.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
        for (worth, brightness) in worth.iter_mut().zip(brightness) {
            *worth = worth.min(brightness / most);
        }
    }
    // Of equals the first: the one that the course's window opens with.
    worth.iter().enumerate().rev().max_by(|(_, a), (_, b)| a.total_cmp(b)).map_or(0, |(pose, _)| pose)
}

/// The sum of red, green and blue over what is painted.
fn brightness(frame: &Frame) -> f64 {
    let painted = frame.pixels.iter().zip(&frame.coverage).filter(|(_, coverage)| **coverage == Coverage::Interior);
    painted.map(|([red, green, blue, _], _)| f64::from(*red) + f64::from(*green) + f64::from(*blue)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{Hypothesis, TermPictures};

    #[test]
    fn a_wrong_answer_shares_the_terms_that_it_computes_as_it_should() {
        let assignment = reference::assignment("ggsample06").unwrap();
        let right = term_pictures(assignment, Some(&[]), None);
        let slip = Hypothesis { id: "specular-half-unnormalized".into(), form: 0, parameter: None };
        let wrong = term_pictures(assignment, Some(&[slip]), None);
        assert_eq!(right.len(), wrong.len());
        let is_shared = |(right, wrong): (&TermPictures, &TermPictures)| {
            let yours = wrong.yours.as_ref().expect("it is explained");
            Arc::ptr_eq(&right.expected, &wrong.expected) && Arc::ptr_eq(&wrong.expected, yours)
        };
        let shared = right.iter().zip(&*wrong).map(is_shared);
        let is_highlight = right.iter().map(|term| term.id == "specular");
        assert!(shared.zip(is_highlight).all(|(is_shared, is_highlight)| is_shared != is_highlight));
    }

    #[test]
    fn the_pose_shows_every_term() {
        // The highlight is seen near t = 0 only, and there it is faint: see the assignment's notes on the animation.
        let assignment = reference::assignment("ggsample06").unwrap();
        let pose = &assignment.scene.all_poses()[telling_pose(assignment)];
        for term in assignment.rubric.iter().filter(|line| !line.alone_in.is_empty()) {
            let frame = assignment.term_frame(pose, &assignment.equation.right(), &term.judges).unwrap();
            assert!(brightness(&frame) > 0.0, "{} at t = {}", term.id, pose.t);
        }
    }
}
