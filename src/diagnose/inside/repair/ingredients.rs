//! What the right answer is made of, as it may stand in the student's text.

use crate::diagnose::columns::is_equal;
use crate::diagnose::inside::search::Search;
use crate::diagnose::inside::{Stage, What};
use crate::source;
use reference::interpreter::Ingredients;

impl Search<'_, '_> {
    /// What the right answer is made of, by the student's own names as far as these are known.
    pub(super) fn ingredients(&self) -> Ingredients {
        let files = self.assignment.files.iter();
        let texts: Vec<String> = files.map(|file| self.in_their_names(file.stage, &file.solution.text)).collect();
        Ingredients::of(&texts.iter().map(String::as_str).collect::<Vec<_>>())
    }

    /// A text of the right answer, with the student's names for what the student calls otherwise.
    fn in_their_names(&self, stage: Stage, text: &str) -> String {
        let own = self.texts(stage).map(|(_, source)| source);
        // A member of a block is no word, which alone can be declared.
        let is_word = |own: &str| !own.contains('.');
        let is_free =
            |right: &str, own: &str| is_word(own) && !source::words(text).any(|(_, word)| word == own) && right != own;
        let mut names = self.names_alike(stage);
        names.retain(|(right, _)| !own.is_some_and(|own| own.words().any(|(_, word)| word == right)));
        names.retain(|(right, own)| is_free(right, own));
        let (mut renamed, mut end) = (String::new(), 0);
        for (at, word) in source::words(text) {
            renamed.push_str(&text[end..at]);
            let own = names.iter().find(|(right, _)| right == word);
            renamed.push_str(own.map_or(word, |(_, own)| own));
            end = at + word.len();
        }
        renamed + &text[end..]
    }

    /// The names of what the right answer is given, with the student's names of the same values.
    fn names_alike(&self, stage: Stage) -> Vec<(String, String)> {
        let Some(trace) = self.trace(stage) else { return Vec::new() };
        let sites = self.theirs.stage(stage).sites();
        let alike = self.quantities.given(stage).into_iter().filter_map(|(name, values)| {
            let mut reads = trace.events.iter().filter_map(|event| match &sites[event.site].what {
                What::Read(own) if event.from.is_empty() && is_equal(&event.values, values) => Some(own.clone()),
                _ => None,
            });
            Some((name.to_owned(), reads.next()?))
        });
        alike.collect()
    }
}
