//! Constructors.

use super::{CompiledValue, Compiler, class};
use crate::interpreter::Refusal;
use crate::interpreter::code::Slot;
use crate::interpreter::types::{Scalar, Type};
use crate::text::both;

impl Compiler {
    /// `kind(arguments)`
    pub(super) fn construct(&mut self, kind: &Type, arguments: Vec<CompiledValue>) -> Result<CompiledValue, Refusal> {
        match kind {
            Type::Vector(scalar, count) => self.vector(*scalar, usize::from(*count), &arguments),
            Type::Matrix(scalar, columns, rows) => {
                self.matrix(*scalar, [usize::from(*columns), usize::from(*rows)], &arguments)
            }
            Type::Struct(structure) => {
                let kinds: Vec<Type> = structure.members.iter().map(|(_, kind)| kind.clone()).collect();
                self.parts(kind.clone(), &kinds, arguments)
            }
            Type::Array(element, length) => {
                let mut element = (**element).clone();
                if element.slots().is_none()
                    && let Some(first) = arguments.first()
                {
                    element = first.kind.clone();
                }
                let length = length.unwrap_or(arguments.len());
                self.parts(element.clone().array(Some(length)), &vec![element; length.min(1 << 20)], arguments)
            }
            Type::Void | Type::Sampler(_) => Err(self
                .invalid(both(format!("{kind} has no constructor"), format!("{kind} にはコンストラクタがありません")))),
        }
    }

    fn parts(&mut self, kind: Type, kinds: &[Type], arguments: Vec<CompiledValue>) -> Result<CompiledValue, Refusal> {
        if kinds.len() != arguments.len() {
            return Err(self.invalid(both(
                format!("{kind} is made of {} values", kinds.len()),
                format!("{kind} の値の個数は {} です", kinds.len()),
            )));
        }
        let mut slots = Vec::new();
        for (argument, kind) in arguments.into_iter().zip(kinds) {
            slots.extend(self.implicit(argument, kind)?.slots);
        }
        Ok(CompiledValue { kind, slots })
    }

    /// All components of the arguments in order, as one type.
    fn components_of(&mut self, arguments: &[CompiledValue], scalar: Scalar) -> Result<Vec<Slot>, Refusal> {
        let mut slots = Vec::new();
        for argument in arguments {
            let from = argument.kind.scalar();
            let from = from.ok_or_else(|| {
                self.invalid(both(
                    format!("{} is not made of numbers", argument.kind),
                    format!("{} は数値から成る型ではありません", argument.kind),
                ))
            })?;
            slots.extend(self.converted(&argument.slots, from, scalar));
        }
        Ok(slots)
    }

    fn vector(&mut self, scalar: Scalar, count: usize, arguments: &[CompiledValue]) -> Result<CompiledValue, Refusal> {
        let kind = Type::Vector(scalar, count as u8);
        // What the vector does not take of a longer one is not converted.
        let first = arguments.first().ok_or_else(|| {
            self.invalid(both(format!("{kind}() without a value"), format!("{kind}() に値がありません")))
        })?;
        let mut slots = if arguments.len() == 1 && first.slots.len() > count {
            let shortened = CompiledValue { kind: first.kind.clone(), slots: first.slots[..count].to_vec() };
            self.components_of(&[shortened], scalar)?
        } else {
            self.components_of(arguments, scalar)?
        };
        if arguments.len() == 1 && first.kind.is_scalar() {
            slots = vec![slots[0]; count];
        }
        if slots.len() < count {
            return Err(self.invalid(both(
                format!("{kind} has {count} components, and {} are given", slots.len()),
                format!("{kind} の成分は {count} 個ですが、{} 個が与えられています", slots.len()),
            )));
        }
        slots.truncate(count);
        Ok(CompiledValue { kind, slots })
    }

    fn matrix(
        &mut self,
        scalar: Scalar,
        [columns, rows]: [usize; 2],
        arguments: &[CompiledValue],
    ) -> Result<CompiledValue, Refusal> {
        let kind = Type::Matrix(scalar, columns as u8, rows as u8);
        let slots = self.components_of(arguments, scalar)?;
        let class = class(scalar);
        let (zero, one) = (self.builder.number(class, 0.0), self.builder.number(class, 1.0));
        let given = match arguments {
            [only] if only.kind.is_scalar() => Some((usize::MAX, 0)),
            [CompiledValue { kind: Type::Matrix(_, columns, rows), .. }] => {
                Some((usize::from(*columns), usize::from(*rows)))
            }
            _ => None,
        };
        let slots = match given {
            None if slots.len() < columns * rows => {
                return Err(self.invalid(both(
                    format!("{kind} has {} components", columns * rows),
                    format!("{kind} の成分は {} 個です", columns * rows),
                )));
            }
            None => slots[..columns * rows].to_vec(),
            Some((from_columns, from_rows)) => (0..columns * rows)
                .map(|index| match (index / rows, index % rows) {
                    (column, row) if from_columns == usize::MAX => {
                        if column == row {
                            slots[0]
                        } else {
                            zero
                        }
                    }
                    (column, row) if column < from_columns && row < from_rows => slots[column * from_rows + row],
                    (column, row) if column == row => one,
                    _ => zero,
                })
                .collect(),
        };
        Ok(CompiledValue { kind, slots })
    }
}
