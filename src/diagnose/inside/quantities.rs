//! What a right answer computes on its way.

mod collect;
mod leaves;

pub(super) use leaves::leaves;

use super::Place;
use super::walk::made_of;
use crate::diagnose::columns::{ScalarColumns, is_constant, is_equal, is_same, of_places};
use glam::DVec3;
use reference::Assignment;
use reference::equation::EquationVariant;
use reference::interpreter::trace::{Event, Trace, What};
use reference::interpreter::{Interpolation, Stage};
use reference::traced::TracedProgram;

/// A value of the right answer.
#[derive(Clone, Debug)]
pub(super) struct Quantity {
    /// The stage in whose texts it may stand.
    pub stage: Stage,
    /// The stage of the right answer that computes it.
    pub computed_in: Stage,
    /// The variables that are given it.
    pub names: Vec<String>,
    /// Each time that it is computed.
    pub turns: Vec<ScalarColumns>,
    /// Where it is computed: the events of the right answer's trace of that stage.
    events: Vec<usize>,
    pub is_bool: bool,
    /// Whether it is written as it is, or read: what may stand in the place of a number.
    pub is_leaf: bool,
    /// Whether it is what a fragment is given of a variable between the stages.
    pub is_interpolated: bool,
    /// What is added up to it.
    pub addends: Vec<(Option<String>, ScalarColumns)>,
    /// Whether it is some addends of a sum, which the right answer does not add by themselves.
    pub is_partial: bool,
    /// Whether the right answer multiplies a sum where this has the factor in each addend.
    pub is_multiplied_out: bool,
    /// Whether it is the same at all places: such values are equal by chance.
    pub is_constant: bool,
}

/// What is done to a value where it is computed.
const FINISHING: [&str; 6] = ["normalize", "max", "min", "clamp", "abs", "fract"];

/// All of them.
#[derive(Debug)]
pub(super) struct Quantities {
    pub all: Vec<Quantity>,
    traces: [Option<Trace>; 2],
    /// The variable that each event gives its value, by stage.
    names: [Vec<Option<String>>; 2],
    /// What each event does, by stage.
    doings: [Vec<What>; 2],
}

impl Quantity {
    /// Whether a value equals it where it is computed, and not by chance.
    fn is_equal_to(&self, stage: Stage, event: &Event) -> bool {
        let is_varying = self.stage == stage && !self.is_constant && !is_constant(&event.values);
        is_varying && self.turns.iter().any(|turn| is_same(event, turn))
    }
}

impl Quantities {
    pub fn of(solution: &TracedProgram, traces: [Option<Trace>; 2]) -> Self {
        let mut quantities =
            Self { all: Vec::new(), names: [Vec::new(), Vec::new()], doings: [Vec::new(), Vec::new()], traces };
        for stage in [Stage::Vertex, Stage::Fragment] {
            let program = solution.stage(stage);
            let Some(trace) = quantities.traces[stage as usize].take() else { continue };
            quantities.names[stage as usize] = trace.events.iter().map(|event| collect::name(program, event)).collect();
            let doing = |event: &Event| program.sites()[event.site].what.clone();
            quantities.doings[stage as usize] = trace.events.iter().map(doing).collect();
            quantities.all.extend(collect::of_stage(stage, program, &trace));
            quantities.traces[stage as usize] = Some(trace);
        }
        let flat = quantities.handed_over_flat(solution);
        quantities.all.extend(flat);
        quantities
    }

    /// What the right answer's vertex stage computes on the way to an output that is flat: a text may as well compute it in the
    /// fragment stage, from what it is handed of the triangle's last vertex.
    fn handed_over_flat(&self, solution: &TracedProgram) -> Vec<Quantity> {
        let [Some(vertex), Some(fragment)] = &self.traces else { return Vec::new() };
        let outputs = solution.stage(Stage::Vertex).outputs().iter().zip(&vertex.outputs);
        let flat = outputs.filter(|(output, _)| output.interpolation == Interpolation::Flat);
        let roots: Vec<usize> = flat.flat_map(|(_, events)| events.clone()).collect();
        let way = made_of(vertex, &roots);
        let lanes = fragment.events.first().map_or(0, |event| event.lanes.len());
        let last = |column: &Vec<f64>| at_last_corner(column, lanes);
        let columns = |columns: &ScalarColumns| -> ScalarColumns { columns.iter().map(last).collect() };
        let is_on_the_way =
            |own: &&Quantity| own.stage == Stage::Vertex && own.events.iter().any(|at| way.contains(at));
        let handed = self.all.iter().filter(is_on_the_way).map(|own| Quantity {
            stage: Stage::Fragment,
            turns: own.turns.iter().map(columns).collect(),
            addends: own.addends.iter().map(|(name, addend)| (name.clone(), columns(addend))).collect(),
            ..own.clone()
        });
        let is_new = |one: &Quantity| {
            let known = self.all.iter().filter(|own| own.stage == Stage::Fragment);
            !known.flat_map(|own| &own.turns).any(|turn| is_equal(turn, &one.turns[0]))
        };
        handed.filter(is_new).collect()
    }

