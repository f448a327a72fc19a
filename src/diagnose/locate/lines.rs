//! What stands on a line of the student's file.

use crate::source::{self, Source};
use reference::interpreter::{Stage, outline};
use std::collections::HashSet;

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
    let handed_out = || starter.lines().flat_map(constants).collect::<HashSet<_>>();
    let own = constants(source.code_line(number));
    let are_the_same = || own.is_subset(&handed_out());
    !code.is_empty() && (starter.lines().any(is_it) || !own.is_empty() && are_the_same())
}

/// The constants that a line of declarations defines, each with its value; several may stand on one line.
fn constants(line: &str) -> HashSet<Vec<String>> {
    let words = values(line);
    let [first, _, rest @ ..] = &words[..] else { return HashSet::new() };
    if first != "const" {
        return HashSet::new();
    }
    let mut depth = 0_usize;
    let is_between = |word: &String| {
        match word.as_str() {
            "(" => depth += 1,
            ")" => depth = depth.saturating_sub(1),
            _ => {}
        }
        depth == 0 && matches!(word.as_str(), "," | ";")
    };
    rest.split(is_between).filter(|own| !own.is_empty()).map(<[String]>::to_vec).collect()
}

/// The words and signs of a line, each number by its value.
fn values(line: &str) -> Vec<String> {
    let words = outline::words(line.split("//").next().unwrap_or_default()).into_iter().map(|word| word.text);
    words.map(|word| word.parse::<f64>().map_or(word, |number| number.to_string())).collect()
}
