//! The page on which a student works: an editor, what came of it, and the attempts so far.

use super::assets;
use super::datetime::Moment;
use super::frame::Frame;
use super::report_fragment;
use super::standing::{Fact, StudentStanding};
use crate::language::Language;
use crate::report::Verdict;
use crate::report::html::Mark;
use crate::report::html::rich::{Piece, pieces};
use crate::service::clock::Millis;
use crate::service::identity::new_id;
use crate::service::store::{HistoryRow, State as Progress};
use crate::service::submit::{MAX_UPLOAD, too_large};
use crate::slots::Slot;
use askama::Template;
use reference::assignment::Stage;
use reference::typeset::Typeset;

/// Attempts that a page lists.
pub(super) const LISTED: u32 = 60;

/// What a student's page is made of.
pub(super) struct Desk<'a> {
    pub frame: Frame,
    /// The homework.
    pub homework: std::sync::Arc<reference::Assignment>,
    /// What may still be handed in.
    pub standing: StudentStanding<'a>,
    /// Student number.
    pub who: Option<String>,
    pub csrf: String,
    /// What this browser has handed in, the newest first.
    pub history: &'a [HistoryRow],
    /// Id and text of a submission to go on with, in place of the hand-out.
    pub own: Option<(String, String)>,
    /// What is to be said first.
    pub notice: Option<String>,
}

#[derive(Template)]
#[template(path = "service/pages/templates/student.html")]
struct StudentPage<'a> {
    frame: Frame,
    title: String,
    /// The names of the homework's files.
    file: String,
    /// Whether the homework is one file, which the editor shows.
    has_editor: bool,
    /// Extensions of the files that may be chosen.
    accepted: String,
    facts: Vec<Fact>,
    now: Millis,
    hindrance: Option<&'static str>,
    how: &'static str,
    steps: Vec<&'static str>,
    draft_word: &'static str,
    notice: Option<String>,
    who: Option<String>,
    action: String,
    draft: String,
    starter_address: String,
    key: String,
    csrf: String,
    /// By which the service knows a form that is sent twice.
    form_key: String,
    text: String,
    /// Id of the submission whose text it is.
    own: Option<String>,
    /// Where files are read as text, what the largest has in bytes, and what is said of others.
    read: String,
    most: usize,
    too_large: String,
    several: String,
    can_hand_in: bool,
    grades_drafts: bool,
    expected: String,
    /// The name of what is computed, by which the line to change is found.
    output: &'a str,
    task: Vec<Piece>,
    picture: &'a str,
    equation: Option<&'a Typeset>,
    attempts: Vec<Attempt>,
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
    pub fn render(mut self) -> askama::Result<String> {
        let homework = std::sync::Arc::clone(&self.homework);
        let id = &homework.id;
        let language = self.frame.language;
        let file = self.homework.files.first();
        let starter = file.map(|file| file.starter.clone()).unwrap_or_default();
        let standing = self.standing;
        let slots = &self.homework.files;
        let file_name = file_names(&self.homework);
        let several = match language {
            Language::En => format!("Several files: give one at a time. The homework is {file_name}."),
            Language::Ja => {
                format!("ファイルが複数あります。1 つずつ選んでください。課題のファイルは {file_name} です。")
            }
        };
        let (has_editor, accepted) = (slots.len() == 1, accepted(slots));
        let (own, text) = self.own.take().unzip();
        StudentPage {
            title: title(&self.homework, language),
            file: file_name,
            has_editor,
            accepted,
            facts: self.facts(),
            now: standing.now,
            hindrance: standing.hindrance(&self.frame),
            how: standing.how(&self.frame),
            steps: standing.steps(&self.frame),
            draft_word: standing.draft_word(&self.frame),
            can_hand_in: standing.can_hand_in(),
            grades_drafts: standing.grades_drafts(),
            attempts: self.attempts(),
            notice: self.notice,
            who: self.who,
            action: format!("/a/{id}"),
            draft: format!("/a/{id}/draft"),
            starter_address: format!("/a/{id}/starter"),
            key: format!("ggrade {id}"),
            csrf: self.csrf,
            form_key: new_id(),
            own,
            text: text.unwrap_or(starter),
            read: format!("/a/{id}/read"),
            most: MAX_UPLOAD,
            too_large: too_large().detail.get(language).to_owned(),
            several,
            expected: assets::expected(&homework),
            output: homework.interface.outputs.first().map_or("", |output| &output.name),
            task: task(&homework, &self.frame),
            picture: homework
                .task
                .as_ref()
                .map_or(self.frame.say("What a right answer draws", "正しい答えが描く画像"), |task| {
                    language.of(&task.picture)
                }),
            equation: homework.typeset.as_ref(),
            frame: self.frame,
        }
        .render()
    }

    fn facts(&self) -> Vec<Fact> {
        let mut facts = self.standing.facts(&self.frame);
        facts.extend(best_fact(&self.frame, self.history));
        facts
    }

    fn attempts(&self) -> Vec<Attempt> {
        let best = best(self.history).map(|row| row.submission.id.as_str());
        self.history.iter().map(|row| self.attempt(row, best)).collect()
    }

    fn attempt(&self, row: &HistoryRow, best: Option<&str>) -> Attempt {
        let submission = &row.submission;
        let verdict = match (row.verdict, submission.state) {
            (Some(verdict), _) => report_fragment::verdict(&self.frame, verdict),
            (None, Progress::Failed) => {
                self.frame.say("Failed on our side; tried again soon", "サーバ側の障害。まもなく再採点します")
            }
            (None, _) => self.frame.say("Being graded", "採点中"),
        };
        Attempt {
            href: format!("/r/{}", submission.id),
            mark: row.verdict.map(|verdict| mark(verdict, row.score).id()),
            score: report_fragment::points(row.score),
            max_score: report_fragment::points(row.max_score),
            verdict,
            is_best: best == Some(submission.id.as_str()),
            portrait: draws(row.verdict).then(|| self.frame.picture(&submission.id, "portrait")),
            at: self.frame.moment(submission.received_at),
        }
    }
}

