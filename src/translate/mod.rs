//! Source → [`Shader`]: the compiler's verdict, the interface, and the module that wgpu runs.

mod entry;
pub mod glslang;
mod hints;
mod interface;
mod limits;
mod log;
mod spirv;

pub use entry::{Attribute, CAPTURE_GROUP, CAPTURE_STRIDE};
pub use hints::{overlooked_errors, without_line_directives};
pub use interface::{Interface, Variable};
pub use log::{link_diagnostics, vertex_diagnostics};
pub use spirv::Lines;

mod module;
pub use module::{Shader, Uniform, UniformBlock};

/// Experimental entry.
pub fn module_of(words: &[u32]) -> Result<Shader, crate::fault::Fault> {
    module::build(words, &["pv", "cv"], "vc")
}
pub use module::unsupported;
/// Experimental entry.
pub fn fixed_of(words: &[u32]) -> Result<naga::Module, crate::fault::Fault> {
    module::build_fixed_stage(words, "vc")
}
