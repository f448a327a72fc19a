//! The reference against a right answer as Mesa's OpenGL driver computed it (`tests/data`).

use glam::DVec3;
use reference::rasteriser::{Coverage, Frame};
use reference::scene::Point;
use reference::{Assignment, assignment};
use std::path::{Path, PathBuf};

/// `vc` in f32, x^80 included: measured 3.1e-7 at most. The nearest known mistake differs by 5/255.
const VERTEX_COLOUR_TOLERANCE: f64 = 1e-4;

/// One step for the driver's f32 at a rounding boundary, one for a vertex snapped to 1/256 pixel.
const CHANNEL_TOLERANCE: u8 = 2;

fn ggsample06() -> &'static Assignment {
    assignment("ggsample06").expect("built in")
}

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(name)
}

#[test]
fn vertex_colours_agree_with_the_driver() {
    let text = std::fs::read_to_string(data("vertices.json")).expect("captured data");
    let captured: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let poses = captured["poses"].as_array().expect("poses");
    assert_eq!(poses.len(), 25);
    let assignment = ggsample06();
    let right = assignment.equation.right();
    let mut worst = 0.0f64;
    for entry in poses {
        let pose = assignment.scene.pose(entry["t"].as_f64().expect("t"));
        let uniforms = assignment.uniform_values(&assignment.scene.moment(pose.t, pose.matrices));
        for (i, vertex) in assignment.scene.triangle(&pose).iter().enumerate() {
            let colour = right.evaluate(&uniforms, &assignment.attribute_values(vertex)).colour();
            for channel in 0..3 {
                let theirs = entry["vc"][i][channel].as_f64().expect("a number");
                worst = worst.max((colour[channel] - theirs).abs());
            }
        }
    }
    println!("vc: at most {worst:e} apart");
    assert!(worst < VERTEX_COLOUR_TOLERANCE, "{worst:e}");
}

fn captured_frame(index: usize) -> image::RgbaImage {
    image::open(data(&format!("frame-{index:02}.png"))).expect("captured frame").to_rgba8()
}

fn covered(pixel: &[u8; 4]) -> bool {
    pixel[3] == 255
}

#[derive(Default, Debug)]
struct Tally {
    interior: usize,
    silhouette: usize,
    coverage_mismatches: usize,
    worst: u8,
    off_by_more_than_one: usize,
}

fn compare(ours: &Frame, theirs: &image::RgbaImage, tally: &mut Tally) {
    assert_eq!((ours.width, ours.height), theirs.dimensions());
    for ((pixel, coverage), their) in ours.pixels.iter().zip(&ours.coverage).zip(theirs.pixels()) {
        let silhouette = *coverage == Coverage::Silhouette;
        tally.silhouette += usize::from(silhouette);
        if covered(pixel) != (their[3] == 255) {
            assert!(silhouette, "coverage differs away from the silhouette");
            tally.coverage_mismatches += 1;
            continue;
        }
        let difference = (0..3).map(|c| pixel[c].abs_diff(their[c])).max().unwrap_or(0);
        if *coverage == Coverage::Interior {
            tally.interior += 1;
            tally.worst = tally.worst.max(difference);
        }
        tally.off_by_more_than_one += usize::from(difference > 1);
    }
}

#[test]
fn frames_agree_with_the_driver() {
    let frames = ggsample06().frames();
    assert_eq!(frames.len(), 25);
    let mut tally = Tally::default();
    for (index, frame) in frames.iter().enumerate() {
        compare(frame, &captured_frame(index), &mut tally);
    }
    println!("{tally:?}");
    // 745,364 pixels are covered in the captured frames.
    assert!(tally.interior > 700_000);
    assert!(tally.worst <= CHANNEL_TOLERANCE, "{tally:?}");
}

#[test]
fn a_wrong_equation_does_not_agree() {
    let assignment = ggsample06();
    let mut other = assignment.clone();
    other.scene.views[0].eye = Point::Fixed(DVec3::new(0.02, 2.0, 5.0));
    let moved = other.frames();
    let mismatched = moved.iter().enumerate().any(|(index, frame)| {
        let theirs = captured_frame(index);
        let pairs = frame.pixels.iter().zip(&frame.coverage).zip(theirs.pixels());
        pairs.into_iter().any(|((p, c), t)| *c != Coverage::Silhouette && covered(p) != (t[3] == 255))
    });
    assert!(mismatched, "the comparison cannot fail");
}
