//! A student's text as tokens that know their place, also where no compiler can parse it.

/// What a token is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LexemeKind {
    /// A name, keyword or type.
    Word,
    /// A number.
    Number,
    /// An operator or a bracket.
    Sign,
    /// A preprocessor line with its continuations, without comments after it.
    Directive,
    /// A string or character in quotes, which GLSL does not have.
    Quoted,
    /// A character that belongs to no token of GLSL.
    Other,
}

/// A piece of the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Lexeme<'a> {
    /// What it is.
    pub kind: LexemeKind,
    /// As written.
    pub text: &'a str,
    /// Byte offset of its first character.
    pub start: usize,
}

impl Lexeme<'_> {
    /// Byte offset after its last character.
    pub fn end(&self) -> usize {
        self.start + self.text.len()
    }
}

/// Signs of more than one character, longest first.
const SIGNS: [&str; 23] = [
    "<<=", ">>=", "::", "->", "++", "--", "<=", ">=", "==", "!=", "&&", "||", "^^", "<<", ">>", "+=", "-=", "*=", "/=",
    "%=", "&=", "|=", "^=",
];

/// The tokens of `text` in order; comments and white space are none.
pub fn tokens(text: &str) -> Vec<Lexeme<'_>> {
    let mut all = Vec::new();
    let mut at = 0;
    let mut line_is_empty = true;
    while let Some(first) = text[at..].chars().next() {
        let rest = &text[at..];
        let length = if let Some(length) = blank_length(rest) {
            line_is_empty |= rest.starts_with('\n');
            length
        } else {
            let (kind, length) = token(rest, first, line_is_empty);
            line_is_empty = false;
            all.push(Lexeme { kind, text: rest[..length].trim_end(), start: at });
            length
        };
        at += length;
    }
    all
}

/// Where the block comments of `text` stand.
pub fn comments(text: &str) -> Vec<std::ops::Range<usize>> {
    let mut found = Vec::new();
    let mut at = 0;
    for token in tokens(text) {
        block_comments(&text[at..token.start], at, &mut found);
        at = token.end();
    }
    block_comments(&text[at..], at, &mut found);
    found
}

/// Finds the block comments in a gap between two tokens, which begins at byte `start`.
fn block_comments(gap: &str, start: usize, found: &mut Vec<std::ops::Range<usize>>) {
    let mut at = 0;
    while let Some(length) = blank_length(&gap[at..]) {
        if gap[at..].starts_with("/*") {
            found.push(start + at..start + at + length);
        }
        at += length;
    }
}

/// The length of the white space, comment or line continuation that `rest` begins with.
fn blank_length(rest: &str) -> Option<usize> {
    if rest.starts_with("//") {
        return Some(line_length(rest));
    }
    if let Some(comment) = rest.strip_prefix("/*") {
        return Some(comment.find("*/").map_or(rest.len(), |end| end + 4));
    }
    if rest.starts_with("\\\n") {
        return Some(2);
    }
    rest.chars().next().filter(|c| c.is_whitespace()).map(char::len_utf8)
}

fn token(rest: &str, first: char, line_is_empty: bool) -> (LexemeKind, usize) {
    let length_while = |accept: fn(char) -> bool| rest.find(|c| !accept(c)).unwrap_or(rest.len());
    let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    match first {
        '#' if line_is_empty => (LexemeKind::Directive, directive_length(rest)),
        'a'..='z' | 'A'..='Z' | '_' => (LexemeKind::Word, length_while(is_word)),
        '0'..='9' => (LexemeKind::Number, number_length(rest)),
        '.' if rest[1..].starts_with(|c: char| c.is_ascii_digit()) => (LexemeKind::Number, number_length(rest)),
        '"' | '\'' => (LexemeKind::Quoted, quoted_length(rest, first)),
        _ => match SIGNS.iter().find(|sign| rest.starts_with(**sign)) {
            Some(sign) => (LexemeKind::Sign, sign.len()),
            None if "()[]{}.,;:?=+-*/%<>!~&|^".contains(first) => (LexemeKind::Sign, 1),
            None => (LexemeKind::Other, first.len_utf8()),
        },
    }
}

/// A number takes its exponent's sign along: `1.0e-3`.
fn number_length(rest: &str) -> usize {
    let hexadecimal = rest.starts_with("0x") || rest.starts_with("0X");
    let mut before = ' ';
    rest.find(|c: char| {
        let exponent = !hexadecimal && matches!(before, 'e' | 'E') && matches!(c, '+' | '-');
        before = c;
        !(c.is_ascii_alphanumeric() || c == '.' || exponent)
    })
    .unwrap_or(rest.len())
}

fn quoted_length(rest: &str, quote: char) -> usize {
    let line = rest.find('\n').unwrap_or(rest.len());
    rest[1..line].find(quote).map_or(line, |end| end + 2)
}

/// The length of a line together with the lines that a backslash joins to it.
fn line_length(rest: &str) -> usize {
    let mut length = 0;
    for line in rest.split_inclusive('\n') {
        length += line.len();
        if !line.ends_with("\\\n") {
            return if line.ends_with('\n') { length - 1 } else { length };
        }
    }
    length
}

/// A directive ends before a comment; a block comment may hold it open over several lines, which nobody needs here.
fn directive_length(rest: &str) -> usize {
    let line = line_length(rest);
    let comment = ["//", "/*"].iter().filter_map(|open| rest[..line].find(open)).min();
    comment.unwrap_or(line)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(text: &str) -> Vec<&str> {
        tokens(text).iter().map(|token| token.text).collect()
    }

    #[test]
    fn splits_code_and_skips_comments() {
        assert_eq!(
            texts("a+=b.xy*1.0e-3f;// c\n/* d\n */--e"),
            ["a", "+=", "b", ".", "xy", "*", "1.0e-3f", ";", "--", "e"]
        );
        assert_eq!(texts("x = .5 - 0x1E-2;"), ["x", "=", ".5", "-", "0x1E", "-", "2", ";"]);
    }

    #[test]
    fn keeps_places_after_wide_characters() {
        let text = "/* 光 */ pl;";
        let first = tokens(text)[0];
        assert_eq!((first.text, &text[first.start..first.end()]), ("pl", "pl"));
    }

    #[test]
    fn takes_a_directive_with_its_continuation() {
        assert_eq!(texts("  #define A 1 \\\n  + 2 // c\nb"), ["#define A 1 \\\n  + 2", "b"]);
        assert_eq!(texts("// c \\\n still c\na # b"), ["a", "#", "b"]);
    }

    #[test]
    fn survives_what_is_no_code() {
        assert_eq!(texts("\"a b\" 'c @ é"), ["\"a b\"", "'c @ é"]);
        assert_eq!(texts("@é"), ["@", "é"]);
        assert_eq!(texts("a /* open"), ["a"]);
        assert_eq!(texts("\""), ["\""]);
    }
}
