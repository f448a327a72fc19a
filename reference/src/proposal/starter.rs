//! The starter: the solution without what students write.
//!
//! What stands between `// ggrade: begin` and `// ggrade: end` is taken out; `// ggrade: instead TEXT` there puts TEXT in its
//! place. Without marks the body of `main` is taken out, and the outputs get a plain value.

mod plain;
mod stand_in;

use super::FolderPlan;
use super::source::SolutionFile;
use crate::assignment::AssignmentError;
use crate::interpreter::Program;
use crate::interpreter::outline::{self, FunctionText};
use crate::text::{Text, both};
use plain::{assigned, written_parameters};
use stand_in::{StandIn, for_part};
use std::ops::RangeInclusive;

/// What begins a mark.
const MARK: &str = "// ggrade:";

/// What a starter says where something is missing.
const HINT: &str = "// Write your code here.";

enum StarterMark {
    Begin,
    End,
    Instead(String),
}

/// Cuts the starters of all solutions. Where one file has marks, a file without is handed out as it is.
pub(super) fn cut(plan: &mut FolderPlan) -> Result<(), AssignmentError> {
    let marked: Vec<bool> = plan.sources.iter().map(|source| source.text.contains(MARK)).collect();
    let any = marked.iter().any(|marked| *marked);
    for (at, is_marked) in marked.into_iter().enumerate() {
        let source = &plan.sources[at];
        let (starter, remarks) = match (is_marked, any) {
            (true, _) => between_marks(source)?,
            (false, true) => (source.text.clone(), vec![StarterRemark::AsItIs]),
            (false, false) => of_plain_values(source),
        };
        compiles(source, &starter)?;
        for told in remarks {
            tell(plan, at, told);
        }
        plan.starters.push(starter);
    }
    Ok(())
}

enum StarterRemark {
    Marks(usize),
    AsItIs,
    StandIn(StandIn),
    NoMarks,
    Left(Vec<String>),
}

fn tell(plan: &mut FolderPlan, at: usize, told: StarterRemark) {
    let (starter, entry) = (plan.sources[at].starter_name(), plan.sources[at].entry);
    match told {
        StarterRemark::Marks(count) => plan.read(
            format!("{starter}: the solution without the {count} part(s) between `// ggrade: begin` and `// ggrade: end`"),
            format!("{starter}: 解答から `// ggrade: begin` と `// ggrade: end` の間 ({count} か所) を除いたもの"),
        ),
        StarterRemark::AsItIs => plan.attention(
            format!("{starter}: has no marks, so that it is handed out as it is; the other file has marks"),
            format!("{starter}: 印がないため、そのまま配布されます (もう一方のファイルには印があります)"),
        ),
        StarterRemark::StandIn(StandIn::Variable(what)) => plan.guessed(
            format!("{starter}: `{what}` stands for a variable that is used behind the part that was taken out"),
            format!("{starter}: 取り除いた部分より後で使われる変数の代わりに `{what}` を置きました"),
        ),
        StarterRemark::StandIn(StandIn::Output(what)) => plan.guessed(
            format!("{starter}: `{what}` gives a value to what nothing but the part that was taken out writes"),
            format!("{starter}: 取り除いた部分だけで値が決まる変数のために `{what}` を置きました"),
        ),
        StarterRemark::StandIn(StandIn::Result(what, function)) => plan.guessed(
            format!("{starter}: `{what}` stands for the `return` of `{function}`, which was taken out"),
            format!("{starter}: 取り除いた `{function}` の `return` の代わりに `{what}` を置きました"),
        ),
        StarterRemark::NoMarks => plan.guessed(
            format!(
                "{starter}: there are no marks, so the body of `{entry}` is taken out, and the outputs get a plain value; to cut \
                 elsewhere, write `// ggrade: begin` and `// ggrade: end` around what students write"
            ),
            format!(
                "{starter}: 印がないので `{entry}` の中身を取り除き、出力には単純な値を入れました。別の場所で切るには、学生が書く部分を \
                 `// ggrade: begin` と `// ggrade: end` で囲んでください"
            ),
        ),
        StarterRemark::Left(names) => {
            let names = names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
            plan.attention(
                format!("{starter}: hands out the functions {names} of the solution; put marks around what students should write"),
                format!("{starter}: 解答の関数 {names} も配布されます。学生に書かせる部分は印で囲んでください"),
            );
        }
    }
}

/// The mark in a line, with the text behind it.
fn mark(line: &str) -> Option<Result<StarterMark, &str>> {
    let rest = line.trim_start().strip_prefix(MARK)?.trim();
    Some(match rest.split_once(' ').unwrap_or((rest, "")) {
        ("begin", _) => Ok(StarterMark::Begin),
        ("end", _) => Ok(StarterMark::End),
        ("instead", text) if !text.trim().is_empty() => Ok(StarterMark::Instead(text.trim().to_owned())),
        _ => Err(rest),
    })
}

