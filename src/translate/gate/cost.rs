//! The look at the module: what it costs the driver to compile, and how much memory it asks for.
//!
//! The driver inlines every call and takes a local array apart into its elements, so a short file can be a long
//! program: what counts is the size after both.

use super::stopped;
use crate::diagnostic::Stage;
use crate::language::Text;
use crate::source::Source;
use crate::translate::interface::place;
use crate::translate::{Lines, Refusal};
use naga::front::Typifier;
use naga::proc::ResolveContext;
use naga::{
    AddressSpace, ArraySize, BinaryOperator, Block, Expression, Function, Handle, MathFunction, Module, Span,
    Statement, TypeInner,
};
use std::collections::{BTreeMap, HashMap};

/// Most operations on scalars that are compiled, all calls inlined; see the weights below.
///
/// Answers to the homework have 100 to 600. The driver's time grows with the square: 0.1 s more at 3,000,
/// 0.7 s at this bound, 8 s at four times it.
pub(super) const MAX_OPERATIONS: u64 = 10_000;

/// Most scalars in variables and arrays of the shader's own, all calls inlined: 64 KiB.
///
/// Compiling their initial values takes 0.1 s at this bound.
pub(super) const MAX_SCALARS: u64 = 16_384;

/// Most bytes of uniforms. OpenGL drivers have at most this much for a vertex shader.
pub(super) const MAX_UNIFORM_BYTES: u64 = 65_536;

// Weights: the driver's compile time of each, as a multiple of a scalar multiply-add's.

/// Reading or writing one element of an array at an index that is computed, for each scalar of the array: the driver
/// makes a ladder of branches of it. Measured: 512 scalars, 0.5 s; 1,024, 6 s.
const INDEXED_SCALAR: u64 = 20;
/// `pow`, `sin` and their like. Measured: 400 of `pow`, 0.6 s.
const TRANSCENDENTAL: u64 = 15;
/// Dividing integers, with the checks against zero and overflow.
const INTEGER_DIVISION: u64 = 6;
const BRANCH: u64 = 8;
/// Measured: 100 loops, 0.2 s; 400 loops, 3.4 s.
const LOOP: u64 = 50;
/// Measured: 1,000 calls, 0.2 s; 2,000 calls, 2.2 s.
const CALL: u64 = 10;

/// Refuses a module that costs too much.
pub(in crate::translate) fn check_module(
    module: &Module,
    costs: &Costs,
    lines: &Lines,
    source: &Source,
) -> Result<(), Refusal> {
    let entry = &module.entry_points[0].function;
    if costs.of_entry <= MAX_OPERATIONS {
        return check_variables(module, costs, source);
    }
    Err(stopped(
        Stage::Compile,
        Walk { module, costs }.heaviest(entry, lines),
        Text::new(
            format!(
                "the shader has about {} operations when all calls and array accesses are written out, and at most \
                 {MAX_OPERATIONS} are compiled (limit of the grader); this line has most of them",
                costs.of_entry
            ),
            format!(
                "関数呼び出しと配列の参照をすべて展開すると約 {} 個の演算になり、上限の {MAX_OPERATIONS} 個を超えます \
                 (採点システムの上限)。この行が最も多くを占めています",
                costs.of_entry
            ),
        ),
    ))
}

