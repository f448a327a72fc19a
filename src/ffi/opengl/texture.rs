//! The textures of a homework, set up as a host program does.

use super::Driver;
use glow::HasContext;
use reference::interpreter::{Compare, Dimension, Filter, Scalar, Texels as Kept, Texture, Wrap};

impl Driver {
    /// A texture, bound to the unit that is active.
    pub(super) fn upload(&self, texture: &Texture) -> glow::Texture {
        let gl = self.gl();
        let level = &texture.levels[0];
        let [width, height, depth] = level.size.map(|side| i32::try_from(side).expect("a side"));
        let target = match (texture.dimension, texture.array) {
            (Dimension::One, _) => glow::TEXTURE_1D,
            (Dimension::Three, _) => glow::TEXTURE_3D,
            (Dimension::Cube, _) => glow::TEXTURE_CUBE_MAP,
            (_, true) => glow::TEXTURE_2D_ARRAY,
            (_, false) => glow::TEXTURE_2D,
        };
        let floats: Vec<[f32; 4]>;
        let whole: Vec<[i32; 4]>;
        let (format, kind, texels): (_, _, &[u8]) = match &level.texels {
            Kept::Bytes(texels) => (glow::RGBA8, glow::UNSIGNED_BYTE, texels.as_flattened()),
            Kept::Srgb(texels) => (glow::SRGB8_ALPHA8, glow::UNSIGNED_BYTE, texels.as_flattened()),
            Kept::Numbers(texels) if texture.texel != Scalar::Float => {
                whole = texels.iter().map(|texel| texel.map(|number| number as i32)).collect();
                let (format, kind) = match texture.texel {
                    Scalar::Uint => (glow::RGBA32UI, glow::UNSIGNED_INT),
                    _ => (glow::RGBA32I, glow::INT),
                };
                (format, kind, bytemuck::cast_slice(&whole))
            }
            Kept::Numbers(texels) => {
                floats = texels.iter().map(|texel| texel.map(|number| number as f32)).collect();
                (glow::RGBA32F, glow::FLOAT, bytemuck::cast_slice(&floats))
            }
            // The same depths, bit for bit: those of fixed point are clamped by who reads them here, and that is where they lie.
            Kept::Depths(depths) => {
                let format = if depths.each() == 1 { glow::DEPTH_COMPONENT32F } else { glow::RG32F };
                (format, glow::FLOAT, bytemuck::cast_slice(depths.drawn()))
            }
        };
        let channels = match format {
            glow::DEPTH_COMPONENT32F => glow::DEPTH_COMPONENT,
            glow::RG32F => glow::RG,
            glow::RGBA32I | glow::RGBA32UI => glow::RGBA_INTEGER,
            _ => glow::RGBA,
        };
        let faces = if target == glow::TEXTURE_CUBE_MAP { 6 } else { 1 };
        assert_eq!(texels.len() % faces, 0);
        let wrap = |wrap: Wrap| match wrap {
            Wrap::Repeat => glow::REPEAT,
            Wrap::MirroredRepeat => glow::MIRRORED_REPEAT,
            Wrap::ClampToEdge => glow::CLAMP_TO_EDGE,
            Wrap::ClampToBorder => glow::CLAMP_TO_BORDER,
        };
        let filter = if texture.magnify == Filter::Linear { glow::LINEAR } else { glow::NEAREST };
        // SAFETY: see the head of `opengl.rs`. Each slice holds the texels of a face.
        unsafe {
            let name = gl.create_texture().expect("a texture");
            gl.bind_texture(target, Some(name));
            for (face, texels) in (0..).zip(texels.chunks_exact(texels.len() / faces)) {
                let texels = glow::PixelUnpackData::Slice(Some(texels));
                let kept = format.cast_signed();
                match target {
                    glow::TEXTURE_1D => gl.tex_image_1d(target, 0, kept, width, 0, channels, kind, texels),
                    glow::TEXTURE_3D | glow::TEXTURE_2D_ARRAY => {
                        gl.tex_image_3d(target, 0, kept, width, height, depth, 0, channels, kind, texels);
                    }
                    glow::TEXTURE_CUBE_MAP => {
                        let face = glow::TEXTURE_CUBE_MAP_POSITIVE_X + face;
                        gl.tex_image_2d(face, 0, kept, width, height, 0, channels, kind, texels);
                    }
                    _ => gl.tex_image_2d(target, 0, kept, width, height, 0, channels, kind, texels),
                }
            }
            if let Some(compare) = texture.compare {
                let mode = glow::COMPARE_REF_TO_TEXTURE.cast_signed();
                gl.tex_parameter_i32(target, glow::TEXTURE_COMPARE_MODE, mode);
                gl.tex_parameter_i32(target, glow::TEXTURE_COMPARE_FUNC, function(compare).cast_signed());
            }
            let [s, t, r] = texture.wrap.map(wrap);
            let parameters = [
                (glow::TEXTURE_MIN_FILTER, filter),
                (glow::TEXTURE_MAG_FILTER, filter),
                (glow::TEXTURE_WRAP_S, s),
                (glow::TEXTURE_WRAP_T, t),
                (glow::TEXTURE_WRAP_R, r),
            ];
            for (name, value) in parameters {
                gl.tex_parameter_i32(target, name, value.cast_signed());
            }
            gl.tex_parameter_f32_slice(target, glow::TEXTURE_BORDER_COLOR, &texture.border.map(|number| number as f32));
            self.check("set up a texture");
            name
        }
    }
}

fn function(compare: Compare) -> u32 {
    match compare {
        Compare::Never => glow::NEVER,
        Compare::Less => glow::LESS,
        Compare::Equal => glow::EQUAL,
        Compare::LessOrEqual => glow::LEQUAL,
        Compare::Greater => glow::GREATER,
        Compare::NotEqual => glow::NOTEQUAL,
        Compare::GreaterOrEqual => glow::GEQUAL,
        Compare::Always => glow::ALWAYS,
    }
}
