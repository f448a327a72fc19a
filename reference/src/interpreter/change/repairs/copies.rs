//! What a macro writes several times.

use super::super::Operator;
use super::super::tree::{ExpressionPlace, Path, TreeWalk, paths, walk};
use super::{ProgramRepair, Where};
use crate::interpreter::syntax::{Expression, Item};
use std::cell::RefCell;
use std::collections::{HashMap, HashSet};

/// The bytes of the text at which something is written that stands at several places of the program.
pub(super) fn copied(items: &mut [Item]) -> HashSet<u32> {
    let (mut once, mut copied) = (HashSet::new(), HashSet::new());
    let mut meet = |at: u32| {
        if at > 0 && !once.insert(at) {
            copied.insert(at);
        }
    };
    let mut of = |own: &Expression| {
        paths(own).iter().for_each(|path| meet(ExpressionPlace::of(own, path).own.at));
    };
    let of = RefCell::new(&mut of);
    walk(
        items,
        &mut TreeWalk {
            is_part: &|_| true,
            declares: true,
            bound: &mut |own, _| of.borrow_mut()(own),
            statement: &mut |_, _| {},
            expression: &mut |own, _, _| of.borrow_mut()(own),
        },
    );
    copied
}

/// A change of what a macro writes is one of all its copies: the changes of each copy that are the same slip become one. A slip that not
/// every copy can have is none. `found`: the changes with the bytes at which what they change is written.
pub(super) fn together(found: Vec<(u32, ProgramRepair)>, copied: &HashSet<u32>) -> Vec<ProgramRepair> {
    let mut alone = Vec::new();
    let mut groups: HashMap<u32, Vec<(Place, Vec<ProgramRepair>)>> = HashMap::new();
    for (at, repair) in found {
        let place = match &repair.place {
            Where::Expressions(places) if copied.contains(&at) => (places[0].0, places[0].1.clone()),
            _ => {
                alone.push(repair);
                continue;
            }
        };
        let copies = groups.entry(at).or_default();
        match copies.iter_mut().find(|(known, _)| *known == place) {
            Some((_, own)) => own.push(repair),
            None => copies.push((place, vec![repair])),
        }
    }
    let mut groups: Vec<_> = groups.into_iter().collect();
    groups.sort_by_key(|(at, _)| *at);
    for (_, copies) in groups {
        let Some(((_, first), others)) = copies.split_first() else { continue };
        let others: Vec<_> = others.iter().map(|(_, own)| numbered(own)).collect();
        for (key, repair) in numbered(first) {
            let same = others.iter().map(|own| own.iter().find(|(other, _)| *other == key).map(|(_, repair)| *repair));
            if let Some(same) = same.collect::<Option<Vec<&ProgramRepair>>>() {
                let mut joined = repair.clone();
                if let Where::Expressions(places) = &mut joined.place {
                    places.extend(same.iter().flat_map(|other| match &other.place {
                        Where::Expressions(places) => places.clone(),
                        Where::Statement(_) => Vec::new(),
                    }));
                    // What is within another copy is changed before it.
                    places.sort_by_key(|(_, path, _)| std::cmp::Reverse(path.len()));
                }
                alone.push(joined);
            }
        }
    }
    alone
}

type Place = (usize, Path);

/// The changes of one copy, each with what kind it is, whether it is a slip of what is written, and which of those it is.
fn numbered(own: &[ProgramRepair]) -> Vec<((Operator, bool, usize), &ProgramRepair)> {
    let mut counts: HashMap<(Operator, bool), usize> = HashMap::new();
    let number = |repair: &ProgramRepair| {
        let count = counts.entry((repair.mistake, repair.is_slip)).or_default();
        *count += 1;
        (repair.mistake, repair.is_slip, *count)
    };
    let keys: Vec<_> = own.iter().map(number).collect();
    keys.into_iter().zip(own).collect()
}
