//! What is looked at before anything is graded.

use crate::batch::anonymous::{self, Pseudonyms};
use crate::batch::journal::{self, FoundJournal, JournalHeader, UnreadableJournal};
use crate::batch::resume::NotBegun;
use crate::class::folder::{NotOpened, OutputFolder};
use crate::class::formats::worksheet;
use crate::cli::BatchArguments;
use crate::command::{file_fault, language, writing};
use crate::intake::Intake;
use crate::language::{Language, Text};
use crate::report::wrap::plain;
use crate::slots::Slot;
use reference::Assignment;
use std::path::Path;

/// Refuses an output folder that a later run would read as part of the input.
pub(super) fn outside(arguments: &BatchArguments) -> Result<(), NotBegun> {
    let real = |path: &Path| std::fs::canonicalize(path).ok();
    let absolute = std::path::absolute(arguments.out()).unwrap_or_else(|_| arguments.out().to_owned());
    // The nearest folder that is there already tells where the others will be.
    let Some(out) = absolute.ancestors().find_map(real) else { return Ok(()) };
    let inside =
        arguments.inputs.iter().find(|input| real(input).is_some_and(|input| input.is_dir() && out.starts_with(input)));
    let Some(input) = inside else { return Ok(()) };
    let (out, input) = (arguments.out().display(), input.display());
    Err(NotBegun::Usage(Text::new(
        format!("--out {out} lies inside the input {input}, and would be handed in with it: name a folder beside it"),
        format!(
            "--out {out} が入力 {input} の中にあり、提出物と混ざってしまいます。入力の外のフォルダを指定してください"
        ),
    )))
}

pub(super) fn open(arguments: &BatchArguments) -> Result<OutputFolder, NotBegun> {
    OutputFolder::open(arguments.out()).map_err(|error| match error {
        NotOpened::Fault(fault) => NotBegun::Fault(fault),
        NotOpened::InUse => {
            let path = arguments.out().display();
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
pub(super) fn read_sheet(path: &Path) -> Result<Vec<u8>, NotBegun> {
    let sheet = std::fs::read(path).map_err(|error| usage_unreadable(path, &error.to_string()))?;
    worksheet::check(&sheet).map_err(|fault| {
        let path = path.display();
        NotBegun::Usage(Text::new(format!("{path}: {}", fault.message.en), format!("{path}: {}", fault.message.ja)))
    })?;
    Ok(sheet)
}

/// The earlier results to compare with: a journal, or the folder that has it.
pub(super) fn read_earlier(path: &Path) -> Result<FoundJournal, NotBegun> {
    let path = if path.is_dir() { &path.join(journal::NAME) } else { path };
    journal::read(path).map_err(|error| match error {
        UnreadableJournal::Missing => usage_unreadable(path, "no such file"),
        UnreadableJournal::Foreign(text) => NotBegun::Usage(text),
        UnreadableJournal::Fault(fault) => NotBegun::Usage(fault.message),
    })
}

pub(super) fn tell_empty(intake: &Intake, language: Language) {
    let text = Text::new("there is nothing to grade in the input", "入力に採点するものがありません");
    anstream::eprintln!("ggrade: {}", text.get(language));
    for refused in &intake.refused {
        anstream::eprintln!("  {}: {}", plain(&refused.path), plain(refused.reason.get(language)));
    }
}

/// What this run grades with. A run that goes on keeps what was not asked for otherwise, and one that compares takes the
/// seed: then the fresh probes are the same ones.
pub(super) fn header(
    arguments: &BatchArguments,
    assignment: &Assignment,
    found: Option<&FoundJournal>,
    before: Option<&FoundJournal>,
) -> JournalHeader {
    let earlier = found.map(|found| &found.header);
    let seed = earlier.or(before.map(|before| &before.header)).map(|header| header.seed);
    let seed = arguments.seed.or(seed).unwrap_or_else(crate::grade::random_seed);
    let asked = arguments.lang.or(earlier.map(|header| header.language));
    JournalHeader {
        schema: journal::SCHEMA.into(),
        assignment: assignment.id.clone(),
        assignment_digest: assignment.digest.clone(),
        ggrade: env!("CARGO_PKG_VERSION").into(),
        seed,
        hints: arguments.hints,
        deadline: arguments.deadline,
        adapter: arguments.machine.adapter.name().into(),
        language: language(asked),
        anonymous: arguments.anonymous,
        shard: arguments.shard,
    }
}

/// Takes the names away, and writes down whose they were where that is asked for.
pub(super) fn hide(
    arguments: &BatchArguments,
    intake: Intake,
    folder: &OutputFolder,
    slots: &[Slot],
) -> Result<Intake, NotBegun> {
    let (intake, named) = Pseudonyms::of(folder)?.hide(intake, slots);
    if let Some(path) = &arguments.names {
        let table = anonymous::table(&named)?;
        std::fs::write(path, table).map_err(|error| file_fault(&writing(), path, &error))?;
    }
    Ok(intake)
}
