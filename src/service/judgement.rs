//! What people judge beside the grading: a line of the rubric is given other points, a line of a file is commented on, and a
//! student asks once in a homework for another look.

use super::errors::Problem;
use super::identity::{Identity, Teacher, new_id};
use super::store::{Appeal, StoredComment, StoredSubmission, Submission, Via};
use super::submit::check_own;
use super::texts::check_length;
use super::{Service, State};
use crate::report::{Report, RubricLine};
use axum::http::StatusCode;

/// Longest reason, question, answer or comment, in characters.
pub const LONGEST_TEXT: usize = 2000;

/// What a text is for.
#[derive(Clone, Copy)]
enum TextKind {
    Reason,
    Comment,
    Question,
    Answer,
}

impl TextKind {
    /// What it is called where it is too long.
    fn name(self) -> (&'static str, &'static str) {
        match self {
            Self::Reason => ("The reason", "理由"),
            Self::Comment => ("The comment", "コメント"),
            Self::Question => ("The question", "質問"),
            Self::Answer => ("The answer", "回答"),
        }
    }

    /// What is said where there is none.
    fn missing(self) -> (&'static str, &'static str) {
        match self {
            Self::Reason => (
                "There is no reason: say why, the student reads it.",
                "理由がありません。学生が読む理由を入力してください。",
            ),
            Self::Comment => ("The comment is empty.", "コメントが入力されていません。"),
            Self::Question => (
                "There is no question: say what is judged wrongly, and why.",
                "質問がありません。どの判定がなぜ誤りだと思うのかを入力してください。",
            ),
            Self::Answer => {
                ("The answer is empty: the student reads it.", "回答がありません。学生への回答を入力してください。")
            }
        }
    }

    /// A text as it is kept; a problem where there is none, or too much.
    fn read(self, given: &str) -> Result<String, Problem> {
        let text = given.trim().replace('\r', "");
        if text.is_empty() {
            let (en, ja) = self.missing();
            return Err(Problem::unprocessable(en, ja));
        }
        check_length(&text, LONGEST_TEXT, self.name())?;
        Ok(text)
    }
}

/// The report of what was handed in; a problem where there is none yet, or it is a draft.
fn report(stored: &StoredSubmission) -> Result<&Report, Problem> {
    let of_hand_in = stored.submission.via != Via::Editor;
    stored.report.as_ref().filter(|_| of_hand_in).ok_or_else(Problem::not_found)
}

fn staff_id(teacher: &Teacher) -> Option<&str> {
    teacher.staff().map(|member| member.id.as_str())
}

/// Whether a line gives no points at all: it says only what somebody gave in it before the rubric had no such line any more.
pub fn is_gone(line: &RubricLine) -> bool {
    line.max_points <= 0.0
}

/// The lines of the rubric without those that are gone.
fn lines(report: &Report) -> impl Iterator<Item = &RubricLine> {
    report.rubric.iter().filter(|line| !is_gone(line))
}

/// The refusal of a line that the rubric does not have.
fn no_such_line(report: &Report, line: &str) -> Problem {
    let lines: Vec<&str> = lines(report).map(|line| line.id.as_str()).collect();
    let lines = lines.join(", ");
    Problem::unprocessable(
        format!("The rubric has no line `{line}`. Its lines are: {lines}."),
        format!("採点項目「{line}」はありません。項目: {lines}"),
    )
}

/// Gives a line of the rubric other points than the grading, for a reason that its student reads; without points that is taken
/// back. What the log says of it; nothing where there is nothing to be taken back.
pub async fn override_line(
    service: &Service,
    teacher: &Teacher,
    stored: &StoredSubmission,
    line: &str,
    given: Option<(f64, &str)>,
) -> Result<Option<String>, Problem> {
    let report = report(stored)?;
    let of_rubric = lines(report).find(|it| it.id == line);
    let id = &stored.submission.id;
    let Some((points, reason)) = given else {
        let was = service.store.set_override(id, line, None, staff_id(teacher), service.clock.now()).await?;
        return Ok(was.then(|| match of_rubric.map(|it| (it.points, it.graded)) {
            Some((points, Some(graded))) => format!("{line}: {points} → {graded}"),
            _ => format!("{line}: –"),
        }));
    };
    let of_rubric = of_rubric.ok_or_else(|| no_such_line(report, line))?;
    let (before, most) = (of_rubric.points, of_rubric.max_points);
    if !(0.0..=most).contains(&points) {
        return Err(Problem::unprocessable(
            format!("The points of this line are a number from 0 to {most}."),
            format!("この項目の得点は 0 から {most} までの数で入力してください。"),
        ));
    }
    let reason = TextKind::Reason.read(reason)?;
    service.store.set_override(id, line, Some((points, &reason)), staff_id(teacher), service.clock.now()).await?;
    Ok(Some(format!("{line}: {before} → {points}, {reason}")))
}

