//! What a right answer computes on its way.

use super::Place;
use super::walk::made_of;
use crate::diagnose::columns::{ScalarColumns, is_constant, is_equal, is_same, of_places};
use glam::DVec3;
use reference::Assignment;
use reference::equation::EquationVariant;
use reference::interpreter::trace::{Event, Trace, What};
use reference::interpreter::{Binary, Interpolation, Program, Scalar, Stage};
use reference::traced::TracedProgram;
use std::collections::{BTreeMap, BTreeSet};

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

impl Quantities {
    pub fn of(solution: &TracedProgram, traces: [Option<Trace>; 2]) -> Self {
        let mut quantities =
            Self { all: Vec::new(), names: [Vec::new(), Vec::new()], doings: [Vec::new(), Vec::new()], traces };
        for stage in [Stage::Vertex, Stage::Fragment] {
            let program = solution.stage(stage);
            let Some(trace) = quantities.traces[stage as usize].take() else { continue };
            quantities.names[stage as usize] = trace.events.iter().map(|event| name(program, event)).collect();
            let doing = |event: &Event| program.sites()[event.site].what.clone();
            quantities.doings[stage as usize] = trace.events.iter().map(doing).collect();
            let mut own = of_stage(stage, program, &trace);
            own.extend(partial_sums(&own));
            own.extend(siblings(&own));
            quantities.all.append(&mut own);
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
        if is_constant(&event.values) {
            return None;
        }
        let is_it = |own: &&Quantity| {
            own.stage == stage && !own.is_constant && own.turns.iter().any(|turn| is_same(event, turn))
        };
        self.all.iter().find(is_it)
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

fn name(program: &Program, event: &Event) -> Option<String> {
    match &program.sites()[event.site].what {
        What::Assign { name, is_part: false } => Some(name.clone()),
        _ => None,
    }
}

fn of_stage(stage: Stage, program: &Program, trace: &Trace) -> Vec<Quantity> {
    let mut found: Vec<Quantity> = Vec::new();
    let sites = program.sites();
    let is_input = |name: &str| program.inputs().iter().any(|input| input.name == name);
    let mut by_site: Vec<Vec<usize>> = vec![Vec::new(); sites.len()];
    trace.events.iter().enumerate().for_each(|(number, event)| by_site[event.site].push(number));
    for (site, events) in sites.iter().zip(by_site).filter(|(_, events)| !events.is_empty()) {
        let is_bool = site.kind.scalar() == Some(Scalar::Bool);
        if !is_bool && !matches!(site.kind.scalar(), Some(Scalar::Float)) {
            continue;
        }
        let name = match &site.what {
            What::Assign { name, is_part: false } => Some(name.clone()),
            _ => None,
        };
        let turns: Vec<ScalarColumns> = events.iter().map(|event| trace.events[*event].values.clone()).collect();
        let quantity = |turns: Vec<ScalarColumns>, events: Vec<usize>| Quantity {
            stage,
            computed_in: stage,
            names: name.iter().cloned().collect(),
            is_constant: turns.iter().all(is_constant),
            addends: events.last().map_or_else(Vec::new, |event| addends(program, trace, *event)),
            turns,
            events,
            is_bool,
            is_partial: false,
            is_leaf: matches!(site.what, What::Literal | What::Read(_)),
            is_interpolated: matches!(&site.what, What::Read(name) if stage == Stage::Fragment && is_input(name)),
        };
        if turns.len() > 1 {
            for (turn, event) in turns.iter().zip(&events).take(8) {
                add(&mut found, quantity(vec![turn.clone()], vec![*event]));
            }
        }
        add(&mut found, quantity(turns, events));
    }
    found
}

/// Quantities whose names differ in their numbers alone, `l1` and `l2`, as a loop or a function computes them one after the other.
fn siblings(all: &[Quantity]) -> Vec<Quantity> {
    let stem = |own: &Quantity| -> Option<String> {
        let name = own.names.first().filter(|_| own.turns.len() == 1)?;
        let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
        (stem.len() < name.len() && !stem.is_empty()).then(|| stem.to_owned())
    };
    let mut families: BTreeMap<String, Vec<&Quantity>> = BTreeMap::new();
    for own in all {
        if let Some(stem) = stem(own) {
            families.entry(stem).or_default().push(own);
        }
    }
    let family = |members: Vec<&Quantity>| {
        let first = (*members.first()?).clone();
        let is_alike = |own: &&Quantity| own.turns[0].len() == first.turns[0].len() && own.is_bool == first.is_bool;
        (members.len() > 1 && members.iter().all(is_alike)).then(|| Quantity {
            names: members.iter().flat_map(|own| own.names.clone()).collect(),
            turns: members.iter().flat_map(|own| own.turns.clone()).collect(),
            events: members.iter().flat_map(|own| own.events.clone()).collect(),
            is_constant: members.iter().all(|own| own.is_constant),
            is_leaf: false,
            ..first
        })
    };
    families.into_values().filter_map(family).collect()
}

/// Most addends of a sum some of which may be added by themselves.
const MOST_ADDENDS: usize = 6;

/// Sums of some of the addends of the largest sum: a factor may stand before two terms of three.
fn partial_sums(all: &[Quantity]) -> Vec<Quantity> {
    let fits = |one: &Quantity| one.addends.iter().all(|(_, addend)| [1, one.turns[0].len()].contains(&addend.len()));
    let sums = all.iter().filter(|one| (3..=MOST_ADDENDS).contains(&one.addends.len()) && fits(one));
    let Some(whole) = sums.max_by_key(|one| one.addends.len()) else { return Vec::new() };
    let count = whole.addends.len();
    let width = whole.turns[0].len();
    let chosen = (1_usize..(1 << count) - 1).filter(|chosen| chosen.count_ones() > 1);
    let sum = |chosen: usize| {
        let addends: Vec<_> =
            (0..count).filter(|at| chosen >> at & 1 == 1).map(|at| whole.addends[at].clone()).collect();
        let mut total: ScalarColumns = vec![vec![0.0; addends[0].1[0].len()]; width];
        for (_, addend) in &addends {
            for (to, from) in total.iter_mut().zip(addend.iter().cycle()) {
                to.iter_mut().zip(from).for_each(|(to, from)| *to += from);
            }
        }
        let events = addends.iter().flat_map(|(_, addend)| {
            all.iter()
                .filter(|one| one.turns.iter().any(|turn| is_equal(turn, addend)))
                .flat_map(|one| one.events.clone())
        });
        Quantity {
            stage: whole.stage,
            computed_in: whole.computed_in,
            names: Vec::new(),
            is_constant: is_constant(&total),
            events: events.collect(),
            turns: vec![total],
            is_bool: false,
            is_partial: true,
            is_leaf: false,
            is_interpolated: false,
            addends,
        }
    };
    let is_new = |one: &Quantity| !all.iter().any(|own| own.turns.iter().any(|turn| is_equal(turn, &one.turns[0])));
    chosen.map(sum).filter(is_new).collect()
}

/// Adds a quantity; one that is there already only gets a name.
fn add(found: &mut Vec<Quantity>, quantity: Quantity) {
    let is_it = |own: &&mut Quantity| {
        let alike = own.turns.len() == quantity.turns.len() && own.is_bool == quantity.is_bool;
        alike && own.turns.iter().zip(&quantity.turns).all(|(a, b)| is_equal(a, b))
    };
    match found.iter_mut().find(is_it) {
        Some(own) => {
            own.names.extend(quantity.names);
            own.events.extend(quantity.events);
            own.is_leaf |= quantity.is_leaf;
            own.is_interpolated |= quantity.is_interpolated;
        }
        None => found.push(quantity),
    }
}

/// What is added up to an event, with the names of variables.
fn addends(program: &Program, trace: &Trace, event: usize) -> Vec<(Option<String>, ScalarColumns)> {
    let own = &trace.events[event];
    let site = &program.sites()[own.site];
    let is_sum = matches!(site.what, What::Binary(Binary::Add));
    let operands = || own.from.iter().copied();
    match &site.what {
        What::Binary(Binary::Add) => {
            operands().flat_map(|operand| addend(program, trace, operand)).filter(|_| is_sum).collect()
        }
        What::Assign { .. } => match own.from.as_slice() {
            [only] => addends(program, trace, *only),
            _ => Vec::new(),
        },
        _ => Vec::new(),
    }
}

fn addend(program: &Program, trace: &Trace, event: usize) -> Vec<(Option<String>, ScalarColumns)> {
    let inner = addends(program, trace, event);
    if !inner.is_empty() {
        return inner;
    }
    let own = &trace.events[event];
    let name = match &program.sites()[own.site].what {
        What::Read(name) => Some(name.clone()),
        _ => None,
    };
    vec![(name, own.values.clone())]
}
