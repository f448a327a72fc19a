//! What GLSL does not allow, in words.

use crate::translate::hints::suggestions;

/// A message of the compiler and its wording for a student; `{}` stands for the token that it names.
pub struct DisallowedWording {
    /// The token, or the beginning of the message.
    pub says: &'static str,
    /// What is wrong, in English and in Japanese.
    pub message: [&'static str; 2],
    /// What to do; empty where the message says it.
    pub hint: [&'static str; 2],
}

pub const NO_HINT: [&str; 2] = ["", ""];

/// Things of other languages, by the compiler's token.
pub const ALIEN: [DisallowedWording; 7] = [
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
pub const DECLARATIONS: [DisallowedWording; 28] = [
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
        says: "vertex input cannot be further qualified",
        message: [
            "Before a vertex shader nothing is interpolated: its inputs have no `flat`, `smooth` or `noperspective`.",
            "頂点シェーダの前には補間がないので、入力変数に `flat`、`smooth`、`noperspective` は付けられません。",
        ],
        hint: [
            "An output may have one. Or is this the fragment shader?",
            "出力変数には付けられます。あるいは、このファイルはフラグメントシェーダではありませんか。",
        ],
    },
    DisallowedWording {
        says: "sampler/image types can only be used in uniform variables or function parameters",
        message: [
            "A texture is no value: only a uniform or a parameter of a function has the type `{}`.",
            "テクスチャは値ではありません。`{}` 型にできるのは uniform 変数と関数の引数だけです。",
        ],
        hint: ["Use the uniform's own name here.", "ここでは uniform 変数の名前をそのまま使ってください。"],
    },
    DisallowedWording {
        says: "overlapping use of location",
        message: [
            "Another variable has this `location` already.",
            "この `location` は、すでに別の変数に使われています。",
        ],
        hint: NO_HINT,
    },
    DisallowedWording {
        says: "Number of constructor parameters does not match the number of structure fields",
        message: [
            "This constructor of a structure has not as many values as the structure has members.",
            "構造体のコンストラクタの引数の数が、メンバの数と一致していません。",
        ],
        hint: ["It needs a value for each member, in their order.", "メンバの宣言の順に、1 つずつ値を書いてください。"],
    },
    DisallowedWording {
        says: "continue statement only allowed in loops",
        message: ["`continue` stands only in a loop.", "`continue` はループの中でしか使えません。"],
        hint: NO_HINT,
    },
    DisallowedWording {
        says: "break statement only allowed in switch and loops",
        message: ["`break` stands only in a loop or a `switch`.", "`break` はループか `switch` の中でしか使えません。"],
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
pub const LATE_CONSTANT: DisallowedWording = DisallowedWording {
    says: "non-constant initializer",
    message: [
        "Before GLSL 4.20, the value of a `const` must be known when the shader is compiled.",
        "GLSL 4.20 より前では、`const` の値はコンパイル時に決まっていなければなりません。",
    ],
    hint: ["Leave out the `const` here.", "ここでは `const` を付けずに宣言してください。"],
};
