//! The homeworks of a course: which it has, in which order, what each counts, and from when on students see it.

use super::super::datetime;
use super::super::frame::PageFrame;
use super::super::shown;
use super::{Tab, refused};
use crate::report::text::number;
use crate::sandbox::MOST_ASSIGNMENTS;
use crate::service::acts::{Detail, changes};
use crate::service::clock::{Millis, local_minute};
use crate::service::courses;
use crate::service::errors::Problem;
use crate::service::identity::{LecturerPage, Teacher};
use crate::service::rules;
use crate::service::store::CoursePlace;
use crate::service::{Service, State};
use askama::Template;
use axum::Form;
use axum::extract::State as Shared;
use axum::http::StatusCode;
use axum::response::{IntoResponse, Redirect, Response};
use std::collections::HashMap;

#[derive(Template)]
#[template(path = "service/pages/templates/plan.html")]
struct PlanPage {
    frame: PageFrame,
    place: Tab,
    csrf: String,
    problem: Option<String>,
    lines: Vec<HomeworkLine>,
    /// Id and title of what the course can have as well.
    others: Vec<(String, String)>,
    /// Whether it is the first course, which has what the service was started with.
    is_first: bool,
}

/// A homework of the course.
struct HomeworkLine {
    id: String,
    title: String,
    href: String,
    position: String,
    points: String,
    /// Points of its rubric.
    most: String,
    /// `shown`, `hidden` or `from`.
    seen: String,
    from: String,
    /// Whether it can be taken out here: it was chosen, and has no folder of its own.
    can_leave: bool,
}

/// The form: `csrf`, and of each homework `position.ID`, `points.ID`, `seen.ID`, `from.ID`, `leave.ID`, `add.ID`.
type Fields = HashMap<String, String>;

fn field<'a>(fields: &'a Fields, name: &str, id: &str) -> Option<&'a str> {
    fields.get(&format!("{name}.{id}")).map(|text| text.trim())
}

fn line(
    service: &Service,
    frame: &PageFrame,
    state: &State,
    index: usize,
    place: Option<&CoursePlace>,
    typed: &Fields,
) -> HomeworkLine {
    let id = state.assignment.id.clone();
    let given = |name: &str, stands: String| field(typed, name, &id).map_or(stands, str::to_owned);
    let shown_from = place.and_then(|place| place.shown_from);
    let seen = match place {
        Some(place) if place.is_hidden != 0 => "hidden",
        _ if shown_from.is_some() => "from",
        _ => "shown",
    };
    HomeworkLine {
        title: frame.language.of(&state.assignment.title).to_owned(),
        href: format!("{}/teacher", state.base()),
        position: given("position", (index + 1).to_string()),
        points: given("points", place.and_then(|place| place.points).map(number).unwrap_or_default()),
        most: number(state.assignment.max_score()),
        seen: given("seen", seen.to_owned()),
        from: given("from", shown_from.map(|at| local_minute(at, frame.course.zone())).unwrap_or_default()),
        can_leave: service.is_beside() && service.named_as(&id).is_some(),
        id,
    }
}

async fn view(
    service: &Service,
    frame: PageFrame,
    teacher: &Teacher,
    typed: &Fields,
    problem: Option<String>,
) -> Result<Response, Problem> {
    let places = service.store.places().await?;
    let place = |state: &State| places.iter().find(|place| place.id == state.assignment.id);
    let lines = service.homeworks().enumerate();
    let lines: Vec<HomeworkLine> =
        lines.map(|(index, state)| line(service, &frame, &state, index, place(&state), typed)).collect();
    let offered = if service.is_beside() { service.offered() } else { &[] };
    let others = offered.iter().filter(|one| lines.iter().all(|line| line.id != one.id));
    let others = others.map(|one| (one.id.clone(), frame.language.of(&one.title).to_owned())).collect();
    shown(
        PlanPage {
            place: Tab::Plan,
            csrf: teacher.csrf(service),
            problem,
            lines,
            others,
            is_first: !service.is_beside(),
            frame,
        }
        .render(),
    )
}

/// `GET /teacher/plan`.
pub(in crate::service::pages) async fn page(
    Shared(service): Shared<Service>,
    LecturerPage(teacher): LecturerPage,
    frame: PageFrame,
) -> Result<Response, Problem> {
    teacher.check_course()?;
    view(&service, frame, &teacher, &Fields::new(), None).await
}

