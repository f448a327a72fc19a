//! Directives.

use super::macros::Macros;
use super::{Token, TokenKind, condition, lexer};
use crate::interpreter::Refusal;
use crate::text::both;
use std::rc::Rc;

/// The version of a file without `#version`.
const DEFAULT_VERSION: u32 = 110;

/// Macros that compilers of desktop OpenGL define by themselves.
const PREDEFINED: [&str; 5] = [
    "GL_core_profile",
    "GL_ARB_gpu_shader5",
    "GL_ARB_shading_language_420pack",
    "GL_ARB_explicit_attrib_location",
    "GL_ARB_separate_shader_objects",
];

/// What is left of a file.
#[derive(Debug)]
pub struct Preprocessed {
    /// The tokens to be parsed.
    pub tokens: Vec<Token>,
    /// What `#version` says.
    pub version: u32,
}

/// Carries the directives out and expands the macros.
///
/// # Errors
/// A directive that cannot be read, `#error`, and macros that never end.
pub fn preprocess(text: &str) -> Result<Preprocessed, Refusal> {
    let mut preprocessor = Preprocessor {
        macros: Macros::new(DEFAULT_VERSION),
        conditions: Vec::new(),
        pending: Vec::new(),
        output: Vec::new(),
    };
    for name in PREDEFINED {
        preprocessor.macros.define_number(name, 1);
    }
    for line in lexer::tokens(text).split(|token| token.kind == TokenKind::LineEnd) {
        match line {
            [hash, directive @ ..] if hash.is("#") => preprocessor.directive(directive, hash.line)?,
            _ if preprocessor.is_active() => preprocessor.pending.extend_from_slice(line),
            _ => {}
        }
    }
    preprocessor.flush()?;
    if let Some(condition) = preprocessor.conditions.last() {
        return Err(Refusal::invalid(
            condition.line,
            both("this condition is not closed with #endif", "この条件が `#endif` で閉じられていません"),
        ));
    }
    Ok(Preprocessed { tokens: preprocessor.output, version: preprocessor.macros.version })
}

struct ConditionalGroup {
    line: u32,
    /// Whether the text between this directive and the next is read.
    active: bool,
    /// Whether a branch was read already, or none may be.
    taken: bool,
}

struct Preprocessor {
    macros: Macros,
    conditions: Vec<ConditionalGroup>,
    /// Read, and not expanded yet: a macro's arguments may stand on several lines.
    pending: Vec<Token>,
    output: Vec<Token>,
}

impl Preprocessor {
    fn is_active(&self) -> bool {
        self.conditions.last().is_none_or(|condition| condition.active)
    }

    fn flush(&mut self) -> Result<(), Refusal> {
        let pending = std::mem::take(&mut self.pending);
        self.output.append(&mut self.macros.expand(pending)?);
        Ok(())
    }

    fn directive(&mut self, tokens: &[Token], line: u32) -> Result<(), Refusal> {
        let Some((name, rest)) = tokens.split_first() else { return Ok(()) };
        self.conditional(&name.text, rest, line)?;
        if !self.is_active() {
            return Ok(());
        }
        match &*name.text {
            "define" => {
                self.flush()?;
                self.macros.define(rest, line)
            }
            "undef" => {
                self.flush()?;
                rest.first().into_iter().for_each(|name| self.macros.undefine(&name.text));
                Ok(())
            }
            "line" => {
                self.flush()?;
                let rest = self.macros.expand(rest.to_vec())?;
                let number = |index: usize| rest.get(index).and_then(|number| number.text.parse::<i64>().ok());
                self.macros.file = number(1).unwrap_or(self.macros.file);
                // Before 3.30 the line of the directive itself has the number.
                let next = i64::from(line) + i64::from(self.macros.version >= 330);
                self.macros.line_offset = number(0).unwrap_or(next) - next;
                Ok(())
            }
            "version" => {
                let number = rest.first().and_then(|number| number.text.parse().ok());
                self.macros.version = number.ok_or_else(|| {
                    Refusal::invalid(line, both("#version without a number", "`#version` に番号がありません"))
                })?;
                if rest.get(1).is_some_and(|profile| &*profile.text == "compatibility") {
                    self.macros.define_number("GL_compatibility_profile", 1);
                }
                Ok(())
            }
            "error" => Err(Refusal::invalid(line, both("#error", "`#error` があります"))),
            _ => Ok(()),
        }
    }

