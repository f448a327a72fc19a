//! The tank that all vertices of a grading share: who runs, and what is left in the capture's header.

use super::refit::leave_above;
use super::{CUT, Gauge};
use crate::translate::build::Build;
use naga::{BinaryOperator, Expression, Handle, LocalVariable};

/// Runs `vertex` unless the header says that another vertex ran out of fuel, and writes to it if this one does.
/// `capture` is the buffer, `turns` a variable.
///
/// A driver that has cut a loop leaves every later one after its first turn. So a loop of two turns tells: its length
/// depends on the header, which is 0 and which the driver's compiler does not know.
pub(in crate::translate) fn run(
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
