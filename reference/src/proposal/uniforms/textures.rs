//! Pictures for samplers.

use crate::proposal::names::NameWords;

/// An entry `[[texture]]`.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::proposal) struct TextureEntry {
    pub name: String,
    /// `key = value`, one line each.
    pub lines: Vec<String>,
    pub what: (&'static str, &'static str),
}

/// The textures so far: no two have one name.
#[derive(Default)]
pub(super) struct ProposedTextures {
    names: Vec<String>,
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

impl ProposedTextures {
    /// A texture for the sampler at a path.
    pub fn of(&mut self, path: &str, is_cube: bool) -> TextureEntry {
        let name = self.name(path);
        let own = |lines: &[&str], what| {
            let lines = lines.iter().map(|line| (*line).to_owned()).collect();
            TextureEntry { name: name.clone(), lines, what }
        };
        if is_cube {
            return own(&["generate = { sky = {} }", "size = [64, 64]"], ("a sky around the scene", "周囲の空"));
        }
        let words = NameWords::of(path);
        if let Some((_, lines, what)) = GREY.iter().find(|(known, ..)| words.has(known) || words.is(known)) {
            return own(lines, *what);
        }
        let lines = COLOURFUL[self.colourful % COLOURFUL.len()];
        self.colourful += 1;
        own(lines, ("a picture of colours", "色の画像"))
    }

    fn name(&mut self, path: &str) -> String {
        let plain: String = path.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '-' }).collect();
        let plain = plain.replace("--", "-").trim_matches('-').to_owned();
        self.names.push(plain.clone());
        plain
    }
}
