//! Whether a statement computes what it should, and what that is.

use super::variable;
use crate::diagnose::columns::{ScalarColumns, fits as fits_shape, is_colour, is_number, is_same, shaped};
use crate::diagnose::inside::Stage;
use crate::diagnose::inside::candidates::Mend;
use crate::diagnose::inside::search::Search;
use crate::diagnose::inside::walk::Suspect;
use crate::diagnose::inside::words::meaning;
use crate::language::Text;
use glam::DVec3;
use reference::interpreter::Scalar;

/// So many values are put in the place of others to see whether all becomes right, each at three places or at all.
pub(super) const MOST_TRIED: usize = 400;

/// A value in the place of a statement's makes so many places right at least, where it does not make all right: one may be by chance.
const LEAST_GAINED: usize = 2;

/// A right answer's value in the place of a statement's, one for each time that the statement runs.
pub(super) struct Counterpart {
    pub values: Vec<ScalarColumns>,
    pub means: Option<Text>,
}

/// What a statement may compute.
struct Namesake {
    /// The quantity by its place.
    number: usize,
    /// Whether the right answer calls it the same.
    is_own: bool,
    /// Whether the statement computes it.
    is_equal: bool,
}

/// What has been tried.
pub(super) struct Trial {
    /// How often may be tried again.
    pub left: usize,
    /// The colours with what has been found.
    pub before: Vec<DVec3>,
}

/// What is known of a statement.
pub(super) enum StatementStanding {
    Unknown,
    /// It computes something that a right answer computes.
    Right(Option<Text>),
    Wrong(Counterpart),
}

impl Search<'_, '_> {
    /// What is known of a statement. `is_said`: whether the report says that the mistake is on its line.
    pub(super) fn standing(
        &mut self,
        stage: Stage,
        site: usize,
        events: &[usize],
        is_said: bool,
        trial: &mut Trial,
    ) -> StatementStanding {
        let own = &self.theirs.stage(stage).sites()[site];
        let name = variable(own).0.to_owned();
        if own.kind.scalar() != Some(Scalar::Float) {
            return StatementStanding::Unknown;
        }
        let named = self.namesakes(stage, site, events, &name, is_said);
        let equal = named.iter().find(|one| one.is_equal).map(|one| one.number);
        if let Some(number) = equal.filter(|_| !is_said) {
            return StatementStanding::Right(self.means(number));
        }
        let unnamed = self.unnamed(stage, events);
        for one in named.iter().filter(|one| !one.is_equal) {
            // What is right by itself lacks a last step at most.
            let is_step = |right: &usize| {
                self.quantities.finishes(&self.quantities.all[one.number], &self.quantities.all[*right])
            };
            if !is_said && !one.is_own && unnamed.as_ref().is_some_and(|right| !is_step(right)) {
                continue;
            }
            let Some(rest) = trial.left.checked_sub(1) else { break };
            trial.left = rest;
            let mend = self.in_place(stage, site, events, one.number);
            if self.is_start(&mend) && !is_said {
                break;
            }
            let is_whole = self.mends(&mend);
            if is_whole || self.betters(&mend, one.is_own, trial) {
                if !is_whole {
                    // What is wrong beside it shows where this is right.
                    self.base[stage as usize].push(mend.change());
                }
                return StatementStanding::Wrong(Counterpart { values: mend.values, means: self.means(one.number) });
            }
        }
        match equal {
            Some(number) => StatementStanding::Right(self.means(number)),
            None if unnamed.is_some() => StatementStanding::Right(None),
            None => StatementStanding::Unknown,
        }
    }

    /// A quantity that a statement computes each time, by its place.
    fn unnamed(&self, stage: Stage, events: &[usize]) -> Option<usize> {
        let trace = self.trace(stage)?;
        let known = |event: &usize| self.quantities.equal_to(stage, &trace.events[*event]);
        let last = known(events.last()?)?;
        let is_known = events.iter().all(|event| known(event).is_some());
        self.quantities.all.iter().position(|one| is_known && std::ptr::eq(one, last))
    }

