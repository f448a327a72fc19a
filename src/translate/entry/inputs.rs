//! The inputs of the entry point: which of them the assignment's program feeds, and what the others hold.

use naga::{
    Binding, Block, BuiltIn, Expression, Function, FunctionArgument, GlobalVariable, Handle, Literal, Module, Scalar,
    Span, Statement, TypeInner, VectorSize,
};

/// A vertex attribute that the shader reads.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Attribute {
    /// Its name in the student's file.
    pub name: String,
    /// Its location in the module.
    pub location: u32,
    /// Its GLSL type, such as `vec4`.
    pub ty: String,
    /// What its components are, where it is a scalar or vector.
    pub kind: Option<naga::ScalarKind>,
    /// Bytes of a component.
    pub width: u8,
}

/// Gives attributes the locations of their places in the interface, and the outputs location 0.
pub(in crate::translate) fn locate(module: &mut Module, interface: &crate::translate::Interface) {
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

/// Keeps the inputs that the program feeds and takes the others away. Gives the attributes and the
/// index of the argument that carries `instance_index`.
pub(super) fn feed(module: &mut Module, function: &mut Function, inputs: &[&str]) -> (Vec<Attribute>, u32) {
    let arguments = std::mem::take(&mut function.arguments);
    let mut attributes = Vec::new();
    let mut kept = Vec::new();
    for argument in &arguments {
        let keep = match (&argument.binding, &argument.name) {
            (Some(Binding::Location { .. }), Some(name)) if inputs.contains(&name.as_str()) => {
                let inner = &module.types[argument.ty].inner;
                attributes.push(Attribute {
                    name: name.clone(),
                    location: attributes.len() as u32,
                    ty: super::super::interface::type_name(inner),
                    kind: inner.scalar_kind(),
                    width: inner.scalar().map_or(0, |scalar| scalar.width),
                });
                true
            }
            (Some(Binding::BuiltIn(BuiltIn::VertexIndex)), _) => true,
            _ => false,
        };
        kept.push(keep.then(|| {
            let mut argument = argument.clone();
            if let (Some(Binding::Location { location, .. }), Some(attribute)) =
                (&mut argument.binding, attributes.last())
            {
                // The compiler's automatic locations may collide with the student's own.
                *location = attribute.location;
            }
            function.arguments.push(argument);
            function.arguments.len() as u32 - 1
        }));
    }
    let u32_type = super::types::scalar_type(module, Scalar::U32);
    let instance = function.arguments.len() as u32;
    function.arguments.push(FunctionArgument {
        name: None,
        ty: u32_type,
        binding: Some(Binding::BuiltIn(BuiltIn::InstanceIndex)),
    });

    let mut dropped = Vec::new();
    for (handle, expression) in function.expressions.iter_mut() {
        if let Expression::FunctionArgument(index) = expression {
            let index = *index as usize;
            match kept[index] {
                Some(new) => *expression = Expression::FunctionArgument(new),
                None => {
                    *expression = Expression::ZeroValue(arguments[index].ty);
                    dropped.push((handle, index));
                }
            }
        }
    }
    drop_stores(module, function, &arguments, &dropped);
    (attributes, instance)
}

/// Removes the copies of dropped inputs; a generic attribute that nothing feeds is (0, 0, 0, 1).
fn drop_stores(
    module: &mut Module,
    function: &mut Function,
    arguments: &[FunctionArgument],
    dropped: &[(Handle<Expression>, usize)],
) {
    let is_dropped = |value: &Handle<Expression>| {
        let source = match function.expressions[*value] {
            Expression::As { expr, .. } => expr,
            _ => *value,
        };
        dropped.iter().find(|(handle, _)| *handle == source).map(|(_, index)| *index)
    };
    let mut body = Block::new();
    let mut defaults = Vec::new();
    for (statement, span) in std::mem::take(&mut function.body).span_into_iter() {
        if let Statement::Store { pointer, value } = &statement
            && let Some(index) = is_dropped(value)
        {
            if let Expression::GlobalVariable(global) = function.expressions[*pointer]
                && matches!(arguments[index].binding, Some(Binding::Location { .. }))
            {
                defaults.push(global);
            }
            continue;
        }
        body.push(statement, span);
    }
    function.body = body;
    for global in defaults {
        unset_attribute(module, global);
    }
}

fn unset_attribute(module: &mut Module, global: Handle<GlobalVariable>) {
    let ty = module.global_variables[global].ty;
    let TypeInner::Vector { size: VectorSize::Quad, scalar } = module.types[ty].inner else {
        return;
    };
    let Some(one) = Literal::one(scalar) else {
        return;
    };
    let Some(zero) = Literal::zero(scalar) else {
        return;
    };
    let components = [zero, zero, zero, one]
        .map(|literal| module.global_expressions.append(Expression::Literal(literal), Span::UNDEFINED))
        .to_vec();
    let init = module.global_expressions.append(Expression::Compose { ty, components }, Span::UNDEFINED);
    module.global_variables[global].init = Some(init);
}
