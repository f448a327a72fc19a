//! The homeworks that a course serves, and those from which it chooses.

use super::{Service, State};
use crate::service::errors::Problem;
use crate::service::gallery::RightPictures;
use reference::Assignment;
use std::sync::atomic::Ordering;
use std::sync::{Arc, PoisonError};

impl Service {
    /// Every homework that is served, in the order of the course; those that have no place in it yet come last, those of the
    /// command line before the others.
    pub fn homeworks(&self) -> impl Iterator<Item = State> + '_ {
        let mut homeworks = self.homeworks.read().unwrap_or_else(PoisonError::into_inner).clone();
        let plan = self.plan.read().unwrap_or_else(PoisonError::into_inner);
        homeworks.sort_by_key(|(assignment, _)| plan.place(&assignment.id));
        drop(plan);
        homeworks.into_iter().map(|(assignment, right)| State {
            service: self.clone(),
            assignment,
            right,
            folder: None,
        })
    }

    /// The ids of the homeworks that are served.
    pub fn ids(&self) -> Vec<String> {
        self.homeworks().map(|state| state.assignment.id.clone()).collect()
    }

    /// The homework that is served, where it is one.
    pub fn only(&self) -> Option<State> {
        let mut homeworks = self.homeworks();
        homeworks.next().filter(|_| homeworks.next().is_none())
    }

    /// Whether the homeworks have a list: several of the first course, and all of another one, whose addresses then stay what
    /// they are.
    pub fn has_several(&self) -> bool {
        self.is_beside() || self.homeworks().count() > 1
    }

    /// The homework in an uploaded folder, to be looked at.
    pub(in crate::service) fn unserved(&self, assignment: Arc<Assignment>, folder: &str) -> State {
        let (assignment, right) = with_pictures(assignment);
        State { service: self.clone(), assignment, right, folder: Some(folder.to_owned()) }
    }

    /// How often the homeworks have changed that are served.
    pub fn generation(&self) -> u64 {
        self.generation.load(Ordering::Acquire)
    }

    /// Serves a homework from now on, in the place of the one with the same id.
    pub(in crate::service) fn serve(&self, assignment: Arc<Assignment>) {
        let mut homeworks = self.homeworks.write().unwrap_or_else(PoisonError::into_inner);
        let place = homeworks.iter().position(|(known, _)| known.id == assignment.id);
        match place {
            Some(place) => homeworks[place] = with_pictures(assignment),
            None => homeworks.push(with_pictures(assignment)),
        }
        drop(homeworks);
        self.generation.fetch_add(1, Ordering::Release);
    }

    /// Serves the homework with this id no more, or as the command line names it.
    pub(in crate::service) fn withdraw(&self, id: &str) {
        if let Some(named) = self.named_as(id) {
            return self.serve(named);
        }
        self.homeworks.write().unwrap_or_else(PoisonError::into_inner).retain(|(known, _)| known.id != id);
        self.generation.fetch_add(1, Ordering::Release);
    }

    /// The homeworks of the course that need no folder: those that the command line names, or that another course chose.
    pub(in crate::service) fn named_ones(&self) -> Vec<Arc<Assignment>> {
        let plan = self.plan.read().unwrap_or_else(PoisonError::into_inner);
        plan.chosen(&self.named, !self.is_beside())
    }

    /// That one of them which has this id.
    pub(in crate::service) fn named_as(&self, id: &str) -> Option<Arc<Assignment>> {
        self.named_ones().into_iter().find(|known| known.id == id)
    }

    /// The homeworks from which another course chooses.
    pub(in crate::service) fn offered(&self) -> &[Arc<Assignment>] {
        &self.named
    }

    /// The homework with this id.
    pub fn homework(&self, id: &str) -> Option<State> {
        self.homeworks().find(|state| state.assignment.id == id)
    }

    /// The homework with this id, of which something is stored; a problem where it is not served any more.
    pub fn homework_of(&self, id: &str) -> Result<State, Problem> {
        self.homework(id).ok_or_else(|| Problem::not_served(id, &self.ids()))
    }

    /// The homework that a request names; without a name the only one.
    pub fn named(&self, id: Option<&str>) -> Result<State, Problem> {
        match (id, self.only()) {
            (None, Some(only)) => Ok(only),
            (Some(id), Some(only)) => Some(only).filter(|only| only.assignment.id == id).ok_or_else(Problem::not_found),
            (Some(id), None) => self.homework_of(id),
            (None, None) => Err(Problem::which_homework(&self.ids())),
        }
    }
}

/// A homework with what a right answer draws.
pub(super) fn with_pictures(assignment: Arc<Assignment>) -> (Arc<Assignment>, Arc<RightPictures>) {
    let right = Arc::new(RightPictures::new(Arc::clone(&assignment)));
    (assignment, right)
}
