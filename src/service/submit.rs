//! The one way in: every set of files that a student hands in, by page, editor or API.

mod files;

mod allowed;

use super::State;
use super::errors::Problem;
use super::grading::{self, GradingResult};
use super::idempotency;
use super::identity::{Identity, new_id};
use super::store::{Added, NewSubmission, Priority, Sender, StoredKey, StoredSubmission, Submission, Via};
use super::{Config, metrics, store};
use crate::fault::Fault;
use crate::hand_in::{HandIn, hexadecimal};
use crate::report::{Hints, Report};
use crate::slots::Slot;
use crate::source;
use crate::source::lookalikes::is_bidi;
pub(super) use allowed::{check_own, closed, is_stranger, not_shown};
use allowed::{may_hand_in, no_attempt_left};
use axum::http::StatusCode;
use files::checked;
pub(super) use files::{check_text, for_slots};
use sha2::{Digest, Sha256};
use std::net::IpAddr;
use std::sync::Arc;
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
    /// The address that it comes from.
    pub address: IpAddr,
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
        Ok(Some(receipt)) => return with_lateness(state, receipt).await,
        Ok(None) => None,
        Err(problem) => Some(problem),
    };
    // The same request may have been stored meanwhile; what it used up is no reason to refuse this one.
    match stored_earlier(state, key.as_ref()).await? {
        Some(receipt) => Ok(receipt),
        None => Err(problem.unwrap_or_else(|| Problem::internal(&"a key is taken by nothing"))),
    }
}

/// The receipt with what lateness takes off, which grading does not know.
async fn with_lateness(state: &State, mut receipt: Receipt) -> Result<Receipt, Problem> {
    if let Some(GradingResult::Graded(report)) = &mut receipt.outcome
        && let Some(lateness) = state.store.lateness(&receipt.submission.id).await?
    {
        Arc::make_mut(report).lateness = Some(lateness);
    }
    Ok(receipt)
}

/// The key of an upload: everything counts that makes another upload of it.
fn key(state: &State, given: &idempotency::RequestKey, upload: &Upload) -> StoredKey {
    let Upload { hand_in, identity, via, hints, .. } = upload;
    let parts = [&state.assignment.id, &hand_in.names(), &store::word(via), &store::word(hints), &hand_in.sha256()];
    given.of_student(identity, &parts.map(String::as_str))
}

/// What an earlier request with this key stored, with what has come of it or comes of it in time.
async fn stored_earlier(state: &State, key: Option<&StoredKey>) -> Result<Option<Receipt>, Problem> {
    let earlier = idempotency::earlier(state, key).await?;
    let Some(id) = earlier.and_then(|earlier| earlier.submission_id) else { return Ok(None) };
    let mut listener = state.queue.listen(&id);
    let Some(StoredSubmission { submission, report, .. }) = state.store.stored(&id).await? else { return Ok(None) };
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
async fn carry_out(state: &State, upload: Upload, key: Option<&StoredKey>) -> Result<Option<Receipt>, Problem> {
    let (assignment, hand_in) = checked(state, &upload).await?;
    let mut new = new_submission(state, &assignment, &upload, hand_in);
    let known = state.store.known_report(&new.assignment, &new.hand_in.sha256(), new.seed, new.hints).await?;
    // One of a folder that was changed since is of another assignment. Those of old do not say which they are of.
    let is_of =
        |report: &Report| report.assignment_digest.is_empty() || report.assignment_digest == state.assignment.digest;
    if let Some(report) = known.filter(is_of) {
        return keep_known(state, new, key, report).await;
    }
    if let Some(sender) = new.senders.first() {
        new.priority = state.store.priority(&new.hand_in.sha256(), sender, new.received_at).await?;
    }
    let waiting = state.store.queue_length(new.received_at, state.queue.capacity()).await?;
    let place = state.queue.reserve(waiting).map_err(|full| {
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
    let added = state.store.add_submission(&new, key).await.map_err(Problem::from);
    let is_stored = added.and_then(|added| is_stored(&new, added));
    if !matches!(is_stored, Ok(true)) {
        drop(listener);
        state.queue.tidy();
        return is_stored.map(|_| None);
    }
    let submission = submission_of(&new, store::SubmissionState::Queued);
    metrics::uploaded(&submission, false);
    drop(place);
    grading::files_wait(state).await;
    let outcome = in_time(state, &mut listener).await;
    Ok(Some(Receipt { submission, outcome }))
}

/// Whether a hand-in is stored, which it is not where its key is taken; a problem where no attempt is left.
fn is_stored(new: &NewSubmission, added: Added) -> Result<bool, Problem> {
    match added {
        Added::Stored => Ok(true),
        Added::KeyTaken => Ok(false),
        Added::NoAttemptLeft => Err(no_attempt_left(new.most_attempts.unwrap_or_default())),
    }
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

fn new_submission(
    state: &State,
    assignment: &store::AssignmentSettings,
    upload: &Upload,
    hand_in: HandIn,
) -> NewSubmission {
    let now = state.clock.now();
    let owner = upload.identity.student_id().or(upload.identity.owner_id()).map(|id| Sender::Owner(id.to_owned()));
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
        priority: Priority::Student,
        senders: owner.into_iter().chain([Sender::Address(upload.address)]).collect(),
        most_attempts: assignment.attempts.filter(|_| upload.via != Via::Editor),
    }
}

/// SHA-256 in hexadecimal.
pub(super) fn sha256(bytes: &[u8]) -> String {
    hexadecimal(&Sha256::digest(bytes))
}

/// The last part of a name as handed in, of a bearable length and without what turns the direction of writing, which makes an ending
/// look like another one; the name that the homework asks for, where none is left.
pub(super) fn file_name(name: &str, slot: Option<&Slot>) -> String {
    let last = name.rsplit(['/', '\\']).next().unwrap_or_default();
    let clean: String = last.chars().filter(|c| !c.is_control() && !is_bidi(*c)).take(LONGEST_NAME).collect();
    match slot {
        Some(slot) if clean.trim().is_empty() => slot.name.clone(),
        _ => clean,
    }
}

async fn keep_known(
    state: &State,
    new: NewSubmission,
    key: Option<&StoredKey>,
    mut report: Report,
) -> Result<Option<Receipt>, Problem> {
    report.of_files(crate::grade::sources(&state.assignment, &new.hand_in));
    let added = state.store.add_graded(&new, key, &report, state.clock.now()).await?;
    if !is_stored(&new, added)? {
        return Ok(None);
    }
    let submission = submission_of(&new, store::SubmissionState::Graded);
    metrics::uploaded(&submission, true);
    if report.cross_check.take().is_none() {
        state.cross_checks.expect(&submission, &report);
    }
    Ok(Some(Receipt { submission, outcome: Some(GradingResult::Graded(Arc::new(report))) }))
}

fn submission_of(new: &NewSubmission, state: store::SubmissionState) -> Submission {
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
