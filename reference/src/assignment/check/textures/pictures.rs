//! The pictures that a texture is made of: read from files, or computed.

use super::{FLOATS, LONGEST_SIDE, MOST_TEXELS, TextureReader, place};
use crate::assignment::check::CheckResult;
use crate::assignment::{AssignmentError, error};
use crate::interpreter::{Dimension, Level, Scalar, Texels, Texture};
use crate::manifest::{Format, PictureOrigin, TextureSize};
use crate::texture::{BrokenPicture, Generator, TexturePicture, read};

/// More layers or slices of a texture are refused.
const MOST_PICTURES: usize = 256;
/// Whole numbers up to this are floats without rounding, which lookups read.
const LARGEST_WHOLE: f64 = 16_777_216.0;

/// What the pictures of a texture are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum TextureShape {
    Line,
    Flat,
    Cube,
    Layers,
    Slices,
}

/// The pictures of a texture, one after the other.
pub(super) struct TexturePictures {
    pub shape: TextureShape,
    /// Width, height, and how many there are.
    size: [usize; 3],
    texels: Texels,
}

impl TexturePictures {
    /// The texture, read by the nearest texel.
    pub fn texture(self, texel: Scalar) -> Texture {
        let [width, height, _] = self.size;
        let (dimension, array) = match self.shape {
            TextureShape::Line => (Dimension::One, false),
            TextureShape::Flat => (Dimension::Two, false),
            TextureShape::Cube => (Dimension::Cube, false),
            TextureShape::Layers => (Dimension::Two, true),
            TextureShape::Slices => (Dimension::Three, false),
        };
        let levels = vec![Level { size: self.size, texels: self.texels }];
        Texture { dimension, array, texel, levels, ..Texture::two_dimensional(width, height, Vec::<[u8; 4]>::new()) }
    }
}

