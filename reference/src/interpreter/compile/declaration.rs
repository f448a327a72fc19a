//! Types as they are written, variables, functions.

use super::conversion::{ParameterDirection, Signature};
use super::scope::{self, Symbol};
use super::{CompiledValue, Compiler, DeclaredFunction};
use crate::interpreter::Refusal;
use crate::interpreter::code::{CodeConstant, Slot};
use crate::interpreter::run::Undefined;
use crate::interpreter::syntax::{
    BaseType, Declaration, DeclaredVariable, Expression, ExpressionKind, Function, Name, StorageQualifier, TypeName,
};
use crate::interpreter::types::{Scalar, Struct, Type};
use crate::text::both;
use std::sync::Arc;

impl Compiler {
    /// The type that is written.
    pub(super) fn type_of(&mut self, name: &TypeName) -> Result<Type, Refusal> {
        self.builder.line = name.line;
        let base = match &name.base {
            BaseType::Named(name) => match self.scopes.get(name) {
                Some(Symbol::Structure(kind)) => kind.clone(),
                _ => Type::named(name).ok_or_else(|| {
                    self.limit(both(format!("there is no type `{name}`"), format!("型 `{name}` がありません")))
                })?,
            },
            BaseType::Struct(name, members) => self.structure(name, members)?,
        };
        self.arrays_of(base, &name.lengths)
    }

    fn structure(&mut self, name: &Name, members: &[Declaration]) -> Result<Type, Refusal> {
        let members = self.member_types(members)?;
        self.structures += 1;
        let structure = Struct::new(name.to_string(), self.structures, members);
        let kind = Type::Struct(Arc::new(structure));
        if !name.is_empty() {
            self.scopes.declare(Name::clone(name), Symbol::Structure(kind.clone()));
        }
        Ok(kind)
    }

    /// Names and types of a structure's or block's members.
    pub(super) fn member_types(&mut self, members: &[Declaration]) -> Result<Vec<(String, Type)>, Refusal> {
        let mut all = Vec::new();
        for member in members {
            let kind = self.type_of(&member.kind)?;
            for variable in &member.variables {
                all.push((variable.name.to_string(), self.arrays_of(kind.clone(), &variable.lengths)?));
            }
        }
        Ok(all)
    }

    /// Arrays of a type: of `[a][b]`, the first is the outermost.
    pub(super) fn arrays_of(&mut self, mut kind: Type, lengths: &[Option<Expression>]) -> Result<Type, Refusal> {
        for length in lengths.iter().rev() {
            let length = match length {
                Some(length) => {
                    let value = self.constant_whole(length)?;
                    let length = Some(value).filter(|&value| value >= 1.0);
                    Some(length.ok_or_else(|| {
                        self.invalid(both(
                            "an array's length must be positive",
                            "配列の長さは 1 以上でなければなりません",
                        ))
                    })? as usize)
                }
                None => None,
            };
            kind = kind.array(length);
        }
        Ok(kind)
    }

    /// The value of a constant whole number.
    pub(super) fn constant_whole(&mut self, expression: &Expression) -> Result<f64, Refusal> {
        let value = self.untraced(|compiler| compiler.value(expression))?;
        let is_whole = value.kind.is_scalar() && value.kind.scalar().is_some_and(Scalar::is_integer);
        let known = value.slots.first().and_then(|&slot| self.builder.known(slot)).filter(|_| is_whole);
        known.ok_or_else(|| self.invalid(both("a constant whole number is expected", "整数の定数式が必要です")))
    }

    /// Slots for a variable of this type.
    pub(super) fn allocate(&mut self, kind: &Type) -> Result<Slot, Refusal> {
        let size = scope::size(kind)
            .ok_or_else(|| self.limit(both("this variable is too large", "この変数は大きすぎます")))?;
        self.builder.allocate(size)
    }

    /// Declares variables without qualifiers, or constants.
    pub(super) fn plain_variables(&mut self, declaration: &Declaration) -> Result<(), Refusal> {
        let base = self.type_of(&declaration.kind)?;
        let is_constant = declaration.qualifiers.storage == StorageQualifier::Constant;
        declaration.variables.iter().try_for_each(|variable| self.plain_variable(&base, variable, is_constant))
    }

    /// Declares one of them.
    pub(super) fn plain_variable(
        &mut self,
        base: &Type,
        variable: &DeclaredVariable,
        is_constant: bool,
    ) -> Result<(), Refusal> {
        self.builder.line = variable.line;
        let kind = self.arrays_of(base.clone(), &variable.lengths)?;
        let Some(value) = &variable.value else { return self.without_value(&variable.name, kind) };
        let value = self.first_value(variable, value, &kind, is_constant)?;
        let slot = self.with_value(value.clone(), is_constant)?;
        self.gave(&variable.name, &value, slot);
        self.scopes.declare(Name::clone(&variable.name), Symbol::variable(value.kind.clone(), slot));
        self.remember_local(&variable.name, &value.kind, slot);
        Ok(())
    }

    /// An outermost local of `main` can be looked at when the program has run.
    fn remember_local(&mut self, name: &Name, kind: &Type, slot: Slot) {
        let is_main = self.current.is_some_and(|current| &*self.functions[current].name == "main");
        // The file's scope, and that of parameters and body.
        if is_main && self.scopes.depth() == 2 {
            let (name, kind, line) = (name.to_string(), kind.clone(), self.builder.line);
            let (interpolation, location) = Default::default();
            self.locals.push(crate::interpreter::code::ProgramVariable {
                written: name.clone(),
                name,
                kind,
                slot,
                line,
                interpolation,
                location,
                place: None,
            });
        }
    }

