//! Samples in which every term, every clamp and every known mistake of the equation shows.
//!
//! An animation hardly shows what stands out at a few angles only. Probes are vertices of their own, drawn once with random
//! rigid cameras: each is designed in eye space by the angles between directions of the solution, then carried back to object
//! space.

mod design;
mod light;
mod nearby;
mod spots;

use crate::assignment::{Feed, Uniform};
use crate::equation::Reads;
use crate::interpreter::Formula;
use crate::scene::{Matrices, Moment, Vertex, perspective};
use crate::{Assignment, Text, Value};
use design::EyeSpace;
pub(crate) use design::{Aim, Design, Normal};
use glam::{DMat4, DQuat, DVec3, DVec4};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
pub use spots::{Crossings, EdgeDefect, Pictured, ProbeOutput, Spot, at_pixel, linear};
pub(crate) use spots::{FragmentInputs, handed_at};
use std::ops::{Range, RangeInclusive};

/// The last groups have one camera: the second of them has the positions of the first, the third has its own.
const TWINS: usize = 3;

/// The seed of the probes that judge.
const JUDGING: u64 = 1;

/// How often a vertex is drawn for which a right answer is no number, before it is taken as it is.
const TRIES: usize = 100;

/// A window's sides vary by such factors.
const WINDOW: RangeInclusive<f64> = 0.5..=1.5;

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

    /// What probes with the same uniforms are given. Nothing is drawn that the homework has not: the same seed gives the
    /// same camera with uniforms of other kinds.
    fn group(&self, random: &mut Random) -> ProbeGroup {
        let uniforms = &self.interface.uniforms;
        let mut matrices = random_camera(random);
        let moves = uniforms.iter().any(|uniform| matches!(uniform.feed, Feed::Expression(_)));
        let t = if moves { random.between(0.0, 1.0) } else { 0.0 };
        let is_of_the_world = |feed: &Feed| match feed {
            Feed::Role(role) => role.is_of_the_world(),
            feed => matches!(feed, Feed::Expression(_)),
        };
        if uniforms.iter().any(|uniform| is_of_the_world(&uniform.feed)) {
            matrices = self.in_the_world(random, t, &matrices);
        }
        let mut moment = self.scene.moment(t, matrices);
        moment.resolution = self.random_window(random, &moment);
        if self.scene.pass.is_some() {
            moment.pass = self.random_pass(random, &matrices.model);
        }
        let value = |uniform: &Uniform| match &uniform.probe {
            Some(bounds) if !uniform.follows_window(&moment) => bounds.draw(|| random.between(0.0, 1.0)),
            _ => uniform.value(&moment),
        };
        let uniforms = uniforms.iter().map(value).collect();
        ProbeGroup { matrices, t, uniforms, pass: moment.pass, window: moment.resolution }
    }

    /// A window of another size, where a uniform that follows it may vary: fragments have to lie in the window that the program is
    /// told of. What follows from it stays within its bounds; where no such window is found, it is the homework's own.
    fn random_window(&self, random: &mut Random, moment: &Moment) -> [f64; 2] {
        let bounded = self.interface.uniforms.iter().filter_map(|uniform| Some((uniform, uniform.probe.as_ref()?)));
        let bounded: Vec<_> = bounded.filter(|(uniform, _)| uniform.follows_window(moment)).collect();
        if bounded.is_empty() {
            return moment.resolution;
        }
        let mut window = || moment.resolution.map(|side| (side * random.within(&WINDOW)).round());
        let is_within = |window: &[f64; 2]| {
            let there = Moment { resolution: *window, ..*moment };
            bounded.iter().all(|(uniform, bounds)| bounds.hold(&uniform.value(&there)))
        };
        (0..TRIES).map(|_| window()).find(is_within).unwrap_or(moment.resolution)
    }

    /// The camera in front of the homework's own model, turned and shifted: where that is stretched, so is this.
    fn in_the_world(&self, random: &mut Random, t: f64, seen: &Matrices) -> Matrices {
        let moment = self.scene.moment(t, *seen);
        let own = self.scene.views.first().and_then(|view| view.draws.first());
        let own = own.map_or(DMat4::IDENTITY, |draw| draw.model.at(&moment));
        let turned = DQuat::from_axis_angle(random.direction(), random.between(0.4, 2.7));
        let moved = DMat4::from_rotation_translation(turned, random.direction() * random.between(0.5, 3.0));
        // What the eye sees is as far away as without a world.
        Matrices::seen(moved * own, seen.model_view * moved.inverse(), seen.projection)
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

/// A camera that turns and shifts but, like the course's own, never stretches.
///
/// The shift is large: a normal that is moved as if it were a position ends up somewhere else altogether.
fn random_camera(random: &mut Random) -> Matrices {
    let axis = random.direction();
    let rotation = DQuat::from_axis_angle(axis, random.between(0.4, 2.7));
    let shift = random.direction() * random.between(3.0, 8.0);
    let near = random.between(0.5, 2.0);
    let projection =
        perspective(random.between(0.4, 1.2), random.between(0.8, 1.8), near, near + random.between(10.0, 20.0));
    Matrices::new(DMat4::from_rotation_translation(rotation, shift), projection)
}

/// Random numbers that are the same on every machine.
struct Random(ChaCha8Rng);

impl Random {
    /// Uniform in [from, to).
    fn between(&mut self, from: f64, to: f64) -> f64 {
        // The upper 53 bits fill the significand of an f64.
        let unit = (self.0.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
        from + (to - from) * unit
    }

    /// Uniform within a range.
    fn within(&mut self, range: &RangeInclusive<f64>) -> f64 {
        self.between(*range.start(), *range.end())
    }

    /// Uniform on the unit sphere: height and longitude are independent (Archimedes).
    fn direction(&mut self) -> DVec3 {
        let z = self.between(-1.0, 1.0);
        let (s, c) = self.between(0.0, std::f64::consts::TAU).sin_cos();
        let r = (1.0 - z * z).sqrt();
        DVec3::new(r * c, r * s, z)
    }

    /// A unit vector at `angle` from `axis`, in a random direction around it.
    fn at_angle(&mut self, axis: DVec3, angle: f64) -> DVec3 {
        let aside = axis.any_orthonormal_vector();
        let around = DQuat::from_axis_angle(axis, self.between(0.0, std::f64::consts::TAU));
        axis * angle.cos() + around * aside * angle.sin()
    }
}

#[cfg(test)]
mod tests;
