//! A program whose values are looked at: each has a site, and stands in slots of its own, so that it can be changed.

use super::place::LValue;
use super::{CompiledValue, Compiler};
use crate::interpreter::Refusal;
use crate::interpreter::code::{Node, ObservedValue, Slot};
use crate::interpreter::syntax::{DeclaredVariable, Expression, ExpressionKind, Name, Unary};
use crate::interpreter::trace::{Site, What};
use std::collections::HashMap;

/// The sites of the program that is being compiled.
#[derive(Default)]
pub struct Tracing {
    pub is_on: bool,
    /// Within what has to be known before the program runs.
    quiet: usize,
    pub sites: Vec<Site>,
    /// The sites of what is written at a byte of the text. A macro may write it several times.
    places: HashMap<u32, Vec<usize>>,
    /// The sites of the operands of each expression that is being compiled.
    operands: Vec<usize>,
    /// Where the expression that is being compiled reads.
    sources: Vec<Slot>,
    /// The function that is being compiled.
    pub function: Option<String>,
}

impl Compiler {
    fn is_traced(&self) -> bool {
        self.tracing.is_on && self.tracing.quiet == 0
    }

    /// Compiles something that has to be known before the program runs.
    pub(super) fn untraced<T>(&mut self, compile: impl FnOnce(&mut Self) -> Result<T, Refusal>) -> Result<T, Refusal> {
        self.tracing.quiet += 1;
        let result = compile(self);
        self.tracing.quiet -= 1;
        result
    }

    /// The value of an expression.
    pub(super) fn value(&mut self, expression: &Expression) -> Result<CompiledValue, Refusal> {
        if !self.is_traced() {
            return self.computed(expression);
        }
        let mark = self.tracing.operands.len();
        let value = self.computed(expression)?;
        let Some(what) = self.what(expression) else { return Ok(value) };
        // The last operator of a chain makes its value.
        self.builder.line = match &expression.kind {
            ExpressionKind::Chain(_, others) => others.last().map_or(expression.line, |(_, line, _)| *line),
            _ => expression.line,
        };
        let value = self.record(what, value, mark, expression.at);
        let is_whole = self.is_whole(expression);
        let site = self.tracing.operands.last().and_then(|&site| self.tracing.sites.get_mut(site));
        site.into_iter().for_each(|site| site.is_part = !is_whole);
        Ok(value)
    }

    /// The number of an element: one that is written is no value that anybody looks at.
    pub(super) fn index(&mut self, index: &Expression) -> Result<CompiledValue, Refusal> {
        match index.kind {
            ExpressionKind::Integer(..) => self.untraced(|compiler| compiler.value(index)),
            _ => self.value(index),
        }
    }

    /// A value in slots of its own, as that of a site whose operands were recorded since a mark, and which is written at a byte of
    /// the text; 0 where a statement says it.
    fn record(&mut self, what: What, value: CompiledValue, mark: usize, at: u32) -> CompiledValue {
        if value.slots.is_empty() {
            return value;
        }
        // The result of an operator stands in slots of its own already.
        let is_own = matches!(what, What::Binary(_) | What::Unary | What::Conditional)
            && value.slots.iter().all(|&slot| self.builder.known(slot).is_none());
        let slots = if is_own { value.slots.clone() } else { self.own_copies(&value.slots) };
        let site = self.site(what, &value, mark, at);
        let sources = std::mem::take(&mut self.tracing.sources);
        self.builder.push(Node::Record(Box::new(ObservedValue { site, slots: slots.clone(), sources })));
        CompiledValue { slots, ..value }
    }