    /// What is made of a value, or of what it is made of, where the right answer finishes the one or the other, see
    /// [`Self::finishes`].
    pub fn finished(&self, stage: Stage, trace: &Trace, event: &Event) -> Option<&Quantity> {
        let from = event.from.iter().map(|from| &trace.events[*from]);
        let known: Vec<&Quantity> =
            std::iter::once(event).chain(from).filter_map(|own| self.equal_to(stage, own)).collect();
        let is_it = |own: &&Quantity| {
            own.stage == stage
                && own.turns.len() == 1
                && own.turns[0].len() == event.values.len()
                && known.iter().any(|known| self.finishes(own, known))
        };
        self.all.iter().find(is_it)
    }

    /// Whether two are computed alike from different things: none of them is made of the other one.
    pub fn are_apart(&self, a: &Quantity, b: &Quantity) -> bool {
        let Some(trace) = &self.traces[a.computed_in as usize] else { return false };
        let is_made = |of: &Quantity, from: &Quantity| {
            let way = made_of(trace, &of.events);
            from.events.iter().any(|event| way.contains(event))
        };
        a.computed_in == b.computed_in && !is_made(a, b) && !is_made(b, a)
    }

    /// What the right answer is given in a stage, each with what it, and what a part of it, has where it is first read; none that is the
    /// same everywhere.
    pub fn given(&self, stage: Stage) -> Vec<(&str, &ScalarColumns)> {
        let events = self.traces[stage as usize].iter().flat_map(|trace| &trace.events);
        let mut found: Vec<(&str, &ScalarColumns)> = Vec::new();
        for (event, what) in events.zip(&self.doings[stage as usize]) {
            let What::Read(name) = what else { continue };
            if !event.from.is_empty() {
                continue;
            }
            let is_it = |(known, values): &(&str, &ScalarColumns)| known == name && values.len() == event.values.len();
            if !found.iter().any(is_it) {
                found.push((name, &event.values));
            }
        }
        found.retain(|(_, values)| !is_constant(values));
        found
    }

    /// Whether a value is given a name that the right answer gives another one.
    pub fn is_misnamed(&self, stage: Stage, what: &What, event: &Event) -> bool {
        let What::Assign { name, is_part: false } = what else { return false };
        let mut named = self.all.iter().filter(|own| own.stage == stage && own.names.contains(name)).peekable();
        named.peek().is_some() && !named.any(|own| own.turns.iter().any(|turn| is_same(event, turn)))
    }

