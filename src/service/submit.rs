//! The one way in: every set of files that a student hands in, by page, editor or API.

use super::State;
use super::clock::millis;
use super::errors::Problem;
use super::grading::{GradingResult, Job};
use super::idempotency;
use super::identity::{Identity, new_id};
use super::roster::not_on_roster;
use super::store::{Audience, Key, NewSubmission, Stored, Submission, Via};
use super::{Config, metrics, store};
use crate::batch::intake::{self, Content, HandInPart};
use crate::diagnose::Hints;
use crate::diagnostic::Diagnostic;
use crate::fault::Fault;
use crate::hand_in::{HandIn, HandedInFile};
use crate::language::Text;
use crate::report::Report;
use crate::slots::Slot;
use crate::source;
use axum::http::StatusCode;
use sha2::{Digest, Sha256};
use std::sync::Arc;
use std::time::Instant;
use tokio::sync::broadcast;

/// Longest file that is taken, in bytes: a longer one is not read as text.
pub const MAX_UPLOAD: usize = source::MAX_BYTES;

/// Longest file name that is kept, in characters.
const LONGEST_NAME: usize = 200;

/// What somebody hands in.
#[derive(Clone, Debug)]
pub struct Upload {
    /// The files as they came: with any folders in their names, and archives unopened.
    pub hand_in: HandIn,
    /// Who hands in.
    pub identity: Identity,
    /// The way by which it comes.
    pub via: Via,
    /// How much the messages shall help; never more than the course allows.
    pub hints: Option<Hints>,
    /// The key with which it may come again.
    pub key: Option<idempotency::RequestKey>,
}

/// A hand-in that is stored.
#[derive(Clone, Debug)]
pub struct Receipt {
    /// What was stored.
    pub submission: Submission,
    /// What came of it, where that was known in time.
    pub outcome: Option<GradingResult>,
}

impl Receipt {
    /// The report, where it was made in time.
    pub fn report(&self) -> Option<&Arc<Report>> {
        match &self.outcome {
            Some(GradingResult::Graded(report)) => Some(report),
            _ => None,
        }
    }

    /// Our failure, where it was met in time.
    pub fn fault(&self) -> Option<&Arc<Fault>> {
        match &self.outcome {
            Some(GradingResult::Failed(fault)) => Some(fault),
            _ => None,
        }
    }
}

/// Stores a hand-in, has it graded, and waits a while for the report. What comes again with the same key is not stored
/// again: the answer is about what was stored the first time.
pub async fn submit(state: &State, upload: Upload) -> Result<Receipt, Problem> {
    let key = upload.key.as_ref().map(|given| key(state, given, &upload));
    if let Some(receipt) = stored_earlier(state, key.as_ref()).await? {
        return Ok(receipt);
    }
    let problem = match carry_out(state, upload, key.as_ref()).await {
        Ok(Some(receipt)) => return Ok(receipt),
        Ok(None) => None,
        Err(problem) => Some(problem),
    };
    // The same request may have been stored meanwhile; what it used up is no reason to refuse this one.
    match stored_earlier(state, key.as_ref()).await? {
        Some(receipt) => Ok(receipt),
        None => Err(problem.unwrap_or_else(|| Problem::internal(&"a key is taken by nothing"))),
    }
}

/// The key of an upload: everything counts that makes another upload of it.
fn key(state: &State, given: &idempotency::RequestKey, upload: &Upload) -> Key {
    let Upload { hand_in, identity, via, hints, .. } = upload;
    let parts = [&state.assignment.id, &hand_in.names(), &store::word(via), &store::word(hints), &hand_in.sha256()];
    given.of_student(identity, &parts.map(String::as_str))
}

