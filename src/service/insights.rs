//! What a course learns from a homework: how many attempts a right answer takes, which mistakes come when, and which messages
//! were followed by a right answer. It is of the class; nobody is named.

use super::State;
use super::classes::{Person, people};
use super::clock::Millis;
use super::errors::Problem;
use super::store::ClassRow;
use crate::diagnostic::{Diagnostic, Severity};
use crate::language::Language;
use crate::language::Text;
use crate::report::Verdict;
use crate::report::labels::mistake_title;
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// Stretches of time.
const STRETCHES: usize = 12;

/// Most messages that are listed.
const MOST_MESSAGES: usize = 60;

/// What was learned.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Insights {
    /// How many students have had their first right answer at which attempt, from 1.
    pub right_at: BTreeMap<usize, usize>,
    /// How many have none yet, by how often they have tried.
    pub trying: BTreeMap<usize, usize>,
    /// How many have handed in nothing.
    pub nothing: usize,
    /// The time between the first and the last hand-in, in equal parts.
    pub stretches: Vec<TimeStretch>,
    /// The mistakes that were handed in, with their titles, the most frequent first.
    pub mistakes: Vec<(String, Text)>,
    /// What was said, the most frequent first.
    pub messages: Vec<MessageInsight>,
}

/// A part of the time.
#[derive(Clone, Debug, PartialEq)]
pub struct TimeStretch {
    /// When it begins,
    pub from: Millis,
    /// and ends.
    pub to: Millis,
    /// How many files were handed in and graded,
    pub hand_ins: usize,
    /// how many of them were right,
    pub right: usize,
    /// and how many had each mistake, by its id.
    pub mistakes: HashMap<String, usize>,
}

/// A message, and what came after it.
#[derive(Clone, Debug, PartialEq)]
pub struct MessageInsight {
    /// Id of the mistake; none for what the compiler and its like say.
    pub mistake: Option<String>,
    /// What was said: the mistake's title, or the message without what it quotes from a file.
    pub text: Text,
    /// In how many hand-ins it was said,
    pub said: usize,
    /// and to how many students.
    pub students: usize,
    /// How often the student's next hand-in was right,
    pub right: usize,
    /// was not right, and this was not said any more,
    pub gone: usize,
    /// had this said again,
    pub again: usize,
    /// and how often there was no next one.
    pub last: usize,
}

/// What the homework's class shows.
pub async fn of(state: &State) -> Result<Insights, Problem> {
    let class = people(state).await?.class;
    let refusals = state.store.refusals(&state.assignment.id).await?;
    let title = |id: &str| {
        let of = |language| mistake_title(&state.assignment, id, language).to_owned();
        Text::new(of(Language::En), of(Language::Ja))
    };
    Ok(gather(&class, &refusals, &title))
}

/// A message as what tells it from others: the known mistake, if it is one, and its English.
type MessageKey = (Option<String>, String);

fn gather(class: &[Person], refusals: &HashMap<String, Vec<Diagnostic>>, title: &dyn Fn(&str) -> Text) -> Insights {
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

/// A table of what was learned.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize, utoipa::ToSchema)]
#[serde(rename_all = "lowercase")]
pub enum Table {
    /// Attempts until a right answer.
    Attempts,
    /// Mistakes over time.
    Mistakes,
    /// Messages, and what came after them.
    Messages,
}

impl Table {
    /// Its name.
    pub fn id(self) -> &'static str {
        match self {
            Self::Attempts => "attempts",
            Self::Mistakes => "mistakes",
            Self::Messages => "messages",
        }
    }

    /// The table: headings, and lines.
    pub fn rows(self, insights: &Insights, language: Language) -> Vec<Vec<String>> {
        let words = |words: &[&str]| words.iter().map(|word| (*word).to_owned()).collect();
        let count = |number: &usize| number.to_string();
        match self {
            Self::Attempts => {
                let row = |outcome: &str, (attempts, students): (&usize, &usize)| {
                    vec![outcome.to_owned(), count(attempts), count(students)]
                };
                let right = insights.right_at.iter().map(|it| row("right", it));
                let trying = insights.trying.iter().map(|it| row("not right", it));
                let nothing = std::iter::once(row("nothing", (&0, &insights.nothing)));
                let headings = words(&["outcome", "attempts", "students"]);
                std::iter::once(headings).chain(right).chain(trying).chain(nothing).collect()
            }
            Self::Mistakes => {
                let headings = words(&["from", "to", "hand_ins", "right", "mistake", "title", "count"]);
                let row = |stretch: &TimeStretch, id: &str, title: &str, had: usize| {
                    let [from, to] = [stretch.from, stretch.to].map(super::clock::rfc3339);
                    vec![
                        from,
                        to,
                        count(&stretch.hand_ins),
                        count(&stretch.right),
                        id.into(),
                        title.into(),
                        count(&had),
                    ]
                };
                let rows = insights.stretches.iter().flat_map(|stretch| {
                    let of = |(id, title): &(String, Text)| {
                        row(stretch, id, title.get(language), stretch.mistakes.get(id).copied().unwrap_or(0))
                    };
                    insights.mistakes.iter().map(of).collect::<Vec<_>>()
                });
                std::iter::once(headings).chain(rows).collect()
            }
            Self::Messages => {
                let headings = words(&[
                    "mistake",
                    "message",
                    "said",
                    "students",
                    "next_right",
                    "next_without",
                    "next_again",
                    "no_next",
                ]);
                let row = |it: &MessageInsight| {
                    let MessageInsight { mistake, text, said, students, right, gone, again, last } = it;
                    let texts = [mistake.clone().unwrap_or_default(), text.get(language).to_owned()];
                    texts.into_iter().chain([said, students, right, gone, again, last].map(count)).collect()
                };
                std::iter::once(headings).chain(insights.messages.iter().map(row)).collect()
            }
        }
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
