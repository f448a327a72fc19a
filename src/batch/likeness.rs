//! `likeness.html`: the answers of a class that are alike, side by side, on one page without scripts.

use crate::class::folder::OutputFolder;
use crate::fault::Fault;
use crate::language::{Language, Text};
use crate::likeness::Comparison;
use crate::likeness::view;
use crate::report::html::BASE_STYLE;
use askama::Template;
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use sha2::{Digest, Sha256};

/// Name of the file.
pub const NAME: &str = "likeness.html";

const STYLE: &str = "details { margin-block: 1rem; padding-top: 1rem; border-top: 1px solid var(--rule); }\n\
                     summary { cursor: pointer; padding-block: .4rem; }\nsummary small { color: var(--quiet); }\n";

#[derive(Template)]
#[template(path = "batch/templates/likeness.html")]
struct ComparisonPage<'a> {
    language: Language,
    tag: &'static str,
    title: &'a str,
    style: String,
    style_digest: String,
    comparisons: &'a [Comparison],
}

impl ComparisonPage<'_> {
    fn say(&self, en: &'static str, ja: &'static str) -> &'static str {
        match self.language {
            Language::En => en,
            Language::Ja => ja,
        }
    }
}

/// Writes the page, or takes away that of an earlier run where nobody is alike. Gives its name, and what it is.
pub fn write(
    title: &str,
    comparisons: &[Comparison],
    language: Language,
    folder: &OutputFolder,
) -> Result<Option<(String, Text)>, Fault> {
    if comparisons.is_empty() {
        folder.remove(NAME)?;
        return Ok(None);
    }
    let style = format!("{BASE_STYLE}{STYLE}{}", view::STYLE);
    let page = ComparisonPage {
        language,
        tag: match language {
            Language::En => "en",
            Language::Ja => "ja",
        },
        title,
        style_digest: STANDARD.encode(Sha256::digest(&style)),
        style,
        comparisons,
    };
    let page = page.render().map_err(|error| {
        Fault::new(Text::new(
            format!("The page of answers that are alike could not be written: {error}."),
            format!("似ている提出のページを生成できませんでした（{error}）。"),
        ))
    })?;
    folder.write(NAME, page.as_bytes())?;
    let what = Text::new(
        "Answers that are alike, side by side: a hint, and no verdict",
        "似ている提出の比較（手がかりであり、判定ではありません）",
    );
    Ok(Some((NAME.into(), what)))
}
