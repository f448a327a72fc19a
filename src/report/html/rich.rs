//! Messages with their `code` told apart from their words.

/// A stretch of a message: words, or code between back-quotes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct MessagePiece {
    pub text: String,
    pub code: bool,
}

/// A message in its pieces; a back-quote without a partner is a back-quote.
pub(crate) fn pieces(text: &str) -> Vec<MessagePiece> {
    let parts: Vec<&str> = text.split('`').collect();
    let lonely = parts.len().is_multiple_of(2);
    let mut pieces: Vec<MessagePiece> = Vec::new();
    for (index, part) in parts.iter().enumerate() {
        let text = if lonely && index == parts.len() - 1 { format!("`{part}") } else { (*part).to_owned() };
        let code = index % 2 == 1 && !text.starts_with('`');
        if !text.is_empty() {
            pieces.push(MessagePiece { text, code });
        }
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn back_quotes_part_code_from_words() {
        let parts = |text| pieces(text).into_iter().map(|piece| (piece.text, piece.code)).collect::<Vec<_>>();
        let expected = |parts: &[(&str, bool)]| parts.iter().map(|(t, c)| ((*t).to_owned(), *c)).collect::<Vec<_>>();
        assert_eq!(parts("`h` is `v`."), expected(&[("h", true), (" is ", false), ("v", true), (".", false)]));
        assert_eq!(parts("a ` b"), expected(&[("a ", false), ("` b", false)]));
    }
}
