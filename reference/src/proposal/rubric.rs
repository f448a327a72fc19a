//! Lines of the rubric: parts of the solution that show by themselves when they are taken out. Each is tried.

use super::Plan;
use super::names::NameWords;
use super::source::SolutionFile;
use super::writing::quoted;
use crate::assignment::both;
use crate::feature::Feature;
use crate::fit;
use crate::interpreter::outline::{self, StatementText, Word};
use crate::interpreter::{Scalar, Stage, Type, is_builtin};
use crate::{Assignment, Text};
use std::collections::HashSet;

/// Most lines that are proposed beside the one of the position.
const MOST_TERMS: usize = 6;

/// A line of the rubric.
#[derive(Clone, Debug)]
pub(super) struct ProposedLine {
    pub id: String,
    pub label: Text,
    pub judges: Option<String>,
    pub without: Option<Change>,
}

/// One text of the solution, and what stands in its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Change {
    from: String,
    to: String,
}

impl Change {
    /// As a variant.
    pub fn text(&self) -> String {
        format!("{{ replace = [[{}, {}]] }}", quoted(&self.from), quoted(&self.to))
    }
}

/// Lines that every solution has: the colour, and where vertices are moved, the shape.
pub(super) fn plain(plan: &mut Plan) {
    let mut lines = Vec::new();
    if plan.hands_in(Stage::Vertex) {
        lines.push(line("shape", Some("gl_Position")));
    }
    lines.push(line("colour", None));
    plan.rubric = lines;
}

fn line(id: &str, judges: Option<&str>) -> ProposedLine {
    ProposedLine { id: id.to_owned(), label: label(id), judges: judges.map(str::to_owned), without: None }
}

/// Puts lines for parts in the place of the line of the colour, or beside it where there is only one.
pub(super) fn refine(plan: &mut Plan) {
    let base = plan.rubric.clone();
    let shape: Vec<ProposedLine> = base.iter().filter(|line| line.id == "shape").cloned().collect();
    let mut terms = terms(plan);
    while !terms.is_empty() {
        let before: &[ProposedLine] = if terms.len() == 1 { &base } else { &shape };
        plan.rubric = before.iter().chain(&terms).cloned().collect();
        match worst(plan, before, &terms) {
            None => return,
            Some(at) => drop(terms.remove(at)),
        }
    }
    plan.rubric = base;
}

/// One of these that cannot be a line: what is without it is no program, or shows nothing, or shows what another shows.
fn worst(plan: &mut Plan, before: &[ProposedLine], terms: &[ProposedLine]) -> Option<usize> {
    let Ok(assignment) = Assignment::load(plan.folder()) else {
        // Each is tried alone.
        let mut loads = |term: &ProposedLine| {
            plan.rubric = before.iter().chain([term]).cloned().collect();
            Assignment::load(plan.folder()).is_ok()
        };
        return Some(terms.iter().position(|term| !loads(term)).unwrap_or(terms.len() - 1));
    };
    let probes = assignment.judging_probes();
    let footprints = fit::Footprints::of(&assignment, &probes, fit::TOLERANCE);
    if let Some(weak) = footprints.lines().find(|line| footprints.of_line(*line).len() < fit::FEWEST) {
        return weak.checked_sub(before.len());
    }
    // What moves vertices is judged by the line of the shape.
    let moves = |feature: &Option<Feature>| {
        let shown = feature.as_ref().map(|feature| assignment.computed_without(feature, &probes)).unwrap_or_default();
        let mut shown = shown.iter().zip(&probes.probes);
        shown.any(|((_, position), probe)| (*position - probe.position).abs().max_element() > fit::TOLERANCE)
    };
    if plan.hands_in(Stage::Vertex)
        && let Some(moving) = assignment.features.iter().position(moves)
    {
        return moving.checked_sub(before.len());
    }
    let alike = fit::alike(&assignment, &probes, fit::TOLERANCE);
    let (name, _) = alike.first()?;
    let found = terms.iter().position(|term| name.contains(&format!("`no-{}`", term.id)));
    Some(found.unwrap_or(terms.len() - 1))
}

/// What the lines are.
pub(super) fn tell(plan: &mut Plan) {
    let ids: Vec<_> = plan.rubric.iter().map(|line| format!("`{}`", line.id)).collect();
    let ids = ids.join(", ");
    let is_split = plan.rubric.iter().any(|line| line.without.is_some());
    match is_split {
        true => plan.guessed(
            format!("rubric: {ids}: parts of the colour that show when they are taken out of the solution"),
            format!("rubric: {ids}: 解答から取り除くと画像が変わる部分"),
        ),
        false => plan.guessed(
            format!("rubric: {ids}: the solution was not taken apart; write more lines with `without`"),
            format!("rubric: {ids}: 解答を部分に分けられませんでした。`without` で行を増やせます"),
        ),
    }
}

