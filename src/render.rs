//! Shader + scene → frames and samples, with wgpu.
//!
//! First the student's vertex stage runs alone, over the vertices of the frames and of the probes: it writes clip-space
//! positions and colours to a buffer ([`capture`]). From that buffer a pipeline of our own paints the frames as tiles of
//! one texture ([`painter`], [`tiles`]), each only as far as its triangles reach, which is read back once.
//!
//! A fragment stage that is handed in runs over these triangles in the painter's place ([`fragments`]), and at each probe
//! over the corners of one pixel ([`pixels`]).

mod buffers;
mod capture;
mod device;
mod fragments;
mod frames;
mod painter;
mod pixels;
mod renderer;
mod scene;
mod textures;
mod tiles;
mod uniforms;

pub use device::{AdapterKind, Device};
pub use frames::{Frames, Met, Rendering, Sample};
pub use pixels::Pixel;
pub use renderer::{Captured, Renderer};
pub use scene::{DrawCall, DrawState, RenderScene};
