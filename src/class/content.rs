//! Which submissions need be graded only once: those that decode to the same text with the same remarks about its encoding,
//! byte for byte the same, or with other line ends. All that a grading sees is then equal, its line numbers too. A text that
//! differs in a comment or a space is graded again, since its lines and the remarks about its comments are its own.

use crate::diagnostic::Diagnostic;
use crate::source::Source;
use sha2::{Digest, Sha256};

/// What decides whether two files need but one grading.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct ContentDigest([u8; 32]);

impl ContentDigest {
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

#[cfg(test)]
mod tests {
    use super::*;

    fn source(text: &[u8]) -> Source {
        crate::source::read("a.vert", text).expect("a shader")
    }

    #[test]
    fn other_line_ends_are_the_same_content_and_another_comment_is_not() {
        let text = "#version 410\nvoid main() { gl_Position = vec4(0); } // a\n";
        let content = |text: &[u8]| ContentDigest::of_text(&source(text));
        assert_eq!(content(text.as_bytes()), content(text.replace('\n', "\r\n").as_bytes()));
        assert_ne!(content(text.as_bytes()), content(text.replace("// a", "// b").as_bytes()));
        // UTF-16 reads as the same text, but there is something to say about it.
        let utf16: Vec<u8> = [0xFEFF].into_iter().chain(text.encode_utf16()).flat_map(u16::to_le_bytes).collect();
        assert_eq!(source(&utf16).text, text);
        assert_ne!(content(&utf16), content(text.as_bytes()));
    }
}
