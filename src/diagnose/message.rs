//! What a line of the rubric says: what is seen, which equation it breaks, where to look.

use super::{Cause, Evidence};
use crate::language::Text;
use reference::assignment::RubricLine;

/// A message and the line of the student's file that it speaks of.
pub(super) struct Told {
    pub text: Text,
    pub line: Option<u32>,
}

/// The message for a line of the rubric.
pub(super) fn tell(evidence: &Evidence<'_>, line: &RubricLine, cause: &Cause, culprit: Option<&str>) -> Told {
    let Some(id) = culprit else { return Told { text: agreement(evidence, line), line: None } };
    let Some(mistake) = evidence.assignment.mistake(id) else { return Told { text: Text::default(), line: None } };
    let mut parts = vec![&mistake.seen, &mistake.equation, &mistake.look];
    parts.retain(|part| !part.en.is_empty());
    let join = |language: fn(&reference::Text) -> &str, space: &str| {
        parts.iter().map(|part| language(part)).collect::<Vec<_>>().join(space)
    };
    let _ = cause;
    Told { text: Text::new(join(|t| &t.en, " "), join(|t| &t.ja, "")), line: None }
}

/// Right answers get more than silence.
fn agreement(evidence: &Evidence<'_>, line: &RubricLine) -> Text {
    let frames = evidence.frames.len();
    let probes = evidence.probes.probes.len();
    if line.id == super::SHAPE {
        return Text::new(
            format!("The triangle stands where it should in all {frames} frames."),
            format!("{frames} 枚の画像すべてで、三角形の位置と形が一致しています。"),
        );
    }
    Text::new(
        format!("It agrees wherever it shows among {probes} probes."),
        format!("{probes} 点の検査点のうち、この項が現れるすべての点で一致しています。"),
    )
}
