//! Grading everything again, at a teacher's wish.

use super::State;
use super::errors::Problem;
use super::folders;
use super::grading;
use super::identity::new_id;
use super::store::Regrading;
use crate::report::Verdict;
use axum::http::StatusCode;

/// Begins to grade everything again in the background, behind all else; with another seed, where that is wished, and by an
/// uploaded folder, where `folder` is the id of one.
pub async fn start(state: &State, new_seed: bool, folder: Option<String>) -> Result<Regrading, Problem> {
    let assignment = state.store.assignment(&state.assignment.id).await?;
    let regrading = Regrading {
        id: new_id(),
        assignment: assignment.id,
        seed: if new_seed { crate::grade::random_seed() } else { assignment.seed },
        hints: assignment.hints,
        created_at: state.clock.now(),
        adopted_at: None,
        folder,
    };
    state.store.add_regrading(&regrading).await?;
    grading::files_wait(state).await;
    Ok(regrading)
}

/// Points that differ by less are the same: sums of fractions of points are rounded.
pub const SAME_POINTS: f64 = 1e-6;

/// Verdict, points and mistakes of a grading.
pub type Earned = (Verdict, f64, Vec<String>);

/// Whether two gradings of a submission differ.
pub fn differs(before: &Earned, after: &Earned) -> bool {
    before.0 != after.0 || (before.1 - after.1).abs() > SAME_POINTS || before.2 != after.2
}

/// The regrading with this id, where it is of this homework.
pub async fn found(state: &State, id: &str) -> Result<Regrading, Problem> {
    let of_this = |regrading: &Regrading| regrading.assignment == state.assignment.id;
    state.store.regrading(id).await?.filter(of_this).ok_or_else(Problem::not_found)
}

/// Lets the results take the place of the reports, and publishes the folder by which they were graded.
pub async fn adopt(state: &State, id: &str) -> Result<(), Problem> {
    let regrading = found(state, id).await?;
    if regrading.adopted_at.is_some() {
        return Ok(());
    }
    if !state.store.regrading_progress(id).await?.is_done() {
        return Err(Problem::new(
            StatusCode::CONFLICT,
            "not-done",
            "Not everything is graded again yet; wait until it is.",
            "再採点がまだ終わっていません。終わるまで待ってください。",
        ));
    }
    let mut published = None;
    if let Some(folder) = &regrading.folder {
        published = Some(folders::read(state, folder).await?);
        // No report by the folder of before is left among those of the new one.
        let since = state.store.extend_regrading(&regrading).await?;
        if since > 0 {
            grading::files_wait(state).await;
            return Err(Problem::new(
                StatusCode::CONFLICT,
                "not-done",
                format!(
                    "{since} more were handed in since this began. They are graded by the new folder now: adopt once more in a moment."
                ),
                format!(
                    "再採点を始めた後に {since} 件の提出がありました。新しいフォルダで採点しています。少し待ってから、もう一度採用してください。"
                ),
            ));
        }
    }
    let turn = state.served_turn.acquire().await;
    state.store.adopt(&regrading, state.clock.now()).await?;
    if let Some(assignment) = published {
        state.serve(assignment);
        drop(turn);
        grading::folders_changed(state).await;
    }
    state.cross_checks.look();
    Ok(())
}
