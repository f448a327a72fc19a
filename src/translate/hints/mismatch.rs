//! Types that do not fit: conversions, operands, arguments, constructors, components.

use super::declarations::DeclarationKind;
use super::file::HintContext;
use super::types::{self, Numeric};
use super::{CompilerMessage, expression, vocabulary};
use crate::diagnostic::Diagnostic;
use crate::language::Text;

/// Puts a message about types into words.
pub fn explain(file: &HintContext<'_>, finding: &CompilerMessage<'_, '_>) -> Option<Diagnostic> {
    let message = finding.entry.message;
    if message.starts_with("cannot convert from") || message.starts_with("non-matching or non-convertible") {
        return conversion(file, finding);
    }
    if message.starts_with("wrong operand type") {
        return operands(file, finding);
    }
    if message.starts_with("no matching overloaded") || message.starts_with("ambiguous") {
        return arguments(file, finding);
    }
    if finding.entry.token == "constructor" {
        return constructor(file, finding);
    }
    super::components::explain(file, finding)
}

/// The phrases in quotes in a message of the compiler, as type names.
fn quoted_types(message: &str) -> Vec<String> {
    message.split('\'').skip(1).step_by(2).map(types::from_phrase).collect()
}

fn conversion(file: &HintContext<'_>, finding: &CompilerMessage<'_, '_>) -> Option<Diagnostic> {
    let quoted = quoted_types(finding.entry.message);
    let equals = (finding.index..file.code.len()).find(|&at| matches!(file.code[at].text, "=" | ";"))?;
    let value = || {
        let end = (equals..file.code.len()).find(|&at| file.code[at].text == ";")?;
        expression::type_of(file, file.code.get(equals + 1..end)?).map(|ty| ty.to_string())
    };
    let (from, to) = match &quoted[..] {
        [from, to] => (Some(from.clone()), Some(to.clone())),
        _ => (value(), file.declarations.iter().find(|d| d.index == finding.index).map(|d| d.ty.clone())),
    };
    let (Some(from), Some(to)) = (from, to) else {
        let text = Text::new("The value does not fit the type of the variable.", "値の型が変数の型と合っていません。");
        return Some(file.error_at(finding.index, text));
    };
    let text = Text::new(
        format!("A value of type {from} is assigned to a variable of type {to}."),
        format!("{to} 型の変数に {from} 型の値を代入しています。"),
    );
    let diagnostic = file.error_at(finding.index, text);
    Some(match conversion_hint(&from, &to) {
        Some(hint) => diagnostic.hint(hint),
        None => diagnostic,
    })
}

/// How to get from one type to the other, without saying which of the two is the wrong one.
pub fn conversion_hint(from: &str, to: &str) -> Option<Text> {
    let (a, b) = (Numeric::named(from)?, Numeric::named(to)?);
    Some(if a.is_vector() && b.is_vector() && a.rows > b.rows {
        let part = &"xyzw"[..usize::from(b.rows)];
        Text::new(
            format!("The first {} components of a {from} are its `.{part}`.", b.rows),
            format!("{from} の最初の {} 成分は `.{part}` で取り出せます。", b.rows),
        )
    } else if a.is_vector() && b.is_vector() && a.rows < b.rows {
        Text::new(
            format!(
                "`{to}(…, 1.0)` makes a {to} of a {from} and one more number. Or is the variable meant to be a {from}?"
            ),
            format!(
                "`{to}(…, 1.0)` のように成分を補うと {from} から {to} を作れます。変数を {from} 型にするつもりだったのかも確かめてください。"
            ),
        )
    } else if a.is_vector() && b.is_scalar() {
        Text::new(
            format!("A {from} has {} components: take one of them (`.x`), or declare the variable as {from}.", a.rows),
            format!(
                "{from} には {} つの成分があります。`.x` のように 1 つ取り出すか、変数を {from} 型で宣言してください。",
                a.rows
            ),
        )
    } else if a.is_scalar() && (b.is_vector() || b.columns > 1) {
        Text::new(
            format!(
                "A single number does not fill a {to}: `{to}(x)` writes it into every component. Is a factor missing?"
            ),
            format!(
                "1 つの数値をそのまま {to} には代入できません。`{to}(x)` とすると全成分が x になります。掛け忘れた値はありませんか。"
            ),
        )
    } else if (a.columns, a.rows) == (b.columns, b.rows) {
        Text::new(
            format!("GLSL does not turn {from} into {to} by itself: write `{to}(…)`."),
            format!("GLSL は {from} を {to} に自動では変換しません。`{to}(…)` と書いてください。"),
        )
    } else if a.columns > 1 && b.columns > 1 {
        Text::new(
            format!("`{to}(m)` makes a {to} of another matrix."),
            format!("`{to}(m)` とすると別の大きさの行列から {to} を作れます。"),
        )
    } else {
        return None;
    })
}

