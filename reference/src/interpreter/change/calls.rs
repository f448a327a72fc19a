//! Slips around calls of functions.

use super::tree::ExpressionPlace;
use super::{Local, NameScope, Operator, bare, is_literal, written};
use crate::interpreter::syntax::{Binary, Expression, ExpressionKind, Name};
use crate::interpreter::types::Type;

/// Functions that are taken for one another.
const ALIKE: [&[&str]; 9] = [
    &["max", "min"],
    &["sin", "cos", "tan"],
    &["exp", "exp2"],
    &["log", "log2"],
    &["floor", "ceil", "round", "fract"],
    &["sqrt", "inversesqrt"],
    &["transpose", "inverse"],
    &["dFdx", "dFdy"],
    &["dot", "distance"],
];

/// Functions of which the order of the arguments makes no difference.
const SYMMETRIC: [&str; 4] = ["max", "min", "dot", "distance"];

/// Those of a call.
pub(super) fn changes(place: &ExpressionPlace<'_>, scope: &mut NameScope<'_>, found: &mut Vec<Local>) {
    match &place.own.kind {
        ExpressionKind::Call(name, arguments) if Type::named(name).is_none() => {
            let call = Call { name, arguments, line: place.own.line };
            call.left_out(scope, place.own, found);
            call.exchanged(scope, found);
            call.another(scope, found);
            call.another_order(found);
            if is_square(place.own) {
                let length = ExpressionKind::Call("length".into(), vec![arguments[0].clone()]);
                found.push(Local::new(Operator::FactorLeftOut, Expression { kind: length, ..place.own.clone() }));
            }
        }
        ExpressionKind::Conditional(condition, yes, no) => {
            let kind = ExpressionKind::Conditional(condition.clone(), no.clone(), yes.clone());
            found.push(Local::new(Operator::Exchanged, Expression { kind, ..place.own.clone() }));
            found.extend([yes, no].map(|branch| Local::new(Operator::CallLeftOut, (**branch).clone())));
        }
        _ => {}
    }
}

/// Whether it is a vector's product with itself.
pub(super) fn is_square(own: &Expression) -> bool {
    let ExpressionKind::Call(name, arguments) = &own.kind else { return false };
    matches!((&**name, &arguments[..]), ("dot", [a, b]) if written(a) == written(b))
}

/// Whether an expression is kept from going below 0.
pub(super) fn is_bound_by_zero(expression: &Expression) -> bool {
    let ExpressionKind::Call(name, arguments) = &expression.kind else { return false };
    let is_zero = |one: &Expression| match one.kind {
        ExpressionKind::Floating(value, _) | ExpressionKind::Integer(value, _) => value == 0.0,
        _ => false,
    };
    matches!(&**name, "max" | "clamp") && arguments[1..].iter().any(is_zero)
}

/// Arguments with two of the first `most` exchanged that have the same type.
pub(super) fn exchanged(
    arguments: &[Expression],
    most: usize,
    kind: &mut dyn FnMut(&Expression) -> Option<Type>,
) -> Vec<Vec<Expression>> {
    let kinds: Vec<Option<Type>> = arguments.iter().take(most).map(kind).collect();
    let pairs = (1..kinds.len()).flat_map(|second| (0..second).map(move |first| (first, second)));
    let swapped = |(first, second)| {
        let mut arguments = arguments.to_vec();
        arguments.swap(first, second);
        arguments
    };
    pairs.filter(|(first, second)| kinds[*first] == kinds[*second]).map(swapped).collect()
}

struct Call<'a> {
    name: &'a Name,
    arguments: &'a [Expression],
    line: u32,
}

