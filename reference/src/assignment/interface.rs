//! What the handed-in stages are given and what they write.

use crate::Value;
use crate::feed::{Bounds, Feed, Stream};
use crate::interpreter::{BlockPlace, Program, ProgramVariable, Type};
use crate::scene::Moment;

/// What the handed-in stage is given and what it writes, by name.
#[derive(Clone, Debug, Default)]
pub struct Interface {
    /// Vertex attributes.
    pub inputs: Vec<Input>,
    /// Uniforms: scalars, vectors, matrices and samplers, each by its path.
    pub uniforms: Vec<Uniform>,
    /// Outputs, `gl_Position` aside.
    pub outputs: Vec<Output>,
}

/// A vertex attribute.
#[derive(Clone, Debug)]
pub struct Input {
    /// Its name in the shader.
    pub name: String,
    /// Its type.
    pub kind: Type,
    /// Where its values come from.
    pub stream: Stream,
    /// The location that the solution or the fixed stage gives it, by which the program feeds it then.
    pub location: Option<u32>,
}

impl Input {
    /// Which of these a vertex stage's input is: by its name, or by a location that both give where that name is nobody's: a program that
    /// feeds locations does not see names.
    pub fn fed<'a>(inputs: &'a [Self], program: &Program, own: &ProgramVariable) -> Option<&'a Self> {
        let is_taken = |input: &Self| program.inputs().iter().any(|other| other.name == input.name);
        let at_location = |input: &&Self| input.location.is_some() && input.location == own.location;
        let named = inputs.iter().find(|input| input.name == own.name);
        named.or_else(|| inputs.iter().find(at_location).filter(|input| !is_taken(input)))
    }
}

/// A uniform, or a part of one.
#[derive(Clone, Debug)]
pub struct Uniform {
    /// Its name in the shader, or the path `lights[1].colour`, `Block.member`.
    pub path: String,
    /// Its type.
    pub kind: Type,
    /// Where its value comes from.
    pub feed: Feed,
    /// What probes may draw at random.
    pub probe: Option<Bounds>,
    /// Where it lies in a block that the homework lays out by `std140`, which a program fills byte by byte.
    pub place: Option<BlockPlace>,
}

impl Uniform {
    /// Whether a variable of a program is this one: by its place in such a block, whatever it is called there, else by its name.
    pub fn is(&self, own: &ProgramVariable) -> bool {
        match (&self.place, &own.place) {
            (Some(place), Some(own)) if place.block == own.block => {
                (place.offset, place.is_row_major) == (own.offset, own.is_row_major)
            }
            _ => self.path == own.name,
        }
    }

    /// Its value at a moment; numbers that are none where an expression has no value.
    pub fn value(&self, moment: &Moment) -> Value {
        let none = || Value::of(self.kind.clone(), vec![f64::NAN; self.kind.slots().unwrap_or(0)]);
        self.feed.value(&self.kind, moment).unwrap_or_else(none)
    }

    /// Whether it is another value in another window.
    pub(crate) fn follows_window(&self, moment: &Moment) -> bool {
        let [width, height] = moment.resolution;
        self.follows(moment, &Moment { resolution: [2.0 * height, 3.0 * width], ..*moment })
    }

    /// Whether it is another value at another moment of the same camera.
    pub(crate) fn follows(&self, moment: &Moment, other: &Moment) -> bool {
        matches!(self.feed, Feed::Expression(_)) && self.value(other) != self.value(moment)
    }
}

/// An output of the handed-in stage.
#[derive(Clone, Debug)]
pub struct Output {
    /// Its name in the shader.
    pub name: String,
    /// Its type.
    pub kind: Type,
}
