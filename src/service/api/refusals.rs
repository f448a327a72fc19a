//! What operations answer where they do not do what they are asked for.

use crate::service::errors::ProblemJson;

/// What every operation may answer.
#[derive(utoipa::IntoResponses)]
#[allow(dead_code, reason = "only its description is used")]
pub(super) enum Errors {
    /// The request cannot be understood.
    #[response(status = 400, content_type = "application/problem+json")]
    BadRequest(ProblemJson),
    /// It took too long.
    #[response(status = 408, content_type = "application/problem+json")]
    Timeout(ProblemJson),
    /// Something of ours failed.
    #[response(status = 500, content_type = "application/problem+json")]
    Internal(ProblemJson),
    /// The database does not answer, or the service is being restarted; with Retry-After.
    #[response(status = 503, content_type = "application/problem+json")]
    Unavailable(ProblemJson),
}

/// What operations on a submission may answer.
#[derive(utoipa::IntoResponses)]
#[allow(dead_code, reason = "only its description is used")]
pub(super) enum NotFound {
    /// There is nothing here.
    #[response(status = 404, content_type = "application/problem+json")]
    NotFound(ProblemJson),
}

/// What operations that take a file may answer.
#[derive(utoipa::IntoResponses)]
#[allow(dead_code, reason = "only its description is used")]
pub(super) enum Refusals {
    /// A secret is wrong, or nobody may do this.
    #[response(status = 401, content_type = "application/problem+json",
        headers(("WWW-Authenticate" = String, description = "`Bearer`")))]
    Unauthorized(ProblemJson),
    /// Whoever asks may not do this: a role or a token that is good for less, another homework's token, a page of another site, a
    /// personal code that is wrong. Or nobody may now: the course is archived, handing in is over or has not begun, all attempts are
    /// used up.
    #[response(status = 403, content_type = "application/problem+json")]
    Forbidden(ProblemJson),
    /// The file is too large.
    #[response(status = 413, content_type = "application/problem+json")]
    TooLarge(ProblemJson),
    /// Neither a form nor a plain file.
    #[response(status = 415, content_type = "application/problem+json")]
    UnsupportedMediaType(ProblemJson),
    /// There is no file, a field makes no sense, or the `Idempotency-Key` was sent before with another request.
    #[response(status = 422, content_type = "application/problem+json")]
    Unprocessable(ProblemJson),
    /// The queue is full (with the position that the file would have had), or there were too many requests; with
    /// Retry-After.
    #[response(status = 429, content_type = "application/problem+json",
        headers(("Retry-After" = u64, description = "Seconds after which to try again")))]
    TooMany(ProblemJson),
}
