//! What the linker says about the stages of a program.

use super::declarations::{DeclarationKind, DeclaredName};
use super::file::HintContext;
use super::suggestions;
use super::vocabulary;
use crate::diagnostic::{Diagnostic, DiagnosticStage};
use crate::language::Text;
use crate::source;
use crate::translate::Variable;
use crate::translate::log::LogEntry;

/// Puts a message of the linker into words.
pub fn explain(file: &HintContext<'_>, entry: &LogEntry<'_>) -> Diagnostic {
    let message = entry.message;
    let is_told = |output: &&Variable| {
        let words = entry.more.iter().copied().chain([message, entry.token]);
        words.flat_map(source::words).any(|(_, word)| word == output.name)
    };
    let output = || file.interface.outputs.iter().find(is_told);
    let found = if message.contains("no matching declaration for statically used input") {
        output().map(|output| output_missing(file, output))
    } else if message.contains("Member names and types must match") {
        members_differ(file, &entry.more.join(" "))
    } else if message.contains("must match") || message.contains("must be compatible") {
        let of_output = || output().and_then(|output| output_differs(file, output, message));
        let more = entry.more.join(" ");
        let of_location = || location_differs(file, &more).filter(|_| message.contains("location"));
        uniform_differs(file, &more).or_else(of_location).or_else(of_output)
    } else if message.contains("Missing entry point") {
        Some(no_main(file))
    } else if message.contains("Recursion detected") {
        recursion(file, entry)
    } else if message.contains("No function definition") {
        no_body(file, entry)
    } else {
        None
    };
    found.unwrap_or_else(|| {
        let more = entry.more.join(" ");
        let words = format!("{message} {more}");
        let words = words.trim();
        Diagnostic::error(
            DiagnosticStage::Link,
            Text::new(
                format!("The shaders cannot be linked: “{words}”."),
                format!("シェーダをリンクできません:「{words}」。"),
            ),
        )
    })
}

fn at(file: &HintContext<'_>, declaration: &DeclaredName<'_>, text: Text) -> Diagnostic {
    Diagnostic { stage: DiagnosticStage::Link, ..file.error_at(declaration.index, text) }
}

/// How the fragment shader's input wants the output declared.
fn output_hint(file: &HintContext<'_>, name: &str) -> Text {
    let needed = suggestions::declaration_of(file, name).unwrap_or_default();
    Text::new(
        format!("The fragment shader's input fits an output `{needed}`: the name and the type must be just these."),
        format!("フラグメントシェーダの入力に合う宣言は `{needed}` です。変数名と型をこれに合わせてください。"),
    )
}

/// An error of the compiler: `own` has the name of the output and is none.
/// Says that the output of the homework is not declared.
pub fn output_missing_as(file: &HintContext<'_>, own: &DeclaredName<'_>) -> Diagnostic {
    let name = own.name;
    let text = if own.global {
        Text::new(
            format!("`{name}` is not declared as an output (`out`) of this shader."),
            format!("`{name}` が出力変数 (`out`) として宣言されていません。"),
        )
    } else {
        Text::new(
            format!("This `{name}` exists only inside its function or block; the shader has no output `{name}`."),
            format!("この `{name}` は関数やブロックの中だけの変数です。出力変数 `{name}` がありません。"),
        )
    };
    file.error_at(own.index, text).hint(output_hint(file, name))
}

/// Whether `declaration` is an output variable, also in the words of old GLSL.
fn is_output(declaration: &DeclaredName<'_>) -> bool {
    let output = declaration.is("out") || declaration.is("varying");
    declaration.global && declaration.role == DeclarationKind::Variable && output
}

/// Says that the output of the homework is not declared.
pub fn output_missing(file: &HintContext<'_>, output: &Variable) -> Diagnostic {
    let name = output.name.as_str();
    let hint = output_hint(file, name);
    if let Some(swallowed) = file.swallowed(name).filter(|_| file.anywhere(name).is_none()) {
        return Diagnostic { stage: DiagnosticStage::Link, ..swallowed };
    }
    if let Some(own) = file.anywhere(name).filter(|d| !is_output(d)) {
        return Diagnostic { stage: DiagnosticStage::Link, ..output_missing_as(file, own) };
    }
    let outputs: Vec<_> =
        file.declarations.iter().filter(|d| is_output(d) && !file.interface.is_output(d.name)).collect();
    let near = vocabulary::nearest(name, outputs.iter().map(|d| d.name));
    let same_type = || outputs.iter().find(|d| d.ty == output.ty);
    match outputs.iter().find(|d| Some(d.name) == near).or_else(same_type).or(outputs.first()) {
        Some(renamed) => {
            let own = renamed.name;
            let text = Text::new(
                format!("The fragment shader reads `{name}`, but this output is called `{own}`."),
                format!("フラグメントシェーダが受け取る変数は `{name}` ですが、この出力変数の名前は `{own}` です。"),
            );
            at(file, renamed, text).hint(hint)
        }
        None => Diagnostic::error(
            DiagnosticStage::Link,
            Text::new(
                format!("The output `{name}`, which the fragment shader reads, is not declared."),
                format!("フラグメントシェーダが受け取る出力変数 `{name}` が宣言されていません。"),
            ),
        )
        .hint(hint),
    }
}

