//! Fuel: every turn of a loop takes some, and a vertex that has none left leaves its loops.
//!
//! The software driver cuts a shader's loops silently after 65,535 turns in all, and draws a wrong picture. So the
//! module counts the turns itself and says which loop was running when the count reached its bound.
//!
//! Straight code needs no fuel: [`super::gate`] bounds how much of it there is, all calls inlined.

use super::build::Build;
use super::gate::Costs;
use super::spirv::{self, Lines, op};
use crate::diagnostic::{Diagnostic, Stage};
use crate::language::Text;
use naga::{
    AddressSpace, Arena, BinaryOperator, Block, Expression, GlobalVariable, Handle, LocalVariable, Module, Scalar,
    Span, Statement, Type, TypeInner,
};
use std::collections::HashMap;

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
    let handles: Vec<_> = module.functions.iter().map(|(handle, _)| handle).collect();
    for handle in handles {
        let operations = costs.loops(module, &module.functions[handle]);
        if operations.is_empty() {
            continue;
        }
        let function = &mut module.functions[handle];
        let known = function.name.as_deref().and_then(|name| headers.get(name));
        // Both are in the order of the source, unless the compiler dropped a loop that is never reached.
        let known = known.filter(|known| known.len() == operations.len());
        let mut leaf = |expression| function.expressions.append(expression, Span::UNDEFINED);
        let used = leaf(Expression::GlobalVariable(gauge.used));
        let ran_out = leaf(Expression::GlobalVariable(gauge.ran_out));
        let body = std::mem::take(&mut function.body);
        let first = meters.len();
        let mut refit = Refit { used, ran_out, operations: &operations, known, lines, first, meters: &mut meters };
        function.body = refit.block(&mut function.expressions, body);
    }
    let gauge = (!meters.is_empty()).then_some(gauge);
    (meters, gauge)
}

/// Puts meters into the loops of one function.
struct Refit<'a> {
    used: Handle<Expression>,
    ran_out: Handle<Expression>,
    /// Of each loop of the function, what a turn costs.
    operations: &'a [u64],
    known: Option<&'a Vec<Option<u32>>>,
    lines: &'a Lines,
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
                    let mut metered = self.check(expressions, &body);
                    for (statement, span) in self.block(expressions, body).span_into_iter() {
                        metered.push(statement, span);
                    }
                    let continuing = self.block(expressions, continuing);
                    Statement::Loop { body: metered, continuing, break_if }
                }
                other => other,
            };
            refitted.push(statement, span);
        }
        refitted
    }

    /// What a loop does first in each turn: leave where the fuel is used up, else take some.
    fn check(&mut self, expressions: &mut Arena<Expression>, body: &Block) -> Block {
        let index = self.meters.len() - self.first;
        let units = 1 + self.operations.get(index).copied().unwrap_or(0) / OPERATIONS_PER_UNIT;
        let units = u32::try_from(units).unwrap_or(MAX_TURNS).min(MAX_TURNS);
        let line = match self.known {
            Some(known) => known.get(index).copied().flatten(),
            None => first_line(body, expressions, self.lines),
        };
        self.meters.push(Meter { line, turns: MAX_TURNS / units });
        let mut build = Build::new(expressions);
        let id = build.number(self.meters.len() as u32);
        let zero = build.number(0);
        let units = build.number(units);
        let last = build.number(MAX_TURNS);
        let used = build.load(self.used);
        let sum = build.binary(BinaryOperator::Add, used, units);
        let is_empty = build.binary(BinaryOperator::Greater, sum, last);
        build.when(is_empty, |build| {
            let known = build.load(self.ran_out);
            let is_first = build.binary(BinaryOperator::Equal, known, zero);
            let told = build.node(Expression::Select { condition: is_first, accept: id, reject: known });
            build.store(self.ran_out, told);
            // Every loop that this vertex still meets is left at once.
            build.store(self.used, last);
            build.push(Statement::Break);
        });
        build.store(self.used, sum);
        build.finish()
    }
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

/// The counters as a function sees them, and where the first vertex that runs out tells the others.
pub(super) struct Tank {
    ran_out: Handle<Expression>,
    header: Handle<Expression>,
    /// What the header said when this vertex began.
    before: Handle<Expression>,
}

/// Begins a vertex: its tank is full, or empty where another vertex has run out before. `capture` is the buffer.
pub(super) fn fill(build: &mut Build<'_>, gauge: &Gauge, capture: Handle<Expression>) -> Tank {
    let used = build.leaf(Expression::GlobalVariable(gauge.used));
    let ran_out = build.leaf(Expression::GlobalVariable(gauge.ran_out));
    let zero = build.number(0);
    let empty = build.number(MAX_TURNS);
    let header = build.member(capture, 0);
    let before = build.load(header);
    let is_over = build.binary(BinaryOperator::NotEqual, before, zero);
    build.when(is_over, |build| {
        build.store(used, empty);
        build.store(ran_out, before);
    });
    Tank { ran_out, header, before }
}

/// Ends a vertex: writes to the header which loop ran out, or that the driver cut one. `turns` is a variable for it.
///
/// A driver that has cut a loop leaves every later one after its first turn. So a loop of two turns tells: its length
/// hangs on the header, which is 0 and which the driver's compiler does not know.
pub(super) fn report(build: &mut Build<'_>, tank: &Tank, turns: Handle<LocalVariable>) {
    let turns = build.leaf(Expression::LocalVariable(turns));
    let [zero, one, two, cut] = [0, 1, 2, CUT].map(|number| build.number(number));
    let first = build.load(tank.ran_out);
    let has_fuel = build.binary(BinaryOperator::Equal, first, zero);
    build.when(has_fuel, |build| {
        build.forever(|build| {
            let done = build.load(turns);
            let done = build.binary(BinaryOperator::Add, done, one);
            build.store(turns, done);
            let enough = build.binary(BinaryOperator::Add, tank.before, one);
            let is_last = build.binary(BinaryOperator::Greater, done, enough);
            build.when(is_last, |build| build.push(Statement::Break));
        });
        let done = build.load(turns);
        let is_cut = build.binary(BinaryOperator::Less, done, two);
        build.when(is_cut, |build| build.store(tank.ran_out, cut));
    });
    let ran_out = build.load(tank.ran_out);
    let is_over = build.binary(BinaryOperator::NotEqual, ran_out, zero);
    build.when(is_over, |build| build.store(tank.header, ran_out));
}

/// What a student is told whose loops ran out of fuel.
pub(super) fn out_of_fuel(meters: &[Meter], ran_out: u32) -> Diagnostic {
    let meter = meters.get((ran_out as usize).wrapping_sub(1)).copied();
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
    match meter.and_then(|meter| meter.line) {
        Some(line) => diagnostic.at(line, None),
        None => diagnostic,
    }
}
