//! What belongs in a place whose operands are right.

use super::{is_right_there, named_suspects};
use crate::diagnose::columns::{ScalarColumns, fits, is_constant, is_equal, is_number, is_same, shaped};
use crate::diagnose::inside::candidates::Mend;
use crate::diagnose::inside::quantities::{Quantity, leaves};
use crate::diagnose::inside::search::{Search, is_right};
use crate::diagnose::inside::walk::Suspect;
use crate::diagnose::inside::{Stage, What, variable};
use reference::interpreter::Binary;
use reference::interpreter::trace::{Event, Trace};

/// So many values are tried in one place, those that fit best.
const MOST_VALUES: usize = 12;

/// How much a value of the right answer has to do with a place. More is greater.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
struct Kinship {
    /// The right answer calls it by the name that is given the value there.
    is_called: bool,
    /// How much of what is used in the place is on its way, in twelfths.
    on_its_way: usize,
    /// How much of that it is computed from at once, in twelfths of both.
    alike: usize,
    /// Whether it is computed at once from what stands in the place.
    is_next: bool,
}

impl Search<'_, '_> {
    /// What belongs in a place whose operands are right: what the right answer makes of them, or calls by this name. What makes more of
    /// the values further on right comes first. `is_known`: the value is right by itself, so that the next step is missing, or it has the
    /// name of another one.
    pub(super) fn belonging(
        &self,
        stage: Stage,
        suspect: &Suspect,
        is_known: bool,
        tries: &mut usize,
    ) -> Option<(Mend, usize)> {
        let all = self.candidates(stage, suspect).into_iter().chain(self.parts(stage, suspect));
        let all = all.map(|mend| (self.kinship(&mend), mend));
        let is_akin =
            |kinship: &Kinship| kinship.is_called || if is_known { kinship.is_next } else { kinship.on_its_way > 0 };
        let mut akin: Vec<(Kinship, Mend)> = all.filter(|(kinship, _)| is_akin(kinship)).collect();
        akin.sort_by_key(|(kinship, _)| std::cmp::Reverse(*kinship));
        akin.truncate(MOST_VALUES);
        let but = (stage, suspect.site);
        let before = if akin.is_empty() { 0 } else { count_wrong(self, self.traces, but) };
        let mut best: Option<((bool, bool, usize, Kinship), Mend)> = None;
        for (kinship, mend) in akin {
            *tries = tries.checked_sub(1)?;
            let Some(after) = self.wrong_with(&mend, but) else { continue };
            let (is_more, gained) = (after < before || after == 0, before.saturating_sub(after));
            let key = (is_more, kinship.is_called, gained, kinship);
            let is_good = is_more || kinship.is_called && !is_known;
            if is_good && best.as_ref().is_none_or(|(other, _)| *other < key) {
                best = Some((key, mend));
            }
        }
        best.map(|((_, _, gained, _), mend)| (mend, gained))
    }

    /// What may stand in a place that the right answer has as a part only: components of a vector in a row, and what is multiplied out.
    fn parts(&self, stage: Stage, suspect: &Suspect) -> Vec<Mend> {
        let Some(trace) = self.trace(stage) else { return Vec::new() };
        let [event] = suspect.events[..] else { return Vec::new() };
        let event = &trace.events[event];
        let width = event.values.len();
        let is_product = matches!(self.site(stage, suspect).what, What::Binary(Binary::Multiply | Binary::Divide));
        let of = |own: &Quantity| -> Vec<ScalarColumns> {
            match &own.turns[..] {
                [turn] if own.is_multiplied_out && fits(width, turn.len()) && (is_product || !own.is_partial) => {
                    vec![shaped(event, turn)]
                }
                [turn] if !own.is_partial && (width + 1..=4).contains(&turn.len()) => {
                    turn.windows(width).map(<[_]>::to_vec).collect()
                }
                _ => Vec::new(),
            }
        };
        let all = self.quantities.all.iter().enumerate().filter(|(_, own)| own.stage == stage);
        let mut found: Vec<Mend> = Vec::new();
        for (number, part) in all.flat_map(|(number, own)| of(own).into_iter().map(move |part| (number, part))) {
            let is_there = |mend: &Mend| is_equal(&mend.values[0], &part);
            if part[0].len() == event.lanes.len() && !is_same(event, &part) && !found.iter().any(is_there) {
                found.push(Mend { stage, suspect: suspect.clone(), quantity: Some(number), values: vec![part] });
            }
        }
        found
    }

