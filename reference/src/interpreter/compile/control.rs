//! Statements.

use super::{CompiledValue, Compiler};
use crate::interpreter::code::{Node, Slot};
use crate::interpreter::syntax::{Declaration, Expression, LoopCondition, Name, Statement, StatementKind};
use crate::interpreter::types::{Scalar, Type};
use crate::interpreter::{Refusal, Stage};
use crate::text::both;

impl Compiler {
    /// A function's body.
    pub(super) fn body(&mut self, index: usize, statements: &[Statement]) -> Result<(), Refusal> {
        self.undefine_result(index);
        self.statements(statements)
    }

    fn statements(&mut self, statements: &[Statement]) -> Result<(), Refusal> {
        statements.iter().try_for_each(|statement| self.statement(statement))
    }

    fn statement(&mut self, statement: &Statement) -> Result<(), Refusal> {
        self.builder.line = statement.line;
        let mark = self.builder.mark();
        match &statement.kind {
            StatementKind::Empty => {}
            StatementKind::Expression(expression) => {
                self.value(expression)?;
                self.thrown_away();
            }
            StatementKind::Declaration(declaration) => self.plain_variables(declaration)?,
            StatementKind::Block(statements) => self.scoped(|compiler| compiler.statements(statements))?,
            StatementKind::If(condition, yes, no) => {
                let condition = self.truth(condition)?;
                let line = statement.line;
                let (yes, ()) = self.nodes(|compiler| compiler.scoped(|compiler| compiler.statement(yes)))?;
                let (no, ()) = self.nodes(|compiler| {
                    compiler.scoped(|compiler| no.iter().try_for_each(|no| compiler.statement(no)))
                })?;
                self.builder.push(Node::If { condition, yes, no, line });
            }
            StatementKind::Loop(first, condition, step, body) => self.scoped(|compiler| {
                first.iter().try_for_each(|first| compiler.statement(first))?;
                compiler.repeat(condition.as_ref(), step.as_ref(), body, statement.line)
            })?,
            StatementKind::DoWhile(body, condition) => {
                let (body, ()) = self.nodes(|compiler| compiler.scoped(|compiler| compiler.statement(body)))?;
                let (test, condition) = self.nodes(|compiler| compiler.truth(condition))?;
                let (condition, step, line) = (Some(condition), Vec::new(), statement.line);
                self.builder.push(Node::Loop { test, condition, body, step, test_first: false, line });
            }
            StatementKind::Switch(selector, statements) => self.switch(selector, statements)?,
            StatementKind::Case(_) => {
                return Err(self.invalid(both(
                    "`case` stands only directly in a `switch`",
                    "`case` は `switch` の直下にだけ書けます",
                )));
            }
            StatementKind::Break => self.builder.push(Node::Break),
            StatementKind::Continue => self.builder.push(Node::Continue),
            StatementKind::Return(value) => self.result(value.as_ref())?,
            StatementKind::Discard if self.stage == Stage::Fragment => self.builder.push(Node::Discard),
            StatementKind::Discard => {
                return Err(self
                    .invalid(both("only fragments are discarded", "`discard` はフラグメントシェーダでだけ使えます")));
            }
        }
        self.end_statement(mark)
    }

    fn scoped<T>(&mut self, write: impl FnOnce(&mut Self) -> Result<T, Refusal>) -> Result<T, Refusal> {
        self.scopes.push();
        let result = write(self);
        self.scopes.pop();
        result
    }

    /// The slot of a condition.
    fn truth(&mut self, condition: &Expression) -> Result<Slot, Refusal> {
        let value = self.value(condition)?;
        self.only(&value, &Type::BOOL)
    }

    fn only(&self, value: &CompiledValue, kind: &Type) -> Result<Slot, Refusal> {
        match value.slots[..] {
            [slot] if value.kind == *kind => Ok(slot),
            _ => Err(self.invalid(both(
                format!("{kind} is expected, not {}", value.kind),
                format!("{kind} が必要なところに {} があります", value.kind),
            ))),
        }
    }

