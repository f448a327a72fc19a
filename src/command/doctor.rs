//! `ggrade doctor`: what this machine has, and what to install.

use super::{Outcome, language};
use crate::cli::Doctor;
use crate::fault::Fault;
use crate::grade::Order;
use crate::language::{Language, Text};
use crate::render::AdapterKind;
use crate::report::Verdict;
use crate::sandbox::{Pool, Settings, Submission};
use std::time::Instant;

/// Checks the machine by what it is for: opens the device in a worker, and grades the handed-out file of every homework.
pub fn run(arguments: &Doctor) -> Result<Outcome, Fault> {
    let language = language(arguments.lang);
    let mut healthy = true;
    for assignment in reference::assignments() {
        healthy &= check_assignment(assignment, language);
    }
    let gpu = crate::render::Device::open(AdapterKind::Gpu);
    let gpu = match gpu {
        Ok(device) => Text::new(
            format!("graphics card: {} ({}), used with --adapter gpu", device.renderer, device.driver),
            format!("グラフィックスカード: {} ({})。--adapter gpu で使えます", device.renderer, device.driver),
        ),
        Err(_) => {
            Text::new("graphics card: none (none is needed)", "グラフィックスカード: なし (なくても採点できます)")
        }
    };
    say(true, &gpu, language);
    Ok(if healthy { Outcome::FullMarks } else { Outcome::Fault })
}

/// Grades the handed-out file, which every homework has, and says how that went.
fn check_assignment(assignment: &reference::Assignment, language: Language) -> bool {
    let start = Instant::now();
    let pool = match Pool::start(Settings::new(&assignment.id), 1) {
        Ok(pool) => pool,
        Err(fault) => return complain(&fault, language),
    };
    let warm = start.elapsed();
    let file = &assignment.files[0];
    let submission =
        Submission { name: &file.name, bytes: file.starter.as_bytes(), order: Order::default(), wants_frames: false };
    let start = Instant::now();
    match pool.grade(submission) {
        Ok(answer) if answer.report.verdict == Verdict::Wrong => {
            let environment = &answer.report.environment;
            let driver = Text::verbatim(format!("Vulkan: {} ({})", environment.renderer, environment.driver));
            say(true, &driver, language);
            let (warm, graded) = (warm.as_millis(), start.elapsed().as_millis());
            let text = Text::new(
                format!(
                    "{}: a worker is ready in {warm} ms and grades the handed-out file in {graded} ms",
                    assignment.id
                ),
                format!("{}: ワーカの準備に {warm} ms、配布ファイルの採点に {graded} ms", assignment.id),
            );
            say(true, &text, language);
            true
        }
        Ok(answer) => {
            let text = Text::new(
                format!("{}: the handed-out file got the verdict {:?}", assignment.id, answer.report.verdict),
                format!("{}: 配布ファイルの判定が {:?} になりました", assignment.id, answer.report.verdict),
            );
            say(false, &text, language);
            false
        }
        Err(fault) => complain(&fault, language),
    }
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
