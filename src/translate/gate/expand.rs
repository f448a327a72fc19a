//! Macro expansion as far as counting needs it: what the preprocessor would write, or a little more.
//!
//! Conditions are not decided: what stands between `#if` and `#endif` may hold or not, so that a name may have several
//! definitions, and each of them is written where it is used. A file that deceives this count meets the worker's limits
//! of time and memory instead.

use super::text::{Excess, MAX_TOKENS};
use std::collections::HashMap;
use std::rc::Rc;

/// A name, a number, or one other character.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct ExpandedToken {
    pub text: Rc<str>,
    /// Line from 1; for what a macro writes, the line of its use.
    pub line: u32,
}

/// The tokens of one line.
pub(super) fn tokens(line: &str, number: u32) -> Vec<ExpandedToken> {
    let mut found = Vec::new();
    let mut rest = line.trim_start();
    while !rest.is_empty() {
        let (text, others) = rest.split_at(token_length(rest));
        found.push(ExpandedToken { text: text.into(), line: number });
        rest = others.trim_start();
    }
    found
}

/// Bytes of the token that `text` begins with.
fn token_length(text: &str) -> usize {
    let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let length = |is_part: &dyn Fn(char) -> bool| text.find(|c| !is_part(c)).unwrap_or(text.len());
    match text.chars().next() {
        Some(first) if first.is_ascii_digit() => length(&|c| is_word(c) || c == '.'),
        Some(first) if is_word(first) => length(&is_word),
        // These compare; a single `=` assigns.
        Some('=' | '!' | '<' | '>') if text[1..].starts_with('=') => 2,
        first => first.map_or(1, char::len_utf8),
    }
}

#[derive(Clone, Debug, PartialEq, Eq)]
struct GateMacro {
    /// `None` for a macro without parentheses.
    parameters: Option<Vec<Rc<str>>>,
    body: Vec<Rc<str>>,
}

/// What is still to be read.
#[derive(Clone, Debug)]
enum PendingToken {
    ExpandedToken(ExpandedToken),
    /// From here on the macro's name is not expanded (−1: it may be again).
    Hide(Rc<str>, i32),
}

/// Receives the tokens that are left when all macros are expanded.
pub(super) type Sink<'a> = dyn FnMut(&ExpandedToken) -> Result<(), (Excess, u32)> + 'a;

/// The macros of a file, and how many tokens they have written.
#[derive(Debug, Default)]
pub(super) struct Expander {
    /// What each name may stand for.
    macros: HashMap<Rc<str>, Vec<GateMacro>>,
    hidden: HashMap<Rc<str>, i32>,
    written: usize,
}

impl Expander {
    /// Takes what stands after `#define`. It takes the place of what the name stood for, if it `is_certain` to be read.
    pub fn define(&mut self, text: &str, is_certain: bool) {
        let (name, rest) = split_name(text);
        let (parameters, body) = match rest.strip_prefix('(').and_then(|list| list.split_once(')')) {
            Some((list, body)) => (Some(list.split(',').map(|parameter| parameter.trim().into()).collect()), body),
            None => (None, rest),
        };
        let body: Vec<Rc<str>> = tokens(body, 0).into_iter().map(|token| token.text).collect();
        let known = self.macros.entry(name.into()).or_default();
        if is_certain {
            known.clear();
        }
        let defined = GateMacro { parameters, body };
        if !known.contains(&defined) {
            known.push(defined);
        }
    }

    /// Takes what stands after an `#undef` that is certain to be read.
    pub fn undefine(&mut self, text: &str) {
        self.macros.remove(split_name(text).0);
    }

    /// Expands `tokens` and gives each that is left to `sink`.
    pub fn expand(&mut self, tokens: Vec<ExpandedToken>, sink: &mut Sink<'_>) -> Result<(), (Excess, u32)> {
        // The next item is the last: what a macro writes is pushed in front of what is still to come.
        let mut items: Vec<PendingToken> = tokens.into_iter().rev().map(PendingToken::ExpandedToken).collect();
        self.hidden.clear();
        while let Some(item) = items.pop() {
            match item {
                PendingToken::Hide(name, change) => *self.hidden.entry(name).or_default() += change,
                PendingToken::ExpandedToken(token) => match self.written_by(&token, &mut items)? {
                    true => {}
                    false => sink(&token)?,
                },
            }
        }
        Ok(())
    }

    /// Pushes what the macro `token` writes; false where it names none.
    fn written_by(&mut self, token: &ExpandedToken, items: &mut Vec<PendingToken>) -> Result<bool, (Excess, u32)> {
        let is_hidden = self.hidden.get(&token.text).is_some_and(|count| *count > 0);
        let Some(found) = self.macros.get(&token.text).filter(|_| !is_hidden) else { return Ok(false) };
        let takes_arguments = found.iter().any(|one| one.parameters.is_some());
        let arguments = if takes_arguments { arguments(items, &mut self.hidden) } else { None };
        if arguments.is_none() && found.iter().all(|one| one.parameters.is_some()) {
            return Ok(false);
        }
        let arguments = arguments.unwrap_or_default();
        let mut pushed = vec![PendingToken::Hide(token.text.clone(), 1)];
        for one in found {
            one.write(token, &arguments, &mut pushed);
            if self.written + pushed.len() > MAX_TOKENS {
                return Err((Excess::Tokens, token.line));
            }
        }
        pushed.push(PendingToken::Hide(token.text.clone(), -1));
        self.written += pushed.len();
        items.extend(pushed.into_iter().rev());
        Ok(true)
    }
}

