//! From characters to the smallest parts of an expression.

use super::{Parser, Typed, is_identifier};
use crate::expression::value::Type;
use crate::expression::{ExpressionError, Node};

impl Parser<'_> {
    pub(super) fn error(&self, at: usize, message: impl Into<String>) -> ExpressionError {
        ExpressionError { column: at + 1, message: message.into() }
    }

    pub(super) fn skip_space(&mut self) {
        while self.text.get(self.at).is_some_and(|c| c.is_whitespace()) {
            self.at += 1;
        }
    }

    /// Takes `token` if it comes next.
    pub(super) fn take(&mut self, token: &str) -> bool {
        self.skip_space();
        let rest = &self.text[self.at..];
        let found = token.chars().enumerate().all(|(i, c)| rest.get(i) == Some(&c));
        if found {
            self.at += token.chars().count();
        }
        found
    }

    pub(super) fn expect(&mut self, token: &str) -> Result<(), ExpressionError> {
        if self.take(token) { Ok(()) } else { Err(self.error(self.at, format!("`{token}` expected"))) }
    }

    /// Whether the text between two places is an integer literal.
    pub(super) fn is_integer(&self, from: usize, to: usize) -> bool {
        let text: String = self.text[from..to].iter().collect();
        let text = text.trim().trim_matches(|c| c == '(' || c == ')');
        !text.is_empty() && text.chars().all(|c| c.is_ascii_digit())
    }

    pub(super) fn identifier(&mut self) -> Result<String, ExpressionError> {
        let start = self.at;
        while self.text.get(self.at).is_some_and(|c| c.is_ascii_alphanumeric() || *c == '_') {
            self.at += 1;
        }
        let name: String = self.text[start..self.at].iter().collect();
        if is_identifier(&name) { Ok(name) } else { Err(self.error(start, "a name, a number or `(` expected")) }
    }

    pub(super) fn number(&mut self) -> Result<Typed, ExpressionError> {
        let start = self.at;
        while let Some(c) = self.text.get(self.at) {
            let exponent_sign =
                matches!(c, '+' | '-') && matches!(self.text.get(self.at.wrapping_sub(1)), Some('e' | 'E'));
            if !(c.is_ascii_alphanumeric() || *c == '.' || exponent_sign) {
                break;
            }
            self.at += 1;
        }
        let text: String = self.text[start..self.at].iter().collect();
        let number = text.parse().ok().filter(|x: &f64| x.is_finite());
        let number = number.ok_or_else(|| self.error(start, format!("`{text}` is not a number")))?;
        Ok((Node::Literal(number), Type::Float))
    }
}
