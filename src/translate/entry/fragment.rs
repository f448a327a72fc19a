//! The entry point of a fragment stage. Its colours go to the targets of their locations, as four numbers each.
//!
//! - A fragment that is discarded still tells what it met, before it ends.
//! - All fragments together have a bound of fuel as well: there are millions of them.
//! - Frames lie side by side in one texture, so what places a frame there is taken from `gl_FragCoord`.
//! - In a frame, alpha says what is painted, so that a colour that equals the background is not taken for it.

use super::header::{CaptureHeader, insert};
use super::inputs::feed;
use super::{AttributePart, Hooks};
use crate::translate::build::Build;
use crate::translate::fuel;
use naga::{
    BinaryOperator, Binding, Block, BuiltIn, Expression, Function, FunctionArgument, FunctionResult, Handle, Literal,
    LocalVariable, MathFunction, Module, Sampling, Scalar, ScalarKind, Span, Statement, StructMember, SwitchCase, Type,
    TypeInner, VectorSize,
};
use reference::interpreter::WindowCoordinates;

/// Colours beyond this are painted as if they were this: the driver's conversion to 8 bits goes through an `i32`, and
/// would make black of what that cannot hold.
const MOST: f32 = 1_048_576.0;

/// Gives the location of what is added to `gl_FragCoord`, where the stage reads that.
pub(super) fn rebuild(
    module: &mut Module,
    function: &mut Function,
    inputs: &[AttributePart],
    outputs: &[AttributePart],
    hooks: Option<&Hooks>,
    window: WindowCoordinates,
) -> Option<u32> {
    let header = hooks.map(|hooks| (hooks, CaptureHeader::declare(module, None)));
    let depth = depth(function);
    if let Some((hooks, header)) = &header {
        for (_, own) in module.functions.iter_mut() {
            let body = std::mem::take(&mut own.body);
            own.body = settled(&mut own.expressions, body, header, hooks);
        }
    }
    let place = function
        .arguments
        .iter()
        .position(|argument| matches!(argument.binding, Some(Binding::BuiltIn(BuiltIn::Position { .. }))));
    let shift = place.map(|place| (place as u32, shift_argument(module, function, inputs.len() as u32)));
    let fed = feed(function, inputs, true);
    let u32 = insert(module, TypeInner::Scalar(Scalar::U32));
    let turns = LocalVariable { name: None, ty: u32, init: None };
    let turns = function.local_variables.append(turns, Span::UNDEFINED);
    let [mut call, behind] = super::statements(function);
    let result = result(module, outputs, depth.is_some());
    let vec2 = insert(module, TypeInner::Vector { size: VectorSize::Bi, scalar: Scalar::F32 });
    let mut build = Build::new(&mut function.expressions);
    if let Some((place, shift)) = shift {
        // The copy of the argument to the student's variable becomes one of the sum.
        let sum = shifted(&mut build, [vec2, result.vectors[0]], place, shift, window);
        for (statement, _) in &mut call {
            if let Statement::Store { value, .. } = statement
                && build.is_argument(*value, place)
            {
                *value = sum;
            }
        }
    }
    let call = |build: &mut Build<'_>| {
        fed.into_iter().for_each(|(part, argument)| {
            let place = part.pointer(build);
            let value = build.leaf(Expression::FunctionArgument(argument));
            build.store(place, value);
        });
        build.append(call);
    };
    let is_frame = match &header {
        Some((hooks, header)) => {
            super::run(&mut build, hooks, header, turns, |build| {
                call(build);
                settle(build, header, hooks);
            });
            let capture = header.pointer(&mut build);
            let is_frame = header.is_frame(&mut build, capture);
            let one = build.number(1);
            Some(build.binary(BinaryOperator::Equal, is_frame, one))
        }
        None => {
            call(&mut build);
            None
        }
    };
    build.append(behind);
    let mut components: Vec<Handle<Expression>> =
        outputs.iter().map(|part| colour(&mut build, module_vec4(&result, part), part, is_frame)).collect();
    components.extend(depth);
    match result.ty {
        Some(ty) => {
            let value = build.node(Expression::Compose { ty, components });
            build.push(Statement::Return { value: Some(value) });
            function.body = build.finish();
            function.result = Some(FunctionResult { ty, binding: None });
        }
        None => {
            build.push(Statement::Return { value: None });
            function.body = build.finish();
            function.result = None;
        }
    }
    shift.map(|_| inputs.len() as u32)
}