/// Parts of the solution that may be lines, in its order.
fn terms(plan: &Plan) -> Vec<ProposedLine> {
    let all: String = plan.sources.iter().map(|source| source.text.as_str()).collect();
    let mut terms: Vec<(String, Change, HashSet<String>)> = Vec::new();
    for source in &plan.sources {
        for (name, change, uses) in terms_of(source) {
            let is_once = all.matches(change.from.as_str()).count() == 1;
            let is_known = terms.iter().any(|(known, other, _)| *known == name || *other == change);
            if is_once && !is_known {
                terms.push((name, change, uses));
            }
        }
    }
    // A sum of parts that are lines is no line.
    let names: Vec<String> = terms.iter().map(|(name, ..)| name.clone()).collect();
    terms.retain(|(name, _, uses)| !names.iter().any(|other| other != name && uses.contains(other)));
    terms.truncate(MOST_TERMS);
    let line = |(name, change, _): (String, Change, HashSet<String>)| {
        let id = super::id_of(&name.replace('_', "-"));
        ProposedLine { label: label(&name), id, judges: None, without: Some(change) }
    };
    let mut lines: Vec<ProposedLine> = terms.into_iter().map(line).collect();
    let mut ids = HashSet::from(["shape".to_owned()]);
    lines.retain(|line| ids.insert(line.id.clone()));
    lines
}

/// The parts of a file: locals that are summed up, and statements that change what there is already. Each with its name, the
/// change that takes it out, and the words that it is computed from.
fn terms_of(source: &SolutionFile) -> Vec<(String, Change, HashSet<String>)> {
    let functions = outline::functions(&source.text);
    let Some(main) = functions.iter().find(|function| function.name.text == source.entry) else { return Vec::new() };
    let own: Vec<&str> = functions.iter().map(|function| function.name.text.as_str()).collect();
    let summed: HashSet<&str> = main.statements.iter().flat_map(summands).collect();
    let raises = |statement: &&StatementText| statement.words.iter().any(|word| word.text == "+=");
    let raised: HashSet<&str> =
        main.statements.iter().filter(raises).map(|statement| statement.words[0].text.as_str()).collect();
    let mut terms = Vec::new();
    for statement in &main.statements {
        let text = &source.text[statement.range()];
        if statement.words[0].text == "discard" {
            let change = Change { from: text.to_owned(), to: ";".to_owned() };
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
                terms.push((name, Change { from: from.to_owned(), to }, uses));
            }
            None if statement.words[at].text != "=" || uses.contains(&target.text) => {
                let Some(name) = named_after(right, &target.text, &own) else { continue };
                let change = Change { from: text.to_owned(), to: ";".to_owned() };
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
fn mixed(source: &SolutionFile, words: &[Word], uses: &HashSet<String>) -> Option<(String, Change, HashSet<String>)> {
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
    let text = |words: &[Word]| Some(source.text[words.first()?.range.start..words.last()?.range.end].to_owned());
    Some((name, Change { from: text(&words[at..=close])?, to: text(kept)? }, uses.clone()))
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
    let name = called.or_else(|| names().rfind(is_own))?;
    Some(name.text.clone())
}

/// What a part is called in both languages.
fn label(name: &str) -> Text {
    let mut words = NameWords::of(name).words;
    if words.len() > 1 && ["calc", "calculate", "compute", "get", "eval"].contains(&words[0].as_str()) {
        words.remove(0);
    }
    let known = LABELS.iter().find(|(known, ..)| words.iter().any(|word| word.contains(known)));
    if let Some((_, en, ja)) = known {
        return both(*en, *ja);
    }
    let words = words.join(" ");
    let mut letters = words.chars();
    let en: String = letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect());
    both(en, format!("「{name}」"))
}

/// Words in names, and what such a part is called.
const LABELS: &[(&str, &str, &str)] = &[
    ("shape", "Shape", "形"),
    ("amb", "Ambient light", "環境光"),
    ("diff", "Diffuse reflection", "拡散反射光"),
    ("lambert", "Diffuse reflection", "拡散反射光"),
    ("spec", "Specular reflection", "鏡面反射光"),
    ("highlight", "Highlight", "ハイライト"),
    ("rim", "Rim light", "リムライト"),
    ("fog", "Fog", "霧"),
    ("gamma", "Gamma correction", "ガンマ補正"),
    ("exposure", "Exposure", "露出"),
    ("reflect", "Reflection", "反射"),
    ("refract", "Refraction", "屈折"),
    ("fresnel", "Fresnel reflection", "フレネル反射"),
    ("emis", "Emission", "発光"),
    ("outline", "Outline", "輪郭線"),
    ("edge", "Edge", "縁"),
    ("shadow", "Shadow", "影"),
    ("discard", "What is cut out", "切り抜き"),
    ("glow", "Glow", "光彩"),
    ("noise", "Noise", "ノイズ"),
    ("spot", "Spot light", "スポットライト"),
    ("point", "Point lights", "点光源"),
    ("dir", "Directional light", "平行光源"),
    ("colo", "Colour", "色"),
];
