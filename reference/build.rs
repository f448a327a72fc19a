//! Embeds every folder below `assignments` as it is: a folder becomes a built-in assignment by being there. And names the
//! engine: what was computed by other code is not taken for what this code computes.

use std::fmt::Write;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};
use std::{env, fs, io};

fn main() -> io::Result<()> {
    let package = PathBuf::from(env::var("CARGO_MANIFEST_DIR").map_err(io::Error::other)?);
    let (root, sources) = (package.join("assignments"), package.join("src"));
    let mut hasher = DefaultHasher::new();
    hash(&sources, &mut hasher)?;
    println!("cargo::rustc-env=GGRADE_ENGINE={:016x}", hasher.finish());
    println!("cargo::rerun-if-changed={}", sources.display());
    // Cargo looks at everything below a folder.
    println!("cargo::rerun-if-changed={}", root.display());
    let mut code = String::from("&[\n");
    for folder in entries(&root)?.iter().filter(|path| path.is_dir()) {
        writeln!(code, "({:?}, &[", name(folder)).map_err(io::Error::other)?;
        files(folder, "", &mut code)?;
        code.push_str("]),\n");
    }
    code.push_str("]\n");
    let out = PathBuf::from(env::var("OUT_DIR").map_err(io::Error::other)?);
    fs::write(out.join("built_in.rs"), code)
}

/// One line for each file of a folder: its relative name, and its bytes.
fn files(folder: &Path, before: &str, code: &mut String) -> io::Result<()> {
    for path in entries(folder)? {
        let relative = format!("{before}{}", name(&path));
        if path.is_dir() {
            files(&path, &format!("{relative}/"), code)?;
        } else {
            writeln!(code, "({relative:?}, include_bytes!({:?})),", path.display().to_string())
                .map_err(io::Error::other)?;
        }
    }
    Ok(())
}

/// The names and bytes of all files below a folder.
fn hash(folder: &Path, hasher: &mut DefaultHasher) -> io::Result<()> {
    for path in entries(folder)? {
        name(&path).hash(hasher);
        if path.is_dir() {
            hash(&path, hasher)?;
        } else {
            fs::read(&path)?.hash(hasher);
        }
    }
    Ok(())
}

/// What is in a folder, in order of name; hidden files and an editor's backups are no part of it.
fn entries(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let paths: io::Result<Vec<_>> = fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect();
    let mut paths = paths?;
    paths.retain(|path| !name(path).starts_with('.') && !name(path).ends_with('~'));
    paths.sort();
    Ok(paths)
}

fn name(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}
