//! Names that are not there, and those that were meant.

use super::declarations::{Declaration, Role};
use super::file::{File, macro_name};
use super::tokens::Kind;
use super::vocabulary::{self, Instead, Origin};
use super::{Entry, Finding};
use crate::diagnostic::Diagnostic;
use crate::language::Text;
use crate::translate::Variable;

/// The index of the code token that `entry` is about; `offset` is where the compiler noticed.
pub fn locate(file: &File<'_>, entry: &Entry<'_>, offset: usize) -> usize {
    let at = file.index_at(offset);
    let call = entry.message.starts_with("no matching overloaded") || entry.token == "constructor";
    // The compiler notices at the end of the arguments, which may be lines below the name.
    if call && file.word(Some(at)) == ")" {
        let name = file.opening(at).and_then(|open| open.checked_sub(1));
        if let Some(name) = name.filter(|&name| entry.token == "constructor" || file.code[name].text == entry.token) {
            return name;
        }
    }
    let line = file.line(offset);
    let on_line = file.code.iter().enumerate().filter(|(_, token)| file.line(token.start) == line);
    let same = on_line.filter(|(_, token)| token.text == entry.token);
    same.min_by_key(|(_, token)| token.start.abs_diff(offset)).map_or(at, |(index, _)| index)
}

/// Whether `name` is a function, a type or a variable that can be called or indexed by its name at least.
pub fn is_callable(file: &File<'_>, name: &str) -> bool {
    let known = vocabulary::is_function(name) || vocabulary::is_type(name) || name.is_empty();
    let declared = file.declarations.iter().any(|d| d.name == name && d.role != Role::Function);
    let function = file.declarations.iter().any(|d| d.name == name && d.role == Role::Function);
    known || declared || function
}

/// Puts a message about a name into words.
pub fn explain(file: &File<'_>, finding: &Finding<'_, '_>) -> Option<Diagnostic> {
    let name = finding.entry.token;
    let message = finding.entry.message;
    if message.starts_with("undeclared identifier") {
        return Some(undeclared(file, finding, name));
    }
    if finding.unknown_function {
        return Some(unknown_function(file, finding, name));
    }
    if message.starts_with("no matching overloaded") && !vocabulary::is_function(name) {
        return defined_later(file, finding, name);
    }
    if message.starts_with("can't use function syntax on variable") {
        let text = Text::new(
            format!("`{name}` is a variable and cannot be called like a function."),
            format!("`{name}` は変数なので、関数のように呼び出すことはできません。"),
        );
        return Some(file.error_at(finding.index, text).hint(Text::new(
            "Is there a `*` missing between the name and the parenthesis?",
            "名前と括弧の間の `*` が抜けていませんか。",
        )));
    }
    if message.starts_with("function call, method, or subroutine call expected") {
        let text =
            Text::new("What stands before this `(` is no function.", "この `(` の前にあるものは関数ではありません。");
        return Some(
            file.error_at(finding.index, text)
                .hint(Text::new("Is a `*` missing before the parenthesis?", "括弧の前の `*` が抜けていませんか。")),
        );
    }
    None
}

fn undeclared(file: &File<'_>, finding: &Finding<'_, '_>, name: &str) -> Diagnostic {
    let next = file.code.get(finding.index + 1);
    if file.word(Some(finding.index)) == name && next.is_some_and(|next| next.kind == Kind::Word) {
        return unknown_type(file, finding.index);
    }
    let text = Text::new(format!("`{name}` is not declared."), format!("`{name}` は宣言されていません。"));
    place(file, finding, name, text).hint(hint_for_variable(file, finding, name))
}

/// A diagnostic about `name`: where it stands, or in the macro that brought it to the line of the message.
fn place(file: &File<'_>, finding: &Finding<'_, '_>, name: &str, text: Text) -> Diagnostic {
    if file.word(Some(finding.index)) == name || file.anywhere(name).is_some() {
        return file.error_at(finding.index, text);
    }
    let found = file.directives.iter().find_map(|line| {
        let after = line.text.find(macro_name(line.text)?)?;
        let body = super::tokens::tokens(&line.text[after..]);
        let word = body.iter().find(|token| token.kind == Kind::Word && token.text == name);
        word.map(|token| line.start + after + token.start)
    });
    match found {
        Some(offset) => {
            let used = finding.entry.place.map_or(0, |(line, _)| line);
            let text = Text::new(
                format!("{} This macro is used on line {used}.", text.en),
                format!("{}このマクロは {used} 行目で使われています。", text.ja),
            );
            file.error(offset, name.len(), text)
        }
        None => file.error_at(finding.index, text),
    }
}

