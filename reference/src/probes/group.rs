//! What probes with the same uniforms are given: a camera, and the values of the uniforms.

use super::{ProbeGroup, Random, TRIES};
use crate::Assignment;
use crate::assignment::{Feed, Uniform};
use crate::scene::{Matrices, Moment, perspective};
use glam::{DMat4, DQuat};
use std::ops::RangeInclusive;

/// A window's sides vary by such factors.
const WINDOW: RangeInclusive<f64> = 0.5..=1.5;

impl Assignment {
    /// What probes with the same uniforms are given. Nothing is drawn that the homework has not: the same seed gives the
    /// same camera with uniforms of other kinds.
    pub(super) fn group(&self, random: &mut Random) -> ProbeGroup {
        let uniforms = &self.interface.uniforms;
        let mut matrices = random_camera(random);
        let moves = uniforms.iter().any(|uniform| matches!(uniform.feed, Feed::Expression(_)));
        let t = if moves { random.between(0.0, 1.0) } else { 0.0 };
        let is_of_the_world = |feed: &Feed| match feed {
            Feed::Role(role) => role.is_of_the_world(),
            feed => matches!(feed, Feed::Expression(_)),
        };
        let i = self.random_draw(random, &self.scene.moment(t, matrices));
        if uniforms.iter().any(|uniform| is_of_the_world(&uniform.feed)) {
            matrices = self.in_the_world(random, &self.scene.moment_of_draw(i, t, matrices));
        }
        let mut moment = self.scene.moment_of_draw(i, t, matrices);
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

    /// The number of what is drawn, where a uniform depends on it.
    fn random_draw(&self, random: &mut Random, moment: &Moment) -> u32 {
        let count = self.scene.count_of_draws();
        let follows = |uniform: &Uniform| {
            uniform.probe.is_none() && (1..count).any(|i| uniform.follows(moment, &Moment { i, ..*moment }))
        };
        if self.interface.uniforms.iter().any(follows) { random.below(count as usize) as u32 } else { 0 }
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
    fn in_the_world(&self, random: &mut Random, moment: &Moment) -> Matrices {
        let seen = &moment.matrices;
        let own = self.scene.drawn(moment.i).map_or(DMat4::IDENTITY, |draw| draw.model.at(moment));
        let turned = DQuat::from_axis_angle(random.direction(), random.between(0.4, 2.7));
        let moved = DMat4::from_rotation_translation(turned, random.direction() * random.between(0.5, 3.0));
        // What the eye sees is as far away as without a world.
        Matrices::seen(moved * own, seen.model_view * moved.inverse(), seen.projection)
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
