//! GitHub Classroom: the result of one submission in the base64 form that the action
//! `classroom-resources/autograding-grading-reporter` reads.

use super::untrusted::{one_line, visible};
use super::wording;
use crate::class::standing::Standing;
use crate::class::{Class, ClassEntry};
use crate::language::Language;
use crate::report::RubricLine;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};

/// Base64 of a JSON object, in one line, for the reporter's `…_RESULTS`.
///
/// It has no way to say "no score": after a failure of ours it is worth 0 of 0 points.
pub fn render(entry: &ClassEntry, class: &Class) -> String {
    let language = class.language;
    let duration = entry.report().map_or(0.0, |report| report.elapsed_ms.round() / 1000.0);
    let mut tests: Vec<_> = rubric(entry).iter().map(|line| test(entry, line, duration, language)).collect();
    if tests.is_empty() {
        tests.push(json!({
            "name": Standing::of(&entry.outcome).word(language),
            "status": status(entry),
            "score": 0,
            "message": message(entry, language),
            "test_code": "",
            "filename": file_name(entry),
            "line_no": 0,
            "duration": 0,
        }));
    }
    let result = json!({
        "version": 1,
        "status": status(entry),
        "max_score": entry.report().map_or(0.0, |report| report.max_score),
        "tests": tests,
    });
    format!("{}\n", STANDARD.encode(result.to_string()))
}

fn rubric(entry: &ClassEntry) -> &[RubricLine] {
    entry.report().map_or(&[], |report| &report.rubric)
}

/// `pass`, `fail`, or `error` where it is no doing of the student's.
fn status(entry: &ClassEntry) -> &'static str {
    match Standing::of(&entry.outcome) {
        Standing::Correct => "pass",
        Standing::Wrong | Standing::Rejected | Standing::Stopped | Standing::NotGraded => "fail",
        Standing::Fault => "error",
    }
}

/// What is said of the submission as a whole: the outcome, then what the stages say about places in it.
fn message(entry: &ClassEntry, language: Language) -> String {
    let mut lines = vec![wording::explanation(entry, language)];
    lines.extend(wording::fault(entry, language));
    for (report, diagnostic) in entry.diagnostics() {
        lines.push(format!(
            "{}: {}",
            wording::place(report, diagnostic, language),
            wording::message(diagnostic, language)
        ));
    }
    lines.join("\n")
}

fn line_status(line: &RubricLine) -> &'static str {
    if wording::is_full(line) { "pass" } else { "fail" }
}

fn test(entry: &ClassEntry, line: &RubricLine, duration: f64, language: Language) -> Value {
    // Where nothing ran, what the compiler says is what the student needs.
    let nothing_ran = matches!(Standing::of(&entry.outcome), Standing::Rejected | Standing::Stopped);
    let message = if nothing_ran { message(entry, language) } else { visible(line.message.get(language)) };
    json!({
        // The reporter shows points of the whole run only; those of the line stand in its name.
        "name": wording::rubric_title(line, language),
        "status": line_status(line),
        "score": line.points,
        "message": message,
        "test_code": one_line(line.mistake.as_deref().unwrap_or_default()),
        "filename": one_line(entry.place(line.file.as_deref()).map_or("", |place| &place.path)),
        "line_no": line.line.unwrap_or(0),
        "duration": duration,
    })
}

fn file_name(entry: &ClassEntry) -> String {
    one_line(&entry.path().unwrap_or_default())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::class::formats::nasty;
    use crate::report::samples;

    /// As the reporter reads it: base64 of UTF-8 JSON.
    fn decoded(entry: &ClassEntry) -> Value {
        let text = render(entry, &nasty::class());
        let line = text.strip_suffix('\n').unwrap();
        assert!(line.bytes().all(|b| b.is_ascii_alphanumeric() || b"+/=".contains(&b)), "{line}");
        serde_json::from_slice(&STANDARD.decode(line).expect("base64")).expect("JSON")
    }

    #[test]
    fn each_outcome_has_its_status() {
        let results: Vec<_> = nasty::class().entries.iter().map(decoded).collect();
        let status: Vec<_> = results.iter().map(|result| result["status"].as_str().unwrap()).collect();
        assert_eq!(status, ["pass", "fail", "fail", "fail", "fail", "error"]);
        let rejected = results[2]["tests"][0]["message"].as_str().unwrap();
        assert!(rejected.contains("line 11, column 12: `Max` is not declared."), "{rejected}");
    }

    #[test]
    fn the_scores_add_up_in_the_reporter() {
        for entry in &nasty::class().entries {
            let result = decoded(entry);
            // The reporter adds the scores of the tests and holds them against max_score.
            let sum: f64 = result["tests"].as_array().unwrap().iter().map(|test| test["score"].as_f64().unwrap()).sum();
            let expected = entry.report().map_or((0.0, 0.0), |report| (report.score, report.max_score));
            assert_eq!((sum, result["max_score"].as_f64().unwrap()), expected);
        }
        let wrong = decoded(&nasty::class().entries[1]);
        assert_eq!(wrong["version"], 1);
        let specular = &wrong["tests"][3];
        assert_eq!(specular["name"], "Specular 20 / 40");
        assert_eq!((&specular["status"], &specular["line_no"]), (&json!("fail"), &json!(11)));
        // 412.25 ms.
        assert_eq!((&wrong["tests"][0]["status"], &wrong["tests"][0]["duration"]), (&json!("pass"), &json!(0.412)));
    }

    #[test]
    fn a_failure_of_ours_takes_no_points() {
        let result = decoded(&nasty::class().entries[5]);
        assert_eq!((&result["status"], &result["max_score"]), (&json!("error"), &json!(0.0)));
    }

    #[test]
    fn what_students_write_is_shown_and_not_obeyed() {
        let result = decoded(&nasty::attack(samples::wrong()));
        assert_eq!(result["tests"][0]["message"], visible(nasty::NASTY));
    }
}