/// Adds a comment on a line of a file that was handed in.
pub async fn comment(
    service: &Service,
    teacher: &Teacher,
    stored: &StoredSubmission,
    (file, line): (&str, u32),
    said: &str,
) -> Result<StoredComment, Problem> {
    report(stored)?;
    let id = &stored.submission.id;
    let sources = service.store.hand_in(id).await?.unwrap_or_default().readable();
    let file = match sources.as_slice() {
        [only] if file.is_empty() => Some(only),
        all => all.iter().find(|source| source.facts.name == file),
    };
    let has_line = |source: &crate::source::Source| line >= 1 && (line as usize) <= source.text.lines().count();
    let Some(file) = file.filter(|source| has_line(source)) else {
        return Err(Problem::unprocessable(
            "A comment is about a line of one of the files: there is no such file or no such line.",
            "コメントを付けるファイルまたは行がありません。",
        ));
    };
    let comment = StoredComment {
        id: new_id(),
        file: file.facts.name.clone(),
        line: i64::from(line),
        text: TextKind::Comment.read(said)?,
        author: None,
    };
    service.store.add_comment(id, &comment, staff_id(teacher), service.clock.now()).await?;
    Ok(comment)
}

/// By what somebody is known who asks about a submission: the student, or the browser.
pub fn asker(submission: &Submission) -> Option<&str> {
    submission.student_id.as_deref().or(submission.owner_id.as_deref())
}

/// Keeps what a student asks about a line of the rubric.
pub async fn ask(
    state: &State,
    identity: &Identity,
    stored: &StoredSubmission,
    line: &str,
    question: &str,
) -> Result<Appeal, Problem> {
    let submission = &stored.submission;
    let report = report(stored)?;
    check_own(state, identity, submission).await?;
    let asker = asker(submission).ok_or_else(Problem::not_found)?;
    if !report.rubric.iter().any(|it| it.id == line) {
        return Err(no_such_line(report, line));
    }
    let appeal = Appeal {
        id: new_id(),
        submission_id: submission.id.clone(),
        assignment: submission.assignment.clone(),
        line: line.to_owned(),
        question: TextKind::Question.read(question)?,
        asked_at: state.clock.now(),
        handler: None,
        taken_at: None,
        answer: None,
        answered_at: None,
        number: None,
        name: None,
        student_id: None,
    };
    if state.store.add_appeal(&appeal, asker).await? {
        return Ok(appeal);
    }
    Err(Problem::new(
        StatusCode::CONFLICT,
        "asked-before",
        "You have asked for another look in this homework before; that is possible once.",
        "この課題ではすでに再確認を依頼しています。依頼できるのは 1 回です。",
    ))
}

/// What is done about an appeal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Handling<'a> {
    /// Whoever does it handles it from now on.
    Take,
    /// Nobody handles it.
    Release,
    /// It is answered.
    Answer(&'a str),
}

/// Handles an appeal.
pub async fn handle(
    service: &Service,
    teacher: &Teacher,
    appeal: &Appeal,
    handling: Handling<'_>,
) -> Result<(), Problem> {
    teacher.check(&appeal.assignment)?;
    let (store, now) = (&service.store, service.clock.now());
    match handling {
        Handling::Take => store.take_appeal(&appeal.id, staff_id(teacher), Some(now)).await?,
        Handling::Release => store.take_appeal(&appeal.id, None, None).await?,
        Handling::Answer(answer) => {
            store.answer_appeal(&appeal.id, staff_id(teacher), &TextKind::Answer.read(answer)?, now).await?
        }
    }
    Ok(())
}
