//! What real drivers refuse and the compiler lets pass, as far as it is sure.

use super::{LinkedInterface, text};
use crate::diagnostic::{Diagnostic, DiagnosticStage};
use crate::language::Text;
use crate::source::{self, Source};

/// From this version on, a layout qualifier may be repeated.
const FREE_LAYOUTS: i32 = 420;
/// The version in which an output with a location finds no input without one.
const STRICT_LOCATIONS: i32 = 420;

/// The errors of `source`, which the compiler accepts.
pub(super) fn errors(source: &Source, interface: &LinkedInterface) -> Vec<Diagnostic> {
    let version = source.version();
    let mut errors: Vec<_> = before_version(source, version_line(source.code())).into_iter().collect();
    let code = text::without_directives(source.code());
    for statement in statements(&code) {
        if version < FREE_LAYOUTS {
            errors.extend(repeated_layout(source, &statement));
        }
        if version == STRICT_LOCATIONS && !interface.fragment.is_empty() {
            errors.extend(located_output(source, &statement, interface));
        }
        errors.extend(qualified_result(source, &statement));
    }
    errors
}

/// What stands before `#version` in its line, so that no compiler sees a directive there.
pub(super) fn hidden_version(source: &Source) -> Option<Diagnostic> {
    let code = source.code();
    let at = code.match_indices('#').find_map(|(at, _)| {
        let start = code[..at].rfind('\n').map_or(0, |end| end + 1);
        let first = code[start..at].chars().find(|&c| !is_blank(c))?;
        (first != '#' && is_version(&code[at..])).then_some(at)
    });
    // One that is a directive as well is what the compiler goes by.
    before_version(source, at.filter(|_| version_line(code).is_none()))
}

/// Where the line of `#version` begins.
fn version_line(code: &str) -> Option<usize> {
    let mut start = 0;
    code.split_inclusive('\n').find_map(|line| {
        let at = start + line.len() - line.trim_start_matches(is_blank).len();
        start += line.len();
        is_version(&code[at..]).then_some(at)
    })
}

fn is_version(text: &str) -> bool {
    let name = text.strip_prefix('#').map(|rest| rest.trim_start_matches([' ', '\t']));
    let rest = name.and_then(|name| name.strip_prefix("version"));
    rest.is_some_and(|rest| rest.starts_with(is_blank))
}

/// White space, and the sign that joins lines.
fn is_blank(c: char) -> bool {
    matches!(c, ' ' | '\t' | '\n' | '\r' | '\x0b' | '\x0c' | '\\')
}

/// The first of what stands before the `#version` at `version`, comments aside.
fn before_version(source: &Source, version: Option<usize>) -> Option<Diagnostic> {
    let before = &source.code()[..version?];
    let at = before.find(|c| !is_blank(c))?;
    let end = before[at..].find(is_blank).map_or(before.len(), |length| at + length);
    let message = Text::new(
        "Only comments and blank lines may stand before `#version`.",
        "`#version` より前に置けるのは、コメントと空行だけです。",
    );
    let hint = Text::new(
        "Delete this, or move it below the line of `#version`.",
        "ここを削除するか、`#version` の行より下に移してください。",
    );
    Some(error(source, DiagnosticStage::Compile, (at, &before[at..end]), message).hint(hint))
}

/// A piece of code between `;`, `{` and `}`: its words with the bytes that they stand at.
pub(super) struct CodeStatement<'a> {
    pub words: Vec<(usize, &'a str)>,
}

/// The pieces of `code`, which has no directives.
pub(super) fn statements(code: &str) -> impl Iterator<Item = CodeStatement<'_>> {
    let mut start = 0;
    code.split_inclusive([';', '{', '}']).map(move |piece| {
        let words = source::words(piece).map(|(at, word)| (start + at, word)).collect();
        start += piece.len();
        CodeStatement { words }
    })
}

impl CodeStatement<'_> {
    /// Which of its words is `wanted`.
    pub fn position(&self, wanted: &str) -> Option<usize> {
        self.words.iter().position(|(_, word)| *word == wanted)
    }
}

fn error(source: &Source, stage: DiagnosticStage, (at, word): (usize, &str), message: Text) -> Diagnostic {
    let (line, column) = source.position(at);
    Diagnostic::error(stage, message).at(line, Some(column)).spanning(word.len())
}

/// `layout(location = 1, location = 0)`, and `layout(…) layout(…)`.
fn repeated_layout(source: &Source, statement: &CodeStatement<'_>) -> Option<Diagnostic> {
    let code = source.code();
    let is_name = |&&(at, _): &&(usize, &str)| text::is_in_layout(code, at);
    let names = ["location", "layout", "std140", "shared", "packed", "row_major", "column_major"];
    let repeated = |name: &&str| {
        let mut places = statement.words.iter().filter(|(_, word)| word == name);
        let mut places = places.by_ref().filter(|place| *name == "layout" || is_name(place));
        places.next().and_then(|_| places.next())
    };
    let &place = names.iter().find_map(repeated)?;
    let message = Text::new(
        format!("`{}` stands twice; before GLSL 4.20 drivers refuse that.", place.1),
        format!("`{}` が重複しています。GLSL 4.20 より前ではドライバがエラーにします。", place.1),
    );
    Some(error(source, DiagnosticStage::Compile, place, message))
}

/// `layout(location = 1) out vec4 vc` where the fixed fragment shader's input has no location.
fn located_output(source: &Source, statement: &CodeStatement<'_>, interface: &LinkedInterface) -> Option<Diagnostic> {
    let place = statement.words[statement.position("location")?];
    let mut outputs = interface.outputs.iter().map(|output| output.name.as_str());
    let name = outputs.find(|name| statement.position(name).is_some())?;
    let is_output = statement.position("out").is_some();
    let message = Text::new(
        format!("In GLSL 4.20 the fragment shader's `{name}`, which has no location, does not find this one."),
        format!("GLSL 4.20 では、location の指定がないフラグメントシェーダの `{name}` とこの変数が結び付きません。"),
    );
    let hint = Text::new("Leave the `layout` away.", "`layout` を付けずに宣言してください。");
    is_output.then(|| error(source, DiagnosticStage::Link, place, message).hint(hint))
}

/// `precise float f() { … }`.
fn qualified_result(source: &Source, statement: &CodeStatement<'_>) -> Option<Diagnostic> {
    let [place @ (_, "precise"), (_, _), (at, name), ..] = statement.words[..] else { return None };
    let is_function = source.code()[at + name.len()..].trim_start().starts_with('(');
    let message = Text::new(
        format!("The result of the function `{name}` cannot be `precise`."),
        format!("関数 `{name}` の戻り値の型に `precise` は付けられません。"),
    );
    is_function.then(|| error(source, DiagnosticStage::Compile, place, message))
}
