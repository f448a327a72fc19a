//! Statements and declarations that do not end, do not begin or do not hold together.

mod semicolon;

pub use semicolon::semicolon;

use super::declarations::DeclarationKind;
use super::file::HintContext;
use super::syntax::{in_brackets, is_operand_end};
use super::tokens::LexemeKind;
use super::{brackets, names, suggestions, vocabulary};
use crate::diagnostic::Diagnostic;
use crate::language::Text;
use semicolon::missing_semicolon;

/// `const lspec = …`, `float f(x)`: a name without its type.
pub fn missing_type(file: &HintContext<'_>, at: usize) -> Option<Diagnostic> {
    let open = brackets::open_before(file, at).last().copied();
    let head = open.and_then(|open| open.checked_sub(1));
    let parameter = file.code.get(at)?.kind == LexemeKind::Word
        && matches!(file.word(at.checked_sub(1)), "(" | ",")
        && file.declarations.iter().any(|d| d.role == DeclarationKind::Function && Some(d.index) == head);
    let name = if parameter {
        at
    } else {
        let name = at.checked_sub(1)?;
        let qualifier = name.checked_sub(1).is_some_and(|before| vocabulary::is_qualifier(file.code[before].text));
        let plain = file.code[name].kind == LexemeKind::Word && !vocabulary::is_keyword(file.code[name].text);
        (qualifier && plain && matches!(file.word(Some(at)), "=" | ";")).then_some(name)?
    };
    let text = Text::new(
        format!("The type of `{}` is missing.", file.word(Some(name))),
        format!("`{}` の型がありません。", file.word(Some(name))),
    );
    Some(file.error_at(name, text).hint(Text::new(
        "A declaration names the type first: `vec4 a`, `float x`.",
        "宣言は `vec4 a` や `float x` のように型から書きます。",
    )))
}

/// `vec4 sample`, `float vec3`: a keyword where a name belongs.
pub fn keyword_as_name(file: &HintContext<'_>, at: usize) -> Option<Diagnostic> {
    let word = file.word(Some(at));
    let (before, token) = (file.code.get(at.checked_sub(1)?)?, file.code.get(at)?);
    let same_line = file.line(before.start) == file.line(token.start);
    if !(vocabulary::is_keyword(word) && vocabulary::is_type(before.text) && same_line) {
        return None;
    }
    let text = Text::new(
        format!("`{word}` is a word of the language and cannot be the name of a variable or function."),
        format!("`{word}` は GLSL のキーワードなので、変数や関数の名前にはできません。"),
    );
    Some(file.error_at(at, text).hint(Text::new(suggestions::ANOTHER_NAME[0], suggestions::ANOTHER_NAME[1])))
}

/// The `{` of a function that is missing, cut off by a `;`, or inside another function.
pub fn body(file: &HintContext<'_>, at: usize) -> Option<Diagnostic> {
    let before = at.checked_sub(1)?;
    let outside = brackets::open_before(file, at).is_empty();
    match (file.word(Some(before)), file.word(Some(at))) {
        (")", "{") if !outside && brackets::unclosed_brace(file).is_none() => {
            let name = file.opening(before)?.checked_sub(1)?;
            let text = Text::new(
                format!("The function `{}` is defined inside another function.", file.word(Some(name))),
                format!("関数 `{}` が別の関数の中で定義されています。", file.word(Some(name))),
            );
            Some(file.error_at(name, text).hint(Text::new(
                "GLSL defines functions outside each other: move it in front of the function that calls it.",
                "GLSL では関数の中に関数を定義できません。呼び出す関数より前の、関数の外に移してください。",
            )))
        }
        (";", "{") if outside && file.word(before.checked_sub(1)) == ")" => {
            let text = Text::new(
                "This `;` ends the function before its body begins.",
                "この `;` のため、本体の手前で関数の宣言が終わっています。",
            );
            Some(file.error_at(before, text).hint(Text::new(
                "The `{` of the body follows the `)` directly.",
                "関数の `)` の直後には本体の `{` を書きます。",
            )))
        }
        (")", _) if outside && is_function_head(file, before) => {
            let text =
                Text::new("The `{` of this function's body is missing.", "この関数の本体を始める `{` がありません。");
            Some(file.error_after(before, text))
        }
        _ => None,
    }
}

/// Whether the `)` at `close` ends the parameters of a function that is declared or defined there.
fn is_function_head(file: &HintContext<'_>, close: usize) -> bool {
    let name = file.opening(close).and_then(|open| open.checked_sub(1));
    file.declarations.iter().any(|d| d.role == DeclarationKind::Function && Some(d.index) == name)
}

/// A word that begins a declaration or statement and is none that GLSL knows there.
pub fn unknown_first_word(file: &HintContext<'_>, at: usize) -> Option<Diagnostic> {
    let token = file.code.get(at)?;
    let outside = brackets::open_before(file, at).is_empty();
    let structure = at.checked_sub(1).is_some_and(|before| ends_structure(file, before));
    if outside && !structure && token.kind == LexemeKind::Word && file.statement(at) == at {
        if !vocabulary::is_keyword(token.text) && file.word(Some(at + 1)) != "=" {
            return Some(names::unknown_type(file, at));
        }
        if let Some(swallowed) = file.swallowed("{") {
            return Some(swallowed);
        }
        let text = Text::new(
            format!("`{}` begins a statement outside any function.", token.text),
            format!("`{}` で始まる文が関数の外にあります。", token.text),
        );
        return Some(file.error_at(at, text).hint(Text::new(
            "Only declarations stand outside. Is the `{` or `}` of a function in the wrong place?",
            "関数の外に書けるのは宣言だけです。関数の `{` や `}` の位置を確かめてください。",
        )));
    }
    let first = at.checked_sub(1)?;
    // The name of a block stands behind its members.
    if outside && first.checked_sub(1).is_some_and(|close| ends_structure(file, close)) {
        return Some(missing_semicolon(file, first));
    }
    let before = file.code.get(file.statement(at)..first)?;
    let qualified = before.iter().all(|token| vocabulary::is_qualifier(token.text));
    let adjacent = file.code[first].kind == LexemeKind::Word && token.kind == LexemeKind::Word && qualified;
    let unknown =
        !vocabulary::is_keyword(file.code[first].text) && file.visible(file.code[first].text, token.start).is_none();
    (adjacent && unknown).then(|| names::unknown_type(file, first))
}

