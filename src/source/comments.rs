//! Where the comments are. GLSL has no strings, so two characters decide; but a backslash at the end of a line joins
//! it to the next before anything else is looked at, even between the two slashes of `//`.

use serde::{Deserialize, Serialize};
use std::ops::Range;

/// A comment of the student's text.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct SourceComment {
    /// Its bytes, from the opening slash to its last character; for `//` without the line end.
    pub range: Range<usize>,
    /// Whether it is a `//` comment.
    pub to_line_end: bool,
}

/// All comments of `text`, in order. A block comment that is never closed reaches to the end.
pub(super) fn find(text: &str) -> Vec<SourceComment> {
    let bytes = text.as_bytes();
    let mut found = Vec::new();
    let mut at = 0;
    while let Some(slash) = text[at..].find('/') {
        at += slash;
        let second = after_splices(bytes, at + 1);
        let end = match bytes.get(second) {
            Some(b'/') => line_end(bytes, second + 1),
            Some(b'*') => block_end(bytes, second + 1),
            _ => {
                at += 1;
                continue;
            }
        };
        found.push(SourceComment { range: at..end, to_line_end: bytes[second] == b'/' });
        at = end;
    }
    found
}

/// `text` with every byte of a comment, line ends left out, replaced by a space.
pub(super) fn blank(text: &str, comments: &[SourceComment]) -> String {
    let mut code = String::with_capacity(text.len());
    let mut done = 0;
    for SourceComment { range, .. } in comments {
        code.push_str(&text[done..range.start]);
        code.extend(text[range.clone()].bytes().map(|byte| if byte == b'\n' { '\n' } else { ' ' }));
        done = range.end;
    }
    code.push_str(&text[done..]);
    code
}

/// The first byte from `at` on that is not part of a line continuation.
fn after_splices(bytes: &[u8], mut at: usize) -> usize {
    while bytes.get(at) == Some(&b'\\') && bytes.get(at + 1) == Some(&b'\n') {
        at += 2;
    }
    at
}

fn line_end(bytes: &[u8], mut at: usize) -> usize {
    loop {
        at = after_splices(bytes, at);
        match bytes.get(at) {
            None | Some(b'\n') => return at.min(bytes.len()),
            Some(_) => at += 1,
        }
    }
}

fn block_end(bytes: &[u8], mut at: usize) -> usize {
    loop {
        at = after_splices(bytes, at);
        match bytes.get(at) {
            None => return bytes.len(),
            Some(b'*') => {
                let next = after_splices(bytes, at + 1);
                if bytes.get(next) == Some(&b'/') {
                    return next + 1;
                }
                at = next;
            }
            Some(_) => at += 1,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn code(text: &str) -> String {
        blank(text, &find(text))
    }

    #[test]
    fn comments_become_spaces_and_nothing_moves() {
        assert_eq!(code("a // b\nc\n"), "a     \nc\n");
        assert_eq!(code("a/* b\nc */d\n"), "a    \n    d\n");
        // Three bytes of UTF-8 become three spaces.
        assert_eq!(code("//光\nx"), "     \nx");
    }

    #[test]
    fn a_slash_or_a_star_alone_is_code() {
        assert_eq!(code("a / b * c */ d"), "a / b * c */ d");
        assert_eq!(code("a /"), "a /");
    }

    #[test]
    fn a_block_comment_does_not_close_on_its_own_star() {
        assert_eq!(code("/*/ a */ b"), "         b");
        assert_eq!(code("/***/ b"), "      b");
        assert_eq!(code("/* ** // */ b"), "            b");
    }

    #[test]
    fn a_block_comment_may_stay_open() {
        assert_eq!(code("a /* b\nc"), "a     \n ");
        assert_eq!(code("a /*"), "a   ");
    }

    #[test]
    fn an_opened_kind_of_comment_hides_the_other() {
        assert_eq!(code("// /*\na // */\n"), "     \na      \n");
        assert_eq!(code("/* // */ a"), "         a");
    }

    // Mesa takes all of these as written here.
    #[test]
    fn a_backslash_joins_lines_before_comments_are_looked_for() {
        assert_eq!(code("// a \\\nb\nc"), "      \n \nc");
        assert_eq!(code("/\\\n/ a\nb"), "  \n   \nb");
        assert_eq!(code("/\\\n* a *\\\n/ b"), "  \n      \n  b");
        assert_eq!(code("// a \\ \nb"), "       \nb");
        assert_eq!(code("// a\\\n"), "     \n");
    }
}
