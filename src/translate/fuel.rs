//! Fuel: every turn of a loop takes some, and a vertex that has none left leaves its loops.
//!
//! The software driver cuts a shader's loops silently after 65,535 turns in all, and draws a wrong picture. So the
//! module counts the turns itself and says which loop was running when the count reached its bound.
//!
//! Each loop counts its own turns from 0 against a constant, and adds them up behind its end: so a driver that unrolls
//! a short loop finds the count superfluous and drops it. (A count that goes on from loop to loop turns 100 unrolled
//! loops into branches that take half a minute to compile.) Only a loop around other loops looks at the sum.
//!
//! Straight code needs no fuel: [`super::gate`] bounds how much of it there is, all calls inlined.

mod lines;
mod out_of_fuel_message;
mod refit;
mod tank;
mod total;

pub(super) use out_of_fuel_message::out_of_fuel;
pub(super) use tank::run;
pub(super) use total::settle;

use super::gate::{Costs, each_statement};
use super::spirv::{LineTable, is_ours};
use naga::{
    AddressSpace, Block, Expression, Function, GlobalVariable, Handle, Module, Scalar, Span, Statement, Type, TypeInner,
};
use refit::Refit;
use std::collections::HashSet;

/// Turns that the loops of a shader may take for one vertex, in all, where a turn is short.
///
/// The driver cuts at 65,535. Answers to the homework take up to 80 (`pow` by hand).
pub const MAX_TURNS: u32 = 50_000;

/// Operations (see [`super::gate`]) that one unit of fuel pays for: a turn of a longer body takes more units.
///
/// With it the longest program that stays within its fuel takes 1 s for all vertices of a grading.
const OPERATIONS_PER_UNIT: u64 = 100;

/// What a vertex reports where the driver cut its loops: it runs the vertices of a triangle side by side, and counts
/// the turns of all of them where they part.
pub const CUT: u32 = u32::MAX;

/// A loop that takes fuel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LoopFuel {
    /// Its line in the student's file.
    pub line: Option<u32>,
    /// How many of its turns empty a full tank.
    pub turns: u32,
}

/// The counters that a module was given.
#[derive(Clone, Debug)]
pub(super) struct Gauge {
    /// Units taken so far.
    pub used: Handle<GlobalVariable>,
    /// The meter that took the last unit, counted from 1; 0 while there is fuel.
    pub ran_out: Handle<GlobalVariable>,
}

/// Has every loop of the module take fuel. Gives the loops, in the order in which [`Gauge::ran_out`] numbers them, and
/// the counters; `None` where there is no loop.
///
/// `words` are those that the module was made from, with their lines.
pub(super) fn meter(
    module: &mut Module,
    costs: &Costs,
    words: &[u32],
    lines: &LineTable,
) -> (Vec<LoopFuel>, Option<Gauge>) {
    let u32_type = module.types.insert(Type { name: None, inner: TypeInner::Scalar(Scalar::U32) }, Span::UNDEFINED);
    let mut counter = |name: &str| {
        let variable = GlobalVariable {
            name: Some(name.into()),
            space: AddressSpace::Private,
            binding: None,
            ty: u32_type,
            init: None,
            memory_decorations: naga::MemoryDecorations::empty(),
        };
        module.global_variables.append(variable, Span::UNDEFINED)
    };
    let gauge = Gauge { used: counter("fuel used"), ran_out: counter("ran out") };
    let headers = lines::loop_lines(words);
    let mut meters = Vec::new();
    let mut looping = HashSet::new();
    let handles: Vec<_> = module.functions.iter().map(|(handle, _)| handle).collect();
    for handle in handles {
        // A lookup reads eight texels at most.
        if is_ours(&module.functions[handle]) {
            continue;
        }
        if holds_loop(&module.functions[handle].body, &looping) {
            looping.insert(handle);
        }
        let operations = costs.loops(module, &module.functions[handle]);
        if operations.is_empty() {
            continue;
        }
        let function = &mut module.functions[handle];
        let known = function.name.as_deref().and_then(|name| headers.get(name));
        // Both are in the order of the source, unless the compiler dropped a loop that is never reached.
        let known = known.filter(|known| known.len() == operations.len());
        let body = std::mem::take(&mut function.body);
        let mut refit = Refit {
            u32_type,
            used: function.expressions.append(Expression::GlobalVariable(gauge.used), Span::UNDEFINED),
            ran_out: function.expressions.append(Expression::GlobalVariable(gauge.ran_out), Span::UNDEFINED),
            locals: &mut function.local_variables,
            operations: &operations,
            known,
            lines,
            looping: &looping,
            open: Vec::new(),
            first: meters.len(),
            meters: &mut meters,
        };
        function.body = refit.block(&mut function.expressions, body);
    }
    let gauge = (!meters.is_empty()).then_some(gauge);
    (meters, gauge)
}

/// Whether a loop stands in the block or in what it calls; `looping` are the functions that are known to have one.
fn holds_loop(block: &Block, looping: &HashSet<Handle<Function>>) -> bool {
    let mut found = false;
    each_statement(block, &mut |statement, _| match statement {
        Statement::Loop { .. } => found = true,
        Statement::Call { function, .. } => found |= looping.contains(function),
        _ => {}
    });
    found
}
