//! What a right answer is made of, so that it can stand in another program.

use super::super::tree::{ExpressionPlace, MetAs, TreeWalk, paths, walk, with};
use super::super::types::{DeclaredTypes, KnownTypes, guess, of_name, typed};
use super::super::{Operator, bare, calls, floats, is_literal, written};
use super::inlined::{bracketed, inlined, is_everywhere};
use crate::interpreter::syntax::{BaseType, Binary, Expression, ExpressionKind, Item, Name, StatementKind};
use crate::interpreter::types::Type;
use crate::interpreter::{is_builtin, parse, text};
use std::collections::HashSet;

/// What is longer than this is not written by a slip.
const LONGEST: usize = 300;

/// Numbers that every answer may have: what makes no difference to a sum or a product, and where counting begins.
const PLAIN: [f64; 2] = [0.0, 1.0];

/// The values, functions and numbers of a right answer.
#[derive(Debug, Default)]
pub struct Ingredients {
    /// What `main` computes, each by what is declared outside of functions.
    pub(super) values: Vec<Ingredient>,
    wrappers: Vec<Wrapper>,
    numbers: Vec<f64>,
    /// Those that something is divided by.
    divisors: Vec<f64>,
}

#[derive(Debug)]
pub(super) struct Ingredient {
    pub expression: Expression,
    pub kind: Type,
    name: String,
    /// Whether it is declared outside, as it is.
    is_given: bool,
}

/// A function with all that it is given but for one value.
#[derive(Debug)]
struct Wrapper {
    call: Expression,
    /// The place of that value, and its type.
    hole: usize,
    kind: Type,
    operator: Operator,
}

/// A change that takes something from a right answer.
pub(super) struct AddedMistake {
    pub mistake: Operator,
    pub expression: Expression,
    pub name: Option<String>,
    pub is_bound_by_zero: bool,
    /// Whether it would do as well on another line: a part of a sum, and what stands for all of a value.
    pub is_elsewhere: bool,
}

impl Ingredients {
    /// Those of the texts of a right answer.
    pub fn of(texts: &[&str]) -> Self {
        let mut found = Self::default();
        for source in texts {
            let Ok(preprocessed) = text::preprocess(source) else { continue };
            let Ok(items) = parse::parse(&preprocessed.tokens) else { continue };
            found.read(items);
        }
        let mut known = HashSet::new();
        found.values.retain(|value| known.insert(written(&value.expression)));
        let mut known = HashSet::new();
        found.wrappers.retain(|wrapper| known.insert((written(&wrapper.call), wrapper.hole)));
        found.numbers.extend(PLAIN);
        for numbers in [&mut found.numbers, &mut found.divisors] {
            numbers.sort_by(f64::total_cmp);
            numbers.dedup();
        }
        found
    }

    fn read(&mut self, mut items: Vec<Item>) {
        let mut given: HashSet<Name> = HashSet::new();
        for item in &items {
            if let Item::Declaration(declaration) = item {
                for variable in declaration.variables.iter().filter(|variable| variable.lengths.is_empty()) {
                    given.insert(Name::clone(&variable.name));
                    let BaseType::Named(kind) = &declaration.kind.base else { continue };
                    let (Some(kind), name) = (Type::named(kind), &variable.name) else { continue };
                    let expression = of_name(name, declaration.line);
                    self.values.push(Ingredient { expression, kind, name: name.to_string(), is_given: true });
                }
            }
        }
        // The locals of `main` that have one value only, by what is given.
        let mut locals: Vec<(Name, Expression)> = Vec::new();
        for item in &items {
            let Item::Function(function) = item else { continue };
            if *function.name != *"main" {
                continue;
            }
            for statement in function.body.iter().flatten() {
                let StatementKind::Declaration(declaration) = &statement.kind else { continue };
                let BaseType::Named(kind) = &declaration.kind.base else { continue };
                for variable in &declaration.variables {
                    let (Some(value), Some(kind)) = (&variable.value, Type::named(kind)) else { continue };
                    let expression = inlined(value, &locals);
                    if written(&expression).len() > LONGEST || !is_everywhere(&expression) {
                        continue;
                    }
                    locals.push((Name::clone(&variable.name), expression.clone()));
                    self.values.push(Ingredient { expression, kind, name: variable.name.to_string(), is_given: false });
                }
            }
        }
        let declared = DeclaredTypes::of(&items);
        walk(
            &mut items,
            &mut TreeWalk {
                is_part: &|_| true,
                declares: false,
                statement: &mut |_, _| {},
                expression: &mut |own, met, names| {
                    if matches!(met, MetAs::Bound) {
                        return;
                    }
                    let known = KnownTypes { names: &typed(names, own.line), declared: &declared };
                    for path in paths(own) {
                        self.of_place(ExpressionPlace::of(own, &path).own, known, &given);
                    }
                },
            },
        );
    }

