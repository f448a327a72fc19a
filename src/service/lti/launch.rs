//! A launch: the platform sends the browser back with its word on who that is.

use super::super::identity::{Jar, Visitor, become_student, end_session, has_launch, open_for, token_hash};
use super::super::pages::{PageFrame, launch_lost, shown_choice};
use super::super::store::{HomeworkLink, Platform, Proof, StudentRecord};
use super::super::{Service, State};
use super::claims::{Claims, DEEP_LINKING, RESOURCE_LINK};
use super::people::{Described, PlatformStudent, staff, student, teaches_no_more};
use super::{contexts, deep_linking, number, refused};
use crate::service::errors::Problem;
use crate::service::proxied::ProxiedName;
use axum::extract::State as Shared;
use axum::http::HeaderMap;
use axum::response::{IntoResponse, Redirect, Response};
use axum::{Extension, Form};
use serde::Deserialize;
use serde_json::Value;

/// The form that a platform lets the browser send.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub struct LaunchForm {
    id_token: String,
    state: String,
    error: String,
    error_description: String,
}

/// The claim of a link that says which homework it is for; a platform's own link may have it as well.
pub(super) const HOMEWORK: &str = "assignment";

/// `POST /lti/launch`.
pub async fn launch(
    Shared(service): Shared<Service>,
    headers: HeaderMap,
    frame: PageFrame,
    proxied: Option<Extension<ProxiedName>>,
    Form(answer): Form<LaunchForm>,
) -> Result<Response, Problem> {
    if !answer.error.is_empty() {
        let said: String = format!("{} {}", answer.error, answer.error_description).chars().take(300).collect();
        return Err(refused(
            format!("The learning platform does not let you in: {said}"),
            format!("学習プラットフォームで認証できませんでした: {said}"),
        ));
    }
    let begun = service.store.take_launch(&token_hash(&answer.state), service.clock.now()).await?;
    let begun = begun.ok_or_else(|| {
        refused(
            "This launch has been used, or took longer than ten minutes. Go back and open the homework again.",
            "この起動はすでに使用されたか、10 分を過ぎています。戻って課題を開き直してください。",
        )
    })?;
    if !has_launch(&service, &headers, &answer.state) {
        return launch_lost(frame, &begun.begun_by);
    }
    let gone = || refused("The learning platform is not known any more.", "学習プラットフォームの登録がありません。");
    let platform = service.store.platform(&begun.platform_id).await?.filter(|found| found.is_active == 1);
    let platform = platform.ok_or_else(gone)?;
    let claims = Claims::read(&service, &platform, &answer.id_token).await?;
    if claims.nonce.as_deref() != Some(begun.nonce.as_str()) {
        return Err(refused(
            "The learning platform's message is not the answer to this launch (nonce). Open the homework again.",
            "学習プラットフォームからの情報がこの起動に対するものではありません (nonce)。課題を開き直してください。",
        ));
    }
    check_deployment(&service, &platform, claims.deployment_id.as_deref().unwrap_or_default()).await?;
    let course = contexts::course_of(&service, &platform, &claims).await?;
    match claims.message_type.as_deref() {
        Some(RESOURCE_LINK) => {
            let said = proxied.map(|Extension(said)| said);
            open(&course, frame, &platform, &claims, (&headers, said)).await
        }
        Some(DEEP_LINKING) => {
            let choice = deep_linking::offer(&course, &platform, &claims, &frame).await?;
            shown_choice(frame, choice)
        }
        _ => Err(refused(
            "This kind of LTI message is not known here.",
            "この種類の LTI メッセージには対応していません。",
        )),
    }
}

/// Lets launches of approved deployments pass; another one is noted for an administrator to approve.
async fn check_deployment(service: &Service, platform: &Platform, id: &str) -> Result<(), Problem> {
    let deployments = service.store.deployments().await?;
    let known = deployments.iter().find(|found| found.platform_id == platform.id && found.deployment_id == id);
    if known.is_some_and(|found| found.is_approved == 1) {
        return Ok(());
    }
    if known.is_none() && !id.is_empty() && id.len() <= 255 {
        service.store.note_deployment(&platform.id, id, false).await?;
    }
    let id: String = id.chars().filter(|c| !c.is_control()).take(80).collect();
    Err(refused(
        format!(
            "The deployment `{id}` of {} is not approved here. An administrator approves it under Learning platforms.",
            platform.name
        ),
        format!(
            "{} のデプロイメント「{id}」は承認されていません。管理者が「学習プラットフォーム」で承認してください。",
            platform.name
        ),
    ))
}

/// What the claims say of the person.
fn described(claims: &Claims) -> Result<Described, Problem> {
    let subject = claims.sub.clone().filter(|sub| !sub.is_empty() && sub.len() <= 255).ok_or_else(|| {
        refused(
            "The learning platform does not say who you are. Its administrator lets it share the user's id with this tool.",
            "学習プラットフォームから利用者の情報が送られていません。プラットフォームの管理者に設定を依頼してください。",
        )
    })?;
    let numbers = [
        claims.lis.as_ref().and_then(|lis| lis.person_sourcedid.clone()),
        claims.ext.as_ref().and_then(|ext| ext.user_username.clone()),
    ];
    let numbers = numbers.into_iter().flatten().filter(|number| !number.is_empty()).collect();
    Ok(Described { subject, name: claims.full_name(), numbers })
}

