use super::*;
use crate::interpreter::Interpolation;
use crate::scene::Cull;
use glam::DVec2;

const BACKGROUND: [u8; 4] = [255, 255, 255, 0];

/// A vertex at a window position in pixels (y downwards) of a window of `size` × `size`, with a given w.
fn vertex(size: u32, x: f64, y: f64, w: f64, grey: f64) -> ClipVertex {
    let size = f64::from(size);
    let ndc = DVec2::new(2.0 * x / size - 1.0, 1.0 - 2.0 * y / size);
    ClipVertex { position: DVec4::new(ndc.x * w, ndc.y * w, 0.0, w), colour: DVec3::splat(grey) }
}

fn flat(size: u32, corners: [(f64, f64); 3]) -> [ClipVertex; 3] {
    corners.map(|(x, y)| vertex(size, x, y, 1.0, 1.0))
}

fn covered(frame: &Frame) -> Vec<(usize, usize)> {
    let width = frame.width as usize;
    let inside = |i: &usize| frame.pixels[*i][3] == 255;
    (0..frame.pixels.len()).filter(inside).map(|i| (i % width, i / width)).collect()
}

fn drawn(size: u32, triangle: &[ClipVertex; 3]) -> Frame {
    let positions = triangle.map(|vertex| vertex.position);
    let surface = Surface {
        positions: &positions,
        same: &[0, 1, 2],
        triangles: &[[0, 1, 2]],
        is_faceted: false,
        depth_test: None,
        cull: Cull::None,
    };
    let mut visible = Visible::new(size, size);
    visible.draw(&[surface]);
    let mut frame = Frame::cleared(size, size, BACKGROUND);
    for pixel in 0..frame.pixels.len() {
        let Some(setup) = visible.at(pixel) else { continue };
        let place = |at: u32| 2.0 * (f64::from(at) + 0.5) / f64::from(size) - 1.0;
        let (x, y) = (place(pixel as u32 % size), -place(pixel as u32 / size));
        let channel = |at: usize| {
            let ramp = setup.ramp(triangle.map(|vertex| vertex.colour[at]), Interpolation::Smooth);
            ramp.at(x, y, setup.divisor(x, y))
        };
        frame.pixels[pixel] = quantised([0, 1, 2].map(channel));
    }
    frame.coverage = visible.coverage;
    frame
}

#[test]
fn centres_on_the_top_and_left_edge_belong_to_the_triangle() {
    // Right angle at (0.5, 0.5), legs of two pixels: the centres (0.5, 0.5), (1.5, 0.5) lie on the top edge, (0.5, 0.5) and
    // (0.5, 1.5) on the left one, (2.5, 0.5), (1.5, 1.5), (0.5, 2.5) on the slanted right one, which does not belong to it.
    let frame = drawn(4, &flat(4, [(0.5, 0.5), (2.5, 0.5), (0.5, 2.5)]));
    assert_eq!(covered(&frame), [(0, 0), (1, 0), (0, 1)]);
}

#[test]
fn centres_on_the_bottom_and_right_edge_do_not() {
    // The same, turned by half a turn: the right edge x = 2.5 and the bottom edge y = 2.5 are excluded, and of the centres on
    // the slanted left edge from (2.5, 0.5) to (0.5, 2.5) only (1.5, 1.5) is not on one of those.
    let frame = drawn(4, &flat(4, [(2.5, 2.5), (0.5, 2.5), (2.5, 0.5)]));
    assert_eq!(covered(&frame), [(1, 1)]);
}

#[test]
fn triangles_that_share_an_edge_cover_each_pixel_once() {
    let (a, b) = ((0.3, 0.7), (15.1, 14.9));
    let (c, d) = ((14.7, 1.1), (1.9, 15.3));
    let mut seen = covered(&drawn(16, &flat(16, [a, b, c])));
    let first = seen.len();
    seen.extend(covered(&drawn(16, &flat(16, [b, a, d]))));
    assert!(first > 50 && seen.len() > first + 50);
    let all = seen.len();
    seen.sort_unstable();
    seen.dedup();
    assert_eq!(seen.len(), all, "a pixel is covered twice");
    // And none is left out: the shared edge crosses the rows 1 to 14, whose covered pixels must be one run.
    for row in 1..15 {
        let columns: Vec<usize> = seen.iter().filter(|(_, y)| *y == row).map(|(x, _)| *x).collect();
        let (least, greatest) = (columns.iter().min().expect("a run"), columns.iter().max().expect("a run"));
        assert_eq!(greatest - least + 1, columns.len(), "row {row}");
    }
}

#[test]
fn both_windings_are_drawn_alike() {
    let [a, b, c] = flat(8, [(0.3, 0.7), (7.1, 2.9), (3.7, 7.1)]);
    assert_eq!(drawn(8, &[a, b, c]), drawn(8, &[a, c, b]));
}

