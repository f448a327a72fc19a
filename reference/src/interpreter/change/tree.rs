//! Places in a syntax tree, and the tree with another expression at one of them.

use crate::interpreter::DISCARD;
use crate::interpreter::syntax::{
    BaseType, Declaration, DeclaredVariable, Expression, ExpressionKind, Function, InterfaceBlock, Item, LoopCondition,
    Name, Statement, StatementKind, StorageQualifier,
};

/// A place in an expression: which operand of which operand.
pub type Path = Vec<usize>;

/// An expression within another.
pub(super) struct ExpressionPlace<'a> {
    pub own: &'a Expression,
    /// What it is an operand of.
    pub parent: Option<&'a Expression>,
}

impl<'a> ExpressionPlace<'a> {
    pub fn of(root: &'a Expression, path: &[usize]) -> Self {
        let mut place = Self { own: root, parent: None };
        for at in path {
            place = Self { own: operands(place.own)[*at], parent: Some(place.own) };
        }
        place
    }

    pub fn is_root(&self) -> bool {
        self.parent.is_none()
    }

    /// Whether it is all that a variable is given, or a function gives back.
    pub fn is_whole(&self) -> bool {
        self.parent.is_none_or(|parent| matches!(parent.kind, ExpressionKind::Assign(..)))
    }
}

/// All places, the outermost first.
pub(super) fn paths(root: &Expression) -> Vec<Path> {
    let mut paths = vec![Vec::new()];
    let mut next = 0;
    while let Some(path) = paths.get(next).cloned() {
        let count = operands(ExpressionPlace::of(root, &path).own).len();
        paths.extend((0..count).map(|at| [path.as_slice(), &[at]].concat()));
        next += 1;
    }
    paths
}

/// What an expression is made of; what is written to is no part of it.
pub(super) fn operands(expression: &Expression) -> Vec<&Expression> {
    match &expression.kind {
        ExpressionKind::Unary(_, of) | ExpressionKind::Member(of, _) => vec![of],
        ExpressionKind::Chain(first, others) => {
            std::iter::once(&**first).chain(others.iter().map(|(_, _, other)| other)).collect()
        }
        ExpressionKind::Assign(_, _, from) => vec![from],
        ExpressionKind::Conditional(condition, yes, no) => vec![condition, yes, no],
        ExpressionKind::Comma(all)
        | ExpressionKind::Call(_, all)
        | ExpressionKind::ArrayConstructor(_, all)
        | ExpressionKind::List(all) => all.iter().collect(),
        ExpressionKind::Index(of, index) => vec![of, index],
        _ => Vec::new(),
    }
}

fn operand_mut(expression: &mut Expression, at: usize) -> Option<&mut Expression> {
    match &mut expression.kind {
        ExpressionKind::Unary(_, of) | ExpressionKind::Member(of, _) => Some(of),
        ExpressionKind::Chain(first, _) if at == 0 => Some(first),
        ExpressionKind::Chain(_, others) => others.get_mut(at - 1).map(|(_, _, other)| other),
        ExpressionKind::Assign(_, _, from) => Some(from),
        ExpressionKind::Conditional(condition, yes, no) => Some([condition, yes, no].into_iter().nth(at)?),
        ExpressionKind::Comma(all)
        | ExpressionKind::Call(_, all)
        | ExpressionKind::ArrayConstructor(_, all)
        | ExpressionKind::List(all) => all.get_mut(at),
        ExpressionKind::Index(of, index) => Some(if at == 0 { of } else { index }),
        _ => None,
    }
}

/// `root` with another expression at a place.
pub(super) fn with(root: &Expression, path: &[usize], other: Expression) -> Expression {
    let mut changed = root.clone();
    let mut place = Some(&mut changed);
    for at in path {
        place = place.and_then(|place| operand_mut(place, *at));
    }
    if let Some(place) = place {
        *place = other;
    }
    changed
}

/// Names, and the names of their types.
pub type TypedNames = [(Name, Name)];

/// What a walk through a program meets.
pub struct TreeWalk<'w> {
    /// Whether the function of a name is gone through.
    pub is_part: &'w dyn Fn(&str) -> bool,
    /// Whether what is declared outside of functions with a value is gone through.
    pub declares: bool,
    /// What is called for every statement: may replace it. The names that are known there, with the names of their types.
    pub statement: &'w mut dyn FnMut(&mut Statement, &TypedNames),
    /// What is called for every expression that is not part of another.
    pub expression: &'w mut dyn FnMut(&mut Expression, MetAs<'_>, &TypedNames),
}

/// What an expression is where a walk meets it.
#[derive(Clone, Copy, Debug)]
pub enum MetAs<'n> {
    /// A value, and the variable that is given it, or the function that returns it; [`DISCARD`] of what decides whether a fragment is
    /// thrown away.
    Value(Option<&'n Name>),
    /// What a loop goes on by.
    Bound,
}

