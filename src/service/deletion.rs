//! Deleting a submission, an archive, or a student with everything of theirs.

use super::Service;
use super::acts::Detail;
use super::errors::Problem;
use super::roster::Matcher;
use super::store::{Counts, DeletionTarget};
use crate::language::Language;

/// Deletes it for good: rows, files, reports, and the pictures that are kept of them. The log has how much it was, and
/// nothing of whose.
pub async fn delete(service: &Service, target: &DeletionTarget) -> Result<Counts, Problem> {
    let refused = match target {
        DeletionTarget::Student(id) => refused_without(service, id).await?,
        _ => Vec::new(),
    };
    let (counts, files) = service.store.delete(target, &refused, service.clock.now()).await?;
    for sha256 in &files {
        service.gallery.forget(sha256).await;
    }
    // The rows are gone whatever becomes of this.
    if let Err(error) = service.store.empty_log().await {
        tracing::error!(%error, "the log of the database could not be emptied");
    }
    let Counts { submissions, drafts, entries, browsers } = counts;
    tracing::info!(what = target.word(), submissions, drafts, entries, browsers, "a teacher deleted");
    Ok(counts)
}

/// What the log of acts says of a deletion; it has no name of who is gone.
pub(super) fn detail(target: &DeletionTarget, counts: &Counts) -> Detail {
    Detail::of(format!("{}: {}", target.word(), counts.said(Language::En).join(", ")))
}

/// The lists of members that archives left out, without those whose path names this student: of each batch that changes.
async fn refused_without(service: &Service, id: &str) -> Result<Vec<(String, String)>, Problem> {
    let Some(student) = service.store.student_by_id(id).await? else { return Ok(Vec::new()) };
    let matcher = Matcher::new(std::slice::from_ref(&student));
    let mut changed = Vec::new();
    for batch in service.store.all_batches().await? {
        let kept: Vec<_> = batch.refused.iter().filter(|refused| !matcher.path_names(&refused.path, id)).collect();
        if kept.len() < batch.refused.len() {
            changed.push((batch.id, serde_json::to_string(&kept).map_err(|error| Problem::internal(&error))?));
        }
    }
    Ok(changed)
}
