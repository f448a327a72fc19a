//! The shadow maps of ggsample11 against pictures of a real OpenGL driver (`tests/data/ggsample11-map`).

use reference::rasteriser::{Coverage, Frame};
use std::path::Path;

/// One step for the driver's f32 at a rounding boundary, one for a vertex snapped to 1/256 pixel.
const CHANNEL_TOLERANCE: u8 = 2;

/// Pixels of a picture that are judged and yet may differ: the driver draws its own depth map, whose texels at the edges of figures are
/// others in a few places. At most 8 were measured; the faintest mistake, another bias, changes 200 and more.
const BUDGET: usize = 16;

/// The pictures of both scenes, by twentieths of the cycle.
const NAMES: [&str; 6] = ["above-00", "above-02", "above-07", "aside-01", "aside-05", "aside-08"];

fn captured(index: usize) -> image::RgbImage {
    let name = format!("tests/data/ggsample11-map/{}.png", NAMES[index]);
    image::open(Path::new(env!("CARGO_MANIFEST_DIR")).join(name)).expect("a captured frame").to_rgb8()
}

/// Pixels that are judged, those that are not, and those that are judged and not as captured.
fn compared(ours: &Frame, theirs: &image::RgbImage) -> [usize; 3] {
    assert_eq!((ours.width, ours.height), theirs.dimensions());
    let mut counts = [0; 3];
    for ((pixel, coverage), their) in ours.pixels.iter().zip(&ours.coverage).zip(theirs.pixels()) {
        let differs = (0..3).any(|c| pixel[c].abs_diff(their[c]) > CHANNEL_TOLERANCE);
        counts[0] += usize::from(*coverage == Coverage::Interior);
        counts[1] += usize::from(*coverage == Coverage::Silhouette);
        counts[2] += usize::from(*coverage != Coverage::Silhouette && differs);
    }
    counts
}

#[test]
fn shadow_maps_are_what_opengl_draws() {
    let assignment = reference::assignment("ggsample11-map").expect("built in");
    let frames = assignment.frames();
    assert_eq!(frames.len(), NAMES.len());
    for (index, frame) in frames.iter().enumerate() {
        let counts = compared(frame, &captured(index));
        println!("{index}: {counts:?}");
        // Floor and figures cover more than a quarter of the window, and hardly any of that is left open.
        assert!(counts[0] > 200_000 && counts[1] < counts[0] / 12, "{index}: {counts:?}");
        assert!(counts[2] <= BUDGET, "{index}: {counts:?}");
    }
}
