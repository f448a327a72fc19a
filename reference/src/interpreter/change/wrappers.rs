//! Slips around a value: something more that is done to it.

use super::tree::ExpressionPlace;
use super::{FREE, Local, NameScope, Operator, calls, floats, is_literal, name_of, written};
use crate::interpreter::syntax::{Binary, Expression, ExpressionKind, Unary};
use crate::interpreter::types::Type;

/// Those of a value, whatever it is.
pub(super) fn changes(place: &ExpressionPlace<'_>, scope: &mut NameScope<'_>, found: &mut Vec<Local>) {
    let own = place.own;
    // A column or an element is taken as it is.
    let is_taken =
        matches!(&own.kind, ExpressionKind::Comma(_) | ExpressionKind::Assign(..) | ExpressionKind::Index(..));
    if is_literal(own) && !place.is_root() || is_taken {
        return;
    }
    let kind = (scope.kind)(own);
    let Some(count) = floats(kind.as_ref()) else { return };
    let value = WrappedValue { own, line: own.line, count };
    value.wrapped(place, found);
    if scope.free && value.is_worth_a_number(place) {
        value.with_a_number(found);
    }
    if place.is_root() {
        value.as_a_whole(scope, found);
    }
}

struct WrappedValue<'a> {
    own: &'a Expression,
    line: u32,
    /// How many floats it has.
    count: u8,
}

impl WrappedValue<'_> {
    fn expression(&self, kind: ExpressionKind) -> Expression {
        Expression::made(self.line, kind)
    }

    fn call(&self, name: &str, arguments: Vec<Expression>) -> Expression {
        self.expression(ExpressionKind::Call(name.into(), arguments))
    }

    fn number(&self, number: f64) -> Expression {
        self.expression(ExpressionKind::Floating(number, false))
    }

    /// It, in brackets where it needs some.
    fn it(&self) -> Expression {
        match &self.own.kind {
            ExpressionKind::Chain(..) | ExpressionKind::Conditional(..) => {
                self.expression(ExpressionKind::Comma(vec![self.own.clone()]))
            }
            _ => self.own.clone(),
        }
    }

    fn between(&self, a: Expression, operator: Binary, b: Expression) -> Expression {
        self.expression(ExpressionKind::Chain(Box::new(a), vec![(operator, self.line, b)]))
    }

    /// A vector that has this number everywhere.
    fn all(&self, number: f64) -> Expression {
        let name = if self.count == 1 { "float".to_owned() } else { format!("vec{}", self.count) };
        self.call(&name, vec![self.number(number)])
    }

    fn wrapped(&self, place: &ExpressionPlace<'_>, found: &mut Vec<Local>) {
        let own = || self.own.clone();
        let mut add = |operator, expression| found.push(Local::new(operator, expression).about(self.own));
        let has_sign = |one: &Expression| matches!(one.kind, ExpressionKind::Unary(..));
        if !has_sign(self.own) && !place.parent.is_some_and(has_sign) {
            add(Operator::Sign, self.expression(ExpressionKind::Unary(Unary::Minus, Box::new(self.it()))));
        }
        add(Operator::Absolute, self.call("abs", vec![own()]));
        add(Operator::Clamped, self.call("max", vec![own(), self.number(0.0)]));
        add(Operator::Clamped, self.call("clamp", vec![own(), self.number(0.0), self.number(1.0)]));
        // Of a vector's product with itself that is its length.
        if self.count > 1 && !place.parent.is_some_and(calls::is_square) {
            add(Operator::Normalized, self.call("normalize", vec![own()]));
        }
        // In the place of a number there is another number.
        if !is_literal(self.own) {
            add(Operator::Complement, self.between(self.number(1.0), Binary::Subtract, self.it()));
        }
        // Of a power that is another exponent.
        let is_power = |one: &Expression| matches!(&one.kind, ExpressionKind::Call(name, _) if **name == *"pow");
        if !is_power(self.own) && !place.parent.is_some_and(is_power) {
            add(Operator::Squared, self.between(self.it(), Binary::Multiply, self.it()));
            add(Operator::Root, self.call("sqrt", vec![own()]));
        }
        let half = self.between(self.number(0.5), Binary::Multiply, self.it());
        add(Operator::Raised, self.between(half, Binary::Add, self.number(0.5)));
        if self.count == 4 && !place.is_root() {
            // The same without its fourth component.
            let part = self.expression(ExpressionKind::Member(Box::new(self.it()), "xyz".into()));
            add(Operator::OtherW, self.call("vec4", vec![part, self.number(1.0)]));
        }
    }

    /// Whether a number is looked for that is applied to it: to a whole definition, to a part of a sum, to an argument.
    fn is_worth_a_number(&self, place: &ExpressionPlace<'_>) -> bool {
        let Some(parent) = place.parent else { return true };
        match &parent.kind {
            ExpressionKind::Chain(_, others) => {
                others.iter().any(|(operator, ..)| matches!(operator, Binary::Add | Binary::Subtract))
            }
            ExpressionKind::Call(..) => true,
            _ => false,
        }
    }

    fn with_a_number(&self, found: &mut Vec<Local>) {
        let free = || self.expression(ExpressionKind::Name(FREE.into()));
        let minus = |of: Expression| self.expression(ExpressionKind::Unary(Unary::Minus, Box::new(of)));
        let mut add = |operator, expression| found.push(Local::new(operator, expression).about(self.own));
        add(Operator::Scaled, self.between(self.it(), Binary::Multiply, free()));
        add(Operator::Scaled, minus(self.between(self.it(), Binary::Multiply, free())));
        add(Operator::Shifted, self.between(self.it(), Binary::Add, free()));
        add(Operator::Shifted, self.between(self.it(), Binary::Subtract, free()));
        if self.count == 1 {
            add(Operator::Raising, self.call("pow", vec![self.own.clone(), free()]));
        }
    }

    /// What becomes of a whole definition.
    fn as_a_whole(&self, scope: &NameScope<'_>, found: &mut Vec<Local>) {
        found.push(Local::new(Operator::LeftOut, self.all(0.0)));
        if self.count == 1 {
            found.push(Local::new(Operator::FactorLeftOut, self.all(1.0)));
        }
        for (other, kind) in scope.names {
            if scope.constants.contains(&written(other)) {
                continue;
            }
            if *kind == Type::FLOAT {
                let above = self.between(other.clone(), Binary::Greater, self.number(0.0));
                let gated =
                    ExpressionKind::Conditional(Box::new(above), Box::new(self.own.clone()), Box::new(self.all(0.0)));
                found.push(Local { about: name_of(other), ..Local::new(Operator::Gated, self.expression(gated)) });
                let times = self.between(self.it(), Binary::Multiply, other.clone());
                found.push(Local { about: name_of(other), ..Local::new(Operator::Times, times) });
            }
            if floats(Some(kind)) == Some(self.count) && written(other) != written(self.own) {
                found.push(Local::new(Operator::OtherValue, other.clone()));
            }
        }
    }
}
