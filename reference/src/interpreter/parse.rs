//! Tokens → syntax, by recursive descent.

mod declaration;
mod expression;
pub(super) mod literal;
mod statement;

use super::Refusal;
use super::syntax::{Expression, Item, Name, Qualifiers};
use super::text::{Token, TokenKind};
use crate::text::{Text, both};
use std::collections::HashSet;

/// Deepest nesting of expressions and statements; ggrade's gate refuses deeper files before.
const MAX_NESTING: usize = 256;

/// Parses a whole file.
///
/// # Errors
/// It is not GLSL, or nested more deeply than this parser goes.
pub fn parse(tokens: &[Token]) -> Result<Vec<Item>, Refusal> {
    let mut parser = Parser { tokens, at: 0, depth: 0, functions: HashSet::new(), blocks: Qualifiers::default() };
    let mut items = Vec::new();
    while parser.at < tokens.len() {
        if !parser.takes(";") {
            items.push(parser.item()?);
        }
    }
    Ok(items)
}

/// Parses a single expression, with these functions of the program around it.
///
/// # Errors
/// It is not an expression, or more than one.
pub fn parse_expression(tokens: &[Token], functions: HashSet<Name>) -> Result<Expression, Refusal> {
    let mut parser = Parser { tokens, at: 0, depth: 0, functions, blocks: Qualifiers::default() };
    let expression = parser.initialiser()?;
    if parser.at < tokens.len() {
        Err(parser.unexpected(both("the end of the expression", "式の終わり")))
    } else {
        Ok(expression)
    }
}

/// A token of the text, as it is quoted.
fn token(text: &str) -> Text {
    both(format!("`{text}`"), format!(" `{text}` "))
}

struct Parser<'a> {
    tokens: &'a [Token],
    at: usize,
    depth: usize,
    /// Names of the functions that are declared so far: calling them may change a variable.
    functions: HashSet<Name>,
    /// What `layout(…) uniform;` says of the blocks of uniforms that follow.
    blocks: Qualifiers,
}

impl Parser<'_> {
    fn peek(&self, ahead: usize) -> Option<&Token> {
        self.tokens.get(self.at + ahead)
    }

    /// The text of a symbol or word that is ahead; empty at the end.
    fn text(&self, ahead: usize) -> &str {
        self.peek(ahead).map_or("", |token| &token.text)
    }

    fn is_name(&self, ahead: usize) -> bool {
        self.peek(ahead).is_some_and(|token| token.kind == TokenKind::Name)
    }

    fn line(&self) -> u32 {
        self.peek(0).or(self.tokens.last()).map_or(1, |token| token.line)
    }

    /// The line of the next token, and the byte at which it is written.
    fn place(&self) -> (u32, u32) {
        (self.line(), self.peek(0).map_or(0, |token| token.at))
    }

    fn takes(&mut self, text: &str) -> bool {
        let is_next = self.text(0) == text;
        self.at += usize::from(is_next);
        is_next
    }

    fn expect(&mut self, text: &str) -> Result<(), Refusal> {
        if self.takes(text) { Ok(()) } else { Err(self.unexpected(token(text))) }
    }

    fn unexpected(&self, wanted: Text) -> Refusal {
        let found =
            self.peek(0).map_or_else(|| both("the end of the file", "ファイルの終わり"), |found| token(&found.text));
        let what = both(
            format!("{} is expected before {}", wanted.en, found.en),
            format!("{}の前に{}が必要です", found.ja.trim_start(), wanted.ja),
        );
        Refusal::invalid(self.line(), what)
    }

    fn name(&mut self) -> Result<Name, Refusal> {
        match self.peek(0) {
            Some(token) if token.kind == TokenKind::Name => {
                self.at += 1;
                Ok(Name::clone(&self.tokens[self.at - 1].text))
            }
            _ => Err(self.unexpected(both("a name", "名前"))),
        }
    }

    /// Goes one level deeper, as far as the stack is sure to bear it.
    fn nested<T>(&mut self, read: impl FnOnce(&mut Self) -> Result<T, Refusal>) -> Result<T, Refusal> {
        if self.depth >= MAX_NESTING {
            return Err(Refusal::limit(self.line(), both("this is nested too deeply", "入れ子が深すぎます")));
        }
        self.depth += 1;
        let result = read(self);
        self.depth -= 1;
        result
    }

    /// How many tokens from `ahead` on are `[…]` groups.
    fn lengths_ahead(&self, mut ahead: usize) -> usize {
        let start = ahead;
        while self.text(ahead) == "[" {
            let mut depth = 0_usize;
            loop {
                match self.text(ahead) {
                    "[" => depth += 1,
                    "]" => depth -= 1,
                    "" | ";" => return ahead - start,
                    _ => {}
                }
                ahead += 1;
                if depth == 0 {
                    break;
                }
            }
        }
        ahead - start
    }
}