    /// The quantities that fit a statement, those of its own name first, then those with another; the others where `all` count.
    fn namesakes(&self, stage: Stage, site: usize, events: &[usize], name: &str, all: bool) -> Vec<Namesake> {
        let Some(trace) = self.trace(stage) else { return Vec::new() };
        let width = self.theirs.stage(stage).sites()[site].kind.slots().unwrap_or(0);
        let lanes = trace.events[events[0]].lanes.len();
        let mut found = Vec::new();
        for (number, quantity) in self.quantities.all.iter().enumerate() {
            let turns = &quantity.turns;
            let counts = all && !quantity.is_partial || !quantity.names.is_empty();
            let fits = quantity.stage == stage && !quantity.is_bool && counts;
            let fits = fits && fits_shape(width, turns[0].len()) && turns[0][0].len() == lanes;
            if !fits || turns.len() != 1 && turns.len() != events.len() {
                continue;
            }
            let turn = |at: usize| if turns.len() == 1 { &turns[0] } else { &turns[at] };
            let is_equal = events.iter().enumerate().all(|(at, event)| is_same(&trace.events[*event], turn(at)));
            let is_own = quantity.names.iter().any(|own| own == name);
            // What is the same everywhere is equal to many things by chance.
            let is_by_chance = is_equal && quantity.is_constant && !is_own && !is_telling(&turns[0]);
            if !is_by_chance {
                found.push(Namesake { number, is_own, is_equal });
            }
        }
        let is_unnamed = |one: &Namesake| self.quantities.all[one.number].names.is_empty();
        found.sort_by_key(|one| (!one.is_own, is_unnamed(one), one.number));
        found
    }

    /// A quantity in the place of a statement.
    fn in_place(&self, stage: Stage, site: usize, events: &[usize], number: usize) -> Mend {
        let turns = &self.quantities.all[number].turns;
        let trace = self.trace(stage).map_or(&[][..], |trace| &trace.events);
        let turn = |at: usize| if turns.len() == 1 { &turns[0] } else { &turns[at] };
        let values = events.iter().enumerate().map(|(at, event)| shaped(&trace[*event], turn(at))).collect();
        let suspect = Suspect { site, events: events.to_vec(), is_right: false, gives_right: false };
        Mend { stage, suspect, quantity: Some(number), values }
    }

    /// Whether more becomes right by this and nothing wrong, beside another mistake: it has the name of what it should be, or is that
    /// wherever all is right, or nothing is right anywhere before.
    fn betters(&mut self, mend: &Mend, is_own: bool, trial: &mut Trial) -> bool {
        let wanted = self.wanted;
        let is_right = |seen: &[DVec3], at: usize| is_colour(wanted.colours[at], seen[at]);
        let right: Vec<usize> = (0..self.count).filter(|at| is_right(&trial.before, *at)).collect();
        if !is_own && !right.is_empty() && !right.iter().all(|at| self.is_there(mend, *at)) {
            return false;
        }
        let Some(seen) = self.seen_everywhere(mend) else { return false };
        let gained = (0..self.count).filter(|at| !right.contains(at) && is_right(&seen, *at)).count();
        let is_better = right.iter().all(|at| is_right(&seen, *at)) && gained >= LEAST_GAINED;
        if is_better {
            trial.before = seen;
        }
        is_better
    }

    /// Whether a statement computes at a place what would be put in its place.
    fn is_there(&self, mend: &Mend, at: usize) -> bool {
        let Some(trace) = self.trace(mend.stage) else { return false };
        mend.suspect.events.iter().zip(&mend.values).all(|(event, values)| {
            let event = &trace.events[*event];
            let lane = self.lane(mend.stage, event, at);
            event.values.iter().zip(values).all(|(own, right)| is_number(own[lane], right[lane]))
        })
    }

    fn means(&self, number: usize) -> Option<Text> {
        self.quantities.all[number].names.iter().find_map(|name| meaning(self.assignment, name))
    }
}

/// Whether a value that is the same everywhere is too many numbers to be equal to another by chance.
fn is_telling(columns: &ScalarColumns) -> bool {
    columns.len() > 2 && columns.iter().any(|column| !is_number(column[0], columns[0][0]))
}
