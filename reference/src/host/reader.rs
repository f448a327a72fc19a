//! Reads how a number is written: tokens, one behind the other, become an expression.

use super::expression::HostExpression;
use super::found::closing;
use super::meaning::NameMeaning;
use super::token::{HostToken, HostTokenKind};
use super::{HostArray, UnreadableProgram};
use crate::text::both;

/// Names stand for names at most so deep, and what a number is written as has at most so many parts.
pub(super) const DEEPEST: usize = 60;
const MOST_PARTS: usize = 500;

/// Reads expressions of a program.
pub(super) struct Reader<'a> {
    pub(super) array: &'a HostArray,
    pub(super) tokens: &'a [HostToken<'a>],
    pub(super) depth: usize,
    parts: usize,
}

pub(super) type HostResult<T> = Result<T, UnreadableProgram>;

impl<'a> Reader<'a> {
    pub fn new(array: &'a HostArray, tokens: &'a [HostToken<'a>]) -> Self {
        Self { array, tokens, depth: 0, parts: 0 }
    }

    /// The expression of these tokens; of none it is 0.
    pub fn read(&mut self, at: usize, end: usize) -> HostResult<HostExpression> {
        if at == end {
            return Ok(HostExpression::Int(0));
        }
        self.parts = 0;
        self.whole(at, end)
    }

    pub(super) fn whole(&mut self, mut at: usize, end: usize) -> HostResult<HostExpression> {
        let found = self.sum(&mut at, end)?;
        if at < end { Err(self.not_read(at)) } else { Ok(found) }
    }

    fn sign(&self, at: usize, end: usize, of: &[&str]) -> Option<char> {
        let token = self.tokens.get(at).filter(|token| at < end && token.kind == HostTokenKind::Sign)?;
        of.contains(&token.text).then(|| token.text.chars().next()).flatten()
    }

    fn sum(&mut self, at: &mut usize, end: usize) -> HostResult<HostExpression> {
        self.chain(at, end, &["+", "-"], |reader, at| {
            reader.chain(at, end, &["*", "/"], |reader, at| reader.signed(at, end))
        })
    }

    /// Parts with one of these signs between them, from left to right.
    fn chain(
        &mut self,
        at: &mut usize,
        end: usize,
        signs: &[&str],
        part: impl Fn(&mut Self, &mut usize) -> HostResult<HostExpression>,
    ) -> HostResult<HostExpression> {
        let mut left = part(self, at)?;
        while let Some(sign) = self.sign(*at, end, signs) {
            let place = *at;
            *at += 1;
            let right = part(self, at)?;
            left = self.combined(sign, left, right, place)?;
        }
        Ok(left)
    }

    fn signed(&mut self, at: &mut usize, end: usize) -> HostResult<HostExpression> {
        self.parts += 1;
        self.depth += 1;
        if self.depth > DEEPEST || self.parts > MOST_PARTS {
            return Err(self.wrong(
                *at,
                both("This number is written in too many parts.", "この数の式が長すぎるか、入れ子が深すぎます。"),
            ));
        }
        let found = match self.sign(*at, end, &["+", "-"]) {
            Some(sign) => {
                *at += 1;
                let of = self.signed(at, end)?;
                match (sign, of) {
                    ('+', of) => of,
                    (_, HostExpression::Int(number)) => HostExpression::Int(number.saturating_neg()),
                    (_, HostExpression::Float(number)) => HostExpression::Float(-number),
                    (_, of) => HostExpression::Negative(Box::new(of)),
                }
            }
            None => self.single(at, end)?,
        };
        self.depth -= 1;
        Ok(found)
    }

    /// A number, a name, or something in parentheses.
    fn single(&mut self, at: &mut usize, end: usize) -> HostResult<HostExpression> {
        let place = *at;
        let Some(token) = self.tokens.get(place).copied().filter(|_| place < end) else {
            let last = place.min(self.tokens.len()).saturating_sub(1);
            return Err(self.wrong(last, both("A number is missing here.", "ここに数が必要です。")));
        };
        *at += 1;
        match token.kind {
            HostTokenKind::Number => number(token.text).ok_or_else(|| self.not_read(place)),
            HostTokenKind::Sign if token.is("(") => {
                let close = closing(self.tokens, place).filter(|close| *close < end);
                let close = close.ok_or_else(|| self.not_read(place))?;
                *at = close + 1;
                let is_type = |token: &HostToken<'_>| {
                    is_number_type(token.text) || token.is("const") || token.is("std") || token.is("::")
                };
                // `(GLfloat)4`
                if close > place + 1 && self.tokens[place + 1..close].iter().all(is_type) {
                    return self.signed(at, end);
                }
                self.whole(place + 1, close)
            }
            HostTokenKind::Name if token.is("static_cast") => {
                let open = (place..end).find(|at| self.tokens[*at].is("("));
                self.in_brackets(open.ok_or_else(|| self.not_read(place))?, at, end)
            }
            HostTokenKind::Name if is_number_type(token.text) && self.sign(*at, end, &["(", "{"]).is_some() => {
                self.in_brackets(*at, at, end)
            }
            HostTokenKind::Name => self.named(place, at, end),
            _ => Err(self.not_read(place)),
        }
    }

