//! What a course learns from a homework: how many attempts a right answer takes, which mistakes come when, and which messages
//! were followed by a right answer. It is of the class; nobody is named.

mod counting;

use super::State;
use super::classes::people;
use super::clock::Millis;
use super::errors::Problem;
use crate::language::Language;
use crate::language::Text;
use crate::report::labels::mistake_title;
use std::collections::{BTreeMap, HashMap};

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
        let of = |language| mistake_title(&state.assignment, id, language);
        Text::new(of(Language::En), of(Language::Ja))
    };
    Ok(counting::gather(&class, &refusals, &title))
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
