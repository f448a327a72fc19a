//! What an answer that is wrong somewhere keeps, for its text computes that right.

use crate::compare::{COLOUR_TOLERANCE, colour_difference};
use crate::diagnose::inside::{self, Finding};
use crate::diagnose::trials::{FUEL_OF_TRACE, place};
use crate::diagnose::{Evidence, addends};
use crate::render::Sample;
use glam::DVec3;
use reference::Assignment;
use reference::assignment::RubricItem;
use reference::derived::{definition, is_derived};
use reference::equation::{DISCARDED, Reads};
use reference::fit::TermJudgement;
use reference::interpreter::DISCARD;
use reference::mistake::FoundMistake;
use reference::traced::ToldByOutputs;

/// The judgements, corrected by the outputs of a vertex stage that have names of their own.
pub fn by_outputs(evidence: &Evidence<'_>, known: Vec<TermJudgement>) -> Vec<TermJudgement> {
    let mut terms = known.clone();
    let ToldByOutputs { right, wrong } = told_by_outputs(evidence);
    let judged = evidence.samples.len();
    let worst = terms.iter().find_map(|term| term.worst);
    for (line, is_right) in
        right.into_iter().map(|line| (line, true)).chain(wrong.into_iter().map(|line| (line, false)))
    {
        let id = &evidence.assignment.rubric[line].id;
        if terms.iter().any(|term| term.line == *id && term.is_right() == is_right) {
            continue;
        }
        let matched = if is_right { judged } else { judged.saturating_sub(1) };
        terms.retain(|term| term.line != *id);
        terms.push(TermJudgement { matched, worst: worst.filter(|_| !is_right), ..TermJudgement::right(id, judged) });
    }
    // Something is wrong that no line tells.
    if terms.iter().all(TermJudgement::is_right) { known } else { terms }
}

/// The judgements; right is also what has nothing to do with what is thrown away, where nothing is wrong but that.
pub fn beside_holes(evidence: &Evidence<'_>, mut terms: Vec<TermJudgement>) -> Vec<TermJudgement> {
    let assignment = evidence.assignment;
    let pairs = || evidence.probes.iter().zip(evidence.samples).map(|(probe, sample)| (probe.colour, sample));
    let is_hole = |sample: &Sample| DVec3::from(sample.colour_f64()) == DISCARDED;
    let is_other_hole = |(right, sample): (DVec3, &Sample)| (right == DISCARDED) != is_hole(sample);
    let agrees = |(right, sample): (DVec3, &Sample)| {
        right == DISCARDED || is_hole(sample) || colour_difference(right, sample) <= COLOUR_TOLERANCE
    };
    if assignment.is_judged(DISCARD) && pairs().any(is_other_hole) && pairs().all(agrees) {
        let is_about = |term: &TermJudgement| assignment.lines_about(DISCARD).any(|line| line.id == term.line);
        let judged = evidence.samples.len();
        for term in terms.iter_mut().filter(|term| !is_about(term)) {
            *term = TermJudgement::right(&term.line, judged);
        }
    }
    terms
}

fn told_by_outputs(evidence: &Evidence<'_>) -> ToldByOutputs {
    let Some(program) = evidence.traced else { return ToldByOutputs::default() };
    let places: Vec<_> = (0..evidence.probes.probes.len()).map(|at| place(evidence, at)).collect();
    evidence.assignment.told_by_outputs(program, &places, FUEL_OF_TRACE)
}

