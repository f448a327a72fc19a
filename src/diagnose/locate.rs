//! Which line of the student's file a message speaks of.
//!
//! The shader is run once more, on the CPU, at some of the probes, and one value on its way is replaced by what a right
//! answer has there. Where that mends the colour at all of them, the statement that computes the value is the one that
//! the mistake is about. A search for names in the text would not see that a statement further down changes the value, or
//! that a function or a variable of another name computes it. Where no single statement mends the colour, no line is named.

use reference::interpreter::Stage;

mod lines;
mod points;
mod search;

pub(super) use lines::{Words, is_handed_out};
pub(super) use points::{Points, given, is_close, is_same, of};

/// A place in the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Located {
    /// The line, from 1.
    pub line: u32,
    /// The variable that is given the value there.
    pub name: Option<String>,
    /// What the value is to the colour.
    pub role: Role,
    /// The stage whose text it is; none where there is only one.
    pub stage: Option<Stage>,
}

impl Located {
    /// A line of which no more is known.
    pub fn at(line: u32) -> Self {
        Self { line, name: None, role: Role::Wrong, stage: None }
    }
}

/// How the shader comes by what the mistake is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    /// The place computes it, and what it computes is not right.
    Wrong,
    /// The place computes it, and it is 0 at every probe.
    Zero,
    /// Nothing that the colour depends on stands for it; the place is the sum in which it is missing.
    Absent,
    /// It makes no difference to the colour, and it is not known why; the place is the sum.
    Lost,
}
