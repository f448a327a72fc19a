//! `ggrade batch`: a class to its reports.

use super::interrupt::Interrupt;
use super::{Outcome, deadline, language, report_fault, warn, width};
use crate::batch::anonymous::{self, Pseudonyms};
use crate::batch::changes::Changes;
use crate::batch::class::{Class, Entry};
use crate::batch::folder::{Folder, NotOpened};
use crate::batch::formats::{Format, worksheet};
use crate::batch::intake::{self, Intake};
use crate::batch::journal::{self, Found, Header, Journal, Record, Unreadable};
use crate::batch::output::{self, Given};
use crate::batch::page::Pages;
use crate::batch::portrait::Portraits;
use crate::batch::progress::Progress;
use crate::batch::run::{self, Candidate, Run, Wants};
use crate::batch::standing::Standing;
use crate::batch::start::{self, Mode, NotBegun};
use crate::batch::{lines, summary};
use crate::cli::Batch;
use crate::fault::Fault;
use crate::grade::Order;
use crate::language::{Language, Text};
use crate::parallel;
use crate::report::wrap::plain;
use crate::sandbox::{Pool, Settings};
use reference::Assignment;
use std::collections::{HashMap, HashSet};
use std::io::{IsTerminal, Write};
use std::path::Path;
use std::time::Duration;

/// Grades a class.
pub fn run(arguments: &Batch) -> Result<Outcome, Fault> {
    // Before any thread is started.
    let interrupt = Interrupt::watch()?;
    let Some(deadline) = deadline(arguments.deadline) else { return Ok(Outcome::Usage) };
    match grade(arguments, deadline, &interrupt) {
        Ok(outcome) => Ok(outcome),
        Err(NotBegun::Fault(fault)) => Err(fault),
        Err(NotBegun::Usage(text)) => {
            anstream::eprintln!("ggrade: {}", text.get(language(arguments.lang)));
            Ok(Outcome::Usage)
        }
    }
}

fn grade(arguments: &Batch, deadline: Duration, interrupt: &Interrupt) -> Result<Outcome, NotBegun> {
    let assignment = crate::homework::assignment(&arguments.machine.assignment)?;
    outside(arguments)?;
    let sheet = arguments.moodle_worksheet.as_deref().map(read_sheet).transpose()?;
    let before = arguments.compare.as_deref().map(read_earlier).transpose()?;
    let options = intake::Options::new(assignment)?;
    let intake = intake::read(&arguments.inputs, &options)?;
    if intake.hand_ins.is_empty() {
        tell_empty(&intake, language(arguments.lang));
        return Ok(Outcome::Nothing);
    }
    let given = Given {
        anonymous: arguments.anonymous,
        worksheet: sheet.is_some(),
        moodle: intake.hand_ins.iter().any(|hand_in| hand_in.student.moodle.is_some()),
    };
    let formats = output::choose(&arguments.formats, given).map_err(NotBegun::Usage)?;
    let folder = open(arguments)?;
    let mode = match (arguments.resume, arguments.force) {
        (true, _) => Mode::Resume,
        (_, true) => Mode::Force,
        _ => Mode::New,
    };
    let found = start::earlier(&folder, &arguments.out, mode)?;
    let header = header(arguments, found.as_ref(), before.as_ref());
    let intake = if arguments.anonymous { hide(arguments, intake, &folder, &options.file_name)? } else { intake };
    let title = arguments.title.clone().unwrap_or(intake.title);
    let candidates = run::candidates(intake.hand_ins, assignment);
    let session = Session { arguments, assignment, interrupt, deadline, folder: &folder, header: &header };
    let mut entries = session.reuse(&candidates, found, output::wants(&formats))?;
    if !session.fill(&candidates, &mut entries, output::wants(&formats))? {
        return Ok(Outcome::Interrupted);
    }
    let class = Class {
        assignment: assignment.id.clone(),
        title: if title.is_empty() { assignment.id.clone() } else { title },
        entries: entries.into_iter().flatten().collect(),
        refused: intake.refused,
        expected_portrait: Portraits::new(assignment)?.expected,
        language: header.language,
    };
    session.finish(&candidates, &class, &formats, sheet.as_deref(), before)
}

/// Refuses an output folder that a later run would read as part of the input.
fn outside(arguments: &Batch) -> Result<(), NotBegun> {
    let real = |path: &Path| std::fs::canonicalize(path).ok();
    let absolute = std::path::absolute(&arguments.out).unwrap_or_else(|_| arguments.out.clone());
    // The nearest folder that is there already tells where the others will be.
    let Some(out) = absolute.ancestors().find_map(real) else { return Ok(()) };
    let inside =
        arguments.inputs.iter().find(|input| real(input).is_some_and(|input| input.is_dir() && out.starts_with(input)));
    let Some(input) = inside else { return Ok(()) };
    let (out, input) = (arguments.out.display(), input.display());
    Err(NotBegun::Usage(Text::new(
        format!("--out {out} lies inside the input {input}, and would be handed in with it: name a folder beside it"),
        format!(
            "--out {out} が入力 {input} の中にあり、提出物と混ざってしまいます。入力の外のフォルダを指定してください"
        ),
    )))
}

fn open(arguments: &Batch) -> Result<Folder, NotBegun> {
    Folder::open(&arguments.out).map_err(|error| match error {
        NotOpened::Fault(fault) => NotBegun::Fault(fault),
        NotOpened::InUse => {
            let path = arguments.out.display();
            NotBegun::Usage(Text::new(
                format!("another ggrade is writing into {path}: wait for it, or name another folder"),
                format!("別の ggrade が {path} に書き込んでいます。終わるまで待つか、別のフォルダを指定してください"),
            ))
        }
    })
}

