//! Work that would keep a thread of the runtime from its requests, and work that a request may not leave half done.

use super::State;
use super::errors::Problem;
use crate::fault::Fault;
use std::future::Future;

/// Does work that takes a processor or waits for the disk; a panic in it is a failure of ours.
pub async fn aside<T: Send + 'static>(work: impl FnOnce() -> T + Send + 'static) -> Result<T, Problem> {
    tokio::task::spawn_blocking(work).await.map_err(|panic| Problem::internal(&panic))
}

/// The same with a homework's state.
pub async fn blocking<T: Send + 'static>(
    state: &State,
    work: impl FnOnce(&State) -> Result<T, Fault> + Send + 'static,
) -> Result<T, Problem> {
    let state = state.clone();
    aside(move || work(&state)).await?.map_err(|fault| Problem::of_fault(&fault))
}

/// Does work to its end. A request ends between any two steps when its time is over or its client is gone; the work goes on then.
pub async fn to_its_end<T: Send + 'static>(
    work: impl Future<Output = Result<T, Problem>> + Send + 'static,
) -> Result<T, Problem> {
    tokio::spawn(work).await.map_err(|panic| Problem::internal(&panic))?
}
