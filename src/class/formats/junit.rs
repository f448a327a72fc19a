//! JUnit XML for CI: one suite for each student, one case for each line of the rubric.

use super::untrusted::{one_line, visible};
use super::wording;
use crate::class::standing::Standing;
use crate::class::{Class, ClassEntry};
use crate::fault::Fault;
use crate::language::{Language, Text};
use crate::report::text::number;
use crate::report::{Report, RubricLine};
use quick_junit::{NonSuccessKind, Property, TestCase, TestCaseStatus, TestSuite};
use std::time::Duration;

/// The class as one document. A lost point is a failure, a failure of ours an error, nothing handed in a skipped case.
pub fn render(class: &Class) -> Result<String, Fault> {
    let mut document = quick_junit::Report::new(one_line(&format!("ggrade {}: {}", class.assignment.id, class.title)));
    document.add_test_suites(class.entries.iter().map(|entry| suite(entry, class)));
    let skipped = format!(" skipped=\"{}\"", document.skipped);
    // The root is written first, and Jenkins' schema knows this attribute for suites only.
    document.to_string().map(|text| text.replacen(&skipped, "", 1)).map_err(|error| {
        Fault::new(Text::new(
            format!("the JUnit XML could not be written: {error}"),
            format!("JUnit XML を書き出せません: {error}"),
        ))
    })
}

fn suite(entry: &ClassEntry, class: &Class) -> TestSuite {
    let student = &entry.student;
    let mut suite = TestSuite::new(one_line(&if student.name == student.key {
        student.name.clone()
    } else {
        format!("{} ({})", student.name, student.key)
    }));
    suite.add_property(("verdict", Standing::of(&entry.outcome).id()));
    match entry.report() {
        Some(report) => {
            suite.set_time(Duration::try_from_secs_f64(report.elapsed_ms / 1000.0).unwrap_or_default());
            suite.add_properties(properties(report));
            suite.add_test_cases(report.rubric.iter().map(|line| case(entry, report, line, class.language)));
        }
        None => {
            suite.add_test_case(ungraded(entry, class.language));
        }
    }
    for case in &mut suite.test_cases {
        case.set_classname(one_line(&format!("{}.{}", class.assignment.id, student.key)));
    }
    suite
}

fn properties(report: &Report) -> Vec<Property> {
    let mut properties = vec![
        Property::new("score", number(report.score)),
        Property::new("max_score", number(report.max_score)),
        Property::new("file", one_line(&report.file_names())),
        Property::new("assignment_digest", report.assignment_digest.clone()),
        Property::new("seed", report.probes.seed.to_string()),
    ];
    if let Some(lateness) = report.lateness {
        properties.push(Property::new("late_penalty", number(lateness.penalty)));
        properties.push(Property::new("total", number(report.total())));
    }
    properties.extend(report.mistakes.iter().map(|mistake| Property::new("mistake", one_line(mistake))));
    properties
}

fn case(entry: &ClassEntry, report: &Report, line: &RubricLine, language: Language) -> TestCase {
    let name = one_line(line.label.get(language));
    if wording::is_full(line) {
        return TestCase::new(name, TestCaseStatus::success());
    }
    let mut status = TestCaseStatus::non_success(NonSuccessKind::Failure);
    let kind = line.mistake.as_deref().unwrap_or(Standing::of(&entry.outcome).id());
    status.set_message(wording::rubric_title(line, language)).set_type(one_line(kind));
    let mut description = visible(line.message.get(language));
    for diagnostic in &report.diagnostics {
        let (place, message) = (wording::place(report, diagnostic, language), wording::message(diagnostic, language));
        description.push_str(&format!("\n\n{place}\n{message}"));
    }
    status.set_description(description);
    TestCase::new(name, status)
}

