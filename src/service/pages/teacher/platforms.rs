//! Learning platforms: which ones launch homeworks here, and their rosters.

use super::super::frame::PageFrame;
use super::super::shown;
use super::{Tab, refused};
use crate::service::Service;
use crate::service::acts::Detail;
use crate::service::errors::Problem;
use crate::service::identity::{LecturerPage, Teacher, new_id};
use crate::service::lti::known::{self, KnownPlatform};
use crate::service::lti::memberships::{self, FetchedRoster};
use crate::service::lti::{self, contexts, registration};
use crate::service::store::{HomeworkLink, Platform, StaffRole};
use askama::Template;
use axum::Form;
use axum::extract::State as Shared;
use axum::response::{IntoResponse, Redirect, Response};
use serde::Deserialize;

#[derive(Template)]
#[template(path = "service/pages/templates/platforms.html")]
struct PlatformsPage {
    frame: PageFrame,
    place: Tab,
    csrf: String,
    platforms: Vec<PlatformLine>,
    /// Whether this teacher may add and change platforms.
    may_change: bool,
    /// A registration link that was just made.
    link: Option<String>,
    problem: Option<String>,
    notice: Option<String>,
    /// The courses here with which a platform's course can be connected: id and title.
    here: Vec<(String, String)>,
    /// The address of this service, or why it is not known.
    own: Result<String, String>,
    typed: PlatformForm,
}

/// A platform of the list.
struct PlatformLine {
    known: KnownPlatform,
    /// Links by which rosters are fetched, one of each course.
    rosters: Vec<HomeworkLink>,
}

/// A form of the page. `wish` says which.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::service::pages) struct PlatformForm {
    csrf: String,
    wish: String,
    platform: String,
    deployment: String,
    link: String,
    context: String,
    /// Id of the course; `-`: none.
    course: String,
    name: String,
    issuer: String,
    client_id: String,
    auth_url: String,
    token_url: String,
    keys_url: String,
    token_audience: String,
}

/// What the form says for no course.
const NO_COURSE: &str = "-";

/// The courses with which a platform's course can be connected: this one, and the others where it is the first.
async fn here(service: &Service, frame: &PageFrame) -> Result<Vec<(String, String)>, Problem> {
    let mut here = Vec::new();
    for course in service.everywhere() {
        let is_own = course.root() == service.root();
        let id = course.course_id().filter(|_| !is_own).unwrap_or_default().to_owned();
        let title = course.store.course().await?.title;
        let untitled = || if is_own { frame.say("This course", "この授業").to_owned() } else { id.clone() };
        here.push((id.clone(), if title.is_empty() { untitled() } else { title }));
    }
    Ok(here)
}

/// What the page says of a form that was sent.
#[derive(Default)]
struct PlatformsNotice {
    link: Option<String>,
    problem: Option<String>,
    notice: Option<String>,
    typed: PlatformForm,
}

async fn view(
    service: &Service,
    frame: PageFrame,
    teacher: &Teacher,
    said: PlatformsNotice,
) -> Result<Response, Problem> {
    teacher.check_course()?;
    let links = service.store.links().await?;
    let line = |known: KnownPlatform| {
        let mut rosters: Vec<HomeworkLink> = Vec::new();
        let own = |link: &&HomeworkLink| link.platform_id == known.platform.id && link.memberships.is_some();
        for link in links.iter().filter(own) {
            if !rosters.iter().any(|known| known.context == link.context) {
                rosters.push(link.clone());
            }
        }
        PlatformLine { known, rosters }
    };
    let platforms = known::platforms(service, teacher).await?.into_iter().map(line).collect();
    let here = here(service, &frame).await?;
    shown(
        PlatformsPage {
            place: Tab::Platforms,
            csrf: teacher.csrf(service),
            platforms,
            may_change: teacher.role() == StaffRole::Administrator,
            link: said.link,
            problem: said.problem,
            notice: said.notice,
            here,
            own: lti::address(service).map_err(|problem| plainly(&problem, &frame)),
            typed: said.typed,
            frame,
        }
        .render(),
    )
}

fn plainly(problem: &Problem, frame: &PageFrame) -> String {
    problem.detail.get(frame.language).replace('`', "")
}

