//! `#define` and the expansion of what it defines.

use super::{Hidden, Token, TokenKind, lexer};
use crate::interpreter::Refusal;
use crate::text::both;
use std::collections::HashMap;
use std::rc::Rc;

/// Most tokens that expansion writes: a bomb of macros ends here, not the memory.
const MAX_TOKENS: usize = 1_000_000;
/// Deepest arguments of arguments of macros.
const MAX_DEPTH: usize = 64;

/// What a name stands for.
#[derive(Debug)]
struct Macro {
    /// Names of the arguments; `None` where it is used without brackets.
    parameters: Option<Vec<Rc<str>>>,
    body: Vec<Token>,
}

/// The macros that are defined at a place in the file.
#[derive(Debug, Default)]
pub struct Macros {
    defined: HashMap<Rc<str>, Rc<Macro>>,
    written: usize,
    /// What `#line` adds to a token's line.
    pub line_offset: i64,
    /// What `__FILE__` is, which `#line` may say.
    pub file: i64,
    /// The number that `#version` names.
    pub version: u32,
}

impl Macros {
    /// No macros, in a file of this version.
    pub fn new(version: u32) -> Self {
        Self { version, ..Self::default() }
    }

    /// Takes what stands behind `#define`.
    pub fn define(&mut self, tokens: &[Token], line: u32) -> Result<(), Refusal> {
        let (name, rest) = match tokens {
            [name, rest @ ..] if name.kind == TokenKind::Name => (name, rest),
            _ => return Err(Refusal::invalid(line, both("#define without a name", "`#define` に名前がありません"))),
        };
        let (parameters, body) = parameters(rest)?;
        self.defined.insert(Rc::clone(&name.text), Rc::new(Macro { parameters, body: body.to_vec() }));
        Ok(())
    }

    /// Defines a name as a number.
    pub fn define_number(&mut self, name: &str, value: i64) {
        let body = vec![Token::new(TokenKind::Number, &value.to_string(), 0)];
        self.defined.insert(name.into(), Rc::new(Macro { parameters: None, body }));
    }

    /// Forgets a name.
    pub fn undefine(&mut self, name: &str) {
        self.defined.remove(name);
    }

    /// Whether a name is defined.
    pub fn is_defined(&self, name: &str) -> bool {
        self.defined.contains_key(name) || matches!(name, "__LINE__" | "__FILE__" | "__VERSION__")
    }

    /// Replaces macros until none is left.
    pub fn expand(&mut self, tokens: Vec<Token>) -> Result<Vec<Token>, Refusal> {
        self.expand_in(tokens, 0)
    }

    fn expand_in(&mut self, mut input: Vec<Token>, depth: usize) -> Result<Vec<Token>, Refusal> {
        let line = input.first().map_or(0, |token| token.line);
        if depth > MAX_DEPTH {
            return Err(Refusal::limit(line, both("macros are nested too deeply", "マクロの入れ子が深すぎます")));
        }
        input.reverse();
        let mut output = Vec::with_capacity(input.len());
        while let Some(token) = input.pop() {
            if token.kind != TokenKind::Name || token.hides(&token.text) {
                output.push(token);
                continue;
            }
            if let Some(number) = self.predefined(&token) {
                output.push(number);
                continue;
            }
            let Some(replacement) = self.defined.get(&token.text).cloned() else {
                output.push(token);
                continue;
            };
            let arguments = match &replacement.parameters {
                None => Vec::new(),
                Some(parameters) => match arguments(&mut input, parameters.len()) {
                    Some(arguments) => arguments,
                    None => {
                        output.push(token);
                        continue;
                    }
                },
            };
            let written = self.replace(&replacement, &arguments, &token, depth)?;
            self.written += written.len();
            if self.written > MAX_TOKENS {
                return Err(Refusal::limit(
                    token.line,
                    both("macros expand to more than a million tokens", "マクロの展開が 100 万トークンを超えます"),
                ));
            }
            input.extend(written.into_iter().rev());
        }
        Ok(output)
    }

    fn predefined(&self, token: &Token) -> Option<Token> {
        let value = match &*token.text {
            "__LINE__" => i64::from(token.line) + self.line_offset,
            "__FILE__" => self.file,
            "__VERSION__" => i64::from(self.version),
            _ => return None,
        };
        Some(Token::new(TokenKind::Number, &value.to_string(), token.line))
    }