    /// The definitions as a variant of the equation has them; its colours.
    /// `each`: how many samples each place has.
    pub fn replace(
        &mut self,
        assignment: &Assignment,
        variant: &EquationVariant<'_>,
        places: &[Place<'_>],
        each: usize,
    ) -> Option<Vec<DVec3>> {
        let outcomes: Vec<_> = places.iter().map(|at| variant.evaluate(at.uniforms, &at.probe.attributes)).collect();
        for definition in assignment.equation.definitions() {
            let values: Vec<_> = outcomes.iter().map(|one| one.get(&definition.name)).collect::<Option<_>>()?;
            let columns = of_places(&values, each);
            for own in self.all.iter_mut().filter(|own| own.names.contains(&definition.name)) {
                if own.turns.len() == 1 && own.turns[0].len() == columns.len() {
                    own.is_constant = is_constant(&columns);
                    own.turns = vec![columns.clone()];
                }
            }
        }
        Some(outcomes.iter().map(reference::equation::Evaluation::colour).collect())
    }

    /// A right quantity that a value equals where it is computed, and not by chance.
    pub fn equal_to(&self, stage: Stage, event: &Event) -> Option<&Quantity> {
        self.all.iter().find(|own| !own.is_multiplied_out && own.is_equal_to(stage, event))
    }

    /// Whether a value is right: it equals a quantity, also multiplied out, or a component of one, or several in a row.
    pub fn is_right(&self, stage: Stage, event: &Event) -> bool {
        self.equals_any(stage, event, |_| true) || self.is_component(stage, event)
    }

    /// Whether a value equals a component of a quantity, or several in a row, and not by chance.
    fn is_component(&self, stage: Stage, event: &Event) -> bool {
        let width = event.values.len();
        let is_it = |turn: &ScalarColumns| {
            (width + 1..=4).contains(&turn.len()) && turn.windows(width).any(|part| is_same(event, part))
        };
        let mut all = self.all.iter().filter(|own| own.stage == stage && !own.is_constant && !own.is_partial);
        (1..4).contains(&width) && !is_constant(&event.values) && all.any(|own| own.turns.iter().any(is_it))
    }

    /// Whether it equals one of several such quantities. A vector of length 1 is one, and the same normalised is another.
    pub fn equals_any(&self, stage: Stage, event: &Event, is_one: impl Fn(&Quantity) -> bool) -> bool {
        self.all.iter().any(|own| is_one(own) && own.is_equal_to(stage, event))
    }

    /// Whether a quantity is another one, clamped or made a unit vector: what is done to a value where it is computed, not
    /// where it is used.
    pub fn finishes(&self, of: &Quantity, on: &Quantity) -> bool {
        let Some(trace) = &self.traces[of.computed_in as usize] else { return false };
        let doings = &self.doings[of.computed_in as usize];
        let finishes = |event: &usize| {
            let is_finish = match &doings[*event] {
                What::Call(name) => FINISHING.contains(&name.as_str()),
                _ => false,
            };
            is_finish
                && trace.events[*event]
                    .from
                    .iter()
                    .any(|from| on.turns.iter().any(|turn| is_equal(turn, &trace.events[*from].values)))
        };
        of.stage == on.stage && of.events.iter().any(finishes)
    }

    /// The name of a variable, and those of what is computed from it.
    pub fn spoilt_by(&self, stage: Stage, name: &str) -> Vec<String> {
        let Some(trace) = &self.traces[stage as usize] else { return vec![name.to_owned()] };
        let names = &self.names[stage as usize];
        let mut is_spoilt = vec![false; trace.events.len()];
        for (number, event) in trace.events.iter().enumerate() {
            is_spoilt[number] = names[number].as_deref() == Some(name)
                || event.from.iter().chain(&event.under).any(|from| is_spoilt[*from]);
        }
        let named = names.iter().zip(&is_spoilt).filter(|(_, is)| **is);
        let mut found: Vec<String> = named.filter_map(|(name, _)| name.clone()).collect();
        found.sort();
        found.dedup();
        found
    }

    /// The first name that a quantity, or what is computed from it, is given.
    pub fn served_by(&self, quantity: &Quantity) -> Option<String> {
        if let Some(own) = quantity.names.first() {
            return Some(own.clone());
        }
        let trace = self.traces[quantity.computed_in as usize].as_ref()?;
        let names = &self.names[quantity.computed_in as usize];
        let mut made = vec![false; trace.events.len()];
        quantity.events.iter().for_each(|event| made[*event] = true);
        for (number, event) in trace.events.iter().enumerate() {
            made[number] |= event.from.iter().chain(&event.under).any(|from| made[*from]);
        }
        names.iter().zip(&made).find(|(name, made)| **made && name.is_some()).and_then(|(name, _)| name.clone())
    }

    /// The names of what a quantity is computed from, its own, and those of what is computed from it.
    pub fn touched_by(&self, quantity: &Quantity) -> Vec<String> {
        let Some(trace) = &self.traces[quantity.computed_in as usize] else { return Vec::new() };
        let names = &self.names[quantity.computed_in as usize];
        let mut is_touched = vec![false; trace.events.len()];
        quantity.events.iter().for_each(|event| is_touched[*event] = true);
        for (number, event) in trace.events.iter().enumerate() {
            is_touched[number] |= event.from.iter().chain(&event.under).any(|from| is_touched[*from]);
        }
        made_of(trace, &quantity.events).into_iter().for_each(|event| is_touched[event] = true);
        let named = names.iter().zip(&is_touched).filter(|(_, is)| **is);
        let mut found: Vec<String> = named.filter_map(|(name, _)| name.clone()).collect();
        found.sort();
        found.dedup();
        found
    }
}

/// What a flat output hands over of a value at three corners for each place, to so many samples.
pub(super) fn at_last_corner<T: Copy>(column: &[T], lanes: usize) -> Vec<T> {
    const CORNERS: usize = 3;
    let each = CORNERS * lanes / column.len().max(1);
    let own = column.iter().skip(CORNERS - 1).step_by(CORNERS);
    own.flat_map(|value| std::iter::repeat_n(*value, each)).collect()
}