impl Call<'_> {
    fn call(&self, name: &str, arguments: Vec<Expression>) -> Expression {
        Expression::made(self.line, ExpressionKind::Call(name.into(), arguments))
    }

    fn number(&self, number: f64) -> Expression {
        Expression::made(self.line, ExpressionKind::Floating(number, false))
    }

    fn between(&self, operator: Binary, a: Expression, b: Expression) -> Expression {
        let kind = ExpressionKind::Chain(Box::new(a), vec![(operator, self.line, b)]);
        Expression::made(self.line, kind)
    }

    fn left_out(&self, scope: &mut NameScope<'_>, own: &Expression, found: &mut Vec<Local>) {
        let kind = (scope.kind)(own);
        let operator = match &**self.name {
            "max" | "min" | "clamp" => Operator::ClampLeftOut,
            "normalize" => Operator::NormalizeLeftOut,
            "pow" => Operator::PowerLeftOut,
            _ => Operator::CallLeftOut,
        };
        for argument in self.arguments.iter().filter(|argument| !is_literal(argument)) {
            if kind.is_none() || (scope.kind)(argument) == kind {
                found.push(Local::new(operator, argument.clone()).about(argument));
            }
        }
    }

    fn exchanged(&self, scope: &mut NameScope<'_>, found: &mut Vec<Local>) {
        if SYMMETRIC.contains(&&**self.name) {
            return;
        }
        let all = exchanged(self.arguments, self.arguments.len(), scope.kind);
        found.extend(all.into_iter().map(|other| Local::new(Operator::Exchanged, self.call(self.name, other))));
    }

    fn another(&self, scope: &mut NameScope<'_>, found: &mut Vec<Local>) {
        let alike = ALIKE.iter().filter(|names| names.contains(&&**self.name)).flat_map(|names| names.iter());
        let alike = alike.filter(|name| **name != &**self.name);
        let mut others: Vec<Expression> = alike.map(|name| self.call(name, self.arguments.to_vec())).collect();
        let one = || self.arguments[0].clone();
        match (&**self.name, self.arguments) {
            ("max", [x, low]) if is_literal(low) => {
                others.push(self.call("abs", vec![x.clone()]));
                found.push(Local::new(
                    Operator::Clamped,
                    self.call("clamp", vec![x.clone(), low.clone(), self.number(1.0)]),
                ));
            }
            ("abs", [x]) => others.push(self.call("max", vec![x.clone(), self.number(0.0)])),
            ("pow", [base, exponent]) => {
                others.push(self.between(Binary::Multiply, base.clone(), exponent.clone()));
                others.push(self.between(Binary::Divide, base.clone(), exponent.clone()));
                others.push(self.call("exp", vec![self.between(Binary::Multiply, base.clone(), exponent.clone())]));
            }
            ("smoothstep", [low, high, x]) => {
                let part = |x: &Expression| self.between(Binary::Subtract, x.clone(), low.clone());
                let bracket = |inner| Expression::made(self.line, ExpressionKind::Comma(vec![inner]));
                let ratio = self.between(Binary::Divide, bracket(part(x)), bracket(part(high)));
                others.push(self.call("clamp", vec![ratio, self.number(0.0), self.number(1.0)]));
                others.extend([low, high].map(|edge| self.call("step", vec![edge.clone(), x.clone()])));
            }
            ("length", [x]) => others.push(self.call("dot", vec![x.clone(), x.clone()])),
            ("dot", [a, b]) => {
                let product = |a: &Expression, b: &Expression| self.call("cross", vec![a.clone(), b.clone()]);
                others.push(self.call("length", vec![product(a, b)]));
            }
            ("normalize", [_]) => others.push(self.call("abs", vec![one()])),
            ("reflect", [ray, axis]) => {
                let half = self.between(Binary::Add, ray.clone(), axis.clone());
                others.push(self.call("normalize", vec![half]));
            }
            _ => {}
        }
        found.extend(others.into_iter().map(|other| Local::new(Operator::OtherFunction, other)));
        if **self.name == *"normalize" && scope.free {
            // Squared length in place of the length.
            let squared = self.call("dot", vec![one(), one()]);
            let of = Expression::made(self.line, ExpressionKind::Comma(vec![one()]));
            found.push(Local::new(Operator::OtherFunction, self.between(Binary::Divide, of, squared)));
        }
    }

    /// Two functions in the other order, or a function of the parts in place of the whole.
    fn another_order(&self, found: &mut Vec<Local>) {
        let [inner, rest @ ..] = self.arguments else { return };
        let mut add = |expression| found.push(Local::new(Operator::OtherOrder, expression));
        match &bare(inner).kind {
            ExpressionKind::Call(name, arguments) if Type::named(name).is_none() && name != self.name => {
                if let [x, own @ ..] = &arguments[..] {
                    let outer = self.call(self.name, [std::slice::from_ref(x), rest].concat());
                    add(self.call(name, [&[outer], own].concat()));
                }
            }
            ExpressionKind::Member(of, components) => {
                let whole = self.call(self.name, [&[(**of).clone()], rest].concat());
                let kind = ExpressionKind::Member(Box::new(whole), Name::clone(components));
                add(Expression::made(self.line, kind));
            }
            ExpressionKind::Unary(sign, of) => {
                let whole = self.call(self.name, [&[(**of).clone()], rest].concat());
                let kind = ExpressionKind::Unary(*sign, Box::new(whole));
                add(Expression::made(self.line, kind));
            }
            ExpressionKind::Chain(first, others) if rest.is_empty() || rest.iter().all(is_literal) => {
                let of = |x: &Expression| self.call(self.name, [std::slice::from_ref(x), rest].concat());
                let chain = |first: Expression, others| {
                    Expression::made(self.line, ExpressionKind::Chain(Box::new(first), others))
                };
                let each = others.iter().map(|(operator, line, operand)| (*operator, *line, of(operand)));
                add(chain(of(first), each.collect()));
                let mut last = others.clone();
                if let Some((_, _, operand)) = last.last_mut() {
                    *operand = of(operand);
                }
                add(chain((**first).clone(), last));
                add(chain(of(first), others.clone()));
            }
            _ => {}
        }
    }
}
