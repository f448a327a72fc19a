//! The slip that a change of a wrong text undoes.

use super::tree::{ExpressionPlace, assigned, operands, paths};
use super::{Change, Operator, bare, is_literal, written};
use crate::interpreter::syntax::{Binary, Expression, ExpressionKind, Name, Statement, StatementKind, Unary};

/// What the student did, where this change of `root` makes it right.
pub(super) fn mistake_of(root: &Expression, change: &Change) -> Operator {
    let own = ExpressionPlace::of(root, &change.path).own;
    let removed = || removed(own, ExpressionPlace::of(&change.expression, &change.path).own);
    match change.operator {
        Operator::ClampLeftOut => Operator::Clamped,
        Operator::NormalizeLeftOut => Operator::Normalized,
        Operator::PowerLeftOut => Operator::Raising,
        Operator::CallLeftOut => of_call(own),
        Operator::LeftOut => Operator::OtherValue,
        Operator::AddendLeftOut => removed().map_or(Operator::Shifted, |removed| match removed.is_there_still {
            true => Operator::AddedTwice,
            false => Operator::Shifted,
        }),
        Operator::FactorLeftOut | Operator::DivisorLeftOut => {
            let is_factor = change.operator == Operator::FactorLeftOut;
            removed().map_or(Operator::Times, |removed| match (removed.is_there_still, removed.is_literal) {
                (true, _) if is_factor => Operator::Squared,
                (_, true) => Operator::Scaled,
                _ => Operator::Times,
            })
        }
        Operator::MatrixLeftOut => Operator::Times,
        Operator::AddedTwice => Operator::AddendLeftOut,
        Operator::Squared | Operator::Times => Operator::FactorLeftOut,
        Operator::Absolute | Operator::Root => Operator::CallLeftOut,
        Operator::Raised => Operator::Otherwise,
        Operator::Clamped => Operator::ClampLeftOut,
        Operator::Normalized => Operator::NormalizeLeftOut,
        Operator::Gated => Operator::StatementLeftOut,
        other => other,
    }
}

/// What the student did, where a statement is one too many.
pub(super) fn of_statement(statement: &Statement) -> Operator {
    let StatementKind::Expression(expression) = &statement.kind else { return Operator::Gated };
    match &expression.kind {
        ExpressionKind::Assign(Some(Binary::Multiply | Binary::Divide), _, from) if is_literal(from) => {
            Operator::Scaled
        }
        ExpressionKind::Assign(Some(Binary::Multiply | Binary::Divide), ..) => Operator::Times,
        ExpressionKind::Assign(Some(Binary::Add | Binary::Subtract), ..) => Operator::Shifted,
        // What it writes over is what counts.
        ExpressionKind::Assign(None, _, from) if !assigned(expression).is_some_and(|name| reads(from, name)) => {
            Operator::OtherValue
        }
        ExpressionKind::Assign(None, _, from) => match &bare(from).kind {
            ExpressionKind::Call(..) => of_call(bare(from)),
            ExpressionKind::Unary(Unary::Minus, _) => Operator::Sign,
            _ => Operator::OtherValue,
        },
        _ => Operator::OtherValue,
    }
}

/// Whether a variable is a part of an expression.
fn reads(own: &Expression, name: &Name) -> bool {
    paths(own)
        .iter()
        .any(|path| matches!(&ExpressionPlace::of(own, path).own.kind, ExpressionKind::Name(own) if own == name))
}

/// What a function does that has no place there.
fn of_call(own: &Expression) -> Operator {
    match &own.kind {
        ExpressionKind::Conditional(..) => Operator::Gated,
        ExpressionKind::Call(name, _) => match &**name {
            "abs" => Operator::Absolute,
            "sqrt" => Operator::Root,
            "max" | "min" | "clamp" => Operator::Clamped,
            "normalize" => Operator::Normalized,
            "pow" => Operator::Raising,
            _ => Operator::OtherFunction,
        },
        _ => Operator::OtherFunction,
    }
}

struct RemovedOperand {
    /// Whether the same stands there once more.
    is_there_still: bool,
    is_literal: bool,
}

/// The operand that is in one expression and not in the other.
fn removed(before: &Expression, after: &Expression) -> Option<RemovedOperand> {
    let listed = |of: &Expression| match &of.kind {
        ExpressionKind::Chain(..) => operands(of).into_iter().map(written).collect(),
        _ => vec![written(of)],
    };
    let mut rest: Vec<String> = listed(after);
    let gone = operands(before).into_iter().find(|operand| {
        let text = written(operand);
        match rest.iter().position(|own| *own == text) {
            Some(place) => {
                rest.remove(place);
                false
            }
            None => true,
        }
    })?;
    let text = written(gone);
    let squeezed = |text: &str| text.trim_matches(['(', ')']).to_owned();
    let is_there_still = listed(after).iter().any(|own| squeezed(own) == squeezed(&text));
    Some(RemovedOperand { is_there_still, is_literal: is_literal(gone) })
}
