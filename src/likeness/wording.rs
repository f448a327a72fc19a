//! What anybody would write: the hand-out, and the lecture's equation.

use super::reading::{TextStatement, passages, statements, texts};
use crate::source::Source;
use reference::interpreter::outline::Word;
use std::collections::{BTreeSet, HashMap, HashSet};

/// Most types by which definitions of a solution are put into others: two to the power of this many readings.
const MOST_TYPES: usize = 4;

/// Most words of a definition that is put into others: they grow with every step.
const MOST_WORDS: usize = 200;

/// The wording of the hand-out and of the right answers that the homework knows.
#[derive(Debug)]
pub struct KnownWording {
    statements: HashSet<Vec<String>>,
    names: HashSet<String>,
    prints: HashSet<u64>,
}

impl KnownWording {
    /// Of a hand-out, and of right answers.
    pub fn new<'a>(hand_out: &[Source], solutions: impl Iterator<Item = &'a str>) -> Self {
        let handed_out: Vec<TextStatement> = all(hand_out);
        let names: HashSet<String> = handed_out
            .iter()
            .flat_map(|statement| &statement.words)
            .filter(|word| word.is_name)
            .map(|word| word.text.clone())
            .collect();
        let mut wording = Self { statements: handed_out.iter().map(texts).collect(), names, prints: HashSet::new() };
        wording.learn(&handed_out);
        for solution in solutions {
            for reading in readings(&statements(0, solution), &wording.names) {
                wording.learn(&reading);
            }
        }
        wording
    }

    /// The words of the hand-out that are names.
    pub fn names(&self) -> &HashSet<String> {
        &self.names
    }

    /// Whether anybody would write this.
    pub fn has(&self, print: u64) -> bool {
        self.prints.contains(&print)
    }

    /// The statements of a hand-in that are not the hand-out's.
    pub fn own(&self, sources: &[Source]) -> Vec<TextStatement> {
        self.without_hand_out(all(sources))
    }

    fn without_hand_out(&self, mut statements: Vec<TextStatement>) -> Vec<TextStatement> {
        statements.retain(|statement| !self.statements.contains(&texts(statement)));
        statements
    }

    /// Takes up the fingerprints of a text, as it is and with the hand-out's statements left out.
    fn learn(&mut self, statements: &[TextStatement]) {
        let own = self.without_hand_out(statements.to_vec());
        for text in [statements, &own] {
            self.prints.extend(passages(text, &self.names).into_iter().map(|passage| passage.print));
        }
    }
}

fn all(sources: &[Source]) -> Vec<TextStatement> {
    sources.iter().enumerate().flat_map(|(file, source)| statements(file, &source.text)).collect()
}

/// A solution as people cut it into statements: as it is, and with the definitions of each choice of types put in where they
/// are used, with brackets around sums and without.
fn readings(solution: &[TextStatement], kept: &HashSet<String>) -> Vec<Vec<TextStatement>> {
    let types: BTreeSet<&str> = solution.iter().filter_map(|it| definition(it, kept)).map(|found| found.kind).collect();
    let types: Vec<&str> = types.into_iter().take(MOST_TYPES).collect();
    let mut readings = vec![solution.to_vec()];
    for choice in 1..1_usize << types.len() {
        let chosen: Vec<&str> =
            types.iter().enumerate().filter(|(at, _)| choice >> at & 1 == 1).map(|(_, kind)| *kind).collect();
        for brackets in [false, true] {
            readings.push(put_in(solution, kept, &chosen, brackets));
        }
    }
    readings
}

/// `kind name = value;`
struct LocalDefinition<'a> {
    kind: &'a str,
    name: &'a str,
    value: &'a [Word],
}

fn definition<'a>(statement: &'a TextStatement, kept: &HashSet<String>) -> Option<LocalDefinition<'a>> {
    let [kind, name, equals, value @ .., _] = statement.words.as_slice() else { return None };
    let is_one = kind.is_name && name.is_name && equals.text == "=" && !kept.contains(&name.text);
    is_one.then_some(LocalDefinition { kind: &kind.text, name: &name.text, value })
}

fn put_in(solution: &[TextStatement], kept: &HashSet<String>, kinds: &[&str], brackets: bool) -> Vec<TextStatement> {
    let mut values: HashMap<&str, Vec<Word>> = HashMap::new();
    let mut text = Vec::new();
    for statement in solution {
        let found = definition(statement, kept).filter(|found| kinds.contains(&found.kind));
        let words = found.as_ref().map_or(statement.words.as_slice(), |found| found.value);
        let mut written: Vec<Word> = Vec::new();
        for (at, word) in words.iter().enumerate() {
            let is_used = at == 0 || words[at - 1].text != "." && !words[at - 1].is_name;
            match values.get(word.text.as_str()).filter(|_| is_used) {
                Some(value) => written.extend(value.iter().cloned()),
                None => written.push(word.clone()),
            }
        }
        match found {
            Some(found) if written.len() <= MOST_WORDS => {
                let is_sum = written.iter().any(|word| matches!(word.text.as_str(), "+" | "-"));
                if let (true, true, Some(first)) = (brackets, is_sum, written.first().cloned()) {
                    let sign = |text: &str| Word { text: text.to_owned(), is_name: false, ..first.clone() };
                    written.insert(0, sign("("));
                    written.push(sign(")"));
                }
                values.insert(found.name, written);
            }
            Some(_) => text.push(statement.clone()),
            None => text.push(TextStatement { words: written, ..*statement }),
        }
    }
    text
}
