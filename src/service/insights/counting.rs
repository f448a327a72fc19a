//! Counts what a class has handed in, and what it was told.

use super::{Insights, MessageInsight, TimeStretch};
use crate::diagnostic::{Diagnostic, Severity};
use crate::language::Text;
use crate::report::Verdict;
use crate::service::classes::Person;
use crate::service::clock::Millis;
use crate::service::store::ClassRow;
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// Stretches of time.
const STRETCHES: usize = 12;

/// Most messages that are listed.
const MOST_MESSAGES: usize = 60;

/// A message as what tells it from others: the known mistake, if it is one, and its English.
type MessageKey = (Option<String>, String);

/// What people of a class show; `refusals` are by submission, `title` names a mistake.
pub(super) fn gather(
    class: &[Person],
    refusals: &HashMap<String, Vec<Diagnostic>>,
    title: &dyn Fn(&str) -> Text,
) -> Insights {
    let mut insights = Insights::default();
    let mut messages: BTreeMap<MessageKey, (MessageInsight, BTreeSet<&str>)> = BTreeMap::new();
    for person in class {
        // The oldest first.
        let graded: Vec<&ClassRow> = person.rows.iter().rev().filter(|row| row.row.verdict.is_some()).collect();
        match graded.iter().position(|row| is_right(row)) {
            Some(at) => *insights.right_at.entry(at + 1).or_default() += 1,
            None if person.rows.is_empty() => insights.nothing += 1,
            None => *insights.trying.entry(graded.len()).or_default() += 1,
        }
        let said: Vec<Vec<(Option<String>, Text)>> = graded.iter().map(|row| said(row, refusals, title)).collect();
        for (at, (own, _)) in said.iter().zip(&graded).enumerate().filter(|(_, (_, row))| !is_right(row)) {
            for (mistake, text) in own {
                let key = (mistake.clone(), text.en.clone());
                let (message, students) =
                    messages.entry(key).or_insert_with(|| (MessageInsight::new(mistake, text), BTreeSet::new()));
                message.said += 1;
                students.insert(&person.key);
                match graded.get(at + 1) {
                    None => message.last += 1,
                    Some(next) if is_right(next) => message.right += 1,
                    Some(_) if said[at + 1].iter().any(|(_, next)| next.en == text.en) => message.again += 1,
                    Some(_) => message.gone += 1,
                }
            }
        }
    }
    let finished =
        |(message, students): (MessageInsight, BTreeSet<&str>)| MessageInsight { students: students.len(), ..message };
    insights.messages = messages.into_values().map(finished).collect();
    insights.messages.sort_by(|a, b| b.said.cmp(&a.said).then_with(|| a.text.en.cmp(&b.text.en)));
    insights.messages.truncate(MOST_MESSAGES);
    insights.stretches = stretches(class);
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for (id, count) in insights.stretches.iter().flat_map(|stretch| &stretch.mistakes) {
        *counts.entry(id).or_default() += count;
    }
    let mut mistakes: Vec<(&str, usize)> = counts.into_iter().collect();
    mistakes.sort_by_key(|(id, count)| (std::cmp::Reverse(*count), *id));
    insights.mistakes = mistakes.into_iter().map(|(id, _)| (id.to_owned(), title(id))).collect();
    insights
}

fn is_right(row: &ClassRow) -> bool {
    row.row.verdict == Some(Verdict::Correct)
}

/// What was said of a hand-in, each once.
fn said(
    row: &ClassRow,
    refusals: &HashMap<String, Vec<Diagnostic>>,
    title: &dyn Fn(&str) -> Text,
) -> Vec<(Option<String>, Text)> {
    let mistakes = row.mistakes.iter().map(|id| (Some(id.clone()), title(id)));
    let refusals = refusals.get(&row.row.submission.id).into_iter().flatten();
    let errors = refusals.filter(|said| said.severity == Severity::Error);
    let errors = errors.map(|said| (None, Text::new(unquoted(&said.message.en), unquoted(&said.message.ja))));
    let mut all: Vec<(Option<String>, Text)> = Vec::new();
    for said in mistakes.chain(errors) {
        if !all.iter().any(|(_, known)| known.en == said.1.en) {
            all.push(said);
        }
    }
    all
}

