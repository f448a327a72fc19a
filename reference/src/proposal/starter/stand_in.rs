//! What stands in a starter for a part that was taken out, so that the rest compiles and runs.

use super::plain::{assigned, path_in, plain, written_parameters};
use crate::interpreter::Type;
use crate::interpreter::outline::{self, FunctionText, StatementText};
use crate::proposal::source::SolutionFile;
use std::ops::RangeInclusive;

/// A statement in the place of others.
pub(super) enum StandIn {
    /// The declaration of a variable that the text behind the part uses.
    Variable(String),
    /// The value of an output or an `out` parameter that nothing else writes.
    Output(String),
    /// The `return` of the function with this name.
    Result(String, String),
}

impl StandIn {
    /// The statement.
    pub fn text(&self) -> &str {
        match self {
            Self::Variable(text) | Self::Output(text) | Self::Result(text, _) => text,
        }
    }
}

/// What stands for these lines of a solution.
pub(super) fn for_part(source: &SolutionFile, lines: RangeInclusive<u32>) -> Vec<StandIn> {
    let functions = outline::functions(&source.text);
    let line_of = |at: usize| source.text[..at].matches('\n').count() as u32 + 1;
    let is_around =
        |function: &&FunctionText| function.name.line < *lines.start() && line_of(function.body.end) > *lines.end();
    let Some(around) = functions.iter().find(is_around) else { return Vec::new() };
    let mut all: Vec<StandIn> = variables(source, around, &lines);
    let outputs = match around.name.text.as_str() {
        "main" => outputs(source, &functions, &lines),
        _ => parameters(around, &lines),
    };
    all.extend(outputs.into_iter().map(StandIn::Output));
    all.extend(result(around, &lines).map(|text| StandIn::Result(text, around.name.text.clone())));
    all
}

/// The variables of the function itself that the part declares and the text behind it uses.
fn variables(source: &SolutionFile, around: &FunctionText, lines: &RangeInclusive<u32>) -> Vec<StandIn> {
    let words = source.words();
    let end = around.body.end;
    let is_behind =
        |name: &str| words.iter().any(|word| word.line > *lines.end() && word.range.start < end && word.text == name);
    let declared: Vec<(String, Type)> = match around.name.text.as_str() {
        "main" => {
            let locals = source.program.locals().iter().filter(|local| lines.contains(&local.line));
            locals.map(|local| (local.name.clone(), local.kind.clone())).collect()
        }
        _ => around.statements.iter().filter(|own| is_within(own, lines)).filter_map(declared).collect(),
    };
    let used = declared.into_iter().filter(|(name, _)| is_behind(name));
    used.filter_map(|(name, kind)| Some(StandIn::Variable(format!("{kind} {name} = {};", plain(&kind, false)?))))
        .collect()
}

/// The variable that a statement of the function's own braces declares, if it does.
fn declared(statement: &StatementText) -> Option<(String, Type)> {
    let words = statement.words.iter().filter(|word| word.text != "const");
    let mut words = words.filter(|_| statement.depth == 0 && statement.under.is_empty());
    let kind = Type::named(&words.next()?.text)?;
    let name = words.next().filter(|name| name.is_name)?;
    matches!(words.next()?.text.as_str(), "=" | ";").then(|| (name.text.clone(), kind))
}

fn is_within(statement: &StatementText, lines: &RangeInclusive<u32>) -> bool {
    lines.contains(&statement.words[0].line)
}

/// Plain values of the outputs of `main` that nothing but the part writes.
fn outputs(source: &SolutionFile, functions: &[FunctionText], lines: &RangeInclusive<u32>) -> Vec<String> {
    let is_written = |name: &str, inside: bool| {
        let mut words =
            functions.iter().flat_map(|function| &function.statements).flat_map(|statement| &statement.words);
        words.any(|word| word.text == name && lines.contains(&word.line) == inside)
    };
    let mut all = Vec::new();
    for output in source.program.outputs() {
        let name = path_in(source, &output.name);
        let name = name.split(['.', '[']).next().unwrap_or(&name);
        if is_written(name, true) && !is_written(name, false) {
            all.extend(assigned(source, &output.name, &output.kind));
        }
    }
    all
}

/// Plain values of the `out` parameters that nothing but the part writes.
fn parameters(around: &FunctionText, lines: &RangeInclusive<u32>) -> Vec<String> {
    let is_written = |name: &str, inside: bool| {
        let mut words = around.statements.iter().flat_map(|statement| &statement.words);
        words.any(|word| word.text == name && lines.contains(&word.line) == inside)
    };
    let own = written_parameters(around).into_iter();
    own.filter(|(name, _)| is_written(name, true) && !is_written(name, false)).map(|(_, text)| text).collect()
}

/// A `return` where the last one of the function lies in the part.
fn result(around: &FunctionText, lines: &RangeInclusive<u32>) -> Option<String> {
    let last = around.statements.iter().rfind(|statement| statement.words[0].text == "return")?;
    let kind = Type::named(&around.result.text)?;
    is_within(last, lines).then(|| plain(&kind, false)).flatten().map(|value| format!("return {value};"))
}