    fn conditional(&mut self, name: &str, rest: &[Token], line: u32) -> Result<(), Refusal> {
        let outer = |conditions: &[ConditionalGroup]| conditions.len() < 2 || conditions[conditions.len() - 2].active;
        match name {
            "if" | "ifdef" | "ifndef" => {
                let is_read = self.is_active();
                let active = is_read && self.condition(name, rest, line)?;
                self.conditions.push(ConditionalGroup { line, active, taken: active || !is_read });
            }
            "elif" | "else" => {
                let is_read = outer(&self.conditions);
                let taken = self.conditions.last().is_none_or(|condition| condition.taken);
                let active = is_read && !taken && (name == "else" || self.condition("if", rest, line)?);
                let condition = self.conditions.last_mut();
                let condition = condition.ok_or_else(|| {
                    Refusal::invalid(line, both("this directive has no #if", "この指示に対応する `#if` がありません"))
                })?;
                condition.active = active;
                condition.taken |= active;
            }
            "endif" => {
                self.conditions.pop().ok_or_else(|| {
                    Refusal::invalid(line, both("#endif without #if", "`#endif` に対応する `#if` がありません"))
                })?;
            }
            _ => {}
        }
        Ok(())
    }

    fn condition(&mut self, name: &str, rest: &[Token], line: u32) -> Result<bool, Refusal> {
        self.flush()?;
        if name != "if" {
            let is_defined = rest.first().is_some_and(|name| self.macros.is_defined(&name.text));
            return Ok(is_defined == (name == "ifdef"));
        }
        let mut answered = Vec::new();
        let mut tokens = rest.iter();
        while let Some(token) = tokens.next() {
            if &*token.text != "defined" {
                answered.push(token.clone());
                continue;
            }
            let mut name = tokens.next();
            if name.is_some_and(|token| token.is("(")) {
                name = tokens.next();
                tokens.next();
            }
            let is_defined = name.is_some_and(|name| self.macros.is_defined(&name.text));
            answered.push(Token {
                text: Rc::from(if is_defined { "1" } else { "0" }),
                kind: TokenKind::Number,
                ..token.clone()
            });
        }
        condition::holds(&self.macros.expand(answered)?, line)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn left(text: &str) -> String {
        let preprocessed = preprocess(text).expect("a text");
        preprocessed.tokens.iter().map(|token| &*token.text).collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn arguments_are_expanded_and_a_macro_does_not_call_itself() {
        assert_eq!(
            left("#define f(x) (x + x)\n#define a f(b)\n#define b a\nf(f(1)) a"),
            "( ( 1 + 1 ) + ( 1 + 1 ) ) ( a + a )"
        );
        assert_eq!(left("#define TWICE(a, b) a##b a\nTWICE(x,\n1) TWICE"), "x1 x TWICE");
        // A bracket that does not touch the name belongs to the body.
        assert_eq!(left("#define g (x)\ng"), "( x )");
    }

    #[test]
    fn the_first_true_branch_is_read() {
        let text = "#version 330\n#if 0\na '\n#elif defined(X) || __VERSION__ == 330 && !defined Y\nb\n#elif 1\nc\n#else\nd\n#endif\n";
        assert_eq!(left(text), "b");
        assert_eq!(left("#ifdef A\n#if 1\na\n#else\nb\n#endif\n#else\nc\n#endif"), "c");
        assert_eq!(left("#if (1 << 4) % 7 == 2 && -1 < 0\ny\n#endif"), "y");
    }

    #[test]
    fn lines_are_counted_as_the_directive_says() {
        assert_eq!(left("#version 330\n#line 100\n__LINE__\n__LINE__"), "100 101");
        assert_eq!(left("#version 150\n#line 100\n__LINE__"), "101");
    }

    #[test]
    fn bombs_end() {
        let mut text = String::from("#define a0 x x\n");
        for n in 1..40 {
            text += &format!("#define a{n} a{} a{}\n", n - 1, n - 1);
        }
        let refusal = preprocess(&(text + "a39")).expect_err("2^40 tokens");
        assert!(refusal.is_limit() && refusal.line == 41, "{refusal}");
    }
}