/// The judgements; right are also the terms that no place of a mistake has to do with: with the right values in these places,
/// everything is right.
pub fn beside(evidence: &Evidence<'_>, mut terms: Vec<TermJudgement>, findings: &[Finding]) -> Vec<TermJudgement> {
    let assignment = evidence.assignment;
    let moves = findings.iter().any(|finding| finding.touches_position);
    let is_left =
        |right: &Vec<String>| moves || terms.iter().any(|term| !term.is_right() && !right.contains(&term.line));
    if let Some(right) = elsewhere(assignment, findings).filter(is_left) {
        terms.retain(|term| !right.contains(&term.line));
        terms.extend(right.iter().map(|line| TermJudgement::right(line, evidence.samples.len())));
        return terms;
    }
    let is_touched = |term: &TermJudgement| {
        let line = assignment.rubric.iter().find(|line| line.id == term.line);
        line.is_some_and(|line| findings.iter().any(|finding| finding.touches.contains(&line.judges)))
    };
    // Of a program of no definitions it is not known what a value has to do with. All that is seen has to do with everything.
    let is_known = assignment.equation.reads() != Reads::Outputs && !findings.iter().any(|finding| finding.is_whole);
    if !is_known || !terms.iter().any(is_touched) {
        return terms;
    }
    let judged = evidence.samples.len();
    let worst = terms.iter().find_map(|term| term.worst);
    let is_any_wrong = terms.iter().any(|term| is_touched(term) && !term.is_right());
    let spared = terms.iter().map(|term| match is_touched(term) {
        false => TermJudgement::right(&term.line, judged),
        // What is wrong may not show where the term stands alone.
        true if !is_any_wrong => {
            TermJudgement { matched: judged.saturating_sub(1), worst, ..TermJudgement::right(&term.line, judged) }
        }
        true => term.clone(),
    });
    spared.collect()
}

/// The ids of the lines that are about other variables of the solution than those in which places of mistakes were found; `None` where
/// a place is all that is seen, or in none that a line is about. A line that judges where all stands has what moves that, and what
/// follows from it.
pub fn elsewhere(assignment: &Assignment, findings: &[Finding]) -> Option<Vec<String>> {
    let owners = |finding: &Finding| -> Option<Vec<&RubricItem>> {
        if !(finding.features.is_empty() || finding.is_whole || finding.touches_position) {
            return Some(assignment.rubric.iter().filter(|line| finding.features.contains(&line.id)).collect());
        }
        let name = finding.serves.as_deref().filter(|_| !finding.is_whole)?;
        let about = || assignment.lines_about(name);
        let of_position: Vec<&RubricItem> =
            about().filter(|line| finding.touches_position && assignment.judges_position(line)).collect();
        let of_colour = || about().filter(|line| !assignment.judges_position(line)).collect();
        Some(if of_position.is_empty() { of_colour() } else { of_position }).filter(|lines| !lines.is_empty())
    };
    let wrong: Vec<Vec<&RubricItem>> = findings.iter().map(owners).collect::<Option<_>>()?;
    let is_wrong = |line: &RubricItem| wrong.iter().flatten().any(|own| own.id == line.id);
    let right = assignment.rubric.iter().filter(|line| !line.variables.is_empty() && !is_wrong(line));
    (!wrong.is_empty()).then(|| right.map(|line| line.id.clone()).collect())
}

/// The ids of the lines that derived mistakes cost nothing, for the text computes what they judge, or has its one mistake within another
/// line's feature; none where these are all.
pub fn by_text(evidence: &Evidence<'_>, found: &[FoundMistake]) -> Vec<String> {
    let assignment = evidence.assignment;
    if !found.iter().all(|found| is_derived(&found.id)) {
        return Vec::new();
    }
    if !assignment.is_told_by_features() {
        return if is_of_several_terms(assignment, found) { right_where_they_show(evidence) } else { Vec::new() };
    }
    let costs = |line: &&RubricItem| found.iter().any(|found| assignment.keeps(found, line) < 1.0);
    let costly: Vec<&RubricItem> = assignment.rubric.iter().filter(costs).collect();
    // What is within one feature is that line's, whatever else of it the text computes.
    if costly.iter().filter(|line| !assignment.judges_position(line)).count() < 2 {
        return Vec::new();
    }
    let costly: Vec<&str> = costly.into_iter().map(|line| line.id.as_str()).collect();
    let within = if let [_] = found { inside::features_of_all(evidence) } else { Vec::new() };
    if !within.is_empty() && within.iter().all(|id| costly.contains(&id.as_str())) {
        let is_other = |line: &&RubricItem| !within.contains(&line.id) && !assignment.judges_position(line);
        return assignment.rubric.iter().filter(is_other).map(|line| line.id.clone()).collect();
    }
    let spared = computed_of(evidence, &costly);
    if costly.iter().all(|id| spared.iter().any(|own| own == id)) { Vec::new() } else { spared }
}