fn check_variables(module: &Module, costs: &Costs, source: &Source) -> Result<(), Refusal> {
    let globals = || module.global_variables.iter().map(|(_, variable)| variable);
    let uniform: u64 = globals()
        .filter(|variable| variable.space == AddressSpace::Uniform)
        .map(|variable| scalars(module, &module.types[variable.ty].inner) * 4)
        .fold(0, u64::saturating_add);
    if uniform > MAX_UNIFORM_BYTES {
        return Err(too_many_uniforms(uniform));
    }
    let private: u64 = globals()
        .filter(|variable| variable.space == AddressSpace::Private)
        .map(|variable| scalars(module, &module.types[variable.ty].inner))
        .fold(0, u64::saturating_add);
    let all = private.saturating_add(costs.scalars_of_entry);
    if all <= MAX_SCALARS {
        return Ok(());
    }
    let locals = module.functions.iter().flat_map(|(_, function)| function.local_variables.iter());
    let variables = globals()
        .filter(|variable| variable.space == AddressSpace::Private)
        .map(|variable| (&variable.name, variable.ty))
        .chain(locals.map(|(_, variable)| (&variable.name, variable.ty)));
    let largest = variables.max_by_key(|(_, ty)| scalars(module, &module.types[*ty].inner));
    let name = largest.and_then(|(name, _)| name.as_deref()).unwrap_or_default();
    Err(too_much_memory(all.saturating_mul(4), name, source))
}

pub(super) fn too_much_memory(bytes: u64, name: &str, source: &Source) -> Refusal {
    let limit = MAX_SCALARS * 4;
    // The compiler makes variables of its own, whose names say nothing.
    let is_known = source.words().any(|(_, word)| word == name);
    let (en, ja) = if is_known {
        (format!(": `{name}` is the largest"), format!("。最も大きい変数は `{name}` です"))
    } else {
        Default::default()
    };
    let message = Text::new(
        format!(
            "the variables of the shader, with those of all calls, need {bytes} bytes, and a vertex has at most \
             {limit} (memory limit of the grader){en}"
        ),
        format!(
            "変数に、呼び出すすべての関数の分も合わせて {bytes} バイト必要ですが、頂点 1 個あたり {limit} バイトまでです \
             (採点システムのメモリ上限){ja}"
        ),
    );
    Refusal::Stopped(vec![place(crate::diagnostic::Diagnostic::error(Stage::Compile, message), source, name)])
}

pub(super) fn too_many_uniforms(bytes: u64) -> Refusal {
    let message = Text::new(
        format!("the uniform variables need {bytes} bytes; OpenGL drivers have room for {MAX_UNIFORM_BYTES}"),
        format!(
            "uniform 変数に {bytes} バイト必要ですが、OpenGL のドライバで使えるのは {MAX_UNIFORM_BYTES} バイトまでです"
        ),
    );
    Refusal::Rejected(vec![crate::diagnostic::Diagnostic::error(Stage::Link, message)])
}

/// How many scalars a value of this type has.
fn scalars(module: &Module, ty: &TypeInner) -> u64 {
    let of = |ty| scalars(module, &module.types[ty].inner);
    match *ty {
        TypeInner::Vector { size, scalar } => size as u64 * width(scalar),
        TypeInner::Matrix { columns, rows, scalar } => columns as u64 * rows as u64 * width(scalar),
        TypeInner::Array { base, size: ArraySize::Constant(length), .. } => {
            of(base).saturating_mul(length.get().into())
        }
        TypeInner::Struct { ref members, .. } => {
            members.iter().map(|member| of(member.ty)).fold(0, u64::saturating_add)
        }
        TypeInner::Pointer { base, .. } => of(base),
        TypeInner::ValuePointer { size, scalar, .. } => size.map_or(1, |size| size as u64) * width(scalar),
        TypeInner::Scalar(scalar) => width(scalar),
        _ => 1,
    }
}

/// A double counts as two.
fn width(scalar: naga::Scalar) -> u64 {
    u64::from(scalar.width).div_ceil(4)
}

/// What the functions of a module cost, each with all that it calls.
#[derive(Debug, Default)]
pub(in crate::translate) struct Costs {
    functions: HashMap<Handle<Function>, u64>,
    scalars: HashMap<Handle<Function>, u64>,
    of_entry: u64,
    scalars_of_entry: u64,
}

