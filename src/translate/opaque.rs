//! Keeps the driver from compiling the shader anew for every draw.
//!
//! The software driver looks for branches whose condition depends on uniforms alone, and for each new value of these
//! uniforms compiles a shader of its own in which they are constants. Every batch has its own matrices, so a harmless
//! `if (mw[3].z < 0.0)` makes fifty compilations of one: measured, 3.5 s for 0.15 s. Such a condition is joined here
//! with a value from the capture's header that is always true, and of which the driver's compiler knows nothing.

use super::build::Build;
use super::entry::is_input;
use super::spirv::{Io, is_ours};
use naga::{
    AddressSpace, Arena, BinaryOperator, Block, Expression, Function, GlobalVariable, Handle, LocalVariable, Module,
    Scalar, ScalarKind, Span, Statement, SwitchValue, Type, TypeInner,
};
use std::collections::{HashMap, HashSet};

/// What a value depends on; of two operands the greater decides.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum ValueSource {
    Constants,
    /// Uniforms, as far as is known here.
    Uniforms,
    /// Attributes: the driver leaves such a condition alone.
    Attributes,
}

/// Joins the conditions that depend on uniforms alone with a variable that holds 0. Gives the variable, which the entry
/// point has to fill from the capture's header; `None` where there is no such condition.
pub(super) fn hide_conditions(module: &mut Module, io: &[Io]) -> Option<Handle<GlobalVariable>> {
    let u32_type = module.types.insert(Type { name: None, inner: TypeInner::Scalar(Scalar::U32) }, Span::UNDEFINED);
    let mut inputs = inputs(&module.entry_points[0].function);
    inputs.extend(module.global_variables.iter().filter(|(_, of)| is_input(io, of)).map(|(handle, _)| handle));
    let zero = GlobalVariable {
        name: Some("zero".into()),
        space: AddressSpace::Private,
        binding: None,
        ty: u32_type,
        init: None,
        memory_decorations: naga::MemoryDecorations::empty(),
    };
    let zero = module.global_variables.append(zero, Span::UNDEFINED);
    let mut is_used = false;
    // What a lookup branches by is known where it stands, or read from a buffer: the driver is to leave out what it does not need.
    for (_, function) in module.functions.iter_mut().filter(|(_, function)| !is_ours(function)) {
        let sources = sources(function, &inputs);
        let body = std::mem::take(&mut function.body);
        let mut hide = Hide { sources, zero, is_used: false };
        function.body = hide.block(&mut function.expressions, body);
        is_used |= hide.is_used;
    }
    is_used.then_some(zero)
}

/// The variables that the entry point copies its arguments to.
fn inputs(entry: &Function) -> HashSet<Handle<GlobalVariable>> {
    let is_argument = |value: Handle<Expression>| match entry.expressions[value] {
        Expression::FunctionArgument(_) => true,
        Expression::As { expr, .. } => matches!(entry.expressions[expr], Expression::FunctionArgument(_)),
        _ => false,
    };
    let copied = entry.body.iter().filter_map(|statement| match *statement {
        Statement::Store { pointer, value } if is_argument(value) => match entry.expressions[pointer] {
            Expression::GlobalVariable(variable) => Some(variable),
            _ => None,
        },
        _ => None,
    });
    copied.collect()
}

/// What each expression of the function depends on.
fn sources(function: &Function, inputs: &HashSet<Handle<GlobalVariable>>) -> Vec<ValueSource> {
    let mut locals: HashMap<Handle<LocalVariable>, ValueSource> = HashMap::new();
    loop {
        let mut sources = Vec::with_capacity(function.expressions.len());
        for (_, expression) in function.expressions.iter() {
            sources.push(source(expression, &sources, &locals, inputs));
        }
        let before = locals.clone();
        super::gate::each_statement(&function.body, &mut |statement, _| {
            let mut raise = |pointer, source: ValueSource| {
                if let Some(local) = root(function, pointer) {
                    let known = locals.entry(local).or_insert(ValueSource::Constants);
                    *known = source.max(*known);
                }
            };
            match statement {
                Statement::Store { pointer, value } => {
                    raise(*pointer, sources[value.index()].max(sources[pointer.index()]));
                }
                Statement::Call { arguments, .. } => {
                    arguments.iter().for_each(|argument| raise(*argument, ValueSource::Uniforms));
                }
                _ => {}
            }
        });
        if before == locals {
            return sources;
        }
    }
}

