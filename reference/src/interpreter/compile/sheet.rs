//! A program's `main` as a list of definitions, each of which is compiled by itself.

use super::Compiler;
use super::scope::Symbol;
use crate::interpreter::change::{self, Change, FREE, NameScope, Operator, written};
use crate::interpreter::code::{Node, ProgramVariable as Outside, Slot};
use crate::interpreter::sheet::{Cell, Formula, Sheet, StoredOutput};
use crate::interpreter::syntax::{
    Declaration, DeclaredVariable, Expression, ExpressionKind, Function, Item, Name, Statement, StatementKind,
    StorageQualifier,
};
use crate::interpreter::texture::Texture;
use crate::interpreter::types::Type;
use crate::interpreter::{Refusal, Stage, builtin, parse, text};
use crate::text::{Text, both};
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

/// As many as usual formulas need.
const TEMPORARIES: Slot = 128;

fn only_definitions(line: u32) -> Refusal {
    let what = both(
        "`main` has only definitions `type name = expression;`, and then `output = name;`: put this into a function",
        "`main` に書けるのは、定義 `型 名前 = 式;` と、その後の `出力 = 名前;` だけです。これは関数にしてください",
    );
    Refusal::invalid(line, what)
}

impl Draft {
    /// Reads a program. The constants in `open` keep their slots, so that they can be given other values.
    ///
    /// # Errors
    /// It is not GLSL, its `main` is no list of definitions, or it uses something that is not supported.
    pub fn read(source: &str, stage: Stage, open: &[&str]) -> Result<Self, Refusal> {
        let (mut draft, main) = Self::outside(source, stage, open)?;
        if let Some(hindrance) = draft.hindrance.take() {
            return Err(hindrance);
        }
        let main =
            main.ok_or_else(|| Refusal::invalid(0, both("there is no function main", "関数 `main` がありません")))?;
        draft.main(&main)?;
        Ok(draft)
    }

    /// The values of those constants of a program that have these names; what its `main` does makes no difference.
    ///
    /// # Errors
    /// What stands outside of `main` is not GLSL.
    pub fn constants(source: &str, stage: Stage, names: &[&str]) -> Result<Vec<(Cell, Vec<f64>)>, Refusal> {
        let (draft, _) = Self::outside(source, stage, names)?;
        let value = |cell: Cell| {
            let values = draft.values.iter().filter(|(slot, _)| cell.slots.contains(slot));
            (cell.clone(), values.map(|(_, value)| *value).collect())
        };
        Ok(draft.cells.iter().cloned().map(value).collect())
    }

    /// Everything but `main`, and that.
    fn outside(source: &str, stage: Stage, open: &[&str]) -> Result<(Self, Option<Function>), Refusal> {
        let preprocessed = text::preprocess(source)?;
        let items = parse::parse(&preprocessed.tokens)?;
        let functions = items.iter().filter_map(|item| match item {
            Item::Function(function) => Some(Name::clone(&function.name)),
            _ => None,
        });
        let mut draft = Self {
            compiler: Compiler::new(preprocessed.version, stage),
            functions: functions.collect(),
            cells: Vec::new(),
            values: Vec::new(),
            formulas: Vec::new(),
            expressions: Vec::new(),
            stored: Vec::new(),
            declared: 0,
            hindrance: None,
            temporaries: 0,
            main: 0,
        };
        let mut main = None;
        for item in items {
            match item {
                Item::Function(function) if &*function.name == "main" && function.body.is_some() => {
                    main = Some(function);
                }
                Item::Declaration(declaration)
                    if matches!(
                        declaration.qualifiers.storage,
                        StorageQualifier::Plain | StorageQualifier::Constant
                    ) =>
                {
                    draft.global(&declaration, open)?;
                }
                other => draft.compiler.item(&other)?,
            }
        }
        Ok((draft, main))
    }

    /// Variables outside of functions, which should be constant and known.
    fn global(&mut self, declaration: &Declaration, open: &[&str]) -> Result<(), Refusal> {
        let is_constant = declaration.qualifiers.storage == StorageQualifier::Constant;
        let compiler = &mut self.compiler;
        let mark = compiler.builder.mark();
        compiler.builder.line = declaration.line;
        let base = compiler.type_of(&declaration.kind)?;
        for variable in &declaration.variables {
            let name = &variable.name;
            compiler.plain_variable(&base, variable, is_constant)?;
            let Some(Symbol::Variable { kind, slot }) = compiler.scopes.get(name).cloned() else { continue };
            let slots = slot..slot + kind.slots().unwrap_or(0) as Slot;
            let known = slots.clone().map(|slot| compiler.builder.known(slot)).collect::<Option<Vec<f64>>>();
            match known.filter(|_| is_constant) {
                Some(known) if open.contains(&&**name) => {
                    slots.clone().for_each(|slot| compiler.builder.constants[slot as usize] = None);
                    self.values.extend(slots.zip(known));
                    self.cells.push(Cell::new(name, kind, slot, variable.line));
                }
                Some(_) => {}
                None => {
                    let what = both(
                        format!("`{name}` is not known before `main`: write `const` before it, or move it there"),
                        format!(
                            "`main` の前では `{name}` の値が決まりません。`const` を付けるか、`main` の中に移してください"
                        ),
                    );
                    self.hindrance.get_or_insert(Refusal::limit(variable.line, what));
                }
            }
        }
        compiler.end_statement(mark)
    }