impl Costs {
    /// Adds up a module. A function stands behind those that it calls, or naga refuses the module.
    pub fn of(module: &Module) -> Self {
        let mut costs = Self::default();
        for (handle, function) in module.functions.iter() {
            let (operations, scalars) = costs.function(module, function);
            costs.functions.insert(handle, operations);
            costs.scalars.insert(handle, scalars);
        }
        (costs.of_entry, costs.scalars_of_entry) = costs.function(module, &module.entry_points[0].function);
        costs
    }

    fn function(&self, module: &Module, function: &Function) -> (u64, u64) {
        let walk = Walk { module, costs: self };
        let own =
            function.local_variables.iter().map(|(_, variable)| scalars(module, &module.types[variable.ty].inner));
        let own = own.fold(0, u64::saturating_add);
        let called = walk.called(&function.body);
        let called = called.iter().filter_map(|callee| self.scalars.get(callee)).copied().fold(0, u64::saturating_add);
        // A variable's initial value is one store a scalar, which the driver mostly drops.
        let operations = walk.block(&walk.weights(function), &function.body).saturating_add(own / 16);
        (operations, own.saturating_add(called))
    }

    /// What a turn of each loop of a function costs, in the order in which the loops begin.
    pub fn loops(&self, module: &Module, function: &Function) -> Vec<u64> {
        let walk = Walk { module, costs: self };
        let mut weights = None;
        let mut found = Vec::new();
        each_statement(&function.body, &mut |statement, _| {
            if let Statement::Loop { body, continuing, .. } = statement {
                let weights = weights.get_or_insert_with(|| walk.weights(function));
                found.push(walk.block(weights, body).saturating_add(walk.block(weights, continuing)));
            }
        });
        found
    }
}

struct Walk<'a> {
    module: &'a Module,
    costs: &'a Costs,
}

impl Walk<'_> {
    /// What each expression of the function costs.
    fn weights(&self, function: &Function) -> Vec<u64> {
        let context = ResolveContext::with_locals(self.module, &function.local_variables, &function.arguments);
        let mut types = Typifier::new();
        let mut weights = Vec::with_capacity(function.expressions.len());
        for (handle, expression) in function.expressions.iter() {
            if types.grow(handle, &function.expressions, &context).is_err() {
                // naga refuses such a module when it is made into a pipeline.
                return vec![0; function.expressions.len()];
            }
            let size = |of: Handle<Expression>| scalars(self.module, types.get(of, &self.module.types));
            let is_constant = |of: Handle<Expression>| {
                matches!(function.expressions[of], Expression::Literal(_) | Expression::Constant(_))
            };
            let own = types.get(handle, &self.module.types);
            weights.push(match *expression {
                Expression::Access { index, .. } if is_constant(index) => 1,
                _ => weight(expression, own, size(handle), &size),
            });
        }
        weights
    }

    fn block(&self, weights: &[u64], block: &Block) -> u64 {
        block.iter().map(|statement| self.statement(weights, statement)).fold(0, u64::saturating_add)
    }

    fn statement(&self, weights: &[u64], statement: &Statement) -> u64 {
        let block = |block| self.block(weights, block);
        match statement {
            Statement::Emit(range) => {
                range.clone().map(|expression| weights[expression.index()]).fold(0, u64::saturating_add)
            }
            Statement::Block(inner) => block(inner),
            Statement::If { accept, reject, .. } => block(accept).saturating_add(block(reject)).saturating_add(BRANCH),
            Statement::Switch { cases, .. } => {
                cases.iter().map(|case| block(&case.body).saturating_add(BRANCH)).fold(0, u64::saturating_add)
            }
            Statement::Loop { body, continuing, .. } => {
                block(body).saturating_add(block(continuing)).saturating_add(LOOP)
            }
            Statement::Call { function, .. } => {
                self.costs.functions.get(function).copied().unwrap_or(0).saturating_add(CALL)
            }
            // The value's own weight has its size.
            Statement::Store { value, .. } => weights[value.index()].clamp(1, MAX_SCALARS),
            _ => 1,
        }
    }

    fn called(&self, block: &Block) -> Vec<Handle<Function>> {
        let mut found = Vec::new();
        each_statement(block, &mut |statement, _| {
            if let Statement::Call { function, .. } = statement {
                found.push(*function);
            }
        });
        found
    }

    /// The line of the shader's `main` whose calls and expressions cost most.
    fn heaviest(&self, entry: &Function, lines: &Lines) -> Option<u32> {
        let main = self.called(&entry.body).into_iter().next_back();
        let function = main.map_or(entry, |main| &self.module.functions[main]);
        let weights = self.weights(function);
        let mut costs: BTreeMap<u32, u64> = BTreeMap::new();
        let mut consider = |cost, span| {
            if let Some(line) = lines.line(span) {
                let sum = costs.entry(line).or_default();
                *sum = sum.saturating_add(cost);
            }
        };
        each_statement(&function.body, &mut |statement, span| match statement {
            Statement::Emit(range) => {
                for expression in range.clone() {
                    consider(weights[expression.index()], function.expressions.get_span(expression));
                }
            }
            Statement::Call { .. } => consider(self.statement(&weights, statement), span),
            _ => {}
        });
        costs.into_iter().max_by_key(|(_, cost)| *cost).map(|(line, _)| line)
    }
}

