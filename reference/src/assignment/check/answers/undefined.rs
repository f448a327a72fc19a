//! Why a solution has no value, in words.

use crate::Text;
use crate::interpreter::{Undefined, UndefinedCause};
use crate::text::both;

/// What is said of a colour or a position that has no value.
pub(super) fn message(cause: Option<UndefinedCause>) -> Text {
    let (en, ja) = cause.map_or(UNKNOWN, |cause| words(cause.what));
    both(
        format!("the colour or the position is undefined, or no number: {en}"),
        format!("色または位置が未定義か、数になりません。{ja}"),
    )
}

const UNKNOWN: (&str, &str) = (
    "look at divisions, roots, powers, branches, `normalize` of nothing, and `smoothstep` whose first edge is not the smaller one",
    "割り算、平方根、べき乗、分岐、長さ 0 の `normalize`、1 つ目の端が小さくない `smoothstep` を確かめてください",
);

fn words(what: Undefined) -> (&'static str, &'static str) {
    match what {
        Undefined::Uninitialised => ("a variable is read before it has a value", "値を入れる前の変数を読んでいます"),
        Undefined::Unwritten => ("an output is never given a value", "出力変数に値を代入していません"),
        Undefined::NoResult => ("a function ends without `return`", "関数が `return` なしで終わっています"),
        Undefined::Index => ("an index is out of range", "添字が範囲の外にあります"),
        Undefined::Power => (
            "GLSL gives `pow` no value where the base is negative, even for a square, or where it is 0 and the exponent is not positive. \
             For a square write `x * x`",
            "GLSL の `pow` は、底が負のとき (2 乗でも)、また底が 0 で指数が正でないときは値が決まりません。2 乗は `x * x` と書いてください",
        ),
        Undefined::Domain => (
            "a function has no value there: the root of a negative number, the logarithm of what is not positive, `asin` and `acos` \
             beyond 1, `normalize` of nothing",
            "関数の値が決まらない引数です (負の数の平方根、正でない数の対数、1 を超える `asin` や `acos`、長さ 0 の `normalize`)",
        ),
        Undefined::Division => ("a division by 0", "0 で割っています"),
        Undefined::Remainder => ("`%` of a negative whole number", "負の整数に `%` を使っています"),
        Undefined::Shift => {
            ("a shift by less than 0 or more than 31 bits", "0 より小さいか 31 を超えるビット数のシフトです")
        }
        Undefined::Bitfield => ("a field of bits that is not within 32", "32 ビットに収まらないビットフィールドです"),
        Undefined::Conversion => {
            ("a number that the type of whole numbers cannot hold", "整数の型に収まらない数を変換しています")
        }
        Undefined::NotANumber => ("a value that is no number", "数でない値 (NaN) です"),
        Undefined::Half => (
            "`round` of a number in the middle between two whole ones",
            "2 つの整数のちょうど中間の数に `round` を使っています",
        ),
        Undefined::Bounds => (
            "the first edge of `smoothstep`, or the first bound of `clamp`, is not the smaller one",
            "`smoothstep` や `clamp` の 1 つ目の端が、2 つ目より小さくありません",
        ),
        Undefined::Derivative => {
            ("a derivative where not all four pixels run", "4 画素がそろわないところで微分を求めています")
        }
        Undefined::Texture => ("a lookup that OpenGL leaves open", "OpenGL で結果の決まらないテクスチャ参照です"),
    }
}
