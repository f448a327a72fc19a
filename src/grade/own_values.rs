//! Where in a wrong picture an answer is followed line by line.

use crate::compare::{self, ExpectedFrame, PIXEL_TOLERANCE};
use crate::diagnose::{self, Evidence};
use crate::render::Frames;
use crate::report::{FrameResult, OwnValues, RubricLine};
use reference::equation::Reads;
use reference::probes::Pictured;

/// What a wrong answer computes on its way, in the frame that differs most, or at probes where none does.
pub(super) fn of(
    evidence: &Evidence<'_>,
    expected: &[ExpectedFrame],
    drawn: &Frames,
    rubric: &[RubricLine],
) -> Option<OwnValues> {
    // What stands for a program in another language is not the student's own text.
    if evidence.assignment.files.iter().any(|file| file.program.is_some()) {
        return None;
    }
    let frame = FrameResult::differs_most(evidence.frames);
    let pictured = frame.and_then(|frame| pictured(evidence, expected.get(frame)?, drawn, frame)).unwrap_or_default();
    diagnose::own_values(evidence, frame.unwrap_or(0) as u32, &pictured, rubric)
}

/// The vertices of a frame, or some of its pixels.
fn pictured(evidence: &Evidence<'_>, expected: &ExpectedFrame, drawn: &Frames, frame: usize) -> Option<Vec<Pictured>> {
    let assignment = evidence.assignment;
    let pose = *assignment.scene.all_poses().get(frame)?;
    if assignment.equation.reads() == Reads::Attributes {
        return Some(assignment.pictured_vertices(&pose));
    }
    let differences = compare::differences(expected, drawn, frame as u32);
    Some(assignment.pictured_pixels(&pose, &pixels(&differences, drawn.width)))
}

/// Pixels that show what is wrong, and one that is right: the innermost wrong one, the one that differs most, the one that is farthest from
/// both, and the innermost right one.
fn pixels(differences: &[Option<u8>], width: u32) -> Vec<[u32; 2]> {
    let all = |is_it: &dyn Fn(u8) -> bool| -> Vec<bool> {
        differences.iter().map(|difference| difference.is_some_and(is_it)).collect()
    };
    let wrong = all(&|difference| difference > PIXEL_TOLERANCE);
    let right = all(&|difference| difference <= PIXEL_TOLERANCE);
    let pixel = |place: usize| [place as u32 % width.max(1), place as u32 / width.max(1)];
    let mut found: Vec<[u32; 2]> = compare::innermost(&wrong, width).into_iter().collect();
    let worst = differences.iter().enumerate().filter_map(|(place, difference)| Some(((*difference)?, place)));
    found.extend(worst.rev().max_by_key(|(difference, _)| *difference).map(|(_, place)| pixel(place)));
    let far = |place: usize| {
        let [x, y] = pixel(place);
        found.iter().map(|[a, b]| a.abs_diff(x).max(b.abs_diff(y))).min().unwrap_or(0)
    };
    let places = (0..wrong.len()).rev().filter(|place| wrong[*place]);
    let farthest = places.max_by_key(|place| far(*place)).map(pixel);
    found.extend(farthest);
    found.extend(compare::innermost(&right, width));
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_show_what_is_wrong_from_several_sides_and_what_is_right() {
        // Two rows of eight: the left half is wrong, most at its lower left, and the edge is not judged.
        let row = |first: u8| [Some(first), Some(40), Some(40), Some(40), None, Some(0), Some(1), Some(2)];
        let differences: Vec<Option<u8>> = [row(40), row(90)].concat();
        let found = pixels(&differences, 8);
        assert_eq!(found.len(), 4);
        assert_eq!(found[1], [0, 1], "the worst");
        let is_wrong = |[x, _]: &[u32; 2]| *x < 4;
        assert_eq!(found.iter().map(is_wrong).collect::<Vec<_>>(), [true, true, true, false]);
        assert!(pixels(&[Some(0); 4], 2).iter().all(|[x, y]| *x < 2 && *y < 2));
    }
}
