//! How a cause is found: known mistakes first, and then what nobody wrote down.

use super::unexplained::{alone, unexplained};
use super::{Cause, FEW_PIXELS, HARD_CODED, NEARLY, spared, with_constants, worth};
use crate::compare::{COLOUR_TOLERANCE, POSITION_TOLERANCE, position_difference};
use crate::diagnose::constants::{self, ChangedConstant};
use crate::diagnose::inside::{self, RepairAim, Repaired};
use crate::diagnose::listed::WrongNumbers;
use crate::diagnose::{Evidence, POSITION_CHANGED, addends, hard_coded, plain, position_scale};
use crate::render::Sample;
use crate::report::FrameResult;
use glam::{DVec3, DVec4};
use reference::Assignment;
use reference::equation::{DISCARDED, Reads};
use reference::fit::{
    Alternatives, Fit, MOST_MISTAKES, explain_moved, is_right, judge_features, judge_terms, programs_showing,
};
use reference::mistake::FoundMistake;

/// So many mistakes are looked for at once before the text is looked into.
const FEW: usize = MOST_MISTAKES - 1;

/// Whether a picture is off by no more than what is nearly right.
fn is_hardly_off(frame: &FrameResult) -> bool {
    frame.max_difference <= NEARLY * 255.0
}

/// Whether hardly any pixel of a picture is another one.
fn are_few_pixels_off(evidence: &Evidence<'_>) -> bool {
    /// Of the window's pixels. A border of a pixel around a third of it is less.
    const FEW: f64 = 0.01;
    let Evidence { assignment, frames, .. } = *evidence;
    let scene = &assignment.scene;
    let most = FEW * f64::from(scene.width) * f64::from(scene.height);
    let is_few = |frame: &FrameResult| frame.coverage_mismatches == 0 && f64::from(frame.mismatched_pixels) <= most;
    assignment.mistake(FEW_PIXELS).is_some() && frames.iter().all(is_few)
}

/// Finds it. `shape`: whether everything stands where it should.
pub(in crate::diagnose) fn cause(evidence: &Evidence<'_>, shape: bool) -> Cause {
    let Evidence { assignment, probes, .. } = *evidence;
    let samples: Vec<[f64; 3]> = evidence.samples.iter().map(Sample::colour_f64).collect();
    let frames_agree = evidence.frames.iter().all(FrameResult::agrees);
    let all_right = is_right(probes, &samples, COLOUR_TOLERANCE);
    if let (true, Some(_), Some(mistake)) = (all_right, evidence.undefined, assignment.undefined_power()) {
        let found = vec![FoundMistake { id: mistake.id.clone(), form: 0, parameter: None }];
        return Cause::known(found);
    }
    let alternatives = Alternatives::new(assignment, probes);
    let is_there = is_there(evidence);
    let mut shown = programs_showing(&alternatives, &samples, &is_there, COLOUR_TOLERANCE);
    if !(all_right && shape)
        && let Some(found) = shown.next()
    {
        let by_text = told_by_text(evidence, &alternatives, &samples, &found, shown);
        return by_text.unwrap_or_else(|| Cause::known(vec![found]));
    }
    if all_right
        && !shape
        && let Some(cause) = moved(evidence, &samples, &is_there)
    {
        return cause;
    }
    if all_right {
        // Right at every probe and in place, but not in the frames: the course's own poses are treated apart.
        return match assignment.equation.reads() {
            _ if frames_agree || !shape => Cause::Right,
            // A number that is hardly off shows in a picture all the same.
            _ if let Some(listed) = WrongNumbers::of(evidence).filter(WrongNumbers::is_wrong) => {
                Cause::unexplained(listed.terms(evidence), Vec::new())
            }
            // What the last digits decide is not judged.
            Reads::Attributes if hard_coded::are_at_steps(assignment, evidence.frames) => Cause::Right,
            Reads::Attributes => Cause::HardCoded,
            Reads::Outputs if are_few_pixels_off(evidence) => Cause::FewPixels,
            // Not all that a fragment stage reads is probed.
            Reads::Varyings | Reads::Outputs => Cause::unexplained(Vec::new(), Vec::new()),
        };
    }
    let constants = constants::changed(evidence.sources.iter().copied(), assignment);
    if let Some(found) = explained_by(&constants, evidence, &samples) {
        return Cause::Known { constants, found, spared: Vec::new() };
    }
    // Numbers that a program lists are known one by one: nothing is looked up, and the course's own light hides what is wrong.
    let is_listed = assignment.files.iter().any(|file| file.program.is_some());
    let frames_agree = frames_agree && !is_listed;
    let shows_a_table = !is_listed && hard_coded::is_lookup(evidence.source, probes, evidence.samples);
    let by_term = |begun| {
        let terms = judge_terms(assignment, probes, &samples, COLOUR_TOLERANCE);
        unexplained(evidence, &alternatives, &samples, terms, begun)
    };
    if shows_a_table && addends::is_finite_nowhere(evidence) {
        return by_term(None);
    }
    let is_lookup = shows_a_table && !addends::is_computed(evidence);
    // Without the normals the course's own poses can only be right if they are treated apart.
    let is_made_for_the_poses = || frames_agree && hard_coded::ignores_normals(probes, evidence.samples);
    let is_nearly_right = || is_right(probes, &samples, NEARLY) && evidence.frames.iter().all(is_hardly_off);
    // Of fragments there are no twins with one number: the text says whether anything is computed.
    let is_made_of_nothing = || {
        let is_known = assignment.mistake(HARD_CODED).is_some() && assignment.equation.reads() == Reads::Outputs;
        is_known && !is_dark(evidence.samples) && inside::ignores_all(evidence)
    };
    let is_hard_coded = || is_lookup || is_made_for_the_poses() || is_made_of_nothing();
    let explained = |counts| plain::explained(counts, assignment, evidence.sources, probes, &samples, COLOUR_TOLERANCE);
    let (mut fit, mut begun) = (explained(1..=1), None);
    if matches!(fit, Fit::Unexplained(_)) {
        // One change of the solution says more than two mistakes.
        if !is_hard_coded() && !is_nearly_right() {
            begun = match alone(evidence, &alternatives, &samples) {
                Ok(cause) if !cause.is_of_several_terms(assignment) => return cause,
                other => Some(other),
            };
        }
        fit = explained(2..=FEW);
    }
    match fit {
        // What computes a right term has it multiplied by 0, or left out.
        Fit::Explained(found)
            if shows_a_table
                && hard_coded::is_coincidence(assignment, probes, evidence.samples, &found)
                && !addends::computes_a_term(evidence) =>
        {
            if is_lookup {
                Cause::HardCoded
            } else {
                by_term(begun)
            }
        }
        // What was handed out may be left behind a right answer.
        Fit::Explained(found)
            if !frames_agree && is_handed_out(assignment, &found) && addends::computes_the_colour(evidence) =>
        {
            by_term(begun)
        }
        // The course's own poses are treated apart from what explains all others.
        Fit::Explained(found) if frames_agree && hard_coded::leaves_nothing(assignment, &found) => Cause::HardCoded,
        // Some mistakes together come near to nearly anything.
        Fit::Explained(found) if found.len() > 1 && is_nearly_right() => nearly_right(evidence),
        // One slip in how a function is written says more than what it does to several terms.
        Fit::Explained(found)
            if found.len() > 1
                && let Some(cause) = in_a_body(evidence) =>
        {
            cause
        }
        Fit::Explained(found) if is_dark(evidence.samples) && stands_elsewhere(evidence, &found) => by_term(begun),
        Fit::Explained(found) => Cause::known(found),
        Fit::Unexplained(_) if is_hard_coded() => Cause::HardCoded,
        Fit::Unexplained(_) if is_nearly_right() => nearly_right(evidence),
        Fit::Unexplained(terms) => unexplained(evidence, &alternatives, &samples, terms, begun),
    }
}

