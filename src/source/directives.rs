//! Which lines a compiler reads: what a real driver skips must not refuse a file.

use super::words;
use std::collections::{HashMap, HashSet};

/// What a compiler makes of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum LineState {
    /// It is compiled.
    Compiled,
    /// That depends on a condition which only the compiler can decide.
    Undecided,
    /// It is skipped: `#if 0`, the text of `#error` and `#pragma`, a macro that is never used.
    Skipped,
}

/// One open `#if`.
struct Conditional {
    outside: LineState,
    /// Whether one of its branches is compiled already, as far as that is known.
    taken: Option<bool>,
}

/// The preprocessor's state, as far as a glance at the file tells.
struct DirectiveState<'a> {
    /// The words that stand anywhere but in conditions and as the name that is defined.
    uses: HashSet<&'a str>,
    standing: LineState,
    open: Vec<Conditional>,
    /// Macros of the file: whether they are defined here, `None` where a condition decides.
    macros: HashMap<String, Option<bool>>,
}

/// The standing of each line of `code`, which has no comments.
pub(super) fn standings(code: &str) -> Vec<LineState> {
    let mut preprocessor =
        DirectiveState { uses: uses(code), standing: LineState::Compiled, open: Vec::new(), macros: HashMap::new() };
    let mut standings = Vec::new();
    let mut lines = code.lines().peekable();
    while let Some(first) = lines.next() {
        let mut logical = first.to_owned();
        let mut count = 1;
        while logical.ends_with('\\') && lines.peek().is_some() {
            logical.pop();
            logical.push_str(lines.next().unwrap_or_default());
            count += 1;
        }
        let standing = preprocessor.line(&logical);
        standings.extend(std::iter::repeat_n(standing, count));
    }
    standings
}

fn uses(code: &str) -> HashSet<&str> {
    let mut uses = HashSet::new();
    for line in code.lines() {
        let directive = line.trim_start().strip_prefix('#').map(str::trim_start);
        let begins = |word: &str| directive.is_some_and(|directive| directive.starts_with(word));
        if begins("if") || begins("elif") || begins("undef") {
            continue;
        }
        let own_name = if begins("define") { 2 } else { 0 };
        uses.extend(words(line).skip(own_name).map(|(_, word)| word));
    }
    uses
}

impl DirectiveState<'_> {
    /// Takes one line, continuations joined, and says how it stands.
    fn line(&mut self, line: &str) -> LineState {
        let blank = |c: char| matches!(c, ' ' | '\t' | '\u{B}' | '\u{C}');
        let Some(directive) = line.trim_start_matches(blank).strip_prefix('#') else {
            return self.standing;
        };
        let directive = directive.trim_start_matches(blank);
        let end = directive.find(|c: char| !c.is_ascii_alphanumeric()).unwrap_or(directive.len());
        let (name, rest) = directive.split_at(end);
        let here = self.standing;
        match name {
            "if" => self.open(decide(rest, &self.macros)),
            "ifdef" => self.open(first_word(rest).and_then(|macro_| self.is_defined(macro_))),
            "ifndef" => self.open(first_word(rest).and_then(|macro_| self.is_defined(macro_)).map(|known| !known)),
            "elif" => return self.branch(decide(rest, &self.macros)),
            "else" => return self.branch(Some(true)),
            "endif" => self.standing = self.open.pop().map_or(self.standing, |conditional| conditional.outside),
            "define" | "undef" if here != LineState::Skipped => {
                return self.define(name == "define", rest);
            }
            "error" | "pragma" => return LineState::Skipped,
            _ => return here,
        }
        if name == "endif" { self.standing } else { here }
    }

    fn open(&mut self, condition: Option<bool>) {
        self.open.push(Conditional { outside: self.standing, taken: condition });
        self.standing = inside(self.standing, condition);
    }

    /// `#elif` and `#else`; answers how the directive itself stands.
    fn branch(&mut self, condition: Option<bool>) -> LineState {
        let Some(conditional) = self.open.last_mut() else {
            return self.standing;
        };
        let condition = match (conditional.taken, condition) {
            (Some(true), _) => Some(false),
            (Some(false), condition) => condition,
            (None, Some(false)) => Some(false),
            (None, _) => None,
        };
        conditional.taken = match (conditional.taken, condition) {
            (Some(false), condition) => condition,
            (taken, _) => taken,
        };
        self.standing = inside(conditional.outside, condition);
        conditional.outside
    }

    fn define(&mut self, defined: bool, rest: &str) -> LineState {
        let Some(name) = first_word(rest) else {
            return self.standing;
        };
        let certain = self.standing == LineState::Compiled;
        self.macros.insert(name.to_owned(), certain.then_some(defined));
        if self.uses.contains(name) { self.standing } else { LineState::Skipped }
    }

    fn is_defined(&self, name: &str) -> Option<bool> {
        is_defined(&self.macros, name)
    }
}

