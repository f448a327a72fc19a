//! Whole programs in place of forms: what a mistake's program shows, and what shows of a feature by itself.

use super::{TermJudgement, Worst, agrees};
use crate::Assignment;
use crate::accepted::AcceptedAnswer;
use crate::mistake::FoundMistake;
use crate::probes::ProbeSet;
use glam::{DVec3, DVec4};

/// The first mistake whose program shows what the samples show, in colour and, as far as it is known, in place.
///
/// `is_there`: whether a sample's position is a given one.
pub fn program_of(
    assignment: &Assignment,
    probes: &ProbeSet,
    samples: &[[f64; 3]],
    is_there: &dyn Fn(usize, DVec4) -> bool,
    tolerance: f64,
) -> Option<FoundMistake> {
    let samples = super::padded(probes, samples);
    assignment.mistakes.iter().find_map(|mistake| {
        let shows = |number: &usize| {
            let computed = assignment.computed_by(&mistake.variants[*number], probes);
            computed.iter().zip(&samples).enumerate().all(|(place, ((colour, position), sample))| {
                agrees(*colour, *sample, tolerance) && is_there(place, *position)
            })
        };
        let found = (0..mistake.variants.len()).find(shows)?;
        Some(FoundMistake { id: mistake.id.clone(), form: mistake.forms.len() + found, parameter: None })
    })
}

/// Where a line's feature shows.
#[derive(Clone, Debug)]
pub struct Footprint {
    /// The line's place in the rubric.
    pub line: usize,
    /// At how many probes the solution without the feature differs from the solution.
    pub shows: usize,
    /// Those of them at which the solution without any other feature does not differ.
    pub alone: Vec<usize>,
}

/// The footprints of all lines that have a feature.
pub fn footprints(assignment: &Assignment, probes: &ProbeSet, tolerance: f64) -> Vec<Footprint> {
    let differs = |feature: &Option<AcceptedAnswer>| Some(differs(assignment, feature.as_ref()?, probes, tolerance));
    let shows: Vec<Option<Vec<bool>>> = assignment.features.iter().map(differs).collect();
    let footprint = |(line, own): (usize, &Option<Vec<bool>>)| {
        let own = own.as_ref()?;
        let is_alone = |place: &usize| {
            let mut others = shows.iter().enumerate().filter(|(other, _)| *other != line);
            own[*place] && !others.any(|(_, other)| other.as_ref().is_some_and(|other| other[*place]))
        };
        let shows = own.iter().filter(|differs| **differs).count();
        Some(Footprint { line, shows, alone: (0..own.len()).filter(is_alone).collect() })
    };
    shows.iter().enumerate().filter_map(footprint).collect()
}

/// At which probes a program shows another colour than what is right.
fn differs(assignment: &Assignment, program: &AcceptedAnswer, probes: &ProbeSet, tolerance: f64) -> Vec<bool> {
    let computed = assignment.computed_by(program, probes);
    computed.iter().zip(probes).map(|((colour, _), probe)| !agrees(probe.colour, *colour, tolerance)).collect()
}

/// The mistakes whose programs show what the solution shows, or what another mistake's do: what stands for each, and what it is like.
pub fn alike(assignment: &Assignment, probes: &ProbeSet, tolerance: f64) -> Vec<(String, Option<String>)> {
    type Shown = Vec<(DVec3, DVec4)>;
    let same = |a: &Shown, b: &Shown| {
        let is_there =
            |a: &DVec4, b: &DVec4| (*a - *b).abs().max_element() <= tolerance * a.abs().max_element().max(1.0);
        a.iter().zip(b).all(|(a, b)| agrees(a.0, b.0, tolerance) && is_there(&a.1, &b.1))
    };
    let right: Shown = probes.iter().map(|probe| (probe.colour, probe.position)).collect();
    let mut known: Vec<(&str, Shown)> = Vec::new();
    let mut alike = Vec::new();
    for program in assignment.mistakes.iter().flat_map(|mistake| &mistake.variants) {
        let shown = assignment.computed_by(program, probes);
        if same(&right, &shown) {
            alike.push((program.name.clone(), None));
        } else if let Some((other, _)) = known.iter().find(|(_, other)| same(other, &shown)) {
            alike.push((program.name.clone(), Some((*other).to_owned())));
        }
        known.push((&program.name, shown));
    }
    alike
}

/// A feature that shows by itself at fewer probes than this is not judged by them.
pub const FEWEST: usize = 8;

/// The lines whose features show by themselves at some probes, see [`footprints`].
pub fn judge_features(
    assignment: &Assignment,
    probes: &ProbeSet,
    samples: &[[f64; 3]],
    tolerance: f64,
) -> Vec<TermJudgement> {
    let samples = super::padded(probes, samples);
    let judgement = |Footprint { line, alone, .. }: Footprint| {
        if alone.len() < FEWEST {
            return None;
        }
        let apart = |place: &usize| {
            let apart = (samples[*place] - probes.probes[*place].colour).abs().max_element();
            if apart.is_finite() { apart } else { f64::INFINITY }
        };
        let is_wrong = |place: &&usize| !agrees(probes.probes[**place].colour, samples[**place], tolerance);
        let wrong: Vec<usize> = alone.iter().filter(is_wrong).copied().collect();
        let worst = wrong.iter().copied().max_by(|a, b| apart(a).total_cmp(&apart(b))).map(|probe| Worst {
            probe,
            region: probes.probes[probe].region,
            expected: probes.probes[probe].colour,
            found: samples[probe],
        });
        let (judged, matched) = (alone.len(), alone.len() - wrong.len());
        Some(TermJudgement { line: assignment.rubric[line].id.clone(), judged, matched, worst })
    };
    footprints(assignment, probes, tolerance).into_iter().filter_map(judgement).collect()
}

/// What is shown with these mistakes in it, where one of them is a whole program.
pub(super) fn shown_with(assignment: &Assignment, found: &[FoundMistake], probes: &ProbeSet) -> Option<Vec<DVec3>> {
    let [found] = found else { return None };
    let program = assignment.mistake(&found.id)?.program(found.form)?;
    Some(assignment.computed_by(program, probes).into_iter().map(|(colour, _)| colour).collect())
}
