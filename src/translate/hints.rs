//! What a message of the compiler means for a student, and where to look.
//!
//! The compiler says where it noticed; a hint looks through the file for where the mistake is.

mod brackets;
mod components;
mod declarations;
mod directives;
mod disallowed;
mod expression;
mod file;
pub mod link;
mod mismatch;
mod names;
mod overlooked;
mod rules;
mod statement;
mod suggestions;
mod syntax;
#[cfg(test)]
pub mod tests;
mod tokens;
mod types;
mod vocabulary;

pub use directives::{missing_version, refused_line_directive, without_line_directives};
pub use file::HintContext;
pub use overlooked::overlooked_errors;

use super::log::LogEntry;
use crate::diagnostic::{Diagnostic, Severity};
use crate::language::Text;
use std::ops::Range;
pub use tokens::Lexeme;

/// A message of the compiler with its place in the file.
#[derive(Clone, Debug)]
pub struct CompilerMessage<'e, 'a> {
    /// The message.
    pub entry: &'e LogEntry<'a>,
    /// Index of the code token that it is about; the number of tokens for the end of the file.
    pub index: usize,
    /// Index of the first token of the statement around it.
    pub statement: usize,
    /// Whether it is about a call of a function that GLSL and the file do not have.
    pub unknown_function: bool,
}

impl CompilerMessage<'_, '_> {
    /// Whether a real driver refuses the file for this too.
    pub fn is_error(&self) -> bool {
        self.entry.is_error && !matches!(self.entry.token, "line continuation" | "extraneous semicolon")
    }

    /// Whether nothing that the compiler says besides is worth reading.
    pub fn ends_everything(&self) -> bool {
        matches!(self.entry.token, "#version" | "#include")
            || directives::is_about_version(self.entry)
            || self.entry.message.starts_with("End of input in comment")
            || (self.entry.token == "#" && directives::is_misspelt_version(self.entry))
    }

    /// Whether it follows from `earlier`, wherever that stands.
    pub fn follows_from(&self, earlier: &CompilerMessage<'_, '_>) -> bool {
        let (before, now) = (earlier.entry, self.entry);
        let undeclared = earlier.misses_a_name() && before.token == now.token;
        // The compiler declares a name that it missed, and a declaration further down is then the second.
        let declared_by_that = now.message.starts_with("redefinition") || now.message.starts_with("can't use function");
        (undeclared && declared_by_that)
            || (before.message.starts_with("identifier not previously declared") && before.token == now.token)
            || (before.message.starts_with("invalid directive") && now.message.contains("#endif"))
            || (before.message.starts_with("invalid directive") && now.message.starts_with("mismatched"))
            || (before.token == "return" && now.message.contains("does not return a value"))
    }

    /// Whether a name is declared nowhere.
    pub fn misses_a_name(&self) -> bool {
        self.entry.message.starts_with("undeclared identifier")
    }

    /// Whether it is about a word as such, so that another mistake in the same statement is no reason for it.
    pub fn stands_alone(&self) -> bool {
        let message = self.entry.message;
        self.misses_a_name() || message.starts_with("Reserved word") || self.unknown_function || self.is_alien()
    }

    /// Whether it is about something that GLSL does not have at all.
    pub fn is_alien(&self) -> bool {
        matches!(self.entry.token, "string literal" | "::" | "'" | "explicit typecast" | "#include" | "#")
            || self.entry.message.starts_with("unexpected token")
    }

    /// Whether the parser gave up at `syntax` because of this.
    pub fn explains_syntax_error(&self, file: &HintContext<'_>, syntax: &CompilerMessage<'_, '_>) -> bool {
        let before = syntax.index.checked_sub(1);
        self.is_alien()
            || self.entry.message.starts_with("Reserved word")
            || self.index == syntax.index
            || before.and_then(|close| file.opening(close)).and_then(|open| open.checked_sub(1)) == Some(self.index)
            || (self.stands_alone() && before == Some(self.index) && file.word(before) == self.entry.token)
    }
}

/// Finds the place that `entry` is about.
pub fn find<'e, 'a>(file: &HintContext<'a>, entry: &'e LogEntry<'a>) -> CompilerMessage<'e, 'a> {
    let index = match entry.place {
        Some((line, column)) if entry.is_syntax_error() => {
            syntax::unexpected_token(file, entry, file.offset(line, column))
        }
        Some((line, column)) => names::locate(file, entry, file.offset(line, column)),
        None => file.code.len(),
    };
    let unknown_function =
        entry.message.starts_with("no matching overloaded") && !names::is_callable(file, entry.token);
    CompilerMessage { entry, index, statement: file.statement(index), unknown_function }
}

/// The index of the `}` that ended a function too early, where the parser gave up for that.
pub fn stray_brace(file: &HintContext<'_>, syntax: &CompilerMessage<'_, '_>) -> Option<usize> {
    brackets::stray_brace(file, syntax.index)
}

/// The words of the statement that `finding` is about.
pub fn statement_words<'a>(file: &HintContext<'a>, finding: &CompilerMessage<'_, '_>) -> impl Iterator<Item = &'a str> {
    file.code[statement_range(file, finding)].iter().map(|token| token.text)
}

/// The names that the statement around `finding` declares.
pub fn declared_in_statement<'a>(
    file: &HintContext<'a>,
    finding: &CompilerMessage<'_, '_>,
) -> impl Iterator<Item = &'a str> {
    let statement = statement_range(file, finding);
    file.declarations.iter().filter(move |d| statement.contains(&d.index)).map(|d| d.name)
}

fn statement_range(file: &HintContext<'_>, finding: &CompilerMessage<'_, '_>) -> Range<usize> {
    let start = finding.statement.min(file.code.len());
    let ends = |token: &Lexeme<'_>| matches!(token.text, ";" | "{" | "}");
    let end = file.code[start..].iter().position(ends).map_or(file.code.len(), |length| start + length);
    start..end
}

/// Puts an error into words.
pub fn explain(file: &HintContext<'_>, finding: &CompilerMessage<'_, '_>) -> Diagnostic {
    directives::explain(file, finding)
        .or_else(|| syntax::explain(file, finding))
        .or_else(|| names::explain(file, finding))
        .or_else(|| mismatch::explain(file, finding))
        .or_else(|| rules::explain(file, finding))
        .unwrap_or_else(|| in_the_compilers_words(file, finding))
}

/// Puts a warning into words, if it matters to a student.
pub fn warn(file: &HintContext<'_>, finding: &CompilerMessage<'_, '_>) -> Option<Diagnostic> {
    let diagnostic = disallowed::warn(file, finding)?;
    Some(Diagnostic { severity: Severity::Warning, ..diagnostic })
}

fn in_the_compilers_words(file: &HintContext<'_>, finding: &CompilerMessage<'_, '_>) -> Diagnostic {
    let words = finding.entry.message.trim_end_matches([':', '.', ' ']);
    let text = match finding.entry.token {
        "" => Text::new(
            format!("The compiler refuses this: “{words}”."),
            format!("コンパイラがエラーを報告しています:「{words}」。"),
        ),
        token => Text::new(
            format!("The compiler refuses `{token}`: “{words}”."),
            format!("`{token}` についてコンパイラがエラーを報告しています:「{words}」。"),
        ),
    };
    match finding.entry.place {
        // A place outside the code, such as a preprocessor line, has no token.
        Some((line, column)) => match file.code.get(finding.index) {
            Some(token) if file.line(token.start) == line => file.error_at(finding.index, text),
            _ => file.error(file.offset(line, column), 1, text),
        },
        None => Diagnostic::error(crate::diagnostic::DiagnosticStage::Compile, text),
    }
}