    fn of_place(&mut self, own: &Expression, known: KnownTypes<'_>, given: &HashSet<Name>) {
        match &own.kind {
            ExpressionKind::Floating(number, _) => self.numbers.push(*number),
            ExpressionKind::Chain(_, others) => {
                let divisors = others.iter().filter_map(|(operator, _, other)| match (operator, &other.kind) {
                    (Binary::Divide, ExpressionKind::Floating(number, _)) => Some(*number),
                    _ => None,
                });
                self.divisors.extend(divisors);
            }
            ExpressionKind::Call(name, arguments) if Type::named(name).is_none() && is_builtin(name) => {
                let is_given = |one: &Expression| {
                    is_literal(one) || matches!(&bare(one).kind, ExpressionKind::Name(name) if given.contains(name))
                };
                for (hole, argument) in arguments.iter().enumerate() {
                    let mut others = arguments.iter().enumerate().filter(|(at, _)| *at != hole);
                    let Some(kind) = guess(argument, known) else { continue };
                    if is_literal(argument) || !others.all(|(_, other)| is_given(other)) {
                        continue;
                    }
                    // What goes in comes out.
                    if guess(own, known).is_some_and(|result| result != kind) {
                        continue;
                    }
                    let operator = match &**name {
                        "max" | "min" | "clamp" => Operator::ClampLeftOut,
                        "normalize" => Operator::NormalizeLeftOut,
                        "pow" => Operator::PowerLeftOut,
                        _ => Operator::CallLeftOut,
                    };
                    self.wrappers.push(Wrapper { call: own.clone(), hole, kind, operator });
                }
            }
            _ => {}
        }
    }

