//! Which homeworks a course has, and in which order.

use super::super::blocking::to_its_end;
use super::super::errors::Problem;
use super::super::store::{CoursePlace, Result as StoreResult, Store};
use super::super::{Service, folders, grading};
use crate::sandbox::MOST_ASSIGNMENTS;
use reference::Assignment;
use std::collections::HashMap;
use std::sync::{Arc, PoisonError};

/// The order of a course, and what it chose, as this process knows it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct CoursePlan {
    /// Of each homework the place in the order, and whether it was chosen.
    places: HashMap<String, (usize, bool)>,
}

impl CoursePlan {
    /// As the course has it.
    pub(in crate::service) async fn read(store: &Store) -> StoreResult<Self> {
        let places = store.places().await?.into_iter().enumerate();
        let place = |(index, place): (usize, CoursePlace)| {
            let index = if place.position.is_some() { index } else { usize::MAX };
            (place.id, (index, place.is_chosen != 0))
        };
        Ok(Self { places: places.map(place).collect() })
    }

    /// The place of a homework in the order.
    pub(in crate::service) fn place(&self, id: &str) -> usize {
        self.places.get(id).map_or(usize::MAX, |(index, _)| *index)
    }

    /// Those of the named homeworks that the course has: all of them in the first course.
    pub(in crate::service) fn chosen(&self, named: &[Arc<Assignment>], is_first: bool) -> Vec<Arc<Assignment>> {
        let is_chosen =
            |one: &&Arc<Assignment>| is_first || self.places.get(&one.id).is_some_and(|(_, chosen)| *chosen);
        named.iter().filter(is_chosen).cloned().collect()
    }
}

/// Sets what the course says of homeworks, and serves what it has then; other processes learn of it as well.
///
/// What is chosen anew is drawn before anything changes: that takes seconds, in which a request may be given up. From then on all of
/// it is done, so that the tables never say something else than what is served.
pub async fn set_places(service: &Service, places: Vec<CoursePlace>) -> Result<(), Problem> {
    let is_new = |id: &str| places.iter().any(|place| place.id == id && place.is_chosen != 0);
    for assignment in service.offered().iter().filter(|one| is_new(&one.id) && service.homework(&one.id).is_none()) {
        // A page that cannot be drawn says so itself.
        let _ = folders::drawn(assignment).await;
    }
    let service = service.clone();
    to_its_end(async move {
        service.store.set_places(&places).await?;
        reread(&service).await?;
        grading::folders_changed(&service).await;
        grading::files_wait(&service).await;
        Ok(())
    })
    .await
}

/// Serves what the course has now, in its order.
pub async fn reread(service: &Service) -> StoreResult<()> {
    let _turn = service.served_turn.acquire().await;
    let plan = CoursePlan::read(&service.store).await?;
    *service.plan.write().unwrap_or_else(PoisonError::into_inner) = plan;
    folders::follow(service).await
}

/// What a homework counts in its course: what a lecturer set, or as many points as its rubric has.
pub fn points(places: &[CoursePlace], assignment: &Assignment) -> f64 {
    let own = places.iter().find(|place| place.id == assignment.id).and_then(|place| place.points);
    own.unwrap_or_else(|| assignment.max_score())
}

/// Gives the course these homeworks, in this order. Another course than the first leaves out what it chose, and chooses what is
/// offered; a homework that has a folder here stays until that is taken out of service.
pub async fn arrange(service: &Service, ids: &[String]) -> Result<(), Problem> {
    let is_offered = |id: &String| service.is_beside() && service.offered().iter().any(|one| one.id == *id);
    let repeated = ids.iter().enumerate().find(|(index, id)| ids[..*index].contains(id)).map(|(_, id)| id);
    let unknown = ids.iter().find(|id| service.homework(id).is_none() && !is_offered(id));
    if let Some(id) = repeated.or(unknown) {
        return Err(Problem::unprocessable(
            format!("`{id}` is no homework that this course can have, or is named twice."),
            format!("「{id}」はこの授業で選べる課題ではないか、2 回指定されています。"),
        ));
    }
    if ids.len() > MOST_ASSIGNMENTS {
        return Err(too_many());
    }
    let folders: Vec<String> = service.store.published().await?.into_iter().map(|(id, _)| id).collect();
    let must_stay = |id: &&String| !ids.contains(*id) && (!service.is_beside() || folders.contains(*id));
    if let Some(id) = service.ids().iter().find(must_stay) {
        return Err(Problem::unprocessable(
            format!(
                "`{id}` is served and must be in the list; what has a folder here is taken out of service with it."
            ),
            format!(
                "「{id}」は公開中のため、一覧に含めてください。フォルダのある課題は、フォルダの公開停止で外せます。"
            ),
        ));
    }
    for id in ids {
        service.store.assignment(id).await?;
    }
    // All that another course chooses is set, by what the tables say of it: what is served may be less, or more.
    let is_choice = |id: &String| service.is_beside() && !folders.contains(id);
    let mut places = service.store.places().await?;
    places.retain(|place| ids.contains(&place.id) || is_choice(&place.id));
    for place in &mut places {
        let index = ids.iter().position(|id| *id == place.id);
        place.position = index.and_then(|index| i64::try_from(index).ok());
        if is_choice(&place.id) {
            place.is_chosen = i64::from(index.is_some());
        }
    }
    set_places(service, places).await
}

/// The refusal of more homeworks than workers read.
pub fn too_many() -> Problem {
    Problem::unprocessable(
        format!("A course has at most {MOST_ASSIGNMENTS} homeworks."),
        format!("1 つの授業の課題は {MOST_ASSIGNMENTS} 個までです。"),
    )
}
