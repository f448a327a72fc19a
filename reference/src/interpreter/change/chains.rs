//! Slips between operands.

mod brackets;

use super::tree::ExpressionPlace;
use super::{Local, NameScope, Operator, bare, is_literal};
use crate::interpreter::syntax::{Binary, Expression, ExpressionKind, Unary};
use crate::interpreter::types::Type;

type OtherOperands = Vec<(Binary, u32, Expression)>;

/// Those of a chain of operators.
pub(super) fn changes(place: &ExpressionPlace<'_>, scope: &mut NameScope<'_>, found: &mut Vec<Local>) {
    let ExpressionKind::Chain(first, others) = &place.own.kind else {
        if let ExpressionKind::Assign(Some(operator), to, from) = &place.own.kind {
            let with = |operator| {
                let kind = ExpressionKind::Assign(operator, to.clone(), from.clone());
                Local::new(Operator::OtherOperator, Expression { kind, ..place.own.clone() })
            };
            found.extend(instead_of(*operator).iter().map(|other| with(Some(*other))));
            found.push(with(None));
        }
        return;
    };
    let own = OperatorChain { first, others, line: place.own.line };
    own.left_out(place.own, scope, found);
    own.other_operators(found);
    own.sums_of_factors(found);
    own.exchanged(scope, found);
    own.repeated(found);
    own.grouped(found);
}

/// What may stand in place of an operator.
fn instead_of(operator: Binary) -> &'static [Binary] {
    match operator {
        Binary::Add => &[Binary::Subtract, Binary::Multiply, Binary::Divide],
        Binary::Subtract => &[Binary::Add, Binary::Multiply, Binary::Divide],
        Binary::Multiply => &[Binary::Add, Binary::Divide, Binary::Subtract],
        Binary::Divide => &[Binary::Multiply, Binary::Subtract, Binary::Add],
        Binary::Less => &[Binary::Greater, Binary::GreaterEqual],
        Binary::Greater => &[Binary::Less, Binary::LessEqual],
        Binary::LessEqual => &[Binary::Greater, Binary::Less],
        Binary::GreaterEqual => &[Binary::Less, Binary::Greater],
        Binary::Equal => &[Binary::NotEqual],
        Binary::NotEqual => &[Binary::Equal],
        Binary::And => &[Binary::Or],
        Binary::Or => &[Binary::And],
        _ => &[],
    }
}

pub(super) fn is_additive(operator: Binary) -> bool {
    matches!(operator, Binary::Add | Binary::Subtract)
}

fn is_multiplicative(operator: Binary) -> bool {
    matches!(operator, Binary::Multiply | Binary::Divide)
}

struct OperatorChain<'a> {
    first: &'a Expression,
    others: &'a OtherOperands,
    line: u32,
}

