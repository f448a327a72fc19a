//! Work that would keep a thread of the runtime from its requests.

use super::State;
use super::errors::Problem;
use crate::fault::Fault;

/// Does work that takes a processor for a while.
pub async fn blocking<T: Send + 'static>(
    state: &State,
    work: impl FnOnce(&State) -> Result<T, Fault> + Send + 'static,
) -> Result<T, Problem> {
    let state = state.clone();
    match tokio::task::spawn_blocking(move || work(&state)).await {
        Ok(result) => result.map_err(|fault| Problem::of_fault(&fault)),
        Err(panic) => Err(Problem::internal(&panic)),
    }
}
