//! Grades what was handed in: all processors busy, each result written as it comes.

use super::class::{AlikeStudent, ClassEntry, Outcome};
use super::content::ContentDigest;
use super::folder::OutputFolder;
use super::intake::{self, StudentWork};
use super::journal::{Journal, JournalRecord, RecordOf};
use super::page::Pages;
use super::portrait::Portraits;
use crate::fault::Fault;
use crate::grade::{self, Order};
use crate::hand_in::HandIn;
use crate::language::Text;
use crate::likeness::{Comparison, Likeness, Pair};
use crate::parallel;
use crate::sandbox::{GradedSubmission, GradingTask, Pool};
use crate::source::{self, Source};
use reference::Assignment;
use std::collections::HashMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

/// A hand-in and what is known of it before it is graded.
#[derive(Debug)]
pub struct GradingCandidate {
    /// Who handed in what.
    pub hand_in: StudentWork,
    /// The hand-in's digest in hexadecimal; none where there is nothing to grade.
    pub sha256: Option<String>,
    /// The files that can be read as text.
    sources: Vec<Source>,
    content: Option<ContentDigest>,
    alike: Vec<AlikeStudent>,
}

/// What was handed in, read, and who is alike.
#[derive(Debug)]
pub struct Roll {
    /// Everyone.
    pub candidates: Vec<GradingCandidate>,
    /// Those whose answers are alike, the most alike first.
    pub comparisons: Vec<Comparison>,
}

/// Most pairs that are shown side by side.
const MOST_COMPARISONS: usize = 200;

/// Reads what was handed in as text, and finds who is alike: of the class, or one of the class and one of an earlier term.
pub fn roll(hand_ins: Vec<StudentWork>, earlier: Vec<StudentWork>, assignment: &Assignment) -> Roll {
    let class = hand_ins.len();
    let mut all: Vec<GradingCandidate> = hand_ins.into_iter().chain(earlier).map(GradingCandidate::new).collect();
    let likeness = Likeness::of(assignment);
    let answers: Vec<_> = all.iter().map(|candidate| likeness.read(&candidate.sources)).collect();
    let pairs = likeness.pairs(&answers, class);
    let called = |place: usize| {
        let student = &all[place].hand_in.student;
        match (place < class, &all[place].hand_in.content) {
            // Of an earlier term, the place of the files says which one it is.
            (false, intake::HandInContent::Files { .. }) => {
                all[place].hand_in.path().unwrap_or_else(|| student.name.clone())
            }
            _ => student.name.clone(),
        }
    };
    let comparison = |pair: &Pair| {
        let (one, other) = pair.places;
        let side = |place: usize| (&answers[place], all[place].sources.as_slice());
        let sides = likeness.compare(side(one), side(other)).into();
        Comparison { pair: pair.clone(), names: [called(one), called(other)], sides }
    };
    let comparisons = pairs.iter().take(MOST_COMPARISONS).map(comparison).collect();
    // Each student's own list begins with who is most alike.
    let keys: Vec<String> = all.iter().map(|candidate| candidate.hand_in.student.key.clone()).collect();
    let names: Vec<String> = (0..all.len()).map(called).collect();
    for pair in &pairs {
        for (place, other) in [pair.places, (pair.places.1, pair.places.0)] {
            let is_earlier = other >= class;
            let key = if is_earlier { names[other].clone() } else { keys[other].clone() };
            all[place].alike.push(AlikeStudent { key, percent: pair.percent(), is_same: pair.is_same, is_earlier });
        }
    }
    all.truncate(class);
    Roll { candidates: all, comparisons }
}

impl GradingCandidate {
    fn new(work: StudentWork) -> Self {
        let none = |hand_in| Self { hand_in, sha256: None, sources: Vec::new(), content: None, alike: Vec::new() };
        let intake::HandInContent::Files { hand_in, .. } = &work.content else { return none(work) };
        let read: Vec<Option<Source>> = hand_in.files.iter().map(source::readable).collect();
        let contents = hand_in.files.iter().zip(&read).map(|(file, source)| match source {
            Some(source) => ContentDigest::of_text(source),
            None => ContentDigest::of_bytes(&file.sha256()),
        });
        let content = ContentDigest::of_all(contents);
        let sha256 = hand_in.sha256();
        Self {
            sha256: Some(sha256),
            sources: read.into_iter().flatten().collect(),
            content: Some(content),
            ..none(work)
        }
    }

