//! What a value is computed from in its expression.

use super::{Quantities, Quantity};
use crate::diagnose::columns::{ScalarColumns, is_constant, is_equal};
use crate::diagnose::inside::walk::made_of;
use reference::interpreter::trace::{Event, Trace, What};

impl Quantities {
    /// The values of the variables that a quantity is computed from in its expression.
    pub fn made_from(&self, quantity: &Quantity) -> Vec<&ScalarColumns> {
        self.leaves_of(quantity).map(|event| &event.values).collect()
    }

    /// Those of them that are computed, and not given.
    pub fn needed_for(&self, quantity: &Quantity) -> Vec<&ScalarColumns> {
        self.leaves_of(quantity).filter(|event| !event.from.is_empty()).map(|event| &event.values).collect()
    }

    fn leaves_of(&self, quantity: &Quantity) -> impl Iterator<Item = &Event> {
        let trace = self.traces[quantity.computed_in as usize].as_ref();
        let doings = &self.doings[quantity.computed_in as usize];
        let first = trace.zip(quantity.events.first());
        first.into_iter().flat_map(|(trace, event)| leaf_events(trace, *event, &|event| &doings[event]))
    }

    /// The values on the way to a quantity that differ from place to place.
    pub fn way(&self, quantity: &Quantity) -> Vec<&ScalarColumns> {
        let Some(trace) = &self.traces[quantity.computed_in as usize] else { return Vec::new() };
        let way = made_of(trace, &quantity.events).into_iter().map(|event| &trace.events[event].values);
        way.filter(|values| !is_constant(values)).collect()
    }
}

/// The values of the variables that an event is computed from in its expression, but for those that are the same everywhere. `what`: what
/// a site does.
pub(in crate::diagnose::inside) fn leaves<'t>(
    trace: &'t Trace,
    event: usize,
    what: &dyn Fn(usize) -> &'t What,
) -> Vec<&'t ScalarColumns> {
    let all = leaf_events(trace, event, &|event| what(trace.events[event].site));
    all.into_iter().map(|event| &event.values).collect()
}

/// `what`: what an event does.
fn leaf_events<'t>(trace: &'t Trace, event: usize, what: &dyn Fn(usize) -> &'t What) -> Vec<&'t Event> {
    let mut found: Vec<&Event> = Vec::new();
    let mut open = vec![event];
    while let Some(at) = open.pop() {
        let own = &trace.events[at];
        let is_leaf = match what(at) {
            What::Read(_) => true,
            What::Assign { .. } => at != event,
            _ => false,
        };
        if !is_leaf {
            open.extend(&own.from);
        } else if !is_constant(&own.values) && !found.iter().any(|known| is_equal(&known.values, &own.values)) {
            found.push(own);
        }
    }
    found
}
