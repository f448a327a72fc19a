//! What all fragments of a grading may spend together.

use super::{CUT, Gauge};
use crate::translate::build::Build;
use naga::{AtomicFunction, BinaryOperator, Expression, Handle, Statement, Type};

/// Units that all fragments may take together: each may run long, and there are millions of them. The picture of a
/// fractal with a hundred turns a pixel takes 8 · 10⁸ for 25 frames of 640 × 480.
const MAX_UNITS: u32 = 2_000_000_000;

/// A fragment that took no more than this is not counted: counting is for all cores at once.
const FREE_UNITS: u32 = 64;

/// Says so where the fuel of this fragment is used up, and adds it to what all have `spent`.
pub(in crate::translate) fn settle(
    build: &mut Build<'_>,
    gauge: &Gauge,
    capture: Handle<Expression>,
    spent: Handle<Expression>,
    u32_type: Handle<Type>,
) {
    let [ran_out, used] = [gauge.ran_out, gauge.used].map(|variable| build.leaf(Expression::GlobalVariable(variable)));
    let [told, used] = [ran_out, used].map(|variable| build.load(variable));
    let zero = build.number(0);
    let is_over = build.binary(BinaryOperator::NotEqual, told, zero);
    build.when(is_over, |build| {
        let header = build.member(capture, 0);
        build.store(header, told);
    });
    let free = build.number(FREE_UNITS);
    let is_counted = build.binary(BinaryOperator::Greater, used, free);
    build.when(is_counted, |build| {
        let before = build.leaf(Expression::AtomicResult { ty: u32_type, comparison: false });
        build.push(Statement::Atomic { pointer: spent, fun: AtomicFunction::Add, value: used, result: Some(before) });
        let most = build.number(MAX_UNITS);
        let is_over = build.binary(BinaryOperator::Greater, before, most);
        build.when(is_over, |build| {
            let header = build.member(capture, 0);
            let cut = build.number(CUT);
            build.store(header, cut);
        });
    });
}
