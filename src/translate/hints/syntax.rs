//! Where the parser gave up, and what it stumbled over.

use super::declarations::Role;
use super::file::File;
use super::tokens::Kind;
use super::{Finding, brackets, names, vocabulary};
use crate::diagnostic::Diagnostic;
use crate::language::Text;

/// The index of the token at which the parser gave up at byte `offset`: it counts to the end of a token, and one
/// further where a line ends there.
pub fn unexpected_token(file: &File<'_>, offset: usize) -> usize {
    let index = file.index_at(offset);
    let before = index.checked_sub(1).filter(|&before| file.code[before].end() == offset);
    let inside = file.code.get(index).is_some_and(|token| token.start <= offset);
    before.filter(|_| !inside).unwrap_or(index)
}

/// Puts a syntax error into words.
pub fn explain(file: &File<'_>, finding: &Finding<'_, '_>) -> Option<Diagnostic> {
    if !finding.entry.is_syntax_error() {
        return None;
    }
    let at = finding.index;
    let found = alien_sign(file, at)
        .or_else(|| macro_with_semicolon(file, at))
        .or_else(|| keyword_as_name(file, at))
        .or_else(|| brackets::explain(file, at))
        .or_else(|| body(file, at))
        .or_else(|| unknown_first_word(file, at))
        .or_else(|| semicolon(file, at, finding.entry.message))
        .or_else(|| operand(file, at));
    Some(found.unwrap_or_else(|| unexpected(file, at)))
}

fn unexpected(file: &File<'_>, at: usize) -> Diagnostic {
    let text = match file.word(Some(at)) {
        "" => Text::new("The file ends too early.", "ファイルが途中で終わっています。"),
        word => Text::new(
            format!("`{word}` cannot stand here: syntax error."),
            format!("ここに `{word}` を書くことはできません (構文エラー)。"),
        ),
    };
    file.error_at(at, text).hint(Text::new(
        "The mistake is here or just before it: look for a missing operator, comma, bracket or `;`.",
        "間違いはここか、そのすぐ前にあります。演算子、コンマ、括弧、`;` が抜けていないか確かめてください。",
    ))
}

/// Signs that mean something in other languages.
fn alien_sign(file: &File<'_>, at: usize) -> Option<Diagnostic> {
    let before = at.checked_sub(1);
    let (previous, sign, next) = (file.word(before), file.word(Some(at)), file.word(Some(at + 1)));
    let touches = |a: usize, b: usize| file.code.get(a).zip(file.code.get(b)).is_some_and(|(a, b)| a.end() == b.start);
    match sign {
        "*" if previous == "*" && touches(at - 1, at) => Some(
            file.error_at(at, Text::new("GLSL has no operator `**`.", "GLSL に演算子 `**` はありません。"))
                .hint(Text::new("The power of a number is `pow(x, y)`.", "べき乗は `pow(x, y)` で計算します。")),
        ),
        "*" if next == "/" && touches(at, at + 1) => Some(
            file.error_at(at, Text::new("This `*/` ends no comment.", "この `*/` に対応する `/*` がありません。"))
                .hint(Text::new(
                    "A comment begins with `/*`, and comments do not nest: the first `*/` ends it.",
                    "コメントは `/*` で始めます。コメントを入れ子にすることはできず、最初の `*/` で終わります。",
                )),
        ),
        "*" | "&" if vocabulary::is_type(previous) || !is_operand_end(file, before) => Some(
            file.error_at(
                at,
                Text::new("GLSL has no pointers and no addresses.", "GLSL にはポインタもアドレス演算子もありません。"),
            )
            .hint(Text::new(
                "Write the name alone. A function gives back more than one value through `out` parameters.",
                "変数名だけを書いてください。複数の値を返す関数には `out` 引数を使います。",
            )),
        ),
        "<<" | ">>" | "==" if next == sign && touches(at, at + 1) => Some(
            file.error_at(at, Text::new("This line marks a merge conflict.", "この行はマージの衝突を示す印です。"))
                .hint(Text::new(
                    "Keep one of the two versions, and delete the lines `<<<<<<<`, `=======` and `>>>>>>>`.",
                    "どちらか一方の内容を残し、`<<<<<<<`、`=======`、`>>>>>>>` の行を消してください。",
                )),
        ),
        "->" => Some(file.error_at(at, Text::new("GLSL has no `->`.", "GLSL に `->` はありません。")).hint(Text::new(
            "Components and members are taken with a dot: `v.xyz`.",
            "成分やメンバは `v.xyz` のようにドットで取り出します。",
        ))),
        "/" if !is_operand_end(file, before) => Some(
            file.error_at(at, Text::new("A single `/` begins no comment.", "`/` 1 つではコメントになりません。")).hint(
                Text::new(
                    "A comment begins with `//`, or stands between `/*` and `*/`.",
                    "コメントは `//` で始めるか、`/*` と `*/` で囲みます。",
                ),
            ),
        ),
        _ => None,
    }
}