/// The one slip in how a function is written.
fn in_a_body(evidence: &Evidence<'_>) -> Option<Cause> {
    let repaired = inside::only_change(evidence, RepairAim::Body)?;
    let lines = worth::charged(evidence.assignment, &[], &repaired);
    (!lines.is_empty()).then(|| Cause::Repaired(vec![(lines, repaired)]))
}

/// Whether nothing was changed of what was handed out.
fn is_handed_out(assignment: &Assignment, found: &[FoundMistake]) -> bool {
    found.iter().any(|found| assignment.mistake(&found.id).is_some_and(|mistake| mistake.handed_out))
}

/// That it is never off by much, and the lines that have nothing to do with where it is.
fn nearly_right(evidence: &Evidence<'_>) -> Cause {
    let spared = spared::elsewhere(evidence.assignment, &inside::find(evidence));
    Cause::NearlyRight(spared.unwrap_or_default())
}

/// The mistakes by which something stands elsewhere, where all colours are right: a derived one, or those that changes of the text mend.
fn moved(evidence: &Evidence<'_>, samples: &[[f64; 3]], is_there: &dyn Fn(usize, DVec4) -> bool) -> Option<Cause> {
    let assignment = evidence.assignment;
    let mut of_position = (0..assignment.rubric.len()).filter(|at| assignment.judges_position(&assignment.rubric[*at]));
    // A line that judges all of the place has no feature.
    let has_features = of_position.clone().all(|line| assignment.has_feature(line));
    let judges_position = of_position.next().is_some();
    if has_features && let Some(found) = explain_moved(assignment, evidence.probes, samples, is_there, COLOUR_TOLERANCE)
    {
        // Where a line judges where something stands, nothing of the colour is wrong.
        let of_colour = assignment.rubric.iter().filter(|line| judges_position && !assignment.judges_position(line));
        let spared = of_colour.map(|line| line.id.clone()).collect();
        return Some(Cause::Known { constants: Vec::new(), found: vec![found], spared });
    }
    let moves = |id: &str| assignment.mistake(POSITION_CHANGED).is_some_and(|mistake| mistake.keeps(id) < 1.0);
    let is_general = assignment.mistake(POSITION_CHANGED).is_some_and(|mistake| mistake.is_general);
    if judges_position && (has_features || !is_general) || !assignment.is_told_by_features() {
        return None;
    }
    let (_, repairs) = inside::account(evidence, &mut || true);
    let charged = |repaired: Repaired| {
        let mut lines = worth::charged(assignment, &[], &repaired);
        lines.retain(|id| moves(id));
        (!lines.is_empty()).then_some((lines, repaired))
    };
    let repairs: Vec<_> = repairs.into_iter().map(charged).collect::<Option<_>>()?;
    (!repairs.is_empty()).then_some(Cause::Repaired(repairs))
}

