//! Slips of a program by what is asked of them.

use super::{PlacedSlip, ProgramSlip, SlipMark, found, slips_of};
use crate::interpreter::change::{Operator, written};
use crate::interpreter::{Program, Refusal, Stage, parse, text};

/// The programs with each of the slips that have a mark.
///
/// # Errors
/// The program is none.
pub fn slips_marked(source: &str, stage: Stage, mark: &SlipMark) -> Result<Vec<Program>, Refusal> {
    let slips = slips_of(source, stage, &|_| true, &|slip| slip.mark() == *mark)?;
    Ok(slips.into_iter().map(|slip| slip.program).collect())
}

/// The slips in `main` by which a variable is given what is written.
///
/// # Errors
/// The program is none.
pub fn slips_written(source: &str, (of, name): (Operator, &str), text: &str) -> Result<Vec<SlipMark>, Refusal> {
    let items = parse::parse(&text::preprocess(source)?.tokens)?;
    let is_it = |slip: &PlacedSlip| match slip {
        PlacedSlip::Expression(_, Some(given), change, _) => {
            change.operator == of && **given == *name && written(&change.expression) == text
        }
        _ => false,
    };
    Ok(found(&items, &|function| function == "main").iter().filter(|slip| is_it(slip)).map(PlacedSlip::mark).collect())
}

/// The slips of a program in those of its functions that `is_part` names, as far as they are programs. The plainer ones come first.
///
/// # Errors
/// The program is none.
pub fn program_slips(source: &str, stage: Stage, is_part: &dyn Fn(&str) -> bool) -> Result<Vec<ProgramSlip>, Refusal> {
    slips_of(source, stage, is_part, &|slip| !matches!(slip, PlacedSlip::Branch(..)))
}

/// Those in `main` by which certain variables are given another value.
///
/// # Errors
/// The program is none.
pub fn slips_of_variables(
    source: &str,
    stage: Stage,
    is_one: &dyn Fn(&str) -> bool,
) -> Result<Vec<ProgramSlip>, Refusal> {
    slips_of(source, stage, &|function| function == "main", &|slip| slip.parts().0.is_some_and(|name| is_one(name)))
}

/// The program without each of its parts: a statement, a branch, an operand, a function around a value.
///
/// # Errors
/// The program is none.
pub fn program_without_parts(source: &str, stage: Stage) -> Result<Vec<ProgramSlip>, Refusal> {
    slips_of(source, stage, &|_| true, &|slip| slip.operator() <= Operator::FallsThrough)
}
