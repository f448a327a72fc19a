//! Expressions.

use super::place::components;
use super::scope::UNSIZED;
use super::{CompiledValue, Compiler};
use crate::interpreter::Refusal;
use crate::interpreter::code::Operation;
use crate::interpreter::syntax::{Binary, Expression, ExpressionKind, Unary};
use crate::interpreter::trace::What;
use crate::interpreter::types::{Scalar, Type};
use crate::text::both;

impl Compiler {
    /// The value of an expression as it is computed.
    pub(super) fn computed(&mut self, expression: &Expression) -> Result<CompiledValue, Refusal> {
        self.builder.line = expression.line;
        match &expression.kind {
            ExpressionKind::Integer(value, unsigned) => {
                let kind = if *unsigned { Type::UINT } else { Type::INT };
                Ok(CompiledValue { kind, slots: vec![self.builder.whole(*value)] })
            }
            ExpressionKind::Floating(value, true) => {
                Ok(CompiledValue { kind: Type::DOUBLE, slots: vec![self.builder.whole(*value)] })
            }
            ExpressionKind::Floating(value, false) => {
                Ok(CompiledValue { kind: Type::FLOAT, slots: vec![self.builder.float(*value)] })
            }
            ExpressionKind::Bool(value) => {
                Ok(CompiledValue { kind: Type::BOOL, slots: vec![self.builder.whole(f64::from(u8::from(*value)))] })
            }
            ExpressionKind::Unary(operator, operand) => {
                let operand = self.value(operand)?;
                self.builder.line = expression.line;
                self.unary(*operator, operand)
            }
            ExpressionKind::Step(adds, after, operand) => self.step(*adds, *after, operand),
            ExpressionKind::Chain(first, others) => self.chain(first, others, expression.at),
            ExpressionKind::Assign(operator, to, from) => self.assign(*operator, to, from, expression.line),
            ExpressionKind::Conditional(condition, yes, no) => self.conditional(condition, yes, no),
            ExpressionKind::Comma(all) => {
                let mut last = CompiledValue { kind: Type::Void, slots: Vec::new() };
                for one in all {
                    last = self.value(one)?;
                }
                Ok(last)
            }
            ExpressionKind::Call(name, arguments) => self.call(name, arguments, expression.line),
            ExpressionKind::ArrayConstructor(kind, arguments) => {
                let kind = self.type_of(kind)?;
                let arguments = self.values(arguments)?;
                self.builder.line = expression.line;
                self.construct(&kind, arguments)
            }
            ExpressionKind::Length(of) => self.length(of),
            ExpressionKind::List(_) => {
                Err(self
                    .invalid(both("a list in braces stands only behind `=`", "波括弧の並びは `=` の後にだけ書けます")))
            }
            ExpressionKind::Name(_) | ExpressionKind::Index(..) | ExpressionKind::Member(..) => {
                match self.place(expression)? {
                    Some(place) => {
                        self.reads(&place);
                        self.read(&place)
                    }
                    None => self.part(expression),
                }
            }
        }
    }

    /// Values of expressions from left to right: a later one does not change an earlier one any more.
    pub(super) fn values(&mut self, expressions: &[Expression]) -> Result<Vec<CompiledValue>, Refusal> {
        let mut values = Vec::new();
        for (index, expression) in expressions.iter().enumerate() {
            let mut value = self.value(expression)?;
            if expressions[index + 1..].iter().any(|later| later.changes) {
                value.slots = self.builder.copies(&value.slots);
            }
            values.push(value);
        }
        Ok(values)
    }

    /// A part of a value that no variable holds.
    fn part(&mut self, expression: &Expression) -> Result<CompiledValue, Refusal> {
        match &expression.kind {
            ExpressionKind::Member(of, name) => {
                let value = self.value(of)?;
                self.builder.line = expression.line;
                if let Type::Struct(structure) = &value.kind {
                    let mut first = 0;
                    for (member, kind) in &structure.members {
                        let size = kind.slots().unwrap_or(0);
                        if **member == **name {
                            let slots = value.slots[first..first + size].to_vec();
                            return Ok(CompiledValue { kind: kind.clone(), slots });
                        }
                        first += size;
                    }
                }
                let Type::Vector(scalar, count) = value.kind else {
                    return Err(self.invalid(both(
                        format!("{} has no member `{name}`", value.kind),
                        format!("{} にメンバ `{name}` はありません", value.kind),
                    )));
                };
                let chosen = components(name, count);
                let chosen = chosen.ok_or_else(|| {
                    self.invalid(both(format!("there is no component `{name}`"), format!("成分 `{name}` はありません")))
                })?;
                let slots: Vec<_> = chosen.iter().map(|&index| value.slots[index as usize]).collect();
                Ok(CompiledValue { kind: Type::Vector(scalar, slots.len() as u8), slots })
            }
            ExpressionKind::Index(of, index) => {
                let mut value = self.value(of)?;
                if index.changes {
                    value.slots = self.builder.copies(&value.slots);
                }
                let index = self.value(index)?;
                self.builder.line = expression.line;
                let place = self.laid_out(value)?;
                let place = self.element(place, &index)?;
                self.read(&place)
            }
            _ => Err(self.invalid(both("this has no value", "値がありません"))),
        }
    }

