//! To which course here a platform's course belongs. A platform lets everybody who teaches anything there make links to this
//! service; so nobody comes in from a course that nobody connected.

use super::super::Service;
use super::super::errors::Problem;
use super::super::store::{Platform, PlatformCourse, Result as StoreResult, Store};
use super::claims::Claims;
use super::refused;

/// Longest title of a platform's course, in characters.
const LONGEST_TITLE: usize = 100;

/// The tables of the course with which a platform is registered: this one, or the first.
pub(super) async fn home<'a>(service: &'a Service, platform_id: &str) -> StoreResult<&'a Store> {
    match &service.first {
        Some(first) if first.platform(platform_id).await?.is_some() => Ok(first),
        _ => Ok(&service.store),
    }
}

/// Whether a platform that a course knows is registered with another one.
pub async fn is_elsewheres(service: &Service, platform_id: &str) -> StoreResult<bool> {
    match &service.first {
        Some(first) => Ok(first.platform(platform_id).await?.is_some()),
        None => Ok(false),
    }
}

/// The course to which a launch leads. The first course of a platform is connected by itself where there is one course only here and nobody
/// uses it yet: whoever comes first may teach anything at the platform, and would be a lecturer of people who are not theirs.
pub(super) async fn course_of(service: &Service, platform: &Platform, claims: &Claims) -> Result<Service, Problem> {
    let (context, title) = claims.context.as_ref().map_or(("", ""), |context| (&*context.id, context.name()));
    let of_platform = async || -> StoreResult<Vec<PlatformCourse>> {
        let all = service.store.platform_courses().await?;
        Ok(all.into_iter().filter(|known| known.platform_id == platform.id).collect())
    };
    let is_first = of_platform().await?.is_empty() && service.everywhere().len() == 1;
    let connects = is_first && service.store.is_unused().await?;
    let title: String = title.chars().filter(|c| !c.is_control()).take(LONGEST_TITLE).collect();
    let noted = PlatformCourse {
        platform_id: platform.id.clone(),
        context: context.to_owned(),
        title: title.clone(),
        course: connects.then(String::new),
    };
    if context.len() <= 255 {
        service.store.note_platform_course(&noted).await?;
    }
    let known = of_platform().await?.into_iter().find(|known| known.context == context);
    let connected = known.and_then(|known| service.course_or_this(known.course.as_deref()?));
    connected.ok_or_else(|| not_connected(service, platform, if title.is_empty() { context } else { &title }))
}

fn not_connected(service: &Service, platform: &Platform, title: &str) -> Problem {
    let title: String = title.chars().take(LONGEST_TITLE).collect();
    let place = super::address(service).map(|own| format!("{own}/teacher/platforms")).unwrap_or_default();
    refused(
        format!(
            "The course “{title}” of {} is not connected with a course here. An administrator of this service connects it under Learning platforms: {place}",
            platform.name
        ),
        format!(
            "{} のコース「{title}」は、このサービスの授業と結び付けられていません。このサービスの管理者が「学習プラットフォーム」で設定してください: {place}",
            platform.name
        ),
    )
}

/// Connects a platform's course with the course of this id; none: with no course any more. What was linked elsewhere before is
/// forgotten there, so that grades come from one course only.
pub async fn connect(service: &Service, platform: &Platform, context: &str, id: Option<&str>) -> Result<(), Problem> {
    let known = service.store.platform_courses().await?;
    let known = known.into_iter().find(|known| known.platform_id == platform.id && known.context == context);
    let before = known.ok_or_else(Problem::not_found)?.course;
    let target = id.map(|id| service.course_or_this(id).ok_or_else(Problem::not_found)).transpose()?;
    if let Some(target) = &target
        && target.root() != service.root()
    {
        target.store.add_platform(platform, service.clock.now()).await?;
        if target.store.platform(&platform.id).await?.is_none() {
            return Err(Problem::unprocessable(
                "That course has registered this platform for itself.",
                "その授業には、このプラットフォームがすでに登録されています。",
            ));
        }
    }
    if before.as_deref() != id
        && let Some(left) = before.and_then(|before| service.course_or_this(&before))
    {
        left.store.forget_links(&platform.id, context).await?;
    }
    Ok(service.store.connect_platform_course(&platform.id, context, id).await?)
}

/// Says whether launches of a platform are taken, in every course that knows it.
pub async fn set_active(service: &Service, platform: &Platform, is_active: bool) -> StoreResult<()> {
    for course in service.everywhere() {
        course.store.set_platform_active(&platform.id, is_active).await?;
    }
    Ok(())
}
