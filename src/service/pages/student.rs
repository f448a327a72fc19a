//! The page on which a student works: an editor, what came of it, and the attempts so far.

use super::assets;
use super::attempts::{Attempt, CountingChoice};
use super::frame::{PageFrame, SignInLink};
use super::judgement;
use super::preview::PreviewPanel;
use super::report_fragment;
use super::standing::{Fact, StudentStanding};
use crate::language::Language;
use crate::report::html::rich::{MessagePiece, pieces};
use crate::service::State;
use crate::service::clock::Millis;
use crate::service::counting::{Counting, countable, counted};
use crate::service::identity::new_id;
use crate::service::store::{Appeal, HistoryRow, StudentRecord};
use crate::service::submit::{MAX_UPLOAD, too_large};
use crate::slots::Slot;
use askama::Template;
use percent_encoding::{NON_ALPHANUMERIC, utf8_percent_encode};
use reference::interpreter::Stage;
use reference::typeset::{SumPart, Typeset};

/// Digits of a folder's digest that tell its versions apart.
pub(super) const DIGITS: usize = 8;

/// Attempts that a page lists.
pub(super) const LISTED: u32 = 60;

/// What a student's page is made of.
pub(super) struct StudentPageParts<'a> {
    pub frame: PageFrame,
    /// The homework.
    pub state: &'a State,
    /// What may still be handed in.
    pub standing: StudentStanding<'a>,
    /// The student.
    pub who: Option<StudentRecord>,
    pub csrf: String,
    /// What this browser has handed in, the newest first.
    pub history: &'a [HistoryRow],
    /// What they asked to be looked at again.
    pub appeal: Option<Appeal>,
    /// Id and texts of a submission to go on with, in place of the hand-out.
    pub own: Option<(String, Vec<String>)>,
    /// What is to be said first.
    pub notice: Option<String>,
    /// What a preview says to the teacher who writes the homework.
    pub preview: Option<PreviewPanel>,
    /// How to say who one is.
    pub sign_ins: Vec<SignInLink>,
}

/// The mark of a page that shows an uploaded folder to who teaches.
struct FolderMark {
    /// The page of the folder.
    href: String,
    digest: String,
}

#[derive(Template)]
#[template(path = "service/pages/templates/student.html")]
struct StudentPage<'a> {
    frame: PageFrame,
    title: String,
    /// The names of the homework's files.
    file: String,
    /// An editor for each file of the homework.
    sheets: Vec<EditorSheet>,
    /// Extensions of the files that may be chosen.
    accepted: String,
    facts: Vec<Fact>,
    now: Millis,
    hindrance: Option<&'static str>,
    how: String,
    steps: Vec<&'static str>,
    draft_word: &'static str,
    notice: Option<String>,
    sign_ins: Vec<SignInLink>,
    action: String,
    draft: String,
    /// Where all that is handed out is downloaded.
    starter: String,
    csrf: String,
    /// By which the service knows a form that is sent twice.
    form_key: String,
    /// Id of the submission whose texts these are.
    own: Option<String>,
    /// Where files are read as text, what the largest has in bytes, and what is said of others.
    read: String,
    most: usize,
    too_large: String,
    can_hand_in: bool,
    grades_drafts: bool,
    expected: String,
    task: Vec<MessagePiece>,
    picture: &'a str,
    equation: Option<&'a Typeset>,
    attempts: Vec<Attempt>,
    /// Where a form lets an attempt count, and whether attempts can be deleted here.
    choose: String,
    deletable: bool,
    preview: Option<PreviewPanel>,
    folder: Option<FolderMark>,
}

/// The editor of one file.
struct EditorSheet {
    /// The file's name.
    name: String,
    /// The id of its text field.
    id: String,
    /// Under which the browser keeps drafts of it.
    key: String,
    /// Where the file that is handed out for it is.
    starter: String,
    /// The name of what is computed in it, by which the line to change is found.
    output: String,
    text: String,
}

