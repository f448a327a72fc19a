//! The marks that a teacher writes beside what was handed in.

use crate::report::Verdict;
use crate::report::labels::Labels;

/// How much of its points a line or a whole file earned, as a teacher marks it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// All points.
    Full,
    /// Some.
    Partial,
    /// None.
    None,
}

impl Mark {
    /// The mark of all that was handed in: what does not run earns none.
    pub fn of_verdict(verdict: Verdict, score: f64) -> Self {
        match verdict {
            Verdict::Correct => Self::Full,
            Verdict::Wrong if score > 0.0 => Self::Partial,
            Verdict::Wrong | Verdict::Rejected | Verdict::Stopped => Self::None,
        }
    }

    /// The mark of a line.
    pub(super) fn of(points: f64, max_points: f64) -> Self {
        match points {
            points if points >= max_points => Self::Full,
            points if points > 0.0 => Self::Partial,
            _ => Self::None,
        }
    }

    /// The name of its sign in the style sheet.
    pub fn id(self) -> &'static str {
        match self {
            Self::Full => "full",
            Self::Partial => "partial",
            Self::None => "none",
        }
    }

    /// Its sign as a character.
    pub(super) fn sign(self) -> &'static str {
        match self {
            Self::Full => "○",
            Self::Partial => "△",
            Self::None => "×",
        }
    }

    /// What it says, in words.
    pub(super) fn word(self, labels: &'static Labels) -> &'static str {
        match self {
            Self::Full => labels.full,
            Self::Partial => labels.partial,
            Self::None => labels.none,
        }
    }
}
