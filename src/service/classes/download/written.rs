//! What a download consists of, written to files.

use super::Download;
use crate::class::folder::{NotOpened, OutputFolder};
use crate::class::formats::{ClassFormat, KEY};
use crate::class::output::{self, WrittenFiles};
use crate::class::page::Pages;
use crate::class::{Class, ClassEntry};
use crate::fault::Fault;
use crate::language::{Language, Text};
use crate::report::Report;
use crate::service::State;
use crate::service::blocking::blocking;
use crate::service::errors::Problem;
use crate::service::store::Submission;
use crate::source::Source;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Writes a student's report as a page with its pictures; where that is. `sources` are its files as far as a report shows them.
pub(super) async fn page(
    state: &State,
    submission: &Submission,
    report: &Report,
    sources: Vec<Source>,
    language: Language,
    path: PathBuf,
) -> Result<PathBuf, Problem> {
    let frames = state.gallery.decoded(state, submission).await?;
    let report = report.clone();
    let write = move |state: &State| {
        let page = Pages::new(Arc::clone(&state.assignment), language).page(&report, &sources, &frames)?;
        std::fs::write(&path, page).map_err(|error| disk(&error))?;
        Ok(path)
    };
    blocking(state, write).await
}

/// Writes a format into a folder, and takes its file from there, or all its files as a ZIP.
pub(super) fn written(
    class: &Class,
    format: ClassFormat,
    sheet: Option<&[u8]>,
    path: &Path,
) -> Result<Download, Fault> {
    let folder = match OutputFolder::open(path) {
        Ok(folder) => folder,
        Err(NotOpened::Fault(fault)) => return Err(fault),
        Err(NotOpened::InUse) => return Err(Fault::new(Text::verbatim("a new folder is in use"))),
    };
    let (WrittenFiles { notes, .. }, fault) = output::write(class, &[format], sheet, &folder);
    if let Some(fault) = fault {
        return Err(fault);
    }
    let pages: Vec<&ClassEntry> = class.entries.iter().filter(|entry| entry.page.is_some()).collect();
    if format == ClassFormat::Html && !pages.is_empty() {
        // Where the class page links to.
        let folder = path.join("students");
        std::fs::create_dir_all(&folder).map_err(|error| disk(&error))?;
        for entry in pages {
            let to = folder.join(format!("{}.html", entry.student.key));
            std::fs::copy(entry.page.as_deref().unwrap_or(path), to).map_err(|error| disk(&error))?;
        }
        let bytes = zipped(path).map_err(|error| disk(&error))?;
        return Ok(Download { name: format!("{}.zip", format.id()), bytes, notes });
    }
    match format.files() {
        [file] if !file.contains(KEY) => {
            let bytes = std::fs::read(folder.at(file)).map_err(|error| disk(&error))?;
            Ok(Download { name: (*file).to_owned(), bytes, notes })
        }
        _ => {
            let bytes = zipped(path).map_err(|error| disk(&error))?;
            Ok(Download { name: format!("{}.zip", format.id()), bytes, notes })
        }
    }
}

/// Every file below a folder, in the order of their names.
pub(super) fn zipped(folder: &Path) -> std::io::Result<Vec<u8>> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    zip_into(folder, &mut bytes)?;
    Ok(bytes.into_inner())
}

/// The same into a file.
pub(super) fn zip_into(folder: &Path, to: impl std::io::Write + std::io::Seek) -> std::io::Result<()> {
    let mut zip = zip::ZipWriter::new(to);
    for entry in walkdir::WalkDir::new(folder).sort_by_file_name() {
        let entry = entry?;
        let Ok(name) = entry.path().strip_prefix(folder) else { continue };
        if entry.file_type().is_file() {
            zip.start_file(name.to_string_lossy(), zip::write::SimpleFileOptions::default())?;
            std::io::copy(&mut std::fs::File::open(entry.path())?, &mut zip)?;
        }
    }
    zip.finish()?;
    Ok(())
}

pub(super) fn disk(error: &std::io::Error) -> Fault {
    Fault::new(Text::new(format!("a temporary file: {error}"), format!("一時ファイルの障害: {error}")))
}
