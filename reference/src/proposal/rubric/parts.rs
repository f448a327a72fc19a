//! The parts of a solution's `main` that can be taken out: summands, calls that are added up, colours that are mixed in.

use super::TextChange;
use crate::interpreter::outline::{self, StatementText, Word};
use crate::interpreter::{Scalar, Type, is_builtin};
use crate::proposal::source::SolutionFile;
use std::collections::HashSet;

/// The parts of a file: locals that are summed up, and statements that change what there is already. Each with its name, the
/// change that takes it out, and the words that it is computed from.
pub(super) fn terms_of(source: &SolutionFile) -> Vec<(String, TextChange, HashSet<String>)> {
    let functions = outline::functions(&source.text);
    let Some(main) = functions.iter().find(|function| function.name.text == source.entry) else { return Vec::new() };
    let own: Vec<&str> = functions.iter().map(|function| function.name.text.as_str()).collect();
    let summed: HashSet<&str> = main.statements.iter().flat_map(summands_of_colours).collect();
    let raises = |statement: &&StatementText| statement.words.iter().any(|word| word.text == "+=");
    let raised: HashSet<&str> =
        main.statements.iter().filter(raises).map(|statement| statement.words[0].text.as_str()).collect();
    let mut terms = Vec::new();
    for statement in &main.statements {
        let text = &source.text[statement.range()];
        if statement.words[0].text == "discard" {
            let change = TextChange { from: text.to_owned(), to: ";".to_owned() };
            terms.push(("discard".to_owned(), change, HashSet::new()));
            continue;
        }
        let Some(at) = statement.assignment() else { continue };
        let (left, right) = (&statement.words[..at], &statement.words[at + 1..statement.words.len() - 1]);
        let uses = own_names(right);
        let Some(target) = left.iter().rev().find(|word| word.is_name && !is_swizzle(&word.text)) else { continue };
        let declared = left.iter().find_map(|word| Type::named(&word.text));
        terms.extend(mixed(source, right, &uses));
        let begins_sum =
            || raised.contains(target.text.as_str()) && right.iter().any(|word| own.contains(&word.text.as_str()));
        match declared {
            Some(kind) if summed.contains(target.text.as_str()) || begins_sum() => {
                let Some(nothing) = nothing(&kind) else { continue };
                let name = match summed.contains(target.text.as_str()) {
                    true => target.text.clone(),
                    false => named_after(right, &target.text, &own).unwrap_or_else(|| target.text.clone()),
                };
                let from = &source.text[left[0].range.start..right[right.len() - 1].range.end];
                let to = format!("{} = {nothing}", &source.text[left[0].range.start..left[left.len() - 1].range.end]);
                terms.push((name, TextChange { from: from.to_owned(), to }, uses));
            }
            None if statement.words[at].text != "=" || uses.contains(&target.text) => {
                let Some(name) = named_after(right, &target.text, &own) else { continue };
                let change = TextChange { from: text.to_owned(), to: ";".to_owned() };
                terms.push((name, change, uses));
            }
            _ => {}
        }
    }
    terms
}

fn is_swizzle(word: &str) -> bool {
    (1..=4).contains(&word.len())
        && ["xyzw", "rgba", "stpq"].iter().any(|set| word.chars().all(|c| set.contains(c)))
        && word != "p"
}

/// The names among these words that are no members of another.
fn own_names(words: &[Word]) -> HashSet<String> {
    let is_own = |at: &usize| words[*at].is_name && at.checked_sub(1).is_none_or(|before| words[before].text != ".");
    (0..words.len()).filter(is_own).map(|at| words[at].text.clone()).collect()
}

/// Functions within whose brackets a sum of colours may stand.
const AROUND_COLOURS: [&str; 5] = ["clamp", "min", "max", "pow", "mix"];

/// The summands of a statement. A number that is computed from one of them alone, such as a divisor, is no sum of colours.
fn summands_of_colours(statement: &StatementText) -> Vec<&str> {
    let found = summands(statement);
    let is_number = statement.words.first().is_some_and(|first| first.text == "float");
    let distinct: HashSet<&&str> = found.iter().collect();
    if is_number && distinct.len() < 2 { Vec::new() } else { found }
}

