//! Where the parts of a file stand: its functions, and the statements in them, byte by byte as they are written.
//!
//! This is for cutting a text and for changing it at a place; what the text means is said by the compiler.

use super::text::{self, Token, TokenKind};
use std::ops::Range;

/// A word, number or symbol as it is written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Word {
    /// Its text.
    pub text: String,
    /// Its bytes in the file.
    pub range: Range<usize>,
    /// Its line, from 1.
    pub line: u32,
    /// Whether it is a name or keyword.
    pub is_name: bool,
}

/// What ends in a semicolon inside of a function, its own words only.
#[derive(Clone, Debug)]
pub struct StatementText {
    /// Its words, the semicolon among them.
    pub words: Vec<Word>,
    /// How many pairs of braces it stands in, those of its function not counted.
    pub depth: usize,
    /// The words of what decides that it is done: `if (…`, `for (…`.
    pub under: Vec<Word>,
}

impl StatementText {
    /// Its bytes in the file.
    pub fn range(&self) -> Range<usize> {
        let (first, last) = (self.words.first(), self.words.last());
        first.map_or(0, |word| word.range.start)..last.map_or(0, |word| word.range.end)
    }

    /// Where its own assignment or first value stands: the place of `=`, `+=` and so on among its words.
    pub fn assignment(&self) -> Option<usize> {
        let mut depth = 0_i32;
        self.words.iter().position(|word| {
            match word.text.as_str() {
                "(" | "[" => depth += 1,
                ")" | "]" => depth -= 1,
                _ => {}
            }
            depth == 0 && matches!(word.text.as_str(), "=" | "+=" | "-=" | "*=" | "/=")
        })
    }
}

/// Those of the words of what decides that a statement is done which stand in the heads of loops.
pub fn loop_heads(under: &[Word]) -> Vec<Word> {
    let mut is_loop = false;
    let is_in_head = |word: &&Word| {
        match word.text.as_str() {
            "for" | "while" => is_loop = true,
            "if" | "switch" => is_loop = false,
            _ => {}
        }
        is_loop
    };
    under.iter().filter(is_in_head).cloned().collect()
}

/// A function with its body.
#[derive(Clone, Debug)]
pub struct FunctionText {
    /// The last word of the type of its result.
    pub result: Word,
    /// Its name.
    pub name: Word,
    /// The words between its brackets.
    pub parameters: Vec<Word>,
    /// The bytes between its braces.
    pub body: Range<usize>,
    /// The statements in it, those of inner blocks among them.
    pub statements: Vec<StatementText>,
}

/// The functions of a file that have a body, in their order.
pub fn functions(source: &str) -> Vec<FunctionText> {
    let words = words(source);
    let mut functions = Vec::new();
    let mut at = 0;
    while at < words.len() {
        if words[at].text != "{" {
            at += 1;
            continue;
        }
        let end = closing(&words, at);
        if let Some(function) = function(&words, at, end) {
            functions.push(function);
        }
        at = end + 1;
    }
    functions
}

/// All words of a file; comments and the lines of directives are left out.
pub fn words(source: &str) -> Vec<Word> {
    let tokens = text::tokens(source);
    let lines = tokens.split(|token| token.kind == TokenKind::LineEnd);
    let own = lines.filter(|line| line.first().is_none_or(|first| &*first.text != "#"));
    own.flatten().map(word).collect()
}

fn word(token: &Token) -> Word {
    let start = token.at as usize;
    Word {
        text: token.text.to_string(),
        range: start..start + token.text.len(),
        line: token.line,
        is_name: token.is_name(),
    }
}

/// The place of the brace that closes the one at a place; the last word where none does.
fn closing(words: &[Word], open: usize) -> usize {
    let mut depth = 0_usize;
    let closes = words[open..].iter().position(|word| {
        match word.text.as_str() {
            "{" => depth += 1,
            "}" => depth -= 1,
            _ => {}
        }
        depth == 0
    });
    closes.map_or(words.len() - 1, |steps| open + steps)
}

/// The function whose braces these are, if they are those of one.
fn function(words: &[Word], open: usize, close: usize) -> Option<FunctionText> {
    let before = open.checked_sub(1).filter(|before| words[*before].text == ")")?;
    let mut depth = 0_usize;
    let bracket = words[..=before].iter().rposition(|word| {
        match word.text.as_str() {
            ")" => depth += 1,
            "(" => depth -= 1,
            _ => {}
        }
        depth == 0
    })?;
    let [.., result, name] = &words[..bracket] else { return None };
    let name = Some(name).filter(|name| name.is_name)?.clone();
    let start = words[open].range.end;
    Some(FunctionText {
        result: result.clone(),
        name,
        parameters: words[bracket + 1..before].to_vec(),
        // A file may end behind the brace.
        body: start..words[close].range.start.max(start),
        statements: statements(words.get(open + 1..close).unwrap_or_default()),
    })
}

