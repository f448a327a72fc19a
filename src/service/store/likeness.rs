//! The files of a whole class at once.

use super::{Result, Store, on};
use crate::hand_in::{HandIn, HandedInFile};
use std::collections::HashMap;

impl Store {
    /// The files of everything that was handed in for a homework, drafts left out, by the id of the submission.
    pub async fn hand_ins(&self, assignment: &str) -> Result<HashMap<String, HandIn>> {
        const SQL: &str = "SELECT f.submission_id, f.name, u.bytes FROM submissions s \
                           JOIN submission_files f ON f.submission_id = s.id JOIN uploads u ON u.sha256 = f.sha256 \
                           WHERE s.assignment = $1 AND s.via <> 'editor' ORDER BY f.submission_id, f.position";
        let rows: Vec<(String, String, Vec<u8>)> =
            on!(&self.read, db => sqlx::query_as(SQL).bind(assignment).fetch_all(db).await?);
        let mut hand_ins: HashMap<String, HandIn> = HashMap::new();
        for (id, name, bytes) in rows {
            hand_ins.entry(id).or_default().files.push(HandedInFile { name, bytes });
        }
        Ok(hand_ins)
    }
}
