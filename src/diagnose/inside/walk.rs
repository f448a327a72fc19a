//! From the outputs back to what they are made of, as far as it is not right yet.

use super::{Trace, What};
use crate::diagnose::columns::{ScalarColumns, is_equal};
use reference::interpreter::Program;
use reference::interpreter::trace::Event;
use std::collections::{BTreeMap, BTreeSet};

/// A site that may be to blame.
#[derive(Clone, Debug)]
pub(super) struct Suspect {
    pub site: usize,
    /// Its events, in order.
    pub events: Vec<usize>,
    /// Whether its value is right as it is, so that it can only be the wrong one in its place.
    pub is_right: bool,
    /// Whether it is what gives a value that is right as it is.
    pub gives_right: bool,
}

/// The suspects of a stage in the order in which they are computed. `is_known`: whether a value is taken for right.
pub(super) fn suspects(program: &Program, trace: &Trace, is_known: &dyn Fn(&Event) -> bool) -> Vec<Suspect> {
    let roots = &roots(trace);
    let mut seen: BTreeMap<usize, bool> = BTreeMap::new();
    let mut givers: Vec<usize> = Vec::new();
    let mut open: Vec<usize> = roots.to_vec();
    while let Some(event) = open.pop() {
        if seen.contains_key(&event) {
            continue;
        }
        let own = &trace.events[event];
        // What goes out is what is asked about, and a step that changes nothing anywhere may be the one that should.
        let goes_out = roots.iter().any(|root| trace.events[*root].values == own.values);
        let is_right = !goes_out && is_known(own) && !changes_nothing(program, trace, event);
        seen.insert(event, is_right);
        match is_right {
            true => givers.extend(copies(trace, event)),
            false => open.extend(own.from.iter().chain(&own.under)),
        }
        // What decides over it may be wrong whatever it is.
        if is_right {
            open.extend(&own.under);
        }
    }
    let mut by_site: BTreeMap<usize, Suspect> = BTreeMap::new();
    let all = seen.iter().map(|(event, is_right)| (*event, *is_right, false));
    let givers = givers.iter().filter(|event| !seen.contains_key(event)).map(|event| (*event, true, true));
    for (event, is_right, gives_right) in all.chain(givers) {
        let site = trace.events[event].site;
        let suspect =
            by_site.entry(site).or_insert_with(|| Suspect { site, events: Vec::new(), is_right: true, gives_right });
        suspect.is_right &= is_right;
        suspect.gives_right &= gives_right;
    }
    let mut found: Vec<Suspect> = by_site.into_values().collect();
    for suspect in &mut found {
        let events = trace.events.iter().enumerate().filter(|(_, event)| event.site == suspect.site);
        suspect.events = events.map(|(number, _)| number).collect();
    }
    found.sort_by_key(|suspect| suspect.events.first().copied());
    found.retain(|suspect| !matches!(program.sites()[suspect.site].what, What::Step));
    found
}

/// What an event is only a copy of, also by way of a structure or an array that holds it among others.
fn copies(trace: &Trace, event: usize) -> Vec<usize> {
    let own = &trace.events[event].values;
    let holds = |values: &ScalarColumns| !own.is_empty() && values.windows(own.len()).any(|part| part == own);
    let mut seen = BTreeSet::new();
    let mut open = vec![event];
    while let Some(event) = open.pop() {
        let from = trace.events[event].from.iter().copied();
        open.extend(from.filter(|from| holds(&trace.events[*from].values) && seen.insert(*from)));
    }
    seen.into_iter().filter(|event| trace.events[*event].values == *own).collect()
}

/// Whether a value is that of one of its operands, or a copy of such a value: a sum with an addend of 0, a mixture all of one.
fn changes_nothing(program: &Program, trace: &Trace, event: usize) -> bool {
    let own = &trace.events[event];
    let mut same = own.from.iter().filter(|from| is_equal(&trace.events[**from].values, &own.values));
    match &program.sites()[own.site].what {
        What::Binary(_) | What::Call(_) | What::Conditional => same.next().is_some(),
        What::Assign { .. } | What::Read(_) => same.any(|from| changes_nothing(program, trace, *from)),
        _ => false,
    }
}

/// The events that give the outputs their values.
pub(super) fn roots(trace: &Trace) -> Vec<usize> {
    trace.outputs.iter().flatten().copied().collect()
}

/// The events that some events are computed from, and they themselves.
pub(in crate::diagnose) fn made_of(trace: &Trace, events: &[usize]) -> BTreeSet<usize> {
    let mut found = BTreeSet::new();
    let mut open = events.to_vec();
    while let Some(event) = open.pop() {
        if found.insert(event) {
            open.extend(&trace.events[event].from);
        }
    }
    found
}
