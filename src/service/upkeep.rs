//! What is done every now and then: old submissions and keys of requests go, and what nobody needs is forgotten.

use super::Service;
use super::clock::{Millis, millis};
use super::{idempotency, metrics};
use std::time::Duration;

const MINUTE: Duration = Duration::from_secs(60);
const DAY: Duration = Duration::from_secs(24 * 3600);

/// How many minutes lie between two removals.
const REMOVALS: u32 = 60;

/// Runs until the service is told to end.
pub(super) async fn run(service: Service) {
    for minute in 0_u32.. {
        for course in service.everywhere() {
            if minute.is_multiple_of(REMOVALS) {
                remove(&course).await;
            }
            if let Err(error) = course.store.forget_senders(course.clock.now()).await {
                tracing::error!(%error, "senders of long ago could not be removed");
            }
        }
        service.limits.tidy();
        service.queue.tidy();
        metrics::upkeep();
        tokio::select! {
            () = tokio::time::sleep(MINUTE) => {}
            () = service.ended() => return,
        }
    }
}

/// Removes drafts and keys of yesterday, and submissions that are older than the configuration keeps them.
pub async fn remove(service: &Service) {
    let now = service.clock.now();
    let before = |days: u32| -> Millis { now - millis(DAY) * Millis::from(days) };
    let days = service.config.retention_days;
    if let Err(error) = service.store.forget_keys(now - millis(idempotency::KEPT)).await {
        tracing::error!(%error, "old keys of requests could not be removed");
    }
    match service.store.remove_old((days > 0).then(|| before(days)), before(1)).await {
        Ok(removed) if removed.submissions > 0 => {
            tracing::info!(submissions = removed.submissions, files = removed.uploads, "removed what is old");
        }
        Ok(_) => {}
        Err(error) => tracing::error!(%error, "old submissions could not be removed"),
    }
    if let Err(error) = service.store.empty_log().await {
        tracing::error!(%error, "the log of the database could not be emptied");
    }
}
