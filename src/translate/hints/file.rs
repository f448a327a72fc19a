//! The student's file as the hints look at it: text, lines, tokens, declarations, and the assignment's interface.

use super::declarations::{self, DeclaredName};
use super::tokens::{self, Lexeme, LexemeKind};
use crate::diagnostic::{Diagnostic, DiagnosticStage};
use crate::language::Text;
use crate::translate::LinkedInterface;

/// What every hint may look at.
pub struct HintContext<'a> {
    /// The student's text; lines end with `\n`.
    pub text: &'a str,
    /// The tokens outside preprocessor lines.
    pub code: Vec<Lexeme<'a>>,
    /// The preprocessor lines.
    pub directives: Vec<Lexeme<'a>>,
    /// What the file declares, in order.
    pub declarations: Vec<DeclaredName<'a>>,
    /// What the assignment's program offers and takes.
    pub interface: &'a LinkedInterface,
    line_starts: Vec<usize>,
}

impl<'a> HintContext<'a> {
    /// Looks through `text`.
    pub fn new(text: &'a str, interface: &'a LinkedInterface) -> Self {
        let (directives, code): (Vec<_>, Vec<_>) =
            tokens::tokens(text).into_iter().partition(|token| token.kind == LexemeKind::Directive);
        let declarations = declarations::find(&code);
        let ends = text.match_indices('\n').map(|(end, _)| end + 1);
        let line_starts = std::iter::once(0).chain(ends).collect();
        Self { text, code, directives, declarations, interface, line_starts }
    }

    /// The byte offset of a place as the compiler counts: line from 1, column in bytes from 1. A place outside the
    /// file is moved to its nearest end.
    pub fn offset(&self, line: u32, column: u32) -> usize {
        let index = (line.max(1) as usize - 1).min(self.line_starts.len() - 1);
        let start = self.line_starts[index];
        let end = self.line_end(start);
        let mut offset = (start + column.max(1) as usize - 1).min(end);
        while !self.text.is_char_boundary(offset) {
            offset -= 1;
        }
        offset
    }

    fn line_end(&self, offset: usize) -> usize {
        self.text[offset..].find('\n').map_or(self.text.len(), |length| offset + length)
    }

    /// The line, from 1, of a byte offset.
    pub fn line(&self, offset: usize) -> u32 {
        u32::try_from(self.line_starts.partition_point(|&start| start <= offset)).unwrap_or(u32::MAX)
    }

    /// How many characters of white space the line of `offset` begins with.
    pub fn indentation(&self, offset: usize) -> usize {
        let start = self.line_starts[self.line(offset) as usize - 1];
        self.text[start..].chars().take_while(|c| matches!(c, ' ' | '\t')).count()
    }

    /// The index of the first code token that ends after `offset`; the number of tokens if there is none.
    pub fn index_at(&self, offset: usize) -> usize {
        self.code.partition_point(|token| token.end() <= offset)
    }

    /// The text of the code token `index`, or nothing beyond the ends.
    pub fn word(&self, index: Option<usize>) -> &'a str {
        index.and_then(|index| self.code.get(index)).map_or("", |token| token.text)
    }

    /// The index of the first token of the statement that the code token `index` belongs to.
    pub fn statement(&self, index: usize) -> usize {
        let before = &self.code[..index.min(self.code.len())];
        before.iter().rposition(|token| matches!(token.text, ";" | "{" | "}")).map_or(0, |end| end + 1)
    }

    /// The index of the bracket that closes the one at `open`.
    pub fn closing(&self, open: usize) -> Option<usize> {
        let mut depth = 0_usize;
        (open..self.code.len()).find(|&index| {
            match self.code[index].text {
                "(" | "[" | "{" => depth += 1,
                ")" | "]" | "}" => depth = depth.saturating_sub(1),
                _ => {}
            }
            depth == 0
        })
    }

    /// The index of the bracket that the one at `close` closes.
    pub fn opening(&self, close: usize) -> Option<usize> {
        let mut depth = 0_usize;
        (0..=close.min(self.code.len().checked_sub(1)?)).rev().find(|&index| {
            match self.code[index].text {
                ")" | "]" | "}" => depth += 1,
                "(" | "[" | "{" => depth = depth.saturating_sub(1),
                _ => {}
            }
            depth == 0
        })
    }

    /// The declaration that `name` refers to at byte `offset`: the last one before it whose scope is still open.
    pub fn visible(&self, name: &str, offset: usize) -> Option<&DeclaredName<'a>> {
        self.declarations.iter().rev().find(|d| d.name == name && d.is_visible(offset))
    }

    /// The first declaration of `name` anywhere.
    pub fn anywhere(&self, name: &str) -> Option<&DeclaredName<'a>> {
        self.declarations.iter().find(|d| d.name == name)
    }

    /// The `#define` line of `name`.
    pub fn definition(&self, name: &str) -> Option<&Lexeme<'a>> {
        self.directives.iter().find(|line| macro_name(line.text) == Some(name))
    }

    /// An error about the comment that swallows `name`: one that reaches over the `/*` of the next comment to its end.
    pub fn swallowed(&self, name: &str) -> Option<Diagnostic> {
        let has_name = |part: &str| tokens::tokens(part).iter().any(|token| token.text == name);
        let code_in = |comment: &str| comment.lines().skip(1).any(has_name);
        let comment = tokens::comments(self.text).into_iter().find(|comment| {
            let inside = &self.text[comment.start + 2..comment.end];
            inside.contains("/*") && code_in(inside)
        })?;
        let (first, last) = (self.line(comment.start), self.line(comment.end - 1));
        let text = Text::new(
            format!("This comment ends only on line {last}, and so hides the code in between."),
            format!("このコメントは {last} 行目まで続いているので、その間のコードが無効になっています。"),
        );
        let hint = Text::new(
            format!("The `*/` of the comment on line {first} is missing; `{name}` stands inside it."),
            format!("{first} 行目のコメントを閉じる `*/` がありません。`{name}` がコメントの中に入っています。"),
        );
        Some(self.error(comment.start, 2, text).hint(hint))
    }

    /// An error of the compiler about `length` bytes from `offset` on.
    pub fn error(&self, offset: usize, length: usize, message: Text) -> Diagnostic {
        let offset = offset.min(self.text.len());
        let line = self.line(offset);
        let start = self.line_starts[line as usize - 1];
        let characters = |part: Option<&str>| part.map_or(0, |part| part.chars().count());
        let column = u32::try_from(characters(self.text.get(start..offset)) + 1).unwrap_or(u32::MAX);
        let end = (offset + length).min(self.line_end(offset));
        Diagnostic::error(DiagnosticStage::Compile, message)
            .at(line, Some(column))
            .spanning(characters(self.text.get(offset..end)))
    }

    /// An error of the compiler about the code token `index`; about the end of the file beyond the last.
    pub fn error_at(&self, index: usize, message: Text) -> Diagnostic {
        match self.code.get(index) {
            Some(token) => self.error(token.start, token.text.len(), message),
            None => self.error(self.text.trim_end().len(), 1, message),
        }
    }

    /// An error of the compiler about the place just after the code token `index`.
    pub fn error_after(&self, index: usize, message: Text) -> Diagnostic {
        self.error(self.code[index].end(), 1, message)
    }
}

/// The name that a `#define` line defines.
pub fn macro_name(directive: &str) -> Option<&str> {
    let rest = directive.strip_prefix('#')?.trim_start().strip_prefix("define")?.trim_start();
    let end = rest.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).unwrap_or(rest.len());
    (end > 0).then(|| &rest[..end])
}