fn between_marks(source: &SolutionFile) -> Result<(String, Vec<StarterRemark>), AssignmentError> {
    let refused = |line: u32, en: String, ja: String| Err(source.wrong(line, both(en, ja)));
    let mut starter = String::new();
    let mut removed: Vec<RangeInclusive<u32>> = Vec::new();
    let mut open: Option<(u32, String, Vec<String>)> = None;
    let mut told = Vec::new();
    for (number, line) in (1_u32..).zip(source.text.split_inclusive('\n')) {
        match (mark(line), open.take()) {
            (None, None) => starter += line,
            (None, inside) => open = inside,
            (Some(Ok(StarterMark::Begin)), None) => {
                let indent = line[..line.len() - line.trim_start().len()].to_owned();
                open = Some((number, indent, Vec::new()));
            }
            (Some(Ok(StarterMark::Instead(text))), Some((first, indent, mut instead))) => {
                instead.push(text);
                open = Some((first, indent, instead));
            }
            (Some(Ok(StarterMark::End)), Some((first, indent, instead))) => {
                let stand_ins = if instead.is_empty() { for_part(source, first..=number) } else { Vec::new() };
                let hint = if instead.is_empty() { Some(HINT) } else { None };
                let instead = instead.iter().map(String::as_str);
                for text in hint.into_iter().chain(stand_ins.iter().map(StandIn::text)).chain(instead) {
                    starter += &format!("{indent}{text}\n");
                }
                told.extend(stand_ins.into_iter().map(StarterRemark::StandIn));
                removed.push(first..=number);
            }
            (Some(Ok(StarterMark::Begin)), Some((first, ..))) => {
                return refused(
                    number,
                    format!("`begin` stands within the part that begins in line {first}: write `{MARK} end` before it"),
                    format!(
                        "{first} 行目で始まる部分の中に `begin` があります。その前に `{MARK} end` を書いてください"
                    ),
                );
            }
            (Some(Ok(_)), None) => {
                return refused(
                    number,
                    format!("no part begins before this mark: write `{MARK} begin` above what students write"),
                    format!("この印より前に始まりがありません。学生が書く部分の上に `{MARK} begin` を書いてください"),
                );
            }
            (Some(Err(other)), _) => {
                return refused(
                    number,
                    format!("`{other}` is no mark: write `{MARK} begin`, `{MARK} instead TEXT` or `{MARK} end`"),
                    format!(
                        "`{other}` という印はありません。`{MARK} begin`、`{MARK} instead 文`、`{MARK} end` のいずれかを書いてください"
                    ),
                );
            }
        }
    }
    if let Some((first, ..)) = open {
        return refused(
            first,
            format!("the part that begins here does not end: write `{MARK} end` below what students write"),
            format!("ここで始まる部分の終わりがありません。学生が書く部分の下に `{MARK} end` を書いてください"),
        );
    }
    if removed.is_empty() {
        return refused(0, format!("has no `{MARK} begin`"), format!("`{MARK} begin` がありません"));
    }
    told.insert(0, StarterRemark::Marks(removed.len()));
    Ok((starter, told))
}

/// The solution with a body of its entry that gives every output a plain value.
fn of_plain_values(source: &SolutionFile) -> (String, Vec<StarterRemark>) {
    let functions = outline::functions(&source.text);
    let Some(entry) = functions.iter().find(|function| function.name.text == source.entry) else {
        return (source.text.clone(), vec![StarterRemark::AsItIs]);
    };
    let lines: Vec<String> = match source.entry {
        "main" => {
            let outputs = source.program.outputs().iter();
            outputs.filter_map(|output| assigned(source, &output.name, &output.kind)).collect()
        }
        _ => written_parameters(entry).into_iter().map(|(_, text)| text).collect(),
    };
    let body: String =
        std::iter::once(HINT).chain(lines.iter().map(String::as_str)).map(|line| format!("    {line}\n")).collect();
    let text = &source.text;
    let starter = format!("{}\n{body}{}", &text[..entry.body.start], &text[entry.body.end..]);
    let own = ["main", "mainImage"];
    let left: Vec<String> = functions
        .iter()
        .map(|function| &function.name.text)
        .filter(|name| !own.contains(&name.as_str()))
        .cloned()
        .collect();
    let mut told = vec![StarterRemark::NoMarks];
    told.extend((!left.is_empty()).then_some(StarterRemark::Left(left)));
    (starter, told)
}

/// A starter has to be a whole shader.
fn compiles(source: &SolutionFile, starter: &str) -> Result<(), AssignmentError> {
    let (line, what, example) = match (Program::compile(starter, source.stage), without_return(starter)) {
        (Err(refusal), _) => (refusal.line, refusal.what().clone(), "vec3 name = vec3(0.0);"),
        (Ok(_), Some((line, what))) => (line, what, "return vec3(0.0);"),
        (Ok(_), None) => return Ok(()),
    };
    let line = starter.lines().nth((line as usize).saturating_sub(1)).unwrap_or_default().trim();
    // The same line of the solution, where it is known to the lecturer.
    let same = source.text.lines().position(|own| own.trim() == line && !line.is_empty()).map_or(0, |at| at as u32 + 1);
    let Text { en, ja } = what;
    Err(source.wrong(
        same,
        both(
            format!(
                "without what stands between the marks this does not compile: {en}. Write `{MARK} instead …` between the marks, with \
                 what the starter has in their place, such as `{MARK} instead {example}`"
            ),
            format!(
                "印の間を取り除くとコンパイルできません: {ja}。配布ファイルに代わりに置く文を、印の間に `{MARK} instead …` と書いてください \
                 (例: `{MARK} instead {example}`)"
            ),
        ),
    ))
}

/// A function with a result that has no `return`: the interpreter runs it, and compilers refuse it.
fn without_return(starter: &str) -> Option<(u32, Text)> {
    let functions = outline::functions(starter);
    let returns = |function: &FunctionText| function.statements.iter().any(|own| own.words[0].text == "return");
    let lacking = functions.iter().find(|function| function.result.text != "void" && !returns(function))?;
    let name = &lacking.name;
    let message = both(format!("`{}` has no `return`", name.text), format!("`{}` に `return` がありません", name.text));
    Some((name.line, message))
}
