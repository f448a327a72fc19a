//! A run on its way: what is kept, what is graded, what is written at the end.

use crate::batch::changes::Changes;
use crate::batch::journal::{self, FoundJournal, Journal, JournalHeader, JournalRecord, RecordOf};
use crate::batch::progress::ClassProgress;
use crate::batch::resume::{self, NotBegun};
use crate::batch::run::ClassRun;
use crate::batch::shard::Shard;
use crate::batch::{anonymous, json_lines, likeness, summary};
use crate::class::folder::OutputFolder;
use crate::class::formats::ClassFormat;
use crate::class::output::{self, Wants};
use crate::class::page::Pages;
use crate::class::portrait::Portraits;
use crate::class::roll::GradingCandidate;
use crate::class::{Class, ClassEntry, Outcome};
use crate::cli::BatchArguments;
use crate::command::interrupt::Interrupt;
use crate::command::{ExitStatus, report_fault, warn, width};
use crate::fault::Fault;
use crate::grade::Order;
use crate::language::Text;
use crate::likeness::Comparison;
use crate::parallel;
use crate::sandbox::{Pool, Settings};
use reference::Assignment;
use std::collections::{HashMap, HashSet};
use std::io::{IsTerminal, Write};
use std::sync::Arc;
use std::time::Duration;

/// A run on its way.
pub(super) struct BatchSession<'a> {
    pub arguments: &'a BatchArguments,
    pub assignment: &'a Arc<Assignment>,
    pub interrupt: &'a Interrupt,
    pub deadline: Duration,
    pub folder: &'a OutputFolder,
    pub header: &'a JournalHeader,
}

/// What is written of a graded class.
pub(super) struct ClassOutputs<'a> {
    pub formats: &'a [ClassFormat],
    /// Moodle's worksheet.
    pub sheet: Option<&'a [u8]>,
    /// What a teacher may miss.
    pub hint: Option<Text>,
    /// Whose answers are alike.
    pub comparisons: &'a [Comparison],
}

