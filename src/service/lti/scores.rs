//! Grades go home: the attempt of each student that counts, until the platform has it.
//!
//! What the platform has is compared with what stands here again and again, so that whatever changes a score is sent (an attempt, a
//! regrading), and a platform that does not answer gets it later. A score is claimed before it is sent, so that one process sends
//! it, and what is sent is what stands after that; so no older score comes after a newer one.

use super::super::Service;
use super::super::clock::Millis;
use super::super::store::{DueScore, Platform, Result as StoreResult};
use super::address;
use super::platform::{Connections, Failure};
use crate::language::Language;
use crate::report::Report;
use crate::report::labels::Labels;
use crate::report::text::number;
use reqwest::{Method, Url};
use serde_json::{Value, json};
use std::collections::{BTreeMap, HashMap};
use std::time::{Duration, Instant};
use tokio::task::{JoinHandle, JoinSet};

/// What this service may do to scores.
pub(super) const SCOPE: &str = "https://purl.imsglobal.org/spec/lti-ags/scope/score";

/// How often it is looked whether something is due.
const TICK: Duration = Duration::from_secs(5);

/// Platforms may compare times by this.
const SECOND: Millis = 1_000;

/// The first pause after a failure, and the longest, in milliseconds.
const FIRST_PAUSE: Millis = 5_000;
const LONGEST_PAUSE: Millis = 3_600_000;

/// How long a score is kept from other processes while it is sent: longer than a token and an answer may take.
const CLAIM: Millis = 60_000;

/// A failure that takes as long as this is one of the platform, and not of the one score.
const HANGS: Duration = Duration::from_secs(5);

/// Runs until the service is told to end. A round passes over platforms with which an earlier one is not done, so that one that
/// does not answer holds up no other.
pub async fn run(service: Service) {
    let mut under_way: HashMap<(String, String), JoinHandle<()>> = HashMap::new();
    loop {
        under_way.retain(|_, sending| !sending.is_finished());
        for course in service.everywhere() {
            for (platform, due) in due(&course).await {
                let key = (course.root().to_owned(), platform);
                under_way.entry(key).or_insert_with(|| tokio::spawn(send_all(course.clone(), due)));
            }
        }
        tokio::select! {
            () = tokio::time::sleep(TICK) => {}
            () = service.ended() => return,
        }
    }
}

/// Sends what is due now, to all platforms at once.
pub async fn send_due(service: &Service) {
    let due = due(service).await.into_values();
    let sending: JoinSet<()> = due.map(|due| send_all(service.clone(), due)).collect();
    sending.join_all().await;
}

/// What is due, by platform.
async fn due(service: &Service) -> BTreeMap<String, Vec<DueScore>> {
    let mut all: BTreeMap<String, Vec<DueScore>> = BTreeMap::new();
    if let Err(error) = service.store.expect_scores().await {
        tracing::error!(%error, "scores for learning platforms");
    }
    match service.store.due_scores(service.clock.now()).await {
        Ok(due) => due.into_iter().for_each(|due| all.entry(due.platform_id.clone()).or_default().push(due)),
        Err(error) => tracing::error!(%error, "scores for learning platforms"),
    }
    all
}

/// Sends scores to a platform, one after another. What is left when it hangs is for the next round.
async fn send_all(service: Service, due: Vec<DueScore>) {
    for due in due {
        if service.is_ending() {
            return;
        }
        let start = Instant::now();
        match claim_and_send(&service, &due).await {
            Ok(true) => {}
            Ok(false) if start.elapsed() < HANGS => {}
            Ok(false) => return,
            Err(error) => return tracing::error!(%error, "scores for learning platforms"),
        }
    }
}

