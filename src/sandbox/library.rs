//! What the parent knows of the assignments that its workers read: their right pictures, which one worker computes for all.

use super::Settings;
use crate::expected::{Pack, cache};
use reference::Assignment;
use std::collections::HashMap;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};

/// The right pictures of assignments, by the assignment's digest.
#[derive(Debug, Default)]
pub(super) struct PictureLibrary {
    pictures: Mutex<HashMap<String, PictureState>>,
    changed: Condvar,
}

#[derive(Clone, Debug)]
enum PictureState {
    /// A worker is at it, and the others wait.
    InTheMaking,
    Known(Pack),
    /// Computing them is cheaper than handing them on.
    Cheap,
}

/// What a worker that reads an assignment is to do about its pictures.
#[derive(Debug)]
pub(super) enum Turn<'a> {
    /// Take these.
    Given(Pack),
    /// Compute them for itself.
    Own,
    /// Compute them for all, unless that is quickly done.
    ForAll(Maker<'a>),
}

/// The duty to compute the pictures, which another worker gets where it is not done.
#[derive(Debug)]
pub(super) struct Maker<'a> {
    library: &'a PictureLibrary,
    digest: String,
    outcome: Option<PictureState>,
}

impl PictureLibrary {
    /// What the next worker is to do. Waits while another one computes the pictures.
    pub fn turn(&self, assignment: &Assignment, settings: &Settings) -> Turn<'_> {
        let digest = assignment.digest.clone();
        let mut pictures = self.lock();
        loop {
            match pictures.get(&digest) {
                Some(PictureState::Known(pack)) => return Turn::Given(pack.clone()),
                Some(PictureState::Cheap) => return Turn::Own,
                Some(PictureState::InTheMaking) => {
                    pictures = self.changed.wait(pictures).unwrap_or_else(PoisonError::into_inner);
                }
                None => break,
            }
        }
        pictures.insert(digest.clone(), PictureState::InTheMaking);
        drop(pictures);
        let mut maker = Maker { library: self, digest, outcome: None };
        match settings.cache.as_deref().and_then(|folder| cache::read(folder, assignment)) {
            Some(pack) => {
                maker.outcome = Some(PictureState::Known(pack.clone()));
                Turn::Given(pack)
            }
            None => Turn::ForAll(maker),
        }
    }

    /// Whether a worker that has met a student's file may read the assignment: one that computes for all may not have.
    pub fn is_settled(&self, assignment: &Assignment) -> bool {
        matches!(self.lock().get(&assignment.digest), Some(PictureState::Known(_) | PictureState::Cheap))
    }

    fn lock(&self) -> MutexGuard<'_, HashMap<String, PictureState>> {
        self.pictures.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Maker<'_> {
    /// Hands the pictures on, and keeps them on disk; none where they were quickly computed.
    pub fn done(mut self, assignment: &Assignment, pack: Option<Pack>, settings: &Settings) {
        if let (Some(pack), Some(folder)) = (&pack, &settings.cache) {
            // Where it cannot be written, the next process computes them again.
            let _ = cache::write(folder, assignment, pack);
        }
        self.outcome = Some(pack.map_or(PictureState::Cheap, PictureState::Known));
    }
}

impl Drop for Maker<'_> {
    fn drop(&mut self) {
        let mut pictures = self.library.lock();
        match self.outcome.take() {
            Some(outcome) => pictures.insert(std::mem::take(&mut self.digest), outcome),
            None => pictures.remove(&self.digest),
        };
        drop(pictures);
        self.library.changed.notify_all();
    }
}
