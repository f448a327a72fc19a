//! Passes, the maps that they draw, and uniforms that students name.

use super::{changed, refused};
use crate::assignment::{Assignment, MANIFEST};
use crate::built_in::assignment;
use crate::interpreter::{Stage, Texels};
use crate::pipeline::Pipeline;
use crate::probes::EdgeDefect;
use crate::rasteriser::Coverage;
use crate::{Folder, feed::Feed};

fn shadows() -> Folder {
    Folder::clone(&assignment("ggsample11-map").expect("built in").folder)
}

/// The ids of what the uniforms of an answer are taken for.
fn taken(vertex: impl Fn(&str) -> String, fragment: impl Fn(&str) -> String) -> Vec<(String, String)> {
    let assignment = assignment("ggsample11-map").expect("built in");
    let text = |at: usize| assignment.files[at].solution.text.as_str();
    let [vertex, fragment] = [vertex(text(0)), fragment(text(1))];
    let taken =
        assignment.taken(&[(Stage::Vertex, &vertex), (Stage::Fragment, &fragment)], &assignment.judging_probes());
    taken.into_iter().map(|taken| (taken.name, taken.as_what.id.clone())).collect()
}

fn same(text: &str) -> String {
    text.to_owned()
}

fn pairs(pairs: &[(&str, &str)]) -> Vec<(String, String)> {
    pairs.iter().map(|(name, id)| ((*name).to_owned(), (*id).to_owned())).collect()
}

#[test]
fn the_maps_of_pictures_stand_behind_that_of_probes() {
    let assignment = assignment("ggsample11-map").expect("built in");
    let poses = assignment.scene.all_poses();
    assert_eq!(assignment.textures.len(), 1 + poses.len());
    let sampler = assignment.interface.uniforms.iter().find(|uniform| uniform.path == "depth").expect("a sampler");
    assert!(matches!(sampler.feed, Feed::Drawn { first: 1, at_probes: 0 }));
    for (number, pose) in poses.iter().enumerate() {
        let moment = assignment.scene.instances(pose)[0].moment;
        assert_eq!(sampler.value(&moment).numbers(), [(1 + number) as f64]);
    }
    let Texels::Depths(probes) = &assignment.textures[0].levels[0].texels else { panic!("depths") };
    let mut depths: Vec<f32> = probes.drawn().to_vec();
    depths.sort_by(f32::total_cmp);
    depths.dedup();
    assert_eq!(depths.len(), 32 * 32, "each square has a depth of its own");
    assert!(depths[0] >= 0.0 && depths[1023] < 1.0);
}

#[test]
fn a_map_holds_what_is_drawn_into_it_and_nothing_else() {
    let assignment = assignment("ggsample11-map").expect("built in");
    let Texels::Depths(map) = &assignment.textures[1].levels[0].texels else { panic!("depths") };
    let map = map.drawn();
    let covered = map.iter().filter(|depth| **depth < 1.0).count();
    // The document of the homework measured 27,000 to 56,000 texels.
    assert!((27_000..=56_000).contains(&covered), "{covered}");
    // Without an offset: the figures, 0.88 high, stand on the floor, 4 below the light. With n = 1 and f = 5 the depth at a distance d is
    // (f + n) / (f - n) / 2 + 1 / 2 - f n / (f - n) / d = 1.25 - 1.25 / d: 0.849 at 3.12 and 0.9375 at 4.
    let plain = Assignment::load(changed(shadows(), MANIFEST, "polygon_offset = [1, 1]", "")).expect("an assignment");
    let Texels::Depths(plain) = &plain.textures[1].levels[0].texels else { panic!("depths") };
    let drawn = || plain.drawn().iter().copied().filter(|depth| *depth < 1.0);
    let (nearest, farthest) = (drawn().fold(1.0, f32::min), drawn().fold(0.0, f32::max));
    assert!(nearest > 0.845 && nearest < 0.86 && farthest < 0.938, "{nearest} to {farthest}");
    // 24 bits of fixed point, as far as a float holds them.
    assert!(map.iter().all(|depth| {
        let steps = f64::from(*depth) * 16_777_215.0;
        (steps - steps.round()).abs() <= 0.51
    }));
    let with_the_floor = changed(shadows(), MANIFEST, "draws = [\"figures\"]\n", "");
    let with_the_floor = Assignment::load(with_the_floor).expect("an assignment");
    let Texels::Depths(other) = &with_the_floor.textures[1].levels[0].texels else { panic!("depths") };
    let more = other.drawn().iter().filter(|depth| **depth < 1.0).count();
    // The floor is 5.6 of the 7.45 = 2 · 4 · tan 0.75 that the light sees at its distance.
    assert!(more > 350_000, "{more}");
}

