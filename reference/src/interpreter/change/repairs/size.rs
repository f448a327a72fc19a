//! How large a change of a text is.

/// How many words and signs a change takes away and puts there, and whether it puts any there: what is too much is plainer than what
/// another one should stand for.
pub(super) fn size(texts: &[String; 2]) -> (usize, bool) {
    let [mut before, mut after] = [tokens(&texts[0]), tokens(&texts[1])];
    before.retain(|token| match after.iter().position(|other| other == token) {
        Some(place) => {
            after.remove(place);
            false
        }
        None => true,
    });
    (before.len() + after.len(), !after.is_empty())
}

/// The words and signs of a text.
pub(super) fn tokens(text: &str) -> Vec<&str> {
    let is_word = |c: char| c.is_ascii_alphanumeric() || "_.".contains(c);
    let mut found = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let end = match is_word(first) {
            true => rest.find(|c| !is_word(c)).unwrap_or(rest.len()),
            false => first.len_utf8(),
        };
        found.extend(Some(&rest[..end]).filter(|token| !token.trim().is_empty()));
        rest = &rest[end..];
    }
    found
}