    fn length(&mut self, of: &Expression) -> Result<CompiledValue, Refusal> {
        let kind = match self.place(of)? {
            Some(place) => place.kind,
            None => self.value(of)?.kind,
        };
        let element = kind.element();
        let (_, length) = element.ok_or_else(|| {
            self.invalid(both(format!("{kind} has no length"), format!("{kind} には長さがありません")))
        })?;
        let length = self.builder.whole(length.unwrap_or(UNSIZED) as f64);
        Ok(CompiledValue { kind: Type::INT, slots: vec![length] })
    }

    fn unary(&mut self, operator: Unary, operand: CompiledValue) -> Result<CompiledValue, Refusal> {
        let scalar =
            operand.kind.scalar().ok_or_else(|| self.invalid(both("this has no sign", "符号を付けられない値です")))?;
        let operation = match (operator, scalar) {
            (Unary::Plus, _) => return Ok(operand),
            (Unary::Minus, Scalar::Bool) | (Unary::Complement, Scalar::Bool | Scalar::Float | Scalar::Double) => {
                return Err(self.invalid(both(
                    format!("{} has no such operator", operand.kind),
                    format!("{} にこの演算子は使えません", operand.kind),
                )));
            }
            (Unary::Minus, _) => Operation::Negate,
            (Unary::Not, _) => Operation::Not,
            (Unary::Complement, _) => Operation::BitNot,
        };
        let slots = self.builder.each1(operation, super::class(scalar), &operand.slots);
        Ok(CompiledValue { kind: operand.kind, slots })
    }

    fn step(&mut self, adds: bool, after: bool, operand: &Expression) -> Result<CompiledValue, Refusal> {
        let place = self
            .place(operand)?
            .ok_or_else(|| self.invalid(both("this cannot be changed", "この値は変更できません")))?;
        let mut before = self.read(&place)?;
        before.slots = self.builder.copies(&before.slots);
        let scalar = before
            .kind
            .scalar()
            .ok_or_else(|| self.invalid(both("this cannot be counted", "この値に `++` や `--` は使えません")))?;
        let class = super::class(scalar);
        let one = self.builder.number(class, 1.0);
        let operation = if adds { Operation::Add } else { Operation::Subtract };
        let slots = self.builder.each2(operation, class, &before.slots, &[one]);
        let changed = CompiledValue { kind: before.kind.clone(), slots };
        self.write(&place, &changed)?;
        Ok(if after { before } else { changed })
    }

    fn chain(
        &mut self,
        first: &Expression,
        others: &[(Binary, u32, Expression)],
        at: u32,
    ) -> Result<CompiledValue, Refusal> {
        let mut left = self.value(first)?;
        let last = others.len().saturating_sub(1);
        for (number, (operator, line, right)) in others.iter().enumerate() {
            if right.changes && matches!(operator, Binary::And | Binary::Or) {
                self.builder.line = *line;
                left = self.short_circuit(*operator, left, right)?;
                continue;
            }
            if right.changes {
                left.slots = self.builder.copies(&left.slots);
            }
            let right = self.value(right)?;
            self.builder.line = *line;
            left = self.binary(*operator, left, right)?;
            // The last one is that of the whole expression.
            if number < last {
                left = self.recorded_step(What::Binary(*operator), left, at);
            }
        }
        Ok(left)
    }

    fn assign(
        &mut self,
        operator: Option<Binary>,
        to: &Expression,
        from: &Expression,
        line: u32,
    ) -> Result<CompiledValue, Refusal> {
        let place = self
            .place(to)?
            .ok_or_else(|| self.invalid(both("this cannot be assigned to", "ここには代入できません")))?;
        let value = match operator {
            None => self.value(from)?,
            Some(operator) => {
                // The place is known first, and read last: `s += (s = x)` is `2 x`, as compilers have it.
                let value = self.value(from)?;
                self.builder.line = line;
                self.reads(&place);
                let before = self.read(&place)?;
                self.binary(operator, before, value)?
            }
        };
        self.builder.line = line;
        let value = self.implicit(value, &place.kind)?;
        let value = self.recorded_assignment(to, operator.is_none(), value);
        self.write(&place, &value)?;
        self.wrote(&place);
        Ok(value)
    }
}
