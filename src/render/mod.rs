//! Shader + scene → frames and samples, with wgpu.
//!
//! All frames of a submission are tiles of one texture, drawn in one render pass together with the
//! probes, and read back once. Each vertex also writes its clip-space position and colour, as the
//! shader computed them, to a buffer that is read back with the tiles.

mod buffers;
mod device;
mod frames;
mod job;
mod renderer;
mod target;

pub use device::{AdapterKind, Device};
pub use frames::{Frames, Rendering, Sample};
pub use job::{Batch, Scene};
pub use renderer::Renderer;
