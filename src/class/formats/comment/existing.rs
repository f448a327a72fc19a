//! What stands in a cell already: ours, which is replaced, and a teacher's words, which are kept once.

use super::exported::{GAP, is_html, paragraphs, plain_quotes, text};
use super::former::Former;
use super::{CLOSE, LANGUAGES, OPEN, OPEN_QUOTED, WorksheetComment, marks};

/// The cell with `ours` in the place of what is ours in it, or behind what is a teacher's.
pub(super) fn replaced(cell: &str, ours: &str, former: &Former) -> WorksheetComment {
    let whole = |html: String| WorksheetComment { html, is_end_guessed: false };
    if !is_html(cell) {
        return in_text(&plain_quotes(cell), ours, former);
    }
    if let Some(html) = in_html(cell, ours) {
        return whole(html);
    }
    // HTML without our element: a teacher's, unless our words are in it. Then the words are what can be gone by.
    let text = text(cell);
    if marked(&text).is_some() || former.find(&text).is_some() {
        return in_text(&text, ours, former);
    }
    whole(format!("{cell}{ours}"))
}

/// HTML with `ours` in the place of our element; `None` where it has none.
fn in_html(cell: &str, ours: &str) -> Option<String> {
    let element = |html: &str| {
        let start = [OPEN, OPEN_QUOTED].iter().filter_map(|open| html.find(open)).min()?;
        let end = start + html[start..].find(CLOSE)? + CLOSE.len();
        Some(start..end)
    };
    let first = element(cell)?;
    let (before, mut after) = (&cell[..first.start], cell[first.end..].to_owned());
    while let Some(other) = element(&after) {
        after.replace_range(other, "");
    }
    Some(format!("{before}{ours}{after}"))
}

/// The text of a worksheet with `ours` in the place of what is ours in it.
fn in_text(text: &str, ours: &str, former: &Former) -> WorksheetComment {
    let (before, after) = match marked(text) {
        Some(span) => (text[..span.start].to_owned(), text[span.end..].to_owned()),
        None => (text.to_owned(), String::new()),
    };
    let mut is_end_guessed = false;
    let mut without_former = |text: String| {
        let mut parts = Vec::new();
        let mut rest = without_marks(&text);
        while let Some(found) = former.find(&rest) {
            is_end_guessed |= found.is_end_guessed;
            parts.push(rest[..found.span.start].to_owned());
            rest.replace_range(..found.span.end, "");
        }
        parts.push(rest);
        parts
    };
    let (before, after) = (without_former(before), without_former(after));
    let (first, rest) =
        before.split_first().map_or((String::new(), String::new()), |(first, rest)| (first.clone(), rest.join(GAP)));
    let html = format!("{}{ours}{}{}", paragraphs(&first), paragraphs(&rest), paragraphs(&after.join(GAP)));
    WorksheetComment { html, is_end_guessed }
}

/// From the first of our marks that begins to the last that ends: what a student quotes between them ends nothing.
fn marked(text: &str) -> Option<std::ops::Range<usize>> {
    let start = LANGUAGES.iter().filter_map(|language| text.find(marks(*language)[0])).min()?;
    let end = |mark: &str| text[start..].rfind(mark).map(|at| start + at + mark.len());
    let end = LANGUAGES.iter().filter_map(|language| end(marks(*language)[1])).max()?;
    Some(start..end)
}

/// The text without a mark whose partner somebody has removed.
fn without_marks(text: &str) -> String {
    LANGUAGES.iter().flat_map(|language| marks(*language)).fold(text.to_owned(), |text, mark| text.replace(mark, GAP))
}
