//! What the interpreter says of files that were graded. It is a part of the stored report, and of nothing that a student
//! is shown.

use super::{Result, Store, on};
use crate::report::{CrossCheck, Report};

/// Whether a stored report says that driver and interpreter disagree: the opinion is what its JSON begins with.
macro_rules! differs {
    ($report:literal) => {
        concat!($report, " LIKE '{\"cross_check\":{\"opinion\":\"differs\"%'")
    };
}
pub(super) use differs;

impl Store {
    /// Submissions whose shader was drawn and that the interpreter has not run, the newest first; drafts are left out.
    pub async fn not_cross_checked(&self, assignment: &str, limit: u32) -> Result<Vec<String>> {
        const SQL: &str = "SELECT s.id FROM submissions s JOIN reports r ON r.submission_id = s.id \
                           WHERE s.assignment = $1 AND s.via <> 'editor' AND r.verdict IN ('correct', 'wrong') \
                           AND r.report NOT LIKE '{\"cross_check\":{%' ORDER BY s.received_at DESC, s.id LIMIT $2";
        Ok(on!(&self.read, db => {
            sqlx::query_scalar(SQL).bind(assignment).bind(i64::from(limit)).fetch_all(db).await?
        }))
    }

    /// Puts a second opinion into the report of a submission that was graded with this seed; a report that was replaced
    /// meanwhile stays as it is.
    pub async fn set_cross_check(&self, id: &str, seed: u64, checked: &CrossCheck) -> Result<()> {
        const READ: &str = "SELECT report FROM reports WHERE submission_id = $1";
        const WRITE: &str = "UPDATE reports SET report = $2 WHERE submission_id = $1 AND report = $3";
        let json: Option<String> = on!(&self.read, db => sqlx::query_scalar(READ).bind(id).fetch_optional(db).await?);
        let Some(json) = json else { return Ok(()) };
        let mut report: Report = serde_json::from_str(&json)?;
        if report.probes.seed != seed {
            return Ok(());
        }
        report.cross_check = Some(checked.clone());
        let with_opinion = serde_json::to_string(&report)?;
        on!(&self.write, db => {
            sqlx::query(WRITE).bind(id).bind(&with_opinion).bind(&json).execute(db).await?;
        });
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::Opinion;

    #[test]
    fn an_opinion_is_what_a_stored_report_begins_with() {
        let mut report = crate::report::samples::correct();
        let json = |report: &Report| serde_json::to_string(report).expect("JSON");
        assert!(json(&report).starts_with("{\"cross_check\":null,"));
        report.cross_check = Some(CrossCheck {
            opinion: Opinion::Differs,
            agreeing: 1,
            undefined: 0,
            unsettled: 0,
            differing: 1,
            message: None,
            line: None,
        });
        let pattern = differs!("").trim_start_matches(" LIKE '").trim_end_matches("%'");
        assert!(json(&report).starts_with(pattern), "{pattern}");
    }
}