/// Whether one is in what several lines of the rubric go into: the sum without two of its terms is two mistakes.
pub fn is_of_several_terms(assignment: &Assignment, found: &[FoundMistake]) -> bool {
    let equation = &assignment.equation;
    let place = |name: &str| equation.index(name);
    let goes_into = |of| {
        assignment.rubric.iter().filter_map(|line| place(&line.judges)).filter(move |on| equation.depends(of, *on))
    };
    found.iter().filter_map(|found| place(definition(&found.id)?)).any(|of| goes_into(of).nth(1).is_some())
}

/// The ids of the lines whose terms show at probes that are right, and at none that is wrong: a mistake in their sum leaves them as they
/// are. None where these are all.
fn right_where_they_show(evidence: &Evidence<'_>) -> Vec<String> {
    let assignment = evidence.assignment;
    let terms: Vec<&RubricItem> = assignment.rubric.iter().filter(|line| !assignment.judges_position(line)).collect();
    let shows = shows_at(evidence);
    let is_spared = |line: &&&RubricItem| matches!(shows(line), [true, false]);
    let spared: Vec<String> = terms.iter().filter(is_spared).map(|line| line.id.clone()).collect();
    if spared.len() == terms.len() { Vec::new() } else { spared }
}

/// Whether the term that a line judges shows at a probe that is right, and whether at one that is wrong.
pub fn shows_at<'e>(evidence: &'e Evidence<'_>) -> impl Fn(&RubricItem) -> [bool; 2] + 'e {
    let Evidence { assignment, probes, samples, .. } = *evidence;
    let right = assignment.equation.right();
    let values: Vec<_> = probes.iter().map(|probe| right.evaluate(probes.uniforms(probe), &probe.attributes)).collect();
    let is_right = |at: &usize| colour_difference(probes.probes[*at].colour, &samples[*at]) <= COLOUR_TOLERANCE;
    let places: (Vec<usize>, Vec<usize>) = (0..samples.len().min(values.len())).partition(is_right);
    move |line| {
        let shows = |at: &usize| {
            let value = values[*at].get(&line.judges);
            value.is_some_and(|value| value.numbers().iter().any(|number| number.abs() > COLOUR_TOLERANCE))
        };
        [&places.0, &places.1].map(|places| places.iter().any(shows))
    }
}

/// The lines of which the text computes what they judge. Where one of these `wrong` ones is left that judges a value, the ways in
/// which all is drawn are right as well: of a right answer's value in its place, all is right.
fn computed_of(evidence: &Evidence<'_>, wrong: &[&str]) -> Vec<String> {
    let rubric = &evidence.assignment.rubric;
    let mut lines = inside::computed_lines(evidence);
    lines.extend(told_by_outputs(evidence).right.into_iter().map(|line| rubric[line].id.clone()));
    let is_turns = |number: usize| evidence.assignment.judges_turns(number);
    let is_value = |number: usize| evidence.assignment.judges_a_value(number) && !is_turns(number);
    let is_wrong = |line: &RubricItem| wrong.contains(&line.id.as_str()) && !lines.contains(&line.id);
    // Where each wrong value is there in some turns, it is the turns that are wrong.
    if let Some(turns) = (0..rubric.len()).find(|number| is_turns(*number) && is_wrong(&rubric[*number])) {
        let some = inside::lines_of_some_turns(evidence);
        let mut values = rubric.iter().enumerate().filter(|(number, line)| is_value(*number) && is_wrong(line));
        if values.clone().next().is_some() && values.all(|(_, line)| some.contains(&line.id)) {
            let others = rubric.iter().enumerate().filter(|(number, _)| *number != turns);
            return others.map(|(_, line)| line.id.clone()).collect();
        }
    }
    let is_left = |(number, line): (usize, &RubricItem)| is_value(number) && is_wrong(line);
    if rubric.iter().enumerate().any(is_left) {
        let ways = rubric.iter().enumerate().filter(|(number, _)| !is_value(*number));
        lines.extend(ways.map(|(_, line)| line.id.clone()));
    }
    lines
}

/// The judgements; right are also the lines of which the text computes what they judge, unless these are all.
pub fn computed(evidence: &Evidence<'_>, terms: Vec<TermJudgement>) -> Vec<TermJudgement> {
    if !evidence.assignment.is_told_by_features() {
        return terms;
    }
    let wrong: Vec<&str> = terms.iter().filter(|term| !term.is_right()).map(|term| term.line.as_str()).collect();
    let lines = computed_of(evidence, &wrong);
    addends::credited(evidence, terms, &lines)
}
