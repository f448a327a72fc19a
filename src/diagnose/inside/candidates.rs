//! What may stand in a place of the text.

use super::quantities::Quantity;
use super::search::Search;
use super::walk::Suspect;
use super::*;
use crate::diagnose::columns::{ScalarColumns, fits, is_constant, is_number, is_same, shaped};
use reference::interpreter::Scalar;
use reference::interpreter::trace::{Event, ValueChange};

/// What to try for a number that is written: what makes no difference, or the other sign.
const PLAIN: [f64; 4] = [1.0, 0.0, -1.0, 2.0];

/// A place that mends what is seen, and what has to stand there.
#[derive(Clone, Debug)]
pub(super) struct Mend {
    pub stage: Stage,
    pub suspect: Suspect,
    /// The quantity by its place; `None` for a plain number or a truth value.
    pub quantity: Option<usize>,
    pub values: Vec<ScalarColumns>,
}

impl Mend {
    /// The same place with a number in it.
    pub(super) fn with_number(&self, number: f64) -> Self {
        let fill = |column: &Vec<f64>| vec![number; column.len()];
        let values = self.values.iter().map(|turn| turn.iter().map(fill).collect()).collect();
        Self { quantity: None, values, ..self.clone() }
    }

    /// What is changed by it.
    pub fn change(&self) -> ValueChange {
        ValueChange { site: self.suspect.site, values: self.values.clone() }
    }
}

impl Search<'_, '_> {
    /// What may stand in a place, and is not what stands there.
    pub fn candidates(&self, stage: Stage, suspect: &Suspect) -> Vec<Mend> {
        let Some(trace) = self.trace(stage) else { return Vec::new() };
        let events: Vec<&Event> = suspect.events.iter().map(|event| &trace.events[*event]).collect();
        let Some(first) = events.first() else { return Vec::new() };
        let site = self.site(stage, suspect);
        let is_bool = site.kind.scalar() == Some(Scalar::Bool);
        let is_float = site.kind.scalar() == Some(Scalar::Float);
        let lanes = first.lanes.len();
        if self.has_its_own_name(stage, site, &events) {
            return Vec::new();
        }
        let mend = |quantity, values| Mend { stage, suspect: suspect.clone(), quantity, values };
        let mut found = Vec::new();
        for (number, quantity) in self.quantities.all.iter().enumerate() {
            if quantity.is_multiplied_out
                || quantity.stage != stage
                || quantity.is_bool != is_bool
                || quantity.turns[0].first().is_none_or(|column| column.len() != lanes)
            {
                continue;
            }
            // Whole numbers count and choose: they are no quantities.
            if !is_bool && !is_float || site.what == What::Literal && !quantity.is_leaf {
                continue;
            }
            // Only what has a factor is wrong as a part of a sum. A sum that is one of them lacks the others.
            let has_factor = matches!(site.what, What::Binary(Binary::Multiply | Binary::Divide));
            if quantity.is_partial && !has_factor {
                continue;
            }
            // What is computed from place to place is no single number of a right answer, unless it has its name: that would be by chance.
            let has_its_name = matches!(&site.what, What::Assign { name, .. } if quantity.names.contains(name));
            let is_computed = !matches!(site.what, What::Read(_)) && !has_its_name;
            let is_number = quantity.is_constant && quantity.turns[0].len() == 1;
            if is_number && is_computed && !events.iter().all(|event| is_constant(&event.values)) {
                continue;
            }
            for turns in in_turn(&quantity.turns, events.len(), first.values.len()) {
                let turn = |at: usize| turns[at.min(turns.len() - 1)];
                if !events.iter().enumerate().all(|(at, event)| is_same(event, turn(at))) {
                    let shaped = events.iter().enumerate().map(|(at, event)| shaped(event, turn(at))).collect();
                    found.push(mend(Some(number), shaped));
                }
            }
        }
        if events.len() > 1 {
            let finished = events.iter().map(|event| self.quantities.finished(stage, trace, event));
            if let Some(each) = finished.collect::<Option<Vec<&Quantity>>>() {
                let is_it = |own: &Quantity| std::ptr::eq(own, each[0]);
                let values = events.iter().zip(&each).map(|(event, own)| shaped(event, &own.turns[0])).collect();
                found.push(mend(self.quantities.all.iter().position(is_it), values));
            }
        }
        if is_bool {
            for truth in [0.0, 1.0] {
                found.push(mend(None, vec![vec![vec![truth; lanes]]]));
            }
            let other = |event: &&Event| vec![event.values[0].iter().map(|truth| 1.0 - truth).collect()];
            found.push(mend(None, events.iter().map(other).collect()));
        }
        if matches!(site.what, What::Literal | What::Read(_)) && is_float && first.values.len() <= 4 {
            for number in PLAIN.into_iter().filter(|number| !is_number(first.values[0][0], *number)) {
                found.push(mend(None, vec![vec![vec![number; lanes]; first.values.len()]]));
            }
        }
        // One more, or one less: where counting begins and ends.
        if site.what == What::Literal && matches!(site.kind.scalar(), Some(Scalar::Int | Scalar::Uint)) {
            for number in [first.values[0][0] + 1.0, first.values[0][0] - 1.0] {
                found.push(mend(None, vec![vec![vec![number; lanes]]]));
            }
        }
        found
    }

    /// Whether a variable is given what the right answer gives the variable of that name.
    fn has_its_own_name(&self, stage: Stage, site: &Site, events: &[&Event]) -> bool {
        let What::Assign { name, is_part: false } = &site.what else { return false };
        let own = self.quantities.all.iter().filter(|own| own.stage == stage && own.names.contains(name));
        own.flat_map(|own| &own.turns).any(|turn| events.iter().all(|event| is_same(event, turn)))
    }
}

/// What a place may have each time that it is computed, so many times `count`, where a right answer has these turns: the same each time, one
/// turn each time, all turns again and again, as in a loop around the right answer's, or each several times, as in a loop inside of it. A
/// number may be the channels of a colour one after the other.
fn in_turn(turns: &[ScalarColumns], count: usize, width: usize) -> Vec<Vec<&[Vec<f64>]>> {
    let (most, channels) = (turns.len(), turns[0].len());
    let is_channel = width == 1 && (3..=4).contains(&channels) && count == 3 * most;
    if !is_channel && (!fits(width, channels) || !count.is_multiple_of(most)) {
        return Vec::new();
    }
    let times = count / most;
    let part = |turn: usize, channel: usize| match is_channel {
        true => std::slice::from_ref(&turns[turn][channel]),
        false => turns[turn].as_slice(),
    };
    let around = || (0..count).map(|at| part(at % most, at / most)).collect();
    let inside = || (0..count).map(|at| part(at / times, at % times)).collect();
    match (most, times) {
        (1, _) if !is_channel => vec![vec![part(0, 0)]],
        (_, 1) | (1, _) => vec![around()],
        _ => vec![around(), inside()],
    }
}
