//! The HTTP API, and what else is no page.

use super::State;
use axum::Router;

/// Longest body of a usual request, in bytes: a file of the largest size in the roomiest form encoding.
pub const MAX_BODY: usize = 4 * super::submit::MAX_UPLOAD;

/// The routes.
pub fn router(_state: &State) -> Router<State> {
    Router::new()
}
