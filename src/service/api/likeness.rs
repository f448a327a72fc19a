//! Answers that are alike: for teachers.

use super::batches::OfQuery;
use super::body::unkept;
use super::refusals::{Errors, NotFound, Refusals};
use crate::likeness::{Pair, Side};
use crate::service::Service;
use crate::service::courses::at;
use crate::service::errors::Problem;
use crate::service::identity::Teacher;
use crate::service::likeness::{self, AlikePerson};
use axum::extract::rejection::QueryRejection;
use axum::extract::{Path, Query, State as Shared};
use axum::http::HeaderMap;
use axum::response::Response;
use serde::{Deserialize, Serialize};

/// How much two answers are alike: a hint, and no verdict.
#[derive(Debug, Serialize, utoipa::ToSchema)]
pub(super) struct PairJson {
    /// Share of what the two wrote themselves that both have, in percent.
    percent: u32,
    /// How many passages of five words, numbers and signs both have.
    passages: usize,
    /// Whether the two have the same code throughout.
    is_same: bool,
    /// Whether the two are the same files, comments included.
    is_same_text: bool,
}

impl PairJson {
    fn of(pair: &Pair) -> Self {
        let Pair { shared, is_same, is_same_text, .. } = *pair;
        Self { percent: pair.percent(), passages: shared, is_same, is_same_text }
    }
}

/// One of two.
#[derive(Debug, Serialize, utoipa::ToSchema)]
pub(super) struct MemberJson {
    /// Address of the submission.
    submission: String,
    /// Student number, or what stands for it; empty where nothing is known.
    student: String,
    /// Whether they are of the class; others are of an earlier term, or of nobody.
    is_of_class: bool,
    /// What the addresses of their course begin with, where that is another course; null: it is this one.
    course: Option<String>,
}

/// Two whose answers are alike.
#[derive(Debug, Serialize, utoipa::ToSchema)]
pub(super) struct AlikeJson {
    /// How much.
    #[serde(flatten)]
    pair: PairJson,
    /// Who.
    #[schema(min_items = 2, max_items = 2)]
    members: Vec<MemberJson>,
    /// Address of the two side by side.
    comparison: String,
}

/// Who is alike in a class.
#[derive(Debug, Serialize, utoipa::ToSchema)]
pub(super) struct LikenessJson {
    /// How many answers of the class were looked at: of each student the one that counts.
    class: usize,
    /// How many others that are kept.
    others: usize,
    /// The most alike first.
    pairs: Vec<AlikeJson>,
    /// How many pairs are less alike than these, and not told.
    left_out: usize,
}

/// Answers that are alike
///
/// A hint where to look, and never a verdict. Names, the order of lines, spacing and comments are left aside; so is what the
/// hand-out and the lecture say, and what many of the class have. Answers of other courses of the service are looked at as well,
/// where who asks teaches there: with the teacher's token all of them, with a person's token none.
#[utoipa::path(
    get, operation_id = "list_likeness", path = "/api/v1/likeness", tag = "submissions", security(("teacher" = [])),
    params(OfQuery),
    responses((status = 200, description = "Who is alike", body = LikenessJson), NotFound, Refusals, Errors)
)]
pub(super) async fn list(
    teacher: Teacher,
    headers: HeaderMap,
    Shared(service): Shared<Service>,
    of: Result<Query<OfQuery>, QueryRejection>,
) -> Result<Response, Problem> {
    let Query(of) = of.map_err(super::body::other)?;
    let state = service.named(of.assignment.as_deref())?;
    teacher.check(&state.assignment.id)?;
    let found = likeness::find(&state, &headers).await?;
    let member = |member: &AlikePerson| MemberJson {
        submission: match &member.course {
            Some(course) => format!("{}/api/v1/submissions/{}", course.root, member.submission),
            None => at(&format!("/api/v1/submissions/{}", member.submission)),
        },
        student: member.number.clone(),
        is_of_class: member.is_of_class,
        course: member.course.as_ref().map(|course| course.root.clone()),
    };
    let alike = |(pair, [one, other]): (Pair, [AlikePerson; 2])| AlikeJson {
        pair: PairJson::of(&pair),
        comparison: comparison(&one, &other),
        members: vec![member(&one), member(&other)],
    };
    let json = LikenessJson {
        class: found.class,
        others: found.others,
        pairs: found.pairs.into_iter().map(alike).collect(),
        left_out: found.left_out,
    };
    Ok(unkept(json))
}

/// The address of two side by side; the other one may be of another course.
fn comparison(one: &AlikePerson, other: &AlikePerson) -> String {
    let address = at(&format!("/api/v1/submissions/{}/likeness/{}", one.submission, other.submission));
    match &other.course {
        Some(course) => format!("{address}?{}", course.query()),
        None => address,
    }
}

/// In which course the other one of two is.
#[derive(Debug, Deserialize, utoipa::IntoParams)]
#[serde(deny_unknown_fields)]
#[into_params(parameter_in = Query)]
pub(super) struct ComparisonQuery {
    /// What the addresses of the other one's course begin with, where that is another one: empty for the first course.
    #[param(required = false)]
    course: Option<String>,
}

/// A piece of a line.
#[derive(Debug, Serialize, utoipa::ToSchema)]
pub(super) struct PieceJson {
    /// As it was handed in.
    text: String,
    /// Whether the other has it as well.
    is_shared: bool,
}

/// A file of one of the two.
#[derive(Debug, Serialize, utoipa::ToSchema)]
pub(super) struct SideJson {
    /// Its name.
    name: String,
    /// Its lines.
    lines: Vec<Vec<PieceJson>>,
}

/// Two hand-ins side by side.
#[derive(Debug, Serialize, utoipa::ToSchema)]
pub(super) struct ComparisonJson {
    /// How much they are alike by themselves: what many of the class have counts here.
    #[serde(flatten)]
    pair: PairJson,
    /// The files of the one, and of the other.
    #[schema(min_items = 2, max_items = 2)]
    sides: Vec<Vec<SideJson>>,
}

/// Two submissions side by side
///
/// Their files line by line, with what both have.
#[utoipa::path(
    get, operation_id = "compare_submissions", path = "/api/v1/submissions/{id}/likeness/{other}", tag = "submissions", security(("teacher" = [])),
    params(("id" = String, Path, description = "Id of the submission"), ("other" = String, Path, description = "Id of the other one"), ComparisonQuery),
    responses((status = 200, description = "The two", body = ComparisonJson), NotFound, Refusals, Errors)
)]
pub(super) async fn compare(
    teacher: Teacher,
    headers: HeaderMap,
    Shared(service): Shared<Service>,
    Path((id, other)): Path<(String, String)>,
    of: Result<Query<ComparisonQuery>, QueryRejection>,
) -> Result<Response, Problem> {
    let Query(of) = of.map_err(super::body::other)?;
    let (state, _) = service.submission(&id).await?;
    teacher.check(&state.assignment.id)?;
    let (there, _) = likeness::in_course(&state, of.course.as_deref(), &headers).await?;
    let found = likeness::compare([(&state, &id), (&there, &other)], Default::default()).await?;
    let side = |Side { name, lines }: Side| SideJson {
        name,
        lines: lines
            .into_iter()
            .map(|line| line.into_iter().map(|it| PieceJson { text: it.text, is_shared: it.is_shared }).collect())
            .collect(),
    };
    let sides = found.sides.map(|files| files.into_iter().map(side).collect());
    let json = ComparisonJson { pair: PairJson::of(&found.pair), sides: sides.into() };
    Ok(unkept(json))
}
