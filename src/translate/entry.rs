//! Rebuilds the entry point around the student's `main`: which inputs reach it, what leaves it.
//!
//! naga's front end wraps `main` in a function that copies inputs to private variables, calls
//! `main`, and returns the outputs. Here that wrapper is made to
//! - feed only the assignment's inputs and `gl_VertexID`; every other input has the value that
//!   OpenGL gives it when the program sets nothing (0, 0, 0, 1; `gl_InstanceID` = 0);
//! - write the clip-space position and the colour to a storage buffer, one [`CAPTURE_STRIDE`]-byte
//!   record a vertex, at `instance_index + vertex_index`, behind a header of [`CAPTURE_HEADER`] bytes;
//! - tell in the header, a u32, which loop ran out of fuel (see [`super::fuel`]), 0 where none did;
//!   every vertex after the first to say so finds no fuel, so that they all end quickly;
//! - return one and the same position for every vertex: nothing is to be painted, and the driver has nothing to clip.

mod inputs;
mod types;

pub use inputs::Attribute;
pub(super) use inputs::locate;

use super::build::Build;
use super::fuel::{self, Gauge};
use inputs::feed;
use naga::{
    AddressSpace, BinaryOperator, Binding, BuiltIn, Expression, Function, FunctionArgument, FunctionResult,
    GlobalVariable, Handle, Literal, LocalVariable, Module, ResourceBinding, Span, Statement, StorageAccess, Type,
    TypeInner,
};
use types::Types;

/// Bind group of the capture buffer; the student's own uniform blocks are in group 0.
pub const CAPTURE_GROUP: u32 = 1;
/// Bytes of the capture buffer before its records: the number of the loop that ran out of fuel, a zero, what is
/// undefined, and room.
pub const CAPTURE_HEADER: u64 = 32;
/// Members of the capture buffer behind the number of the loop that ran out of fuel.
const ZERO_MEMBER: u32 = 1;
const UNDEFINED_MEMBER: u32 = 2;
const RECORDS_MEMBER: u32 = 3;
/// Bytes of one captured vertex: clip-space position and colour, four f32 each.
pub const CAPTURE_STRIDE: u64 = 32;

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

/// Rebuilds the only entry point of `module`; gives the attributes that it reads.
///
/// `inputs` are the names that the assignment's program feeds, `output` is the varying that the
/// fixed fragment shader reads, `hooks` is what stands around the call of `main`.
pub(super) fn rebuild(module: &mut Module, inputs: &[&str], output: &str, hooks: &Hooks) -> Vec<Attribute> {
    let mut entry = module.entry_points.remove(0);
    let outputs = Outputs::of(module, &entry.function, output);
    let (attributes, instance) = feed(module, &mut entry.function, inputs);
    finish(module, &mut entry.function, &outputs, instance, hooks);
    entry.name = "main".into();
    module.entry_points.push(entry);
    attributes
}

/// The values that `main` leaves behind, as expressions of the wrapper; none where never written.
struct Outputs {
    position: Option<Handle<Expression>>,
    colour: Option<Handle<Expression>>,
}

impl Outputs {
    fn of(module: &Module, function: &Function, output: &str) -> Self {
        let returned = function.body.iter().rev().find_map(|statement| match statement {
            Statement::Return { value } => *value,
            _ => None,
        });
        let Some(returned) = returned else {
            return Self { position: None, colour: None };
        };
        let components = match &function.expressions[returned] {
            Expression::Compose { components, .. } => components.clone(),
            _ => vec![returned],
        };
        let pointer = |value: Handle<Expression>| match function.expressions[value] {
            Expression::Load { pointer } => Some(pointer),
            _ => None,
        };
        let position = components.iter().copied().find(|&c| {
            let Some(Expression::AccessIndex { base, index }) = pointer(c).map(|p| &function.expressions[p]) else {
                return false;
            };
            let Expression::GlobalVariable(global) = function.expressions[*base] else {
                return false;
            };
            let TypeInner::Struct { members, .. } = &module.types[module.global_variables[global].ty].inner else {
                return false;
            };
            matches!(
                members.get(*index as usize).and_then(|m| m.binding.as_ref()),
                Some(Binding::BuiltIn(BuiltIn::Position { .. }))
            )
        });
        let colour = components.iter().copied().find(|&c| {
            let Some(Expression::GlobalVariable(global)) = pointer(c).map(|p| &function.expressions[p]) else {
                return false;
            };
            module.global_variables[*global].name.as_deref() == Some(output)
        });
        Self { position, colour }
    }
}

