//! Fragment stages that write `gl_FragDepth`: what covers what is known when all that covers a pixel was shaded.

use super::{MOST_LAYERS, Scenery};
use crate::pipeline::scalars;
use crate::rasteriser::{Coverage, SILHOUETTE_DISTANCE, Visible};
use crate::scene::DepthTest;

/// What rounding to f32 or 24 bits and a few operations move a depth by.
const ROUNDING: f64 = 1e-6;

/// A depth that was written, and by how much it changes over the distance that rounding moves a surface by.
#[derive(Clone, Copy)]
struct WrittenDepth {
    at: f64,
    slack: f64,
}

/// What is far away where nothing is drawn.
const FAR: WrittenDepth = WrittenDepth { at: 1.0, slack: 0.0 };

impl Scenery<'_> {
    /// Shows at each pixel the triangle that the depths leave which the fragment stage writes; without such an output, all stays. A depth
    /// that is undefined is the nearest: its fragment is seen, and is asked why.
    pub fn settle(&self, visible: &mut Visible) {
        let Some(output) = self.pipeline.depth else { return };
        let mut depths = vec![FAR; visible.coverage.len()];
        let mut shown: Vec<Option<u32>> = vec![None; visible.coverage.len()];
        let mut doubtful: Vec<u32> = Vec::new();
        for layer in visible.layers(MOST_LAYERS) {
            visible.show(&layer);
            let pixels = self.covered(visible);
            let near = SILHOUETTE_DISTANCE;
            let here = self.depths(visible, &pixels, output, [0.0, 0.0]);
            let beside = [[near, 0.0], [-near, 0.0], [0.0, near], [0.0, -near]];
            let beside = beside.map(|moved| self.depths(visible, &pixels, output, moved));
            for (at, &pixel) in pixels.iter().enumerate() {
                let around = || beside.iter().map(|depths| depths[at]);
                if around().any(|beside| beside.is_some() != here[at].is_some()) {
                    doubtful.push(pixel);
                }
                let Some(depth) = here[at] else { continue };
                let depth = if depth.is_nan() { 0.0 } else { depth };
                let slack = around().flatten().map(|beside| (beside - depth).abs()).fold(ROUNDING, f64::max);
                let there = &mut depths[pixel as usize];
                let test = visible.test_at(pixel as usize);
                if test.is_some() && (depth - there.at).abs() <= slack + there.slack {
                    doubtful.push(pixel);
                }
                let [own, other] = [depth, there.at].map(|depth| depth.clamp(0.0, 1.0));
                let is_shown = match test {
                    Some(DepthTest::Less) => own < other,
                    Some(DepthTest::LessEqual) => own <= other,
                    None => true,
                };
                if is_shown {
                    shown[pixel as usize] = layer[pixel as usize];
                    if test.is_some() {
                        *there = WrittenDepth { at: depth, slack };
                    }
                }
            }
        }
        visible.show(&shown);
        doubtful.into_iter().for_each(|pixel| visible.coverage[pixel as usize] = Coverage::Silhouette);
    }

    /// The depths that are written at pixels, a little beside their middles; `None` where the fragment is thrown away.
    fn depths(&self, visible: &Visible, pixels: &[u32], output: usize, moved: [f64; 2]) -> Vec<Option<f64>> {
        let shake = super::Shake { moved, ..Default::default() };
        self.each(visible, pixels, None, &|surface, fragments| {
            let Some(outputs) = self.outputs(visible, surface, fragments, shake, false) else {
                return vec![Some(f64::NAN); fragments.len()];
            };
            let columns = scalars(&outputs, output);
            let depth = |fragment: usize| columns.first().map_or(f64::NAN, |column| column[fragment]);
            (0..fragments.len()).map(|at| (!outputs.discarded[at]).then(|| depth(at))).collect()
        })
    }
}
