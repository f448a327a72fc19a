//! Whether a shader treats the probes that judge apart from all others.
//!
//! The probes that judge are the same in every grading, and the project's text shows them to everybody. So each grading draws
//! some more that nobody knows. They never judge a detail: what an honest shader does at a few of them is luck.

use crate::render::Sample;
use reference::Assignment;
use reference::fit::contradicted;
use reference::mistake::FoundMistake;
use reference::probes::{Probe, ProbeSet};

/// A verdict is contradicted if so many of the 20 vertices of every fresh camera contradict it.
///
/// Noise: a shader that goes wrong in a fraction p of all places, and not at the 560 known ones, does so at 5 of 20 vertices
/// under each of four cameras with less than 1e-20; one that goes wrong under a fraction p of all cameras, and not under the
/// 26 known ones, with (1 − p)²⁶ p⁴ < 1e-5. Defect to catch: a table of the known probes before another way to compute the
/// colour; without one of the three terms that way is wrong at 8 vertices or more.
const CONTRADICTED: usize = 5;

/// The fresh probes, and what the shader computed there.
#[derive(Clone, Copy, Debug)]
pub struct Fresh<'a> {
    /// The probes.
    pub probes: &'a ProbeSet,
    /// A sample for each of them.
    pub samples: &'a [Sample],
}

impl Fresh<'_> {
    /// Whether what is right with these mistakes in it is far from what the shader computes.
    pub(super) fn refutes(&self, assignment: &Assignment, found: &[FoundMistake], tolerance: f64) -> bool {
        let samples: Vec<[f64; 3]> = self.samples.iter().map(Sample::colour_f64).collect();
        let wrong = contradicted(assignment, found, self.probes, &samples, tolerance);
        self.is_contradicted(|place| wrong[place])
    }

    /// Whether many samples under every camera are wrong, by a test of probe and sample.
    pub(super) fn refutes_each(&self, is_wrong: impl Fn(&Probe, &Sample) -> bool) -> bool {
        self.is_contradicted(|place| is_wrong(&self.probes.probes[place], &self.samples[place]))
    }

    /// `is_wrong`: of the probe in this place.
    pub(super) fn is_contradicted(&self, is_wrong: impl Fn(usize) -> bool) -> bool {
        let wrong = |group: usize| {
            let places = 0..self.samples.len().min(self.probes.probes.len());
            places.filter(|place| self.probes.probes[*place].group == group && is_wrong(*place)).count()
        };
        let groups = 0..self.probes.groups.len();
        !groups.is_empty() && groups.into_iter().all(|group| wrong(group) >= CONTRADICTED)
    }
}
