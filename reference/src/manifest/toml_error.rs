//! What is wrong in a file that does not read as a manifest, as a person can mend it.

use crate::Text;
use crate::text::both;

/// A name that is so far from another, in letters changed, is not what was meant.
const FARTHEST: usize = 3;

/// The message of the TOML reader, with what to write instead.
pub(super) fn explained(message: &str) -> Text {
    let named: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    let known = || listed(&named[1..]);
    match (message.split(['`', ':']).next().unwrap_or_default().trim(), &named[..]) {
        ("unknown field", [found, rest @ ..]) if !rest.is_empty() => match nearest(found, rest) {
            Some(near) => both(
                format!("there is no key `{found}`: write `{near}`; known are {}", known()),
                format!("`{found}` というキーはありません。`{near}` と書いてください (使えるキー: {})", known()),
            ),
            None => both(
                format!("there is no key `{found}`: known are {}", known()),
                format!("`{found}` というキーはありません。使えるキー: {}", known()),
            ),
        },
        ("unknown variant", [found, rest @ ..]) if !rest.is_empty() => {
            let near =
                nearest(found, rest).map(|near| (format!("write `{near}`; "), format!("`{near}` と書いてください。")));
            let (en, ja) = near.unwrap_or_default();
            both(
                format!("`{found}` is not known here: {en}possible are {}", known()),
                format!("ここでは `{found}` は使えません。{ja}使えるもの: {}", known()),
            )
        }
        ("missing field", [lacking]) => both(
            format!("`{lacking}` is missing: write `{lacking} = …`"),
            format!("`{lacking}` がありません。`{lacking} = …` を書いてください"),
        ),
        ("invalid type", _) => of_type(message),
        _ => unread(message),
    }
}

/// What the reader of TOML says; it speaks English.
fn unread(message: &str) -> Text {
    both(message, format!("TOML として読めません ({message})"))
}

fn listed(names: &[&str]) -> String {
    names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}

/// The name that is nearest to one that nobody knows.
pub(super) fn nearest<'n>(found: &str, known: &[&'n str]) -> Option<&'n str> {
    let distance = |name: &&str| strsim::damerau_levenshtein(found, name);
    let near = known.iter().copied().min_by_key(distance)?;
    (distance(&near) <= FARTHEST.min(near.len() / 2)).then_some(near)
}

/// `invalid type: integer `3`, expected a string`
fn of_type(message: &str) -> Text {
    let rest = message.trim_start_matches("invalid type: ");
    let Some((found, expected)) = rest.rsplit_once(", expected ") else { return unread(message) };
    let (en, ja) = match expected.trim() {
        "a string" => ("text between quotation marks, \"…\"", "引用符で囲んだ文字列 \"…\""),
        "f64" => ("a number", "数"),
        "u32" | "u8" | "usize" => ("a whole number that is not negative", "0 以上の整数"),
        "a boolean" => ("true or false", "true または false"),
        "a sequence" => ("a list, [ … ]", "リスト [ … ]"),
        "a map" => ("a table, { … }", "テーブル { … }"),
        expected if expected.starts_with("struct ") => ("a table, { … }", "テーブル { … }"),
        expected if expected.starts_with("an array") => ("a list, [ … ]", "リスト [ … ]"),
        expected => (expected, expected),
    };
    both(
        format!("this is {}: write {en}", kind_of(found)),
        format!("{}になっています。{ja}を書いてください", kind_in_japanese(found)),
    )
}

fn kind_of(found: &str) -> String {
    match found {
        "map" => "a table".to_owned(),
        "sequence" => "a list".to_owned(),
        other if other.starts_with(['a', 'e', 'i', 'o', 'u']) => format!("an {other}"),
        other => format!("a {other}"),
    }
}

fn kind_in_japanese(found: &str) -> String {
    let (kind, value) = found.split_once(' ').unwrap_or((found, ""));
    let kind = match kind {
        "integer" => "整数",
        "floating" => "小数",
        "string" => "文字列",
        "boolean" => "真偽値",
        "map" => "テーブル",
        "sequence" => "リスト",
        other => other,
    };
    let value = value.trim_start_matches("point ");
    if value.is_empty() { kind.to_owned() } else { format!("{kind} {value} ") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::manifest::Manifest;

    fn said(text: &str) -> Text {
        explained(toml::from_str::<Manifest>(text).expect_err("broken").message())
    }

    #[test]
    fn the_nearest_key_is_named() {
        let Text { en, ja } = said("id = \"x\"\nttle = \"y\"");
        assert!(en.starts_with("there is no key `ttle`: write `title`; known are `id`, `extends`,"), "{en}");
        assert!(ja.starts_with("`ttle` というキーはありません。`title` と書いてください"), "{ja}");
        let far = said("id = \"x\"\nquaternions = 3");
        assert!(far.en.starts_with("there is no key `quaternions`: known are"), "{}", far.en);
        let variant = said("[[input]]\nname = \"a\"\ncarries = \"positon\"");
        assert!(variant.en.contains("`positon` is not known here: write `position`; possible are"), "{}", variant.en);
        assert!(said("[[file]]\nname = \"a\"\nstage = \"fragement\"").en.contains("write `fragment`"));
    }

    #[test]
    fn what_is_missing_or_of_another_type_is_said_with_what_to_write() {
        let lacking = said("id = \"x\"\ntitle = { en = \"a\" }");
        assert_eq!(lacking.en, "`ja` is missing: write `ja = …`");
        let number = said("id = 3");
        assert_eq!(number.en, "this is an integer `3`: write text between quotation marks, \"…\"");
        assert!(number.ja.starts_with("整数 `3` になっています。引用符で囲んだ文字列"), "{}", number.ja);
        let title = said("id = \"x\"\ntitle = \"Fog\"");
        assert!(title.en.ends_with("write a table, { … }"), "{}", title.en);
        let points = said("[[rubric]]\nid = \"x\"\npoints = \"ten\"");
        assert!(points.en.ends_with("write a number"), "{}", points.en);
    }
}
