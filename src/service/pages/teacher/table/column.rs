//! The columns of the table, and by what each sorts.

use crate::service::classes::Person;
use crate::service::pages::frame::PageFrame;

/// The columns that the table can be sorted by, with what stands first when one is chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SortColumn {
    Student,
    Verdict,
    Score,
    Mistakes,
    Attempts,
    Last,
}

impl SortColumn {
    pub const ALL: [Self; 6] = [Self::Student, Self::Verdict, Self::Score, Self::Mistakes, Self::Attempts, Self::Last];

    pub fn id(self) -> &'static str {
        match self {
            Self::Student => "student",
            Self::Verdict => "verdict",
            Self::Score => "score",
            Self::Mistakes => "mistakes",
            Self::Attempts => "attempts",
            Self::Last => "last",
        }
    }

    pub fn label(self, frame: &PageFrame) -> &'static str {
        match self {
            Self::Student => frame.say("Student", "学生"),
            Self::Verdict => frame.say("Verdict", "判定"),
            Self::Score => frame.say("Score", "得点"),
            Self::Mistakes => frame.say("Mistakes", "間違い"),
            Self::Attempts => frame.say("Attempts", "提出回数"),
            Self::Last => frame.say("Last", "最終提出"),
        }
    }

    /// Whether the greatest is looked for first.
    pub fn falls_first(self) -> bool {
        matches!(self, Self::Attempts | Self::Last)
    }

    pub fn is_number(self) -> bool {
        matches!(self, Self::Score | Self::Attempts)
    }

    pub fn compare(self, a: &Person, b: &Person) -> std::cmp::Ordering {
        let score = |person: &Person| person.counted().and_then(|row| row.row.total()).unwrap_or(-1.0);
        // Who has none stands behind who has one.
        let mistakes = |person: &Person| {
            let found = person.counted().map(|row| row.mistakes.join(" ")).unwrap_or_default();
            (found.is_empty(), found)
        };
        match self {
            Self::Student => by_number(a, b),
            Self::Verdict => a.standing().rank().cmp(&b.standing().rank()),
            Self::Score => score(a).total_cmp(&score(b)),
            Self::Mistakes => mistakes(a).cmp(&mistakes(b)),
            Self::Attempts => a.rows.len().cmp(&b.rows.len()),
            Self::Last => a.latest().cmp(&b.latest()),
        }
    }
}

/// The order of the class.
pub(super) fn by_number(a: &Person, b: &Person) -> std::cmp::Ordering {
    (&a.number, &a.name, &a.key).cmp(&(&b.number, &b.name, &b.key))
}
