//! What GLSL does not allow with names, functions and declarations that it knows.

use super::declarations::{DeclarationKind, DeclaredName};
use super::file::HintContext;
use super::tokens::LexemeKind;
use super::{CompilerMessage, brackets, disallowed, expression, mismatch};
use crate::diagnostic::Diagnostic;
use crate::language::Text;

/// Puts a broken rule into words.
pub fn explain(file: &HintContext<'_>, finding: &CompilerMessage<'_, '_>) -> Option<Diagnostic> {
    let message = finding.entry.message;
    if message.starts_with("l-value required") {
        return Some(not_assignable(file, finding));
    }
    if message.starts_with("redefinition") || message.starts_with("function already has a body") {
        return Some(redefinition(file, finding));
    }
    if finding.entry.token == "return" || message.contains("does not return a value") {
        return returned(file, finding);
    }
    if message.starts_with("must be qualified as flat") {
        return Some(not_interpolated(file, finding));
    }
    disallowed::explain(file, finding)
}

/// An input of whole numbers that is not `flat`.
fn not_interpolated(file: &HintContext<'_>, finding: &CompilerMessage<'_, '_>) -> Diagnostic {
    let token = finding.entry.token;
    let is_it = |d: &&DeclaredName<'_>| d.index > finding.index || d.ty == token && d.index == finding.index;
    let own = file.declarations.iter().filter(|d| d.global).find(is_it);
    let (ty, name) = own.map_or((token, "…"), |own| (own.ty.as_str(), own.name));
    let text = Text::new(
        format!("Nothing lies between whole numbers: an input of type `{ty}` has to be `flat`."),
        format!("整数は補間できません。`{ty}` 型の入力変数には `flat` が必要です。"),
    );
    let diagnostic = file.error_at(own.map_or(finding.index, |own| own.index), text);
    diagnostic.hint(Text::new(
        format!("Write `flat in {ty} {name};` here and `flat out {ty} {name};` in the vertex shader."),
        format!("ここでは `flat in {ty} {name};`、頂点シェーダでは `flat out {ty} {name};` と宣言してください。"),
    ))
}

fn not_assignable(file: &HintContext<'_>, finding: &CompilerMessage<'_, '_>) -> Diagnostic {
    let operator = file.word(Some(finding.index));
    if !(operator.ends_with('=') || matches!(operator, "++" | "--")) {
        let open = brackets::open_before(file, finding.index).last().copied();
        let call = open.and_then(|open| open.checked_sub(1)).unwrap_or(finding.index);
        let text = Text::new(
            format!(
                "`{}` writes into this argument (`out`), so it must be a variable of your own.",
                file.word(Some(call))
            ),
            format!(
                "`{}` はこの引数に値を書き込む (`out`) ので、書き換えられる変数を渡してください。",
                file.word(Some(call))
            ),
        );
        return file.error_at(call, text);
    }
    let Some(base) = assigned(file, finding.index) else {
        let text = Text::new(
            "What stands left of the assignment cannot be assigned to.",
            "代入の左辺に書けるのは変数だけです。",
        );
        return file.error_at(finding.index, text);
    };
    let name = file.word(Some(base));
    let message = finding.entry.message;
    let declared = file.code.get(base).and_then(|token| file.visible(name, token.start));
    if let Some(own) = declared.filter(|d| d.global && file.interface.is_output(d.name)) {
        return super::link::output_missing_as(file, own);
    }
    let line = declared.map(|d| file.line(d.start));
    let (en, ja) = if message.contains("shader input") {
        ("an input of the shader", "シェーダの入力変数")
    } else if message.contains("a uniform") {
        ("a uniform", "uniform 変数")
    } else if message.contains("a const") {
        if declared.is_none() {
            let text = Text::new(
                "What stands left of the assignment cannot be assigned to.",
                "代入の左辺に書けるのは変数だけです。",
            );
            return file.error_at(base, text);
        }
        ("a constant", "定数")
    } else {
        let text =
            Text::new(format!("`{name}` cannot be assigned to."), format!("`{name}` に代入することはできません。"));
        return file.error_at(base, text);
    };
    let text = Text::new(
        format!("`{name}` is {en} and cannot be changed."),
        format!("`{name}` は{ja}なので、値を変更できません。"),
    );
    let hint = match line {
        Some(line) => Text::new(
            format!("It is declared on line {line}. Put the new value into a variable of your own."),
            format!("{line} 行目で宣言されています。新しい値は自分で宣言した変数に入れてください。"),
        ),
        None => Text::new(
            "Put the new value into a variable of your own.",
            "新しい値は自分で宣言した変数に入れてください。",
        ),
    };
    file.error_at(base, text).hint(hint)
}

