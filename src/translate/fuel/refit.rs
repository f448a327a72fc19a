//! Puts the meters into the loops of a function.

use super::{LoopFuel, MAX_TURNS, OPERATIONS_PER_UNIT, holds_loop, lines::first_line};
use crate::translate::build::Build;
use crate::translate::spirv::LineTable;
use naga::{Arena, BinaryOperator, Block, Expression, Function, Handle, LocalVariable, Span, Statement, Type};
use std::collections::HashSet;

/// Puts meters into the loops of one function.
pub(super) struct Refit<'a> {
    pub u32_type: Handle<Type>,
    pub used: Handle<Expression>,
    pub ran_out: Handle<Expression>,
    pub locals: &'a mut Arena<LocalVariable>,
    /// Of each loop of the function, what a turn costs.
    pub operations: &'a [u64],
    pub known: Option<&'a Vec<Option<u32>>>,
    pub lines: &'a LineTable,
    pub looping: &'a HashSet<Handle<Function>>,
    /// The counters of the loops around the current statement.
    pub open: Vec<Handle<Expression>>,
    /// How many meters there were before this function's.
    pub first: usize,
    pub meters: &'a mut Vec<LoopFuel>,
}

impl Refit<'_> {
    pub fn block(&mut self, expressions: &mut Arena<Expression>, block: Block) -> Block {
        let mut refitted = Block::new();
        for (statement, span) in block.span_into_iter() {
            let statement = match statement {
                Statement::Block(inner) => Statement::Block(self.block(expressions, inner)),
                Statement::If { condition, accept, reject } => Statement::If {
                    condition,
                    accept: self.block(expressions, accept),
                    reject: self.block(expressions, reject),
                },
                Statement::Switch { selector, mut cases } => {
                    for case in &mut cases {
                        case.body = self.block(expressions, std::mem::take(&mut case.body));
                    }
                    Statement::Switch { selector, cases }
                }
                Statement::Loop { body, continuing, break_if } => {
                    let metered = self.metered(expressions, body, continuing, break_if);
                    metered.span_into_iter().for_each(|(statement, span)| refitted.push(statement, span));
                    continue;
                }
                Statement::Return { .. } => {
                    let mut build = Build::new(expressions);
                    self.open.iter().for_each(|counter| add(&mut build, self.used, *counter));
                    build.finish().span_into_iter().for_each(|(statement, span)| refitted.push(statement, span));
                    statement
                }
                other => other,
            };
            refitted.push(statement, span);
        }
        refitted
    }

    /// The loop with its meter, and what stands around it.
    fn metered(
        &mut self,
        expressions: &mut Arena<Expression>,
        body: Block,
        continuing: Block,
        break_if: Option<Handle<Expression>>,
    ) -> Block {
        let index = self.meters.len() - self.first;
        let units = 1 + self.operations.get(index).copied().unwrap_or(0) / OPERATIONS_PER_UNIT;
        let units = u32::try_from(units).unwrap_or(MAX_TURNS).min(MAX_TURNS);
        let line = match self.known {
            Some(known) => known.get(index).copied().flatten(),
            None => first_line(&body, expressions, self.lines),
        };
        self.meters.push(LoopFuel { line, turns: MAX_TURNS / units });
        let number = self.meters.len() as u32;
        let counter = LocalVariable { name: None, ty: self.u32_type, init: None };
        let counter = self.locals.append(counter, Span::UNDEFINED);
        let counter = expressions.append(Expression::LocalVariable(counter), Span::UNDEFINED);

        let sees_sum = holds_loop(&body, self.looping);
        let mut turn = Build::new(expressions);
        take_fuel(&mut turn, counter, units);
        if sees_sum {
            let (sum, last) = (turn.load(self.used), turn.number(MAX_TURNS));
            leave_above(&mut turn, sum, last);
        }
        let mut metered = turn.finish();
        self.open.push(counter);
        metered.append(&mut self.block(expressions, body));
        let continuing = self.block(expressions, continuing);
        self.open.pop();

        let mut build = Build::new(expressions);
        let zero = build.number(0);
        build.store(counter, zero);
        build.push(Statement::Loop { body: metered, continuing, break_if });
        add(&mut build, self.used, counter);
        self.tell(&mut build, number);
        build.finish()
    }

    /// Behind a loop: says so where the fuel is used up.
    fn tell(&self, build: &mut Build<'_>, number: u32) {
        let [number, zero, last] = [number, 0, MAX_TURNS].map(|n| build.number(n));
        let sum = build.load(self.used);
        let is_over = build.binary(BinaryOperator::Greater, sum, last);
        let told = build.load(self.ran_out);
        let is_first = build.binary(BinaryOperator::Equal, told, zero);
        let is_told = build.binary(BinaryOperator::LogicalAnd, is_over, is_first);
        let told = build.node(Expression::Select { condition: is_told, accept: number, reject: told });
        build.store(self.ran_out, told);
    }
}

/// `sum += counter`
fn add(build: &mut Build<'_>, sum: Handle<Expression>, counter: Handle<Expression>) {
    let (before, turns) = (build.load(sum), build.load(counter));
    let after = build.binary(BinaryOperator::Add, before, turns);
    build.store(sum, after);
}

/// What a loop does first in each turn: takes fuel, and leaves where there is none.
fn take_fuel(build: &mut Build<'_>, counter: Handle<Expression>, units: u32) {
    let [units, last] = [units, MAX_TURNS].map(|n| build.number(n));
    let before = build.load(counter);
    let after = build.binary(BinaryOperator::Add, before, units);
    build.store(counter, after);
    leave_above(build, after, last);
}

/// `if (value > last) break;`
pub(super) fn leave_above(build: &mut Build<'_>, value: Handle<Expression>, last: Handle<Expression>) {
    let is_over = build.binary(BinaryOperator::Greater, value, last);
    build.when(is_over, |build| build.push(Statement::Break));
}
