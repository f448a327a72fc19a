//! What a macro writes several times.

use super::super::tree::{ExpressionPlace, Path, TreeWalk, paths, walk, with};
use super::super::written;
use super::ProgramRepair;
use crate::interpreter::syntax::{Expression, Item};
use std::collections::HashMap;

/// The bytes at which what is written once stands several times, and whether it is the same each time.
pub(super) fn copied(items: &mut [Item]) -> HashMap<u32, bool> {
    let mut known: HashMap<u32, Vec<String>> = HashMap::new();
    walk(
        items,
        &mut TreeWalk {
            is_part: &|_| true,
            bound: &mut |_, _| {},
            statement: &mut |_, _| {},
            expression: &mut |own, _, _| {
                for path in paths(own) {
                    let place = ExpressionPlace::of(own, &path).own;
                    known.entry(place.at).or_default().push(written(place));
                }
            },
        },
    );
    let copied = known.into_iter().filter(|(at, texts)| *at > 0 && texts.len() > 1);
    copied.map(|(at, texts)| (at, texts.iter().all(|text| *text == texts[0]))).collect()
}

/// Puts a change into every copy of what a macro writes several times.
pub(super) fn replace_copies(own: &mut Expression, repair: &ProgramRepair, changed: &Expression) {
    let is_copy = |path: &Path| {
        let place = ExpressionPlace::of(own, path).own;
        place.at == repair.at && written(place) == repair.texts[0]
    };
    let copies: Vec<Path> = paths(own).into_iter().filter(is_copy).collect();
    for path in copies {
        *own = with(own, &path, changed.clone());
    }
}