/// `POST /teacher/plan`.
pub(in crate::service::pages) async fn save(
    Shared(service): Shared<Service>,
    LecturerPage(teacher): LecturerPage,
    frame: PageFrame,
    Form(fields): Form<Fields>,
) -> Result<Response, Problem> {
    teacher.check_course()?;
    teacher.check_csrf(&service, fields.get("csrf").map_or("", String::as_str))?;
    let added: Vec<String> = service
        .offered()
        .iter()
        .filter(|one| {
            service.is_beside() && field(&fields, "add", &one.id).is_some() && service.homework(&one.id).is_none()
        })
        .map(|one| one.id.clone())
        .collect();
    for id in &added {
        service.store.assignment(id).await?;
    }
    match places(&service, &frame, &fields, &added).await? {
        Ok(places) => {
            let known = service.store.places().await?;
            let page = datetime::with_unclear("/teacher/plan", &shown_dates(&fields, &known), frame.course.zone());
            let before = described(&service, &frame, &places, known);
            courses::set_places(&service, places.clone()).await?;
            let after = described(&service, &frame, &places, service.store.places().await?);
            Ok(Detail::of(changes(&before, &after)).on(Redirect::to(&page).into_response()))
        }
        Err(wrong) => {
            let page = view(&service, frame, &teacher, &fields, Some(wrong)).await?;
            Ok(refused(page, StatusCode::UNPROCESSABLE_ENTITY))
        }
    }
}

/// The dates from which homeworks are to be shown, with those from which they were.
fn shown_dates<'a>(fields: &'a Fields, known: &[CoursePlace]) -> Vec<(&'a str, Option<Millis>)> {
    let is_dated = |place: &&CoursePlace| field(fields, "seen", &place.id) == Some("from");
    let date = |place: &CoursePlace| Some((field(fields, "from", &place.id)?, place.shown_from));
    known.iter().filter(is_dated).filter_map(date).collect()
}

/// The order of the course, and these homeworks in it as `known` has them, in the words of the log of acts.
fn described(
    service: &Service,
    frame: &PageFrame,
    homeworks: &[CoursePlace],
    known: Vec<CoursePlace>,
) -> Vec<(String, String)> {
    let mut said = vec![("order".to_owned(), service.ids().join(" "))];
    for homework in homeworks {
        let place = known.iter().find(|place| place.id == homework.id).unwrap_or(homework);
        let of_place = rules::described_place(place, frame.course.zone());
        said.extend(of_place.map(|(name, value)| (format!("{} {name}", homework.id), value)));
    }
    said
}

/// What the form makes of the course's homeworks: those that it has in their new order, and then those that were added.
async fn places(
    service: &Service,
    frame: &PageFrame,
    fields: &Fields,
    added: &[String],
) -> Result<Result<Vec<CoursePlace>, String>, Problem> {
    let known = service.store.places().await?;
    let find = |id: &str| known.iter().find(|place| place.id == *id).cloned();
    let mut ordered = Vec::new();
    for (index, id) in service.ids().iter().enumerate() {
        let Some(place) = find(id) else { continue };
        let position = field(fields, "position", id).and_then(|text| text.parse().ok()).unwrap_or(index as f64 + 1.0);
        match read(frame, fields, place) {
            Ok(place) => ordered.push((position, place)),
            Err(wrong) => return Ok(Err(wrong)),
        }
    }
    // Two with one number stay in the order in which they stand.
    ordered.sort_by(|(one, _), (other, _)| f64::total_cmp(one, other));
    let mut places: Vec<CoursePlace> = ordered.into_iter().map(|(_, place)| place).collect();
    places.extend(added.iter().filter_map(|id| Some(CoursePlace { is_chosen: 1, ..find(id)? })));
    for (place, position) in places.iter_mut().zip(0..) {
        place.position = Some(position);
        let leaves = service.is_beside() && field(fields, "leave", &place.id).is_some();
        place.is_chosen = if leaves { 0 } else { place.is_chosen };
    }
    if places.len() > MOST_ASSIGNMENTS {
        return Ok(Err(courses::too_many().detail.get(frame.language).to_owned()));
    }
    Ok(Ok(places))
}

/// What the form says of one homework.
fn read(frame: &PageFrame, fields: &Fields, place: CoursePlace) -> Result<CoursePlace, String> {
    let points = match field(fields, "points", &place.id) {
        None => place.points,
        Some("") => None,
        Some(text) => {
            // What is no number is none that a homework may count.
            let points = rules::check_points(text.parse().unwrap_or(f64::NAN));
            Some(points.map_err(|wrong| wrong.get(frame.language).to_owned())?)
        }
    };
    let from = field(fields, "from", &place.id).unwrap_or_default();
    let from = datetime::parse(from, frame.course.zone(), place.shown_from)
        .and_then(|from| rules::check_date(from).map(|()| from));
    let from = from.map_err(|wrong| wrong.get(frame.language).to_owned())?;
    let (is_hidden, shown_from) = match (field(fields, "seen", &place.id), from) {
        (Some("hidden"), _) => (1, None),
        (Some("from"), None) => {
            return Err(frame.say("Say from when on it is shown.", "公開を始める日時を入力してください。").to_owned());
        }
        (Some("from"), from) => (0, from),
        (Some(_), _) => (0, None),
        (None, _) => (place.is_hidden, place.shown_from),
    };
    Ok(CoursePlace { points, is_hidden, shown_from, ..place })
}
