//! Ways to make a wrong program right: one change of its text at a time.
//!
//! These are the slips of the text itself, for most slips undo another one, and what the right answer is made of: its values,
//! its functions with what else they are given, its numbers.

mod copies;
mod ingredients;
mod size;

use super::inverse::{mistake_of, of_statement};
use super::programs::{guess, left_out, of_name};
use super::tree::{ExpressionPlace, Path, TreeWalk, TypedNames, operands, paths, walk, with};
use super::{Change, NameScope, Operator, changes, written};
use crate::interpreter::syntax::{Expression, ExpressionKind, Item, StatementKind};
use crate::interpreter::types::Type;
use crate::interpreter::{Program, Refusal, Stage, compile, parse, text};
use copies::{copied, replace_copies};
pub use ingredients::Ingredients;
use size::{size, tokens};
use std::collections::{HashMap, HashSet};

/// A program that is to be repaired.
#[derive(Clone, Debug)]
pub struct Repairable {
    items: Vec<Item>,
    /// The bytes of the text at which something is written that a macro writes several times, and whether all copies are the same: of an
    /// argument they are, of a macro's body with arguments in it they are not.
    copied: HashMap<u32, bool>,
    version: u32,
    stage: Stage,
}

/// One change of it.
#[derive(Clone, Debug)]
pub struct ProgramRepair {
    /// What the student did, where this makes it right.
    pub mistake: Operator,
    /// The line of what is changed, from 1.
    pub line: u32,
    /// Whether a bound of 0 is missing or there.
    pub is_bound_by_zero: bool,
    /// The name in the right answer, or in the text, of the value that is missing, where it is one.
    pub added: Option<String>,
    /// Whether it undoes a slip of what is written, and takes nothing from the right answer.
    pub is_slip: bool,
    /// What is written there, and what belongs there; empty for a statement that goes.
    pub texts: [String; 2],
    /// The byte of the text at which that is written, as [`Expression::at`].
    at: u32,
    place: Where,
}

#[derive(Clone, Debug)]
enum Where {
    /// The expression with this number, in the order of a walk, the place in it, and what it is instead.
    Expression(usize, Path, Expression),
    /// The statement with this number goes.
    Statement(usize),
}

impl ProgramRepair {
    /// The line of what was changed, in a program that was made to be traced.
    pub const MARK: u32 = u32::MAX;
}

/// Most changes of the expressions of one line.
const MOST_OF_LINE: usize = 500;

/// No slip takes away or adds more words and signs.
const LARGEST: usize = 24;

impl Repairable {
    /// Reads it. Lines are those on which something is written, also within a macro.
    ///
    /// # Errors
    /// It is no program.
    pub fn read(source: &str, stage: Stage) -> Result<Self, Refusal> {
        let preprocessed = text::preprocess(source)?;
        let tokens: Vec<_> = preprocessed.tokens.into_iter().map(text::Token::on_its_line).collect();
        let mut items = parse::parse(&tokens)?;
        let copied = copied(&mut items);
        Ok(Self { items, copied, version: preprocessed.version, stage })
    }

    /// The changes of what stands on these lines: those of the first line first, the smaller ones before others.
    pub fn repairs(&self, lines: &[u32], right: &Ingredients) -> Vec<ProgramRepair> {
        let mut found: Vec<(usize, (usize, bool), ProgramRepair)> = Vec::new();
        let (mut expression, mut statement) = (0, 0);
        let rank = |own: &[u32]| lines.iter().position(|line| own.contains(line));
        let mut statements = Vec::new();
        walk(
            &mut self.items.clone(),
            &mut TreeWalk {
                is_part: &|_| true,
                bound: &mut |_, _| {},
                statement: &mut |own, _| {
                    let name = left_out(own).filter(|_| !matches!(own.kind, StatementKind::Empty));
                    if let Some(rank) = name.and_then(|_| rank(&[own.line])) {
                        let written = match &own.kind {
                            StatementKind::Expression(expression) => written(expression),
                            _ => String::new(),
                        };
                        statements.push((
                            rank,
                            (tokens(&written).len(), false),
                            ProgramRepair {
                                mistake: of_statement(own),
                                line: own.line,
                                is_bound_by_zero: false,
                                added: None,
                                is_slip: true,
                                texts: [written, String::new()],
                                at: 0,
                                place: Where::Statement(statement),
                            },
                        ));
                    }
                    statement += 1;
                },
                expression: &mut |own, _, names| {
                    let number = expression;
                    expression += 1;
                    let own_lines: Vec<u32> =
                        paths(own).iter().map(|path| ExpressionPlace::of(own, path).own.line).collect();
                    if let Some(rank) = rank(&own_lines) {
                        let all = of_expression(own, number, names, right);
                        let sized = all.into_iter().map(|repair| (rank, size(&repair.texts), repair));
                        found.extend(sized.filter(|(_, (size, _), _)| *size <= LARGEST));
                    }
                },
            },
        );
        found.extend(statements);
        found.sort_by_key(|(rank, size, repair)| (*rank, *size, repair.mistake));
        // Copies are changed together, or not at all.
        let mut known = HashSet::new();
        found.retain(|(.., repair)| match self.copied.get(&repair.at) {
            Some(is_same) => *is_same && known.insert((repair.at, repair.texts.clone())),
            None => true,
        });
        let mut counts = vec![0; lines.len()];
        found.retain(|(rank, ..)| {
            counts[*rank] += 1;
            counts[*rank] <= MOST_OF_LINE
        });
        found.into_iter().map(|(.., repair)| repair).collect()
    }