fn statements(words: &[Word]) -> Vec<StatementText> {
    let (mut statements, mut own, mut brackets) = (Vec::new(), Vec::new(), 0_usize);
    // Where the heads of the blocks around begin, and those of the statement that comes next.
    let (mut blocks, mut heads, mut ended): (Vec<usize>, Vec<Vec<Word>>, Vec<Vec<Word>>) = Default::default();
    for word in words {
        match word.text.as_str() {
            "(" => brackets += 1,
            ")" => brackets = brackets.saturating_sub(1),
            _ => {}
        }
        let outer = |blocks: &[usize]| blocks.last().copied().unwrap_or(0);
        match word.text.as_str() {
            "{" => {
                own.clear();
                blocks.push(heads.len());
            }
            "}" => {
                own.clear();
                blocks.pop();
                ended = heads.split_off(outer(&blocks));
            }
            // What stands behind `if (…)` without braces is a statement of its own.
            ")" if brackets == 0 && is_head(&own) => heads.push(std::mem::take(&mut own)),
            // What decides about one branch decides about the other.
            "else" if brackets == 0 => {
                own.clear();
                heads.append(&mut ended);
            }
            "do" if brackets == 0 => own.clear(),
            ";" if brackets == 0 => {
                own.push(word.clone());
                let under = heads.concat();
                statements.push(StatementText { words: std::mem::take(&mut own), depth: blocks.len(), under });
                ended = heads.split_off(outer(&blocks));
            }
            _ => own.push(word.clone()),
        }
    }
    statements
}

fn is_head(words: &[Word]) -> bool {
    words.first().is_some_and(|word| matches!(word.text.as_str(), "if" | "for" | "while" | "switch"))
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "#version 330 core\n#define BODY { }\nstruct S { float x; };\nfloat f(in vec2 p)\n{ return p.x; }\n\
        void main() {\n  float a = 1.0; // a { in a comment\n  for (int i = 0; i < 3; i++) a += f(vec2(a));\n  if (a > 2.0) { discard; }\n}\n";

    #[test]
    fn functions_are_found_with_what_stands_in_them() {
        let found = functions(TEXT);
        let names: Vec<_> = found.iter().map(|function| function.name.text.as_str()).collect();
        assert_eq!(names, ["f", "main"]);
        assert_eq!([&found[0].result.text, &found[1].result.text], ["float", "void"]);
        assert_eq!(found[0].parameters.iter().map(|word| word.text.as_str()).collect::<Vec<_>>(), ["in", "vec2", "p"]);
        assert_eq!(&TEXT[found[0].body.clone()], " return p.x; ");
        let texts: Vec<_> = found[1].statements.iter().map(|statement| &TEXT[statement.range()]).collect();
        assert_eq!(texts, ["float a = 1.0;", "a += f(vec2(a));", "discard;"]);
        let under: Vec<String> = found[1].statements.iter().map(|statement| joined(&statement.under)).collect();
        assert_eq!(under, ["", "for ( int i = 0 ; i < 3 ; i ++", "if ( a > 2.0"]);
        let depths: Vec<_> = found[1].statements.iter().map(|statement| statement.depth).collect();
        assert_eq!(depths, [0, 0, 1]);
        let assigned = found[1].statements[1].assignment().map(|at| found[1].statements[1].words[at].text.as_str());
        assert_eq!(assigned, Some("+="));
    }

    #[test]
    fn a_file_that_ends_within_a_function_has_it_without_a_statement() {
        for text in ["void main() {", "void main() { /* float x = 1.0; }"] {
            let found = functions(text);
            assert_eq!((found.len(), found[0].statements.len()), (1, 0), "{text}");
            assert_eq!(found[0].body, 13..13, "{text}");
        }
    }

    fn joined(words: &[Word]) -> String {
        words.iter().map(|word| word.text.as_str()).collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn both_branches_are_under_their_condition() {
        let text = "void main() { if (a) { b; if (c) d; else e; f; } else if (g) h; else { i; } j; }";
        let under: Vec<String> = functions(text)[0].statements.iter().map(|own| joined(&own.under)).collect();
        let expected = ["if ( a", "if ( a if ( c", "if ( a if ( c", "if ( a", "if ( a if ( g", "if ( a if ( g", ""];
        assert_eq!(under, expected);
    }

    #[test]
    fn braces_that_do_not_close_end_with_the_file() {
        assert_eq!(functions("void main() { a; ").len(), 1);
        assert!(functions("}{").is_empty() && functions("").is_empty());
    }
}