impl TextureReader<'_> {
    /// The picture of a file, or those of six.
    pub(super) fn files(&self, names: &[&str], room: usize) -> CheckResult<TexturePictures> {
        let entry = self.entry;
        if entry.size.is_some() || entry.format.is_some() && !self.is_whole() {
            return Err(self.wrong(
                "`size` belongs to `generate`, and a file has its own: remove it; `format` of a file is \"rgba32i\" or \"rgba32ui\"",
                "`size` は `generate` のためのものです。ファイルでは使わないので、取り除いてください。ファイルの `format` に書けるのは \"rgba32i\" と \"rgba32ui\" だけです",
            ));
        }
        // OpenGL takes the rows of a cube's faces from above.
        let flip = entry.flip.unwrap_or(names.len() == 1);
        let mut size = None;
        let mut texels = Vec::new();
        for name in names {
            let picture = self.picture(name, room / names.len() / self.room_of_texel())?;
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
        let shape = if names.len() > 1 { TextureShape::Cube } else { TextureShape::Flat };
        let texels = if self.is_whole() {
            Texels::Numbers(texels.into_iter().map(|texel| texel.map(f64::from)).collect())
        } else {
            self.bytes(texels)
        };
        Ok(TexturePictures { shape, size: [width, height, names.len()], texels })
    }

    /// Pictures of one size, from files or computed.
    pub(super) fn several(
        &self,
        pictures: &[PictureOrigin],
        shape: TextureShape,
        room: usize,
    ) -> CheckResult<TexturePictures> {
        if pictures.is_empty() || pictures.len() > MOST_PICTURES {
            return Err(self.wrong(
                format!("`layers` and `slices` are 1 to {MOST_PICTURES} pictures"),
                format!("`layers` と `slices` には 1 から {MOST_PICTURES} 枚の画像を書いてください"),
            ));
        }
        let is_file = |picture: &PictureOrigin| matches!(picture, PictureOrigin::File(_));
        if self.entry.flip.is_some() && !pictures.iter().any(is_file) {
            return Err(self.flip_of_none());
        }
        let each = room / pictures.len();
        let mut numbers = Vec::new();
        let mut size = None;
        for picture in pictures {
            let own = match picture {
                PictureOrigin::File(name) => {
                    let picture = self.picture(name, each / self.room_of_texel())?;
                    let picture = if self.entry.flip.unwrap_or(true) { picture.flipped() } else { picture };
                    let number = |byte| if self.is_whole() { f64::from(byte) } else { f64::from(byte) / 255.0 };
                    let texels = picture.texels.into_iter().map(|texel| texel.map(number)).collect();
                    TexturePicture { width: picture.width, height: picture.height, texels }
                }
                PictureOrigin::Generated(generator) if generator.is_cube() => {
                    return Err(self.wrong(
                        "a sky is a cube, and no picture among others: write it as `generate`",
                        "`sky` はキューブマップなので、`layers` や `slices` には使えません。`generate` に書いてください",
                    ));
                }
                PictureOrigin::Generated(generator) => {
                    self.computed(generator, self.small(self.flat_size()?, 1, each)?)?.remove(0)
                }
            };
            let [width, height] = *size.get_or_insert([own.width, own.height]);
            if [own.width, own.height] != [width, height] {
                let [other, high] = [own.width, own.height];
                return Err(self.wrong(
                    format!("has pictures of {width} × {height} and of {other} × {high} pixels: make all of one size"),
                    format!(
                        "{width} × {height} 画素と {other} × {high} 画素の画像があります。すべて同じ大きさにしてください"
                    ),
                ));
            }
            numbers.extend(own.texels);
        }
        let [width, height] = size.unwrap_or_default();
        Ok(TexturePictures { shape, size: [width, height, pictures.len()], texels: self.kept(numbers)? })
    }

    /// Width and height of what is no line.
    pub(super) fn flat_size(&self) -> CheckResult<[usize; 2]> {
        match self.entry.size.unwrap_or_default() {
            TextureSize::Line(_) => Err(self.wrong(
                "`size` is width and height in texels, such as [64, 64]; one number is for `generate` alone",
                "`size` は幅と高さ ([64, 64] など) です。数を 1 つだけ書けるのは `generate` のときだけです",
            )),
            size => Ok(size.sides().map(|side| side as usize)),
        }
    }

    fn flip_of_none(&self) -> AssignmentError {
        self.wrong("`flip` belongs to files: remove it", "`flip` はファイルのためのものです。取り除いてください")
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

    pub(super) fn generated(&self, generator: &Generator, room: usize) -> CheckResult<TexturePictures> {
        let entry = self.entry;
        if entry.flip.is_some() {
            return Err(self.flip_of_none());
        }
        let said = entry.size.unwrap_or_default();
        let (shape, size) = match said {
            _ if generator.is_cube() => (TextureShape::Cube, self.flat_size()?),
            TextureSize::Line(_) => (TextureShape::Line, said.sides().map(|side| side as usize)),
            TextureSize::Flat(_) => (TextureShape::Flat, said.sides().map(|side| side as usize)),
        };
        if shape == TextureShape::Cube && size[0] != size[1] {
            return Err(self.wrong(
                "`size` is width and height in texels: the faces of a sky are squares",
                "`size` は幅と高さです。`sky` の面は正方形です",
            ));
        }
        let faces = if shape == TextureShape::Cube { 6 } else { 1 };
        let pictures = self.computed(generator, self.small(size, faces, room)?)?;
        let numbers = pictures.into_iter().flat_map(|picture| picture.texels).collect();
        Ok(TexturePictures { shape, size: [size[0], size[1], faces], texels: self.kept(numbers)? })
    }

    /// So many texels of four bytes a texel counts as.
    fn room_of_texel(&self) -> usize {
        if self.format() == Format::Rgba8 { 1 } else { FLOATS }
    }

    /// The size, where so many pictures of it fit.
    fn small(&self, size: [usize; 2], pictures: usize, room: usize) -> CheckResult<[usize; 2]> {
        if size.contains(&0) {
            return Err(self.wrong(
                "`size` is width and height in texels, each at least 1",
                "`size` は幅と高さです。どちらも 1 以上にしてください",
            ));
        }
        let each = pictures * self.room_of_texel();
        let is_small = size[0].max(size[1]) <= LONGEST_SIDE && size[0] * size[1] <= room / each;
        if is_small { Ok(size) } else { Err(self.too_large(None, size)) }
    }

    fn computed(&self, generator: &Generator, size: [usize; 2]) -> CheckResult<Vec<TexturePicture<f64>>> {
        generator.pictures(size).map_err(|message| error(place(self.entry, self.place_at), message))
    }

    /// Colours as the format keeps them.
    fn kept(&self, numbers: Vec<[f64; 4]>) -> CheckResult<Texels> {
        let format = self.format();
        let each = |kept: &dyn Fn(f64) -> f64| Texels::Numbers(numbers.iter().map(|texel| texel.map(kept)).collect());
        let least = if format == Format::Rgba32i { -LARGEST_WHOLE } else { 0.0 };
        match format {
            Format::Rgba8 if numbers.iter().flatten().all(|number| (0.0..=1.0).contains(number)) => Ok(self
                .bytes(numbers.into_iter().map(|texel| texel.map(|number| (number * 255.0).round() as u8)).collect())),
            Format::Rgba8 => Err(self.beyond("generate")),
            _ if !self.is_whole() => Ok(each(&|number| f64::from(number as f32))),
            _ if numbers.iter().flatten().all(|number| (least..=LARGEST_WHOLE).contains(&number.round())) => {
                Ok(each(&f64::round))
            }
            _ => Err(self.wrong(
                format!("whole numbers of a texture are {least} to {LARGEST_WHOLE}"),
                format!("テクスチャの整数は {least} から {LARGEST_WHOLE} までにしてください"),
            )),
        }
    }

    /// Bytes hold 0 to 1.
    pub(super) fn beyond(&self, key: &str) -> AssignmentError {
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