#[test]
fn an_offset_moves_depths_by_slope_and_units() {
    let map = |offset: &str| {
        let folder = changed(shadows(), MANIFEST, "polygon_offset = [1, 1]", offset);
        let assignment = Assignment::load(folder).expect("an assignment");
        let Texels::Depths(map) = &assignment.textures[1].levels[0].texels else { panic!("depths") };
        map.drawn().to_vec()
    };
    let (plain, units, slope) = (map(""), map("polygon_offset = [0, 1000]"), map("polygon_offset = [1, 0]"));
    for ((plain, units), slope) in plain.iter().zip(&units).zip(&slope).filter(|((plain, _), _)| **plain < 1.0) {
        // 1000 × 2⁻²⁴ = 5.96e-5, and a rounding to 24 bits.
        assert!((f64::from(units - plain) - 5.96e-5).abs() < 1.5e-7, "{plain} {units}");
        assert!(slope >= plain, "{plain} {slope}");
    }
}

#[test]
fn what_a_little_less_depth_or_a_neighbour_changes_is_not_judged() {
    let poses = |assignment: &Assignment| assignment.scene.all_poses()[0];
    let judged = assignment("ggsample11-map").expect("built in");
    let mut folder = shadows();
    let text = folder.text(MANIFEST).expect("a text").to_owned();
    let (before, rest) = text.split_once("[[unjudged]]").expect("what is not judged");
    let after = &rest[rest.find("[probes]").expect("probes")..];
    folder.files.insert(MANIFEST.into(), [before, after].concat().into());
    let all = Assignment::load(folder).expect("an assignment");
    let open = |assignment: &Assignment| {
        let frame = assignment.right_frame(&poses(assignment));
        frame.coverage.iter().filter(|coverage| **coverage == Coverage::Silhouette).count()
    };
    let (less, more) = (open(&all), open(judged));
    println!("{less} and {more} pixels");
    assert!(more > less + 5_000 && more < less + 60_000, "{less} and {more}");
}

#[test]
fn a_mean_of_comparisons_goes_over_edges_gradually_and_one_comparison_at_once() {
    let [soft, hard] = ["ggsample11-pcf", "ggsample11-map"].map(|name| assignment(name).expect("built in"));
    let crossings = soft.crossings().expect("edges");
    assert_eq!(crossings.probes.probes.len(), 4 * 4 * 32);
    let course = |pipeline: &Pipeline| {
        let shown = soft.shown_once(pipeline, &crossings.probes).expect("it runs");
        crossings.course(&shown.iter().map(|shown| shown.colour.to_array()).collect::<Vec<_>>())
    };
    assert_eq!(course(&soft.pipeline), None);
    assert_eq!(course(&hard.pipeline), Some(EdgeDefect::Abrupt));
    assert!(hard.crossings().is_none(), "nobody asks for them");
}

