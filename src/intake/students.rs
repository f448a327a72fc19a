//! Whose each file of an input is.
//!
//! A level of a tree on which a name is a participant's is a Moodle download; what stands there under other names
//! belongs to nobody. Elsewhere each folder (or archive) is a student, and each shader that lies loose beside them.
//! Folders of students, such as the classes of a year, have no file of their own and several folders with shaders:
//! they are looked into where all folders beside them are such, so that no student becomes several by what is handed in.

use super::layout::{holds_classes, is_moodle, is_one_student, of_folder, without_zip};
use super::moodle::{self, Loose, Marked};
use super::tree::{Held, TreeFile, TreeFolder, TreeNode};
use super::{IntakeOptions, Participant, Refused};
use crate::language::Text;
use crate::slots::{NameFit, fit};
use std::collections::HashMap;
use std::path::PathBuf;

/// Who handed in, before keys are given.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Who {
    /// The name as shown.
    pub name: String,
    /// As Moodle names them.
    pub moodle: Option<Participant>,
    /// Where the student was found: what a key can be made of.
    pub place: String,
}

/// What one student handed in.
#[derive(Debug)]
pub(super) struct StudentFiles {
    pub who: Who,
    pub files: Vec<Owned>,
    /// Whether the person at the command line named the file, so that there is nothing to choose.
    pub is_named: bool,
    /// Whether a text was typed into Moodle's own field.
    pub has_online_text: bool,
}

/// A file of a student's.
#[derive(Debug)]
pub(super) struct Owned {
    /// Its own name.
    pub name: String,
    /// Its path below the student's folder.
    pub below: String,
    /// Its path from the input on.
    pub path: String,
    pub file: TreeFile,
}

/// The students in a folder or archive that is shown as `shown`. `is_one_of_several` says that other inputs stand
/// beside it, so that it may be one student's.
pub(super) fn in_folder(
    shown: &str,
    folder: TreeFolder,
    options: &IntakeOptions,
    is_one_of_several: bool,
) -> (Vec<StudentFiles>, Vec<Refused>) {
    let mut finding = StudentSearch::new(options);
    if is_moodle(&folder) {
        finding.moodle(shown, folder);
    } else if is_one_student(&folder, &options.slots, is_one_of_several) {
        let name = shown.rsplit('/').next().unwrap_or(shown);
        finding.student(without_zip(name), shown, folder);
    } else {
        finding.class(shown, folder);
    }
    (finding.groups, finding.refused)
}

/// The students whose files were named one by one.
pub(super) fn of_files(
    files: Vec<(String, PathBuf, TreeFile)>,
    options: &IntakeOptions,
) -> (Vec<StudentFiles>, Vec<Refused>) {
    let mut finding = StudentSearch::new(options);
    for (shown, path, file) in files {
        let mut names = shown.rsplit('/');
        let name = names.next().unwrap_or(&shown).to_owned();
        let parent = path.parent().and_then(|parent| std::path::absolute(parent).ok());
        let parent = parent.as_deref().and_then(|parent| parent.file_name()).map(super::tree::decoded);
        let in_folder = || Some(Loose::Of(moodle::folder(parent.as_deref()?)?));
        if let Some(loose) = moodle::file(&name).or_else(in_folder) {
            finding.loose(&loose, &name, shown, file);
            continue;
        }
        let is_wanted = NameFit::best(&name, &options.slots) <= NameFit::Copy;
        let who = parent.filter(|_| is_wanted).unwrap_or_else(|| stem(&name).into());
        finding.named(who, Owned { name: name.clone(), below: name, path: shown, file });
    }
    (finding.groups, finding.refused)
}

struct StudentSearch<'a> {
    options: &'a IntakeOptions,
    groups: Vec<StudentFiles>,
    refused: Vec<Refused>,
    /// The group of each participant.
    by_number: HashMap<Option<u64>, usize>,
}

impl<'o> StudentSearch<'o> {
    fn new(options: &'o IntakeOptions) -> Self {
        Self { options, groups: Vec::new(), refused: Vec::new(), by_number: HashMap::new() }
    }

    fn class(&mut self, place: &str, folder: TreeFolder) {
        if is_moodle(&folder) {
            return self.moodle(place, folder);
        }
        let are_classes = holds_classes(&folder, &self.options.slots);
        for (name, node) in folder.into_children() {
            let place = format!("{place}/{name}");
            match node {
                TreeNode::Folder(folder) if are_classes && !folder.is_empty() => self.class(&place, folder),
                TreeNode::Folder(folder) => self.student(without_zip(&name), &place, folder),
                TreeNode::File(file) if self.is_hand_in(&name, &file) => {
                    let who = stem(&name).to_owned();
                    self.named(who, Owned { name: name.clone(), below: name, path: place, file });
                }
                TreeNode::File(file) => self.nobodys(place, &file),
            }
        }
    }