    fn main(&mut self, main: &Function) -> Result<(), Refusal> {
        let compiler = &mut self.compiler;
        let outside = compiler.uniforms.iter().chain(&compiler.inputs);
        let cell = |one: &Outside| Cell::new(&one.name, one.kind.clone(), one.slot, one.line);
        self.cells.extend(outside.map(cell));
        self.declared = compiler.inputs.len();
        self.temporaries = compiler.builder.allocate(TEMPORARIES as usize)?;
        self.main = compiler.declare_function(main)?;
        compiler.functions[self.main].body = Some(Vec::new());
        compiler.current = Some(self.main);
        compiler.scopes.push();
        compiler.builder.begin_function();
        for statement in main.body.iter().flatten() {
            self.statement(statement)?;
        }
        // What is free in a formula has one place for all of them.
        let slot = self.compiler.builder.allocate(1)?;
        self.cells.push(Cell::new("", Type::FLOAT, slot, 0));
        self.check_calls()
    }

    fn statement(&mut self, statement: &Statement) -> Result<(), Refusal> {
        match &statement.kind {
            StatementKind::Empty => Ok(()),
            StatementKind::Declaration(declaration)
                if matches!(declaration.qualifiers.storage, StorageQualifier::Plain | StorageQualifier::Constant) =>
            {
                declaration.variables.iter().try_for_each(|variable| self.define(declaration, variable))
            }
            StatementKind::Expression(Expression { kind: ExpressionKind::Assign(None, to, from), .. }) => {
                self.output(to, from, statement.line)
            }
            _ => Err(only_definitions(statement.line)),
        }
    }

    fn define(&mut self, declaration: &Declaration, variable: &DeclaredVariable) -> Result<(), Refusal> {
        let name = &variable.name;
        let refused = |what: Text| Err(Refusal::invalid(variable.line, what));
        let Some(value) = &variable.value else {
            return refused(both(
                format!("`{name}` has no value: write `{name} = …` where it is declared"),
                format!("`{name}` に値がありません。宣言するところで `{name} = …` と書いてください"),
            ));
        };
        if self.compiler.scopes.get(name).is_some() {
            return refused(both(
                format!("`{name}` is the name of something else already: choose another"),
                format!("名前 `{name}` はすでに使われています。別の名前にしてください"),
            ));
        }
        let base = self.compiler.type_of(&declaration.kind)?;
        let kind = self.compiler.arrays_of(base, &variable.lengths)?;
        let (nodes, (slot, kind)) = self.compiled(value, &kind, None)?;
        self.cells.push(Cell::new(name, kind.clone(), slot, variable.line));
        self.compiler.scopes.declare(Name::clone(name), Symbol::variable(kind, slot));
        let formula = self.formula(self.cells.len() - 1, nodes, variable.line)?;
        self.formulas.push(formula);
        self.expressions.push(value.clone());
        Ok(())
    }

    /// `output = name;`, or `output = expression;`: a definition that has the output's name.
    fn output(&mut self, to: &Expression, from: &Expression, line: u32) -> Result<(), Refusal> {
        let ExpressionKind::Name(output) = &to.kind else { return Err(only_definitions(line)) };
        if self.defined(output).is_some() {
            let what = both(
                format!("`{output}` has a value already: give the new one a name of its own"),
                format!("`{output}` にはすでに値があります。新しい値には別の名前を付けてください"),
            );
            return Err(Refusal::invalid(line, what));
        }
        self.compiler.place(to)?;
        let Some(known) = self.compiler.outputs.iter().find(|known| known.name == **output) else {
            return Err(Refusal::invalid(
                line,
                both(
                    format!("`{output}` is no output of this stage"),
                    format!("`{output}` はこのステージの出力ではありません"),
                ),
            ));
        };
        let cell = match &from.kind {
            ExpressionKind::Name(name) => self.defined(name),
            _ => None,
        };
        let cell = match cell.filter(|&cell| self.cells[cell].kind == known.kind) {
            Some(cell) => cell,
            None => {
                let (kind, slot) = (known.kind.clone(), known.slot);
                let (nodes, _) = self.compiled(from, &kind, Some(slot))?;
                self.cells.push(Cell::new(output, kind, slot, line));
                let cell = self.cells.len() - 1;
                let formula = self.formula(cell, nodes, line)?;
                self.formulas.push(formula);
                self.expressions.push(from.clone());
                cell
            }
        };
        self.stored.push(StoredOutput { output: output.to_string(), cell, line });
        Ok(())
    }

    fn defined(&self, name: &str) -> Option<usize> {
        self.formulas.iter().map(Formula::cell).find(|&cell| self.cells[cell].name == name)
    }

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
