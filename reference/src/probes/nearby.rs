//! Probes near the vertices of what a homework draws.

use super::Random;
use crate::Assignment;
use crate::scene::Vertex;
use glam::DVec2;

/// How far from a vertex of the mesh a probe may lie, as a share of the mesh's size: what only the homework's own vertices
/// have is no rule.
const ASIDE: f64 = 0.1;

impl Assignment {
    /// A vertex near one of the meshes', with a normal and texture coordinates of its own; `before`: the vertex whose place it
    /// takes, with another normal.
    pub(super) fn nearby(&self, random: &mut Random, before: Option<Vertex>) -> Vertex {
        let normal = random.direction();
        let tangent = normal.any_orthonormal_vector();
        if let Some(before) = before {
            let vertex = Vertex::new(before.position.truncate(), normal).textured(before.texture_coordinates);
            return vertex.along(tangent, before.tangent.w).numbered_as(&before);
        }
        let draws: Vec<_> = self.scene.views.iter().flat_map(|view| &view.draws).collect();
        let mesh = &draws[random.below(draws.len())].mesh;
        let own = &mesh.vertices[random.below(mesh.vertices.len())];
        let (low, high) = mesh.bounds();
        let aside = random.direction() * random.between(0.0, ASIDE) * (high - low).length();
        let coordinates = DVec2::new(random.between(0.0, 1.0), random.between(0.0, 1.0));
        let vertex = Vertex::new(own.position.truncate() + aside, normal).textured(coordinates);
        vertex.along(tangent, own.tangent.w).numbered_as(own)
    }
}