/// What an earlier request with this key stored, with what has come of it or comes of it in time.
async fn stored_earlier(state: &State, key: Option<&Key>) -> Result<Option<Receipt>, Problem> {
    let earlier = idempotency::earlier(state, key).await?;
    let Some(id) = earlier.and_then(|earlier| earlier.submission_id) else { return Ok(None) };
    let mut listener = state.queue.listen(&id);
    let Some(Stored { submission, report, .. }) = state.store.stored(&id).await? else { return Ok(None) };
    let outcome = match (report, &submission.fault) {
        (Some(report), _) => Some(GradingResult::Graded(Arc::new(report))),
        (None, Some(fault)) => Some(GradingResult::Failed(Arc::new(fault.clone()))),
        (None, None) => in_time(state, &mut listener).await,
    };
    Ok(Some(Receipt { submission, outcome }))
}

/// What comes of a file, where it comes in time.
async fn in_time(state: &State, listener: &mut broadcast::Receiver<GradingResult>) -> Option<GradingResult> {
    tokio::select! {
        outcome = listener.recv() => outcome.ok(),
        () = tokio::time::sleep(Config::span(state.config.wait)) => None,
        () = state.ended() => None,
    }
}

/// Stores a file, and waits a while for its report; none where the key is taken.
async fn carry_out(state: &State, upload: Upload, key: Option<&Key>) -> Result<Option<Receipt>, Problem> {
    let (assignment, hand_in) = checked(state, &upload).await?;
    let new = new_submission(state, &assignment, &upload, hand_in);
    let known = state.store.known_report(&new.assignment, &new.hand_in.sha256(), new.seed, new.hints).await?;
    // One of a folder that was changed since is of another assignment. Those of old do not say which they are of.
    let is_of =
        |report: &Report| report.assignment_digest.is_empty() || report.assignment_digest == state.assignment.digest;
    if let Some(report) = known.filter(is_of) {
        return keep_known(state, new, key, report).await;
    }
    let place = state.queue.reserve().map_err(|full| {
        let mut problem = Problem::new(
            StatusCode::TOO_MANY_REQUESTS,
            "queue-full",
            format!("Many hand-ins wait to be graded; yours would be number {}. It was not stored: please send it again.",
                full.position),
            format!("採点待ちの提出が多く、あなたの提出は {} 番目になります。保存していませんので、もう一度送信してください。",
                full.position),
        )
        .retry_after(full.retry_after);
        problem.position = Some(full.position);
        problem
    })?;
    let mut listener = state.queue.listen(&new.id);
    let added = state.store.add_submission(&new, key).await;
    if !matches!(added, Ok(true)) {
        drop(listener);
        state.queue.tidy();
        return added.map(|_| None).map_err(Problem::from);
    }
    let submission = submission_of(&new, store::State::Queued);
    metrics::uploaded(&submission, false);
    place.fill(Job { submission: submission.clone(), hand_in: new.hand_in, since: Instant::now() });
    let outcome = in_time(state, &mut listener).await;
    Ok(Some(Receipt { submission, outcome }))
}

/// The files that the homework asks for, where they may be handed in at all.
async fn checked(state: &State, upload: &Upload) -> Result<(store::Assignment, HandIn), Problem> {
    if state.is_ending() {
        return Err(Problem::new(
            StatusCode::SERVICE_UNAVAILABLE,
            "ending",
            "The service is being restarted; nothing was stored. Please try again in a minute.",
            "サービスを再起動しています。何も保存されていません。1 分ほどしてからもう一度試してください。",
        )
        .retry_after(10));
    }
    let hand_in = asked_for(state, upload.hand_in.clone()).await?;
    let assignment = state.store.assignment(&state.assignment.id).await?;
    may_hand_in(state, &assignment, upload).await?;
    Ok((assignment, hand_in))
}

/// The files that the homework asks for among those that somebody sent, archives opened. What is missing, double or no
/// text is named; it is not stored and costs no attempt.
async fn asked_for(state: &State, sent: HandIn) -> Result<HandIn, Problem> {
    let given = given(state, sent.files);
    let options = intake::Options::new(&state.assignment);
    let chosen = tokio::task::spawn_blocking(move || intake::one(given, &options));
    let hand_in = match chosen.await.map_err(|panic| Problem::internal(&panic))? {
        Content::Files { hand_in, .. } => hand_in,
        Content::Nothing(why) => return Err(unfilled(&why)),
    };
    for (file, slot) in hand_in.files.iter().zip(&state.assignment.files) {
        check_text(slot, &file.bytes).map_err(|problem| match hand_in.files.len() {
            1 => problem,
            _ => problem.about(&file.name),
        })?;
    }
    Ok(hand_in)
}

