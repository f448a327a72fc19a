//! GLSL, interpreted in f64 over many samples at once.
//!
//! This is what ggrade knows of GLSL by itself: it shares no compiler, no translator and no driver with the way that a
//! student's shader takes, and knows nothing of assignments. A text goes through it in this order:
//!
//! - `text`: characters → tokens; comments, macros and conditions are gone
//! - `parse`: tokens → `syntax`
//! - `compile`: syntax → `code`: names and `types` are resolved, constants are folded, `builtin` functions become
//!   instructions
//! - `run`: code → outputs, for columns of samples, with `texture`s read by OpenGL's rules
//! - [`Sheet`]: a program whose `main` is a list of definitions, each to be computed by itself, one sample at a time
//!
//! ```
//! use reference::interpreter::{Program, Stage};
//! let text = "in vec2 p; out float d; uniform float k; void main() { d = k * length(p); }";
//! let program = Program::compile(text, Stage::Vertex).unwrap();
//! let run = program.run(2).uniform("k", &[2.0]).unwrap().input("p", &[&[3.0, 0.0], &[4.0, 1.0]]).unwrap();
//! assert_eq!(run.outputs().unwrap().get("d").unwrap().values, [[10.0, 2.0]]);
//! ```
//!
//! # Why a parser of its own
//! Measured against `glsl-lang` 0.8.1 on the machine that ggrade is developed on: that crate and those that it brings
//! (a parser generator runs at build time) take 63 s of processor time to compile; the crate `reference` takes 15, this
//! whole module included. Of the 447 accepted samples it refuses 14, nearly all by rule: words that are keywords only in
//! later versions (`buffer`, `sample`, `shared`), extensions by name, members named as types, form feeds. Its
//! preprocessor gives what a macro wrote the span of the macro's body and not of its use, which is the line that a
//! report has to name.
//!
//! # What is undefined
//! Where GLSL leaves a value open, a lane gets one and a [`UndefinedCause`] beside it, which goes wherever the value goes: an
//! output says that it is undefined only where such a value reaches it. Where an undefined value decides which statements
//! run, or where something is written, all outputs of the lane are undefined.
//!
//! # How exact
//! Values of type `float` are computed in 64 bits. What a driver rounds visibly is rounded here as well: whole numbers
//! as floats, floats as integers and as bits, and results that no float holds are infinite. [`Precision::Single`] rounds
//! after every operation instead; how far the two are apart tells how much a value depends on rounding.

mod builtin;
mod change;
mod code;
mod compile;
mod nature;
pub mod outline;
mod parse;
mod run;
mod sheet;
pub mod std140;
mod syntax;
mod text;
mod texture;
pub mod trace;
mod types;
mod window;

#[cfg(test)]
mod tests;

pub use builtin::lookup::{is_lookup, lookup_of_today};
pub use change::{
    ChangedPart, FREE, Ingredients, Operator, ProgramRepair, ProgramSlip, Repairable, SlipMark, program_slips,
    program_without_parts, slips_marked, slips_of_variables, slips_written,
};
pub use code::{BlockPlace, Interpolation, ProgramVariable};
pub use compile::{DefinitionSlip, Draft};
pub use nature::{Copied, Nature};
pub use run::{
    Column, FUEL, Mismatch, NotedLookup, Outputs, Precision, Prepared, Run, Stopped, Undefined, UndefinedCause,
};
pub use sheet::{Cell, Formula, Registers, Sheet, StoredOutput};
pub use syntax::Binary;
pub use text::numbers;
pub use texture::{Compare, Depths, Filter, Level, Lookup, Texels, Texture, Wrap};
pub use types::{Dimension, Sampler, Scalar, Struct, Type};
pub use window::WindowCoordinates;

use crate::Text;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::HashSet;
use std::fmt;

/// A stage of the pipeline.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Stage {
    /// The vertex shader.
    Vertex,
    // Its samples are 2 × 2 pixels after 2 × 2 pixels, each row by row from below.
    /// The fragment shader.
    Fragment,
}

/// Why a program is not run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// The line in the file, from 1; 0 where it is about the whole file.
    pub line: u32,
    what: Text,
    is_limit: bool,
}

impl Refusal {
    fn invalid(line: u32, what: Text) -> Self {
        Self { line, what, is_limit: false }
    }

    fn limit(line: u32, what: Text) -> Self {
        Self { line, what, is_limit: true }
    }

    /// What is wrong, or not supported.
    pub fn what(&self) -> &Text {
        &self.what
    }

