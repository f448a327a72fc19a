//! The assignments that are part of the program: every folder below `reference/assignments`.

use crate::assignment::MANIFEST;
use crate::{Assignment, Folder};
use std::sync::{Arc, OnceLock};

/// A folder: its name, and its files by name.
type BuiltIn = (&'static str, &'static [(&'static str, &'static [u8])]);

const BUILT_IN: &[BuiltIn] = include!(concat!(env!("OUT_DIR"), "/built_in.rs"));

/// The names of the assignments that are built in, in order.
pub fn names() -> impl Iterator<Item = &'static str> {
    BUILT_IN.iter().map(|(name, _)| *name)
}

/// The files of the built-in folder of this name, without those that it extends.
pub(crate) fn folder(name: &str) -> Option<Folder> {
    let (_, files) = BUILT_IN.iter().find(|(known, _)| *known == name)?;
    Some(Folder::of(files.iter().copied()))
}

/// The names of the assignments that hand in a file of one of these names, case aside. They are not loaded for it.
pub fn handing_in(files: &[impl AsRef<str>]) -> Vec<&'static str> {
    let is_given = |own: &String| files.iter().any(|file| file.as_ref().eq_ignore_ascii_case(own));
    names().filter(|name| handed_in(name).iter().any(is_given)).collect()
}

/// The names of the files that are handed in: the folder's own, or else those of the one that it extends.
fn handed_in(name: &str) -> Vec<String> {
    let folder = folder(name);
    let manifest = folder.as_ref().and_then(|folder| folder.text(MANIFEST).ok()?.parse::<toml::Table>().ok());
    let Some(manifest) = manifest else { return Vec::new() };
    match (manifest.get("file").and_then(toml::Value::as_array), manifest.get("extends").and_then(toml::Value::as_str))
    {
        (Some(own), _) => own.iter().filter_map(|file| Some(file.get("name")?.as_str()?.to_owned())).collect(),
        (None, Some(base)) => handed_in(base),
        (None, None) => Vec::new(),
    }
}

/// The built-in assignment of this name, which is its id.
///
/// # Panics
/// If the built-in folder is not an assignment, which the tests of this crate rule out.
pub fn assignment(name: &str) -> Option<&'static Arc<Assignment>> {
    static LOADED: [OnceLock<Arc<Assignment>>; BUILT_IN.len()] = [const { OnceLock::new() }; BUILT_IN.len()];
    let place = names().position(|known| known == name)?;
    let load = || folder(name)?.with_bases(None).and_then(Assignment::load).map(Arc::new).ok();
    Some(LOADED[place].get_or_init(|| load().expect("a built-in assignment is broken")))
}

/// The assignments that are built in.
///
/// # Panics
/// See [`assignment`].
pub fn assignments() -> impl Iterator<Item = &'static Arc<Assignment>> {
    names().filter_map(assignment)
}
