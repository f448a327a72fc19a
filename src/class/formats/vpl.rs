//! Moodle's Virtual Programming Lab (VPL): what `vpl_execution` prints when it evaluates one submission.
//!
//! VPL reads the output line by line. `<|--` and `--|>` stand around the comment, in which a line that begins with `-`
//! is a heading and one that begins with `>` is shown as it is; `Grade :=>>` proposes the grade, the last one wins.

use super::untrusted::visible;
use super::wording;
use crate::class::standing::Standing;
use crate::class::{ClassEntry, Outcome};
use crate::language::{Language, Text};
use crate::report::text::number;
use std::fmt::Write;

/// The range of grades of the activity; VPL gives it in `VPL_GRADEMIN` and `VPL_GRADEMAX`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    /// The grade for no points.
    pub min: f64,
    /// The grade for all points.
    pub max: f64,
}

impl Default for Scale {
    /// The rubric's own points.
    fn default() -> Self {
        Self { min: 0.0, max: 100.0 }
    }
}

impl Scale {
    /// The scale that VPL's variables give, each as its text; what is missing or no number is as by default.
    pub fn from_variables(min: Option<&str>, max: Option<&str>) -> Self {
        let number = |text: Option<&str>| text?.trim().parse().ok().filter(|value: &f64| value.is_finite());
        let usual = Self::default();
        let scale = Self { min: number(min).unwrap_or(usual.min), max: number(max).unwrap_or(usual.max) };
        if scale.max > scale.min { scale } else { usual }
    }

    fn grade(self, share: f64) -> f64 {
        self.min + share.clamp(0.0, 1.0) * (self.max - self.min)
    }
}

/// The output for one submission. After a failure of ours it proposes no grade, and VPL leaves the grading to a teacher.
pub fn render(entry: &ClassEntry, scale: Scale, language: Language) -> String {
    let mut comment = VplComment(String::from("<|--\n"));
    comment.heading(Standing::of(&entry.outcome).word(language));
    comment.text(&wording::explanation(entry, language));
    if let Some(report) = entry.report() {
        for diagnostic in &report.diagnostics {
            comment.heading(&wording::place(report, diagnostic, language));
            comment.text(&wording::message(diagnostic, language));
        }
        for line in &report.rubric {
            comment.heading(&wording::rubric_title(line, language));
            comment.text(line.message.get(language));
        }
    }
    comment.close();
    let share = match &entry.outcome {
        Outcome::Graded(report) => Some(report.total() / report.max_score),
        Outcome::NotGraded(_) => Some(0.0),
        Outcome::Fault(_) => None,
    };
    let mut text = comment.0;
    match share.filter(|share| share.is_finite()) {
        // VPL shows at most five decimals; two are what grades have.
        Some(share) => {
            let _ = writeln!(text, "Grade :=>> {}", number(scale.grade(share)));
        }
        None => {
            let fault = wording::fault(entry, language).unwrap_or_default();
            let word = Text::new("For the staff", "担当者へ");
            let _ = writeln!(text, "Comment :=>> {}: {}", word.get(language), harmless(&fault.replace('\n', " ")));
        }
    }
    text
}

/// A comment in which no line is one of VPL's own.
struct VplComment(String);

impl VplComment {
    fn heading(&mut self, text: &str) {
        let _ = writeln!(self.0, "-{}", harmless(&text.replace('\n', " ")));
    }

    fn text(&mut self, text: &str) {
        for line in harmless(text).split('\n') {
            // A line of text is neither a heading nor preformatted, whatever it begins with.
            let guard = if line.starts_with(['-', '>', '<']) { " " } else { "" };
            let _ = writeln!(self.0, "{guard}{line}");
        }
    }

    fn close(&mut self) {
        self.0.push_str("--|>\n");
    }
}

/// The text without anything that VPL reads as its own, wherever in a line it stands.
fn harmless(text: &str) -> String {
    visible(text).replace(":=>>", ": = > >").replace("--|>", "-- | >").replace("<|--", "< | --")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::class::formats::nasty;
    use crate::report::samples;

    /// What VPL makes of an output, by the rules above: proposed grade, and the comment's lines.
    fn read(output: &str) -> (Option<&str>, Vec<&str>) {
        let (mut grade, mut comment, mut inside) = (None, Vec::new(), false);
        // VPL takes the line end that it finds: CR where there is no LF.
        for line in output.split(['\n', '\r']) {
            if let Some(proposed) = line.strip_prefix("Grade :=>>") {
                grade = Some(proposed.trim());
            } else if line.trim() == "<|--" {
                inside = true;
            } else if line.trim() == "--|>" {
                inside = false;
            } else if inside {
                comment.push(line);
            } else if let Some(line) = line.strip_prefix("Comment :=>>") {
                comment.push(line);
            } else {
                assert_eq!(line, "", "outside of every tag");
            }
        }
        assert!(!inside, "the comment stays open");
        (grade, comment)
    }

    fn output(index: usize, scale: Scale) -> String {
        render(&nasty::class().entries[index], scale, Language::En)
    }

    #[test]
    fn the_grade_is_scaled_to_the_activity() {
        let ten = Scale { min: 0.0, max: 10.0 };
        let grades = |scale| (0..6).map(|i| read(&output(i, scale)).0.map(str::to_owned)).collect::<Vec<_>>();
        let some = |grades: [&str; 5]| grades.map(|grade| Some(grade.to_owned())).into_iter().chain([None]);
        assert_eq!(grades(ten), some(["10", "8", "0", "0", "0"]).collect::<Vec<_>>());
        // 80 of 100 points from 1 to 5: 1 + 0.8 · 4 = 4.2.
        assert_eq!(grades(Scale { min: 1.0, max: 5.0 })[1].as_deref(), Some("4.2"));
    }

    #[test]
    fn a_failure_of_ours_proposes_no_grade() {
        let output = output(5, Scale::default());
        assert_eq!(read(&output).0, None);
        assert!(output.contains("costs no points") && output.contains("For the staff: no driver in /usr/share"));
    }

    #[test]
    fn nobody_writes_a_grade_or_leaves_the_comment() {
        for report in samples::all() {
            let expected = number(report.score);
            let output = render(&nasty::attack(report), Scale::default(), Language::En);
            assert_eq!(read(&output).0, Some(expected.as_str()), "{output}");
            assert_eq!(output.matches(":=>>").count(), 1, "{output}");
            assert!(!output.contains(['\r', '\0', '\u{1B}']));
        }
        let output = output(4, Scale::default());
        assert_eq!(read(&output).0, Some("0"));
    }

    #[test]
    fn headings_are_ours() {
        let entry = nasty::attack(samples::rejected());
        let output = render(&entry, Scale::default(), Language::En);
        let (_, comment) = read(&output);
        let headings = comment.iter().filter(|line| line.starts_with('-')).count();
        // The verdict, three diagnostics, four rubric lines.
        assert_eq!(headings, 8, "{output}");
    }

    #[test]
    fn a_scale_that_makes_no_sense_is_the_usual_one() {
        let scale = |min, max| Scale::from_variables(min, max);
        assert_eq!(scale(Some("0"), Some("10.00000")), Scale { min: 0.0, max: 10.0 });
        for (min, max) in [(None, None), (Some(""), Some("x")), (Some("10"), Some("0")), (None, Some("NaN"))] {
            assert_eq!(scale(min, max), Scale::default());
        }
    }
}
