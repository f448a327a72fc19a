//! What every driver refuses and the compiler here lets pass.

use super::declarations::{DeclarationKind, DeclaredName};
use super::directives::directive_name;
use super::file::HintContext;
use super::suggestions;
use super::tokens::{Lexeme, LexemeKind};
use crate::diagnostic::{Diagnostic, DiagnosticStage};
use crate::language::Text;
use crate::source;
use crate::translate::log::MAX_DIAGNOSTICS;
use crate::translate::{LinkedInterface, Variable};
use std::collections::HashSet;

/// From this version on, the two shaders may differ in how an output is interpolated.
const FREE_INTERPOLATION: u32 = 440;

/// The errors that real drivers report in `text` although the compiler accepts it.
pub fn overlooked_errors(text: &str, interface: &LinkedInterface) -> Vec<Diagnostic> {
    let file = HintContext::new(text, interface);
    let mut all: Vec<_> = version(&file).into_iter().collect();
    all.extend(swizzles(&file));
    all.extend(interpolation(&file));
    all.extend(output_in_block(&file));
    all.truncate(MAX_DIAGNOSTICS);
    all
}

/// `#version 410core` and the versions of OpenGL ES, which no desktop program links.
fn version(file: &HintContext<'_>) -> Option<Diagnostic> {
    let line = file.directives.iter().find(|token| directive_name(token.text) == "version")?;
    let mut words = line.text.split("version").nth(1)?.split_ascii_whitespace();
    let (number, profile) = (words.next()?, words.next().unwrap_or_default());
    let text = if number.chars().any(|c| c.is_ascii_alphabetic()) {
        Text::new(
            format!("`{number}` is no version number: a space is missing."),
            format!("`{number}` は版の番号として読めません。番号の後に空白が必要です。"),
        )
    } else if profile == "es" {
        Text::new(
            format!("GLSL {number} es is for OpenGL ES; this program is for desktop OpenGL."),
            format!("GLSL {number} es は OpenGL ES 用です。この課題のプログラムはデスクトップ版の OpenGL を使います。"),
        )
    } else {
        return None;
    };
    let diagnostic = file.error(line.start, line.text.len(), text);
    Some(diagnostic.hint(super::directives::version_hint(file)))
}

/// The version number of the file; 0 if it has none.
fn version_number(file: &HintContext<'_>) -> u32 {
    let line = file.directives.iter().find(|token| directive_name(token.text) == "version");
    let number = line.and_then(|line| line.text.split("version").nth(1)?.split_ascii_whitespace().next());
    number.and_then(|number| number.parse().ok()).unwrap_or(0)
}

/// `.rgb2`, `.e`: the compiler drops a character that names no component.
fn swizzles(file: &HintContext<'_>) -> Vec<Diagnostic> {
    let members = words_of_structures(file);
    let mut found = Vec::new();
    for index in 2..file.code.len() {
        let field = file.code[index];
        let is_field = file.code[index - 1].text == "."
            && field.kind == LexemeKind::Word
            && file.code[index - 2].text != "gl_DepthRange";
        let called = file.word(Some(index + 1)) == "(";
        let odd = field.text.chars().find(|c| !"xyzwrgbastpq".contains(*c));
        let Some(odd) = odd.filter(|_| is_field && !called) else { continue };
        // A member of a structure, what a macro writes, or a branch of `#if` that nobody compiles may be called anything.
        let built_in = [file.code[index - 2].text, field.text].iter().any(|name| name.starts_with("gl_"));
        let known = built_in || members.contains(field.text) || is_in_macro(file, field.text);
        if known || is_conditional(file, field.start) {
            continue;
        }
        let text = Text::new(
            format!("A vector has no components `{}`: `{odd}` names none.", field.text),
            format!("ベクトルに `{}` という成分はありません (`{odd}` は成分名ではありません)。", field.text),
        );
        found.push(file.error_at(index, text).hint(super::components::names_of_components()));
    }
    found
}

