//! The known mistakes of an assignment.

use super::CheckResult;
use super::rubric::known_line;
use super::solution::CheckedSolution;
use super::variants::Variants;
use crate::Text;
use crate::assignment::{Constant, error};
use crate::interpreter::Type;
use crate::manifest::{self, RubricItem, TermState};
use crate::mistake::{Alternative, Condition, DefinitionOverride, FreeParameter, Mistake, MistakeForm};
use crate::text::both;
use crate::together::has_name;
use serde::Deserialize;
use std::collections::{BTreeMap, HashSet};
use toml::Spanned;

/// The folder's mistakes, and those of any homework.
pub(super) fn all(
    entries: Vec<manifest::MistakeEntry>,
    rubric: &[RubricItem],
    solution: &mut CheckedSolution<'_>,
    constants: &[Constant],
    variants: &Variants<'_>,
    place_at: &dyn Fn(usize) -> String,
) -> CheckResult<Vec<Mistake>> {
    let lines: HashSet<String> = rubric.iter().map(|line| line.id.clone()).collect();
    let mut ids = HashSet::new();
    let mut titles = [HashSet::new(), HashSet::new()];
    for entry in &entries {
        let place = || format!("mistake `{}`", entry.id);
        if !ids.insert(entry.id.clone()) {
            return Err(error(
                place(),
                both("stands twice: give one another name", "2 回書かれています。一方の名前を変えてください"),
            ));
        }
        // Lists name a mistake by its title alone.
        let own = [&entry.title.en, &entry.title.ja];
        if !titles.iter_mut().zip(own).all(|(titles, title)| titles.insert(title.clone())) {
            return Err(error(
                place(),
                both(
                    "another mistake has the same title: lists name it by the title alone",
                    "同じ title の mistake があります。一覧では title だけで区別します",
                ),
            ));
        }
    }
    let general = general(rubric, solution)?.into_iter().filter(|entry| !ids.contains(&entry.id));
    let entries: Vec<_> = entries.into_iter().chain(general).collect();
    let checked = entries.into_iter().map(|entry| mistake(entry, solution, &lines, constants, variants, place_at));
    let is_general = |mistake: Mistake| Mistake { is_general: !ids.contains(&mistake.id), ..mistake };
    checked.map(|checked| checked.map(is_general)).collect()
}

/// What goes wrong in any homework.
fn general(rubric: &[RubricItem], solution: &CheckedSolution<'_>) -> CheckResult<Vec<manifest::MistakeEntry>> {
    /// The file, where `keeps` speaks of kinds of lines.
    #[derive(Deserialize)]
    struct General {
        mistake: Vec<manifest::MistakeEntry>,
    }
    let read = toml::from_str(include_str!("general.toml"));
    let General { mut mistake } = read.map_err(|e| error("general.toml", Text::verbatim(e.to_string())))?;
    for mistake in &mut mistake {
        let kept = |line: &RubricItem| {
            let kind = if solution.is_position(&line.judges) { "position" } else { "colour" };
            mistake.keeps.get(kind).map(|kept| (line.id.clone(), *kept))
        };
        mistake.keeps = rubric.iter().filter_map(kept).collect();
    }
    Ok(mistake)
}

/// A mistake whose forms fit the solution. `place_at`: where a byte of the manifest stands.
fn mistake(
    entry: manifest::MistakeEntry,
    solution: &mut CheckedSolution<'_>,
    lines: &HashSet<String>,
    constants: &[Constant],
    variants: &Variants<'_>,
    place_at: &dyn Fn(usize) -> String,
) -> CheckResult<Mistake> {
    let place = format!("mistake `{}`", entry.id);
    title(&entry.title, &place)?;
    for (line, fraction) in &entry.keeps {
        known_line(lines, line, &place)?;
        if !(0.0..=1.0).contains(fraction) {
            return Err(error(
                place,
                both(
                    format!("keeps {fraction} of `{line}`: write a fraction, 0 to 1"),
                    format!("`{line}` の {fraction} を残すことになっています。0 から 1 の数にしてください"),
                ),
            ));
        }
    }
    let fit = match entry.fit {
        None => None,
        Some(f) => {
            solution.parameter(&f.name, &place)?;
            if !(f.from > 0.0 && f.from < f.example && f.example < f.to && f.to.is_finite()) {
                return Err(error(
                    place,
                    both("`fit` needs 0 < from < example < to", "`fit` では 0 < from < example < to としてください"),
                ));
            }
            let of = f.of.map(|name| {
                let is_it = |constant: &Constant| constant.name == name && *constant.value.kind() == Type::FLOAT;
                let found = constants.iter().position(is_it);
                found.ok_or_else(|| {
                    error(
                        &place,
                        both(
                            format!("there is no float constant `{name}`"),
                            format!("float 型の定数 `{name}` がありません"),
                        ),
                    )
                })
            });
            let of = of.transpose()?;
            Some(FreeParameter { name: f.name, from: f.from, to: f.to, example: f.example, turns: f.turns, of })
        }
    };
    let free = fit.as_ref().map(|fit| fit.name.as_str());
    let mut forms = Vec::new();
    for (number, texts) in entry.forms.iter().enumerate() {
        let at = |at: usize| {
            let first = place_at(at);
            format!("{first}, {place}, form {number}")
        };
        forms.push(form(texts, solution, free, &at, &format!("{place}, form {number}"))?);
    }
    let is_used = |fit: &FreeParameter| {
        let mut texts = entry.variants.iter().flat_map(|variant| &variant.replace);
        forms.iter().any(|form| form.free) || texts.any(|[_, to]| has_name(to, &fit.name))
    };
    if fit.as_ref().is_some_and(|fit| !is_used(fit)) {
        return Err(error(
            place,
            both(
                "no form or variant uses the name in `fit`: use it, or remove `fit`",
                "どの form や variant も `fit` の名前を使っていません。使うか、`fit` を取り除いてください",
            ),
        ));
    }
    let numbered = entry.variants.iter().enumerate();
    let likeliest = fit.as_ref().map(|fit| (fit.name.as_str(), fit.example));
    let variants = numbered
        .map(|(number, variant)| variants.program_with(variant, likeliest, &format!("{place}, variant {number}")));
    Ok(Mistake {
        variants: variants.collect::<CheckResult<_>>()?,
        id: entry.id,
        title: entry.title,
        keeps: entry.keeps.into_iter().collect(),
        fit,
        needs: entry.needs,
        lacks: entry.lacks,
        handed_out: entry.handed_out,
        is_general: false,
        at_use: entry.at_use,
        undefined_power: entry.undefined_power,
        instead: entry
            .instead
            .into_iter()
            .map(|other| alternative(other, forms.len() + entry.variants.len(), &place))
            .collect::<CheckResult<_>>()?,
        forms,
        seen: entry.seen,
        equation: entry.equation,
        look: entry.look,
    })
}

