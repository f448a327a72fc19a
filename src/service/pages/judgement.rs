//! The page of a report as the place where people judge: what those who teach can do there, and what its student can ask.

pub(super) mod forms;

use super::datetime::TimeElement;
use super::frame::PageFrame;
use super::report_fragment;
use crate::language::Language;
use crate::report::Report;
use crate::report::labels::{mistake_title, rubric_label};
use crate::report::text::number;
use crate::service::State;
use crate::service::errors::Problem;
use crate::service::identity::{Teacher, Visitor};
use crate::service::judgement::{asker, is_gone};
use crate::service::store::{Appeal, StoredSubmission, Via};
use crate::service::submit::check_own;

/// What those who teach can do.
pub(super) struct StaffForms {
    pub csrf: String,
    pub lines: Vec<LineForm>,
    /// The names of the files.
    pub files: Vec<String>,
    pub comments: Vec<CommentLine>,
    pub repairs: Vec<ShownRepair>,
}

/// What would make a file right.
pub(super) struct ShownRepair {
    pub place: String,
    /// Id and title of the mistake.
    pub id: String,
    pub title: String,
    pub written: String,
    pub right: String,
}

/// A line of the rubric, and what it is given.
pub(super) struct LineForm {
    pub id: String,
    pub label: String,
    pub points: String,
    pub most: String,
    /// Whether the rubric has no such line any more.
    pub is_gone: bool,
    /// What the grading gave, and why it is overridden by whom.
    pub overridden: Option<(String, String, String)>,
}

/// A comment, with what removes it.
pub(super) struct CommentLine {
    pub id: String,
    pub place: String,
    pub text: String,
    pub author: String,
}

/// What was asked, for its student and for those who teach.
pub(super) struct ShownAppeal {
    pub id: String,
    pub label: String,
    pub question: String,
    pub at: TimeElement,
    /// How far it is, in words.
    pub standing: String,
    /// Whether somebody handles it, and who; empty where only the course is known.
    pub is_taken: bool,
    pub handler: String,
    pub answer: Option<String>,
}

/// What the student may ask: the token of the form, and ids and names of the rubric's lines.
pub(super) struct Question {
    pub csrf: String,
    pub lines: Vec<(String, String)>,
}

/// The lines of the rubric by id and name, those that lost points before the others.
fn asked_first(report: &Report, language: Language) -> Vec<(String, String)> {
    let mut lines: Vec<_> = report.rubric.iter().collect();
    lines.sort_by_key(|line| line.points >= line.max_points);
    lines.into_iter().map(|line| (line.id.clone(), line.label.get(language).to_owned())).collect()
}

/// Everything of it on one page.
pub(super) struct Judgement {
    /// None for who does not teach.
    pub desk: Option<StaffForms>,
    pub asked: Option<ShownAppeal>,
    /// None for who may not ask.
    pub question: Option<Question>,
}

impl Judgement {
    /// What there is for whoever looks at a report.
    pub async fn of(
        state: &State,
        frame: &PageFrame,
        stored: &StoredSubmission,
        teacher: Option<&Teacher>,
        visitor: &Visitor,
    ) -> Result<Self, Problem> {
        let submission = &stored.submission;
        let Some(report) = stored.report.as_ref().filter(|_| submission.via != Via::Editor) else {
            return Ok(Self { desk: None, asked: None, question: None });
        };
        let teacher = teacher.filter(|teacher| teacher.may_see(&submission.assignment));
        let is_theirs = visitor.identity.has_handed_in(submission);
        let desk = match teacher {
            Some(teacher) => Some(StaffForms::of(state, frame, stored, report, teacher).await?),
            None => None,
        };
        let appeal = match (is_theirs, asker(submission)) {
            (true, Some(asker)) => state.store.appeal_of(&submission.assignment, asker).await?,
            _ => None,
        };
        let may_ask = is_theirs && check_own(state, &visitor.identity, submission).await.is_ok();
        let question = (may_ask && appeal.is_none())
            .then(|| Question { csrf: visitor.csrf(state), lines: asked_first(report, frame.language) });
        let shown = match appeal {
            Some(appeal) => Some(appeal).filter(|appeal| appeal.submission_id == submission.id),
            None if desk.is_some() => state.store.appeal_about(&submission.id).await?,
            None => None,
        };
        Ok(Self { desk, asked: shown.map(|appeal| ShownAppeal::of(state, frame, appeal)), question })
    }
}

impl StaffForms {
    async fn of(
        state: &State,
        frame: &PageFrame,
        stored: &StoredSubmission,
        report: &Report,
        teacher: &Teacher,
    ) -> Result<Self, Problem> {
        let id = &stored.submission.id;
        let overrides = state.store.overrides(id).await?;
        let line = |line: &crate::report::RubricLine| LineForm {
            id: line.id.clone(),
            label: line.label.get(frame.language).to_owned(),
            points: number(line.points),
            most: number(line.max_points),
            is_gone: is_gone(line),
            overridden: overrides.iter().find(|given| given.line == line.id).map(|given| {
                let graded = report_fragment::points(line.graded);
                (graded, given.reason.clone(), given.author.clone().unwrap_or_default())
            }),
        };
        let place = |file: &str, line: i64| match frame.tag() {
            "ja" => format!("{file} {line} 行目"),
            _ => format!("{file}, line {line}"),
        };
        let comments = state.store.comments(id).await?.into_iter().map(|comment| CommentLine {
            place: place(&comment.file, comment.line),
            id: comment.id,
            text: comment.text,
            author: comment.author.unwrap_or_default(),
        });
        Ok(Self {
            csrf: teacher.csrf(state),
            lines: report.rubric.iter().map(line).collect(),
            files: report.sources.iter().map(|source| source.name.clone()).collect(),
            comments: comments.collect(),
            repairs: report
                .repairs
                .iter()
                .map(|repair| ShownRepair {
                    place: place(&repair.file, repair.line.into()),
                    title: mistake_title(&state.assignment, &repair.mistake, frame.language),
                    id: repair.mistake.clone(),
                    written: repair.written.clone(),
                    right: repair.right.clone(),
                })
                .collect(),
        })
    }
}

impl ShownAppeal {
    pub fn of(state: &State, frame: &PageFrame, appeal: Appeal) -> Self {
        Self {
            standing: standing(frame, &appeal),
            is_taken: appeal.taken_at.is_some(),
            label: rubric_label(&state.assignment, &appeal.line, frame.language).to_owned(),
            question: appeal.question,
            at: frame.datetime(appeal.asked_at),
            handler: appeal.handler.unwrap_or_default(),
            answer: appeal.answer,
            id: appeal.id,
        }
    }
}

/// How far an appeal is, in words.
pub(super) fn standing(frame: &PageFrame, appeal: &Appeal) -> String {
    let handler = appeal.taken_at.map(|_| appeal.handler.as_deref());
    match (&appeal.answer, handler, frame.tag()) {
        (Some(_), _, "ja") => "回答済み".to_owned(),
        (Some(_), ..) => "answered".to_owned(),
        (None, Some(handler), "ja") => format!("{} が対応中", handler.unwrap_or("担当者")),
        (None, Some(handler), _) => format!("{} is handling it", handler.unwrap_or("somebody of the staff")),
        (None, None, "ja") => "対応待ち".to_owned(),
        (None, None, _) => "nobody is handling it yet".to_owned(),
    }
}