    /// Whether the program may be valid, and this interpreter does not know what it uses.
    pub fn is_limit(&self) -> bool {
        self.is_limit
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let kind = if self.is_limit { "not supported" } else { "not valid" };
        write!(f, "line {}: {kind}: {}", self.line, self.what.en)
    }
}

/// The scalars of an expression that stands by itself, as a value of a type.
///
/// # Errors
/// It is no expression, or not constant, or not of the type.
pub fn constant(text: &str, kind: &Type) -> Result<Vec<f64>, Refusal> {
    let preprocessed = text::preprocess(text)?;
    let expression = parse::parse_expression(&preprocessed.tokens, HashSet::new())?;
    compile::constant(&expression, NEWEST, kind)
}

/// Checks that a text is one expression, whatever its names mean.
///
/// # Errors
/// It is not.
pub fn expression(text: &str) -> Result<(), Refusal> {
    let preprocessed = text::preprocess(text)?;
    parse::parse_expression(&preprocessed.tokens, HashSet::new()).map(drop)
}

/// The variable that a path begins with, such as `lights` of `lights[1].colour`.
pub fn root(path: &str) -> &str {
    path.split(['.', '[']).next().unwrap_or(path)
}

/// The word that throws a fragment away.
pub const DISCARD: &str = "discard";

/// Whether GLSL has a function of this name.
pub fn is_builtin(name: &str) -> bool {
    !builtin::signatures(name).is_empty()
}

/// The version of an expression that stands by itself.
const NEWEST: u32 = 460;

/// A program that can be run, as often as one likes and in any thread.
#[derive(Clone, Debug)]
pub struct Program {
    code: code::Code,
}

impl Program {
    /// Compiles a shader.
    ///
    /// # Errors
    /// It is not GLSL, or uses something that is not supported.
    pub fn compile(source: &str, stage: Stage) -> Result<Self, Refusal> {
        let preprocessed = text::preprocess(source)?;
        let items = parse::parse(&preprocessed.tokens)?;
        Ok(Self { code: compile::compile(&items, preprocessed.version, stage)? })
    }

    fn of(code: code::Code) -> Self {
        Self { code }
    }

    /// Compiles a shader so that each value on its way can be looked at and changed. Lines are those on which something is
    /// written, also within a macro.
    ///
    /// # Errors
    /// As for [`Program::compile`].
    pub fn traced(source: &str, stage: Stage) -> Result<Self, Refusal> {
        let preprocessed = text::preprocess(source)?;
        let tokens: Vec<_> = preprocessed.tokens.into_iter().map(text::Token::on_its_line).collect();
        let items = parse::parse(&tokens)?;
        Ok(Self { code: compile::compile_traced(&items, preprocessed.version, stage)? })
    }

    /// Where values are looked at, in a program that was compiled for that.
    pub fn sites(&self) -> &[trace::Site] {
        &self.code.sites
    }

    /// The uniforms that can be set, each part of a structure, array or block by its path.
    pub fn uniforms(&self) -> &[ProgramVariable] {
        &self.code.uniforms
    }

    /// The value that a uniform has where the host sets none, if the program says it.
    pub fn initial(&self, uniform: &ProgramVariable) -> Option<Vec<f64>> {
        let slots = uniform.slot..uniform.slot + uniform.kind.slots()? as code::Slot;
        let of = |slot| self.code.defaults.iter().find(|(known, _)| *known == slot).map(|(_, value)| *value);
        slots.map(of).collect()
    }

    /// What each sample has for itself; built-in variables only where the program uses them.
    pub fn inputs(&self) -> &[ProgramVariable] {
        &self.code.inputs
    }

    /// What each sample computes.
    pub fn outputs(&self) -> &[ProgramVariable] {
        &self.code.outputs
    }

    /// The outermost variables of `main`.
    pub fn locals(&self) -> &[ProgramVariable] {
        &self.code.locals
    }

    /// What it needs and does beyond computing outputs from inputs.
    pub fn nature(&self) -> Nature {
        Nature::of(&self.code)
    }

    /// For each scalar of its outputs the scalar of an input that it is a copy of; `None` where it computes anything.
    pub fn copies(&self) -> Option<Vec<Vec<Copied>>> {
        nature::copies(&self.code)
    }

    /// Makes ready for runs of so many samples, again and again; all of them together take the steps. The first one says how
    /// many a run may take: some times as many as that.
    pub fn prepared<'a>(&'a self, samples: usize, textures: &'a [Texture], fuel: u64) -> Prepared<'a> {
        Prepared::new(&self.code, samples, textures, fuel)
    }

    /// Begins a run for so many samples.
    pub fn run(&self, samples: usize) -> Run<'_> {
        Run::new(&self.code, samples)
    }
}
