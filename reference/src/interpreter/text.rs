//! Characters → the tokens that are compiled: lines joined, comments and directives gone, macros expanded.

mod condition;
mod lexer;
mod macros;
mod preprocessor;

pub use lexer::tokens;
pub use preprocessor::preprocess;

use super::parse::literal::literal;
use super::syntax::ExpressionKind;
use std::rc::Rc;

/// The numbers that stand in a text, each once, in their order.
pub fn numbers(text: &str) -> Vec<f64> {
    let mut found: Vec<f64> = Vec::new();
    for token in tokens(text).iter().filter(|token| token.kind == TokenKind::Number) {
        let number = match literal(&token.text) {
            Some(ExpressionKind::Integer(value, _) | ExpressionKind::Floating(value, _)) => value,
            _ => continue,
        };
        if !found.contains(&number) {
            found.push(number);
        }
    }
    found
}

/// What a token is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TokenKind {
    /// Name or keyword.
    Name,
    /// Number.
    Number,
    /// Operator or bracket.
    Symbol,
    /// The end of a line; none of them leaves the preprocessor.
    LineEnd,
    /// A character that GLSL has no use for.
    Stray,
}

/// One token.
#[derive(Clone, Debug)]
pub struct Token {
    /// What it is.
    pub kind: TokenKind,
    /// Its text.
    pub text: Rc<str>,
    /// The line in the file, from 1, `#line` directives aside; of a macro's tokens, where the macro is used.
    pub line: u32,
    /// The line on which it is written: of a macro's tokens, that of the macro; 0 of what no file has.
    pub written: u32,
    /// The byte of the text that was read at which it starts.
    pub at: u32,
    /// Whether it follows the token before without white space.
    touches: bool,
    /// The macros that it came out of, and which are not expanded in it again.
    hidden: Option<Rc<Hidden>>,
}

#[derive(Debug)]
struct Hidden {
    name: Rc<str>,
    others: Option<Rc<Hidden>>,
}

impl Drop for Hidden {
    fn drop(&mut self) {
        // One after the other: a chain as long as the file has macros must not be dropped by recursion.
        let mut next = self.others.take();
        while let Some(hidden) = next {
            next = Rc::into_inner(hidden).and_then(|mut hidden| hidden.others.take());
        }
    }
}

impl Token {
    fn new(kind: TokenKind, text: &str, line: u32) -> Self {
        Self { kind, text: text.into(), line, written: line, at: 0, touches: false, hidden: None }
    }

    /// The token on the line on which it is written.
    pub fn on_its_line(self) -> Self {
        Self { line: if self.written == 0 { self.line } else { self.written }, ..self }
    }

    /// Whether it is a name or keyword.
    pub fn is_name(&self) -> bool {
        self.kind == TokenKind::Name
    }

    fn is(&self, symbol: &str) -> bool {
        self.kind == TokenKind::Symbol && &*self.text == symbol
    }

    fn hides(&self, name: &str) -> bool {
        std::iter::successors(self.hidden.as_deref(), |hidden| hidden.others.as_deref())
            .any(|hidden| &*hidden.name == name)
    }
}
