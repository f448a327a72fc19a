//! What is known of a change by which something becomes right.

use crate::diagnose::Evidence;
use crate::diagnose::locate::Located;
use crate::{report, source};
use reference::interpreter::Operator;
use reference::mistake::Mistake;

/// A change by which something becomes right.
#[derive(Clone, Debug)]
pub(in crate::diagnose) struct Repaired {
    /// The mistake that it undoes.
    pub mistake: Mistake,
    /// What kind of mistake that is; `None` for one that the homework names.
    pub operator: Option<Operator>,
    /// Where it is; `None` for what the text has nothing of.
    pub located: Option<Located>,
    /// What is written there, and what belongs there.
    pub texts: [String; 2],
    /// What its value should be at a place that shows it, and what it is there, where that says more than the mistake.
    pub numbers: Option<[String; 2]>,
    /// The lines of the rubric whose features it is in, where that is known.
    pub lines: Vec<String>,
    /// Whether it puts in its place what stands elsewhere.
    pub moves: bool,
    /// The variables of the right answer that are wrong with the mistake: the one that it is in, and those computed from it.
    pub touches: Vec<String>,
    /// The lines of the rubric whose terms it changes, where that is known.
    pub terms: Vec<String>,
    /// What the text writes over where it should be kept, by the names of the right answer, where that is known.
    pub written_over: Vec<String>,
}

impl Repaired {
    /// A mistake of which no more is known.
    pub fn of(mistake: Mistake) -> Self {
        Self {
            mistake,
            operator: None,
            located: None,
            texts: Default::default(),
            numbers: None,
            lines: Vec::new(),
            moves: false,
            touches: Vec::new(),
            terms: Vec::new(),
            written_over: Vec::new(),
        }
    }

    /// Whether nothing is left of what an earlier change put there.
    pub(super) fn undoes(&self, earlier: &Self) -> bool {
        let [before, after] = &self.texts;
        let added = &earlier.texts[1];
        let place = |own: &Self| own.located.as_ref().map(|located| (located.stage, located.line));
        let is_same_place = place(self) == place(earlier);
        is_same_place && !added.is_empty() && before.contains(added.as_str()) && !after.contains(added.as_str())
    }

    /// Whether it changes what is written there, or puts one name in its place: else the student's text has nothing of what it
    /// adds, and what was to be computed there is missing.
    pub fn builds_on_the_text(&self) -> bool {
        let [written, right] = self.texts.each_ref().map(|text| names(text));
        let is_name = self.texts[1].chars().all(|c| c.is_alphanumeric() || c == '_' || c == '.');
        is_name || right.is_empty() || right.iter().any(|name| written.contains(name))
    }

    /// Whether it keeps what the text writes over: `=` stands there for `+=` or the like.
    pub fn keeps_what_was_there(&self) -> bool {
        let [written, right] =
            self.texts.each_ref().map(|text| text.split_once('=').map(|(to, from)| (to.trim(), from)));
        let is_operator = |rest: &str| ["+", "-", "*", "/"].contains(&rest.trim());
        matches!((written, right), (Some((to, from)), Some((other, same)))
            if from == same && other.strip_prefix(to).is_some_and(is_operator))
    }

    /// Whether it concerns how a function is written, and not what stands in its expressions.
    pub fn is_of_a_body(&self) -> bool {
        self.operator.is_some_and(Operator::is_of_a_body)
    }

    /// Whether another whole number belongs there, or a variable in its place.
    pub fn is_of_an_element(&self) -> bool {
        let [written, right] = &self.texts;
        let is_number = |text: &String| text.parse::<u32>().is_ok();
        let is_name = right.chars().all(|c| c.is_alphanumeric() || c == '_');
        is_number(written) && is_name
    }

    /// What a teacher is shown of it.
    pub fn shown(&self, evidence: &Evidence<'_>) -> Option<report::Repair> {
        let [written, right] = self.texts.clone();
        let Located { stage, line, .. } = *self.located.as_ref()?;
        let file = evidence.text(stage).0.facts.name.clone();
        Some(report::Repair { mistake: self.mistake.id.clone(), file, line, written, right })
    }
}

/// The names of variables in a text, not those of functions, types and components.
fn names(text: &str) -> Vec<&str> {
    let is_variable = |&(at, word): &(usize, &str)| {
        let is_number = word.starts_with(|c: char| c.is_ascii_digit());
        !is_number && !text[..at].ends_with('.') && !text[at + word.len()..].trim_start().starts_with('(')
    };
    source::words(text).filter(is_variable).map(|(_, word)| word).collect()
}

#[cfg(test)]
mod tests {
    use super::names;

    #[test]
    fn names_are_those_of_variables() {
        assert_eq!(names("(texture(depth, ps.xyz / ps.w) * 0.5) + _a1"), ["depth", "ps", "ps", "_a1"]);
        assert_eq!(names("vec3 (1e3, 0.5, 1.0)"), [""; 0]);
    }
}
