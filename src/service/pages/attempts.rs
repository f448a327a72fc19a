//! What somebody has handed in, one card for each, on their own page and on the teacher's.

use super::datetime::TimeElement;
use super::frame::PageFrame;
use super::report_fragment;
use crate::language::{Language, span};
use crate::report::html::Mark;
use crate::report::text::number;
use crate::report::{Lateness, Verdict};
use crate::service::counting::Counting;
use crate::service::store::{HistoryRow, SubmissionState as Progress};

/// One attempt.
pub(super) struct Attempt {
    pub id: String,
    pub mark: Option<&'static str>,
    pub score: String,
    pub max_score: String,
    /// What lateness takes off, and what is left.
    pub late: Option<String>,
    pub word: &'static str,
    /// What an attempt that counts is called; none for the others.
    pub counts: Option<&'static str>,
    /// Whether it may be chosen to count.
    pub can_choose: bool,
    pub portrait: Option<String>,
    pub at: TimeElement,
    /// Title and id of each mistake, for those who teach.
    pub mistakes: Vec<(String, String)>,
    /// Whether driver and interpreter disagree, for those who teach.
    pub is_disputed: bool,
    /// The names of its files, for those who teach.
    pub file: String,
}

/// Which attempts count, and whether that may be changed.
#[derive(Clone, Copy)]
pub(super) struct CountingChoice<'a> {
    pub counting: Counting,
    /// Id of the attempt that counts.
    pub counted: Option<&'a str>,
    /// Whether whoever looks may let another one count.
    pub may_choose: bool,
}

impl Attempt {
    pub fn of(frame: &PageFrame, row: &HistoryRow, choice: CountingChoice<'_>) -> Self {
        let submission = &row.submission;
        let is_counted = choice.counted == Some(submission.id.as_str());
        let can_choose = choice.may_choose && choice.counting == Counting::Chosen && !is_counted;
        Self {
            id: submission.id.clone(),
            mark: row.verdict.map(|verdict| Mark::of_verdict(verdict, row.score.unwrap_or(0.0)).id()),
            score: report_fragment::points(row.score),
            max_score: report_fragment::points(row.max_score),
            late: row.lateness.map(|lateness| late(frame, lateness, row.total())),
            word: match (row.verdict, submission.state) {
                (Some(verdict), _) => report_fragment::verdict(frame, verdict),
                (None, Progress::Failed) => {
                    frame.say("Failed on our side; tried again soon", "サーバ側の障害。まもなく再採点します")
                }
                (None, _) => frame.say("Being graded", "採点中"),
            },
            counts: is_counted.then(|| match choice.counting {
                Counting::Best => frame.say("best", "最高"),
                Counting::Last | Counting::Chosen => frame.say("counts", "成績に反映"),
            }),
            can_choose: can_choose && row.score.is_some(),
            portrait: row.verdict.is_some_and(Verdict::is_drawn).then(|| frame.picture(&submission.id, "portrait")),
            at: frame.datetime(submission.received_at),
            mistakes: Vec::new(),
            is_disputed: false,
            file: String::new(),
        }
    }
}

/// What lateness takes off, and what is left: `1 day late: −20 → 60`.
fn late(frame: &PageFrame, lateness: Lateness, total: Option<f64>) -> String {
    let late = span(lateness.milliseconds, frame.language);
    let late = match frame.language {
        Language::En => format!("{late} late"),
        Language::Ja => format!("遅延 {late}"),
    };
    let taken = total.map(|total| format!(": −{} → {}", number(lateness.penalty), number(total)));
    late + &taken.unwrap_or_default()
}
