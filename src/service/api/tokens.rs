//! `/api/v1/tokens`: which tokens there are, and ending one. A person makes them, on a page.

use super::body::unkept;
use super::caller::check_page;
use super::refusals::{Errors, NotFound, Refusals};
use super::schema::time;
use crate::service::Service;
use crate::service::errors::Problem;
use crate::service::identity::{Teacher, end_token, tokens_for};
use crate::service::store::{OwnedToken, TokenScope};
use axum::extract::{Path, State as Shared};
use axum::http::{HeaderMap, StatusCode};
use axum::response::{IntoResponse, Response};
use serde::Serialize;

/// A token, without its secret.
#[derive(Debug, Serialize, utoipa::ToSchema)]
pub(super) struct TokenJson {
    /// Id, which ends it.
    id: String,
    /// What its owner calls it.
    name: String,
    /// Login of its owner.
    owner: String,
    /// What it is good for.
    #[schema(inline)]
    scope: TokenScope,
    /// Id of the homework that it is for; null: all that its owner sees.
    assignment: Option<String>,
    /// When it was made.
    #[schema(format = DateTime)]
    created_at: String,
    /// When it ends.
    #[schema(format = DateTime)]
    expires_at: String,
    /// When it was used last, to the hour; null: never.
    #[schema(format = DateTime)]
    last_used_at: Option<String>,
}

/// The tokens.
#[derive(Debug, Serialize, utoipa::ToSchema)]
pub(super) struct TokensJson {
    /// The newest first.
    tokens: Vec<TokenJson>,
}

impl From<OwnedToken> for TokenJson {
    fn from(OwnedToken { token, login }: OwnedToken) -> Self {
        Self {
            id: token.id,
            name: token.name,
            owner: login,
            scope: token.scope,
            assignment: token.assignment,
            created_at: time(token.created_at),
            expires_at: time(token.expires_at),
            last_used_at: token.last_used_at.map(time),
        }
    }
}

/// The tokens of people
///
/// One's own; an administrator sees everybody's. They are made at `/teacher/tokens`.
#[utoipa::path(
    get, operation_id = "list_tokens", path = "/api/v1/tokens", tag = "batches", security(("teacher" = [])),
    responses((status = 200, description = "Those that hold", body = TokensJson), Refusals, Errors)
)]
pub(super) async fn list(teacher: Teacher, Shared(service): Shared<Service>) -> Result<Response, Problem> {
    let tokens = tokens_for(&service, &teacher).await?.into_iter().map(TokenJson::from).collect();
    Ok(unkept(TokensJson { tokens }))
}

/// End a token
#[utoipa::path(
    delete, operation_id = "end_token", path = "/api/v1/tokens/{id}", tag = "batches", security(("teacher" = [])),
    params(("id" = String, Path, description = "Id of the token")),
    responses((status = 204, description = "It is good for nothing any more"), NotFound, Refusals, Errors)
)]
pub(super) async fn end(
    teacher: Teacher,
    headers: HeaderMap,
    Shared(service): Shared<Service>,
    Path(id): Path<String>,
) -> Result<Response, Problem> {
    check_page(&teacher, &headers, &service)?;
    let ended = end_token(&service, &teacher, &id).await?;
    Ok(ended.detail().on(StatusCode::NO_CONTENT.into_response()))
}