    fn repeat(
        &mut self,
        condition: Option<&LoopCondition>,
        step: Option<&Expression>,
        body: &Statement,
        line: u32,
    ) -> Result<(), Refusal> {
        let (test, condition) = self.nodes(|compiler| match condition {
            None => Ok(None),
            Some(LoopCondition::Expression(condition)) => compiler.truth(condition).map(Some),
            Some(LoopCondition::Declaration(declaration)) => compiler.declared_condition(declaration).map(Some),
        })?;
        let (body, ()) = self.nodes(|compiler| compiler.scoped(|compiler| compiler.statement(body)))?;
        let (step, ()) = self.nodes(|compiler| {
            let mark = compiler.builder.mark();
            step.iter().try_for_each(|step| compiler.value(step).map(drop))?;
            compiler.end_statement(mark)
        })?;
        self.builder.push(Node::Loop { test, condition, body, step, test_first: true, line });
        Ok(())
    }

    fn declared_condition(&mut self, declaration: &Declaration) -> Result<Slot, Refusal> {
        self.plain_variables(declaration)?;
        let line = declaration.line;
        let variable = declaration
            .variables
            .last()
            .ok_or_else(|| self.invalid(both("a condition is expected", "条件 (bool の値) が必要です")))?;
        let kind = crate::interpreter::syntax::ExpressionKind::Name(Name::clone(&variable.name));
        self.truth(&Expression::made(line, kind))
    }

    fn switch(&mut self, selector: &Expression, statements: &[Statement]) -> Result<(), Refusal> {
        let line = self.builder.line;
        let selector = self.value(selector)?;
        let scalar = selector.kind.scalar().filter(|scalar| scalar.is_integer() && selector.kind.is_scalar());
        let scalar = scalar.ok_or_else(|| {
            self.invalid(both("`switch` takes an integer", "`switch` の値は整数でなければなりません"))
        })?;
        let mut cases: Vec<(Vec<Option<f64>>, Vec<Node>)> = Vec::new();
        self.scopes.push();
        let mut rest = statements;
        while let Some((statement, after)) = rest.split_first() {
            let StatementKind::Case(label) = &statement.kind else {
                let end = rest.iter().position(|one| matches!(one.kind, StatementKind::Case(_)));
                let (of_case, after) = rest.split_at(end.unwrap_or(rest.len()));
                let (mut nodes, ()) = self.nodes(|compiler| compiler.statements(of_case))?;
                let case = cases.last_mut().ok_or_else(|| {
                    self.invalid(both("this stands before the first `case`", "最初の `case` より前に文があります"))
                })?;
                case.1.append(&mut nodes);
                rest = after;
                continue;
            };
            self.builder.line = statement.line;
            let label = label.as_ref().map(|label| self.label(label, scalar)).transpose()?;
            match cases.last_mut() {
                Some((labels, nodes)) if nodes.is_empty() => labels.push(label),
                _ => cases.push((vec![label], Vec::new())),
            }
            rest = after;
        }
        self.scopes.pop();
        let selector = selector.slots[0];
        self.builder.push(Node::Switch { selector, cases, line });
        Ok(())
    }

    /// A label as the number that the selector has: `case -1` is 4294967295 of an unsigned one.
    fn label(&mut self, label: &Expression, scalar: Scalar) -> Result<f64, Refusal> {
        let known = self.constant_whole(label)?;
        Ok(if scalar == Scalar::Uint { f64::from(known as i64 as u32) } else { f64::from(known as i64 as i32) })
    }

    fn result(&mut self, value: Option<&Expression>) -> Result<(), Refusal> {
        let current = self.current.ok_or_else(|| {
            self.invalid(both("`return` stands outside of a function", "関数の外に `return` があります"))
        })?;
        if let Some(value) = value {
            let value = self.value(value)?;
            let kind = self.functions[current].signature.result.clone();
            if kind != Type::Void {
                let value = self.implicit(value, &kind)?;
                let slot = self.functions[current].result;
                self.store(slot, &value.slots);
                self.handed(slot, &value);
            }
        }
        self.builder.push(Node::Return);
        Ok(())
    }
}