/// Names that stand in a sum of colours, as a summand or a factor of one.
fn summands(statement: &StatementText) -> Vec<&str> {
    let words = &statement.words;
    let text = |at: Option<usize>| at.and_then(|at| words.get(at)).map_or("", |word| word.text.as_str());
    let mut found = Vec::new();
    // What stands before the brackets that are open.
    let mut around: Vec<&str> = Vec::new();
    for (at, word) in words.iter().enumerate() {
        match word.text.as_str() {
            "(" => around.push(if at > 0 && words[at - 1].is_name { words[at - 1].text.as_str() } else { "" }),
            ")" => drop(around.pop()),
            _ => {}
        }
        let is_colour = |name: &&str| name.is_empty() || AROUND_COLOURS.contains(name) || Type::named(name).is_some();
        if !word.is_name || text(at.checked_sub(1)) == "." || !around.iter().all(is_colour) {
            continue;
        }
        // Over factors to both sides: `ks * spec.rgb + …`.
        let (mut left, mut right) = (at, at + 1);
        while text(left.checked_sub(1)) == "*" && left >= 2 {
            left = start_of_factor(words, left - 2);
        }
        while matches!(text(Some(right)), "*" | ".") {
            right += 2;
        }
        let begins = matches!(text(left.checked_sub(1)), "+" | "+=");
        if begins || text(Some(right)) == "+" {
            found.push(word.text.as_str());
        }
    }
    found
}

/// Where a factor starts that ends at a place: `vec3(0.4)`, `light.colour`, `2.0`.
fn start_of_factor(words: &[Word], end: usize) -> usize {
    let mut at = end;
    if words[at].text == ")" {
        let mut depth = 0_usize;
        let open = words[..=at].iter().rposition(|word| {
            match word.text.as_str() {
                ")" => depth += 1,
                "(" => depth -= 1,
                _ => {}
            }
            depth == 0
        });
        at = open.unwrap_or(0);
        at -= usize::from(at > 0 && words[at - 1].is_name);
    }
    while at >= 2 && words[at - 1].text == "." {
        at -= 2;
    }
    at
}

/// `mix(a, b, t)` without one of the two: without what is not computed in the file.
fn mixed(
    source: &SolutionFile,
    words: &[Word],
    uses: &HashSet<String>,
) -> Option<(String, TextChange, HashSet<String>)> {
    let at = words.iter().position(|word| word.text == "mix")?;
    let mut depth = 0_i32;
    let mut borders = vec![at + 1];
    for (place, word) in words.iter().enumerate().skip(at + 1) {
        match word.text.as_str() {
            "(" => depth += 1,
            ")" => depth -= 1,
            "," if depth == 1 => borders.push(place),
            _ => {}
        }
        if depth == 0 {
            borders.push(place);
            break;
        }
    }
    let [open, first, second, close] = borders[..] else { return None };
    let (one, other) = (&words[open + 1..first], &words[first + 1..second]);
    let is_local =
        |words: &[Word]| words.iter().any(|word| source.program.locals().iter().any(|own| own.name == word.text));
    let (kept, dropped) = if is_local(one) && !is_local(other) { (one, other) } else { (other, one) };
    let name = named_after(dropped, "", &[])?;
    // What `fogColor` is mixed in for is fog.
    let ends = ["Color", "Colour", "_color", "_colour"];
    let name =
        ends.iter().find_map(|end| name.strip_suffix(end)).filter(|rest| !rest.is_empty()).unwrap_or(&name).to_owned();
    let text = |words: &[Word]| Some(source.text[words.first()?.range.start..words.last()?.range.end].to_owned());
    Some((name, TextChange { from: text(&words[at..=close])?, to: text(kept)? }, uses.clone()))
}

/// The value that adds nothing.
fn nothing(kind: &Type) -> Option<String> {
    match kind {
        Type::Vector(Scalar::Float, 1) => Some("0.0".to_owned()),
        Type::Vector(Scalar::Float, 3 | 4) => Some(format!("{kind}(0.0)")),
        _ => None,
    }
}

/// What a statement is called after: a function of the file that it calls, or else the last name that it uses.
fn named_after(right: &[Word], target: &str, own: &[&str]) -> Option<String> {
    let names = || right.iter().filter(|word| word.is_name && word.text != target);
    let called = names().find(|word| own.contains(&word.text.as_str()));
    let is_own = |word: &&Word| {
        Type::named(&word.text).is_none() && !is_swizzle(&word.text) && !is_builtin(&word.text) && word.text.len() > 1
    };
    let telling = || names().find(|word| super::is_telling(&word.text));
    let name = called.or_else(telling).or_else(|| names().rfind(is_own))?;
    Some(name.text.clone())
}
