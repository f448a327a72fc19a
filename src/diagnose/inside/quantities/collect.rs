//! The quantities of a trace.

use super::Quantity;
use crate::diagnose::columns::{ScalarColumns, is_constant, is_equal};
use reference::interpreter::trace::{Event, Trace, What};
use reference::interpreter::{Binary, Program, Scalar, Stage};
use std::collections::BTreeMap;

/// The variable that an event gives its value.
pub(super) fn name(program: &Program, event: &Event) -> Option<String> {
    match &program.sites()[event.site].what {
        What::Assign { name, is_part: false } => Some(name.clone()),
        _ => None,
    }
}

/// All of a stage: what it computes, sums of some addends of the largest sum, and what is computed several times under names in a row.
pub(super) fn of_stage(stage: Stage, program: &Program, trace: &Trace) -> Vec<Quantity> {
    let mut all = computed(stage, program, trace);
    all.extend(partial_sums(&all));
    all.extend(multiplied_sums(program, trace, &all));
    all.extend(siblings(&all));
    all
}

fn computed(stage: Stage, program: &Program, trace: &Trace) -> Vec<Quantity> {
    let mut found: Vec<Quantity> = Vec::new();
    let sites = program.sites();
    let is_input = |name: &str| program.inputs().iter().any(|input| input.written == name);
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
            is_multiplied_out: false,
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
    some_of_the_largest(all, &|one| one.addends.clone())
}

/// The same where a factor stands before each of the addends, and these by themselves.
fn multiplied_sums(program: &Program, trace: &Trace, all: &[Quantity]) -> Vec<Quantity> {
    let each = |one: &Quantity| {
        // What only passes a sum on has no addends.
        let site = one.events.first().map(|event| trace.events[*event].site);
        let event = one.events.iter().rfind(|event| Some(trace.events[**event].site) == site);
        event.map_or_else(Vec::new, |event| multiplied_out(program, trace, *event))
    };
    let found = some_of_the_largest(all, &each).into_iter();
    found.map(|own| Quantity { is_multiplied_out: true, ..own }).collect()
}

/// Some of the addends of the largest sum, and their sums, as far as they are new. `each`: what is added up to a quantity.
fn some_of_the_largest(all: &[Quantity], each: &dyn Fn(&Quantity) -> Vec<Addend>) -> Vec<Quantity> {
    let fits = |one: &Quantity, addends: &[Addend]| {
        let is_one = |(_, addend): &Addend| [1, one.turns[0].len()].contains(&addend.len());
        (3..=MOST_ADDENDS).contains(&addends.len()) && addends.iter().all(is_one)
    };
    let sums = all.iter().map(|one| (one, each(one))).filter(|(one, addends)| fits(one, addends));
    let Some((whole, addends)) = sums.max_by_key(|(_, addends)| addends.len()) else { return Vec::new() };
    let count = addends.len();
    let width = whole.turns[0].len();
    let sum = |chosen: usize| {
        let addends: Vec<Addend> =
            (0..count).filter(|at| chosen >> at & 1 == 1).map(|at| addends[at].clone()).collect();
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
            is_partial: addends.len() > 1,
            is_multiplied_out: false,
            is_leaf: false,
            is_interpolated: false,
            addends,
        }
    };
    let is_new = |one: &Quantity| !all.iter().any(|own| own.turns.iter().any(|turn| is_equal(turn, &one.turns[0])));
    (1_usize..(1 << count) - 1).map(sum).filter(is_new).collect()
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

/// A part of a sum, with the name of the variable that it is.
type Addend = (Option<String>, ScalarColumns);

/// What is added up to an event, where what multiplies a sum multiplies each of its addends.
fn multiplied_out(program: &Program, trace: &Trace, event: usize) -> Vec<Addend> {
    let own = &trace.events[event];
    let each = |event: usize| multiplied_out(program, trace, event);
    match (&program.sites()[own.site].what, &own.from[..]) {
        (What::Binary(Binary::Add), operands) => operands.iter().flat_map(|operand| each(*operand)).collect(),
        (What::Assign { .. }, [only]) => each(*only),
        (What::Binary(Binary::Multiply), [a, b]) => {
            let [of_a, of_b] = [each(*a), each(*b)];
            let (sum, factor) = if of_a.len() > 1 { (of_a, *b) } else { (of_b, *a) };
            let factor = &trace.events[factor].values;
            let fits =
                |one: &ScalarColumns| [one.len(), factor.len()].iter().all(|n| [1, own.values.len()].contains(n));
            if sum.len() < 2 || !sum.iter().all(|(_, addend)| fits(addend)) {
                return vec![(None, own.values.clone())];
            }
            sum.into_iter().map(|(_, addend)| (None, product(&addend, factor))).collect()
        }
        _ => addend(program, trace, event),
    }
}

/// The product of two values, each a number or as many as the other one has.
fn product(a: &ScalarColumns, b: &ScalarColumns) -> ScalarColumns {
    let pairs = a.iter().cycle().zip(b.iter().cycle()).take(a.len().max(b.len()));
    pairs.map(|(a, b)| a.iter().zip(b).map(|(a, b)| a * b).collect()).collect()
}

/// What is added up to an event, with the names of variables.
fn addends(program: &Program, trace: &Trace, event: usize) -> Vec<Addend> {
    let own = &trace.events[event];
    match &program.sites()[own.site].what {
        What::Binary(Binary::Add) => own.from.iter().flat_map(|operand| addend(program, trace, *operand)).collect(),
        What::Assign { .. } => match own.from.as_slice() {
            [only] => addends(program, trace, *only),
            _ => Vec::new(),
        },
        _ => Vec::new(),
    }
}

fn addend(program: &Program, trace: &Trace, event: usize) -> Vec<Addend> {
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