    fn moodle(&mut self, place: &str, folder: TreeFolder) {
        for (name, node) in folder.into_children() {
            let place = format!("{place}/{name}");
            match node {
                TreeNode::Folder(folder) => match of_folder(&name) {
                    Some(Loose::Of(marked)) => {
                        let files = owned(&place, folder);
                        let group = self.participant(&place, &marked);
                        files.into_iter().for_each(|file| group.take(&marked, file));
                    }
                    Some(Loose::Unclear(participants)) => self.unclear(place, &participants),
                    None if is_moodle(&folder) => self.moodle(&place, folder),
                    None if folder.is_empty() => self.refused.push(Refused { path: place, reason: nobodys() }),
                    None => owned(&place, folder).into_iter().for_each(|owned| self.nobodys(owned.path, &owned.file)),
                },
                TreeNode::File(file) => match moodle::file(&name) {
                    Some(loose) => self.loose(&loose, &name, place, file),
                    None => self.nobodys(place, &file),
                },
            }
        }
    }

    /// A file of the name `name` among those of all students.
    fn loose(&mut self, loose: &Loose, name: &str, path: String, file: TreeFile) {
        match loose {
            Loose::Of(marked) => {
                let own = marked.file_name.unwrap_or(name).to_owned();
                let group = self.participant(&path, marked);
                group.take(marked, Owned { name: own.clone(), below: own, path, file });
            }
            Loose::Unclear(participants) => self.unclear(path, participants),
        }
    }

    /// What can be several students' is nobody's, and is named.
    fn unclear(&mut self, path: String, participants: &[Participant]) {
        self.refused.push(Refused { path, reason: super::wording::unclear(participants) });
    }

    /// Whether a file beside the students' folders is a student's: a shader, or an archive that cannot be opened.
    fn is_hand_in(&self, name: &str, file: &TreeFile) -> bool {
        let is_broken = matches!(file.held, Held::Refused(_)) && without_zip(name) != name;
        is_broken || NameFit::best(name, &self.options.slots) <= NameFit::Renamed
    }

    /// The group of this participant, made where there is none yet.
    fn participant(&mut self, place: &str, marked: &Marked) -> &mut StudentFiles {
        let groups = &mut self.groups;
        let at = *self.by_number.entry(marked.participant.number).or_insert_with(|| {
            let name = moodle::shown(&marked.participant);
            let who = Who { name, moodle: Some(marked.participant.clone()), place: place.into() };
            groups.push(StudentFiles { who, files: Vec::new(), is_named: false, has_online_text: false });
            groups.len() - 1
        });
        &mut groups[at]
    }

    /// A file that is a student's by its name: the student's first, or one for another slot than those that are there.
    fn named(&mut self, name: String, file: Owned) {
        let slots = &self.options.slots;
        let slot = |name: &str| (0..slots.len()).min_by_key(|&slot| fit(name, &slots[slot]));
        let folder = |path: &str| path.rsplit_once('/').map(|(folder, _)| folder.to_owned());
        let is_theirs = |group: &&mut StudentFiles| {
            group.is_named
                && group.who.name == name
                && group
                    .files
                    .iter()
                    .all(|other| folder(&other.path) == folder(&file.path) && slot(&other.name) != slot(&file.name))
        };
        match self.groups.iter_mut().find(is_theirs) {
            Some(group) => group.files.push(file),
            None => {
                let who = Who { name, moodle: None, place: file.path.clone() };
                self.groups.push(StudentFiles { who, files: vec![file], is_named: true, has_online_text: false });
            }
        }
    }

    fn student(&mut self, name: &str, place: &str, folder: TreeFolder) {
        let who = Who { name: name.into(), moodle: None, place: place.into() };
        self.groups.push(StudentFiles { who, files: owned(place, folder), is_named: false, has_online_text: false });
    }

    /// A file that belongs to no student. What was refused has been named already.
    fn nobodys(&mut self, path: String, file: &TreeFile) {
        if !matches!(file.held, Held::Refused(_)) {
            self.refused.push(Refused { path, reason: nobodys() });
        }
    }
}

impl StudentFiles {
    fn take(&mut self, marked: &Marked, file: Owned) {
        if marked.plugin == "file" {
            self.files.push(file);
        } else {
            self.has_online_text |= marked.plugin == "onlinetext";
        }
    }
}

fn nobodys() -> Text {
    Text::new(
        "It stands where only students' folders and shaders are expected, and belongs to nobody.",
        "学生ごとのフォルダやシェーダが並ぶ場所にあり、どの学生のものか分かりません。",
    )
}

/// The files below a student's folder.
pub(super) fn owned(place: &str, folder: TreeFolder) -> Vec<Owned> {
    let own = |(path, file): (Vec<String>, TreeFile)| {
        let below = path.join("/");
        Owned { name: path.last().cloned().unwrap_or_default(), path: format!("{place}/{below}"), below, file }
    };
    folder.into_files().into_iter().map(own).collect()
}

/// A file name without its extensions.
fn stem(name: &str) -> &str {
    let stem = match name.find(".vert.") {
        Some(at) => &name[..at],
        None => name.rsplit_once('.').map_or(name, |(stem, _)| stem),
    };
    if stem.is_empty() { name } else { stem }
}
