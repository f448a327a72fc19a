//! Slips in what an expression begins with: names, numbers, components, signs.

use super::tree::ExpressionPlace;
use super::{FREE, Local, NameScope, Operator, floats, is_literal, written};
use crate::interpreter::syntax::{Expression, ExpressionKind, Unary};
use crate::interpreter::types::Type;

/// Components by their number.
const COMPONENTS: [&str; 4] = ["x", "y", "z", "w"];

/// Ways to take three components, and two.
pub(super) const OF_THREE: [&str; 6] = ["xyz", "xzy", "yxz", "zyx", "yzx", "zxy"];
const OF_TWO: [&str; 6] = ["xy", "yx", "xz", "zx", "yz", "xx"];

/// Those of names, numbers, components and signs.
pub(super) fn changes(place: &ExpressionPlace<'_>, scope: &mut NameScope<'_>, found: &mut Vec<Local>) {
    let own = place.own;
    let expression = |kind| Expression::made(own.line, kind);
    let call = |name: &str, arguments| expression(ExpressionKind::Call(name.into(), arguments));
    let number = |number| expression(ExpressionKind::Floating(number, false));
    match &own.kind {
        ExpressionKind::Name(_) => other_names(place, scope, found),
        ExpressionKind::Floating(value, false) => {
            if scope.free {
                let free = || expression(ExpressionKind::Name(FREE.into()));
                found.push(Local::new(Operator::OtherNumber, free()));
                let negative = expression(ExpressionKind::Unary(Unary::Minus, Box::new(free())));
                found.push(Local::new(Operator::OtherNumber, negative));
                found.push(Local::new(Operator::OtherNumber, number(0.0)));
            } else {
                let others = [0.0, 1.0, value * 2.0, value / 2.0, -value, 1.0 - value, value * 10.0, value / 10.0];
                let plain = [2.0, 3.0, 4.0, 5.0, 8.0, 16.0, 64.0, 128.0].into_iter().filter(|_| *value > 2.0);
                let others = others.into_iter().chain(plain);
                found.extend(others.map(|other| Local::new(Operator::OtherNumber, number(other))));
            }
        }
        ExpressionKind::Integer(value, unsigned) => {
            let others = [0.0, 1.0, 2.0, 3.0, value + 1.0, value - 1.0, value * 2.0].into_iter();
            let integer = |other| expression(ExpressionKind::Integer(other, *unsigned));
            let others = others.filter(|other| *other >= 0.0);
            found.extend(others.map(|other| Local::new(Operator::OtherNumber, integer(other))));
        }
        ExpressionKind::Unary(Unary::Minus, operand) if !is_literal(operand) => {
            found.push(Local::new(Operator::Sign, (**operand).clone()).about(operand));
        }
        ExpressionKind::Member(of, taken) => {
            let Some(Type::Vector(_, count)) = (scope.kind)(of) else { return };
            let mut member = |name: &str| {
                let kind = ExpressionKind::Member(of.clone(), name.into());
                found.push(Local::new(Operator::OtherComponents, expression(kind)));
            };
            match taken.len() {
                1 => COMPONENTS[..usize::from(count)].iter().for_each(|name| member(name)),
                2 => OF_TWO.iter().filter(|name| **name != &**taken).for_each(|name| member(name)),
                3 => OF_THREE.iter().filter(|name| **name != &**taken).for_each(|name| member(name)),
                _ => {}
            }
        }
        ExpressionKind::Call(name, arguments)
            if Type::named(name).is_some() && arguments.len() > 1 && scope.free && is_literal(own) =>
        {
            // A colour of its own: grey.
            let count = arguments.len();
            let free = vec![expression(ExpressionKind::Name(FREE.into())); count];
            found.push(Local::new(Operator::OtherNumber, call(name, free)));
        }
        _ => {}
    }
}

/// Other values of the same type, or a part of another.
fn other_names(place: &ExpressionPlace<'_>, scope: &mut NameScope<'_>, found: &mut Vec<Local>) {
    let own = place.own;
    let Some(kind) = (scope.kind)(own) else { return };
    let expression = |kind| Expression::made(own.line, kind);
    let call = |name: &str, arguments| expression(ExpressionKind::Call(name.into(), arguments));
    let member = |of: &Expression, name: &str| expression(ExpressionKind::Member(Box::new(of.clone()), name.into()));
    let number = |number| expression(ExpressionKind::Floating(number, false));
    let operator = if matches!(kind, Type::Matrix(..)) { Operator::OtherMatrix } else { Operator::OtherValue };
    let text = written(own);
    for (other, its) in scope.names.iter().filter(|(other, _)| written(other) != text) {
        if *its == kind {
            found.push(Local::new(operator, other.clone()));
        } else if kind == Type::VEC3 && *its == Type::VEC4 && !scope.constants.contains(&written(other)) {
            found.push(Local::new(operator, member(other, "xyz")));
        }
    }
    let is_constant = scope.constants.contains(&text);
    match &kind {
        Type::Matrix(_, columns, rows) if columns == rows => {
            found.extend(["transpose", "inverse"].map(|name| Local::new(operator, call(name, vec![own.clone()]))));
            if *columns == 4 {
                let turned = call("mat4", vec![call("mat3", vec![own.clone()])]);
                found.push(Local::new(Operator::OtherW, turned));
            }
        }
        Type::Vector(..) if floats(Some(&kind)) == Some(4) && !is_constant => {
            for w in [0.0, 1.0] {
                let other = call("vec4", vec![member(own, "xyz"), number(w)]);
                found.push(Local::new(Operator::OtherW, other));
            }
        }
        _ => {}
    }
}
