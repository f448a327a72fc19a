//! What is drawn into a texture before each picture, by a program of the homework's own: a map of depths as a light sees them.

use super::{Cull, DepthTest, Draw, Matrices, Moment, Pose, Scene, matrix};
use crate::assignment::Interface;
use crate::feed::Expression;
use crate::interpreter::Program;
use crate::pipeline::positions;
use crate::rasteriser::{Surface, depth_map};
use glam::DMat4;
use std::sync::Arc;

/// A pass whose target is a texture.
#[derive(Clone, Debug)]
pub struct Pass {
    /// From world space to the pass's eye space.
    pub view: Expression,
    /// From there to its clip space.
    pub projection: Expression,
    /// Its vertex stage; depths need no fragment stage.
    pub program: Arc<Program>,
    /// The names of what is drawn; all where none are said.
    pub draws: Option<Vec<String>>,
    /// Which depths are kept.
    pub depth_test: DepthTest,
    /// Which triangles are left out.
    pub cull: Cull,
    /// Factor and units of `glPolygonOffset`.
    pub polygon_offset: [f64; 2],
    /// Width and height of the texture.
    pub size: [u32; 2],
    /// Whether depths are kept in 24 bits of fixed point, or else as floats.
    pub is_fixed_point: bool,
}

impl Pass {
    /// View and projection at a moment.
    pub(super) fn matrices(&self, moment: &Moment) -> [DMat4; 2] {
        [&self.view, &self.projection].map(|one| one.value(moment).map_or(DMat4::NAN, |value| matrix(&value)))
    }

    fn draws(&self, draw: &Draw) -> bool {
        let is_named = |names: &Vec<String>| draw.name.as_ref().is_some_and(|name| names.contains(name));
        self.draws.as_ref().is_none_or(is_named)
    }
}

/// A pass with all that it is drawn with.
#[derive(Clone, Debug)]
pub struct DepthPass {
    /// What is drawn, and the pass.
    pub scene: Scene,
    /// What its program is given.
    pub interface: Interface,
}

impl DepthPass {
    /// The depths of a pose, row by row, the lowest first.
    pub fn map(&self, pose: &Pose) -> Vec<f32> {
        let Some(pass) = &self.scene.pass else { return Vec::new() };
        let shapes: Vec<_> = self
            .scene
            .instances(pose)
            .into_iter()
            .filter(|instance| pass.draws(instance.draw))
            .filter_map(|instance| {
                let [view, projection] = instance.moment.pass;
                let model = instance.draw.model.at(&instance.moment);
                let moment = Moment { matrices: Matrices::seen(model, view, projection), ..instance.moment };
                let uniforms: Vec<_> = self.interface.uniforms.iter().map(|uniform| uniform.value(&moment)).collect();
                let mesh = &instance.draw.mesh;
                let outputs = self.interface.run_vertices(&pass.program, &uniforms, &mesh.vertices, &[])?;
                Some((positions(&outputs, mesh.vertices.len()), &mesh.triangles))
            })
            .collect();
        let surfaces: Vec<Surface<'_>> = shapes
            .iter()
            .map(|(positions, triangles)| Surface {
                positions,
                same: &[],
                triangles,
                is_faceted: true,
                depth_test: Some(pass.depth_test),
                cull: pass.cull,
            })
            .collect();
        let rounded = |depth: f64| match pass.is_fixed_point {
            true => (depth * FIXED).round() / FIXED,
            false => depth,
        };
        depth_map(pass.size, &surfaces, pass.polygon_offset).into_iter().map(|depth| rounded(depth) as f32).collect()
    }
}

/// The greatest number of 24 bits.
const FIXED: f64 = 16_777_215.0;
