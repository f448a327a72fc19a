//! Operators between two values.

use super::{CompiledValue, Compiler, class};
use crate::interpreter::Refusal;
use crate::interpreter::code::{ArithmeticClass, Operation, Slot};
use crate::interpreter::syntax::Binary;
use crate::interpreter::types::{Scalar, Type};
use crate::text::both;

impl Compiler {
    /// The type that both operands become.
    pub(super) fn common_scalar(&self, a: Scalar, b: Scalar) -> Result<Scalar, Refusal> {
        let order = |scalar| match scalar {
            Scalar::Bool => 0,
            Scalar::Int => 1,
            Scalar::Uint => 2,
            Scalar::Float => 3,
            Scalar::Double => 4,
        };
        match (a, b) {
            _ if a == b => Ok(a),
            (Scalar::Bool, _) | (_, Scalar::Bool) => Err(self
                .invalid(both("a truth value and a number do not go together", "真偽値と数値を一緒に計算できません"))),
            _ => Ok(if order(a) > order(b) { a } else { b }),
        }
    }

    pub(super) fn binary(
        &mut self,
        operator: Binary,
        a: CompiledValue,
        b: CompiledValue,
    ) -> Result<CompiledValue, Refusal> {
        match operator {
            Binary::Add | Binary::Subtract | Binary::Multiply | Binary::Divide | Binary::Remainder => {
                self.arithmetic(operator, a, b)
            }
            Binary::BitAnd | Binary::BitOr | Binary::BitXor => {
                let operation = match operator {
                    Binary::BitAnd => Operation::BitAnd,
                    Binary::BitOr => Operation::BitOr,
                    _ => Operation::BitXor,
                };
                let (a, b, scalar) = self.same_scalar(a, b)?;
                self.componentwise(operation, scalar, a, b)
            }
            Binary::ShiftLeft | Binary::ShiftRight => {
                let left = operator == Binary::ShiftLeft;
                let operation = if left { Operation::ShiftLeft } else { Operation::ShiftRight };
                let scalar = a
                    .kind
                    .scalar()
                    .ok_or_else(|| self.invalid(both("only integers are shifted", "シフトできるのは整数だけです")))?;
                let slots = self.builder.each2(operation, class(scalar), &a.slots, &b.slots);
                Ok(CompiledValue { kind: a.kind, slots })
            }
            Binary::Less | Binary::LessEqual | Binary::Greater | Binary::GreaterEqual => {
                let (a, b, scalar) = self.same_scalar(a, b)?;
                let (a, b) = if matches!(operator, Binary::Less | Binary::LessEqual) { (a, b) } else { (b, a) };
                let or_equal = matches!(operator, Binary::LessEqual | Binary::GreaterEqual);
                let operation = if or_equal { Operation::LessEqual } else { Operation::Less };
                let slots = self.builder.each2(operation, class(scalar), &a.slots, &b.slots);
                Ok(CompiledValue { kind: Type::BOOL, slots })
            }
            Binary::Equal | Binary::NotEqual => self.equality(operator == Binary::Equal, a, b),
            Binary::And | Binary::Or | Binary::Xor => {
                let operation = match operator {
                    Binary::And => Operation::And,
                    Binary::Or => Operation::Or,
                    _ => Operation::Xor,
                };
                if a.kind != Type::BOOL || b.kind != Type::BOOL {
                    return Err(
                        self.invalid(both("this operator is for truth values", "この演算子は真偽値に使うものです"))
                    );
                }
                Ok(CompiledValue {
                    kind: Type::BOOL,
                    slots: self.builder.each2(operation, ArithmeticClass::Uint, &a.slots, &b.slots),
                })
            }
        }
    }

    /// Both operands with components of one type.
    fn same_scalar(
        &mut self,
        mut a: CompiledValue,
        mut b: CompiledValue,
    ) -> Result<(CompiledValue, CompiledValue, Scalar), Refusal> {
        let (Some(of_a), Some(of_b)) = (a.kind.scalar(), b.kind.scalar()) else {
            return Err(self.invalid(both(
                format!("{} and {} have no such operator", a.kind, b.kind),
                format!("{} と {} にこの演算子は使えません", a.kind, b.kind),
            )));
        };
        let scalar = self.common_scalar(of_a, of_b)?;
        a = CompiledValue { kind: a.kind.with_scalar(scalar), slots: self.converted(&a.slots, of_a, scalar) };
        b = CompiledValue { kind: b.kind.with_scalar(scalar), slots: self.converted(&b.slots, of_b, scalar) };
        Ok((a, b, scalar))
    }

