//! The expressions of `#if` and `#elif`.

use super::{Token, TokenKind};
use crate::interpreter::Refusal;
use crate::text::both;

/// Deepest nesting of brackets and signs.
const MAX_DEPTH: usize = 300;

/// Whether the condition holds. Macros are expanded already, and `defined` is answered.
pub fn holds(tokens: &[Token], line: u32) -> Result<bool, Refusal> {
    let mut reader = ConditionReader { tokens, at: 0, line, depth: 0 };
    let value = reader.binary(0)?;
    match tokens.get(reader.at) {
        // What follows on the line is ignored, as compilers do.
        _ if reader.at > 0 => Ok(value != 0),
        _ => Err(reader.wrong()),
    }
}

/// Operators by how tightly they bind, loosest first.
const LEVELS: [&[&str]; 10] = [
    &["||"],
    &["&&"],
    &["|"],
    &["^"],
    &["&"],
    &["==", "!="],
    &["<=", ">=", "<", ">"],
    &["<<", ">>"],
    &["+", "-"],
    &["*", "/", "%"],
];

struct ConditionReader<'a> {
    tokens: &'a [Token],
    at: usize,
    line: u32,
    depth: usize,
}

impl ConditionReader<'_> {
    fn wrong(&self) -> Refusal {
        Refusal::invalid(
            self.line,
            both("this condition of the preprocessor cannot be read", "プリプロセッサの条件を読み取れません"),
        )
    }

    fn next(&mut self) -> Option<Token> {
        let token = self.tokens.get(self.at).cloned();
        self.at += 1;
        token
    }

    fn binary(&mut self, level: usize) -> Result<i64, Refusal> {
        let Some(operators) = LEVELS.get(level) else { return self.unary() };
        let mut left = self.binary(level + 1)?;
        while let Some(operator) =
            self.tokens.get(self.at).and_then(|token| operators.iter().find(|operator| token.is(operator)))
        {
            self.at += 1;
            let right = self.binary(level + 1)?;
            left = self.apply(operator, left, right)?;
        }
        Ok(left)
    }

    fn apply(&self, operator: &str, a: i64, b: i64) -> Result<i64, Refusal> {
        let shift = u32::try_from(b).unwrap_or(u32::MAX);
        Ok(match operator {
            "||" => i64::from(a != 0 || b != 0),
            "&&" => i64::from(a != 0 && b != 0),
            "|" => a | b,
            "^" => a ^ b,
            "&" => a & b,
            "==" => i64::from(a == b),
            "!=" => i64::from(a != b),
            "<=" => i64::from(a <= b),
            ">=" => i64::from(a >= b),
            "<" => i64::from(a < b),
            ">" => i64::from(a > b),
            "<<" => a.checked_shl(shift).unwrap_or(0),
            ">>" => a.checked_shr(shift).unwrap_or(0),
            "+" => a.wrapping_add(b),
            "-" => a.wrapping_sub(b),
            "*" => a.wrapping_mul(b),
            // The compiler takes a division by zero for one by one.
            "/" => a.wrapping_div(if b == 0 { 1 } else { b }),
            "%" => a.wrapping_rem(if b == 0 { 1 } else { b }),
            _ => return Err(self.wrong()),
        })
    }

    fn unary(&mut self) -> Result<i64, Refusal> {
        self.depth += 1;
        if self.depth > MAX_DEPTH {
            return Err(Refusal::limit(
                self.line,
                both(
                    "a condition of the preprocessor is nested too deeply",
                    "プリプロセッサの条件の入れ子が深すぎます",
                ),
            ));
        }
        let token = self.next().ok_or_else(|| self.wrong())?;
        let value = match (token.kind, &*token.text) {
            (TokenKind::Symbol, "!") => i64::from(self.unary()? == 0),
            (TokenKind::Symbol, "-") => self.unary()?.wrapping_neg(),
            (TokenKind::Symbol, "+") => self.unary()?,
            (TokenKind::Symbol, "~") => !self.unary()?,
            (TokenKind::Symbol, "(") => {
                let value = self.binary(0)?;
                match self.next() {
                    Some(close) if close.is(")") => value,
                    _ => return Err(self.wrong()),
                }
            }
            (TokenKind::Number, text) => integer(text).ok_or_else(|| self.wrong())?,
            // A name that stands for nothing is 0.
            (TokenKind::Name, _) => 0,
            _ => return Err(self.wrong()),
        };
        self.depth -= 1;
        Ok(value)
    }
}

fn integer(text: &str) -> Option<i64> {
    let text = text.trim_end_matches(['u', 'U']);
    if let Some(digits) = text.strip_prefix("0x").or_else(|| text.strip_prefix("0X")) {
        return i64::from_str_radix(digits, 16).ok();
    }
    match text.strip_prefix('0') {
        Some(digits) if !digits.is_empty() => i64::from_str_radix(digits, 8).ok(),
        _ => text.parse().ok(),
    }
}
