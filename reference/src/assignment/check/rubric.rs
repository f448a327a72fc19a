//! The lines of the rubric: what each judges, and that each name stands once.

use super::CheckResult;
use super::solution::CheckedSolution;
use crate::assignment::error;
use crate::manifest;
use crate::text::both;
use crate::together::has_name;
use std::collections::HashSet;

/// Rubric lines are held as the bits of a u64.
const MAX_LINES: usize = 64;

/// The names of the lines; each is completed by what it judges.
pub(super) fn rubric(
    lines: &mut [manifest::RubricItem],
    solution: &CheckedSolution<'_>,
    texts: &[&str],
) -> CheckResult<HashSet<String>> {
    if lines.len() > MAX_LINES {
        return Err(error("rubric", both("has more than 64 lines", "64 行を超えています")));
    }
    let mut ids = HashSet::new();
    for line in lines {
        let place = format!("rubric `{}`", line.id);
        let judged = match line.judges.as_str() {
            "" => solution.colour()?,
            judges => solution.definition(judges, &|| place.clone())?,
        };
        line.judges = solution.name(judged).to_owned();
        for number in &line.numbers {
            solution.definition(number, &|| format!("{place}, `numbers`"))?;
        }
        if let Some(name) = line.variables.iter().find(|name| !texts.iter().any(|text| has_name(text, name))) {
            return Err(error(
                place,
                both(
                    format!(
                        "is about `{name}`, which the solution does not have: write the name of one of its variables"
                    ),
                    format!("`{name}` は解答例にありません。解答例の変数名を書いてください"),
                ),
            ));
        }
        if !line.points.is_finite() || line.points <= 0.0 {
            return Err(error(
                place,
                both(
                    "is worth nothing: write `points` above 0",
                    "点がありません。`points` を 0 より大きくしてください",
                ),
            ));
        }
        if !ids.insert(line.id.clone()) {
            return Err(error(
                place,
                both("stands twice: give one another name", "2 回書かれています。一方の名前を変えてください"),
            ));
        }
    }
    Ok(ids)
}

/// Refuses what names a line that there is not.
pub(super) fn known_line(lines: &HashSet<String>, line: &str, place: &str) -> CheckResult<()> {
    if lines.contains(line) {
        Ok(())
    } else {
        Err(error(
            place,
            both(
                format!("there is no rubric line `{line}`: correct the name, or add it"),
                format!("採点の行 `{line}` はありません。名前を直すか、追加してください"),
            ),
        ))
    }
}
