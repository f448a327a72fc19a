//! What the lecture says of the solution's definitions and variables.

use super::about::computed;
use super::solution::CheckedSolution;
use super::{CheckResult, listed};
use crate::assignment::{HandedIn, error};
use crate::manifest::LectureName;
use crate::text::both;
use std::collections::BTreeMap;

/// Each is there: among the definitions, or among what is computed in the files of a solution that is no list of definitions.
pub(super) fn names(
    given: BTreeMap<String, LectureName>,
    solution: &CheckedSolution<'_>,
    files: &[HandedIn],
) -> CheckResult<BTreeMap<String, LectureName>> {
    let is_list = solution.why_whole().is_none();
    let variables = if is_list || given.is_empty() { Default::default() } else { computed(files) };
    for name in given.keys() {
        let place = || format!("definition `{name}`");
        if is_list {
            solution.definition(name, &place)?;
        } else if !variables.contains(name) {
            let known = listed(variables.iter().map(String::as_str));
            return Err(error(
                place(),
                both(
                    format!("the solution computes no `{name}`; it computes {known}"),
                    format!("解答に `{name}` はありません (あるもの: {known})"),
                ),
            ));
        }
    }
    Ok(given)
}
