//! What the compiler takes and only some drivers do: it is graded, with a warning.

use super::strict::{CodeStatement, statements};
use super::{LinkedInterface, text};
use crate::diagnostic::{Diagnostic, DiagnosticStage};
use crate::language::Text;
use crate::source::{self, Source};

/// The first version that all drivers of the core profile take.
const FIRST_COMMON_VERSION: i32 = 140;
/// From this version on, the two shaders may differ in interpolation.
const FREE_INTERPOLATION: i32 = 440;
/// From this version on, they may differ in invariance.
const FREE_INVARIANCE: i32 = 420;
/// In every version, drivers refuse an output with a location that the input has not.
const FREE_LOCATIONS: i32 = i32::MAX;

/// The warnings about `source`, which the compiler accepts.
pub(super) fn warnings(source: &Source, interface: &LinkedInterface) -> Vec<Diagnostic> {
    let version = source.version();
    let mut warnings: Vec<_> = version_line(source, version).into_iter().collect();
    warnings.extend(late_extension(source));
    if interface.fragment.is_empty() {
        return warnings;
    }
    let outputs = || interface.outputs.iter().map(|output| output.name.as_str());
    warnings.extend(outputs().next().and_then(|output| invariant_pragma(source, version, output)));
    let code = text::without_directives(source.code());
    let fixed = interface.fragment.to_str().map(text::without_directives).unwrap_or_default();
    let is_in_both = |output: &str, word: &str| {
        statements(&fixed).any(|own| own.position(output).is_some() && own.position(word).is_some())
    };
    let of = |statement: CodeStatement<'_>| {
        outputs().find_map(|output| qualifier(source, &statement, version, output, &|word| is_in_both(output, word)))
    };
    warnings.extend(statements(&code).filter_map(of));
    warnings
}

/// The first warning about `source`, one of two stages that are handed in, that its word `smooth` is not in the other's declaration.
/// The two hand over `variables`.
pub(super) fn smooth_alone(source: &Source, other: &Source, variables: &[&str], version: i32) -> Option<Diagnostic> {
    let [code, others] = [source, other].map(|source| text::without_directives(source.code()));
    let is_in_both = |variable: &str, word: &str| {
        word != "smooth"
            || statements(&others).any(|own| own.position(variable).is_some() && own.position(word).is_some())
    };
    statements(&code).find_map(|statement| {
        let of = |variable: &&str| qualifier(source, &statement, version, variable, &|word| is_in_both(variable, word));
        variables.iter().find_map(of)
    })
}

fn warning(source: &Source, (at, word): (usize, &str), message: Text) -> Diagnostic {
    let (line, column) = source.position(at);
    Diagnostic::warning(DiagnosticStage::Compile, message).at(line, Some(column)).spanning(word.len())
}

/// The directives called `name`, each with the words behind that.
fn directives<'a>(source: &'a Source, name: &'a str) -> impl Iterator<Item = Vec<(usize, &'a str)>> {
    let mut start = 0;
    let lines = source.code().split_inclusive('\n').map(move |line| {
        start += line.len();
        (start - line.len(), line)
    });
    lines.filter(|(_, line)| line.trim_start().starts_with('#')).filter_map(move |(start, line)| {
        let words: Vec<_> = source::words(line).map(|(at, word)| (start + at, word)).collect();
        (words.first()?.1 == name).then(|| words[1..].to_vec())
    })
}

