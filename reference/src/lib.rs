//! What a right answer to a shading homework is, in f64, without a GPU.
//!
//! An assignment is a folder: a solution, which is a shader, and data (`assignments/<id>/assignment.toml`): the interface,
//! the scene, the rubric and the known mistakes. From it come, in this order:
//!
//! - [`interpreter`]: GLSL in f64; it knows nothing of the others
//! - [`equation`]: the solution's definitions, evaluated in order, with any of them replaced
//! - [`accepted`]: other shaders that are right as well
//! - [`texture`]: pictures from PNG files, and pictures that are computed
//! - [`scene`]: meshes, cameras and moments of the course program
//! - [`feed`]: what the shader is given at a moment
//! - [`host`]: programs of which numbers are read, as shaders
//! - [`manifest`], [`mod@assignment`], [`mistake`]: the folder, read and checked
//! - [`typeset`]: the equation as the lecture writes it
//! - [`rasteriser`], [`frames`]: the pictures
//! - [`probes`]: samples in which every term, every clamp and every known mistake shows
//! - `together`: several mistakes in one program
//! - [`fit`]: which mistakes explain what a shader computed
//! - [`page`]: shaders as pages for sharing them have them
//! - [`proposal`]: a folder, written from a solution
//!
//! ```
//! let assignment = reference::assignment("ggsample06").expect("built in");
//! let probes = assignment.probes(7);
//! let right: Vec<[f64; 3]> = probes.iter().map(|p| p.colour.to_array()).collect();
//! let fit = reference::fit::explain(assignment, &probes, &right, reference::fit::TOLERANCE);
//! assert!(fit.is_right());
//! ```

pub mod accepted;
pub mod advice;
pub mod assignment;
pub mod built_in;
pub mod derived;
pub mod equation;
pub mod feature;
pub mod feed;
pub mod fit;
mod folder;
pub mod frames;
pub mod free;
pub mod host;
pub mod interpreter;
pub mod manifest;
pub mod mistake;
pub mod page;
pub mod pipeline;
pub mod probes;
pub mod proposal;
pub mod rasteriser;
pub mod scene;
pub mod schema;
mod shading;
mod text;
pub mod texture;
mod together;
pub mod traced;
pub mod typeset;
mod unjudged;
pub mod unseen;
mod value;

/// Names the code of this crate: what other code computed has another name.
pub const ENGINE: &str = env!("GGRADE_ENGINE");

pub use assignment::{Assignment, AssignmentError};
pub use built_in::{assignment, assignments};
pub use folder::Folder;
pub use text::Text;
pub use value::{Value, Values};
