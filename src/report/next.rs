//! What a student does first.

use super::labels::Labels;
use super::text::number;
use super::{Report, Verdict};
use crate::diagnostic::Severity;
use crate::language::Language;

impl Labels {
    /// What to do first; `None` when nothing is left to do.
    pub fn next_step(&self, report: &Report, language: Language) -> Option<String> {
        match report.verdict {
            Verdict::Correct => None,
            Verdict::Wrong => {
                let line = report.rubric.iter().find(|line| line.points < line.max_points)?;
                let points = number(line.max_points - line.points);
                Some(self.start_with(
                    line.label.get(language),
                    line.line.map(|own| (own, line.file.as_deref())),
                    &points,
                ))
            }
            Verdict::Rejected => {
                let errors = report.diagnostics.iter().filter(|d| d.severity == Severity::Error);
                Some(self.fix_first(errors.count() > 1).to_owned())
            }
            Verdict::Stopped => Some(self.unstop().to_owned()),
        }
    }

    fn start_with(&self, label: &str, line: Option<(u32, Option<&str>)>, points: &str) -> String {
        match (line, self.japanese()) {
            (Some((line, file)), true) => {
                let of = file.map_or_else(String::new, |file| format!("{file} の "));
                format!("まず {of}{line} 行目を見てみましょう。{label}であと {points} 点取れます。")
            }
            (None, true) => {
                format!("まず{label}から見直してみましょう。あと {points} 点取れます。")
            }
            (Some((line, file)), false) => {
                let of = file.map_or_else(String::new, |file| format!(" of {file}"));
                format!("Look at line {line}{of} first: {label} has {points} more points to give.")
            }
            (None, false) => format!("Start with {label}: it has {points} more points to give."),
        }
    }

    fn fix_first(&self, several: bool) -> &'static str {
        match (several, self.japanese()) {
            (true, true) => {
                "最初のエラーを直して、もう一度採点してください。後のエラーは最初のエラーが原因であることがよくあります。"
            }
            (false, true) => "エラーを直して、もう一度採点してください。",
            (true, false) => "Mend the first error and grade again: later errors often follow from the first.",
            (false, false) => "Mend the error and grade again.",
        }
    }

    fn unstop(&self) -> &'static str {
        if self.japanese() {
            "繰り返しの条件や計算量を見直して、もう一度採点してください。"
        } else {
            "Check the conditions of your loops and how much they compute, and grade again."
        }
    }
}
