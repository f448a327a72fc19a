//! Whole draws: meshes with attributes and uniforms of any type, depth test and culling, several outputs.

mod uniforms;

use super::{Driver, LinkedProgram, Rejection};
use glow::HasContext;
use reference::interpreter::Texture;
use reference::scene::{Cull, DepthTest};

/// A scalar, vector or matrix: what its components are, and how many there are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ValueKind {
    /// Floats.
    Float(u8),
    /// Signed integers.
    Int(u8),
    /// Unsigned integers.
    Uint(u8),
    /// Truth values.
    Bool(u8),
    /// Columns and rows.
    Matrix(u8, u8),
}

/// A uniform by path, column after column.
pub type UniformValue = (String, ValueKind, Vec<f64>);

/// One draw.
#[derive(Clone, Debug, Default)]
pub struct OpenglDraw {
    /// What its uniforms are.
    pub uniforms: Vec<UniformValue>,
    /// By name: the type, and number after number.
    pub attributes: Vec<(String, ValueKind, Vec<f64>)>,
    /// The vertices of each triangle; without any, three consecutive vertices are one.
    pub triangles: Vec<[u32; 3]>,
    /// Which pixels are drawn over others; all without it.
    pub depth_test: Option<DepthTest>,
    /// Which triangles are left out.
    pub cull: Cull,
    /// How many instances are drawn at once.
    pub instances: u32,
}

/// Where it is drawn.
#[derive(Clone, Copy, Debug)]
pub struct Window {
    /// Pixels of a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// The colour that it is cleared to.
    pub background: [f32; 4],
    /// 32 bits a channel, or 8.
    pub is_float: bool,
}

impl Driver {
    /// The outputs at locations 0 to `outputs` - 1 after the draws, each as rows from below. Textures are bound to units in
    /// their order; one without a name is told by a uniform that is the number of its unit.
    ///
    /// # Errors
    /// The driver refuses the program.
    ///
    /// # Panics
    /// A triangle has a corner without a vertex, or OpenGL has no memory left.
    pub fn scene(
        &self,
        [vertex, fragment]: [&str; 2],
        draws: &[OpenglDraw],
        textures: &[(&str, &Texture)],
        window: Window,
        outputs: u32,
    ) -> Result<Vec<Vec<[f32; 4]>>, Rejection> {
        let program = self.link(vertex, fragment, &[])?;
        let pictures = self.scene_of(program, draws, textures, window, outputs);
        self.delete(program);
        Ok(pictures)
    }

    /// The same by a program that is linked: the driver compiles it when it draws first.
    ///
    /// # Panics
    /// As [`Driver::scene`].
    pub fn scene_of(
        &self,
        program: LinkedProgram,
        draws: &[OpenglDraw],
        textures: &[(&str, &Texture)],
        window: Window,
        outputs: u32,
    ) -> Vec<Vec<[f32; 4]>> {
        let gl = self.gl();
        let [width, height] = [window.width, window.height].map(|side| i32::try_from(side).expect("a side"));
        let mut pictures = Vec::new();
        // SAFETY: see the head of `opengl.rs`. Each slice that is read into has 16 bytes for each pixel, and no corner
        // names a vertex that the buffers do not have.
        unsafe {
            let framebuffer = gl.create_framebuffer().expect("a framebuffer");
            gl.bind_framebuffer(glow::FRAMEBUFFER, Some(framebuffer));
            let renderbuffer = |format, attachment| {
                let buffer = gl.create_renderbuffer().expect("a renderbuffer");
                gl.bind_renderbuffer(glow::RENDERBUFFER, Some(buffer));
                gl.renderbuffer_storage(glow::RENDERBUFFER, format, width, height);
                gl.framebuffer_renderbuffer(glow::FRAMEBUFFER, attachment, glow::RENDERBUFFER, Some(buffer));
                buffer
            };
            let format = if window.is_float { glow::RGBA32F } else { glow::RGBA8 };
            let mut buffers: Vec<_> =
                (0..outputs).map(|number| renderbuffer(format, glow::COLOR_ATTACHMENT0 + number)).collect();
            buffers.push(renderbuffer(glow::DEPTH_COMPONENT32F, glow::DEPTH_ATTACHMENT));
            assert_eq!(gl.check_framebuffer_status(glow::FRAMEBUFFER), glow::FRAMEBUFFER_COMPLETE);
            gl.draw_buffers(&(0..outputs).map(|number| glow::COLOR_ATTACHMENT0 + number).collect::<Vec<_>>());
            gl.viewport(0, 0, width, height);
            let [red, green, blue, alpha] = window.background;
            gl.clear_color(red, green, blue, alpha);
            gl.clear_depth_f32(1.0);
            gl.clear(glow::COLOR_BUFFER_BIT | glow::DEPTH_BUFFER_BIT);
            gl.use_program(Some(program.name()));
            let mut bound = Vec::new();
            for (unit, (name, texture)) in (0..).zip(textures) {
                gl.active_texture(glow::TEXTURE0 + unit);
                bound.push(self.upload(texture));
                gl.uniform_1_i32(gl.get_uniform_location(program.name(), name).as_ref(), unit.cast_signed());
            }
            for draw in draws {
                self.draw_scene(program, draw);
            }
            for number in 0..outputs {
                let mut pixels = vec![[0.0_f32; 4]; window.width * window.height];
                gl.read_buffer(glow::COLOR_ATTACHMENT0 + number);
                let into = glow::PixelPackData::Slice(Some(bytemuck::cast_slice_mut(&mut pixels)));
                gl.read_pixels(0, 0, width, height, glow::RGBA, glow::FLOAT, into);
                pictures.push(pixels);
            }
            self.check("draw a scene");
            gl.active_texture(glow::TEXTURE0);
            gl.delete_framebuffer(framebuffer);
            buffers.into_iter().for_each(|buffer| gl.delete_renderbuffer(buffer));
            bound.into_iter().for_each(|texture| gl.delete_texture(texture));
        }
        pictures
    }

