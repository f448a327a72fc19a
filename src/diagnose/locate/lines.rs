//! What stands on a line of the student's file.

use crate::source::Source;

/// The statement that a line is part of.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::diagnose) struct Statement {
    /// Its words; those of the macros that it uses as well.
    words: Vec<String>,
}

impl Statement {
    /// The statement that goes over line `number`, from 1.
    pub fn at(source: &Source, number: u32) -> Self {
        let code = source.code();
        let line = source.code_line(number);
        let Some(start) = source.offset(number, 1) else { return Self { words: Vec::new() } };
        let end = start + line.len();
        let is_end = |c: char| matches!(c, ';' | '{' | '}');
        let directive = line.trim_start().starts_with('#');
        let text = if directive {
            line
        } else {
            let first = code[..start].rfind(is_end).map_or(0, |at| at + 1);
            let last = code[end..].find(is_end).map_or(code.len(), |at| end + at);
            &code[first..if line.trim_end().ends_with(is_end) { end } else { last }]
        };
        let mut words = words(text);
        let macros: Vec<String> =
            code.lines().filter_map(macro_of).filter(|(name, _)| words.contains(name)).map(|(_, body)| body).collect();
        for body in macros {
            words.extend(self::words(&body));
        }
        Self { words }
    }

    /// The whole file.
    pub fn all(source: &Source) -> Self {
        Self { words: words(source.code()) }
    }

    /// Whether it has the word.
    pub fn has(&self, word: &str) -> bool {
        self.words.iter().any(|own| own == word)
    }
}

fn words(text: &str) -> Vec<String> {
    let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    text.split(|c| !is_word(c)).filter(|word| !word.is_empty()).map(str::to_owned).collect()
}

/// The name and the text of the macro that a line defines.
fn macro_of(line: &str) -> Option<(String, String)> {
    let rest = line.trim_start().strip_prefix('#')?.trim_start().strip_prefix("define")?.trim_start();
    let end = rest.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).unwrap_or(rest.len());
    Some((rest[..end].to_owned(), rest[end..].to_owned()))
}

/// Whether line `number` is one of the handed-out file, as it was.
pub(in crate::diagnose) fn is_handed_out(source: &Source, number: u32, starter: &str) -> bool {
    let squeezed = |line: &str| line.split_whitespace().collect::<String>();
    let line = squeezed(source.line(number));
    let code = squeezed(source.code_line(number));
    // The comment may have gone.
    let is_it = |other: &str| {
        let other = squeezed(other);
        other == line || other.split("//").next() == Some(&code)
    };
    !code.is_empty() && starter.lines().any(is_it)
}