    /// The copies that a macro makes of what is written once have one site, which is reached several times.
    fn site(&mut self, what: What, value: &CompiledValue, mark: usize, at: u32) -> usize {
        let operands = self.tracing.operands.split_off(mark.min(self.tracing.operands.len()));
        let (line, function) = (self.builder.line, self.tracing.function.clone());
        let (is_used, is_part) = (true, false);
        let site = Site { line, what, kind: value.kind.clone(), operands, function, is_used, is_part };
        let Tracing { sites, places, .. } = &mut self.tracing;
        let known = places.get(&at).filter(|_| at > 0).into_iter().flatten();
        let known = known.copied().find(|&known| Site { is_part, ..sites[known].clone() } == site);
        let number = known.unwrap_or_else(|| {
            places.entry(at).or_default().push(sites.len());
            sites.push(site);
            sites.len() - 1
        });
        self.tracing.operands.push(number);
        number
    }

    /// Copies, of what is known as well.
    fn own_copies(&mut self, slots: &[Slot]) -> Vec<Slot> {
        slots.iter().map(|&slot| self.builder.own_copy(slot)).collect()
    }

    /// One step of a chain of operators that begins at a byte of the text; its two operands were recorded last.
    pub(super) fn recorded_step(&mut self, what: What, value: CompiledValue, at: u32) -> CompiledValue {
        if !self.is_traced() {
            return value;
        }
        let mark = self.tracing.operands.len().saturating_sub(2);
        self.record(what, value, mark, at)
    }

    /// What is assigned to a place.
    pub(super) fn recorded_assignment(
        &mut self,
        to: &Expression,
        is_whole: bool,
        value: CompiledValue,
    ) -> CompiledValue {
        if !self.is_traced() {
            return value;
        }
        let is_part = !is_whole || !self.is_whole(to);
        let mark = self.tracing.operands.len().saturating_sub(1);
        self.record(What::Assign { name: self.root(to).unwrap_or_default(), is_part }, value, mark, 0)
    }

    /// The place was given what was recorded last.
    pub(super) fn wrote(&mut self, place: &LValue) {
        if self.is_traced()
            && let Some(&site) = self.tracing.operands.last()
        {
            for slot in self.all_slots(place) {
                self.builder.push(Node::Wrote { site, base: slot, count: 1 });
            }
        }
    }

    /// Slots were given a value: that of the site which was recorded last.
    pub(super) fn handed(&mut self, base: Slot, value: &CompiledValue) {
        self.passed(0, 1, base, value);
    }

    /// A parameter is given one of so many arguments, which were recorded last.
    pub(super) fn passed(&mut self, number: usize, count: usize, base: Slot, value: &CompiledValue) {
        let operands = &self.tracing.operands;
        let site = operands.len().checked_sub(count).and_then(|first| operands.get(first + number)).copied();
        if let Some(site) = site.filter(|_| self.is_traced()) {
            self.builder.push(Node::Wrote { site, base, count: value.slots.len() as u32 });
        }
    }

    /// A place is given back what a function left in its parameter.
    pub(super) fn handed_back(&mut self, place: &LValue, from: &[Slot]) {
        if self.is_traced() {
            for (to, &from) in self.all_slots(place).into_iter().zip(from) {
                self.builder.push(Node::HandedOn { to, from });
            }
        }
    }

    /// The expression that is being compiled reads a place.
    pub(super) fn reads(&mut self, place: &LValue) {
        if self.is_traced() {
            self.tracing.sources = self.all_slots(place);
        }
    }

    /// The expression that is being compiled reads these slots.
    pub(super) fn read_from(&mut self, slots: &[Slot]) {
        if self.is_traced() {
            self.tracing.sources = slots.to_vec();
        }
    }

    /// The value that was recorded last goes nowhere.
    pub(super) fn thrown_away(&mut self) {
        let last = self.tracing.operands.last().copied().filter(|_| self.is_traced());
        if let Some(site) = last.and_then(|last| self.tracing.sites.get_mut(last))
            && !matches!(site.what, What::Assign { .. } | What::Step)
        {
            site.is_used = false;
        }
        self.tracing.operands.clear();
    }

