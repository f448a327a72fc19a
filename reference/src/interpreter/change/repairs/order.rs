//! Two statements that stand one after the other, in the other order.

use super::super::tree::assigned;
use super::super::{Operator, written};
use super::{ProgramRepair, Where, marked};
use crate::interpreter::syntax::{Declaration, Expression, ExpressionKind, Name, Statement, StatementKind};
use crate::interpreter::text;

/// Statements as they are met, each with its number: those that another one may stand before.
#[derive(Default)]
pub(super) struct StatementOrder {
    last: Option<(usize, Statement)>,
    pub found: Vec<ProgramRepair>,
}

impl StatementOrder {
    /// Looks at the next statement. Its number is one more than that of the statement before it, unless that has statements of its own.
    pub fn meet(&mut self, own: &Statement, number: usize) {
        let is_plain = given(own).is_some();
        if let Some((before, first)) = self.last.take().filter(|(before, _)| is_plain && before + 1 == number)
            && concerns(&first, own)
        {
            let place = Where::Exchanged(before, Box::new([first.clone(), own.clone()]));
            let [a, b] = [&first, own].map(text_of);
            let texts = [format!("{a} {b}"), format!("{b} {a}")];
            self.found.push(ProgramRepair::slip(Operator::OtherOrder, first.line, texts, place));
        }
        self.last = is_plain.then(|| (number, own.clone()));
    }
}

/// The statement that stands in the place of another one, if it is one of two that are exchanged.
pub(super) fn exchanged(place: &Where, number: usize, is_marked: bool) -> Option<Statement> {
    let Where::Exchanged(at, both) = place else { return None };
    let other = match number.checked_sub(*at)? {
        0 => &both[1],
        1 => &both[0],
        _ => return None,
    };
    let mut other = other.clone();
    // What comes first then has another value.
    match &mut other.kind {
        StatementKind::Expression(own) if is_marked && number == *at => *own = marked(own),
        StatementKind::Declaration(own) if is_marked && number == *at => {
            own.variables.iter_mut().filter_map(|variable| variable.value.as_mut()).for_each(|own| *own = marked(own));
        }
        _ => {}
    }
    Some(other)
}

/// The variable that a statement gives a value, and the value.
fn given(statement: &Statement) -> Option<(&Name, &Expression)> {
    match &statement.kind {
        StatementKind::Expression(own) => match &own.kind {
            ExpressionKind::Assign(_, _, from) => Some((assigned(own)?, from)),
            _ => None,
        },
        StatementKind::Declaration(Declaration { variables, .. }) => match &variables[..] {
            [only] => Some((&only.name, only.value.as_ref()?)),
            _ => None,
        },
        _ => None,
    }
}

/// Whether the order of two statements matters: one of them reads what the other one gives, or both make another value of the same
/// variable. What is only written over is none of its affair.
fn concerns(first: &Statement, second: &Statement) -> bool {
    let reads = |statement: &Statement, name: &Name| {
        let value = given(statement).map(|(_, value)| written(value)).unwrap_or_default();
        text::preprocess(&value).is_ok_and(|text| text.tokens.iter().any(|token| *token.text == **name))
    };
    let (Some((one, _)), Some((other, _))) = (given(first), given(second)) else { return false };
    if one == other {
        return [first, second].into_iter().all(|own| is_added_to(own) || reads(own, one));
    }
    reads(second, one) || reads(first, other)
}

/// Whether a statement makes a new value of the one that its variable has, as `+=` does.
fn is_added_to(statement: &Statement) -> bool {
    matches!(&statement.kind, StatementKind::Expression(Expression { kind: ExpressionKind::Assign(Some(_), ..), .. }))
}

fn text_of(statement: &Statement) -> String {
    match &statement.kind {
        StatementKind::Expression(own) => format!("{};", written(own)),
        _ => given(statement).map(|(name, value)| format!("{name} = {};", written(value))).unwrap_or_default(),
    }
}
