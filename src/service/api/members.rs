//! Objects that programs send, read member by member: by the description of the API it is said which member is wrong, what is, and
//! what it takes.

use super::body::other;
use crate::language::Text;
use crate::service::clock::has_rfc3339;
use crate::service::errors::Problem;
use axum::Json;
use axum::extract::rejection::JsonRejection;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};
use utoipa::PartialSchema;

/// Longest value that is quoted, in characters.
const LONGEST_QUOTED: usize = 80;

/// A time as programs write it.
const TIME: &str = "2027-06-01T23:59:00+09:00";

/// What a program sent.
pub(super) fn read<T: DeserializeOwned + PartialSchema>(
    sent: Result<Json<Value>, JsonRejection>,
) -> Result<T, Problem> {
    let Json(sent) = sent.map_err(other)?;
    let Value::Object(sent) = sent else { return Err(no_object()) };
    typed(sent, true)
}

/// An object with the members of a patch in the place of its own (RFC 7396, of one level).
pub(super) fn patched<T: Serialize + DeserializeOwned + PartialSchema>(
    before: &T,
    patch: &Value,
) -> Result<T, Problem> {
    let mut whole = serde_json::to_value(before).map_err(|error| Problem::internal(&error))?;
    let (Some(members), Some(patch)) = (whole.as_object_mut(), patch.as_object()) else { return Err(no_object()) };
    members.extend(patch.iter().map(|(name, value)| (name.clone(), value.clone())));
    typed(std::mem::take(members), false)
}

fn no_object() -> Problem {
    Problem::unprocessable("The body is no JSON object.", "本文が JSON オブジェクトではありません。")
}

fn typed<T: DeserializeOwned + PartialSchema>(object: Map<String, Value>, is_whole: bool) -> Result<T, Problem> {
    let schema = serde_json::to_value(T::schema()).map_err(|error| Problem::internal(&error))?;
    if let Some(wrong) = wrong(&schema, &object, is_whole) {
        return Err(Problem::unprocessable(wrong.en, wrong.ja));
    }
    serde_json::from_value(Value::Object(object)).map_err(|error| {
        Problem::unprocessable(
            format!("The object cannot be read: {error}. /api/docs says what it takes."),
            format!("オブジェクトを読み取れません（{error}）。指定できる内容は /api/docs にあります。"),
        )
    })
}

/// What is wrong with an object, by the schema of what it is to be; `is_whole` says that a member may be missing.
fn wrong(schema: &Value, object: &Map<String, Value>, is_whole: bool) -> Option<Text> {
    let known = schema["properties"].as_object()?;
    for (name, value) in object {
        let Some(property) = known.get(name) else {
            let names = known.keys().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
            let name = quoted(name);
            return Some(Text::new(
                format!("There is no `{name}` here. There are {names}."),
                format!("「{name}」という項目はありません。指定できる項目: {names}"),
            ));
        };
        let kinds = kinds(property);
        if !kinds.is_empty() && !kinds.iter().any(|kind| kind.takes(value)) {
            let (takes, value) = (said(&kinds), quoted(&value.to_string()));
            return Some(Text::new(
                format!("`{name}` takes {}, not {value}.", takes.en),
                format!("`{name}` に {value} は指定できません。指定できる値: {}", takes.ja),
            ));
        }
    }
    let required = schema["required"].as_array().into_iter().flatten().filter_map(Value::as_str);
    let missing = required.filter(|_| is_whole).find(|name| !object.contains_key(*name))?;
    let takes = said(&kinds(known.get(missing)?));
    Some(Text::new(
        format!("`{missing}` is missing: it takes {}.", takes.en),
        format!("`{missing}` がありません。指定できる値: {}", takes.ja),
    ))
}

/// The beginning of what somebody sent.
fn quoted(text: &str) -> String {
    text.chars().take(LONGEST_QUOTED).collect()
}

/// A kind of value that a member takes.
enum Kind<'a> {
    Null,
    Boolean,
    /// At least this.
    Integer(Option<i64>),
    Number,
    /// One of these words.
    Word(Vec<&'a str>),
    Time,
    Text,
    List,
    Object,
}

/// The kinds that a member takes by its schema; nothing where that leaves it open.
fn kinds(schema: &Value) -> Vec<Kind<'_>> {
    // What is described in place has its own description beside the type.
    if let Some(first) = schema["allOf"].get(0) {
        return kinds(first);
    }
    if let Some(several) = schema["oneOf"].as_array() {
        let all: Vec<Vec<Kind<'_>>> = several.iter().map(kinds).collect();
        return if all.iter().any(Vec::is_empty) { Vec::new() } else { all.into_iter().flatten().collect() };
    }
    let types = match &schema["type"] {
        Value::Array(several) => several.iter().filter_map(Value::as_str).collect(),
        one => Vec::from_iter(one.as_str()),
    };
    let of = |name: &str| match name {
        "null" => Some(Kind::Null),
        "boolean" => Some(Kind::Boolean),
        "integer" => Some(Kind::Integer(schema["minimum"].as_i64())),
        "number" => Some(Kind::Number),
        "string" => Some(match schema["enum"].as_array() {
            Some(words) => Kind::Word(words.iter().filter_map(Value::as_str).collect()),
            None if schema["format"] == "date-time" => Kind::Time,
            None => Kind::Text,
        }),
        "array" => Some(Kind::List),
        "object" => Some(Kind::Object),
        _ => None,
    };
    types.into_iter().filter_map(of).collect()
}

impl Kind<'_> {
    fn takes(&self, value: &Value) -> bool {
        match self {
            Self::Null => value.is_null(),
            Self::Boolean => value.is_boolean(),
            Self::Integer(least) => match value.as_i64() {
                Some(number) => least.is_none_or(|least| number >= least),
                None => value.is_u64(),
            },
            Self::Number => value.is_number(),
            Self::Word(words) => value.as_str().is_some_and(|text| words.contains(&text)),
            Self::Time => value.as_str().is_some_and(|text| text.parse().is_ok_and(has_rfc3339)),
            Self::Text => value.is_string(),
            Self::List => value.is_array(),
            Self::Object => value.is_object(),
        }
    }

    fn said(&self) -> Text {
        match self {
            Self::Null => Text::new("null", "null"),
            Self::Boolean => Text::new("true or false", "true か false"),
            Self::Integer(Some(least)) => {
                Text::new(format!("a whole number from {least}"), format!("{least} 以上の整数"))
            }
            Self::Integer(None) => Text::new("a whole number", "整数"),
            Self::Number => Text::new("a number", "数値"),
            Self::Word(words) => {
                let words: Vec<String> = words.iter().map(|word| format!("`{word}`")).collect();
                Text::new(words.join(" or "), format!("{} のいずれか", words.join("、")))
            }
            Self::Time => Text::new(format!("a time such as {TIME}"), format!("{TIME} の形式の日時")),
            Self::Text => Text::new("a text", "文字列"),
            Self::List => Text::new("a list", "リスト"),
            Self::Object => Text::new("an object", "オブジェクト"),
        }
    }
}

/// What a member takes, in words.
fn said(kinds: &[Kind<'_>]) -> Text {
    let all: Vec<Text> = kinds.iter().map(Kind::said).collect();
    let join = |part: fn(&Text) -> &str, with: &str| all.iter().map(part).collect::<Vec<_>>().join(with);
    Text::new(join(|text| &text.en, " or "), join(|text| &text.ja, "、"))
}
