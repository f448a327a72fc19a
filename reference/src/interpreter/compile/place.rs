//! Places: what can be written to, and read a part at a time.

use super::scope::{Symbol, UNSIZED};
use super::{CompiledValue, Compiler};
use crate::interpreter::Refusal;
use crate::interpreter::code::{Indexed, Node, Slot};
use crate::interpreter::syntax::{Expression, ExpressionKind, Name};
use crate::interpreter::types::Type;
use crate::text::both;

/// A variable, or a part of one.
#[derive(Clone, Debug)]
pub struct LValue {
    /// What lies there.
    pub kind: Type,
    /// The first slot, as far as it is known.
    pub base: Slot,
    /// How much further it lies, where an index is not known.
    offset: Option<Slot>,
    /// Which components of a vector, where they are named.
    components: Option<Vec<Slot>>,
}

impl Compiler {
    /// The place that an expression names; `None` where it is a value.
    pub(super) fn place(&mut self, expression: &Expression) -> Result<Option<LValue>, Refusal> {
        self.builder.line = expression.line;
        match &expression.kind {
            ExpressionKind::Name(name) => self.variable(name).map(Some),
            ExpressionKind::Index(of, index) => {
                let Some(place) = self.place(of)? else { return Ok(None) };
                if place.components.is_some() {
                    return Ok(None);
                }
                let index = self.index(index)?;
                self.builder.line = expression.line;
                self.element(place, &index).map(Some)
            }
            ExpressionKind::Member(of, name) => {
                let Some(place) = self.place(of)? else { return Ok(None) };
                self.builder.line = expression.line;
                self.member(place, name).map(Some)
            }
            ExpressionKind::Comma(one) if one.len() == 1 => self.place(&one[0]),
            _ => Ok(None),
        }
    }

    fn variable(&mut self, name: &Name) -> Result<LValue, Refusal> {
        if self.scopes.get(name).is_none() && name.starts_with("gl_") {
            self.declare_built_in(name)?;
        }
        match self.scopes.get(name) {
            Some(Symbol::Variable { kind, slot }) => {
                Ok(LValue { kind: kind.clone(), base: *slot, offset: None, components: None })
            }
            Some(Symbol::Unsupported([en, ja])) => Err(self.limit(both(*en, *ja))),
            Some(Symbol::Structure(_)) => {
                Err(self.invalid(both(format!("`{name}` is a type"), format!("`{name}` は型の名前です"))))
            }
            None => {
                Err(self.invalid(both(format!("there is no variable `{name}`"), format!("変数 `{name}` がありません"))))
            }
        }
    }

    /// Slots of a value in a row, so that they can be indexed.
    pub(super) fn laid_out(&mut self, value: CompiledValue) -> Result<LValue, Refusal> {
        let base = self.builder.allocate(value.slots.len())?;
        self.store(base, &value.slots);
        Ok(LValue { kind: value.kind, base, offset: None, components: None })
    }

    pub(super) fn element(&mut self, place: LValue, index: &CompiledValue) -> Result<LValue, Refusal> {
        let element = place.kind.element();
        let (kind, count) = element.ok_or_else(|| {
            self.invalid(both(format!("{} has no elements", place.kind), format!("{} に要素はありません", place.kind)))
        })?;
        let count = count.unwrap_or(UNSIZED);
        let stride = kind.slots().ok_or_else(|| {
            self.invalid(both("the length of this array is not known", "この配列の長さが分かりません"))
        })?;
        let index = *index
            .slots
            .first()
            .ok_or_else(|| self.invalid(both("an index is a whole number", "添字は整数でなければなりません")))?;
        if let Some(known) = self.builder.known(index).filter(|&known| known >= 0.0 && known < count as f64) {
            let base = place.base + known as Slot * stride as Slot;
            return Ok(LValue { kind, base, ..place });
        }
        let (to, line) = (self.builder.temporary(), self.builder.line);
        let (count, stride) = (count as u32, stride as u32);
        self.builder.push(Node::Offset { to, before: place.offset, index, count, stride, line });
        Ok(LValue { kind, offset: Some(to), ..place })
    }

