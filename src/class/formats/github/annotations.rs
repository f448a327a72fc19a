//! Annotations: `::error file=…,line=…::message`.

use crate::class::formats::untrusted::{one_line, visible};
use crate::class::formats::wording;
use crate::class::standing::Standing;
use crate::class::{Class, ClassEntry};
use crate::diagnostic::{Diagnostic, Severity};
use crate::intake::FileLocation;
use crate::language::{Language, Text};
use crate::report::{Report, RubricLine, Verdict};
use std::collections::VecDeque;
use std::fmt::Write;

/// How many annotations of one level GitHub shows of a step; more are dropped without a word.
const SHOWN: usize = 10;

/// The levels, the weightiest first, by the names of their commands.
const LEVELS: [&str; 3] = ["error", "warning", "notice"];

/// One annotation.
struct Annotation<'a> {
    level: &'static str,
    entry: &'a ClassEntry,
    place: Option<&'a FileLocation>,
    line: Option<u32>,
    columns: Option<(u32, u32)>,
    title: String,
    message: String,
}

/// The annotations of the class that GitHub shows, as workflow commands, a line each.
///
/// Of each level everyone's first comes before anyone's second; what does not fit is counted in the last notice.
pub fn annotations(class: &Class) -> String {
    let language = class.language;
    let all: Vec<_> = class.entries.iter().flat_map(|entry| of_entry(entry, language)).collect();
    let mut out = String::new();
    let mut left_out = 0;
    for level in LEVELS {
        let fair = in_turns(all.iter().filter(|annotation| annotation.level == level));
        // The last notice may have to say what is left out.
        let room = if level == "notice" { SHOWN - 1 } else { SHOWN };
        left_out += fair.len().saturating_sub(room);
        for annotation in fair.into_iter().take(room) {
            annotation.write(&mut out);
        }
    }
    if left_out > 0 {
        let more = Text::new(
            format!("{left_out} more messages are in the job summary and in the reports."),
            format!("ほかに {left_out} 件のメッセージがあります。ジョブサマリーと採点結果をご覧ください。"),
        );
        let _ = writeln!(out, "::notice::{}", data(more.get(language)));
    }
    out
}

/// The annotations, everyone's first before anyone's second; those of one student are neighbours in `annotations`.
fn in_turns<'a>(annotations: impl Iterator<Item = &'a Annotation<'a>>) -> Vec<&'a Annotation<'a>> {
    let mut students: VecDeque<VecDeque<&Annotation>> = VecDeque::new();
    for annotation in annotations {
        match students.back_mut() {
            Some(of_one) if of_one.back().is_some_and(|last| std::ptr::eq(last.entry, annotation.entry)) => {
                of_one.push_back(annotation);
            }
            _ => students.push_back(VecDeque::from([annotation])),
        }
    }
    let mut fair = Vec::new();
    while let Some(mut of_one) = students.pop_front() {
        fair.extend(of_one.pop_front());
        if !of_one.is_empty() {
            students.push_back(of_one);
        }
    }
    fair
}

fn of_entry(entry: &ClassEntry, language: Language) -> Vec<Annotation<'_>> {
    let standing = Standing::of(&entry.outcome);
    let Some(report) = entry.report() else {
        let message = wording::fault(entry, language).unwrap_or_else(|| wording::explanation(entry, language));
        let title = title(entry, standing.word(language));
        return vec![Annotation {
            level: "error",
            entry,
            place: entry.place(None),
            line: None,
            columns: None,
            title,
            message,
        }];
    };
    let lost = report.rubric.iter().filter(|line| !wording::is_full(line));
    // Where nothing ran, the lines of the rubric say nothing that the diagnostics do not.
    let lost = lost.filter(|_| report.verdict == Verdict::Wrong).map(|line| of_rubric(entry, line, language));
    lost.chain(report.diagnostics.iter().map(|diagnostic| of_diagnostic(entry, report, diagnostic, language))).collect()
}

fn of_rubric<'a>(entry: &'a ClassEntry, line: &RubricLine, language: Language) -> Annotation<'a> {
    Annotation {
        level: "warning",
        entry,
        place: entry.place(line.file.as_deref()),
        line: line.line,
        columns: None,
        title: title(entry, &wording::rubric_title(line, language)),
        message: visible(line.message.get(language)),
    }
}

fn of_diagnostic<'a>(
    entry: &'a ClassEntry,
    report: &Report,
    diagnostic: &Diagnostic,
    language: Language,
) -> Annotation<'a> {
    let level = match diagnostic.severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
        Severity::Note => "notice",
    };
    Annotation {
        level,
        entry,
        place: entry.place(diagnostic.file.as_deref()),
        line: diagnostic.line,
        columns: diagnostic.column.map(|column| (column, column.saturating_add(diagnostic.length.max(1) - 1))),
        title: title(entry, &wording::place(report, diagnostic, language)),
        message: wording::message(diagnostic, language),
    }
}

fn title(entry: &ClassEntry, what: &str) -> String {
    one_line(&format!("{}: {what}", entry.student.name))
}

impl Annotation<'_> {
    fn write(&self, out: &mut String) {
        let mut properties = Vec::new();
        let mut property = |name: &str, value: &str| properties.push(format!("{name}={}", escaped(value)));
        match (self.place.and_then(|place| place.local.as_ref()), self.place) {
            (Some(file), _) => {
                property("file", &visible(&file.to_string_lossy()));
                if let Some(line) = self.line {
                    property("line", &line.to_string());
                    property("endLine", &line.to_string());
                }
                if let (Some(_), Some((first, last))) = (self.line, self.columns) {
                    property("col", &first.to_string());
                    property("endColumn", &last.to_string());
                }
                property("title", &self.title);
            }
            // Inside an archive there is no line of the repository to point at.
            (None, Some(place)) => property("title", &one_line(&format!("{} ({})", self.title, place.path))),
            (None, None) => property("title", &self.title),
        }
        let _ = writeln!(out, "::{} {}::{}", self.level, properties.join(","), data(&self.message));
    }
}