/// The words between the braces of structures and blocks. The type of a member may be what a macro writes, so that it is no declaration
/// by itself.
fn words_of_structures<'t>(file: &HintContext<'t>) -> HashSet<&'t str> {
    let opens = (0..file.code.len()).filter(|at| file.code[*at].text == "{");
    let bodies = opens.filter(|open| structure_around(file, open + 1).is_some());
    bodies
        .flat_map(|open| file.code[open + 1..].iter().map(|token| token.text).take_while(|text| *text != "}"))
        .collect()
}

/// Whether a macro is called so, or has the name in what it stands for.
fn is_in_macro(file: &HintContext<'_>, name: &str) -> bool {
    let is_macro = |line: &&Lexeme<'_>| directive_name(line.text) == "define";
    file.directives.iter().filter(is_macro).any(|line| source::words(line.text).any(|(_, word)| word == name))
}

/// The name of the structure or block, among the code tokens, between whose braces the token at `index` stands.
fn structure_around(file: &HintContext<'_>, index: usize) -> Option<usize> {
    let inside = file.code[..index].iter().rposition(|token| matches!(token.text, "{" | "}"))?;
    let name = inside.checked_sub(1).filter(|_| file.code[inside].text == "{")?;
    let is_it = |d: &DeclaredName<'_>| d.role == DeclarationKind::Structure && d.index == name;
    (file.code[name].text == "struct" || file.declarations.iter().any(is_it)).then_some(name)
}

/// Whether the byte `offset` lies between an `#if` and its `#endif`.
fn is_conditional(file: &HintContext<'_>, offset: usize) -> bool {
    let before = file.directives.iter().take_while(|line| line.start < offset);
    let depth = before.fold(0_i32, |depth, line| match directive_name(line.text) {
        "if" | "ifdef" | "ifndef" => depth + 1,
        "endif" => depth - 1,
        _ => depth,
    });
    depth > 0
}

/// The output as a member of a block, which is not the variable that the fragment shader reads.
fn output_in_block(file: &HintContext<'_>) -> Option<Diagnostic> {
    file.interface.outputs.iter().find_map(|output| one_in_block(file, output))
}

fn one_in_block(file: &HintContext<'_>, variable: &Variable) -> Option<Diagnostic> {
    let output = file.anywhere(&variable.name).filter(|d| !d.global)?;
    let block = structure_around(file, output.index)?;
    let is_block = |d: &DeclaredName<'_>| d.ty == "out" && d.index == block;
    file.declarations.iter().any(is_block).then(|| super::link::output_missing(file, variable))
}

/// An output that is `flat` or `noperspective` where the fragment shader's input is not, or the other way round.
fn interpolation(file: &HintContext<'_>) -> Option<Diagnostic> {
    if version_number(file) >= FREE_INTERPOLATION {
        return None;
    }
    let fragment = HintContext::new(file.interface.fragment.to_str().ok()?, file.interface);
    file.interface.outputs.iter().find_map(|output| interpolation_of(file, &fragment, &output.name))
}

fn interpolation_of(file: &HintContext<'_>, fragment: &HintContext<'_>, name: &str) -> Option<Diagnostic> {
    let is =
        |d: &&DeclaredName<'_>, qualifiers: [&str; 2]| d.global && d.name == name && qualifiers.iter().any(|q| d.is(q));
    let output = file.declarations.iter().find(|d| is(d, ["out", "varying"]))?;
    let input = fragment.declarations.iter().find(|d| is(d, ["in", "varying"]))?;
    let qualifier = ["flat", "noperspective"].into_iter().find(|q| output.is(q) != input.is(q))?;
    let text = Text::new(
        format!("The output `{name}` and the fragment shader's input differ in `{qualifier}`."),
        format!("出力変数 `{name}` とフラグメントシェーダの入力変数とで、`{qualifier}` の有無が異なっています。"),
    );
    let declaration = suggestions::declaration_of(file, name)?;
    let diagnostic = Diagnostic { stage: DiagnosticStage::Link, ..file.error_at(output.index, text) };
    Some(diagnostic.hint(Text::new(
        format!("It must be declared as `{declaration}`."),
        format!("`{declaration}` と宣言してください。"),
    )))
}
