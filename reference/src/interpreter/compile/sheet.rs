//! A program's `main` as a list of definitions, each of which is compiled by itself.

mod program;
mod slip;

pub use slip::DefinitionSlip;

use super::Compiler;
use super::scope::Symbol;
use crate::interpreter::code::{Node, Slot};
use crate::interpreter::sheet::{Cell, Formula, Sheet, StoredOutput};
use crate::interpreter::syntax::{Expression, Name};
use crate::interpreter::texture::Texture;
use crate::interpreter::types::Type;
use crate::interpreter::{Refusal, builtin, parse, text};
use crate::text::both;
use std::collections::HashSet;
use std::sync::Arc;

/// A [`Sheet`] as long as formulas are added to it.
pub struct Draft {
    compiler: Compiler,
    /// Names of the functions, which the parser has to know.
    functions: HashSet<Name>,
    cells: Vec<Cell>,
    /// Values of the constants that may have others.
    values: Vec<(Slot, f64)>,
    formulas: Vec<Formula>,
    /// What the formulas are, as they are written.
    expressions: Vec<Expression>,
    stored: Vec<StoredOutput>,
    /// How many inputs the file declares.
    declared: usize,
    /// What outside of `main` keeps it from being computed a part at a time.
    hindrance: Option<Refusal>,
    /// Slots that all formulas use on their way.
    temporaries: Slot,
    /// `main` among the functions, which calls what the definitions call.
    main: usize,
}

/// As many as usual formulas need.
const TEMPORARIES: Slot = 128;

impl Draft {
    /// An expression that may stand in place of a definition, in which the name of a number may stand that is free.
    ///
    /// # Errors
    /// It is not an expression, or not of the definition's type, or uses what is not there.
    pub fn replacement(&mut self, cell: usize, text: &str, free: Option<&str>) -> Result<Formula, Refusal> {
        let tokens = text::preprocess(text)?.tokens;
        let expression = parse::parse_expression(&tokens, self.functions.clone())?;
        self.compiler.scopes.push();
        if let (Some(name), Some(cell)) = (free, self.cells.last()) {
            self.compiler.scopes.declare(Name::from(name), Symbol::variable(Type::FLOAT, cell.slots.start));
        }
        let Cell { kind, slots, .. } = self.cells[cell].clone();
        let compiled = self.compiled(&expression, &kind, Some(slots.start));
        self.compiler.scopes.pop();
        let (nodes, _) = compiled?;
        self.formula(cell, nodes, 1)
    }

    /// Leaves the slots to a sheet of the same program that it has beyond this draft's: what is compiled from here on can be
    /// computed in the registers of both.
    pub fn beyond(&mut self, sheet: &Sheet) -> Result<(), Refusal> {
        let missing = sheet.slots().saturating_sub(self.compiler.builder.constants.len());
        self.compiler.builder.allocate(missing).map(drop)
    }

    /// A condition on the definitions. Where it holds, the cell of what is free becomes 1, and 0 elsewhere.
    ///
    /// # Errors
    /// See [`Draft::replacement`].
    pub fn condition(&mut self, text: &str) -> Result<Formula, Refusal> {
        let tokens = text::preprocess(text)?.tokens;
        let expression = parse::parse_expression(&tokens, self.functions.clone())?;
        let cell = self.cells.len() - 1;
        let (nodes, _) = self.compiled(&expression, &Type::BOOL, Some(self.cells[cell].slots.start))?;
        self.formula(cell, nodes, 1)
    }

    /// Whether a name can be that of something new.
    pub fn is_free(&self, name: &str) -> bool {
        let is_word = text::preprocess(name).is_ok_and(|read| matches!(&*read.tokens, [one] if one.is_name()));
        let is_known = self.compiler.scopes.get(name).is_some() || self.functions.contains(name);
        is_word && !is_known && builtin::signatures(name).is_empty() && Type::named(name).is_none()
    }

    /// What can be named in an expression, see [`Sheet::cells`].
    pub fn cells(&self) -> &[Cell] {
        &self.cells
    }

    /// What the definitions are, in their order.
    pub fn formulas(&self) -> &[Formula] {
        &self.formulas
    }

    /// What the outputs are given.
    pub fn stored(&self) -> &[StoredOutput] {
        &self.stored
    }

    /// Writes the value of an expression to a place, or to a new one.
    fn compiled(
        &mut self,
        value: &Expression,
        kind: &Type,
        to: Option<Slot>,
    ) -> Result<(Vec<Node>, (Slot, Type)), Refusal> {
        let compiler = &mut self.compiler;
        let mark = compiler.builder.mark();
        let compiled = compiler.nodes(|compiler| {
            let value = compiler.initial_value(value, kind)?;
            let slot = to.map_or_else(|| compiler.builder.allocate(value.slots.len()), Ok)?;
            compiler.store(slot, &value.slots);
            Ok((slot, value.kind))
        })?;
        compiler.end_statement(mark)?;
        Ok(compiled)
    }

    fn formula(&self, cell: usize, nodes: Vec<Node>, line: u32) -> Result<Formula, Refusal> {
        if let Some(input) = self.compiler.inputs.get(self.declared) {
            let what = both(
                format!("a definition does not know `{}`: use only what is declared", input.name),
                format!("定義の中で `{}` は使えません。宣言されているものだけを使ってください", input.name),
            );
            return Err(Refusal::limit(line, what));
        }
        let bodies = self.compiler.functions.iter().map(|declared| declared.body.as_deref().unwrap_or_default());
        let temporaries = self.temporaries..self.temporaries + TEMPORARIES;
        Formula::new(cell, nodes, &self.cells, &bodies.collect::<Vec<_>>(), temporaries)
            .map_err(|(what, at)| Refusal::invalid(if at == 0 { line } else { at }, what))
    }

    fn check_calls(&self) -> Result<(), Refusal> {
        let mut depths = vec![None; self.compiler.functions.len()];
        self.compiler.check_calls(self.main, &mut depths, 0).map(drop)
    }

    /// The sheet, to which no formula is added any more. `textures`: what samplers name by their number.
    ///
    /// # Errors
    /// Functions call one another in a circle.
    pub fn finish(self, textures: Arc<[Texture]>) -> Result<Sheet, Refusal> {
        self.check_calls()?;
        let builder = self.compiler.builder;
        let mut first: Vec<f64> =
            builder.constants.iter().map(|constant| constant.map_or(0.0, |constant| constant.value)).collect();
        for (slot, value) in self.compiler.defaults.into_iter().chain(self.values) {
            first[slot as usize] = value;
        }
        let functions = self.compiler.functions.into_iter().map(|declared| declared.body.unwrap_or_default());
        Ok(Sheet::new(self.cells, functions.collect(), first, self.formulas, textures))
    }
}