fn source(
    expression: &Expression,
    sources: &[ValueSource],
    locals: &HashMap<Handle<LocalVariable>, ValueSource>,
    inputs: &HashSet<Handle<GlobalVariable>>,
) -> ValueSource {
    let of = |handle: &Handle<Expression>| sources[handle.index()];
    match expression {
        Expression::Literal(_) | Expression::Constant(_) | Expression::ZeroValue(_) => ValueSource::Constants,
        Expression::GlobalVariable(variable) if inputs.contains(variable) => ValueSource::Attributes,
        Expression::LocalVariable(local) => locals.get(local).copied().unwrap_or(ValueSource::Constants),
        Expression::Compose { components, .. } => components.iter().map(of).max().unwrap_or(ValueSource::Constants),
        Expression::Access { base, index } => of(base).max(of(index)),
        Expression::AccessIndex { base, .. } => of(base),
        Expression::Splat { value, .. } => of(value),
        Expression::Swizzle { vector, .. } => of(vector),
        Expression::Load { pointer } => of(pointer),
        Expression::Unary { expr, .. } | Expression::As { expr, .. } => of(expr),
        Expression::Relational { argument, .. } => of(argument),
        Expression::Binary { left, right, .. } => of(left).max(of(right)),
        Expression::Select { condition, accept, reject } => of(condition).max(of(accept)).max(of(reject)),
        Expression::Math { arg, arg1, arg2, arg3, .. } => [Some(arg), arg1.as_ref(), arg2.as_ref(), arg3.as_ref()]
            .into_iter()
            .flatten()
            .map(of)
            .max()
            .unwrap_or(of(arg)),
        _ => ValueSource::Uniforms,
    }
}

/// The local variable that a pointer points into.
fn root(function: &Function, mut pointer: Handle<Expression>) -> Option<Handle<LocalVariable>> {
    loop {
        match function.expressions[pointer] {
            Expression::LocalVariable(local) => return Some(local),
            Expression::Access { base, .. } | Expression::AccessIndex { base, .. } => pointer = base,
            _ => return None,
        }
    }
}

struct Hide {
    sources: Vec<ValueSource>,
    zero: Handle<GlobalVariable>,
    is_used: bool,
}

impl Hide {
    fn block(&mut self, expressions: &mut Arena<Expression>, block: Block) -> Block {
        let mut hidden = Block::new();
        for (statement, span) in block.span_into_iter() {
            let statement = match statement {
                Statement::Block(inner) => Statement::Block(self.block(expressions, inner)),
                Statement::If { condition, accept, reject } => {
                    let condition = self.condition(expressions, &mut hidden, condition);
                    let accept = self.block(expressions, accept);
                    Statement::If { condition, accept, reject: self.block(expressions, reject) }
                }
                Statement::Switch { selector, mut cases } => {
                    // Where every label stands beside `default`, nothing is chosen, and nothing tells the type.
                    let is_signed = cases.iter().find_map(|case| match case.value {
                        SwitchValue::I32(_) => Some(true),
                        SwitchValue::U32(_) => Some(false),
                        SwitchValue::Default => None,
                    });
                    let selector = match is_signed {
                        Some(is_signed) => self.selector(expressions, &mut hidden, selector, is_signed),
                        None => selector,
                    };
                    for case in &mut cases {
                        case.body = self.block(expressions, std::mem::take(&mut case.body));
                    }
                    Statement::Switch { selector, cases }
                }
                Statement::Loop { body, continuing, break_if } => {
                    let body = self.block(expressions, body);
                    let mut continuing = self.block(expressions, continuing);
                    let break_if = break_if.map(|last| self.condition(expressions, &mut continuing, last));
                    Statement::Loop { body, continuing, break_if }
                }
                other => other,
            };
            hidden.push(statement, span);
        }
        hidden
    }

    /// `condition && zero == 0`, evaluated at the end of `block`.
    fn condition(
        &mut self,
        expressions: &mut Arena<Expression>,
        block: &mut Block,
        condition: Handle<Expression>,
    ) -> Handle<Expression> {
        if self.sources[condition.index()] != ValueSource::Uniforms {
            return condition;
        }
        let mut build = Build::new(expressions);
        let zero = self.load(&mut build);
        let nothing = build.number(0);
        let is_zero = build.binary(BinaryOperator::Equal, zero, nothing);
        let hidden = build.binary(BinaryOperator::LogicalAnd, condition, is_zero);
        block.append(&mut build.finish());
        hidden
    }

    /// `selector + zero`, evaluated at the end of `block`.
    fn selector(
        &mut self,
        expressions: &mut Arena<Expression>,
        block: &mut Block,
        selector: Handle<Expression>,
        is_signed: bool,
    ) -> Handle<Expression> {
        if self.sources[selector.index()] != ValueSource::Uniforms {
            return selector;
        }
        let mut build = Build::new(expressions);
        let mut zero = self.load(&mut build);
        if is_signed {
            zero = build.node(Expression::As { expr: zero, kind: ScalarKind::Sint, convert: None });
        }
        let hidden = build.binary(BinaryOperator::Add, selector, zero);
        block.append(&mut build.finish());
        hidden
    }

    fn load(&mut self, build: &mut Build<'_>) -> Handle<Expression> {
        self.is_used = true;
        let zero = build.leaf(Expression::GlobalVariable(self.zero));
        build.load(zero)
    }
}
