//! For who runs the service: is it alive, can it work, how much does it do.

use super::refusals::Errors;
use crate::service::Service;
use crate::service::errors::{Problem, ProblemJson};
use crate::service::identity::{bearer, equal_secrets};
use crate::service::limits::Client;
use crate::service::metrics as figures;
use axum::extract::State as Shared;
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Response};

/// Whether the process is alive
#[utoipa::path(get, operation_id = "read_health", path = "/healthz", tag = "operations",
    responses((status = 200, description = "It is", body = String, content_type = "text/plain"), Errors))]
pub(super) async fn healthz() -> &'static str {
    "ok\n"
}

/// Whether uploads are taken
#[utoipa::path(get, operation_id = "read_readiness", path = "/readyz", tag = "operations",
    responses((status = 200, description = "They are", body = String, content_type = "text/plain"), Errors))]
pub(super) async fn readyz(Shared(service): Shared<Service>) -> Result<&'static str, Problem> {
    service.store.ping().await?;
    if service.is_ending() {
        return Err(Problem::new(
            StatusCode::SERVICE_UNAVAILABLE,
            "ending",
            "The service is about to end.",
            "サービスは終了処理中です。",
        )
        .retry_after(10));
    }
    Ok("ready\n")
}

/// Figures for Prometheus
///
/// For this machine, or with `Authorization: Bearer` and the token of the configuration.
#[utoipa::path(get, operation_id = "read_metrics", path = "/metrics", tag = "operations",
    responses(
        (status = 200, description = "The figures", body = String, content_type = "text/plain"),
        (status = 403, description = "Not from this machine, and without the token", body = ProblemJson,
            content_type = "application/problem+json"),
        Errors
    ))]
pub(super) async fn metrics(
    Shared(service): Shared<Service>,
    client: Client,
    headers: HeaderMap,
) -> Result<Response, Problem> {
    let has_token = match (&service.config.metrics_token, bearer(&headers)) {
        (Some(token), Some(given)) => equal_secrets(token, given),
        _ => false,
    };
    if !has_token && !client.is_local {
        return Err(Problem::new(
            StatusCode::FORBIDDEN,
            "forbidden",
            "The figures are for this machine, or for who has the token (metrics_token).",
            "この情報はサーバ自身から、またはトークン (metrics_token) を使って読んでください。",
        ));
    }
    let kind = [(header::CONTENT_TYPE, "text/plain; version=0.0.4; charset=utf-8")];
    Ok((kind, figures::render(&service).await).into_response())
}