fn operands(file: &HintContext<'_>, finding: &CompilerMessage<'_, '_>) -> Option<Diagnostic> {
    let operator = finding.entry.token;
    let quoted = quoted_types(finding.entry.message);
    let Some((left, right)) = quoted.get(1).zip(quoted.get(2)) else {
        let phrase = finding.entry.message.split("operand of type ").nth(1).unwrap_or_default();
        let ty = types::from_phrase(phrase.split(" (or").next().unwrap_or_default());
        let text = Text::new(
            format!("`{operator}` cannot be applied to a value of type {ty}."),
            format!("`{operator}` を {ty} 型の値に使うことはできません。"),
        );
        return Some(file.error_at(finding.index, text));
    };
    if operator == ":" {
        let text = Text::new(
            format!("Both sides of `:` must have the same type; here they are {left} and {right}."),
            format!("`:` の両側は同じ型でなければなりません。ここでは {left} と {right} です。"),
        );
        return Some(file.error_at(finding.index, text));
    }
    let text = Text::new(
        format!("`{operator}` cannot combine {left} with {right}."),
        format!("`{operator}` で {left} と {right} を計算することはできません。"),
    );
    let diagnostic = file.error_at(finding.index, text);
    Some(match operand_hint(operator, left, right) {
        Some(hint) => diagnostic.hint(hint),
        None => diagnostic,
    })
}

fn operand_hint(operator: &str, left: &str, right: &str) -> Option<Text> {
    let (a, b) = (Numeric::named(left)?, Numeric::named(right)?);
    match operator {
        "^" => {
            return Some(Text::new(
                "`^` works on bits of integers. A power is `pow(x, y)`.",
                "`^` は整数のビット演算です。べき乗は `pow(x, y)` で計算します。",
            ));
        }
        "%" => {
            return Some(Text::new(
                "`%` works on integers only. For real numbers there is `mod(x, y)`.",
                "`%` は整数専用です。実数には `mod(x, y)` を使います。",
            ));
        }
        "&" | "|" | "<<" | ">>" => {
            return Some(Text::new("This operator works on integers only.", "この演算子は整数にしか使えません。"));
        }
        "&&" | "||" | "^^" => {
            return Some(Text::new(
                "Both sides must be conditions (`bool`).",
                "両辺とも条件 (`bool`) でなければなりません。",
            ));
        }
        "<" | ">" | "<=" | ">=" => {
            return Some(Text::new(
                "It compares single numbers of one type.",
                "比較できるのは同じ型の数値どうしです。",
            ));
        }
        _ => {}
    }
    if a.is_vector() && b.is_vector() {
        return Some(Text::new(
            format!(
                "One side has {} components, the other {}. `.xyz` shortens a vec4, `vec4(v, w)` lengthens a vec3.",
                a.rows, b.rows
            ),
            format!(
                "左辺は {} 成分、右辺は {} 成分です。vec4 は `.xyz` で短く、vec3 は `vec4(v, w)` で長くできます。",
                a.rows, b.rows
            ),
        ));
    }
    let (matrix, vector) = if a.columns > 1 { (a, b) } else { (b, a) };
    (matrix.columns > 1 && vector.is_vector()).then(|| {
        Text::new(
            format!("A {matrix} goes with a vector of {} components, this one has {}. `vec4(v, w)` lengthens a vec3, `mat3(m)` shortens a mat4.", matrix.columns, vector.rows),
            format!("{matrix} には {} 成分のベクトルを掛けますが、このベクトルは {} 成分です。vec3 は `vec4(v, w)` で長く、mat4 は `mat3(m)` で小さくできます。", matrix.columns, vector.rows),
        )
    })
}

