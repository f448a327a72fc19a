//! Watches for what GLSL leaves undefined: `pow` of a negative base (GLSL 4.10, section 8.2).
//!
//! A driver may give NaN, which `max` or a comparison then hides, or some number; another driver gives another picture.
//! So the module notes it where it happens, and the capture's header tells. Whether the colour depends on it is seen
//! when the shader runs once more with such results poisoned ([`super::Shader::poisoned`]).

use super::build::Build;
use super::spirv::{LineTable, NEGATIVE};
use naga::front::Typifier;
use naga::proc::ResolveContext;
use naga::{
    AddressSpace, Arena, BinaryOperator, Block, Expression, Function, GlobalVariable, Handle, Literal, MathFunction,
    MemoryDecorations, Module, RelationalFunction, Scalar, Span, Statement, SwitchCase, Type, TypeInner, VectorSize,
};
use std::collections::HashMap;

/// What the variable holds where the line is not known.
pub const NO_LINE: u32 = u32::MAX;

/// Each `pow` of a function: its base, and how many components that has.
type Powers = HashMap<Handle<Expression>, (Handle<Expression>, Option<VectorSize>)>;

/// Adds the watch. Gives the variable that holds, after `main`, the line of such a `pow` (or [`NO_LINE`]); 0 if none was
/// met. `None` where the shader raises nothing to a power.
pub(super) fn watch(module: &mut Module, lines: &LineTable) -> Option<Handle<GlobalVariable>> {
    let all: Vec<Powers> = module.functions.iter().map(|(_, function)| powers(module, function)).collect();
    if all.iter().all(Powers::is_empty) {
        return None;
    }
    let ty = module.types.insert(Type { name: None, inner: TypeInner::Scalar(Scalar::U32) }, Span::UNDEFINED);
    let met = module.global_variables.append(
        GlobalVariable {
            name: Some("undefined_power".into()),
            space: AddressSpace::Private,
            binding: None,
            ty,
            init: None,
            memory_decorations: MemoryDecorations::empty(),
        },
        Span::UNDEFINED,
    );
    for ((_, function), powers) in module.functions.iter_mut().zip(&all).filter(|(_, powers)| !powers.is_empty()) {
        let body = std::mem::take(&mut function.body);
        let watch = UndefinedWatch { powers, lines, met };
        function.body = watch.block(body, &mut function.expressions);
    }
    Some(met)
}

/// The powers in f32; a base that `max` or `abs` keeps from being negative needs no watch.
fn powers(module: &Module, function: &Function) -> Powers {
    let mut types = Typifier::new();
    let context = ResolveContext::with_locals(module, &function.local_variables, &function.arguments);
    let expressions = &function.expressions;
    let power = |(handle, expression): (Handle<Expression>, &Expression)| {
        let Expression::Math { fun: MathFunction::Pow, arg, .. } = *expression else { return None };
        if is_kept_positive(module, expressions, arg) || types.grow(arg, expressions, &context).is_err() {
            return None;
        }
        match types.get(arg, &module.types) {
            TypeInner::Scalar(Scalar::F32) => Some((handle, (arg, None))),
            TypeInner::Vector { size, scalar: Scalar::F32 } => Some((handle, (arg, Some(*size)))),
            _ => None,
        }
    };
    expressions.iter().filter_map(power).collect()
}

fn is_kept_positive(module: &Module, expressions: &Arena<Expression>, base: Handle<Expression>) -> bool {
    let is_positive = |handle: Handle<Expression>| match expressions[handle] {
        Expression::Literal(Literal::F32(number)) => number >= 0.0,
        Expression::ZeroValue(_) => true,
        Expression::Constant(constant) => {
            let init = &module.global_expressions[module.constants[constant].init];
            matches!(init, Expression::Literal(Literal::F32(number)) if *number >= 0.0)
        }
        _ => false,
    };
    match expressions[base] {
        Expression::Math { fun: MathFunction::Max, arg, arg1: Some(other), .. } => {
            is_positive(arg) || is_positive(other)
        }
        Expression::Math { fun: MathFunction::Clamp, arg1: Some(least), .. } => is_positive(least),
        Expression::Math { fun: MathFunction::Abs | MathFunction::Saturate | MathFunction::Length, .. } => true,
        _ => is_positive(base),
    }
}

struct UndefinedWatch<'a> {
    powers: &'a Powers,
    lines: &'a LineTable,
    met: Handle<GlobalVariable>,
}

impl UndefinedWatch<'_> {
    /// The block with a note behind the evaluation of each power.
    fn block(&self, block: Block, expressions: &mut Arena<Expression>) -> Block {
        let mut out = Block::new();
        for (statement, span) in block.span_into_iter() {
            let statement = self.within(statement, expressions);
            let evaluated: Vec<Handle<Expression>> = match &statement {
                Statement::Emit(range) => range.clone().filter(|handle| self.powers.contains_key(handle)).collect(),
                _ => Vec::new(),
            };
            out.push(statement, span);
            for power in evaluated {
                out.extend_block(self.note(power, expressions));
            }
        }
        out
    }

    fn within(&self, statement: Statement, expressions: &mut Arena<Expression>) -> Statement {
        match statement {
            Statement::Block(block) => Statement::Block(self.block(block, expressions)),
            Statement::If { condition, accept, reject } => Statement::If {
                condition,
                accept: self.block(accept, expressions),
                reject: self.block(reject, expressions),
            },
            Statement::Switch { selector, cases } => Statement::Switch {
                selector,
                cases: cases
                    .into_iter()
                    .map(|case| SwitchCase { body: self.block(case.body, expressions), ..case })
                    .collect(),
            },
            Statement::Loop { body, continuing, break_if } => Statement::Loop {
                body: self.block(body, expressions),
                continuing: self.block(continuing, expressions),
                break_if,
            },
            other => other,
        }
    }

    fn note(&self, power: Handle<Expression>, expressions: &mut Arena<Expression>) -> Block {
        let line = self.lines.line(expressions.get_span(power)).unwrap_or(NO_LINE);
        let (base, size) = self.powers[&power];
        let mut build = Build::new(expressions);
        let mut limit = build.leaf(Expression::Literal(Literal::F32(NEGATIVE)));
        if let Some(size) = size {
            limit = build.node(Expression::Splat { size, value: limit });
        }
        let mut negative = build.binary(BinaryOperator::Less, base, limit);
        if size.is_some() {
            negative = build.node(Expression::Relational { fun: RelationalFunction::Any, argument: negative });
        }
        build.when(negative, |build| {
            let met = build.leaf(Expression::GlobalVariable(self.met));
            let line = build.number(line);
            build.store(met, line);
        });
        build.finish()
    }
}