/// A command's message, as the toolkit's `escapeData` writes it.
fn data(text: &str) -> String {
    text.replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A")
}

/// A command's property, as the toolkit's `escapeProperty` writes it.
fn escaped(text: &str) -> String {
    data(text).replace(':', "%3A").replace(',', "%2C")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::class::Outcome;
    use crate::class::formats::github::tests::obeyed;
    use crate::class::formats::nasty;
    use crate::report::samples;

    fn class(entries: Vec<ClassEntry>) -> Class {
        Class { entries, ..nasty::class() }
    }

    /// The level, properties and message of a command, as the runner's `TryParseV2` takes them apart.
    fn parsed(command: &str) -> (String, Vec<(String, String)>, String) {
        let (head, message) = command.strip_prefix("::").unwrap().split_once("::").unwrap();
        let (level, properties) = head.split_once(' ').unwrap_or((head, ""));
        let unescape = |text: &str, pairs: &[(&str, &str)]| {
            let text = pairs.iter().fold(text.to_owned(), |text, (from, to)| text.replace(from, to));
            text.replace("%25", "%")
        };
        let data = [("%0D", "\r"), ("%0A", "\n")];
        let property = [("%0D", "\r"), ("%0A", "\n"), ("%3A", ":"), ("%2C", ",")];
        let properties = properties.split(',').filter_map(|pair| pair.split_once('='));
        let properties = properties.map(|(name, value)| (name.to_owned(), unescape(value, &property))).collect();
        (level.to_owned(), properties, unescape(message, &data))
    }

    #[test]
    fn an_error_stands_at_its_line_and_columns() {
        let rejected = nasty::entry(2, Outcome::Graded(Box::new(samples::rejected())));
        let text = annotations(&class(vec![rejected]));
        // "Max" at column 12 with three characters: columns 12 to 14.
        let first = "::error file=student-2/ggsample06.vert,line=11,endLine=11,col=12,endColumn=14,\
                     title=Student 2%3A error · line 11%2C column 12::`Max` is not declared.%0A→ GLSL tells";
        assert!(text.starts_with(first), "{text}");
        assert_eq!(text.lines().count(), 2);
    }

    #[test]
    fn lost_points_warn_at_the_line_that_loses_them() {
        let wrong = nasty::entry(1, Outcome::Graded(Box::new(samples::wrong())));
        let text = annotations(&class(vec![wrong]));
        assert!(text.contains("::warning file=student-1/ggsample06.vert,line=11,endLine=11,title="), "{text}");
        assert!(text.contains("Specular 20 / 40"), "{text}");
    }

    #[test]
    fn what_a_student_wrote_comes_back_whole_and_alone() {
        let entry = nasty::attack(samples::rejected());
        let file = visible(&entry.places[0].local.as_ref().unwrap().to_string_lossy());
        let text = annotations(&class(vec![entry]));
        let commands = obeyed(&text);
        assert_eq!(commands.len(), text.lines().count());
        let (level, properties, message) = parsed(commands[0]);
        assert_eq!(level, "error");
        assert_eq!(properties[0], ("file".into(), file));
        assert_eq!(message, visible(&format!("{0}\n→ {0}", nasty::NASTY)));
    }

    #[test]
    fn everyones_first_error_comes_before_anyones_second() {
        // 12 students with two errors each: the first errors of the first ten are shown.
        let rejected = |index| nasty::entry(index, Outcome::Graded(Box::new(samples::rejected())));
        let text = annotations(&class((0..12).map(rejected).collect()));
        let errors: Vec<_> = text.lines().filter(|line| line.starts_with("::error ")).collect();
        assert_eq!(errors.len(), 10);
        for (index, error) in errors.iter().enumerate() {
            assert!(error.contains(&format!("file=student-{index}/")) && error.contains("Max"), "{error}");
        }
        // 24 errors less the ten that are shown.
        assert!(text.ends_with("::notice::14 more messages are in the job summary and in the reports.\n"), "{text}");
    }

    #[test]
    fn inside_an_archive_no_file_is_named() {
        let mut entry = nasty::entry(2, Outcome::Graded(Box::new(samples::rejected())));
        entry.places[0].local = None;
        let text = annotations(&class(vec![entry]));
        assert!(text.starts_with("::error title=Student 2%3A error · line 11%2C column 12 (student-2/"), "{text}");
    }

    #[test]
    fn our_failure_and_a_missing_file_are_errors_that_say_so() {
        let text = annotations(&nasty::class());
        assert!(text.contains("title=Student 5%3A Grading failed::no driver in /usr/share/vulkan%0A"), "{text}");
        assert!(text.contains("title=Student 4%3A Nothing to grade::There is no .vert file"), "{text}");
    }

    #[test]
    fn of_several_files_each_is_annotated_at_its_own_line() {
        let text = annotations(&class(vec![nasty::two_files()]));
        assert!(text.contains("file=student-7/ggsample11.frag,line=11,endLine=11,title="), "{text}");
        assert!(text.contains("file=student-7/ggsample11.vert,line=12,endLine=12,col=9,"), "{text}");
        assert!(text.contains("title=Student 7%3A warning · ggsample11.vert%2C line 12%2C column 9::"), "{text}");
    }
}
