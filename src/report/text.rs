//! The report for a terminal.

use super::difference::{band_of, shades};
use super::labels::Labels;
use super::wrap::{columns, pad, plain, wrap};
use super::{FrameResult, Report, RubricLine, Verdict};
use crate::diagnostic::{Diagnostic, Severity};
use crate::language::Language;
use anstyle::{AnsiColor, Style};

/// How to write a report.
#[derive(Clone, Copy, Debug)]
pub struct Options<'a> {
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
/// Columns of a bar of the rubric.
const BAR: usize = 10;

const BOLD: Style = Style::new().bold();
const DIM: Style = Style::new().dimmed();
const GOOD: Style = AnsiColor::Green.on_default();
const PARTIAL: Style = AnsiColor::Yellow.on_default();
const BAD: Style = AnsiColor::Red.on_default();
const CODE: Style = AnsiColor::Cyan.on_default();

/// The report as text, with a final newline.
pub fn render(report: &Report, options: &Options) -> String {
    let mut writer = Writer {
        out: String::new(),
        labels: Labels::of(options.language),
        language: options.language,
        width: options.width.clamp(NARROWEST, WIDEST),
        colour: options.colour,
    };
    writer.head(report);
    if matches!(report.verdict, Verdict::Rejected | Verdict::Stopped) {
        writer.diagnostics(report, options.excerpts);
    } else {
        writer.rubric(report);
        writer.measurements(report);
        writer.diagnostics(report, options.excerpts);
    }
    writer.next(report);
    writer.environment(report);
    writer.out
}