/// Whether an expression can end with the code token `index`.
fn is_operand_end(file: &File<'_>, index: Option<usize>) -> bool {
    let Some(token) = index.and_then(|index| file.code.get(index)) else { return false };
    match token.kind {
        Kind::Word => !vocabulary::is_keyword(token.text) || matches!(token.text, "true" | "false"),
        Kind::Number => true,
        _ => matches!(token.text, ")" | "]" | "++" | "--"),
    }
}

/// A macro whose text ends with `;`, used where the parser gave up.
fn macro_with_semicolon(file: &File<'_>, at: usize) -> Option<Diagnostic> {
    let line = file.line(file.code.get(at)?.start);
    let used = |line_text: &&super::tokens::Token<'_>| {
        let name = super::file::macro_name(line_text.text).unwrap_or_default();
        let near = file.code[..=at].iter().rev().take_while(|token| file.line(token.start) == line);
        near.into_iter().any(|token| token.text == name)
    };
    let define = file.directives.iter().filter(used).find(|define| define.text.trim_end().ends_with(';'))?;
    let name = super::file::macro_name(define.text)?;
    let last = define.start + define.text.trim_end().len() - 1;
    let text = Text::new(
        format!("The macro `{name}` ends with `;`, and line {line} puts that `;` into the middle of a statement."),
        format!("マクロ `{name}` の定義が `;` で終わっているので、{line} 行目では文の途中に `;` が入ります。"),
    );
    Some(file.error(last, 1, text).hint(Text::new(
        "A `#define` line is copied as it stands: it takes no `;` at its end.",
        "`#define` の内容はそのまま置き換えられます。行末に `;` を付けません。",
    )))
}

/// `vec4 sample`, `float vec3`: a keyword where a name belongs.
fn keyword_as_name(file: &File<'_>, at: usize) -> Option<Diagnostic> {
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
    Some(file.error_at(at, text).hint(names::another_name()))
}

