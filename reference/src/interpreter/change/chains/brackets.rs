//! Brackets that are missing, or stand around something else.

use super::{OperatorChain, OtherOperands, is_additive, is_multiplicative};
use crate::interpreter::change::tree::operands;
use crate::interpreter::change::{Local, Operator, bare, is_literal};
use crate::interpreter::syntax::{Expression, ExpressionKind};

impl OperatorChain<'_> {
    /// Brackets that are missing, or stand around something else.
    pub(super) fn grouped(&self, found: &mut Vec<Local>) {
        for at in 0..self.count() {
            let ExpressionKind::Chain(inner, rest) = &bare(self.operand(at)).kind else { continue };
            let inner = OperatorChain { first: inner, others: rest, line: self.line };
            let (outer, within) = (self.others[at.saturating_sub(1)].0, inner.others[0].0);
            if is_multiplicative(outer) && is_additive(within) {
                // a * (b + c) * d becomes a * b + c * d.
                let last = inner.count() - 1;
                let mut left = inner.first.clone();
                if at > 0 {
                    let mut others: OtherOperands = self.others[..at].to_vec();
                    others[at - 1].2 = left;
                    left = self.chain(self.first.clone(), others);
                }
                let mut others = inner.others.clone();
                if at + 1 < self.count() {
                    let right = self.chain(inner.operand(last).clone(), self.others[at..].to_vec());
                    others[last - 1].2 = right;
                }
                found.push(Local::new(Operator::Grouping, self.chain(left, others)));
                self.partly_grouped(at, &inner, found);
            } else if is_additive(outer) && is_multiplicative(within) {
                // a + b * c becomes (a + b) * c, and a * b + c becomes a * (b + c).
                if at > 0 {
                    let mut others: OtherOperands = self.others[..at].to_vec();
                    others[at - 1].2 = inner.first.clone();
                    let sum = self.chain(self.first.clone(), others);
                    let mistake = grouping_of(&sum);
                    let sum = self.bracketed(sum);
                    let product = self.chain(sum, inner.others.clone());
                    let rest = self.others[at..].to_vec();
                    let whole = if rest.is_empty() { product } else { self.chain(product, rest) };
                    found.push(Local::new(mistake, whole));
                }
                if at + 1 < self.count() {
                    let last = inner.count() - 1;
                    let sum = self.chain(inner.operand(last).clone(), self.others[at..].to_vec());
                    let mut others = inner.others.clone();
                    let mistake = grouping_of(&sum);
                    others[last - 1].2 = self.bracketed(sum);
                    let product = self.chain(inner.first.clone(), others);
                    let whole = match at {
                        0 => product,
                        _ => {
                            let mut before: OtherOperands = self.others[..at].to_vec();
                            before[at - 1].2 = product;
                            self.chain(self.first.clone(), before)
                        }
                    };
                    found.push(Local::new(mistake, whole));
                }
            }
        }
    }

    /// A product of a sum of which only some parts are multiplied.
    fn partly_grouped(&self, at: usize, inner: &OperatorChain<'_>, found: &mut Vec<Local>) {
        let product = |part: Expression| {
            let part = self.bracketed(part);
            let (mut first, mut others) = (self.first.clone(), self.others.clone());
            match at {
                0 => first = part,
                _ => others[at - 1].2 = part,
            }
            self.chain(first, others)
        };
        for split in 1..inner.count() {
            let (operator, line, _) = inner.others[split - 1];
            let (left, right) = (inner.part(0, split), inner.part(split, inner.count()));
            let sum = |a: Expression, b: Expression| self.chain(a, vec![(operator, line, b)]);
            found.push(Local::new(Operator::Grouping, sum(left.clone(), product(right.clone()))));
            found.push(Local::new(Operator::Grouping, sum(product(left), right)));
        }
    }
}

/// What brackets around a sum are that do not belong there. Around numbers they are no brackets that anybody writes: what is multiplied
/// and added is missing.
fn grouping_of(sum: &Expression) -> Operator {
    let is_of_numbers = operands(sum).into_iter().all(is_literal);
    if is_of_numbers { Operator::AddendLeftOut } else { Operator::Grouping }
}
