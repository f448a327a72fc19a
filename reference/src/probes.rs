//! Samples in which every term, every clamp and every known mistake of the equation shows.
//!
//! An animation hardly shows what stands out at a few angles only. Probes are vertices of their own, drawn once with random
//! rigid cameras: each is designed in eye space by the angles between directions of the solution, then carried back to object
//! space.

mod design;
mod group;
mod light;
mod nearby;
mod random;
mod spots;

use crate::equation::Reads;
use crate::interpreter::Formula;
use crate::scene::{Matrices, Vertex};
use crate::{Assignment, Text, Value};
use design::EyeSpace;
pub(crate) use design::{Aim, Design, Normal};
use glam::{DMat4, DVec3, DVec4};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use random::Random;
pub use spots::{Crossings, EdgeDefect, Pictured, ProbeOutput, Spot, at_pixel, linear};
pub(crate) use spots::{FragmentInputs, handed_at};
use std::ops::Range;

/// The last groups have one camera: the second of them has the positions of the first, the third has its own.
const TWINS: usize = 3;

/// The seed of the probes that judge.
const JUDGING: u64 = 1;

/// How often a vertex is drawn for which a right answer is no number, before it is taken as it is.
const TRIES: usize = 100;

/// So many cameras of the probes that are fresh in every grading: 80 vertices.
const FRESH_GROUPS: usize = 4;

/// How the probes of an assignment are chosen.
#[derive(Clone, Debug)]
pub(crate) struct Probing {
    /// Number of cameras.
    pub groups: usize,
    /// Vertices for each of them.
    pub per_group: usize,
    /// By which angles those are chosen; without it they lie near the homework's own.
    pub aim: Option<Aim>,
    /// Whether backs of triangles are probed as well as fronts.
    pub takes_backs: bool,
}

/// What a right answer shows in some places.
#[derive(Clone, Debug)]
pub struct Region {
    /// Its name in the assignment.
    pub id: String,
    /// What is said of a place there.
    pub seen: Text,
    /// Whether a term that is nothing here shows if a clamp is missing.
    pub shows_clamps: bool,
    /// Where that is.
    pub(crate) when: Formula,
}

/// One vertex, or one fragment, and what a right answer computes for it.
#[derive(Clone, Debug)]
pub struct Probe {
    /// Which of the groups it belongs to: its uniforms.
    pub group: usize,
    /// The attributes, exact in f32.
    pub vertex: Vertex,
    /// What the equation reads: for definitions of a vertex stage the attributes in the interface's order, see
    /// [`Reads`](crate::equation::Reads).
    pub attributes: Vec<Value>,
    /// What a right answer shows here: a place among the assignment's regions.
    pub region: Option<usize>,
    /// The right colour: a vertex's not clamped, a fragment's as a target of fixed point holds it.
    pub colour: DVec3,
    /// The right position in clip space.
    pub position: DVec4,
    /// The fragment that is probed, where the fragment stage is run as well.
    pub spot: Option<Box<Spot>>,
}

/// Probes with the same uniforms.
#[derive(Clone, Debug)]
pub struct ProbeGroup {
    /// The matrices, exact in f32.
    pub matrices: Matrices,
    /// Fraction of the cycle.
    pub t: f64,
    /// The uniforms in the interface's order.
    pub uniforms: Vec<Value>,
    /// View and projection of the pass, where there is one.
    pub pass: [DMat4; 2],
    /// Width and height of the window in which its fragments lie, in pixels.
    pub window: [f64; 2],
}

/// Probes under several cameras.
#[derive(Clone, Debug)]
pub struct ProbeSet {
    /// What they were chosen from; the same seed gives the same probes.
    pub seed: u64,
    /// The cameras.
    pub groups: Vec<ProbeGroup>,
    /// The vertices, group after group, the same number for each.
    pub probes: Vec<Probe>,
    /// How many of the last groups have one camera.
    twins: usize,
}

