//! What a right answer to a shading homework is, in f64, without a GPU.
//!
//! An assignment is data (`assignments/<id>/assignment.toml`): interface, constants, scene, the illumination equation, the
//! rubric and the known mistakes. From it come, in this order:
//!
//! - [`expression`]: the small exact subset of GLSL in which equations are written
//! - [`equation`]: definitions evaluated in order, with any of them replaced
//! - [`scene`]: poses and matrices of the course program
//! - [`manifest`], [`assignment`], [`mistake`]: the folder, read and checked
//! - [`rasteriser`], [`frames`]: the pictures
//! - [`probes`]: samples in which every term, every clamp and every known mistake shows

pub mod assignment;
pub mod equation;
pub mod expression;
pub mod frames;
pub mod manifest;
pub mod mistake;
pub mod probes;
pub mod rasteriser;
pub mod scene;
mod text;

pub use assignment::{Assignment, assignment, assignments};
pub use expression::{Type, Value};
pub use text::Text;