    fn in_brackets(&mut self, open: usize, at: &mut usize, end: usize) -> HostResult<HostExpression> {
        let close = closing(self.tokens, open).filter(|close| *close < end).ok_or_else(|| self.not_read(open))?;
        *at = close + 1;
        self.whole(open + 1, close)
    }

    /// A name, with what stands behind it: `light.position[0]`, `height`.
    fn named(&mut self, place: usize, at: &mut usize, end: usize) -> HostResult<HostExpression> {
        let meaning = self.meaning(place, at, end)?;
        let text = |at: usize| self.tokens.get(at).filter(|_| at < end).map_or("", |token| token.text);
        // `lp[1]`, `lp.at(1)`
        let open = match [text(*at), text(*at + 1), text(*at + 2)] {
            ["[", ..] => Some(*at),
            [".", "at", "("] => Some(*at + 2),
            _ => None,
        };
        let member = ["x", "y", "z", "w"].iter().position(|own| text(*at) == "." && *own == text(*at + 1));
        let index = match (open, member) {
            (Some(open), _) => {
                let close = closing(self.tokens, open).filter(|close| *close < end);
                let close = close.ok_or_else(|| self.not_read(open))?;
                let index = self.whole(open + 1, close)?;
                *at = close + 1;
                let HostExpression::Int(index) = index else { return Err(self.not_read(place)) };
                Some(usize::try_from(index).map_err(|_| self.not_read(place))?)
            }
            (None, Some(member)) => {
                *at += 2;
                Some(member)
            }
            (None, None) => None,
        };
        match (meaning, index) {
            (NameMeaning::Value(value), None) => Ok(value),
            (NameMeaning::Given(name), Some(index)) => {
                let element = self.array.given.get(&name).and_then(|all| all.get(index));
                element.map(|element| HostExpression::Given(element.clone())).ok_or_else(|| {
                    self.wrong(
                        place,
                        both(
                            format!("`{name}` has no element {index}; the first one is 0."),
                            format!("`{name}` に要素 {index} はありません（最初の要素は 0 番です）。"),
                        ),
                    )
                })
            }
            (NameMeaning::List(all), Some(index)) => match all.get(index).cloned() {
                Some(range) => self.deeper(range.start, range.end, place),
                None => Err(self.not_read(place)),
            },
            _ => Err(self.not_read(place)),
        }
    }

    fn combined(
        &self,
        sign: char,
        left: HostExpression,
        right: HostExpression,
        place: usize,
    ) -> HostResult<HostExpression> {
        let none = || self.wrong(place, both("This is no number.", "この式は数になりません。"));
        if let (HostExpression::Int(a), HostExpression::Int(b)) = (&left, &right) {
            let whole = match sign {
                '+' => a.checked_add(*b),
                '-' => a.checked_sub(*b),
                '*' => a.checked_mul(*b),
                // Of whole numbers what is left is dropped, as C++ does.
                _ => a.checked_div(*b),
            };
            return whole.map(HostExpression::Int).ok_or_else(none);
        }
        if let (Some(a), Some(b)) = (left.number(), right.number()) {
            let number = match sign {
                '+' => a + b,
                '-' => a - b,
                '*' => a * b,
                _ => a / b,
            };
            let is_number = (number as f32).is_finite();
            return if is_number { Ok(HostExpression::Float(number)) } else { Err(none()) };
        }
        if sign == '/' && right.number() == Some(0.0) {
            return Err(none());
        }
        Ok(HostExpression::Of(sign, Box::new([left, right])))
    }

    pub(super) fn wrong(&self, at: usize, message: crate::Text) -> UnreadableProgram {
        UnreadableProgram { line: self.tokens.get(at).map(|token| token.line), message, hint: None }
    }

    pub(super) fn not_read(&self, at: usize) -> UnreadableProgram {
        let shown: String = self.tokens.get(at).map_or("", |token| token.text).chars().take(40).collect();
        let known = self.array.given.keys().map(|name| format!("`{name}[…]`")).collect::<Vec<_>>();
        UnreadableProgram {
            hint: Some(both(
                format!("Numbers, {}, `+ - * /` and parentheses are read; nothing is run.", known.join(", ")),
                format!("読み取るのは、数、{}、`+ - * /`、括弧だけです。プログラムは実行しません。", known.join("、")),
            )),
            ..self.wrong(
                at,
                both(format!("`{shown}` cannot be read as a number."), format!("`{shown}` を数として読み取れません。")),
            )
        }
    }
}

fn is_number_type(name: &str) -> bool {
    ["GLfloat", "float", "double", "GLdouble"].contains(&name)
}

/// A number of C++.
fn number(text: &str) -> Option<HostExpression> {
    let plain = text.replace('\'', "").to_ascii_lowercase();
    if plain.starts_with("0x") || plain.starts_with("0b") {
        return None;
    }
    let is_whole = plain.bytes().all(|byte| byte.is_ascii_digit() || b"ul".contains(&byte));
    let digits = plain.trim_end_matches(['f', 'l', 'u']);
    // A nought before other digits means another base.
    if is_whole && !(digits.len() > 1 && digits.starts_with('0')) {
        return digits.parse().ok().map(HostExpression::Int);
    }
    let number = digits.parse::<f64>().ok().filter(|number| (*number as f32).is_finite() && !is_whole)?;
    Some(HostExpression::Float(number))
}