/// Goes through the functions of a program, in the order of the text.
pub fn walk(items: &mut [Item], walk: &mut TreeWalk<'_>) {
    let mut names: Vec<(Name, Name)> = Vec::new();
    for item in items {
        match item {
            Item::Declaration(declaration) => {
                let known = names.len();
                of_declaration(declaration, walk, walk.declares, &mut names);
                if declaration.qualifiers.storage == StorageQualifier::Output {
                    names.truncate(known);
                }
            }
            Item::Function(function) if (walk.is_part)(&function.name) => {
                let known = names.len();
                of_function(function, walk, &mut names);
                names.truncate(known);
            }
            // Members of a block without a name of its own are known by theirs.
            Item::Block(InterfaceBlock { members, instance: None, qualifiers, .. })
                if qualifiers.storage != StorageQualifier::Output =>
            {
                members.iter().for_each(|member| declare(member, &mut names));
            }
            Item::Function(_) | Item::Block(_) | Item::Requalification => {}
        }
    }
}

/// The last line that something of a statement stands on.
pub(super) fn last_line(statement: &Statement) -> u32 {
    let (mut of_expressions, mut of_statements) = (statement.line, statement.line);
    let mut all = TreeWalk {
        is_part: &|_| true,
        declares: false,
        statement: &mut |own, _| of_statements = of_statements.max(own.line),
        expression: &mut |own, met, _| {
            if matches!(met, MetAs::Bound) {
                return;
            }
            let lines = paths(own).iter().map(|path| ExpressionPlace::of(own, path).own.line).max();
            of_expressions = of_expressions.max(lines.unwrap_or(0));
        },
    };
    of_statement(&mut statement.clone(), None, &mut all, &mut Vec::new());
    of_expressions.max(of_statements)
}

fn of_function(function: &mut Function, walk: &mut TreeWalk<'_>, names: &mut Vec<(Name, Name)>) {
    for parameter in &function.parameters {
        if let BaseType::Named(kind) = &parameter.kind.base {
            names.push((Name::clone(&parameter.name), Name::clone(kind)));
        }
    }
    let result = Some(&function.name).filter(|name| ***name != *"main");
    let body = function.body.iter_mut().flatten();
    body.for_each(|statement| of_statement(statement, result, walk, names));
}

/// `result`: the function whose statement it is, unless that is `main`.
fn of_statement(
    statement: &mut Statement,
    result: Option<&Name>,
    walk: &mut TreeWalk<'_>,
    names: &mut Vec<(Name, Name)>,
) {
    (walk.statement)(statement, names);
    let known = names.len();
    match &mut statement.kind {
        StatementKind::Expression(expression) => {
            let name = assigned(expression).cloned();
            (walk.expression)(expression, MetAs::Value(name.as_ref()), names);
        }
        StatementKind::Declaration(declaration) => {
            of_declaration(declaration, walk, true, names);
            return;
        }
        StatementKind::Block(all) | StatementKind::Switch(_, all) => {
            all.iter_mut().for_each(|statement| of_statement(statement, result, walk, names));
        }
        StatementKind::If(condition, yes, no) => {
            let thrown = throws_away(yes).then(|| Name::from(DISCARD));
            (walk.expression)(condition, MetAs::Value(thrown.as_ref()), names);
            of_statement(yes, result, walk, names);
            if let Some(no) = no {
                of_statement(no, result, walk, names);
            }
        }
        StatementKind::Loop(first, condition, _, body) => {
            if let Some(first) = first {
                of_statement(first, result, walk, names);
            }
            if let Some(LoopCondition::Expression(condition)) = condition {
                (walk.expression)(condition, MetAs::Bound, names);
            }
            of_statement(body, result, walk, names);
        }
        StatementKind::DoWhile(body, condition) => {
            of_statement(body, result, walk, names);
            (walk.expression)(condition, MetAs::Bound, names);
        }
        StatementKind::Return(Some(value)) => (walk.expression)(value, MetAs::Value(result), names),
        _ => {}
    }
    names.truncate(known);
}

/// Whether a statement does nothing but throw the fragment away.
fn throws_away(statement: &Statement) -> bool {
    match &statement.kind {
        StatementKind::Discard => true,
        StatementKind::Block(all) => matches!(&all[..], [only] if throws_away(only)),
        _ => false,
    }
}

/// Each variable is known to what comes after it. `gives`: whether their values are gone through.
fn of_declaration(declaration: &mut Declaration, walk: &mut TreeWalk<'_>, gives: bool, names: &mut Vec<(Name, Name)>) {
    for variable in &mut declaration.variables {
        if let Some(value) = variable.value.as_mut().filter(|_| gives) {
            (walk.expression)(value, MetAs::Value(Some(&variable.name)), names);
        }
        named(variable, &declaration.kind.base, names);
    }
}

/// What is declared without values is known from now on.
fn declare(declaration: &Declaration, names: &mut Vec<(Name, Name)>) {
    declaration.variables.iter().for_each(|variable| named(variable, &declaration.kind.base, names));
}

fn named(variable: &DeclaredVariable, kind: &BaseType, names: &mut Vec<(Name, Name)>) {
    if let (BaseType::Named(kind), true) = (kind, variable.lengths.is_empty()) {
        names.push((Name::clone(&variable.name), Name::clone(kind)));
    }
}

/// The variable that an assignment gives a value to, or a part of which it gives one.
pub(super) fn assigned(expression: &Expression) -> Option<&Name> {
    let ExpressionKind::Assign(_, to, _) = &expression.kind else { return None };
    let mut to = &**to;
    loop {
        match &to.kind {
            ExpressionKind::Member(of, _) | ExpressionKind::Index(of, _) => to = of,
            ExpressionKind::Name(name) => return Some(name),
            _ => return None,
        }
    }
}
