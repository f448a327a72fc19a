//! Whole programs in place of forms: what a mistake's program shows, and what shows of a feature by itself.

use super::parts::FULL;
use super::{Alternatives, TermJudgement, Worst, agrees, channel_agrees};
use crate::Assignment;
use crate::accepted::Computed;
use crate::equation::{DISCARDED, Reads};
use crate::mistake::FoundMistake;
use crate::probes::{Probe, ProbeSet};
use glam::{DVec3, DVec4};

/// The mistakes whose programs show what the samples show, in colour and, as far as it is known, in place; in the assignment's order. Each program is
/// run only when it is its turn.
///
/// `is_there`: whether a sample's position is a given one.
pub fn programs_showing(
    alternatives: &Alternatives<'_>,
    samples: &[[f64; 3]],
    is_there: &dyn Fn(usize, DVec4) -> bool,
    tolerance: f64,
) -> impl Iterator<Item = FoundMistake> {
    let samples = super::padded(alternatives.probes, samples);
    let shows = move |computed: &[Computed]| {
        computed.iter().zip(&samples).enumerate().all(|(place, ((colour, position), sample))| {
            agrees(*colour, *sample, tolerance) && is_there(place, *position)
        })
    };
    // A number is taken from the text.
    let programs = alternatives.programs().filter(|(found, ..)| found.parameter.is_none());
    programs.filter(move |(_, _, computed)| shows(computed)).map(|(found, ..)| found.clone())
}

/// A channel at a probe: their places.
pub type ProbeChannel = (usize, usize);

/// Where the features of the rubric show: in which channels at which probes the solution without one differs from the solution.
#[derive(Clone, Debug)]
pub struct Footprints {
    /// For each line of the rubric and each probe the channels; `None` for a line without a feature.
    shows: Vec<Option<Vec<[bool; 3]>>>,
    /// The line of the rubric that judges what no feature shows, where there is one.
    rest: Option<usize>,
    /// For each probe the channels that are not cut off.
    tells: Vec<[bool; 3]>,
}

/// A line of the rubric, judged by what shows it beside nothing that may be wrong.
#[derive(Clone, Debug)]
pub struct JudgedLine {
    /// Its place in the rubric.
    pub line: usize,
    /// Whether all agrees that it is judged by.
    pub is_right: bool,
    cells: Vec<ProbeChannel>,
}

impl JudgedLine {
    /// The probes that it is judged at.
    pub fn probes(&self) -> Vec<usize> {
        probes_of(&self.cells)
    }
}

fn probes_of(cells: &[ProbeChannel]) -> Vec<usize> {
    let mut probes: Vec<usize> = cells.iter().map(|(probe, _)| *probe).collect();
    probes.dedup();
    probes
}

impl Footprints {
    /// Looks at all features of an assignment.
    pub fn of(alternatives: &Alternatives<'_>, tolerance: f64) -> Self {
        // What is cut off at white is the same whatever is added to it.
        let is_clamped = alternatives.assignment.equation.reads() != Reads::Attributes;
        let tells = |channel: f64| !is_clamped || channel < FULL;
        let differs = |computed: &[Computed]| {
            let pairs = computed.iter().zip(alternatives.probes);
            let differs = |channel, probe: &Probe, colour: DVec3| {
                tells(probe.colour[channel]) && !channel_agrees(probe.colour[channel], colour[channel], tolerance)
            };
            pairs.map(|((colour, _), probe)| [0, 1, 2].map(|channel| differs(channel, probe, *colour))).collect()
        };
        let lines = 0..alternatives.assignment.features.len();
        let shows: Vec<_> = lines.map(|line| alternatives.without(line).map(differs)).collect();
        let rest = rest_of(alternatives.assignment, &shows);
        let tells = alternatives.probes.iter().map(|probe| probe.colour.to_array().map(tells)).collect();
        Self { shows, rest, tells }
    }

