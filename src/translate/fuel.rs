//! Fuel: every turn of a loop takes some, and a vertex that has none left leaves its loops.
//!
//! The software driver cuts a shader's loops silently after 65,535 turns in all, and draws a wrong picture. So the
//! module counts the turns itself and says which loop was running when the count reached its bound.
//!
//! Each loop counts its own turns from 0 against a constant, and adds them up behind its end: so a driver that unrolls
//! a short loop finds the count superfluous and drops it. (A count that goes on from loop to loop turns 100 unrolled
//! loops into branches that take half a minute to compile.) Only a loop around other loops looks at the sum.
//!
//! Straight code needs no fuel: [`super::gate`] bounds how much of it there is, all calls inlined.

use super::build::Build;
use super::gate::{Costs, each_statement};
use super::spirv::{self, Lines, op};
use crate::diagnostic::{Diagnostic, Stage};
use crate::language::Text;
use naga::{
    AddressSpace, Arena, BinaryOperator, Block, Expression, Function, GlobalVariable, Handle, LocalVariable, Module,
    Scalar, Span, Statement, Type, TypeInner,
};
use std::collections::{HashMap, HashSet};

/// Turns that the loops of a shader may take for one vertex, in all, where a turn is short.
///
/// The driver cuts at 65,535. Answers to the homework take up to 80 (`pow` by hand).
pub const MAX_TURNS: u32 = 50_000;

/// Operations (see [`super::gate`]) that one unit of fuel pays for: a turn of a longer body takes more units.
///
/// With it the longest program that stays within its fuel takes 1 s for all vertices of a grading.
const OPERATIONS_PER_UNIT: u64 = 100;

/// What a vertex reports where the driver cut its loops: it runs the vertices of a triangle side by side, and counts
/// the turns of all of them where they part.
pub const CUT: u32 = u32::MAX;

/// A loop that takes fuel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Meter {
    /// Its line in the student's file.
    pub line: Option<u32>,
    /// How many of its turns empty a full tank.
    pub turns: u32,
}

/// The counters that a module was given.
#[derive(Clone, Debug)]
pub(super) struct Gauge {
    /// Units taken so far.
    pub used: Handle<GlobalVariable>,
    /// The meter that took the last unit, counted from 1; 0 while there is fuel.
    pub ran_out: Handle<GlobalVariable>,
}

/// Has every loop of the module take fuel. Gives the loops, in the order in which [`Gauge::ran_out`] numbers them, and
/// the counters; none where there is no loop.
///
/// `words` are those that the module was made from, with their lines.
pub(super) fn meter(module: &mut Module, costs: &Costs, words: &[u32], lines: &Lines) -> (Vec<Meter>, Option<Gauge>) {
    let u32_type = module.types.insert(Type { name: None, inner: TypeInner::Scalar(Scalar::U32) }, Span::UNDEFINED);
    let mut counter = |name: &str| {
        let variable = GlobalVariable {
            name: Some(name.into()),
            space: AddressSpace::Private,
            binding: None,
            ty: u32_type,
            init: None,
            memory_decorations: naga::MemoryDecorations::empty(),
        };
        module.global_variables.append(variable, Span::UNDEFINED)
    };
    let gauge = Gauge { used: counter("fuel used"), ran_out: counter("ran out") };
    let headers = loop_lines(words);
    let mut meters = Vec::new();
    let mut looping = HashSet::new();
    let handles: Vec<_> = module.functions.iter().map(|(handle, _)| handle).collect();
    for handle in handles {
        if holds_loop(&module.functions[handle].body, &looping) {
            looping.insert(handle);
        }
        let operations = costs.loops(module, &module.functions[handle]);
        if operations.is_empty() {
            continue;
        }
        let function = &mut module.functions[handle];
        let known = function.name.as_deref().and_then(|name| headers.get(name));
        // Both are in the order of the source, unless the compiler dropped a loop that is never reached.
        let known = known.filter(|known| known.len() == operations.len());
        let body = std::mem::take(&mut function.body);
        let mut refit = Refit {
            u32_type,
            used: function.expressions.append(Expression::GlobalVariable(gauge.used), Span::UNDEFINED),
            ran_out: function.expressions.append(Expression::GlobalVariable(gauge.ran_out), Span::UNDEFINED),
            locals: &mut function.local_variables,
            operations: &operations,
            known,
            lines,
            looping: &looping,
            open: Vec::new(),
            first: meters.len(),
            meters: &mut meters,
        };
        function.body = refit.block(&mut function.expressions, body);
    }
    let gauge = (!meters.is_empty()).then_some(gauge);
    (meters, gauge)
}

/// Whether a loop stands in the block or in what it calls; `looping` are the functions that are known to have one.
fn holds_loop(block: &Block, looping: &HashSet<Handle<Function>>) -> bool {
    let mut found = false;
    each_statement(block, &mut |statement, _| match statement {
        Statement::Loop { .. } => found = true,
        Statement::Call { function, .. } => found |= looping.contains(function),
        _ => {}
    });
    found
}

