//! Other homeworks than the first against pictures and numbers of a real OpenGL driver (`tests/data`).

use reference::rasteriser::{Coverage, Frame};
use reference::{Assignment, Folder};
use std::path::{Path, PathBuf};

/// One step for the driver's f32 at a rounding boundary, one for a vertex snapped to 1/256 pixel.
const CHANNEL_TOLERANCE: u8 = 2;

/// Pixels of a picture with shadows that are judged and yet may differ: the driver draws its own depth map, whose texels at the
/// edges of figures are others in a few places. At most 8 were measured; the faintest mistake, another bias, changes 200 and more.
const BUDGET: usize = 16;

/// The pictures of both scenes with shadows, by twentieths of the cycle.
const SHADOWS: [&str; 6] = ["above-00", "above-02", "above-07", "aside-01", "aside-05", "aside-08"];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests")
}

fn loaded(name: &str) -> Assignment {
    let folder = Folder::read(&root().join("folders").join(name)).expect("a folder");
    Assignment::load(folder).unwrap_or_else(|error| panic!("{error}"))
}

fn captured(folder: &str, name: &str) -> image::RgbImage {
    let path = root().join("data").join(folder).join(format!("{name}.png"));
    image::open(path).expect("a captured frame").to_rgb8()
}

/// Pixels that are judged and drawn, those that are left to the rasteriser, and those that are not as captured.
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
fn a_torus_with_a_point_light_is_what_opengl_draws() {
    let assignment = loaded("gouraud-point-light");
    let frames = assignment.frames();
    let mut sum = [0; 3];
    for (index, frame) in frames.iter().enumerate() {
        let counts = compared(frame, &captured("gouraud-point-light", &format!("frame-{index:02}")));
        sum = [0, 1, 2].map(|at| sum[at] + counts[at]);
    }
    println!("{sum:?}");
    assert_eq!(frames.len(), 10);
    // The torus covers 130,000 of 307,200 pixels; its contour is some 2,400 pixels long, of which an eighth is near.
    assert!(sum[0] > 1_200_000 && sum[1] < 10_000, "{sum:?}");
    assert_eq!(sum[2], 0, "{sum:?}");
}

#[test]
fn shadow_maps_are_what_opengl_draws() {
    let assignment = reference::assignment("ggsample11-map").expect("built in");
    let frames = assignment.frames();
    assert_eq!(frames.len(), SHADOWS.len());
    for (name, frame) in SHADOWS.iter().zip(&frames) {
        let counts = compared(frame, &captured("ggsample11-map", name));
        println!("{name}: {counts:?}");
        // Floor and figures cover more than a quarter of the window. What lies two texels from an edge is open, the sides of figures that
        // shadow themselves among it: less than a third of what is judged.
        assert!(counts[0] > 200_000 && counts[1] < counts[0] / 3, "{name}: {counts:?}");
        assert!(counts[2] <= BUDGET, "{name}: {counts:?}");
    }
}

/// The frames of the homework of the projection shadow, by twentieths of the cycle.
const PROJECTIONS: [&str; 4] = ["above-00", "above-02", "above-04", "above-06"];

#[test]
fn projection_shadows_are_what_opengl_draws() {
    let assignment = reference::assignment("ggsample11-projection").expect("built in");
    let frames = assignment.frames();
    assert_eq!(frames.len(), PROJECTIONS.len());
    for (name, frame) in PROJECTIONS.iter().zip(&frames) {
        let counts = compared(frame, &captured("ggsample11-projection", name));
        println!("{name}: {counts:?}");
        assert!(counts[0] > 200_000 && counts[1] < counts[0] / 3, "{name}: {counts:?}");
        assert_eq!(counts[2], 0, "{name}: {counts:?}");
        // Ambient light alone, 0.2 · 0.2 of 255: as much of the picture as six silhouettes cover.
        let dark = frame.pixels.iter().filter(|pixel| pixel[..3] == [10; 3]).count();
        assert!((10_000..80_000).contains(&dark), "{name}: {dark}");
    }
}

#[test]
fn its_vertices_have_the_colours_that_opengl_computes() {
    let text = std::fs::read_to_string(root().join("data/gouraud-point-light/vertices.json")).expect("captured data");
    let captured: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let assignment = loaded("gouraud-point-light");
    let right = assignment.equation.right();
    let mesh = &assignment.scene.views[0].draws[0].mesh;
    let mut worst = 0.0_f64;
    for entry in captured["poses"].as_array().expect("poses") {
        let pose = assignment.scene.pose(entry["t"].as_f64().expect("t"));
        let uniforms = assignment.uniform_values(&assignment.scene.moment(pose.t, pose.matrices));
        for vertex in &mesh.vertices {
            // The captured torus has no seam: of 19 vertices around the tube the last is the first.
            let (i, j) = (vertex.number / 19 % 36, vertex.number % 19 % 18);
            let colour = right.evaluate(&uniforms, &assignment.attribute_values(vertex)).colour();
            for channel in 0..3 {
                let theirs = entry["v_color"][(i * 18 + j) as usize][channel].as_f64().expect("a number");
                worst = worst.max((colour[channel] - theirs).abs());
            }
        }
    }
    println!("at most {worst:e} apart");
    assert!(worst < 1e-4, "{worst:e}");
}

#[test]
fn what_is_hard_coded_shows_in_the_probes() {
    let assignment = loaded("gouraud-point-light");
    let probes = assignment.judging_probes();
    let place = |path: &str| assignment.interface.uniforms.iter().position(|uniform| uniform.path == path).expect(path);
    for path in ["u_lightPos", "u_material.shininess", "u_material.diffuse", "u_lightMaterial.specular"] {
        let values: Vec<_> = probes.groups.iter().map(|group| group.uniforms[place(path)].clone()).collect();
        assert!(values.windows(2).filter(|pair| pair[0] != pair[1]).count() > 20, "{path}");
    }
    let shininess = place("u_material.shininess");
    assert!(probes.groups.iter().all(|group| (4.0..=100.0).contains(&group.uniforms[shininess].float())));
}
