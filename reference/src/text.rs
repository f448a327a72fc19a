//! What is said to a person, in the two languages of the course.

use schemars::JsonSchema;
use serde::Deserialize;

/// One message in English and in Japanese.
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Text {
    /// The message in English.
    pub en: String,
    /// The message in Japanese (です・ます).
    pub ja: String,
}

impl Text {
    /// What stands in both languages as it is: a word of a file, or what another program says.
    pub fn verbatim(text: impl Into<String>) -> Self {
        let en = text.into();
        Self { ja: en.clone(), en }
    }

    /// Both wordings with their `{placeholders}` filled in. A part in ⟨ ⟩ is left out if one of its placeholders is not given; what
    /// follows a `|` in it stands there instead.
    pub fn fill(&self, values: &[(&str, &str)]) -> Self {
        Self { en: fill(&self.en, values), ja: fill(&self.ja, values) }
    }
}

/// A message in both languages.
pub(crate) fn both(en: impl Into<String>, ja: impl Into<String>) -> Text {
    Text { en: en.into(), ja: ja.into() }
}

fn fill(text: &str, values: &[(&str, &str)]) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some((before, after)) = rest.split_once('⟨') {
        let (optional, after) = after.split_once('⟩').unwrap_or((after, ""));
        out.push_str(&substitute(before, values));
        let (optional, instead) = optional.split_once('|').unwrap_or((optional, ""));
        // What a value brings in stays as it is; a placeholder of ours is one in the text.
        let is_complete = placeholders(optional).all(|name| values.iter().any(|(n, _)| *n == name));
        out.push_str(&substitute(if is_complete { optional } else { instead }, values));
        rest = after;
    }
    out.push_str(&substitute(rest, values));
    out
}

/// The names in braces.
fn placeholders(text: &str) -> impl Iterator<Item = &str> {
    text.split('{').skip(1).filter_map(|part| part.split_once('}').map(|(name, _)| name))
}

/// In one pass, so that braces in a value are not taken for placeholders.
fn substitute(text: &str, values: &[(&str, &str)]) -> String {
    let mut parts = text.split('{');
    let mut out = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let known = part.split_once('}').and_then(|(name, after)| {
            let value = values.iter().find(|(n, _)| *n == name);
            value.map(|(_, v)| (*v, after))
        });
        match known {
            Some((value, after)) => {
                out.push_str(value);
                out.push_str(after);
            }
            None => {
                out.push('{');
                out.push_str(part);
            }
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(en: &str) -> Text {
        Text { en: en.into(), ja: en.into() }
    }

    #[test]
    fn a_part_in_angle_brackets_needs_its_placeholders() {
        let look = text("Look at `h`⟨ on line {line}⟩: how long is⟨ `{name}`⟩ it?");
        assert_eq!(look.fill(&[("line", "37")]).en, "Look at `h` on line 37: how long is it?");
        assert_eq!(look.fill(&[]).ja, "Look at `h`: how long is it?");
    }

    #[test]
    fn a_value_is_taken_literally() {
        let look = text("⟨`{name}`|The result⟩ is wrong.");
        assert_eq!(look.fill(&[("name", "h")]).en, "`h` is wrong.");
        assert_eq!(look.fill(&[]).en, "The result is wrong.");
        let look = text("{name}⟨ and {line}⟩");
        let filled = look.fill(&[("name", "a{line}⟨b"), ("line", "{name}")]);
        assert_eq!(filled.en, "a{line}⟨b and {name}");
    }
}
