//! Brackets that do not match, and which of them is to blame.

use super::file::HintContext;
use crate::diagnostic::Diagnostic;
use crate::language::Text;

/// The brackets that are open in front of the code token `index`, outermost first.
pub fn open_before(file: &HintContext<'_>, index: usize) -> Vec<usize> {
    let mut open: Vec<usize> = Vec::new();
    for (at, token) in file.code[..index.min(file.code.len())].iter().enumerate() {
        match token.text {
            "(" | "[" | "{" => open.push(at),
            ")" | "]" | "}" => {
                open.pop();
            }
            _ => {}
        }
    }
    open
}

/// The `{` that lacks its `}`, if the file has more of the one than of the other.
///
/// Counting alone blames the outermost one: the `}` of `main` closes the `if` in it. Indentation says more: a `}` that
/// stands further left than the line of its `{` belongs to another.
pub fn unclosed_brace(file: &HintContext<'_>) -> Option<usize> {
    let mut open = Vec::new();
    let mut stepped_over = None;
    for (at, token) in file.code.iter().enumerate() {
        match token.text {
            "{" => open.push(at),
            "}" => {
                let start = open.pop()?;
                let inner = file.indentation(file.code[start].start);
                if file.indentation(token.start) < inner && stepped_over.is_none() {
                    stepped_over = Some(start);
                }
            }
            _ => {}
        }
    }
    let unclosed = *open.last()?;
    Some(stepped_over.unwrap_or(unclosed))
}

/// Whether the file has more `}` than `{`.
fn closes_too_often(file: &HintContext<'_>) -> bool {
    let count = |text| file.code.iter().filter(|token| token.text == text).count();
    count("}") > count("{")
}

/// The `}` that ended the function too early, if the parser gave up outside any function at the code token `at`.
pub fn stray_brace(file: &HintContext<'_>, at: usize) -> Option<usize> {
    let outside = open_before(file, at).is_empty() && closes_too_often(file);
    file.code[..at].iter().rposition(|token| token.text == "}").filter(|_| outside)
}

/// What brackets have to do with the parser's giving up at the code token `at`.
pub fn explain(file: &HintContext<'_>, at: usize) -> Option<Diagnostic> {
    let open = open_before(file, at);
    let unexpected = file.word(Some(at));
    let innermost = open.last().copied();
    let opening = file.word(innermost);
    match unexpected {
        "" => match opening {
            "(" | "[" => Some(unclosed(file, innermost?)),
            _ => unclosed_brace(file).map(|brace| unclosed(file, brace)),
        },
        ")" | "]" if opening.is_empty() || opening == "{" => Some(extra(file, at)),
        ")" if opening == "[" => Some(unclosed(file, innermost?)),
        "]" if opening == "(" => Some(unclosed(file, innermost?)),
        "}" if open.is_empty() => Some(extra(file, at)),
        "}" | "{" if matches!(opening, "(" | "[") => Some(unclosed(file, innermost?)),
        ";" if matches!(opening, "(" | "[") => Some(unclosed_at_semicolon(file, innermost?, at)),
        "{" if !open.is_empty() => unclosed_brace(file).map(|brace| unclosed(file, brace)),
        "else" if unclosed_brace(file).is_some() => Some(unclosed(file, unclosed_brace(file)?)),
        _ if stray_brace(file, at).is_some() => Some(extra(file, stray_brace(file, at)?)),
        _ if matches!(opening, "(" | "[") && statement_begins(file, at) => Some(unclosed(file, innermost?)),
        _ => None,
    }
}

/// Whether a new line at the code token `at` begins another statement: a declaration or an assignment.
fn statement_begins(file: &HintContext<'_>, at: usize) -> bool {
    let line = |index: usize| file.line(file.code[index].start);
    let fresh = at > 0 && at < file.code.len() && line(at) > line(at - 1);
    fresh && (super::vocabulary::begins_statement(file.code[at].text) || file.word(Some(at + 1)) == "=")
}

fn unclosed_at_semicolon(file: &HintContext<'_>, open: usize, at: usize) -> Diagnostic {
    if file.word(open.checked_sub(1)) != "for" {
        return unclosed(file, open);
    }
    let text = Text::new(
        "The parentheses of this `for` hold exactly two `;`.",
        "この `for` の括弧の中に書く `;` はちょうど 2 つです。",
    );
    file.error_at(at, text).hint(for_hint())
}

/// How a `for` is written.
pub fn for_hint() -> Text {
    Text::new(
        "A loop is written `for (int i = 0; i < n; ++i)`: three parts with `;` between them.",
        "ループは `for (int i = 0; i < n; ++i)` のように、3 つの部分を `;` で区切って書きます。",
    )
}

fn partner(bracket: &str) -> &'static str {
    match bracket {
        "(" => ")",
        "[" => "]",
        "{" => "}",
        ")" => "(",
        "]" => "[",
        _ => "{",
    }
}

fn unclosed(file: &HintContext<'_>, open: usize) -> Diagnostic {
    let bracket = file.code[open].text;
    let close = partner(bracket);
    let text = Text::new(
        format!("This `{bracket}` is never closed: a `{close}` is missing."),
        format!("この `{bracket}` に対応する `{close}` がありません。"),
    );
    let hint = if bracket == "{" {
        Text::new(
            "Count the braces from here to the end of the file: every `{` needs its own `}`.",
            "ここからファイルの終わりまで括弧の対応を数えてみてください。`{` にはそれぞれ対応する `}` が必要です。",
        )
    } else {
        Text::new(
            format!("Every `{bracket}` of the expression needs its own `{close}`. Where should this one end?"),
            format!(
                "式の中の `{bracket}` にはそれぞれ `{close}` が必要です。この括弧をどこで閉じるか確かめてください。"
            ),
        )
    };
    file.error_at(open, text).hint(hint)
}

fn extra(file: &HintContext<'_>, close: usize) -> Diagnostic {
    // The brace that is missing may stand in a comment that was never ended.
    if let Some(swallowed) = file.swallowed("{").filter(|_| file.code[close].text == "}") {
        return swallowed;
    }
    let bracket = file.code[close].text;
    let open = partner(bracket);
    let text = Text::new(
        format!("This `{bracket}` closes nothing: there is no `{open}` for it."),
        format!("この `{bracket}` に対応する `{open}` がありません。"),
    );
    file.error_at(close, text).hint(Text::new(
        format!("Either this `{bracket}` is one too many, or a `{open}` is missing before it."),
        format!("`{bracket}` が 1 つ多いか、これより前に `{open}` が足りません。"),
    ))
}
