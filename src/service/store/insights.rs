//! What was said of files that could not be judged.

use super::{Result, Store, on};
use crate::diagnostic::Diagnostic;
use std::collections::HashMap;

/// The part of a stored report that is read.
#[derive(serde::Deserialize)]
struct StoredDiagnostics {
    diagnostics: Vec<Diagnostic>,
}

impl Store {
    /// The diagnostics of everything handed in for a homework that was rejected or stopped, drafts left out, by the id of the
    /// submission.
    pub async fn refusals(&self, assignment: &str) -> Result<HashMap<String, Vec<Diagnostic>>> {
        const SQL: &str = "SELECT s.id, r.report FROM submissions s JOIN reports r ON r.submission_id = s.id \
                           WHERE s.assignment = $1 AND s.via <> 'editor' AND r.verdict IN ('rejected', 'stopped')";
        let rows: Vec<(String, String)> =
            on!(&self.read, db => sqlx::query_as(SQL).bind(assignment).fetch_all(db).await?);
        let read =
            |(id, json): (String, String)| Ok((id, serde_json::from_str::<StoredDiagnostics>(&json)?.diagnostics));
        rows.into_iter().map(read).collect()
    }
}
