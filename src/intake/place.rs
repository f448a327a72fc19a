//! How files are named in what is handed out: from the input on that they came in, never by where this machine has them.

use super::tree;
use std::path::{Component, Path, PathBuf};

/// What each input is called: the only one by its own name, several by their paths from the folder on that holds them
/// all, so that no two are called the same.
pub(super) fn names(inputs: &[PathBuf]) -> Vec<String> {
    if let [input] = inputs {
        return vec![own_name(&absolute(input))];
    }
    let common = common_folder(inputs);
    let name = |input: &PathBuf| {
        let whole = absolute(input);
        let below = whole.strip_prefix(&common).unwrap_or(&whole);
        let parts: Vec<String> = below.iter().map(tree::decoded).collect();
        if parts.is_empty() { own_name(&whole) } else { parts.join("/") }
    };
    inputs.iter().map(name).collect()
}

/// The title of what these inputs are together: the name of the only one, or of the folder that holds them all.
pub(super) fn title(inputs: &[PathBuf]) -> String {
    let name = match inputs {
        [] => return String::new(),
        [input] => own_name(&std::fs::canonicalize(input).unwrap_or_else(|_| absolute(input))),
        several => common_folder(several).file_name().map(tree::decoded).unwrap_or_default(),
    };
    match name.len().checked_sub(4).and_then(|at| name.split_at_checked(at)) {
        Some((stem, extension)) if extension.eq_ignore_ascii_case(".zip") && !stem.is_empty() => stem.into(),
        _ => name,
    }
}

/// A path without the name of the only input, with which it begins; the input itself keeps its name.
pub(super) fn below(path: String, input: &str) -> String {
    match path.strip_prefix(input).and_then(|rest| rest.strip_prefix('/')) {
        Some(rest) if !rest.is_empty() => rest.into(),
        _ => path,
    }
}

/// A file by its path from the working folder on, as CI finds it; `None` where it is not below that.
pub fn in_working_folder(path: &Path) -> Option<PathBuf> {
    // Whoever works in `/` works nowhere in particular: from there a path is that of the machine.
    let folder = std::env::current_dir().ok().filter(|folder| folder.parent().is_some())?;
    let plain = |path: &Path| path.components().all(|part| matches!(part, Component::Normal(_)));
    let typed: PathBuf = absolute(path).strip_prefix(&folder).ok()?.into();
    if plain(&typed) {
        return Some(typed);
    }
    let real = std::fs::canonicalize(path).ok()?;
    real.strip_prefix(std::fs::canonicalize(folder).ok()?).ok().map(Path::to_owned)
}

/// The nearest folder in which all of these are.
fn common_folder(inputs: &[PathBuf]) -> PathBuf {
    let all: Vec<PathBuf> = inputs.iter().map(absolute).collect();
    let holds_all = |folder: &&Path| all.iter().all(|input| input.starts_with(folder));
    let first = all.first().map(PathBuf::as_path).unwrap_or(Path::new("/"));
    first.ancestors().skip(1).find(holds_all).unwrap_or(Path::new("/")).to_owned()
}

fn absolute(path: impl AsRef<Path>) -> PathBuf {
    let path = path.as_ref();
    std::path::absolute(path).unwrap_or_else(|_| path.to_owned())
}

/// The last part of a path; that of `..` is the folder that it leads to.
fn own_name(path: &Path) -> String {
    let real = || std::fs::canonicalize(path).ok();
    let name = path.file_name().map(tree::decoded);
    name.or_else(|| real()?.file_name().map(tree::decoded)).unwrap_or_else(|| "/".into())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn named(inputs: &[&str]) -> Vec<String> {
        names(&inputs.iter().map(PathBuf::from).collect::<Vec<_>>())
    }

    #[test]
    fn one_input_has_its_own_name_and_several_their_paths_from_the_folder_that_holds_them() {
        assert_eq!(named(&["/srv/2026/class.zip"]), ["class.zip"]);
        assert_eq!(named(&["./class/"]), ["class"]);
        assert_eq!(named(&["/srv/a/x.vert", "/srv/b/x.vert"]), ["a/x.vert", "b/x.vert"]);
        assert_eq!(named(&["/srv/a", "/srv/a/b"]), ["a", "a/b"]);
        assert_eq!(named(&["/srv/a/b", "/srv/a"]), ["b", "a"]);
    }

    #[test]
    fn the_only_input_is_left_out_of_the_paths_in_it() {
        assert_eq!(below("class.zip/alice/x.vert".into(), "class.zip"), "alice/x.vert");
        assert_eq!(below("class.zip".into(), "class.zip"), "class.zip");
        assert_eq!(below("class.zip.d/x".into(), "class.zip"), "class.zip.d/x");
        assert_eq!(below("a/a/x".into(), "a"), "a/x");
    }

    #[test]
    fn only_files_below_the_working_folder_have_a_path_from_there() {
        assert_eq!(in_working_folder(Path::new("./src/lib.rs")), Some("src/lib.rs".into()));
        assert_eq!(in_working_folder(Path::new("src/../src/lib.rs")), Some("src/lib.rs".into()));
        let here = std::env::current_dir().unwrap();
        assert_eq!(in_working_folder(&here.join("src/lib.rs")), Some("src/lib.rs".into()));
        assert_eq!(in_working_folder(Path::new("/etc/hostname")), None);
        assert_eq!(in_working_folder(Path::new("../x.vert")), None);
    }
}
