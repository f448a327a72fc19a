//! `ggrade batch`: a class to its reports. [`begin`] looks at what is wanted, [`session`] does it.

mod begin;
mod session;

use super::interrupt::Interrupt;
use super::{ExitStatus, deadline, language};
use crate::batch::resume::{self, NotBegun, ResumeMode};
use crate::batch::shard;
use crate::choice;
use crate::class::Class;
use crate::class::output::{self, OutputOptions};
use crate::class::portrait::Portraits;
use crate::class::roll::{Roll, roll};
use crate::class::standing::Standing;
use crate::cli::{BatchAction, BatchArguments, BatchCommand, MergeArguments};
use crate::fault::Fault;
use crate::intake;
use crate::language::Text;
use session::{BatchSession, ClassOutputs};
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

/// Grades a class, or puts shards together.
pub fn run(arguments: &BatchCommand) -> Result<ExitStatus, Fault> {
    let (arguments, shards) = match &arguments.action {
        Some(BatchAction::Merge(MergeArguments { shards, batch })) => (batch, shards.as_slice()),
        None => (&arguments.batch, &[][..]),
    };
    // Before any thread is started.
    let interrupt = Interrupt::watch()?;
    let Some(deadline) = deadline(arguments.deadline, language(arguments.lang)) else { return Ok(ExitStatus::Usage) };
    match grade(arguments, shards, deadline, &interrupt) {
        Ok(outcome) => Ok(outcome),
        Err(NotBegun::Fault(fault)) => Err(fault),
        Err(NotBegun::Usage(text)) => {
            anstream::eprintln!("ggrade: {}", text.get(language(arguments.lang)));
            Ok(ExitStatus::Usage)
        }
    }
}

fn grade(
    arguments: &BatchArguments,
    shards: &[PathBuf],
    deadline: Duration,
    interrupt: &Interrupt,
) -> Result<ExitStatus, NotBegun> {
    if !shards.is_empty() && (arguments.shard.is_some() || arguments.resume) {
        let text = "`ggrade batch merge` takes neither --shard nor --resume";
        return Err(NotBegun::Usage(Text::new(text, "ggrade batch merge に --shard と --resume は指定できません")));
    }
    let assignment =
        choice::assignment(arguments.machine.assignment.as_deref(), &[]).map_err(NotBegun::Usage)?.assignment;
    begin::outside(arguments)?;
    let sheet = arguments.moodle_worksheet.as_deref().map(begin::read_sheet).transpose()?;
    let before = arguments.compare.as_deref().map(begin::read_earlier).transpose()?;
    let options = intake::IntakeOptions::new(&assignment);
    let intake = intake::read(&arguments.inputs, &options)?;
    if intake.hand_ins.is_empty() {
        begin::tell_empty(&intake, language(arguments.lang));
        return Ok(ExitStatus::Nothing);
    }
    let given = OutputOptions {
        anonymous: arguments.anonymous,
        worksheet: sheet.is_some(),
        moodle: intake.hand_ins.iter().any(|hand_in| hand_in.student.moodle.is_some()),
    };
    let formats = output::choose(&arguments.formats, given).map_err(NotBegun::Usage)?;
    let folder = begin::open(arguments)?;
    let mode = match (arguments.resume, arguments.force) {
        (true, _) => ResumeMode::Resume,
        (_, true) => ResumeMode::Force,
        _ => ResumeMode::New,
    };
    let mut found = resume::earlier(&folder, arguments.out(), mode)?;
    if !shards.is_empty() {
        found = Some(shard::gather(&folder, shards)?);
    }
    let header = begin::header(arguments, &assignment, found.as_ref(), before.as_ref());
    if let Some(found) = &found {
        resume::same_conditions(arguments.out(), &found.header, &header)?;
    }
    let intake = if arguments.anonymous { begin::hide(arguments, intake, &folder, &options.slots)? } else { intake };
    let earlier = match arguments.earlier.is_empty() {
        true => Vec::new(),
        false => intake::read(&arguments.earlier, &options)?.hand_ins,
    };
    let title = arguments.title.clone().unwrap_or(intake.title);
    let Roll { mut candidates, comparisons } = roll(intake.hand_ins, earlier, &assignment);
    if let Some(shard) = arguments.shard {
        candidates = shard.of(candidates);
    }
    let portraits = Portraits::new(&assignment)?;
    let session =
        BatchSession { arguments, assignment: &assignment, interrupt, deadline, folder: &folder, header: &header };
    let wants = output::wants(&formats);
    let mut entries = session.reuse(&candidates, found, wants)?;
    if !session.fill(&candidates, &mut entries, wants, &portraits)? {
        return Ok(ExitStatus::Interrupted);
    }
    if let Some(shard) = arguments.shard {
        let entries: Vec<_> = entries.into_iter().flatten().collect();
        return Ok(session.finish_shard(shard, &candidates, &entries)?);
    }
    let class = Class {
        assignment: Arc::clone(&assignment),
        title: if title.is_empty() { assignment.id.clone() } else { title },
        entries: entries.into_iter().flatten().collect(),
        refused: intake.refused,
        expected_portrait: portraits.expected,
        language: header.language,
    };
    let hint = output::hint(&arguments.formats, given);
    session.finish(
        &candidates,
        &class,
        &ClassOutputs { formats: &formats, sheet: sheet.as_deref(), hint, comparisons: &comparisons },
        before,
    )
}

/// How a graded class ends the program.
fn outcome(class: &Class) -> ExitStatus {
    let has = |wanted: Standing| class.entries.iter().any(|entry| Standing::of(&entry.outcome) == wanted);
    let all = |wanted: Standing| class.entries.iter().all(|entry| Standing::of(&entry.outcome) == wanted);
    if has(Standing::Fault) {
        ExitStatus::Fault
    } else if all(Standing::NotGraded) {
        ExitStatus::Nothing
    } else if all(Standing::Correct) && class.refused.is_empty() {
        ExitStatus::FullMarks
    } else {
        ExitStatus::Graded
    }
}
