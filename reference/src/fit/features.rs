//! Whole programs in place of forms: what a mistake's program shows, and what shows of a feature by itself.

use super::{Alternatives, TermJudgement, Worst, agrees};
use crate::Assignment;
use crate::accepted::Computed;
use crate::equation::DISCARDED;
use crate::mistake::FoundMistake;
use crate::probes::ProbeSet;
use glam::{DVec3, DVec4};

/// The first mistake whose program shows what the samples show, in colour and, as far as it is known, in place.
///
/// `is_there`: whether a sample's position is a given one.
pub fn program_of(
    alternatives: &Alternatives<'_>,
    samples: &[[f64; 3]],
    is_there: &dyn Fn(usize, DVec4) -> bool,
    tolerance: f64,
) -> Option<FoundMistake> {
    let samples = super::padded(alternatives.probes, samples);
    let shows = |computed: &[Computed]| {
        computed.iter().zip(&samples).enumerate().all(|(place, ((colour, position), sample))| {
            agrees(*colour, *sample, tolerance) && is_there(place, *position)
        })
    };
    let mut programs = alternatives.programs();
    programs.find(|(_, _, computed)| shows(computed)).map(|(found, ..)| found.clone())
}

/// Where the features of the rubric show: at which probes the solution without one differs from the solution.
#[derive(Clone, Debug)]
pub struct Footprints {
    /// For each line of the rubric and each probe; none for a line without a feature.
    shows: Vec<Option<Vec<bool>>>,
}

impl Footprints {
    /// Looks at all features of an assignment.
    pub fn of(alternatives: &Alternatives<'_>, tolerance: f64) -> Self {
        let differs = |computed: &[Computed]| {
            let pairs = computed.iter().zip(alternatives.probes);
            pairs.map(|((colour, _), probe)| !agrees(probe.colour, *colour, tolerance)).collect()
        };
        let lines = 0..alternatives.assignment.features.len();
        Self { shows: lines.map(|line| alternatives.without(line).map(differs)).collect() }
    }

    /// The lines that have a feature, in the rubric's order.
    pub fn lines(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.shows.len()).filter(|line| self.shows[*line].is_some())
    }

    /// The probes at which a line's feature shows.
    pub fn of_line(&self, line: usize) -> Vec<usize> {
        self.beside(line, &|_| true)
    }

    /// The probes at which a line's feature shows beside no other than those that are known to be right.
    fn beside(&self, line: usize, is_right: &dyn Fn(usize) -> bool) -> Vec<usize> {
        let Some(Some(own)) = self.shows.get(line) else { return Vec::new() };
        let others: Vec<&Vec<bool>> = self
            .shows
            .iter()
            .enumerate()
            .filter_map(|(other, shows)| shows.as_ref().filter(|_| other != line && !is_right(other)))
            .collect();
        (0..own.len()).filter(|place| own[*place] && !others.iter().any(|other| other[*place])).collect()
    }

    /// The lines that can be judged, in an order in which each shows by itself beside those before it, with the probes at
    /// which it is judged. `agrees`: whether a probe shows what is right; what differs is beside no other line.
    pub fn judged(&self, agrees: &dyn Fn(usize) -> bool) -> Vec<(usize, Vec<usize>)> {
        let mut judged: Vec<(usize, Vec<usize>)> = Vec::new();
        let mut right: Vec<usize> = Vec::new();
        loop {
            let open = self.lines().filter(|line| !judged.iter().any(|(known, _)| known == line));
            let places = open.map(|line| (line, self.beside(line, &|other| right.contains(&other))));
            let Some((line, places)) = places.into_iter().find(|(_, places)| places.len() >= FEWEST) else {
                return judged;
            };
            if places.iter().all(|place| agrees(*place)) {
                right.push(line);
            }
            judged.push((line, places));
        }
    }
}

/// The mistakes whose programs show what the solution shows, or what another mistake's do: what stands for each, and what it is like.
pub fn alike(alternatives: &Alternatives<'_>, tolerance: f64) -> Vec<(String, Option<String>)> {
    let same = |a: &[Computed], b: &[Computed]| {
        let is_there =
            |a: &DVec4, b: &DVec4| (*a - *b).abs().max_element() <= tolerance * a.abs().max_element().max(1.0);
        a.iter().zip(b).all(|(a, b)| agrees(a.0, b.0, tolerance) && is_there(&a.1, &b.1))
    };
    let right = alternatives.right();
    let mut known: Vec<(&str, &[Computed])> = Vec::new();
    let mut alike = Vec::new();
    for (_, program, shown) in alternatives.programs() {
        if same(&right, shown) {
            alike.push((program.name.clone(), None));
        } else if let Some((other, _)) = known.iter().find(|(_, other)| same(other, shown)) {
            alike.push((program.name.clone(), Some((*other).to_owned())));
        }
        known.push((&program.name, shown));
    }
    alike
}

/// A feature that shows by itself at fewer probes than this is not judged by them.
pub const FEWEST: usize = 8;

/// The lines with a feature, judged where it shows by itself, or beside such as are right, see [`Footprints::judged`]; a line that
/// cannot be judged is right at none of no probes.
pub fn judge_features(alternatives: &Alternatives<'_>, samples: &[[f64; 3]], tolerance: f64) -> Vec<TermJudgement> {
    let Alternatives { assignment, probes, .. } = *alternatives;
    let samples = super::padded(probes, samples);
    let is_right = |place: usize| agrees(probes.probes[place].colour, samples[place], tolerance);
    let judgement = |(line, places): (usize, Vec<usize>)| {
        let apart = |place: &usize| {
            let apart = (samples[*place] - probes.probes[*place].colour).abs().max_element();
            if apart.is_finite() { apart } else { f64::INFINITY }
        };
        let wrong: Vec<usize> = places.iter().filter(|place| !is_right(**place)).copied().collect();
        let shown = |probe: usize| Worst {
            probe,
            region: probes.probes[probe].region,
            expected: probes.probes[probe].colour,
            found: samples[probe],
        };
        let worst = wrong.iter().copied().max_by(|a, b| apart(a).total_cmp(&apart(b))).map(&shown);
        // What throws away has thrown away too much where nothing should be.
        let throws_away = places.iter().any(|place| probes.probes[*place].colour == DISCARDED);
        let too_much = || (0..samples.len()).find(|at| samples[*at] == DISCARDED && !is_right(*at));
        let worst = worst.or_else(|| throws_away.then(too_much).flatten().map(&shown));
        let matched = (places.len() - wrong.len()).saturating_sub(usize::from(wrong.is_empty() && worst.is_some()));
        let judged = places.len();
        TermJudgement { line: assignment.rubric[line].id.clone(), judged, matched, worst }
    };
    let footprints = Footprints::of(alternatives, tolerance);
    let judged = footprints.judged(&is_right);
    let open = footprints.lines().filter(|line| !judged.iter().any(|(known, _)| known == line));
    let open: Vec<_> = open.map(|line| (line, Vec::new())).collect();
    judged.into_iter().chain(open).map(judgement).collect()
}

/// What is shown with these mistakes in it, where one of them is a whole program.
pub(super) fn shown_with(assignment: &Assignment, found: &[FoundMistake], probes: &ProbeSet) -> Option<Vec<DVec3>> {
    let [found] = found else { return None };
    let program = assignment.mistake(&found.id)?.program(found.form)?;
    Some(assignment.computed_by(program, probes).into_iter().map(|(colour, _)| colour).collect())
}
