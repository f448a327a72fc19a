//! `ggrade assignment check`: whether a folder is a homework that grades.

#[cfg(feature = "opengl")]
mod opengl;
mod rubric;
mod shows;
mod texts;
mod unseen;

use super::list;
use crate::cli::CheckArguments;
use crate::command::{ExitStatus, assignment, file_fault, warn, writing};
use crate::fault::Fault;
use crate::grade::Order;
use crate::hand_in::HandIn;
use crate::language::{Language, Text};
use crate::pictures::expected_pictures;
use crate::report::{Picture, Pictures, Report, Verdict, pictures};
use crate::sandbox::{GradedSubmission, GradingTask, Pool, Settings};
use crate::slots;
use reference::Assignment;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

/// How long a lecturer waits for the solution on a busy machine. What `check` says is the same on each machine, so that it says nothing of
/// time.
const PATIENCE: Duration = Duration::from_secs(20);

/// Grades the folder's own files, and says what its rubric and its mistakes show.
pub(super) fn run(arguments: &CheckArguments, language: Language) -> Result<ExitStatus, Fault> {
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
    let album = Album::new(arguments.pictures.clone(), &assignment)?;
    let said = CheckWording { language };
    let grade = |hand_in: &HandIn, name: &str| -> Result<Report, Fault> {
        let assignment = pool.assignment();
        let wants_frames = album.is_wanted();
        let GradedSubmission { report, frames } =
            pool.grade(GradingTask { assignment, hand_in, order: Order::default(), wants_frames })?;
        album.put(name, frames)?;
        Ok(report)
    };
    let solution = grade(&slots::solution(&assignment), "solution")?;
    let mut is_whole = say_solution(said, &solution);
    #[cfg(feature = "opengl")]
    let is_drawn_alike = opengl::say(said, &arguments.assignment);
    #[cfg(not(feature = "opengl"))]
    let is_drawn_alike = say_no_opengl(said);
    is_whole &= is_drawn_alike;
    is_whole &= say_starter(said, &grade(&slots::handed_out(&assignment), "handed-out")?);
    is_whole &= shows::say(said, &assignment, &album)?;
    texts::say(said, &assignment);
    is_whole &= texts::say_unfilled(said, &assignment);
    said.ok(&Text::new(format!("digest: {}", assignment.digest), format!("ダイジェスト: {}", assignment.digest)));
    Ok(if is_whole { ExitStatus::FullMarks } else { ExitStatus::Usage })
}

/// Whether driver and interpreter agree on the solution.
fn say_solution(said: CheckWording, report: &Report) -> bool {
    let is_right = report.verdict == Verdict::Correct;
    let scored = scored("the solution", "解答", report);
    let Some(apart) = report.probes.max_difference.filter(|_| is_right) else {
        said.line(is_right, &scored);
        report.diagnostics.iter().for_each(|one| anstream::println!("     {}", one.message.get(said.language)));
        disagreements(report).iter().for_each(|one| anstream::println!("     {}", one.get(said.language)));
        return is_right;
    };
    let (probes, frames) = (report.probes.samples, report.frames.len());
    let steps = report.frames.iter().map(|frame| frame.max_difference).fold(0.0, f64::max);
    said.ok(&Text::new(
        format!(
            "{}; interpreter and driver differ by at most {apart:.1e} at {probes} probes, and by {steps}/255 in {frames} frames",
            scored.en
        ),
        format!("{}。インタープリターとドライバーの差は、検査点 {probes} 点で最大 {apart:.1e}、画像 {frames} 枚で最大 {steps}/255", scored.ja),
    ));
    true
}

