//! What a homework shows of its class: for teachers.

use super::batches::OfQuery;
use super::refusals::{Errors, NotFound, Refusals};
use crate::class::formats::plain::cell;
use crate::service::Service;
use crate::service::download;
use crate::service::errors::Problem;
use crate::service::identity::Teacher;
use crate::service::insights::{self, Table};
use crate::service::language::Lang;
use axum::extract::rejection::{PathRejection, QueryRejection};
use axum::extract::{Path, Query, State as Shared};
use axum::response::Response;

/// What a homework shows of its class
///
/// A table as CSV: how many students had their first right answer at which attempt; which mistakes were handed in when; which
/// messages were said, and what the same student handed in next. Nobody is named.
#[utoipa::path(
    get, operation_id = "read_insights", path = "/api/v1/insights/{table}", tag = "batches", security(("teacher" = [])),
    params(("table" = Table, Path, description = "Which table"), OfQuery),
    responses((status = 200, description = "The table", body = String, content_type = "text/csv"), NotFound, Refusals, Errors)
)]
pub(super) async fn read(
    teacher: Teacher,
    Shared(service): Shared<Service>,
    Lang(language): Lang,
    table: Result<Path<Table>, PathRejection>,
    of: Result<Query<OfQuery>, QueryRejection>,
) -> Result<Response, Problem> {
    let Path(table) = table.map_err(|_| Problem::not_found())?;
    let Query(of) = of.map_err(super::body::other)?;
    let state = service.named(of.assignment.as_deref())?;
    teacher.check(&state.assignment.id)?;
    let insights = insights::of(&state).await?;
    let rows = table.rows(&insights, language).into_iter();
    let rows = rows.map(|row| row.iter().map(|text| cell(text)).collect::<Vec<String>>());
    download::table(&format!("{}-{}.csv", state.assignment.id, table.id()), rows)
}
