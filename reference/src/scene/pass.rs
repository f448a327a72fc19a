//! What is drawn into a texture before each picture, by a program of the homework's own: a map of depths as a light sees them.

use super::{Cull, DepthTest, Draw, Matrices, Moment, Pose, Scene, matrix};
use crate::assignment::Interface;
use crate::feed::FeedExpression;
use crate::interpreter::Program;
use crate::pipeline::{UniformsOf, positions};
use crate::rasteriser::{Surface, depth_map};
use glam::DMat4;
use std::sync::Arc;

/// A pass whose target is a texture.
#[derive(Clone, Debug)]
pub struct Pass {
    /// From world space to the pass's eye space.
    pub view: FeedExpression,
    /// From there to its clip space.
    pub projection: FeedExpression,
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
    /// Over how many texels to each side moments are means, where the texture holds moments of the depths.
    pub moments: Option<u32>,
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
                let outputs =
                    self.interface.run_vertices(&pass.program, UniformsOf::All(&uniforms), &mesh.vertices, &[])?;
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
        let depths = depth_map(pass.size, &surfaces, pass.polygon_offset).into_iter().map(rounded);
        match pass.moments {
            None => depths.map(|depth| depth as f32).collect(),
            Some(blur) => moments(&depths.collect::<Vec<_>>(), pass.size, blur),
        }
    }
}

/// The means of depths over so many texels to each side, and those of their squares. Beyond the map its outermost depths go on.
fn moments(depths: &[f64], [width, height]: [u32; 2], blur: u32) -> Vec<f32> {
    let (width, height, blur) = (width as usize, height as usize, blur as usize);
    let around = move |at: usize, size: usize| (0..=2 * blur).map(move |k| (at + k).saturating_sub(blur).min(size - 1));
    let count = (2 * blur + 1) as f64;
    let mean = |of: &dyn Fn(f64) -> f64| {
        let along =
            |at: usize| around(at % width, width).map(|x| of(depths[at / width * width + x])).sum::<f64>() / count;
        let rows: Vec<f64> = (0..width * height).map(along).collect();
        let across = |at: usize| around(at / width, height).map(|y| rows[y * width + at % width]).sum::<f64>() / count;
        (0..width * height).map(across).collect::<Vec<_>>()
    };
    let (first, second) = (mean(&|depth| depth), mean(&|depth| depth * depth));
    first.into_iter().zip(second).flat_map(|(first, second)| [first as f32, second as f32]).collect()
}

/// The greatest number of 24 bits.
const FIXED: f64 = 16_777_215.0;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_are_means_of_depths_and_of_their_squares() {
        // 2 × 1 texels of 0 and 0.5 without a blur: the depth and its square.
        assert_eq!(moments(&[0.0, 0.5], [2, 1], 0), [0.0, 0.0, 0.5, 0.25]);
        // Over one texel to each side the outermost counts twice: (0 + 0 + 0.6) / 3 and (0 + 0 + 0.36) / 3, then the other way round.
        let found = moments(&[0.0, 0.6], [2, 1], 1);
        let expected = [0.2_f32, 0.12, 0.4, 0.24];
        assert!(found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-6), "{found:?}");
    }
}
