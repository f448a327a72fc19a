//! Answers of the class that are alike, and two of them side by side.

use super::super::frame::PageFrame;
use super::super::shown;
use super::Tab;
use crate::likeness::{Comparison, Pair};
use crate::service::State;
use crate::service::classes::people;
use crate::service::errors::Problem;
use crate::service::identity::{Teacher, TeacherPage};
use crate::service::likeness::{self, AlikePerson};
use askama::Template;
use axum::extract::{Query, State as Shared};
use axum::http::HeaderMap;
use axum::response::Response;
use serde::Deserialize;
use std::collections::HashMap;

#[derive(Template)]
#[template(path = "service/pages/templates/likeness.html")]
struct LikenessPage {
    frame: PageFrame,
    place: Tab,
    csrf: String,
    class: usize,
    others: usize,
    left_out: usize,
    rows: Vec<AlikePairLine>,
}

/// Two that are alike.
struct AlikePairLine {
    pair: Pair,
    members: [AlikePerson; 2],
    href: String,
}

#[derive(Template)]
#[template(path = "service/pages/templates/side_by_side.html")]
struct SideBySidePage {
    frame: PageFrame,
    place: Tab,
    csrf: String,
    comparison: Comparison,
    /// The addresses of the two reports.
    reports: [String; 2],
}

/// `GET /teacher/likeness`.
pub(in crate::service::pages) async fn page(
    Shared(state): Shared<State>,
    TeacherPage(teacher): TeacherPage,
    headers: HeaderMap,
    frame: PageFrame,
) -> Result<Response, Problem> {
    let found = likeness::find(&state, &headers).await?;
    let hidden = hidden(&state, &teacher, &frame).await?;
    let row = |(pair, members): (Pair, [AlikePerson; 2])| {
        let members = members.map(|member| hidden.shown(member));
        let [one, other] = &members;
        let mut href = format!("{}/likeness/pair?one={}&other={}", frame.teacher(), one.submission, other.submission);
        // Two of which one is of another course: the other one is of this class.
        if let Some(course) = &other.course {
            href.push_str(&format!("&{}", course.query()));
        }
        AlikePairLine { pair, members, href }
    };
    shown(
        LikenessPage {
            place: Tab::Likeness,
            csrf: teacher.csrf(&state),
            class: found.class,
            others: found.others,
            left_out: found.left_out,
            rows: found.pairs.into_iter().map(row).collect(),
            frame,
        }
        .render(),
    )
}

/// Which two.
#[derive(Debug, Deserialize)]
pub(in crate::service::pages) struct Two {
    one: String,
    other: String,
    /// What the addresses of the other one's course begin with, where that is another one.
    course: Option<String>,
}

/// `GET /teacher/likeness/pair?one=&other=&course=`.
pub(in crate::service::pages) async fn side_by_side(
    Shared(state): Shared<State>,
    TeacherPage(teacher): TeacherPage,
    headers: HeaderMap,
    Query(Two { one, other, course }): Query<Two>,
    frame: PageFrame,
) -> Result<Response, Problem> {
    let hidden = hidden(&state, &teacher, &frame).await?;
    let (there, of_there) = likeness::in_course(&state, course.as_deref(), &headers).await?;
    let members =
        [likeness::member_of(&state, &one, None).await?, likeness::member_of(&there, &other, of_there.as_ref()).await?];
    let reports = [format!("{}/r/{one}", state.root()), format!("{}/r/{other}", there.root())];
    let names = members.map(|member| hidden.shown(member).called());
    let comparison = likeness::compare([(&state, &one), (&there, &other)], names).await?;
    shown(SideBySidePage { place: Tab::Likeness, csrf: teacher.csrf(&state), comparison, reports, frame }.render())
}

/// The names of a class as the one who looks reads them.
struct ClassNames(Option<HashMap<String, String>>);

impl ClassNames {
    fn shown(&self, member: AlikePerson) -> AlikePerson {
        match &self.0 {
            _ if member.course.is_some() => member,
            None => member,
            Some(pseudonyms) => {
                let number = pseudonyms.get(&member.key).cloned().unwrap_or_default();
                AlikePerson { number, name: String::new(), ..member }
            }
        }
    }
}

/// With pseudonyms, everybody is called as in the table of the class.
async fn hidden(state: &State, teacher: &Teacher, frame: &PageFrame) -> Result<ClassNames, Problem> {
    if teacher.sees_names() {
        return Ok(ClassNames(None));
    }
    let mut keys: Vec<String> = people(state).await?.class.into_iter().map(|person| person.key).collect();
    keys.sort();
    Ok(ClassNames(Some(keys.into_iter().enumerate().map(|(place, key)| (key, frame.pseudonym(place))).collect())))
}
