//! The words of a C++ text, as far as numbers and the names of variables need them.

/// A word, number or sign.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct HostToken<'a> {
    pub kind: HostTokenKind,
    pub text: &'a str,
    /// From 1.
    pub line: u32,
    /// Whether it stands behind `#define NAME`.
    pub is_macro: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum HostTokenKind {
    Name,
    Number,
    Sign,
    /// A string or a character in quotes.
    Quoted,
}

impl HostToken<'_> {
    pub fn is(&self, text: &str) -> bool {
        self.text == text && self.kind != HostTokenKind::Quoted
    }
}

/// The tokens of a text; comments, strings' insides and what `#if 0` leaves out are none.
pub(super) fn tokens(text: &str) -> Vec<HostToken<'_>> {
    let mut scanner = Scanner { text, at: 0, line: 1, found: Vec::new(), open: Vec::new() };
    while scanner.step() {}
    scanner.found
}

struct Scanner<'a> {
    text: &'a str,
    at: usize,
    line: u32,
    found: Vec<HostToken<'a>>,
    /// For each open `#if`: whether what follows is left out, and whether what stands behind `#else` is.
    open: Vec<[bool; 2]>,
}

impl<'a> Scanner<'a> {
    fn rest(&self) -> &'a str {
        &self.text[self.at..]
    }

    fn step(&mut self) -> bool {
        let rest = self.rest();
        let Some(c) = rest.chars().next() else { return false };
        let taken = match c {
            _ if rest.starts_with("//") => logical_line(rest),
            _ if rest.starts_with("/*") => rest[2..].find("*/").map_or(rest.len(), |end| end + 4),
            '#' if self.begins_line() => return self.directive(logical_line(rest)),
            '"' | '\'' => quoted(rest, c),
            _ if c.is_ascii_digit() || c == '.' && rest[1..].starts_with(|c: char| c.is_ascii_digit()) => number(rest),
            _ if c == '_' || c.is_alphabetic() => {
                rest.find(|c: char| c != '_' && !c.is_alphanumeric()).unwrap_or(rest.len())
            }
            _ if c.is_whitespace() => c.len_utf8(),
            _ if ["->", "::", "+=", "-=", "*=", "/=", "++", "--", "=="].iter().any(|sign| rest.starts_with(sign)) => 2,
            _ => c.len_utf8(),
        };
        let kind = match c {
            _ if c.is_whitespace() || rest.starts_with("//") || rest.starts_with("/*") => None,
            '"' | '\'' => Some(HostTokenKind::Quoted),
            _ if c == '_' || c.is_alphabetic() => Some(HostTokenKind::Name),
            _ if c.is_ascii_digit() || c == '.' && taken > 1 => Some(HostTokenKind::Number),
            _ => Some(HostTokenKind::Sign),
        };
        if let Some(kind) = kind.filter(|_| !self.is_left_out()) {
            self.found.push(HostToken { kind, text: &rest[..taken], line: self.line, is_macro: false });
        }
        self.skip(taken);
        true
    }

    fn begins_line(&self) -> bool {
        let line = self.text[..self.at].rfind('\n').map_or(0, |end| end + 1);
        self.text[line..self.at].trim().is_empty()
    }

    fn is_left_out(&self) -> bool {
        self.open.iter().any(|[left_out, _]| *left_out)
    }

    fn skip(&mut self, bytes: usize) {
        let lines = self.rest()[..bytes].matches('\n').count();
        self.line += u32::try_from(lines).unwrap_or(u32::MAX);
        self.at += bytes;
    }

    fn directive(&mut self, length: usize) -> bool {
        let text = &self.rest()[..length];
        let words = text[1..].trim_start();
        let (word, argument) = words.split_once(|c: char| c.is_whitespace()).unwrap_or((words, ""));
        let condition = argument.split("//").next().unwrap_or_default().trim();
        match word {
            "if" => self.open.push([["0", "false"].contains(&condition), ["1", "true"].contains(&condition)]),
            "ifdef" | "ifndef" => self.open.push([false; 2]),
            "else" | "elif" => self.open.iter_mut().next_back().into_iter().for_each(|last| last[0] = last[1]),
            "endif" => drop(self.open.pop()),
            "define" if !self.is_left_out() => {
                let line = self.line;
                let own = tokens(argument).into_iter().map(|token| HostToken { line, is_macro: true, ..token });
                self.found.extend(own);
                // A line end ends it, whatever follows.
                self.found.push(HostToken { kind: HostTokenKind::Sign, text: ";", line, is_macro: true });
            }
            _ => {}
        }
        self.skip(length);
        true
    }
}

/// The length of a line, with those that a backslash joins to it.
fn logical_line(text: &str) -> usize {
    let mut at = 0;
    while let Some(end) = text[at..].find('\n') {
        let line = text[at..at + end].trim_end_matches('\r');
        at += end;
        if !line.ends_with('\\') {
            return at;
        }
        at += 1;
    }
    text.len()
}

fn quoted(text: &str, quote: char) -> usize {
    let mut is_escaped = false;
    for (at, c) in text.char_indices().skip(1) {
        match c {
            '\n' => return at,
            _ if is_escaped => is_escaped = false,
            '\\' => is_escaped = true,
            _ if c == quote => return at + 1,
            _ => {}
        }
    }
    text.len()
}

fn number(text: &str) -> usize {
    let mut before = ' ';
    let ends = |c: char| {
        let is_sign = (c == '+' || c == '-') && before.eq_ignore_ascii_case(&'e');
        before = c;
        !(is_sign || c == '.' || c == '\'' || c.is_ascii_alphanumeric())
    };
    text.find(ends).unwrap_or(text.len())
}