/// A number with at most two decimals, and none that says nothing.
pub(super) fn number(value: f64) -> String {
    if !value.is_finite() {
        return "–".into();
    }
    let text = format!("{value:.2}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

struct Writer {
    out: String,
    labels: &'static Labels,
    language: Language,
    width: usize,
    colour: bool,
}

impl Writer {
    fn paint(&self, style: Style, text: &str) -> String {
        if self.colour {
            format!("{style}{text}{style:#}")
        } else {
            text.to_owned()
        }
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

    fn bar(&self, share: f64, width: usize, style: Style) -> String {
        let filled = filled(share, width);
        let rest = self.paint(DIM, &"─".repeat(width - filled));
        format!("{}{rest}", self.paint(style, &"━".repeat(filled)))
    }

    fn head(&mut self, report: &Report) {
        let style = verdict_style(report.verdict);
        let verdict = self.labels.verdict(report.verdict);
        let title = format!("{} {verdict}", verdict_mark(report.verdict));
        let name = plain(&report.source.name);
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

    fn rubric(&mut self, report: &Report) {
        let labels = report
            .rubric
            .iter()
            .map(|line| columns(line.label.get(self.language)));
        let column = labels.max().unwrap_or(0);
        let full = report.verdict == Verdict::Correct;
        self.gap();
        for line in &report.rubric {
            self.rubric_line(line, column);
            if !full {
                self.paragraph(2, line.message.get(self.language));
                self.gap();
            }
        }
        if full {
            self.gap();
        }
    }

    fn rubric_line(&mut self, line: &RubricLine, column: usize) {
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
        let mistake = line.mistake.as_deref().map(plain).unwrap_or_default();
        if used + columns(&mistake) <= self.width {
            let mistake = self.paint(DIM, &mistake);
            self.line(&format!("{text}  {mistake}"));
        } else {
            self.line(&text);
            let mistake = self.paint(DIM, &mistake);
            self.line(&format!("  {mistake}"));
        }
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
    }

    /// One cell a frame, shaded by its largest difference, above the axis of t.
    fn strip(&mut self, frames: &[FrameResult], column: usize) {
        let labels = self.labels;
        let indent = " ".repeat(column + 2);
        let room = self.width - column - 2;
        let cell = if frames.len() * 2 <= room { 2 } else { 1 };
        let agree = frames.iter().filter(|frame| frame.agrees()).count();
        let heading = self.paint(BOLD, &pad(labels.frames, column));
        self.line(&format!(
            "{heading}  {}",
            labels.frames_agree(agree, frames.len())
        ));
        for row in frames.chunks(room / cell) {
            let cells: String = row.iter().map(|frame| self.cell(frame, cell)).collect();
            self.line(&format!("{indent}{cells}"));
            let axis = self.paint(DIM, &axis(row, cell, room));
            self.line(&format!("{indent}{axis}"));
        }
        if agree < frames.len() {
            let ramp: Vec<String> = shades()
                .map(|(shade, range)| format!("{shade} {range}"))
                .collect();
            let legend = format!("· {}  {}", labels.agrees, ramp.join("  "));
            self.legend(column + 2, &legend);
            self.legend(column + 2, labels.legend);
        }
        self.gap();
    }

    fn legend(&mut self, indent: usize, text: &str) {
        let indent = if indent + columns(text) > self.width {
            2
        } else {
            indent
        };
        let room = self.width - indent;
        let lines = if columns(text) <= room { vec![text.to_owned()] } else { wrap(text, room) };
        for line in lines {
            let line = self.paint(DIM, &line);
            self.line(&format!("{}{line}", " ".repeat(indent)));
        }
    }

    fn cell(&self, frame: &FrameResult, width: usize) -> String {
        if frame.agrees() {
            return self.paint(GOOD, &pad("·", width));
        }
        // A frame that differs is never drawn as one that agrees, whatever its numbers are.
        let shade = band_of(frame.max_difference).map_or('░', |band| band.shade);
        self.paint(BAD, &shade.to_string().repeat(width))
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
            self.diagnostic(diagnostic);
        }
    }

    fn diagnostic(&mut self, diagnostic: &Diagnostic) {
        let place = diagnostic
            .line
            .map(|line| self.labels.place(line, diagnostic.column));
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
        let mut facts = vec![format!("ggrade {}", environment.ggrade)];
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

/// Cells of a bar: full only for a full share, empty only for none.
fn filled(share: f64, width: usize) -> usize {
    match share {
        share if share.is_nan() || share <= 0.0 => 0,
        share if share >= 1.0 => width,
        share => ((share * width as f64).round() as usize).clamp(1, width - 1),
    }
}

/// The values of t under the cells that they belong to, wherever there is room for one.
fn axis(frames: &[FrameResult], cell: usize, room: usize) -> String {
    let mut axis = String::new();
    for (index, frame) in frames.iter().enumerate() {
        let label = if index == 0 {
            format!("t = {}", number(frame.t))
        } else {
            number(frame.t)
        };
        let start = index * cell;
        let due = index == 0 || index % 5 == 0 && start >= columns(&axis) + 2;
        if due && start + columns(&label) <= room {
            axis = pad(&axis, start) + &label;
        }
    }
    axis
}

fn mark(points: f64, max_points: f64) -> (&'static str, Style) {
    match points {
        points if points >= max_points => ("✓", GOOD),
        points if points > 0.0 => ("△", PARTIAL),
        _ => ("✗", BAD),
    }
}

fn verdict_mark(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Correct => "✓",
        Verdict::Wrong => "△",
        Verdict::Rejected | Verdict::Stopped => "✗",
    }
}

fn verdict_style(verdict: Verdict) -> Style {
    match verdict {
        Verdict::Correct => GOOD,
        Verdict::Wrong => PARTIAL,
        Verdict::Rejected | Verdict::Stopped => BAD,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::samples;

    fn text(report: &Report, language: Language, width: usize) -> String {
        render(
            report,
            &Options {
                language,
                width,
                colour: false,
                excerpts: None,
            },
        )
    }

    /// Without the line breaks and indents that the width decides.
    fn unwrapped(text: &str) -> String {
        text.split_whitespace().collect()
    }

    #[test]
    fn no_line_is_wider_than_the_terminal() {
        for report in samples::all() {
            for language in [Language::En, Language::Ja] {
                for width in [40, 57, 80, 100] {
                    for line in text(&report, language, width).lines() {
                        assert!(columns(line) <= width, "{width}: {line}");
                    }
                }
            }
        }
    }

    #[test]
    fn wrong_says_what_where_and_how_much() {
        let report = samples::wrong();
        for language in [Language::En, Language::Ja] {
            for width in [40, 80] {
                let text = unwrapped(&text(&report, language, width));
                for line in &report.rubric {
                    assert!(
                        text.contains(&unwrapped(line.message.get(language))),
                        "{text}"
                    );
                    assert!(
                        text.contains(&unwrapped(line.label.get(language))),
                        "{text}"
                    );
                }
                assert!(text.contains("80/100") && text.contains("20/40"), "{text}");
                assert!(text.contains("specular-half-unnormalized"), "{text}");
                assert!(
                    text.contains("seed20240613") || text.contains("シード20240613"),
                    "{text}"
                );
                assert!(text.contains("412ms"), "{text}");
            }
        }
        assert!(text(&report, Language::En, 80).contains("Look at line 11 first"));
        assert!(text(&report, Language::Ja, 80).contains("まず 11 行目"));
    }

    #[test]
    fn the_strip_shades_each_frame_by_its_difference() {
        let text = text(&samples::wrong(), Language::En, 80);
        // The samples cycle through differences of 0, 1, 5, 20, 90 and 255; five frames in 25 agree.
        let cycle = "· ░░▒▒▓▓████";
        assert!(text.contains(&format!("{}·\n", cycle.repeat(4))), "{text}");
        assert!(text.contains("5 of 25 agree"), "{text}");
        assert!(text.contains("409 of 640 agree"), "{text}");
        // Frames 0, 5, 10, 15, 20 of 25, two columns each.
        let axis = "t = 0     0.2       0.4       0.6       0.8\n";
        assert!(text.contains(axis), "{text}");
    }

    #[test]
    fn a_frame_that_differs_is_never_drawn_as_agreeing() {
        let mut report = samples::correct();
        report.verdict = Verdict::Wrong;
        report.frames[0].mismatched_pixels = 3;
        assert!(text(&report, Language::En, 80).contains("24 of 25 agree\n        ░░· "));
    }

    #[test]
    fn correct_says_that_everything_agrees() {
        let report = samples::correct();
        let english = text(&report, Language::En, 80);
        assert!(english.contains("Every frame and every probe agrees."));
        assert!(english.contains("25 of 25 agree") && english.contains("640 of 640 agree"));
        assert!(!english.contains("Next"));
        assert!(
            text(&report, Language::Ja, 80)
                .contains("すべてのフレームとすべての検査点が正解と一致しました。")
        );
    }

    #[test]
    fn rejected_and_stopped_show_their_diagnostics_and_no_empty_tables() {
        for report in [samples::rejected(), samples::stopped()] {
            let text = text(&report, Language::Ja, 80);
            for diagnostic in &report.diagnostics {
                assert!(text.contains(&diagnostic.message.ja), "{text}");
            }
            assert!(
                !text.contains("フレーム") && !text.contains("検査点") && !text.contains("形状"),
                "{text}"
            );
        }
        assert!(
            text(&samples::rejected(), Language::En, 80).contains("error · line 11, column 12")
        );
    }

    #[test]
    fn excerpts_take_the_place_of_the_bare_diagnostics() {
        let options = Options {
            language: Language::En,
            width: 80,
            colour: false,
            excerpts: Some("EXCERPT\n"),
        };
        let text = render(&samples::rejected(), &options);
        assert!(text.contains("\nEXCERPT\n") && !text.contains("not declared"));
    }

    #[test]
    fn colour_adds_nothing_but_colour() {
        for report in samples::all() {
            let options = Options {
                language: Language::Ja,
                width: 80,
                colour: true,
                excerpts: None,
            };
            let coloured = render(&report, &options);
            assert!(coloured.contains('\u{1b}'));
            let bare: String = coloured
                .split('\u{1b}')
                .enumerate()
                .map(|(i, part)| {
                    if i == 0 {
                        part
                    } else {
                        part.split_once('m').expect("an SGR sequence").1
                    }
                })
                .collect();
            let trimmed = |text: &str| {
                text.lines()
                    .map(str::trim_end)
                    .collect::<Vec<_>>()
                    .join("\n")
            };
            assert_eq!(trimmed(&bare), trimmed(&text(&report, Language::Ja, 80)));
        }
    }

    #[test]
    fn a_name_cannot_steer_the_terminal() {
        let mut report = samples::rejected();
        report.source.name = "a\u{1b}]0;owned\u{7}.vert".into();
        report.diagnostics[0].message = crate::language::Text::verbatim("\u{1b}[2J");
        assert!(!text(&report, Language::En, 80).contains('\u{1b}'));
    }

    #[test]
    fn a_bar_is_full_or_empty_only_when_it_says_so() {
        assert_eq!(
            [
                filled(0.0, 10),
                filled(0.001, 10),
                filled(0.999, 10),
                filled(1.0, 10)
            ],
            [0, 1, 9, 10]
        );
        assert_eq!(filled(0.0 / 0.0, 10), 0);
        assert_eq!(filled(0.5, 10), 5);
    }

    #[test]
    fn numbers_are_short() {
        assert_eq!(
            [80.0, 62.5, 33.333, f64::NAN].map(number),
            ["80", "62.5", "33.33", "–"]
        );
    }
}
