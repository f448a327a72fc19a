//! Why a folder is not an assignment: the file, the line, what is wrong, and what to write instead.

use super::MANIFEST;
use crate::{Folder, Text, manifest};
use std::fmt;

/// Why a folder is not an assignment.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AssignmentError {
    /// The file, by its name in the folder.
    pub file: String,
    /// The line in it, from 1, where it is known.
    pub line: Option<u32>,
    /// The column in that line, from 1, where it is known.
    pub column: Option<u32>,
    /// What in the file it is about, such as an entry of `assignment.toml`.
    pub entry: Option<String>,
    /// What is wrong there, and what to try.
    pub message: Text,
}

impl AssignmentError {
    /// The place and the message, in both languages.
    pub fn text(&self) -> Text {
        let Self { file, line, column, entry, message } = self;
        let entry = |separator: &str| entry.as_ref().map(|entry| format!("{separator}{entry}")).unwrap_or_default();
        let (en, ja) = match (line, column) {
            (Some(line), Some(column)) => {
                (format!("{file}, line {line}, column {column}"), format!("{file} の {line} 行目 {column} 桁目"))
            }
            (Some(line), None) => (format!("{file}, line {line}"), format!("{file} の {line} 行目")),
            (None, _) => (file.clone(), file.clone()),
        };
        Text { en: format!("{en}{}: {}", entry(", "), message.en), ja: format!("{ja}{}: {}", entry("、"), message.ja) }
    }

    /// The same with the line of the entry, where the error was found without one, and with what to do about an entry of a
    /// folder that is extended.
    pub(super) fn located(self, folder: &Folder) -> Self {
        let mut located = self;
        if located.line.is_none() && located.file == MANIFEST {
            let found = located.entry.as_deref().and_then(|entry| entry_in(folder, entry));
            (located.file, located.line) = found.map_or((located.file, None), |(file, line)| (file, Some(line)));
        }
        // A file that is not there is named somewhere.
        if !folder.files.contains_key(&located.file)
            && let Some((manifest, line)) = naming(folder, &located.file)
        {
            let file = format!("`{}`", std::mem::replace(&mut located.file, manifest));
            located.line = Some(line);
            located.entry = Some(located.entry.map_or_else(|| file.clone(), |entry| format!("{entry}, {file}")));
        }
        if let Ok(text) = folder.text(&located.file) {
            located = located.in_column_of(text);
        }
        let name = located.entry.as_deref().and_then(|entry| entry.split('`').nth(1));
        if let Some(name) = name.filter(|_| located.file.starts_with("../")) {
            let Text { en, ja } = &mut located.message;
            en.push_str(&format!(
                "; this homework has it from there: write `leave_out = [\"{name}\"]`, or write it anew"
            ));
            ja.push_str(&format!(
                "。この課題が継承しているものです。`leave_out = [\"{name}\"]` と書いて除くか、書き直してください"
            ));
        }
        located
    }

    /// About a whole file.
    pub(crate) fn of_file(file: impl Into<String>, message: Text) -> Self {
        Self { file: file.into(), line: None, column: None, entry: None, message }
    }

    /// The same with the column of the first word between backticks that stands in its line of the file's text.
    pub(crate) fn in_column_of(self, text: &str) -> Self {
        let line = self.line.and_then(|line| text.lines().nth((line as usize).checked_sub(1)?));
        let Some(line) = line.filter(|_| self.column.is_none()) else { return self };
        let entry = self.entry.iter().flat_map(|entry| entry.split('`').skip(1).step_by(2));
        let words = self.message.en.split('`').skip(1).step_by(2).chain(entry);
        let found = words.filter(|word| !word.is_empty()).find_map(|word| position_of_word(line, word));
        let column = found.map(|at| line[..at].chars().count() as u32 + 1);
        Self { column, ..self }
    }
}

/// Where a text stands in a line, not as a part of a longer word.
fn position_of_word(line: &str, word: &str) -> Option<usize> {
    let is_part = |c: Option<char>| c.is_some_and(|c| c.is_alphanumeric() || c == '_');
    let is_own = |at: &usize| {
        let own = |end: Option<char>, other: Option<char>| is_part(end) && is_part(other);
        !own(word.chars().next(), line[..*at].chars().next_back())
            && !own(word.chars().next_back(), line[at + word.len()..].chars().next())
    };
    line.match_indices(word).map(|(at, _)| at).find(is_own)
}

impl fmt::Display for AssignmentError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text().en)
    }
}

impl std::error::Error for AssignmentError {}

/// An error at a place: `FILE`, `FILE, line N`, either of them with `, ENTRY` behind it, or an entry of `assignment.toml`
/// alone, such as ``mistake `gamma` ``. The name of a file has a dot and no space.
pub(crate) fn error(place: impl Into<String>, message: Text) -> AssignmentError {
    let place = place.into();
    let (first, rest) = place.split_once(", ").unwrap_or((&place, ""));
    let is_file = first.contains('.') && !first.contains([' ', '`']);
    if !is_file {
        return AssignmentError { entry: Some(place), ..AssignmentError::of_file(MANIFEST, message) };
    }
    let (line, rest) = match rest.strip_prefix("line ") {
        Some(numbered) => {
            let (number, rest) = numbered.split_once(", ").unwrap_or((numbered, ""));
            (number.parse().ok(), rest)
        }
        None => (None, rest),
    };
    let entry = (!rest.is_empty()).then(|| rest.to_owned());
    AssignmentError { line, entry, ..AssignmentError::of_file(first, message) }
}