impl OperatorChain<'_> {
    fn operand(&self, at: usize) -> &Expression {
        if at == 0 { self.first } else { &self.others[at - 1].2 }
    }

    fn count(&self) -> usize {
        self.others.len() + 1
    }

    fn expression(&self, kind: ExpressionKind) -> Expression {
        Expression::made(self.line, kind)
    }

    /// The operands from `from` to before `to`.
    fn part(&self, from: usize, to: usize) -> Expression {
        let rest: OtherOperands = self.others[from..to - 1].to_vec();
        if rest.is_empty() {
            return self.operand(from).clone();
        }
        self.expression(ExpressionKind::Chain(Box::new(self.operand(from).clone()), rest))
    }

    fn chain(&self, first: Expression, others: OtherOperands) -> Expression {
        self.expression(ExpressionKind::Chain(Box::new(first), others))
    }

    fn bracketed(&self, inner: Expression) -> Expression {
        match inner.kind {
            ExpressionKind::Chain(..) => self.expression(ExpressionKind::Comma(vec![inner])),
            _ => inner,
        }
    }

    fn left_out(&self, own: &Expression, scope: &mut NameScope<'_>, found: &mut Vec<Local>) {
        let kind = (scope.kind)(own);
        let is_alike =
            |without: &Expression, scope: &mut NameScope<'_>| kind.is_none() || (scope.kind)(without) == kind;
        let begins = self.others[0].0;
        let (operand, rest) = (self.others[0].2.clone(), self.others[1..].to_vec());
        let start = match begins {
            Binary::Subtract => self.expression(ExpressionKind::Unary(Unary::Minus, Box::new(operand))),
            _ => operand,
        };
        let without = if rest.is_empty() { start } else { self.chain(start, rest) };
        let left_out = |operator, operand: &Expression, scope: &mut NameScope<'_>| match operator {
            Binary::Divide => Some(Operator::DivisorLeftOut),
            Binary::Multiply if matches!((scope.kind)(operand), Some(Type::Matrix(..))) => {
                Some(Operator::MatrixLeftOut)
            }
            Binary::Multiply => Some(Operator::FactorLeftOut),
            _ if is_additive(operator) => Some(Operator::AddendLeftOut),
            _ => None,
        };
        let first = if begins == Binary::Divide { None } else { left_out(begins, self.first, scope) };
        let first = first.filter(|_| is_alike(&without, scope));
        found.extend(first.map(|kind| Local::new(kind, without).about(self.first)));
        for (at, (operator, _, operand)) in self.others.iter().enumerate() {
            let Some(kind) = left_out(*operator, operand, scope) else { continue };
            let mut others = self.others.clone();
            others.remove(at);
            let first = self.first.clone();
            let without = if others.is_empty() { first } else { self.chain(first, others) };
            if is_alike(&without, scope) {
                found.push(Local::new(kind, without).about(operand));
            }
        }
    }

    fn other_operators(&self, found: &mut Vec<Local>) {
        for (at, (operator, line, operand)) in self.others.iter().enumerate() {
            let is_of_one = matches!(bare(self.operand(at)).kind, ExpressionKind::Floating(1.0, _));
            for other in instead_of(*operator) {
                // One times it is what it is without the operator.
                let is_left_out = is_of_one && *other == Binary::Multiply;
                if is_left_out && *operator == Binary::Subtract {
                    continue;
                }
                let mistake = if is_left_out { Operator::DivisorLeftOut } else { Operator::OtherOperator };
                let expression = if is_additive(*operator) && is_multiplicative(*other) {
                    // A product binds more tightly than the sum around it.
                    let product = self.chain(self.operand(at).clone(), vec![(*other, *line, operand.clone())]);
                    let mut others = self.others.clone();
                    others.remove(at);
                    match at {
                        0 if others.is_empty() => product,
                        0 => self.chain(product, others),
                        _ => {
                            others[at - 1].2 = product;
                            self.chain(self.first.clone(), others)
                        }
                    }
                } else if is_multiplicative(*operator) && is_additive(*other) {
                    let right = self.part(at + 1, self.count());
                    self.chain(self.part(0, at + 1), vec![(*other, *line, right)])
                } else {
                    let mut others = self.others.clone();
                    others[at].0 = *other;
                    self.chain(self.first.clone(), others)
                };
                found.push(Local::new(mistake, expression).about(operand));
            }
        }
        // A sum that is taken for the greatest of its parts.
        if self.others.iter().all(|(operator, ..)| *operator == Binary::Add) {
            let greatest = self.others.iter().fold(self.first.clone(), |greatest, (_, _, operand)| {
                self.expression(ExpressionKind::Call("max".into(), vec![greatest, operand.clone()]))
            });
            found.push(Local::new(Operator::OtherOperator, greatest));
        }
    }

    /// A product in which one operator is another: two factors added up before the others are multiplied, or one factor added
    /// to the product of the others.
    fn sums_of_factors(&self, found: &mut Vec<Local>) {
        let is_product = self.others.iter().all(|(operator, ..)| *operator == Binary::Multiply);
        if !is_product {
            return;
        }
        let product = |places: &[usize]| {
            let rest: OtherOperands =
                places[1..].iter().map(|at| (Binary::Multiply, self.line, self.operand(*at).clone())).collect();
            let first = self.operand(places[0]).clone();
            if rest.is_empty() { first } else { self.chain(first, rest) }
        };
        let sum = |a: Expression, b: Expression| self.chain(a, vec![(Binary::Add, self.line, b)]);
        let mut add = |expression| found.push(Local::new(Operator::OtherOperator, expression));
        for at in 0..self.count() {
            let rest: Vec<usize> = (0..self.count()).filter(|other| *other != at).collect();
            add(sum(self.operand(at).clone(), product(&rest)));
            for second in at + 1..self.count() {
                let rest: Vec<usize> = (0..self.count()).filter(|other| *other != at && *other != second).collect();
                for (a, operator, b) in
                    [(at, Binary::Add, second), (at, Binary::Subtract, second), (second, Binary::Subtract, at)]
                {
                    let pair =
                        self.chain(self.operand(a).clone(), vec![(operator, self.line, self.operand(b).clone())]);
                    let pair = self.bracketed(pair);
                    if !rest.is_empty() {
                        add(self.chain(product(&rest), vec![(Binary::Multiply, self.line, pair)]));
                    }
                }
                for name in ["max", "min"] {
                    let operands = vec![self.operand(at).clone(), self.operand(second).clone()];
                    let either = self.expression(ExpressionKind::Call(name.into(), operands));
                    add(match rest.is_empty() {
                        true => either,
                        false => self.chain(product(&rest), vec![(Binary::Multiply, self.line, either)]),
                    });
                }
            }
        }
    }

    fn exchanged(&self, scope: &mut NameScope<'_>, found: &mut Vec<Local>) {
        for (at, (operator, line, operand)) in self.others.iter().enumerate() {
            let before = self.operand(at);
            let is_matrix =
                |one: &Expression, scope: &mut NameScope<'_>| matches!((scope.kind)(one), Some(Type::Matrix(..)));
            let matters = matches!(operator, Binary::Subtract | Binary::Divide)
                || *operator == Binary::Multiply && (is_matrix(before, scope) || is_matrix(operand, scope));
            if !matters {
                continue;
            }
            let mut others = self.others.clone();
            others[at] = (*operator, *line, before.clone());
            let mut first = self.first.clone();
            match at {
                0 => first = operand.clone(),
                _ => others[at - 1].2 = operand.clone(),
            }
            found.push(Local::new(Operator::Exchanged, self.chain(first, others)));
        }
        if self.others.iter().any(|(operator, ..)| *operator == Binary::Divide) {
            let whole = self.part(0, self.count());
            let whole = self.expression(ExpressionKind::Call("trunc".into(), vec![whole]));
            found.push(Local::new(Operator::WholeNumbers, whole));
        }
    }

    /// A part that is there twice.
    fn repeated(&self, found: &mut Vec<Local>) {
        let operator = self.others[0].0;
        let (kind, operator) = if is_additive(operator) {
            (Operator::AddedTwice, Binary::Add)
        } else if is_multiplicative(operator) {
            (Operator::Squared, Binary::Multiply)
        } else {
            return;
        };
        // Of a power that is another exponent, of a number another number.
        let is_power = |one: &Expression| matches!(&one.kind, ExpressionKind::Call(name, _) if **name == *"pow");
        let is_number = |one: &Expression| is_literal(one) || kind == Operator::Squared && is_power(one);
        for at in (0..self.count()).filter(|at| !is_number(self.operand(*at))) {
            let mut others = self.others.clone();
            others.push((operator, self.line, self.operand(at).clone()));
            found.push(Local::new(kind, self.chain(self.first.clone(), others)).about(self.operand(at)));
        }
    }
}
