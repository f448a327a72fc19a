//! The type of an expression, as far as it is easily seen.

use super::tree::TypedNames;
use crate::interpreter::builtin;
use crate::interpreter::syntax::{
    BaseType, Binary, Declaration, Expression, ExpressionKind, InterfaceBlock, Item, Name, TypeName,
};
use crate::interpreter::types::{Scalar, Type};
use std::collections::HashMap;

/// What is known of types at a place of a program.
#[derive(Clone, Copy)]
pub(super) struct KnownTypes<'k> {
    /// The variables, the innermost first.
    pub names: &'k [(Expression, Type)],
    pub declared: &'k DeclaredTypes,
}

/// The types that functions and members have, by their names.
#[derive(Clone, Debug, Default)]
pub(super) struct DeclaredTypes {
    functions: HashMap<Name, Type>,
    members: HashMap<Name, Type>,
}

impl DeclaredTypes {
    /// Those of a program. A name that has several types has none here.
    pub fn of(items: &[Item]) -> Self {
        let (mut functions, mut members) = (Vec::new(), Vec::new());
        for item in items {
            match item {
                Item::Function(function) => functions.push((&function.name, known(&function.result))),
                Item::Block(InterfaceBlock { members: all, .. })
                | Item::Declaration(Declaration { kind: TypeName { base: BaseType::Struct(_, all), .. }, .. }) => {
                    let typed = all.iter().flat_map(|member| {
                        member
                            .variables
                            .iter()
                            .map(|own| (&own.name, known(&member.kind).filter(|_| own.lengths.is_empty())))
                    });
                    members.extend(typed);
                }
                _ => {}
            }
        }
        Self { functions: unique(&functions), members: unique(&members) }
    }
}

fn known(kind: &TypeName) -> Option<Type> {
    match &kind.base {
        BaseType::Named(name) if kind.lengths.is_empty() => Type::named(name),
        _ => None,
    }
}

/// The names that have one type.
fn unique(all: &[(&Name, Option<Type>)]) -> HashMap<Name, Type> {
    let is_one = |name: &Name, kind: &Option<Type>| all.iter().all(|(other, its)| *other != name || its == kind);
    let one = all.iter().filter(|(name, kind)| is_one(name, kind));
    one.filter_map(|(name, kind)| Some((Name::clone(name), kind.clone()?))).collect()
}

/// The variables of these names, the innermost first, as they are written on a line.
pub(super) fn typed(names: &TypedNames, line: u32) -> Vec<(Expression, Type)> {
    let known = names.iter().rev().filter_map(|(name, kind)| Some((of_name(name, line), Type::named(kind)?)));
    known.collect()
}

/// A variable.
pub(super) fn of_name(name: &Name, line: u32) -> Expression {
    Expression::made(line, ExpressionKind::Name(Name::clone(name)))
}

/// The type of an expression, as far as it is easily seen; the compiler knows better.
pub(super) fn guess(expression: &Expression, known: KnownTypes<'_>) -> Option<Type> {
    match &expression.kind {
        ExpressionKind::Floating(_, false) => Some(Type::FLOAT),
        ExpressionKind::Integer(_, false) => Some(Type::INT),
        ExpressionKind::Name(own) => {
            let is_it = |name: &Expression| matches!(&name.kind, ExpressionKind::Name(name) if name == own);
            known.names.iter().find(|(name, _)| is_it(name)).map(|(_, kind)| kind.clone())
        }
        ExpressionKind::Unary(_, of) => guess(of, known),
        ExpressionKind::Comma(all) => guess(all.last()?, known),
        ExpressionKind::Conditional(_, yes, _) => guess(yes, known),
        ExpressionKind::Member(of, taken) => match guess(of, known) {
            Some(Type::Vector(scalar, _)) => Some(Type::Vector(scalar, u8::try_from(taken.len()).ok()?)),
            Some(_) => None,
            None => known.declared.members.get(taken).cloned(),
        },
        ExpressionKind::Index(of, _) => match guess(of, known)? {
            Type::Matrix(scalar, _, rows) => Some(Type::Vector(scalar, rows)),
            Type::Vector(scalar, _) => Some(Type::Vector(scalar, 1)),
            _ => None,
        },
        ExpressionKind::Call(name, arguments) => {
            let own = Type::named(name).or_else(|| known.declared.functions.get(name).cloned());
            let of = |place: usize| guess(arguments.get(place)?, known);
            own.or_else(|| match &**name {
                "dot" | "length" | "distance" => Some(Type::FLOAT),
                "texture" => Some(Type::VEC4),
                "step" => of(1),
                "smoothstep" => of(2),
                name => builtin::signatures(name).first().and_then(|_| of(0)),
            })
        }
        ExpressionKind::Chain(first, others) => {
            if others.iter().any(|(operator, ..)| !is_arithmetic(*operator)) {
                return Some(Type::BOOL);
            }
            let kinds = std::iter::once(&**first).chain(others.iter().map(|(_, _, other)| other));
            let kinds: Vec<Type> = kinds.map(|operand| guess(operand, known)).collect::<Option<_>>()?;
            let is_vector = |kind: &&Type| matches!(kind, Type::Vector(Scalar::Float, count) if *count > 1);
            kinds.iter().rfind(is_vector).or(kinds.first()).cloned()
        }
        _ => None,
    }
}

fn is_arithmetic(operator: Binary) -> bool {
    matches!(operator, Binary::Add | Binary::Subtract | Binary::Multiply | Binary::Divide | Binary::Remainder)
}
