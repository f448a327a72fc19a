//! The job's summary: Markdown for the file that `$GITHUB_STEP_SUMMARY` names.

use crate::class::formats::untrusted::one_line;
use crate::class::formats::wording;
use crate::class::standing::Standing;
use crate::class::{Class, ClassEntry};
use crate::diagnostic::Severity;
use crate::language::{Language, Text};
use crate::report::html::rich::{MessagePiece, pieces};
use crate::report::labels::mistake_title;
use std::fmt::Write;

/// The most bytes that GitHub takes of one step: 1 MiB. A longer summary is refused whole.
pub const LIMIT: usize = 1 << 20;
/// Bytes kept free for the line that says how much is left out.
const CLOSING: usize = 400;

/// The summary of the class in at most `limit` bytes: counts, then a row a student with the place of report and
/// picture, then what was left out of the input. Rows that do not fit are counted.
pub fn summary(class: &Class, limit: usize) -> String {
    let language = class.language;
    let mut rows = MarkdownRows { out: String::new(), limit: limit.saturating_sub(CLOSING), left_out: 0 };
    rows.push(&format!("## ggrade: {}\n\n", markdown(&class.title)));
    if let [entry] = &class.entries[..] {
        rows.push(&single(entry, language));
    } else {
        rows.push(&format!("{}\n\n{}", counts(class), heading(language)));
        for entry in &class.entries {
            rows.push(&row(entry, class));
        }
    }
    if !class.refused.is_empty() {
        let left = Text::new("Left out of the input", "読み飛ばしたもの");
        rows.push(&format!("\n### {}\n\n", left.get(language)));
        for refused in &class.refused {
            rows.push(&format!("- {}: {}\n", code(&refused.path), markdown(refused.reason.get(language))));
        }
    }
    rows.finish(language)
}

/// Markdown that grows row by row up to its limit.
struct MarkdownRows {
    out: String,
    limit: usize,
    left_out: usize,
}

impl MarkdownRows {
    /// Takes the row whole or not at all, and none after the first that does not fit.
    fn push(&mut self, row: &str) {
        if self.left_out > 0 || self.out.len() + row.len() > self.limit {
            self.left_out += 1;
        } else {
            self.out.push_str(row);
        }
    }

    fn finish(mut self, language: Language) -> String {
        if self.left_out > 0 {
            let more = Text::new(
                format!("\n{} more rows do not fit here: they are in the reports.\n", self.left_out),
                format!("\nほかに {} 行ありますが、ここには収まりません。採点結果をご覧ください。\n", self.left_out),
            );
            self.out.push_str(more.get(language));
        }
        self.out
    }
}

/// How many students stand where.
fn counts(class: &Class) -> String {
    use Standing::{Correct, Fault, NotGraded, Rejected, Stopped, Wrong};
    let count = |standing| class.entries.iter().filter(|entry| Standing::of(&entry.outcome) == standing).count();
    let counts = [Correct, Wrong, Rejected, Stopped, NotGraded, Fault].map(|standing| (standing, count(standing)));
    let counts = counts.iter().filter(|(_, count)| *count > 0);
    counts.map(|(standing, count)| format!("{} {count}", standing.word(class.language))).collect::<Vec<_>>().join(" · ")
}

fn heading(language: Language) -> &'static str {
    match language {
        Language::En => {
            "| Student | Outcome | Score | Mistakes and errors | Report and pictures |\n| --- | --- | ---: | --- | --- |\n"
        }
        Language::Ja => "| 学生 | 結果 | 得点 | 間違いとエラー | 採点結果と画像 |\n| --- | --- | ---: | --- | --- |\n",
    }
}

fn row(entry: &ClassEntry, class: &Class) -> String {
    let language = class.language;
    let report = entry.report();
    let score = report.map(wording::result).unwrap_or_default();
    let detail = match report {
        Some(report) => match report.diagnostics.iter().find(|diagnostic| diagnostic.severity == Severity::Error) {
            Some(error) => {
                let place = wording::place(report, error, language);
                format!("{}: {}", markdown(&place), rich(error.message.get(language)))
            }
            None => {
                let title = |id: &String| markdown(&mistake_title(&class.assignment, id, language));
                report.mistakes.iter().map(title).collect::<Vec<_>>().join(" · ")
            }
        },
        None => {
            let fault = wording::fault(entry, language);
            rich(&fault.unwrap_or_else(|| wording::explanation(entry, language)))
        }
    };
    let page = entry.page.as_ref().map(|page| code(&page.to_string_lossy())).unwrap_or_default();
    let name = markdown(&entry.student.name);
    format!("| {name} | {} | {score} | {detail} | {page} |\n", Standing::of(&entry.outcome).word(language))
}

