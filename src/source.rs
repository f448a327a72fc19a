//! Untrusted bytes → [`Source`]: size, encoding, line ends, and what a compiler would only stumble over.
//!
//! The text keeps the student's own lines: CRLF, CR and LF each end one line, as in an editor, so that every line
//! number of a later stage is theirs. What can be named better here than by a compiler is named here: a file that cannot be
//! the shader that is asked for, and characters that look like GLSL and are not.

mod comments;
mod directives;
mod encoding;
mod kind;
mod lines;
pub(crate) mod lookalikes;
mod page;
mod program;
mod stray_characters;
#[cfg(test)]
mod tests;

pub use encoding::Encoding;
pub use kind::fragment_shader;
pub use program::{ReadProgram, read_program};

use crate::diagnostic::Diagnostic;
use crate::hand_in::{HandIn, HandedInFile, hexadecimal};
use crate::language::Text;
use comments::SourceComment;
use reference::assignment::HandedIn;
use reference::interpreter::Stage;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

/// The largest file that is read, in bytes. Real answers to a shading homework have two to five kilobytes.
pub const MAX_BYTES: usize = 64 * 1024;

/// The version of a file without `#version` (GLSL 4.10, section 3.3).
pub(crate) const DEFAULT_VERSION: i32 = 110;

/// What is known of a file whatever becomes of it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct FileFacts {
    /// File name as handed in.
    pub name: String,
    /// Size in bytes.
    pub bytes: usize,
    /// SHA-256 of the bytes as handed in, in hexadecimal.
    pub sha256: String,
    /// The encoding that the text was read in; `None` where it was never read as text.
    pub encoding: Option<Encoding>,
}

/// A file that is not graded, and why.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct SourceRefusal {
    /// The file.
    pub facts: FileFacts,
    /// Its text, where it has one, for excerpts.
    pub source: Option<Source>,
    /// At least one error, in the order of the file; then the warnings.
    pub diagnostics: Vec<Diagnostic>,
}

/// A file read as text.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Source {
    /// The file.
    pub facts: FileFacts,
    /// Its text without a byte-order mark, every line ended by `\n`, the last one too. Never a NUL.
    pub text: String,
    /// Warnings and notes: nothing that keeps the file from being graded.
    pub notes: Vec<Diagnostic>,
    code: String,
    comments: Vec<SourceComment>,
    line_starts: Vec<usize>,
    /// The version that it is read as where it has no `#version`.
    default_version: i32,
}

/// Reads the file `name`, whose content is `bytes`.
///
/// # Errors
/// A [`SourceRefusal`] for what is no vertex shader, and for characters in code that no GLSL compiler takes.
pub fn read(name: &str, bytes: &[u8]) -> Result<Source, Box<SourceRefusal>> {
    read_stage(Stage::Vertex, name, bytes)
}

/// Reads the file `name`, which is to be a shader of this stage.
///
/// # Errors
/// As of [`read`].
pub fn read_stage(stage: Stage, name: &str, bytes: &[u8]) -> Result<Source, Box<SourceRefusal>> {
    let in_words = |refusal: Diagnostic| of_stage(stage, refusal);
    let mut facts = FileFacts::of(name, bytes);
    let decoded = match decode(bytes) {
        Ok(decoded) => decoded,
        Err(error) => return Err(Box::new(SourceRefusal { facts, source: None, diagnostics: vec![in_words(*error)] })),
    };
    facts.encoding = Some(decoded.encoding);
    let mut source = Source::new(facts, &decoded.text);
    source.notes = decoded.notes;
    source.notes.extend(stray_characters::in_comments(&source));
    let mut diagnostics: Vec<_> = kind::wrong_text(&source, stage).map(in_words).into_iter().collect();
    if diagnostics.is_empty() {
        let (errors, warnings) = stray_characters::in_code(&source);
        source.notes.splice(0..0, warnings);
        diagnostics = errors;
    }
    if diagnostics.is_empty() {
        return Ok(if stage == Stage::Fragment { page::complete(source) } else { source });
    }
    diagnostics.extend(source.notes.iter().cloned());
    Err(Box::new(SourceRefusal { facts: source.facts.clone(), source: Some(source), diagnostics }))
}

impl FileFacts {
    fn of(name: &str, bytes: &[u8]) -> Self {
        let sha256 = hexadecimal(&Sha256::digest(bytes));
        Self { name: name.to_owned(), bytes: bytes.len(), sha256, encoding: None }
    }
}

impl HandIn {
    /// The files that can be read as text.
    pub fn readable(&self) -> Vec<Source> {
        self.files.iter().filter_map(readable).collect()
    }
}

/// A file as text, also where it is refused; `None` where it cannot be read as text.
pub fn readable(file: &HandedInFile) -> Option<Source> {
    match read(&file.name, &file.bytes) {
        Ok(source) => Some(source),
        Err(refusal) => refusal.source,
    }
}

/// The encoding that a file is read in; `None` where it cannot be read as text.
pub fn encoding(bytes: &[u8]) -> Option<Encoding> {
    decode(bytes).ok().map(|decoded| decoded.encoding)
}

