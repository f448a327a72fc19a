//! `ggrade doctor`: what this machine has, and what to install.

mod installation;

use super::{ExitStatus, language};
use crate::choice;
use crate::cli::DoctorArguments;
use crate::fault::Fault;
use crate::grade::Order;
use crate::language::{Language, Text};
use crate::render::AdapterKind;
use crate::report::{Environment, Report, Verdict};
use crate::sandbox::{GradingTask, Policy, Pool, Settings};
use crate::slots::handed_out;
use installation::Installation;
use reference::Assignment;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

/// Checks the machine by what it is for: opens the device in a worker, and grades the handed-out file of every homework.
pub fn run(arguments: &DoctorArguments) -> Result<ExitStatus, Fault> {
    let language = language(arguments.lang);
    let program = std::env::current_exe().unwrap_or_default();
    let installation = Installation::of(&program, Path::new("/"));
    let what = installation.description();
    let head = format!("ggrade {} ({})", env!("CARGO_PKG_VERSION"), program.display());
    say(true, &Text::new(format!("{head}: {}", what.en), format!("{head}: {}", what.ja)), language);
    let (mut healthy, mut said) = match check_worker(language) {
        Ok(closed) => (closed, None),
        Err(fault) => (complain(&fault, language), Some(fault.message)),
    };
    for assignment in reference::assignments() {
        match check_assignment(assignment, language) {
            Ok(is_right) => healthy &= is_right,
            // What the machine lacks, every homework lacks: it is said once.
            Err(fault) if said.as_ref() == Some(&fault.message) => healthy = false,
            Err(fault) => {
                healthy = complain(&fault, language);
                said = Some(fault.message);
            }
        }
    }
    let gpu = Settings { adapter: AdapterKind::Gpu, ..settings(choice::default()) };
    let gpu = match Pool::start(gpu, 1) {
        Ok(pool) => {
            let Environment { renderer, driver, .. } = pool.environment();
            Text::new(
                format!("graphics card: {renderer} ({driver}), used with --adapter gpu"),
                format!("グラフィックスカード: {renderer} ({driver})。--adapter gpu で使えます"),
            )
        }
        _ => Text::new("graphics card: none (none is needed)", "グラフィックスカード: なし (なくても採点できます)"),
    };
    say(true, &gpu, language);
    #[cfg(feature = "service")]
    check_https(language);
    if !healthy {
        anstream::println!("     {}", installation.remedy().get(language));
    }
    Ok(if healthy { ExitStatus::FullMarks } else { ExitStatus::Fault })
}

/// Gradings on this machine, whatever the sandbox lacks: that is said once, and apart.
fn settings(assignment: &Arc<Assignment>) -> Settings {
    Settings { policy: Policy::BestEffort, ..Settings::new(Arc::clone(assignment)).for_one_grading() }
}

/// Says of each layer of the sandbox whether it holds, what a worker could do in spite of all, and what it draws with.
fn check_worker(language: Language) -> Result<bool, Fault> {
    let pool = Pool::start(settings(choice::default()), 1)?;
    let protection = pool.protection();
    for state in &protection.layers {
        let name = state.layer.name();
        let en = format!("sandbox, {}: {}", name.en, state.detail);
        let word = if state.holds { "ok  " } else { "lack" };
        let text = Text::new(en, format!("サンドボックス、{}: {}", name.ja, state.detail));
        anstream::println!("{word} {}", text.get(language));
    }
    let text = match protection.notice().filter(|_| !protection.is_closed()) {
        None => Text::new(
            "sandbox: a grading process can open no file, make no socket and start no program",
            "サンドボックス: 採点プロセスは、ファイルを開くことも、ソケットを作ることも、プログラムを起動することもできません",
        ),
        Some(notice) => Text::new(
            format!("sandbox: {}. Only --sandbox best-effort grades here", notice.en),
            format!("サンドボックス: {}。--sandbox best-effort を付けないと採点できません", notice.ja),
        ),
    };
    say(protection.is_closed(), &text, language);
    let Environment { renderer, driver, .. } = pool.environment();
    say(true, &Text::verbatim(format!("Vulkan: {renderer} ({driver})")), language);
    Ok(protection.is_closed())
}

/// Grades the handed-out file, which every homework has, and says how that went.
fn check_assignment(assignment: &Arc<Assignment>, language: Language) -> Result<bool, Fault> {
    let start = Instant::now();
    let pool = Pool::start(settings(assignment), 1)?;
    pool.warm()?;
    let warm = start.elapsed();
    let hand_in = handed_out(assignment);
    let submission = GradingTask { assignment, hand_in: &hand_in, order: Order::default(), wants_frames: false };
    let start = Instant::now();
    let Report { verdict, .. } = pool.grade(submission)?.report;
    let is_right = verdict == Verdict::Wrong;
    let id = &assignment.id;
    let text = if is_right {
        let (warm, graded) = (warm.as_millis(), start.elapsed().as_millis());
        Text::new(
            format!("{id}: a worker is ready in {warm} ms and grades the handed-out file in {graded} ms"),
            format!("{id}: ワーカの準備に {warm} ms、配布ファイルの採点に {graded} ms"),
        )
    } else {
        Text::new(
            format!("{id}: the handed-out file got the verdict {verdict:?}"),
            format!("{id}: 配布ファイルの判定が {verdict:?} になりました"),
        )
    };
    say(is_right, &text, language);
    Ok(is_right)
}

/// Says whether the service could ask learning platforms and issuers; nothing else needs https.
#[cfg(feature = "service")]
fn check_https(language: Language) {
    let (word, text) = match crate::service::clients::https() {
        Ok(_) => {
            ("ok  ", Text::new("https: the certificates of authorities are there", "https: 認証局の証明書があります"))
        }
        Err(failure) => (
            "lack",
            Text::new(
                format!("https: {failure}. Only LTI and signing in by OpenID Connect need it"),
                format!("https: {failure} (必要なのは LTI と OpenID Connect によるログインだけです)"),
            ),
        ),
    };
    anstream::println!("{word} {}", text.get(language));
}

fn complain(fault: &Fault, language: Language) -> bool {
    say(false, &fault.message, language);
    if let Some(remedy) = &fault.remedy {
        anstream::println!("     {}", remedy.get(language));
    }
    false
}

fn say(good: bool, text: &Text, language: Language) {
    anstream::println!("{} {}", if good { "ok  " } else { "FAIL" }, text.get(language));
}
