//! The textures of an assignment.

mod pictures;

use super::{CheckResult, passes};
use crate::Folder;
use crate::assignment::{AssignmentError, error};
use crate::interpreter::{Compare, Depths, Filter, Scalar, Texels, Texture, Wrap};
use crate::manifest::{self, Format};
use crate::text::both;
use pictures::TextureShape;

/// More textures than this are refused: OpenGL promises room for so many in a stage.
const MOST_TEXTURES: usize = 16;
/// The longest side of a picture.
const LONGEST_SIDE: usize = 8_192;
/// More texels in all textures than this are refused: four pictures of 1024 × 1024 pixels. Each worker holds them, and they
/// fit into one buffer of the GPU.
const MOST_TEXELS: usize = 1 << 22;
/// More texels of depths than this, in the maps of all pictures, are refused: 64 MiB, which each worker holds twice.
const MOST_DEPTHS: usize = 1 << 24;
/// The mean of moments is taken over at most so many texels to each side.
const MOST_BLUR: u32 = 16;
/// A texel of four floats counts as so many of four bytes.
const FLOATS: usize = 4;

/// The textures, in the order of the manifest. Depths that a pass draws are those of probes there; those of so many `pictures` stand
/// behind all others. `place_at`: where a byte of the manifest stands.
pub(super) fn textures(
    entries: &[manifest::TextureEntry],
    pictures: usize,
    folder: &Folder,
    place_at: &dyn Fn(usize) -> String,
) -> CheckResult<Vec<Texture>> {
    if entries.len() > MOST_TEXTURES {
        let count = entries.len();
        return Err(error(
            "texture",
            both(
                format!("there are {count}: use at most {MOST_TEXTURES}"),
                format!("{count} 個あります。{MOST_TEXTURES} 個以下にしてください"),
            ),
        ));
    }
    let mut room = MOST_TEXELS;
    let mut all = Vec::new();
    for (number, entry) in entries.iter().enumerate() {
        let reader = TextureReader { entry, folder, place_at };
        if entries[..number].iter().any(|other| other.name.get_ref() == entry.name.get_ref()) {
            return Err(
                reader.wrong("stands twice: give one another name", "2 回書かれています。一方の名前を変えてください")
            );
        }
        if reader.format().is_depth() {
            let map = reader.depths(pictures)?;
            all.push(map);
            continue;
        }
        let texture = reader.texture(room)?;
        let texels = &texture.levels[0].texels;
        let is_float = matches!(texels, Texels::Numbers(_));
        room -= texels.count() * if is_float { FLOATS } else { 1 };
        all.push(texture);
    }
    let maps: Vec<&Texture> =
        all.iter().filter(|texture| matches!(texture.levels[0].texels, Texels::Depths(_))).collect();
    if let [map] = maps[..] {
        let mut map = map.clone();
        let Texels::Depths(known) = &map.levels[0].texels else { return Ok(all) };
        let (count, each) = (known.count(), known.each());
        for _ in 0..pictures {
            map.levels[0].texels = Texels::Depths(Depths::later(count, each));
            all.push(map.clone());
        }
    }
    Ok(all)
}

/// The entry of a texture.
pub(super) fn place(entry: &manifest::TextureEntry, place_at: &dyn Fn(usize) -> String) -> String {
    let line = place_at(entry.name.span().start);
    format!("{line}, texture `{}`", entry.name.get_ref())
}

struct TextureReader<'a> {
    entry: &'a manifest::TextureEntry,
    folder: &'a Folder,
    place_at: &'a dyn Fn(usize) -> String,
}

