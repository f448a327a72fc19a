//! Everything that is kept of one student, for them to have.

use super::rows::submission_columns;
use super::{Result, Store, Submission, on};
use crate::service::clock::Millis;
use serde_json::{Map, Value, json};

/// One kind of what is kept: its name, the statement for a student's id, and the names of its columns, all of them texts.
type ExportedTable = (&'static str, &'static str, &'static [&'static str]);

/// What is kept of a student beside their hand-ins. Numbers are told as texts.
const KINDS: [ExportedTable; 8] = [
    (
        "extensions",
        "SELECT assignment, CAST(closes_at AS TEXT), reason FROM extensions WHERE student_id = $1 ORDER BY assignment",
        &["assignment", "closes_at", "reason"],
    ),
    (
        "extensions_of_group",
        "SELECT g.assignment, g.group_name, CAST(g.closes_at AS TEXT), g.reason FROM group_extensions g \
         JOIN students t ON t.group_name = g.group_name WHERE t.id = $1 ORDER BY g.assignment",
        &["assignment", "group", "closes_at", "reason"],
    ),
    (
        "requests",
        "SELECT assignment, submission_id, line, question, CAST(asked_at AS TEXT), coalesce(answer, '') FROM appeals \
         WHERE asker = $1 OR asker IN (SELECT id FROM owners WHERE student_id = $1) ORDER BY asked_at",
        &["assignment", "submission", "line", "question", "asked_at", "answer"],
    ),
    (
        "browsers",
        "SELECT CAST(created_at AS TEXT), proof FROM owners WHERE student_id = $1 ORDER BY created_at",
        &["known_since", "proof"],
    ),
    (
        "archives",
        "SELECT b.title, coalesce(e.path, ''), e.student FROM batch_entries e JOIN batches b ON b.id = e.batch_id \
         WHERE e.student_id = $1 ORDER BY b.created_at, e.position",
        &["archive", "path", "named"],
    ),
    (
        "platforms",
        "SELECT p.issuer, l.subject FROM lti_people l JOIN lti_platforms p ON p.id = l.platform_id \
         WHERE l.student_id = $1 ORDER BY p.issuer, l.subject",
        &["issuer", "subject"],
    ),
    (
        "sent_scores",
        "SELECT c.link_id, CAST(coalesce(c.score, 0) AS TEXT), CAST(c.sent_at AS TEXT) FROM lti_scores c \
         JOIN lti_people l ON l.platform_id = c.platform_id AND l.subject = c.subject WHERE l.student_id = $1 \
         ORDER BY c.link_id",
        &["link", "score", "sent_at"],
    ),
    (
        "acts_about_you",
        "SELECT CAST(at AS TEXT), act, coalesce(assignment, ''), detail FROM acts WHERE student_id = $1 ORDER BY at, id",
        &["at", "act", "assignment", "detail"],
    ),
];

impl Store {
    /// Everything that a student has handed in for all homeworks, drafts too, the oldest first.
    pub async fn submissions_of_student(&self, student_id: &str) -> Result<Vec<Submission>> {
        const SQL: &str = concat!(
            "SELECT ",
            submission_columns!(),
            " FROM submissions s WHERE s.student_id = $1 \
             OR (s.student_id IS NULL AND s.owner_id IN (SELECT id FROM owners WHERE student_id = $1)) \
             ORDER BY s.received_at, s.id"
        );
        Ok(on!(&self.read, db => sqlx::query_as(SQL).bind(student_id).fetch_all(db).await?))
    }

    /// When a submission was chosen to count, where it was.
    pub async fn chosen_at(&self, submission: &str) -> Result<Option<Millis>> {
        const SQL: &str = "SELECT chosen_at FROM submissions WHERE id = $1";
        let found: Option<Option<Millis>> =
            on!(&self.read, db => sqlx::query_scalar(SQL).bind(submission).fetch_optional(db).await?);
        Ok(found.flatten())
    }

    /// What is kept of a student beside the roster's line and the hand-ins: lists by their names.
    pub async fn kept_of_student(&self, student_id: &str) -> Result<Map<String, Value>> {
        let mut kept = Map::new();
        for (name, sql, columns) in KINDS {
            let rows: Vec<Value> = on!(&self.read, db => {
                let rows = sqlx::query(sql).bind(student_id).fetch_all(db).await?;
                rows.iter().map(|row| texts(row, columns)).collect::<std::result::Result<_, sqlx::Error>>()?
            });
            kept.insert(name.to_owned(), Value::Array(rows));
        }
        Ok(kept)
    }
}

/// A row as an object; texts that are moments are written as such.
fn texts<R: sqlx::Row>(row: &R, columns: &[&str]) -> std::result::Result<Value, sqlx::Error>
where
    usize: sqlx::ColumnIndex<R>,
    for<'a> String: sqlx::Decode<'a, R::Database> + sqlx::Type<R::Database>,
{
    let mut object = Map::new();
    for (at, column) in columns.iter().enumerate() {
        let text: String = row.try_get(at)?;
        let is_moment = column.ends_with("_at") || matches!(*column, "at" | "known_since");
        let value = match text.parse().ok().filter(|_| is_moment) {
            Some(at) => json!(crate::service::clock::rfc3339(at)),
            None => json!(text),
        };
        object.insert((*column).to_owned(), value);
    }
    Ok(Value::Object(object))
}