/// Opens the homework for a student, or its class for who teaches.
async fn open(
    service: &Service,
    frame: PageFrame,
    platform: &Platform,
    claims: &Claims,
    (headers, said): (&HeaderMap, Option<ProxiedName>),
) -> Result<Response, Problem> {
    let link =
        claims.resource_link.as_ref().map(|link| link.id.clone()).filter(|id| !id.is_empty()).ok_or_else(|| {
            refused("The launch is of no link (resource_link).", "起動元のリンク (resource_link) が示されていません。")
        })?;
    let who = described(claims)?;
    // A learner may be somebody who teaches and looks at the course as a student does: platforms do not tell.
    if claims.staff_role().is_none() && !claims.is_learner() {
        teaches_no_more(service, platform, &who.subject).await?;
        return Err(looks_on());
    }
    let state = homework(service, platform, claims, &link).await?;
    if let Some(state) = &state {
        note_link(service, platform, claims, (&link, state)).await?;
    }
    if let Some(role) = claims.staff_role() {
        let member = staff(service, platform, &who, role).await?;
        let page =
            state.map_or_else(|| format!("{}/teacher", service.root()), |state| format!("{}/teacher", state.base()));
        return open_for(service, member, &page, (Jar::of(headers), said.as_ref())).await;
    }
    let Some(state) = state else {
        return Err(refused(
            "Your teacher has not yet chosen the homework of this link.",
            "このリンクの課題がまだ選択されていません。担当教員に連絡してください。",
        ));
    };
    match student(service, platform, &who).await? {
        PlatformStudent::Theirs(student) => {
            enter(service, (platform, &link, &who.subject), (&state, student), headers).await
        }
        PlatformStudent::Held(student) => number::asked(service, frame, (platform, &link, &who), (&state, &student)),
    }
}

/// Lets a student in who opened a link of a platform as its person with this id.
pub(super) async fn enter(
    service: &Service,
    (platform, link, subject): (&Platform, &str, &str),
    (state, student): (&State, StudentRecord),
    headers: &HeaderMap,
) -> Result<Response, Problem> {
    let jar = Jar::of(headers);
    service.store.note_member_of_link(&platform.id, link, subject).await?;
    service.store.expect_score(&platform.id, link, subject).await?;
    // Another homework in another tab goes on in the same browser; whoever else sat here is somebody else.
    let here = Visitor::of(service, headers).await?;
    let is_theirs = here.identity.student_id() == Some(student.id.as_str());
    let visitor = if is_theirs { here } else { Visitor::replaced() };
    let visitor = become_student(service, visitor, student, Proof::Platform).await?;
    let mut response = Redirect::to(&state.page()).into_response();
    visitor.set_cookie_in(service, &mut response, jar);
    // Whoever teaches there as well looks at the homework as a student does.
    let known = service.store.platform_person(&platform.id, subject).await?;
    if known.is_none_or(|person| person.staff_id.is_none()) {
        end_session(service, headers, (&mut response, jar)).await?;
    }
    Ok(response)
}

/// The refusal of who is in the platform's course and neither learns nor teaches there, as a mentor or a developer of content: the
/// class and its gradebook are those who learn.
fn looks_on() -> Problem {
    refused(
        "In the learning platform's course you are neither a student nor one of those who teach, so this homework is not opened \
         for you. Whoever teaches that course can give you another role there.",
        "学習プラットフォームのコースで学生・教員・アシスタントのいずれでもないため、課題を開けません。コースの担当教員に役割の変更を依頼してください。",
    )
}

/// The homework that a link is for: what the link itself says, where it leads, what it was before, or the only one.
async fn homework(
    service: &Service,
    platform: &Platform,
    claims: &Claims,
    link: &str,
) -> Result<Option<State>, Problem> {
    let said = claims.custom.as_ref().and_then(|custom| custom.get(HOMEWORK)).and_then(Value::as_str);
    let led = claims.target_link_uri.as_deref().and_then(|address| Some(address.split_once("/a/")?.1));
    let led = led.and_then(|rest| rest.split(['/', '?', '#']).next());
    if let Some(state) = said.or(led).and_then(|id| service.homework(id)) {
        return Ok(Some(state));
    }
    let links = service.store.links().await?;
    let before = links.into_iter().find(|found| found.platform_id == platform.id && found.link_id == link);
    Ok(before.and_then(|link| service.homework(&link.assignment)).or_else(|| service.only()))
}

async fn note_link(
    service: &Service,
    platform: &Platform,
    claims: &Claims,
    (link, state): (&str, &State),
) -> Result<(), Problem> {
    let grades = claims.grades.as_ref().filter(|grades| grades.scope.iter().any(|scope| scope == super::scores::SCOPE));
    let link = HomeworkLink {
        platform_id: platform.id.clone(),
        link_id: link.to_owned(),
        assignment: state.assignment.id.clone(),
        context: claims.context.as_ref().map(|context| context.id.clone()).unwrap_or_default(),
        line_item: grades.and_then(|grades| grades.lineitem.clone()),
        memberships: claims.names.as_ref().and_then(|names| names.context_memberships_url.clone()),
    };
    Ok(service.store.note_link(&link).await?)
}