/// The extensions of the files of a homework, for the browser's dialogue.
fn accepted(slots: &[Slot]) -> String {
    let mut extensions: Vec<&str> = Vec::new();
    for stage in slots.iter().map(|slot| slot.stage) {
        extensions.extend(match stage {
            Stage::Vertex => [".vert", ".vs"],
            Stage::Fragment => [".frag", ".fs"],
        });
    }
    extensions.dedup();
    extensions.extend([".glsl", ".txt", "text/plain", ".zip"]);
    extensions.join(",")
}

/// The best of some attempts, the newest first; of equals the first that was made.
fn best(history: &[HistoryRow]) -> Option<&HistoryRow> {
    let graded = history.iter().rev().filter(|row| row.score.is_some());
    graded.reduce(|best, next| if next.score > best.score { next } else { best })
}

/// What the best of some attempts got.
pub(super) fn best_fact(frame: &Frame, history: &[HistoryRow]) -> Option<Fact> {
    let best = best(history)?;
    let (score, most) = (report_fragment::points(best.score), report_fragment::points(best.max_score));
    let said = frame.say("Best so far", "これまでの最高");
    Some(Fact::plain("", format!("{said} {score} / {most}")))
}

/// What there is to do.
pub(super) fn task(homework: &reference::Assignment, frame: &Frame) -> Vec<Piece> {
    let draw_this = frame.say(
        "Complete the file so that it draws this picture.",
        "この画像を描くように、ファイルを完成させてください。",
    );
    pieces(homework.task.as_ref().map_or(draw_this, |task| frame.language.of(&task.text)))
}

/// The names of a homework's files, in one line.
pub(super) fn file_names(homework: &reference::Assignment) -> String {
    homework.files.iter().map(|slot| slot.name.as_str()).collect::<Vec<_>>().join(", ")
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
