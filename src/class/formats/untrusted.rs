//! Text that students had a hand in (names, file names, what a compiler quotes) made harmless.

use super::plain::entity;
use crate::excerpt;
use crate::report::html::rich;

/// The text with everything pictured that a terminal, an XML parser or a reader's eye would obey: control characters,
/// a lone CR among them, marks that turn or hide text, and what is no character at all. Only tabs and `\n` stay.
pub fn visible(text: &str) -> String {
    excerpt::visible(text).replace(['\u{FFFE}', '\u{FFFF}'], "\u{FFFD}")
}

/// The same in one line.
pub fn one_line(text: &str) -> String {
    visible(text).replace(['\n', '\t'], " ")
}

/// The text as HTML, in an element or in a quoted attribute.
pub fn html(text: &str) -> String {
    let mut html = String::with_capacity(text.len());
    for c in visible(text).chars() {
        match entity(c) {
            Some(named) => html.push_str(named),
            None => html.push(c),
        }
    }
    html
}

/// A message as HTML: its `code` marked as such, its line ends kept.
pub fn rich_html(message: &str) -> String {
    let piece = |piece: rich::MessagePiece| {
        let text = html(&piece.text).replace('\n', "<br>");
        if piece.code { format!("<code>{text}</code>") } else { text }
    };
    rich::pieces(message).into_iter().map(piece).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_that_is_obeyed_remains() {
        // ESC is U+001B, its picture U+241B; CR U+000D and U+240D; NUL U+0000 and U+2400.
        assert_eq!(visible("a\u{1B}[2Jb\rc\0d"), "a\u{241B}[2Jb\u{240D}c\u{2400}d");
        assert_eq!(visible("right\u{202E}left\u{200B}\u{FFFE}\u{85}"), "right\u{FFFD}left\u{FFFD}\u{FFFD}\u{FFFD}");
        assert_eq!(visible("two\n\tlines 日本"), "two\n\tlines 日本");
        assert_eq!(one_line("two\nlines\r\nmore"), "two lines\u{240D} more");
    }

    #[test]
    fn no_markup_remains() {
        assert_eq!(html(r#"<script a="b" c='d'>&"#), "&lt;script a=&quot;b&quot; c=&#39;d&#39;&gt;&amp;");
        assert_eq!(rich_html("`<b>` is\n<i>"), "<code>&lt;b&gt;</code> is<br>&lt;i&gt;");
    }
}
