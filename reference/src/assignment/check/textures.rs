//! The textures of an assignment.

use super::{CheckResult, passes};
use crate::Folder;
use crate::assignment::{AssignmentError, both, error};
use crate::interpreter::{Compare, Depths, Filter, Texels, Texture, Wrap};
use crate::manifest::{self, Format};
use crate::texture::{BrokenPicture, Generator, TexturePicture, read};

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
    entries: &[manifest::Texture],
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
pub(super) fn place(entry: &manifest::Texture, place_at: &dyn Fn(usize) -> String) -> String {
    let line = place_at(entry.name.span().start);
    format!("{line}, texture `{}`", entry.name.get_ref())
}

struct TextureReader<'a> {
    entry: &'a manifest::Texture,
    folder: &'a Folder,
    place_at: &'a dyn Fn(usize) -> String,
}

/// The pictures of a texture, one after the other.
struct TexturePictures {
    /// One, or six.
    faces: usize,
    width: usize,
    height: usize,
    texels: Texels,
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
        let TexturePictures { faces, width, height, texels } = match (&entry.file, &entry.cube, &entry.generate) {
            (Some(file), None, None) => self.files(&[file], room)?,
            (None, Some(files), None) => self.files(&files.each_ref().map(String::as_str), room)?,
            (None, None, Some(generator)) => self.generated(generator, room)?,
            _ => {
                return Err(self.wrong(
                    "write one of `file`, `cube` and `generate`",
                    "`file`、`cube`、`generate` のうち 1 つだけを書いてください",
                ));
            }
        };
        let is_cube = faces > 1;
        let bare = if is_cube { Texture::cube(width, texels) } else { Texture::two_dimensional(width, height, texels) };
        let filter = entry.filter.unwrap_or(Filter::Linear);
        let wrap = self.wrap(is_cube)?;
        Ok(Texture { magnify: filter, minify: filter, wrap, border: self.border(wrap)?, ..bare })
    }

    /// Depths that a pass draws, as probes read them.
    fn depths(&self, pictures: usize) -> CheckResult<Texture> {
        let entry = self.entry;
        let is_picture = entry.file.is_some() || entry.cube.is_some() || entry.generate.is_some();
        if is_picture || entry.flip.is_some() || entry.srgb {
            return Err(self.wrong(
                "depths are drawn by a [[pass]]: remove `file`, `cube`, `generate`, `flip` and `srgb`",
                "深度は [[pass]] が描きます。`file`、`cube`、`generate`、`flip`、`srgb` を取り除いてください",
            ));
        }
        let [width, height] = entry.size.unwrap_or([256; 2]).map(|side| side as usize);
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

    /// The picture of a file, or those of six.
    fn files(&self, names: &[&str], room: usize) -> CheckResult<TexturePictures> {
        let entry = self.entry;
        if entry.size.is_some() || entry.format.is_some() {
            return Err(self.wrong(
                "`size` and `format` belong to `generate`, and a file has its own: remove them",
                "`size` と `format` は `generate` のためのものです。ファイルでは使わないので、取り除いてください",
            ));
        }
        // OpenGL takes the rows of a cube's faces from above.
        let flip = entry.flip.unwrap_or(names.len() == 1);
        let mut size = None;
        let mut texels = Vec::new();
        for name in names {
            let picture = self.picture(name, room / names.len())?;
            let own = (picture.width, picture.height);
            if names.len() > 1 && (own.0 != own.1 || size.is_some_and(|first| first != own)) {
                let (width, height) = own;
                return Err(self.in_file(
                    name,
                    format!("has {width} × {height} pixels: the six faces of a cube are squares of one size"),
                    format!(
                        "{width} × {height} 画素です。キューブマップの 6 面は、すべて同じ大きさの正方形にしてください"
                    ),
                ));
            }
            size = Some(own);
            texels.extend(if flip { picture.flipped().texels } else { picture.texels });
        }
        let (width, height) = size.unwrap_or_default();
        Ok(TexturePictures { faces: names.len(), width, height, texels: self.bytes(texels) })
    }

    fn bytes(&self, texels: Vec<[u8; 4]>) -> Texels {
        if self.entry.srgb { Texels::Srgb(texels) } else { Texels::Bytes(texels) }
    }

    /// The picture of a file, the first row first.
    fn picture(&self, name: &str, room: usize) -> CheckResult<TexturePicture<u8>> {
        let bytes = self.folder.bytes(name);
        let bytes = bytes.map_err(|missing| AssignmentError { entry: Some(self.name()), ..missing })?;
        let picture = read(bytes, room).map_err(|broken| match broken {
            BrokenPicture::TooLarge(width, height) => self.too_large(Some(name), [width as usize, height as usize]),
            BrokenPicture::Not(what) => self.in_file(
                name,
                format!("is {what}: save it as PNG"),
                format!("PNG ではありません ({what})。PNG として保存してください"),
            ),
            BrokenPicture::Damaged(what) => self.in_file(
                name,
                format!("is no PNG, or damaged ({what}): open it in a picture editor, and save it as PNG again"),
                format!("PNG ではないか、壊れています ({what})。画像ソフトで開き、PNG として保存し直してください"),
            ),
        })?;
        let is_too_long = picture.width.max(picture.height) > LONGEST_SIDE;
        if is_too_long { Err(self.too_large(Some(name), [picture.width, picture.height])) } else { Ok(picture) }
    }

    fn generated(&self, generator: &Generator, room: usize) -> CheckResult<TexturePictures> {
        let entry = self.entry;
        if entry.flip.is_some() {
            return Err(self
                .wrong("`flip` belongs to files: remove it", "`flip` はファイルのためのものです。取り除いてください"));
        }
        let is_float = self.format() == Format::Rgba32f;
        if is_float && entry.srgb {
            return Err(self.wrong(
                "`srgb` decodes bytes: remove it, or write `format = \"rgba8\"`",
                "`srgb` は 8 ビットの値を変換します。取り除くか、`format = \"rgba8\"` と書いてください",
            ));
        }
        let faces = if generator.is_cube() { 6 } else { 1 };
        let size = entry.size.unwrap_or([256; 2]).map(|side| side as usize);
        if size.contains(&0) || faces > 1 && size[0] != size[1] {
            return Err(self.wrong(
                "`size` is width and height in texels, each at least 1; the faces of a sky are squares",
                "`size` は幅と高さです。どちらも 1 以上にしてください。`sky` の面は正方形です",
            ));
        }
        let each = faces * if is_float { FLOATS } else { 1 };
        let is_small = size[0].max(size[1]) <= LONGEST_SIDE && size[0] * size[1] <= room / each;
        if !is_small {
            return Err(self.too_large(None, size));
        }
        let pictures = generator.pictures(size).map_err(|message| error(place(entry, self.place_at), message))?;
        let numbers: Vec<[f64; 4]> = pictures.into_iter().flat_map(|picture| picture.texels).collect();
        let texels = if is_float {
            Texels::Numbers(numbers.into_iter().map(|texel| texel.map(|number| f64::from(number as f32))).collect())
        } else {
            if !numbers.iter().flatten().all(|number| (0.0..=1.0).contains(number)) {
                return Err(self.beyond("generate"));
            }
            self.bytes(numbers.into_iter().map(|texel| texel.map(|number| (number * 255.0).round() as u8)).collect())
        };
        Ok(TexturePictures { faces, width: size[0], height: size[1], texels })
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
        if self.format() == Format::Rgba8 && !border.0.iter().all(|number| (0.0..=1.0).contains(number)) {
            return Err(self.beyond("border"));
        }
        Ok(border.0.map(|number| f64::from(number as f32)))
    }

    fn format(&self) -> Format {
        self.entry.format.unwrap_or_default()
    }

    /// Bytes hold 0 to 1.
    fn beyond(&self, key: &str) -> AssignmentError {
        self.wrong(
            format!("`{key}` has a colour beyond 0 to 1: keep to that, or write `format = \"rgba32f\"` with `generate`"),
            format!(
                "`{key}` に 0 から 1 の範囲を超える色があります。範囲に収めるか、`generate` に `format = \"rgba32f\"` を添えてください"
            ),
        )
    }

    fn too_large(&self, file: Option<&str>, [width, height]: [usize; 2]) -> AssignmentError {
        let en = format!(
            "{width} × {height} pixels are too many: a side has at most {LONGEST_SIDE}, and all textures have at most \
             {MOST_TEXELS}, of which a float texel counts as {FLOATS}. Make it smaller"
        );
        let ja = format!(
            "{width} × {height} 画素は大きすぎます。一辺は {LONGEST_SIDE} 画素以下、全テクスチャの合計は {MOST_TEXELS} 画素以下です \
             (float の画素は {FLOATS} 画素と数えます)。小さくしてください"
        );
        match file {
            Some(file) => self.in_file(file, en, ja),
            None => self.wrong(en, ja),
        }
    }
}
