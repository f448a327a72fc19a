//! What is said to a person, in the two languages of the course.

use serde::Deserialize;

/// One message in English and in Japanese.
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Text {
    /// The message in English.
    pub en: String,
    /// The message in Japanese (です・ます).
    pub ja: String,
}

impl Text {
    /// Both wordings, each with `change` applied: how placeholders are filled in.
    pub fn map(&self, change: impl Fn(&str) -> String) -> Self {
        Self { en: change(&self.en), ja: change(&self.ja) }
    }
}
