//! Characters → tokens, with the ends of lines still among them.

use super::{Token, TokenKind};

/// Operators of more than one character, longer ones first.
const SYMBOLS: [&str; 24] = [
    "<<=", ">>=", "++", "--", "<<", ">>", "<=", ">=", "==", "!=", "&&", "||", "^^", "+=", "-=", "*=", "/=", "%=", "&=",
    "|=", "^=", "##", "//", "/*",
];

/// All tokens of a text; comments are white space, and a line that ends in `\` goes on in the next.
pub fn tokens(text: &str) -> Vec<Token> {
    let mut lexer = Lexer { characters: joined(text), at: 0, end: 0, tokens: Vec::new() };
    while lexer.token() {}
    lexer.tokens
}

/// A character, its line, and the byte of the file at which it stands.
type PlacedCharacter = (char, u32, u32);

/// The characters with their places. Every kind of line end is `\n`; those behind a `\` are gone.
fn joined(text: &str) -> Vec<PlacedCharacter> {
    let mut characters: Vec<PlacedCharacter> = Vec::with_capacity(text.len() + 1);
    let mut line = 1;
    let mut rest = text.char_indices().peekable();
    while let Some((at, character)) = rest.next() {
        let at = at as u32;
        if !matches!(character, '\n' | '\r') {
            characters.push((character, line, at));
            continue;
        }
        if character == '\r' {
            rest.next_if(|(_, next)| *next == '\n');
        }
        match characters.last() {
            Some(('\\', ..)) => drop(characters.pop()),
            _ => characters.push(('\n', line, at)),
        }
        line += 1;
    }
    characters.push(('\n', line, text.len() as u32));
    characters
}

struct Lexer {
    characters: Vec<PlacedCharacter>,
    at: usize,
    /// Where the last token ended.
    end: usize,
    tokens: Vec<Token>,
}

impl Lexer {
    fn peek(&self, ahead: usize) -> char {
        self.characters.get(self.at + ahead).map_or('\0', |&(character, ..)| character)
    }

    /// Reads one token or stretch of white space; false at the end.
    fn token(&mut self) -> bool {
        let Some(&(first, line, at)) = self.characters.get(self.at) else { return false };
        match first {
            '\n' => self.push(TokenKind::LineEnd, 1),
            _ if first.is_whitespace() => self.at += 1,
            'a'..='z' | 'A'..='Z' | '_' => self.run(TokenKind::Name, |lexer, n| is_word(lexer.peek(n))),
            '0'..='9' => self.number(),
            '.' if self.peek(1).is_ascii_digit() => self.number(),
            _ => self.symbol(first, line, at),
        }
        true
    }

    fn push(&mut self, kind: TokenKind, length: usize) {
        let part = &self.characters[self.at..self.at + length];
        let text: String = part.iter().map(|&(character, ..)| character).collect();
        let (_, line, at) = part[0];
        self.tokens.push(Token { touches: self.end == self.at, at, ..Token::new(kind, &text, line) });
        self.at += length;
        self.end = self.at;
    }

    fn run(&mut self, kind: TokenKind, goes_on: impl Fn(&Self, usize) -> bool) {
        let mut length = 1;
        while goes_on(self, length) {
            length += 1;
        }
        self.push(kind, length);
    }

    fn number(&mut self) {
        let is_hexadecimal = self.peek(0) == '0' && matches!(self.peek(1), 'x' | 'X');
        self.run(TokenKind::Number, |lexer, n| match lexer.peek(n) {
            '+' | '-' => !is_hexadecimal && matches!(lexer.peek(n - 1), 'e' | 'E'),
            other => other == '.' || is_word(other),
        });
    }

    fn symbol(&mut self, first: char, line: u32, at: u32) {
        let starts = |symbol: &&&str| symbol.chars().enumerate().all(|(n, c)| self.peek(n) == c);
        match SYMBOLS.iter().find(starts).copied() {
            Some("//") => {
                while !matches!(self.peek(0), '\n' | '\0') {
                    self.at += 1;
                }
            }
            Some("/*") => {
                self.at += 2;
                while self.at < self.characters.len() && !(self.peek(0) == '*' && self.peek(1) == '/') {
                    self.at += 1;
                }
                self.at += 2;
            }
            Some(symbol) => self.push(TokenKind::Symbol, symbol.len()),
            None if first.is_ascii_punctuation() && !matches!(first, '$' | '@' | '`' | '"' | '\'' | '\\') => {
                self.push(TokenKind::Symbol, 1);
            }
            None => {
                self.tokens.push(Token { at, ..Token::new(TokenKind::Stray, &first.to_string(), line) });
                self.at += 1;
            }
        }
    }
}

fn is_word(character: char) -> bool {
    character.is_ascii_alphanumeric() || character == '_'
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(text: &str) -> Vec<String> {
        tokens(text).iter().filter(|t| t.kind != TokenKind::LineEnd).map(|t| t.text.to_string()).collect()
    }

    #[test]
    fn the_longest_operator_is_taken() {
        assert_eq!(texts("a+++b<<=c"), ["a", "++", "+", "b", "<<=", "c"]);
    }

    #[test]
    fn numbers_keep_their_signs_and_suffixes() {
        assert_eq!(texts("1.5e-3f+.5 0xFEu-1 2.lf"), ["1.5e-3f", "+", ".5", "0xFEu", "-", "1", "2.lf"]);
    }

    #[test]
    fn comments_and_joined_lines_keep_the_numbering() {
        let tokens = tokens("a /* one\ntwo */ b\r\nc \\\n d // e\\\n f\rg");
        let lines: Vec<_> =
            tokens.iter().filter(|t| t.kind == TokenKind::Name).map(|t| (t.text.to_string(), t.line)).collect();
        let expected = [("a", 1), ("b", 2), ("c", 3), ("d", 4), ("g", 6)].map(|(name, line)| (name.to_owned(), line));
        assert_eq!(lines, expected);
    }
}