    /// The program with a change in it; none where it is no program.
    pub fn program(&self, repair: &ProgramRepair) -> Option<Program> {
        let items = self.items_with(repair, false);
        Some(Program::of(compile::compile(&items, self.version, self.stage).ok()?))
    }

    /// The same so that it can be traced, with what was changed on the line [`ProgramRepair::MARK`].
    pub fn traced(&self, repair: &ProgramRepair) -> Option<Program> {
        let items = self.items_with(repair, true);
        Some(Program::of(compile::compile_traced(&items, self.version, self.stage).ok()?))
    }

    /// What is to be repaired further.
    pub fn with(&self, repair: &ProgramRepair) -> Self {
        Self { items: self.items_with(repair, false), copied: self.copied.clone(), ..*self }
    }

    fn items_with(&self, repair: &ProgramRepair, is_marked: bool) -> Vec<Item> {
        let mut items = self.items.clone();
        let (mut expression, mut statement) = (0, 0);
        walk(
            &mut items,
            &mut TreeWalk {
                is_part: &|_| true,
                bound: &mut |_, _| {},
                statement: &mut |own, _| {
                    if matches!(repair.place, Where::Statement(at) if at == statement) {
                        own.kind = StatementKind::Empty;
                    }
                    statement += 1;
                },
                expression: &mut |own, _, _| {
                    if let Where::Expression(at, path, changed) = &repair.place {
                        let changed = if is_marked { marked(changed) } else { changed.clone() };
                        if self.copied.contains_key(&repair.at) {
                            replace_copies(own, repair, &changed);
                        } else if *at == expression {
                            *own = with(own, path, changed);
                        }
                    }
                    expression += 1;
                },
            },
        );
        items
    }
}

/// The changes of an expression.
fn of_expression(own: &Expression, number: usize, names: &TypedNames, right: &Ingredients) -> Vec<ProgramRepair> {
    let known = names.iter().rev().filter_map(|(name, kind)| Some((of_name(name, own.line), Type::named(kind)?)));
    let typed: Vec<(Expression, Type)> = known.collect();
    let theirs = &typed;
    let mut kind = |expression: &Expression| guess(expression, theirs);
    let scope = &mut NameScope { names: &typed, constants: &HashSet::new(), kind: &mut kind, free: false };
    let slips = changes(own, scope).into_iter().filter(|change| change.operator != Operator::WholeNumbers);
    let mut found: Vec<ProgramRepair> = slips.map(|change| of_slip(own, number, change)).collect();
    for path in paths(own) {
        let place = ExpressionPlace::of(own, &path);
        let Some(kind) = guess(place.own, theirs) else { continue };
        let is_whole = place.parent.is_none_or(is_statement);
        for added in right.changes(&place, &kind, is_whole, theirs) {
            found.push(ProgramRepair {
                mistake: added.mistake,
                line: place.own.line,
                is_bound_by_zero: added.is_bound_by_zero,
                added: added.name,
                is_slip: false,
                texts: [written(place.own), written(&added.expression)],
                at: place.own.at,
                place: Where::Expression(number, path.clone(), added.expression),
            });
        }
    }
    let mut known = HashSet::new();
    found.sort_by_key(|repair| repair.mistake);
    found.retain(|repair| match &repair.place {
        Where::Expression(_, path, changed) => known.insert(written(&with(own, path, changed.clone()))),
        Where::Statement(_) => true,
    });
    found
}

/// Whether an expression is a whole statement, so that its operand is a whole value.
fn is_statement(parent: &Expression) -> bool {
    matches!(parent.kind, ExpressionKind::Assign(..))
}

fn of_slip(own: &Expression, number: usize, change: Change) -> ProgramRepair {
    let mistake = mistake_of(own, &change);
    let at = |root: &Expression| {
        let mut place = root;
        for step in &change.path {
            match operands(place).get(*step) {
                Some(next) => place = next,
                None => break,
            }
        }
        place.clone()
    };
    let (before, after) = (at(own), at(&change.expression));
    let is_bound_by_zero = change.is_bound_by_zero || super::calls::is_bound_by_zero(&after);
    ProgramRepair {
        mistake,
        line: line_of(&before, &after),
        is_bound_by_zero,
        added: None,
        is_slip: true,
        texts: [written(&before), written(&after)],
        at: before.at,
        place: Where::Expression(number, change.path, after),
    }
}

/// The expression on the line [`ProgramRepair::MARK`], the last operator of a chain among it.
fn marked(changed: &Expression) -> Expression {
    let mut marked = Expression { line: ProgramRepair::MARK, ..changed.clone() };
    if let ExpressionKind::Chain(_, others) = &mut marked.kind
        && let Some((_, line, _)) = others.last_mut()
    {
        *line = ProgramRepair::MARK;
    }
    marked
}

/// The line of what a change is about: in a chain of operators, that of the first one at which it is another chain.
fn line_of(before: &Expression, after: &Expression) -> u32 {
    let (ExpressionKind::Chain(first, own), ExpressionKind::Chain(other, theirs)) = (&before.kind, &after.kind) else {
        return before.line;
    };
    let pairs = own.iter().zip(theirs);
    let same = pairs.take_while(|((a, _, own), (b, _, other))| a == b && written(own) == written(other)).count();
    match own.get(same) {
        Some((_, line, _)) if written(first) == written(other) => *line,
        _ => before.line,
    }
}