/// The `{` of a function that is missing, cut off by a `;`, or inside another function.
fn body(file: &File<'_>, at: usize) -> Option<Diagnostic> {
    let before = at.checked_sub(1)?;
    let outside = brackets::open_before(file, at).is_empty();
    match (file.word(Some(before)), file.word(Some(at))) {
        (")", "{") if !outside => {
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
fn is_function_head(file: &File<'_>, close: usize) -> bool {
    let name = file.opening(close).and_then(|open| open.checked_sub(1));
    file.declarations.iter().any(|d| d.role == Role::Function && Some(d.index) == name)
}

/// A word that begins a declaration or statement and is none that GLSL knows there.
fn unknown_first_word(file: &File<'_>, at: usize) -> Option<Diagnostic> {
    let token = file.code.get(at)?;
    let outside = brackets::open_before(file, at).is_empty();
    if outside && token.kind == Kind::Word && file.statement(at) == at {
        if !vocabulary::is_keyword(token.text) && file.word(Some(at + 1)) != "=" {
            return Some(names::unknown_type(file, at));
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
    let adjacent = file.code[first].kind == Kind::Word && token.kind == Kind::Word && file.statement(at) == first;
    let unknown =
        !vocabulary::is_keyword(file.code[first].text) && file.visible(file.code[first].text, token.start).is_none();
    (adjacent && unknown).then(|| names::unknown_type(file, first))
}

/// A `;` that is missing, at the end of the line that lacks it.
fn semicolon(file: &File<'_>, at: usize, message: &str) -> Option<Diagnostic> {
    let mut before = at.checked_sub(1)?;
    let token = file.code.get(at)?;
    let line = |index: usize| file.line(file.code[index].start);
    // `a` ⏎ `++b` is read as `a++ b`.
    if matches!(file.code[before].text, "++" | "--") && before > 0 && line(before - 1) < line(before) {
        before -= 1;
    }
    if !message.contains("SEMICOLON") {
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
    let next_line = line(before) < file.line(token.start);
    let separate = next_line || vocabulary::begins_statement(token.text) || matches!(token.text, "{" | "}");
    if !ends || !separate {
        return None;
    }
    let text = Text::new(
        format!("A `;` is missing at the end of this statement, after `{word}`."),
        format!("文の終わりの `;` がありません (`{word}` の後)。"),
    );
    Some(file.error_after(before, text).hint(Text::new(
        format!("The compiler notices only at `{}` on line {}.", token.text, file.line(token.start)),
        format!("コンパイラが気付くのは次の `{}` ({} 行目) です。", token.text, file.line(token.start)),
    )))
}

fn colon(file: &File<'_>, at: usize) -> Diagnostic {
    let next = file.word(Some(at + 1));
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

/// Two operands without an operator, or an operator without an operand.
fn operand(file: &File<'_>, at: usize) -> Option<Diagnostic> {
    let before = at.checked_sub(1)?;
    let token = file.code.get(at)?;
    let (previous, word) = (file.code[before], token.text);
    let inside = matches!(file.word(brackets::open_before(file, at).last().copied()), "(" | "[");
    if word == "else" {
        let text = Text::new("This `else` belongs to no `if`.", "この `else` に対応する `if` がありません。");
        return Some(file.error_at(at, text).hint(Text::new(
            "Between `if` and `else` stands one statement, or several in `{ }`; no `;` after the condition.",
            "`if` と `else` の間には文を 1 つだけ置くか、`{ }` で囲みます。条件の後に `;` は付けません。",
        )));
    }
    if vocabulary::is_type(previous.text) && matches!(word, "=" | ";" | ",") {
        let text = Text::new(
            format!("The name is missing after the type `{}`.", previous.text),
            format!("型 `{}` の後に変数名がありません。", previous.text),
        );
        return Some(file.error_after(before, text));
    }
    let operator = previous.kind == Kind::Sign && !matches!(previous.text, ")" | "]" | "}" | ";" | "{" | "++" | "--");
    if operator && token.kind == Kind::Sign {
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
    let for_header = word == ")" && inside && for_semicolons(file, at);
    if for_header {
        let text = Text::new("The `for` lacks a `;`.", "`for` の `;` が足りません。");
        return Some(file.error_at(at, text).hint(brackets::for_hint()));
    }
    let starts = matches!(token.kind, Kind::Word | Kind::Number) || word == "(";
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
    Some(if inside { diagnostic } else { diagnostic.hint(hint) })
}

/// Whether the bracket open at `at` is that of a `for` with fewer than two `;`.
fn for_semicolons(file: &File<'_>, at: usize) -> bool {
    let Some(open) = brackets::open_before(file, at).last().copied() else { return false };
    let count = file.code[open..at].iter().filter(|token| token.text == ";").count();
    file.word(open.checked_sub(1)) == "for" && count < 2
}
