//! What changed since an earlier grading.

use super::{BAD, DIM, GOOD, LISTED, ODD, PARTIAL, SummaryWriter, number, paint};
use crate::batch::changes::{Changes, EarnedPoints, GradeSummary, LineChange, StudentChange};
use crate::intake::Student;
use crate::language::Language;
use crate::report::labels::{mistake_title, rubric_label};
use crate::report::wrap::{columns, pad, plain};
use anstyle::Style;
use reference::Assignment;

impl SummaryWriter {
    pub(super) fn changes(&mut self, assignment: &Assignment, changes: &Changes) {
        let since = &changes.before;
        let heading = match self.language {
            Language::En => format!("Since ggrade {}, seed {}", since.ggrade, since.seed),
            Language::Ja => format!("前回 (ggrade {}、シード {}) からの変化", since.ggrade, since.seed),
        };
        self.heading(&plain(&heading));
        if changes.is_empty() {
            self.line(self.text("  Nothing changed.", "  変化はありません。"));
            return;
        }
        let (gains, losses) = (changes.gains.len(), changes.losses.len());
        let counts = match self.language {
            Language::En => format!("▲ {gains} gain   ▼ {losses} lose   = {} unchanged", changes.unchanged),
            Language::Ja => format!("▲ {gains} 名が増点   ▼ {losses} 名が減点   = {} 名は変化なし", changes.unchanged),
        };
        self.line(&format!("  {counts}"));
        for (list, sign, style) in [
            (&changes.losses, "▼", BAD),
            (&changes.gains, "▲", GOOD),
            (&changes.otherwise, "◇", PARTIAL),
            (&changes.unclear, "!", ODD),
        ] {
            for change in list.iter().take(LISTED) {
                self.change(assignment, change, &paint(style, sign));
            }
            self.more(list.len());
        }
        self.students(self.text("New", "新たな学生"), &changes.new);
        self.students(self.text("No longer there", "いなくなった学生"), &changes.gone);
    }

    fn change(&mut self, assignment: &Assignment, change: &StudentChange, sign: &str) {
        let (before, after) = (&change.before, &change.after);
        let name = plain(&change.student.name).replace('\n', " ");
        let points = |grade: &GradeSummary| grade.score.map_or("–".into(), number);
        let mut line = format!("  {sign} {name}  {} → {}", points(before), points(after));
        if before.standing != after.standing {
            let word = |grade: &GradeSummary| grade.standing.word(self.language);
            line += &format!("  {} → {}", word(before), word(after));
        }
        if change.is_new_file {
            line += &paint(DIM, self.text("  (another file)", "  (別のファイル)"));
        }
        self.line(&line);
        let lines: Vec<_> = change.rubric.iter().map(|line| self.rubric_line(assignment, line)).collect();
        let column = lines.iter().map(|(label, _)| columns(label)).max().unwrap_or(0);
        for (label, change) in lines {
            self.line(&format!("      {}", paint(DIM, &format!("{}  {change}", pad(&label, column)))));
        }
    }

    fn students(&mut self, what: &str, students: &[Student]) {
        if students.is_empty() {
            return;
        }
        let names: Vec<_> = students.iter().take(LISTED).map(|student| student.name.as_str()).collect();
        self.paragraph(2, Style::new(), &format!("{what} ({}): {}", students.len(), names.join(", ")));
        self.more(students.len());
    }

    /// `Specular` and `20 → 40  Phong's reflection vector → –`: a line of the rubric, and what changed in it.
    fn rubric_line(&self, assignment: &Assignment, line: &LineChange) -> (String, String) {
        let points =
            |earned: &Option<EarnedPoints>| earned.as_ref().map_or("–".into(), |earned| number(earned.points));
        let mistake = |earned: &Option<EarnedPoints>| {
            let id = earned.as_ref().and_then(|earned| earned.mistake.as_deref());
            id.map_or("–".into(), |id| plain(&mistake_title(assignment, id, self.language)))
        };
        let (before, after) = (mistake(&line.before), mistake(&line.after));
        let why = if before == after { before } else { format!("{before} → {after}") };
        let label = plain(rubric_label(assignment, &line.id, self.language));
        (label, format!("{} → {}  {why}", points(&line.before), points(&line.after)))
    }
}
