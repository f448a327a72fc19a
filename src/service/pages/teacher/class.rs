//! The class: everyone's picture and result, filters, charts.

use super::super::frame::PageFrame;
use super::super::{hand_in, shown, student};
use super::charts::{self, HEIGHT, Histogram, SPARK, SubmissionChart, Trend, WIDTH};
use super::downloads::{DownloadOffer, formats};
use super::table::{StudentTable, TableFilter, titled};
use super::{Tab, word};
use crate::report::html::Mark;
use crate::service::State;
use crate::service::classes::{People, Person, PersonStanding, people};
use crate::service::courses::at;
use crate::service::errors::Problem;
use crate::service::identity::{Teacher, TeacherPage};
use askama::Template;
use axum::extract::{Query, State as Shared};
use axum::response::Response;

#[derive(Template)]
#[template(path = "service/pages/templates/class.html")]
struct ClassPage {
    frame: PageFrame,
    place: Tab,
    csrf: String,
    title: String,
    file: String,
    filter: TableFilter,
    notice: Option<&'static str>,
    tallies: Vec<StandingCount>,
    expected: String,
    everyone: usize,
    handed_in: usize,
    /// How many files are of nobody in the class.
    strangers: usize,
    /// On how many files of the class driver and interpreter disagree.
    disputed: usize,
    /// Requests for another look that are not answered.
    appeals: u64,
    has_roster: bool,
    histogram: Histogram,
    course: Option<(SubmissionChart, String, String)>,
    trends: Vec<Trend>,
    /// Title and id of those to filter by.
    mistakes: Vec<(String, String)>,
    table: StudentTable,
    formats: Vec<DownloadOffer>,
    /// Where the files of the formats are, and the batch that they are of: none, for the class.
    files: String,
    of_batch: &'static str,
    /// By which an address of the API says which homework it is about.
    query: String,
    /// Where the form for Moodle's worksheet leads, and what is wrong with what was sent.
    worksheet: String,
    problem: Option<String>,
    drawing: (f64, f64),
    spark: (f64, f64),
}

/// How many stand in one way.
struct StandingCount {
    id: &'static str,
    word: &'static str,
    mark: Option<&'static str>,
    count: usize,
    x: f64,
    width: f64,
}

/// `GET /teacher`.
pub(in crate::service::pages) async fn page(
    Shared(state): Shared<State>,
    TeacherPage(teacher): TeacherPage,
    Query(filter): Query<TableFilter>,
    frame: PageFrame,
) -> Result<Response, Problem> {
    view(&state, &teacher, frame, filter, None).await
}

/// The page, with what is wrong with a worksheet.
pub(super) async fn view(
    state: &State,
    teacher: &Teacher,
    frame: PageFrame,
    mut filter: TableFilter,
    problem: Option<String>,
) -> Result<Response, Problem> {
    if !teacher.sees_names() {
        filter.anonymous = "on".to_owned();
    }
    let People { mut class, mut apart } = people(state).await?;
    // Pseudonyms follow an order that says nothing of names, and stay as they are when others join.
    class.sort_by(|a, b| a.key.cmp(&b.key));
    apart.sort_by(|a, b| a.key.cmp(&b.key));
    let everyone: Vec<&Person> = class.iter().collect();
    let strangers: Vec<&Person> = apart.iter().collect();
    let listed = if filter.is_apart() { &strangers } else { &everyone };
    let id = &state.assignment.id;
    let mut mistakes: Vec<String> =
        listed.iter().filter_map(|person| person.counted()).flat_map(|row| row.mistakes.iter().cloned()).collect();
    mistakes.sort_unstable();
    mistakes.dedup();
    let mut mistakes = titled(&frame, &mistakes);
    mistakes.sort();
    let course = charts::course(&everyone).map(|course| {
        let (from, to) = (frame.datetime(course.from).text, frame.datetime(course.to).text);
        (course, from, to)
    });
    let deleted = frame.say(
        "Deleted for good; the settings page lists what was deleted.",
        "削除しました。削除の記録は設定ページにあります。",
    );
    shown(
        ClassPage {
            place: Tab::Class,
            csrf: teacher.csrf(state),
            title: student::title(&state.assignment, frame.language),
            file: id.clone(),
            notice: (filter.done == "deleted").then_some(deleted),
            tallies: tallies(&frame, listed),
            expected: hand_in::picture(&state.assignment, "portrait"),
            everyone: everyone.len(),
            handed_in: everyone.iter().filter(|person| !person.rows.is_empty()).count(),
            strangers: strangers.iter().map(|person| person.rows.len().max(1)).sum(),
            disputed: everyone.iter().flat_map(|person| &person.rows).filter(|row| row.differs).count(),
            appeals: state.store.open_appeals(id).await?,
            has_roster: state.store.has_roster().await?,
            histogram: charts::histogram(&everyone),
            course,
            trends: charts::trends(&frame, &everyone),
            mistakes,
            table: StudentTable::of(&frame, listed, &filter),
            formats: formats(&frame),
            files: at("/api/v1/class/files"),
            of_batch: "",
            query: state.query(),
            worksheet: format!("{}/worksheet", frame.teacher()),
            problem,
            filter,
            drawing: (WIDTH, HEIGHT),
            spark: SPARK,
            frame,
        }
        .render(),
    )
}

fn tallies(frame: &PageFrame, all: &[&Person]) -> Vec<StandingCount> {
    let total = all.len().max(1) as f64;
    let mut x = 0.0;
    let tally = |standing: PersonStanding| {
        let count = all.iter().filter(|person| person.standing() == standing).count();
        let width = 1000.0 * count as f64 / total;
        let mark = match standing {
            PersonStanding::Graded(verdict) => Some(Mark::of_verdict(verdict, 1.0).id()),
            _ => None,
        };
        let tally = StandingCount { id: standing.id(), word: word(frame, standing), mark, count, x, width };
        x += width;
        tally
    };
    PersonStanding::ALL.into_iter().map(tally).filter(|tally| tally.count > 0).collect()
}
