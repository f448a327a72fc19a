//! What a macro writes several times.

use super::super::Operator;
use super::super::tree::{ExpressionPlace, Path, TreeWalk, paths, walk};
use super::{ProgramRepair, Where};
use crate::interpreter::syntax::Item;
use std::cmp::Reverse;
use std::collections::{BTreeMap, HashMap, HashSet};

/// The bytes of the text at which something is written that stands at several places of the program.
pub(super) fn copied(items: &mut [Item]) -> HashSet<u32> {
    let (mut once, mut copied) = (HashSet::new(), HashSet::new());
    walk(
        items,
        &mut TreeWalk {
            is_part: &|_| true,
            declares: true,
            statement: &mut |_, _| {},
            expression: &mut |own, _, _| {
                let all = paths(own).into_iter().map(|path| ExpressionPlace::of(own, &path).own.at);
                copied.extend(all.filter(|at| *at > 0 && !once.insert(*at)));
            },
        },
    );
    copied
}

/// A change of what a macro writes is one of all its copies: the changes of each copy that are the same slip become one. A slip that not
/// every copy can have is none. But brackets that a macro lacks change only what it is given without any of its own: they are told on
/// the macro's own line. `found`: the changes with the bytes at which what they change is written.
pub(super) fn together(found: Vec<(u32, ProgramRepair)>, copied: &HashSet<u32>) -> Vec<ProgramRepair> {
    let (copies, alone): (Vec<_>, Vec<_>) = found.into_iter().partition(|(at, _)| copied.contains(at));
    let brackets = copies.iter().filter(|(_, repair)| repair.mistake == Operator::Grouping);
    let brackets: Vec<ProgramRepair> = brackets.map(|(_, repair)| on_the_macro(repair)).collect();
    let mut groups: BTreeMap<u32, Vec<Vec<ProgramRepair>>> = BTreeMap::new();
    for (at, repair) in copies {
        let all = groups.entry(at).or_default();
        match all.iter_mut().find(|own| place(&own[0]) == place(&repair)) {
            Some(own) => own.push(repair),
            None => all.push(vec![repair]),
        }
    }
    let joined = groups.into_values().flat_map(|copies| {
        let mut copies = copies.iter().map(|own| numbered(own));
        let first = copies.next().unwrap_or_default();
        let others: Vec<_> = copies.collect();
        let join = move |(key, repair): (SlipNumber, &ProgramRepair)| {
            let mut places = repair.places().to_vec();
            for own in &others {
                places.extend_from_slice(own.iter().find(|(other, _)| *other == key)?.1.places());
            }
            // What is within another copy is changed before it.
            places.sort_by_key(|(_, path, _)| Reverse(path.len()));
            Some(ProgramRepair { place: Where::Expressions(places), ..repair.clone() })
        };
        first.into_iter().filter_map(join).collect::<Vec<_>>()
    });
    alone.into_iter().map(|(_, repair)| repair).chain(joined).chain(brackets).collect()
}

/// A change on the line of the macro that writes what is changed: that stands above all that the macro is given.
fn on_the_macro(repair: &ProgramRepair) -> ProgramRepair {
    let changed = repair.places().iter().map(|(.., changed)| changed);
    let lines = changed.flat_map(|changed| {
        paths(changed).into_iter().map(|path| ExpressionPlace::of(changed, &path).own.line).collect::<Vec<_>>()
    });
    ProgramRepair { line: lines.chain([repair.line]).min().unwrap_or(repair.line), ..repair.clone() }
}

/// Where a change, or the first copy of one, stands: in which expression, and where in it.
pub(super) fn place(repair: &ProgramRepair) -> Option<(usize, &Path)> {
    repair.places().first().map(|(number, path, _)| (*number, path))
}

/// What kind of change it is, whether it is a slip of what is written, and which of those of its copy.
type SlipNumber = (Operator, bool, usize);

/// The changes of one copy by their numbers.
fn numbered(own: &[ProgramRepair]) -> Vec<(SlipNumber, &ProgramRepair)> {
    let mut counts: HashMap<(Operator, bool), usize> = HashMap::new();
    let number = |repair: &ProgramRepair| {
        let count = counts.entry((repair.mistake, repair.is_slip)).or_default();
        *count += 1;
        (repair.mistake, repair.is_slip, *count)
    };
    let numbers: Vec<SlipNumber> = own.iter().map(number).collect();
    numbers.into_iter().zip(own).collect()
}
