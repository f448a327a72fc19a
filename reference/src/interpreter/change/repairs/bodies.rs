//! Repairs of what a function is made of: its parameters, and the statements in its lists of them.

use super::super::tree::assigned;
use super::super::{Operator, written};
use super::{ProgramRepair, Where, marked};
use crate::interpreter::syntax::{
    BaseType, Binary, Declaration, Expression, ExpressionKind, Function, Item, Name, Statement, StatementKind,
    StorageQualifier, TypeName,
};
use std::collections::{BTreeSet, HashMap};

/// So many variables are tried to take what is thrown away.
const MOST_TARGETS: usize = 12;

/// Another list of statements, and what it mends.
struct ListRepair {
    mistake: Operator,
    line: u32,
    texts: [String; 2],
    list: Vec<Statement>,
}

/// The repairs of all functions.
pub(super) fn of_functions(items: &[Item]) -> Vec<ProgramRepair> {
    let globals = items.iter().filter_map(|item| if let Item::Declaration(own) = item { Some(own) } else { None });
    let globals: Vec<&Name> = globals.flat_map(|own| &own.variables).map(|variable| &variable.name).collect();
    let functions = items.iter().enumerate().filter_map(|(at, item)| match item {
        Item::Function(own) if own.body.is_some() => Some((at, own)),
        _ => None,
    });
    functions.flat_map(|(at, own)| of_function(own, at, &globals)).collect()
}

/// A function with what was changed on the line [`ProgramRepair::MARK`].
pub(super) fn with_marks(function: &Function, line: u32) -> Function {
    let mut own = function.clone();
    each_list(&mut own, &mut |list| {
        for statement in list.iter_mut().filter(|statement| statement.line == line) {
            match &mut statement.kind {
                StatementKind::Expression(value) | StatementKind::Return(Some(value)) => *value = marked(value),
                _ => {}
            }
        }
    });
    own
}

fn of_function(function: &Function, item: usize, globals: &[&Name]) -> Vec<ProgramRepair> {
    let names = UsedNames::of(function, globals);
    let mut found: Vec<ProgramRepair> = handed_in(function, item, &names).collect();
    let mut lists = Vec::new();
    each_list(&mut function.clone(), &mut |list| lists.push(list.clone()));
    for (number, list) in lists.iter().enumerate() {
        let all = (0..list.len()).flat_map(|at| of_place(list, at, &names));
        found.extend(all.map(|own| {
            let mut other = function.clone();
            let mut count = 0;
            each_list(&mut other, &mut |list| {
                if count == number {
                    list.clone_from(&own.list);
                }
                count += 1;
            });
            ProgramRepair::slip(own.mistake, own.line, own.texts, Where::Function(item, Box::new(other)))
        }));
    }
    found
}

/// Parameters that only come in, though the function gives them values.
fn handed_in(function: &Function, item: usize, names: &UsedNames) -> impl Iterator<Item = ProgramRepair> {
    let is_in = |storage| matches!(storage, StorageQualifier::Plain | StorageQualifier::Input);
    // What a function returns may be all that it is called for.
    let is_void = matches!(&function.result.base, BaseType::Named(name) if **name == *"void");
    let gives_back = is_void || function.parameters.iter().any(|own| !is_in(own.storage));
    let all = function.parameters.iter().enumerate().filter(move |_| gives_back);
    let changed = all.filter(move |(_, own)| is_in(own.storage) && names.assigned.contains(&own.name));
    changed.map(move |(at, own)| {
        let mut other = function.clone();
        other.parameters[at].storage = StorageQualifier::InputOutput;
        let texts = [own.name.to_string(), format!("inout {}", own.name)];
        ProgramRepair::slip(Operator::ByValue, own.kind.line, texts, Where::Function(item, Box::new(other)))
    })
}