/// What is returned: a structure, none where there is nothing, and the types of its vectors.
struct Returned {
    ty: Option<Handle<Type>>,
    vectors: [Handle<Type>; 3],
}

fn module_vec4(result: &Returned, part: &AttributePart) -> Handle<Type> {
    match part.attribute.kind {
        Some(ScalarKind::Sint) => result.vectors[1],
        Some(ScalarKind::Uint) => result.vectors[2],
        _ => result.vectors[0],
    }
}

fn result(module: &mut Module, outputs: &[AttributePart], has_depth: bool) -> Returned {
    let vectors = [Scalar::F32, Scalar::I32, Scalar::U32]
        .map(|scalar| insert(module, TypeInner::Vector { size: VectorSize::Quad, scalar }));
    let f32 = insert(module, TypeInner::Scalar(Scalar::F32));
    let returned = Returned { ty: None, vectors };
    let mut members: Vec<StructMember> = (0..)
        .zip(outputs)
        .map(|(at, part)| StructMember {
            name: None,
            ty: module_vec4(&returned, part),
            binding: Some(Binding::Location {
                location: part.attribute.location,
                interpolation: None,
                sampling: None,
                blend_src: None,
                per_primitive: false,
            }),
            offset: at * 16,
        })
        .collect();
    if has_depth {
        let offset = members.len() as u32 * 16;
        members.push(StructMember { name: None, ty: f32, binding: Some(Binding::BuiltIn(BuiltIn::FragDepth)), offset });
    }
    let span = (members.len() as u32 * 16).max(16);
    let ty = (!members.is_empty()).then(|| insert(module, TypeInner::Struct { members, span }));
    Returned { ty, ..returned }
}

/// The value of an output as four numbers: what is missing is 0, 0, 0 and 1.
fn colour(
    build: &mut Build<'_>,
    vec4: Handle<Type>,
    part: &AttributePart,
    is_frame: Option<Handle<Expression>>,
) -> Handle<Expression> {
    let place = part.pointer(build);
    let mut value = build.load(place);
    let literal = |number: u8| match part.attribute.kind {
        Some(ScalarKind::Sint) => Literal::I32(number.into()),
        Some(ScalarKind::Uint) => Literal::U32(number.into()),
        _ => Literal::F32(number.into()),
    };
    if part.attribute.size < 4 {
        let missing = [0, 0, 0, 1].map(|number| build.leaf(Expression::Literal(literal(number))));
        let missing = &missing[usize::from(part.attribute.size)..];
        let components = std::iter::once(value).chain(missing.iter().copied()).collect();
        value = build.node(Expression::Compose { ty: vec4, components });
    }
    if part.attribute.kind != Some(ScalarKind::Float) || part.attribute.location != 0 {
        return value;
    }
    // A fixed stage paints frames only, of values that are within bounds.
    let bounded = if is_frame.is_some() { bounded(build, value) } else { value };
    let one = build.leaf(Expression::Literal(Literal::F32(1.0)));
    let mut parts: Vec<_> = (0..3).map(|index| build.member(bounded, index)).collect();
    parts.push(one);
    let painted = build.node(Expression::Compose { ty: vec4, components: parts });
    match is_frame {
        Some(is_frame) => {
            let size = VectorSize::Quad;
            let condition = build.node(Expression::Splat { size, value: is_frame });
            build.node(Expression::Select { condition, accept: painted, reject: value })
        }
        None => painted,
    }
}