#[test]
fn colours_are_interpolated_in_perspective() {
    // Left vertices at w = 1 with 0, the right one at w = 3 with 1; the point half way across the picture has the weights
    // (1/2)/1 and (1/2)/3 before division, so the colour is (1/6) / (1/2 + 1/6) = 1/4.
    let triangle = [vertex(64, 0.5, -63.5, 1.0, 0.0), vertex(64, 0.5, 64.5, 1.0, 0.0), vertex(64, 64.5, 0.5, 3.0, 1.0)];
    let frame = drawn(64, &triangle);
    // The pixel (32, 0) has its centre at (32.5, 0.5), half way. 255/4 = 63.75 is rounded to 64.
    assert_eq!(frame.pixels[32], [64, 64, 64, 255]);
}

#[test]
fn the_near_plane_cuts_what_lies_before_it() {
    // z = -w is the near plane. The lower left corner is at z = -3w, so that the cut is half way along both edges at it.
    let mut triangle = flat(8, [(0.0, 8.0), (8.0, 8.0), (0.0, 0.0)]);
    triangle[0].position.z = -3.0;
    triangle[1].position.z = 1.0;
    triangle[2].position.z = 1.0;
    let frame = drawn(8, &triangle);
    // Inside the triangle x < y, and beyond the cut from (4, 8) to (0, 4): y < x + 4.
    for (x, y) in covered(&frame) {
        assert!(x <= y && y <= x + 4, "({x}, {y})");
    }
    assert_eq!(frame.pixels[5 * 8 + 3][3], 255);
    assert_eq!(frame.pixels[7 * 8 + 1][3], 0);
    assert_eq!(frame.coverage[7 * 8 + 1], Coverage::Outside);
}

#[test]
fn what_lies_behind_the_eye_is_not_mirrored_into_the_picture() {
    let behind = flat(8, [(1.0, 1.0), (7.0, 1.0), (1.0, 7.0)]).map(|v| ClipVertex { position: -v.position, ..v });
    assert!(covered(&drawn(8, &behind)).is_empty());
}

#[test]
fn a_vertex_behind_the_eye_does_not_spoil_the_others() {
    // A at s = 0 has w = 1, y = z = 0; the third vertex at s = 1 has w = -1, y = 1/2, z = -2. Along the edge w = 1 - 2s,
    // y = s/2, z = -2s, which meets the near plane z = -w at s = 1/4. There y/w = 1/4: three pixels from the top. So the
    // triangle opens upwards from its edge at row 4 (away from the third vertex's mirrored image) and covers row 3 only.
    let mut triangle = flat(8, [(2.0, 4.0), (6.0, 4.0), (4.0, 6.0)]);
    triangle[2].position = DVec4::new(0.0, 0.5, -2.0, -1.0);
    let pixels = covered(&drawn(8, &triangle));
    assert!(pixels.iter().all(|(_, y)| *y == 3), "{pixels:?}");
    // In x the edges run from -1/2 and 1/2 at s = 0 to ∓(1/2)(3/4)/(1/2) = ∓3/4 at the near plane: row 3 is covered at least
    // from 2 to 6.
    assert!((2..6).all(|x| pixels.contains(&(x, 3))), "{pixels:?}");
}

#[test]
fn pixels_near_an_edge_are_left_to_the_rasteriser() {
    // A left edge 0.05 pixels from the centres of column 2 (within 1/16), a right edge 0.3 from those of column 6.
    let triangle = flat(16, [(2.45, -20.0), (2.45, 40.0), (6.8, 10.5)]);
    let frame = drawn(16, &triangle);
    let at = |x: usize, y: usize| frame.coverage[y * 16 + x];
    assert_eq!(at(2, 10), Coverage::Silhouette);
    assert_eq!(at(3, 10), Coverage::Interior);
    assert_eq!(at(1, 10), Coverage::Outside);
    assert_eq!(at(9, 10), Coverage::Outside);
}

#[test]
fn colours_are_clamped_and_rounded_to_the_nearest() {
    let colour = |grey: f64| {
        let triangle = flat(4, [(-8.0, -8.0), (16.0, -8.0), (-8.0, 16.0)]);
        let triangle = triangle.map(|v| ClipVertex { colour: DVec3::splat(grey), ..v });
        drawn(4, &triangle).pixels[0][0]
    };
    assert_eq!(colour(-0.5), 0);
    assert_eq!(colour(1.5), 255);
    // 0.12 × 255 = 30.6 and 0.1 × 255 = 25.5.
    assert_eq!(colour(0.12), 31);
    assert_eq!(colour(0.099), 25);
    assert_eq!(colour(f64::NAN), 0);
}

#[test]
fn a_vertex_that_is_no_number_draws_nothing() {
    for odd in [f64::NAN, f64::INFINITY] {
        let mut triangle = flat(4, [(0.0, 0.0), (4.0, 0.0), (0.0, 4.0)]);
        triangle[1].position.x = odd;
        assert_eq!(drawn(4, &triangle), Frame::cleared(4, 4, BACKGROUND), "{odd}");
    }
}
