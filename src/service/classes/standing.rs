//! How people of a class stand.

use crate::report::Verdict;

/// How somebody stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PersonStanding {
    /// By the verdict of the attempt that counts.
    Graded(Verdict),
    /// Being graded.
    Queued,
    /// Our fault.
    Failed,
    /// There is something, and nothing to grade in it.
    Ungraded,
    /// On the roster, and nothing handed in.
    Nothing,
}

impl PersonStanding {
    /// Its name in an address.
    pub fn id(self) -> &'static str {
        match self {
            Self::Graded(Verdict::Correct) => "correct",
            Self::Graded(Verdict::Wrong) => "wrong",
            Self::Graded(Verdict::Rejected) => "rejected",
            Self::Graded(Verdict::Stopped) => "stopped",
            Self::Queued => "queued",
            Self::Failed => "failed",
            Self::Ungraded => "ungraded",
            Self::Nothing => "nothing",
        }
    }

    /// Its place from the best to the least.
    pub fn rank(self) -> usize {
        Self::ALL.iter().position(|standing| *standing == self).unwrap_or(Self::ALL.len())
    }

    /// Whether a teacher has to look: it could not be graded.
    pub fn is_trouble(self) -> bool {
        matches!(self, Self::Failed | Self::Ungraded)
    }

    /// All, from the best to the least.
    pub const ALL: [Self; 8] = [
        Self::Graded(Verdict::Correct),
        Self::Graded(Verdict::Wrong),
        Self::Graded(Verdict::Rejected),
        Self::Graded(Verdict::Stopped),
        Self::Queued,
        Self::Failed,
        Self::Ungraded,
        Self::Nothing,
    ];
}
