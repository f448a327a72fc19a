//! The list of the homeworks, where a service has several: for students, and for teachers. What a teacher's page of the only homework
//! was before there were several leads on from where it was, and back.

use super::frame::{PageFrame, SignInLink};
use super::standing::{Fact, StudentStanding};
use super::teacher::Tab;
use super::{hand_in, shown, student};
use crate::language::Language;
use crate::report::html::rich::MessagePiece;
use crate::service::counting::countable;
use crate::service::errors::Problem;
use crate::service::identity::{Teacher, TeacherPage, Visitor};
use crate::service::{Service, State};
use askama::Template;
use axum::Router;
use axum::extract::{MatchedPath, Path, State as Shared};
use axum::http::Uri;
use axum::response::{IntoResponse, Redirect, Response};
use axum::routing::{any, get};

/// The routes.
pub(super) fn router() -> Router<Service> {
    Router::new()
        .route("/", get(list))
        .route("/teacher", get(classes))
        .route("/teacher/batches/{id}", get(moved_batch))
        .route("/teacher/regradings/{id}", get(moved_regrading))
        .merge(OF_A_CLASS.iter().fold(Router::new(), |routes, page| routes.route(page, get(moved))))
        .route("/a/{assignment}", any(no_such_homework))
        .route("/a/{assignment}/{*rest}", any(no_such_page))
}

/// The pages of a class that stand without the homework's name where there is one homework.
const OF_A_CLASS: [&str; 8] = [
    "/teacher/appeals",
    "/teacher/insights",
    "/teacher/likeness",
    "/teacher/likeness/pair",
    "/teacher/person",
    "/teacher/extensions",
    "/teacher/batches",
    "/teacher/settings",
];

/// The routes of the only homework at which its class was while there were several.
pub(super) fn of_the_only_one() -> Router<State> {
    Router::new().route("/teacher", get(moved_back)).route("/teacher/{*rest}", get(moved_back))
}

#[derive(Template)]
#[template(path = "service/pages/templates/homeworks.html")]
struct HomeworksPage {
    frame: PageFrame,
    heading: &'static str,
    homeworks: Vec<HomeworkCard>,
    sign_ins: Vec<SignInLink>,
}

/// The same for who teaches.
#[derive(Template)]
#[template(path = "service/pages/templates/classes.html")]
struct ClassesPage {
    frame: PageFrame,
    place: Tab,
    csrf: String,
    heading: &'static str,
    homeworks: Vec<HomeworkCard>,
}

/// A homework of the list.
struct HomeworkCard {
    href: String,
    title: String,
    /// The names of its files.
    file: String,
    task: Vec<MessagePiece>,
    facts: Vec<Fact>,
    /// The addresses of what a right answer draws, and of the same as it moves: the list does not wait for drawing it.
    still: String,
    moving: String,
}

impl HomeworkCard {
    fn of(state: &State, frame: &PageFrame, href: String, facts: Vec<Fact>) -> Self {
        let assignment = &state.assignment;
        Self {
            href,
            title: student::title(assignment, frame.language),
            file: student::file_names(assignment),
            task: student::task(assignment, frame),
            facts,
            still: hand_in::picture(assignment, "portrait"),
            moving: hand_in::picture(assignment, "goal"),
        }
    }
}

/// `GET /`.
async fn list(Shared(service): Shared<Service>, frame: PageFrame, visitor: Visitor) -> Result<Response, Problem> {
    let mut homeworks = Vec::new();
    for state in service.homeworks() {
        if !service.store.assignment(&state.assignment.id).await?.is_shown(service.clock.now()) {
            continue;
        }
        let facts = facts(&state, &frame, &visitor).await?;
        homeworks.push(HomeworkCard::of(&state, &frame, state.page(), facts));
    }
    let heading = frame.say("Homework", "課題の一覧");
    let sign_ins = SignInLink::all(&service, None);
    shown(HomeworksPage { frame, heading, homeworks, sign_ins }.render())
}

/// Dates, attempts, and the best of what this browser has handed in.
async fn facts(state: &State, frame: &PageFrame, visitor: &Visitor) -> Result<Vec<Fact>, Problem> {
    let id = &state.assignment.id;
    let identity = &visitor.identity;
    let settings = state.store.assignment_for(id, identity.student_id()).await?;
    let (mut history, mut used) = (Vec::new(), 0);
    if let Some(owner) = identity.owner_id() {
        history = state.store.history(id, owner, identity.student_id(), student::LISTED).await?;
        used = state.store.attempts(id, owner, identity.student_id()).await?;
    }
    let standing = StudentStanding { settings: &settings, now: state.clock.now(), may_hand_in: true, used };
    let mut facts = standing.facts(frame);
    facts.extend(student::counted_fact(frame, &countable(&history, identity.student_id()), settings.counting));
    Ok(facts)
}