/// Tells in the capture's header what [`super::undefined`] met. Any vertex's answer will do.
fn tell_undefined(build: &mut Build<'_>, capture: Handle<Expression>, undefined: Handle<GlobalVariable>) {
    let undefined = build.leaf(Expression::GlobalVariable(undefined));
    let met = build.load(undefined);
    let none = build.number(0);
    let is_met = build.binary(BinaryOperator::NotEqual, met, none);
    build.when(is_met, |build| {
        let place = build.member(capture, UNDEFINED_MEMBER);
        build.store(place, met);
    });
}

/// Replaces what follows the call of `main`: capture and return.
fn finish(module: &mut Module, function: &mut Function, outputs: &Outputs, instance: u32, hooks: &Hooks) {
    let types = Types::new(module);
    let capture = module.global_variables.append(
        GlobalVariable {
            name: Some("capture".into()),
            space: AddressSpace::Storage { access: StorageAccess::LOAD | StorageAccess::STORE },
            binding: Some(ResourceBinding { group: CAPTURE_GROUP, binding: 0 }),
            ty: types.capture,
            init: None,
            memory_decorations: naga::MemoryDecorations::empty(),
        },
        Span::UNDEFINED,
    );
    let vertex = vertex_index(function, types.u32);
    let mut statements: Vec<_> = std::mem::take(&mut function.body).span_into_iter().collect();
    if matches!(statements.last(), Some((Statement::Return { .. }, _))) {
        statements.pop();
    }
    let mut build = Build::new(&mut function.expressions);
    let capture = build.leaf(Expression::GlobalVariable(capture));
    if let Some(zero) = hooks.zero {
        let header = build.member(capture, ZERO_MEMBER);
        let value = build.load(header);
        let zero = build.leaf(Expression::GlobalVariable(zero));
        build.store(zero, value);
    }
    // Those that call `main`; what is loaded to be returned stays outside, where it is used.
    let call = statements.iter().rposition(|(statement, _)| matches!(statement, Statement::Call { .. }));
    let behind = statements.split_off(call.map_or(0, |call| call + 1));
    match &hooks.gauge {
        Some(gauge) => {
            let turns = LocalVariable { name: None, ty: types.u32, init: None };
            let turns = function.local_variables.append(turns, Span::UNDEFINED);
            fuel::run(&mut build, gauge, capture, turns, |build| build.append(statements));
        }
        None => build.append(statements),
    }
    build.append(behind);
    if let Some(undefined) = hooks.undefined {
        tell_undefined(&mut build, capture, undefined);
    }
    write_record(&mut build, &types, outputs, capture, [instance, vertex]);
    let [zero, one] = [0.0, 1.0].map(|number| build.leaf(Expression::Literal(Literal::F32(number))));
    let middle = build.node(Expression::Compose { ty: types.vec4, components: vec![zero, zero, zero, one] });
    build.push(Statement::Return { value: Some(middle) });
    function.body = build.finish();
    let position = Binding::BuiltIn(BuiltIn::Position { invariant: false });
    function.result = Some(FunctionResult { ty: types.vec4, binding: Some(position) });
}

/// The argument that carries the vertex's index; made where the shader does not read it.
fn vertex_index(function: &mut Function, u32_type: Handle<Type>) -> u32 {
    let binding = Some(Binding::BuiltIn(BuiltIn::VertexIndex));
    let known = function.arguments.iter().position(|argument| argument.binding == binding);
    known.unwrap_or_else(|| {
        function.arguments.push(FunctionArgument { name: None, ty: u32_type, binding });
        function.arguments.len() - 1
    }) as u32
}

fn write_record(
    build: &mut Build<'_>,
    types: &Types,
    outputs: &Outputs,
    capture: Handle<Expression>,
    [instance, vertex]: [u32; 2],
) {
    let instance = build.leaf(Expression::FunctionArgument(instance));
    let vertex = build.leaf(Expression::FunctionArgument(vertex));
    let zero = build.leaf(Expression::ZeroValue(types.vec4));
    let position = outputs.position.unwrap_or(zero);
    let colour = outputs.colour.unwrap_or(zero);

    let index = build.binary(BinaryOperator::Add, instance, vertex);
    let records = build.member(capture, RECORDS_MEMBER);
    let record = build.node(Expression::Access { base: records, index });
    let to_position = build.member(record, 0);
    let to_colour = build.member(record, 1);
    build.store(to_position, position);
    build.store(to_colour, colour);
}
