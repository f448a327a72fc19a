//! The page on which a student works: an editor, what came of it, and the attempts so far.

use super::assets;
use super::frame::Frame;
use super::moment::Moment;
use super::part;
use crate::language::Language;
use crate::report::html::Mark;
use crate::report::{Equation, Verdict};
use crate::service::clock::Millis;
use crate::service::store::{Assignment, HistoryRow, State as Progress};
use askama::Template;

/// Longest file that is shown in the editor, in bytes.
const LONGEST_SHOWN: usize = 200_000;

/// What a student's page is made of.
pub(super) struct Desk<'a> {
    pub frame: Frame,
    /// The homework.
    pub homework: &'static reference::Assignment,
    /// What the teacher set for it.
    pub settings: &'a Assignment,
    pub now: Millis,
    /// Student number.
    pub who: Option<String>,
    /// Whether the course knows enough of who sits there.
    pub may_hand_in: bool,
    pub csrf: String,
    /// What this browser has handed in, the newest first.
    pub history: &'a [HistoryRow],
    /// Attempts that count.
    pub used: u64,
    /// A text in place of the hand-out.
    pub text: Option<String>,
    /// What is to be said first.
    pub notice: Option<String>,
}

#[derive(Template)]
#[template(path = "service/student.html")]
struct View {
    frame: Frame,
    title: String,
    file: String,
    facts: Vec<Fact>,
    notice: Option<String>,
    who: Option<String>,
    action: String,
    draft: String,
    starter_address: String,
    key: String,
    csrf: String,
    text: String,
    has_own_text: bool,
    can_hand_in: bool,
    grades_drafts: bool,
    expected: &'static str,
    output: String,
    equation: Equation,
    equation_source: String,
    attempts: Vec<Attempt>,
}

/// Something to know before handing in.
struct Fact {
    kind: &'static str,
    text: String,
}

/// One attempt.
struct Attempt {
    href: String,
    mark: Option<&'static str>,
    score: String,
    max_score: String,
    verdict: &'static str,
    is_best: bool,
    portrait: Option<String>,
    at: Moment,
}