/// Visits the statements of a block and of all blocks in it.
pub(in crate::translate) fn each_statement(block: &Block, visit: &mut dyn FnMut(&Statement, Span)) {
    for (statement, span) in block.span_iter() {
        visit(statement, *span);
        match statement {
            Statement::Block(inner) => each_statement(inner, visit),
            Statement::If { accept, reject, .. } => {
                each_statement(accept, visit);
                each_statement(reject, visit);
            }
            Statement::Switch { cases, .. } => cases.iter().for_each(|case| each_statement(&case.body, visit)),
            Statement::Loop { body, continuing, .. } => {
                each_statement(body, visit);
                each_statement(continuing, visit);
            }
            _ => {}
        }
    }
}

/// What an expression costs whose value has `own` scalars; `size` gives the scalars of its operands.
fn weight(expression: &Expression, ty: &TypeInner, own: u64, size: &dyn Fn(Handle<Expression>) -> u64) -> u64 {
    let is_integer = !matches!(ty.scalar_kind(), Some(naga::ScalarKind::Float));
    match *expression {
        Expression::Access { base, .. } => match ty.pointer_space() {
            Some(AddressSpace::Uniform) => 1,
            _ => size(base).saturating_mul(INDEXED_SCALAR),
        },
        // Two matrices: a dot product of one's row and the other's column for each scalar.
        Expression::Binary { op: BinaryOperator::Multiply, left, right } if size(left).max(size(right)) > 4 => {
            own.saturating_mul(4)
        }
        Expression::Binary { op: BinaryOperator::Divide | BinaryOperator::Modulo, .. } if is_integer => {
            own.saturating_mul(INTEGER_DIVISION)
        }
        Expression::Math { fun, arg, .. } => own.max(size(arg)).saturating_mul(math(fun)),
        Expression::AccessIndex { .. } | Expression::CallResult(_) => 1,
        _ => own,
    }
}

fn math(fun: MathFunction) -> u64 {
    use MathFunction as F;
    match fun {
        F::Abs | F::Min | F::Max | F::Floor | F::Ceil | F::Fract | F::Fma | F::Sqrt | F::InverseSqrt => 1,
        F::Sin | F::Cos | F::Tan | F::Asin | F::Acos | F::Atan | F::Atan2 | F::Sinh | F::Cosh | F::Tanh => {
            TRANSCENDENTAL
        }
        F::Asinh | F::Acosh | F::Atanh | F::Pow | F::Exp | F::Exp2 | F::Log | F::Log2 => TRANSCENDENTAL,
        F::Inverse | F::Determinant => 12,
        _ => 4,
    }
}
