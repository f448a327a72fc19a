//! The folder of a homework out of a ZIP. It runs in a worker only: the archive is a stranger's.

use crate::language::Text;
use reference::Folder;
use reference::assignment::MANIFEST;
use std::collections::BTreeMap;
use std::io::{Cursor, Read};
use zip::ZipArchive;

/// Most members of an archive, and most bytes of all of them unpacked.
const MOST_FILES: usize = 1000;
pub(super) const MOST_BYTES: usize = 64 << 20;

/// The files of the one folder with an `assignment.toml` in it, which may stand in other folders. Hidden files, an editor's
/// backups and what macOS adds are no part of it.
pub(super) fn unpacked(archive: &[u8]) -> Result<Folder, Text> {
    let mut archive = ZipArchive::new(Cursor::new(archive)).map_err(|error| broken(&error))?;
    if archive.len() > MOST_FILES {
        return Err(too_large());
    }
    let mut room = MOST_BYTES as u64;
    let mut files = BTreeMap::new();
    for index in 0..archive.len() {
        let member = archive.by_index(index).map_err(|error| broken(&error))?;
        let Some(name) = member.enclosed_name().and_then(|path| Some(path.to_str()?.replace('\\', "/"))) else {
            return Err(leads_out(&member.name().unwrap_or_default()));
        };
        if member.is_dir() || name.split('/').any(is_litter) {
            continue;
        }
        let mut bytes = Vec::new();
        member.take(room + 1).read_to_end(&mut bytes).map_err(|error| broken(&error))?;
        room = room.checked_sub(bytes.len() as u64).ok_or_else(too_large)?;
        files.insert(name, bytes);
    }
    below_manifest(files)
}

fn is_litter(part: &str) -> bool {
    part.starts_with('.') || part.ends_with('~') || part == "__MACOSX"
}

/// The files beside the manifest and below, by their names from there.
fn below_manifest(files: BTreeMap<String, Vec<u8>>) -> Result<Folder, Text> {
    let folders = files.keys().filter_map(|name| name.strip_suffix(MANIFEST));
    let mut folders: Vec<&str> = folders.filter(|folder| folder.is_empty() || folder.ends_with('/')).collect();
    folders.sort_by_key(|folder| folder.len());
    let root = match folders.as_slice() {
        [] => return Err(no_manifest()),
        [root] => (*root).to_owned(),
        [root, rest @ ..] if rest.iter().all(|other| other.starts_with(root)) => (*root).to_owned(),
        several => return Err(several_folders(several)),
    };
    let own = files.into_iter().filter_map(|(name, bytes)| Some((name.strip_prefix(&root)?.to_owned(), bytes)));
    Ok(Folder::of(own))
}

fn broken(error: &dyn std::fmt::Display) -> Text {
    Text::new(
        format!("it is no ZIP that can be unpacked ({error}): pack the folder again"),
        format!("ZIP として展開できません（{error}）。フォルダをもう一度 ZIP にしてください"),
    )
}

fn too_large() -> Text {
    let room = MOST_BYTES >> 20;
    Text::new(
        format!(
            "it has more than {MOST_FILES} files or {room} MiB unpacked: pack the folder of one homework, and nothing else"
        ),
        format!(
            "展開するとファイルが {MOST_FILES} 個または {room} MiB を超えます。1 つの課題のフォルダだけを ZIP にしてください"
        ),
    )
}

fn leads_out(name: &str) -> Text {
    let name: String = name.chars().filter(|c| !c.is_control()).take(100).collect();
    Text::new(
        format!("the name `{name}` leads out of the archive: pack the folder again"),
        format!("「{name}」はアーカイブの外を指す名前です。フォルダをもう一度 ZIP にしてください"),
    )
}

fn no_manifest() -> Text {
    Text::new(
        format!("there is no {MANIFEST} in it: every homework has one; `ggrade assignment new` writes one"),
        format!("{MANIFEST} がありません。どの課題にも必要です。`ggrade assignment new` で作成できます"),
    )
}

fn several_folders(folders: &[&str]) -> Text {
    let named: Vec<_> = folders.iter().map(|folder| format!("`{folder}{MANIFEST}`")).collect();
    let named = named.join(", ");
    Text::new(
        format!("it has several homeworks ({named}): upload each by itself"),
        format!("複数の課題があります（{named}）。1 つずつアップロードしてください"),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Write;
    use zip::write::SimpleFileOptions;

    fn zip(files: &[(&str, &str)]) -> Vec<u8> {
        let mut zip = zip::ZipWriter::new(Cursor::new(Vec::new()));
        for (name, text) in files {
            zip.start_file(*name, SimpleFileOptions::default()).unwrap();
            zip.write_all(text.as_bytes()).unwrap();
        }
        zip.finish().unwrap().into_inner()
    }

    #[test]
    fn the_folder_is_found_wherever_it_stands() {
        let folder = Folder::of([("assignment.toml", "a"), ("meshes/m.obj", "b")]);
        for root in ["", "mine/", "x/y/"] {
            let name = |name: &str| format!("{root}{name}");
            let names =
                [name("assignment.toml"), name("meshes/m.obj"), name(".git/x"), name("a~"), "__MACOSX/q".into()];
            let files: Vec<_> = names.iter().zip(["a", "b", "", "", ""]).map(|(n, t)| (n.as_str(), t)).collect();
            assert_eq!(unpacked(&zip(&files)), Ok(folder.clone()), "{root}");
        }
    }

    #[test]
    fn what_is_no_homework_is_told_why() {
        let said = |bytes: &[u8]| unpacked(bytes).unwrap_err().en;
        assert!(said(b"nothing").contains("no ZIP"));
        assert!(said(&zip(&[("a.vert", "")])).contains("no assignment.toml"));
        let two = zip(&[("a/assignment.toml", ""), ("b/assignment.toml", "")]);
        assert!(said(&two).contains("`a/assignment.toml`, `b/assignment.toml`"));
        assert!(said(&zip(&[("../assignment.toml", "")])).contains("leads out"));
        let (zeros, names) = ("\0".repeat(1 << 20), (0..65).map(|i| format!("{i}")).collect::<Vec<_>>());
        let bomb: Vec<_> = names.iter().map(|name| (name.as_str(), zeros.as_str())).collect();
        assert!(said(&zip(&bomb)).contains("64 MiB"));
    }
}
