//! Expressions by what is given alone, with what names stand for in their place.

use super::super::tree::{ExpressionPlace, operands, paths, with};
use crate::interpreter::is_builtin;
use crate::interpreter::syntax::{Expression, ExpressionKind, Name};
use crate::interpreter::types::Type;

pub(super) fn bracketed(value: &Expression) -> Expression {
    match &value.kind {
        ExpressionKind::Chain(..) | ExpressionKind::Conditional(..) => {
            Expression { kind: ExpressionKind::Comma(vec![value.clone()]), ..value.clone() }
        }
        _ => value.clone(),
    }
}

/// An expression with what some names stand for in their place.
pub(super) fn inlined(expression: &Expression, locals: &[(Name, Expression)]) -> Expression {
    let mut found = expression.clone();
    // The innermost first: what is put there is not gone through again.
    for path in paths(expression).into_iter().rev() {
        if let ExpressionKind::Name(name) = &ExpressionPlace::of(expression, &path).own.kind
            && let Some((_, value)) = locals.iter().rev().find(|(known, _)| known == name)
        {
            found = with(&found, &path, bracketed(value));
        }
    }
    found
}

/// Whether an expression uses no functions of the program, which others do not have.
pub(super) fn is_everywhere(expression: &Expression) -> bool {
    let is_known = match &expression.kind {
        ExpressionKind::Call(name, _) => Type::named(name).is_some() || is_builtin(name),
        ExpressionKind::Assign(..) | ExpressionKind::Step(..) => false,
        _ => true,
    };
    is_known && operands(expression).into_iter().all(is_everywhere)
}
