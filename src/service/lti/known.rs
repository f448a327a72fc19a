//! The platforms that a course knows, with what is known of each.

use super::super::Service;
use super::super::store::{Deployment, Platform, PlatformCourse, Result as StoreResult};
use super::contexts::is_elsewheres;

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
    /// How many scores did not arrive, and why.
    pub stuck: Option<(i64, String)>,
}

/// All of them, the oldest first.
pub async fn platforms(service: &Service) -> StoreResult<Vec<KnownPlatform>> {
    let (deployments, courses) = (service.store.deployments().await?, service.store.platform_courses().await?);
    let stuck = service.store.stuck_scores().await?;
    let mut known = Vec::new();
    for platform in service.store.platforms().await? {
        let of_it = |id: &str| id == platform.id;
        let stuck = stuck.iter().find(|(id, ..)| of_it(id));
        known.push(KnownPlatform {
            is_elsewheres: is_elsewheres(service, &platform.id).await?,
            deployments: deployments.iter().filter(|one| of_it(&one.platform_id)).cloned().collect(),
            courses: courses.iter().filter(|one| of_it(&one.platform_id)).cloned().collect(),
            stuck: stuck.map(|(_, count, why)| (*count, why.clone().unwrap_or_default())),
            platform,
        });
    }
    Ok(known)
}