/// What there is for which slot among the files that somebody chose, archives opened, see [`intake::some`].
pub(super) async fn for_slots(
    state: &State,
    sent: Vec<HandedInFile>,
    shown: usize,
) -> Result<impl Iterator<Item = (usize, HandedInFile)>, Problem> {
    let given = given(state, sent);
    let options = intake::Options::new(&state.assignment);
    let placed = tokio::task::spawn_blocking(move || intake::some(given, shown, &options));
    let placed = placed.await.map_err(|panic| Problem::internal(&panic))?.map_err(|why| unfilled(&why))?;
    Ok((0..).zip(placed).filter_map(|(slot, file)| Some((slot, file?))))
}

fn given(state: &State, sent: Vec<HandedInFile>) -> Vec<HandInPart> {
    let named = |(index, file): (usize, HandedInFile)| {
        let name = file_name(&file.name, state.assignment.files.get(index));
        HandInPart::File { file: HandedInFile { name, ..file }, local: None }
    };
    sent.into_iter().enumerate().map(named).collect()
}

/// The answer to files of which the homework's slots cannot be filled.
fn unfilled(why: &Text) -> Problem {
    Problem::new(
        StatusCode::UNPROCESSABLE_ENTITY,
        "files",
        format!("{} Nothing was stored.", why.en),
        format!("{}何も保存されていません。", why.ja),
    )
}

/// Whether the file for a slot can be read as text. What cannot is not stored and costs no attempt.
pub(super) fn check_text(slot: &Slot, bytes: &[u8]) -> Result<(), Problem> {
    if bytes.is_empty() {
        return Err(Problem::unprocessable(
            "The file is empty. Save it in your text editor and choose it again.",
            "ファイルが空です。テキストエディタで保存してから、もう一度選んでください。",
        ));
    }
    if bytes.len() > MAX_UPLOAD {
        return Err(too_large());
    }
    let Some(Diagnostic { message, hint, .. }) = source::not_text(slot.stage.into(), bytes) else { return Ok(()) };
    let (en, ja) = hint.map(|hint| (format!("{} ", hint.en), hint.ja)).unwrap_or_default();
    Err(Problem::new(
        StatusCode::UNPROCESSABLE_ENTITY,
        "not-text",
        format!("{} {en}Nothing was stored.", message.en),
        format!("{}{ja}何も保存されていません。", message.ja),
    ))
}

async fn may_hand_in(state: &State, assignment: &store::Assignment, upload: &Upload) -> Result<(), Problem> {
    let forbidden = |kind, en: &str, ja: &str| Err(Problem::new(StatusCode::FORBIDDEN, kind, en, ja));
    let now = state.clock.now();
    if assignment.opens_at.is_some_and(|opens| now < opens) {
        return forbidden("not-open", "Handing in has not begun yet.", "提出の受付はまだ始まっていません。");
    }
    let is_draft = upload.via == Via::Editor;
    if assignment.is_closed(now) && !(is_draft && assignment.practice) {
        return forbidden("closed", "Handing in is over.", "提出の受付は終了しました。");
    }
    if assignment.audience == Audience::Number && upload.identity.student().is_none() {
        return forbidden(
            "no-number",
            "Open the course link first and give your student number.",
            "先に授業のリンクを開き、学籍番号を入力してください。",
        );
    }
    // A number from before the roster counts for nobody; whoever hands in under it must learn that now.
    if !is_draft
        && let Some(student) = upload.identity.student()
        && is_stranger(state, student).await?
    {
        return Err(not_on_roster(&student.number));
    }
    if is_draft && !assignment.grades_drafts(now) {
        return forbidden(
            "no-drafts",
            "The number of attempts is limited, so nothing is graded while you type: hand in to be graded.",
            "提出回数に制限があるため、入力中の採点は行いません。提出すると採点します。",
        );
    }
    let Some(limit) = assignment.attempts.filter(|_| !is_draft) else { return Ok(()) };
    let student = upload.identity.student().map(|student| student.id.as_str());
    let made = match (upload.identity.owner_id(), student) {
        (None, None) => {
            return forbidden(
                "no-number",
                "The number of attempts is limited: hand in on the page, or say for which student.",
                "提出回数に制限があります。ページから提出するか、学生を指定してください。",
            );
        }
        (owner, student) => state.store.attempts(&assignment.id, owner.unwrap_or_default(), student).await?,
    };
    if made >= limit {
        return Err(Problem::new(
            StatusCode::FORBIDDEN,
            "attempts",
            format!("All {limit} attempts are used up."),
            format!("提出できる回数 ({limit} 回) を使い切りました。"),
        ));
    }
    Ok(())
}

