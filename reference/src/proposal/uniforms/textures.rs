//! Pictures for samplers.

mod another;

use crate::interpreter::{Dimension, Sampler, Scalar};
use crate::proposal::names::NameWords;
use another::another;
use std::collections::HashMap;

/// An entry `[[texture]]`.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::proposal) struct ProposedTexture {
    pub name: String,
    /// `key = value`, one line each.
    pub lines: Vec<String>,
    pub what: (&'static str, &'static str),
}

/// The textures so far: no two of them are alike, so that it shows when an answer swaps them.
#[derive(Default)]
pub(super) struct ProposedTextures {
    /// How many textures have each picture of the tables, or another one made of it.
    taken: HashMap<String, usize>,
    colourful: usize,
}

/// Words, the lines of the entry, and what it is taken for.
type TextureGuess = (&'static [&'static str], &'static [&'static str], (&'static str, &'static str));

const GREY: &[TextureGuess] = &[
    (
        &["normal", "normals", "bump", "bumpmap"],
        &["generate = { normal-map = { of = { bumps = { count = [4, 4] } }, height = 0.08 } }", "size = [128, 128]"],
        ("a normal map", "法線マップ"),
    ),
    (
        &["height", "displacement", "depth", "parallax", "elevation", "terrain"],
        &["generate = { noise = { seed = 2, cells = [4, 4] } }", "size = [64, 64]"],
        ("heights", "高さ"),
    ),
    (
        &["noise", "dissolve", "perlin", "cloud", "clouds", "random", "channel0", "channel1", "channel2", "channel3"],
        &["generate = { noise = { seed = 7, cells = [6, 6] } }", "size = [128, 128]"],
        ("noise", "ノイズ"),
    ),
    (
        &["specular", "gloss", "roughness", "metallic", "metalness", "mask", "occlusion", "ao", "alpha", "opacity"],
        &[
            "generate = { noise = { seed = 5, cells = [6, 4], colours = [[0.1, 0.1, 0.1], [1, 1, 1]] } }",
            "size = [60, 60]",
        ],
        ("a mask of greys", "灰色の濃淡"),
    ),
    (
        &["hdr", "scene", "screen", "framebuffer", "buffer", "radiance", "irradiance"],
        &[
            "generate = { gradient = { rows = [[[0.02, 0.05, 0.1], [4.0, 2.0, 0.8]], [[0.3, 1.2, 0.5], [0.1, 0.2, 3.0]]] } }",
            "size = [64, 64]",
            "format = \"rgba32f\" # values beyond 1",
            "wrap = \"clamp-to-edge\"",
        ],
        ("a picture with values beyond 1", "1 を超える値のある画像"),
    ),
    (
        &["ramp", "gradient", "lut", "palette", "toon", "colormap"],
        &[
            "generate = { gradient = { rows = [[[0.1, 0.1, 0.3], [0.9, 0.5, 0.2], [1, 1, 0.8]]] } }",
            "size = [64, 4]",
            "wrap = \"clamp-to-edge\"",
        ],
        ("a ramp of colours", "色の階調"),
    ),
];

/// Pictures that are others when they are turned over or round, so that swapped coordinates show.
const COLOURFUL: [&[&str]; 3] = [
    &[
        "generate = { noise = { seed = 1, cells = [7, 5], colours = [[0.8, 0.25, 0.1], [0.95, 0.85, 0.6]] } }",
        "size = [96, 96]",
    ],
    &[
        "generate = { noise = { seed = 3, cells = [5, 5], colours = [[0.1, 0.3, 0.6], [0.8, 0.95, 0.7]] } }",
        "size = [96, 96]",
    ],
    &[
        "generate = { gradient = { rows = [[[0.9, 0.2, 0.3], [0.2, 0.3, 0.9]], [[0.9, 0.8, 0.2], [0.2, 0.8, 0.4]]] } }",
        "size = [64, 64]",
    ],
];

const NUMBERS: (&str, &str) = ("whole numbers", "整数");

const RAMP: &str = "generate = { gradient = { rows = [[[0.1, 0.1, 0.3], [0.9, 0.5, 0.2], [1, 1, 0.8]]] } }";

/// Whole numbers from 0 to 3, which are other ones in each channel.
const WHOLE: [&str; 2] = [
    "generate = { noise = { seed = 4, cells = [8, 6], octaves = 1, colours = [[0, 3, 0, 0], [3, 0, 3, 1]] } }",
    "generate = { noise = { seed = 8, cells = [8, 6], octaves = 1, colours = [[0, 3, 0, 0], [3, 0, 3, 1]] } }",
];