/// The repairs at a place of a list of statements.
fn of_place(list: &[Statement], at: usize, names: &UsedNames) -> Vec<ListRepair> {
    let own = &list[at];
    let repair = |mistake, texts, with: &dyn Fn(&mut Vec<Statement>)| {
        let mut list = list.to_vec();
        with(&mut list);
        ListRepair { mistake, line: own.line, texts, list }
    };
    let statement = |kind| Statement { line: own.line, kind };
    match &own.kind {
        // A semicolon behind the condition ends the branch.
        StatementKind::If(condition, yes, None) if matches!(yes.kind, StatementKind::Empty) && at + 1 < list.len() => {
            let text = written(condition);
            let next = |list: &mut Vec<Statement>| {
                let next = Box::new(list.remove(at + 1));
                list[at].kind = StatementKind::If(condition.clone(), next, None);
            };
            vec![repair(Operator::EmptyBranch, [format!("if ({text});"), format!("if ({text})")], &next)]
        }
        StatementKind::Expression(call @ Expression { kind: ExpressionKind::Call(..), .. }) => {
            let targets = names.assigned.iter().take(MOST_TARGETS);
            let ways = [None, Some(Binary::Add), Some(Binary::Multiply)];
            let all = targets.flat_map(|name| ways.into_iter().map(move |way| (name, way)));
            let kept = all.map(|(name, way)| {
                let to = Box::new(Expression::made(own.line, ExpressionKind::Name(Name::clone(name))));
                let kind = ExpressionKind::Assign(way, to, Box::new(call.clone()));
                let kept = Expression { line: own.line, at: 0, changes: true, kind };
                let texts = [written(call), written(&kept)];
                let keep = |list: &mut Vec<Statement>| list[at] = statement(StatementKind::Expression(kept.clone()));
                repair(Operator::ThrownAway, texts, &keep)
            });
            kept.collect()
        }
        StatementKind::Declaration(Declaration {
            kind: TypeName { base: BaseType::Named(of), .. }, variables, ..
        }) => {
            let [only] = &variables[..] else { return Vec::new() };
            let Some(value) = only.value.as_ref().filter(|_| names.is_twice(&only.name)) else { return Vec::new() };
            let to = Box::new(Expression::made(own.line, ExpressionKind::Name(Name::clone(&only.name))));
            let kind = ExpressionKind::Assign(None, to, Box::new(value.clone()));
            let given = Expression { line: own.line, at: 0, changes: true, kind };
            let texts = [format!("{of} {}", only.name), only.name.to_string()];
            let give = |list: &mut Vec<Statement>| list[at] = statement(StatementKind::Expression(given.clone()));
            vec![repair(Operator::Shadowed, texts, &give)]
        }
        StatementKind::Case(Some(Expression { kind: ExpressionKind::Integer(number, unsigned), at: byte, .. })) => {
            let others = [0.0, 1.0, 2.0, 3.0].into_iter().filter(|other| other != number);
            let all = others.map(|other| {
                let kind = ExpressionKind::Integer(other, *unsigned);
                let label = Expression { at: *byte, ..Expression::made(own.line, kind) };
                let put = |list: &mut Vec<Statement>| list[at] = statement(StatementKind::Case(Some(label.clone())));
                repair(Operator::OtherNumber, [number, &other].map(|number| format!("case {number}")), &put)
            });
            all.collect()
        }
        _ if is_run_into(list, at + 1) => {
            let texts = [String::new(), "break;".to_owned()];
            vec![repair(Operator::FallsThrough, texts, &|list| list.insert(at + 1, statement(StatementKind::Break)))]
        }
        _ => Vec::new(),
    }
}

/// Whether a case begins there that the one before it runs into.
fn is_run_into(list: &[Statement], at: usize) -> bool {
    let ends = |kind: &StatementKind| {
        matches!(
            kind,
            StatementKind::Case(_)
                | StatementKind::Break
                | StatementKind::Continue
                | StatementKind::Return(_)
                | StatementKind::Discard
        )
    };
    let begins = |next: &Statement| matches!(next.kind, StatementKind::Case(_));
    list.get(at).is_some_and(begins) && !ends(&list[at - 1].kind)
}

/// The names of a function's variables.
struct UsedNames {
    /// Those that are given values.
    assigned: BTreeSet<Name>,
    /// How often each is declared, outside of functions as well.
    declared: HashMap<Name, usize>,
}

impl UsedNames {
    fn of(function: &Function, globals: &[&Name]) -> Self {
        let mut own = Self { assigned: BTreeSet::new(), declared: HashMap::new() };
        let parameters = function.parameters.iter().map(|parameter| &parameter.name);
        for name in parameters.chain(globals.iter().copied()) {
            *own.declared.entry(Name::clone(name)).or_default() += 1;
        }
        each_list(&mut function.clone(), &mut |list| list.iter().for_each(|statement| own.meet(statement)));
        own
    }

    fn meet(&mut self, statement: &Statement) {
        match &statement.kind {
            StatementKind::Expression(own) => self.assigned.extend(assigned(own).cloned()),
            StatementKind::Declaration(own) => {
                for variable in &own.variables {
                    *self.declared.entry(Name::clone(&variable.name)).or_default() += 1;
                    self.assigned.insert(Name::clone(&variable.name));
                }
            }
            _ => {}
        }
    }

    fn is_twice(&self, name: &Name) -> bool {
        self.declared.get(name).is_some_and(|count| *count > 1)
    }
}

/// Calls `visit` for every list of statements of a function; a statement that stands alone in a branch or a loop is a list of one.
fn each_list(function: &mut Function, visit: &mut dyn FnMut(&mut Vec<Statement>)) {
    if let Some(body) = &mut function.body {
        lists_in(body, visit);
    }
}

fn lists_in(list: &mut Vec<Statement>, visit: &mut dyn FnMut(&mut Vec<Statement>)) {
    visit(list);
    list.iter_mut().for_each(|statement| lists_of(statement, visit));
}

fn lists_of(statement: &mut Statement, visit: &mut dyn FnMut(&mut Vec<Statement>)) {
    match &mut statement.kind {
        StatementKind::Block(all) | StatementKind::Switch(_, all) => lists_in(all, visit),
        StatementKind::If(_, yes, no) => {
            list_of_one(yes, visit);
            no.iter_mut().for_each(|no| list_of_one(no, visit));
        }
        StatementKind::Loop(_, _, _, body) | StatementKind::DoWhile(body, _) => list_of_one(body, visit),
        _ => {}
    }
}

fn list_of_one(statement: &mut Statement, visit: &mut dyn FnMut(&mut Vec<Statement>)) {
    if matches!(statement.kind, StatementKind::Block(_)) {
        return lists_of(statement, visit);
    }
    let mut list = vec![statement.clone()];
    visit(&mut list);
    *statement = match <[Statement; 1]>::try_from(list) {
        Ok([only]) => only,
        Err(list) => Statement { line: statement.line, kind: StatementKind::Block(list) },
    };
    lists_of(statement, visit);
}
