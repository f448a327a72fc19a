//! Where the parser gave up, and what it stumbled over.

use super::file::HintContext;
use super::tokens::LexemeKind;
use super::{CompilerMessage, LogEntry, brackets, statement, vocabulary};
use crate::diagnostic::Diagnostic;
use crate::language::Text;

/// The index of the token at which the parser gave up at byte `offset`: it counts to the end of a token, and one
/// further where a line ends there.
pub fn unexpected_token(file: &HintContext<'_>, entry: &LogEntry<'_>, offset: usize) -> usize {
    let end_of_file = entry.message.contains("unexpected end of file");
    let index = file.index_at(offset);
    if offset + 1 >= file.text.trim_end().len() && end_of_file {
        return file.code.len();
    }
    let before = index.checked_sub(1).filter(|&before| file.code[before].end() == offset);
    let inside = file.code.get(index).is_some_and(|token| token.start <= offset);
    before.filter(|_| !inside).unwrap_or(index)
}

/// Puts a syntax error into words.
pub fn explain(file: &HintContext<'_>, finding: &CompilerMessage<'_, '_>) -> Option<Diagnostic> {
    if !finding.entry.is_syntax_error() {
        return None;
    }
    let at = finding.index;
    let found = cut_off(file, at)
        .or_else(|| alien_sign(file, at))
        .or_else(|| macro_with_semicolon(file, at))
        .or_else(|| statement::keyword_as_name(file, at))
        .or_else(|| statement::body(file, at))
        .or_else(|| brackets::explain(file, at))
        .or_else(|| statement::missing_type(file, at))
        .or_else(|| statement::unknown_first_word(file, at))
        .or_else(|| statement::semicolon(file, at, finding.entry.message))
        .or_else(|| statement::construct(file, at))
        .or_else(|| statement::nothing_between(file, at))
        .or_else(|| statement::operands(file, at));
    Some(found.unwrap_or_else(|| unexpected(file, at)))
}

fn unexpected(file: &HintContext<'_>, at: usize) -> Diagnostic {
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

/// The end of the file in the middle of an expression, or a `?` without its `:`.
fn cut_off(file: &HintContext<'_>, at: usize) -> Option<Diagnostic> {
    let before = at.checked_sub(1)?;
    if at == file.code.len() && matches!(file.word(Some(before)), "+" | "-" | "*" | "/" | "=" | "," | "(") {
        let text =
            Text::new("The file ends in the middle of this expression.", "ファイルがこの式の途中で終わっています。");
        return Some(file.error_at(before, text).hint(Text::new(
            "Was the whole file saved and handed in?",
            "ファイル全体が保存・提出されているか確かめてください。",
        )));
    }
    let statement = file.code.get(file.statement(before)..at).unwrap_or_default();
    let count = |sign| statement.iter().filter(|token| token.text == sign).count();
    (file.word(Some(at)) == ";" && count("?") > count(":") && is_operand_end(file, Some(before))).then(|| {
        let text = Text::new("The `:` that belongs to `?` is missing.", "`?` に対応する `:` がありません。");
        file.error_at(at, text)
            .hint(Text::new("A choice is written `condition ? a : b`.", "条件演算子は `条件 ? a : b` の形で書きます。"))
    })
}

/// Signs that mean something in other languages.
fn alien_sign(file: &HintContext<'_>, at: usize) -> Option<Diagnostic> {
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
        "*" | "&"
            if vocabulary::is_type(previous)
                || matches!(previous, "(" | "," | "=")
                || sign == "&" && !is_operand_end(file, before) =>
        {
            Some(
                file.error_at(
                    at,
                    Text::new(
                        "GLSL has no pointers and no addresses.",
                        "GLSL にはポインタもアドレス演算子もありません。",
                    ),
                )
                .hint(Text::new(
                    "Write the name alone. A function gives back more than one value through `out` parameters.",
                    "変数名だけを書いてください。複数の値を返す関数には `out` 引数を使います。",
                )),
            )
        }
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
pub fn is_operand_end(file: &HintContext<'_>, index: Option<usize>) -> bool {
    let Some(token) = index.and_then(|index| file.code.get(index)) else { return false };
    match token.kind {
        LexemeKind::Word => !vocabulary::is_keyword(token.text) || matches!(token.text, "true" | "false"),
        LexemeKind::Number => true,
        _ => matches!(token.text, ")" | "]" | "++" | "--"),
    }
}

/// A macro whose text ends with `;`, used where the parser gave up.
fn macro_with_semicolon(file: &HintContext<'_>, at: usize) -> Option<Diagnostic> {
    let line = file.line(file.code.get(at)?.start);
    let used = |line_text: &&super::tokens::Lexeme<'_>| {
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

/// Whether the code token `at` stands inside parentheses or square brackets.
pub fn in_brackets(file: &HintContext<'_>, at: usize) -> bool {
    matches!(file.word(brackets::open_before(file, at).last().copied()), "(" | "[")
}