/// The manifest of a folder, or of one that it extends, in which an entry stands, and its line there.
fn entry_in(folder: &Folder, entry: &str) -> Option<(String, u32)> {
    in_manifests(folder, |text| line_of(text, entry))
}

/// The manifest of a folder, or of one that it extends, that names a file, and the line in which it does.
fn naming(folder: &Folder, file: &str) -> Option<(String, u32)> {
    let name = format!("\"{file}\"");
    in_manifests(folder, |text| Some(text.lines().position(|line| line.contains(&name))? as u32 + 1))
}

/// The first manifest of a folder, and of those that it extends, in which there is such a line.
fn in_manifests(folder: &Folder, line: impl Fn(&str) -> Option<u32>) -> Option<(String, u32)> {
    let mut file = MANIFEST.to_owned();
    loop {
        let text = folder.text(&file).ok()?;
        if let Some(line) = line(text) {
            return Some((file, line));
        }
        file = manifest::name_of_base(&manifest::extended(text)?);
    }
}

/// The line of the manifest at which an entry begins: the one that names it (`id = "gamma"`), or the head of its table.
fn line_of(manifest: &str, entry: &str) -> Option<u32> {
    let (kind, name) = match entry.split_once(" `") {
        Some((kind, rest)) => (kind, rest.split('`').next()),
        None => (entry.split(',').next()?, None),
    };
    let kind = kind.split_whitespace().next()?.trim_end_matches(',');
    let head = |line: &str| {
        let line = line.trim();
        let inner = line.strip_prefix("[[").and_then(|l| l.split("]]").next());
        inner.or_else(|| line.strip_prefix('[').and_then(|l| l.split(']').next())).map(str::to_owned)
    };
    let mut first = None;
    let mut is_inside = false;
    for (number, line) in (1..).zip(manifest.lines()) {
        if let Some(found) = head(line) {
            is_inside = found == kind || found.strip_prefix(kind).is_some_and(|rest| rest.starts_with('.'));
            if is_inside && (first.is_none() || name.is_some_and(|name| found == format!("{kind}.{name}"))) {
                first = Some(number);
            }
        }
        let Some(name) = name.filter(|_| is_inside) else { continue };
        if let Some((key, value)) = line.split_once('=')
            && ["id", "name"].contains(&key.trim())
            && value.trim().starts_with(&format!("\"{name}\""))
        {
            return Some(number);
        }
    }
    first
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text::both;

    const TEXT: &str = "id = \"x\"\n[scene]\nfar = 1\n[[mistake]]\nid = \"one\"\n[mistake.seen]\nen = \"\"\n\n\
                        [[mistake]]\nkeeps = {}\nid = \"two\"\n[definition.h]\nsymbol = \"H\"\n";

    #[test]
    fn an_entry_is_found_by_its_name() {
        assert_eq!(line_of(TEXT, "mistake `one`, form 0"), Some(5));
        assert_eq!(line_of(TEXT, "mistake `two`"), Some(11));
        assert_eq!(line_of(TEXT, "scene"), Some(2));
        assert_eq!(line_of(TEXT, "scene, `eye`"), Some(2));
        assert_eq!(line_of(TEXT, "definition `h`"), Some(12));
        assert_eq!(line_of(TEXT, "rubric `x`"), None);
    }

    #[test]
    fn a_place_is_a_file_or_an_entry() {
        let found = |place: &str| {
            let AssignmentError { file, line, entry, .. } = error(place, Text::verbatim("wrong"));
            (file, line, entry)
        };
        assert_eq!(found("a.vert"), ("a.vert".into(), None, None));
        assert_eq!(found("a.vert, line 7"), ("a.vert".into(), Some(7), None));
        assert_eq!(found("a.vert, at t = 0.5"), ("a.vert".into(), None, Some("at t = 0.5".into())));
        let entry = "mistake `m`, form 0, `h`";
        assert_eq!(found(&format!("{MANIFEST}, line 3, {entry}")), (MANIFEST.into(), Some(3), Some(entry.into())));
        assert_eq!(found("uniform `a.b`"), (MANIFEST.into(), None, Some("uniform `a.b`".into())));
        let text = error("a.vert, line 7", both("wrong", "誤り")).text();
        assert_eq!((text.en.as_str(), text.ja.as_str()), ("a.vert, line 7: wrong", "a.vert の 7 行目: 誤り"));
    }

    #[test]
    fn a_column_is_that_of_the_first_word_that_is_named() {
        let said = |line: &str, message: &str| {
            error("a.frag, line 2", Text::verbatim(message)).in_column_of(&format!("one\n{line}\n")).column
        };
        assert_eq!(said("  c = vec4(cc, c2);", "there is no variable `c2`"), Some(16));
        assert_eq!(said("  colour = c;", "`c` has no value: write `c = …`"), Some(12));
        assert_eq!(said("  “é” = x;", "there is no `x`"), Some(9));
        assert_eq!(said("nothing of it", "`c` is missing"), None);
        let whole = AssignmentError::of_file("a.frag", Text::verbatim("`one` is missing")).in_column_of("one");
        assert_eq!((whole.line, whole.column), (None, None));
    }
}
