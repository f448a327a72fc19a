//! Colours that are looked up instead of computed.

use crate::compare::COLOUR_TOLERANCE;
use crate::render::Sample;
use crate::report::FrameResult;
use crate::source::Source;
use reference::Assignment;
use reference::assignment::RubricItem;
use reference::mistake::FoundMistake;
use reference::probes::ProbeSet;
use std::ops::Range;

/// A table has few entries: it gives one vertex at most so many colours under the 26 cameras. Black and white alone, or a few
/// poses and a default, are fewer; what is computed from the matrices and clamped differs under a third of them or more.
const MOST_ENTRIES: usize = 8;

/// Whether the colour comes from a table: it stays the same, number by number, when all attributes change; and it has few
/// values when the matrices do, or the text looks something up by a number.
pub fn is_lookup(source: &Source, probes: &ProbeSet, samples: &[Sample]) -> bool {
    let is_black = |sample: &Sample| sample.colour_f64().iter().all(|channel| channel.abs() <= COLOUR_TOLERANCE);
    // What is dark there and not elsewhere has lost its light, as in a cone that points away.
    let is_lost = |groups: &[Range<usize>; 2]| {
        let dark = groups.iter().filter_map(|places| samples.get(places.clone())).flatten();
        dark.into_iter().all(is_black) && !samples.iter().all(is_black)
    };
    let twins = probes.with_other_vertices().filter(|groups| !is_lost(groups));
    twins.is_some_and(|groups| stays_the_same(groups, samples))
        && (entries(probes, samples) <= MOST_ENTRIES || has_a_table(source))
}

/// Whether the text takes something by a number that is computed, or by the vertex's.
fn has_a_table(source: &Source) -> bool {
    let code = source.code();
    let index = |after: &str| {
        let index = after.split(']').next().unwrap_or_default().trim();
        !index.is_empty() && !index.bytes().all(|byte| byte.is_ascii_digit())
    };
    code.contains("gl_VertexID") || code.split('[').skip(1).any(index)
}

/// How many colours the first vertex has under all cameras.
fn entries(probes: &ProbeSet, samples: &[Sample]) -> usize {
    let each = samples.len() / probes.groups.len().max(1);
    let mut entries: Vec<&Sample> = Vec::new();
    for sample in samples.iter().step_by(each.max(1)) {
        if !entries.iter().any(|known| is_equal(known, sample)) {
            entries.push(sample);
        }
    }
    entries.len()
}

/// Whether the colour stays the same, vertex by vertex, when only the normals change.
pub fn ignores_normals(probes: &ProbeSet, samples: &[Sample]) -> bool {
    probes.with_other_normals().is_some_and(|groups| stays_the_same(groups, samples))
}

fn stays_the_same(groups: [Range<usize>; 2], samples: &[Sample]) -> bool {
    let [one, other] = groups.map(|places| samples.get(places).unwrap_or_default());
    !one.is_empty() && one.len() == other.len() && one.iter().zip(other).all(|(a, b)| is_equal(a, b))
}

fn is_equal(a: &Sample, b: &Sample) -> bool {
    a.colour_f64().iter().zip(b.colour_f64()).all(|(x, y)| (x - y).abs() <= COLOUR_TOLERANCE)
}

/// Whether these mistakes explain a looked-up colour by chance: they were fitted to it, or it is the same everywhere
/// and they would leave points to a term that varies, of which it shows nothing. (Black is also a product with one factor
/// missing, and white is everything added up.)
pub fn is_coincidence(assignment: &Assignment, probes: &ProbeSet, samples: &[Sample], found: &[FoundMistake]) -> bool {
    let is_one_colour = samples.iter().all(|sample| is_equal(sample, &samples[0]));
    let leaves = |line: &RubricItem| found.iter().all(|found| assignment.keeps(found, line) > 0.0);
    let mut colours = assignment.rubric.iter().filter(|line| !assignment.judges_position(line));
    found.iter().any(|found| found.parameter.is_some())
        || is_one_colour && colours.any(|line| leaves(line) && varies(assignment, probes, &line.judges))
}

/// Whether each frame that is wrong has a vertex at which the last digits decide what a right answer shows.
pub fn are_at_steps(assignment: &Assignment, frames: &[FrameResult]) -> bool {
    let poses = assignment.scene.all_poses();
    poses.iter().zip(frames).filter(|(_, frame)| !frame.agrees()).all(|(pose, _)| assignment.has_a_step_at(pose))
}

/// Whether the mistakes leave nothing of the colour, so that they cannot draw a right picture.
pub fn leaves_nothing(assignment: &Assignment, found: &[FoundMistake]) -> bool {
    let mut colours = assignment.rubric.iter().filter(|line| !assignment.judges_position(line));
    colours.all(|line| !found.iter().all(|found| assignment.keeps(found, line) > 0.0))
}

/// Whether a definition of the right equation has different values at the probes.
fn varies(assignment: &Assignment, probes: &ProbeSet, definition: &str) -> bool {
    let right = assignment.equation.right();
    let mut values = probes.iter().filter_map(|probe| {
        let outcome = right.evaluate(&probes.groups.get(probe.group)?.uniforms, &probe.attributes);
        outcome.get(definition).map(|value| value.numbers().to_vec())
    });
    let Some(first) = values.next() else { return false };
    values.any(|other| first.iter().zip(&other).any(|(a, b)| (a - b).abs() > COLOUR_TOLERANCE))
}
