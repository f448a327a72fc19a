//! Grading everything again, at a teacher's wish.

use super::State;
use super::errors::Problem;
use super::identity::new_id;
use super::store::Regrading;
use axum::http::StatusCode;

/// Begins to grade everything again in the background, behind all else; with another seed, where that is wished.
pub async fn start(state: &State, new_seed: bool) -> Result<Regrading, Problem> {
    let assignment = state.store.assignment(&state.assignment.id).await?;
    let regrading = Regrading {
        id: new_id(),
        assignment: assignment.id,
        seed: if new_seed { crate::grade::random_seed() } else { assignment.seed },
        hints: assignment.hints,
        created_at: state.clock.now(),
        adopted_at: None,
    };
    state.store.add_regrading(&regrading).await?;
    state.queue.look();
    Ok(regrading)
}

/// The regrading with this id, where it is of this homework.
pub async fn found(state: &State, id: &str) -> Result<Regrading, Problem> {
    let of_this = |regrading: &Regrading| regrading.assignment == state.assignment.id;
    state.store.regrading(id).await?.filter(of_this).ok_or_else(Problem::not_found)
}

/// Lets the results take the place of the reports.
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
    state.store.adopt(&regrading, state.clock.now()).await?;
    state.cross_checks.look();
    Ok(())
}
