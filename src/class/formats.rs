//! A graded class in the formats that people and courses' tools read: one module a format, all of them views of a
//! [`Class`](super::Class).

pub mod classroom;
pub mod coderunner;
mod comment;
pub mod exchange;
pub mod feedback;
pub mod github;
pub mod gradebooks;
pub mod grades;
pub mod gradescope;
pub mod junit;
mod names;
#[cfg(test)]
mod nasty;
pub mod page;
pub(crate) mod plain;
#[cfg(test)]
mod samples;
pub mod sarif;
mod status;
#[cfg(test)]
mod tests;
mod untrusted;
pub mod vpl;
mod wording;
pub mod worksheet;

use crate::language::Text;
use clap::ValueEnum;
use clap::builder::PossibleValue;

/// A format that a class is written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum ClassFormat {
    /// The class on one page.
    Html,
    /// A table for spreadsheets.
    Csv,
    /// The same for programs.
    Json,
    /// The columns that nbgrader exports.
    Nbgrader,
    /// The columns that Canvas imports.
    Canvas,
    /// The columns that Gradescope exports.
    GradescopeGrades,
    /// Moodle's offline grading worksheet, filled in.
    MoodleWorksheet,
    /// The archive that Moodle takes as multiple feedback files.
    MoodleFeedback,
    /// Gradescope's `results.json`.
    Gradescope,
    /// Workflow commands and a job summary for GitHub Actions.
    Github,
    /// The result that GitHub Classroom's reporter reads.
    ClassroomLegacy,
    /// JUnit XML.
    Junit,
    /// SARIF 2.1.0.
    Sarif,
    /// Moodle's Virtual Programming Lab.
    Vpl,
    /// Moodle's CodeRunner question type.
    Coderunner,
}

/// Where the student's key stands in a file name of [`ClassFormat::files`] that exists once a student.
pub const KEY: &str = "KEY";

/// One format as a person chooses it.
struct FormatRow {
    format: ClassFormat,
    id: &'static str,
    files: &'static [&'static str],
    en: &'static str,
    ja: &'static str,
}

const fn row(
    format: ClassFormat,
    id: &'static str,
    files: &'static [&'static str],
    en: &'static str,
    ja: &'static str,
) -> FormatRow {
    FormatRow { format, id, files, en, ja }
}

