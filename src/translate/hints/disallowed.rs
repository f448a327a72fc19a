//! Words of other languages, declarations that GLSL does not allow, and what another version has.

mod wording;

use super::file::{HintContext, macro_name};
use super::tokens::Lexeme;
use super::{CompilerMessage, vocabulary};
use crate::diagnostic::Diagnostic;
use crate::ffi::glslang::Stage;
use crate::language::Text;
use wording::{ALIEN, DECLARATIONS, LATE_CONSTANT, NO_HINT};

/// Puts a message about something that GLSL does not allow into words.
pub fn explain(file: &HintContext<'_>, finding: &CompilerMessage<'_, '_>) -> Option<Diagnostic> {
    let (token, message) = (finding.entry.token, finding.entry.message);
    let by_token = ALIEN.iter().chain([&LATE_CONSTANT]).find(|wording| wording.says == token);
    let by_message = || DECLARATIONS.iter().find(|wording| message.starts_with(wording.says));
    let Some(wording) = by_token.or_else(by_message) else { return version(file, finding) };
    let fill = |[en, ja]: [&str; 2]| Text::new(en.replace("{}", token), ja.replace("{}", token));
    let diagnostic = file.error_at(finding.index, fill(wording.message));
    Some(if wording.hint == NO_HINT { diagnostic } else { diagnostic.hint(fill(wording.hint)) })
}

/// What another `#version` has.
fn version(file: &HintContext<'_>, finding: &CompilerMessage<'_, '_>) -> Option<Diagnostic> {
    let message = finding.entry.message;
    let about = |start: &str| message.starts_with(start);
    let what = match finding.entry.token {
        "" => file.word(Some(finding.index)),
        token => token,
    };
    let text = if about("not supported for this version")
        || about("required extension not requested")
        || about("not supported with this profile")
    {
        Text::new(
            format!("The `#version` of this file does not have `{what}`."),
            format!("このファイルの `#version` では `{what}` は使えません。"),
        )
    } else if message.contains("no longer supported in") || message.contains("removed") {
        Text::new(
            format!("`{what}` was removed from GLSL before the `#version` of this file."),
            format!("`{what}` は、このファイルの `#version` の GLSL では廃止されています。"),
        )
    } else {
        return None;
    };
    Some(file.error_at(finding.index, text))
}

/// Puts a warning into words.
pub fn warn(file: &HintContext<'_>, finding: &CompilerMessage<'_, '_>) -> Option<Diagnostic> {
    let message = finding.entry.message;
    let (line, column) = finding.entry.place?;
    if finding.entry.token == "line continuation" {
        let text = Text::new(
            "A line continued with `\\` belongs to GLSL 4.20 and later; some drivers refuse it here.",
            "行末の `\\` による行の継続は GLSL 4.20 以降の機能です。ドライバによってはエラーになります。",
        );
        return Some(file.error(file.offset(line, column), 1, text));
    }
    if finding.entry.token == "extraneous semicolon" {
        let text = Text::new(
            "A `;` that ends nothing belongs to GLSL 4.60; some drivers refuse it here.",
            "余分な `;` が許されるのは GLSL 4.60 からです。ドライバによってはエラーになります。",
        );
        return Some(file.error(file.offset(line, column), 1, text));
    }
    let word = message.split_ascii_whitespace().next().unwrap_or_default();
    if message.contains("deprecated in version") && vocabulary::is_qualifier(word) {
        let (old, new) = (word, if word == "varying" && file.interface.stage == Stage::Vertex { "out" } else { "in" });
        let text = Text::new(
            format!("`{old}` is GLSL before version 1.30; some drivers refuse it. Today it is written `{new}`."),
            format!(
                "`{old}` は GLSL 1.30 より前の書き方で、ドライバによってはエラーになります。現在は `{new}` と書きます。"
            ),
        );
        return Some(file.error(file.offset(line, column), word.len(), text));
    }
    if message.starts_with("type conversion on return values") {
        let text = Text::new(
            "The value of this `return` is converted to the function's type; before GLSL 4.20 some drivers refuse that.",
            "この `return` の値は関数の型に変換されます。GLSL 4.20 より前では、ドライバによってはエラーになります。",
        );
        return Some(file.error_at(finding.index, text));
    }
    if message.contains("consecutive underscores") {
        let token = match finding.entry.token {
            "#define" => {
                let here = |directive: &&Lexeme<'_>| file.line(directive.start) == line;
                file.directives.iter().find(here).and_then(|directive| macro_name(directive.text)).unwrap_or_default()
            }
            token => token,
        };
        let text = Text::new(
            format!("`{token}` contains `__`, which GLSL keeps for itself."),
            format!("`{token}` に含まれる `__` は、GLSL 自身のために予約されています。"),
        );
        return Some(file.error(file.offset(line, column), token.len(), text));
    }
    None
}