fn output_differs(file: &HintContext<'_>, output: &Variable, message: &str) -> Option<Diagnostic> {
    let own = file.declarations.iter().find(|d| d.name == output.name && is_output(d))?;
    let (name, ty, needed) = (own.name, &own.ty, &output.ty);
    let text = if message.contains("Types must match") || message.contains("Array sizes") {
        Text::new(
            format!("The output `{name}` has type {ty}, but the fragment shader reads {needed}."),
            format!("出力変数 `{name}` は {ty} 型ですが、フラグメントシェーダが受け取るのは {needed} 型です。"),
        )
    } else {
        Text::new(
            format!("The output `{name}` carries a qualifier that the fragment shader's input does not have."),
            format!("出力変数 `{name}` の修飾子が、フラグメントシェーダの入力変数と一致していません。"),
        )
    };
    let declaration = suggestions::declaration_of(file, name)?;
    Some(at(file, own, text).hint(Text::new(
        format!("It must be declared as `{declaration}`."),
        format!("`{declaration}` と宣言してください。"),
    )))
}

/// A structure or block that both stages declare: `more` is the compiler's `Block: S vertex stage: " float a" fragment stage: " int b"`.
fn members_differ(file: &HintContext<'_>, more: &str) -> Option<Diagnostic> {
    let behind = |words: &str| more.split_once(words).map(|(_, rest)| rest);
    let name = behind("Block: ")?.split_whitespace().next()?;
    let member = |stage: &str| behind(stage)?.trim_start_matches([' ', '"']).split('"').next();
    let [vertex, fragment] = [member("vertex stage:")?, member("fragment stage:")?];
    let own = file.declarations.iter().find(|d| d.role == DeclarationKind::Structure && d.name == name)?;
    let text = Text::new(
        format!("The two files declare `{name}` differently: `{vertex}` in the vertex shader, `{fragment}` here."),
        format!(
            "`{name}` の宣言が 2 つのファイルで異なっています。頂点シェーダでは `{vertex}`、ここでは `{fragment}` です。"
        ),
    );
    let hint = Text::new(
        "Both need the same members, with the same types and in the same order.",
        "メンバは、名前も型も順序も、両方で同じにしてください。",
    );
    Some(at(file, own, text).hint(hint))
}

/// A uniform that both stages declare, or what the one hands to the other: `more` is the compiler's `vertex stage: " float a" fragment stage: " int a"`.
fn uniform_differs(file: &HintContext<'_>, more: &str) -> Option<Diagnostic> {
    let declared = |stage: &str| {
        let text = more.split_once(stage)?.1.trim_start_matches([' ', '"']).split('"').next()?.trim();
        // Of a structure the members are told, and not its name.
        Some(text.rsplit_once('}').map_or(text, |(_, name)| name).trim())
    };
    let [vertex, fragment] = [declared("vertex stage:")?, declared("fragment stage:")?];
    let (_, name) = source::words(fragment.split('[').next()?).last()?;
    let is_it = |d: &&DeclaredName<'_>| d.global && (d.is("uniform") || d.is("in")) && d.name == name;
    let own = file.declarations.iter().find(is_it).filter(|own| own.is("uniform") || vertex != fragment)?;
    let text = Text::new(
        format!("The two files declare `{name}` differently: `{vertex}` in the vertex shader, `{fragment}` here."),
        format!(
            "`{name}` の宣言が 2 つのファイルで異なっています。頂点シェーダでは `{vertex}`、ここでは `{fragment}` です。"
        ),
    );
    let hint = match own.is("in") {
        false => Text::new("A uniform is one for both.", "uniform 変数は両方のシェーダに共通です。"),
        true => Text::new(
            "What the vertex shader hands over needs the same type in both files.",
            "頂点シェーダから渡す変数は、両方のファイルで同じ型にしてください。",
        ),
    };
    Some(at(file, own, text).hint(hint))
}