/// In the order of the variants, which is the order in which help lists them.
const TABLE: [FormatRow; 15] = [
    row(
        ClassFormat::Html,
        "html",
        &["report.html"],
        "The class on one page: everyone's picture, filters, histograms",
        "クラス全体の一覧ページ（全員の画像、絞り込み、分布）",
    ),
    row(
        ClassFormat::Csv,
        "csv",
        &["grades.csv"],
        "A table for Excel and other spreadsheets",
        "Excel などの表計算ソフトで開ける成績表",
    ),
    row(
        ClassFormat::Json,
        "json",
        &["grades.json"],
        "The same table for programs, as JSON",
        "同じ成績表の JSON（プログラム用）",
    ),
    row(
        ClassFormat::Nbgrader,
        "nbgrader",
        &["nbgrader.csv"],
        "The columns of `nbgrader export`",
        "`nbgrader export` と同じ列の成績表",
    ),
    row(
        ClassFormat::Canvas,
        "canvas",
        &["canvas.csv"],
        "The grades for Canvas's gradebook, which imports them",
        "Canvas の成績表にインポートする CSV",
    ),
    row(
        ClassFormat::GradescopeGrades,
        "gradescope-grades",
        &["gradescope-grades.csv"],
        "The columns of Gradescope's \"Download grades\"",
        "Gradescope の成績ダウンロードと同じ列の成績表",
    ),
    row(
        ClassFormat::MoodleWorksheet,
        "moodle-worksheet",
        &["moodle-worksheet.csv"],
        "Moodle's offline grading worksheet with grades and comments filled in",
        "Moodle のオフライン評定ワークシートに評定とコメントを記入したもの",
    ),
    row(
        ClassFormat::MoodleFeedback,
        "moodle-feedback",
        &["moodle-feedback.zip"],
        "Everyone's report for Moodle's \"Upload feedback files in a zip\"",
        "Moodle の「複数フィードバックファイルをZIPでアップロードする」に渡す全員の採点結果",
    ),
    row(
        ClassFormat::Gradescope,
        "gradescope",
        &["gradescope/KEY.json"],
        "Gradescope results.json, one a student",
        "Gradescope の results.json（学生ごと）",
    ),
    row(
        ClassFormat::Github,
        "github",
        &["github-annotations.txt", "github-summary.md"],
        "GitHub Actions: annotations at the students' lines, and a job summary",
        "GitHub Actions のアノテーションとジョブサマリー",
    ),
    row(
        ClassFormat::ClassroomLegacy,
        "classroom-legacy",
        &["classroom-legacy/KEY.txt"],
        "GitHub Classroom's result for its grading reporter (base64), one a student",
        "GitHub Classroom の grading reporter が読む結果（base64、学生ごと）",
    ),
    row(
        ClassFormat::Junit,
        "junit",
        &["junit.xml"],
        "JUnit XML: one suite for each student, one case for each line of the rubric",
        "JUnit XML（学生ごとのスイート、採点項目ごとのケース）",
    ),
    row(
        ClassFormat::Sarif,
        "sarif",
        &["report.sarif"],
        "SARIF 2.1.0: what the compiler says, at the students' lines",
        "SARIF 2.1.0（コンパイラのメッセージと学生の行番号）",
    ),
    row(
        ClassFormat::Vpl,
        "vpl",
        &["vpl/KEY.txt"],
        "Moodle VPL: comment and `Grade :=>>`, one a student",
        "Moodle VPL のコメントと `Grade :=>>`（学生ごと）",
    ),
    row(
        ClassFormat::Coderunner,
        "coderunner",
        &["coderunner/KEY.json"],
        "Moodle CodeRunner combinator grader result, one a student",
        "Moodle CodeRunner のコンビネータ採点結果（学生ごと）",
    ),
];

impl ClassFormat {
    fn row(self) -> &'static FormatRow {
        &TABLE[self as usize]
    }

    /// Its name on the command line.
    pub fn id(self) -> &'static str {
        self.row().id
    }

    /// The files that it writes, relative to the output folder, `/` between folders; one with [`KEY`] in its name is
    /// written once a student.
    pub fn files(self) -> &'static [&'static str] {
        self.row().files
    }

    /// Whether what it says is read by students: then it is in the language of the course, whoever fetches it.
    pub fn is_for_students(self) -> bool {
        match self {
            Self::MoodleWorksheet
            | Self::MoodleFeedback
            | Self::Gradescope
            | Self::Github
            | Self::ClassroomLegacy
            | Self::Vpl
            | Self::Coderunner => true,
            Self::Html
            | Self::Csv
            | Self::Json
            | Self::Nbgrader
            | Self::Canvas
            | Self::GradescopeGrades
            | Self::Junit
            | Self::Sarif => false,
        }
    }

    /// What it is, in a line.
    pub fn description(self) -> Text {
        Text::new(self.row().en, self.row().ja)
    }
}

impl ValueEnum for ClassFormat {
    fn value_variants<'a>() -> &'a [Self] {
        const ALL: [ClassFormat; TABLE.len()] = {
            let mut all = [ClassFormat::Html; TABLE.len()];
            let mut index = 0;
            while index < TABLE.len() {
                all[index] = TABLE[index].format;
                index += 1;
            }
            all
        };
        &ALL
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        let needs = match self {
            Self::MoodleWorksheet => " (needs --moodle-worksheet)",
            Self::MoodleFeedback => " (needs --moodle-worksheet where groups hand in)",
            _ => "",
        };
        Some(PossibleValue::new(self.id()).help(format!("{}{needs}", self.row().en)))
    }
}
