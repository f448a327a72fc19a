//! Which name means what.

use crate::interpreter::code::Slot;
use crate::interpreter::syntax::Name;
use crate::interpreter::types::Type;
use std::collections::HashMap;

/// Elements that an array without a length may have at most.
pub const UNSIZED: usize = 64;

/// What a name stands for.
#[derive(Clone, Debug)]
pub enum Symbol {
    /// A variable of the program.
    Variable { kind: Type, slot: Slot },
    /// A structure.
    Structure(Type),
    /// Something that may be declared and is not supported where it is used.
    Unsupported([&'static str; 2]),
}

impl Symbol {
    /// A variable.
    pub fn variable(kind: Type, slot: Slot) -> Self {
        Self::Variable { kind, slot }
    }
}

/// The scopes around a place, the file's own first.
pub struct Scopes(Vec<HashMap<Name, Symbol>>);

impl Default for Scopes {
    fn default() -> Self {
        Self(vec![HashMap::new()])
    }
}

impl Scopes {
    /// Begins an inner scope.
    pub fn push(&mut self) {
        self.0.push(HashMap::new());
    }

    /// Ends the innermost scope.
    pub fn pop(&mut self) {
        self.0.pop();
    }

    /// How many scopes there are.
    pub fn depth(&self) -> usize {
        self.0.len()
    }

    /// What a name means here.
    pub fn get(&self, name: &str) -> Option<&Symbol> {
        self.0.iter().rev().find_map(|scope| scope.get(name))
    }

    /// What a name means in the innermost scope only.
    pub fn innermost(&self, name: &str) -> Option<&Symbol> {
        self.0.last()?.get(name)
    }

    /// Gives a name a meaning in the innermost scope.
    pub fn declare(&mut self, name: Name, symbol: Symbol) {
        if let Some(scope) = self.0.last_mut() {
            scope.insert(name, symbol);
        }
    }

    /// Gives a name a meaning in the whole file.
    pub fn declare_globally(&mut self, name: Name, symbol: Symbol) {
        self.0[0].insert(name, symbol);
    }
}

/// How many scalars a variable of a type needs, also where its length is not known yet.
pub fn size(kind: &Type) -> Option<usize> {
    match kind {
        Type::Array(element, None) => element.slots()?.checked_mul(UNSIZED),
        other => other.slots(),
    }
}
