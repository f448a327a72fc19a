//! Syntax → code: names are resolved, types are checked, and every expression becomes instructions on scalars.

mod builder;
mod call;
mod conditional;
mod constructor;
mod control;
mod conversion;
mod declaration;
mod expression;
mod interface;
mod operator;
mod place;
mod scope;
mod sheet;
mod traced;

pub use builder::{CodeBuilder, class};
pub use conversion::{ParameterDirection, Signature};
pub use sheet::{DefinitionSlip, Draft};

use super::code::{Code, Node, ProgramVariable, Slot};
use super::syntax::{Expression, Function, Item, Name};
use super::types::Type;
use super::{Refusal, Stage};
use crate::text::{Text, both};
use scope::Scopes;
use std::collections::HashMap;
use traced::Tracing;

/// Deepest nesting of statements and calls together.
const MAX_DEPTH: usize = 1_000;

/// A value: its type and where its scalars are.
#[derive(Clone, Debug)]
pub struct CompiledValue {
    /// Its type.
    pub kind: Type,
    /// Its scalars, in order.
    pub slots: Vec<Slot>,
}

/// A function that is declared.
struct DeclaredFunction {
    name: Name,
    signature: Signature,
    parameters: Vec<Slot>,
    result: Slot,
    body: Option<Vec<Node>>,
    /// Functions that it calls.
    calls: Vec<usize>,
    /// How deep its own statements are nested.
    depth: usize,
}

struct Compiler {
    version: u32,
    stage: Stage,
    builder: CodeBuilder,
    scopes: Scopes,
    functions: Vec<DeclaredFunction>,
    by_name: HashMap<Name, Vec<usize>>,
    /// The function whose body is compiled.
    current: Option<usize>,
    depth: usize,
    structures: usize,
    /// The instance names of blocks that go from stage to stage.
    instances: Vec<Name>,
    uniforms: Vec<ProgramVariable>,
    inputs: Vec<ProgramVariable>,
    outputs: Vec<ProgramVariable>,
    locals: Vec<ProgramVariable>,
    defaults: Vec<(Slot, f64)>,
    tracing: Tracing,
}

/// Compiles a parsed file.
///
/// # Errors
/// It is not valid, or something in it is not supported.
pub fn compile(items: &[Item], version: u32, stage: Stage) -> Result<Code, Refusal> {
    let mut compiler = Compiler::new(version, stage);
    items.iter().try_for_each(|item| compiler.item(item))?;
    compiler.finish()
}

/// The same with every value of the program recorded.
///
/// # Errors
/// As for [`compile`].
pub fn compile_traced(items: &[Item], version: u32, stage: Stage) -> Result<Code, Refusal> {
    let mut compiler = Compiler::new(version, stage);
    compiler.tracing.is_on = true;
    items.iter().try_for_each(|item| compiler.item(item))?;
    compiler.finish()
}

/// The scalars of an expression that needs nothing around it, as a value of this type.
///
/// # Errors
/// It is not valid, or not of the type, or not known before a program runs.
pub fn constant(expression: &Expression, version: u32, kind: &Type) -> Result<Vec<f64>, Refusal> {
    let mut compiler = Compiler::new(version, Stage::Vertex);
    let value = compiler.initial_value(expression, kind)?;
    let known = value.slots.iter().map(|&slot| compiler.builder.known(slot)).collect::<Option<Vec<f64>>>();
    known.ok_or_else(|| compiler.invalid(both("this is not constant", "定数式ではありません")))
}

impl Compiler {
    fn new(version: u32, stage: Stage) -> Self {
        Self {
            version,
            stage,
            builder: CodeBuilder::default(),
            scopes: Scopes::default(),
            functions: Vec::new(),
            by_name: HashMap::new(),
            current: None,
            depth: 0,
            structures: 0,
            instances: Vec::new(),
            uniforms: Vec::new(),
            inputs: Vec::new(),
            outputs: Vec::new(),
            locals: Vec::new(),
            defaults: Vec::new(),
            tracing: Tracing::default(),
        }
    }

    /// What stands outside of functions.
    fn item(&mut self, item: &Item) -> Result<(), Refusal> {
        let mark = self.builder.mark();
        match item {
            Item::Function(function) => self.function(function)?,
            Item::Declaration(declaration) => self.global(declaration)?,
            Item::Block(block) => self.interface_block(block)?,
            Item::Requalification => {}
        }
        self.end_statement(mark)
    }

    fn invalid(&self, what: Text) -> Refusal {
        Refusal::invalid(self.builder.line, what)
    }

