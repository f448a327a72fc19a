//! The class: everyone's picture and result, filters, charts.

use super::super::frame::Frame;
use super::super::moment::Moment;
use super::super::{internal, part, shown, student};
use super::Place;
use super::charts::{self, Course, HEIGHT, Histogram, SPARK, Trend, WIDTH};
use super::people::{Person, Standing, people};
use crate::service::State;
use crate::service::errors::Problem;
use crate::service::identity::TeacherPage;
use askama::Template;
use axum::extract::{Query, State as Shared};
use axum::response::Response;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde::Deserialize;

/// What to show.
#[derive(Clone, Debug, Default, Deserialize)]
pub(in crate::service::pages) struct Filter {
    #[serde(default)]
    verdict: String,
    #[serde(default)]
    mistake: String,
    #[serde(default)]
    q: String,
    #[serde(default)]
    sort: String,
    #[serde(default)]
    anonymous: String,
}

impl Filter {
    fn is_anonymous(&self) -> bool {
        self.anonymous == "on"
    }

    fn takes(&self, person: &Person) -> bool {
        let best = person.best();
        let q = self.q.trim().to_lowercase();
        let has = |text: &str| text.to_lowercase().contains(&q);
        (self.verdict.is_empty() || person.standing().id() == self.verdict)
            && (self.mistake.is_empty() || best.is_some_and(|best| best.mistakes.contains(&self.mistake)))
            && (q.is_empty() || (!self.is_anonymous() && (has(&person.number) || has(&person.name))))
    }

    fn sort(&self, people: &mut [(usize, &Person)]) {
        let score = |person: &Person| person.best().and_then(|best| best.row.score).unwrap_or(-1.0);
        match self.sort.as_str() {
            "score" => people.sort_by(|(_, a), (_, b)| score(b).total_cmp(&score(a))),
            "score-up" => people.sort_by(|(_, a), (_, b)| score(a).total_cmp(&score(b))),
            "time" => people.sort_by_key(|(_, person)| std::cmp::Reverse(person.latest())),
            _ if self.is_anonymous() => {}
            _ => people.sort_by(|(_, a), (_, b)| (&a.number, &a.name, &a.key).cmp(&(&b.number, &b.name, &b.key))),
        }
    }
}

#[derive(Template)]
#[template(path = "service/class.html")]
struct View {
    frame: Frame,
    place: Place,
    csrf: String,
    title: String,
    file: String,
    filter: Filter,
    tallies: Vec<Tally>,
    expected: String,
    everyone: usize,
    handed_in: usize,
    histogram: Histogram,
    course: Option<(Course, String, String)>,
    trends: Vec<Trend>,
    mistakes: Vec<String>,
    rows: Vec<Row>,
    drawing: (f64, f64),
    spark: (f64, f64),
}

/// How many stand in one way.
struct Tally {
    id: &'static str,
    word: &'static str,
    mark: Option<&'static str>,
    count: usize,
    x: f64,
    width: f64,
}

/// One line of the table.
pub(super) struct Row {
    pub href: String,
    pub number: String,
    pub name: String,
    pub portrait: Option<String>,
    pub mark: Option<&'static str>,
    pub word: &'static str,
    pub score: String,
    pub max_score: String,
    pub mistakes: Vec<String>,
    pub attempts: usize,
    pub at: Option<Moment>,
}

/// `GET /teacher`.
pub(in crate::service::pages) async fn page(
    Shared(state): Shared<State>,
    TeacherPage(teacher): TeacherPage,
    Query(filter): Query<Filter>,
    frame: Frame,
) -> Result<Response, Problem> {
    let frame = frame.of(&state.assignment.id);
    let mut all = people(&state, None).await?;
    // Pseudonyms follow an order that says nothing of names, and stay as they are when others join.
    all.sort_by(|a, b| a.key.cmp(&b.key));
    let everyone: Vec<&Person> = all.iter().collect();
    let mut chosen: Vec<(usize, &Person)> = all.iter().enumerate().filter(|(_, person)| filter.takes(person)).collect();
    filter.sort(&mut chosen);
    let trends = charts::trends(&everyone);
    let mut mistakes: Vec<String> =
        all.iter().filter_map(Person::best).flat_map(|best| best.mistakes.iter().cloned()).collect();
    mistakes.sort_unstable();
    mistakes.dedup();
    let course = charts::course(&everyone).map(|course| {
        let said = |at| Moment::of(at, frame.language).text;
        let (from, to) = (said(course.from), said(course.to));
        (course, from, to)
    });
    let expected = &state.gallery.portraits().map_err(internal)?.expected;
    shown(
        View {
            place: Place::Class,
            csrf: teacher.csrf(&state),
            title: student::title(state.assignment, frame.language),
            file: state.assignment.id.clone(),
            tallies: tallies(&frame, &all),
            expected: format!("data:image/png;base64,{}", STANDARD.encode(expected)),
            everyone: all.len(),
            handed_in: all.iter().filter(|person| !person.rows.is_empty()).count(),
            histogram: charts::histogram(&everyone),
            course,
            trends,
            mistakes,
            rows: chosen.into_iter().map(|(index, person)| row(&frame, &filter, index, person)).collect(),
            filter,
            drawing: (WIDTH, HEIGHT),
            spark: SPARK,
            frame,
        }
        .render(),
    )
}

pub(super) fn word(frame: &Frame, standing: Standing) -> &'static str {
    match standing {
        Standing::Graded(verdict) => part::verdict(frame, verdict),
        Standing::Queued => frame.say("Being graded", "採点中"),
        Standing::Failed => frame.say("Our fault", "サーバ側の障害"),
        Standing::Nothing => frame.say("Nothing handed in", "未提出"),
    }
}

fn tallies(frame: &Frame, all: &[Person]) -> Vec<Tally> {
    let total = all.len().max(1) as f64;
    let mut x = 0.0;
    let tally = |standing: Standing| {
        let count = all.iter().filter(|person| person.standing() == standing).count();
        let width = 1000.0 * count as f64 / total;
        let mark = match standing {
            Standing::Graded(verdict) => Some(student::mark(verdict, Some(1.0)).id()),
            _ => None,
        };
        let tally = Tally { id: standing.id(), word: word(frame, standing), mark, count, x, width };
        x += width;
        tally
    };
    Standing::ALL.into_iter().map(tally).filter(|tally| tally.count > 0).collect()
}

pub(super) fn row(frame: &Frame, filter: &Filter, index: usize, person: &Person) -> Row {
    let best = person.best();
    let shown = best.or(person.rows.first());
    let standing = person.standing();
    let anonymous = filter.is_anonymous();
    let pseudonym = || match frame.tag() {
        "ja" => format!("学生 {}", index + 1),
        _ => format!("Student {}", index + 1),
    };
    let portrait = best.filter(|best| student::draws(best.row.verdict));
    Row {
        href: format!("/teacher/person?key={}{}", person.key, if anonymous { "&anonymous=on" } else { "" }),
        number: if anonymous { pseudonym() } else { person.number.clone() },
        name: if anonymous { String::new() } else { person.name.clone() },
        portrait: portrait.map(|best| format!("/r/{}/portrait.png", best.row.submission.id)),
        mark: best.and_then(|best| Some(student::mark(best.row.verdict?, best.row.score).id())),
        word: word(frame, standing),
        score: part::points(best.and_then(|best| best.row.score)),
        max_score: part::points(best.and_then(|best| best.row.max_score)),
        mistakes: shown.map(|row| row.mistakes.clone()).unwrap_or_default(),
        attempts: person.rows.len(),
        at: person.latest().map(|at| Moment::of(at, frame.language)),
    }
}
