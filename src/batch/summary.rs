//! The class at the end of a run, for a terminal.

mod changes;
#[cfg(test)]
mod tests;

use super::changes::Changes;
use crate::class::output::WrittenFiles;
use crate::class::standing::Standing;
use crate::class::statistics::{self, Averages, BINS};
use crate::class::{Class, Outcome};
use crate::language::{Language, Text};
use crate::report::labels::mistake_title;
use crate::report::wrap::{columns, pad, plain, wrap};
use anstyle::{AnsiColor, Style};

/// Narrowest terminal that the tables are laid out for, and the widest line that reads well.
const NARROWEST: usize = 40;
const WIDEST: usize = 100;
/// How many of a list are shown; the rest is counted.
const LISTED: usize = 10;
/// Widest line with a bar.
const BARS: usize = 64;
/// Width of the bar of a mistake, which stands before its title.
const MISTAKE_BAR: usize = 12;

const BOLD: Style = Style::new().bold();
const DIM: Style = Style::new().dimmed();
const GOOD: Style = AnsiColor::Green.on_default();
const PARTIAL: Style = AnsiColor::Yellow.on_default();
const BAD: Style = AnsiColor::Red.on_default();
const ODD: Style = AnsiColor::Magenta.on_default();

/// The summary, with a final newline. It is coloured; nothing is said by colour alone.
pub fn render(class: &Class, changes: Option<&Changes>, written: &WrittenFiles, width: usize) -> String {
    let mut writer =
        SummaryWriter { out: String::new(), language: class.language, width: width.clamp(NARROWEST, WIDEST) };
    writer.head(class);
    writer.standings(class);
    writer.scores(class);
    writer.mistakes(class);
    writer.troubles(class);
    if let Some(changes) = changes {
        writer.changes(&class.assignment, changes);
    }
    writer.written(written);
    writer.out
}

struct SummaryWriter {
    out: String,
    language: Language,
    width: usize,
}