/// Sends what is due by now of one that was due, unless another process does; whether it did not fail.
async fn claim_and_send(service: &Service, due: &DueScore) -> StoreResult<bool> {
    let now = service.clock.now();
    let Some(due) = service.store.claim_score(due, now, now + CLAIM).await? else { return Ok(true) };
    let at = now.max(after(due.sent_at));
    let sent = send(service, &due, at).await;
    match &sent {
        Ok(()) => service.store.score_sent(&due, at).await?,
        Err(failure) => {
            tracing::warn!(failure, "a learning platform did not take a score");
            let pause = FIRST_PAUSE.saturating_mul(1 << due.tries.clamp(0, 16)).min(LONGEST_PAUSE);
            service.store.score_failed(&due, failure, service.clock.now() + pause).await?;
        }
    }
    Ok(sent.is_ok())
}

/// The first time that is later than another one for a platform that counts whole seconds, as Moodle does.
fn after(sent_at: Millis) -> Millis {
    (sent_at / SECOND + 1) * SECOND
}

async fn send(service: &Service, due: &DueScore, at: Millis) -> Result<(), Failure> {
    let failed = |error: &dyn std::fmt::Display| error.to_string();
    let platform: Platform = service
        .store
        .platform(&due.platform_id)
        .await
        .map_err(|error| failed(&error))?
        .ok_or_else(|| "the platform is gone".to_owned())?;
    let stored = service.store.stored(&due.submission_id).await.map_err(|error| failed(&error))?;
    let report = stored.and_then(|stored| stored.report).ok_or_else(|| "the report is gone".to_owned())?;
    let language = service.store.course().await.map_err(|error| failed(&error))?.language;
    let page = address(service).map_err(|problem| problem.detail.en)?;
    let page = format!("{page}/r/{}", due.submission_id);
    let body = body(due, &report, language, &page, at);
    let address = scores_of(&due.line_item)?;
    let kind = "application/vnd.ims.lis.v1.score+json";
    Connections::call(service, &platform, SCOPE, (Method::POST, &address, kind), Some(&body)).await?;
    Ok(())
}

/// Where scores of a line item go: below its path, before its query.
fn scores_of(line_item: &str) -> Result<String, Failure> {
    let mut url = Url::parse(line_item).map_err(|error| format!("{line_item}: {error}"))?;
    let path = format!("{}/scores", url.path().trim_end_matches('/'));
    url.set_path(&path);
    Ok(url.to_string())
}

fn body(due: &DueScore, report: &Report, language: Language, page: &str, at: Millis) -> Value {
    json!({
        "userId": due.subject,
        "scoreGiven": report.total(),
        "scoreMaximum": report.max_score,
        "comment": comment(report, language, page),
        "timestamp": jiff::Timestamp::from_millisecond(at).map(|at| format!("{at:.3}")).unwrap_or_default(),
        "activityProgress": "Submitted",
        "gradingProgress": "FullyGraded",
    })
}

/// What the gradebook says beside a score, as plain text: each rubric line, what costs points, and where the report is.
fn comment(report: &Report, language: Language, page: &str) -> String {
    let mut lines = vec![format!(
        "{} {} / {}",
        Labels::of(language).headline(report.verdict),
        number(report.score),
        number(report.max_score)
    )];
    for line in &report.rubric {
        lines.push(format!("{} {} / {}", line.label.get(language), number(line.points), number(line.max_points)));
        if line.points < line.max_points || line.graded.is_some() {
            lines.push(line.message.get(language).replace('`', ""));
        }
    }
    lines.extend(report.comment_lines(language));
    lines.extend(report.lateness_lines(language));
    lines.push(page.to_owned());
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scores_go_below_the_path_of_a_line_item() {
        let at = |line_item: &str| scores_of(line_item).expect("an address");
        assert_eq!(
            at("https://lms.example/2/lineitems/7/lineitem"),
            "https://lms.example/2/lineitems/7/lineitem/scores"
        );
        assert_eq!(
            at("https://lms.example/lineitem?type_id=3&x=%2F"),
            "https://lms.example/lineitem/scores?type_id=3&x=%2F"
        );
        assert!(scores_of("no address").is_err());
    }
}