    /// The lines that have a feature, in the rubric's order.
    pub fn lines(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.shows.len()).filter(|line| self.shows[*line].is_some())
    }

    /// The probes at which nothing of the rubric shows, though every line but those of the position has a feature: what is wrong
    /// only there costs no points.
    pub fn unjudged(&self, alternatives: &Alternatives<'_>) -> Vec<usize> {
        let assignment = alternatives.assignment;
        if self.lines().next().is_none() || !without_feature(assignment, &self.shows).is_empty() {
            return Vec::new();
        }
        let is_shown = |place: usize| self.shows.iter().flatten().any(|shows| shows[place].contains(&true));
        // Where all is cut off at white, or thrown away, little can be wrong.
        let tells = |colour: DVec3| colour != DISCARDED && colour.min_element() < FULL;
        let probes = alternatives.probes.iter().enumerate().filter(|(_, probe)| tells(probe.colour));
        probes.map(|(place, _)| place).filter(|place| !is_shown(*place)).collect()
    }

    /// The probes at which a line's feature shows.
    pub fn of_line(&self, line: usize) -> Vec<usize> {
        probes_of(&self.beside(line, &|_| true))
    }

    /// Where a line's feature shows beside no other than those that are known to be right.
    fn beside(&self, line: usize, is_right: &dyn Fn(usize) -> bool) -> Vec<ProbeChannel> {
        let Some(Some(own)) = self.shows.get(line) else { return Vec::new() };
        let others: Vec<&Vec<[bool; 3]>> = self
            .shows
            .iter()
            .enumerate()
            .filter_map(|(other, shows)| shows.as_ref().filter(|_| other != line && !is_right(other)))
            .collect();
        let cells = (0..own.len()).flat_map(|probe| (0..3).map(move |channel| (probe, channel)));
        let is_alone = |(probe, channel): &ProbeChannel| {
            own[*probe][*channel] && !others.iter().any(|other| other[*probe][*channel])
        };
        cells.filter(is_alone).collect()
    }

    /// The lines that can be judged, in an order in which each shows by itself beside those before it. `agrees`: whether a
    /// channel at a probe shows what is right; what differs is beside no other line.
    pub fn judged(&self, agrees: &dyn Fn(ProbeChannel) -> bool) -> Vec<JudgedLine> {
        let mut judged: Vec<JudgedLine> = Vec::new();
        loop {
            let is_right = |line: usize| judged.iter().any(|known| known.line == line && known.is_right);
            let open = self.lines().filter(|line| !judged.iter().any(|known| known.line == *line));
            let cells = open.map(|line| (line, self.beside(line, &is_right)));
            let Some((line, cells)) = cells.into_iter().find(|(_, cells)| probes_of(cells).len() >= FEWEST) else {
                judged.extend(self.judged_rest(&judged, agrees));
                return judged;
            };
            judged.push(JudgedLine { line, is_right: cells.iter().all(|cell| agrees(*cell)), cells });
        }
    }

    /// The line of the rest, judged where no feature shows but such as are right: what is wrong elsewhere, another line may have
    /// been charged for.
    fn judged_rest(&self, judged: &[JudgedLine], agrees: &dyn Fn(ProbeChannel) -> bool) -> Option<JudgedLine> {
        let line = self.rest?;
        let is_right = |line: usize| judged.iter().any(|known| known.line == line && known.is_right);
        let doubtful: Vec<&Vec<[bool; 3]>> =
            self.lines().filter(|line| !is_right(*line)).filter_map(|line| self.shows[line].as_ref()).collect();
        // What is cut off may be wrong by any feature.
        let is_own = |(probe, channel): &ProbeChannel| {
            doubtful.is_empty() || self.tells[*probe][*channel] && !doubtful.iter().any(|shows| shows[*probe][*channel])
        };
        let all = (0..self.tells.len()).flat_map(|probe| (0..3).map(move |channel| (probe, channel)));
        let cells: Vec<ProbeChannel> = all.filter(is_own).collect();
        let is_right = cells.iter().all(|cell| agrees(*cell));
        (probes_of(&cells).len() >= FEWEST).then_some(JudgedLine { line, is_right, cells })
    }
}

/// The lines of the colour that have no feature.
fn without_feature(assignment: &Assignment, shows: &[Option<Vec<[bool; 3]>>]) -> Vec<usize> {
    let lines = (0..shows.len()).filter(|line| shows[*line].is_none());
    lines.filter(|line| !assignment.judges_position(&assignment.rubric[*line])).collect()
}

/// The only line beside features that judges no value of its own.
fn rest_of(assignment: &Assignment, shows: &[Option<Vec<[bool; 3]>>]) -> Option<usize> {
    let [line] = without_feature(assignment, shows)[..] else { return None };
    let judged = assignment.equation.index(&assignment.rubric[line].judges);
    let is_rest = judged.is_none_or(|judged| judged == assignment.equation.colour());
    (is_rest && shows.iter().any(Option::is_some)).then_some(line)
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
    let agrees = |(at, channel): ProbeChannel| {
        channel_agrees(probes.probes[at].colour[channel], samples[at][channel], tolerance)
    };
    let judgement = |line: usize, cells: &[ProbeChannel]| {
        let places = probes_of(cells);
        let apart = |place: &usize| {
            let apart = (samples[*place] - probes.probes[*place].colour).abs().max_element();
            if apart.is_finite() { apart } else { f64::INFINITY }
        };
        let wrong = probes_of(&cells.iter().filter(|cell| !agrees(**cell)).copied().collect::<Vec<_>>());
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
    let judged = footprints.judged(&agrees);
    let open = footprints.lines().filter(|line| !judged.iter().any(|known| known.line == *line));
    let open: Vec<TermJudgement> = open.map(|line| judgement(line, &[])).collect();
    judged.iter().map(|judged| judgement(judged.line, &judged.cells)).chain(open).collect()
}

/// What is shown with these mistakes in it, where one of them is a whole program.
pub(super) fn shown_with(assignment: &Assignment, found: &[FoundMistake], probes: &ProbeSet) -> Option<Vec<DVec3>> {
    let [found] = found else { return None };
    let program = assignment.mistake(&found.id)?.program(found.form)?;
    Some(assignment.computed_by(program, probes).into_iter().map(|(colour, _)| colour).collect())
}
