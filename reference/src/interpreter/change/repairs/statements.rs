//! Repairs of whole statements, and of the conditions of branches.

use super::super::inverse::of_statement;
use super::super::programs::left_out;
use super::super::tree::Path;
use super::super::{Operator, written};
use super::{ProgramRepair, Where, undone};
use crate::interpreter::syntax::{Expression, ExpressionKind, Statement, StatementKind};

/// A branch that is taken only where the one before it is not.
pub(super) fn without_else(before: &Expression, own: &Expression, number: usize) -> (u32, ProgramRepair) {
    let place = Where::Expressions(vec![(number, Path::new(), undone::with_else(before, own))]);
    let text = written(own);
    let texts = [format!("if ({text})"), format!("else if ({text})")];
    (own.at, ProgramRepair::slip(Operator::StatementLeftOut, own.line, texts, place))
}

/// The condition of a branch that is always taken.
pub(super) const ALWAYS: &str = "true";

/// A branch that is always taken.
pub(super) fn always(condition: &Expression, number: usize) -> (u32, ProgramRepair) {
    let holds = Expression { kind: ExpressionKind::Bool(true), ..condition.clone() };
    let texts = [written(condition), ALWAYS.into()];
    let place = Where::Expressions(vec![(number, Path::new(), holds)]);
    (condition.at, ProgramRepair::slip(Operator::Gated, condition.line, texts, place))
}

/// The program without a statement.
pub(super) fn without(own: &Statement, number: usize) -> Option<ProgramRepair> {
    left_out(own).filter(|_| !matches!(own.kind, StatementKind::Empty))?;
    let text = match &own.kind {
        StatementKind::Expression(expression) => written(expression),
        _ => String::new(),
    };
    Some(ProgramRepair::slip(of_statement(own), own.line, [text, String::new()], Where::Statement(number)))
}
