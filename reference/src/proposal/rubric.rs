//! Lines of the rubric: parts of the solution that show by themselves when they are taken out. Each is tried.

mod labels;
mod parts;

use super::FolderPlan;
use super::writing::quoted;
use crate::fit;
use crate::interpreter::Stage;
use crate::{Assignment, Text};
use labels::{in_sentences, is_telling, label};
use parts::terms_of;
use std::collections::HashSet;

/// Most lines that are proposed beside the one of the position.
const MOST_TERMS: usize = 6;

/// A line of the rubric.
#[derive(Clone, Debug)]
pub(super) struct ProposedLine {
    pub id: String,
    pub label: Text,
    /// The label as a sentence has it: a name of the solution that no word is known for is code there.
    pub in_sentences: Text,
    pub judges: Option<String>,
    /// What the part is called in the solution.
    local: Option<String>,
    pub without: Option<TextChange>,
}

/// One text of the solution, and what stands in its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct TextChange {
    from: String,
    to: String,
}

impl TextChange {
    /// As a variant.
    pub fn text(&self) -> String {
        format!("{{ replace = [[{}, {}]] }}", quoted(&self.from), quoted(&self.to))
    }
}

/// Lines that every solution has: the colour, and where vertices are moved, the shape.
pub(super) fn plain(plan: &mut FolderPlan) {
    let mut lines = Vec::new();
    if plan.hands_in(Stage::Vertex) {
        lines.push(line("shape", Some("gl_Position")));
    }
    lines.push(line("colour", None));
    plan.rubric = lines;
}

fn line(id: &str, judges: Option<&str>) -> ProposedLine {
    ProposedLine {
        id: id.to_owned(),
        label: label(id),
        in_sentences: in_sentences(id),
        judges: judges.map(str::to_owned),
        local: None,
        without: None,
    }
}

/// Puts lines for parts in the place of the line of the colour, or beside it where there is only one, or where they leave much
/// of the picture to no line.
pub(super) fn refine(plan: &mut FolderPlan) {
    let base = plan.rubric.clone();
    let shape: Vec<ProposedLine> = base.iter().filter(|line| line.id == "shape").cloned().collect();
    let mut terms = terms(plan);
    while !terms.is_empty() {
        let before: &[ProposedLine] = if terms.len() == 1 { &base } else { &shape };
        plan.rubric = before.iter().chain(&terms).cloned().collect();
        let Ok(assignment) = Assignment::load(plan.folder()) else {
            let at = broken(plan, before, &terms);
            terms.remove(at);
            continue;
        };
        let probes = assignment.judging_probes();
        let alternatives = fit::Alternatives::new(&assignment, &probes);
        let footprints = fit::Footprints::of(&alternatives, fit::TOLERANCE);
        if let Some(at) = worst(plan, before.len(), &terms, &alternatives, &footprints) {
            terms.remove(at);
            continue;
        }
        // An answer may be wrong at many probes, and right by every line.
        if footprints.unjudged(&alternatives).len() >= fit::FEWEST {
            plan.rubric = base.iter().chain(&terms).cloned().collect();
        }
        return by_definitions(plan);
    }
    plan.rubric = base;
}

/// Names the definition that a line judges, where the solution has one of its name: a hand-in's own value is looked up then.
fn by_definitions(plan: &mut FolderPlan) {
    let Ok(assignment) = Assignment::load(plan.folder()) else { return };
    let equation = &assignment.equation;
    let is_term = |name: &&String| equation.index(name).is_some_and(|definition| definition != equation.colour());
    for line in plan.rubric.iter_mut().filter(|line| line.judges.is_none()) {
        line.judges = line.local.as_ref().filter(is_term).cloned();
    }
}

/// One of these without which the solution is no program: each is tried alone.
fn broken(plan: &mut FolderPlan, before: &[ProposedLine], terms: &[ProposedLine]) -> usize {
    let mut loads = |term: &ProposedLine| {
        plan.rubric = before.iter().chain([term]).cloned().collect();
        Assignment::load(plan.folder()).is_ok()
    };
    terms.iter().position(|term| !loads(term)).unwrap_or(terms.len() - 1)
}