    /// The changes at a place with what a right answer is made of.
    pub(super) fn changes(
        &self,
        place: &ExpressionPlace<'_>,
        kind: &Type,
        theirs: &[(Expression, Type)],
    ) -> Vec<AddedMistake> {
        let (own, is_whole) = (place.own, place.is_whole());
        let mut found = Vec::new();
        let is_measured = place.parent.is_some_and(is_measure);
        let plain = |mistake, expression| AddedMistake {
            mistake,
            expression,
            name: None,
            is_bound_by_zero: false,
            is_elsewhere: match mistake {
                Operator::AddendLeftOut => !is_measured,
                Operator::OtherValue => true,
                _ => false,
            },
        };
        if let ExpressionKind::Floating(value, _) = own.kind {
            let others = self.numbers.iter().filter(|number| **number != value);
            let number = |number: &f64| Expression { kind: ExpressionKind::Floating(*number, false), ..own.clone() };
            found.extend(others.map(|other| plain(Operator::OtherNumber, number(other))));
            let names = self.values.iter().filter(|value| value.is_given && value.kind == Type::FLOAT);
            found.extend(names.map(|name| plain(Operator::OtherNumber, name.expression.clone())));
            return found;
        }
        found.extend(self.to_another_space(own, kind, theirs));
        let Some(count) = floats(Some(kind)) else { return found };
        if is_literal(own) || matches!(own.kind, ExpressionKind::Assign(..)) {
            return found;
        }
        for wrapper in self.wrappers.iter().filter(|wrapper| wrapper.kind == *kind) {
            let expression = with(&wrapper.call, &[wrapper.hole], own.clone());
            let is_bound_by_zero = calls::is_bound_by_zero(&wrapper.call);
            found.push(AddedMistake { is_bound_by_zero, ..plain(wrapper.operator, expression) });
        }
        let has = |parent: &Expression, which: &[Binary]| match &parent.kind {
            ExpressionKind::Chain(_, others) => others.iter().any(|(operator, ..)| which.contains(operator)),
            _ => false,
        };
        let sums = [Binary::Add, Binary::Subtract];
        // A value is added to all that is added up, and multiplied with what is an addend, or given to something.
        let is_sum = is_whole || is_measured || has(own, &sums);
        let is_addend = is_whole || place.parent.is_some_and(|parent| has(parent, &sums) || is_given_on(parent));
        if !is_sum && !is_addend {
            return found;
        }
        let it = || match &own.kind {
            ExpressionKind::Chain(..) | ExpressionKind::Conditional(..) => {
                Expression { kind: ExpressionKind::Comma(vec![own.clone()]), ..own.clone() }
            }
            _ => own.clone(),
        };
        let between = |operator, other: Expression| {
            Expression::made(own.line, ExpressionKind::Chain(Box::new(it()), vec![(operator, own.line, other)]))
        };
        if is_addend {
            let number = |number: &f64| Expression::made(own.line, ExpressionKind::Floating(*number, false));
            let by = self.divisors.iter().map(|by| between(Binary::Divide, number(by)));
            found.extend(by.map(|divided| plain(Operator::DivisorLeftOut, divided)));
        }
        let their_values = theirs.iter().map(|(value, kind)| (value, kind, written(value)));
        let right_values = self
            .values
            .iter()
            .filter(|value| !value.is_given || !theirs.iter().any(|(name, _)| is_named(name, &value.name)));
        let right_values = right_values.map(|value| (&value.expression, &value.kind, value.name.clone()));
        for (value, its, name) in their_values.chain(right_values) {
            let Some(width) = floats(Some(its)) else { continue };
            let fitting = match (width, count) {
                (a, b) if a == b || a == 1 => value.clone(),
                (4, 3) => Expression {
                    kind: ExpressionKind::Member(Box::new(bracketed(value)), "xyz".into()),
                    ..value.clone()
                },
                // A number becomes a vector by a factor only, where a vector may stand as well.
                (_, 1) if !is_whole || place.parent.is_some_and(is_given_by_an_operator) => value.clone(),
                _ => continue,
            };
            let named = |mistake, expression| AddedMistake { name: Some(name.clone()), ..plain(mistake, expression) };
            let is_alike = width >= count && (count > 1 || width == 1);
            if is_sum && is_alike {
                found.push(named(Operator::AddendLeftOut, between(Binary::Add, bracketed(&fitting))));
                // Nothing is left of what is taken from itself.
                if written(&fitting) != written(own) {
                    found.push(named(Operator::AddendLeftOut, between(Binary::Subtract, bracketed(&fitting))));
                }
            }
            if is_addend {
                found.push(named(Operator::FactorLeftOut, between(Binary::Multiply, bracketed(&fitting))));
                if width == 1 {
                    found.push(named(Operator::DivisorLeftOut, between(Binary::Divide, bracketed(&fitting))));
                }
            }
            if (is_whole || matches!(own.kind, ExpressionKind::Name(_))) && width == count {
                found.push(named(Operator::OtherValue, fitting));
            }
        }
        found
    }
}

/// Whether an expression measures vectors, which are differences and sums of places and directions.
fn is_measure(parent: &Expression) -> bool {
    matches!(&parent.kind, ExpressionKind::Call(name, _) if ["distance", "dot", "length", "normalize"].contains(&&**name))
}

/// Whether what is given is added to a variable, or the like, which may be a vector while that is a number.
fn is_given_by_an_operator(parent: &Expression) -> bool {
    matches!(parent.kind, ExpressionKind::Assign(Some(_), ..))
}

/// Whether an expression gives its operands to a function.
fn is_given_on(parent: &Expression) -> bool {
    matches!(parent.kind, ExpressionKind::Call(..) | ExpressionKind::Comma(_))
}

fn is_named(expression: &Expression, name: &str) -> bool {
    matches!(&expression.kind, ExpressionKind::Name(own) if **own == *name)
}
