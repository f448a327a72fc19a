//! Known mistakes that are whole programs: one with a number of the text or with what is a matter of taste, or two at once.

use super::taste::is_explained;
use super::{Alternatives, agrees};
use crate::Assignment;
use crate::accepted::{AcceptedAnswer, Computed};
use crate::mistake::FoundMistake;
use crate::probes::Probe;
use glam::{DVec3, DVec4};

/// So many mistakes and so many pairs are run, those first that fit best by what each of them shows alone: some 3 ms each, and ten
/// times that where much is a matter of taste.
const MOST_ALONE: usize = 12;
const MOST_PAIRS: usize = 40;

/// What contradicts more than this share of the samples is not run: by what a mistake shows alone, where it need not be what it is
/// with another one or with what is a matter of taste.
const CONTRADICTED: f64 = 0.6;

/// A mistake that is a program, and what it shows alone.
struct Alone<'p> {
    found: FoundMistake,
    /// Its place among the mistakes.
    mistake: usize,
    /// The lines of the rubric that it costs points, as bits.
    lines: u64,
    /// Where it shows something else than what is right, and where it shows what the samples do.
    moved: Vec<bool>,
    agrees: Vec<bool>,
    shown: &'p [Computed],
}

/// One or two mistakes whose program shows what the samples show, the fewest first.
///
/// `numbers`: those of the student's text. `is_there`: whether a sample's position is a given one.
pub fn programs_of(
    alternatives: &Alternatives<'_>,
    samples: &[[f64; 3]],
    numbers: &[f64],
    is_there: &dyn Fn(usize, DVec4) -> bool,
    tolerance: f64,
) -> Option<Vec<FoundMistake>> {
    let Alternatives { assignment, probes, .. } = *alternatives;
    let samples = super::padded(probes, samples);
    let explains = |found: &Vec<FoundMistake>| is_explained(assignment, found, probes, &samples, is_there, tolerance);
    let all: Vec<Alone> =
        alternatives.programs().filter_map(|program| alone(alternatives, program, &samples, tolerance)).collect();
    let most = (CONTRADICTED * samples.len() as f64) as usize;
    if !assignment.unjudged.is_empty() {
        let is_plain = |one: &&Alone| one.found.parameter.is_none();
        let mut likely: Vec<(usize, &Alone)> = all
            .iter()
            .filter(is_plain)
            .map(|one| (one.agrees.iter().filter(|agrees| !**agrees).count(), one))
            .collect();
        likely.retain(|(contradicted, _)| *contradicted <= most);
        likely.sort_by_key(|(contradicted, one)| (*contradicted, one.mistake));
        let found = likely.iter().take(MOST_ALONE).map(|(_, one)| vec![one.found.clone()]).find(&explains);
        if found.is_some() {
            return found;
        }
    }
    if let Some(found) = all.iter().flat_map(|one| with_numbers(assignment, one, numbers)).find(&explains) {
        return Some(found);
    }
    let is_plain = |one: &&Alone| has_its_number(one, numbers) && !is_doubtful(one, &all, tolerance);
    let all: Vec<&Alone> = all.iter().filter(is_plain).collect();
    let is_right: Vec<bool> =
        probes.iter().zip(&samples).map(|(probe, sample)| agrees(probe.colour, *sample, tolerance)).collect();
    let mut likely: Vec<(usize, &Alone, &Alone)> = Vec::new();
    for (at, first) in all.iter().enumerate() {
        for second in all[at + 1..].iter().filter(|second| fits(first, second)) {
            // Where one of them changes nothing, the other one is what shows.
            let is_contradicted = |place: &usize| match (first.moved[*place], second.moved[*place]) {
                (false, false) => !is_right[*place],
                (true, false) => !first.agrees[*place],
                (false, true) => !second.agrees[*place],
                (true, true) => false,
            };
            let contradicted = (0..samples.len()).filter(is_contradicted).count();
            if contradicted <= most {
                likely.push((contradicted, *first, *second));
            }
        }
    }
    let lines = |first: &Alone, second: &Alone| first.lines.count_ones() + second.lines.count_ones();
    likely.sort_by_key(|(contradicted, a, b)| (*contradicted, lines(a, b), a.mistake, b.mistake));
    let pairs = likely.into_iter().take(MOST_PAIRS);
    pairs.map(|(_, first, second)| vec![first.found.clone(), second.found.clone()]).find(explains)
}

/// Whether the number of a mistake stands in the text, where it has one.
fn has_its_number(one: &Alone, numbers: &[f64]) -> bool {
    one.found.parameter.is_none_or(|own| numbers.contains(&own))
}

/// A mistake with each of these numbers that may stand for its own.
fn with_numbers(assignment: &Assignment, one: &Alone, numbers: &[f64]) -> Vec<Vec<FoundMistake>> {
    let fit = assignment.mistake(&one.found.id).and_then(|mistake| mistake.fit.as_ref());
    let Some(fit) = fit.filter(|_| one.found.parameter.is_some()) else { return Vec::new() };
    let fitting = numbers.iter().filter(|number| (fit.from..=fit.to).contains(number));
    fitting.map(|number| vec![FoundMistake { parameter: Some(*number), ..one.found.clone() }]).collect()
}

/// Nothing of a mistake that is no program which replaces texts of the solution.
fn alone<'p>(
    alternatives: &Alternatives<'_>,
    (found, program, shown): (&FoundMistake, &AcceptedAnswer, &'p [Computed]),
    samples: &[DVec3],
    tolerance: f64,
) -> Option<Alone<'p>> {
    let Alternatives { assignment, probes, .. } = *alternatives;
    if program.replaced.is_empty() {
        return None;
    }
    let moved = |(probe, (colour, _)): (&Probe, &Computed)| !agrees(probe.colour, *colour, tolerance);
    let agreeing = |(sample, (colour, _)): (&DVec3, &Computed)| agrees(*colour, *sample, tolerance);
    Some(Alone {
        mistake: assignment.mistakes.iter().position(|mistake| mistake.id == found.id)?,
        lines: lines(assignment, found),
        moved: probes.iter().zip(shown).map(moved).collect(),
        agrees: samples.iter().zip(shown).map(agreeing).collect(),
        found: found.clone(),
        shown,
    })
}

/// The lines that a mistake costs points, as bits.
fn lines(assignment: &Assignment, found: &FoundMistake) -> u64 {
    let rubric = assignment.rubric.iter().enumerate();
    rubric.filter(|(_, line)| assignment.keeps(found, line) < 1.0).map(|(place, _)| 1 << place).sum()
}

/// Two mistakes that cost points of different lines: of two in one place much is explained by chance.
fn fits(first: &Alone, second: &Alone) -> bool {
    first.mistake != second.mistake && first.lines & second.lines == 0
}

/// Whether another mistake shows the same: then nothing tells which of them stands in a pair. Without a shadow and with its place in
/// another space nothing lies in shadow, and each with the comparison inverted explains whatever puts all in shadow.
fn is_doubtful(one: &Alone, all: &[Alone], tolerance: f64) -> bool {
    let is_same = |other: &&Alone| {
        other.mistake != one.mistake
            && one.shown.iter().zip(other.shown).all(|((own, _), (other, _))| agrees(*own, *other, tolerance))
    };
    all.iter().any(|other| is_same(&other))
}
