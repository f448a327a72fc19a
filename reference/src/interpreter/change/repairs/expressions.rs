//! The changes of an expression.

use super::super::inverse::mistake_of;
use super::super::tree::{ExpressionPlace, Path, TypedNames, operands, paths};
use super::super::types::{KnownTypes, guess, typed};
use super::super::{Change, NameScope, Operator, bare, calls, changes, written};
use super::copies::place;
use super::declared::Declared;
use super::undone;
use super::{Ingredients, ProgramRepair, Where};
use crate::interpreter::is_builtin;
use crate::interpreter::syntax::{Binary, Expression, ExpressionKind};
use crate::interpreter::types::Type;
use std::collections::HashSet;

/// The changes of an expression, each with the byte at which what it changes is written.
pub(super) fn of_expression(
    own: &Expression,
    number: usize,
    names: &TypedNames,
    right: &Ingredients,
    declared: &Declared,
) -> Vec<(u32, ProgramRepair)> {
    let typed = typed(names, own.line);
    let theirs = KnownTypes { names: &typed, declared: &declared.types };
    let mut kind = |expression: &Expression| guess(expression, theirs);
    let scope = &mut NameScope { names: &typed, constants: &HashSet::new(), kind: &mut kind, free: false };
    let slips = changes(own, scope).into_iter().filter(|change| change.operator != Operator::WholeNumbers);
    let mut found: Vec<(u32, ProgramRepair)> = slips.map(|change| of_slip(own, number, &change, declared)).collect();
    for path in paths(own) {
        let place = ExpressionPlace::of(own, &path);
        let is_of_use = is_use(place.own, declared);
        let add = |mistake, expression| repair((number, &path), place.own, expression, mistake, is_of_use);
        let undone = undone::changes(&place, theirs, &declared.members).into_iter().map(|(mistake, expression)| {
            let repair = add(mistake, expression);
            // A place is divided by its last component where it is used.
            ProgramRepair { is_of_use: repair.is_of_use && mistake != Operator::DivisorLeftOut, ..repair }
        });
        found.extend(undone.map(|repair| (place.own.at, repair)));
        let Some(kind) = guess(place.own, theirs) else { continue };
        let added = right.changes(&place, &kind, &typed).into_iter().map(|added| ProgramRepair {
            line: place.own.line,
            is_bound_by_zero: added.is_bound_by_zero,
            added: added.name,
            // One number is written for another.
            is_slip: added.mistake == Operator::OtherNumber,
            // What a function of the text is called for may as well be wrong in the function.
            is_elsewhere: added.is_elsewhere || has_own_call(place.own),
            is_of_use,
            ..add(added.mistake, added.expression)
        });
        found.extend(added.map(|repair| (place.own.at, repair)));
    }
    found.sort_by_key(|(_, repair)| repair.mistake);
    let mut known = HashSet::new();
    let is_new = found.iter().map(|(_, repair)| known.insert((place(repair), &repair.texts[1])));
    let mut is_new = is_new.collect::<Vec<_>>().into_iter();
    found.retain(|_| is_new.next() == Some(true));
    found
}

fn of_slip(own: &Expression, number: usize, change: &Change, declared: &Declared) -> (u32, ProgramRepair) {
    let [before, after] = [own, &change.expression].map(|root| ExpressionPlace::of(root, &change.path).own);
    let is_bound_by_zero = change.is_bound_by_zero || calls::is_bound_by_zero(after);
    let place = (number, &change.path);
    let repair = repair(place, before, after.clone(), mistake_of(own, change), is_use(before, declared));
    (before.at, ProgramRepair { is_bound_by_zero, ..repair })
}

/// The slip that one expression in place of another undoes, by the number of the whole expression and the place in it.
fn repair(
    (number, path): (usize, &Path),
    before: &Expression,
    after: Expression,
    mistake: Operator,
    is_use: bool,
) -> ProgramRepair {
    let texts = [written(before), written(&after)];
    // What a result is kept from is a matter of the function that gives it.
    let is_kept = mistake <= Operator::CallLeftOut && has_own_call(before);
    let is_of_use = is_kept || is_use && !is_substitute(mistake);
    let line = line_of(before, &after);
    let place = Where::Expressions(vec![(number, path.clone(), after)]);
    ProgramRepair { is_of_use, ..ProgramRepair::slip(mistake, line, texts, place) }
}

/// Whether an expression only passes on what is made elsewhere in the text.
fn is_use(own: &Expression, declared: &Declared) -> bool {
    match &bare(own).kind {
        ExpressionKind::Name(name) => !declared.is_input(name),
        ExpressionKind::Member(of, _) | ExpressionKind::Index(of, _) => is_use(of, declared),
        ExpressionKind::Call(..) => is_own_call(own),
        _ => false,
    }
}

/// Whether the result of a function of the text is a part of a sum or a product.
fn has_own_call(own: &Expression) -> bool {
    let own = bare(own);
    match &own.kind {
        ExpressionKind::Call(..) => is_own_call(own),
        ExpressionKind::Chain(..) => operands(own).into_iter().any(has_own_call),
        _ => false,
    }
}

/// Whether a function of the text is called.
fn is_own_call(own: &Expression) -> bool {
    matches!(&bare(own).kind, ExpressionKind::Call(name, _) if Type::named(name).is_none() && !is_builtin(name))
}

/// Whether another value is taken, and nothing made of it.
fn is_substitute(mistake: Operator) -> bool {
    matches!(
        mistake,
        Operator::OtherValue
            | Operator::OtherMatrix
            | Operator::OtherComponents
            | Operator::OtherNumber
            | Operator::OtherFunction
            | Operator::Exchanged
    )
}

/// The line of what a change is about: in a chain of operators, that of the first one at which it is another chain; of what is given to a
/// function, that of the first that is another one.
fn line_of(before: &Expression, after: &Expression) -> u32 {
    let differs = |pair: &(&Expression, &Expression)| written(pair.0) != written(pair.1);
    match (&before.kind, &after.kind) {
        (ExpressionKind::Chain(first, own), ExpressionKind::Chain(other, theirs)) => {
            let pairs = own.iter().zip(theirs);
            let is_same = |(own, other): &(&Operand, &Operand)| own.0 == other.0 && !differs(&(&own.2, &other.2));
            let same = pairs.take_while(is_same).count();
            match own.get(same) {
                Some((_, line, _)) if !differs(&(first, other)) => *line,
                _ => before.line,
            }
        }
        (ExpressionKind::Call(name, own), ExpressionKind::Call(other, theirs)) if name == other => {
            let first = own.iter().zip(theirs).find(differs);
            first.map_or(before.line, |(own, _)| bare(own).line)
        }
        _ => before.line,
    }
}

/// An operator with its line, and what stands behind it.
type Operand = (Binary, u32, Expression);