/// The name that a text begins with, and the rest.
pub(super) fn split_name(text: &str) -> (&str, &str) {
    let text = text.trim_start();
    text.split_at(text.find(|c: char| !c.is_ascii_alphanumeric() && c != '_').unwrap_or(text.len()))
}

/// Takes `( … )` from the items and splits it at its commas; `None` where no parenthesis follows.
fn arguments(items: &mut Vec<PendingToken>, hidden: &mut HashMap<Rc<str>, i32>) -> Option<Vec<Vec<PendingToken>>> {
    let next = items.iter().rev().find_map(|item| match item {
        PendingToken::ExpandedToken(token) => Some(&*token.text == "("),
        PendingToken::Hide(..) => None,
    })?;
    if !next {
        return None;
    }
    let mut depth = 0_u32;
    let mut found = vec![Vec::new()];
    while let Some(item) = items.pop() {
        let token = match &item {
            PendingToken::ExpandedToken(token) => token,
            // Before the parenthesis.
            PendingToken::Hide(name, change) if depth == 0 => {
                *hidden.entry(name.clone()).or_default() += change;
                continue;
            }
            PendingToken::Hide(..) => {
                if let Some(last) = found.last_mut() {
                    last.push(item);
                }
                continue;
            }
        };
        match (&*token.text, depth) {
            ("(", 0) => {
                depth = 1;
                continue;
            }
            ("(", _) => depth += 1,
            (")", 1) => break,
            (")", _) => depth -= 1,
            (",", 1) => {
                found.push(Vec::new());
                continue;
            }
            _ => {}
        }
        if let Some(last) = found.last_mut() {
            last.push(item);
        }
    }
    Some(found.into_iter().map(|argument| settle(argument, hidden)).collect())
}

/// Keeps in an argument the pairs that let a macro's name be expanded in its own argument; what else there is of that kind
/// belongs to macros that end among the arguments, and holds from here on.
fn settle(argument: Vec<PendingToken>, hidden: &mut HashMap<Rc<str>, i32>) -> Vec<PendingToken> {
    let mut open: HashMap<Rc<str>, Vec<usize>> = HashMap::new();
    let mut is_kept = vec![true; argument.len()];
    for (at, item) in argument.iter().enumerate() {
        let PendingToken::Hide(name, change) = item else { continue };
        match (*change, open.get_mut(name).and_then(Vec::pop)) {
            (1, Some(_)) => {}
            (_, before) => {
                let waiting = open.entry(name.clone()).or_default();
                waiting.extend(before);
                if *change < 0 {
                    waiting.push(at);
                } else {
                    is_kept[at] = false;
                }
            }
        }
    }
    open.into_values().flatten().for_each(|at| is_kept[at] = false);
    let mut kept = Vec::with_capacity(argument.len());
    for (item, is_kept) in argument.into_iter().zip(is_kept) {
        match item {
            PendingToken::Hide(name, change) if !is_kept => *hidden.entry(name).or_default() += change,
            item => kept.push(item),
        }
    }
    kept
}

impl GateMacro {
    /// Writes what stands for `token`; arguments that no parameter takes are written as well.
    fn write(&self, token: &ExpandedToken, arguments: &[Vec<PendingToken>], pushed: &mut Vec<PendingToken>) {
        let parameters = self.parameters.as_deref().unwrap_or_default();
        let mut is_pasted = false;
        let mut at = 0;
        while let Some(text) = self.body.get(at) {
            if &**text == "#" && self.body.get(at + 1).is_some_and(|next| &**next == "#") {
                is_pasted = true;
                at += 2;
                continue;
            }
            let before = if std::mem::take(&mut is_pasted) { take_last(pushed) } else { None };
            let start = pushed.len();
            let parameter = parameters.iter().position(|name| name == text);
            match parameter.and_then(|index| arguments.get(index)) {
                // Inside its own argument a macro's name is expanded.
                Some(argument) => {
                    pushed.push(PendingToken::Hide(token.text.clone(), -1));
                    pushed.extend(argument.iter().cloned());
                    pushed.push(PendingToken::Hide(token.text.clone(), 1));
                }
                None => {
                    pushed.push(PendingToken::ExpandedToken(ExpandedToken { text: text.clone(), line: token.line }))
                }
            }
            if let Some(before) = before {
                paste(before, pushed, start, token.line);
            }
            at += 1;
        }
        let are_all_named = parameters.iter().all(|name| name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_'));
        if arguments.len() > parameters.len() || !are_all_named {
            pushed.extend(arguments.iter().flatten().cloned());
        }
    }
}

/// Takes the last token out of the items.
fn take_last(items: &mut Vec<PendingToken>) -> Option<Rc<str>> {
    let at = items.iter().rposition(|item| matches!(item, PendingToken::ExpandedToken(_)))?;
    match items.remove(at) {
        PendingToken::ExpandedToken(token) => Some(token.text),
        PendingToken::Hide(..) => None,
    }
}

/// Makes `before` and the first token from `start` on one, as `##` does. What is pasted is none of an argument's own, so
/// it stands in front of what lets the macro's name be expanded there.
fn paste(before: Rc<str>, items: &mut Vec<PendingToken>, start: usize, line: u32) {
    let first = (start..items.len()).find(|&at| matches!(items[at], PendingToken::ExpandedToken(_)));
    let text = match first.map(|at| items.remove(at)) {
        Some(PendingToken::ExpandedToken(token)) => format!("{before}{}", token.text).into(),
        _ => before,
    };
    items.insert(start, PendingToken::ExpandedToken(ExpandedToken { text, line }));
}