    fn kinship(&self, mend: &Mend) -> Kinship {
        let quantity = mend.quantity.map(|number| &self.quantities.all[number]);
        let event = mend.suspect.events.first();
        let (Some(quantity), Some(trace), Some(&event)) = (quantity, self.trace(mend.stage), event) else {
            return Kinship::default();
        };
        let sites = self.theirs.stage(mend.stage).sites();
        let what = &sites[mend.suspect.site].what;
        let is_called = matches!(what, What::Assign { name, .. } if quantity.names.contains(name));
        let own = leaves(trace, event, &|site| &sites[site].what);
        let right = self.quantities.made_from(quantity);
        let way = self.quantities.way(quantity);
        let among = |all: &[&ScalarColumns]| own.iter().filter(|own| all.iter().any(|one| is_part(own, one))).count();
        let shared = among(&right);
        let all = own.len() + right.len() - shared.min(right.len());
        let value = &trace.events[event].values;
        // What a variable is given has its next step where the variable is read.
        let is_used = matches!(what, What::Read(_))
            || !matches!(what, What::Assign { .. }) && variable(sites, mend.suspect.site).is_none();
        Kinship {
            is_called,
            on_its_way: 12 * among(&way) / own.len().max(1),
            alike: 12 * shared / all.max(1),
            is_next: is_used && !is_constant(value) && right.iter().any(|one| is_part(value, one)),
        }
    }

    /// How many values are wrong with this in its place, but for those of a place; 0 where all is right.
    fn wrong_with(&self, mend: &Mend, but: (Stage, usize)) -> Option<usize> {
        let mut base = self.base.clone();
        base[mend.stage as usize].push(mend.change());
        let (own, traces) = self.traced_with(&base)?;
        Some(if is_right(self.wanted, &own, self.count) { 0 } else { count_wrong(self, &traces, but).max(1) })
    }
}

/// Whether a value has only components of another one, or the other way round.
fn is_part(a: &ScalarColumns, b: &ScalarColumns) -> bool {
    let is_one = |a: &[f64], b: &[f64]| a.len() == b.len() && a.iter().zip(b).all(|(a, b)| is_number(*a, *b));
    let has = |all: &ScalarColumns, column: &Vec<f64>| all.iter().any(|own| is_one(own, column));
    let (less, more) = if a.len() <= b.len() { (a, b) } else { (b, a) };
    less.iter().all(|column| has(more, column))
}

/// In how many places something wrong is computed, but for one, or something right has a wrong name. What is only passed on becomes
/// right whatever it is.
fn count_wrong(search: &Search<'_, '_>, traces: &[Option<Trace>; 2], but: (Stage, usize)) -> usize {
    let of_stage = |stage: Stage| {
        let Some(trace) = &traces[stage as usize] else { return 0 };
        let sites = search.theirs.stage(stage).sites();
        let is_computed = |one: &Suspect| {
            let is_copy = matches!(sites[one.site].what, What::Read(_) | What::Assign { .. } | What::Part);
            !is_copy && (stage, one.site) != but
        };
        let is_wrong = |one: &&Suspect| {
            let is_right = one.is_right || one.gives_right || is_right_there(search, stage, trace, one);
            let mut events = one.events.iter().map(|event| &trace.events[*event]);
            let is_misnamed = |event: &Event| search.quantities.is_misnamed(stage, &sites[event.site].what, event);
            is_computed(one) && !is_right || is_right && events.any(is_misnamed)
        };
        named_suspects(search, stage, trace).iter().filter(is_wrong).count()
    };
    of_stage(Stage::Vertex) + of_stage(Stage::Fragment)
}
