//! What is a matter of taste: where a right answer may show this or that, nothing is judged.

use crate::probes::Probe;
use crate::rasteriser::{Coverage, Frame};
use crate::scene::Pose;
use crate::{Assignment, Value};

/// A pixel that changes by more than this, in 1/255, is not judged: a byte's own rounding is less.
const PIXEL: u8 = 1;

/// The same of a probe's colour: a tenth of the tolerance with which probes are judged.
const COLOUR: f64 = 2e-4;

impl Assignment {
    /// The picture, but what one of the programs that are not judged shows otherwise is left to the rasteriser.
    pub(crate) fn without_unjudged(&self, pose: &Pose, mut right: Frame) -> Frame {
        for other in &self.unjudged {
            let other = self.drawn_by(other, pose);
            let pairs = right.pixels.iter().zip(&other.pixels).zip(&mut right.coverage);
            for ((own, other), coverage) in pairs {
                if (0..3).any(|channel| own[channel].abs_diff(other[channel]) > PIXEL) {
                    *coverage = Coverage::Silhouette;
                }
            }
        }
        right
    }

    /// The probes that all those programs agree on.
    pub(crate) fn judged(&self, uniforms: &[Value], mut probes: Vec<Probe>) -> Vec<Probe> {
        let mut is_judged = self.are_judged(uniforms, &probes).into_iter();
        probes.retain(|_| is_judged.next() == Some(true));
        probes
    }

    /// For each of these probes whether all those programs agree on it.
    pub(crate) fn are_judged(&self, uniforms: &[Value], probes: &[Probe]) -> Vec<bool> {
        let mut judged = vec![true; probes.len()];
        for other in &self.unjudged {
            let Some(shown) = self.shown_of_group(&other.pipeline, uniforms, probes) else { continue };
            for ((judged, probe), shown) in judged.iter_mut().zip(probes).zip(&shown) {
                *judged &= (probe.colour - shown.colour).abs().max_element() <= COLOUR;
            }
        }
        judged
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mistake_is_seen_beside_what_is_not_judged() {
        let assignment = crate::assignment("ggsample11-map").expect("it is built in");
        let pose = assignment.scene.all_poses()[0];
        let right = assignment.right_frame(&pose);
        let program = assignment.mistake("no-shadow").and_then(|mistake| mistake.program(mistake.forms.len()));
        let wrong = assignment.drawn_by(program.expect("a program"), &pose);
        let lie = right.coverage.iter().zip(&wrong.coverage);
        let judged = lie.map(|(a, b)| *a != Coverage::Silhouette && *b != Coverage::Silhouette);
        let differs = right.pixels.iter().zip(&wrong.pixels).map(|(a, b)| (0..3).any(|c| a[c].abs_diff(b[c]) > PIXEL));
        assert!(judged.zip(differs).filter(|both| *both == (true, true)).count() > 100);
    }
}
