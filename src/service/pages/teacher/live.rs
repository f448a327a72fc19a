//! How far the work in the background is, as server-sent events.

use crate::service::State;
use crate::service::store::Progress;
use axum::response::sse::{Event, KeepAlive, Sse};
use axum::response::{IntoResponse, Response};
use futures_util::stream;
use std::convert::Infallible;
use std::time::Duration;

/// Pause between two looks at the database.
const LOOK: Duration = Duration::from_millis(400);

/// What is looked at.
pub(super) enum What {
    /// A batch, by its id.
    Batch(String),
    /// A regrading, by its id.
    Regrading(String),
}

impl What {
    async fn progress(&self, state: &State) -> Option<Progress> {
        let progress = match self {
            Self::Batch(id) => state.store.progress(id).await,
            Self::Regrading(id) => state.store.regrading_progress(id).await,
        };
        progress.inspect_err(|error| tracing::error!(%error, "progress cannot be read")).ok()
    }
}

/// An event `progress` whenever something changed, until all is done or the service ends.
pub(super) fn events(state: &State, what: What) -> Response {
    let begin = (state.clone(), what, None::<Progress>);
    let events = stream::unfold(begin, |(state, what, before)| async move {
        if before.is_some_and(|before| before.is_done()) {
            return None;
        }
        loop {
            let now = what.progress(&state).await?;
            if before != Some(now) {
                let event = Event::default().event("progress").json_data(now).ok()?;
                return Some((Ok::<_, Infallible>(event), (state, what, Some(now))));
            }
            tokio::select! {
                () = tokio::time::sleep(LOOK) => {}
                () = state.ended() => return None,
            }
        }
    });
    Sse::new(events).keep_alive(KeepAlive::default()).into_response()
}
