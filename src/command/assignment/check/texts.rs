//! Texts that were not translated, and placeholders in them that nothing fills.

use super::CheckWording;
use crate::language;
use reference::{Assignment, Text};
use std::collections::{BTreeSet, HashSet};

/// Names the texts that are the same in both languages, or empty in one.
pub(super) fn say(said: CheckWording, assignment: &Assignment) {
    let mut texts: Vec<(String, &Text)> = vec![("title".to_owned(), &assignment.title)];
    if let Some(task) = &assignment.task {
        texts.extend([("task, text".to_owned(), &task.text), ("task, picture".to_owned(), &task.picture)]);
    }
    for line in &assignment.rubric {
        texts.push((format!("rubric `{}`, label", line.id), &line.label));
        texts.extend(line.right.iter().map(|right| (format!("rubric `{}`, right", line.id), right)));
    }
    for mistake in &assignment.mistakes {
        let own = [
            ("title", &mistake.title),
            ("seen", &mistake.seen),
            ("equation", &mistake.equation),
            ("look", &mistake.look),
        ];
        texts.extend(own.map(|(key, text)| (format!("mistake `{}`, {key}", mistake.id), text)));
    }
    let is_untranslated = |(_, text): &&(String, &Text)| text.en == text.ja || text.en.is_empty() || text.ja.is_empty();
    for (place, _) in texts.iter().filter(is_untranslated) {
        said.note(&language::Text::new(
            format!("{place}: the same in both languages, or empty in one; students choose Japanese or English"),
            format!("{place}: 日本語と英語が同じか、一方が空です。学生は日本語か英語を選びます"),
        ));
    }
}

/// Placeholders that are filled whatever the homework is about.
const GENERAL: [&str; 7] = ["line", "name", "found", "expected", "frames", "probes", "cases"];

/// Whether each placeholder that stands outside of ⟨ ⟩ can be filled: students would read `{l}` else.
pub(super) fn say_unfilled(said: CheckWording, assignment: &Assignment) -> bool {
    let interface = &assignment.interface;
    let definitions = assignment.equation.definitions().iter().map(|definition| definition.name.as_str());
    let constants = assignment.constants.iter().map(|constant| constant.name.as_str());
    let inputs = interface.inputs.iter().map(|input| input.name.as_str());
    let outputs = interface.outputs.iter().map(|output| output.name.as_str());
    let known: HashSet<&str> = definitions.chain(constants).chain(inputs).chain(outputs).chain(GENERAL).collect();
    let mut is_whole = true;
    for mistake in &assignment.mistakes {
        let instead = mistake.instead.iter().flat_map(|other| [&other.seen, &other.equation, &other.look]).flatten();
        let texts = [&mistake.seen, &mistake.equation, &mistake.look].into_iter().chain(instead);
        let unfilled = texts.flat_map(|text| [&text.en, &text.ja]).flat_map(|text| placeholders(text));
        let unfilled: BTreeSet<&str> = unfilled.filter(|name| !known.contains(name)).collect();
        for name in unfilled {
            is_whole = false;
            let id = &mistake.id;
            said.line(
                false,
                &language::Text::new(
                    format!("mistake `{id}`: nothing fills `{{{name}}}`, and students would read it so: put it between ⟨ and ⟩, or write the texts anew"),
                    format!("mistake `{id}`: `{{{name}}}` に入るものがなく、学生にはこのまま表示されます。⟨ と ⟩ で囲むか、文を書き直してください"),
                ),
            );
        }
    }
    is_whole
}

/// The placeholders of a text that do not stand between ⟨ and ⟩.
fn placeholders(text: &str) -> impl Iterator<Item = &str> {
    let outside = text.split('⟨').flat_map(|part| part.rsplit('⟩').next());
    outside.flat_map(|part| part.split('{').skip(1).filter_map(|rest| rest.split('}').next()))
}

#[cfg(test)]
mod tests {
    use super::placeholders;

    #[test]
    fn what_may_be_left_out_is_no_placeholder_that_must_be_filled() {
        let found = |text| placeholders(text).collect::<Vec<_>>();
        assert_eq!(found("between {l} and {v}⟨, on line {line}⟩: {name}"), ["l", "v", "name"]);
        assert!(found("⟨{line} 行目の⟩式").is_empty());
    }
}