fn hint_for_variable(file: &File<'_>, finding: &Finding<'_, '_>, name: &str) -> Text {
    let offset = file.code.get(finding.index).map_or(file.text.len(), |token| token.start);
    let visible = || file.declarations.iter().filter(|d| d.is_visible(offset)).map(|d| d.name);
    let known = || visible().chain(interface_names(file)).chain(vocabulary::variables()).chain(["true", "false"]);
    let assigned = file.statement(finding.index) == finding.index && file.word(Some(finding.index + 1)) == "=";
    let used_again = file.code.iter().filter(|token| token.text == name).count() > 1;
    from_elsewhere(file, name)
        .or_else(|| of_interface(file, name))
        .or_else(|| file.anywhere(name).map(|d| out_of_reach(file, d, offset)))
        .or_else(|| (assigned && used_again).then(|| type_missing(name)))
        .or_else(|| vocabulary::nearest(name, known()).map(|meant| did_you_mean(file, meant, offset)))
        .or_else(|| attribute_by_role(file, name))
        .or_else(|| assigned.then(|| type_missing(name)))
        .unwrap_or_else(|| {
            Text::new(
                "A variable is declared with its type before it is used.",
                "変数は、使う前に型を付けて宣言してください。",
            )
        })
}

fn interface_names<'a>(file: &File<'a>) -> impl Iterator<Item = &'a str> {
    let interface = file.interface;
    let variables = interface.inputs.iter().chain(&interface.uniforms).chain(std::iter::once(&interface.output));
    variables.map(|variable| variable.name.as_str()).chain(interface.constants.iter().map(String::as_str))
}

fn type_missing(name: &str) -> Text {
    Text::new(
        format!("A new variable begins with its type: `vec3 {name} = …`, `vec4 {name} = …` or `float {name} = …`."),
        format!("新しい変数は `vec3 {name} = …` や `float {name} = …` のように、型を付けて宣言します。"),
    )
}

fn did_you_mean(file: &File<'_>, meant: &str, offset: usize) -> Text {
    match file.visible(meant, offset) {
        Some(declaration) => {
            let line = file.line(declaration.start);
            Text::new(
                format!("Did you mean `{meant}`, declared on line {line}?"),
                format!("{line} 行目で宣言されている `{meant}` の間違いではありませんか。"),
            )
        }
        None => Text::new(
            format!("Did you mean `{meant}`? Capital and small letters differ in GLSL."),
            format!("`{meant}` の間違いではありませんか。GLSL では大文字と小文字を区別します。"),
        ),
    }
}