impl StudentPageParts<'_> {
    /// The page.
    pub fn render(mut self) -> askama::Result<String> {
        let state = self.state;
        let (homework, page) = (&state.assignment, state.page());
        let language = self.frame.language;
        let standing = self.standing;
        let slots = &homework.files;
        let has_several = slots.len() > 1;
        let (own, texts) = self.own.take().unzip();
        StudentPage {
            title: title(homework, language),
            file: file_names(homework),
            sheets: sheets(state, texts),
            accepted: accepted(slots),
            facts: self.facts(),
            now: standing.now,
            hindrance: standing.hindrance(&self.frame),
            how: standing.how(&self.frame, has_several),
            steps: standing.steps(&self.frame),
            draft_word: standing.draft_word(&self.frame),
            can_hand_in: standing.can_hand_in(),
            grades_drafts: standing.grades_drafts() && state.looked_at().is_none(),
            attempts: self.attempts(),
            choose: format!("{page}/choose"),
            deletable: false,
            notice: self.notice,
            preview: self.preview,
            folder: state.looked_at().map(|folder| FolderMark {
                href: format!("{}/teacher/folders/{folder}", state.root()),
                digest: homework.digest.chars().take(DIGITS).collect(),
            }),
            sign_ins: self.sign_ins,
            draft: format!("{page}/draft"),
            starter: starter(state),
            csrf: self.csrf,
            form_key: new_id(),
            own,
            read: format!("{page}/read"),
            action: page,
            most: MAX_UPLOAD,
            too_large: too_large().detail.get(language).to_owned(),
            expected: assets::expected(homework),
            task: task(homework, &self.frame),
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
        if let Some(appeal) = &self.appeal {
            let asked = self.frame.say("Another look:", "再確認:");
            facts.push(Fact::plain("", format!("{asked} {}", judgement::standing(&self.frame, appeal))));
        }
        facts.extend(counted_fact(&self.frame, &self.countable(), self.standing.settings.counting));
        facts
    }

    /// What can count of the history.
    fn countable(&self) -> Vec<&HistoryRow> {
        countable(self.history, self.who.as_ref().map(|student| student.id.as_str()))
    }

    fn attempts(&self) -> Vec<Attempt> {
        let settings = self.standing.settings;
        let counting = settings.counting;
        let countable = self.countable();
        let counted = counted(&countable, counting, |row| *row).map(|row| row.submission.id.as_str());
        let may_choose = self.standing.may_hand_in && !settings.is_closed(self.standing.now);
        let choice = CountingChoice { counting, counted, may_choose };
        self.history.iter().map(|row| Attempt::of(&self.frame, row, choice)).collect()
    }
}

/// The address of all that is handed out.
fn starter(state: &State) -> String {
    format!("{}/starter", state.page())
}

/// The editors of a homework's files, with these texts or what is handed out.
fn sheets(state: &State, texts: Option<Vec<String>>) -> Vec<EditorSheet> {
    let homework = &state.assignment;
    let (slots, id) = (&homework.files, &homework.id);
    // What is typed at a page that is looked at is no draft of the page that students have.
    let id = state.looked_at().map_or_else(|| id.clone(), |folder| format!("{id} {folder}"));
    let mut texts = texts.unwrap_or_default().into_iter();
    let sheet = |(index, slot): (usize, &Slot)| {
        let suffix = if index == 0 { String::new() } else { format!("-{}", index + 1) };
        let encoded = utf8_percent_encode(&slot.name, NON_ALPHANUMERIC);
        EditorSheet {
            name: slot.name.clone(),
            id: format!("code{suffix}"),
            key: if slots.len() == 1 { format!("ggrade {id}") } else { format!("ggrade {id} {}", slot.name) },
            starter: format!("{}?file={encoded}", starter(state)),
            output: computed(homework, slot.stage).to_owned(),
            text: texts.next().unwrap_or_else(|| slot.starter.clone()),
        }
    };
    slots.iter().enumerate().map(sheet).collect()
}

/// The name of what a stage of the homework computes.
fn computed(homework: &reference::Assignment, stage: Stage) -> &str {
    let is_last = stage == Stage::Fragment || homework.files.iter().all(|slot| slot.stage == stage);
    let output = homework.interface.outputs.first().filter(|_| is_last);
    output.map_or("gl_Position", |output| &output.name)
}

/// The extensions of the files of a homework, for the browser's dialogue.
fn accepted(slots: &[Slot]) -> String {
    let mut extensions: Vec<&str> = Vec::new();
    for slot in slots {
        extensions.extend(match (&slot.program, slot.stage) {
            (Some(_), _) => [".cpp", ".cc"],
            (None, Stage::Vertex) => [".vert", ".vs"],
            (None, Stage::Fragment) => [".frag", ".fs"],
        });
    }
    extensions.dedup();
    if slots.iter().any(|slot| slot.program.is_none()) {
        extensions.push(".glsl");
    }
    extensions.extend([".txt", "text/plain", ".zip"]);
    extensions.join(",")
}

/// What counts of some attempts, the newest first.
pub(super) fn counted_fact(frame: &PageFrame, history: &[&HistoryRow], counting: Counting) -> Option<Fact> {
    let row = counted(history, counting, |row| *row)?;
    let (total, most) = (report_fragment::points(row.total()), report_fragment::points(row.max_score));
    let said = match counting {
        Counting::Best => frame.say("Best so far", "これまでの最高"),
        Counting::Last | Counting::Chosen => frame.say("Counts so far", "現在の得点"),
    };
    Some(Fact::plain("", format!("{said} {total} / {most}")))
}

/// What there is to do.
pub(super) fn task(homework: &reference::Assignment, frame: &PageFrame) -> Vec<MessagePiece> {
    let draw_this = match homework.files.len() {
        1 => frame.say(
            "Complete the file so that it draws this picture.",
            "この画像を描くように、ファイルを完成させてください。",
        ),
        _ => frame.say(
            "Complete the files so that they draw this picture.",
            "この画像を描くように、すべてのファイルを完成させてください。",
        ),
    };
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