/// Longest title in characters: a title shares its line in a table with a score.
const LONGEST_TITLE: usize = 60;

/// A title is one short line in each language.
fn title(title: &Text, place: &str) -> CheckResult<()> {
    for wording in [&title.en, &title.ja] {
        let length = wording.chars().count();
        if wording.trim().is_empty() || length > LONGEST_TITLE || wording.contains(['\n', '{', '⟨']) {
            return Err(error(
                place,
                both(
                    format!("the title needs 1 to {LONGEST_TITLE} characters in each language"),
                    format!("title は、どちらの言語でも 1 文字以上 {LONGEST_TITLE} 文字以下にしてください"),
                ),
            ));
        }
    }
    Ok(())
}

fn alternative(entry: manifest::AlternativeEntry, forms: usize, place: &str) -> CheckResult<Alternative> {
    let manifest::When { forms: of_forms, lacks, term } = entry.when;
    if let Some(form) = of_forms.iter().find(|form| **form >= forms) {
        return Err(error(
            place,
            both(
                format!("`instead` speaks of form {form}, and there are {forms}: they count from 0"),
                format!("`instead` に form {form} とありますが、form は {forms} 個です (0 から数えます)"),
            ),
        ));
    }
    let mut when = Vec::new();
    if !of_forms.is_empty() {
        when.push(Condition::Forms(of_forms));
    }
    if !lacks.is_empty() {
        when.push(Condition::Lacks(lacks));
    }
    when.extend(term.map(|term| match term {
        TermState::Zero => Condition::Zero,
        TermState::Absent => Condition::Absent,
    }));
    if when.is_empty() {
        return Err(error(
            place,
            both("`instead` has no condition: write `when`", "`instead` に条件がありません。`when` を書いてください"),
        ));
    }
    if entry.seen.is_none() && entry.equation.is_none() && entry.look.is_none() {
        return Err(error(
            place,
            both(
                "`instead` says nothing: write `seen`, `equation` or `look`",
                "`instead` に文がありません。`seen`、`equation`、`look` のいずれかを書いてください",
            ),
        ));
    }
    Ok(Alternative { when, seen: entry.seen, equation: entry.equation, look: entry.look })
}

fn form(
    texts: &BTreeMap<String, Spanned<String>>,
    solution: &mut CheckedSolution<'_>,
    free_name: Option<&str>,
    at: &dyn Fn(usize) -> String,
    place: &str,
) -> CheckResult<MistakeForm> {
    let mut overrides = Vec::new();
    let mut free = false;
    for (name, text) in texts {
        // Lines are counted where something is wrong.
        let place = || format!("{}, `{name}`", at(text.span().start));
        let definition = solution.definition(name, &place)?;
        let text = text.get_ref();
        let (formula, is_free) = solution.replacement(definition, text, free_name, &place)?;
        free |= is_free;
        overrides.push(DefinitionOverride { definition, text: text.clone(), formula });
    }
    if overrides.is_empty() {
        return Err(error(
            place,
            both(
                "replaces nothing: write `{ definition = \"expression\" }`",
                "置き換えるものがありません。`{ 定義 = \"式\" }` と書いてください",
            ),
        ));
    }
    overrides.sort_by_key(|o| o.definition);
    Ok(MistakeForm { overrides, free })
}
