//! The slips of a program that is no list of definitions: each as a program of its own.

mod chosen;

pub use chosen::{program_slips, program_without_parts, slips_marked, slips_of_variables, slips_written};

use super::tree::{self, MetAs, TreeWalk, TypedNames, walk};
use super::types::{DeclaredTypes, KnownTypes, guess, typed};
use super::{Change, FREE, NameScope, Operator, changes, written};
use crate::interpreter::syntax::{Expression, ExpressionKind, Item, Name, Statement, StatementKind};
use crate::interpreter::{Program, Refusal, Stage, compile, parse, text};
use std::collections::HashSet;

/// A program with a slip in it.
pub struct ProgramSlip {
    /// Of which kind it is.
    pub operator: Operator,
    /// The variable that is given a value there, or the function that returns one.
    pub name: Option<String>,
    /// Whether it is a bound of 0 that is concerned.
    pub is_bound_by_zero: bool,
    /// What is written there.
    pub text: String,
    /// The part of the source that it concerns.
    pub part: ChangedPart,
    /// The program.
    pub program: Program,
}

/// A part of a source, and what a slip makes of it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ChangedPart {
    /// The first and the last line of the source that it stands on, from 1.
    pub lines: (u32, u32),
    /// What stands there.
    pub own: String,
    /// What would stand there; nothing of what is left out altogether.
    pub instead: Option<String>,
}

/// What tells a slip from others, also in a program that is another one elsewhere.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SlipMark {
    /// Of which kind it is.
    pub operator: Operator,
    /// The variable that is given a value there, or the function that returns one.
    pub name: Option<String>,
    /// What stands there, and what would stand there.
    pub texts: (String, Option<String>),
}

impl ProgramSlip {
    /// What tells it from others.
    pub fn mark(&self) -> SlipMark {
        let Self { operator, name, part, .. } = self;
        SlipMark { operator: *operator, name: name.clone(), texts: (part.own.clone(), part.instead.clone()) }
    }
}

/// Most slips of a program.
const MOST: usize = 1_200;

/// Where a slip is, and what stands there then.
enum PlacedSlip {
    /// The expression with this number, in the order of a walk.
    Expression(usize, Option<Name>, Change, ChangedPart),
    /// What the loop with this number goes on by.
    Bound(usize, Change, ChangedPart),
    /// The statement with this number is left out.
    Statement(usize, Option<Name>, ChangedPart),
    /// In the `switch` that is the statement with this number, the one with that number in it, a `break`, is left out.
    FallsThrough(usize, usize, ChangedPart),
    /// The condition of the branch that is the statement with this number always holds, or never.
    Branch(usize, bool, ChangedPart),
}

impl PlacedSlip {
    fn operator(&self) -> Operator {
        match self {
            Self::Expression(_, _, change, _) | Self::Bound(_, change, _) => change.operator,
            Self::Statement(..) | Self::Branch(..) => Operator::StatementLeftOut,
            Self::FallsThrough(..) => Operator::FallsThrough,
        }
    }

    /// The name that is given the value, what is changed, and the part of the source.
    fn parts(&self) -> (Option<&Name>, Option<&Change>, &ChangedPart) {
        match self {
            Self::Expression(_, name, change, part) => (name.as_ref(), Some(change), part),
            Self::Bound(_, change, part) => (None, Some(change), part),
            Self::Statement(_, name, part) => (name.as_ref(), None, part),
            Self::FallsThrough(_, _, part) | Self::Branch(_, _, part) => (None, None, part),
        }
    }

    fn mark(&self) -> SlipMark {
        let (name, _, part) = self.parts();
        let texts = (part.own.clone(), part.instead.clone());
        SlipMark { operator: self.operator(), name: name.map(|name| name.to_string()), texts }
    }
}

/// Which slips are looked for.
struct Sought<'a> {
    /// In which functions.
    is_part: &'a dyn Fn(&str) -> bool,
    /// Only those of one kind, if any.
    operator: Option<Operator>,
    /// What a number is that a slip leaves open, where such slips are looked for.
    free: Option<f64>,
}

impl Sought<'_> {
    fn has(&self, operator: Operator) -> bool {
        self.operator.is_none_or(|only| only == operator)
    }
}

/// The slips that `choose` leaves of those that are found, each as a program.
fn slips_of(
    source: &str,
    stage: Stage,
    sought: &Sought,
    choose: impl FnOnce(&mut Vec<PlacedSlip>),
) -> Result<Vec<ProgramSlip>, Refusal> {
    let preprocessed = text::preprocess(source)?;
    let mut items = parse::parse(&preprocessed.tokens)?;
    if let Some(number) = sought.free {
        let declared = text::preprocess(&format!("const float {FREE} = {number:?};"))?;
        items.splice(..0, parse::parse(&declared.tokens)?);
    }
    let is_part = sought.is_part;
    let mut slips = found(&items, sought);
    choose(&mut slips);
    slips.sort_by_key(PlacedSlip::operator);
    slips.truncate(MOST);
    let compiled = |slip: &PlacedSlip| {
        let code = compile::compile(&with(&items, slip, is_part), preprocessed.version, stage).ok()?;
        let program = Program::of(code);
        let (name, change, part) = slip.parts();
        Some(ProgramSlip {
            operator: slip.operator(),
            name: name.map(|name| name.to_string()),
            is_bound_by_zero: change.is_some_and(|change| change.is_bound_by_zero),
            text: change.map(|change| written(&change.expression)).unwrap_or_default(),
            part: part.clone(),
            program,
        })
    };
    Ok(slips.iter().filter_map(compiled).collect())
}