/// One of these, which stand behind so many other lines, that cannot be a line: it shows nothing, or what another shows.
fn worst(
    plan: &FolderPlan,
    before: usize,
    terms: &[ProposedLine],
    alternatives: &fit::Alternatives<'_>,
    footprints: &fit::Footprints,
) -> Option<usize> {
    let fit::Alternatives { assignment, probes, .. } = *alternatives;
    if let Some(weak) = footprints.lines().find(|line| footprints.of_line(*line).len() < fit::FEWEST) {
        return weak.checked_sub(before);
    }
    // What leaves the colour open shows another picture on each machine.
    let is_open = |line: &usize| {
        let shown = alternatives.without(*line).unwrap_or_default();
        2 * shown.iter().filter(|(colour, _)| colour.is_nan()).count() > shown.len()
    };
    if let Some(open) = (0..assignment.features.len()).find(is_open) {
        return open.checked_sub(before);
    }
    // What moves vertices is judged by the line of the shape.
    let moves = |line: &usize| {
        let mut shown = alternatives.without(*line).unwrap_or_default().iter().zip(&probes.probes);
        shown.any(|((_, position), probe)| (*position - probe.position).abs().max_element() > fit::TOLERANCE)
    };
    if plan.hands_in(Stage::Vertex)
        && let Some(moving) = (0..assignment.features.len()).find(moves)
    {
        return moving.checked_sub(before);
    }
    let alike = fit::alike(alternatives, fit::TOLERANCE);
    let (name, _) = alike.first()?;
    let found = terms.iter().position(|term| name.contains(&format!("`no-{}`", term.id)));
    Some(found.unwrap_or(terms.len() - 1))
}

/// What the lines are.
pub(super) fn tell(plan: &mut FolderPlan) {
    let ids: Vec<_> = plan.rubric.iter().map(|line| format!("`{}`", line.id)).collect();
    let ids = ids.join(", ");
    let is_split = plan.rubric.iter().any(|line| line.without.is_some());
    match is_split {
        true => plan.guessed(
            format!("rubric: {ids}: parts of the colour that show when they are taken out of the solution"),
            format!("rubric: {ids}: 解答から取り除くと画像が変わる部分"),
        ),
        false => plan.guessed(
            format!("rubric: {ids}: the solution was not taken apart; write more lines with `without`"),
            format!("rubric: {ids}: 解答を部分に分けられませんでした。`without` で行を増やせます"),
        ),
    }
}

/// Parts of the solution that may be lines, in its order.
fn terms(plan: &FolderPlan) -> Vec<ProposedLine> {
    let all: String = plan.sources.iter().map(|source| source.text.as_str()).collect();
    let mut terms: Vec<(String, TextChange, HashSet<String>)> = Vec::new();
    for source in &plan.sources {
        for (name, change, uses) in terms_of(source) {
            let is_once = all.matches(change.from.as_str()).count() == 1;
            let is_known = terms.iter().any(|(known, other, _)| *known == name || *other == change);
            if is_once && !is_known {
                terms.push((name, change, uses));
            }
        }
    }
    // A sum of parts that are lines is no line.
    let names: Vec<String> = terms.iter().map(|(name, ..)| name.clone()).collect();
    terms.retain(|(name, _, uses)| !names.iter().any(|other| other != name && uses.contains(other)));
    terms.truncate(MOST_TERMS);
    let line = |(name, change, _): (String, TextChange, HashSet<String>)| {
        let id = super::id_of(&name.replace('_', "-"));
        let (label, in_sentences) = (label(&name), in_sentences(&name));
        ProposedLine { label, in_sentences, id, judges: None, local: Some(name), without: Some(change) }
    };
    let mut lines: Vec<ProposedLine> = terms.into_iter().map(line).collect();
    let mut ids = HashSet::from(["shape".to_owned()]);
    lines.retain(|line| ids.insert(line.id.clone()));
    lines
}
