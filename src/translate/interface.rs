//! What the assignment's program feeds to the shader and takes from it.

use std::ffi::CString;

/// A variable of the interface.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Variable {
    /// Its name.
    pub name: String,
    /// Its GLSL type, such as `mat4`.
    pub ty: String,
}

/// The interface between the assignment's program and the student's vertex shader.
#[derive(Clone, Debug)]
pub struct Interface {
    /// Vertex attributes.
    pub inputs: Vec<Variable>,
    /// Uniforms of the default block.
    pub uniforms: Vec<Variable>,
    /// The varying that the fixed fragment shader reads.
    pub output: Variable,
    /// Names of the constants that the handed-out file defines.
    pub constants: Vec<String>,
    /// The fixed fragment shader.
    pub fragment: CString,
}