/// Whether the `}` at `close` ends a structure or a block.
fn ends_structure(file: &HintContext<'_>, close: usize) -> bool {
    if file.word(Some(close)) != "}" {
        return false;
    }
    let name = file.opening(close).and_then(|open| open.checked_sub(1));
    file.declarations.iter().any(|d| d.role == DeclarationKind::Structure && Some(d.index) == name)
}

/// An `if`, a loop or a number that is not written as it must be.
pub fn construct(file: &HintContext<'_>, at: usize) -> Option<Diagnostic> {
    let token = file.code.get(at)?;
    let (previous, word) = (file.code[at.checked_sub(1)?], token.text);
    if matches!(previous.text, "if" | "while" | "for" | "switch") {
        let text = Text::new(
            format!("What follows `{}` stands in parentheses.", previous.text),
            format!("`{}` の条件は括弧 `( )` で囲みます。", previous.text),
        );
        return Some(file.error_at(at, text));
    }
    if token.kind == LexemeKind::Number && word.matches('.').count() > 1 {
        let text = Text::new(format!("`{word}` is no number."), format!("`{word}` は数値として読めません。"));
        return Some(file.error_at(at, text));
    }
    if word == "else" {
        let text = Text::new("This `else` belongs to no `if`.", "この `else` に対応する `if` がありません。");
        return Some(file.error_at(at, text).hint(Text::new(
            "Between `if` and `else` stands one statement, or several in `{ }`; no `;` after the condition.",
            "`if` と `else` の間には文を 1 つだけ置くか、`{ }` で囲みます。条件の後に `;` は付けません。",
        )));
    }
    let for_header = word == ")" && in_brackets(file, at) && for_semicolons(file, at);
    if for_header {
        let text = Text::new("The `for` lacks a `;`.", "`for` の `;` が足りません。");
        return Some(file.error_at(at, text).hint(brackets::for_hint()));
    }
    None
}

/// An operator without an operand, or a type without a name.
pub fn nothing_between(file: &HintContext<'_>, at: usize) -> Option<Diagnostic> {
    let before = at.checked_sub(1)?;
    let token = file.code.get(at)?;
    let (previous, word) = (file.code[before], token.text);
    if vocabulary::is_type(previous.text) && matches!(word, "=" | ";" | ",") {
        let text = Text::new(
            format!("The name is missing after the type `{}`.", previous.text),
            format!("型 `{}` の後に変数名がありません。", previous.text),
        );
        return Some(file.error_after(before, text));
    }
    let operator =
        previous.kind == LexemeKind::Sign && !matches!(previous.text, ")" | "]" | "}" | ";" | "{" | "++" | "--");
    if operator && token.kind == LexemeKind::Sign {
        let text = Text::new(
            format!("Something is missing between `{}` and `{word}`.", previous.text),
            format!("`{}` と `{word}` の間に式がありません。", previous.text),
        );
        // The operator is what is left over, also where its operand would stand on the next line.
        return Some(file.error_at(before, text).hint(Text::new(
            format!("An operand belongs after `{}`, or it is one too many.", previous.text),
            format!("`{}` の後に値を書くか、余分な `{}` を消してください。", previous.text, previous.text),
        )));
    }
    None
}

/// Two operands without an operator.
pub fn operands(file: &HintContext<'_>, at: usize) -> Option<Diagnostic> {
    let before = at.checked_sub(1)?;
    let token = file.code.get(at)?;
    let (previous, word) = (file.code[before], token.text);
    let inside = in_brackets(file, at);
    let starts = matches!(token.kind, LexemeKind::Word | LexemeKind::Number) || word == "(";
    if !(is_operand_end(file, Some(before)) && starts) {
        return None;
    }
    let text = if inside {
        Text::new(
            format!("A comma or an operator is missing between `{}` and `{word}`.", previous.text),
            format!("`{}` と `{word}` の間にコンマか演算子がありません。", previous.text),
        )
    } else {
        Text::new(
            format!("An operator is missing between `{}` and `{word}`.", previous.text),
            format!("`{}` と `{word}` の間に演算子がありません。", previous.text),
        )
    };
    let hint = Text::new("GLSL multiplies only where a `*` is written.", "GLSL では掛け算の `*` を省略できません。");
    let diagnostic = file.error_at(at, text);
    Some(match suggestions::from_elsewhere(file, word) {
        Some(hint) => diagnostic.hint(hint),
        None if inside => diagnostic,
        None => diagnostic.hint(hint),
    })
}

/// Whether the bracket open at `at` is that of a `for` with fewer than two `;`.
fn for_semicolons(file: &HintContext<'_>, at: usize) -> bool {
    let Some(open) = brackets::open_before(file, at).last().copied() else { return false };
    let count = file.code[open..at].iter().filter(|token| token.text == ";").count();
    file.word(open.checked_sub(1)) == "for" && count < 2
}
