//! Downloads that take seconds: made in the background, kept on the disk for a while.

use super::download::{Download, DownloadOptions, DownloadSelection, Steps, archive, download};
use crate::language::{Language, Text};
use crate::service::State;
use crate::service::blocking::aside;
use crate::service::errors::Problem;
use crate::service::identity::new_id;
use crate::service::store::Progress;
use std::collections::VecDeque;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use tempfile::TempPath;

/// Downloads that are kept; the next one takes the place of the oldest.
const MOST: usize = 8;

/// A download that is being made, or is there.
#[derive(Debug)]
pub struct DownloadJob {
    /// Its id.
    pub id: String,
    /// Id of the homework whose class it is of.
    pub assignment: String,
    /// What it is.
    pub what: Text,
    /// Whether it is the archive of the term.
    pub is_archive: bool,
    /// The page of the class that it is of.
    pub back: String,
    steps: Arc<Steps>,
    made: OnceLock<Result<Made, Problem>>,
}

/// A file to be saved, on the disk until it is forgotten.
#[derive(Debug)]
pub struct Made {
    /// Its name.
    pub name: String,
    /// Where it is.
    pub path: TempPath,
    /// Its size in bytes.
    pub bytes: usize,
    /// What a teacher should know of it.
    pub notes: Vec<Text>,
}

impl DownloadJob {
    /// How far it is.
    pub fn progress(&self) -> Progress {
        let (done, files) = self.steps.get();
        // The last step is the file itself.
        let graded = if self.made.get().is_some() { files } else { done.min(files - 1) };
        let count = |steps: usize| steps as u64;
        Progress { entries: count(files), files: count(files), graded: count(graded), failed: 0 }
    }

    /// The file, or why there is none, where that is known.
    pub fn made(&self) -> Option<&Result<Made, Problem>> {
        self.made.get()
    }
}

/// The downloads made lately.
#[derive(Debug, Default)]
pub struct Jobs(Mutex<VecDeque<Arc<DownloadJob>>>);

impl Jobs {
    /// The download with this id.
    pub fn get(&self, id: &str) -> Option<Arc<DownloadJob>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).iter().find(|job| job.id == id).cloned()
    }

    /// Begins to make one of a homework's class.
    pub fn start(
        &self,
        state: &State,
        whose: DownloadSelection,
        wanted: DownloadOptions,
        back: String,
    ) -> Arc<DownloadJob> {
        let of = state.clone();
        let what = wanted.format.description();
        self.begin(state, (what, false), back, |steps| async move { make(&of, whose, wanted, &steps).await })
    }

    /// Begins to make the archive of the term; it is looked for at the pages of this homework.
    pub fn archive(&self, state: &State, language: Language, back: String) -> Arc<DownloadJob> {
        let service = state.service().clone();
        let what = Text::new("The term as one file", "学期全体のアーカイブ");
        self.begin(state, (what, true), back, |steps| async move { archive(&service, language, &steps).await })
    }

    fn begin<F, M>(&self, state: &State, (what, is_archive): (Text, bool), back: String, making: M) -> Arc<DownloadJob>
    where
        M: FnOnce(Arc<Steps>) -> F,
        F: Future<Output = Result<Made, Problem>> + Send + 'static,
    {
        let (id, steps, made) = (new_id(), Arc::<Steps>::default(), OnceLock::new());
        let making = making(Arc::clone(&steps));
        let job =
            Arc::new(DownloadJob { id, assignment: state.assignment.id.clone(), what, is_archive, back, steps, made });
        let mut jobs = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        jobs.truncate(MOST - 1);
        jobs.push_front(Arc::clone(&job));
        drop(jobs);
        let begun = Arc::clone(&job);
        tokio::spawn(async move {
            // Nobody else sets it.
            let _ = begun.made.set(making.await);
        });
        job
    }
}

async fn make(
    state: &State,
    whose: DownloadSelection,
    wanted: DownloadOptions,
    steps: &Arc<Steps>,
) -> Result<Made, Problem> {
    let Download { name, bytes: content, notes } = download(state, whose, wanted, steps).await?;
    let bytes = content.len();
    let path = aside(move || {
        let path = tempfile::NamedTempFile::new()?.into_temp_path();
        std::fs::write(&path, content)?;
        std::io::Result::Ok(path)
    });
    let path = path.await?.map_err(|error| Problem::internal(&error))?;
    Ok(Made { name, path, bytes, notes })
}
