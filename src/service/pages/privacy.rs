//! What is kept, for how long, and who sees it: for everybody to read.

use super::frame::PageFrame;
use super::shown;
use crate::service::Service;
use crate::service::errors::Problem;
use askama::Template;
use axum::extract::State as Shared;
use axum::response::Response;

#[derive(Template)]
#[template(path = "service/pages/templates/privacy.html")]
struct PrivacyPage {
    frame: PageFrame,
    /// Days after which hand-ins are removed; 0: not by themselves.
    days: u32,
    has_platforms: bool,
}

/// `GET /privacy`.
pub(super) async fn page(Shared(service): Shared<Service>, frame: PageFrame) -> Result<Response, Problem> {
    let has_platforms = !service.store.platforms().await?.is_empty();
    shown(PrivacyPage { days: service.config.retention_days, has_platforms, frame }.render())
}