impl ProbeSet {
    /// The probes in the order in which samples are expected.
    pub fn iter(&self) -> std::slice::Iter<'_, Probe> {
        self.probes.iter()
    }

    /// The same probes with other uniforms.
    pub(crate) fn with_uniforms(&self, change: impl FnMut(&mut ProbeGroup)) -> Self {
        let mut other = self.clone();
        other.groups.iter_mut().for_each(change);
        let spots = other.probes.iter_mut().filter_map(|probe| probe.spot.as_deref_mut());
        spots.for_each(|spot| spot.is_known = false);
        other
    }

    /// The uniforms of a probe, in the interface's order.
    pub fn uniforms(&self, probe: &Probe) -> &[Value] {
        &self.groups[probe.group].uniforms
    }

    /// The places of two groups with one camera and the same positions, number by number, but other normals.
    pub fn with_other_normals(&self) -> Option<[Range<usize>; 2]> {
        self.twins(1)
    }

    /// The places of two groups with one camera, but other positions and normals.
    pub fn with_other_vertices(&self) -> Option<[Range<usize>; 2]> {
        self.twins(2)
    }

    fn twins(&self, other: usize) -> Option<[Range<usize>; 2]> {
        let first = self.groups.len().checked_sub(self.twins).filter(|_| self.twins == TWINS)?;
        let each = self.probes.len() / self.groups.len();
        Some([first, first + other].map(|group| group * each..(group + 1) * each))
    }

    /// The probes of so many groups, and their places in this set.
    pub(crate) fn part(&self, groups: usize) -> (Vec<usize>, Self) {
        let count = self.groups.len().max(1);
        let each = self.probes.len() / count;
        let chosen: Vec<usize> = (0..groups.min(count)).map(|at| at * count / groups.min(count)).collect();
        let places: Vec<usize> = chosen.iter().flat_map(|group| group * each..(group + 1) * each).collect();
        let own = |(at, place): (usize, &usize)| Probe { group: at / each.max(1), ..self.probes[*place].clone() };
        let probes = places.iter().enumerate().map(own).collect();
        let groups = chosen.iter().map(|group| self.groups[*group].clone()).collect();
        (places, Self { seed: self.seed, groups, probes, twins: 0 })
    }

    /// The first so many probes of each group.
    pub(crate) fn thinned(&self, count: usize) -> Self {
        let own = (0..self.groups.len()).flat_map(|group| self.of_group(group).iter().take(count));
        Self { probes: own.cloned().collect(), ..self.clone() }
    }

    /// The probes of several sets, each with its own groups, to be run at once.
    pub(crate) fn joined(sets: impl Iterator<Item = Self>) -> Self {
        let mut joined = Self { seed: 0, groups: Vec::new(), probes: Vec::new(), twins: 0 };
        for set in sets {
            let before = joined.groups.len();
            joined.groups.extend(set.groups);
            joined.probes.extend(set.probes.into_iter().map(|probe| Probe { group: before + probe.group, ..probe }));
        }
        joined
    }

    /// The probes of one group.
    pub fn of_group(&self, group: usize) -> &[Probe] {
        let each = self.probes.len() / self.groups.len().max(1);
        self.probes.get(group * each..(group + 1) * each).unwrap_or_default()
    }
}

impl<'a> IntoIterator for &'a ProbeSet {
    type Item = &'a Probe;
    type IntoIter = std::slice::Iter<'a, Probe>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl Assignment {
    /// The probes that judge: the same in every grading, so that no score and no message depends on a seed.
    pub fn judging_probes(&self) -> ProbeSet {
        self.probes(JUDGING)
    }

    /// Probes that nobody knows beforehand. They only show whether a shader treats the known ones apart.
    pub fn fresh_probes(&self, seed: u64) -> ProbeSet {
        // Another stream: under no seed are they the known ones.
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        random.set_stream(1);
        self.draw(seed, random, FRESH_GROUPS, 0)
    }

    /// As many probes as judge, for a seed.
    pub fn probes(&self, seed: u64) -> ProbeSet {
        self.draw(seed, ChaCha8Rng::seed_from_u64(seed), self.probing.groups, TWINS)
    }

    /// Probes under `count` cameras, of which the last `twins` are the same.
    fn draw(&self, seed: u64, random: ChaCha8Rng, count: usize, twins: usize) -> ProbeSet {
        if self.equation.reads() != Reads::Attributes {
            return self.draw_spots(seed, random, count);
        }
        let mut random = Random(random);
        let mut eye_space = self.probing.aim.as_ref().map(|aim| EyeSpace::of(self, aim));
        let right = self.equation.right();
        let mut groups = Vec::new();
        let mut probes = Vec::new();
        for group in 0..count {
            let twin = (group + twins).checked_sub(count + 1);
            let drawn = match (twin, groups.last()) {
                (Some(_), Some(before)) => ProbeGroup::clone(before),
                _ => self.group(&mut random),
            };
            let ProbeGroup { matrices, uniforms, .. } = &drawn;
            eye_space.iter_mut().for_each(|eye_space| eye_space.enter(&drawn));
            for place in 0..self.probing.per_group {
                let before = probes.len().checked_sub(self.probing.per_group).map(|at| &probes[at]);
                let before = before.filter(|_| twin == Some(0)).map(|probe: &Probe| probe.vertex);
                let mut draw = || match &mut eye_space {
                    Some(eye_space) => eye_space.vertex(&mut random, place, before.map(|own| own.position), matrices),
                    None => self.nearby(&mut random, before),
                };
                let compute = |vertex: Vertex| {
                    let attributes = self.attribute_values(&vertex);
                    let outcome = right.evaluate(uniforms, &attributes);
                    (vertex, attributes, outcome)
                };
                let (mut vertex, mut attributes, mut outcome) = compute(draw());
                for _ in 0..TRIES {
                    if outcome.colour().is_finite() && outcome.position().is_finite() {
                        break;
                    }
                    (vertex, attributes, outcome) = compute(draw());
                }
                probes.push(Probe {
                    group,
                    region: right.first_region(&self.regions),
                    colour: outcome.colour(),
                    position: outcome.position(),
                    vertex,
                    attributes,
                    spot: None,
                });
            }
            groups.push(drawn);
        }
        ProbeSet { seed, groups, probes, twins }
    }

    /// Probes of another assignment with what is right by this one's equation, which may have other constants.
    pub fn reprobe(&self, probes: &ProbeSet) -> ProbeSet {
        let right = self.equation.right();
        let mut theirs = probes.clone();
        for probe in &mut theirs.probes {
            let outcome = right.evaluate(&probes.groups[probe.group].uniforms, &probe.attributes);
            (probe.colour, probe.position) = (outcome.colour(), outcome.position());
        }
        theirs
    }
}

#[cfg(test)]
mod tests;
