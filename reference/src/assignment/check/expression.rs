//! An expression of the manifest, compiled.

use super::CheckResult;
use crate::Text;
use crate::assignment::{AssignmentError, error};
use crate::feed::FeedExpression;
use crate::interpreter::Type;
use crate::text::both;
use toml::Spanned;

/// Compiles an expression of this type that stands at `place`.
pub(super) fn expression(
    text: &Spanned<String>,
    kind: &Type,
    place: &str,
    place_at: &dyn Fn(usize) -> String,
) -> CheckResult<FeedExpression> {
    let wrong = |what: &Text| -> AssignmentError {
        let line = place_at(text.span().start);
        let message = both(
            format!(
                "{}: write an expression of type {kind} with `t`, `i`, `scene`, `resolution`, `turn` and `pi`",
                what.en
            ),
            format!(
                "{}。`t`、`i`、`scene`、`resolution`、`turn`、`pi` を使った {kind} 型の式を書いてください",
                what.ja
            ),
        );
        error(format!("{line}, {place}"), message)
    };
    FeedExpression::compile(text.get_ref(), kind).map_err(|refusal| wrong(refusal.what()))
}
