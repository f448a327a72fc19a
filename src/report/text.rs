//! The report for a terminal.

mod rubric;
mod strip;

use super::labels::Labels;
use super::wrap::{columns, pad, plain, wrap};
use super::{Report, Verdict};
use crate::diagnostic::{Diagnostic, Severity};
use crate::language::Language;
use anstyle::{AnsiColor, Style};
use reference::Assignment;

/// How to write a report.
#[derive(Clone, Copy, Debug)]
pub struct TextOptions<'a> {
    /// The homework.
    pub assignment: &'a Assignment,
    /// The language of every word.
    pub language: Language,
    /// Columns of the terminal; below 40 the lines may not fit.
    pub width: usize,
    /// Whether to colour it; nothing is said by colour alone.
    pub colour: bool,
    /// The diagnostics as excerpts of the source, where the caller has them; written as they are.
    pub excerpts: Option<&'a str>,
}

/// Narrowest terminal that the tables are laid out for, and the widest line that reads well.
const NARROWEST: usize = 40;
const WIDEST: usize = 100;

const BOLD: Style = Style::new().bold();
const DIM: Style = Style::new().dimmed();
const GOOD: Style = AnsiColor::Green.on_default();
const PARTIAL: Style = AnsiColor::Yellow.on_default();
const BAD: Style = AnsiColor::Red.on_default();
const CODE: Style = AnsiColor::Cyan.on_default();

/// The report as text, with a final newline.
pub fn render(report: &Report, options: &TextOptions) -> String {
    let report = &*report.for_student();
    let mut writer = ReportWriter {
        out: String::new(),
        labels: Labels::of(options.language),
        language: options.language,
        width: options.width.clamp(NARROWEST, WIDEST),
        colour: options.colour,
    };
    writer.head(report);
    if !report.verdict.is_drawn() {
        writer.diagnostics(report, options.excerpts);
    } else {
        writer.rubric(options.assignment, report);
        writer.advice(report);
        writer.measurements(report);
        writer.diagnostics(report, options.excerpts);
    }
    writer.next(report);
    writer.environment(report);
    writer.out
}

