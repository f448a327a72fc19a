//! Fragment shaders: each pixel of a small window, as floats.
#![allow(unsafe_code, reason = "OpenGL is a C library")]

use super::driver::Recorder;
use super::{Matrix, Rejection};
use glow::HasContext;

/// A texture of four floats a texel, without levels.
#[derive(Clone, Debug)]
pub struct Texels {
    pub width: usize,
    pub height: usize,
    /// Rows from below.
    pub texels: Vec<[f32; 4]>,
    /// Whether the texels around a place are weighted by distance.
    pub is_linear: bool,
    /// Beyond its edges: repeated, or clamped.
    pub repeats: bool,
}

/// What a fragment shader is given by name.
#[derive(Clone, Copy, Debug)]
pub struct Given<'a> {
    pub matrices: &'a [(&'a str, Matrix)],
    pub textures: &'a [(&'a str, Texels)],
}

/// A triangle that covers the window.
const VERTEX: &str = "#version 410\nvoid main() {\n  \
                      gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);\n}\n";

impl Recorder {
    /// What the shader's only output is for each pixel of a square window, rows from below; `untouched` where it is
    /// thrown away.
    pub fn shade(
        &self,
        fragment: &str,
        given: Given<'_>,
        side: usize,
        untouched: [f32; 4],
    ) -> Result<Vec<[f32; 4]>, Rejection> {
        let program = self.link(VERTEX, fragment, &[])?;
        let gl = self.gl();
        self.set_uniforms(program, given.matrices);
        let mut pixels = vec![[0.0_f32; 4]; side * side];
        // SAFETY: see `src/ffi/opengl.rs`. Each picture has the size that is told with it, and the slice that is
        // read into has 16 bytes for each pixel.
        unsafe {
            let target = self.texture(&Texels {
                width: side,
                height: side,
                texels: pixels.clone(),
                is_linear: false,
                repeats: false,
            });
            let framebuffer = gl.create_framebuffer().expect("a framebuffer");
            gl.bind_framebuffer(glow::FRAMEBUFFER, Some(framebuffer));
            gl.framebuffer_texture_2d(glow::FRAMEBUFFER, glow::COLOR_ATTACHMENT0, glow::TEXTURE_2D, Some(target), 0);
            assert_eq!(gl.check_framebuffer_status(glow::FRAMEBUFFER), glow::FRAMEBUFFER_COMPLETE);
            gl.use_program(Some(program.name()));
            let mut textures = Vec::new();
            for (unit, (name, texels)) in (0..).zip(given.textures) {
                gl.active_texture(glow::TEXTURE0 + unit);
                textures.push(self.texture(texels));
                gl.uniform_1_i32(gl.get_uniform_location(program.name(), name).as_ref(), unit.cast_signed());
            }
            let array = gl.create_vertex_array().expect("a vertex array");
            gl.bind_vertex_array(Some(array));
            let side = i32::try_from(side).expect("a size that OpenGL can count");
            gl.viewport(0, 0, side, side);
            gl.clear_color(untouched[0], untouched[1], untouched[2], untouched[3]);
            gl.clear(glow::COLOR_BUFFER_BIT);
            gl.draw_arrays(glow::TRIANGLES, 0, 3);
            let into = glow::PixelPackData::Slice(Some(bytemuck::cast_slice_mut(&mut pixels)));
            gl.read_pixels(0, 0, side, side, glow::RGBA, glow::FLOAT, into);
            self.check("shade");
            gl.active_texture(glow::TEXTURE0);
            gl.delete_vertex_array(array);
            gl.delete_framebuffer(framebuffer);
            textures.into_iter().chain([target]).for_each(|texture| gl.delete_texture(texture));
        }
        self.delete(program);
        Ok(pixels)
    }

    /// A texture, bound to the unit that is active.
    fn texture(&self, from: &Texels) -> glow::Texture {
        let gl = self.gl();
        let [width, height] = [from.width, from.height].map(|side| i32::try_from(side).expect("a side"));
        assert_eq!(from.texels.len(), from.width * from.height, "a texel for each place");
        let filter = if from.is_linear { glow::LINEAR } else { glow::NEAREST };
        let wrap = if from.repeats { glow::REPEAT } else { glow::CLAMP_TO_EDGE };
        // SAFETY: see `src/ffi/opengl.rs`. The slice holds 16 bytes for each texel of the size that is told.
        unsafe {
            let texture = gl.create_texture().expect("a texture");
            gl.bind_texture(glow::TEXTURE_2D, Some(texture));
            let texels = glow::PixelUnpackData::Slice(Some(bytemuck::cast_slice(&from.texels)));
            let format = glow::RGBA32F.cast_signed();
            gl.tex_image_2d(glow::TEXTURE_2D, 0, format, width, height, 0, glow::RGBA, glow::FLOAT, texels);
            let parameters = [
                (glow::TEXTURE_MIN_FILTER, filter),
                (glow::TEXTURE_MAG_FILTER, filter),
                (glow::TEXTURE_WRAP_S, wrap),
                (glow::TEXTURE_WRAP_T, wrap),
            ];
            for (name, value) in parameters {
                gl.tex_parameter_i32(glow::TEXTURE_2D, name, value.cast_signed());
            }
            texture
        }
    }
}
