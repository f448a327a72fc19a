//! `ggrade opengl`: what the machine's OpenGL driver draws of a solution, in a process of its own. A driver may end its process.

use super::{ExitStatus, assignment};
use crate::cli::OpenglArguments;
use crate::fault::Fault;
use crate::language::{Language, Text};
use crate::opengl;

/// Prints an [`opengl::Agreement`], or why there is none, as JSON.
pub fn run(arguments: &OpenglArguments) -> Result<ExitStatus, Fault> {
    let Some(assignment) = assignment(Some(&arguments.assignment), &[], Language::default()) else {
        return Ok(ExitStatus::Usage);
    };
    let answer = serde_json::to_string(&opengl::agreement(&assignment));
    let answer = answer.map_err(|error| Fault::new(Text::verbatim(error.to_string())))?;
    anstream::println!("{answer}");
    Ok(ExitStatus::FullMarks)
}
