//! Texts that were not translated.

use super::Said;
use crate::language;
use reference::{Assignment, Text};

/// Names the texts that are the same in both languages, or empty in one.
pub(super) fn say(said: Said, assignment: &Assignment) {
    let mut texts: Vec<(String, &Text)> = vec![("title".to_owned(), &assignment.title)];
    if let Some(task) = &assignment.task {
        texts.extend([("task, text".to_owned(), &task.text), ("task, picture".to_owned(), &task.picture)]);
    }
    for line in &assignment.rubric {
        texts.push((format!("rubric line `{}`, label", line.id), &line.label));
        texts.extend(line.right.iter().map(|right| (format!("rubric line `{}`, right", line.id), right)));
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