    fn draw_scene(&self, program: LinkedProgram, draw: &OpenglDraw) {
        let gl = self.gl();
        let count = draw.attributes.first().map_or(0, |(_, kind, numbers)| numbers.len() / components(*kind));
        let given = !draw.triangles.is_empty();
        let corners: Vec<u32> =
            if given { draw.triangles.concat() } else { (0..u32::try_from(count).expect("a count")).collect() };
        assert!(corners.iter().all(|corner| (*corner as usize) < count), "a corner without a vertex");
        // SAFETY: see `scene`. Every buffer holds `count` vertices.
        unsafe {
            let array = gl.create_vertex_array().expect("a vertex array");
            gl.bind_vertex_array(Some(array));
            let mut buffers = Vec::new();
            for (name, kind, numbers) in &draw.attributes {
                let buffer = gl.create_buffer().expect("a buffer");
                gl.bind_buffer(glow::ARRAY_BUFFER, Some(buffer));
                gl.buffer_data_u8_slice(glow::ARRAY_BUFFER, &bytes(*kind, numbers), glow::STATIC_DRAW);
                buffers.push(buffer);
                let Some(location) = gl.get_attrib_location(program.name(), name) else { continue };
                gl.enable_vertex_attrib_array(location);
                let size = i32::try_from(components(*kind)).expect("a size");
                match kind {
                    ValueKind::Int(_) => gl.vertex_attrib_pointer_i32(location, size, glow::INT, 0, 0),
                    ValueKind::Uint(_) => gl.vertex_attrib_pointer_i32(location, size, glow::UNSIGNED_INT, 0, 0),
                    _ => gl.vertex_attrib_pointer_f32(location, size, glow::FLOAT, false, 0, 0),
                }
            }
            let indices = gl.create_buffer().expect("a buffer");
            gl.bind_buffer(glow::ELEMENT_ARRAY_BUFFER, Some(indices));
            gl.buffer_data_u8_slice(glow::ELEMENT_ARRAY_BUFFER, bytemuck::cast_slice(&corners), glow::STATIC_DRAW);
            let blocks = self.set_values(program, &draw.uniforms);
            let switch = |what, on: bool| if on { gl.enable(what) } else { gl.disable(what) };
            switch(glow::DEPTH_TEST, draw.depth_test.is_some());
            gl.depth_func(if draw.depth_test == Some(DepthTest::LessEqual) { glow::LEQUAL } else { glow::LESS });
            switch(glow::CULL_FACE, draw.cull != Cull::None);
            gl.cull_face(if draw.cull == Cull::Front { glow::FRONT } else { glow::BACK });
            let corners = i32::try_from(corners.len()).expect("a count");
            let instances = i32::try_from(draw.instances).expect("a count");
            gl.draw_elements_instanced(glow::TRIANGLES, corners, glow::UNSIGNED_INT, 0, instances);
            switch(glow::DEPTH_TEST, false);
            switch(glow::CULL_FACE, false);
            gl.bind_vertex_array(None);
            gl.delete_vertex_array(array);
            buffers.into_iter().chain([indices]).chain(blocks).for_each(|buffer| gl.delete_buffer(buffer));
        }
    }
}

fn components(kind: ValueKind) -> usize {
    match kind {
        ValueKind::Float(size) | ValueKind::Int(size) | ValueKind::Uint(size) | ValueKind::Bool(size) => size.into(),
        ValueKind::Matrix(columns, rows) => usize::from(columns) * usize::from(rows),
    }
}

fn bytes(kind: ValueKind, numbers: &[f64]) -> Vec<u8> {
    let word = |number: &f64| match kind {
        ValueKind::Int(_) => (*number as i32).to_ne_bytes(),
        ValueKind::Uint(_) | ValueKind::Bool(_) => (*number as u32).to_ne_bytes(),
        _ => (*number as f32).to_ne_bytes(),
    };
    numbers.iter().flat_map(word).collect()
}