/// A number with at most two decimals, and none that says nothing.
pub(crate) fn number(value: f64) -> String {
    if !value.is_finite() {
        return "–".into();
    }
    let text = format!("{value:.2}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

struct ReportWriter {
    out: String,
    labels: &'static Labels,
    language: Language,
    width: usize,
    colour: bool,
}

impl ReportWriter {
    fn paint(&self, style: Style, text: &str) -> String {
        if self.colour { format!("{style}{text}{style:#}") } else { text.to_owned() }
    }

    fn line(&mut self, text: &str) {
        self.out.push_str(text.trim_end());
        self.out.push('\n');
    }

    fn gap(&mut self) {
        self.out.push('\n');
    }

    /// A paragraph behind an indent, its `code` coloured.
    fn paragraph(&mut self, indent: usize, text: &str) {
        let mut in_code = false;
        for line in wrap(&plain(text), self.width - indent) {
            let line = self.code(&line, &mut in_code);
            self.line(&format!("{}{line}", " ".repeat(indent)));
        }
    }

    fn code(&self, line: &str, in_code: &mut bool) -> String {
        let mut styled = String::new();
        for (index, part) in line.split('`').enumerate() {
            if index > 0 {
                *in_code = !*in_code;
                styled.push('`');
            }
            let style = if *in_code { CODE } else { Style::new() };
            styled.push_str(&self.paint(style, part));
        }
        styled
    }

    fn head(&mut self, report: &Report) {
        let (mark, style) = verdict_mark(report);
        let verdict = self.labels.verdict(report.verdict);
        let title = format!("{mark} {verdict}");
        let name = plain(&report.file_names());
        self.gap();
        let title = self.paint(style.bold(), &title);
        self.line(&title);
        for line in wrap(&name, self.width) {
            let line = self.paint(BOLD, &line);
            self.line(&line);
        }
        let score = format!("{} / {}", number(report.score), number(report.max_score));
        let room = self.width.saturating_sub(columns(&score) + 2).min(60);
        let bar = self.bar(report.score / report.max_score, room, style);
        let score = self.paint(BOLD, &score);
        self.line(&format!("{bar}  {score}"));
        self.paragraph(0, self.labels.headline(report.verdict));
    }

    fn advice(&mut self, report: &Report) {
        if report.advice.is_empty() {
            return;
        }
        let is_right = report.verdict == Verdict::Correct;
        let heading = self.paint(BOLD, if is_right { self.labels.advice } else { self.labels.note });
        self.line(&heading);
        for advice in &report.advice {
            self.paragraph(2, advice.message.get(self.language));
        }
        self.gap();
    }

    fn measurements(&mut self, report: &Report) {
        let labels = self.labels;
        let column = columns(labels.frames).max(columns(labels.probes));
        if !report.frames.is_empty() {
            self.strip(&report.frames, column);
        }
        let probes = &report.probes;
        if probes.samples > 0 {
            let agree = probes.samples.saturating_sub(probes.mismatched);
            let text = labels.probes_agree(agree, probes.samples);
            let heading = self.paint(BOLD, &pad(labels.probes, column));
            self.line(&format!("{heading}  {text}"));
        }
        if let Some(checked) = &report.cross_check {
            self.gap();
            let heading = self.paint(BOLD, labels.interpreter);
            self.line(&format!("{heading}  {}", labels.cross_check(checked)));
            if let Some(message) = &checked.message {
                self.paragraph(2, message.get(self.language));
            }
        }
    }

    fn diagnostics(&mut self, report: &Report, excerpts: Option<&str>) {
        if report.diagnostics.is_empty() {
            return;
        }
        self.gap();
        if let Some(excerpts) = excerpts {
            self.out.push_str(excerpts.trim_end_matches('\n'));
            self.gap();
            return;
        }
        for diagnostic in &report.diagnostics {
            self.diagnostic(report, diagnostic);
        }
    }

    fn diagnostic(&mut self, report: &Report, diagnostic: &Diagnostic) {
        let file = report.file_to_name(diagnostic.file.as_deref());
        let place = diagnostic.line.map(|line| plain(&self.labels.place(file, line, diagnostic.column)));
        let place = place.unwrap_or_else(|| self.labels.stage(diagnostic.stage).to_owned());
        let style = match diagnostic.severity {
            Severity::Error => BAD,
            Severity::Warning => PARTIAL,
            Severity::Note => DIM,
        };
        let severity = self.paint(style.bold(), self.labels.severity(diagnostic.severity));
        self.line(&format!("{severity} · {place}"));
        self.paragraph(2, diagnostic.message.get(self.language));
        if let Some(hint) = &diagnostic.hint {
            self.paragraph(2, &format!("→ {}", hint.get(self.language)));
        }
    }

    fn next(&mut self, report: &Report) {
        let Some(next) = self.labels.next_step(report, self.language) else {
            return;
        };
        self.gap();
        let heading = self.paint(BOLD, self.labels.next);
        self.line(&heading);
        self.paragraph(2, &next);
    }

    fn environment(&mut self, report: &Report) {
        let labels = self.labels;
        let environment = &report.environment;
        let mut facts = vec![format!("ggrade {}", environment.ggrade), report.edition()];
        facts.extend([environment.renderer.clone(), environment.driver.clone()]);
        if report.probes.samples > 0 {
            facts.push(format!("{} {}", labels.seed, report.probes.seed));
        }
        facts.push(format!("{:.0} ms", report.elapsed_ms));
        facts.retain(|fact| !fact.is_empty());
        self.gap();
        for line in wrap(&plain(&facts.join(" · ")), self.width) {
            let line = self.paint(DIM, &line);
            self.line(&line);
        }
    }
}

fn verdict_mark(report: &Report) -> (&'static str, Style) {
    match report.verdict {
        Verdict::Correct => ("✓", GOOD),
        Verdict::Wrong if report.score > 0.0 => ("△", PARTIAL),
        Verdict::Wrong | Verdict::Rejected | Verdict::Stopped => ("✗", BAD),
    }
}

#[cfg(test)]
mod tests;
