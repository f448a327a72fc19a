//! Submissions that are the same.
//!
//! Two questions, and an answer of its own to each:
//!
//! - *Which need be graded only once?* Those that decode to the same text with the same remarks about its encoding: byte
//!   for byte the same, or with other line ends. All that a grading sees is then equal, its line numbers too. A text that
//!   differs in a comment or a space is graded again, since its lines and the remarks about its comments are its own.
//! - *Who shares an answer?* Those whose code, comments and spacing left aside, consists of the same statements in the
//!   same order, the hand-out's own statements left out. Who changed nothing shares nothing; nor does who added so little
//!   that the hand-out and the lecture leave no choice of words.

use crate::diagnostic::Diagnostic;
use crate::source::Source;
use sha2::{Digest, Sha256};
use std::collections::{HashMap, HashSet};
use std::hash::Hash;

/// Fewest names, numbers and signs that a student must have added for a shared answer to be told. One term of the
/// lecture's equation in the hand-out's own names, `vec4 idiff = max(dot(n, l), 0.0) * kdiff * ldiff;`, has 19; a whole
/// answer has 60 and more.
pub const FEWEST_TOKENS: usize = 24;

/// A digest that is equal where texts are.
pub type Print = [u8; 32];

/// What decides whether two files need but one grading.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Content(Print);

impl Content {
    /// Of a file that can be read as text.
    pub fn of_text(source: &Source) -> Self {
        Self::of("text", &source.text, &source.notes)
    }

    /// Of any other file.
    pub fn of_bytes(sha256: &str) -> Self {
        Self::of("bytes", sha256, &[])
    }

    /// Of the files of a hand-in, in the order of the homework.
    pub fn of_all(contents: impl Iterator<Item = Self>) -> Self {
        let mut digest = Sha256::new();
        contents.for_each(|content| digest.update(content.0));
        Self(digest.finalize().into())
    }

    fn of(kind: &str, text: &str, notes: &[Diagnostic]) -> Self {
        let mut digest = Sha256::new();
        let notes: String = notes.iter().map(|note| format!("{note:?}")).collect();
        for part in [kind, text, &notes] {
            digest.update((part.len() as u64).to_le_bytes());
            digest.update(part);
        }
        Self(digest.finalize().into())
    }
}

/// Finds what a student added to the hand-out.
#[derive(Debug)]
pub struct HandOut {
    statements: HashSet<Vec<String>>,
}

impl HandOut {
    /// `code` is the handed-out file, its comments blanked.
    pub fn new(code: &str) -> Self {
        Self { statements: statements(code).into_iter().map(owned).collect() }
    }

    /// A digest of what was added to the hand-out; none where that is too little to be told.
    pub fn answer(&self, code: &str) -> Option<Print> {
        let added: Vec<_> =
            statements(code).into_iter().filter(|s| !self.statements.contains(&owned(s.clone()))).collect();
        let tokens = added.iter().map(Vec::len).sum::<usize>();
        if tokens < FEWEST_TOKENS {
            return None;
        }
        let mut digest = Sha256::new();
        for token in added.iter().flatten() {
            digest.update(token);
            // No token has a space in it.
            digest.update(" ");
        }
        Some(digest.finalize().into())
    }
}

fn owned(statement: Vec<&str>) -> Vec<String> {
    statement.into_iter().map(str::to_owned).collect()
}

/// The code in pieces that each end with `;`, `{`, `}` or, for a directive, with the line.
fn statements(code: &str) -> Vec<Vec<&str>> {
    let mut statements = Vec::new();
    let mut statement = Vec::new();
    let mut close = |statement: &mut Vec<_>| {
        if !statement.is_empty() {
            statements.push(std::mem::take(statement));
        }
    };
    let mut is_continued = false;
    for line in code.lines() {
        let is_directive = is_continued || line.trim_start().starts_with('#');
        if is_directive && !is_continued {
            close(&mut statement);
        }
        is_continued = is_directive && line.ends_with('\\');
        for token in tokens(line) {
            statement.push(token);
            if !is_directive && [";", "{", "}"].contains(&token) {
                close(&mut statement);
            }
        }
        if is_directive && !is_continued {
            close(&mut statement);
        }
    }
    close(&mut statement);
    statements
}

/// Names, numbers and single signs. A backslash only joins lines.
fn tokens(line: &str) -> impl Iterator<Item = &str> {
    let is_word = |c: char| c.is_alphanumeric() || c == '_' || c == '.';
    let mut rest = line;
    std::iter::from_fn(move || {
        rest = rest.trim_start_matches(|c: char| c.is_whitespace() || c.is_control() || c == '\\' || c == '\u{feff}');
        let first = rest.chars().next()?;
        let end = match is_word(first) {
            true => rest.find(|c| !is_word(c)).unwrap_or(rest.len()),
            false => first.len_utf8(),
        };
        let (token, others) = rest.split_at(end);
        rest = others;
        Some(token)
    })
}

