//! What arrives while a teacher looks: the page is told that something changed, and fetches what it shows anew.

use crate::service::State;
use crate::service::errors::Problem;
use crate::service::identity::TeacherPage;
use axum::extract::State as Shared;
use axum::response::sse::{Event, KeepAlive, Sse};
use axum::response::{IntoResponse, Response};
use std::convert::Infallible;
use std::time::Duration;

/// How often the class is looked at for who watches it.
const TICK: Duration = Duration::from_secs(1);

/// `GET /teacher/events`: server-sent events `change`, each time that a file of the class has come or was graded.
pub(in crate::service::pages) async fn events(
    Shared(state): Shared<State>,
    _: TeacherPage,
) -> Result<Response, Problem> {
    let now = state.store.class_version(&state.assignment.id, None).await?;
    let changes = futures_util::stream::unfold((state, now), async |(state, seen)| {
        loop {
            tokio::select! {
                () = tokio::time::sleep(TICK) => {}
                () = state.ended() => return None,
            }
            let version = state.store.class_version(&state.assignment.id, None).await;
            // Who watches may come again; the log has what happened.
            let now = version.inspect_err(|error| tracing::error!(%error, "changes of the class")).ok()?;
            if now != seen {
                return Some((Ok::<_, Infallible>(Event::default().event("change").data("{}")), (state, now)));
            }
        }
    });
    Ok(Sse::new(changes).keep_alive(KeepAlive::default()).into_response())
}
