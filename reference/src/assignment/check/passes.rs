//! The pass of an assignment, and the texture that it draws.

use super::expression::expression;
use super::stages::compiled;
use super::{CheckResult, listed, textures};
use crate::assignment::{AssignmentError, Interface, error};
use crate::interpreter::{Stage, Texels, Texture, Type};
use crate::manifest::{Format, Manifest};
use crate::scene::{DepthPass, DepthTest, Pass, Scene};
use crate::text::both;

/// Adds the pass to the scene, and says how its texture is drawn. `textures` are those of the manifest, then those of all pictures.
pub(super) fn pass(
    m: &Manifest,
    textures: &[Texture],
    scene: &mut Scene,
    interface: &Interface,
    read: &dyn Fn(&str) -> CheckResult<String>,
    place_at: &dyn Fn(usize) -> String,
) -> CheckResult<()> {
    let is_depth = |texture: &&crate::manifest::TextureEntry| texture.format.is_some_and(Format::is_depth);
    let target = m.texture.iter().find(is_depth);
    let entry = match (&m.pass[..], target) {
        ([], None) => return Ok(()),
        ([], Some(texture)) => {
            return Err(error(
                textures::place(texture, place_at),
                both(
                    "no pass draws it: write [[pass]], or remove it",
                    "どの [[pass]] も描きません。[[pass]] を書くか、取り除いてください",
                ),
            ));
        }
        ([entry], _) => entry,
        ([_, second, ..], _) => {
            return Err(error(
                format!("{}, pass", place_at(second.target.span().start)),
                both("is a second one: keep one [[pass]]", "2 つ目です。[[pass]] は 1 つだけにしてください"),
            ));
        }
    };
    let place = format!("{}, pass", place_at(entry.target.span().start));
    let wrong = |en: String, ja: String| -> AssignmentError { error(place.clone(), both(en, ja)) };
    let name = entry.target.get_ref();
    let target = m.texture.iter().filter(is_depth).find(|texture| texture.name.get_ref() == name);
    let maps = m.texture.iter().filter(is_depth).count();
    let Some(target) = target.filter(|_| maps == 1) else {
        return Err(wrong(
            format!(
                "`target` is the one [[texture]] with `format = \"depth24\"`, `\"depth32f\"` or `\"moments\"`: there is no `{name}`, or another beside it"
            ),
            format!(
                "`target` には `format = \"depth24\"`、`\"depth32f\"`、`\"moments\"` のいずれかの [[texture]] を 1 つだけ書きます。`{name}` がないか、ほかにもあります"
            ),
        ));
    };
    for named in entry.draws.iter().flatten() {
        let has = |view: &crate::scene::View| view.draws.iter().any(|draw| draw.name.as_ref() == Some(named));
        if !scene.views.iter().all(has) {
            let known = listed(scene.views.iter().flat_map(|view| &view.draws).filter_map(|draw| draw.name.as_deref()));
            return Err(wrong(
                format!("`draws`: not every scene has a [[scene.draw]] with `name = \"{named}\"` (there is {known})"),
                format!("`draws`: `name = \"{named}\"` の [[scene.draw]] がない scene があります (あるもの: {known})"),
            ));
        }
    }
    let program = compiled(&entry.program.vertex, Stage::Vertex, &read(&entry.program.vertex)?)?.program;
    let is_given = |name: &str| interface.uniforms.iter().any(|uniform| uniform.path == name);
    let reads = program.inputs().iter().filter(|input| !input.name.starts_with("gl_"));
    let mut lacking = reads.filter(|input| !interface.inputs.iter().any(|own| own.name == input.name));
    let mut unset = program.uniforms().iter().filter(|own| !is_given(&own.name) || own.kind.has_sampler());
    if let Some(variable) = lacking.next().or_else(|| unset.next()) {
        let (file, name) = (&entry.program.vertex, &variable.name);
        return Err(wrong(
            format!("{file} reads `{name}`: use only what [[input]] and [[uniform]] give, textures aside"),
            format!(
                "{file} が `{name}` を読んでいます。[[input]] と [[uniform]] にあるものだけを使ってください (テクスチャを除く)"
            ),
        ));
    }
    let [width, height] = target.size.unwrap_or_default().sides();
    if !entry.polygon_offset.iter().all(|number| number.is_finite()) {
        return Err(wrong("`polygon_offset` is two numbers".into(), "`polygon_offset` は 2 つの数です".into()));
    }
    scene.pass = Some(Pass {
        view: expression(&entry.view, &Type::MAT4, "pass, `view`", place_at)?,
        projection: expression(&entry.projection, &Type::MAT4, "pass, `projection`", place_at)?,
        program,
        draws: entry.draws.clone(),
        depth_test: entry.depth_test.unwrap_or(DepthTest::Less),
        cull: entry.cull,
        polygon_offset: entry.polygon_offset,
        size: [width, height],
        is_fixed_point: target.format == Some(Format::Depth24),
        moments: (target.format == Some(Format::Moments)).then(|| target.blur.unwrap_or(0)),
    });
    let poses = scene.all_poses();
    for pose in &poses {
        let matrices = scene.instances(pose).first().map(|instance| instance.moment.pass);
        if !matrices.is_some_and(|pass| pass.iter().all(|matrix| matrix.is_finite())) {
            return Err(wrong(
                format!("there is no matrix at t = {}: look at `view` and `projection`", pose.t),
                format!("t = {} で行列を作れません。`view` と `projection` を確かめてください", pose.t),
            ));
        }
    }
    let whole = std::sync::Arc::new(DepthPass { scene: scene.clone(), interface: interface.clone() });
    for (pose, texture) in poses.into_iter().zip(&textures[m.texture.len()..]) {
        if let Texels::Depths(depths) = &texture.levels[0].texels {
            let whole = std::sync::Arc::clone(&whole);
            depths.are(move || whole.map(&pose));
        }
    }
    Ok(())
}

/// How many squares of one depth the map of probes has along a side.
const SQUARES: usize = 32;

/// What SplitMix64 makes of a number (Steele, Lea and Flood 2014), from 0 to 1: neighbours have nothing in common.
fn scattered(number: u64) -> f32 {
    let mut z = number.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 40) as f32 / 16_777_216.0
}

/// Depths that no scene has, for probes: squares, each with a depth of its own anywhere from 0 to 1. A place or a depth that is looked
/// up wrongly meets another answer in about every second probe, whatever is wrong with it.
pub(super) fn depths_of_probes([width, height]: [usize; 2]) -> Vec<f32> {
    let square = |at: usize, size: usize| at * SQUARES / size;
    let depth = |x: usize, y: usize| scattered((square(y, height) * SQUARES + square(x, width) + 1) as u64);
    (0..height).flat_map(|y| (0..width).map(move |x| depth(x, y))).collect()
}

/// The least and the greatest deviation of the depths of a square. Noise: a variance computed in f32 is off by 1e-7, of the least
/// square here by 1e-4 of itself.
const DEVIATION: [f32; 2] = [0.04, 0.25];

/// The same as means of depths, with a deviation of each square's own; and the means of their squares.
pub(super) fn moments_of_probes(depths: &[f32]) -> Vec<f32> {
    let [least, most] = DEVIATION;
    let moments = |mean: &f32| {
        let deviation = least + (most - least) * scattered(u64::from(mean.to_bits()));
        [*mean, mean * mean + deviation * deviation]
    };
    depths.iter().flat_map(moments).collect()
}
