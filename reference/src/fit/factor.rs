//! A number that multiplies terms, such as a falloff or a cone: where it alone is wrong, the terms behind it are right.

use super::{FEWEST, TermJudgement, Worst, agrees, padded};
use crate::Assignment;
use crate::probes::ProbeSet;
use glam::DVec3;

/// What the number multiplies tells it only where it is brighter than this, in some channel.
const BRIGHT: f64 = 0.05;

/// The judgement of each line's part of the colour, where a wrong value of one judged number makes all that is wrong.
///
/// At each probe the sample is the right colour and a multiple of what the colour moves by with the number; three channels
/// say so. The number must not be 0 everywhere: then nothing behind it can be seen. `None` where no line is such a number.
pub fn judge_factor(
    assignment: &Assignment,
    probes: &ProbeSet,
    samples: &[[f64; 3]],
    tolerance: f64,
) -> Option<Vec<TermJudgement>> {
    let samples = padded(probes, samples);
    let parts = || assignment.rubric.iter().zip(&assignment.terms).filter(|(_, term)| term.is_some());
    let (factor, wrong) = parts().find_map(|(line, _)| {
        let definition = assignment.equation.index(&line.judges)?;
        Some((line, judged(assignment, probes, &samples, definition, tolerance)?))
            .filter(|(_, wrong)| !wrong.is_empty())
    })?;
    let worst = wrong.iter().max_by(|a, b| a.1.total_cmp(&b.1)).map(|(probe, _)| Worst {
        probe: *probe,
        region: probes.probes[*probe].region,
        expected: probes.probes[*probe].colour,
        found: samples[*probe],
    });
    let judgement = |id: &str| TermJudgement::right(id, samples.len());
    let of_factor = TermJudgement { matched: samples.len() - wrong.len(), worst, ..judgement(&factor.id) };
    Some(parts().map(|(line, _)| if line.id == factor.id { of_factor.clone() } else { judgement(&line.id) }).collect())
}

/// The probes at which another value of a number makes what is seen, and how far that is off; `None` where no number does.
fn judged(
    assignment: &Assignment,
    probes: &ProbeSet,
    samples: &[DVec3],
    definition: usize,
    tolerance: f64,
) -> Option<Vec<(usize, f64)>> {
    let name = &assignment.equation.definitions()[definition].name;
    let right = assignment.equation.right();
    let (mut wrong, mut telling) = (Vec::new(), 0);
    for (place, (probe, sample)) in probes.iter().zip(samples).enumerate() {
        let uniforms = probes.uniforms(probe);
        let outcome = right.evaluate(uniforms, &probe.attributes);
        let value = outcome.get(name).filter(|value| value.numbers().len() == 1)?.numbers()[0];
        let behind = right.moves(uniforms, &probe.attributes, definition, [1.0; 3]);
        let apart = *sample - probe.colour;
        let share = if behind.length_squared() > 0.0 { apart.dot(behind) / behind.length_squared() } else { 0.0 };
        if !agrees(probe.colour + behind * share, *sample, tolerance) {
            return None;
        }
        // Where little is behind the number, any number fits.
        telling += usize::from(behind.max_element() > BRIGHT && (value + share).abs() > tolerance);
        if !agrees(probe.colour, *sample, tolerance) {
            wrong.push((place, apart.abs().max_element()));
        }
    }
    (telling >= FEWEST).then_some(wrong)
}
