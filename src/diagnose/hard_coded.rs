//! Colours that are looked up instead of computed.

use crate::compare::COLOUR_TOLERANCE;
use crate::render::Sample;
use reference::Assignment;
use reference::assignment::RubricLine;
use reference::mistake::Found;
use reference::probes::ProbeSet;
use std::ops::Range;

/// Whether the colour depends on nothing but the matrices and the vertex number, as a table does: it stays the same, number
/// by number, when all attributes change.
pub fn is_lookup(probes: &ProbeSet, samples: &[Sample]) -> bool {
    probes.with_other_vertices().is_some_and(|groups| stays_the_same(groups, samples))
}

/// Whether the colour stays the same, vertex by vertex, when only the normals change.
pub fn ignores_normals(probes: &ProbeSet, samples: &[Sample]) -> bool {
    probes.with_other_normals().is_some_and(|groups| stays_the_same(groups, samples))
}

fn stays_the_same(groups: [Range<usize>; 2], samples: &[Sample]) -> bool {
    let [one, other] = groups.map(|places| samples.get(places).unwrap_or_default());
    !one.is_empty() && one.len() == other.len() && one.iter().zip(other).all(|(a, b)| same(a, b))
}

fn same(a: &Sample, b: &Sample) -> bool {
    a.colour_f64().iter().zip(b.colour_f64()).all(|(x, y)| (x - y).abs() <= COLOUR_TOLERANCE)
}

/// Whether these mistakes explain a looked-up colour by chance: they were fitted to it, or it is the same everywhere
/// and they would leave points to a term that varies, of which it shows nothing. (Black is also a product with one factor
/// missing, and white is everything added up.)
pub fn is_coincidence(assignment: &Assignment, probes: &ProbeSet, samples: &[Sample], found: &[Found]) -> bool {
    let is_one_colour = samples.iter().all(|sample| same(sample, &samples[0]));
    let leaves = |line: &RubricLine| found.iter().all(|found| assignment.keeps(found, line) > 0.0);
    let mut colours = assignment.rubric.iter().filter(|line| line.id != super::SHAPE);
    found.iter().any(|found| found.parameter.is_some())
        || is_one_colour && colours.any(|line| leaves(line) && varies(assignment, probes, &line.judges))
}

/// Whether the mistakes leave nothing of the colour, so that they cannot draw a right picture.
pub fn leaves_nothing(assignment: &Assignment, found: &[Found]) -> bool {
    let mut colours = assignment.rubric.iter().filter(|line| line.id != super::SHAPE);
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
