//! Ways to make a wrong program right: one change of its text at a time.
//!
//! These are the slips of the text itself, for most slips undo another one, and what the right answer is made of: its values,
//! its functions with what else they are given, its numbers.

mod bodies;
mod copies;
mod declared;
mod expressions;
mod ingredients;
mod inlined;
mod order;
mod size;
mod spaces;
mod statements;
mod undone;

use super::Operator;
use super::tree::{ExpressionPlace, MetAs, Path, TreeWalk, paths, walk, with};
use crate::interpreter::syntax::{Expression, ExpressionKind, Function, Item, Statement, StatementKind};
use crate::interpreter::{Program, Refusal, Stage, compile, parse, text};
use copies::{copied, together};
use declared::Declared;
use expressions::of_expression;
pub use ingredients::Ingredients;
use order::StatementOrder;
use size::{size, tokens};
use statements::{ALWAYS, always, without, without_else};
use std::cell::Cell;
use std::collections::HashSet;

/// A program that is to be repaired.
#[derive(Clone, Debug)]
pub struct Repairable {
    items: Vec<Item>,
    /// The bytes of the text at which something is written that a macro writes several times.
    copied: HashSet<u32>,
    declared: Declared,
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
    /// Whether it makes something of a value where it is only passed on.
    is_of_use: bool,
    /// Whether what is wrong may as well be on another line.
    is_elsewhere: bool,
    /// What is written there, and what belongs there; empty for a statement that goes.
    pub texts: [String; 2],
    place: Where,
}

#[derive(Clone, Debug)]
enum Where {
    /// The expressions with these numbers, in the order of a walk, the places in them, and what they are instead: one, or all copies of
    /// what a macro writes.
    Expressions(Vec<(usize, Path, Expression)>),
    /// The statement with this number goes.
    Statement(usize),
    /// The statement with this number and the next one are exchanged.
    Exchanged(usize, Box<[Statement; 2]>),
    /// The item with this number is another function.
    Function(usize, Box<Function>),
}

impl ProgramRepair {
    /// The line of what was changed, in a program that was made to be traced.
    pub const MARK: u32 = u32::MAX;

    /// A slip that is undone.
    fn slip(mistake: Operator, line: u32, texts: [String; 2], place: Where) -> Self {
        Self {
            mistake,
            line,
            is_bound_by_zero: false,
            added: None,
            is_slip: true,
            is_of_use: false,
            is_elsewhere: false,
            texts,
            place,
        }
    }

    /// The places that are changed; none of a statement.
    fn places(&self) -> &[(usize, Path, Expression)] {
        match &self.place {
            Where::Expressions(places) => places,
            Where::Statement(_) | Where::Exchanged(..) | Where::Function(..) => &[],
        }
    }

    /// How many words and signs it takes away and puts there, and whether it puts any there.
    fn size(&self) -> (usize, bool) {
        match self.place {
            Where::Expressions(_) | Where::Function(..) => size(&self.texts),
            Where::Exchanged(..) => (2, false),
            // It is one thing.
            Where::Statement(_) => (1, false),
        }
    }

    /// Whether it is a slip wherever it stands: something is exchanged, or has another sign, or is compared the other way, or a branch
    /// is always taken.
    fn is_smallest(&self, (size, _): (usize, bool)) -> bool {
        let is_one_of =
            |signs: &str| self.texts.iter().all(|text| tokens(text).iter().any(|token| signs.contains(token)));
        let most = match self.mistake {
            Operator::OtherOperator if is_one_of("+-") || is_one_of("<>") || is_one_of("*/") => 2,
            Operator::Gated => return self.texts[1] == ALWAYS,
            // Of a matrix and a vector it is another matrix.
            Operator::Exchanged if self.texts[0].contains(" * ") => return false,
            _ => 1,
        };
        self.is_slip && size <= most
    }

    /// Whether two statements are exchanged.
    pub fn is_of_order(&self) -> bool {
        matches!(self.place, Where::Exchanged(..))
    }

