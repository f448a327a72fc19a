//! What an expression would be by a slip: generic operators on its syntax tree, which know nothing of what it is for.
//!
//! Each [`Change`] is one slip of one operator at one place. Whether it has a type at all is for the compiler to say.

mod calls;
mod chains;
mod inverse;
mod leaves;
mod programs;
mod repairs;
mod tree;
mod types;
mod wrappers;
mod write;

pub use programs::{
    ChangedPart, ProgramSlip, SlipMark, program_slips, program_without_parts, slips_marked, slips_of_variables,
    slips_written,
};
pub use repairs::{Ingredients, ProgramRepair, Repairable};
pub use write::written;

use super::syntax::{Expression, ExpressionKind, Name};
use super::types::{Scalar, Type};
use serde::Deserialize;
use std::collections::HashSet;

/// What kind of slip it is. The plainer ones stand first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Deserialize)]
pub enum Operator {
    /// `max`, `min` or `clamp` is left out.
    ClampLeftOut,
    /// `normalize` is left out.
    NormalizeLeftOut,
    /// `pow` is left out.
    PowerLeftOut,
    /// Another function is left out.
    CallLeftOut,
    /// All of it is left out: it is 0.
    LeftOut,
    /// A part of a sum is left out.
    AddendLeftOut,
    /// A factor is left out.
    FactorLeftOut,
    /// A matrix is left out of a product.
    MatrixLeftOut,
    /// A divisor is left out.
    DivisorLeftOut,
    /// A statement is left out.
    StatementLeftOut,
    /// A case of a `switch` runs into the next.
    FallsThrough,
    /// A function changes a copy of what it is given.
    ByValue,
    /// A variable is declared anew where another one of its name is meant.
    Shadowed,
    /// What a function returns is not used.
    ThrownAway,
    /// Nothing belongs to a branch.
    EmptyBranch,
    /// The sign is the other one.
    Sign,
    /// Another operator stands between two operands.
    OtherOperator,
    /// Operands or arguments are exchanged.
    Exchanged,
    /// Another value of the same type stands there.
    OtherValue,
    /// Another matrix stands there.
    OtherMatrix,
    /// Other components of a vector are taken.
    OtherComponents,
    /// A point is taken for a direction, or a direction for a point.
    OtherW,
    /// Another function is called.
    OtherFunction,
    /// Two functions are applied in the other order, or a function to a part only.
    OtherOrder,
    /// It is 1 minus what it should be.
    Complement,
    /// Brackets are missing, or stand around something else.
    Grouping,
    /// A part of a sum is added twice.
    AddedTwice,
    /// A factor is there twice.
    Squared,
    /// `abs` around it.
    Absolute,
    /// A clamp around it.
    Clamped,
    /// `normalize` around it.
    Normalized,
    /// It is divided as whole numbers are.
    WholeNumbers,
    /// It is shifted from −1 … 1 to 0 … 1.
    Raised,
    /// The square root of it.
    Root,
    /// It is 0 where something else is not above 0.
    Gated,
    /// It is multiplied by something that has no place there.
    Times,
    /// A number is another one.
    OtherNumber,
    /// It is multiplied by a number.
    Scaled,
    /// It is raised to a power.
    Raising,
    /// A number is added to it.
    Shifted,
    /// What it is computed from is right, and it is not.
    Otherwise,
}

impl Operator {
    /// Whether it concerns how a function is written, and not what stands in its expressions.
    #[must_use]
    pub const fn is_of_a_body(self) -> bool {
        matches!(self, Self::FallsThrough | Self::ByValue | Self::Shadowed | Self::ThrownAway | Self::EmptyBranch)
    }
}

#[cfg(test)]
impl Operator {
    /// All of them.
    pub const ALL: [Self; 41] = [
        Self::ClampLeftOut,
        Self::NormalizeLeftOut,
        Self::PowerLeftOut,
        Self::CallLeftOut,
        Self::LeftOut,
        Self::AddendLeftOut,
        Self::FactorLeftOut,
        Self::MatrixLeftOut,
        Self::DivisorLeftOut,
        Self::StatementLeftOut,
        Self::FallsThrough,
        Self::ByValue,
        Self::Shadowed,
        Self::ThrownAway,
        Self::EmptyBranch,
        Self::Sign,
        Self::OtherOperator,
        Self::Exchanged,
        Self::OtherValue,
        Self::OtherMatrix,
        Self::OtherComponents,
        Self::OtherW,
        Self::OtherFunction,
        Self::OtherOrder,
        Self::Complement,
        Self::Grouping,
        Self::AddedTwice,
        Self::Squared,
        Self::Absolute,
        Self::Clamped,
        Self::Normalized,
        Self::WholeNumbers,
        Self::Raised,
        Self::Root,
        Self::Gated,
        Self::Times,
        Self::OtherNumber,
        Self::Scaled,
        Self::Raising,
        Self::Shifted,
        Self::Otherwise,
    ];
}

