//! The two languages in which ggrade speaks.

use serde::{Deserialize, Serialize};

/// A language of the course.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum, Serialize, Deserialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
#[serde(rename_all = "lowercase")]
pub enum Language {
    /// 日本語
    Ja,
    /// English
    #[default]
    En,
}

impl Language {
    /// The wording of an assignment's text in this language.
    pub fn of(self, text: &reference::Text) -> &str {
        match self {
            Self::En => &text.en,
            Self::Ja => &text.ja,
        }
    }
}

/// One message in both languages. A report keeps both, so that it can be read in either later.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Text {
    /// The message in English.
    pub en: String,
    /// The message in Japanese (です・ます).
    pub ja: String,
}

impl Text {
    /// Both wordings at once.
    pub fn new(en: impl Into<String>, ja: impl Into<String>) -> Self {
        Self { en: en.into(), ja: ja.into() }
    }

    /// A text that is the same in both languages, such as a compiler's own words.
    pub fn verbatim(text: impl Into<String>) -> Self {
        let en = text.into();
        Self { ja: en.clone(), en }
    }

    /// The wording in `language`.
    pub fn get(&self, language: Language) -> &str {
        match language {
            Language::En => &self.en,
            Language::Ja => &self.ja,
        }
    }
}

/// What a homework's folder says, or what is wrong with it.
impl From<reference::Text> for Text {
    fn from(text: reference::Text) -> Self {
        Self { en: text.en, ja: text.ja }
    }
}

/// A span of milliseconds in its two largest units, such as `2 days 3 hours`; minutes are followed by nothing. The student's page
/// writes it in the same way.
pub(crate) fn span(span: u64, language: Language) -> String {
    const UNITS: [(u64, &str, &str); 4] =
        [(86_400_000, "day", "日"), (3_600_000, "hour", "時間"), (60_000, "minute", "分"), (1000, "second", "秒")];
    let first = UNITS.iter().position(|(length, ..)| span >= *length).unwrap_or(UNITS.len() - 1);
    let units = if first < 2 { &UNITS[first..first + 2] } else { &UNITS[first..=first] };
    let mut rest = span;
    let mut said = Vec::new();
    for (index, (length, en, ja)) in units.iter().enumerate() {
        let count = rest / length;
        rest %= length;
        if count > 0 || index == 0 {
            said.push(match language {
                Language::En => format!("{count} {en}{}", if count == 1 { "" } else { "s" }),
                Language::Ja => format!("{count} {ja}"),
            });
        }
    }
    said.join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_span_is_said_in_its_two_largest_units() {
        let (day, hour, minute) = (86_400_000, 3_600_000, 60_000);
        let said = |at| [span(at, Language::En), span(at, Language::Ja)];
        assert_eq!(said(2 * day + 3 * hour + 59 * minute), ["2 days 3 hours", "2 日 3 時間"]);
        assert_eq!(said(day), ["1 day", "1 日"]);
        assert_eq!(said(hour + minute), ["1 hour 1 minute", "1 時間 1 分"]);
        assert_eq!(said(12 * minute + 59_999), ["12 minutes", "12 分"]);
        assert_eq!(said(45_999), ["45 seconds", "45 秒"]);
        assert_eq!(said(0), ["0 seconds", "0 秒"]);
    }
}
