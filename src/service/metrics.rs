//! Figures for Prometheus.

use super::grading::Outcome;
use super::store::{Submission, word};
use std::time::Duration;

/// Counts a grading.
pub(super) fn graded(submission: &Submission, outcome: Option<&Outcome>, took: Duration) {
    let verdict = match outcome {
        Some(Outcome::Graded(report)) => word(&report.verdict),
        Some(Outcome::Failed(_)) => "fault".into(),
        None => "unstored".into(),
    };
    metrics::counter!("ggrade_gradings_total", "verdict" => verdict, "via" => word(&submission.via)).increment(1);
    metrics::histogram!("ggrade_grading_seconds").record(took.as_secs_f64());
}
