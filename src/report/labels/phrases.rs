//! Words that depend on what they are said of: a place, a kind, a count.

use super::Labels;
use crate::diagnostic::{DiagnosticStage, Severity};
use crate::report::{CrossCheck, Opinion};

impl Labels {
    /// File where it has to be said, line, and column where it is known.
    pub fn place(&self, file: Option<&str>, line: u32, column: Option<u32>) -> String {
        let place = match (column, self.japanese()) {
            (None, true) => format!("{line} 行目"),
            (None, false) => format!("line {line}"),
            (Some(column), true) => format!("{line} 行目 {column} 文字目"),
            (Some(column), false) => format!("line {line}, column {column}"),
        };
        match (file, self.japanese()) {
            (None, _) => place,
            (Some(file), true) => format!("{file} の {place}"),
            (Some(file), false) => format!("{file}, {place}"),
        }
    }

    /// What is said of a line of the rubric of which the same is to be said as of an earlier one.
    pub fn as_for(&self, earlier: &str) -> String {
        if self.japanese() {
            format!("上の「{earlier}」と同じです。")
        } else {
            format!("The same as for “{earlier}” above.")
        }
    }

    pub fn severity(&self, severity: Severity) -> &'static str {
        match (severity, self.japanese()) {
            (Severity::Error, false) => "error",
            (Severity::Error, true) => "エラー",
            (Severity::Warning, false) => "warning",
            (Severity::Warning, true) => "警告",
            (Severity::Note, false) => "note",
            (Severity::Note, true) => "補足",
        }
    }

    pub fn stage(&self, stage: DiagnosticStage) -> &'static str {
        match (stage, self.japanese()) {
            (DiagnosticStage::Source, false) => "reading the file",
            (DiagnosticStage::Source, true) => "ファイルの読み込み",
            (DiagnosticStage::Compile, false) => "compiling",
            (DiagnosticStage::Compile, true) => "コンパイル",
            (DiagnosticStage::Link, false) => "linking",
            (DiagnosticStage::Link, true) => "リンク",
            (DiagnosticStage::Interface, false) => "checking the interface",
            (DiagnosticStage::Interface, true) => "入出力の確認",
            (DiagnosticStage::Run, false) => "running",
            (DiagnosticStage::Run, true) => "実行",
        }
    }

    pub fn frames_agree(&self, agree: usize, total: usize) -> String {
        if self.japanese() {
            format!("{total} 枚のうち {agree} 枚が一致")
        } else {
            format!("{agree} of {total} agree")
        }
    }

    /// What is said of pixels that one picture paints and the other does not: `most` of them in a frame.
    pub fn shape_differs(&self, differing: usize, total: usize, most: u32) -> String {
        if self.japanese() {
            format!(
                "{total} 枚のうち {differing} 枚に、正解とあなたの画像の一方だけで描かれている画素があります（1 枚に最大 {most} 画素）"
            )
        } else {
            format!(
                "{differing} of {total} have pixels that only one of the two pictures paints, up to {most} in a frame"
            )
        }
    }

    pub fn probes_agree(&self, agree: u32, total: u32) -> String {
        if self.japanese() {
            format!("{total} 点のうち {agree} 点が一致")
        } else {
            format!("{agree} of {total} agree")
        }
    }

    /// How a second opinion relates to the driver's, by vertices.
    pub fn cross_check(&self, checked: &CrossCheck) -> String {
        let CrossCheck { opinion, agreeing, undefined, unsettled, differing, .. } = checked;
        match (opinion, self.japanese()) {
            (Opinion::NotRun, false) => "not run".into(),
            (Opinion::NotRun, true) => "実行していません".into(),
            (_, false) => format!(
                "{agreeing} vertices agree with the driver, {differing} differ, {undefined} undefined, {unsettled} a matter of rounding"
            ),
            (_, true) => format!(
                "ドライバーと一致 {agreeing} 頂点, 不一致 {differing}, 未定義 {undefined}, 丸めによるもの {unsettled}"
            ),
        }
    }
}