/// `GET /teacher`: the classes that this teacher may see; the class, where it is one.
async fn classes(
    Shared(service): Shared<Service>,
    TeacherPage(teacher): TeacherPage,
    frame: PageFrame,
) -> Result<Response, Problem> {
    let heading = frame.say("Classes", "クラスの一覧");
    of_each(&service, &teacher, frame, heading, "").await
}

/// A page of the class of each homework that this teacher may see: `rest` is what follows `/teacher` in its address.
async fn of_each(
    service: &Service,
    teacher: &Teacher,
    frame: PageFrame,
    heading: &'static str,
    rest: &str,
) -> Result<Response, Problem> {
    let visible: Vec<State> = service.homeworks().filter(|state| teacher.may_see(&state.assignment.id)).collect();
    if let [only] = visible.as_slice() {
        return Ok(Redirect::to(&format!("{}/teacher{rest}", only.base())).into_response());
    }
    let mut homeworks = Vec::new();
    for state in visible {
        let versions = service.store.class_version(&state.assignment.id, None).await?;
        let hand_ins: i64 = versions.iter().map(|(_, count, _)| count).sum();
        let text = match frame.language {
            Language::En => format!("{hand_ins} {}", if hand_ins == 1 { "hand-in" } else { "hand-ins" }),
            Language::Ja => format!("提出 {hand_ins} 件"),
        };
        let facts = vec![Fact::plain("", text)];
        homeworks.push(HomeworkCard::of(&state, &frame, format!("{}/teacher{rest}", state.base()), facts));
    }
    shown(ClassesPage { frame, place: Tab::Classes, csrf: teacher.csrf(service), heading, homeworks }.render())
}

/// The address of a page of the class while there was one homework: now it is a page of each.
async fn moved(
    Shared(service): Shared<Service>,
    TeacherPage(teacher): TeacherPage,
    route: MatchedPath,
    uri: Uri,
    frame: PageFrame,
) -> Result<Response, Problem> {
    let heading = frame.say("Of which class?", "どのクラスのページですか?");
    let page = route.as_str().strip_prefix("/teacher").unwrap_or_default();
    of_each(&service, &teacher, frame, heading, &with_query(page, &uri)).await
}

fn with_query(address: &str, uri: &Uri) -> String {
    uri.query().map_or_else(|| address.to_owned(), |query| format!("{address}?{query}"))
}

/// The same of an archive, which says itself of which homework it is.
async fn moved_batch(
    Shared(service): Shared<Service>,
    TeacherPage(teacher): TeacherPage,
    Path(id): Path<String>,
) -> Result<Redirect, Problem> {
    let batch = service.store.batch(&id).await?.ok_or_else(Problem::not_found)?;
    teacher.check(&batch.assignment)?;
    Ok(Redirect::to(&format!("{}/teacher/batches/{id}", service.homework_of(&batch.assignment)?.base())))
}

/// The same of a regrading.
async fn moved_regrading(
    Shared(service): Shared<Service>,
    TeacherPage(teacher): TeacherPage,
    Path(id): Path<String>,
) -> Result<Redirect, Problem> {
    let regrading = service.store.regrading(&id).await?.ok_or_else(Problem::not_found)?;
    teacher.check(&regrading.assignment)?;
    Ok(Redirect::to(&format!("{}/teacher/regradings/{id}", service.homework_of(&regrading.assignment)?.base())))
}

/// The address of a page of the only homework while there were several.
async fn moved_back(uri: Uri) -> Redirect {
    let page = uri.path().find("/teacher").map_or("/teacher", |start| &uri.path()[start..]);
    Redirect::to(&with_query(page, &uri))
}

/// An address of a homework that there is not.
async fn no_such_homework(Shared(service): Shared<Service>, Path(id): Path<String>) -> Problem {
    Problem::not_served(&id, &service.ids())
}

/// An address below that of a homework.
async fn no_such_page(Shared(service): Shared<Service>, Path((id, _)): Path<(String, String)>) -> Problem {
    match service.homework(&id) {
        Some(_) => Problem::not_found(),
        None => Problem::not_served(&id, &service.ids()),
    }
}