    /// The first value of a variable. That of a constant stays known, as the length of an array needs it.
    pub(super) fn first_value(
        &mut self,
        variable: &DeclaredVariable,
        value: &Expression,
        kind: &crate::interpreter::types::Type,
        is_constant: bool,
    ) -> Result<CompiledValue, Refusal> {
        if !self.is_traced() {
            return self.initial_value(value, kind);
        }
        if is_constant && !value.changes {
            let known = self.untraced(|compiler| compiler.initial_value(value, kind))?;
            if known.slots.iter().all(|&slot| self.builder.known(slot).is_some()) {
                return Ok(known);
            }
        }
        let mark = self.tracing.operands.len();
        let value = self.initial_value(value, kind)?;
        self.builder.line = variable.line;
        let what = What::Assign { name: variable.name.to_string(), is_part: false };
        Ok(self.record(what, value, mark, 0))
    }

    /// A variable has its first value.
    pub(super) fn gave(&mut self, name: &Name, value: &CompiledValue, base: Slot) {
        if !self.is_traced() {
            return;
        }
        let count = value.slots.len() as u32;
        let slots: Vec<Slot> = (base..base + count).collect();
        if slots.iter().any(|&slot| self.builder.known(slot).is_some()) {
            let mark = self.tracing.operands.len();
            let what = What::Assign { name: name.to_string(), is_part: false };
            let site = self.site(what, value, mark, 0);
            self.builder.push(Node::Record(Box::new(ObservedValue { site, slots, sources: Vec::new() })));
        }
        if let Some(&site) = self.tracing.operands.last() {
            self.builder.push(Node::Wrote { site, base, count });
        }
        self.tracing.operands.clear();
    }

    /// What an expression does; `None` for one that is recorded elsewhere, or only stands for another.
    fn what(&self, expression: &Expression) -> Option<What> {
        Some(match &expression.kind {
            ExpressionKind::Integer(..) | ExpressionKind::Floating(..) | ExpressionKind::Bool(_) => What::Literal,
            ExpressionKind::Name(_) | ExpressionKind::Index(..) => What::Read(self.root(expression)?),
            ExpressionKind::Member(..) => self.root(expression).map_or(What::Part, What::Read),
            ExpressionKind::Unary(Unary::Plus, _) => return None,
            ExpressionKind::Unary(..) => What::Unary,
            ExpressionKind::Step(..) => What::Step,
            ExpressionKind::Chain(_, others) => What::Binary(others.last()?.0),
            ExpressionKind::Conditional(..) => What::Conditional,
            ExpressionKind::Call(name, _) => What::Call(name.to_string()),
            ExpressionKind::ArrayConstructor(..) | ExpressionKind::Length(_) => What::Part,
            ExpressionKind::Assign(..) | ExpressionKind::Comma(_) | ExpressionKind::List(_) => return None,
        })
    }

    /// The variable that an expression names, or a part of.
    fn root(&self, expression: &Expression) -> Option<String> {
        match &expression.kind {
            ExpressionKind::Name(name) => Some(name.to_string()),
            ExpressionKind::Member(of, member) if self.is_instance(of) => Some(format!("{}.{member}", self.root(of)?)),
            ExpressionKind::Index(of, _) | ExpressionKind::Member(of, _) => self.root(of),
            ExpressionKind::Comma(one) if one.len() == 1 => self.root(&one[0]),
            _ => None,
        }
    }

    /// Whether an expression is all of a variable. A member of a block that goes from stage to stage is a variable.
    fn is_whole(&self, expression: &Expression) -> bool {
        match &expression.kind {
            ExpressionKind::Name(_) => true,
            ExpressionKind::Member(of, _) => self.is_instance(of),
            _ => false,
        }
    }

    fn is_instance(&self, expression: &Expression) -> bool {
        matches!(&expression.kind, ExpressionKind::Name(name) if self.instances.contains(name))
    }
}