fn ungraded(entry: &ClassEntry, language: Language) -> TestCase {
    let standing = Standing::of(&entry.outcome);
    let explanation = wording::explanation(entry, language);
    let status = match standing {
        Standing::Fault => {
            let mut status = TestCaseStatus::non_success(NonSuccessKind::Error);
            status.set_message(standing.word(language)).set_type(standing.id());
            status.set_description(wording::fault(entry, language).unwrap_or(explanation));
            status
        }
        _ => {
            // Jenkins' schema has only text here, no attributes.
            let mut status = TestCaseStatus::skipped();
            status.set_description(explanation);
            status
        }
    };
    TestCase::new("ggrade", status)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::class::Outcome;
    use crate::class::formats::nasty;
    use crate::report::samples;
    use quick_xml::Reader;
    use quick_xml::events::Event;

    fn parsed(class: &Class) -> quick_junit::Report {
        quick_junit::Report::deserialize_from_str(&render(class).expect("XML")).expect("JUnit XML")
    }

    /// Holds a document against Jenkins' schema by libxml2.
    fn validate(document: &str) {
        let schema = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/schemas/jenkins-junit.xsd");
        let mut command = std::process::Command::new("xmllint");
        let piped = std::process::Stdio::piped;
        command.args(["--noout", "--schema", schema, "-"]).stdin(piped()).stderr(piped());
        let mut lint = command.spawn().expect("xmllint, which script/bootstrap --test installs");
        std::io::Write::write_all(&mut lint.stdin.take().unwrap(), document.as_bytes()).unwrap();
        let output = lint.wait_with_output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    }

    #[test]
    fn jenkins_schema_takes_every_outcome() {
        validate(&render(&nasty::class()).unwrap());
        let entries = samples::all().into_iter().map(nasty::attack).collect();
        validate(&render(&Class { entries, language: Language::Ja, ..nasty::class() }).unwrap());
    }

    #[test]
    #[should_panic(expected = "not expected")]
    fn jenkins_schema_refuses_what_is_wrong() {
        validate(&render(&nasty::class()).unwrap().replace("<testcase", "<case").replace("</testcase", "</case"));
    }

    #[test]
    fn each_outcome_has_its_case() {
        let document = parsed(&nasty::class());
        // Four rubric lines for each of four graded students, and a case each for the two others; one line of `wrong`
        // and all four of `rejected` and `stopped` lose points.
        let skipped: usize = document.test_suites.iter().map(|suite| suite.skipped).sum();
        let counts = (document.tests, document.failures, document.errors, skipped);
        assert_eq!(counts, (18, 9, 1, 1));
        let suites: Vec<_> = document.test_suites.iter().map(|suite| (suite.failures, suite.errors)).collect();
        assert_eq!(suites, [(0, 0), (1, 0), (4, 0), (4, 0), (0, 0), (0, 1)]);
        let TestCaseStatus::NonSuccess { message, ty, description, .. } = &document.test_suites[1].test_cases[3].status
        else {
            panic!("a failure")
        };
        assert_eq!(message.as_deref(), Some("Specular 20 / 40"));
        assert_eq!(ty.as_deref(), Some("specular-half-unnormalized"));
        assert!(description.as_deref().unwrap().contains("The half vector `h` on line 11"));
        assert_eq!(document.test_suites[0].time, Some(Duration::from_millis(412)));
    }

    #[test]
    fn a_failure_of_ours_is_an_error_that_names_its_remedy() {
        let text = render(&nasty::class()).unwrap();
        assert!(text.contains("<error message=\"Grading failed\" type=\"fault\">"), "{text}");
        assert!(text.contains("install mesa-vulkan-drivers"));
    }

    #[test]
    fn students_write_no_elements_and_no_impossible_characters() {
        let entries: Vec<_> = samples::all().into_iter().map(nasty::attack).collect();
        let class = Class { entries, ..nasty::class() };
        let text = render(&class).unwrap();
        // Of the C0 controls XML 1.0 has tab, LF and CR only, and U+FFFE and U+FFFF not at all.
        let impossible = |c: char| c < ' ' && c != '\n' && c != '\t' || matches!(c, '\u{FFFE}' | '\u{FFFF}');
        assert!(!text.contains(impossible));
        let mut reader = Reader::from_str(&text);
        let mut names = std::collections::BTreeSet::new();
        loop {
            match reader.read_event().expect("well-formed") {
                Event::Start(element) | Event::Empty(element) => {
                    names.insert(String::from_utf8_lossy(element.name().as_ref()).into_owned());
                }
                Event::Eof => break,
                Event::CData(_) | Event::Comment(_) | Event::PI(_) => panic!("not ours"),
                _ => {}
            }
        }
        let ours = ["failure", "properties", "property", "testcase", "testsuite", "testsuites"];
        assert_eq!(names.iter().map(String::as_str).collect::<Vec<_>>(), ours);
        let case = &parsed(&class).test_suites[0];
        assert_eq!(case.name.as_str(), one_line(&format!("{} (student-0)", nasty::NASTY)));
    }

    #[test]
    fn what_was_written_is_what_is_read() {
        let wrong = nasty::entry(1, Outcome::Graded(Box::new(samples::wrong())));
        let class = Class { entries: vec![wrong], language: Language::Ja, ..nasty::class() };
        let document = parsed(&class);
        assert_eq!(document.to_string().unwrap().replacen(" skipped=\"0\"", "", 1), render(&class).unwrap());
        assert_eq!(document.test_suites[0].test_cases[1].name.as_str(), "環境光");
    }
}
