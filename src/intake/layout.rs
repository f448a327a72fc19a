//! What a folder looks like by the names in it: one student's, a class, a Moodle download. `wanted` are the files that the
//! assignment asks for.

use super::moodle::{self, Loose};
use super::tree::{TreeFolder, TreeNode};
use crate::slots::{NameFit, Slot, fit};

/// Whether a name in the folder is a participant's of Moodle.
pub(super) fn is_moodle(folder: &TreeFolder) -> bool {
    folder.children().any(|(name, node)| match node {
        TreeNode::Folder(_) => of_folder(name).is_some(),
        TreeNode::File(_) => moodle::file(name).is_some(),
    })
}

/// Whose a folder or an archive is in a Moodle download: Moodle's own folder, or among loose files a student's archive.
pub(super) fn of_folder(name: &str) -> Option<Loose<'_>> {
    match without_zip(name) {
        stem if stem == name => moodle::folder(name).map(Loose::Of).or_else(|| moodle::file(name)),
        stem => moodle::archive(name, stem),
    }
}

/// A name without the extension of an archive.
pub(super) fn without_zip(name: &str) -> &str {
    match name.rsplit_once('.') {
        Some((stem, extension)) if extension.eq_ignore_ascii_case("zip") && !stem.is_empty() => stem,
        _ => name,
    }
}

/// Whether a folder of a class holds classes: each folder in it does, or its only one is full of students' shaders.
pub(super) fn holds_classes(folder: &TreeFolder, wanted: &[Slot]) -> bool {
    only_folder(folder).is_some_and(|(_, only)| is_flat_class(only, wanted))
        || folder.children().all(|(_, node)| match node {
            TreeNode::Folder(folder) => folder.is_empty() || is_class(folder, wanted),
            TreeNode::File(_) => true,
        })
}

/// Whether the whole input is one student's: the wanted file lies in it and no other shader below, or in its only
/// folder, which has the homework's name. Beside other inputs it is one's unless it shows several students.
pub(super) fn is_one_student(folder: &TreeFolder, wanted: &[Slot], is_one_of_several: bool) -> bool {
    let below = folder.children().any(|(_, node)| match node {
        TreeNode::Folder(folder) => has_shader(folder, wanted),
        TreeNode::File(_) => false,
    });
    let has_wanted = folder.file_names().any(|name| NameFit::best(name, wanted) == NameFit::Exact);
    let is_project = only_folder(folder).is_some_and(|(name, _)| NameFit::best(name, wanted) <= NameFit::Renamed);
    (has_wanted && !below) || is_project || (is_one_of_several && !holds_students(folder, wanted))
}

/// Whether a folder holds students rather than being one's.
fn is_class(folder: &TreeFolder, wanted: &[Slot]) -> bool {
    let has_file = folder.file_names().next().is_some();
    let with_shader = folder.children().filter(|(_, node)| match node {
        TreeNode::Folder(folder) => has_shader(folder, wanted),
        TreeNode::File(_) => false,
    });
    is_moodle(folder) || (!has_file && with_shader.count() >= 2)
}

/// Whether a folder is full of shaders of several students: more than one for the same slot, and none with its name.
fn is_flat_class(folder: &TreeFolder, wanted: &[Slot]) -> bool {
    let fitting = |slot: &Slot| folder.file_names().filter(|name| fit(name, slot) <= NameFit::Renamed).count();
    let has_own_name = folder.file_names().any(|name| NameFit::best(name, wanted) <= NameFit::Copy);
    !has_own_name && wanted.iter().any(|slot| fitting(slot) >= 2)
}

fn holds_students(folder: &TreeFolder, wanted: &[Slot]) -> bool {
    let holds_within = || only_folder(folder).is_some_and(|(_, folder)| holds_students(folder, wanted));
    is_class(folder, wanted) || is_flat_class(folder, wanted) || holds_within()
}

fn has_shader(folder: &TreeFolder, wanted: &[Slot]) -> bool {
    folder.has_file(&|name| NameFit::best(name, wanted) <= NameFit::Renamed)
}

/// The only thing in a folder, where that is a folder.
fn only_folder(folder: &TreeFolder) -> Option<(&str, &TreeFolder)> {
    let mut children = folder.children();
    match (children.next(), children.next()) {
        (Some((name, TreeNode::Folder(only))), None) => Some((name, only)),
        _ => None,
    }
}
