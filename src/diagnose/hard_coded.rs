//! Colours that are looked up instead of computed.

use crate::compare::COLOUR_TOLERANCE;
use crate::render::Sample;
use reference::mistake::Found;
use reference::probes::ProbeSet;
use reference::{Assignment, Value};

/// Whether the colour does not depend on the attributes, or not on the matrices, although a right answer's does: the
/// same everywhere in a group of one camera, or the same for one vertex number under every camera.
pub fn is_lookup(probes: &ProbeSet, samples: &[Sample]) -> bool {
    let groups = probes.groups.len();
    if groups < 2 || samples.len() < 2 * groups {
        return false;
    }
    let each = samples.len() / groups;
    let within_group = samples.chunks_exact(each).all(|group| group.iter().all(|sample| same(sample, &group[0])));
    let by_number = samples.chunks_exact(each).all(|group| group.iter().zip(samples).all(|(a, b)| same(a, b)));
    within_group || by_number
}

fn same(a: &Sample, b: &Sample) -> bool {
    a.colour_f64().iter().zip(b.colour_f64()).all(|(x, y)| (x - y).abs() <= COLOUR_TOLERANCE)
}

/// Whether these mistakes explain a looked-up colour by chance: they were fitted to it, or it is the same everywhere
/// and they would leave points to a term that varies, of which it shows nothing. (Black is also a product with one factor
/// missing, and white is everything added up.)
pub fn is_coincidence(assignment: &Assignment, probes: &ProbeSet, samples: &[Sample], found: &[Found]) -> bool {
    let is_one_colour = samples.iter().all(|sample| same(sample, &samples[0]));
    let leaves = |line: &str| found.iter().all(|found| keeps(assignment, found, line));
    let mut colours = assignment.rubric.iter().filter(|line| line.id != super::SHAPE);
    found.iter().any(|found| found.parameter.is_some())
        || is_one_colour && colours.any(|line| leaves(&line.id) && varies(assignment, probes, &line.judges))
}

/// Whether the mistakes leave nothing of the colour, so that they cannot draw a right picture.
pub fn leaves_nothing(assignment: &Assignment, found: &[Found]) -> bool {
    let mut colours = assignment.rubric.iter().filter(|line| line.id != super::SHAPE);
    colours.all(|line| !found.iter().all(|found| keeps(assignment, found, &line.id)))
}

fn keeps(assignment: &Assignment, found: &Found, line: &str) -> bool {
    assignment.mistake(&found.id).is_none_or(|mistake| mistake.keeps(line) > 0.0)
}

/// Whether a definition of the right equation has different values at the probes.
fn varies(assignment: &Assignment, probes: &ProbeSet, definition: &str) -> bool {
    let right = assignment.equation.right();
    let mut values = probes.iter().filter_map(|probe| {
        let outcome = right.evaluate(&probes.groups.get(probe.group)?.uniforms, &probe.attributes);
        outcome.get(definition).as_ref().map(Value::numbers)
    });
    let Some(first) = values.next() else { return false };
    values.any(|other| first.iter().zip(&other).any(|(a, b)| (a - b).abs() > COLOUR_TOLERANCE))
}
