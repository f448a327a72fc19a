//! Which parts of the solution show nowhere.

use super::CheckWording;
use super::shows::is_seen;
use crate::language::Text;
use reference::interpreter::{ChangedPart, Scalar};
use reference::probes::ProbeSet;
use reference::rasteriser::Frame;
use reference::unseen::{Revealing, UnseenPart};
use reference::{Assignment, Value};

/// So many parts are named.
const MOST: usize = 12;

/// Names the parts of the solution without which all probes and all pictures are the same, and what would show them.
pub(super) fn say(said: CheckWording, assignment: &Assignment, probes: &ProbeSet, right: &[Frame]) {
    for uniform in assignment.idle_uniforms(probes) {
        said.note(&Text::new(
            format!(
                "uniform `{uniform}`: with other values the solution shows the same at all probes, so an answer without it has full marks. \
                 Give what it works on other values, or leave it out of the solution"
            ),
            format!(
                "uniform `{uniform}`: 値を変えても解答はどの検査点でも同じなので、使わない答えも満点になります。関係する値を変えるか、\
                 不要なら解答から省いてください"
            ),
        ));
    }
    let unseen = assignment.unseen_parts(probes);
    let unseen: Vec<&UnseenPart> = unseen.iter().filter(|one| !assignment.is_pictured(one, right, &is_seen)).collect();
    let (named, more) = unseen.split_at(unseen.len().min(MOST));
    for (one, revealing) in named.iter().zip(assignment.revealing(named, probes)) {
        said.note(&text(one, revealing.as_ref(), assignment.gradual.is_some()));
    }
    if !more.is_empty() {
        let more = more.len();
        said.note(&Text::new(
            format!("{more} more parts of the solution show nowhere"),
            format!("ほかに {more} か所も、どこにも現れません"),
        ));
    }
}

/// `by_course`: whether answers are judged by their way across edges as well.
fn text(unseen: &UnseenPart, revealing: Option<&Revealing>, by_course: bool) -> Text {
    let UnseenPart { file, part: ChangedPart { lines: (line, _), own, instead, .. }, .. } = unseen;
    let what = match instead {
        Some(instead) => {
            Text::new(format!("`{instead}` in place of `{own}` shows"), format!("`{own}` を `{instead}` にしても"))
        }
        None => Text::new(format!("leaving out `{own}` shows"), format!("`{own}` を省いても")),
    };
    let hint = match revealing {
        Some(Revealing { uniform, value }) => {
            let value = written(value);
            Text::new(
                format!(
                    "It would show with `{uniform}` = {value}: let its `probe = {{ within = … }}` in assignment.toml reach that far, or give it \
                     that `value`"
                ),
                format!(
                    "`{uniform}` が {value} なら現れます。assignment.toml の `probe = {{ within = … }}` をそこまで広げるか、`value` をその値にしてください"
                ),
            )
        }
        None => Text::new(
            "Give what it is computed from other values, or add a second [[scene]] with another mesh, camera or texture in which it \
             shows; or leave it out of the solution",
            "計算のもとになる値を変えるか、それが現れるメッシュ、カメラ、テクスチャの [[scene]] を追加してください。不要なら解答から省いてください",
        ),
    };
    let so = match by_course {
        false => Text::new("an answer like that has full marks", "そう書いた答えも満点になります"),
        true => Text::new(
            "an answer like that is told by its way across edges, if at all",
            "そう書いた答えは、見分けられるとしても境目の変わり方だけによります",
        ),
    };
    Text::new(
        format!("{file}:{line}: {} at no probe and in no frame, so {}. {}", what.en, so.en, hint.en),
        format!("{file}:{line}: {}、検査点にも画像にも違いが出ないので、{}。{}", what.ja, so.ja, hint.ja),
    )
}

/// A value as `assignment.toml` has it.
fn written(value: &Value) -> String {
    let is_whole = value.kind().scalar() != Some(Scalar::Float);
    let number = |number: &f64| match is_whole {
        true => number.to_string(),
        false => format!("{:?}", (number * 1e3).round() / 1e3),
    };
    match value.numbers() {
        [one] => number(one),
        all => format!("[{}]", all.iter().map(number).collect::<Vec<_>>().join(", ")),
    }
}
