//! Statements.

use super::{Parser, token};
use crate::interpreter::Refusal;
use crate::interpreter::syntax::{Declaration, LoopCondition, Statement, StatementKind};

impl Parser<'_> {
    /// `{ … }`
    pub(super) fn block(&mut self) -> Result<Vec<Statement>, Refusal> {
        self.expect("{")?;
        let mut statements = Vec::new();
        while !self.takes("}") {
            statements.push(self.nested(Self::statement)?);
        }
        Ok(statements)
    }

    fn statement(&mut self) -> Result<Statement, Refusal> {
        let line = self.line();
        let kind = match self.text(0) {
            "{" => StatementKind::Block(self.block()?),
            ";" => {
                self.at += 1;
                StatementKind::Empty
            }
            "if" => self.selection()?,
            "for" => self.for_loop()?,
            "while" => {
                self.at += 1;
                self.expect("(")?;
                let condition = self.condition()?;
                self.expect(")")?;
                StatementKind::Loop(None, Some(condition), None, self.boxed()?)
            }
            "do" => {
                self.at += 1;
                let body = self.boxed()?;
                self.expect("while")?;
                self.expect("(")?;
                let condition = self.expression()?;
                self.expect(")")?;
                self.expect(";")?;
                StatementKind::DoWhile(body, condition)
            }
            "switch" => {
                self.at += 1;
                self.expect("(")?;
                let selector = self.expression()?;
                self.expect(")")?;
                StatementKind::Switch(selector, self.block()?)
            }
            "case" => {
                self.at += 1;
                let value = self.expression()?;
                self.expect(":")?;
                StatementKind::Case(Some(value))
            }
            "default" if self.text(1) == ":" => {
                self.at += 2;
                StatementKind::Case(None)
            }
            word @ ("break" | "continue" | "discard") => {
                let kind = match word {
                    "break" => StatementKind::Break,
                    "continue" => StatementKind::Continue,
                    _ => StatementKind::Discard,
                };
                self.at += 1;
                self.expect(";")?;
                kind
            }
            "return" => {
                self.at += 1;
                let value = if self.text(0) == ";" { None } else { Some(self.expression()?) };
                self.expect(";")?;
                StatementKind::Return(value)
            }
            _ => self.simple()?,
        };
        Ok(Statement { line, kind })
    }

    fn boxed(&mut self) -> Result<Box<Statement>, Refusal> {
        self.nested(Self::statement).map(Box::new)
    }

    fn selection(&mut self) -> Result<StatementKind, Refusal> {
        self.at += 1;
        self.expect("(")?;
        let condition = self.expression()?;
        self.expect(")")?;
        let yes = self.boxed()?;
        let no = if self.takes("else") { Some(self.boxed()?) } else { None };
        Ok(StatementKind::If(condition, yes, no))
    }

    fn for_loop(&mut self) -> Result<StatementKind, Refusal> {
        self.at += 1;
        self.expect("(")?;
        let line = self.line();
        let first = if self.takes(";") { None } else { Some(Box::new(Statement { line, kind: self.simple()? })) };
        let condition = if self.text(0) == ";" { None } else { Some(self.condition()?) };
        self.expect(";")?;
        let step = if self.text(0) == ")" { None } else { Some(self.expression()?) };
        self.expect(")")?;
        Ok(StatementKind::Loop(first, condition, step, self.boxed()?))
    }

    fn condition(&mut self) -> Result<LoopCondition, Refusal> {
        if !self.is_declaration() {
            return Ok(LoopCondition::Expression(self.expression()?));
        }
        let line = self.line();
        let qualifiers = self.qualifiers()?;
        let kind = self.declared_type()?;
        let variables = vec![self.variable()?];
        Ok(LoopCondition::Declaration(Declaration { line, qualifiers, kind, variables }))
    }

    /// A declaration or an expression, and `;`.
    fn simple(&mut self) -> Result<StatementKind, Refusal> {
        if !self.is_declaration() {
            let value = self.expression()?;
            self.expect(";")?;
            return Ok(StatementKind::Expression(value));
        }
        let start = self.at;
        if self.text(0) != "precision" {
            self.qualifiers()?;
            let says_more = self.at > start && self.is_name(0) && matches!(self.text(1), ";" | ",");
            if !says_more || Self::is_type(self.text(0)) {
                self.at = start;
                return self.declaration().map(StatementKind::Declaration);
            }
        }
        // `precise x;` says more about a variable that is there.
        while !self.takes(";") {
            self.at += 1;
            if self.peek(0).is_none() {
                return Err(self.unexpected(token(";")));
            }
        }
        Ok(StatementKind::Empty)
    }
}