/// A version that came before the core profile, or another profile.
fn version_line(source: &Source, version: i32) -> Option<Diagnostic> {
    let words = directives(source, "version").next().unwrap_or_default();
    let number = words.first().copied().unwrap_or((0, ""));
    if version < FIRST_COMMON_VERSION {
        let (en, ja) = if number.1.is_empty() {
            (
                "Without `#version` this is GLSL 1.10".to_owned(),
                "`#version` がないので GLSL 1.10 とみなされます".to_owned(),
            )
        } else {
            (format!("`#version {}` is old", number.1), format!("`#version {}` は古い版です", number.1))
        };
        let message = Text::new(
            format!("{en}; drivers that have only the core profile refuse it."),
            format!("{ja}。コアプロファイルだけに対応したドライバではエラーになります。"),
        );
        return Some(warning(source, number, message));
    }
    let profile = compatibility(source)?;
    let message = Text::new(
        "Drivers that have only the core profile refuse `compatibility`.",
        "コアプロファイルだけに対応したドライバでは `compatibility` はエラーになります。",
    );
    Some(warning(source, profile, message))
}

/// The word that asks for the compatibility profile.
fn compatibility(source: &Source) -> Option<(usize, &str)> {
    let words = directives(source, "version").next()?;
    words.get(1).copied().filter(|(_, word)| *word == "compatibility")
}

/// Whether a text asks for the compatibility profile.
pub(super) fn is_compatible(source: &Source) -> bool {
    compatibility(source).is_some()
}

/// An `#extension` behind the first declaration.
fn late_extension(source: &Source) -> Option<Diagnostic> {
    let is_code = |line: &&str| !line.trim().is_empty() && !line.trim_start().starts_with('#');
    let first = source.code().lines().position(|line| is_code(&line))? as u32 + 1;
    let mut places = directives(source, "extension").filter_map(|words| words.first().copied());
    let late = places.find(|&(at, _)| source.position(at).0 > first)?;
    let message = Text::new(
        "An `#extension` stands before everything else; some drivers refuse it here.",
        "`#extension` はほかのすべての宣言より前に書くものです。ドライバによってはここではエラーになります。",
    );
    Some(warning(source, late, message))
}

/// `#pragma STDGL invariant(all)`, which the fixed fragment shader does not say.
fn invariant_pragma(source: &Source, version: i32, output: &str) -> Option<Diagnostic> {
    let is_it = |words: &Vec<(usize, &str)>| words.iter().map(|word| word.1).eq(["STDGL", "invariant", "all"]);
    let words = directives(source, "pragma").find(is_it).filter(|_| version < FREE_INVARIANCE)?;
    Some(warning(source, words[1], differs("invariant", output)))
}

fn differs(qualifier: &str, output: &str) -> Text {
    Text::new(
        format!(
            "`{output}` is `{qualifier}` here and not in the fragment shader; some drivers refuse to link the two."
        ),
        format!(
            "`{output}` にはここで `{qualifier}` が付きますが、フラグメントシェーダの側には付いていません。\
             ドライバによってはリンク時にエラーになります。"
        ),
    )
}

/// What stands before a variable that one stage hands to the other, and not before it in the other's text.
fn qualifier(
    source: &Source,
    statement: &CodeStatement<'_>,
    version: i32,
    output: &str,
    is_in_both: &dyn Fn(&str) -> bool,
) -> Option<Diagnostic> {
    let named = statement.position(output)?;
    let before = &statement.words[..named];
    let is_declaration = before.iter().any(|(_, word)| matches!(*word, "in" | "out" | "varying"));
    let is_redeclaration = named == 1 && before[0].1 == "invariant";
    if !is_declaration && !is_redeclaration {
        return None;
    }
    let until = |word: &str| match word {
        "smooth" | "centroid" => FREE_INTERPOLATION,
        "invariant" => FREE_INVARIANCE,
        "location" => FREE_LOCATIONS,
        _ => 0,
    };
    let &place = before.iter().find(|(_, word)| version < until(word) && !is_in_both(word))?;
    let message = match place.1 {
        // Smooth is what it is anyhow.
        "smooth" => Text::new(
            format!(
                "`smooth` says what `{output}` is anyhow; drivers that compare the declarations word by word refuse it."
            ),
            format!(
                "`smooth` は省略したときと同じ意味です。`{output}` の宣言を厳密に比べるドライバではエラーになります。"
            ),
        ),
        other => differs(other, output),
    };
    Some(warning(source, place, message))
}
