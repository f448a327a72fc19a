//! Words of other languages, declarations that GLSL does not allow, and what another version has.

use super::file::{HintContext, macro_name};
use super::tokens::Lexeme;
use super::{CompilerMessage, suggestions, vocabulary};
use crate::diagnostic::Diagnostic;
use crate::ffi::glslang::Stage;
use crate::language::Text;

/// A message of the compiler and its wording for a student; `{}` stands for the token that it names.
struct DisallowedWording {
    /// The token, or the beginning of the message.
    says: &'static str,
    /// What is wrong, in English and in Japanese.
    message: [&'static str; 2],
    /// What to do; empty where the message says it.
    hint: [&'static str; 2],
}

const NO_HINT: [&str; 2] = ["", ""];

/// Things of other languages, by the compiler's token.
const ALIEN: [DisallowedWording; 7] = [
    QUOTED,
    DisallowedWording { says: "'", ..QUOTED },
    DisallowedWording { says: "string", ..QUOTED },
    DisallowedWording {
        says: "::",
        message: ["GLSL has no namespaces: `::` is C++.", "`::` は C++ の書き方です。GLSL に名前空間はありません。"],
        hint: ["Write the function's name alone, such as `max`.", "`max` のように関数名だけを書いてください。"],
    },
    DisallowedWording {
        says: "explicit typecast",
        message: ["GLSL has no casts such as `(float) x`.", "GLSL に `(float) x` のようなキャストはありません。"],
        hint: [
            "A conversion is written like a call: `float(x)`.",
            "型の変換は `float(x)` のように関数の形で書きます。",
        ],
    },
    DisallowedWording {
        says: "{ } style initializers",
        message: [
            "Lists in braces need `#version 420` or newer.",
            "`{ }` による初期化は `#version 420` 以降の機能です。",
        ],
        hint: [
            "In older versions a constructor makes an array: `float[3](1.0, 2.0, 3.0)`.",
            "それより前の版では `float[3](1.0, 2.0, 3.0)` のようにコンストラクタを使います。",
        ],
    },
    DisallowedWording {
        says: "\\",
        message: ["A `\\` cannot stand in code.", "コードの中に `\\` は書けません。"],
        hint: NO_HINT,
    },
];

const QUOTED: DisallowedWording = DisallowedWording {
    says: "string literal",
    message: ["GLSL has no strings or characters in quotes.", "GLSL に文字列や文字のリテラルはありません。"],
    hint: [
        "Nothing can be printed from a shader either: names are written without quotes.",
        "シェーダから文字を出力することもできません。変数名は引用符を付けずに書きます。",
    ],
};

/// Declarations and names that are not allowed, by the beginning of the compiler's message.
const DECLARATIONS: [DisallowedWording; 22] = [
    DisallowedWording {
        says: "Reserved word",
        message: [
            "`{}` is a word that GLSL keeps for itself; it cannot be a name.",
            "`{}` は GLSL の予約語なので、名前には使えません。",
        ],
        hint: suggestions::ANOTHER_NAME,
    },
    DisallowedWording {
        says: "identifiers starting with \"gl_\"",
        message: [
            "`{}`: names that begin with `gl_` belong to GLSL itself.",
            "`{}` のように `gl_` で始まる名前は、GLSL 自身のために予約されています。",
        ],
        hint: suggestions::ANOTHER_NAME,
    },
    DisallowedWording {
        says: "variables with qualifier 'const' must be initialized",
        message: ["The constant `{}` has no value.", "定数 `{}` に値がありません。"],
        hint: ["A constant gets its value where it is declared.", "定数の値は宣言と同時に指定します。"],
    },
    DisallowedWording {
        says: "global const initializers must be constant",
        message: [
            "The value of a global constant must be known when the shader is compiled.",
            "グローバルな定数の値は、コンパイル時に決まっていなければなりません。",
        ],
        hint: [
            "Inputs and uniforms have no value yet there: compute it in `main`.",
            "入力変数や uniform 変数の値はそこではまだ使えません。`main` の中で計算してください。",
        ],
    },
    MAIN,
    DisallowedWording { says: "function cannot take any parameter", ..MAIN },
    DisallowedWording {
        says: "interpolation qualifiers must appear before",
        message: [
            "The qualifiers stand in the wrong order: before GLSL 4.20 `smooth` and the like come before `in` or `out`.",
            "修飾子の順序が違います。GLSL 4.20 より前では `smooth` などを `in` や `out` の前に書きます。",
        ],
        hint: NO_HINT,
    },
    DisallowedWording {
        says: "cannot initialize this type of qualifier",
        message: [
            "A variable declared with `{}` takes no value there.",
            "`{}` を付けた変数は、宣言と同時に初期化できません。",
        ],
        hint: NO_HINT,
    },
    DisallowedWording {
        says: "identifier not previously declared",
        message: ["The type of `{}` is missing.", "`{}` の型がありません。"],
        hint: NO_HINT,
    },
    DisallowedWording {
        says: "can only apply to uniform, buffer, in, or out",
        message: [
            "With `layout (…)`, this variable needs `in`, `out` or `uniform`.",
            "`layout (…)` を付けた変数には `in`、`out`、`uniform` のどれかが必要です。",
        ],
        hint: NO_HINT,
    },
    DisallowedWording {
        says: "not allowed in nested scope",
        message: ["`{}` variables are declared outside functions.", "`{}` 変数は関数の外で宣言します。"],
        hint: NO_HINT,
    },
    DisallowedWording {
        says: "float literal needs a decimal point",
        message: [
            "A number that ends with `f` needs a decimal point: `1.0f`.",
            "末尾に `f` を付ける数値には `1.0f` のように小数点が必要です。",
        ],
        hint: NO_HINT,
    },
    DisallowedWording {
        says: "unexpected token",
        message: ["The character `{}` has no meaning in GLSL.", "`{}` は GLSL では使えない文字です。"],
        hint: NO_HINT,
    },
    DisallowedWording {
        says: "condition must be a scalar integer expression",
        message: [
            "A `switch` chooses by an `int` or a `uint`.",
            "`switch` の条件には `int` か `uint` の値を書きます。",
        ],
        hint: [
            "For other values write `if` and `else`.",
            "それ以外の値で分けるときは `if` と `else` を使ってください。",
        ],
    },
    DisallowedWording {
        says: "duplicated value",
        message: [
            "Another `case` of this `switch` has the same value.",
            "この `switch` には同じ値の `case` がもう 1 つあります。",
        ],
        hint: NO_HINT,
    },
    DisallowedWording {
        says: "array size must be a constant integer expression",
        message: [
            "The length of an array has to be known when the shader is compiled.",
            "配列の長さは、コンパイル時に決まっていなければなりません。",
        ],
        hint: ["Write a number, or a `const int`.", "数値か `const int` で書いてください。"],
    },
    DisallowedWording {
        says: "Too many args in macro",
        message: ["This macro is given more arguments than it has.", "マクロに渡す引数が多すぎます。"],
        hint: NO_HINT,
    },
    DisallowedWording {
        says: "Too few args in",
        message: ["This macro is given fewer arguments than it has.", "マクロに渡す引数が足りません。"],
        hint: NO_HINT,
    },
    DisallowedWording {
        says: "duplicate member name",
        message: ["Two members have the same name here.", "同じ名前のメンバが 2 つあります。"],
        hint: NO_HINT,
    },
    DisallowedWording {
        says: "non-uniform struct contains a sampler",
        message: [
            "A structure with a sampler is a uniform, and has no copies.",
            "サンプラを含む構造体は uniform 変数にしかできず、コピーもできません。",
        ],
        hint: [
            "Use the uniform itself, or hand it to a function as a parameter.",
            "uniform 変数をそのまま使うか、関数の引数として渡してください。",
        ],
    },
    DisallowedWording {
        says: "not supported in this stage",
        message: ["`{}` belongs to another kind of shader.", "`{}` はこの種類のシェーダでは使えません。"],
        hint: NO_HINT,
    },
    DisallowedWording {
        says: "l-value of swizzle cannot have duplicate",
        message: [
            "A component stands twice on the left side of this assignment.",
            "代入の左辺に同じ成分が 2 回書かれています。",
        ],
        hint: NO_HINT,
    },
];

const MAIN: DisallowedWording = DisallowedWording {
    says: "entry point cannot return a value",
    message: ["`main` is declared as `void main()`.", "`main` は `void main()` と宣言します。"],
    hint: NO_HINT,
};

/// A `const` whose value is known only at run time, inside a function.
const LATE_CONSTANT: DisallowedWording = DisallowedWording {
    says: "non-constant initializer",
    message: [
        "Before GLSL 4.20, the value of a `const` must be known when the shader is compiled.",
        "GLSL 4.20 より前では、`const` の値はコンパイル時に決まっていなければなりません。",
    ],
    hint: ["Leave out the `const` here.", "ここでは `const` を付けずに宣言してください。"],
};

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
