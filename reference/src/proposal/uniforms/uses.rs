//! What uniforms are used as, where their names do not say it.

use crate::interpreter::outline::Word;
use crate::proposal::guess::Guess;
use crate::proposal::names::NameWords;
use crate::proposal::source::SolutionFile;

/// What a whole number is compared with, in conditions and in the cases of a `switch`: each of these, and one more.
pub(super) fn cases(source: &SolutionFile, path: &str) -> Option<Guess> {
    let last = path.rsplit('.').next()?;
    let words = source.words();
    let number = |word: Option<&Word>| word?.text.trim_end_matches(['u', 'U']).parse::<u16>().ok().map(f64::from);
    let is_comparison = |word: &Word| matches!(word.text.as_str(), "==" | "!=" | "<" | ">" | "<=" | ">=");
    let is_end = |word: &&Word| matches!(word.text.as_str(), ";" | "{" | "}");
    let mut found: Vec<f64> = Vec::new();
    for (at, _) in words.iter().enumerate().filter(|(_, word)| word.text == last) {
        if words.get(at + 1).is_some_and(is_comparison) {
            found.extend(number(words.get(at + 2)));
        }
        // `switch (light.kind) {`
        let is_switched = words[..at].iter().rev().take_while(|word| !is_end(word)).any(|word| word.text == "switch")
            && words.get(at + 1).is_some_and(|word| word.text == ")");
        if is_switched {
            let cases = words.iter().enumerate().filter(|(_, word)| word.text == "case");
            found.extend(cases.filter_map(|(case, _)| number(words.get(case + 1))));
        }
    }
    let first = *found.first()?;
    let (least, greatest) =
        found.iter().fold((0.0, first), |(least, most): (f64, f64), own| (least.min(*own), most.max(*own)));
    // Where each number is named there is one more, for which none of them holds.
    let is_named = |number: u16| found.contains(&f64::from(number));
    let greatest = if (0..=greatest as u16).all(is_named) { greatest + 1.0 } else { greatest };
    let within = Some((vec![least], vec![greatest]));
    Some(Guess { value: vec![first], within, what: ("choice", "選択") })
}

/// Whether a uniform lies in a structure of a light that reaches so far and no further: `lights[1].radius`.
pub(super) fn falls_off(source: &SolutionFile, path: &str) -> bool {
    let around = |path: &str| path.rsplit_once('.').map(|(around, _)| around.to_owned());
    let Some(own) = around(path) else { return false };
    let is_light = NameWords::of(&own).has(&["light", "lights", "lamp", "lamps", "spot", "bulb", "bulbs"]);
    let ends = |other: &str| NameWords::of(other).has(&["radius", "range", "reach"]);
    is_light
        && source.program.uniforms().iter().any(|other| around(&other.name).as_ref() == Some(&own) && ends(&other.name))
}

/// Whether a uniform is what a power is raised to: the last argument of `pow`.
pub(super) fn is_exponent(source: &SolutionFile, path: &str) -> bool {
    let last = path.rsplit('.').next().unwrap_or(path);
    let words = source.words();
    let is_path = |word: &Word| word.is_name || word.text == ".";
    words.iter().enumerate().filter(|(_, word)| word.text == last).any(|(at, _)| {
        let is_end = words.get(at + 1).is_some_and(|word| word.text == ")");
        let Some(comma) = words[..at].iter().rposition(|word| !is_path(word)) else { return false };
        is_end
            && words[comma].text == ","
            && opens(&words, comma).is_some_and(|open| open > 0 && words[open - 1].text == "pow")
    })
}

/// The bracket that is open at a place.
fn opens(words: &[Word], at: usize) -> Option<usize> {
    let mut depth = 0_u32;
    words[..at].iter().rposition(|word| match word.text.as_str() {
        ")" => {
            depth += 1;
            false
        }
        "(" if depth == 0 => true,
        "(" => {
            depth -= 1;
            false
        }
        _ => false,
    })
}