/// Whether there is a roster, and this student is not on it.
pub(super) async fn is_stranger(state: &State, student: &store::Student) -> Result<bool, Problem> {
    Ok(!student.is_on_roster() && state.store.has_roster().await?)
}

/// The answer to a file that is larger.
pub(super) fn too_large() -> Problem {
    Problem::new(
        StatusCode::PAYLOAD_TOO_LARGE,
        "too-large",
        format!("The file is larger than {} KiB. A shader has a few kilobytes.", MAX_UPLOAD / 1024),
        format!("ファイルが {} KiB を超えています。シェーダは数キロバイトです。", MAX_UPLOAD / 1024),
    )
}

fn new_submission(state: &State, assignment: &store::Assignment, upload: &Upload, hand_in: HandIn) -> NewSubmission {
    let now = state.clock.now();
    let until = now + millis(Config::span(state.config.limits.lease));
    NewSubmission {
        id: new_id(),
        assignment: state.assignment.id.clone(),
        hand_in,
        owner_id: upload.identity.owner_id().map(str::to_owned),
        student_id: upload.identity.student().map(|student| student.id.clone()),
        batch_id: None,
        via: upload.via,
        seed: assignment.seed,
        hints: upload.hints.map_or(assignment.hints, |hints| hints.min(assignment.hints)),
        received_at: now,
        priority: 0,
        claim: Some((state.instance.clone(), until)),
    }
}

/// SHA-256 in hexadecimal.
pub(super) fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// The last part of a name as handed in, of a bearable length; the name that the homework asks for, where none is left.
pub(super) fn file_name(name: &str, slot: Option<&Slot>) -> String {
    let last = name.rsplit(['/', '\\']).next().unwrap_or_default();
    let clean: String = last.chars().filter(|c| !c.is_control()).take(LONGEST_NAME).collect();
    match slot {
        Some(slot) if clean.trim().is_empty() => slot.name.clone(),
        _ => clean,
    }
}

async fn keep_known(
    state: &State,
    new: NewSubmission,
    key: Option<&Key>,
    mut report: Report,
) -> Result<Option<Receipt>, Problem> {
    report.of_files(crate::grade::sources(&state.assignment, &new.hand_in));
    if !state.store.add_graded(&new, key, &report, state.clock.now()).await? {
        return Ok(None);
    }
    let submission = submission_of(&new, store::State::Graded);
    metrics::uploaded(&submission, true);
    if report.cross_check.take().is_none() {
        state.cross_checks.expect(&submission, &report);
    }
    Ok(Some(Receipt { submission, outcome: Some(GradingResult::Graded(Arc::new(report))) }))
}

fn submission_of(new: &NewSubmission, state: store::State) -> Submission {
    Submission {
        id: new.id.clone(),
        assignment: new.assignment.clone(),
        sha256: new.hand_in.sha256(),
        name: new.hand_in.names(),
        owner_id: new.owner_id.clone(),
        student_id: new.student_id.clone(),
        batch_id: new.batch_id.clone(),
        via: new.via,
        seed: new.seed,
        hints: new.hints,
        received_at: new.received_at,
        state,
        fault: None,
    }
}