#[test]
fn a_map_of_moments_has_the_mean_of_squares_above_the_square_of_the_mean() {
    let assignment = assignment("ggsample11-vsm").expect("built in");
    for texture in &assignment.textures[..2] {
        let Texels::Depths(map) = &texture.levels[0].texels else { panic!("depths") };
        assert_eq!((map.each(), map.drawn().len()), (2, 2 * 400 * 400));
        let (pairs, _) = map.drawn().as_chunks::<2>();
        assert!(pairs.iter().all(|[mean, squares]| squares - mean * mean > -1e-6 && (0.0..=1.0).contains(mean)));
        // Somewhere depths differ.
        assert!(pairs.iter().any(|[mean, squares]| squares - mean * mean > 1e-3));
    }
}

#[test]
fn uniforms_are_what_an_answer_is_right_with() {
    let renamed = |text: &str| text.replace("ms", "shadowMatrix");
    assert_eq!(taken(same, same), []);
    assert_eq!(taken(renamed, same), pairs(&[("shadowMatrix", "matrix-to-clip-space")]));
    let projected = |text: &str| text.replace("ndc * 0.5 + 0.5", "ndc");
    assert_eq!(taken(renamed, projected), pairs(&[("shadowMatrix", "matrix-to-texture-space")]));
    let apart = |text: &str| text.replace("uniform mat4 ms;", "uniform mat4 m, vp;").replace("ms * pv", "vp * m * pv");
    assert_eq!(taken(apart, same), pairs(&[("m", "matrix-of-the-model"), ("vp", "matrix-of-the-light")]));
    let by_hand = |text: &str| {
        let text = text.replace("sampler2DShadow", "sampler2D");
        text.replace("texture(depth, q)", "float(q.z <= texture(depth, q.xy).r)")
    };
    assert_eq!(taken(same, by_hand), pairs(&[("depth", "depth-map")]));
}

#[test]
fn of_an_answer_that_is_never_right_a_single_matrix_is_what_the_slides_have() {
    let renamed = |text: &str| text.replace("ms", "shadowMatrix");
    let dark = |text: &str| text.replace("(idiff + ispec) * lit", "(idiff + ispec) * (1.0 - lit)");
    assert_eq!(taken(renamed, dark), pairs(&[("shadowMatrix", "matrix-to-clip-space")]));
}

#[test]
fn of_an_answer_that_is_never_right_several_matrices_are_what_its_text_computes_most_with() {
    let scaled = |text: &str| text.replace("ndc * 0.5 + 0.5", "ndc * 0.95 + 0.5");
    let apart = |text: &str| text.replace("uniform mat4 ms;", "uniform mat4 m, vp;").replace("ms * pv", "vp * m * pv");
    let meant = pairs(&[("m", "matrix-of-the-model"), ("vp", "matrix-of-the-light")]);
    assert_eq!(taken(apart, scaled), meant);
    let turned = |text: &str| apart(text).replace("lpos.w).xyz", "lpos.w).yzx");
    assert_eq!(taken(turned, same), meant);
    // What scales by itself nowhere is given what has the scaling in it, whatever else is wrong.
    let renamed = |text: &str| text.replace("ms", "shadowMatrix").replace("lpos.w).xyz", "lpos.w).yzx");
    let projected = |text: &str| text.replace("ndc * 0.5 + 0.5", "ndc");
    assert_eq!(taken(renamed, projected), pairs(&[("shadowMatrix", "matrix-to-texture-space")]));
}

#[test]
fn more_uniforms_than_can_be_tried_are_taken_as_they_come() {
    let many = |text: &str| {
        let declared: String = (0..100).map(|number| format!("uniform mat4 m{number};\n")).collect();
        let sum: String = (0..100).map(|number| format!(" + m{number} * pv")).collect();
        text.replace("uniform mat4 ms;", &declared).replace("ms * pv", &sum[3..])
    };
    let taken = taken(many, same);
    assert_eq!(taken.len(), 100);
    assert!(taken.iter().all(|(_, id)| id == "matrix-to-clip-space"));
}