/// `GET /teacher/platforms`.
pub(in crate::service::pages) async fn page(
    Shared(service): Shared<Service>,
    LecturerPage(teacher): LecturerPage,
    frame: PageFrame,
) -> Result<Response, Problem> {
    view(&service, frame, &teacher, PlatformsNotice::default()).await
}

/// `POST /teacher/platforms`.
pub(in crate::service::pages) async fn change(
    Shared(service): Shared<Service>,
    LecturerPage(teacher): LecturerPage,
    frame: PageFrame,
    Form(wish): Form<PlatformForm>,
) -> Result<Response, Problem> {
    teacher.check_csrf(&service, &wish.csrf)?;
    teacher.check_course()?;
    let parts = [&wish.wish, &wish.issuer, &wish.deployment, &wish.context, &wish.course];
    let detail = Detail::of(parts.map(|part| part.trim()).join(" ").trim().to_owned());
    match carried_out(&service, &teacher, &wish, &frame).await {
        Ok(Some(said)) => Ok(detail.on(view(&service, frame, &teacher, said).await?)),
        Ok(None) => Ok(detail.on(Redirect::to("/teacher/platforms").into_response())),
        Err(problem) if problem.status.is_client_error() && problem.kind != "role" => {
            let said = Some(plainly(&problem, &frame));
            let page = view(
                &service,
                frame,
                &teacher,
                PlatformsNotice { problem: said, typed: wish, ..PlatformsNotice::default() },
            )
            .await?;
            Ok(refused(page, problem.status))
        }
        Err(problem) => Err(problem),
    }
}

/// What is said of a roster that was fetched.
fn said_of(fetched: FetchedRoster, frame: &PageFrame) -> String {
    let FetchedRoster { students, on_roster } = fetched;
    let counted = |count: usize| if count == 1 { "1 student".to_owned() } else { format!("{count} students") };
    match frame.tag() {
        "ja" => format!("学習プラットフォームの学生は {students} 人です。名簿は {on_roster} 人になりました。"),
        _ => {
            let verb = if on_roster == 1 { "is" } else { "are" };
            format!("The platform lists {}. {} {verb} on the roster now.", counted(students), counted(on_roster))
        }
    }
}

async fn carried_out(
    service: &Service,
    teacher: &Teacher,
    wish: &PlatformForm,
    frame: &PageFrame,
) -> Result<Option<PlatformsNotice>, Problem> {
    let platform = async || service.store.platform(&wish.platform).await?.ok_or_else(Problem::not_found);
    if wish.wish == "roster" {
        let platform = platform().await?;
        let links = service.store.links().await?;
        let link = links.into_iter().find(|link| link.platform_id == platform.id && link.link_id == wish.link);
        let fetched = memberships::import(service, &platform, &link.ok_or_else(Problem::not_found)?).await?;
        return Ok(Some(PlatformsNotice { notice: Some(said_of(fetched, frame)), ..PlatformsNotice::default() }));
    }
    teacher.check_role(StaffRole::Administrator)?;
    // What is registered with the first course is changed there.
    if contexts::is_elsewheres(service, &wish.platform).await? {
        return Err(Problem::not_found());
    }
    match wish.wish.as_str() {
        "link" => {
            let link = registration::new_link(service).await?;
            return Ok(Some(PlatformsNotice { link: Some(link), ..PlatformsNotice::default() }));
        }
        "approve" => service.store.note_deployment(&platform().await?.id, &wish.deployment, true).await?,
        "off" => contexts::set_active(service, &platform().await?, false).await?,
        "on" => contexts::set_active(service, &platform().await?, true).await?,
        "connect" => {
            let course = Some(wish.course.as_str()).filter(|course| *course != NO_COURSE);
            contexts::connect(service, &platform().await?, &wish.context, course).await?;
        }
        "add" => {
            let text = |text: &String| text.trim().to_owned();
            let platform = Platform {
                id: new_id(),
                issuer: text(&wish.issuer),
                client_id: text(&wish.client_id),
                name: text(&wish.name),
                auth_url: text(&wish.auth_url),
                token_url: text(&wish.token_url),
                keys_url: text(&wish.keys_url),
                token_audience: registration::audience(&wish.token_audience),
                is_active: 1,
            };
            registration::keep(service, platform, Some(wish.deployment.trim())).await?;
        }
        _ => return Err(Problem::unprocessable("There is no such change.", "その操作はありません。")),
    }
    Ok(None)
}