impl TextureReader<'_> {
    fn wrong(&self, en: impl Into<String>, ja: impl Into<String>) -> AssignmentError {
        error(place(self.entry, self.place_at), both(en, ja))
    }

    fn in_file(&self, file: &str, en: impl Into<String>, ja: impl Into<String>) -> AssignmentError {
        AssignmentError { entry: Some(self.name()), ..AssignmentError::of_file(file, both(en, ja)) }
    }

    fn name(&self) -> String {
        format!("texture `{}`", self.entry.name.get_ref())
    }

    /// The texture, of at most so many texels.
    fn texture(&self, room: usize) -> CheckResult<Texture> {
        let entry = self.entry;
        if entry.compare.is_some() {
            return Err(self.wrong(
                "`compare` belongs to depths: remove it, or write `format = \"depth24\"`",
                "`compare` は深度のためのものです。取り除くか、`format = \"depth24\"` と書いてください",
            ));
        }
        if self.format() != Format::Rgba8 && entry.srgb {
            return Err(self.wrong(
                "`srgb` decodes bytes: remove it, or write `format = \"rgba8\"`",
                "`srgb` は 8 ビットの値を変換します。取り除くか、`format = \"rgba8\"` と書いてください",
            ));
        }
        let pictures = match (&entry.file, &entry.cube, &entry.generate, &entry.layers, &entry.slices) {
            (Some(file), None, None, None, None) => self.files(&[file], room)?,
            (None, Some(files), None, None, None) => self.files(&files.each_ref().map(String::as_str), room)?,
            (None, None, Some(generator), None, None) => self.generated(generator, room)?,
            (None, None, None, Some(layers), None) => self.several(layers, TextureShape::Layers, room)?,
            (None, None, None, None, Some(slices)) => self.several(slices, TextureShape::Slices, room)?,
            _ => {
                return Err(self.wrong(
                    "write one of `file`, `cube`, `generate`, `layers` and `slices`",
                    "`file`、`cube`、`generate`、`layers`、`slices` のうち 1 つだけを書いてください",
                ));
            }
        };
        let filter = self.filter()?;
        let wrap = self.wrap(pictures.shape == TextureShape::Cube)?;
        let bare = pictures.texture(self.format().texel());
        Ok(Texture { magnify: filter, minify: filter, wrap, border: self.border(wrap)?, ..bare })
    }

    fn filter(&self) -> CheckResult<Filter> {
        let is_whole = self.is_whole();
        match self.entry.filter {
            Some(Filter::Linear) if is_whole => Err(self.wrong(
                "whole numbers are not mixed: write `filter = \"nearest\"`, or nothing",
                "整数のテクセルは補間できません。`filter = \"nearest\"` と書くか、取り除いてください",
            )),
            said => Ok(said.unwrap_or(if is_whole { Filter::Nearest } else { Filter::Linear })),
        }
    }

    /// Whether its texels are whole numbers.
    fn is_whole(&self) -> bool {
        self.format().texel() != Scalar::Float
    }

    /// Depths that a pass draws, as probes read them.
    fn depths(&self, pictures: usize) -> CheckResult<Texture> {
        let entry = self.entry;
        let is_picture = entry.file.is_some() || entry.cube.is_some() || entry.generate.is_some();
        let is_picture = is_picture || entry.layers.is_some() || entry.slices.is_some();
        if is_picture || entry.flip.is_some() || entry.srgb {
            return Err(self.wrong(
                "depths are drawn by a [[pass]]: remove `file`, `cube`, `generate`, `layers`, `slices`, `flip` and `srgb`",
                "深度は [[pass]] が描きます。`file`、`cube`、`generate`、`layers`、`slices`、`flip`、`srgb` を取り除いてください",
            ));
        }
        let [width, height] = self.flat_size()?;
        let is_small = width.max(height) <= LONGEST_SIDE && width * height * (pictures + 1) <= MOST_DEPTHS;
        if width * height == 0 || !is_small {
            return Err(self.wrong(
                format!(
                    "{width} × {height} texels for each of {pictures} pictures are too many, or none: a side has 1 to {LONGEST_SIDE}, and all \
                     maps together have at most {MOST_DEPTHS}"
                ),
                format!(
                    "{pictures} 枚の画像それぞれに {width} × {height} 画素は大きすぎるか、0 です。一辺は 1 から {LONGEST_SIDE}、\
                     全部の合計は {MOST_DEPTHS} 画素以下にしてください"
                ),
            ));
        }
        let wrap = self.wrap(false)?;
        let filter = entry.filter.unwrap_or(Filter::Nearest);
        let is_moments = self.format() == Format::Moments;
        if entry.blur.is_some_and(|blur| !is_moments || blur > MOST_BLUR) {
            return Err(self.wrong(
                format!("`blur` is a number up to {MOST_BLUR}, and belongs to `format = \"moments\"`"),
                format!("`blur` は {MOST_BLUR} までの数で、`format = \"moments\"` のときだけ使います"),
            ));
        }
        if is_moments && entry.compare.is_some() {
            return Err(self.wrong(
                "moments are not compared: remove `compare`",
                "moments は比較には使えません。`compare` を取り除いてください",
            ));
        }
        let depths = passes::depths_of_probes([width, height]);
        let texels = Texels::Depths(match is_moments {
            true => Depths::known(passes::moments_of_probes(&depths), 2),
            false => Depths::known(depths, 1),
        });
        Ok(Texture {
            magnify: filter,
            minify: filter,
            wrap,
            border: self.border(wrap)?,
            compare: (!is_moments).then(|| entry.compare.unwrap_or(Compare::LessOrEqual)),
            clamps_reference: self.format() == Format::Depth24,
            ..Texture::two_dimensional(width, height, texels)
        })
    }

    fn wrap(&self, is_cube: bool) -> CheckResult<[Wrap; 3]> {
        let said = self.entry.wrap.map(manifest::Wraps::each);
        if is_cube && said.is_some_and(|wrap| wrap != [Wrap::ClampToEdge; 3]) {
            return Err(self.wrong(
                "a cube ends at the edges of its faces: write `wrap = \"clamp-to-edge\"`, or nothing",
                "キューブマップの `wrap` は \"clamp-to-edge\" だけです。そう書くか、取り除いてください",
            ));
        }
        Ok(said.unwrap_or(if is_cube { [Wrap::ClampToEdge; 3] } else { [Wrap::Repeat; 3] }))
    }

    fn border(&self, wrap: [Wrap; 3]) -> CheckResult<[f64; 4]> {
        let Some(border) = self.entry.border else { return Ok([0.0; 4]) };
        if !wrap.contains(&Wrap::ClampToBorder) {
            return Err(self.wrong(
                "`border` is seen with `wrap = \"clamp-to-border\"` only: write that too, or remove it",
                "`border` が見えるのは `wrap = \"clamp-to-border\"` のときだけです。それも書くか、取り除いてください",
            ));
        }
        if self.is_whole() {
            return Err(self.wrong(
                "whole numbers have no border: write another `wrap`",
                "整数のテクスチャに `border` はありません。別の `wrap` を書いてください",
            ));
        }
        if self.format() == Format::Rgba8 && !border.0.iter().all(|number| (0.0..=1.0).contains(number)) {
            return Err(self.beyond("border"));
        }
        Ok(border.0.map(|number| f64::from(number as f32)))
    }

    fn format(&self) -> Format {
        self.entry.format.unwrap_or_default()
    }
}
