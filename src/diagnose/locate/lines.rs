//! What stands on a line of the student's file.

use crate::source::{self, Source};
use reference::interpreter::{Stage, outline};

/// What is written on a line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::diagnose) struct Words(Vec<String>);

impl Words {
    /// The words of line `number`, from 1, and of the macros that it uses.
    pub fn at(source: &Source, number: u32) -> Self {
        let mut words = words(source.code_line(number));
        let macros = source.code().lines().filter_map(macro_of).filter(|(name, _)| words.contains(name));
        let bodies: Vec<String> = macros.map(|(_, body)| body).collect();
        words.extend(bodies.iter().flat_map(|body| self::words(body)));
        Self(words)
    }

    /// All files.
    pub fn all(sources: &[(Stage, &Source)]) -> Self {
        Self(sources.iter().flat_map(|(_, source)| words(source.code())).collect())
    }

    /// Whether it has the word.
    pub fn has(&self, word: &str) -> bool {
        self.0.iter().any(|own| own == word)
    }
}

fn words(text: &str) -> Vec<String> {
    source::words(text).map(|(_, word)| word.to_owned()).collect()
}

/// The name and the text of the macro that a line defines.
fn macro_of(line: &str) -> Option<(String, String)> {
    let rest = line.trim_start().strip_prefix('#')?.trim_start().strip_prefix("define")?.trim_start();
    let end = rest.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).unwrap_or(rest.len());
    Some((rest[..end].to_owned(), rest[end..].to_owned()))
}

/// Whether line `number` is one of the handed-out file, as it was. The numbers of a constant may be written in another way.
pub(in crate::diagnose) fn is_handed_out(source: &Source, number: u32, starter: &str) -> bool {
    let squeezed = |line: &str| line.split_whitespace().collect::<String>();
    let line = squeezed(source.line(number));
    let code = squeezed(source.code_line(number));
    // The comment may have gone.
    let is_it = |other: &str| {
        let other = squeezed(other);
        other == line || other.split("//").next() == Some(&code)
    };
    let constant = code.starts_with("const").then(|| values(source.code_line(number)));
    let is_same_constant = |other: &str| constant.as_ref().is_some_and(|own| values(other) == *own);
    !code.is_empty() && starter.lines().any(|other| is_it(other) || is_same_constant(other))
}

/// The words and signs of a line, each number by its value.
fn values(line: &str) -> Vec<String> {
    let words = outline::words(line.split("//").next().unwrap_or_default()).into_iter().map(|word| word.text);
    words.map(|word| word.parse::<f64>().map_or(word, |number| number.to_string())).collect()
}
