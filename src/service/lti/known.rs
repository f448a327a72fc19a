//! The platforms that a course knows, with what is known of each.

use super::super::Service;
use super::super::identity::Teacher;
use super::super::store::{Deployment, Platform, PlatformCourse, Result as StoreResult, StaffRole, Stuck};
use super::contexts::is_elsewheres;
use super::platform::checked;
use std::collections::BTreeSet;

/// A platform.
#[derive(Clone, Debug)]
pub struct KnownPlatform {
    /// The platform.
    pub platform: Platform,
    /// Whether it is registered with the first course, and some of its courses are connected with this one.
    pub is_elsewheres: bool,
    /// Where the tool is deployed in it.
    pub deployments: Vec<Deployment>,
    /// Its courses from which somebody came.
    pub courses: Vec<PlatformCourse>,
    /// How many scores did not arrive, and why. With the first course an administrator sees those of all courses.
    pub stuck: Option<(i64, String)>,
}

/// All of them, the oldest first, as somebody who teaches sees them.
pub async fn platforms(service: &Service, teacher: &Teacher) -> StoreResult<Vec<KnownPlatform>> {
    let (deployments, courses) = (service.store.deployments().await?, service.store.platform_courses().await?);
    let stuck = stuck(service, teacher).await?;
    let mut known = Vec::new();
    for platform in service.store.platforms().await? {
        let of_it = |id: &str| id == platform.id;
        let (waiting, why): (Vec<i64>, Vec<&Option<String>>) =
            stuck.iter().filter(|(id, ..)| of_it(id)).map(|(_, count, why)| (*count, why)).unzip();
        let why = why.into_iter().flatten().next().cloned().unwrap_or_default();
        known.push(KnownPlatform {
            is_elsewheres: is_elsewheres(service, &platform.id).await?,
            deployments: deployments.iter().filter(|one| of_it(&one.platform_id)).cloned().collect(),
            courses: courses.iter().filter(|one| of_it(&one.platform_id)).cloned().collect(),
            stuck: (!waiting.is_empty()).then(|| (waiting.iter().sum(), why)),
            platform,
        });
    }
    Ok(known)
}

/// Where the pages are that may show homeworks in a frame: those of platforms that are switched on. A platform may have its pages
/// elsewhere than where it signs people in (Canvas: school.instructure.com and sso.canvaslms.com), so what its links say counts as well.
pub async fn origins(service: &Service) -> StoreResult<BTreeSet<String>> {
    let (platforms, links) = (service.store.platforms().await?, service.store.links().await?);
    let mut addresses = Vec::new();
    for platform in platforms.iter().filter(|platform| platform.is_active == 1) {
        addresses.extend([&platform.issuer, &platform.auth_url]);
        let own = links.iter().filter(|link| link.platform_id == platform.id);
        addresses.extend(own.flat_map(|link| [&link.line_item, &link.memberships]).flatten());
    }
    Ok(addresses.into_iter().filter_map(|address| origin(address)).collect())
}

/// The origin of an address that a platform may have.
pub fn origin(address: &str) -> Option<String> {
    checked(address).ok().map(|url| url.origin().ascii_serialization())
}

/// The scores that platforms did not take, of each course by itself. A platform is registered once and serves many courses; whoever
/// does not teach in one of these learns nothing of it.
async fn stuck(service: &Service, teacher: &Teacher) -> StoreResult<Vec<Stuck>> {
    if teacher.role() != StaffRole::Administrator {
        return service.store.stuck_scores().await;
    }
    let mut all = Vec::new();
    for course in service.everywhere() {
        all.extend(course.store.stuck_scores().await?);
    }
    Ok(all)
}