/// One slip.
#[derive(Clone, Debug)]
pub struct Change {
    /// Of which kind.
    pub operator: Operator,
    /// What is written with it.
    pub expression: Expression,
    /// The name that is concerned, where it is a single one.
    pub about: Option<Name>,
    /// Where it is in the expression.
    pub path: tree::Path,
    /// Whether it is in the whole expression, not in a part of it.
    pub is_whole: bool,
    /// Whether it is a bound of 0 that is concerned.
    pub is_bound_by_zero: bool,
}

/// The name of the number that is free in a change.
pub const FREE: &str = "free_number";

/// What can be named where an expression stands.
pub struct NameScope<'a> {
    /// Names, or paths of members, with their types; the first ones are the nearest.
    pub names: &'a [(Expression, Type)],
    /// Those of them that are the same everywhere.
    pub constants: &'a HashSet<String>,
    /// The type of an expression, where it is known.
    pub kind: &'a mut dyn FnMut(&Expression) -> Option<Type>,
    /// Whether numbers may be left free.
    pub free: bool,
}

/// Most changes of one expression; what comes first is plainest.
const MOST: usize = 800;

/// Every slip in an expression, none of them twice.
pub fn changes(root: &Expression, scope: &mut NameScope<'_>) -> Vec<Change> {
    let mut found: Vec<Change> = Vec::new();
    for path in tree::paths(root) {
        let place = tree::ExpressionPlace::of(root, &path);
        let mut own = Vec::new();
        chains::changes(&place, scope, &mut own);
        calls::changes(&place, scope, &mut own);
        leaves::changes(&place, scope, &mut own);
        wrappers::changes(&place, scope, &mut own);
        let is_bound_by_zero = calls::is_bound_by_zero(place.own);
        found.extend(own.into_iter().map(|Local { operator, expression, about }| Change {
            operator,
            expression: tree::with(root, &path, expression),
            about,
            path: path.clone(),
            is_whole: place.is_root(),
            is_bound_by_zero,
        }));
    }
    found.sort_by_key(|change| change.operator);
    let mut known: HashSet<String> = HashSet::from([written(root)]);
    found.retain(|change| known.insert(written(&change.expression)));
    found.truncate(MOST);
    found
}

/// A slip at one place, apart from what stands around it.
struct Local {
    operator: Operator,
    expression: Expression,
    about: Option<Name>,
}

impl Local {
    fn new(operator: Operator, expression: Expression) -> Self {
        Self { operator, expression, about: None }
    }

    fn about(self, operand: &Expression) -> Self {
        Self { about: name_of(operand), ..self }
    }
}

/// The name that an expression is, brackets aside.
fn name_of(expression: &Expression) -> Option<Name> {
    match &bare(expression).kind {
        ExpressionKind::Name(name) => Some(Name::clone(name)),
        _ => None,
    }
}

/// An expression without brackets around it.
fn bare(expression: &Expression) -> &Expression {
    match &expression.kind {
        ExpressionKind::Comma(all) => match &all[..] {
            [one] => bare(one),
            _ => expression,
        },
        _ => expression,
    }
}

fn is_literal(expression: &Expression) -> bool {
    match &bare(expression).kind {
        ExpressionKind::Integer(..) | ExpressionKind::Floating(..) | ExpressionKind::Bool(_) => true,
        ExpressionKind::Unary(_, operand) => is_literal(operand),
        ExpressionKind::Call(name, arguments) => Type::named(name).is_some() && arguments.iter().all(is_literal),
        _ => false,
    }
}

/// How many floats a vector has; 1 for a float.
fn floats(kind: Option<&Type>) -> Option<u8> {
    match kind {
        Some(Type::Vector(Scalar::Float, count)) => Some(*count),
        _ => None,
    }
}