fn inside(outside: LineState, condition: Option<bool>) -> LineState {
    match (outside, condition) {
        (LineState::Skipped, _) | (_, Some(false)) => LineState::Skipped,
        (LineState::Undecided, _) | (_, None) => LineState::Undecided,
        (LineState::Compiled, Some(true)) => LineState::Compiled,
    }
}

fn is_defined(macros: &HashMap<String, Option<bool>>, name: &str) -> Option<bool> {
    match macros.get(name) {
        Some(known) => *known,
        // The driver's own macros: GL_core_profile, __VERSION__, GL_ARB_…
        None if name.starts_with("GL_") || name.starts_with("__") => None,
        None => Some(false),
    }
}

/// The value of a condition where it is a number, or asks for one macro.
fn decide(condition: &str, macros: &HashMap<String, Option<bool>>) -> Option<bool> {
    let condition = condition.trim();
    if let Ok(number) = condition.parse::<i64>() {
        return Some(number != 0);
    }
    let (asked, wanted) = match condition.strip_prefix('!') {
        Some(rest) => (rest.trim_start(), false),
        None => (condition, true),
    };
    let mut names = words(asked).map(|(_, word)| word);
    let only_a_name = asked.chars().all(|c| c.is_ascii_alphanumeric() || matches!(c, '_' | ' ' | '(' | ')'));
    match (names.next(), names.next(), names.next()) {
        (Some("defined"), Some(name), None) if only_a_name => is_defined(macros, name).map(|defined| defined == wanted),
        _ => None,
    }
}

/// The name that a directive begins with, where it does.
fn first_word(text: &str) -> Option<&str> {
    let text = text.trim_start_matches([' ', '\t']);
    words(text).next().filter(|&(start, _)| start == 0).map(|(_, word)| word)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One letter a line: Compiled, Undecided, Skipped.
    fn letters(code: &str) -> String {
        let letter = |standing| match standing {
            LineState::Compiled => 'C',
            LineState::Undecided => 'U',
            LineState::Skipped => 'S',
        };
        standings(code).into_iter().map(letter).collect()
    }

    #[test]
    fn a_constant_condition_decides() {
        assert_eq!(letters("a\n#if 0\nb\n#else\nc\n#endif\nd\n"), "CCSCCCC");
        assert_eq!(letters("#if 1\nb\n#elif x\nc\n#else\nd\n#endif\n"), "CCCSCSC");
        assert_eq!(letters("#if 0\n#if 1\nb\n#endif\nc\n#endif\nd\n"), "CSSSSCC");
    }

    #[test]
    fn macros_of_the_file_decide() {
        assert_eq!(letters("#ifdef X\na\n#endif\n"), "CSC");
        assert_eq!(letters("#define X 1\n#ifdef X\na\n#else\nb\n#endif\n"), "SCCCSC");
        assert_eq!(letters("#define X\n#undef X\n#if defined(X)\na\n#endif\n"), "SSCSC");
        assert_eq!(letters("#if !defined X\na\n#endif\n"), "CCC");
    }

    #[test]
    fn what_the_driver_knows_stays_open() {
        assert_eq!(letters("#ifdef GL_core_profile\na\n#else\nb\n#endif\nc\n"), "CUCUCC");
        assert_eq!(letters("#if __VERSION__ >= 410\na\n#endif\n"), "CUC");
        assert_eq!(letters("#if X > 1 && defined(Y)\na\n#endif\n"), "CUC");
    }

    #[test]
    fn unread_text_is_skipped() {
        assert_eq!(letters("#error a\n#pragma b\n#define unused c\n"), "SSS");
        assert_eq!(letters("#define used \\\nc\nused\n"), "CCC");
        assert_eq!(letters("#define unused \\\nc\nd\n"), "SSC");
        assert_eq!(letters("#define twice a\n#define twice a\n"), "SS");
        assert_eq!(letters("#define asked c\n#ifdef asked\n#endif\n"), "SCC");
    }

    #[test]
    fn unbalanced_directives_change_nothing() {
        assert_eq!(letters("#endif\na\n#else\nb\n"), "CCCC");
    }
}
