//! What a right answer to a shading homework is, in f64, without a GPU.
//!
//! An assignment is data (`assignments/<id>/assignment.toml`): interface, constants, scene, the illumination equation, the
//! rubric and the known mistakes. From it come, in this order:
//!
//! - [`expression`]: the small exact subset of GLSL in which equations are written
//! - [`equation`]: definitions evaluated in order, with any of them replaced
//! - [`scene`]: poses and matrices of the course program
//! - [`manifest`], [`mod@assignment`], [`mistake`]: the folder, read and checked
//! - [`rasteriser`], [`frames`]: the pictures
//! - [`probes`]: samples in which every term, every clamp and every known mistake shows
//! - [`fit`]: which mistakes explain what a shader computed
//! - [`glsl`]: a shader for any of those hypotheses
//!
//! ```
//! let assignment = reference::assignment("ggsample06").expect("built in");
//! let probes = assignment.probes(7);
//! let right: Vec<[f64; 3]> = probes.iter().map(|p| p.colour.to_array()).collect();
//! let fit = reference::fit::explain(assignment, &probes, &right, reference::fit::TOLERANCE);
//! assert!(fit.is_right());
//! ```

pub mod advice;
pub mod assignment;
pub mod equation;
pub mod expression;
pub mod fit;
pub mod frames;
pub mod glsl;
pub mod interpreter;
pub mod manifest;
pub mod mistake;
pub mod probes;
pub mod rasteriser;
pub mod scene;
mod text;

pub use assignment::{Assignment, assignment, assignments};
pub use expression::{Type, Value};
pub use text::Text;