fn out_of_reach(file: &File<'_>, declaration: &Declaration<'_>, offset: usize) -> Text {
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
pub fn declaration_of(file: &File<'_>, name: &str) -> Option<String> {
    let interface = file.interface;
    let line = |qualifier: &str, variable: &Variable| format!("{qualifier} {} {};", variable.ty, variable.name);
    let find = |variables: &[Variable], qualifier| {
        variables.iter().find(|variable| variable.name == name).map(|variable| line(qualifier, variable))
    };
    find(&interface.inputs, "in")
        .or_else(|| find(&interface.uniforms, "uniform"))
        .or_else(|| (interface.output.name == name).then(|| line("out", &interface.output)))
}

fn of_interface(file: &File<'_>, name: &str) -> Option<Text> {
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
fn attribute_by_role(file: &File<'_>, name: &str) -> Option<Text> {
    let lower = name.to_ascii_lowercase();
    let roles = ["normal", "position", "color", "colour", "vertex", "texcoord"];
    (name.len() == 2 || roles.iter().any(|role| lower.contains(role)) || lower == "pos").then(|| attributes(file))
}

fn attributes(file: &File<'_>) -> Text {
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
    Text::new(
        format!("The attributes of this assignment are {}: which of them carries what you need?", en.join(" and ")),
        format!("この課題の頂点属性は {} です。必要な値がどれに入っているか確かめてください。", ja.join("、")),
    )
}

/// What to say about a word of an older GLSL or of another language.
fn from_elsewhere(file: &File<'_>, name: &str) -> Option<Text> {
    let (origin, instead) = vocabulary::foreign(name)?;
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
        Instead::Nothing => Text::new(format!("{}.", from.en), format!("{}。", from.ja)),
        Instead::Interface if origin == Origin::Fragment => {
            let output = &file.interface.output.name;
            Text::new(
                format!("{}. This vertex shader hands its result on in `{output}`.", from.en),
                format!("{}。このバーテックスシェーダの出力変数は `{output}` です。", from.ja),
            )
        }
        Instead::Interface => {
            let list = |variables: &[Variable]| {
                variables.iter().map(|variable| format!("`{}`", variable.name)).collect::<Vec<_>>().join(", ")
            };
            let (inputs, uniforms) = (list(&file.interface.inputs), list(&file.interface.uniforms));
            Text::new(
                format!("{}. Here the attributes are {inputs}, the matrices {uniforms}.", from.en),
                format!("{}。この課題の頂点属性は {inputs}、行列は {uniforms} です。", from.ja),
            )
        }
    })
}

fn unknown_function(file: &File<'_>, finding: &Finding<'_, '_>, name: &str) -> Diagnostic {
    let text = Text::new(format!("There is no function `{name}`."), format!("`{name}` という関数はありません。"));
    let functions = || file.declarations.iter().filter(|d| d.role == Role::Function).map(|d| d.name);
    let hint = from_elsewhere(file, name).or_else(|| {
        let meant = vocabulary::nearest(name, vocabulary::callables().chain(functions()))?;
        Some(did_you_mean(file, meant, usize::MAX - 1))
    });
    let diagnostic = place(file, finding, name, text);
    match hint {
        Some(hint) => diagnostic.hint(hint),
        None => diagnostic,
    }
}

/// A function of the file that is called before it is defined.
fn defined_later(file: &File<'_>, finding: &Finding<'_, '_>, name: &str) -> Option<Diagnostic> {
    let call = file.code.get(finding.index)?.start;
    let function = file.declarations.iter().find(|d| d.name == name && d.role == Role::Function)?;
    if function.start < call {
        return None;
    }
    let line = file.line(function.start);
    let text = Text::new(
        format!("The function `{name}` is called before it is defined (line {line})."),
        format!("関数 `{name}` が、定義 ({line} 行目) より前で呼び出されています。"),
    );
    Some(file.error_at(finding.index, text).hint(Text::new(
        "Move its definition above the function that calls it, or declare it there first.",
        "呼び出す関数より前に定義を移すか、先に関数の宣言 (プロトタイプ) を書いてください。",
    )))
}

/// A word at `index` that stands where a type or a qualifier belongs.
pub fn unknown_type(file: &File<'_>, index: usize) -> Diagnostic {
    let name = file.code[index].text;
    let text = Text::new(
        format!("`{name}` is neither a type nor a keyword of GLSL."),
        format!("`{name}` は GLSL の型でもキーワードでもありません。"),
    );
    let structures = file.declarations.iter().filter(|d| d.role == Role::Structure).map(|d| d.name);
    let hint = from_elsewhere(file, name).or_else(|| {
        let meant = vocabulary::nearest(name, vocabulary::keywords().chain(structures))?;
        Some(Text::new(format!("Did you mean `{meant}`?"), format!("`{meant}` の間違いではありませんか。")))
    });
    file.error_at(index, text).hint(hint.unwrap_or_else(|| {
        Text::new(
            "If this is meant as a remark, write `//` in front of it.",
            "説明を書いた行であれば、先頭に `//` を付けてコメントにしてください。",
        )
    }))
}

/// For a word that cannot be a name.
pub fn another_name() -> Text {
    Text::new("Choose another name, here and where it is used.", "ここと使っている箇所を、別の名前に変えてください。")
}
