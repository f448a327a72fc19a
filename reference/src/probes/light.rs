//! The camera of a pass, for probes.

use super::Random;
use crate::Assignment;
use crate::scene::{look_at, perspective};
use glam::{DMat4, DVec3};

/// How far the camera stands from what it sees, in radii of that: so near that the divisor changes a lot over it.
const DISTANCE: [f64; 2] = [1.8, 3.0];

/// By how much what the camera sees is larger than what is drawn, so that what is moved a little is seen as well.
const ROOM: f64 = 1.15;

impl Assignment {
    /// View and projection of a camera that sees all that is drawn, wherever the model stands: what lies outside of a map, or before
    /// or behind all of it, may be read in several ways.
    pub(super) fn random_pass(&self, random: &mut Random, model: &DMat4) -> [DMat4; 2] {
        let meshes = self.scene.views.iter().flat_map(|view| &view.draws).map(|draw| draw.mesh.bounds());
        let all = meshes.reduce(|(low, high), (l, h)| (low.min(l), high.max(h)));
        let (low, high) = all.unwrap_or((DVec3::NEG_ONE, DVec3::ONE));
        let corner = |at: usize| {
            let pick = |bit: usize, axis: usize| if at >> bit & 1 == 0 { low[axis] } else { high[axis] };
            model.transform_point3(DVec3::new(pick(0, 0), pick(1, 1), pick(2, 2)))
        };
        let middle = model.transform_point3((low + high) / 2.0);
        let radius = (0..8).map(|at| (corner(at) - middle).length()).fold(1e-3, f64::max) * ROOM;
        let towards = random.direction();
        let distance = radius * random.between(DISTANCE[0], DISTANCE[1]);
        let view = look_at(middle + towards * distance, middle, towards.any_orthonormal_vector());
        let fovy = 2.0 * (radius / distance).asin();
        let projection = perspective(fovy, 1.0, distance - radius, distance + radius);
        [view, projection].map(|matrix| matrix.as_mat4().as_dmat4())
    }
}
