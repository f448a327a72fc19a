//! Components of vectors, members, indices and conditions.

use super::file::HintContext;
use super::tokens::LexemeKind;
use super::{CompilerMessage, expression, types};
use crate::diagnostic::Diagnostic;
use crate::language::Text;

/// Puts a message about a part of a value, or about a condition, into words.
pub fn explain(file: &HintContext<'_>, finding: &CompilerMessage<'_, '_>) -> Option<Diagnostic> {
    let message = finding.entry.message;
    let about = |start: &str| message.starts_with(start);
    if finding.entry.token == "scalar swizzle" {
        return Some(scalar(file, finding));
    }
    if finding.entry.token.starts_with(".length()") || about("incomplete method syntax") {
        return Some(length(file, finding));
    }
    if about("unknown swizzle selection") || about("vector swizzle") {
        return Some(swizzle(file, finding));
    }
    if about("does not apply to this type") || about("no such field in structure") {
        return Some(no_such_part(file, finding));
    }
    if about("boolean expression expected") {
        return Some(condition(file, finding));
    }
    index(file, finding)
}

fn scalar(file: &HintContext<'_>, finding: &CompilerMessage<'_, '_>) -> Diagnostic {
    let text = Text::new(
        "A single number has no components: `.x`, `.xyz` and the like belong to vectors.",
        "スカラーに成分はありません。`.x` や `.xyz` が使えるのはベクトルだけです。",
    );
    file.error_at(finding.index, text)
}

fn length(file: &HintContext<'_>, finding: &CompilerMessage<'_, '_>) -> Diagnostic {
    let text = Text::new("`.length` is for arrays only.", "`.length` が使えるのは配列だけです。");
    file.error_at(finding.index, text)
        .hint(Text::new("The length of a vector is `length(v)`.", "ベクトルの長さは `length(v)` で求めます。"))
}

fn swizzle(file: &HintContext<'_>, finding: &CompilerMessage<'_, '_>) -> Diagnostic {
    let field = finding.entry.token;
    if file.word(Some(finding.index + 1)) == "(" {
        let text = Text::new(
            format!("`.{field}(…)` is no GLSL: functions are not called on a value."),
            format!("`.{field}(…)` という書き方は GLSL にはありません。"),
        );
        return file.error_at(finding.index, text).hint(Text::new(
            format!("The values go into the parentheses: `{field}(a, b)`."),
            format!("値は `{field}(a, b)` のように括弧の中に書きます。"),
        ));
    }
    let message = finding.entry.message;
    let text = if message.contains("not from the same set") {
        Text::new(
            format!("`.{field}` mixes names of components from different sets."),
            format!("`.{field}` は異なる組の成分名を混ぜています。"),
        )
    } else if message.contains("out of range") {
        Text::new(
            format!("`.{field}` asks for a component that this vector does not have."),
            format!("`.{field}` は、このベクトルにない成分を指しています。"),
        )
    } else {
        Text::new(
            format!("A vector has no components `{field}`."),
            format!("ベクトルに `{field}` という成分はありません。"),
        )
    };
    // What is called a length elsewhere is a function here.
    let hint = if field == "length" { length_of_vector(file, finding.index) } else { names_of_components() };
    file.error_at(finding.index, text).hint(hint)
}

/// How the length of the vector is written whose member `.length` was meant to be.
fn length_of_vector(file: &HintContext<'_>, index: usize) -> Text {
    let name = index.checked_sub(2).filter(|before| file.code[*before].kind == LexemeKind::Word);
    let example = format!("length({})", name.map_or("…", |before| file.code[before].text));
    Text::new(
        format!("The length of a vector is a function: `{example}`."),
        format!("ベクトルの長さは関数で求めます: `{example}`。"),
    )
}

/// How the components of a vector are named.
pub fn names_of_components() -> Text {
    Text::new(
        "Components are named `xyzw`, `rgba` or `stpq`, up to four of one set; a vec3 ends at `xyz`.",
        "成分名は `xyzw`、`rgba`、`stpq` のどれか 1 組から 4 つまでです。vec3 にあるのは `xyz` までです。",
    )
}

fn no_such_part(file: &HintContext<'_>, finding: &CompilerMessage<'_, '_>) -> Diagnostic {
    let field = finding.entry.token;
    let phrase = finding.entry.message.rsplit_once(':').map_or("", |(_, phrase)| phrase);
    let text = match types::from_phrase(phrase) {
        ty if !ty.is_empty() => Text::new(
            format!("A value of type {ty} has no part `.{field}`."),
            format!("{ty} 型の値に `.{field}` はありません。"),
        ),
        _ => Text::new(format!("There is no member `{field}` here."), format!("`{field}` というメンバはありません。")),
    };
    file.error_at(finding.index, text)
}

/// The condition of an `if` or a loop that is none.
fn condition(file: &HintContext<'_>, finding: &CompilerMessage<'_, '_>) -> Diagnostic {
    let keyword = file.word(Some(finding.index));
    let open = finding.index + 1;
    let close = if file.word(Some(open)) == "(" { file.closing(open) } else { None };
    let inside = close.and_then(|close| file.code.get(open + 1..close)).unwrap_or_default();
    if let Some(at) = inside.iter().position(|token| token.text == "=").filter(|_| matches!(keyword, "if" | "while")) {
        let text = Text::new(
            "`=` assigns here; a comparison is written `==`.",
            "ここの `=` は代入です。比較の演算子は `==` です。",
        );
        return file.error_at(open + 1 + at, text);
    }
    let ty = expression::type_of(file, inside).map(|ty| ty.to_string());
    let text = match ty.filter(|ty| ty != "bool") {
        Some(ty) => Text::new(
            format!("The condition has type {ty}; it must be bool."),
            format!("条件が {ty} 型です。条件は bool 型でなければなりません。"),
        ),
        None => Text::new("The condition must be of type bool.", "条件は bool 型でなければなりません。"),
    };
    let place = if inside.is_empty() { finding.index } else { open + 1 };
    file.error_at(place, text).hint(Text::new(
        "Compare it with something: `x > 0.0`, `i == 1`.",
        "`x > 0.0` や `i == 1` のように、何かと比較してください。",
    ))
}

fn index(file: &HintContext<'_>, finding: &CompilerMessage<'_, '_>) -> Option<Diagnostic> {
    let message = finding.entry.message;
    let text = if message.contains("index out of range") {
        let number = message.rsplit('\'').nth(1).unwrap_or_default();
        Text::new(
            format!("The index {number} is out of range: the first element has index 0."),
            format!("添字 {number} は範囲外です。添字は 0 から始まります。"),
        )
    } else if message.starts_with("scalar integer expression required") {
        Text::new("An index must be an integer.", "添字は整数でなければなりません。")
    } else if message.starts_with("left of '['") {
        Text::new(
            "What stands before `[` is no array, matrix or vector.",
            "`[` の前にあるものは配列でも行列でもベクトルでもありません。",
        )
    } else {
        return None;
    };
    Some(file.error_at(finding.index, text))
}
