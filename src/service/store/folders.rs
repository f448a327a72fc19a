//! Folders of homeworks that were uploaded, and which of them are served.

use super::{Result, Store, on};
use crate::report::Report;
use crate::service::clock::Millis;
use reference::Folder;

/// A folder that was uploaded and checked.
#[derive(Clone, Debug, PartialEq)]
pub struct UploadedFolder {
    /// Id.
    pub id: String,
    /// Id of the homework.
    pub assignment: String,
    /// Digest of its files.
    pub digest: String,
    /// When it was uploaded.
    pub uploaded_at: Millis,
    /// Login of who uploaded it; none by a secret of the whole service, or by a program.
    pub uploader: Option<String>,
    /// What its own solution got.
    pub solution: Report,
    /// What the files got that it hands out.
    pub handed_out: Report,
    /// When it was published; none: never, or it was withdrawn.
    pub published_at: Option<Millis>,
}

type FolderRow = (String, String, String, i64, Option<String>, String, String, Option<i64>);

/// Selects a [`FolderRow`].
macro_rules! select {
    ($rest:literal) => {
        concat!(
            "SELECT f.id, f.assignment, f.digest, f.uploaded_at, s.login, f.solution, f.handed_out, f.published_at \
             FROM folders f LEFT JOIN staff s ON s.id = f.staff_id ",
            $rest
        )
    };
}

impl UploadedFolder {
    fn of(
        (id, assignment, digest, uploaded_at, uploader, solution, handed_out, published_at): FolderRow,
    ) -> Result<Self> {
        let (solution, handed_out) = (serde_json::from_str(&solution)?, serde_json::from_str(&handed_out)?);
        Ok(Self { id, assignment, digest, uploaded_at, uploader, solution, handed_out, published_at })
    }
}

impl Store {
    /// Keeps a folder with its files; `staff_id` is who uploaded it. The same folder stays as it is.
    pub async fn add_folder(&self, folder: &UploadedFolder, files: &Folder, staff_id: Option<&str>) -> Result<()> {
        const INSERT: &str = "INSERT INTO folders (id, assignment, digest, uploaded_at, staff_id, solution, handed_out) \
                              VALUES ($1, $2, $3, $4, $5, $6, $7) ON CONFLICT (digest) DO NOTHING";
        const FILE: &str = "INSERT INTO folder_files (folder_id, name, bytes) VALUES ($1, $2, $3)";
        let (solution, handed_out) =
            (serde_json::to_string(&folder.solution)?, serde_json::to_string(&folder.handed_out)?);
        on!(&self.write, db => {
            let mut transaction = db.begin().await?;
            let inserted = sqlx::query(INSERT)
                .bind(&folder.id)
                .bind(&folder.assignment)
                .bind(&folder.digest)
                .bind(folder.uploaded_at)
                .bind(staff_id)
                .bind(solution)
                .bind(handed_out)
                .execute(&mut *transaction)
                .await?;
            if inserted.rows_affected() > 0 {
                for (name, bytes) in &files.files {
                    sqlx::query(FILE).bind(&folder.id).bind(name).bind(bytes).execute(&mut *transaction).await?;
                }
            }
            transaction.commit().await?;
        });
        Ok(())
    }

    /// Every uploaded folder, the newest first.
    pub async fn folders(&self) -> Result<Vec<UploadedFolder>> {
        const SQL: &str = select!("ORDER BY f.uploaded_at DESC, f.id");
        let rows: Vec<FolderRow> = on!(&self.read, db => sqlx::query_as(SQL).fetch_all(db).await?);
        rows.into_iter().map(UploadedFolder::of).collect()
    }

    /// The folder with this id.
    pub async fn folder(&self, id: &str) -> Result<Option<UploadedFolder>> {
        const SQL: &str = select!("WHERE f.id = $1");
        let row: Option<FolderRow> = on!(&self.write, db => sqlx::query_as(SQL).bind(id).fetch_optional(db).await?);
        row.map(UploadedFolder::of).transpose()
    }

    /// The folder of this digest.
    pub async fn folder_of_digest(&self, digest: &str) -> Result<Option<UploadedFolder>> {
        const SQL: &str = select!("WHERE f.digest = $1");
        let row: Option<FolderRow> = on!(&self.write, db => sqlx::query_as(SQL).bind(digest).fetch_optional(db).await?);
        row.map(UploadedFolder::of).transpose()
    }

    /// The files of a folder; none where there is no such folder.
    pub async fn folder_files(&self, id: &str) -> Result<Folder> {
        const SQL: &str = "SELECT name, bytes FROM folder_files WHERE folder_id = $1";
        let files: Vec<(String, Vec<u8>)> = on!(&self.write, db => sqlx::query_as(SQL).bind(id).fetch_all(db).await?);
        Ok(Folder::of(files))
    }

    /// Homework and id of each folder that is served: of every homework the one that was published last.
    pub async fn published(&self) -> Result<Vec<(String, String)>> {
        const SQL: &str = "SELECT assignment, id FROM folders f WHERE published_at IS NOT NULL AND NOT EXISTS \
                           (SELECT 1 FROM folders g WHERE g.assignment = f.assignment AND g.published_at > f.published_at) \
                           ORDER BY published_at, id";
        Ok(on!(&self.write, db => sqlx::query_as(SQL).fetch_all(db).await?))
    }

    /// Has a folder served from now on.
    pub async fn publish(&self, id: &str, now: Millis) -> Result<()> {
        const SQL: &str = "UPDATE folders SET published_at = $2 WHERE id = $1";
        on!(&self.write, db => { sqlx::query(SQL).bind(id).bind(now).execute(db).await?; });
        Ok(())
    }

    /// Has no folder of this homework served any more.
    pub async fn withdraw(&self, assignment: &str) -> Result<()> {
        const SQL: &str = "UPDATE folders SET published_at = NULL WHERE assignment = $1";
        on!(&self.write, db => { sqlx::query(SQL).bind(assignment).execute(db).await?; });
        Ok(())
    }

    /// Forgets a folder, and what was graded again by it and not adopted.
    pub async fn remove_folder(&self, id: &str) -> Result<()> {
        const SQL: &str = "DELETE FROM folders WHERE id = $1";
        on!(&self.write, db => { sqlx::query(SQL).bind(id).execute(db).await?; });
        Ok(())
    }

    /// Whether something of a homework has a report that counts.
    pub async fn has_reports(&self, assignment: &str) -> Result<bool> {
        const SQL: &str = "SELECT count(*) FROM (SELECT 1 FROM submissions WHERE assignment = $1 AND state = 'graded' \
                           AND via <> 'editor' LIMIT 1) AS found";
        let count: i64 = on!(&self.write, db => sqlx::query_scalar(SQL).bind(assignment).fetch_one(db).await?);
        Ok(count > 0)
    }
}