    fn limit(&self, what: Text) -> Refusal {
        Refusal::limit(self.builder.line, what)
    }

    fn end_statement(&mut self, mark: usize) -> Result<(), Refusal> {
        self.builder.release(mark);
        if self.builder.is_full() {
            Err(self.limit(both("this program has too many instructions", "プログラムの命令が多すぎます")))
        } else {
            Ok(())
        }
    }

    /// Collects the nodes that `write` adds, apart from those that are there.
    fn nodes<T>(&mut self, write: impl FnOnce(&mut Self) -> Result<T, Refusal>) -> Result<(Vec<Node>, T), Refusal> {
        let outer = std::mem::take(&mut self.builder.nodes);
        self.depth += 1;
        let result = write(self);
        if let Some(current) = self.current {
            self.functions[current].depth = self.functions[current].depth.max(self.depth);
        }
        self.depth -= 1;
        let nodes = std::mem::replace(&mut self.builder.nodes, outer);
        Ok((nodes, result?))
    }

    fn function(&mut self, function: &Function) -> Result<(), Refusal> {
        self.builder.line = function.line;
        let index = self.declare_function(function)?;
        let Some(body) = &function.body else { return Ok(()) };
        if self.functions[index].body.is_some() {
            return Err(self.invalid(both(
                format!("{} is defined twice", function.name),
                format!("`{}` が 2 回定義されています", function.name),
            )));
        }
        self.current = Some(index);
        self.tracing.function = Some(function.name.to_string());
        self.scopes.push();
        let declared = &self.functions[index];
        let parameters: Vec<_> =
            declared.parameters.iter().copied().zip(declared.signature.parameters.clone()).collect();
        for ((slot, (_, kind)), parameter) in parameters.into_iter().zip(&function.parameters) {
            if !parameter.name.is_empty() {
                self.scopes.declare(Name::clone(&parameter.name), scope::Symbol::variable(kind, slot));
            }
        }
        // Temporaries of the globals' initialisers are not shared with functions.
        self.builder.begin_function();
        let (nodes, ()) = self.nodes(|compiler| compiler.body(index, body))?;
        self.builder.begin_function();
        self.scopes.pop();
        self.current = None;
        self.tracing.function = None;
        self.functions[index].body = Some(nodes);
        Ok(())
    }

    fn finish(mut self) -> Result<Code, Refusal> {
        let main = self
            .by_name
            .get("main")
            .and_then(|all| all.iter().copied().find(|&index| self.functions[index].signature.parameters.is_empty()));
        let main = main.filter(|&main| self.functions[main].body.is_some());
        let main =
            main.ok_or_else(|| Refusal::invalid(0, both("there is no function main", "関数 `main` がありません")))?;
        let mut depths = vec![None; self.functions.len()];
        self.check_calls(main, &mut depths, 0)?;
        let start = std::mem::take(&mut self.builder.nodes);
        Ok(Code {
            constants: self.builder.constants,
            defaults: self.defaults,
            start,
            functions: self.functions.into_iter().map(|declared| declared.body.unwrap_or_default()).collect(),
            main,
            uniforms: self.uniforms,
            inputs: self.inputs,
            outputs: self.outputs,
            locals: self.locals,
            sites: self.tracing.sites,
        })
    }

    /// How deep calls of a function go; it must not call itself, nor one without a body.
    fn check_calls(&self, index: usize, depths: &mut [Option<usize>], above: usize) -> Result<usize, Refusal> {
        let function = &self.functions[index];
        if above > self.functions.len() {
            return Err(Refusal::invalid(
                0,
                both(
                    format!("{} calls itself", function.name),
                    format!("`{}` が自分自身を呼び出しています", function.name),
                ),
            ));
        }
        if function.body.is_none() {
            return Err(Refusal::invalid(
                0,
                both(
                    format!("{} is called and not defined", function.name),
                    format!("`{}` が呼び出されていますが、定義されていません", function.name),
                ),
            ));
        }
        if let Some(depth) = depths[index] {
            return Ok(depth);
        }
        let mut depth = 0;
        for &called in &function.calls {
            depth = depth.max(self.check_calls(called, depths, above + 1)?);
        }
        let depth = depth + function.depth + 1;
        if depth > MAX_DEPTH {
            return Err(Refusal::limit(
                0,
                both("calls and statements are nested too deeply", "関数呼び出しと文の入れ子が深すぎます"),
            ));
        }
        depths[index] = Some(depth);
        Ok(depth)
    }
}
