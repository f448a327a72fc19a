//! What a student may have meant by a name, and what the assignment calls it.

use super::CompilerMessage;
use super::declarations::DeclaredName;
use super::file::HintContext;
use super::vocabulary::{self, Instead, Origin};
use crate::language::Text;
use crate::translate::{Stage, Variable};

pub fn hint_for_variable(file: &HintContext<'_>, finding: &CompilerMessage<'_, '_>, name: &str) -> Text {
    let offset = file.code.get(finding.index).map_or(file.text.len(), |token| token.start);
    let visible = || file.declarations.iter().filter(|d| d.is_visible(offset)).map(|d| d.name);
    let known = || {
        visible()
            .chain(interface_names(file))
            .chain(vocabulary::variables(file.interface.stage))
            .chain(["true", "false"])
    };
    let assigned = file.statement(finding.index) == finding.index && file.word(Some(finding.index + 1)) == "=";
    let used_again = file.code.iter().filter(|token| token.text == name).count() > 1;
    from_elsewhere(file, name)
        .or_else(|| of_interface(file, name))
        .or_else(|| file.anywhere(name).map(|d| out_of_reach(file, d, offset)))
        .or_else(|| (assigned && used_again).then(|| type_missing(name)))
        .or_else(|| vocabulary::nearest(name, known()).map(|meant| did_you_mean(file, name, meant, offset)))
        .or_else(|| attribute_by_role(file, name))
        .or_else(|| assigned.then(|| type_missing(name)))
        .unwrap_or_else(|| {
            Text::new(
                "A variable is declared with its type before it is used.",
                "変数は、使う前に型を付けて宣言してください。",
            )
        })
}

fn interface_names<'a>(file: &HintContext<'a>) -> impl Iterator<Item = &'a str> {
    let interface = file.interface;
    let variables = interface.inputs.iter().chain(&interface.uniforms).chain(&interface.outputs);
    variables.map(|variable| variable.name.as_str()).chain(interface.constants.iter().map(String::as_str))
}

fn type_missing(name: &str) -> Text {
    Text::new(
        format!("A new variable begins with its type: `vec3 {name} = …`, `vec4 {name} = …` or `float {name} = …`."),
        format!("新しい変数は `vec3 {name} = …` や `float {name} = …` のように、型を付けて宣言します。"),
    )
}

pub fn did_you_mean(file: &HintContext<'_>, name: &str, meant: &str, offset: usize) -> Text {
    match file.visible(meant, offset) {
        Some(declaration) => {
            let line = file.line(declaration.start);
            Text::new(
                format!("Did you mean `{meant}`, declared on line {line}?"),
                format!("{line} 行目で宣言されている `{meant}` の間違いではありませんか。"),
            )
        }
        None if meant.eq_ignore_ascii_case(name) => Text::new(
            format!("Did you mean `{meant}`? Capital and small letters differ in GLSL."),
            format!("`{meant}` の間違いではありませんか。GLSL では大文字と小文字を区別します。"),
        ),
        None => Text::new(format!("Did you mean `{meant}`?"), format!("`{meant}` の間違いではありませんか。")),
    }
}

/// For a function of the handed-out file that the file has no more.
pub fn deleted_function(name: &str) -> Text {
    Text::new(
        format!("The handed-out file defines the function `{name}`. Was it deleted?"),
        format!("配布されたファイルでは関数 `{name}` が定義されています。その定義を消していませんか。"),
    )
}

fn out_of_reach(file: &HintContext<'_>, declaration: &DeclaredName<'_>, offset: usize) -> Text {
    let line = file.line(declaration.start);
    if declaration.start > offset {
        return Text::new(
            format!("It is declared only on line {line}: a declaration stands before the first use."),
            format!("宣言が {line} 行目にあります。宣言は最初に使う行より前に書いてください。"),
        );
    }
    Text::new(
        format!("The one declared on line {line} exists only inside its own function or braces."),
        format!("{line} 行目で宣言されたものは、その関数または `{{ }}` の中でしか使えません。"),
    )
}

/// How a declaration of the interface is written.
pub fn declaration_of(file: &HintContext<'_>, name: &str) -> Option<String> {
    let interface = file.interface;
    let line = |qualifier: &str, variable: &Variable| format!("{qualifier} {} {};", variable.ty, variable.name);
    let find = |variables: &[Variable], qualifier| {
        variables.iter().find(|variable| variable.name == name).map(|variable| line(qualifier, variable))
    };
    let first = find(&interface.inputs, "in").or_else(|| find(&interface.uniforms, "uniform"));
    first.or_else(|| find(&interface.outputs, "out"))
}

pub fn of_interface(file: &HintContext<'_>, name: &str) -> Option<Text> {
    if file.anywhere(name).is_some() {
        return None;
    }
    if let Some(declaration) = declaration_of(file, name) {
        return Some(Text::new(
            format!("It belongs to the assignment's interface: declare it outside `main` with `{declaration}`."),
            format!("課題の入出力に使う変数です。`main` の外で `{declaration}` と宣言してください。"),
        ));
    }
    file.interface.constants.iter().any(|constant| constant == name).then(|| {
        Text::new(
            "The handed-out file defines it as a constant at the top. Was that line deleted?",
            "配布されたファイルの先頭で定数として定義されています。その行を消していませんか。",
        )
    })
}

