//! The slips of a definition: what somebody may have written in its place.

use super::Draft;
use crate::interpreter::change::{self, Change, FREE, NameScope, Operator, written};
use crate::interpreter::compile::scope::Symbol;
use crate::interpreter::sheet::{Cell, Formula};
use crate::interpreter::syntax::{Expression, Name};
use crate::interpreter::types::Type;
use crate::interpreter::{parse, text};
use std::collections::HashSet;

/// A definition by a slip.
pub struct DefinitionSlip {
    /// Of which kind it is.
    pub operator: Operator,
    /// The name that is concerned, where it is a single one.
    pub about: Option<String>,
    /// Whether it is in the whole definition, not in a part of it.
    pub is_whole: bool,
    /// Whether it is a bound of 0 that is concerned.
    pub is_bound_by_zero: bool,
    /// What is written.
    pub text: String,
    /// Whether a number in it is free.
    pub is_free: bool,
    /// How it is computed.
    pub formula: Formula,
}

/// A name, or the path of a member, as an expression.
fn path(name: &str) -> Option<Expression> {
    let tokens = text::preprocess(name).ok()?.tokens;
    parse::parse_expression(&tokens, HashSet::new()).ok()
}

impl Draft {
    /// The slips of a definition, as far as they have its type and use what is there before it.
    pub fn slips(&mut self, definition: usize) -> Vec<DefinitionSlip> {
        let cell = self.formulas[definition].cell();
        let root = self.expressions[definition].clone();
        let named = self.cells[..cell].iter().filter(|cell| !cell.name.is_empty());
        let names: Vec<(Expression, Type)> =
            named.filter_map(|cell| Some((path(&cell.name)?, cell.kind.clone()))).rev().collect();
        let varies: HashSet<usize> = self.formulas.iter().map(Formula::cell).collect();
        let inputs: Vec<&str> = self.compiler.inputs.iter().map(|input| input.name.as_str()).collect();
        let is_constant = |(at, cell): &(usize, &Cell)| !varies.contains(at) && !inputs.contains(&cell.name.as_str());
        let constants = self.cells.iter().enumerate().filter(is_constant).map(|(_, cell)| cell.name.clone()).collect();
        let compiler = &mut self.compiler;
        let mut kind = |expression: &Expression| {
            let mark = compiler.builder.mark();
            let value = compiler.nodes(|compiler| compiler.value(expression));
            compiler.end_statement(mark).ok()?;
            Some(value.ok()?.1.kind)
        };
        let mut scope = NameScope { names: &names, constants: &constants, kind: &mut kind, free: true };
        let changes = change::changes(&root, &mut scope);
        self.compiler.scopes.push();
        if let Some(last) = self.cells.last() {
            self.compiler.scopes.declare(Name::from(FREE), Symbol::variable(Type::FLOAT, last.slots.start));
        }
        let free = self.cells.len() - 1;
        let slips = changes.into_iter().filter_map(|change| self.slip(cell, free, &change)).collect();
        self.compiler.scopes.pop();
        slips
    }

    fn slip(&mut self, cell: usize, free: usize, change: &Change) -> Option<DefinitionSlip> {
        let Cell { kind, slots, .. } = self.cells[cell].clone();
        let (nodes, _) = self.compiled(&change.expression, &kind, Some(slots.start)).ok()?;
        let formula = self.formula(cell, nodes, 1).ok()?;
        let is_known = formula.uses().iter().all(|used| *used < cell || *used == free);
        is_known.then(|| DefinitionSlip {
            operator: change.operator,
            about: change.about.as_ref().map(|name| name.to_string()),
            text: written(&change.expression),
            is_whole: change.is_whole,
            is_bound_by_zero: change.is_bound_by_zero,
            is_free: formula.uses().contains(&free),
            formula,
        })
    }
}
