//! What a program declares outside of its functions, as far as a repair asks.

use super::super::types::DeclaredTypes;
use crate::interpreter::Stage;
use crate::interpreter::syntax::{BaseType, Declaration, Item, Name, StorageQualifier, TypeName};
use std::collections::HashSet;

#[derive(Clone, Debug)]
pub(super) struct Declared {
    pub types: DeclaredTypes,
    /// The members of its structures.
    pub members: Vec<Name>,
    /// What the scene gives it: no line of the text makes it.
    inputs: HashSet<Name>,
}

impl Declared {
    pub fn of(items: &[Item], stage: Stage) -> Self {
        let declarations = || {
            items.iter().filter_map(|item| match item {
                Item::Declaration(declaration) => Some(declaration),
                _ => None,
            })
        };
        let structures = declarations().filter_map(|declaration| match declaration {
            Declaration { kind: TypeName { base: BaseType::Struct(_, members), .. }, .. } => Some(members),
            _ => None,
        });
        let variables = structures.flatten().flat_map(|member| &member.variables);
        let mut members: Vec<Name> = variables.map(|variable| Name::clone(&variable.name)).collect();
        members.sort();
        members.dedup();
        // What a fragment stage is given between the stages, the student's vertex stage may make.
        let is_given = |declaration: &&Declaration| match declaration.qualifiers.storage {
            StorageQualifier::Uniform => true,
            StorageQualifier::Input | StorageQualifier::Varying => stage == Stage::Vertex,
            _ => false,
        };
        let given = declarations().filter(is_given).flat_map(|declaration| &declaration.variables);
        Self {
            types: DeclaredTypes::of(items),
            members,
            inputs: given.map(|variable| Name::clone(&variable.name)).collect(),
        }
    }

    pub fn is_input(&self, name: &Name) -> bool {
        self.inputs.contains(name)
    }
}
