//! What it costs that something stands elsewhere, in a homework of which no line judges the position.

use crate::Assignment;
use crate::feature::Feature;
use crate::interpreter::Stage;

/// Something stands elsewhere, see `general.toml`.
const POSITION_CHANGED: &str = "position-changed";

const SEED: u64 = 6;

/// A vertex is moved by this much of clip space, or more.
const LEAST: f64 = 1e-6;

/// What is left of lines whose feature moves nothing, where no feature does: nobody says what the position is worth.
const HALF: f64 = 0.5;

/// Has the lines pay for it without whose feature something stands elsewhere; where none does so, each loses half.
pub(super) fn complete(assignment: &mut Assignment) {
    let is_said = assignment.rubric.iter().any(|line| assignment.judges_position(line));
    let changed = assignment.mistakes.iter().position(|mistake| mistake.id == POSITION_CHANGED);
    let Some(changed) = changed.filter(|at| assignment.mistakes[*at].keeps.is_empty()) else { return };
    if is_said || !assignment.hands_in(Stage::Vertex) {
        return;
    }
    let probes = assignment.fresh_probes(SEED);
    let moves = |feature: &Feature| {
        let without = assignment.computed_without(feature, &probes);
        let mut moved = without.iter().zip(probes.iter());
        moved.any(|((_, position), probe)| (*position - probe.position).abs().max_element() > LEAST)
    };
    let is_moving: Vec<bool> = assignment.features.iter().map(|feature| feature.as_ref().is_some_and(moves)).collect();
    let keeps = assignment.rubric.iter().zip(&is_moving).filter_map(|(line, moves)| match moves {
        true => Some((line.id.clone(), 0.0)),
        false if is_moving.contains(&true) => None,
        false => Some((line.id.clone(), HALF)),
    });
    assignment.mistakes[changed].keeps = keeps.collect();
}