/// Pictures that are told apart, in each of which swapped coordinates show.
const COLOURS: [&str; 4] = [
    "{ noise = { seed = 1, cells = [7, 5], colours = [[0.8, 0.25, 0.1], [0.95, 0.85, 0.6]] } }",
    "{ gradient = { rows = [[[0.9, 0.2, 0.3], [0.2, 0.3, 0.9]], [[0.9, 0.8, 0.2], [0.2, 0.8, 0.4]]] } }",
    "{ checker = { squares = [4, 2], colours = [[0.1, 0.4, 0.2], [0.7, 0.9, 0.5]] } }",
    "{ noise = { seed = 3, cells = [5, 5], colours = [[0.1, 0.3, 0.6], [0.8, 0.95, 0.7]] } }",
];

/// Colours by their red, green and blue, somewhat turned, so that no two channels are alike.
const TABLE: [&str; 2] = [
    "{ gradient = { rows = [[[0.05, 0, 0.1], [0.9, 0.2, 0]], [[0.2, 0.7, 0.1], [1, 0.9, 0.3]]] } }",
    "{ gradient = { rows = [[[0, 0.1, 0.6], [0.7, 0.1, 0.9]], [[0.1, 0.8, 0.7], [0.9, 1, 0.95]]] } }",
];

fn owned(lines: &[&str]) -> Vec<String> {
    lines.iter().map(|line| (*line).to_owned()).collect()
}

/// A key with a list of pictures, one a line.
fn listed(key: &str, pictures: &[&str]) -> String {
    let each: String =
        pictures.iter().map(|picture| format!("    {},\n", picture.trim_start_matches("generate = "))).collect();
    format!("{key} = [\n{each}]")
}

impl ProposedTextures {
    /// A texture for the sampler at a path; `None` where a homework has none for it.
    pub fn of(&mut self, path: &str, sampler: Sampler) -> Option<ProposedTexture> {
        let is_whole = sampler.texel != Scalar::Float;
        if sampler.shadow || is_whole && sampler.dimension == Dimension::Cube {
            return None;
        }
        let words = NameWords::of(path);
        let (lines, what) = match (sampler.dimension, sampler.array) {
            (Dimension::Two, false) if is_whole => (owned(&[WHOLE[0], "size = [16, 12]"]), NUMBERS),
            (Dimension::Two, false) => self.flat(&words),
            (Dimension::Two, true) => {
                let pictures: &[&str] = if is_whole { &WHOLE } else { &COLOURS };
                (
                    vec![listed("layers", pictures), "size = [64, 64]".to_owned()],
                    ("some pictures of colours", "色の画像数枚"),
                )
            }
            (Dimension::Three, _) => {
                let pictures: &[&str] = if is_whole { &WHOLE } else { &TABLE };
                let size = if is_whole { "size = [16, 12]" } else { "size = [4, 4]" };
                let lines = [listed("slices", pictures), size.to_owned(), "wrap = \"clamp-to-edge\"".to_owned()];
                (lines.to_vec(), ("a table of colours", "色の表"))
            }
            (Dimension::One, false) if is_whole => (owned(&[WHOLE[0], "size = 16"]), NUMBERS),
            (Dimension::One, false) => {
                (owned(&[RAMP, "size = 64", "wrap = \"clamp-to-edge\""]), ("a ramp of colours", "色の階調"))
            }
            (Dimension::Cube, false) => {
                (owned(&["generate = { sky = {} }", "size = [64, 64]"]), ("a sky around the scene", "周囲の空"))
            }
            _ => return None,
        };
        let nth = self.taken.entry(lines[0].clone()).or_default();
        let mut lines: Vec<String> = lines.iter().map(|line| another(line, *nth)).collect();
        *nth += 1;
        if is_whole {
            let format = if sampler.texel == Scalar::Int { "rgba32i" } else { "rgba32ui" };
            lines.push(format!("format = {format:?} # whole numbers"));
        }
        Some(ProposedTexture { name: name(path), lines, what })
    }

    /// A picture.
    fn flat(&mut self, words: &NameWords) -> (Vec<String>, (&'static str, &'static str)) {
        if let Some((_, lines, what)) = GREY.iter().find(|(known, ..)| words.has(known) || words.is(known)) {
            return (owned(lines), *what);
        }
        let lines = COLOURFUL[self.colourful % COLOURFUL.len()];
        self.colourful += 1;
        (owned(lines), ("a picture of colours", "色の画像"))
    }
}

fn name(path: &str) -> String {
    let plain: String = path.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '-' }).collect();
    plain.replace("--", "-").trim_matches('-').to_owned()
}
