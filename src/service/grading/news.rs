//! What processes on one database tell each other: that a file waits, what came of one, and that another folder is
//! served.

use super::GradingResult;
use crate::service::store::{Listener, News, StoreError, StoredSubmission};
use crate::service::{Service, courses};
use std::sync::Arc;
use std::time::Duration;

/// Pause after the connection failed.
const PAUSE: Duration = Duration::from_secs(1);

/// Tells the other processes; where that fails, they find out by themselves a little later.
pub(super) async fn tell(service: &Service, news: &News) {
    if let Err(error) = service.store.tell(news).await {
        tracing::warn!(%error, "other processes could not be told");
    }
}

/// Hears what other processes tell, until the service is told to end.
pub(super) async fn hear(service: Service) {
    while !service.is_ending() {
        let heard = async {
            let Some(mut listener) = service.store.listen().await? else { return Ok(()) };
            follow(&service, &mut listener).await
        };
        let heard: Result<(), StoreError> = tokio::select! {
            heard = heard => heard,
            () = service.ended() => return,
        };
        match heard {
            Ok(()) => return,
            Err(error) => tracing::error!(%error, "other processes cannot be heard"),
        }
        tokio::time::sleep(PAUSE).await;
    }
}

async fn follow(service: &Service, listener: &mut Listener) -> Result<(), StoreError> {
    loop {
        catch_up(service).await?;
        while let Some(news) = listener.next().await? {
            match news {
                News::Waiting => service.queue.wakes.notify_one(),
                News::Finished(id) if service.queue.has_listener(&id) => finished(service, &id).await?,
                News::Finished(_) => {}
                News::Published => published(service).await?,
            }
        }
    }
}

/// What may have been told while nobody listened.
async fn catch_up(service: &Service) -> Result<(), StoreError> {
    published(service).await?;
    service.queue.wakes.notify_one();
    for id in service.queue.expected() {
        finished(service, &id).await?;
    }
    Ok(())
}

/// Courses that were made, and homeworks that were published, chosen or put in another order.
async fn published(service: &Service) -> Result<(), StoreError> {
    courses::follow(service).await?;
    for course in service.everywhere() {
        courses::reread(&course).await?;
    }
    Ok(())
}

async fn finished(service: &Service, id: &str) -> Result<(), StoreError> {
    let Some((_, StoredSubmission { submission, report, .. })) = courses::holding(service, id).await? else {
        return Ok(());
    };
    match (report, submission.fault) {
        (Some(report), _) => service.queue.tell(id, GradingResult::Graded(Arc::new(report))),
        (None, Some(fault)) => service.queue.tell(id, GradingResult::Failed(Arc::new(fault))),
        (None, None) => {}
    }
    Ok(())
}
