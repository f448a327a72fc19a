//! Pictures of the animation, as a right answer or a known mistake draws them.

use crate::Assignment;
use crate::equation::Variant;
use crate::rasteriser::{ClipVertex, Frame};
use crate::scene::Pose;

impl Assignment {
    /// The picture that `variant` of the equation draws at `pose`.
    pub fn frame(&self, pose: &Pose, variant: &Variant<'_>) -> Frame {
        self.picture(&self.corners(pose, variant, self.equation.colour))
    }

    /// The picture of one term: the definition called `term` in place of the colour. `None` if there is no such definition.
    pub fn term_frame(&self, pose: &Pose, variant: &Variant<'_>, term: &str) -> Option<Frame> {
        Some(self.picture(&self.term_corners(pose, variant, term)?))
    }

    /// The right pictures of all poses.
    pub fn frames(&self) -> Vec<Frame> {
        let right = self.equation.right();
        let poses = self.scene.all_poses();
        poses.iter().map(|pose| self.frame(pose, &right)).collect()
    }

    /// The vertices of that picture, with the term in place of the colour.
    pub fn term_corners(&self, pose: &Pose, variant: &Variant<'_>, term: &str) -> Option<[ClipVertex; 3]> {
        Some(self.corners(pose, variant, self.equation.index(term)?))
    }

    /// The picture of a triangle.
    pub(crate) fn picture(&self, corners: &[ClipVertex; 3]) -> Frame {
        let scene = &self.scene;
        let mut frame = Frame::cleared(scene.width, scene.height, scene.background);
        frame.draw(corners);
        frame
    }

    /// The vertices of the triangle, with the value of a definition as the colour.
    pub(crate) fn corners(&self, pose: &Pose, variant: &Variant<'_>, shown: usize) -> [ClipVertex; 3] {
        let uniforms = self.uniform_values(&self.scene.moment(pose.t, pose.matrices));
        self.scene.triangle(pose).map(|vertex| {
            let outcome = variant.evaluate(&uniforms, &self.attribute_values(&vertex));
            ClipVertex { position: outcome.position(), colour: outcome.vec3(shown) }
        })
    }
}