/// What the program feeds to the shader, for a name that someone else's program uses.
fn attribute_by_role(file: &HintContext<'_>, name: &str) -> Option<Text> {
    let lower = name.to_ascii_lowercase();
    let roles = ["normal", "position", "color", "colour", "vertex", "texcoord"];
    (name.len() == 2 || roles.iter().any(|role| lower.contains(role)) || lower == "pos").then(|| attributes(file))
}

fn attributes(file: &HintContext<'_>) -> Text {
    let name = |variable: &Variable| match file.anywhere(&variable.name) {
        Some(d) => (
            format!("`{}` ({}, line {})", variable.name, variable.ty, file.line(d.start)),
            format!("`{}` ({}、{} 行目)", variable.name, variable.ty, file.line(d.start)),
        ),
        None => {
            let plain = format!("`{}` ({})", variable.name, variable.ty);
            (plain.clone(), plain)
        }
    };
    let (en, ja): (Vec<_>, Vec<_>) = file.interface.inputs.iter().map(name).unzip();
    let (own_en, own_ja) = inputs_of(file.interface.stage);
    Text::new(
        format!("The {own_en} of this assignment are {}: which of them carries what you need?", en.join(" and ")),
        format!("この課題の{own_ja}は {} です。必要な値がどれに入っているか確かめてください。", ja.join("、")),
    )
}

/// Types of text in other languages.
const TEXTS: [&str; 3] = ["string", "String", "char"];

/// What to say about a word of an older GLSL or of another language.
pub fn from_elsewhere(file: &HintContext<'_>, name: &str) -> Option<Text> {
    let (origin, instead) = vocabulary::foreign(name)?;
    let stage = file.interface.stage;
    if vocabulary::is_built_in(stage, name) {
        return None;
    }
    let is_output = origin == Origin::Fragment;
    // In a fragment shader they are the outputs of long ago.
    let origin = if stage == Stage::Fragment && is_output { Origin::OldGlsl } else { origin };
    let (en, ja) = match origin {
        Origin::OldGlsl => ("GLSL before version 1.40", "1.40 より前の古い GLSL"),
        Origin::Hlsl => ("HLSL", "HLSL"),
        Origin::C => ("C, C++ or another language", "C や C++ など別の言語"),
        Origin::Fragment => ("fragment shaders", "フラグメントシェーダ"),
    };
    let from = Text::new(format!("`{name}` belongs to {en}"), format!("`{name}` は {ja} のものです"));
    Some(match instead {
        Instead::Word(word) => Text::new(
            format!("{}; GLSL has `{word}`.", from.en),
            format!("{}。GLSL では `{word}` を使います。", from.ja),
        ),
        Instead::Nothing if TEXTS.contains(&name) => Text::new(
            format!("{}; GLSL has no texts, only numbers and truth values.", from.en),
            format!("{}。GLSL には文字や文字列の型がなく、扱えるのは数と真偽値だけです。", from.ja),
        ),
        Instead::Nothing => Text::new(format!("{}.", from.en), format!("{}。", from.ja)),
        Instead::Interface if is_output => {
            let (en, ja) = match stage {
                Stage::Vertex => ("vertex", "バーテックス"),
                Stage::Fragment => ("fragment", "フラグメント"),
            };
            match list(&file.interface.outputs).as_str() {
                "" => Text::new(
                    format!("{}. Declare an output of your own, outside `main`: `out vec4 …;`.", from.en),
                    format!("{}。`main` の外で `out vec4 …;` と出力変数を宣言してください。", from.ja),
                ),
                output => Text::new(
                    format!("{}. This {en} shader hands its result on in {output}.", from.en),
                    format!("{}。この{ja}シェーダの出力変数は {output} です。", from.ja),
                ),
            }
        }
        Instead::Interface => {
            let (inputs, uniforms) = (list(&file.interface.inputs), list(&file.interface.uniforms));
            let (en, ja) = inputs_of(stage);
            let (of_inputs_en, of_inputs_ja) = match inputs.as_str() {
                "" => (String::new(), String::new()),
                inputs => (format!("the {en} are {inputs}, "), format!("{ja}は {inputs}、")),
            };
            Text::new(
                format!("{}. Here {of_inputs_en}the uniforms are {uniforms}.", from.en),
                format!("{}。この課題の{of_inputs_ja}ユニフォーム変数は {uniforms} です。", from.ja),
            )
        }
    })
}

/// What the inputs of a stage are called.
fn inputs_of(stage: Stage) -> (&'static str, &'static str) {
    match stage {
        Stage::Vertex => ("attributes", "頂点属性"),
        Stage::Fragment => ("inputs", "入力変数"),
    }
}

fn list(variables: &[Variable]) -> String {
    variables.iter().map(|variable| format!("`{}`", variable.name)).collect::<Vec<_>>().join(", ")
}

/// For a word that cannot be a name.
pub const ANOTHER_NAME: [&str; 2] =
    ["Choose another name, here and where it is used.", "ここと使っている箇所を、別の名前に変えてください。"];