/// The colour within ±[`MOST`]; what is no number stays none.
fn bounded(build: &mut Build<'_>, value: Handle<Expression>) -> Handle<Expression> {
    let most = build.leaf(Expression::Literal(Literal::F32(MOST)));
    let most = build.node(Expression::Splat { size: VectorSize::Quad, value: most });
    let math =
        |build: &mut Build<'_>, fun, arg| build.node(Expression::Math { fun, arg, arg1: None, arg2: None, arg3: None });
    let size = math(build, MathFunction::Abs, value);
    let sign = math(build, MathFunction::Sign, value);
    let limit = build.binary(BinaryOperator::Multiply, sign, most);
    let condition = build.binary(BinaryOperator::Greater, size, most);
    build.node(Expression::Select { condition, accept: limit, reject: value })
}

/// The depth that naga's wrapper returns, where the stage writes one.
fn depth(function: &Function) -> Option<Handle<Expression>> {
    let result = function.result.as_ref()?;
    let is_depth = |binding: &Option<Binding>| *binding == Some(Binding::BuiltIn(BuiltIn::FragDepth));
    let returned = function.body.iter().rev().find_map(|statement| match statement {
        Statement::Return { value } => *value,
        _ => None,
    })?;
    // All other outputs are private variables.
    is_depth(&result.binding).then_some(returned)
}

/// The argument that carries what is added to `gl_FragCoord`.
fn shift_argument(module: &mut Module, function: &mut Function, location: u32) -> u32 {
    let ty = insert(module, TypeInner::Vector { size: VectorSize::Bi, scalar: Scalar::F32 });
    let binding = Binding::Location {
        location,
        interpolation: Some(naga::Interpolation::Flat),
        sampling: Some(Sampling::First),
        blend_src: None,
        per_primitive: false,
    };
    function.arguments.push(FunctionArgument { name: Some("shift".into()), ty, binding: Some(binding) });
    function.arguments.len() as u32 - 1
}

/// The place in the window, as four numbers.
fn shifted(
    build: &mut Build<'_>,
    [vec2, vec4]: [Handle<Type>; 2],
    place: u32,
    shift: u32,
    window: WindowCoordinates,
) -> Handle<Expression> {
    let [place, shift] = [place, shift].map(|argument| build.leaf(Expression::FunctionArgument(argument)));
    let parts = [0, 1].map(|axis| {
        let (at, by) = (build.member(place, axis), build.member(shift, axis));
        let is_turned = window.from_top && axis == 1;
        build.binary(if is_turned { BinaryOperator::Subtract } else { BinaryOperator::Add }, by, at)
    });
    let xy = build.node(Expression::Compose { ty: vec2, components: parts.to_vec() });
    let [z, w] = [2, 3].map(|axis| build.member(place, axis));
    build.node(Expression::Compose { ty: vec4, components: vec![xy, z, w] })
}

/// The block with a settlement before each end of a fragment.
fn settled(expressions: &mut naga::Arena<Expression>, block: Block, header: &CaptureHeader, hooks: &Hooks) -> Block {
    let mut out = Block::new();
    for (statement, span) in block.span_into_iter() {
        let mut inner = |block| settled(expressions, block, header, hooks);
        let statement = match statement {
            Statement::Block(block) => Statement::Block(inner(block)),
            Statement::If { condition, accept, reject } => {
                Statement::If { condition, accept: inner(accept), reject: inner(reject) }
            }
            Statement::Switch { selector, cases } => Statement::Switch {
                selector,
                cases: cases.into_iter().map(|case| SwitchCase { body: inner(case.body), ..case }).collect(),
            },
            Statement::Loop { body, continuing, break_if } => {
                Statement::Loop { body: inner(body), continuing: inner(continuing), break_if }
            }
            Statement::Kill => {
                let mut build = Build::new(expressions);
                settle(&mut build, header, hooks);
                out.extend_block(build.finish());
                Statement::Kill
            }
            other => other,
        };
        out.push(statement, span);
    }
    out
}

/// Tells what the fragment met, and adds its fuel to what all have spent.
fn settle(build: &mut Build<'_>, header: &CaptureHeader, hooks: &Hooks) {
    let capture = header.pointer(build);
    if let Some(undefined) = hooks.undefined {
        header.tell_undefined(build, capture, undefined);
    }
    if let Some(gauge) = &hooks.gauge {
        let spent = header.spent(build, capture);
        fuel::settle(build, gauge, capture, spent, header.u32);
    }
}
