//! Rebuilds the entry point around the student's `main`: what reaches it, and what leaves it.
//!
//! naga's front end wraps `main` in a function that copies built-in inputs to private variables, calls `main`, and returns
//! built-in outputs; the student's own inputs and outputs are private variables (see [`super::spirv`]). Here that wrapper
//! is made to
//! - fill the inputs that the program feeds, part by part ([`parts`]); every other input has the value that OpenGL gives
//!   it when the program sets nothing (0, 0, 0, 1);
//! - tell in the header of a storage buffer which loop ran out of fuel (see [`super::fuel`]), 0 where none did; whoever
//!   runs after the first to say so finds no fuel, so that they all end quickly;
//! - hand over what `main` wrote: a vertex stage by the same buffer ([`vertex`]), a fragment stage as the colours of its
//!   targets ([`fragment`]).

mod fragment;
mod header;
mod inputs;
mod parts;
mod vertex;

pub(super) use inputs::{leave_unset, locate};
pub use parts::StageVariable;
pub(super) use parts::{AttributePart, is_input, parts};

use super::build::Build;
use super::fuel::{self, Gauge};
use header::CaptureHeader;
use naga::{Expression, Function, GlobalVariable, Handle, LocalVariable, Module, Span, Statement};
use reference::interpreter::WindowCoordinates;

/// Bind group of the capture buffer; the student's own uniform blocks are in group 0.
pub const CAPTURE_GROUP: u32 = 1;
/// Bytes of the capture buffer before its records: the number of the loop that ran out of fuel, a zero, what is
/// undefined, and room.
pub const CAPTURE_HEADER: u64 = 32;
/// Bytes of each vector of four numbers in a captured vertex.
pub const CAPTURE_SLOT: u64 = 16;

/// What the entry point does around the call of `main`.
#[derive(Clone, Debug)]
pub(super) struct Hooks {
    /// The counters of the module's loops, where it has loops.
    pub gauge: Option<Gauge>,
    /// A variable to fill from the header's zero; see [`super::opaque`].
    pub zero: Option<Handle<GlobalVariable>>,
    /// A variable whose value is told in the header; see [`super::undefined`].
    pub undefined: Option<Handle<GlobalVariable>>,
}

/// Rebuilds the only entry point of a vertex stage. `inputs` are what the program feeds, `outputs` what is captured.
pub(super) fn rebuild_vertex(module: &mut Module, inputs: &[AttributePart], outputs: &[AttributePart], hooks: &Hooks) {
    let mut entry = module.entry_points.remove(0);
    vertex::rebuild(module, &mut entry.function, inputs, outputs, hooks);
    entry.name = "main".into();
    module.entry_points.push(entry);
}

/// Rebuilds the only entry point of a fragment stage; gives the location of what is added to `gl_FragCoord`, where the
/// stage reads that. A stage without hooks is trusted.
pub(super) fn rebuild_fragment(
    module: &mut Module,
    inputs: &[AttributePart],
    outputs: &[AttributePart],
    hooks: Option<&Hooks>,
    window: WindowCoordinates,
) -> Option<u32> {
    let mut entry = module.entry_points.remove(0);
    let shift = fragment::rebuild(module, &mut entry.function, inputs, outputs, hooks, window);
    entry.name = "main".into();
    module.entry_points.push(entry);
    shift
}

/// The statements of the wrapper without its return: those up to the call of `main`, and those behind it.
fn statements(function: &mut Function) -> [Vec<(Statement, Span)>; 2] {
    let mut statements: Vec<_> = std::mem::take(&mut function.body).span_into_iter().collect();
    if matches!(statements.last(), Some((Statement::Return { .. }, _))) {
        statements.pop();
    }
    // What is loaded to be returned stays outside, where it is used.
    let call = statements.iter().rposition(|(statement, _)| matches!(statement, Statement::Call { .. }));
    let behind = statements.split_off(call.map_or(0, |call| call + 1));
    [statements, behind]
}

/// Runs `main`, as far as there is fuel.
fn run(
    build: &mut Build<'_>,
    hooks: &Hooks,
    header: &CaptureHeader,
    turns: Handle<LocalVariable>,
    call: impl FnOnce(&mut Build<'_>),
) {
    let capture = header.pointer(build);
    if let Some(zero) = hooks.zero {
        let value = header.zero(build, capture);
        let zero = build.leaf(Expression::GlobalVariable(zero));
        build.store(zero, value);
    }
    match &hooks.gauge {
        Some(gauge) => fuel::run(build, gauge, capture, turns, call),
        None => call(build),
    }
}
