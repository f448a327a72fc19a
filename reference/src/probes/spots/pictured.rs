//! Probes at places of a picture, so that what is run there is what a person sees there.

use super::FragmentChoice;
use super::seen::weights_at;
use crate::frames::VertexStage;
use crate::probes::{Probe, ProbeGroup};
use crate::scene::{Cull, Pose};
use crate::{Assignment, Value};
use glam::{DMat4, DVec2, DVec3, DVec4};
use std::collections::BTreeSet;

/// So many vertices of a picture are looked at: all that the course's meshes show. Of more, every so manieth.
const MOST_VERTICES: usize = 400;

/// A vertex or a pixel of a picture.
#[derive(Clone, Debug)]
pub struct Pictured {
    /// What is run there. Its colour is that of the equation where the homework is a vertex shader of definitions, and unknown
    /// elsewhere.
    pub probe: Probe,
    /// Its uniforms, in the interface's order.
    pub uniforms: Vec<Value>,
    /// Where it is seen, as shares of the picture's sides from the upper left corner.
    pub at: [f64; 2],
    /// The pixel, by column and row from above; `None` for a vertex.
    pub pixel: Option<[u32; 2]>,
}

impl Assignment {
    /// The vertices of the triangles that a right answer shows in a picture, where the homework is a vertex shader of definitions.
    pub fn pictured_vertices(&self, pose: &Pose) -> Vec<Pictured> {
        let size = [self.scene.width, self.scene.height];
        let instances = self.scene.instances(pose);
        let right = self.equation.right();
        let stage = VertexStage::Equation(&right, self.equation.colour);
        let (visible, scenery) = self.scenery(size, &instances, &self.pipeline, stage);
        let shown: BTreeSet<u32> = (0..visible.coverage.len()).filter_map(|pixel| visible.number(pixel)).collect();
        let corners = shown.into_iter().flat_map(|number| {
            let setup = &visible.setups()[number as usize];
            let corners = scenery.shapes[setup.surface as usize].triangles[setup.triangle as usize];
            corners.map(|vertex| (setup.surface as usize, vertex as usize))
        });
        let all: BTreeSet<(usize, usize)> = corners.collect();
        let step = all.len().div_ceil(MOST_VERTICES).max(1);
        let pictured = |(surface, number): (usize, usize)| {
            let vertex = instances[surface].draw.mesh.vertices[number];
            let uniforms = scenery.shapes[surface].uniforms.clone();
            let attributes = self.attribute_values(&vertex);
            let outcome = right.evaluate(&uniforms, &attributes);
            let (colour, position) = (outcome.colour(), outcome.position());
            let at = self.in_picture(position)?;
            let probe = Probe { group: 0, vertex, attributes, region: None, colour, position, spot: None };
            Some(Pictured { probe, uniforms, at, pixel: None })
        };
        all.into_iter().step_by(step).filter_map(pictured).collect()
    }

    /// What a right answer shows at pixels of a picture, counted from above, where a fragment stage is run; those without anything
    /// are left out.
    pub fn pictured_pixels(&self, pose: &Pose, pixels: &[[u32; 2]]) -> Vec<Pictured> {
        let [width, height] = [self.scene.width, self.scene.height];
        let instances = self.scene.instances(pose);
        let stage = VertexStage::Program(&self.pipeline.vertex);
        let (visible, scenery) = self.scenery([width, height], &instances, &self.pipeline, stage);
        let pictured = |pixel: &[u32; 2]| {
            let setup = visible.at((pixel[1] * width + pixel[0]) as usize)?;
            let shape = &scenery.shapes[setup.surface as usize];
            let numbers = shape.triangles[setup.triangle as usize].map(|vertex| vertex as usize);
            let ends = numbers.map(|vertex| shape.vertices.positions[vertex]);
            let corners = numbers.map(|vertex| instances[setup.surface as usize].draw.mesh.vertices[vertex]);
            let middle = [f64::from(pixel[0]) + 0.5, f64::from(height - 1 - pixel[1]) + 0.5];
            let window = [width, height].map(f64::from);
            let weights = weights_at(ends, middle, window)?;
            let uniforms = shape.uniforms.clone();
            let pass = [DMat4::IDENTITY; 2];
            let drawn = ProbeGroup { matrices: pose.matrices, t: pose.t, uniforms: uniforms.clone(), pass, window };
            let located = self.located(&drawn, vec![(corners, weights, Cull::None)], FragmentChoice::AnySide)?;
            let probe = self.shown_in_place(0, &drawn, located, std::iter::once(DVec3::ZERO)).pop()?;
            let at = [(f64::from(pixel[0]) + 0.5) / f64::from(width), (f64::from(pixel[1]) + 0.5) / f64::from(height)];
            Some(Pictured { probe, uniforms, at, pixel: Some(*pixel) })
        };
        pixels.iter().filter(|[x, y]| *x < width && *y < height).filter_map(pictured).collect()
    }

    /// Where a place of clip space is seen; `None` where it is outside of the picture.
    fn in_picture(&self, position: DVec4) -> Option<[f64; 2]> {
        let seen = DVec2::new(position.x, -position.y) / position.w;
        let is_inside = position.w > 0.0 && seen.is_finite() && seen.abs().max_element() <= 1.0;
        is_inside.then(|| ((seen + 1.0) / 2.0).to_array())
    }
}