    fn without_value(&mut self, name: &Name, kind: Type) -> Result<(), Refusal> {
        if let Some(Symbol::Variable { kind: known @ Type::Array(_, None), slot }) = self.scopes.innermost(name) {
            // A later declaration of an array gives its length.
            let (slot, fits) = (*slot, kind.slots() <= scope::size(known));
            if fits {
                self.scopes.declare(Name::clone(name), Symbol::variable(kind, slot));
                return Ok(());
            }
        }
        let slot = self.allocate(&kind)?;
        let size = scope::size(&kind).unwrap_or(0);
        self.builder.undefine(slot, size, Undefined::Uninitialised);
        self.remember_local(name, &kind, slot);
        self.scopes.declare(Name::clone(name), Symbol::variable(kind, slot));
        Ok(())
    }

    /// A variable's own slots, which hold the value.
    fn with_value(&mut self, value: CompiledValue, is_constant: bool) -> Result<Slot, Refusal> {
        let known: Option<Vec<CodeConstant>> =
            value.slots.iter().map(|&slot| self.builder.constants[slot as usize]).collect();
        match known.filter(|_| is_constant) {
            Some(values) => self.builder.allocate_constants(&values),
            None => {
                let slot = self.builder.allocate(value.slots.len())?;
                self.store(slot, &value.slots);
                Ok(slot)
            }
        }
    }

    /// What stands behind `=` in a declaration.
    pub(super) fn initial_value(&mut self, value: &Expression, kind: &Type) -> Result<CompiledValue, Refusal> {
        if let ExpressionKind::List(elements) = &value.kind {
            return self.list(elements, kind);
        }
        let value = self.value(value)?;
        if let (Type::Array(element, None), Type::Array(found, _)) = (kind, &value.kind)
            && same_but_for_lengths(element, found)
        {
            return Ok(value);
        }
        if same_but_for_lengths(kind, &value.kind) && kind.slots().is_none() {
            return Ok(value);
        }
        self.implicit(value, kind)
    }

    /// `{ … }` as a value of this type.
    fn list(&mut self, elements: &[Expression], kind: &Type) -> Result<CompiledValue, Refusal> {
        let kinds: Vec<Type> = match kind {
            Type::Struct(structure) => structure.members.iter().map(|(_, kind)| kind.clone()).collect(),
            other => match other.element() {
                Some((element, length)) => vec![element; length.unwrap_or(elements.len())],
                None if elements.len() == 1 => return self.initial_value(&elements[0], kind),
                None => {
                    return Err(self.invalid(both(
                        format!("{kind} has no parts"),
                        format!("{kind} は `{{ }}` で初期化できません"),
                    )));
                }
            },
        };
        if kinds.len() != elements.len() {
            return Err(self.invalid(both(
                format!("{kind} has {} parts", kinds.len()),
                format!("{kind} の要素は {} 個です", kinds.len()),
            )));
        }
        let mut slots = Vec::new();
        let mut element_kind = None;
        for (element, kind) in elements.iter().zip(&kinds) {
            let part = self.initial_value(element, kind)?;
            slots.extend(if value_may_change(elements) { self.builder.copies(&part.slots) } else { part.slots });
            element_kind = Some(part.kind);
        }
        let kind = match (kind, element_kind) {
            (Type::Array(..), Some(element)) => element.array(Some(elements.len())),
            _ => kind.clone(),
        };
        Ok(CompiledValue { kind, slots })
    }

    /// The number of a function, which is new or was declared before.
    pub(super) fn declare_function(&mut self, function: &Function) -> Result<usize, Refusal> {
        let result = self.type_of(&function.result)?;
        let mut parameters = Vec::new();
        for parameter in &function.parameters {
            let kind = self.type_of(&parameter.kind)?;
            let direction = match parameter.storage {
                StorageQualifier::Output => ParameterDirection::Out,
                StorageQualifier::InputOutput => ParameterDirection::InOut,
                _ => ParameterDirection::In,
            };
            parameters.push((direction, self.arrays_of(kind, &parameter.lengths)?));
        }
        self.builder.line = function.line;
        let signature = Signature { parameters, result };
        let known = self.by_name.get(&function.name).cloned().unwrap_or_default();
        if let Some(index) = known.into_iter().find(|&index| self.functions[index].signature == signature) {
            return Ok(index);
        }
        let slots: Result<Vec<Slot>, Refusal> =
            signature.parameters.iter().map(|(_, kind)| self.allocate(kind)).collect();
        let declared = DeclaredFunction {
            name: Name::clone(&function.name),
            parameters: slots?,
            result: self.allocate(&signature.result)?,
            signature,
            body: None,
            calls: Vec::new(),
            depth: 0,
        };
        self.functions.push(declared);
        let index = self.functions.len() - 1;
        self.by_name.entry(Name::clone(&function.name)).or_default().push(index);
        Ok(index)
    }
}

/// Whether a later part of a list may change what an earlier one has read.
fn value_may_change(elements: &[Expression]) -> bool {
    elements.iter().any(|element| element.changes)
}

fn same_but_for_lengths(a: &Type, b: &Type) -> bool {
    match (a, b) {
        (Type::Array(a, None), Type::Array(b, _)) => same_but_for_lengths(a, b),
        (Type::Array(a, Some(n)), Type::Array(b, Some(m))) => n == m && same_but_for_lengths(a, b),
        _ => a == b,
    }
}
