//! What the handed-out files define, as the solution does.

use super::CheckResult;
use super::solution::{place, refused};
use crate::Value;
use crate::assignment::{Constant, HandedIn, error};
use crate::interpreter::{Cell, Draft};
use crate::manifest;
use crate::text::both;

/// What a file defines of the constants: each with its numbers.
type Defined = Vec<(Cell, Vec<f64>)>;

/// The constants with the values that they have in the solution, which are those of the handed-out file.
pub(super) fn constants(files: &[HandedIn], entries: Vec<manifest::ConstantEntry>) -> CheckResult<Vec<Constant>> {
    let names: Vec<&str> = entries.iter().map(|constant| constant.name.as_str()).collect();
    if names.is_empty() {
        return Ok(Vec::new());
    }
    let defined = |file: &HandedIn, name: &str, text: &str| -> CheckResult<Defined> {
        Draft::constants(text, file.stage, &names).map_err(|refusal| refused(name, &refusal))
    };
    let in_file = |file: &HandedIn| {
        let HandedIn { solution, starter_name, starter, .. } = file;
        Ok((defined(file, &solution.name, &solution.text)?, defined(file, starter_name, starter)?))
    };
    let all = files.iter().map(in_file).collect::<CheckResult<Vec<(Defined, Defined)>>>()?;
    let constant = |entry: manifest::ConstantEntry| {
        let manifest::ConstantEntry { name, means, line } = entry;
        let is_it = |(cell, _): &&(Cell, Vec<f64>)| cell.name == name;
        let missing = || {
            let shown = files.iter().map(|file| file.solution.name.as_str()).collect::<Vec<_>>();
            error(
                format!("constant `{name}`"),
                both(
                    format!(
                        "{} has no `const type {name} = …;`: write it there, or correct the name",
                        shown.join(" and ")
                    ),
                    format!(
                        "{} に `const 型 {name} = …;` がありません。書くか、名前を直してください",
                        shown.join(" と ")
                    ),
                ),
            )
        };
        let found = files
            .iter()
            .zip(&all)
            .find_map(|(file, (ours, starters))| Some((file, ours.iter().find(is_it)?, starters.iter().find(is_it))));
        let (file, (cell, numbers), starter) = found.ok_or_else(missing)?;
        if let Some((other, theirs)) = starter
            && (theirs != numbers || other.kind != cell.kind)
        {
            let (solution, line) = (&file.solution.name, cell.line);
            let message = both(
                format!("`{name}` is not what it is in {solution}, line {line}: write the same in both"),
                format!("`{name}` が {solution} の {line} 行目と異なります。両方に同じものを書いてください"),
            );
            return Err(error(place(&file.starter_name, other.line), message));
        }
        let value = Value::new(cell.kind.clone(), numbers.clone()).ok_or_else(missing)?;
        Ok(Constant { name, value, means, line })
    };
    entries.into_iter().map(constant).collect()
}
