//! A run on its way: what is kept, what is graded, what is written at the end.

use crate::batch::changes::Changes;
use crate::batch::class::{Class, Entry};
use crate::batch::folder::Folder;
use crate::batch::formats::Format;
use crate::batch::journal::{self, Found, Header, Journal, Record};
use crate::batch::page::Pages;
use crate::batch::portrait::Portraits;
use crate::batch::progress::Progress;
use crate::batch::run::{Candidate, Run, Wants};
use crate::batch::start::{self, NotBegun};
use crate::batch::{lines, output, summary};
use crate::cli::Batch;
use crate::command::interrupt::Interrupt;
use crate::command::{Outcome, report_fault, warn, width};
use crate::fault::Fault;
use crate::grade::Order;
use crate::language::Text;
use crate::parallel;
use crate::sandbox::{Pool, Settings};
use reference::Assignment;
use std::collections::{HashMap, HashSet};
use std::io::{IsTerminal, Write};
use std::time::Duration;

/// A run on its way.
pub(super) struct Session<'a> {
    pub arguments: &'a Batch,
    pub assignment: &'static Assignment,
    pub interrupt: &'a Interrupt,
    pub deadline: Duration,
    pub folder: &'a Folder,
    pub header: &'a Header,
}

impl Session<'_> {
    fn say(&self, text: &Text) {
        anstream::eprintln!("ggrade: {}", text.get(self.header.language));
    }

    /// The entries that an earlier run has already; none for those that are to be graded.
    pub fn reuse(
        &self,
        candidates: &[Candidate],
        found: Option<Found>,
        wants: Wants,
    ) -> Result<Vec<Option<Entry>>, NotBegun> {
        let nothing = || candidates.iter().map(|_| None).collect();
        let Some(found) = found else { return Ok(nothing()) };
        let records: HashMap<&str, &Record> = found.records.iter().map(|r| (r.student.key.as_str(), r)).collect();
        let of = |candidate: &Candidate| records.get(candidate.hand_in.student.key.as_str());
        if !records.is_empty() && candidates.iter().all(|candidate| of(candidate).is_none()) {
            return Err(NotBegun::Usage(start::other_class(&self.arguments.out)));
        }
        let keys: HashSet<&str> = candidates.iter().map(|candidate| candidate.hand_in.student.key.as_str()).collect();
        start::forget(self.folder, &found.records, &keys)?;
        let entries: Vec<Option<Entry>> =
            candidates.iter().map(|candidate| candidate.reuse(of(candidate)?, self.folder, wants)).collect();
        let (kept, torn) = (entries.iter().flatten().count(), found.torn);
        let rest = candidates.len() - kept;
        let is_new_file =
            |candidate: &&Candidate| of(candidate).is_some_and(|record| record.sha256 != candidate.sha256);
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
        candidates: &[Candidate],
        entries: &mut [Option<Entry>],
        wants: Wants,
        portraits: &Portraits,
    ) -> Result<bool, Fault> {
        let language = self.header.language;
        let kept: Vec<_> = candidates
            .iter()
            .zip(entries.iter())
            .filter_map(|(candidate, entry)| Some(candidate.record(&entry.as_ref()?.outcome)))
            .collect();
        let journal = Journal::start(self.folder, self.header, &kept)?;
        drop(kept);
        for entry in entries.iter().flatten() {
            self.tell(entry);
        }
        if entries.iter().all(Option::is_some) {
            return Ok(true);
        }
        let threads = self.arguments.jobs.map_or_else(parallel::processors, usize::from);
        let pages = Pages::new(self.assignment, language);
        let is_gradable = |(candidate, entry): (&Candidate, &Option<Entry>)| entry.is_none() && candidate.has_file();
        let pool = match candidates.iter().zip(entries.iter()).any(is_gradable) {
            true => Some(self.pool(threads)?),
            false => None,
        };
        let progress = Progress::new(candidates.len(), entries.iter().flatten(), language);
        let bar = progress.bar();
        self.interrupt.defer(move || {
            let text = Text::new(
                "stopping after the submissions that are being graded; Ctrl-C again ends at once",
                "採点中のものが終わりしだい停止します。もう一度 Ctrl-C を押すとすぐに終了します",
            );
            bar.suspend(|| anstream::eprintln!("ggrade: {}", text.get(language)));
        });
        let finished = |entry: &Entry| {
            progress.finished(entry);
            self.tell(entry);
        };
        let run = Run {
            pool: pool.as_ref(),
            order: Order { seed: self.header.seed, hints: self.header.hints },
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
        let count = entries.iter().flatten().count();
        if self.interrupt.happened() && count < entries.len() {
            let (out, total) = (self.arguments.out.display(), entries.len());
            self.say(&Text::new(
                format!("stopped: {count} of {total} results are in {out}. The same command with --resume goes on"),
                format!("停止しました。{total} 件中 {count} 件の結果が {out} にあります。同じコマンドに --resume を付けると続きから採点します"),
            ));
            return Ok(false);
        }
        Ok(true)
    }

    fn pool(&self, threads: usize) -> Result<Pool, Fault> {
        let machine = &self.arguments.machine;
        let settings =
            Settings { adapter: machine.adapter, deadline: self.deadline, ..Settings::new(&machine.assignment) };
        let pool = Pool::start(self.arguments.sandbox.apply(settings), threads)?;
        warn(&pool, self.header.language);
        Ok(pool)
    }

    /// Tells programs of an entry.
    fn tell(&self, entry: &Entry) {
        if self.arguments.json_lines {
            // A reader that closes the pipe early has what it wanted.
            let _ = std::io::stdout().lock().write_all(lines::line(entry, self.header.language).as_bytes());
        }
    }

    /// Writes the class in all formats, and says how it came out.
    pub fn finish(
        &self,
        candidates: &[Candidate],
        class: &Class,
        formats: &[Format],
        sheet: Option<&[u8]>,
        before: Option<Found>,
    ) -> Result<Outcome, NotBegun> {
        let records: Vec<_> =
            candidates.iter().zip(&class.entries).map(|(candidate, entry)| candidate.record(&entry.outcome)).collect();
        journal::write(self.folder, self.header, &records)?;
        let changes = before.map(|found| Changes::between((found.header, found.records), self.header, class));
        let (mut written, fault) = output::write(class, formats, sheet, changes.as_ref(), self.folder);
        let what = Text::new(
            "Every result, for --resume, --compare and programs",
            "全員の結果 (--resume、--compare、プログラム用)",
        );
        written.files.push((self.folder.at(journal::NAME).display().to_string(), what));
        if self.arguments.json_lines {
            let text = summary::render(class, changes.as_ref(), &written, width(std::io::stderr().is_terminal()));
            anstream::eprint!("{text}");
        } else {
            let text = summary::render(class, changes.as_ref(), &written, width(std::io::stdout().is_terminal()));
            anstream::print!("{text}");
        }
        if let Some(fault) = fault {
            return Ok(report_fault(&fault));
        }
        Ok(super::outcome(class))
    }
}
