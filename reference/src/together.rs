//! Several mistakes in one program, where each is the solution with other texts in it.

use crate::Assignment;
use crate::accepted::AcceptedAnswer;
use crate::interpreter::{Program, Stage};
use crate::mistake::FoundMistake;
use crate::pipeline::Pipeline;
use crate::traced::TracedProgram;
use std::sync::Arc;

impl Assignment {
    /// The solution with all these mistakes in it, and with what those `beside` have in place of its texts. `None` where one of them is no
    /// program that replaces texts, or where one replaces what another one needs.
    pub(crate) fn together(&self, found: &[FoundMistake], beside: &[&AcceptedAnswer]) -> Option<AcceptedAnswer> {
        let texts = self.texts_with(found, beside)?;
        let [mut vertex, mut fragment] = [&self.pipeline.vertex, &self.pipeline.fragment].map(Arc::clone);
        for (file, text) in self.files.iter().zip(texts).filter(|(file, text)| file.solution.text != *text) {
            let stage = file.stage;
            let program = Arc::new(Program::compile(&text, stage).ok()?);
            match stage {
                Stage::Vertex => vertex = program,
                Stage::Fragment => fragment = program,
            }
        }
        let pipeline = Pipeline::link(&vertex, &fragment, None).ok()?;
        Some(AcceptedAnswer::new("", pipeline))
    }

    /// The solution with these mistakes in it, to be looked into.
    pub fn traced_with(&self, found: &[FoundMistake]) -> Option<TracedProgram> {
        let texts = self.texts_with(found, &[])?;
        let stages = self.files.iter().map(|file| file.stage);
        let texts: Vec<(Stage, &str)> = stages.zip(texts.iter().map(String::as_str)).collect();
        TracedProgram::new(self, &texts).ok()
    }

    /// The text of each file of the solution with what these replace: one after the other, or the other way round.
    fn texts_with(&self, found: &[FoundMistake], beside: &[&AcceptedAnswer]) -> Option<Vec<String>> {
        let of_mistake = |found: &FoundMistake| {
            let mistake = self.mistake(&found.id)?;
            let program = mistake.program(found.form)?;
            let number = mistake.fit.as_ref().zip(found.parameter);
            let filled = |[from, to]: &[String; 2]| {
                let to = number.map_or_else(|| to.clone(), |(fit, value)| with_number(to, &fit.name, value));
                [from.clone(), to]
            };
            Some(program.replaced.iter().map(filled).collect::<Vec<_>>())
        };
        let beside = beside.iter().map(|beside| Some(beside.replaced.clone()));
        let mut replaced: Vec<Vec<[String; 2]>> = beside.chain(found.iter().map(of_mistake)).collect::<Option<_>>()?;
        self.replacing(&replaced).or_else(|| {
            replaced.reverse();
            self.replacing(&replaced)
        })
    }

    fn replacing(&self, programs: &[Vec<[String; 2]>]) -> Option<Vec<String>> {
        let mut texts: Vec<String> = self.files.iter().map(|file| file.solution.text.clone()).collect();
        for replaced in programs {
            if replaced.is_empty() {
                return None;
            }
            for [from, to] in replaced {
                let text = texts.iter_mut().find(|text| text.matches(from.as_str()).count() == 1)?;
                *text = text.replacen(from.as_str(), to, 1);
            }
        }
        Some(texts)
    }
}

/// A text with a number in place of a name.
pub(crate) fn with_number(text: &str, name: &str, value: f64) -> String {
    let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let mut found = String::new();
    let mut rest = text;
    while let Some(at) = rest.find(name) {
        let (before, behind) = (&rest[..at], &rest[at + name.len()..]);
        found += before;
        let is_whole = !found.ends_with(is_word) && !behind.starts_with(is_word);
        // In brackets, so that a minus before it is none of `--`.
        found += &if is_whole { format!("({value:?})") } else { name.to_owned() };
        rest = behind;
    }
    found + rest
}

/// Whether a name stands in a text.
pub(crate) fn has_name(text: &str, name: &str) -> bool {
    with_number(text, name, 0.0) != text
}

#[cfg(test)]
mod tests {
    use super::with_number;

    #[test]
    fn a_number_stands_where_its_name_stood_as_a_word() {
        assert_eq!(with_number("q.z -= k; kk = k * lack;", "k", 0.03), "q.z -= (0.03); kk = (0.03) * lack;");
    }
}