    fn arithmetic(&mut self, operator: Binary, a: CompiledValue, b: CompiledValue) -> Result<CompiledValue, Refusal> {
        let (a, b, scalar) = self.same_scalar(a, b)?;
        if scalar == Scalar::Bool {
            return Err(self.invalid(both("truth values have no arithmetic", "真偽値に算術演算はできません")));
        }
        let operation = match operator {
            Binary::Add => Operation::Add,
            Binary::Subtract => Operation::Subtract,
            Binary::Divide => Operation::Divide,
            Binary::Remainder if scalar.is_integer() => Operation::Remainder,
            Binary::Remainder => return Err(self.invalid(both("% is for integers", "`%` は整数に使うものです"))),
            _ => {
                let is_matrix = |value: &CompiledValue| matches!(value.kind, Type::Matrix(..));
                if (is_matrix(&a) && !b.kind.is_scalar()) || (is_matrix(&b) && !a.kind.is_scalar()) {
                    return self.product(&a, &b, class(scalar));
                }
                Operation::Multiply
            }
        };
        self.componentwise(operation, scalar, a, b)
    }

    /// Component by component; a scalar goes with each of them.
    fn componentwise(
        &mut self,
        operation: Operation,
        scalar: Scalar,
        a: CompiledValue,
        b: CompiledValue,
    ) -> Result<CompiledValue, Refusal> {
        if a.kind != b.kind && !a.kind.is_scalar() && !b.kind.is_scalar() {
            return Err(self.invalid(both(
                format!("{} and {} do not go together", a.kind, b.kind),
                format!("{} と {} は一緒に計算できません", a.kind, b.kind),
            )));
        }
        let slots = self.builder.each2(operation, class(scalar), &a.slots, &b.slots);
        Ok(CompiledValue { kind: if a.kind.is_scalar() { b.kind } else { a.kind }, slots })
    }

    /// The product of linear algebra. A vector is a column on the right and a row on the left.
    fn product(
        &mut self,
        a: &CompiledValue,
        b: &CompiledValue,
        class: ArithmeticClass,
    ) -> Result<CompiledValue, Refusal> {
        let shape = |kind: &Type, on_the_left: bool| match *kind {
            Type::Matrix(scalar, columns, rows) => Some((scalar, usize::from(columns), usize::from(rows))),
            Type::Vector(scalar, count) if on_the_left => Some((scalar, usize::from(count), 1)),
            Type::Vector(scalar, count) => Some((scalar, 1, usize::from(count))),
            _ => None,
        };
        let shapes = shape(&a.kind, true).zip(shape(&b.kind, false));
        let ((scalar, inner, rows), (_, columns, _)) =
            shapes.filter(|((_, inner, _), (_, _, rows))| inner == rows).ok_or_else(|| {
                self.invalid(both(
                    format!("{} and {} cannot be multiplied", a.kind, b.kind),
                    format!("{} と {} は掛けられません", a.kind, b.kind),
                ))
            })?;
        let mut slots = Vec::with_capacity(rows * columns);
        for column in 0..columns {
            for row in 0..rows {
                let left: Vec<Slot> = (0..inner).map(|k| a.slots[k * rows + row]).collect();
                slots.push(self.builder.dot(class, &left, &b.slots[column * inner..(column + 1) * inner]));
            }
        }
        let kind = match (&a.kind, &b.kind) {
            (Type::Vector(..), _) => Type::Vector(scalar, columns as u8),
            (_, Type::Vector(..)) => Type::Vector(scalar, rows as u8),
            _ => Type::Matrix(scalar, columns as u8, rows as u8),
        };
        Ok(CompiledValue { kind, slots })
    }

    /// Whether all scalars are equal, or any is not.
    fn equality(&mut self, equal: bool, a: CompiledValue, b: CompiledValue) -> Result<CompiledValue, Refusal> {
        let (a, b) = match (a.kind.scalar(), b.kind.scalar()) {
            (Some(_), Some(_)) => {
                let (a, b, _) = self.same_scalar(a, b)?;
                (a, b)
            }
            _ => (a, b),
        };
        if a.kind != b.kind {
            return Err(self.invalid(both(
                format!("{} and {} cannot be compared", a.kind, b.kind),
                format!("{} と {} は比較できません", a.kind, b.kind),
            )));
        }
        let (operation, joined) =
            if equal { (Operation::Equal, Operation::And) } else { (Operation::NotEqual, Operation::Or) };
        let mut result = None;
        for ((&a, &b), scalar) in a.slots.iter().zip(&b.slots).zip(a.kind.flat()) {
            let one = self.builder.emit(operation, class(scalar), &[a, b]);
            result = Some(match result {
                None => one,
                Some(before) => self.builder.emit(joined, ArithmeticClass::Uint, &[before, one]),
            });
        }
        let slot = result.unwrap_or_else(|| self.builder.whole(f64::from(u8::from(equal))));
        Ok(CompiledValue { kind: Type::BOOL, slots: vec![slot] })
    }
}