/// Whether a mistake costs more than half of all points: then whatever makes little of a right answer show may show the same.
pub(in crate::diagnose) fn leaves_little(assignment: &Assignment, found: &FoundMistake) -> bool {
    let kept: f64 = assignment.rubric.iter().map(|line| line.points * assignment.keeps(found, line)).sum();
    2.0 * kept < assignment.max_score()
}

/// What the text says where what is seen says little: hardly anything is left of a right answer, or mistakes in different lines of the
/// rubric show the same, such as that all lies in shadow. None where nothing that is seen comes from a texture, or the text says no
/// more.
fn told_by_text(
    evidence: &Evidence<'_>,
    alternatives: &Alternatives<'_>,
    samples: &[[f64; 3]],
    first: &FoundMistake,
    mut others: impl Iterator<Item = FoundMistake>,
) -> Option<Cause> {
    let assignment = evidence.assignment;
    let is_little = leaves_little(assignment, first);
    // Each of the others is run to be compared: the dearest question comes last.
    let mut is_ambiguous = || others.any(|other| !assignment.share_a_line(first, &other));
    if !inside::looks_up(evidence) || !(is_little || is_ambiguous()) {
        return None;
    }
    let (findings, repairs) = inside::account(evidence, &mut || true);
    if let Ok([repaired]) = <[Repaired; 1]>::try_from(repairs)
        && repaired.builds_on_the_text()
    {
        // A change in other lines than those which are wrong by what is seen is right by chance.
        let costs =
            |id: &String| assignment.rubric.iter().any(|line| line.id == *id && assignment.keeps(first, line) < 1.0);
        let lines = worth::charged(assignment, &[], &repaired);
        return lines.iter().any(costs).then(|| Cause::Repaired(vec![(lines, repaired)]));
    }
    let terms = judge_features(alternatives, samples, COLOUR_TOLERANCE);
    let terms = spared::by_outputs(evidence, spared::beside(evidence, terms, &findings));
    (!is_little).then_some(Cause::unexplained(terms, findings))
}

/// Whether a sample has a given position, but for the factor that all have in common where they are right.
pub(in crate::diagnose) fn is_there<'e>(evidence: &'e Evidence<'_>) -> impl Fn(usize, DVec4) -> bool + 'e {
    let scale = position_scale(evidence);
    move |place, position| {
        let sample = evidence.samples.get(place);
        let is_at = |scale| sample.is_some_and(|s| position_difference(position, s, scale) <= POSITION_TOLERANCE);
        is_at(1.0) || is_at(scale)
    }
}

/// Whether all that is drawn is black, or no number: then the colours say little of the cause.
pub(super) fn is_dark(samples: &[Sample]) -> bool {
    let is_drawn = |colour: &[f64; 3]| DVec3::from(*colour) != DISCARDED;
    let mut drawn = samples.iter().map(Sample::colour_f64).filter(is_drawn).peekable();
    drawn.peek().is_some() && drawn.flatten().all(|channel| channel == 0.0 || channel.is_nan())
}

/// Whether the places at which all is mended serve definitions that have nothing of what the mistakes have wrong.
fn stands_elsewhere(evidence: &Evidence<'_>, found: &[FoundMistake]) -> bool {
    let Evidence { assignment: Assignment { equation, .. }, .. } = *evidence;
    let forms = found.iter().filter_map(|found| evidence.assignment.mistake(&found.id)?.forms.get(found.form));
    let wrong: Vec<usize> = forms.flat_map(|form| &form.overrides).map(|changed| changed.definition).collect();
    let place = |name: String| equation.definitions().iter().position(|known| known.name == name);
    let places: Vec<usize> =
        inside::find(evidence).into_iter().filter_map(|finding| finding.serves).filter_map(place).collect();
    let is_apart = |place: &usize| !wrong.iter().any(|wrong| equation.depends(*place, *wrong));
    !places.is_empty() && places.iter().all(is_apart)
}

/// The mistakes that explain the samples when the equation has the student's own constants.
fn explained_by(
    constants: &[ChangedConstant],
    evidence: &Evidence<'_>,
    samples: &[[f64; 3]],
) -> Option<Vec<FoundMistake>> {
    if constants.is_empty() {
        return None;
    }
    if constants::explain(constants, evidence) {
        return Some(Vec::new());
    }
    let changed = with_constants(evidence.assignment, constants)?;
    let probes = changed.reprobe(evidence.probes);
    match plain::explained(1..=FEW, &changed, evidence.sources, &probes, samples, COLOUR_TOLERANCE) {
        Fit::Explained(found) => Some(found),
        Fit::Unexplained(_) => None,
    }
}