/// The index of the name that the operator at `index` changes: `cv` in `cv.xyz[0] = …`.
fn assigned(file: &HintContext<'_>, index: usize) -> Option<usize> {
    let operator = file.word(Some(index));
    let mut at = index.checked_sub(1)?;
    if matches!(operator, "++" | "--") && file.code[at].kind != LexemeKind::Word && file.code[at].text != "]" {
        return Some(index + 1);
    }
    loop {
        if file.code[at].text == "]" {
            at = file.opening(at)?.checked_sub(1)?;
        } else if at >= 2 && file.code[at - 1].text == "." {
            at -= 2;
        } else {
            return (file.code[at].kind == LexemeKind::Word).then_some(at);
        }
    }
}

fn redefinition(file: &HintContext<'_>, finding: &CompilerMessage<'_, '_>) -> Diagnostic {
    let name = finding.entry.token;
    // The compiler names a function where its parameters end.
    let here = file.declarations.iter().rfind(|d| d.name == name && d.index <= finding.index);
    let index = here.map_or(finding.index, |d| d.index);
    let start = file.code.get(index).map_or(0, |token| token.start);
    let is_function = here.is_some_and(|d| d.role == DeclarationKind::Function);
    let first = file.declarations.iter().find(|d| d.name == name && d.start < start && d.is_visible(start));
    let text = if is_function {
        Text::new(
            format!("The function `{name}` is defined twice."),
            format!("関数 `{name}` が 2 回定義されています。"),
        )
    } else {
        Text::new(format!("`{name}` is declared twice."), format!("`{name}` が 2 回宣言されています。"))
    };
    let diagnostic = file.error_at(index, text);
    let Some(first) = first else { return diagnostic };
    let line = file.line(first.start);
    let outside = here.is_some_and(|d| d.global);
    diagnostic.hint(if is_function || outside {
        Text::new(
            format!("The first one is on line {line}. Give one of them another name, or remove it."),
            format!("最初のものは {line} 行目にあります。どちらかの名前を変えるか、消してください。"),
        )
    } else {
        Text::new(
            format!("It is declared on line {line} already. To give it another value, leave out the type here."),
            format!("{line} 行目ですでに宣言されています。値を代入し直すだけなら、ここの型名は要りません。"),
        )
    })
}

fn returned(file: &HintContext<'_>, finding: &CompilerMessage<'_, '_>) -> Option<Diagnostic> {
    let message = finding.entry.message;
    let at = finding.index;
    if message.starts_with("void function cannot return a value") {
        let text = Text::new("A `void` function returns no value.", "`void` 型の関数は値を返せません。");
        return Some(file.error_at(at, text).hint(Text::new(
            "Write `return;` or nothing: `main` gives its results in output variables.",
            "`return;` とするか、`return` を書かないでください。`main` の結果は出力変数に代入します。",
        )));
    }
    if message.contains("non-void function must return a value") {
        let text = Text::new("This `return` lacks its value.", "この `return` に返す値がありません。");
        return Some(file.error_at(at, text));
    }
    if message.contains("does not return a value") {
        let text = Text::new("This function ends without `return`.", "この関数は値を `return` せずに終わっています。");
        return Some(file.error_at(at, text));
    }
    let end = (at..file.code.len()).find(|&end| file.code[end].text == ";")?;
    let from = expression::type_of(file, file.code.get(at + 1..end)?).map(|ty| ty.to_string());
    let function = file.declarations.iter().rfind(|d| d.role == DeclarationKind::Function && d.index < at)?;
    let (name, to) = (function.name, &function.ty);
    let text = match &from {
        Some(from) => Text::new(
            format!("`{name}` returns {to}, and this value has type {from}."),
            format!("`{name}` の戻り値の型は {to} ですが、この値は {from} です。"),
        ),
        None => Text::new(
            format!("The value is not of the type {to} that `{name}` returns."),
            format!("値が `{name}` の戻り値の型 {to} と合っていません。"),
        ),
    };
    let diagnostic = file.error_at(at, text);
    Some(match from.and_then(|from| mismatch::conversion_hint(&from, to)) {
        Some(hint) => diagnostic.hint(hint),
        None => diagnostic,
    })
}
