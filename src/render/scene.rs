//! What a submission is drawn with.

mod assigned;

use reference::interpreter::Texture;
use reference::scene::{Cull, DepthTest};
use reference::{Value, Values};
use std::sync::Arc;

/// An input of probes that is no student's: width and height of the window that each lies in.
pub(super) const WINDOW: &str = "window";

/// How the fragments of a draw are kept.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DrawState {
    /// Which fragments are drawn over what is there; none draws all.
    pub depth_test: Option<DepthTest>,
    /// Which triangles are left out.
    pub cull: Cull,
}

/// A draw: its vertices by attribute, and the uniforms that hold for them.
#[derive(Clone, Debug, Default)]
pub struct DrawCall {
    /// Uniforms by path, such as `lights[1].colour`; a part of a structure, array or block may be set by itself.
    pub uniforms: Vec<(String, Value)>,
    /// Attributes by name; all of one length.
    pub attributes: Vec<(String, Values)>,
    /// The corners of the triangles, as numbers of vertices; three after three vertices where there are none.
    pub triangles: Vec<[u32; 3]>,
    /// Of pixels, what of the attributes is another number at the pixel to the right and at the one above.
    pub beside: [Vec<(String, Values)>; 2],
    /// How its fragments are kept.
    pub state: DrawState,
}

impl DrawCall {
    /// The corners of its triangles in the order in which they are drawn. For `flat` values the last one counts, and wgpu
    /// takes the first.
    pub(super) fn corners(&self, is_flat: bool) -> Vec<u32> {
        let turned = |[a, b, c]: [u32; 3]| if is_flat { [c, a, b] } else { [a, b, c] };
        let in_order = (0..self.vertices() / 3).map(|number| [0, 1, 2].map(|corner| 3 * number + corner));
        if self.triangles.is_empty() {
            in_order.flat_map(turned).collect()
        } else {
            // A corner that no vertex has draws nothing.
            let all = self.triangles.iter().copied();
            all.filter(|corners| corners.iter().all(|corner| *corner < self.vertices())).flat_map(turned).collect()
        }
    }

    pub(super) fn vertices(&self) -> u32 {
        self.attributes.first().map_or(0, |(_, values)| values.len() as u32)
    }

    /// How many are drawn: a driver leaves out the vertices of a triangle that is not complete, so the last one is
    /// repeated until it is.
    pub(super) fn drawn(&self) -> u32 {
        self.vertices().next_multiple_of(3)
    }
}

/// What is drawn: frames, which are seen, and probes, of which only the numbers count.
#[derive(Clone, Debug, Default)]
pub struct RenderScene {
    /// Pixels in a row of a frame.
    pub width: u32,
    /// Rows of a frame.
    pub height: u32,
    /// Colour that a frame is cleared to, RGBA8.
    pub background: [u8; 4],
    /// The draws of each frame.
    pub frames: Vec<Vec<DrawCall>>,
    /// The probes of a vertex stage, one a vertex.
    pub probes: Vec<DrawCall>,
    /// The probes of a fragment stage, one a pixel: what it is fed, as attributes by path. `gl_FragCoord` and
    /// `gl_FrontFacing` may be among them.
    pub pixels: Vec<DrawCall>,
    /// Where a vertex stage that is handed in feeds the fragments that are probed: for each batch of pixels the shares of three
    /// vertices in each, which stand one after the other in the batch of probes with the same number.
    pub shares: Vec<Vec<[[f64; 3]; 3]>>,
    /// The textures; a sampler's value is the number of one.
    pub textures: Arc<[Texture]>,
}

impl RenderScene {
    /// The frames, then the probes.
    pub(super) fn batches(&self) -> impl Iterator<Item = &DrawCall> {
        self.frames.iter().flatten().chain(&self.probes)
    }

    /// How many vertices are drawn in all.
    pub(super) fn drawn(&self) -> u32 {
        self.batches().map(DrawCall::drawn).sum()
    }
}
