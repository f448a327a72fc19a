//! Grades what was handed in: all processors busy, each result written as it comes.

use super::journal::{Journal, RecordOf};
use crate::class::folder::{OutputFolder, page_file, portrait_file};
use crate::class::page::Pages;
use crate::class::portrait::Portraits;
use crate::class::roll::{GradingCandidate, groups};
use crate::class::{ClassEntry, Outcome};
use crate::fault::Fault;
use crate::grade::{self, Order};
use crate::language::Text;
use crate::parallel;
use crate::sandbox::{GradedSubmission, GradingTask, Pool};
use reference::Assignment;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

/// Grades a class.
pub struct ClassRun<'a> {
    /// What is graded.
    pub assignment: &'a Assignment,
    /// Who grades; `None` where there is no file to grade.
    pub pool: Option<&'a Pool>,
    /// How.
    pub order: Order,
    /// How many at once.
    pub threads: usize,
    /// Where results are written.
    pub folder: &'a OutputFolder,
    /// Where each is written down.
    pub journal: &'a Journal,
    /// The pictures of students' shaders, where they are wanted.
    pub portraits: Option<&'a Portraits>,
    /// Students' pages, where they are wanted.
    pub pages: Option<&'a Pages>,
    /// Told of each entry that is finished.
    pub finished: &'a (dyn Fn(&ClassEntry) + Sync),
    /// Set to have no further submission begun.
    pub stop: &'a AtomicBool,
}

impl ClassRun<'_> {
    /// Grades everyone whose entry is not there yet, and puts it there. A fault is one that ends the run: a result
    /// cannot be written. Those that were not begun before the stop keep no entry.
    pub fn grade(&self, candidates: &[GradingCandidate], entries: &mut [Option<ClassEntry>]) -> Result<(), Fault> {
        let missing: Vec<usize> = (0..candidates.len()).filter(|&index| entries[index].is_none()).collect();
        let groups = groups(candidates, &missing);
        let failure: Mutex<Option<Fault>> = Mutex::new(None);
        let results = parallel::map(&groups, self.threads, self.stop, |group| {
            self.group(candidates, group).unwrap_or_else(|fault| {
                self.stop.store(true, Ordering::Relaxed);
                failure.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(fault);
                Vec::new()
            })
        });
        for (group, graded) in groups.iter().zip(results) {
            for (&index, entry) in group.iter().zip(graded.into_iter().flatten()) {
                entries[index] = Some(entry);
            }
        }
        failure.into_inner().unwrap_or_else(PoisonError::into_inner).map_or(Ok(()), Err)
    }

    /// Grades hand-ins that are the same, once, and gives each student an entry.
    fn group(&self, candidates: &[GradingCandidate], group: &[usize]) -> Result<Vec<ClassEntry>, Fault> {
        let members: Vec<&GradingCandidate> = group.iter().map(|&index| &candidates[index]).collect();
        let first = members.first().and_then(|first| first.files());
        let Some((hand_in, pool)) = first.zip(self.pool) else {
            return members
                .into_iter()
                .map(|member| self.finish(member, &ShownFile::without(member.nothing())))
                .collect();
        };
        let wants_frames = self.portraits.is_some() || self.pages.is_some();
        let assignment = pool.assignment();
        let mut answer = guarded(|| pool.grade(GradingTask { assignment, hand_in, order: self.order, wants_frames }));
        let mut entries: Vec<ClassEntry> = Vec::with_capacity(members.len());
        let mut last: Option<ShownFile> = None;
        for member in members {
            let judged = match &mut answer {
                Ok(answer) => guarded(|| self.show(answer, member, last.take())),
                Err(fault) => Err(fault.clone()),
            };
            let judged = judged.unwrap_or_else(|fault| ShownFile::without(Outcome::Fault(fault)));
            entries.push(self.finish(member, &judged)?);
            last = Some(judged);
        }
        Ok(entries)
    }

    /// What is shown of one of the hand-ins that the answer is for; `last` is what was shown of the one before.
    fn show(
        &self,
        answer: &mut GradedSubmission,
        member: &GradingCandidate,
        last: Option<ShownFile>,
    ) -> Result<ShownFile, Fault> {
        let Some(hand_in) = member.files() else { return Ok(ShownFile::without(member.nothing())) };
        // Names, sizes and line ends are each one's own.
        let sources = grade::sources(self.assignment, hand_in);
        if let Some(last) = last
            && answer.report.sources == sources
        {
            return Ok(last);
        }
        answer.report.of_files(sources);
        let portrait = self.portraits.map(|portraits| portraits.of(&answer.frames)).transpose()?.flatten();
        let page = self.pages.map(|pages| pages.page(&answer.report, &member.sources, &answer.frames)).transpose()?;
        Ok(ShownFile { outcome: Outcome::Graded(Box::new(answer.report.clone())), portrait, page })
    }

    /// Writes down what became of a hand-in.
    fn finish(&self, member: &GradingCandidate, judged: &ShownFile) -> Result<ClassEntry, Fault> {
        let ShownFile { outcome, portrait, page } = judged;
        let key = &member.hand_in.student.key;
        if let Some(portrait) = portrait {
            self.folder.write(&portrait_file(key), portrait)?;
        }
        let page = page.as_ref().map(|page| self.folder.write(&page_file(key), page.as_bytes())).transpose()?;
        // Last: a result that is written down has its files.
        self.journal.append(&RecordOf::new(member, outcome))?;
        let entry = member.entry(outcome.clone(), portrait.clone(), page);
        (self.finished)(&entry);
        Ok(entry)
    }
}

/// What is shown of a file.
struct ShownFile {
    outcome: Outcome,
    portrait: Option<Vec<u8>>,
    page: Option<String>,
}

impl ShownFile {
    fn without(outcome: Outcome) -> Self {
        Self { outcome, portrait: None, page: None }
    }
}

/// A panic in the work for one file is a fault of ours, and no reason to leave the others.
fn guarded<T>(work: impl FnOnce() -> Result<T, Fault>) -> Result<T, Fault> {
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|_| {
        Err(Fault::new(Text::new("grading this file panicked", "このファイルの採点中に異常終了しました")))
    })
}