/// Bytes as text, in the encoding that fits them best, without a byte-order mark.
pub fn decoded_text(bytes: &[u8]) -> String {
    encoding::decode(bytes).text
}

/// Why `bytes`, which are to be what a slot asks for, cannot be read as text, where they cannot: too many, a binary
/// format, no sense in any encoding.
pub fn not_text(slot: &HandedIn, bytes: &[u8]) -> Option<Diagnostic> {
    let error = *decode(bytes).err()?;
    Some(if slot.program.is_some() { kind::of_program(error) } else { of_stage(slot.stage, error) })
}

/// A refusal in the words of a homework that asks for this stage.
fn of_stage(stage: Stage, refusal: Diagnostic) -> Diagnostic {
    match stage {
        Stage::Vertex => refusal,
        Stage::Fragment => kind::of_fragment_shader(refusal),
    }
}

/// The text of a file with its comments blanked, whatever it is; `None` where it cannot be read as text.
pub fn code(bytes: &[u8]) -> Option<String> {
    let text = decode(bytes).ok()?.text;
    Some(comments::blank(&text, &comments::find(&text)))
}

fn decode(bytes: &[u8]) -> Result<encoding::Decoded, Box<Diagnostic>> {
    if bytes.len() > MAX_BYTES {
        return Err(Box::new(too_large()));
    }
    if let Some(error) = kind::binary(bytes) {
        return Err(Box::new(error));
    }
    let decoded = encoding::decode(bytes);
    match kind::no_sense(&decoded.text, decoded.encoding) {
        Some(error) => Err(Box::new(error)),
        None => Ok(decoded),
    }
}

/// The version that `#version` names in a code, where there is one.
pub(crate) fn declared_version(code: &str) -> Option<i32> {
    let directive = code
        .lines()
        .map(str::trim_start)
        .find_map(|line| line.strip_prefix('#').map(str::trim_start).and_then(|line| line.strip_prefix("version")))?;
    let number = directive.split_whitespace().next().and_then(|number| number.parse().ok());
    Some(number.unwrap_or(DEFAULT_VERSION))
}

impl Source {
    /// `text` with its lines and comments found.
    fn new(facts: FileFacts, text: &str) -> Self {
        let mut text = text.replace("\r\n", "\n").replace('\r', "\n");
        if !text.ends_with('\n') {
            text.push('\n');
        }
        let comments = comments::find(&text);
        let code = comments::blank(&text, &comments);
        let line_ends = text.match_indices('\n').map(|(end, _)| end + 1);
        let line_starts = std::iter::once(0).chain(line_ends).filter(|&start| start < text.len()).collect();
        Self { facts, text, notes: Vec::new(), code, comments, line_starts, default_version: DEFAULT_VERSION }
    }

    /// The text with comments blanked: each of their bytes is a space, line ends stay, so that byte offsets, lines and
    /// everything outside comments are those of [`Source::text`].
    ///
    /// It is for looking things up. It is not always the same program: a block comment that spans lines inside a
    /// preprocessor directive holds the directive together.
    pub fn code(&self) -> &str {
        &self.code
    }

    /// The version that it is read as: that of its `#version`.
    pub fn version(&self) -> i32 {
        declared_version(&self.code).unwrap_or(self.default_version)
    }

    /// The version that a compiler has to be told, since the text does not say it.
    pub fn implied_version(&self) -> Option<i32> {
        (self.default_version != DEFAULT_VERSION).then_some(self.default_version)
    }

    /// The text with `//` comments blanked as in [`Source::code`]; block comments stay, which may hold a directive
    /// together.
    pub fn without_line_comments(&self) -> String {
        let to_line_end: Vec<_> = self.comments.iter().filter(|comment| comment.to_line_end).cloned().collect();
        comments::blank(&self.text, &to_line_end)
    }

    /// For each line whether no compiler reads it: the inside of `#if 0`, the text of a macro that is never used.
    pub fn unread_lines(&self) -> Vec<bool> {
        directives::standings(&self.code)
            .into_iter()
            .map(|standing| standing == directives::LineState::Skipped)
            .collect()
    }

    /// The names, keywords and numbers of the code, in order, each with its byte offset.
    pub fn words(&self) -> impl Iterator<Item = (usize, &str)> {
        words(&self.code)
    }
}

/// The words of `code` with their byte offsets.
pub(crate) fn words(code: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut rest = 0;
    std::iter::from_fn(move || {
        let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let start = rest + code[rest..].find(is_word)?;
        let end = code[start..].find(|c| !is_word(c)).map_or(code.len(), |length| start + length);
        rest = end;
        Some((start, &code[start..end]))
    })
}

fn too_large() -> Diagnostic {
    let limit = MAX_BYTES / 1024;
    Diagnostic::error(
        crate::diagnostic::DiagnosticStage::Source,
        Text::new(
            format!("The file is too large: at most {limit} KiB are read."),
            format!("ファイルが大きすぎます。受け付けられるのは {limit} KiB までです。"),
        ),
    )
    .hint(Text::new(
        "A shader has a few kilobytes. Is this the right file?",
        "シェーダのソースは数 KiB ほどです。別のファイルを選んでいないか確かめてください。",
    ))
}
