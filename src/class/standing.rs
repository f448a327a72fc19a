//! What became of a student, in one word.

use super::{ClassEntry, Outcome};
use crate::language::Language;
use crate::report::Verdict;
use crate::report::labels::Labels;
use serde::Serialize;

/// What became of a student, in one word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
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
pub type StandingCounts = [usize; Standing::ALL.len()];

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
    pub fn count<'a>(entries: impl IntoIterator<Item = &'a ClassEntry>) -> StandingCounts {
        let mut counts = StandingCounts::default();
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
    pub fn word(self, language: Language) -> &'static str {
        let labels = Labels::of(language);
        match (self, language) {
            (Self::Correct, _) => labels.verdict(Verdict::Correct),
            (Self::Wrong, _) => labels.verdict(Verdict::Wrong),
            (Self::Rejected, _) => labels.verdict(Verdict::Rejected),
            (Self::Stopped, _) => labels.verdict(Verdict::Stopped),
            (Self::NotGraded, Language::En) => "Nothing to grade",
            (Self::NotGraded, Language::Ja) => "採点対象なし",
            (Self::Fault, Language::En) => "Grading failed",
            (Self::Fault, Language::Ja) => "採点エラー",
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
            assert_eq!(serde_json::to_value(standing).unwrap(), standing.id());
        }
    }
}
