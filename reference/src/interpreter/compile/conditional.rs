//! Expressions of which a part is computed only on a condition.

use super::{CompiledValue, Compiler};
use crate::interpreter::Refusal;
use crate::interpreter::code::{ArithmeticClass, Node, Operation};
use crate::interpreter::syntax::{Binary, Expression};
use crate::interpreter::types::Type;
use crate::text::both;

impl Compiler {
    /// `?:`, of whose operands only one is computed where that makes a difference.
    pub(super) fn conditional(
        &mut self,
        condition: &Expression,
        yes: &Expression,
        no: &Expression,
    ) -> Result<CompiledValue, Refusal> {
        let line = self.builder.line;
        let mut condition = self.value(condition)?;
        let condition_slot = *condition
            .slots
            .first()
            .ok_or_else(|| self.invalid(both("a condition is expected", "条件 (bool の値) が必要です")))?;
        if !yes.changes && !no.changes {
            let (yes, no) = (self.value(yes)?, self.value(no)?);
            self.builder.line = line;
            let (yes, no) = self.alike(yes, no)?;
            // A known condition chooses without asking.
            let slots = match self.builder.known(condition_slot) {
                Some(known) => {
                    if known != 0.0 {
                        yes.slots
                    } else {
                        no.slots
                    }
                }
                None => {
                    let class = yes.kind.scalar().map_or(ArithmeticClass::Double, super::class);
                    self.builder.each3(Operation::Select, class, [&[condition_slot], &yes.slots, &no.slots])
                }
            };
            return Ok(CompiledValue { kind: yes.kind, slots });
        }
        condition.slots = self.builder.copies(&condition.slots);
        let (mut on_yes, yes) = self.nodes(|compiler| compiler.value(yes))?;
        let (mut on_no, no) = self.nodes(|compiler| compiler.value(no))?;
        let scalar = match (yes.kind.scalar(), no.kind.scalar()) {
            (Some(a), Some(b)) => Some(self.common_scalar(a, b)?),
            _ => None,
        };
        let kind = scalar.map_or_else(|| yes.kind.clone(), |scalar| yes.kind.with_scalar(scalar));
        let result = self.builder.allocate(yes.slots.len())?;
        for (nodes, value) in [(&mut on_yes, yes), (&mut on_no, no)] {
            let (mut more, ()) = self.nodes(|compiler| {
                let value = compiler.implicit(value, &kind)?;
                compiler.store(result, &value.slots);
                Ok(())
            })?;
            nodes.append(&mut more);
        }
        let condition = condition.slots[0];
        self.builder.push(Node::If { condition, yes: on_yes, no: on_no, line });
        let slots: Vec<_> = (result..).take(kind.slots().unwrap_or(0)).collect();
        Ok(CompiledValue { slots: self.builder.copies(&slots), kind })
    }

    /// Two values as one type, as `?:` needs them.
    fn alike(&mut self, a: CompiledValue, b: CompiledValue) -> Result<(CompiledValue, CompiledValue), Refusal> {
        if a.kind == b.kind {
            return Ok((a, b));
        }
        let (Some(of_a), Some(of_b)) = (a.kind.scalar(), b.kind.scalar()) else {
            return Err(self.invalid(both(
                format!("{} and {} are not of one type", a.kind, b.kind),
                format!("{} と {} の型が一致しません", a.kind, b.kind),
            )));
        };
        let scalar = self.common_scalar(of_a, of_b)?;
        let kind = a.kind.with_scalar(scalar);
        Ok((self.implicit(a, &kind)?, self.implicit(b, &kind)?))
    }

    /// `&&` and `||` whose right operand changes something.
    pub(super) fn short_circuit(
        &mut self,
        operator: Binary,
        left: CompiledValue,
        right: &Expression,
    ) -> Result<CompiledValue, Refusal> {
        let result = self.builder.allocate(1)?;
        self.store(result, &left.slots);
        let line = self.builder.line;
        let (nodes, ()) = self.nodes(|compiler| {
            let right = compiler.value(right)?;
            compiler.store(result, &right.slots);
            Ok(())
        })?;
        let (yes, no) = if operator == Binary::And { (nodes, Vec::new()) } else { (Vec::new(), nodes) };
        self.builder.push(Node::If { condition: result, yes, no, line });
        let slots = self.builder.copies(&[result]);
        Ok(CompiledValue { kind: Type::BOOL, slots })
    }
}
