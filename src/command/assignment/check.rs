//! `ggrade assignment check`: whether a folder is a homework that grades.

use super::list;
use crate::cli::Check;
use crate::command::{ExitStatus, assignment, warn};
use crate::fault::Fault;
use crate::grade::{self, Order};
use crate::hand_in::{HandIn, HandedInFile};
use crate::language::{Language, Text};
use crate::report::{Report, Verdict};
use crate::sandbox::{Pool, Settings, Submission};
use reference::Assignment;
use reference::fit;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// How long a lecturer waits on a busy machine before the solution is called too slow.
const PATIENCE: Duration = Duration::from_secs(20);

/// Grades the folder's own files, and says what its rubric and its variants show.
pub(super) fn run(arguments: &Check, language: Language) -> Result<ExitStatus, Fault> {
    let Some(assignment) = assignment(Some(&arguments.assignment), &[], language) else {
        return Ok(ExitStatus::Usage);
    };
    list(&assignment, language);
    let settings = Settings {
        adapter: arguments.adapter,
        policy: arguments.sandbox,
        spares: 0,
        warm_up: false,
        deadline: PATIENCE,
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
    let begin = Instant::now();
    let solution = grade(&HandIn { files: solution.collect() })?;
    let took = begin.elapsed();
    let starter = grade(&grade::handed_out(&assignment))?;
    let is_right = solution.verdict == Verdict::Correct;
    say(is_right, &scored("the solution", "解答", &solution), language);
    for diagnostic in solution.diagnostics.iter().filter(|_| !is_right) {
        anstream::println!("     {}", diagnostic.message.get(language));
    }
    say_time(took, Settings::new(Arc::clone(&assignment)).deadline, language);
    let is_unfinished = starter.verdict == Verdict::Wrong;
    say(is_unfinished, &scored("what is handed out", "配布ファイル", &starter), language);
    say_features(&assignment, language);
    let are_seen = say_variants(&assignment, language);
    let digest = Text::new(format!("digest: {}", assignment.digest), format!("ダイジェスト: {}", assignment.digest));
    say(true, &digest, language);
    Ok(if is_right && is_unfinished && are_seen { ExitStatus::FullMarks } else { ExitStatus::Usage })
}

/// Says that the solution takes most of the time that a hand-in has.
fn say_time(took: Duration, deadline: Duration, language: Language) {
    if took <= deadline.mul_f64(0.8) {
        return;
    }
    let (took, deadline) = (took.as_secs_f64(), deadline.as_secs_f64());
    let text = Text::new(
        format!(
            "the solution took {took:.1} s on this machine, and a hand-in has {deadline} s: draw fewer poses or a smaller window, or grade \
             with a longer --deadline"
        ),
        format!(
            "このマシンで解答の採点に {took:.1} 秒かかりました。提出物の制限は {deadline} 秒です。ポーズを減らすかウィンドウを小さくする、\
             または --deadline を延ばしてください"
        ),
    );
    anstream::println!("note {}", text.get(language));
}

/// Says where each line's feature shows, and which cannot be judged by itself, as a term of a sum that always has another.
fn say_features(assignment: &Assignment, language: Language) {
    let probes = assignment.judging_probes();
    let all = probes.probes.len();
    let footprints = fit::Footprints::of(assignment, &probes, fit::TOLERANCE);
    // Where all is right, each line is judged that can be judged at all.
    let judged = footprints.judged(&|_| true);
    for line in footprints.lines() {
        let (id, shows) = (&assignment.rubric[line].id, footprints.of_line(line).len());
        let alone = judged.iter().find(|(known, _)| *known == line).map_or(0, |(_, places)| places.len());
        let is_judged = alone > 0;
        let [mut en, mut ja] = [
            format!("rubric line `{id}`: shows at {shows} of {all} probes, and is judged at {alone} of them"),
            format!("採点の行 `{id}`: 検査点 {all} 点中 {shows} 点に現れ、そのうち {alone} 点で採点できる"),
        ];
        if !is_judged {
            en.push_str("; an answer that nothing explains loses its points");
            ja.push_str("。原因の分からない答えでは、この行の点は残りません");
        }
        let word = if is_judged { "ok  " } else { "note" };
        anstream::println!("{word} {}", Text::new(en, ja).get(language));
    }
}

/// Names the variants of mistakes that show nothing of their own.
fn say_variants(assignment: &Assignment, language: Language) -> bool {
    let alike = fit::alike(assignment, &assignment.judging_probes(), fit::TOLERANCE);
    for (variant, other) in &alike {
        let text = match other {
            None => Text::new(
                format!("{variant}: shows at no probe; change it, or remove it"),
                format!("{variant}: どの検査点でも解答と同じになります。変えるか、取り除いてください"),
            ),
            Some(other) => Text::new(
                format!("{variant}: shows the same as {other}, which is what will be found; remove one"),
                format!("{variant}: {other} と同じ結果になり、見つかるのはそちらです。一方を取り除いてください"),
            ),
        };
        say(false, &text, language);
    }
    alike.is_empty()
}

/// What one of the folder's own files has.
pub(super) fn scored(en: &str, ja: &str, report: &Report) -> Text {
    let Report { verdict, score, max_score, .. } = report;
    Text::new(
        format!("{en}: {verdict:?}, {score} of {max_score} points"),
        format!("{ja}: {verdict:?}、{max_score} 点中 {score} 点"),
    )
}

fn say(good: bool, text: &Text, language: Language) {
    anstream::println!("{} {}", if good { "ok  " } else { "FAIL" }, text.get(language));
}
