//! Reads a program as a draft: what stands outside of `main`, and then the definitions of `main`.

use super::{Draft, TEMPORARIES};
use crate::interpreter::code::{ProgramVariable as Outside, Slot};
use crate::interpreter::compile::Compiler;
use crate::interpreter::compile::scope::Symbol;
use crate::interpreter::sheet::{Cell, Formula, StoredOutput};
use crate::interpreter::syntax::{
    Declaration, DeclaredVariable, Expression, ExpressionKind, Function, Item, Name, Statement, StatementKind,
    StorageQualifier,
};
use crate::interpreter::types::Type;
use crate::interpreter::{Refusal, Stage, parse, text};
use crate::text::{Text, both};

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
}
