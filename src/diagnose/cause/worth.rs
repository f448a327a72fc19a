//! What a cause leaves of each line's points.

use super::{Cause, NEARLY_RIGHT, PART_ABSENT, PART_MISSING, PART_SCALED};
use crate::diagnose::inside::Repaired;
use crate::diagnose::{CONSTANTS_CHANGED, POSITION_CHANGED};
use crate::report::UNEXPLAINED;
use reference::Assignment;
use reference::assignment::RubricItem;
use reference::derived::{definition, is_derived};
use reference::fit::{FeatureDefect, FeatureExplanation, TermJudgement};
use reference::interpreter::Stage;

/// What is made of more lines' features is all that is seen: these tell more by themselves.
const MOST_LINES: usize = 2;

/// What is said of a feature.
pub(super) const fn part_id(part: FeatureDefect) -> &'static str {
    match part {
        FeatureDefect::Missing => PART_MISSING,
        FeatureDefect::Factor(_) => PART_SCALED,
    }
}

/// Fraction of the line's points that the mistake leaves in this answer.
pub fn kept(assignment: &Assignment, line: &RubricItem, shape: bool, cause: &Cause, id: &str) -> f64 {
    let is_touched = match (cause, id) {
        (_, POSITION_CHANGED) => !shape,
        (Cause::Unexplained { absent, .. }, PART_ABSENT) => absent.contains(&line.id),
        (Cause::Unexplained { absent, .. }, _) if absent.contains(&line.id) => false,
        // What cannot be judged by itself is not known to be right.
        (Cause::Unexplained { terms, .. }, UNEXPLAINED) => terms
            .iter()
            .find(|term| term.line == line.id)
            .map_or(!assignment.judges_position(line), |term| !term.is_right()),
        (Cause::Parts(FeatureExplanation { parts, .. }), PART_MISSING | PART_SCALED) => {
            parts.iter().any(|(at, part)| assignment.rubric[*at].id == line.id && part_id(*part) == id)
        }
        (Cause::Repaired(repairs), _) if repairs.iter().any(|(_, repaired)| repaired.mistake.id == id) => {
            let own = repairs.iter().filter(|(lines, repaired)| repaired.mistake.id == id && lines.contains(&line.id));
            return own.map(|(_, repaired)| repaired.mistake.keeps(&line.id)).fold(1.0, f64::min);
        }
        (Cause::Known { constants, .. }, CONSTANTS_CHANGED) => {
            constants.iter().any(|changed| belongs(assignment, &changed.name, line))
        }
        (Cause::Known { spared, .. }, _) if spared.contains(&line.id) => false,
        (Cause::NearlyRight(spared), NEARLY_RIGHT) if spared.contains(&line.id) => false,
        (Cause::Known { found, .. } | Cause::Parts(FeatureExplanation { found, .. }), _)
            if let Some(found) = found.iter().find(|found| found.id == id) =>
        {
            return assignment.keeps(found, line);
        }
        _ => true,
    };
    if is_touched { assignment.mistake(id).map_or(1.0, |mistake| mistake.keeps(&line.id)) } else { 1.0 }
}

/// The lines that a repaired mistake costs points: those of the colour, see [`of_colour`], and of the position, where it moves what is
/// drawn.
pub(super) fn charged(assignment: &Assignment, terms: &[TermJudgement], repaired: &Repaired) -> Vec<String> {
    // What the homework says of a mistake counts.
    if !is_derived(&repaired.mistake.id) {
        let lines = assignment.rubric.iter().filter(|line| repaired.mistake.keeps(&line.id) < 1.0);
        return lines.map(|line| line.id.clone()).collect();
    }
    let moved = assignment.rubric.iter().filter(|line| repaired.moves && assignment.judges_position(line));
    let mut lines = of_colour(assignment, terms, repaired);
    lines.extend(moved.map(|line| line.id.clone()));
    lines
}

