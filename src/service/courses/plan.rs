//! Which homeworks a course has, and in which order.

use super::super::store::{Place, Result as StoreResult, Store};
use super::super::{Service, folders, grading};
use reference::Assignment;
use std::collections::HashMap;
use std::sync::{Arc, PoisonError};

/// The order of a course, and what it chose, as this process knows it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Plan {
    /// Of each homework the place in the order, and whether it was chosen.
    places: HashMap<String, (usize, bool)>,
}

impl Plan {
    /// As the course has it.
    pub(in crate::service) async fn read(store: &Store) -> StoreResult<Self> {
        let places = store.places().await?.into_iter().enumerate();
        let place = |(index, place): (usize, Place)| {
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

/// Serves what the course has now, in its order; other processes learn of it as well.
pub async fn changed(service: &Service) -> StoreResult<()> {
    reread(service).await?;
    grading::folders_changed(service).await;
    grading::files_wait(service).await;
    Ok(())
}

/// Serves what the course has now, in its order.
pub async fn reread(service: &Service) -> StoreResult<()> {
    let plan = Plan::read(&service.store).await?;
    *service.plan.write().unwrap_or_else(PoisonError::into_inner) = plan;
    folders::follow(service).await
}
