//! Several mistakes, each in an addend of its own: what each of them changes adds up to all that is wrong.

use super::candidates::Mend;
use super::search::Search;
use super::{Stage, What};
use crate::diagnose::columns::is_colour;
use glam::DVec3;

/// So many places with what may stand there are put together.
const MOST: usize = 4_000;

/// A change of a colour of less than this is none.
const LEAST: f64 = 1e-6;

impl Search<'_, '_> {
    /// Two places that mend everything together, each the first that does so beside the other.
    pub fn several(&mut self) -> Vec<Mend> {
        let Some((first, second)) = self.pair() else { return Vec::new() };
        let second = self.first_beside(&first).unwrap_or(second);
        let first = self.first_beside(&second).unwrap_or(first);
        vec![first, second]
    }

    fn pair(&mut self) -> Option<(Mend, Mend)> {
        let mut tried: Vec<(Mend, Vec<DVec3>)> = Vec::new();
        for stage in [Stage::Vertex, Stage::Fragment] {
            for suspect in
                self.suspects(stage).into_iter().filter(|one| self.is_students(stage, one)).collect::<Vec<_>>()
            {
                let all = self.candidates(stage, &suspect);
                let all: Vec<Mend> = all.into_iter().filter(|mend| self.is_term(mend)).collect();
                for mend in all {
                    if tried.len() >= MOST {
                        break;
                    }
                    if let Some(moved) = self.moved(&mend) {
                        tried.push((mend, moved));
                    }
                }
            }
        }
        let count = tried.first()?.1.len();
        let missing: Vec<DVec3> = (0..count).map(|at| self.wanted.colours[at] - self.own.colours[at]).collect();
        for (number, (first, of_first)) in tried.iter().enumerate() {
            for (second, of_second) in &tried[number + 1..] {
                let is_all = |at: usize| is_colour(missing[at], of_first[at] + of_second[at]);
                if first.suspect.site != second.suspect.site
                    && (0..count).all(is_all)
                    && self.mend_together(first, second)
                {
                    return Some((first.clone(), second.clone()));
                }
            }
        }
        None
    }

    /// Whether a place computes something that the right answer has a name for: two of all others mend too much by chance.
    fn is_term(&self, mend: &Mend) -> bool {
        let is_named = mend.quantity.is_some_and(|number| !self.quantities.all[number].names.is_empty());
        let is_computed = !matches!(self.site(mend.stage, &mend.suspect).what, What::Read(_) | What::Literal);
        is_named && is_computed && !mend.suspect.is_right && self.is_to_blame(mend)
    }

    /// By how much the colours move when this is put in its place; `None` where they do not.
    fn moved(&mut self, mend: &Mend) -> Option<Vec<DVec3>> {
        let seen = self.seen_with(mend)?;
        let moved: Vec<DVec3> = seen.iter().zip(&self.own.colours).map(|(seen, own)| *seen - *own).collect();
        let is_moved = moved.iter().any(|moved| moved.abs().max_element() > LEAST);
        (is_moved && moved.iter().all(|moved| moved.is_finite())).then_some(moved)
    }

    fn mend_together(&mut self, first: &Mend, second: &Mend) -> bool {
        self.beside(first, |search| search.mends(second))
    }

    fn beside<T>(&mut self, other: &Mend, work: impl FnOnce(&mut Self) -> T) -> T {
        self.base[other.stage as usize].push(other.change());
        let result = work(self);
        self.base[other.stage as usize].pop();
        result
    }

    fn first_beside(&mut self, other: &Mend) -> Option<Mend> {
        self.beside(other, |search| search.mend_but(Some(other.suspect.site)))
    }
}
