//! Bounds of uniforms that reach so far that parts of the solution show which else show nowhere.

use super::FolderPlan;
use super::uniforms::numbers;
use crate::Assignment;
use crate::unseen::{Revealing, UnseenPart};
use std::collections::HashSet;

/// Widens the bounds of guessed values, as long as the folder grades and fewer parts show nowhere.
pub(super) fn widen(plan: &mut FolderPlan, assignment: &Assignment) {
    let probes = assignment.judging_probes();
    let parts = assignment.unseen_parts(&probes);
    let all: Vec<&UnseenPart> = parts.iter().collect();
    let mut count = parts.len();
    let mut tried = HashSet::new();
    for (part, found) in parts.iter().zip(assignment.revealing(&all, &probes)) {
        let Some(Revealing { uniform, value }) = found.filter(|found| tried.insert(found.uniform.clone())) else {
            continue;
        };
        let Some((entry, line, [least, greatest])) = bounds_of(plan, &uniform) else { continue };
        let number = two_digits(value.float());
        let [least, greatest] = [least.min(number), greatest.max(number)];
        let ends = numbers(&[least, greatest], value.kind());
        let wider = format!("probe = {{ within = {ends} }}");
        let before = std::mem::replace(&mut plan.uniforms[entry].lines[line], wider);
        match Assignment::load(plan.folder()).map(|wider| wider.unseen_parts(&wider.judging_probes()).len()) {
            Ok(fewer) if fewer < count => {
                count = fewer;
                let (own, at) = (&part.part.own, part.part.lines.0);
                plan.guessed(
                    format!("uniform `{uniform}`: within {ends}, so that `{own}` (line {at}) shows"),
                    format!("uniform `{uniform}`: `{own}` ({at} 行目) が現れるように {ends} の範囲"),
                );
            }
            _ => plan.uniforms[entry].lines[line] = before,
        }
    }
}

/// A number as a person writes it.
fn two_digits(number: f64) -> f64 {
    format!("{number:.1e}").parse().unwrap_or(number)
}

/// The entry of a uniform of one number and its line with the bounds, where it has them.
fn bounds_of(plan: &FolderPlan, uniform: &str) -> Option<(usize, usize, [f64; 2])> {
    let entry = plan.uniforms.iter().position(|entry| entry.name == uniform)?;
    plan.uniforms[entry].lines.iter().enumerate().find_map(|(line, text)| {
        let ends = text.strip_prefix("probe = { within = [")?.strip_suffix("] }")?;
        let (least, greatest) = ends.split_once(", ")?;
        Some((entry, line, [least.parse().ok()?, greatest.parse().ok()?]))
    })
}
