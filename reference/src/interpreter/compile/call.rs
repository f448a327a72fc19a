//! Calls of functions.

use super::conversion::{ParameterDirection, Signature, resolve};
use super::place::LValue;
use super::scope::Symbol;
use super::{CompiledValue, Compiler};
use crate::interpreter::Refusal;
use crate::interpreter::builtin;
use crate::interpreter::code::Node;
use crate::interpreter::run::Undefined;
use crate::interpreter::syntax::{Expression, Name};
use crate::interpreter::types::Type;
use crate::text::both;

/// What stands for a parameter.
enum Argument {
    Value(CompiledValue),
    Place(LValue, CompiledValue),
}

impl Argument {
    fn kind(&self) -> Type {
        match self {
            Self::Value(value) | Self::Place(_, value) => value.kind.clone(),
        }
    }
}

impl Compiler {
    /// `name(arguments)`: a constructor, an own function or a built-in one.
    pub(super) fn call(&mut self, name: &Name, arguments: &[Expression], line: u32) -> Result<CompiledValue, Refusal> {
        let constructed = match self.scopes.get(name) {
            Some(Symbol::Structure(kind)) => Some(kind.clone()),
            _ => Type::named(name).filter(|_| !self.by_name.contains_key(name)),
        };
        if let Some(kind) = constructed {
            let values = self.values(arguments)?;
            self.builder.line = line;
            return self.construct(&kind, values);
        }
        let own = self.by_name.get(name).cloned().unwrap_or_default();
        let built_in = builtin::signatures(name);
        if own.is_empty() && built_in.is_empty() {
            return Err(
                self.limit(both(format!("there is no function `{name}`"), format!("関数 `{name}` がありません")))
            );
        }
        let arguments = self.arguments(arguments, &own, built_in)?;
        self.builder.line = line;
        let kinds: Vec<Type> = arguments.iter().map(Argument::kind).collect();
        let candidates: Vec<&Signature> =
            own.iter().map(|&index| &self.functions[index].signature).chain(built_in).collect();
        let version = self.version.max(120);
        let chosen = resolve(&candidates, &kinds, version).or_else(|| resolve(&candidates, &kinds, 400));
        let Some(chosen) = chosen else {
            let kinds = kinds.iter().map(Type::to_string).collect::<Vec<_>>().join(", ");
            return Err(self.limit(both(
                format!("there is no function `{name}`({kinds})"),
                format!("関数 `{name}`({kinds}) がありません"),
            )));
        };
        let signature = candidates[chosen].clone();
        match own.get(chosen) {
            Some(&index) => self.call_own(index, &signature, arguments),
            None => self.call_built_in(name, &signature, arguments),
        }
    }

    /// Values from left to right; a place besides where some function of that name writes there.
    fn arguments(
        &mut self,
        arguments: &[Expression],
        own: &[usize],
        built_in: &[Signature],
    ) -> Result<Vec<Argument>, Refusal> {
        let mut all = Vec::new();
        for (index, argument) in arguments.iter().enumerate() {
            let writes = |signature: &Signature| {
                signature.parameters.get(index).is_some_and(|(direction, _)| *direction != ParameterDirection::In)
            };
            let writes = own.iter().any(|&own| writes(&self.functions[own].signature)) || built_in.iter().any(writes);
            let place = if writes { self.place(argument)? } else { None };
            let mut value = match &place {
                Some(place) => self.read(place)?,
                None => self.value(argument)?,
            };
            if arguments[index + 1..].iter().any(|later| later.changes) {
                value.slots = self.builder.copies(&value.slots);
            }
            all.push(match place {
                Some(place) => Argument::Place(place, value),
                None => Argument::Value(value),
            });
        }
        Ok(all)
    }

    fn call_own(
        &mut self,
        index: usize,
        signature: &Signature,
        arguments: Vec<Argument>,
    ) -> Result<CompiledValue, Refusal> {
        let parameters = self.functions[index].parameters.clone();
        let mut written = Vec::new();
        // All values are there before the first parameter is set: an argument may call the same function.
        let count = arguments.len();
        let all = arguments.into_iter().zip(&signature.parameters).zip(&parameters);
        for (number, ((argument, (direction, kind)), &slot)) in all.enumerate() {
            let (place, value) = match argument {
                Argument::Value(value) => (None, value),
                Argument::Place(place, value) => (Some(place), value),
            };
            if *direction == ParameterDirection::Out {
                self.builder.undefine(slot, kind.slots().unwrap_or(0), Undefined::Uninitialised);
            } else {
                let value = self.implicit(value, kind)?;
                self.store(slot, &value.slots);
                self.passed(number, count, slot, &value);
            }
            if *direction != ParameterDirection::In {
                let place = place.ok_or_else(|| {
                    self.invalid(both("this cannot be written by a function", "関数はここに値を書き込めません"))
                })?;
                written.push((place, slot, kind.clone()));
            }
        }
        let line = self.builder.line;
        self.builder.push(Node::Call { function: index, line });
        if let Some(current) = self.current {
            self.functions[current].calls.push(index);
        }
        let result: Vec<_> = (self.functions[index].result..).take(signature.result.slots().unwrap_or(0)).collect();
        self.read_from(&result);
        let result = CompiledValue { kind: signature.result.clone(), slots: self.builder.copies(&result) };
        for (place, slot, kind) in written {
            let slots: Vec<_> = (slot..).take(kind.slots().unwrap_or(0)).collect();
            self.handed_back(&place, &slots);
            let value = self.implicit(CompiledValue { kind, slots }, &place.kind)?;
            self.write(&place, &value)?;
        }
        Ok(result)
    }

    fn call_built_in(
        &mut self,
        name: &str,
        signature: &Signature,
        arguments: Vec<Argument>,
    ) -> Result<CompiledValue, Refusal> {
        let (mut values, mut places) = (Vec::new(), Vec::new());
        for (argument, (direction, kind)) in arguments.into_iter().zip(&signature.parameters) {
            match (direction, argument) {
                (ParameterDirection::In, Argument::Value(value) | Argument::Place(_, value)) => {
                    values.push(self.implicit(value, kind)?);
                }
                (_, Argument::Place(place, _)) => places.push((place, kind.clone())),
                (_, Argument::Value(_)) => {
                    return Err(
                        self.invalid(both("this cannot be written by a function", "関数はここに値を書き込めません"))
                    );
                }
            }
        }
        let call = builtin::BuiltinCall { name, arguments: &values, result: &signature.result, stage: self.stage };
        let results = call.write(&mut self.builder).map_err(|what| self.limit(what))?;
        let mut results = results.into_iter();
        let result = CompiledValue { kind: signature.result.clone(), slots: results.next().unwrap_or_default() };
        for ((place, kind), slots) in places.into_iter().zip(results) {
            let value = self.implicit(CompiledValue { kind, slots }, &place.kind)?;
            self.write(&place, &value)?;
        }
        Ok(result)
    }
}
