//! What became of a student, in one word.

use super::class::{Entry, Outcome};
use crate::language::Text;
use crate::report::Verdict;

/// What became of a student, in one word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Standing {
    /// Graded, all full marks.
    Correct,
    /// Graded, some points are missing.
    Wrong,
    /// Refused by compiler, linker or interface.
    Rejected,
    /// Stopped at a limit.
    Stopped,
    /// There was nothing to grade.
    NotGraded,
    /// ggrade failed.
    Fault,
}

/// How many there are of each.
pub type Counts = [usize; Standing::ALL.len()];

impl Standing {
    /// All of them, the order in which they are listed.
    pub const ALL: [Self; 6] =
        [Self::Correct, Self::Wrong, Self::Rejected, Self::Stopped, Self::NotGraded, Self::Fault];

    /// The one of an outcome.
    pub fn of(outcome: &Outcome) -> Self {
        match outcome {
            Outcome::Graded(report) => match report.verdict {
                Verdict::Correct => Self::Correct,
                Verdict::Wrong => Self::Wrong,
                Verdict::Rejected => Self::Rejected,
                Verdict::Stopped => Self::Stopped,
            },
            Outcome::NotGraded(_) => Self::NotGraded,
            Outcome::Fault(_) => Self::Fault,
        }
    }

    /// How many entries there are of each.
    pub fn count<'a>(entries: impl IntoIterator<Item = &'a Entry>) -> Counts {
        let mut counts = Counts::default();
        for entry in entries {
            counts[Self::of(&entry.outcome) as usize] += 1;
        }
        counts
    }

    /// The word for programs: the contract's verdicts, and two more.
    pub fn id(self) -> &'static str {
        match self {
            Self::Correct => "correct",
            Self::Wrong => "wrong",
            Self::Rejected => "rejected",
            Self::Stopped => "stopped",
            Self::NotGraded => "not-graded",
            Self::Fault => "fault",
        }
    }

    /// A sign of one column, which tells them apart without colour.
    pub fn sign(self) -> &'static str {
        match self {
            Self::Correct => "✓",
            Self::Wrong => "△",
            Self::Rejected => "✗",
            Self::Stopped => "■",
            Self::NotGraded => "–",
            Self::Fault => "!",
        }
    }

    /// The words for people.
    pub fn label(self) -> Text {
        match self {
            Self::Correct => Text::new("Correct", "正解"),
            Self::Wrong => Text::new("Not right yet", "修正が必要です"),
            Self::Rejected => Text::new("Not accepted", "受理できません"),
            Self::Stopped => Text::new("Stopped", "実行を中断しました"),
            Self::NotGraded => Text::new("Nothing to grade", "採点対象なし"),
            Self::Fault => Text::new("Grading failed", "採点エラー"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_stands_at_its_own_place() {
        for (index, standing) in Standing::ALL.into_iter().enumerate() {
            assert_eq!(standing as usize, index);
        }
    }
}
