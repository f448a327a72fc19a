//! Why a solution has no value, in words.

use crate::Text;
use crate::interpreter::UndefinedCause;
use crate::text::both;

/// What is said of a colour or a position that has no value.
pub(super) fn message(cause: Option<UndefinedCause>) -> Text {
    let (en, ja) = cause.map_or(UNKNOWN, |cause| cause.what.words());
    both(
        format!("the colour or the position is undefined, or no number: {en}"),
        format!("色または位置が未定義か、数になりません。{ja}"),
    )
}

const UNKNOWN: (&str, &str) = (
    "look at divisions, roots, powers, branches, loops that do not end, `normalize` of nothing, and `smoothstep` whose first edge is not the smaller one",
    "割り算、平方根、べき乗、分岐、終わらないループ、長さ 0 の `normalize`、1 つ目の端が小さくない `smoothstep` を確かめてください",
);
