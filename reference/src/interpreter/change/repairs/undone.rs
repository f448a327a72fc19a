//! Slips that are undone in a text, and that nobody makes of a right answer: there they would be another slip, or none.

use super::super::calls::exchanged;
use super::super::chains::is_additive;
use super::super::leaves::OF_THREE;
use super::super::tree::{ExpressionPlace, operands};
use super::super::types::{KnownTypes, guess};
use super::super::{Operator, bare, written};
use crate::interpreter::is_builtin;
use crate::interpreter::syntax::{Binary, Expression, ExpressionKind, Name, Unary};
use crate::interpreter::types::Type;

/// What is a number of two vectors, so that another number may be meant.
const OF_VECTORS: [&str; 3] = ["dot", "length", "distance"];

/// Arguments of a constructor that are exchanged with one another.
const MOST_ARGUMENTS: usize = 6;

/// The changes at a place: what the student did, and what stands there then.
pub(super) fn changes(
    place: &ExpressionPlace<'_>,
    known: KnownTypes<'_>,
    members: &[Name],
) -> Vec<(Operator, Expression)> {
    let own = place.own;
    let kind = guess(own, known);
    let mut found = Vec::new();
    let exchange = |arguments: &[Expression], kind: &dyn Fn(Vec<Expression>) -> ExpressionKind| {
        let all = exchanged(arguments, MOST_ARGUMENTS, &mut |one| guess(one, known)).into_iter();
        let other = |other| (Operator::Exchanged, Expression { kind: kind(other), ..own.clone() });
        all.map(other).collect::<Vec<_>>()
    };
    if let ExpressionKind::Assign(operator, to, from) = &own.kind {
        let assigned = |to| ExpressionKind::Assign(*operator, Box::new(to), from.clone());
        let values = other_targets(to, known).into_iter().map(|to| (Operator::OtherValue, to));
        let components = other_components(to).into_iter().map(|to| (Operator::OtherComponents, to));
        let others = values.chain(components);
        found.extend(others.map(|(mistake, to)| (mistake, Expression { kind: assigned(to), ..own.clone() })));
    }
    // Some components in place of the whole vector. Beside other arguments of a constructor it would be too many.
    if let ExpressionKind::Member(of, _) = &own.kind
        && matches!(guess(of, known), Some(Type::Vector(..)))
        && !place.parent.is_some_and(is_one_of_several)
    {
        found.push((Operator::OtherComponents, (**of).clone()));
    }
    match &own.kind {
        ExpressionKind::Assign(None, to, from) => {
            for (mistake, operator) in
                [(Operator::AddendLeftOut, Binary::Add), (Operator::FactorLeftOut, Binary::Multiply)]
            {
                let kind = ExpressionKind::Assign(Some(operator), to.clone(), from.clone());
                found.push((mistake, Expression { kind, ..own.clone() }));
            }
        }
        // One that is copied from where it is the first, or written for how many there are.
        ExpressionKind::Integer(..) if place.parent.is_some_and(is_counted_by) => {
            let whole = known.names.iter().filter(|(_, kind)| *kind == Type::INT);
            found.extend(whole.map(|(name, _)| (Operator::OtherValue, name.clone())));
        }
        ExpressionKind::Call(name, _) if OF_VECTORS.contains(&&**name) => {
            let numbers = known.names.iter().filter(|(_, kind)| *kind == Type::FLOAT);
            found.extend(numbers.map(|(name, _)| (Operator::OtherValue, name.clone())));
        }
        ExpressionKind::Call(name, arguments) if Type::named(name).is_some() => {
            found.extend(exchange(arguments, &|other| ExpressionKind::Call(Name::clone(name), other)));
        }
        ExpressionKind::ArrayConstructor(kind, arguments) => {
            found.extend(exchange(arguments, &|other| ExpressionKind::ArrayConstructor(kind.clone(), other)));
        }
        // What a matrix of perspective gives is divided by its last component.
        ExpressionKind::Member(of, name)
            if name.chars().all(|c| "xyz".contains(c)) && guess(of, known) == Some(Type::VEC4) =>
        {
            let last = ExpressionKind::Member(of.clone(), "w".into());
            let by = vec![(Binary::Divide, own.line, Expression { kind: last, ..own.clone() })];
            let divided = Expression { kind: ExpressionKind::Chain(Box::new(own.clone()), by), ..own.clone() };
            found.push((Operator::DivisorLeftOut, divided));
        }
        // Of a vector they are components.
        ExpressionKind::Member(of, name) if !matches!(guess(of, known), Some(Type::Vector(..))) => {
            let others = members.iter().filter(|other| *other != name);
            let member = |other: &Name| Expression {
                kind: ExpressionKind::Member(of.clone(), Name::clone(other)),
                ..own.clone()
            };
            found.extend(others.map(|other| (Operator::OtherValue, member(other))));
        }
        ExpressionKind::Chain(first, others) => {
            found.extend(taken_in(own).into_iter().map(|own| (Operator::Grouping, own)));
            found.extend(floating(own).map(|own| (Operator::WholeNumbers, own)));
            // What is turned round as a share of one.
            if let (ExpressionKind::Floating(1.0, _), [(Binary::Subtract, _, other)]) = (&first.kind, &others[..]) {
                found.push((Operator::Complement, other.clone()));
            }
        }
        _ => {}
    }
    if matches!(kind, Some(Type::Matrix(_, columns, rows)) if columns == rows) {
        let call = |name: &str, of| Expression::made(own.line, ExpressionKind::Call(name.into(), vec![of]));
        let inverse = || call("inverse", own.clone());
        let turned = [inverse(), call("transpose", own.clone()), call("transpose", inverse())];
        found.extend(turned.map(|turned| (Operator::CallLeftOut, turned)));
    }
    if place.is_whole() && !matches!(own.kind, ExpressionKind::Assign(..)) && kind == Some(Type::FLOAT) {
        let one = Expression::made(own.line, ExpressionKind::Floating(1.0, false));
        let of = Expression::made(own.line, ExpressionKind::Comma(vec![own.clone()]));
        let kind = ExpressionKind::Chain(Box::new(one), vec![(Binary::Divide, own.line, of)]);
        found.push((Operator::OtherOperator, Expression::made(own.line, kind)));
    }
    found
}