fn found(items: &[Item], sought: &Sought) -> Vec<PlacedSlip> {
    let is_part = sought.is_part;
    let mut items = items.to_vec();
    let mut slips = Vec::new();
    let mut of_statements = Vec::new();
    let (mut expression, mut statement) = (0, 0);
    let mut bounds = Vec::new();
    let mut bound = 0;
    walk(
        &mut items,
        &mut TreeWalk {
            is_part,
            declares: false,
            statement: &mut |own, _| {
                if let Some(name) = left_out(own) {
                    of_statements.push(PlacedSlip::Statement(statement, name, part_of(own)));
                }
                if let StatementKind::Switch(_, all) = &own.kind {
                    // The last one ends nothing that would go on.
                    let before_last = all.iter().take(all.len().saturating_sub(1)).enumerate();
                    let breaks = before_last.filter(|(_, one)| matches!(one.kind, StatementKind::Break));
                    of_statements.extend(breaks.map(|(at, one)| PlacedSlip::FallsThrough(statement, at, part_of(one))));
                }
                if let StatementKind::If(condition, _, no) = &own.kind {
                    let part = |holds: bool| ChangedPart {
                        lines: (condition.line, condition.line),
                        own: written(condition),
                        instead: Some(holds.to_string()),
                    };
                    // Without another branch the statement may be left out, see above.
                    let ways = if no.is_some() { &[true, false][..] } else { &[true] };
                    of_statements.extend(ways.iter().map(|holds| PlacedSlip::Branch(statement, *holds, part(*holds))));
                }
                statement += 1;
            },
            expression: &mut |own, met, names| {
                let mut changes = changes_of(own, names, sought.free.is_some());
                changes.retain(|change| sought.has(change.operator));
                let changes = changes.into_iter();
                let part = |change: &Change| {
                    let [before, after] =
                        [&*own, &change.expression].map(|root| tree::ExpressionPlace::of(root, &change.path).own);
                    let lines = (before.line, before.line);
                    ChangedPart { lines, own: written(before), instead: Some(written(after)) }
                };
                let MetAs::Value(name) = met else {
                    // Any other slip may be a loop without an end.
                    let changes = changes.filter(|change| change.operator == Operator::OtherNumber);
                    bounds.extend(changes.map(|change| {
                        let part = part(&change);
                        PlacedSlip::Bound(bound, change, part)
                    }));
                    bound += 1;
                    return;
                };
                slips.extend(changes.map(|change| {
                    let part = part(&change);
                    PlacedSlip::Expression(expression, name.cloned(), change, part)
                }));
                expression += 1;
            },
        },
    );
    slips.extend(of_statements.into_iter().filter(|slip| sought.has(slip.operator())));
    slips.extend(bounds);
    slips
}

fn changes_of(own: &Expression, names: &TypedNames, free: bool) -> Vec<Change> {
    let typed = typed(names, own.line);
    // What its functions and members are is changed where they are given it.
    let known = KnownTypes { names: &typed, declared: &DeclaredTypes::default() };
    let mut kind = |expression: &Expression| guess(expression, known);
    changes(own, &mut NameScope { names: &typed, constants: &HashSet::new(), kind: &mut kind, free })
}

/// A statement, as it is told.
fn part_of(statement: &Statement) -> ChangedPart {
    let own = match &statement.kind {
        StatementKind::Expression(expression) => format!("{};", written(expression)),
        StatementKind::If(condition, ..) => format!("if ({}) …", written(condition)),
        StatementKind::Break => "break;".to_owned(),
        _ => "discard;".to_owned(),
    };
    ChangedPart { lines: (statement.line, tree::last_line(statement)), own, instead: None }
}

/// Whether a statement may be left out, and the variable that then has no other value.
pub(super) fn left_out(statement: &Statement) -> Option<Option<Name>> {
    match &statement.kind {
        StatementKind::Expression(expression) => match &expression.kind {
            ExpressionKind::Assign(_, to, _) => match &to.kind {
                ExpressionKind::Name(name) => Some(Some(Name::clone(name))),
                _ => Some(None),
            },
            _ => Some(None),
        },
        StatementKind::If(_, _, None) | StatementKind::Discard => Some(None),
        _ => None,
    }
}

/// The program with a slip in it.
fn with(items: &[Item], slip: &PlacedSlip, is_part: &dyn Fn(&str) -> bool) -> Vec<Item> {
    let mut items = items.to_vec();
    let (mut expression, mut statement, mut bound) = (0, 0, 0);
    walk(
        &mut items,
        &mut TreeWalk {
            is_part,
            declares: false,
            statement: &mut |own, _| {
                match slip {
                    PlacedSlip::Statement(at, ..) if *at == statement => own.kind = StatementKind::Empty,
                    PlacedSlip::FallsThrough(at, inner, _) if *at == statement => {
                        if let StatementKind::Switch(_, all) = &mut own.kind {
                            all[*inner].kind = StatementKind::Empty;
                        }
                    }
                    PlacedSlip::Branch(at, holds, _) if *at == statement => {
                        if let StatementKind::If(condition, ..) = &mut own.kind {
                            condition.kind = ExpressionKind::Bool(*holds);
                        }
                    }
                    _ => {}
                }
                statement += 1;
            },
            expression: &mut |own, met, _| {
                let number = match met {
                    MetAs::Value(_) => &mut expression,
                    MetAs::Bound => &mut bound,
                };
                match (slip, met) {
                    (PlacedSlip::Expression(at, _, change, _), MetAs::Value(_))
                    | (PlacedSlip::Bound(at, change, _), MetAs::Bound)
                        if at == number =>
                    {
                        *own = change.expression.clone();
                    }
                    _ => {}
                }
                *number += 1;
            },
        },
    );
    items
}