fn usage_unreadable(path: &Path, detail: &str) -> NotBegun {
    let path = path.display();
    NotBegun::Usage(Text::new(format!("cannot read {path}: {detail}"), format!("{path} を読み込めません: {detail}")))
}

/// Moodle's worksheet; one that cannot be filled in is found before anything is graded.
fn read_sheet(path: &Path) -> Result<Vec<u8>, NotBegun> {
    let sheet = std::fs::read(path).map_err(|error| usage_unreadable(path, &error.to_string()))?;
    let nobody = Class {
        assignment: String::new(),
        title: String::new(),
        entries: Vec::new(),
        refused: Vec::new(),
        expected_portrait: Vec::new(),
        language: Language::En,
    };
    worksheet::fill(&nobody, &sheet).map_err(|fault| {
        let path = path.display();
        NotBegun::Usage(Text::new(format!("{path}: {}", fault.message.en), format!("{path}: {}", fault.message.ja)))
    })?;
    Ok(sheet)
}

/// The earlier results to compare with: a journal, or the folder that has it.
fn read_earlier(path: &Path) -> Result<Found, NotBegun> {
    let path = if path.is_dir() { &path.join(journal::NAME) } else { path };
    journal::read(path).map_err(|error| match error {
        Unreadable::Missing => usage_unreadable(path, "no such file"),
        Unreadable::Foreign(text) => NotBegun::Usage(text),
        Unreadable::Fault(fault) => NotBegun::Usage(fault.message),
    })
}

fn tell_empty(intake: &Intake, language: Language) {
    let text = Text::new("there is nothing to grade in the input", "入力に採点するものがありません");
    anstream::eprintln!("ggrade: {}", text.get(language));
    for refused in &intake.refused {
        anstream::eprintln!("  {}: {}", plain(&refused.path), plain(refused.reason.get(language)));
    }
}

/// What this run grades with. A run that goes on keeps what was not asked for otherwise, and one that compares takes the
/// seed: then no difference comes from other probes.
fn header(arguments: &Batch, found: Option<&Found>, before: Option<&Found>) -> Header {
    let earlier = found.map(|found| &found.header);
    let seed = earlier.or(before.map(|before| &before.header)).map(|header| header.seed);
    let seed = arguments.seed.or(seed).unwrap_or_else(crate::grade::random_seed);
    let asked = arguments.lang.or(earlier.map(|header| header.language));
    Header {
        schema: journal::SCHEMA.into(),
        assignment: arguments.machine.assignment.clone(),
        ggrade: env!("CARGO_PKG_VERSION").into(),
        seed,
        hints: arguments.hints,
        deadline: arguments.deadline,
        adapter: arguments.machine.adapter.name().into(),
        language: language(asked),
        anonymous: arguments.anonymous,
    }
}

/// Takes the names away, and writes down whose they were where that is asked for.
fn hide(arguments: &Batch, intake: Intake, folder: &Folder, file: &str) -> Result<Intake, NotBegun> {
    let (intake, named) = Pseudonyms::of(folder)?.hide(intake, file);
    if let Some(path) = &arguments.names {
        let table = anonymous::table(&named)?;
        std::fs::write(path, table).map_err(|error| super::file_fault(&super::writing(), path, &error))?;
    }
    Ok(intake)
}

/// A run on its way.
struct Session<'a> {
    arguments: &'a Batch,
    assignment: &'static Assignment,
    interrupt: &'a Interrupt,
    deadline: Duration,
    folder: &'a Folder,
    header: &'a Header,
}

impl Session<'_> {
    fn say(&self, text: &Text) {
        anstream::eprintln!("ggrade: {}", text.get(self.header.language));
    }

    /// The entries that an earlier run has already; none for those that are to be graded.
    fn reuse(
        &self,
        candidates: &[Candidate],
        found: Option<Found>,
        wants: Wants,
    ) -> Result<Vec<Option<Entry>>, NotBegun> {
        let nothing = || candidates.iter().map(|_| None).collect();
        let Some(found) = found else { return Ok(nothing()) };
        let out = &self.arguments.out;
        let differences = start::differences(&found.header, self.header);
        if !differences.is_empty() {
            return Err(NotBegun::Usage(start::mixed(out, &differences)));
        }
        let records: HashMap<&str, &Record> = found.records.iter().map(|r| (r.student.key.as_str(), r)).collect();
        let of = |candidate: &Candidate| records.get(candidate.hand_in.student.key.as_str());
        if !records.is_empty() && candidates.iter().all(|candidate| of(candidate).is_none()) {
            return Err(NotBegun::Usage(start::other_class(out)));
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
    fn fill(&self, candidates: &[Candidate], entries: &mut [Option<Entry>], wants: Wants) -> Result<bool, Fault> {
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
        let portraits = Portraits::new(self.assignment)?;
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
            portraits: wants.portraits.then_some(&portraits),
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
    fn finish(
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
        Ok(outcome(class))
    }
}

/// How a graded class ends the program.
fn outcome(class: &Class) -> Outcome {
    let has = |wanted: Standing| class.entries.iter().any(|entry| Standing::of(&entry.outcome) == wanted);
    let all = |wanted: Standing| class.entries.iter().all(|entry| Standing::of(&entry.outcome) == wanted);
    if has(Standing::Fault) {
        Outcome::Fault
    } else if all(Standing::NotGraded) {
        Outcome::Nothing
    } else if all(Standing::Correct) && class.refused.is_empty() {
        Outcome::FullMarks
    } else {
        Outcome::Graded
    }
}