/// The rubric and the diagnostics of the only student.
fn single(entry: &ClassEntry, language: Language) -> String {
    let mut out = format!("**{}**", Standing::of(&entry.outcome).word(language));
    if let Some(report) = entry.report() {
        let _ = write!(out, " {}", wording::result(report));
    }
    let _ = writeln!(out, "\n\n{}\n", rich(&wording::explanation(entry, language)));
    if let Some(fault) = wording::fault(entry, language) {
        let _ = writeln!(out, "{}\n", rich(&fault));
    }
    let Some(report) = entry.report() else { return out };
    out.push_str(match language {
        Language::En => "| Rubric | Points | Mistake | Feedback |\n| --- | ---: | --- | --- |\n",
        Language::Ja => "| 項目 | 得点 | 間違い | 講評 |\n| --- | ---: | --- | --- |\n",
    });
    for line in &report.rubric {
        let label = markdown(line.label.get(language));
        let points = wording::points(line.points, line.max_points);
        let mistake = line.mistake.as_deref().map(code).unwrap_or_default();
        let _ = writeln!(out, "| {label} | {points} | {mistake} | {} |", rich(line.message.get(language)));
    }
    out.push('\n');
    for diagnostic in &report.diagnostics {
        let place = wording::place(report, diagnostic, language);
        let _ = writeln!(out, "- **{}** {}", markdown(&place), rich(&wording::message(diagnostic, language)));
    }
    out
}

/// Text in one line that Markdown takes for nothing but text: an ASCII punctuation mark may mean something (emphasis,
/// a table's cell, HTML, a link made of a bare address), its numeric reference never does.
fn markdown(text: &str) -> String {
    let escape = |c: char| if c.is_ascii_punctuation() { format!("&#{};", u32::from(c)) } else { c.to_string() };
    one_line(text).chars().map(escape).collect()
}

/// A message in one line, its `code` in a typewriter's letters.
fn rich(message: &str) -> String {
    let piece = |piece: MessagePiece| if piece.code { code(&piece.text) } else { markdown(&piece.text) };
    pieces(message).into_iter().map(piece).collect()
}

/// The same in a typewriter's letters.
fn code(text: &str) -> String {
    format!("<code>{}</code>", markdown(text))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::class::Outcome;
    use crate::class::formats::nasty;
    use crate::intake::Refused;
    use crate::report::samples;

    #[test]
    fn everyone_has_a_row() {
        let summary = summary(&nasty::class(), LIMIT);
        assert!(summary.contains("Correct 1 · Not right yet 1 · Not accepted 1 · Stopped 1 · Nothing to grade 1"));
        assert!(summary.contains("| Student 0 | Correct | 100 / 100 |  |  |\n"), "{summary}");
        let mistake = "Half vector not normalised";
        assert!(summary.contains(&format!("| Student 1 | Not right yet | 80 / 100 | {mistake} |  |\n")), "{summary}");
        let error =
            "| Student 2 | Not accepted | 0 / 100 | error · line 11&#44; column 12: <code>Max</code> is not declared";
        assert!(summary.contains(error), "{summary}");
        // No score where we failed, nor where there was nothing to grade.
        assert!(summary.contains("| Student 5 | Grading failed |  | no driver"), "{summary}");
        assert!(summary.contains("| Student 4 | Nothing to grade |  | There is no"), "{summary}");
    }

    #[test]
    fn no_row_is_broken_open() {
        let mut class = nasty::class();
        class.entries = vec![nasty::attack(samples::wrong()), nasty::attack(samples::rejected())];
        class.entries[0].page = Some(nasty::NASTY.into());
        class.refused = vec![Refused { path: nasty::NASTY.into(), reason: Text::verbatim(nasty::NASTY) }];
        let summary = summary(&class, LIMIT);
        let rows: Vec<_> = summary.lines().filter(|line| line.starts_with('|')).collect();
        assert_eq!(rows.len(), 4, "{summary}");
        assert!(rows.iter().all(|row| row.matches('|').count() == 6), "{summary}");
        let ours = summary.replace("<code>", "").replace("</code>", "");
        assert!(!ours.contains(['<', '>', '`', '@', '[', '_', '\u{1B}', '\r', '\0', '\u{202E}']), "{ours}");
    }

    #[test]
    fn one_student_has_the_rubric_and_the_messages() {
        let entry = nasty::entry(1, Outcome::Graded(Box::new(samples::wrong())));
        let class = Class { entries: vec![entry], language: Language::Ja, ..nasty::class() };
        let summary = summary(&class, LIMIT);
        assert!(summary.contains("| 鏡面反射光 | 20 / 40 | <code>specular&#45;half&#45;unnormalized</code> |"));
        assert!(summary.contains("**修正が必要です** 80 / 100\n"), "{summary}");
        assert!(summary.contains("<code>h</code>") && !summary.contains('`'), "{summary}");
        assert!(summary.contains("12 行目 9 文字目"), "{summary}");
    }

    #[test]
    fn a_large_class_stays_below_the_limit_and_says_how_many_are_missing() {
        let mut class = nasty::class();
        let entry = class.entries[1].clone();
        class.entries = vec![entry; 1000];
        // Far less than 1000 rows of at least 60 bytes.
        let summary = summary(&class, 10_000);
        assert!(summary.len() <= 10_000);
        let rows = summary.lines().filter(|line| line.starts_with("| Student")).count() - 1;
        assert!(summary.ends_with(&format!("\n{} more rows do not fit here: they are in the reports.\n", 1000 - rows)));
    }
}
