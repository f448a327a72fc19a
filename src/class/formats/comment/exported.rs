//! What Moodle's worksheet makes of a comment, and how its text becomes HTML again.
//!
//! `core_table\\base_export_format::format_text` puts three blanks for `</p>` and for line ends, strips the tags and decodes
//! the entities but for those of the single quote (Moodle 3.11 to 5.1). Older versions give the HTML as it is.

use crate::class::formats::plain::entity;

/// What stands in an export where a paragraph or a line ended.
pub(super) const GAP: &str = "   ";

/// Elements that Moodle's editors write. Text with other words in angle brackets (`vec<3>`, `#include <cmath>`) is text.
const ELEMENTS: [&str; 33] = [
    "a",
    "b",
    "blockquote",
    "br",
    "code",
    "del",
    "div",
    "em",
    "font",
    "h1",
    "h2",
    "h3",
    "h4",
    "h5",
    "h6",
    "hr",
    "i",
    "img",
    "li",
    "ol",
    "p",
    "pre",
    "s",
    "span",
    "strong",
    "sub",
    "sup",
    "table",
    "tbody",
    "td",
    "th",
    "tr",
    "ul",
];

/// Elements without content.
const VOID: [&str; 3] = ["br", "hr", "img"];

/// Whether a cell is HTML rather than text: it has an element of Moodle's editors, from its beginning to its end.
pub(super) fn is_html(cell: &str) -> bool {
    cell.match_indices('<').any(|(at, _)| {
        let rest = &cell[at + 1..];
        let length = rest.find(|c: char| !c.is_ascii_alphanumeric()).unwrap_or(rest.len());
        let name = rest[..length].to_ascii_lowercase();
        ELEMENTS.contains(&name.as_str())
            && attributes_end(&rest[length..])
                .is_some_and(|content| VOID.contains(&name.as_str()) || content.contains(&format!("</{name}>")))
    })
}

/// What follows the `>` of an element's beginning; `None` where something else than attributes stands before it.
fn attributes_end(text: &str) -> Option<&str> {
    let mut rest = text;
    loop {
        let blank = rest.trim_start();
        let end = blank.strip_prefix('/').unwrap_or(blank).strip_prefix('>');
        if end.is_some() || blank.len() == rest.len() {
            return end;
        }
        let name = blank.find(|c: char| !(c.is_ascii_alphanumeric() || c == '-')).filter(|length| *length > 0)?;
        rest = &blank[name..];
        let Some(value) = rest.strip_prefix('=') else { continue };
        let quote = value.chars().next().filter(|c| matches!(c, '"' | '\''));
        rest = match quote {
            Some(quote) => value[1..].split_once(quote)?.1,
            None => &value[value.find(|c: char| c.is_whitespace() || c == '>')?..],
        };
    }
}

/// HTML as the worksheet gives it. Both sides of every comparison go through this, so the single quote is one here.
pub(super) fn text(html: &str) -> String {
    let spaced = html.replace("</p>", GAP).replace(['\n', '\r'], GAP);
    let mut text = String::with_capacity(spaced.len());
    let mut depth = 0_u32;
    for (at, c) in spaced.char_indices() {
        match c {
            // As PHP has it: only before a blank is a `<` no tag, and one that never ends takes the rest with it.
            '<' if depth > 0 || !spaced[at + 1..].starts_with(char::is_whitespace) => depth += 1,
            '>' if depth > 0 => depth -= 1,
            c if depth == 0 => text.push(c),
            _ => {}
        }
    }
    let entities = [("&lt;", "<"), ("&gt;", ">"), ("&quot;", "\""), ("&#92;", "\\"), ("&nbsp;", " "), ("&amp;", "&")];
    plain_quotes(&entities.iter().fold(text, |text, (entity, c)| text.replace(entity, c)))
}

/// The text of a cell with the single quotes as such, which Moodle leaves as entities.
pub(super) fn plain_quotes(text: &str) -> String {
    text.replace("&#39;", "'").replace("&#039;", "'")
}

/// Text of a worksheet as HTML, a paragraph for each gap in it; nothing for blanks.
pub(super) fn paragraphs(text: &str) -> String {
    let text = text.replace(['\n', '\r'], GAP);
    let paragraphs = text.split(GAP).map(str::trim).filter(|paragraph| !paragraph.is_empty());
    paragraphs.map(|paragraph| format!("<p>{}</p>", escaped(paragraph))).collect()
}

/// The text escaped once: what is an entity already stays one.
fn escaped(text: &str) -> String {
    let mut html = String::with_capacity(text.len());
    for (at, c) in text.char_indices() {
        match entity(c) {
            Some(named) if c != '&' || !begins_entity(&text[at + 1..]) => html.push_str(named),
            None if c == '\\' => html.push_str("&#92;"),
            _ => html.push(c),
        }
    }
    html
}

/// Whether `rest`, behind a `&`, is the rest of an entity.
fn begins_entity(rest: &str) -> bool {
    let Some((name, _)) = rest.split_once(';') else { return false };
    match name.strip_prefix('#') {
        Some(number) => {
            let hexadecimal = number.strip_prefix(['x', 'X']).unwrap_or("-");
            let is = |digits: &str, test: fn(&u8) -> bool| !digits.is_empty() && digits.bytes().all(|byte| test(&byte));
            is(number, u8::is_ascii_digit) || is(hexadecimal, u8::is_ascii_hexdigit)
        }
        None => {
            name.starts_with(|c: char| c.is_ascii_alphabetic()) && name.bytes().all(|byte| byte.is_ascii_alphanumeric())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_export_is_that_of_moodle() {
        // Taken from PHP 8.2: html_entity_decode(strip_tags(str_replace(['</p>', "\n", "\r"], '   ', $text)), ENT_COMPAT),
        // but for the single quote.
        for (html, expected) in [
            ("<p>a &lt; b &amp;&amp; c</p><p>d</p>", "a < b && c   d   "),
            ("<div class=\"x\">1<br>2</div>\r\n3", "12      3"),
            ("a < b <3 c> d < ", "a < b  d < "),
            ("if (i<b && c>d) e <= f", "if (id) e "),
            ("&amp;lt; &quot;q&quot; it&#39;s", "&lt; \"q\" it's"),
            ("open <b tag", "open "),
        ] {
            assert_eq!(text(html), expected, "{html}");
        }
    }

    #[test]
    fn html_is_told_from_code() {
        for html in ["<p>Good</p>", "x<br>y", "<br />", "<IMG src='a.png' alt=x>", "<a href=\"x\" target=_blank>y</a>"]
        {
            assert!(is_html(html), "{html}");
        }
        for text in [
            "Good",
            "a < b",
            "if (i<b && b>c)",
            "vec<3>",
            "#include <cmath>",
            "<p> ist kein",
            "a<b>c",
            "<i",
            "<s x",
            "",
            "<",
        ] {
            assert!(!is_html(text), "{text}");
        }
    }

    #[test]
    fn a_text_is_escaped_once() {
        assert_eq!(
            paragraphs("a < b && \"c\"   d\ne&lt;f  "),
            "<p>a &lt; b &amp;&amp; &quot;c&quot;</p><p>d</p><p>e&lt;f</p>"
        );
        assert_eq!(
            paragraphs("R&D; AT&T &#x3c; &#12; &#x; &; \\"),
            "<p>R&D; AT&amp;T &#x3c; &#12; &amp;#x; &amp;; &#92;</p>"
        );
        assert_eq!(paragraphs("  \r\n   "), "");
    }
}
