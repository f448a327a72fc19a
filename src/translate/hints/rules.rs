//! What GLSL does not allow with names, functions and declarations that it knows.

use super::declarations::Role;
use super::file::File;
use super::tokens::Kind;
use super::{Finding, mismatch, names, types, vocabulary};
use crate::diagnostic::Diagnostic;
use crate::language::Text;

/// Puts a broken rule into words.
pub fn explain(file: &File<'_>, finding: &Finding<'_, '_>) -> Option<Diagnostic> {
    let message = finding.entry.message;
    if message.starts_with("l-value required") {
        return Some(not_assignable(file, finding));
    }
    if message.starts_with("redefinition") || message.starts_with("function already has a body") {
        return Some(redefinition(file, finding));
    }
    if message.starts_with("l-value of swizzle cannot have duplicate") {
        let text = Text::new(
            "A component stands twice on the left side of this assignment.",
            "代入の左辺に同じ成分が 2 回書かれています。",
        );
        return Some(file.error_at(finding.index, text));
    }
    if finding.entry.token == "return" || message.contains("does not return a value") {
        return returned(file, finding);
    }
    alien(file, finding).or_else(|| declaration(file, finding)).or_else(|| version(file, finding))
}

fn not_assignable(file: &File<'_>, finding: &Finding<'_, '_>) -> Diagnostic {
    let base = assigned(file, finding.index).unwrap_or(finding.index);
    let name = file.word(Some(base));
    let message = finding.entry.message;
    let declared = file.code.get(base).and_then(|token| file.visible(name, token.start));
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
fn assigned(file: &File<'_>, index: usize) -> Option<usize> {
    let operator = file.word(Some(index));
    let mut at = index.checked_sub(1)?;
    if matches!(operator, "++" | "--") && file.code[at].kind != Kind::Word && file.code[at].text != "]" {
        return Some(index + 1);
    }
    loop {
        if file.code[at].text == "]" {
            at = file.opening(at)?.checked_sub(1)?;
        } else if at >= 2 && file.code[at - 1].text == "." {
            at -= 2;
        } else {
            return (file.code[at].kind == Kind::Word).then_some(at);
        }
    }
}

fn redefinition(file: &File<'_>, finding: &Finding<'_, '_>) -> Diagnostic {
    let name = finding.entry.token;
    // The compiler names a function where its parameters end.
    let here = file.declarations.iter().filter(|d| d.name == name && d.index <= finding.index).next_back();
    let index = here.map_or(finding.index, |d| d.index);
    let start = file.code.get(index).map_or(0, |token| token.start);
    let is_function = here.is_some_and(|d| d.role == Role::Function);
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

fn returned(file: &File<'_>, finding: &Finding<'_, '_>) -> Option<Diagnostic> {
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
    let from = types::of_expression(file, file.code.get(at + 1..end)?).map(|ty| ty.to_string());
    let function = file.declarations.iter().filter(|d| d.role == Role::Function && d.index < at).next_back()?;
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

/// Things of other languages.
fn alien(file: &File<'_>, finding: &Finding<'_, '_>) -> Option<Diagnostic> {
    let token = finding.entry.token;
    let message = finding.entry.message;
    let (text, hint) = match token {
        "string literal" | "'" | "string" => (
            Text::new("GLSL has no strings or characters in quotes.", "GLSL に文字列や文字のリテラルはありません。"),
            Some(Text::new(
                "Nothing can be printed from a shader either: names are written without quotes.",
                "シェーダから文字を出力することもできません。変数名は引用符を付けずに書きます。",
            )),
        ),
        "::" => (
            Text::new(
                "GLSL has no namespaces: `::` is C++.",
                "`::` は C++ の書き方です。GLSL に名前空間はありません。",
            ),
            Some(Text::new(
                "Write the function's name alone, such as `max`.",
                "`max` のように関数名だけを書いてください。",
            )),
        ),
        "explicit typecast" => (
            Text::new("GLSL has no casts such as `(float) x`.", "GLSL に `(float) x` のようなキャストはありません。"),
            Some(Text::new(
                "A conversion is written like a call: `float(x)`.",
                "型の変換は `float(x)` のように関数の形で書きます。",
            )),
        ),
        "{ } style initializers" => (
            Text::new(
                "Lists in braces need `#version 420` or newer.",
                "`{ }` による初期化は `#version 420` 以降の機能です。",
            ),
            Some(Text::new(
                "In older versions a constructor makes an array: `float[3](1.0, 2.0, 3.0)`.",
                "それより前の版では `float[3](1.0, 2.0, 3.0)` のようにコンストラクタを使います。",
            )),
        ),
        "\\" => (Text::new("A `\\` cannot stand in code.", "コードの中に `\\` は書けません。"), None),
        _ if message.starts_with("unexpected token") => (
            Text::new(
                format!("The character `{token}` has no meaning in GLSL."),
                format!("`{token}` は GLSL では使えない文字です。"),
            ),
            None,
        ),
        _ => return None,
    };
    let diagnostic = file.error_at(finding.index, text);
    Some(match hint {
        Some(hint) => diagnostic.hint(hint),
        None => diagnostic,
    })
}

/// Declarations that are not allowed.
fn declaration(file: &File<'_>, finding: &Finding<'_, '_>) -> Option<Diagnostic> {
    let token = finding.entry.token;
    let message = finding.entry.message;
    let about = |start: &str| message.starts_with(start);
    let (text, hint) = if about("Reserved word") {
        (
            Text::new(
                format!("`{token}` is a word that GLSL keeps for itself; it cannot be a name."),
                format!("`{token}` は GLSL の予約語なので、名前には使えません。"),
            ),
            Some(names::another_name()),
        )
    } else if about("identifiers starting with \"gl_\"") {
        (
            Text::new(
                format!("`{token}`: names that begin with `gl_` belong to GLSL itself."),
                format!("`{token}` のように `gl_` で始まる名前は、GLSL 自身のために予約されています。"),
            ),
            Some(names::another_name()),
        )
    } else if about("variables with qualifier 'const' must be initialized") {
        (
            Text::new(format!("The constant `{token}` has no value."), format!("定数 `{token}` に値がありません。")),
            Some(Text::new("A constant gets its value where it is declared.", "定数の値は宣言と同時に指定します。")),
        )
    } else if about("global const initializers must be constant") {
        (
            Text::new(
                "The value of a global constant must be known when the shader is compiled.",
                "グローバルな定数の値は、コンパイル時に決まっていなければなりません。",
            ),
            Some(Text::new(
                "Inputs and uniforms have no value yet there: compute it in `main`.",
                "入力変数や uniform 変数の値はそこではまだ使えません。`main` の中で計算してください。",
            )),
        )
    } else if finding.entry.token == "non-constant initializer" {
        (
            Text::new(
                "Before GLSL 4.20, the value of a `const` must be known when the shader is compiled.",
                "GLSL 4.20 より前では、`const` の値はコンパイル時に決まっていなければなりません。",
            ),
            Some(Text::new("Leave out the `const` here.", "ここでは `const` を付けずに宣言してください。")),
        )
    } else if about("not allowed in nested scope") {
        (
            Text::new(
                format!("`{token}` variables are declared outside functions."),
                format!("`{token}` 変数は関数の外で宣言します。"),
            ),
            None,
        )
    } else if about("float literal needs a decimal point") {
        (
            Text::new(
                "A number that ends with `f` needs a decimal point: `1.0f`.",
                "末尾に `f` を付ける数値には `1.0f` のように小数点が必要です。",
            ),
            None,
        )
    } else if about("entry point cannot return a value") || about("function cannot take any parameter") {
        (Text::new("`main` is declared as `void main()`.", "`main` は `void main()` と宣言します。"), None)
    } else {
        return None;
    };
    let diagnostic = file.error_at(finding.index, text);
    Some(match hint {
        Some(hint) => diagnostic.hint(hint),
        None => diagnostic,
    })
}

/// What another `#version` has.
fn version(file: &File<'_>, finding: &Finding<'_, '_>) -> Option<Diagnostic> {
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
pub fn warn(file: &File<'_>, finding: &Finding<'_, '_>) -> Option<Diagnostic> {
    let message = finding.entry.message;
    let (line, column) = finding.entry.place?;
    if finding.entry.token == "line continuation" {
        let text = Text::new(
            "A line continued with `\\` belongs to GLSL 4.20 and later; some drivers refuse it here.",
            "行末の `\\` による行の継続は GLSL 4.20 以降の機能です。ドライバによってはエラーになります。",
        );
        return Some(file.error(file.offset(line, column), 1, text));
    }
    let word = message.split_ascii_whitespace().next().unwrap_or_default();
    if message.contains("deprecated in version") && vocabulary::is_qualifier(word) {
        let (old, new) = (word, if word == "varying" { "out" } else { "in" });
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
        let token = finding.entry.token;
        let text = Text::new(
            format!("`{token}` contains `__`, which GLSL keeps for itself."),
            format!("`{token}` に含まれる `__` は、GLSL 自身のために予約されています。"),
        );
        return Some(file.error_at(finding.index, text));
    }
    None
}