    /// Whether the line of what is wrong is known by it.
    pub fn is_of_its_line(&self) -> bool {
        self.is_slip || !self.is_of_use && !self.is_elsewhere
    }
}

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
        let (copied, declared) = (copied(&mut items), Declared::of(&items, stage));
        Ok(Self { items, copied, declared, version: preprocessed.version, stage })
    }

    /// The changes of what stands on these lines. What is only exchanged, or has another sign, comes first; then what stands on the first
    /// `near` lines; then the slips of what is written on the others; then what takes something from the right answer; then what is made
    /// of a value only where it is used, on other lines than the first ones. Of each the smaller ones come first.
    pub fn repairs(&self, lines: &[u32], near: usize, right: &Ingredients) -> Vec<ProgramRepair> {
        let (mut found, mut statements) = (Vec::new(), Vec::new());
        let (mut expression, mut statement) = (0, 0);
        let mut order = StatementOrder::default();
        let is_sought =
            |own: &Expression| paths(own).iter().any(|path| lines.contains(&ExpressionPlace::of(own, path).own.line));
        // The condition of the last branch that nothing else is done without, and the same for the branch whose condition comes next.
        let (mut last, before) = (None, Cell::new(None));
        let decides = Cell::new(false);
        walk(
            &mut self.items.clone(),
            &mut TreeWalk {
                is_part: &|_| true,
                declares: true,
                statement: &mut |own, _| {
                    before.set(None);
                    decides.set(matches!(own.kind, StatementKind::If(..)));
                    if let StatementKind::If(condition, _, no) = &own.kind {
                        before.set(last.take());
                        last = no.is_none().then(|| condition.clone());
                    }
                    statements.extend(without(own, statement));
                    order.meet(own, statement);
                    statement += 1;
                },
                expression: &mut |own, met, names| {
                    let (before, decides) = (before.take(), decides.take());
                    if is_sought(own) {
                        let all = of_expression(own, expression, names, right, &self.declared).into_iter();
                        // Other bounds may have no end.
                        found.extend(all.filter(|(_, repair)| repair.is_slip || !matches!(met, MetAs::Bound)));
                        found.extend(before.map(|before| without_else(&before, own, expression)));
                        found.extend(decides.then(|| always(own, expression)));
                    }
                    expression += 1;
                },
            },
        );
        let rank = |line: u32| lines.iter().position(|own| *own == line);
        let mut all = together(found, &self.copied);
        all.extend(statements);
        all.extend(order.found);
        all.extend(bodies::of_functions(&self.items));
        let ranked = all.into_iter().filter_map(|repair| {
            let rank = rank(repair.line)?;
            let size = repair.size();
            // A function around a value is one slip, whatever else it is given.
            let is_call = !repair.is_slip && repair.mistake <= Operator::CallLeftOut;
            let key = match &repair {
                // The order makes up for much that is wrong in one of the two.
                ProgramRepair { place: Where::Exchanged(..), .. } => (5, size, rank),
                // Where it was found to be wrong, what it is made for counts.
                ProgramRepair { is_of_use: true, .. } => (if rank < near { 3 } else { 4 }, size, rank),
                _ if repair.is_smallest(size) => (0, (0, false), rank),
                _ if rank < near => (1, size, rank),
                ProgramRepair { is_slip: true, .. } => (2, size, rank),
                _ => (3, if is_call { (0, true) } else { size }, rank),
            };
            // What is taken from the right answer as a whole says less than a slip of what is written, and another value may be right by
            // chance where other components are.
            let is_other = repair.mistake == Operator::OtherValue;
            let is_taken = !repair.is_slip && is_other;
            (size.0 <= LARGEST).then_some(((key, is_taken, is_other, repair.mistake), repair))
        });
        let mut ranked: Vec<_> = ranked.collect();
        ranked.sort_by_key(|(key, _)| *key);
        ranked.into_iter().map(|(_, repair)| repair).collect()
    }

    /// The program with a change in it; `None` where it is no program.
    pub fn program(&self, repair: &ProgramRepair) -> Option<Program> {
        let items = self.items_with(repair, false);
        Some(Program::of(compile::compile(&items, self.version, self.stage).ok()?))
    }

    /// The program without a change, so that it can be traced.
    pub fn as_it_is(&self) -> Option<Program> {
        Some(Program::of(compile::compile_traced(&self.items, self.version, self.stage).ok()?))
    }

    /// The program with a change so that it can be traced, with what was changed on the line [`ProgramRepair::MARK`].
    pub fn traced(&self, repair: &ProgramRepair) -> Option<Program> {
        let items = self.items_with(repair, true);
        Some(Program::of(compile::compile_traced(&items, self.version, self.stage).ok()?))
    }

    /// What is to be repaired further.
    pub fn with(&self, repair: &ProgramRepair) -> Self {
        Self {
            items: self.items_with(repair, false),
            copied: self.copied.clone(),
            declared: self.declared.clone(),
            ..*self
        }
    }

    fn items_with(&self, repair: &ProgramRepair, is_marked: bool) -> Vec<Item> {
        let mut items = self.items.clone();
        if let Where::Function(at, function) = &repair.place {
            let function = if is_marked { bodies::with_marks(function, repair.line) } else { (**function).clone() };
            items[*at] = Item::Function(function);
            return items;
        }
        let (mut expression, mut statement) = (0, 0);
        walk(
            &mut items,
            &mut TreeWalk {
                is_part: &|_| true,
                declares: true,
                statement: &mut |own, _| {
                    if matches!(repair.place, Where::Statement(at) if at == statement) {
                        own.kind = StatementKind::Empty;
                    }
                    if let Some(other) = order::exchanged(&repair.place, statement, is_marked) {
                        *own = other;
                    }
                    statement += 1;
                },
                expression: &mut |own, _, _| {
                    for (_, path, changed) in repair.places().iter().filter(|(at, ..)| *at == expression) {
                        *own = with(own, path, if is_marked { marked(changed) } else { changed.clone() });
                    }
                    expression += 1;
                },
            },
        );
        items
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