/// What has other locations in the two stages: `more` is the compiler's
/// `vertex stage: a "layout( location=1) smooth out" fragment stage: a "layout( location=2) smooth in"`.
fn location_differs(file: &HintContext<'_>, more: &str) -> Option<Diagnostic> {
    let declared = |stage: &str| {
        let (name, rest) = more.split_once(stage)?.1.trim_start().split_once(' ')?;
        let number = rest.split_once("location=")?.1;
        let end = number.find(|c: char| !c.is_ascii_digit()).unwrap_or(number.len());
        Some((name, &number[..end]))
    };
    let [(_, vertex), (name, fragment)] = [declared("vertex stage:")?, declared("fragment stage:")?];
    let own = file.declarations.iter().find(|d| d.global && d.is("in") && d.name == name)?;
    let text = Text::new(
        format!("`{name}` has location {vertex} in the vertex shader, and {fragment} here."),
        format!("`{name}` の location は、頂点シェーダでは {vertex}、ここでは {fragment} です。"),
    );
    let hint = Text::new("Both need the same location.", "location は両方で同じにしてください。");
    Some(at(file, own, text).hint(hint))
}

fn no_main(file: &HintContext<'_>) -> Diagnostic {
    if let Some(swallowed) = file.swallowed("main") {
        return Diagnostic { stage: DiagnosticStage::Link, ..swallowed };
    }
    let text = Text::new("The file has no function `main`.", "関数 `main` がありません。");
    let functions = || file.declarations.iter().filter(|d| d.role == DeclarationKind::Function);
    let near = vocabulary::nearest("main", functions().map(|d| d.name));
    match functions().find(|d| Some(d.name) == near) {
        Some(function) => {
            let name = function.name;
            at(file, function, text).hint(Text::new(
                format!("Is `{name}` meant to be `main`? Capital and small letters differ in GLSL."),
                format!("`{name}` は `main` の間違いではありませんか。GLSL では大文字と小文字を区別します。"),
            ))
        }
        None => Diagnostic::error(DiagnosticStage::Link, text)
            .hint(Text::new("A shader begins at `void main()`.", "シェーダの処理は `void main()` から始まります。")),
    }
}

/// The function names in the compiler's lines about functions: `f(f1; calling g(vf3;`.
fn function_names<'e>(entry: &LogEntry<'e>) -> Vec<&'e str> {
    let line = entry.more.first().copied().unwrap_or_default();
    line.split(" calling ").filter_map(|mangled| mangled.split_once('(')).map(|(name, _)| name.trim()).collect()
}

fn recursion(file: &HintContext<'_>, entry: &LogEntry<'_>) -> Option<Diagnostic> {
    let names = function_names(entry);
    let (caller, callee) = (*names.first()?, *names.last()?);
    let is_body = |d: &&DeclaredName<'_>| {
        let close = file.closing(d.index + 1);
        d.role == DeclarationKind::Function && close.is_some_and(|close| file.word(Some(close + 1)) == "{")
    };
    // Of several functions of one name any may be meant, and a macro may hide the call.
    let bodies = || file.declarations.iter().filter(|d| d.name == caller).filter(is_body);
    let call_in = |body: &DeclaredName<'_>| {
        let open = file.closing(body.index + 1)? + 1;
        let close = file.closing(open)?;
        (open..close).find(|&at| file.code[at].text == callee && file.word(Some(at + 1)) == "(")
    };
    let (body, call) = (bodies().next()?, bodies().find_map(call_in));
    let text = match caller == callee {
        true => Text::new(
            format!("`{caller}` calls itself here. GLSL has no recursion."),
            format!("関数 `{caller}` がここで自分自身を呼び出しています。GLSL では再帰呼び出しはできません。"),
        ),
        false => Text::new(
            format!("`{caller}` calls itself here, through `{callee}`. GLSL has no recursion."),
            format!(
                "関数 `{caller}` がここで、`{callee}` を通じて自分自身を呼び出しています。GLSL では再帰呼び出しはできません。"
            ),
        ),
    };
    let placed = match call {
        Some(call) => file.error_at(call, text),
        None => at(file, body, text),
    };
    let diagnostic = Diagnostic { stage: DiagnosticStage::Link, ..placed };
    Some(diagnostic.hint(Text::new("Use a loop instead.", "繰り返しには `for` などのループを使ってください。")))
}

fn no_body(file: &HintContext<'_>, entry: &LogEntry<'_>) -> Option<Diagnostic> {
    let name = *function_names(entry).first()?;
    let declared = file.declarations.iter().find(|d| d.role == DeclarationKind::Function && d.name == name)?;
    let text = Text::new(
        format!("The function `{name}` is declared but has no body `{{ … }}`."),
        format!("関数 `{name}` は宣言されていますが、本体 `{{ … }}` がありません。"),
    );
    Some(at(file, declared, text))
}