fn arguments(file: &HintContext<'_>, finding: &CompilerMessage<'_, '_>) -> Option<Diagnostic> {
    let name = finding.entry.token;
    let open = finding.index + 1;
    let inside = file.closing(open).and_then(|close| file.code.get(open + 1..close)).unwrap_or_default();
    let arguments = expression::arguments(inside);
    let given: Option<Vec<_>> =
        arguments.iter().map(|argument| expression::type_of(file, argument).map(|ty| ty.to_string())).collect();
    let text = match given {
        Some(given) => Text::new(
            format!("`{name}` cannot be called with ({}).", given.join(", ")),
            format!("`{name}` を引数 ({}) で呼び出すことはできません。", given.join(", ")),
        ),
        None => Text::new(
            format!("`{name}` cannot be called with these {} arguments.", arguments.len()),
            format!("`{name}` をこの {} 個の引数で呼び出すことはできません。", arguments.len()),
        ),
    };
    let diagnostic = file.error_at(finding.index, text);
    Some(match form(file, name) {
        Some(form) => diagnostic.hint(form),
        None => diagnostic,
    })
}

/// What a function takes.
fn form(file: &HintContext<'_>, name: &str) -> Option<Text> {
    if let Some(function) = file.anywhere(name).filter(|d| d.role == DeclarationKind::Function) {
        let close = file.closing(function.index + 1)?;
        let parameters: String =
            file.text[function.start..file.code[close].end()].split_ascii_whitespace().collect::<Vec<_>>().join(" ");
        let line = file.line(function.start);
        return Some(Text::new(
            format!("Line {line} defines it as `{parameters}`."),
            format!("{line} 行目で `{parameters}` と定義されています。"),
        ));
    }
    let (en, ja) = match name {
        "dot" | "distance" | "reflect" => ("takes two vectors of the same size", "同じ成分数のベクトルを 2 つ取ります"),
        "cross" => ("takes two vec3", "vec3 を 2 つ取ります"),
        "normalize" | "length" => ("takes one vector", "ベクトルを 1 つ取ります"),
        "max" | "min" | "mod" => (
            "takes two values of the same type, or a vector and then a float",
            "同じ型の値を 2 つ、またはベクトルと float をこの順に取ります",
        ),
        "pow" => ("takes base and exponent, both of the same type", "底と指数を同じ型で取ります"),
        "clamp" => ("takes a value, a lower and an upper bound", "値、下限、上限の 3 つを取ります"),
        "mix" => ("takes two values of the same type and a weight", "同じ型の値を 2 つと、混ぜる割合を取ります"),
        "transpose" | "inverse" | "determinant" => ("takes one matrix", "行列を 1 つ取ります"),
        "step" => ("takes an edge and a value of the same type", "しきい値と値を同じ型で取ります"),
        "smoothstep" => ("takes two edges and a value", "2 つのしきい値と値を取ります"),
        _ if vocabulary::is_function(file.interface.stage, name) => {
            ("does not take these types", "この型の引数を取りません")
        }
        _ => return None,
    };
    Some(Text::new(format!("`{name}` {en}."), format!("`{name}` は{ja}。")))
}

fn constructor(file: &HintContext<'_>, finding: &CompilerMessage<'_, '_>) -> Option<Diagnostic> {
    let name = file.word(Some(finding.index));
    let message = finding.entry.message;
    let ty = Numeric::named(name)?;
    let open = finding.index + 1;
    let inside = file.closing(open).and_then(|close| file.code.get(open + 1..close)).unwrap_or_default();
    let components = |ty: Numeric| u32::from(ty.columns) * u32::from(ty.rows);
    let given: Option<u32> = expression::arguments(inside)
        .into_iter()
        .map(|argument| expression::type_of(file, argument).map(components))
        .sum();
    let needed = components(ty);
    let text =
        match given.filter(|_| message.starts_with("not enough data") || message.starts_with("too many arguments")) {
            Some(given) => Text::new(
                format!("`{name}` is made of {needed} numbers, and here are {given}."),
                format!("`{name}` には {needed} 個の数値が必要ですが、ここには {given} 個あります。"),
            ),
            None if message.starts_with("not enough data") => Text::new(
                format!("`{name}` is made of {needed} numbers, and here are fewer."),
                format!("`{name}` には {needed} 個の数値が必要ですが、足りません。"),
            ),
            None if message.starts_with("too many arguments") => Text::new(
                format!("`{name}` is made of {needed} numbers, and here are more arguments than that takes."),
                format!("`{name}` に必要な数値は {needed} 個です。引数が多すぎます。"),
            ),
            None => Text::new(
                format!("`{name}` cannot be made of these arguments."),
                format!("この引数から `{name}` を作ることはできません。"),
            ),
        };
    Some(file.error_at(finding.index, text))
}
