//! A fragment shader as a page for sharing shaders has it: `mainImage`, and nothing of what the page declares.

use super::{Source, comments, declared_version};
use crate::diagnostic::{Diagnostic, DiagnosticStage};
use crate::language::Text;
use reference::page::{Page, VERSION};

/// Adds what the page adds, so that no line of the file moves: declarations stand in the first line that they may stand in, `main`
/// behind the last one. A file without `#version` is read as the version of the page.
pub(super) fn complete(source: Source) -> Source {
    let Some(page) = Page::of(&source.text) else { return source };
    let Some(at) = first_place(&source) else { return source };
    let declarations = page.declarations.join(" ");
    let text = format!("{}{declarations} {}{}\n", &source.text[..at], &source.text[at..], page.main);
    let message = Text::new(
        format!(
            "This file has `mainImage` and no `main`: it is read with `{}` and the declarations of such pages.",
            page.main
        ),
        format!(
            "`mainImage` だけがあり `main` がないので、`{}` と、共有サイトが与える宣言を補って読みます。",
            page.main
        ),
    );
    let default_version = declared_version(&source.code).map_or_else(version, |_| source.default_version);
    let mut notes = source.notes;
    notes.push(Diagnostic {
        severity: crate::diagnostic::Severity::Note,
        ..Diagnostic::error(DiagnosticStage::Source, message)
    });
    Source { notes, default_version, ..Source::new(source.facts, &text) }
}

/// The number in the page's own `#version`.
fn version() -> i32 {
    VERSION.split_whitespace().nth(1).and_then(|number| number.parse().ok()).unwrap_or(super::DEFAULT_VERSION)
}

/// Where the first line begins that is no directive, within no `#if`, and behind no comment that begins in a line above.
fn first_place(source: &Source) -> Option<usize> {
    let mut depth = 0_usize;
    let mut goes_on = false;
    source.line_starts.iter().zip(source.code.lines()).find_map(|(&start, line)| {
        let is_continued = std::mem::replace(&mut goes_on, line.trim_end().ends_with('\\'));
        let is_within = |comment: &comments::SourceComment| comment.range.start < start && start < comment.range.end;
        if ["if", "ifdef", "ifndef"].iter().any(|name| is_directive(line, name)) {
            depth += 1;
        } else if is_directive(line, "endif") {
            depth = depth.saturating_sub(1);
        } else if depth == 0
            && !is_continued
            && !line.trim_start().starts_with('#')
            && !source.comments.iter().any(is_within)
        {
            return Some(start);
        }
        None
    })
}

fn is_directive(line: &str, name: &str) -> bool {
    let words = line.trim_start().strip_prefix('#').map(str::split_whitespace);
    words.and_then(|mut words| words.next()) == Some(name)
}
