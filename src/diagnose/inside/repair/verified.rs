//! Whether what makes all right at some of the probes does so everywhere.

use super::{FUEL_OF_TRACE, Place, RepairAttempt, RepairStep, Search, TracedProgram, is_right};
use crate::compare::POSITION_TOLERANCE;
use crate::diagnose::columns::is_colour;
use crate::diagnose::trials::StageChanges;
use glam::{DVec3, DVec4};
use reference::equation::Reads;

impl Search<'_, '_> {
    /// Whether what makes all right does so at every probe. What is seen with other mistakes is known at the chosen ones only, and is
    /// looked at without the bounds of a colour, which hide much of it.
    pub(super) fn is_verified(&self, attempt: &RepairAttempt, step: &RepairStep, program: &TracedProgram) -> bool {
        let (stage, repair) = step;
        let Some([_, unclamped]) = &attempt.part else {
            return self.holds_everywhere(program) && !self.is_by_chance(attempt, step);
        };
        // What is bounded is bounded alike only where both can be traced.
        let traced = attempt.text(*stage).and_then(|text| program.with(*stage, text.traced(repair)?));
        let seen = traced.and_then(|program| self.unclamped(&program, &StageChanges::default()));
        seen.is_some_and(|seen| is_right(unclamped, &seen, self.count))
    }

    /// Whether a program is right at every judging probe, and not elsewhere another one.
    fn holds_everywhere(&self, program: &TracedProgram) -> bool {
        let variant = if self.others.is_empty() { None } else { self.assignment.variant(self.others) };
        // What is no variant of the definitions is another program.
        let with_others = match &variant {
            None if !self.others.is_empty() => self.assignment.traced_with(self.others),
            _ => None,
        };
        if !self.others.is_empty() && variant.is_none() && with_others.is_none() {
            return false;
        }
        let all = [self.evidence.probes, self.evidence.fresh.probes];
        let [judging, fresh] = all.map(|probes| {
            let places = Place::all(probes);
            let seen = self.shown(program, &places, FUEL_OF_TRACE)?;
            let wanted: Vec<DVec3> = match (&variant, &with_others) {
                (Some(variant), _) => {
                    let colour = |place: &Place<'_>| variant.evaluate(place.uniforms, &place.probe.attributes).colour();
                    places.iter().map(colour).collect()
                }
                (None, Some(program)) => self.shown(program, &places, FUEL_OF_TRACE)?.colours,
                (None, None) => places.iter().map(|place| place.probe.colour).collect(),
            };
            let is_right = |((place, wanted), (own, position)): ((&Place<'_>, &DVec3), (&DVec3, &DVec4))| {
                let largest = place.probe.position.abs().max_element().max(f64::MIN_POSITIVE);
                let is_there = self.assignment.equation.reads() != Reads::Attributes
                    || (*position - place.probe.position).abs().max_element() <= POSITION_TOLERANCE * largest;
                is_colour(*wanted, *own) && is_there
            };
            let pairs = places.iter().zip(&wanted).zip(seen.colours.iter().zip(&seen.positions));
            Some(pairs.map(is_right).collect::<Vec<bool>>())
        });
        let (Some(judging), Some(fresh)) = (judging, fresh) else { return false };
        judging.iter().all(|is| *is) && !self.evidence.fresh.is_contradicted(|place| !fresh[place])
    }
}
