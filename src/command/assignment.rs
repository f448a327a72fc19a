//! `ggrade assignment`: what assignments there are, and whether one is whole.

use super::{Outcome, language, warn};
use crate::cli::{Action, Assignment as Arguments, Check};
use crate::fault::Fault;
use crate::grade::{self, Order};
use crate::hand_in::{HandIn, HandedInFile};
use crate::language::{Language, Text};
use crate::report::{Report, Verdict};
use crate::sandbox::{Pool, Settings, Submission};
use reference::Assignment;
use std::sync::Arc;

/// Does what is asked.
pub fn run(arguments: &Arguments) -> Result<Outcome, Fault> {
    let language = language(arguments.lang);
    match &arguments.action {
        Action::List => {
            reference::assignments().for_each(|assignment| list(assignment, language));
            Ok(Outcome::FullMarks)
        }
        Action::Check(check) => run_check(check, language),
    }
}

fn list(assignment: &Assignment, language: Language) {
    let files: Vec<_> = assignment.files.iter().map(|file| file.name.as_str()).collect();
    let title = Text::new(&assignment.title.en, &assignment.title.ja);
    anstream::println!("{}  {}  {}", assignment.id, files.join(", "), title.get(language));
}

fn run_check(arguments: &Check, language: Language) -> Result<Outcome, Fault> {
    let Some(assignment) = super::assignment(Some(&arguments.assignment), &[], language) else {
        return Ok(Outcome::Usage);
    };
    list(&assignment, language);
    let settings = Settings {
        adapter: arguments.adapter,
        policy: arguments.sandbox,
        spares: 0,
        warm_up: false,
        ..Settings::new(Arc::clone(&assignment))
    };
    let pool = Pool::start(settings, 1)?;
    warn(&pool, language);
    let grade = |hand_in: &HandIn| {
        let assignment = pool.assignment();
        let answer = pool.grade(Submission { assignment, hand_in, order: Order::default(), wants_frames: false });
        answer.map(|answer| answer.report)
    };
    let solution = assignment.files.iter().map(|file| HandedInFile::new(&file.name, file.solution.text.as_bytes()));
    let solution = grade(&HandIn { files: solution.collect() })?;
    let starter = grade(&grade::handed_out(&assignment))?;
    let is_right = solution.verdict == Verdict::Correct;
    say(is_right, &scored("the solution", "解答", &solution), language);
    for diagnostic in solution.diagnostics.iter().filter(|_| !is_right) {
        anstream::println!("     {}", diagnostic.message.get(language));
    }
    let is_unfinished = starter.verdict == Verdict::Wrong;
    say(is_unfinished, &scored("what is handed out", "配布ファイル", &starter), language);
    let digest = Text::new(format!("digest: {}", assignment.digest), format!("ダイジェスト: {}", assignment.digest));
    say(true, &digest, language);
    Ok(if is_right && is_unfinished { Outcome::FullMarks } else { Outcome::Usage })
}

/// What one of the folder's own files has.
fn scored(en: &str, ja: &str, report: &Report) -> Text {
    let Report { verdict, score, max_score, .. } = report;
    Text::new(
        format!("{en}: {verdict:?}, {score} of {max_score} points"),
        format!("{ja}: {verdict:?}、{max_score} 点中 {score} 点"),
    )
}

fn say(good: bool, text: &Text, language: Language) {
    anstream::println!("{} {}", if good { "ok  " } else { "FAIL" }, text.get(language));
}