/// A message without what it quotes: names are each student's own.
fn unquoted(text: &str) -> String {
    let pieces = text.split('`').enumerate();
    pieces.map(|(at, piece)| if at % 2 == 1 { "`…`" } else { piece }).collect()
}

fn stretches(class: &[Person]) -> Vec<TimeStretch> {
    let graded = || class.iter().flat_map(|person| &person.rows).filter(|row| row.row.verdict.is_some());
    let at = |row: &ClassRow| row.row.submission.received_at;
    let (Some(from), Some(to)) = (graded().map(at).min(), graded().map(at).max()) else { return Vec::new() };
    let width = ((to - from) / STRETCHES as Millis + 1).max(1);
    let stretch = |number: usize| {
        let from = from + width * number as Millis;
        TimeStretch { from, to: from + width, hand_ins: 0, right: 0, mistakes: HashMap::new() }
    };
    let mut stretches: Vec<TimeStretch> = (0..STRETCHES).map(stretch).collect();
    for row in graded() {
        let place = usize::try_from((at(row) - from) / width).unwrap_or(0).min(STRETCHES - 1);
        let stretch = &mut stretches[place];
        stretch.hand_ins += 1;
        stretch.right += usize::from(is_right(row));
        row.mistakes.iter().for_each(|id| *stretch.mistakes.entry(id.clone()).or_default() += 1);
    }
    stretches
}

impl MessageInsight {
    fn new(mistake: &Option<String>, text: &Text) -> Self {
        let (said, students, right, gone, again, last) = Default::default();
        Self { mistake: mistake.clone(), text: text.clone(), said, students, right, gone, again, last }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::service::classes::samples::person;

    #[test]
    fn attempts_messages_and_time_are_counted_by_hand() {
        // a: two mistakes, then one of them, then right. b: right at once. c: the same mistake twice. d: nothing.
        let class = [
            person("a", &[(0, 10.0, "x y"), (50, 60.0, "y"), (120, 100.0, "")]),
            person("b", &[(10, 100.0, "")]),
            person("c", &[(20, 10.0, "x"), (30, 10.0, "x")]),
            person("d", &[]),
        ];
        let title = |id: &str| Text::new(format!("about {id}"), id);
        let found = gather(&class, &HashMap::new(), &title);
        assert_eq!(found.right_at, BTreeMap::from([(1, 1), (3, 1)]));
        assert_eq!((&found.trying, found.nothing), (&BTreeMap::from([(2, 1)]), 1));
        let counts = |message: &MessageInsight| {
            [message.said, message.students, message.right, message.gone, message.again, message.last]
        };
        let messages: Vec<_> = found.messages.iter().map(|it| (it.text.en.as_str(), counts(it))).collect();
        // x: of a, who then had y alone; of c, who had it again, and then handed in nothing. y: of a, who had it again, and then
        // was right.
        assert_eq!(messages, [("about x", [3, 2, 0, 1, 1, 1]), ("about y", [2, 1, 1, 0, 1, 0])]);
        // 120 ms in twelve parts of 11: x at 0, 20 and 30; y at 0 and 50.
        let had = |id: &str| -> Vec<usize> {
            found.stretches.iter().map(|stretch| stretch.mistakes.get(id).copied().unwrap_or(0)).collect()
        };
        assert_eq!(had("x"), [1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0]);
        assert_eq!(had("y"), [1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0]);
        assert_eq!(found.stretches.iter().map(|it| it.hand_ins).sum::<usize>(), 6);
        assert_eq!(found.mistakes[0].0, "x");
    }

    #[test]
    fn a_message_is_the_same_whatever_it_quotes() {
        assert_eq!(unquoted("`foo` is no name; write `bar`."), "`…` is no name; write `…`.");
    }
}
