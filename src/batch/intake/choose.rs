//! Which of a student's files is the one to grade.
//!
//! The assignment's own name comes first, in any case; then that name with the mark of a copy (`ggsample06 (1).vert`);
//! then the only vertex shader under another name; then the only file that was renamed on its way (`.vert.txt`). Two
//! of the same rank that differ are a question to the student, never a guess.

use super::folder;
use super::students::{Group, Owned};
use super::tree::Held;
use super::{Content, Options, wording};
use crate::language::Text;
use std::path::PathBuf;

/// Extensions that other tools give to a vertex shader.
const OTHER_EXTENSIONS: [&str; 6] = ["glsl", "vs", "vsh", "vertex", "vshader", "shader"];

/// How well a file's name fits, the best first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Fit {
    /// The assignment's file name.
    Exact,
    /// That name with the mark of a copy.
    Copy,
    /// Another vertex shader.
    Shader,
    /// The assignment's file, or some vertex shader, with another extension behind it or in its place.
    Renamed,
    /// A text, which may be a vertex shader.
    Text,
    /// Anything else.
    Other,
}

/// How well `name` fits the assignment's `wanted`.
pub(super) fn fit(name: &str, wanted: &str) -> Fit {
    let name = name.trim().to_lowercase();
    let wanted = wanted.to_lowercase();
    if name == wanted {
        return Fit::Exact;
    }
    let wanted_stem = wanted.rsplit_once('.').map_or(wanted.as_str(), |(stem, _)| stem);
    let (stem, extension) = name.rsplit_once('.').unwrap_or((&name, ""));
    match extension {
        "vert" if without_copy_mark(stem) == wanted_stem => Fit::Copy,
        "vert" => Fit::Shader,
        _ if stem == wanted || without_copy_mark(stem) == wanted_stem && is_text(extension) => Fit::Renamed,
        _ if stem.ends_with(".vert") && is_text(extension) => Fit::Renamed,
        _ if OTHER_EXTENSIONS.contains(&extension) => Fit::Renamed,
        "txt" | "" => Fit::Text,
        _ => Fit::Other,
    }
}

fn is_text(extension: &str) -> bool {
    ["", "txt", "text"].contains(&extension) || OTHER_EXTENSIONS.contains(&extension)
}

/// `stem` without what browsers and systems put behind the name of a copy: ` (1)`, ` - Copy`, ` - コピー (2)`, ` 2`, and
/// the number that upload pages append (`_1234567890`, `-1`).
fn without_copy_mark(stem: &str) -> &str {
    let mut stem = stem;
    loop {
        let rest = stem.trim_end();
        let in_brackets = rest
            .strip_suffix(')')
            .and_then(|rest| rest.trim_end_matches(|c: char| c.is_ascii_digit()).strip_suffix('('));
        let word = ["copy", "コピー"].iter().find_map(|word| rest.strip_suffix(word));
        let word = word.map(|rest| rest.trim_end().trim_end_matches(['-', 'の']));
        let number = rest.trim_end_matches(|c: char| c.is_ascii_digit());
        let numbered =
            (number.len() < rest.len()).then_some(number).and_then(|rest| rest.strip_suffix([' ', '_', '-']));
        match in_brackets.or(word).or(numbered) {
            Some(shorter) if !shorter.trim_end().is_empty() => stem = shorter.trim_end(),
            _ => return rest,
        }
    }
}

/// What is graded of a student's files.
#[derive(Debug)]
pub(super) struct Chosen {
    pub path: Option<String>,
    pub local: Option<PathBuf>,
    pub content: Content,
}

/// Chooses among the files of one student.
pub(super) fn choose(group: Group, options: &Options) -> Chosen {
    let mut ranked: Vec<(Fit, Owned)> = group
        .files
        .into_iter()
        .map(|file| (if group.is_named { Fit::Exact } else { fit(&file.name, &options.file_name) }, file))
        .collect();
    for fit in [Fit::Exact, Fit::Copy, Fit::Shader, Fit::Renamed, Fit::Text] {
        let (mut fitting, others): (Vec<_>, Vec<_>) = ranked.into_iter().partition(|(rank, _)| *rank == fit);
        ranked = others;
        if fit == Fit::Text {
            // The extension says nothing: only what reads like a vertex shader is taken for one.
            let (texts, no_texts) = fitting.into_iter().partition(|(_, file)| is_like_shader(file, options));
            (fitting, _) = (texts, ranked.extend::<Vec<_>>(no_texts));
        }
        if !fitting.is_empty() {
            return one_of(fitting.into_iter().map(|(_, file)| file).collect(), options);
        }
    }
    let refused = ranked.iter().find(|(_, file)| matches!(file.file.held, Held::Refused(_)));
    if let Some(Content::Nothing(reason)) = refused.map(|(_, file)| content(file, options)) {
        return nothing(reason);
    }
    let names: Vec<String> = ranked.into_iter().map(|(_, file)| file.below).collect();
    nothing(wording::none_fits(&names, group.has_online_text, &options.file_name))
}

fn nothing(text: Text) -> Chosen {
    Chosen { path: None, local: None, content: Content::Nothing(text) }
}

/// The only one of these; of several the first, where all have the same content.
fn one_of(files: Vec<Owned>, options: &Options) -> Chosen {
    let names: Vec<String> = files.iter().map(|file| file.below.clone()).collect();
    let mut contents = files.into_iter().map(|file| (content(&file, options), file));
    let Some((first, file)) = contents.next() else { return nothing(Text::default()) };
    let is_same = |other: &Content| match (&first, other) {
        (Content::File { bytes, .. }, Content::File { bytes: others, .. }) => bytes == others,
        _ => false,
    };
    if !contents.all(|(other, _)| is_same(&other)) {
        return nothing(wording::several(&names, &options.file_name));
    }
    Chosen { path: Some(file.path), local: file.file.local, content: first }
}

fn content(file: &Owned, options: &Options) -> Content {
    let bytes = match &file.file.held {
        Held::Bytes(bytes) => Ok(bytes.clone()),
        Held::OnDisk => read(file, options),
        Held::Unread => Ok(Vec::new()),
        Held::Refused(reason) => Err(reason.clone()),
    };
    match bytes {
        Ok(bytes) => Content::File { name: file.name.clone(), bytes },
        Err(reason) => Content::Nothing(Text::new(
            format!("`{}` could not be taken. {}", file.below, reason.en),
            format!("`{}` を受け付けられませんでした。{}", file.below, reason.ja),
        )),
    }
}

fn read(file: &Owned, options: &Options) -> Result<Vec<u8>, Text> {
    let Some(local) = &file.file.local else { return Ok(Vec::new()) };
    folder::bytes(local, options.limits.file_bytes).map_err(|error| super::limits::unreadable(&error))
}

/// Whether a text has what only a vertex shader has.
fn is_like_shader(file: &Owned, options: &Options) -> bool {
    match content(file, options) {
        Content::File { bytes, .. } => bytes.windows(11).any(|window| window == b"gl_Position"),
        Content::Nothing(_) => false,
    }
}
