//! Figures for Prometheus.

use super::Service;
use super::grading::GradingResult;
use super::store::{Submission, word};
use crate::report::Opinion;
use metrics::Label;
use metrics_exporter_prometheus::{PrometheusBuilder, PrometheusHandle};
use std::sync::OnceLock;
use std::time::Duration;

/// Upper ends of the buckets of times, in seconds: from an answer out of the store to the deadline.
const BUCKETS: [f64; 11] = [0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1.0, 2.5];

static HANDLE: OnceLock<Option<PrometheusHandle>> = OnceLock::new();

/// Begins to count; once for the process.
pub(super) fn install() -> Option<&'static PrometheusHandle> {
    let handle = HANDLE.get_or_init(|| {
        let recorder = PrometheusBuilder::new().set_buckets(&BUCKETS).ok()?.build_recorder();
        let handle = recorder.handle();
        metrics::set_global_recorder(recorder).ok()?;
        describe();
        Some(handle)
    });
    handle.as_ref()
}

fn describe() {
    use metrics::{describe_counter, describe_gauge, describe_histogram};
    describe_counter!("ggrade_gradings_total", "Gradings by homework, verdict (or fault) and way in");
    describe_counter!(
        "ggrade_cross_checks_total",
        "Files that the interpreter ran after their grading, by homework and what came of it: agrees, differs, not-run"
    );
    describe_counter!("ggrade_uploads_total", "Files stored, by homework and way in");
    describe_counter!("ggrade_reports_reused_total", "Uploads answered with the report of the very same file");
    describe_counter!("ggrade_requests_total", "Requests by route, method and status");
    describe_histogram!("ggrade_request_seconds", "From the head of a request to the head of its answer");
    describe_histogram!("ggrade_stage_seconds", "Stages of a grading: wait for a grader, grade, store");
    describe_gauge!("ggrade_queue_length", "Uploads that wait for a grader");
    describe_gauge!("ggrade_gradings_running", "Files that are graded right now");
    describe_gauge!("ggrade_workers", "Files that can be graded at once");
    describe_gauge!("ggrade_submissions_waiting", "Stored files without a report, batches included");
    describe_gauge!("ggrade_submissions_failed", "Stored files whose grading failed by our fault");
}

/// Counts a grading.
pub(super) fn graded(submission: &Submission, outcome: Option<&GradingResult>) {
    let verdict = match outcome {
        Some(GradingResult::Graded(report)) => word(&report.verdict),
        Some(GradingResult::Failed(_)) => "fault".into(),
        None => "unstored".into(),
    };
    let labels = [of(submission), via(submission), Label::new("verdict", verdict)];
    metrics::counter!("ggrade_gradings_total", labels.iter()).increment(1);
}

/// Counts a second opinion.
pub(super) fn cross_checked(submission: &Submission, opinion: Opinion) {
    let labels = [of(submission), Label::new("opinion", word(&opinion))];
    metrics::counter!("ggrade_cross_checks_total", labels.iter()).increment(1);
}

/// Counts a file that was stored; `is_reused` says that it is answered with a report that there was.
pub(super) fn uploaded(submission: &Submission, is_reused: bool) {
    metrics::counter!("ggrade_uploads_total", [of(submission), via(submission)].iter()).increment(1);
    if is_reused {
        metrics::counter!("ggrade_reports_reused_total", [of(submission)].iter()).increment(1);
    }
}

/// The homework of a submission. Only those that are served come here, so the figures do not grow with what clients write.
fn of(submission: &Submission) -> Label {
    Label::new("assignment", submission.assignment.clone())
}

fn via(submission: &Submission) -> Label {
    Label::new("via", word(&submission.via))
}

/// Notes how long a stage of a grading took.
pub(super) fn stage(name: &'static str, took: Duration) {
    metrics::histogram!("ggrade_stage_seconds", "stage" => name).record(took.as_secs_f64());
}

/// Counts a request.
pub(super) fn request(route: &str, method: &str, status: u16, took: Duration) {
    let labels = [("route", route.to_owned()), ("method", method.to_owned()), ("status", status.to_string())];
    metrics::counter!("ggrade_requests_total", &labels).increment(1);
    metrics::histogram!("ggrade_request_seconds", "route" => route.to_owned()).record(took.as_secs_f64());
}

/// Everything, in Prometheus' text form.
pub(super) async fn render(service: &Service) -> String {
    let (mut length, mut queued, mut failed) = (0, 0, 0);
    for course in service.everywhere() {
        length += course.store.queue_length(course.clock.now(), usize::MAX).await.unwrap_or_default();
        let (more_queued, more_failed) = course.store.waiting().await.unwrap_or_default();
        queued += more_queued;
        failed += more_failed;
    }
    metrics::gauge!("ggrade_queue_length").set(length as f64);
    metrics::gauge!("ggrade_gradings_running").set(service.queue.running() as f64);
    metrics::gauge!("ggrade_workers").set(service.config.workers as f64);
    metrics::gauge!("ggrade_submissions_waiting").set(queued as f64);
    metrics::gauge!("ggrade_submissions_failed").set(failed as f64);
    install().map(PrometheusHandle::render).unwrap_or_default()
}

/// Folds what was counted into the buckets.
pub(super) fn upkeep() {
    if let Some(handle) = install() {
        handle.run_upkeep();
    }
}