    fn member(&mut self, place: LValue, name: &str) -> Result<LValue, Refusal> {
        match &place.kind {
            Type::Struct(structure) => {
                let mut base = place.base;
                for (member, kind) in &structure.members {
                    if member == name {
                        return Ok(LValue { kind: kind.clone(), base, ..place });
                    }
                    base += kind.slots().unwrap_or(0) as Slot;
                }
                Err(self.invalid(both(
                    format!("{} has no member `{name}`", structure.name),
                    format!("{} にメンバ `{name}` はありません", structure.name),
                )))
            }
            Type::Vector(scalar, count) => {
                let chosen = components(name, *count);
                let chosen = chosen.ok_or_else(|| {
                    self.invalid(both(
                        format!("{} has no component `{name}`", place.kind),
                        format!("{} に成分 `{name}` はありません", place.kind),
                    ))
                })?;
                let kind = Type::Vector(*scalar, chosen.len() as u8);
                let chosen = match &place.components {
                    Some(before) => chosen.into_iter().map(|index| before[index as usize]).collect(),
                    None => chosen,
                };
                Ok(LValue { kind, components: Some(chosen), ..place })
            }
            other => Err(self.invalid(both(
                format!("{other} has no member `{name}`"),
                format!("{other} にメンバ `{name}` はありません"),
            ))),
        }
    }

    /// The slots of a place, before an unknown index is added.
    fn slots_of(&self, place: &LValue) -> Result<Vec<Slot>, Refusal> {
        match &place.components {
            Some(components) => Ok(components.iter().map(|component| place.base + component).collect()),
            None => {
                let size = place.kind.slots().ok_or_else(|| {
                    self.invalid(both("the length of this array is not known", "この配列の長さが分かりません"))
                })?;
                Ok((place.base..).take(size).collect())
            }
        }
    }

    /// The value at a place: a variable's own slots where that is possible.
    pub(super) fn read(&mut self, place: &LValue) -> Result<CompiledValue, Refusal> {
        let mut slots = self.slots_of(place)?;
        if let Some(offset) = place.offset {
            for slot in &mut slots {
                let (to, line) = (self.builder.temporary(), self.builder.line);
                self.builder.push(Node::Gather { to, from: Indexed { base: *slot, offset }, line });
                *slot = to;
            }
        }
        Ok(CompiledValue { kind: place.kind.clone(), slots })
    }

    /// Writes a value, which has the place's type.
    pub(super) fn write(&mut self, place: &LValue, value: &CompiledValue) -> Result<(), Refusal> {
        let slots = self.slots_of(place)?;
        if slots.iter().any(|&slot| self.builder.known(slot).is_some()) {
            return Err(self.invalid(both("a constant is written", "定数に値を書き込んでいます")));
        }
        // What is read must not be overwritten before: `v.xy = v.yx`.
        let overlaps = |(index, slot): (usize, &Slot)| slots[..index.min(slots.len())].contains(slot);
        let from = match place.offset.is_none() && value.slots.iter().enumerate().any(overlaps) {
            true => self.builder.copies(&value.slots),
            false => value.slots.clone(),
        };
        let line = self.builder.line;
        for (&to, &from) in slots.iter().zip(&from) {
            self.builder.push(match place.offset {
                Some(offset) => Node::Scatter { to: Indexed { base: to, offset }, from, line },
                None => Node::Store { to, from },
            });
        }
        Ok(())
    }

    /// The slots that a place may lie in.
    pub(super) fn all_slots(&self, place: &LValue) -> Vec<Slot> {
        match (place.offset, self.slots_of(place)) {
            (None, Ok(slots)) => slots,
            // Any of the elements: those from the first on.
            _ => (place.base..(place.base + 64).min(self.builder.constants.len() as Slot)).collect(),
        }
    }

    /// Stores scalars in a row of slots.
    pub(super) fn store(&mut self, base: Slot, from: &[Slot]) {
        for (to, &from) in (base..).zip(from) {
            self.builder.push(Node::Store { to, from });
        }
    }
}

/// The components that a word names: all out of one of the three sets.
pub(super) fn components(name: &str, count: u8) -> Option<Vec<Slot>> {
    let in_set = |set: &str| -> Option<Vec<Slot>> {
        let one = |letter| set.find(letter).filter(|&index| index < usize::from(count)).map(|index| index as Slot);
        name.chars().map(one).collect()
    };
    let found = in_set("xyzw").or_else(|| in_set("rgba")).or_else(|| in_set("stpq"));
    found.filter(|components| (1..=4).contains(&components.len()))
}
