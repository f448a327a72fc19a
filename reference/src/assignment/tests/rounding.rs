//! What rounding decides is judged for nobody.

use super::{changed, homework};
use crate::Folder;
use crate::assignment::{Assignment, MANIFEST};
use crate::rasteriser::Coverage;

/// A homework with a texture of two greys, 102/255 and 204/255, in 4 × 2 fields, whose solution does this with `grey` and `iTime`.
fn fields(statement: &str) -> Folder {
    let texture = "[[uniform]]\nname = \"greys\"\ntexture = \"greys\"\n\n[[texture]]\nname = \"greys\"\nsize = [4, 2]\nfilter = \"nearest\"\n\
                   generate = { checker = { squares = [4, 2], colours = [[0.4, 0.4, 0.4], [0.8, 0.8, 0.8]] } }\n\n[scene]";
    let folder = changed(homework("rings"), MANIFEST, "[scene]", texture);
    let folder = changed(folder, MANIFEST, "is = \"5.0 * t\"", "is = \"t\"");
    let folder =
        changed(folder, "solution.frag", "uniform float iTime;", "uniform float iTime;\nuniform sampler2D greys;");
    let own =
        format!("float grey = texture(greys, at / iResolution.xy).r;\n  {statement}\n  colour = vec4(tint, 1.0);");
    changed(folder, "solution.frag", "colour = vec4(tint, 1.0);", &own)
}

/// For each picture, how much of it is judged.
fn judged(statement: &str) -> Vec<f64> {
    let assignment = Assignment::load(fields(statement)).unwrap_or_else(|error| panic!("{statement}: {error}"));
    let of = |pose| {
        let coverage = assignment.right_frame(&pose).coverage;
        coverage.iter().filter(|own| **own != Coverage::Silhouette).count() as f64 / coverage.len() as f64
    };
    assignment.scene.all_poses().into_iter().map(of).collect()
}

#[test]
fn a_texel_on_a_threshold_is_not_judged() {
    let apart = judged("if (grey < 0.41) discard;");
    assert!(apart.iter().all(|share| *share > 0.9), "{apart:?}");
    let tied = judged("if (grey < 0.4) discard;");
    assert!(tied.iter().all(|share| (0.4..0.6).contains(share)), "{tied:?}");
    // Every driver has 0 and 1 exactly.
    let exact = judged("if (step(0.5, grey) * texture(greys, at).a < 1.0) discard;");
    assert!(exact.iter().all(|share| *share > 0.9), "{exact:?}");
}

#[test]
fn a_uniform_on_a_threshold_is_not_judged_where_it_is() {
    // The pictures are at t = 0, 0.2, 0.4, 0.6 and 0.8.
    let tied = judged("if (grey < 0.5 && iTime <= 0.4) tint *= 0.5;");
    let is_judged: Vec<bool> = tied.iter().map(|share| *share > 0.9).collect();
    assert_eq!(is_judged, [true, true, false, true, true], "{tied:?}");
}