impl BatchSession<'_> {
    fn say(&self, text: &Text) {
        anstream::eprintln!("ggrade: {}", text.get(self.header.language));
    }

    /// The entries that an earlier run has already; none for those that are to be graded.
    pub fn reuse(
        &self,
        candidates: &[GradingCandidate],
        found: Option<FoundJournal>,
        wants: Wants,
    ) -> Result<Vec<Option<ClassEntry>>, NotBegun> {
        let nothing = || candidates.iter().map(|_| None).collect();
        let Some(found) = found else { return Ok(nothing()) };
        let records: HashMap<&str, &JournalRecord> =
            found.records.iter().map(|r| (r.student.key.as_str(), r)).collect();
        let of = |candidate: &GradingCandidate| records.get(candidate.hand_in.student.key.as_str());
        if !records.is_empty() && candidates.iter().all(|candidate| of(candidate).is_none()) {
            return Err(NotBegun::Usage(resume::other_class(self.arguments.out())));
        }
        let keys: HashSet<&str> = candidates.iter().map(|candidate| candidate.hand_in.student.key.as_str()).collect();
        resume::forget(self.folder, &found.records, &keys)?;
        let entries: Vec<Option<ClassEntry>> =
            candidates.iter().map(|candidate| resume::kept(candidate, of(candidate)?, self.folder, wants)).collect();
        let (kept, torn) = (entries.iter().flatten().count(), found.torn);
        let rest = candidates.len() - kept;
        let is_new_file =
            |candidate: &&GradingCandidate| of(candidate).is_some_and(|record| record.sha256 != candidate.sha256);
        let changed = candidates.iter().filter(is_new_file).count();
        self.say(&Text::new(
            format!("going on: {kept} results are kept, {rest} are to come ({changed} changed files, {torn} torn lines)"),
            format!("続きから採点します: 採点済み {kept} 件、残り {rest} 件 (変更されたファイル {changed} 件、途中で切れた行 {torn} 行)"),
        ));
        Ok(entries)
    }

    /// Grades whoever has no entry yet. False where a signal came before everyone had one.
    pub fn fill(
        &self,
        candidates: &[GradingCandidate],
        entries: &mut [Option<ClassEntry>],
        wants: Wants,
        portraits: &Portraits,
    ) -> Result<bool, Fault> {
        let threads = self.arguments.jobs.map_or_else(parallel::processors, usize::from);
        let is_gradable =
            |(candidate, entry): (&GradingCandidate, &Option<ClassEntry>)| entry.is_none() && candidate.is_gradable();
        let pool = match candidates.iter().zip(entries.iter()).any(is_gradable) {
            true => Some(self.pool(threads)?),
            false => None,
        };
        // Where there is nobody to grade, the folder is left as it was.
        let journal = Journal::start(self.folder, self.header, &kept(candidates, entries))?;
        entries.iter().flatten().for_each(|entry| self.tell(entry));
        let pages = Pages::new(Arc::clone(self.assignment), self.header.language);
        let progress = ClassProgress::new(candidates.len(), entries.iter().flatten(), self.header.language);
        self.defer_interrupt(&progress);
        let finished = |entry: &ClassEntry| {
            progress.finished(entry);
            self.tell(entry);
        };
        let run = ClassRun {
            assignment: self.assignment,
            pool: pool.as_ref(),
            order: Order { seed: self.header.seed, hints: self.header.hints, ..Order::default() },
            threads,
            folder: self.folder,
            journal: &journal,
            portraits: wants.portraits.then_some(portraits),
            pages: wants.pages.then_some(&pages),
            finished: &finished,
            stop: self.interrupt.stop(),
        };
        let done = run.grade(candidates, entries);
        progress.clear();
        self.interrupt.resume();
        journal.sync()?;
        done?;
        self.is_complete(entries)
    }

    /// Has the first signal stop the run in order.
    fn defer_interrupt(&self, progress: &ClassProgress) {
        let (bar, language) = (progress.bar(), self.header.language);
        self.interrupt.defer(move || {
            let text = Text::new(
                "stopping after the submissions that are being graded; Ctrl-C again ends at once",
                "採点中のものが終わりしだい停止します。もう一度 Ctrl-C を押すとすぐに終了します",
            );
            bar.suspend(|| anstream::eprintln!("ggrade: {}", text.get(language)));
        });
    }

    /// Whether everyone has an entry; where a signal is why not, says how to go on.
    fn is_complete(&self, entries: &[Option<ClassEntry>]) -> Result<bool, Fault> {
        let (count, total) = (entries.iter().flatten().count(), entries.len());
        if count == total {
            return Ok(true);
        }
        let out = self.arguments.out().display();
        if !self.interrupt.happened() {
            return Err(Fault::new(Text::new(
                format!(
                    "{} submissions were left out by a panic; {count} of {total} results are in {out}",
                    total - count
                ),
                format!(
                    "異常終了のため {} 件を採点できませんでした。{total} 件中 {count} 件の結果が {out} にあります",
                    total - count
                ),
            ))
            .remedy(Text::new("--resume tries them again.", "--resume を付けると再試行します。")));
        }
        self.say(&Text::new(
            format!("stopped: {count} of {total} results are in {out}. The same command with --resume goes on"),
            format!("停止しました。{total} 件中 {count} 件の結果が {out} にあります。同じコマンドに --resume を付けると続きから採点します"),
        ));
        Ok(false)
    }

    fn pool(&self, threads: usize) -> Result<Pool, Fault> {
        let machine = &self.arguments.machine;
        let settings = Settings {
            adapter: machine.adapter,
            deadline: self.deadline,
            ..Settings::new(Arc::clone(self.assignment))
        };
        let pool = Pool::start(self.arguments.sandbox.apply(settings), threads)?;
        warn(&pool, self.header.language);
        Ok(pool)
    }

    /// Tells programs of an entry.
    fn tell(&self, entry: &ClassEntry) {
        if self.arguments.json_lines {
            // A reader that closes the pipe early has what it wanted.
            let _ = std::io::stdout().lock().write_all(json_lines::line(entry, self.header.language).as_bytes());
        }
    }

    /// Writes the results of a shard in order. Its formats are those of the whole class, which it does not know.
    pub fn finish_shard(
        &self,
        shard: Shard,
        candidates: &[GradingCandidate],
        entries: &[ClassEntry],
    ) -> Result<ExitStatus, Fault> {
        self.write_journal(candidates, entries)?;
        let (count, out) = (entries.len(), self.arguments.out().display());
        self.say(&Text::new(
            format!("shard {shard}: {count} results are in {out}. `ggrade batch merge` puts all shards together"),
            format!(
                "分割 {shard}: {count} 件の結果が {out} にあります。全分割が終わったら ggrade batch merge でまとめます"
            ),
        ));
        let has_fault = entries.iter().any(|entry| matches!(entry.outcome, Outcome::Fault(_)));
        Ok(if has_fault { ExitStatus::Fault } else { ExitStatus::FullMarks })
    }

    fn write_journal(&self, candidates: &[GradingCandidate], entries: &[ClassEntry]) -> Result<(), Fault> {
        let records: Vec<_> =
            candidates.iter().zip(entries).map(|(candidate, entry)| RecordOf::new(candidate, &entry.outcome)).collect();
        journal::write(self.folder, self.header, &records)
    }

    /// Writes the class in all formats, and says how it came out.
    pub fn finish(
        &self,
        candidates: &[GradingCandidate],
        class: &Class,
        wanted: &ClassOutputs,
        before: Option<FoundJournal>,
    ) -> Result<ExitStatus, NotBegun> {
        self.write_journal(candidates, &class.entries)?;
        let changes = before.map(|found| Changes::between((found.header, found.records), self.header, class));
        let (mut written, fault) = output::write(class, wanted.formats, wanted.sheet, self.folder);
        let (changed, fault) = match changes.as_ref().map(|changes| changes.write(self.folder)) {
            Some(Ok(file)) => (Some(file), fault),
            Some(Err(other)) => (None, fault.or(Some(other))),
            None => (None, fault),
        };
        let likeness = wanted
            .formats
            .contains(&ClassFormat::Html)
            .then(|| likeness::write(&class.title, wanted.comparisons, self.header.language, self.folder));
        let (likeness, fault) = match likeness {
            Some(Ok(file)) => (file, fault),
            Some(Err(other)) => (None, fault.or(Some(other))),
            None => (None, fault),
        };
        written.files.extend(changed.into_iter().chain(likeness));
        written.notes.extend(wanted.hint.clone());
        let what = Text::new(
            "Every result, for --resume, --compare and programs",
            "全員の結果 (--resume、--compare、プログラム用)",
        );
        written.files.push((journal::NAME.into(), what));
        if self.header.anonymous {
            let what =
                Text::new("The key of the pseudonyms: keep it to yourself", "仮名の鍵。ほかの人に渡さないでください");
            written.files.push((anonymous::KEY_FILE.into(), what));
        }
        let show = |is_terminal| summary::render(class, changes.as_ref(), &written, width(is_terminal));
        // A reader that closes the pipe early, such as `head`, has what it wanted.
        let _ = match self.arguments.json_lines {
            true => anstream::stderr().write_all(show(std::io::stderr().is_terminal()).as_bytes()),
            false => anstream::stdout().write_all(show(std::io::stdout().is_terminal()).as_bytes()),
        };
        if let Some(fault) = fault {
            return Ok(report_fault(&fault));
        }
        Ok(super::outcome(class))
    }
}

/// What there is already, as it is written down.
fn kept<'a>(candidates: &'a [GradingCandidate], entries: &'a [Option<ClassEntry>]) -> Vec<RecordOf<'a>> {
    let pairs = candidates.iter().zip(entries);
    pairs.filter_map(|(candidate, entry)| Some(RecordOf::new(candidate, &entry.as_ref()?.outcome))).collect()
}