impl Desk<'_> {
    /// The page.
    pub fn render(self) -> askama::Result<String> {
        let id = &self.homework.id;
        let language = self.frame.language;
        let file = self.homework.files.first();
        let starter = file.map(|file| file.starter.clone()).unwrap_or_default();
        let output = self.homework.interface.outputs.first().map(|output| output.name.clone());
        let equation = Equation::illumination();
        let text = self.text.clone().filter(|text| text.len() <= LONGEST_SHOWN);
        View {
            title: title(self.homework, language),
            file: file.map(|file| file.name.clone()).unwrap_or_default(),
            facts: self.facts(),
            can_hand_in: self.can_hand_in(),
            grades_drafts: self.grades_drafts(),
            attempts: self.attempts(),
            notice: self.notice,
            who: self.who,
            action: format!("/a/{id}"),
            draft: format!("/a/{id}/draft"),
            starter_address: format!("/a/{id}/starter"),
            key: format!("ggrade {id}"),
            csrf: self.csrf,
            has_own_text: text.is_some(),
            text: text.unwrap_or(starter),
            expected: assets::address(&assets::expected_name(id)),
            output: output.unwrap_or_default(),
            equation_source: equation.source.get(language).to_owned(),
            equation,
            frame: self.frame,
        }
        .render()
    }

    fn attempts_left(&self) -> Option<u64> {
        self.settings.attempts.map(|most| most.saturating_sub(self.used))
    }

    fn can_hand_in(&self) -> bool {
        self.may_hand_in && self.settings.is_open(self.now) && self.attempts_left() != Some(0)
    }

    /// Whether what is typed is graded: not where attempts are counted.
    fn grades_drafts(&self) -> bool {
        self.may_hand_in && self.settings.is_open(self.now) && self.settings.attempts.is_none()
    }

    fn facts(&self) -> Vec<Fact> {
        let language = self.frame.language;
        let moment = |at| Moment::of(at, language).text;
        let mut facts = Vec::new();
        let mut fact = |kind, en: String, ja: String| {
            facts.push(Fact { kind, text: if language == Language::En { en } else { ja } });
        };
        match (self.settings.opens_at, self.settings.closes_at) {
            (Some(opens), _) if self.now < opens => {
                let opens = moment(opens);
                fact("urgent", format!("Opens {opens}"), format!("受付開始 {opens}"));
            }
            (_, Some(closes)) if self.now >= closes => {
                let closes = moment(closes);
                fact("urgent", format!("Closed since {closes}"), format!("受付終了 {closes}"));
            }
            (_, Some(closes)) => {
                let kind = if closes - self.now < 24 * 3_600_000 { "urgent" } else { "" };
                let closes = moment(closes);
                fact(kind, format!("Due {closes}"), format!("締切 {closes}"));
            }
            _ => {}
        }
        if let (Some(most), Some(left)) = (self.settings.attempts, self.attempts_left()) {
            let kind = if left <= 1 { "urgent" } else { "" };
            fact(kind, format!("{left} of {most} attempts left"), format!("提出できる回数 残り {left} / {most}"));
        }
        if let Some(best) = self.best() {
            let best = self.history.iter().find(|row| row.submission.id == best);
            let (score, most) = best.map_or((None, None), |row| (row.score, row.max_score));
            let (score, most) = (part::points(score), part::points(most));
            fact("", format!("Best so far {score} / {most}"), format!("これまでの最高 {score} / {most}"));
        }
        facts
    }

    /// Id of the best attempt; of equals the first.
    fn best(&self) -> Option<&str> {
        let graded = self.history.iter().rev().filter_map(|row| Some((row.score?, row.submission.id.as_str())));
        graded.reduce(|best, next| if next.0 > best.0 { next } else { best }).map(|(_, id)| id)
    }

    fn attempts(&self) -> Vec<Attempt> {
        let best = self.best();
        self.history.iter().map(|row| self.attempt(row, best)).collect()
    }

    fn attempt(&self, row: &HistoryRow, best: Option<&str>) -> Attempt {
        let submission = &row.submission;
        let verdict = match (row.verdict, submission.state) {
            (Some(verdict), _) => part::verdict(&self.frame, verdict),
            (None, Progress::Failed) => {
                self.frame.say("Failed on our side; tried again soon", "サーバ側の障害。まもなく再採点します")
            }
            (None, _) => self.frame.say("Being graded", "採点中"),
        };
        Attempt {
            href: format!("/r/{}", submission.id),
            mark: row.verdict.map(|verdict| mark(verdict, row.score).id()),
            score: part::points(row.score),
            max_score: part::points(row.max_score),
            verdict,
            is_best: best == Some(submission.id.as_str()),
            portrait: draws(row.verdict).then(|| format!("/r/{}/portrait.png", submission.id)),
            at: Moment::of(submission.received_at, self.frame.language),
        }
    }
}

/// The homework's title.
pub(super) fn title(homework: &reference::Assignment, language: Language) -> String {
    match language {
        Language::En => homework.title.en.clone(),
        Language::Ja => homework.title.ja.clone(),
    }
}

/// The sign of a result of which only verdict and points are known.
pub(super) fn mark(verdict: Verdict, score: Option<f64>) -> Mark {
    match verdict {
        Verdict::Correct => Mark::Full,
        Verdict::Wrong if score.unwrap_or(0.0) > 0.0 => Mark::Partial,
        Verdict::Wrong | Verdict::Rejected | Verdict::Stopped => Mark::None,
    }
}

/// Whether a file with this verdict has been drawn.
pub(super) fn draws(verdict: Option<Verdict>) -> bool {
    matches!(verdict, Some(Verdict::Correct | Verdict::Wrong))
}