/// Those whose terms it changes, where that is known; those that are about the variable that it is in, or those within whose features it is; else those of which it spoils what they
/// judge, but for terms that are right by themselves. Where it spoils none of these, such as a sum, all that are not right.
fn of_colour(assignment: &Assignment, terms: &[TermJudgement], repaired: &Repaired) -> Vec<String> {
    if !repaired.terms.is_empty() {
        return repaired.terms.clone();
    }
    let is_wrong = |line: &&RubricItem| terms.iter().any(|term| term.line == line.id && !term.is_right());
    // What cannot be judged by itself is not known to be right.
    let is_right = |line: &&RubricItem| terms.iter().any(|term| term.line == line.id && term.is_right());
    let is_colour = |line: &&RubricItem| !assignment.judges_position(line);
    let lines = || assignment.rubric.iter().filter(is_colour);
    // Of some lines those that are wrong by themselves, or all where none is.
    let wrong_of = |lines: Vec<&RubricItem>| -> Vec<String> {
        let is_any = lines.iter().any(is_wrong);
        lines.into_iter().filter(|line| !is_any || is_wrong(line)).map(|line| line.id.clone()).collect()
    };
    // Which element of an array is taken is a matter of the turns of the loop that goes through it.
    if repaired.is_of_an_element()
        && let Some(turns) = (0..assignment.rubric.len()).find(|line| assignment.judges_turns(*line))
    {
        return vec![assignment.rubric[turns].id.clone()];
    }
    // What is written over is lost, and what writes over it is right.
    if repaired.keeps_what_was_there() {
        let is_known = |line: &&RubricItem| repaired.written_over.contains(&line.judges);
        let is_wrong = |line: &&RubricItem| is_wrong(line) && !repaired.lines.contains(&line.id);
        let lost: [Vec<&RubricItem>; 2] = [lines().filter(is_known).collect(), lines().filter(is_wrong).collect()];
        if let Some(lost) = lost.into_iter().find(|lines| !lines.is_empty()) {
            return lost.into_iter().map(|line| line.id.clone()).collect();
        }
    }
    // What a right answer has in the text of a line's feature is of that line.
    if let Some(own) = assignment.only_line_with(&repaired.texts[1]).filter(is_colour) {
        return vec![own.id.clone()];
    }
    // What a fixed stage reads has its name, whatever stands for it in a right answer.
    let is_read = |name: &&str| {
        assignment.fixed.iter().any(|fixed| fixed.stage == Stage::Fragment)
            && assignment.interface.outputs.iter().any(|output| output.name == **name)
    };
    let output = repaired.located.as_ref().and_then(|located| located.name.as_deref()).filter(is_read);
    let name = output.or(definition(&repaired.mistake.id));
    // A change within what lines judge is of these.
    let is_of_one_line = || name.is_some_and(|name| assignment.is_of_one_line(name));
    if output.is_none() && matches!(repaired.lines.len(), 1..=MOST_LINES) && !is_of_one_line() {
        let lines = assignment.rubric.iter().filter(|line| repaired.lines.contains(&line.id));
        return wrong_of(lines.collect());
    }
    let about = name.into_iter().flat_map(|name| assignment.lines_owning(name));
    // Where all stands is seen by itself.
    let about: Vec<&RubricItem> = about.filter(is_colour).collect();
    // What nothing shows by itself is wrong where it is made of what is wrong, and the others with it.
    let is_hidden =
        |line: &&RubricItem| assignment.judges_the_rest(line) && !terms.iter().any(|term| term.line == line.id);
    if let Some(hidden) = about.iter().copied().find(is_hidden).filter(|_| !terms.is_empty()) {
        return vec![hidden.id.clone()];
    }
    if !about.is_empty() {
        return wrong_of(about);
    }
    let is_spoilt = |line: &&RubricItem| repaired.touches.contains(&line.judges) && !assignment.is_beside_terms(line);
    let is_all = |line: &&RubricItem| assignment.equation.index(&line.judges) == Some(assignment.equation.colour());
    let choices: [Vec<&RubricItem>; 4] = [
        // What it is in itself may be right where it shows alone.
        lines().filter(|line| !is_all(line) && name == Some(line.judges.as_str())).collect(),
        lines().filter(|line| !is_right(line) && is_spoilt(line)).collect(),
        lines().filter(is_wrong).collect(),
        lines().filter(is_spoilt).collect(),
    ];
    let chosen = choices.into_iter().find(|lines| !lines.is_empty()).unwrap_or_default();
    chosen.into_iter().map(|line| line.id.clone()).collect()
}

/// Whether the constant is one of the line's.
pub fn belongs(assignment: &Assignment, constant: &str, line: &RubricItem) -> bool {
    assignment.constants.iter().any(|known| known.name == constant && known.line == line.id)
}