/// Other variables of its type that something is assigned to, or other elements of its array.
fn other_targets(to: &Expression, known: KnownTypes<'_>) -> Vec<Expression> {
    match &to.kind {
        ExpressionKind::Name(_) => {
            let (kind, text) = (guess(to, known), written(to));
            let is_other = |(name, its): &&(Expression, Type)| {
                Some(its) == kind.as_ref() && matches!(name.kind, ExpressionKind::Name(_)) && written(name) != text
            };
            known.names.iter().filter(is_other).map(|(name, _)| name.clone()).collect()
        }
        ExpressionKind::Index(of, at) => {
            let ExpressionKind::Integer(own, unsigned) = at.kind else { return Vec::new() };
            let others = [0.0, 1.0, 2.0, 3.0].into_iter().filter(|other| *other != own);
            let index = |other| Expression { kind: ExpressionKind::Integer(other, unsigned), ..(**at).clone() };
            let element = |other| ExpressionKind::Index(of.clone(), Box::new(index(other)));
            others.map(|other| Expression { kind: element(other), ..to.clone() }).collect()
        }
        _ => Vec::new(),
    }
}

/// Other components of a vector in place of three that something is assigned to.
fn other_components(to: &Expression) -> Vec<Expression> {
    let ExpressionKind::Member(of, taken) = &to.kind else { return Vec::new() };
    if taken.len() != 3 || !taken.chars().all(|c| "xyzrgb".contains(c)) {
        return Vec::new();
    }
    let member = |name: &str| ExpressionKind::Member(of.clone(), name.into());
    OF_THREE.iter().map(|name| Expression { kind: member(name), ..to.clone() }).collect()
}

/// What stands behind a function of one value, in its brackets: `f(a) * b` becomes `f(a * b)`, and `f(a + b) * c` becomes `f(a + b * c)`.
fn taken_in(own: &Expression) -> Option<Expression> {
    let ExpressionKind::Chain(first, others) = &own.kind else { return None };
    let ExpressionKind::Call(name, arguments) = &first.kind else { return None };
    let ([argument], [next, rest @ ..]) = (&arguments[..], &others[..]) else { return None };
    let chain = |first: Expression, others: Vec<(Binary, u32, Expression)>| Expression {
        kind: ExpressionKind::Chain(Box::new(first), others),
        ..own.clone()
    };
    let inner = match &argument.kind {
        ExpressionKind::Chain(begin, parts) if is_additive(parts[0].0) && !is_additive(next.0) => {
            let mut parts = parts.clone();
            let last = parts.last_mut()?;
            last.2 = chain(last.2.clone(), vec![next.clone()]);
            chain((**begin).clone(), parts)
        }
        _ => chain(argument.clone(), vec![next.clone()]),
    };
    let call = Expression { kind: ExpressionKind::Call(Name::clone(name), vec![inner]), ..(**first).clone() };
    Some(if rest.is_empty() { call } else { chain(call, rest.to_vec()) })
}

/// The condition of a branch that holds only where that of the branch before it does not.
pub(super) fn with_else(before: &Expression, own: &Expression) -> Expression {
    let bracket = |of: &Expression| Expression::made(own.line, ExpressionKind::Comma(vec![of.clone()]));
    let not = Expression::made(own.line, ExpressionKind::Unary(Unary::Not, Box::new(bracket(before))));
    let kind = ExpressionKind::Chain(Box::new(not), vec![(Binary::And, own.line, bracket(own))]);
    Expression { kind, ..own.clone() }
}

/// Whether a vector or the like is made there of several values.
fn is_one_of_several(parent: &Expression) -> bool {
    matches!(&parent.kind, ExpressionKind::Call(name, all) if Type::named(name).is_some() && all.len() > 1)
}

/// Whether a whole number stands there for an element, for how many there are, or for one of several cases.
fn is_counted_by(parent: &Expression) -> bool {
    match &parent.kind {
        ExpressionKind::Index(..) => true,
        ExpressionKind::Call(name, _) => Type::named(name).is_none() && !is_builtin(name),
        ExpressionKind::Chain(_, others) => {
            let is_bound = |operator| matches!(operator, Binary::Less | Binary::LessEqual | Binary::NotEqual);
            others.iter().any(|(operator, ..)| is_bound(*operator))
        }
        _ => false,
    }
}

/// A quotient of whole numbers as one of floats.
fn floating(own: &Expression) -> Option<Expression> {
    let ExpressionKind::Chain(first, others) = &own.kind else { return None };
    let is_whole = |operand: &&&Expression| matches!(bare(operand).kind, ExpressionKind::Integer(..));
    let divides = others.iter().any(|(operator, ..)| *operator == Binary::Divide);
    if !divides || operands(own).iter().filter(is_whole).count() < 2 {
        return None;
    }
    let float = |operand: &Expression| match &bare(operand).kind {
        ExpressionKind::Integer(value, _) => {
            Expression { kind: ExpressionKind::Floating(*value, false), ..operand.clone() }
        }
        _ => operand.clone(),
    };
    let others = others.iter().map(|(operator, line, operand)| (*operator, *line, float(operand)));
    let kind = ExpressionKind::Chain(Box::new(float(first)), others.collect());
    Some(Expression { kind, ..own.clone() })
}