    fn files(&self) -> Option<&HandIn> {
        match &self.hand_in.content {
            intake::HandInContent::Files { hand_in, .. } => Some(hand_in),
            intake::HandInContent::Nothing(_) => None,
        }
    }

    /// Why there is nothing to grade.
    pub fn nothing(&self) -> Outcome {
        match &self.hand_in.content {
            intake::HandInContent::Nothing(why) => Outcome::NotGraded(why.clone()),
            intake::HandInContent::Files { .. } => Outcome::NotGraded(Text::default()),
        }
    }

    /// What is written down of it.
    pub fn record<'a>(&'a self, outcome: &'a Outcome) -> RecordOf<'a> {
        RecordOf { student: &self.hand_in.student, path: self.hand_in.path(), sha256: self.sha256.as_deref(), outcome }
    }

    /// The entry of this outcome.
    pub fn entry(&self, outcome: Outcome, portrait: Option<Vec<u8>>, page: Option<PathBuf>) -> ClassEntry {
        let places = match &self.hand_in.content {
            intake::HandInContent::Files { places, .. } => places.clone(),
            intake::HandInContent::Nothing(_) => Vec::new(),
        };
        ClassEntry {
            student: self.hand_in.student.clone(),
            places,
            outcome,
            sources: self.sources.clone(),
            portrait,
            page,
            alike: self.alike.clone(),
        }
    }

    /// The entry by an earlier result, where that is still this hand-in's: the same bytes under the same names, graded,
    /// and with the files that are wanted.
    pub fn reuse(&self, record: &JournalRecord, folder: &OutputFolder, wants: Wants) -> Option<ClassEntry> {
        let Outcome::Graded(report) = &record.outcome else { return None };
        let names = self.files()?.files.iter().map(|file| &file.name);
        if record.sha256 != self.sha256 || !report.sources.iter().map(|source| &source.name).eq(names) {
            return None;
        }
        let key = &self.hand_in.student.key;
        let has_portrait = wants.portraits && report.verdict.is_drawn();
        let portrait = match has_portrait {
            true => Some(folder.read(&portrait_file(key)).ok().flatten()?),
            false => None,
        };
        let page = page_file(key);
        let page = match wants.pages {
            true => Some(folder.has(&page).then(|| folder.at(&page))?),
            false => None,
        };
        Some(self.entry(record.outcome.clone(), portrait, page))
    }

    /// Whether there is something to grade.
    pub fn is_gradable(&self) -> bool {
        self.files().is_some()
    }
}

/// What is wanted of each student besides the report.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Wants {
    /// The small picture.
    pub portraits: bool,
    /// The page.
    pub pages: bool,
}

/// Grades a class.
pub struct ClassRun<'a> {
    /// What is graded.
    pub assignment: &'a Assignment,
    /// Who grades; none where there is no file to grade.
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

/// Where the portrait and the page of a student are, in the output folder.
pub fn portrait_file(key: &str) -> String {
    format!("students/{key}.png")
}

/// See [`portrait_file`].
pub fn page_file(key: &str) -> String {
    format!("students/{key}.html")
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
        self.journal.append(&member.record(outcome))?;
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

/// `indices` with those that need one grading together, in order of the first of each.
pub(super) fn groups(candidates: &[GradingCandidate], indices: &[usize]) -> Vec<Vec<usize>> {
    let mut groups: Vec<Vec<usize>> = Vec::new();
    let mut places: HashMap<&ContentDigest, usize> = HashMap::new();
    for &index in indices {
        let content = candidates[index].content.as_ref();
        match content.and_then(|content| places.get(content)) {
            Some(&place) => groups[place].push(index),
            None => {
                places.extend(content.map(|content| (content, groups.len())));
                groups.push(vec![index]);
            }
        }
    }
    groups
}
