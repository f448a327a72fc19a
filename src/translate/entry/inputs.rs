//! The inputs of the entry point: which of them the program feeds, and what the others hold.

use super::header::insert;
use super::{AttributePart, StageVariable};
use crate::translate::spirv::InputInterpolation;
use naga::{
    Binding, Block, BuiltIn, Expression, Function, FunctionArgument, GlobalVariable, Handle, Literal, Module, Sampling,
    Scalar, ScalarKind, Span, Statement, TypeInner, VectorSize,
};

/// Gives attributes the locations of their places in the interface, and the outputs location 0.
pub(in crate::translate) fn locate(module: &mut Module, interface: &crate::translate::LinkedInterface) {
    let function = &mut module.entry_points[0].function;
    for argument in &mut function.arguments {
        let place = interface.inputs.iter().position(|input| Some(&input.name) == argument.name.as_ref());
        if let (Some(Binding::Location { location, .. }), Some(place)) = (&mut argument.binding, place) {
            *location = place as u32;
        }
    }
    let Some(result) = &mut function.result else { return };
    let old = result.ty;
    let mut ty = module.types[old].clone();
    if let TypeInner::Struct { members, .. } = &mut ty.inner {
        for member in members {
            if let Some(Binding::Location { location, .. }) = &mut member.binding {
                *location = 0;
            }
        }
    }
    result.ty = module.types.insert(ty, Span::UNDEFINED);
    for (_, expression) in function.expressions.iter_mut() {
        match expression {
            Expression::Compose { ty, .. } if *ty == old => *ty = result.ty,
            _ => {}
        }
    }
}

/// Adds an argument for each part that the program feeds, at locations from 0 on.
pub(super) fn feed<'a>(
    function: &mut Function,
    parts: &'a [AttributePart],
    is_fragment: bool,
) -> Vec<(&'a AttributePart, u32)> {
    let mut fed = Vec::with_capacity(parts.len());
    for (location, part) in (0..).zip(parts) {
        let (interpolation, sampling) = if is_fragment { interpolation(&part.attribute) } else { (None, None) };
        let binding = Binding::Location { location, interpolation, sampling, blend_src: None, per_primitive: false };
        let name = Some(part.attribute.name.clone());
        function.arguments.push(FunctionArgument { name, ty: part.ty, binding: Some(binding) });
        fed.push((part, function.arguments.len() as u32 - 1));
    }
    fed
}

/// How the driver is to interpolate an input.
pub(super) fn interpolation(of: &StageVariable) -> (Option<naga::Interpolation>, Option<Sampling>) {
    let sampling = if of.qualifiers.centroid { Sampling::Centroid } else { Sampling::Center };
    match of.qualifiers.interpolation {
        InputInterpolation::Flat => (Some(naga::Interpolation::Flat), Some(Sampling::First)),
        _ if of.kind != Some(ScalarKind::Float) => (Some(naga::Interpolation::Flat), Some(Sampling::First)),
        InputInterpolation::NoPerspective => (Some(naga::Interpolation::Linear), Some(sampling)),
        InputInterpolation::Smooth => (Some(naga::Interpolation::Perspective), Some(sampling)),
    }
}

/// Gives the inputs that nothing feeds their values: a generic attribute that nothing feeds is (0, 0, 0, 1).
pub(in crate::translate) fn leave_unset(module: &mut Module, parts: &[AttributePart]) {
    for global in parts.iter().filter_map(AttributePart::whole) {
        unset_attribute(module, global);
    }
}

/// Takes away the arguments of a vertex stage but the vertex's number: what they are copied to is 0. Gives the index of
/// the argument that carries `instance_index`.
pub(super) fn drop_arguments(module: &mut Module, function: &mut Function) -> u32 {
    let arguments = std::mem::take(&mut function.arguments);
    let kept: Vec<Option<u32>> = arguments
        .iter()
        .map(|argument| {
            (argument.binding == Some(Binding::BuiltIn(BuiltIn::VertexIndex))).then(|| {
                function.arguments.push(argument.clone());
                function.arguments.len() as u32 - 1
            })
        })
        .collect();
    let ty = insert(module, TypeInner::Scalar(Scalar::U32));
    let instance = function.arguments.len() as u32;
    let binding = Some(Binding::BuiltIn(BuiltIn::InstanceIndex));
    function.arguments.push(FunctionArgument { name: None, ty, binding });

    let mut dropped = Vec::new();
    for (handle, expression) in function.expressions.iter_mut() {
        if let Expression::FunctionArgument(index) = expression {
            let index = *index as usize;
            match kept[index] {
                Some(new) => *expression = Expression::FunctionArgument(new),
                None => {
                    *expression = Expression::ZeroValue(arguments[index].ty);
                    dropped.push(handle);
                }
            }
        }
    }
    drop_stores(function, &dropped);
    instance
}

/// Removes the copies of dropped inputs.
fn drop_stores(function: &mut Function, dropped: &[Handle<Expression>]) {
    let expressions = &function.expressions;
    let is_dropped = |value: &Handle<Expression>| {
        let source = match expressions[*value] {
            Expression::As { expr, .. } => expr,
            _ => *value,
        };
        dropped.contains(&source)
    };
    let mut body = Block::new();
    for (statement, span) in std::mem::take(&mut function.body).span_into_iter() {
        if !matches!(&statement, Statement::Store { value, .. } if is_dropped(value)) {
            body.push(statement, span);
        }
    }
    function.body = body;
}

fn unset_attribute(module: &mut Module, global: Handle<GlobalVariable>) {
    let ty = module.global_variables[global].ty;
    let TypeInner::Vector { size: VectorSize::Quad, scalar } = module.types[ty].inner else {
        return;
    };
    let (Some(one), Some(zero)) = (Literal::one(scalar), Literal::zero(scalar)) else { return };
    let components = [zero, zero, zero, one]
        .map(|literal| module.global_expressions.append(Expression::Literal(literal), Span::UNDEFINED))
        .to_vec();
    let init = module.global_expressions.append(Expression::Compose { ty, components }, Span::UNDEFINED);
    module.global_variables[global].init = Some(init);
}