impl SummaryWriter {
    fn text(&self, en: &'static str, ja: &'static str) -> &'static str {
        if self.language == Language::Ja { ja } else { en }
    }

    fn line(&mut self, text: &str) {
        self.out.push_str(text.trim_end());
        self.out.push('\n');
    }

    fn heading(&mut self, text: &str) {
        self.out.push('\n');
        self.line(&paint(BOLD, text));
    }

    /// A paragraph behind an indent.
    fn paragraph(&mut self, indent: usize, style: Style, text: &str) {
        for line in wrap(&plain(text), self.width - indent) {
            self.line(&format!("{}{}", " ".repeat(indent), paint(style, &line)));
        }
    }

    fn more(&mut self, count: usize) {
        if count > LISTED {
            let rest = count - LISTED;
            let text = match self.language {
                Language::En => format!("and {rest} more"),
                Language::Ja => format!("ほか {rest} 件"),
            };
            self.line(&format!("  {}", paint(DIM, &text)));
        }
    }

    fn head(&mut self, class: &Class) {
        let count = class.entries.len();
        let people = match (self.language, count) {
            (Language::En, 1) => "1 student".to_owned(),
            (Language::En, _) => format!("{count} students"),
            (Language::Ja, _) => format!("{count} 名"),
        };
        let title = plain(&class.title).replace('\n', " ");
        let facts = paint(DIM, &format!("{} · {people}", class.assignment.id));
        self.out.push('\n');
        if title.is_empty() || title == class.assignment.id {
            return self.line(&facts);
        }
        for line in wrap(&title, self.width) {
            self.line(&paint(BOLD, &line));
        }
        self.line(&facts);
    }

    fn standings(&mut self, class: &Class) {
        let counts = Standing::count(&class.entries);
        let total = class.entries.len().max(1);
        self.out.push('\n');
        self.line(&stacked(&counts, total, self.width.min(BARS)));
        let present = || Standing::ALL.into_iter().zip(counts).filter(|(_, count)| *count > 0);
        let word = |standing: Standing| standing.word(self.language);
        let column = present().map(|(standing, _)| columns(word(standing))).max().unwrap_or(0);
        let lines: Vec<_> = present()
            .map(|(standing, count)| {
                let share = 100.0 * count as f64 / total as f64;
                let sign = paint(style(standing), standing.sign());
                format!(
                    "{sign} {}  {count:>5}  {}",
                    pad(word(standing), column),
                    paint(DIM, &format!("{share:>3.0} %"))
                )
            })
            .collect();
        lines.iter().for_each(|line| self.line(line));
    }

    fn scores(&mut self, class: &Class) {
        let Some(Averages { count, mean, median }) = statistics::averages(class) else { return };
        self.heading(self.text("Scores", "得点"));
        let facts = match self.language {
            Language::En => format!("mean {mean:.1} · median {median:.1} · {count} graded"),
            Language::Ja => format!("平均 {mean:.1} · 中央値 {median:.1} · 採点 {count} 名"),
        };
        self.paragraph(2, Style::new(), &facts);
        let bins = statistics::histogram(class);
        let most = bins.iter().copied().max().unwrap_or(1).max(1);
        let room = self.width.min(BARS) - 18;
        for (bin, &count) in bins.iter().enumerate() {
            let (label, style) = if bin == BINS {
                ("100 %".to_owned(), GOOD)
            } else {
                (format!("{}–{} %", bin * 100 / BINS, (bin + 1) * 100 / BINS - 1), PARTIAL)
            };
            let bar =
                if count > 0 { format!("{} {count}", paint(style, &bar(count, most, room))) } else { paint(DIM, "·") };
            self.line(&format!("  {label:>7}  {bar}"));
        }
    }

    fn mistakes(&mut self, class: &Class) {
        let titled = |(id, count)| (plain(&mistake_title(&class.assignment, id, self.language)), count);
        let mistakes: Vec<_> = statistics::mistakes(class).into_iter().map(titled).collect();
        if mistakes.is_empty() {
            return;
        }
        self.heading(self.text("Most frequent mistakes", "多かった間違い"));
        let most = mistakes[0].1;
        let indent = 2 + 5 + 2 + MISTAKE_BAR + 2;
        for (title, count) in mistakes.iter().take(LISTED) {
            let bar = bar(*count, most, MISTAKE_BAR);
            let rest = " ".repeat(MISTAKE_BAR - columns(&bar));
            let mut start = format!("  {count:>5}  {}{rest}  ", paint(BAD, &bar));
            for line in wrap(title, self.width - indent) {
                self.line(&format!("{start}{line}"));
                start = " ".repeat(indent);
            }
        }
        self.more(mistakes.len());
    }

    /// Who got no grade, and what was not read.
    fn troubles(&mut self, class: &Class) {
        let mut faults = Vec::new();
        let mut nothing = Vec::new();
        for entry in &class.entries {
            match &entry.outcome {
                Outcome::Fault(fault) => faults.push((&entry.student.name, &fault.message)),
                Outcome::NotGraded(why) => nothing.push((&entry.student.name, why)),
                Outcome::Graded(_) => {}
            }
        }
        let heading = self.text(
            "Grading failed (ggrade's fault, no points are lost; --resume tries again)",
            "採点エラー (ggrade の側の障害で、減点にはなりません。--resume で再試行できます)",
        );
        self.list(heading, BAD, &faults);
        self.list(self.text("Nothing to grade", "採点対象なし"), BOLD, &nothing);
        let refused: Vec<_> = class.refused.iter().map(|refused| (&refused.path, &refused.reason)).collect();
        self.list(self.text("Left out of the input", "読み込まなかったもの"), BOLD, &refused);
    }

    fn list(&mut self, heading: &str, style: Style, items: &[(&String, &Text)]) {
        if items.is_empty() {
            return;
        }
        self.out.push('\n');
        for line in wrap(heading, self.width) {
            self.line(&paint(style.bold(), &line));
        }
        for (name, text) in items.iter().take(LISTED) {
            self.paragraph(2, Style::new(), &name.replace('\n', " "));
            self.paragraph(4, DIM, text.get(self.language));
        }
        self.more(items.len());
    }

    fn written(&mut self, written: &WrittenFiles) {
        if !written.files.is_empty() {
            let heading = format!("{} {}", self.text("Written into", "出力先"), written.folder);
            self.heading(&plain(&heading));
            let column = written.files.iter().map(|(path, _)| columns(path)).max().unwrap_or(0);
            for (path, what) in &written.files {
                let what = what.get(self.language);
                if column + 4 + columns(what) <= self.width {
                    self.line(&format!("  {}  {}", pad(path, column), paint(DIM, what)));
                } else {
                    self.line(&format!("  {path}"));
                    self.paragraph(4, DIM, what);
                }
            }
        }
        for note in &written.notes {
            self.out.push('\n');
            self.paragraph(0, PARTIAL, note.get(self.language));
        }
    }
}

/// A number with at most two decimals, and none that says nothing.
fn number(value: f64) -> String {
    format!("{value:.2}").trim_end_matches('0').trim_end_matches('.').to_owned()
}

fn paint(style: Style, text: &str) -> String {
    if text.is_empty() { String::new() } else { format!("{style}{text}{style:#}") }
}

fn style(standing: Standing) -> Style {
    match standing {
        Standing::Correct => GOOD,
        Standing::Wrong => PARTIAL,
        Standing::Rejected | Standing::Fault => BAD,
        Standing::Stopped => ODD,
        Standing::NotGraded => DIM,
    }
}

/// A bar of at most `room` columns; none only for none.
fn bar(count: usize, most: usize, room: usize) -> String {
    let cells = (count * room).div_ceil(most.max(1)).min(room);
    "━".repeat(cells)
}

/// One bar of all standings, each with its share of `width` and at least a column where there is any.
fn stacked(counts: &[usize], total: usize, width: usize) -> String {
    let mut bar = String::new();
    let (mut sum, mut end) = (0, 0);
    for (standing, &count) in Standing::ALL.into_iter().zip(counts) {
        sum += count;
        let start = end;
        end = (sum * width / total).max(start + usize::from(count > 0));
        let cell = match standing {
            Standing::Correct => "━",
            Standing::Wrong => "╌",
            Standing::Rejected => "═",
            Standing::Stopped => "▪",
            Standing::NotGraded => "·",
            Standing::Fault => "!",
        };
        bar += &paint(style(standing), &cell.repeat(end - start));
    }
    bar
}
