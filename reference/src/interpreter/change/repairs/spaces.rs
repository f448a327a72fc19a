//! Vectors and matrices that are not brought to another space.

use super::super::Operator;
use super::ingredients::{AddedMistake, Ingredients};
use super::inlined::bracketed;
use crate::interpreter::syntax::{Binary, Expression, ExpressionKind};
use crate::interpreter::types::{Scalar, Type};

impl Ingredients {
    /// A vector behind one more matrix, or a matrix behind another one: alone, or between those that are there.
    pub(super) fn to_another_space(
        &self,
        own: &Expression,
        kind: &Type,
        theirs: &[(Expression, Type)],
    ) -> Vec<AddedMistake> {
        let side = match kind {
            Type::Vector(Scalar::Float, count) if *count > 1 => *count,
            Type::Matrix(Scalar::Float, columns, rows) if columns == rows => *rows,
            _ => return Vec::new(),
        };
        let is_space = |kind: &Type| *kind == Type::Matrix(Scalar::Float, side, side);
        let right = self.values.iter().map(|value| (&value.expression, &value.kind));
        let matrices = theirs.iter().map(|(value, kind)| (value, kind)).chain(right);
        let brought = |(matrix, _): (&Expression, &Type)| {
            let factors = vec![(Binary::Multiply, own.line, bracketed(own))];
            let product = Expression::made(own.line, ExpressionKind::Chain(Box::new(bracketed(matrix)), factors));
            AddedMistake {
                mistake: Operator::MatrixLeftOut,
                expression: Expression::made(own.line, ExpressionKind::Comma(vec![product])),
                name: None,
                is_bound_by_zero: false,
                is_elsewhere: false,
            }
        };
        matrices.filter(|(_, kind)| is_space(kind)).map(brought).collect()
    }
}