    /// The body with the arguments in their places.
    fn replace(
        &mut self,
        of: &Macro,
        arguments: &[Vec<Token>],
        used: &Token,
        depth: usize,
    ) -> Result<Vec<Token>, Refusal> {
        let hidden = Rc::new(Hidden { name: Rc::clone(&used.text), others: used.hidden.clone() });
        let parameters = of.parameters.as_deref().unwrap_or_default();
        let argument = |token: &Token| {
            let is_it = |parameter: &Rc<str>| token.kind == TokenKind::Name && *parameter == token.text;
            parameters.iter().position(is_it).map(|index| &arguments[index])
        };
        let mut output: Vec<Token> = Vec::new();
        let mut pasting = false;
        for (index, token) in of.body.iter().enumerate() {
            if token.is("##") {
                pasting = true;
                continue;
            }
            let is_pasted = pasting || of.body.get(index + 1).is_some_and(|next| next.is("##"));
            let mut part = match argument(token) {
                Some(raw) if is_pasted => raw.clone(),
                Some(raw) => self.expand_in(raw.clone(), depth + 1)?,
                None => vec![Token { line: used.line, hidden: Some(Rc::clone(&hidden)), ..token.clone() }],
            };
            if std::mem::take(&mut pasting) {
                paste(&mut output, &mut part, used)?;
            }
            output.append(&mut part);
            if self.written + output.len() > MAX_TOKENS {
                return Err(Refusal::limit(
                    used.line,
                    both("macros expand to more than a million tokens", "マクロの展開が 100 万トークンを超えます"),
                ));
            }
        }
        Ok(output)
    }
}

/// Joins the last token of `left` with the first one of `right`.
fn paste(left: &mut Vec<Token>, right: &mut [Token], used: &Token) -> Result<(), Refusal> {
    if right.is_empty() {
        return Ok(());
    }
    let Some(before) = left.pop() else { return Ok(()) };
    let text = format!("{}{}", before.text, right[0].text);
    let mut joined = lexer::tokens(&text);
    joined.retain(|token| token.kind != TokenKind::LineEnd);
    match <[Token; 1]>::try_from(joined) {
        Ok([token]) => {
            right[0] = Token { line: used.line, written: before.written, hidden: before.hidden, ..token };
            Ok(())
        }
        Err(_) => Err(Refusal::invalid(used.line, both("## makes no token", "`##` の結果がトークンになりません"))),
    }
}

/// The names in brackets directly behind the macro's own, and the body.
#[allow(clippy::type_complexity, reason = "a pair that is taken apart at once")]
fn parameters(rest: &[Token]) -> Result<(Option<Vec<Rc<str>>>, &[Token]), Refusal> {
    let Some((open, mut rest)) = rest.split_first().filter(|(open, _)| open.is("(") && open.touches) else {
        return Ok((None, rest));
    };
    let mut parameters = Vec::new();
    while let Some((token, after)) = rest.split_first() {
        rest = after;
        if token.kind == TokenKind::Name {
            parameters.push(Rc::clone(&token.text));
        } else if token.is(")") {
            return Ok((Some(parameters), rest));
        } else if !token.is(",") {
            break;
        }
    }
    Err(Refusal::invalid(
        open.line,
        both("a macro's parameters are names in brackets", "マクロの引数は括弧の中の名前でなければなりません"),
    ))
}

/// Takes `(…)` off the input; `None` where the macro stands without brackets, or they do not end.
fn arguments(input: &mut Vec<Token>, count: usize) -> Option<Vec<Vec<Token>>> {
    if !input.last()?.is("(") {
        return None;
    }
    let mut depth = 0_usize;
    let length = input.iter().rev().position(|token| {
        if token.is("(") {
            depth += 1;
        } else if token.is(")") {
            depth -= 1;
        }
        depth == 0
    })?;
    let taken = input.split_off(input.len() - length);
    input.pop();
    let mut arguments = vec![Vec::new()];
    let mut depth = 0_usize;
    for token in taken.into_iter().rev().skip(1) {
        if token.is(",") && depth == 0 {
            arguments.push(Vec::new());
            continue;
        }
        if token.is("(") {
            depth += 1;
        } else if token.is(")") {
            depth -= 1;
        }
        arguments.last_mut()?.push(token);
    }
    // One that is missing is empty, as `f()` with one parameter is.
    arguments.resize(count.max(1), Vec::new());
    Some(arguments)
}