/// Where the driver shows something else than the interpreter computes from the same solution.
fn disagreements(report: &Report) -> Vec<Text> {
    let lost = report.rubric.iter().filter(|line| line.points < line.max_points).map(|line| {
        let (id, points, most) = (&line.id, line.points, line.max_points);
        Text::new(
            format!("rubric line `{id}`: {points} of {most} points"),
            format!("評価項目 `{id}`: {most} 点中 {points} 点"),
        )
    });
    let frames = report.frames.iter().filter(|frame| !frame.agrees()).map(|frame| {
        let (t, pixels, others) = (frame.t, frame.mismatched_pixels, frame.coverage_mismatches);
        Text::new(
            format!(
                "frame at t = {t:.3}: the driver's colour differs from the interpreter's in {pixels} pixels, and something is drawn by one of \
                 them alone in {others}: does a comparison there depend on rounding, or does `fract` or `floor` of a large number, as in \
                 `fract(sin(x) * 43758.5)`? A hash of whole numbers is the same everywhere"
            ),
            format!(
                "t = {t:.3} のフレーム: ドライバーとインタープリターで、{pixels} 画素の色が違い、{others} 画素は一方だけが描いています。\
                 丸め誤差で結果が変わる比較や、`fract(sin(x) * 43758.5)` のように大きな数の小数部分を取る計算はありませんか。\
                 整数のハッシュなら、どこでも同じ値になります"
            ),
        )
    });
    lost.chain(frames).collect()
}

/// Says that this build has no OpenGL, which is no error of the homework.
#[cfg(not(feature = "opengl"))]
fn say_no_opengl(said: CheckWording) -> bool {
    said.note(&Text::new(
        "the solution was not held against real OpenGL: this ggrade is built without the feature `opengl`",
        "本物の OpenGL とは比べていません: この ggrade は機能 `opengl` なしでビルドされています",
    ));
    true
}

/// Whether what is handed out leaves something to do.
fn say_starter(said: CheckWording, report: &Report) -> bool {
    let is_unfinished = report.verdict == Verdict::Wrong;
    let mut scored = scored("what is handed out", "配布ファイル", report);
    if let Some(first) =
        report.diagnostics.first().filter(|_| matches!(report.verdict, Verdict::Rejected | Verdict::Stopped))
    {
        let line = first.line.map_or_else(String::new, |line| format!("{line}: "));
        scored.en += &format!(": {line}{}", first.message.en);
        scored.ja += &format!(": {line}{}", first.message.ja);
    }
    if is_unfinished && report.score > 0.0 {
        said.note(&Text::new(
            format!("{}: whoever hands it in as it is has them too", scored.en),
            format!("{} (そのまま提出しても、この点になります)", scored.ja),
        ));
    } else {
        said.line(is_unfinished, &scored);
    }
    is_unfinished
}

/// What one of the folder's own files has.
pub(super) fn scored(en: &str, ja: &str, report: &Report) -> Text {
    let Report { verdict, score, max_score, .. } = report;
    Text::new(
        format!("{en}: {verdict:?}, {score} of {max_score} points"),
        format!("{ja}: {verdict:?}、{max_score} 点中 {score} 点"),
    )
}

/// How lines are said.
#[derive(Clone, Copy)]
struct CheckWording {
    language: Language,
}

impl CheckWording {
    fn ok(self, text: &Text) {
        self.line(true, text);
    }

    fn line(self, good: bool, text: &Text) {
        anstream::println!("{} {}", if good { "ok  " } else { "FAIL" }, text.get(self.language));
    }

    fn note(self, text: &Text) {
        anstream::println!("note {}", text.get(self.language));
    }
}

/// Where pictures go, if anywhere.
struct Album<'a> {
    folder: Option<PathBuf>,
    assignment: &'a Assignment,
}

impl<'a> Album<'a> {
    fn new(folder: Option<PathBuf>, assignment: &'a Assignment) -> Result<Self, Fault> {
        if let Some(folder) = &folder {
            std::fs::create_dir_all(folder).map_err(|error| file_fault(&writing(), folder, &error))?;
        }
        Ok(Self { folder, assignment })
    }

    fn is_wanted(&self) -> bool {
        self.folder.is_some()
    }

    /// Writes one moving picture: these frames, the right ones, and where they differ.
    fn put(&self, name: &str, yours: Arc<[Picture]>) -> Result<(), Fault> {
        let Some(folder) = self.folder.as_ref().filter(|_| !yours.is_empty()) else { return Ok(()) };
        let expected = expected_pictures(self.assignment);
        let pictures = Pictures { yours, expected, terms: Arc::default(), cycle: self.assignment.scene.cycle };
        let path = folder.join(format!("{name}.png"));
        std::fs::write(&path, pictures::animation(&pictures)?).map_err(|error| file_fault(&writing(), &path, &error))
    }
}
