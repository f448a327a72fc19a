//! Who shares an answer with whom.

use crate::class::Class;
use std::collections::HashMap;

/// The groups of students whose files are the same, as indices into the class; each has at least two, in the order of
/// the class.
pub(super) fn groups(class: &Class) -> Vec<Vec<usize>> {
    let index: HashMap<&str, usize> =
        class.entries.iter().enumerate().map(|(index, entry)| (entry.student.key.as_str(), index)).collect();
    let mut group_of: Vec<Option<usize>> = vec![None; class.entries.len()];
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for start in 0..class.entries.len() {
        if group_of[start].is_some() {
            continue;
        }
        let mut members = Vec::new();
        let mut open = vec![start];
        while let Some(at) = open.pop() {
            if group_of[at].is_none() {
                group_of[at] = Some(groups.len());
                members.push(at);
                open.extend(class.entries[at].shares_with().filter_map(|key| index.get(key)));
            }
        }
        members.sort_unstable();
        groups.push(members);
    }
    groups.retain(|group| group.len() > 1);
    groups
}