/// For each of `keys` the indices of the others that have the same one; none for those without a key.
pub fn others<K: Eq + Hash>(keys: &[Option<K>]) -> Vec<Vec<usize>> {
    let mut groups: HashMap<&K, Vec<usize>> = HashMap::new();
    for (index, key) in keys.iter().enumerate() {
        if let Some(key) = key {
            groups.entry(key).or_default().push(index);
        }
    }
    let others = |(index, key): (usize, &Option<K>)| {
        let group = key.as_ref().and_then(|key| groups.get(key)).map_or(&[][..], Vec::as_slice);
        group.iter().copied().filter(|&other| other != index).collect()
    };
    keys.iter().enumerate().map(others).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const HAND_OUT: &str =
        "#version 410 core\nin vec4 pv;\nvoid main(void)\n{\n  vc = cv;\n  gl_Position = mc * pv;\n}\n";
    const ANSWER: &str = "vec3 h = normalize(l + v);\nvec4 ispec = pow(max(dot(n, h), 0.0), kshi) * kspec * lspec;\n";

    fn source(text: &[u8]) -> Source {
        crate::source::read("a.vert", text).expect("a shader")
    }

    fn answer(code: &str) -> Option<Print> {
        HandOut::new(HAND_OUT).answer(code)
    }

    fn with(added: &str) -> String {
        HAND_OUT.replace("  vc = cv;\n", added)
    }

    #[test]
    fn a_statement_is_the_same_however_it_is_spaced() {
        let tight = "vec3 h=normalize(l+v);vec4 ispec=pow(max(dot(n,h),0.0),kshi)*kspec*lspec;";
        let loose =
            "vec3\n\th = normalize ( l\r\n + v ) ;\n\nvec4 ispec = pow(max(dot(n, h), 0.0), kshi)\n * kspec * lspec;";
        assert!(answer(&with(ANSWER)).is_some());
        assert_eq!(answer(&with(tight)), answer(&with(ANSWER)));
        assert_eq!(answer(&with(loose)), answer(&with(ANSWER)));
    }

    #[test]
    fn the_hand_outs_own_text_does_not_count() {
        // Kept or thrown away, above or below: what was added is the same.
        assert_eq!(answer(ANSWER), answer(&with(ANSWER)));
        assert_eq!(answer(&format!("{HAND_OUT}{ANSWER}")), answer(&with(ANSWER)));
        assert_eq!(answer(HAND_OUT), None, "who changed nothing shares nothing");
    }

    #[test]
    fn another_name_number_or_order_is_another_answer() {
        for other in [ANSWER.replace("ispec", "specular"), ANSWER.replace("0.0", "0"), ANSWER.replace("l + v", "v + l")]
        {
            assert_ne!(answer(&with(&other)), answer(&with(ANSWER)), "{other}");
        }
        let swapped: String = ANSWER.lines().rev().collect();
        assert_ne!(answer(&with(&swapped)), answer(&with(ANSWER)));
    }

    #[test]
    fn what_leaves_no_choice_is_not_told() {
        let term = "vec4 idiff = max(dot(n, l), 0.0) * kdiff * ldiff;";
        // vec4 idiff = max ( dot ( n , l ) , 0.0 ) * kdiff * ldiff ;
        assert_eq!(tokens(term).count(), 19);
        assert_eq!(answer(&with(term)), None);
    }

    #[test]
    fn directives_end_with_their_line() {
        let split = statements("#define A 1 \\\n + 2\nfloat a = A;\n#version 410\n");
        assert_eq!(
            split,
            [vec!["#", "define", "A", "1", "+", "2"], vec!["float", "a", "=", "A", ";"], vec!["#", "version", "410"]]
        );
    }

    #[test]
    fn other_line_ends_are_the_same_content_and_another_comment_is_not() {
        let text = "#version 410\nvoid main() { gl_Position = vec4(0); } // a\n";
        let content = |text: &[u8]| Content::of_text(&source(text));
        assert_eq!(content(text.as_bytes()), content(text.replace('\n', "\r\n").as_bytes()));
        assert_ne!(content(text.as_bytes()), content(text.replace("// a", "// b").as_bytes()));
        // UTF-16 reads as the same text, but there is something to say about it.
        let utf16: Vec<u8> = [0xFEFF].into_iter().chain(text.encode_utf16()).flat_map(u16::to_le_bytes).collect();
        assert_eq!(source(&utf16).text, text);
        assert_ne!(content(&utf16), content(text.as_bytes()));
    }

    #[test]
    fn sharing_is_mutual() {
        let keys = [Some("a"), None, Some("b"), Some("a"), None, Some("a")];
        let expected: [&[usize]; 6] = [&[3, 5], &[], &[], &[0, 5], &[], &[0, 3]];
        assert_eq!(others(&keys), expected);
    }
}
