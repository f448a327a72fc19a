//! Lookups in small textures whose texels are known.

use super::super::Compare;
use super::*;

/// 4 × 2 texels: red is x, green is y.
fn texture() -> Texture {
    let texels: Vec<_> = (0..8).map(|n| [f64::from(n % 4), f64::from(n / 4), 0.0, 1.0]).collect();
    Texture::two_dimensional(4, 2, texels)
}

fn at(x: f64, y: f64) -> Lookup {
    Lookup { coordinates: [x, y, 0.0, 0.0], ..Lookup::default() }
}

#[test]
fn nearest_takes_the_texel_that_the_place_lies_in() {
    let texture = texture();
    assert_eq!(texture.sample(&at(0.49, 0.49))[..2], [1.0, 0.0]);
    assert_eq!(texture.sample(&at(0.5, 0.5))[..2], [2.0, 1.0]);
    // Repeated: −0.1 is 0.9.
    assert_eq!(texture.sample(&at(-0.1, 1.3))[..2], [3.0, 0.0]);
}

#[test]
fn one_texel_is_the_same_on_the_short_way() {
    let mut texture = texture();
    assert!(texture.is_plain());
    texture.border = [9.0; 4];
    for wrap in [Wrap::Repeat, Wrap::MirroredRepeat, Wrap::ClampToEdge, Wrap::ClampToBorder] {
        texture.wrap = [wrap; 3];
        for (compare, reference) in [(None, None), (Some(Compare::LessOrEqual), Some(1.5))] {
            texture.compare = compare;
            for [x, y] in [[0.49, 0.3], [-0.1, 1.3], [2.2, -3.1], [1.0, 0.0]] {
                let lookup = Lookup { reference, offset: [1.0, -1.0, 0.0], ..at(x, y) };
                assert_eq!(
                    texture.nearest([x, y], [1.0, -1.0], reference),
                    texture.sample(&lookup),
                    "{wrap:?} {x} {y}"
                );
            }
        }
    }
}

#[test]
fn what_lies_beyond_is_repeated_mirrored_clamped_or_border() {
    let mut texture = texture();
    let x = |texture: &Texture, x: f64| texture.sample(&at(x, 0.25))[0];
    texture.wrap = [Wrap::MirroredRepeat; 3];
    assert_eq!([-0.1, 1.1, 1.9, 2.1].map(|s| x(&texture, s)), [0.0, 3.0, 0.0, 0.0]);
    texture.wrap = [Wrap::ClampToEdge; 3];
    assert_eq!([-0.1, 1.1].map(|s| x(&texture, s)), [0.0, 3.0]);
    texture.wrap = [Wrap::ClampToBorder; 3];
    texture.border = [9.0; 4];
    assert_eq!([-0.1, 0.1, 1.1].map(|s| x(&texture, s)), [9.0, 0.0, 9.0]);
}

#[test]
fn linear_weighs_by_the_distance_of_the_middles() {
    let mut texture = texture();
    (texture.magnify, texture.wrap) = (Filter::Linear, [Wrap::ClampToEdge; 3]);
    // x = 0.5 · 4 − 0.5 = 1.5: half of 1 and half of 2; y = 0.5 · 2 − 0.5 = 0.5.
    assert_eq!(texture.sample(&at(0.5, 0.5))[..2], [1.5, 0.5]);
    assert_eq!(texture.sample(&at(0.0, 0.0))[..2], [0.0, 0.0]);
    // Beyond the last middle the border counts by a half at the edge.
    (texture.wrap, texture.border) = ([Wrap::ClampToBorder; 3], [11.0, 0.0, 0.0, 0.0]);
    assert_eq!(texture.sample(&at(1.0, 0.25))[0], 7.0);
}

#[test]
fn a_comparison_is_made_before_the_filter() {
    let mut texture = texture();
    (texture.magnify, texture.wrap) = (Filter::Linear, [Wrap::ClampToEdge; 3]);
    (texture.compare, texture.clamps_reference) = (Some(Compare::LessOrEqual), false);
    // Between the texels 1 and 2 at 1.25: 1.5 ≤ 1 fails, 1.5 ≤ 2 holds with a weight of 0.25.
    let lookup = Lookup { reference: Some(1.5), ..at(1.75 / 4.0, 0.25) };
    assert_eq!(texture.sample(&lookup)[0], 0.25);
    texture.clamps_reference = true;
    // Clamped to 1: 1 ≤ 1 and 1 ≤ 2.
    assert_eq!(texture.sample(&lookup)[0], 1.0);
}

#[test]
fn four_texels_are_gathered_against_the_clock_from_the_upper_left() {
    let texture = texture();
    assert_eq!(texture.gather(&at(0.5, 0.5), 0), [1.0, 2.0, 2.0, 1.0]);
    assert_eq!(texture.gather(&at(0.5, 0.5), 1), [1.0, 1.0, 0.0, 0.0]);
}

#[test]
fn the_level_follows_from_the_distance_of_neighbours() {
    let mut texture = texture();
    texture.levels.push(Level { size: [2, 1, 1], texels: vec![[10.0; 4], [11.0; 4]].into() });
    (texture.mipmap, texture.minify) = (Some(Filter::Nearest), Filter::Nearest);
    let gradient = |texels: f64| Some([[texels / 4.0, 0.0, 0.0], [0.0; 3]]);
    // 1.4 texels: level 0.49 is rounded to 0; 1.5 texels: 0.58 to 1.
    assert_eq!(texture.sample(&Lookup { gradient: gradient(1.4), ..at(0.1, 0.1) })[0], 0.0);
    assert_eq!(texture.sample(&Lookup { gradient: gradient(1.5), ..at(0.1, 0.1) })[0], 10.0);
    texture.mipmap = Some(Filter::Linear);
    // √2 texels: halfway between the levels.
    let value = texture.sample(&Lookup { gradient: gradient(2_f64.sqrt()), ..at(0.1, 0.1) })[0];
    assert!((value - 5.0).abs() < 1e-12);
    assert_eq!(texture.sample(&Lookup { level: 1.0, ..at(0.9, 0.1) })[0], 11.0);
}

#[test]
fn a_texel_outside_is_not_fetched() {
    let texture = texture();
    assert_eq!(texture.fetch(&at(3.0, 1.0)), Some([3.0, 1.0, 0.0, 1.0]));
    assert_eq!(texture.fetch(&at(4.0, 1.0)), None);
    assert_eq!(texture.fetch(&Lookup { level: 1.0, ..at(0.0, 0.0) }), None);
}
