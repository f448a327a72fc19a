//! The entry point of a vertex stage. It writes the clip-space position and its outputs to the storage buffer, one record a
//! vertex, at `instance_index + vertex_index`, and returns one and the same position for every vertex: nothing is to be
//! painted, and the driver has nothing to clip.

use super::header::CaptureHeader;
use super::inputs::{drop_arguments, feed};
use super::{AttributePart, Hooks};
use crate::translate::build::Build;
use naga::{
    BinaryOperator, Binding, BuiltIn, Expression, Function, FunctionArgument, FunctionResult, Handle, Literal,
    LocalVariable, Module, ScalarKind, Span, Statement, Type, TypeInner,
};

pub(super) fn rebuild(
    module: &mut Module,
    function: &mut Function,
    inputs: &[AttributePart],
    outputs: &[AttributePart],
    hooks: &Hooks,
) {
    let position = position(module, function);
    let instance = drop_arguments(module, function);
    let header = CaptureHeader::declare(module, Some(outputs.len() as u32));
    let vertex = vertex_index(function, header.u32);
    let fed = feed(function, inputs, false);
    let turns = LocalVariable { name: None, ty: header.u32, init: None };
    let turns = function.local_variables.append(turns, Span::UNDEFINED);
    let [call, behind] = super::statements(function);
    let mut build = Build::new(&mut function.expressions);
    super::run(&mut build, hooks, &header, turns, |build| {
        fed.into_iter().for_each(|(part, argument)| {
            let place = part.pointer(build);
            let value = build.leaf(Expression::FunctionArgument(argument));
            build.store(place, value);
        });
        build.append(call);
    });
    build.append(behind);
    let capture = header.pointer(&mut build);
    if let Some(undefined) = hooks.undefined {
        header.tell_undefined(&mut build, capture, undefined);
    }
    let [instance, vertex] = [instance, vertex].map(|index| build.leaf(Expression::FunctionArgument(index)));
    let index = build.binary(BinaryOperator::Add, instance, vertex);
    let zero = build.leaf(Expression::ZeroValue(header.vec4));
    let values: Vec<Handle<Expression>> = std::iter::once(position.unwrap_or(zero))
        .chain(outputs.iter().map(|part| {
            let value = part.pointer(&mut build);
            let value = build.load(value);
            as_floats(&mut build, header.vec4, part, value)
        }))
        .collect();
    let record = header.record(&mut build, capture, index);
    for (slot, value) in (0..).zip(values) {
        let place = build.member(record, slot);
        build.store(place, value);
    }
    let [zero, one] = [0.0, 1.0].map(|number| build.leaf(Expression::Literal(Literal::F32(number))));
    let middle = build.node(Expression::Compose { ty: header.vec4, components: vec![zero, zero, zero, one] });
    build.push(Statement::Return { value: Some(middle) });
    function.body = build.finish();
    let position = Binding::BuiltIn(BuiltIn::Position { invariant: false });
    function.result = Some(FunctionResult { ty: header.vec4, binding: Some(position) });
}

/// The value as four floats; integers keep their bits, and what is missing is 0, 0, 0 and 1.
fn as_floats(
    build: &mut Build<'_>,
    vec4: Handle<Type>,
    part: &AttributePart,
    value: Handle<Expression>,
) -> Handle<Expression> {
    let value = match part.attribute.kind {
        Some(ScalarKind::Float) => value,
        _ => build.node(Expression::As { expr: value, kind: ScalarKind::Float, convert: None }),
    };
    if part.attribute.size == 4 {
        return value;
    }
    let missing = [0.0, 0.0, 0.0, 1.0].map(|number| build.leaf(Expression::Literal(Literal::F32(number))));
    let components =
        std::iter::once(value).chain(missing[usize::from(part.attribute.size)..].iter().copied()).collect();
    build.node(Expression::Compose { ty: vec4, components })
}

/// What `gl_Position` was left with, as an expression of the wrapper; `None` where it was never written.
fn position(module: &Module, function: &Function) -> Option<Handle<Expression>> {
    let returned = function.body.iter().rev().find_map(|statement| match statement {
        Statement::Return { value } => *value,
        _ => None,
    })?;
    let components = match &function.expressions[returned] {
        Expression::Compose { components, .. } => components.clone(),
        _ => vec![returned],
    };
    components.into_iter().find(|component| {
        let Expression::Load { pointer } = function.expressions[*component] else { return false };
        let Expression::AccessIndex { base, index } = function.expressions[pointer] else { return false };
        let Expression::GlobalVariable(global) = function.expressions[base] else { return false };
        let TypeInner::Struct { members, .. } = &module.types[module.global_variables[global].ty].inner else {
            return false;
        };
        let binding = members.get(index as usize).and_then(|member| member.binding.as_ref());
        matches!(binding, Some(Binding::BuiltIn(BuiltIn::Position { .. })))
    })
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
