//! Variables between the stages whose declaration says another way of interpolation than all would be right by.

use super::candidates::Mend;
use super::search::{Search, is_right};
use super::{Finding, Flaw, Stage, Trace, What};
use crate::diagnose::columns::{ScalarColumns, is_same};
use crate::diagnose::trials::FUEL_OF_TRACE;
use reference::interpreter::Interpolation;
use reference::interpreter::trace::Event;
use reference::traced::Bench;

const WAYS: [Interpolation; 3] = [Interpolation::Smooth, Interpolation::Flat, Interpolation::NoPerspective];

/// Whether a vector has the direction of another one: what it lacks, it lacks where it is used.
fn is_along(event: &Event, wanted: &ScalarColumns) -> bool {
    /// The square of the sine of the angle between two that have one direction.
    const APART: f64 = 1e-6;
    let dot = |a: &ScalarColumns, b: &ScalarColumns, lane: usize| -> f64 {
        a.iter().zip(b).take(3).map(|(a, b)| a[lane] * b[lane]).sum()
    };
    let is_lane = |lane: usize| {
        let (own, right) = (dot(&event.values, &event.values, lane), dot(wanted, wanted, lane));
        let both = dot(&event.values, wanted, lane);
        both > 0.0 && own * right - both * both <= APART * own * right
    };
    event.values.len() > 1 && (0..event.lanes.len()).all(is_lane)
}

impl Search<'_, '_> {
    /// The declaration of an input of the fragment stage with which all would be right if it were interpolated in another way; of
    /// several that are declared alike, the first.
    pub(super) fn otherwise_interpolated(&self) -> Option<Finding> {
        let inputs = self.theirs.interpolated();
        let is_mended = |names: &[&str], own: Interpolation| {
            WAYS.into_iter().filter(|way| *way != own).any(|way| self.is_right_with(names, way))
        };
        let alone = inputs.iter().find(|(input, own)| is_mended(&[&input.name], *own)).map(|(input, _)| input);
        let (input, names) = match alone {
            Some(input) => (*input, vec![input.name.as_str()]),
            None => {
                let (input, own) = *inputs.first()?;
                let alike = inputs.iter().filter(|(_, other)| *other == own).map(|(input, _)| input.name.as_str());
                let names: Vec<&str> = alike.collect();
                (names.len() > 1 && is_mended(&names, own)).then_some((input, names))?
            }
        };
        let is_only = names.len() == 1;
        Some(Finding {
            stage: Stage::Fragment,
            line: input.line,
            name: is_only.then(|| input.name.clone()),
            quantity: None,
            serves: None,
            is_use: false,
            touches: Vec::new(),
            is_settled: true,
            is_whole: true,
            is_telling: true,
            touches_position: false,
            flaw: Flaw::Interpolation,
            features: Vec::new(),
            expected: Vec::new(),
            found: Vec::new(),
        })
    }

    fn is_right_with(&self, inputs: &[&str], way: Interpolation) -> bool {
        let other = self.theirs.interpolating(inputs, way);
        let bench = Bench::new(self.assignment, &other, self.places, self.in_quads, FUEL_OF_TRACE);
        let seen = bench.and_then(|mut bench| bench.with(&self.base));
        seen.is_some_and(|seen| is_right(self.wanted, &seen, self.count))
    }

    /// The line of the vertex stage that gives an input of the fragment stage its value, and the output that it is given, where that is
    /// not right already there.
    pub(super) fn handed_over(&self, mend: &Mend) -> Option<(u32, String)> {
        let fragment = self.theirs.stage(mend.stage);
        let What::Read(name) = &fragment.sites()[mend.suspect.site].what else { return None };
        let is_input = self.theirs.interpolated().iter().any(|(input, _)| input.written == *name);
        let event = &self.trace(mend.stage)?.events[*mend.suspect.events.first()?];
        let is_right = self.quantities.equal_to(mend.stage, event).is_some() || is_along(event, &mend.values[0]);
        if mend.stage != Stage::Fragment || !is_input || is_right {
            return None;
        }
        let vertex = self.trace(Stage::Vertex)?;
        let (program, output) = (self.theirs.stage(Stage::Vertex), self.theirs.interpolated_from(name)?);
        let written = &vertex.outputs[output];
        let is_right = |event: &usize| self.quantities.equal_to(Stage::Vertex, &vertex.events[*event]).is_some();
        let last = written.last().filter(|_| !written.iter().all(is_right))?;
        Some((program.sites()[vertex.events[*last].site].line, program.outputs()[output].written.clone()))
    }

    /// Whether the value that belongs in the place of an input is that of another input.
    pub(super) fn is_other_input(&self, mend: &Mend, trace: &Trace) -> bool {
        let sites = self.theirs.stage(mend.stage).sites();
        let What::Read(name) = &sites[mend.suspect.site].what else { return false };
        let inputs = self.theirs.interpolated();
        let is_other = |event: &&Event| match &sites[event.site].what {
            What::Read(other) => other != name && inputs.iter().any(|(input, _)| input.written == *other),
            _ => false,
        };
        mend.stage == Stage::Fragment
            && trace.events.iter().filter(is_other).any(|event| is_same(event, &mend.values[0]))
    }
}
