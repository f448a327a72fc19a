//! The `;` at the end of a statement: missing, or another sign in its place.

use super::ends_structure;
use crate::diagnostic::Diagnostic;
use crate::language::Text;
use crate::translate::hints::file::HintContext;
use crate::translate::hints::syntax::{in_brackets, is_operand_end};
use crate::translate::hints::tokens::LexemeKind;
use crate::translate::hints::vocabulary;

/// A `;` that is missing, at the end of the line that lacks it.
pub fn semicolon(file: &HintContext<'_>, at: usize, message: &str) -> Option<Diagnostic> {
    let mut before = at.checked_sub(1)?;
    let token = file.code.get(at)?;
    let line = |index: usize| file.line(file.code[index].start);
    // `a` ⏎ `++b` is read as `a++ b`.
    if matches!(file.code[before].text, "++" | "--") && before > 0 && line(before - 1) < line(before) {
        before -= 1;
    }
    let jump = matches!(file.code[before].text, "return" | "break" | "continue" | "discard") && token.text == "}";
    let structure = ends_structure(file, before);
    if file.code[before].text == "," && vocabulary::begins_statement(token.text) && !in_brackets(file, at) {
        let text = Text::new("There is a `,` where a `;` belongs.", "`;` を書くところに `,` があります。");
        return Some(file.error_at(before, text));
    }
    if !(message.contains("SEMICOLON") || jump || structure) {
        return None;
    }
    if token.text == "else" || matches!(token.text, ")" | "]") {
        return None;
    }
    if token.text == ":" {
        return Some(colon(file, at));
    }
    let word = file.code[before].text;
    let ends = is_operand_end(file, Some(before)) || matches!(word, "}" | "break" | "continue" | "return" | "discard");
    let next_line = line(before) < file.line(token.start) && !goes_on(file, at);
    let separate = next_line || vocabulary::begins_statement(token.text) || matches!(token.text, "{" | "}");
    if !ends || !separate {
        return None;
    }
    Some(missing_semicolon(file, before))
}

/// Says that the statement whose last word this is lacks its `;`.
pub(super) fn missing_semicolon(file: &HintContext<'_>, before: usize) -> Diagnostic {
    let word = file.code[before].text;
    let text = Text::new(
        format!("A `;` is missing at the end of this statement, after `{word}`."),
        format!("文の終わりの `;` がありません (`{word}` の後)。"),
    );
    let diagnostic = file.error_after(before, text);
    let Some(token) = file.code.get(before + 1) else { return diagnostic };
    diagnostic.hint(Text::new(
        format!("The compiler notices only at `{}` on line {}.", token.text, file.line(token.start)),
        format!("コンパイラが気付くのは次の `{}` ({} 行目) です。", token.text, file.line(token.start)),
    ))
}

/// Whether the statement of the line above goes on at the code token `at`: no statement begins with an operand that an
/// operator follows, or with a function whose only use is its value.
fn goes_on(file: &HintContext<'_>, at: usize) -> bool {
    let token = file.code[at];
    let next = file.word(Some(at + 1));
    let operand = matches!(token.kind, LexemeKind::Word | LexemeKind::Number) && !vocabulary::is_keyword(token.text);
    let value = vocabulary::is_function(file.interface.stage, token.text) && next == "(";
    value || (operand && matches!(next, "+" | "-" | "*" | "/" | ";" | ")" | ","))
}

fn colon(file: &HintContext<'_>, at: usize) -> Diagnostic {
    let next = file.word(Some(at + 1));
    if next == "=" {
        let text = Text::new("An assignment is written `=`, without `:`.", "代入は `:` を付けずに `=` と書きます。");
        return file.error_at(at, text);
    }
    let semantic = next.starts_with("SV_")
        || next == "register"
        || (next.len() > 2 && next.chars().all(|c| c.is_ascii_uppercase() || c.is_ascii_digit()));
    if semantic {
        let text = Text::new(
            format!("`: {next}` is HLSL: GLSL has no semantics after a name."),
            format!("`: {next}` は HLSL の書き方です。GLSL の宣言にセマンティクスはありません。"),
        );
        return file.error_at(at, text).hint(Text::new(
            "In GLSL, inputs and outputs are matched by name or `layout (location = …)`.",
            "GLSL では入出力を名前か `layout (location = …)` で対応付けます。",
        ));
    }
    let text = Text::new("There is a `:` where a `;` belongs.", "`;` を書くところに `:` があります。");
    file.error_at(at, text)
}
