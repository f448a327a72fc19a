//! The lines of the rubric, with their bars.

use super::{BAD, BOLD, DIM, GOOD, PARTIAL, ReportWriter, number};
use crate::report::labels::{Labels, mistake_title};
use crate::report::wrap::{columns, pad, plain};
use crate::report::{Report, RubricLine, Verdict};
use anstyle::Style;
use reference::Assignment;

/// Columns of a bar.
const BAR: usize = 10;

impl ReportWriter {
    pub(super) fn rubric(&mut self, assignment: &Assignment, report: &Report) {
        let labels = report.rubric.iter().map(|line| columns(line.label.get(self.language)));
        let column = labels.max().unwrap_or(0);
        let full = report.verdict == Verdict::Correct;
        self.gap();
        for line in &report.rubric {
            self.rubric_line(assignment, line, column);
            if !full || line.graded.is_some() {
                match report.said_before(line) {
                    Some(before) => {
                        let label = before.label.get(self.language);
                        self.paragraph(2, &Labels::of(self.language).as_for(label));
                    }
                    None => self.paragraph(2, line.message.get(self.language)),
                }
                self.gap();
            }
        }
        if full {
            self.gap();
        }
    }

    fn rubric_line(&mut self, assignment: &Assignment, line: &RubricLine, column: usize) {
        let (mark, style) = mark(line.points, line.max_points);
        let label = pad(&plain(line.label.get(self.language)), column);
        let points = format!("{} / {}", number(line.points), number(line.max_points));
        let text = format!(
            "{} {}  {}  {}",
            self.paint(style, mark),
            self.paint(BOLD, &label),
            self.bar(line.points / line.max_points, BAR, style),
            pad(&points, 7),
        );
        let used = 2 + column + 2 + BAR + 2 + columns(&points).max(7) + 2;
        let title = |id| plain(&mistake_title(assignment, id, self.language));
        let mistake = line.mistake.as_deref().map(title).unwrap_or_default();
        if used + columns(&mistake) <= self.width {
            let mistake = self.paint(DIM, &mistake);
            self.line(&format!("{text}  {mistake}"));
        } else {
            self.line(&text);
            let mistake = self.paint(DIM, &mistake);
            self.line(&format!("  {mistake}"));
        }
    }

    pub(super) fn bar(&self, share: f64, width: usize, style: Style) -> String {
        let filled = filled(share, width);
        let rest = self.paint(DIM, &"─".repeat(width - filled));
        format!("{}{rest}", self.paint(style, &"━".repeat(filled)))
    }
}

/// Cells of a bar: full only for a full share, empty only for none.
pub(super) fn filled(share: f64, width: usize) -> usize {
    match share {
        share if share.is_nan() || share <= 0.0 => 0,
        share if share >= 1.0 => width,
        share => ((share * width as f64).round() as usize).clamp(1, width - 1),
    }
}

fn mark(points: f64, max_points: f64) -> (&'static str, Style) {
    match points {
        points if points >= max_points => ("✓", GOOD),
        points if points > 0.0 => ("△", PARTIAL),
        _ => ("✗", BAD),
    }
}
