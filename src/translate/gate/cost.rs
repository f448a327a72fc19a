//! What the functions of a module cost, each with all that it calls.
//!
//! The driver inlines every call and takes a local array apart into its elements, so a short file can be a long
//! program: what counts is the size after both.

use super::bounds::MAX_SCALARS;
use super::weight::{BRANCH, CALL, COMPILED_LOOK_UP, INDEXED_SCALAR, LOOK_UP, LOOP, LOOP_IN_LOOP, scalars, weight};
use crate::translate::LineTable;
use crate::translate::entry::AttributePart;
use crate::translate::spirv::is_ours;
use naga::front::Typifier;
use naga::proc::ResolveContext;
use naga::{Block, Expression, Function, Handle, Module, Span, Statement, TypeInner};
use std::collections::{BTreeMap, HashMap};

/// Numbers of a position.
const POSITION: u64 = 4;

/// What the functions of a module cost, each with all that it calls.
#[derive(Debug, Default)]
pub(in crate::translate) struct Costs {
    functions: HashMap<Handle<Function>, u64>,
    scalars: HashMap<Handle<Function>, u64>,
    /// How many loops there are in a call of each.
    loops: HashMap<Handle<Function>, u64>,
    /// What the entry point costs the driver that compiles it.
    pub(super) of_entry: u64,
    pub(super) scalars_of_entry: u64,
}

impl Costs {
    /// Adds up a module. A function stands behind those that it calls, or naga refuses the module.
    pub fn of(module: &Module) -> Self {
        let costs = Self::with(module, LOOK_UP);
        if !module.functions.iter().any(|(_, function)| is_ours(function)) {
            return costs;
        }
        Self { of_entry: Self::with(module, COMPILED_LOOK_UP).of_entry, ..costs }
    }

    /// The same where a lookup costs so much.
    fn with(module: &Module, look_up: u64) -> Self {
        let mut costs = Self::default();
        for (handle, function) in module.functions.iter() {
            let (operations, scalars) = costs.function(module, function);
            let operations = if is_ours(function) { operations.min(look_up) } else { operations };
            costs.functions.insert(handle, operations);
            costs.scalars.insert(handle, scalars);
            let loops = CostWalk { module, costs: &costs }.loops(&function.body);
            costs.loops.insert(handle, loops);
        }
        (costs.of_entry, costs.scalars_of_entry) = costs.function(module, &module.entry_points[0].function);
        costs
    }

    /// Adds what the entry point copies: each number of an input once, each of an output, and the position, when it is
    /// read and when it is handed over.
    pub fn copy(&mut self, inputs: &[AttributePart], outputs: &[AttributePart]) {
        let numbers = |parts: &[AttributePart]| parts.iter().map(|part| u64::from(part.attribute.size)).sum::<u64>();
        let position = if outputs.is_empty() { 0 } else { POSITION };
        let copied = numbers(inputs) + 2 * numbers(outputs) + position;
        self.of_entry = self.of_entry.saturating_add(copied);
    }

    fn function(&self, module: &Module, function: &Function) -> (u64, u64) {
        let walk = CostWalk { module, costs: self };
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
        let walk = CostWalk { module, costs: self };
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

pub(super) struct CostWalk<'a> {
    pub module: &'a Module,
    pub costs: &'a Costs,
}

impl CostWalk<'_> {
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
            // A structure of an array as a whole.
            let indexed = match *expression {
                Expression::Load { pointer } if matches!(own, TypeInner::Struct { .. }) => {
                    match function.expressions[pointer] {
                        Expression::Access { base, index } if !is_constant(index) => size(base),
                        _ => 0,
                    }
                }
                _ => 0,
            };
            weights.push(match *expression {
                Expression::Load { .. } if indexed > 0 => indexed.saturating_mul(INDEXED_SCALAR),
                Expression::Access { index, .. } if is_constant(index) => 1,
                _ => weight(self.module, expression, own, size(handle), &size),
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
                let inner = self.loops(body).saturating_add(self.loops(continuing)).saturating_mul(LOOP_IN_LOOP);
                block(body).saturating_add(block(continuing)).saturating_add(LOOP).saturating_add(inner)
            }
            Statement::Call { function, .. } => {
                self.costs.functions.get(function).copied().unwrap_or(0).saturating_add(CALL)
            }
            // The value's own weight has its size.
            Statement::Store { value, .. } => weights[value.index()].clamp(1, MAX_SCALARS),
            _ => 1,
        }
    }

    /// How many loops there are in a block and in what it calls.
    fn loops(&self, block: &Block) -> u64 {
        let mut found = 0_u64;
        each_statement(block, &mut |statement, _| {
            found = found.saturating_add(match statement {
                Statement::Loop { .. } => 1,
                Statement::Call { function, .. } => self.costs.loops.get(function).copied().unwrap_or(0),
                _ => 0,
            });
        });
        found
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
    pub fn heaviest(&self, entry: &Function, lines: &LineTable) -> Option<u32> {
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
