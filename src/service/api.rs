//! The HTTP API, and what else is no page.

mod appeals;
pub(super) mod archive;
mod assignments;
pub(super) mod batches;
pub(super) mod body;
mod caller;
mod class_files;
mod courses;
mod deletions;
mod docs;
mod export;
mod extensions;
mod folders;
mod insights;
mod judgements;
mod likeness;
mod members;
mod operations;
mod own;
pub(super) mod pictures;
mod platforms;
mod records;
mod refusals;
mod regradings;
mod roster;
mod schema;
mod settings;
mod staff;
pub(super) mod submissions;
mod term;
mod tokens;

use super::Service;
use axum::Router;
use axum::extract::DefaultBodyLimit;
use axum::routing::get;
use schema::{FilledFormatName, FormatName, Security};
use tower_http::compression::CompressionLayer;
use utoipa::OpenApi;
use utoipa_axum::router::OpenApiRouter;
use utoipa_axum::routes;

/// Longest body of a usual request, in bytes: a file of the largest size in the roomiest form encoding.
pub const MAX_BODY: usize = 16 * super::submit::MAX_UPLOAD;

#[derive(OpenApi)]
#[openapi(
    info(
        title = "ggrade",
        description = "Hand in a shader, read its report. Every error is an `application/problem+json` object \
                       (RFC 9457), in the language of `?lang=` or `Accept-Language`. Of another course than the \
                       first one, every address begins with `/c/COURSE`.",
        license(name = "MIT OR Apache-2.0")
    ),
    components(schemas(super::errors::ProblemJson, FormatName, FilledFormatName, super::insights::Table)),
    modifiers(&Security),
    tags(
        (name = "submissions", description = "One hand-in. Its id opens it: who has the id may read the report."),
        (name = "batches", description = "Whole classes, for teachers: with the teacher's token."),
        (name = "courses", description = "Courses, their homeworks and rules, who teaches, who the class is: for teachers."),
        (name = "operations", description = "For who runs the service.")
    )
)]
struct ApiDocument;

/// The API's routes with their description.
fn described() -> OpenApiRouter<Service> {
    OpenApiRouter::with_openapi(ApiDocument::openapi())
        .routes(routes!(assignments::list))
        .routes(routes!(submissions::create))
        .routes(routes!(submissions::read))
        .routes(routes!(submissions::source))
        .routes(routes!(pictures::list))
        .routes(routes!(pictures::frame))
        .routes(routes!(pictures::animation))
        .routes(routes!(batches::read))
        .routes(routes!(batches::events))
        .routes(routes!(batches::file, batches::filled))
        .routes(routes!(class_files::read, class_files::filled))
        .routes(routes!(folders::read, folders::remove))
        .routes(routes!(folders::publish, folders::withdraw))
        .routes(routes!(extensions::list, extensions::set))
        .routes(routes!(own::choose))
        .routes(routes!(own::ask, own::asked))
        .routes(routes!(judgements::override_line, judgements::clear_override))
        .routes(routes!(judgements::add_comment))
        .routes(routes!(judgements::remove_comment))
        .routes(routes!(appeals::list))
        .routes(routes!(appeals::answer))
        .routes(routes!(appeals::take, appeals::release))
        .routes(routes!(insights::read))
        .routes(routes!(likeness::list))
        .routes(routes!(likeness::compare))
        .routes(routes!(deletions::delete_submission))
        .routes(routes!(deletions::delete_batch))
        .routes(routes!(deletions::delete_student))
        .routes(routes!(export::export_student))
        .routes(routes!(term::make))
        .routes(routes!(term::read))
        .routes(routes!(tokens::list))
        .routes(routes!(tokens::end))
        .routes(routes!(courses::list, courses::create))
        .routes(routes!(courses::read, courses::change))
        .routes(routes!(courses::renew_link))
        .routes(routes!(settings::read, settings::change))
        .routes(routes!(settings::plan, settings::set_plan))
        .routes(routes!(staff::list, staff::add))
        .routes(routes!(staff::change))
        .routes(routes!(staff::invite))
        .routes(routes!(platforms::list, platforms::add))
        .routes(routes!(platforms::register))
        .routes(routes!(platforms::change))
        .routes(routes!(platforms::connect))
        .routes(routes!(platforms::fetch))
        .routes(routes!(roster::read, roster::set))
        .routes(routes!(roster::codes))
        .routes(routes!(roster::renew))
        .routes(routes!(regradings::start))
        .routes(routes!(regradings::read))
        .routes(routes!(regradings::adopt))
        .routes(routes!(records::gradebook))
        .routes(routes!(records::log))
        .merge(operational())
}

fn operational() -> OpenApiRouter<Service> {
    OpenApiRouter::new()
        .routes(routes!(operations::healthz))
        .routes(routes!(operations::readyz))
        .routes(routes!(operations::metrics))
}

/// The routes for who runs the service, and no others.
pub(super) fn for_operators() -> Router<Service> {
    operational().split_for_parts().0
}

/// The routes.
pub fn router() -> Router<Service> {
    let (router, document) = described().split_for_parts();
    let (archives, with_archives) = OpenApiRouter::new()
        .routes(routes!(batches::create))
        .routes(routes!(folders::list, folders::create))
        .split_for_parts();
    // Archives are counted as they come.
    let router = router.merge(archives.layer(DefaultBodyLimit::disable()));
    let document = document.merge_from(with_archives);
    let document = std::sync::Arc::new(document);
    let description = get(move || docs::document(document.clone()));
    let static_files = docs::router().route("/api/v1/openapi.json", description);
    // Pages are not compressed: they hold tokens beside text that others choose, which the length would give away.
    router.merge(static_files.layer(CompressionLayer::new()))
}
