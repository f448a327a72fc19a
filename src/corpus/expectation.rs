//! What a sample's report must say, wording included: a message that changes is a change that someone blesses.

use crate::diagnostic::{DiagnosticStage, Severity};
use crate::language::Text;
use crate::report::{Repair, Report, Verdict};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// What a report must say.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Expectation {
    /// The verdict.
    pub verdict: Verdict,
    /// The score.
    pub score: f64,
    /// Ids of the mistakes.
    pub mistakes: Vec<String>,
    /// What each rubric line says, by its id.
    pub rubric: BTreeMap<String, ExpectedLine>,
    /// What would make it right, for who teaches.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub repairs: Vec<Repair>,
    /// What would break elsewhere, by its id.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub advice: BTreeMap<String, ExpectedAdvice>,
    /// The diagnostics, in their order.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub diagnostics: Vec<ExpectedDiagnostic>,
}

/// What a rubric line says.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ExpectedLine {
    /// The points.
    pub points: f64,
    /// The file of that line, where the sample has several.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// The line of the file that is named, from 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub line: Option<u32>,
    /// The message.
    pub message: Text,
}

/// What a piece of advice says.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ExpectedAdvice {
    /// The file of that line, where the sample has several.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// The line of the file that is named, from 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub line: Option<u32>,
    /// The message.
    pub message: Text,
}

/// What a diagnostic says, and where it points.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ExpectedDiagnostic {
    /// Error, warning or note.
    pub severity: Severity,
    /// The stage that speaks.
    pub stage: DiagnosticStage,
    /// The file, where the sample has several.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// Line, from 1.
    pub line: Option<u32>,
    /// Column, from 1.
    pub column: Option<u32>,
    /// The message.
    pub message: Text,
    /// What to look at next.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hint: Option<Text>,
}

impl Expectation {
    /// What this report says.
    pub fn of(report: &Report) -> Self {
        let file = |file: Option<&str>| report.file_to_name(file).map(str::to_owned);
        let rubric = report.rubric.iter().map(|line| {
            let said = ExpectedLine {
                points: line.points,
                file: file(line.file.as_deref()),
                line: line.line,
                message: line.message.clone(),
            };
            (line.id.clone(), said)
        });
        let advice = report.advice.iter().map(|advice| {
            let file = advice.line.and_then(|_| file(Some(&advice.file)));
            (advice.id.clone(), ExpectedAdvice { file, line: advice.line, message: advice.message.clone() })
        });
        let diagnostics = report.diagnostics.iter().map(|diagnostic| ExpectedDiagnostic {
            severity: diagnostic.severity,
            stage: diagnostic.stage,
            file: file(diagnostic.file.as_deref()),
            line: diagnostic.line,
            column: diagnostic.column,
            message: diagnostic.message.clone(),
            hint: diagnostic.hint.clone(),
        });
        Self {
            verdict: report.verdict,
            score: report.score,
            mistakes: report.mistakes.clone(),
            rubric: rubric.collect(),
            repairs: report.repairs.clone(),
            advice: advice.collect(),
            diagnostics: diagnostics.collect(),
        }
    }

    /// Whether a report that says `found` is as expected. A number that was measured may differ in its last digit, which
    /// another driver rounds otherwise.
    pub fn agrees(&self, found: &Self) -> bool {
        *self == self.rounded_alike(found)
    }

    /// The texts that are not as expected: whose they are, what is expected, what was found.
    pub fn changed_texts(&self, found: &Self) -> Vec<(String, Text, Text)> {
        let found = self.rounded_alike(found);
        let mut texts: BTreeMap<String, [Text; 2]> = BTreeMap::new();
        for (index, expectation) in [self.clone(), found].iter_mut().enumerate() {
            for (name, text) in expectation.texts() {
                texts.entry(name).or_default()[index].clone_from(text);
            }
        }
        let changed = texts.into_iter().filter(|(_, [expected, found])| expected != found);
        changed.map(|(name, [expected, found])| (name, expected, found)).collect()
    }

    /// `found`, with the numbers of this where they differ by their last digit alone.
    fn rounded_alike(&self, found: &Self) -> Self {
        let (mut expected, mut found) = (self.clone(), found.clone());
        let expected: BTreeMap<_, _> = expected.texts().into_iter().collect();
        for (name, text) in found.texts() {
            if let Some(expected) = expected.get(&name)
                && agree(&expected.en, &text.en)
                && agree(&expected.ja, &text.ja)
            {
                text.clone_from(expected);
            }
        }
        found
    }

    /// Its texts, each with a name.
    fn texts(&mut self) -> Vec<(String, &mut Text)> {
        let mut texts = Vec::new();
        for (id, line) in &mut self.rubric {
            texts.push((id.clone(), &mut line.message));
        }
        for (id, advice) in &mut self.advice {
            texts.push((format!("advice {id}"), &mut advice.message));
        }
        for (number, diagnostic) in (1..).zip(&mut self.diagnostics) {
            texts.push((format!("diagnostic {number}"), &mut diagnostic.message));
            if let Some(hint) = &mut diagnostic.hint {
                texts.push((format!("hint {number}"), hint));
            }
        }
        texts
    }
}

/// Whether two texts are the same, but for the last digit of a number with a decimal point.
fn agree(expected: &str, found: &str) -> bool {
    let (expected, found) = (pieces(expected), pieces(found));
    expected.len() == found.len() && expected.iter().zip(&found).all(|(a, b)| a == b || differ_in_last_digit(a, b))
}

/// A text cut into its numbers and what stands between them.
fn pieces(text: &str) -> Vec<&str> {
    let is_number = |c: char| c.is_ascii_digit() || c == '.';
    let mut rest = text;
    std::iter::from_fn(|| {
        let first = rest.chars().next()?;
        let end = rest.find(|c| is_number(c) != is_number(first)).unwrap_or(rest.len());
        let (piece, after) = rest.split_at(end);
        rest = after;
        Some(piece)
    })
    .collect()
}

fn differ_in_last_digit(a: &str, b: &str) -> bool {
    let decimals =
        |number: &str| number.trim_end_matches('.').split_once('.').map_or(0, |(_, decimals)| decimals.len());
    let digits = decimals(a).max(decimals(b));
    let value = |number: &str| number.trim_end_matches('.').parse::<f64>().ok();
    let (Some(a), Some(b)) = (value(a), value(b)) else { return false };
    let unit = 0.1_f64.powi(digits as i32);
    // Half a unit more, so that the difference of two decimal numbers is not judged by its own rounding.
    digits > 0 && (a - b).abs() < 1.5 * unit
}

#[cfg(test)]
mod tests {
    use super::agree;

    #[test]
    fn wording_agrees_up_to_the_last_digit_of_a_measured_number() {
        let said = "The colour should be 0.494, 0.3, 0; yours is 1. Look at line 31.";
        assert!(agree(said, said));
        assert!(agree(said, "The colour should be 0.493, 0.301, 0; yours is 1.0. Look at line 31."));
        assert!(agree("yours is 1 here", "yours is 0.999 here"));
    }

    #[test]
    fn wording_differs_by_a_word_a_digit_or_a_whole_number() {
        let said = "The colour should be 0.494; look at line 31.";
        for other in [
            "The color should be 0.494; look at line 31.",
            "The colour should be 0.496; look at line 31.",
            "The colour should be 0.494; look at line 32.",
            "The colour should be 0.494; look at line 31",
            "The colour should be 0.494; look at line 31. Why?",
            "The colour should be ; look at line 31.",
            "",
        ] {
            assert!(!agree(said, other), "{other}");
        }
    }
}