#[test]
fn a_pass_that_draws_nothing_is_named_with_what_to_try() {
    let pass = "[[pass]]\ntarget = \"depth\"";
    for (from, to, en, ja) in [
        ("target = \"depth\"", "target = \"shadow\"", "there is no `shadow`", "`shadow` がない"),
        (
            pass,
            "[[pass]]\ntarget = \"depth\"\nprogram = { vertex = \"depth.vert\" }\nview = \"mat4(1)\"\nprojection = \"mat4(1)\"\n[[pass]]\ntarget = \"depth\"",
            "is a second one",
            "2 つ目です",
        ),
        (
            "draws = [\"figures\"]",
            "draws = [\"trees\"]",
            "`name = \"trees\"` (there is `floor`",
            "`name = \"trees\"` の [[scene.draw]]",
        ),
        ("vertex = \"depth.vert\"", "vertex = \"gone.vert\"", "gone.vert", "gone.vert"),
        (
            "perspective(1.5, 1.0, 1.0, 5.0)",
            "perspective(0.0, 1.0, 1.0, 5.0)",
            "no matrix at t = 0",
            "行列を作れません",
        ),
        ("perspective(1.5, 1.0, 1.0, 5.0)", "perspektive(1.5)", "perspektive", "perspektive"),
        (
            "format = \"depth24\"",
            "format = \"depth24\"\nflip = true",
            "depths are drawn by a [[pass]]",
            "[[pass]] が描きます",
        ),
        ("size = [800, 800]", "size = [4000, 4000]", "for each of 6 pictures are too many", "大きすぎるか"),
        ("size = [800, 800]", "size = [0, 8]", "or none", "0 です"),
        ("format = \"depth24\"", "format = \"moments\"", "moments are not compared", "比較には使えません"),
        ("format = \"depth24\"", "format = \"depth24\"\nblur = 2", "`blur` is a number up to 16", "16 までの数"),
        (
            "[probes]",
            "[gradual]\nabrupt = \"flat-place\"\nuneven = \"rough\"\n[probes]",
            "there is no mistake `rough`",
            "`rough` という mistake はありません",
        ),
        ("polygon_offset = [1, 1]", "polygon_offset = [nan, 1]", "two numbers", "2 つの数"),
        ("id = \"view-of-the-light\"", "id = \"matrix-of-the-model\"", "stands twice", "2 回"),
        (
            "type = \"sampler2D\"\ntexture = \"depth\"",
            "type = \"sampler3D\"\ntexture = \"depth\"",
            "sampler2DShadow",
            "sampler2DShadow",
        ),
    ] {
        let text = refused(changed(shadows(), MANIFEST, from, to));
        assert!(text.en.contains(en), "{to}: {}", text.en);
        assert!(text.ja.contains(ja), "{to}: {}", text.ja);
    }
    let alone = shadows().text(MANIFEST).expect("a text").split("[[pass]]").next().expect("a text").to_owned()
        + &shadows().text(MANIFEST).expect("a text")
            [shadows().text(MANIFEST).expect("a text").find("# What the student's own").expect("a text")..];
    let mut folder = shadows();
    folder.files.insert(MANIFEST.into(), alone.into());
    assert!(refused(folder).en.contains("no pass draws it"));
    let reads = changed(shadows(), "depth.vert", "uniform mat4 mp;", "uniform mat4 mp; uniform float other;");
    let reads = changed(reads, "depth.vert", "mp * mv", "other * mp * mv");
    assert!(refused(reads).en.contains("depth.vert reads `other`"));
    let plain = changed(
        super::homework("carpet"),
        MANIFEST,
        "file = \"weave.png\"",
        "file = \"weave.png\"\ncompare = \"less\"",
    );
    assert!(refused(plain).en.contains("`compare` belongs to depths"));
}

#[test]
fn a_homework_has_at_most_ten_times_the_usual_time() {
    assert_eq!(assignment("ggsample11-pcf").expect("built in").time, 3, "as the homework that it extends");
    let text = refused(changed(shadows(), MANIFEST, "time = 3", "time = 0"));
    assert!(text.en.starts_with("assignment.toml, line 6, time: is 0: write how many times as long"), "{}", text.en);
}