/// Puts meters into the loops of one function.
struct Refit<'a> {
    u32_type: Handle<Type>,
    used: Handle<Expression>,
    ran_out: Handle<Expression>,
    locals: &'a mut Arena<LocalVariable>,
    /// Of each loop of the function, what a turn costs.
    operations: &'a [u64],
    known: Option<&'a Vec<Option<u32>>>,
    lines: &'a Lines,
    looping: &'a HashSet<Handle<Function>>,
    /// The counters of the loops around the current statement.
    open: Vec<Handle<Expression>>,
    /// How many meters there were before this function's.
    first: usize,
    meters: &'a mut Vec<Meter>,
}

impl Refit<'_> {
    fn block(&mut self, expressions: &mut Arena<Expression>, block: Block) -> Block {
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
        self.meters.push(Meter { line, turns: MAX_TURNS / units });
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
fn leave_above(build: &mut Build<'_>, value: Handle<Expression>, last: Handle<Expression>) {
    let is_over = build.binary(BinaryOperator::Greater, value, last);
    build.when(is_over, |build| build.push(Statement::Break));
}

/// The first line that anything in a loop has.
fn first_line(body: &Block, expressions: &Arena<Expression>, lines: &Lines) -> Option<u32> {
    let of_statement = |(statement, span): (&Statement, &Span)| match statement {
        Statement::Emit(range) => {
            range.clone().filter_map(|expression| lines.line(expressions.get_span(expression))).min()
        }
        _ => lines.line(*span),
    };
    body.span_iter().filter_map(of_statement).min()
}

/// The lines of the loops of each function, by the compiler's name for it.
fn loop_lines(words: &[u32]) -> HashMap<String, Vec<Option<u32>>> {
    let mut names = HashMap::new();
    let mut found: HashMap<String, Vec<Option<u32>>> = HashMap::new();
    let mut function = String::new();
    let mut line = None;
    for instruction in spirv::instructions(words) {
        match (instruction.opcode, instruction.words) {
            (op::NAME, [_, id, name @ ..]) => {
                names.insert(*id, spirv::text(name));
            }
            (op::FUNCTION, [_, _, id, ..]) => {
                function = names.get(id).cloned().unwrap_or_default();
                line = None;
            }
            (op::LINE, [_, _, number, ..]) => line = Some(*number),
            (op::LOOP_MERGE, _) => found.entry(function.clone()).or_default().push(line),
            _ => {}
        }
    }
    found
}

/// Runs `vertex` unless the header says that another vertex ran out of fuel, and writes to it if this one does.
/// `capture` is the buffer, `turns` a variable.
///
/// A driver that has cut a loop leaves every later one after its first turn. So a loop of two turns tells: its length
/// hangs on the header, which is 0 and which the driver's compiler does not know.
pub(super) fn run(
    build: &mut Build<'_>,
    gauge: &Gauge,
    capture: Handle<Expression>,
    turns: Handle<LocalVariable>,
    vertex: impl FnOnce(&mut Build<'_>),
) {
    let ran_out = build.leaf(Expression::GlobalVariable(gauge.ran_out));
    let turns = build.leaf(Expression::LocalVariable(turns));
    let [zero, one, two, cut] = [0, 1, 2, CUT].map(|number| build.number(number));
    let header = build.member(capture, 0);
    let before = build.load(header);
    // Outside the branch, in which the driver's compiler would know it.
    let enough = build.binary(BinaryOperator::Add, before, one);
    let has_fuel = build.binary(BinaryOperator::Equal, before, zero);
    build.when(has_fuel, |build| {
        vertex(build);
        build.forever(|build| {
            let done = build.load(turns);
            let done = build.binary(BinaryOperator::Add, done, one);
            build.store(turns, done);
            leave_above(build, done, enough);
        });
        let done = build.load(turns);
        let is_cut = build.binary(BinaryOperator::Less, done, two);
        let told = build.load(ran_out);
        let is_first = build.binary(BinaryOperator::Equal, told, zero);
        let is_told = build.binary(BinaryOperator::LogicalAnd, is_cut, is_first);
        let told = build.node(Expression::Select { condition: is_told, accept: cut, reject: told });
        let is_over = build.binary(BinaryOperator::NotEqual, told, zero);
        build.when(is_over, |build| build.store(header, told));
    });
}

/// What a student is told whose loops ran out of fuel.
pub(super) fn out_of_fuel(meters: &[Meter], ran_out: u32) -> Diagnostic {
    let meter = meters.get((ran_out as usize).wrapping_sub(1)).copied();
    let line = meter.or(meters.first().copied()).and_then(|meter| meter.line);
    let turns = meter.map_or(MAX_TURNS, |meter| meter.turns);
    let message = match meter {
        Some(_) => Text::new(
            format!(
                "your loop ran more than {turns} times: it was stopped (the limit counts all loops of one vertex together)"
            ),
            format!(
                "ループの繰り返しが {turns} 回を超えたため、打ち切りました (上限は頂点 1 個のすべてのループを合わせた回数です)"
            ),
        ),
        None => Text::new(
            format!("your loops ran more than {turns} times in all: they were stopped"),
            format!("ループの繰り返しが合わせて {turns} 回を超えたため、打ち切りました"),
        ),
    };
    let diagnostic = Diagnostic::error(Stage::Run, message).hint(Text::new(
        "Does the loop's condition ever become false? Look at the variable that it tests.",
        "ループの条件はいつか偽になりますか。条件で調べている変数の変わり方を確かめてください。",
    ));
    match line {
        Some(line) => diagnostic.at(line, None),
        None => diagnostic,
    }
}
