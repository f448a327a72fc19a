//! SARIF 2.1.0: what the compiler says and which mistakes are known, at the lines of the students' files.

mod region;
mod rules;

use self::region::FileLines;
use self::rules::RuleTable;
use super::untrusted::visible;
use super::wording;
use crate::class::{Class, ClassEntry, Outcome};
use crate::diagnostic::{Diagnostic, Severity};
use crate::hand_in::hexadecimal;
use crate::intake::FileLocation;
use crate::language::Language;
use crate::report::{AdviceLine, RubricLine, SourceInfo, UNEXPLAINED, Verdict};
use percent_encoding::{AsciiSet, NON_ALPHANUMERIC, utf8_percent_encode};
use serde_json::{Value, json};
use sha2::{Digest, Sha256};
use std::collections::HashMap;

/// Where the schema of the format is published.
const SCHEMA: &str = "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json";

/// What a path keeps as it is: RFC 3986's unreserved characters, and `/`.
const PATH: &AsciiSet = &NON_ALPHANUMERIC.remove(b'-').remove(b'.').remove(b'_').remove(b'~').remove(b'/');

/// The class as one log with one run.
///
/// Results are diagnostics and lost points; a failure of ours and a missing file are notifications of the run.
pub fn render(class: &Class) -> String {
    let mut run = SarifRun { rules: RuleTable::of(class), results: vec![], artifacts: vec![], seen: HashMap::new() };
    for entry in &class.entries {
        run.add(entry, class.language);
    }
    let failed = class.entries.iter().any(|entry| matches!(entry.outcome, Outcome::Fault(_)));
    let notifications: Vec<_> = class.entries.iter().filter_map(|entry| notification(entry, class.language)).collect();
    let log = json!({
        "$schema": SCHEMA,
        "version": "2.1.0",
        "runs": [{
            "tool": { "driver": {
                "name": "ggrade",
                "semanticVersion": env!("CARGO_PKG_VERSION"),
                "rules": run.rules.into_values(),
            }},
            "language": match class.language { Language::En => "en", Language::Ja => "ja" },
            "columnKind": "utf16CodeUnits",
            // As ggrade counts lines, and editors do.
            "newlineSequences": ["\r\n", "\n", "\r"],
            "invocations": [{
                "executionSuccessful": !failed,
                "toolExecutionNotifications": notifications,
            }],
            "properties": { "assignment": class.assignment.id, "assignmentDigest": class.assignment.digest },
            "artifacts": run.artifacts,
            "results": run.results,
        }],
    });
    format!("{log:#}\n")
}

/// One run while it is written.
struct SarifRun {
    rules: RuleTable,
    results: Vec<Value>,
    artifacts: Vec<Value>,
    /// How often each fingerprint has come up.
    seen: HashMap<String, u32>,
}

/// One file among the artifacts.
struct Artifact<'a> {
    entry: &'a ClassEntry,
    source: &'a SourceInfo,
    uri: String,
    index: usize,
    lines: FileLines<'a>,
}

/// What is said about a place in a file.
struct SarifResult<'a> {
    rule: &'a str,
    level: &'static str,
    message: String,
    region: Option<Value>,
    line: Option<u32>,
}

impl SarifRun {
    fn add(&mut self, entry: &ClassEntry, language: Language) {
        let Some(report) = entry.report() else { return };
        let mut files = Vec::new();
        for (source, place) in report.sources.iter().zip(&entry.places) {
            let text = entry.sources.iter().find(|read| read.facts.name == source.name);
            let lines = FileLines::of(text.map_or("", |read| &read.text));
            let file = Artifact { entry, source, index: self.artifacts.len(), lines, uri: uri(place) };
            self.artifacts.push(artifact(&file));
            files.push(file);
        }
        let of =
            |name: Option<&str>| files.iter().find(|file| Some(file.source.name.as_str()) == name).or(files.first());
        // Where nothing ran, the lines of the rubric say nothing that the diagnostics do not.
        if report.verdict == Verdict::Wrong {
            for line in report.rubric.iter().filter(|line| !wording::is_full(line)) {
                let Some(file) = of(line.file.as_deref()) else { continue };
                self.push(file, &lost(file, line, language));
            }
        }
        for advice in &report.advice {
            let Some(file) = of(Some(&advice.file)) else { continue };
            self.push(file, &advised(file, advice, language));
        }
        for diagnostic in &report.diagnostics {
            let Some(file) = of(diagnostic.file.as_deref()) else { continue };
            self.push(file, &said(file, diagnostic, language));
        }
    }

    fn push(&mut self, file: &Artifact, finding: &SarifResult) {
        let mut location = json!({ "artifactLocation": location(&file.uri, file.index) });
        if let Some(region) = &finding.region {
            location["region"] = region.clone();
        }
        let fingerprint = self.fingerprint(file, finding);
        let student = visible(&file.entry.student.name);
        self.results.push(json!({
            "ruleId": finding.rule,
            "ruleIndex": self.rules.index(finding.rule),
            "level": finding.level,
            "message": { "text": finding.message },
            "locations": [{ "physicalLocation": location }],
            "partialFingerprints": { "primaryLocationLineHash": fingerprint },
            "properties": { "student": student },
        }));
    }

    /// The same for the same finding wherever its line moves to: rule, file and the text of the line, and how often
    /// these have come up, in the form in which GitHub's code scanning writes its own.
    fn fingerprint(&mut self, file: &Artifact, finding: &SarifResult) -> String {
        const BYTES: usize = 8;
        let text = finding.line.map_or("", |line| file.lines.text(line).trim());
        let digest = Sha256::digest(format!("{}\0{}\0{text}", finding.rule, file.uri));
        let hash = hexadecimal(&digest[..BYTES]);
        let count = self.seen.entry(hash.clone()).or_default();
        *count += 1;
        format!("{hash}:{count}")
    }
}

fn artifact(file: &Artifact) -> Value {
    let mut location = location(&file.uri, file.index);
    location["description"] = json!({ "text": visible(&file.entry.student.name) });
    json!({
        "location": location,
        "length": file.source.bytes,
        "hashes": { "sha-256": file.source.sha256 },
        "sourceLanguage": "glsl",
    })
}

fn location(uri: &str, index: usize) -> Value {
    json!({ "uri": uri, "index": index, "uriBaseId": "%SRCROOT%" })
}

/// The file as a relative reference (RFC 3986): from the working folder on, or else from the input on.
fn uri(place: &FileLocation) -> String {
    let local = place.local.as_ref().map(|local| local.to_string_lossy());
    utf8_percent_encode(local.as_deref().unwrap_or(&place.path), PATH).to_string()
}

fn lost<'a>(file: &Artifact, line: &'a RubricLine, language: Language) -> SarifResult<'a> {
    SarifResult {
        rule: line.mistake.as_deref().unwrap_or(UNEXPLAINED),
        level: "warning",
        message: format!("{}: {}", wording::rubric_title(line, language), visible(line.message.get(language))),
        region: line.line.and_then(|number| file.lines.whole(number)),
        line: line.line,
    }
}

fn advised<'a>(file: &Artifact, advice: &'a AdviceLine, language: Language) -> SarifResult<'a> {
    SarifResult {
        rule: &advice.id,
        level: "note",
        message: visible(advice.message.get(language)),
        region: advice.line.and_then(|number| file.lines.whole(number)),
        line: advice.line,
    }
}

fn said<'a>(file: &Artifact, diagnostic: &'a Diagnostic, language: Language) -> SarifResult<'a> {
    SarifResult {
        rule: rules::stage(diagnostic.stage),
        level: match diagnostic.severity {
            Severity::Error => "error",
            Severity::Warning => "warning",
            Severity::Note => "note",
        },
        message: wording::message(diagnostic, language),
        region: diagnostic.line.and_then(|line| match diagnostic.column {
            Some(column) => file.lines.span(line, column, diagnostic.length),
            None => file.lines.whole(line),
        }),
        line: diagnostic.line,
    }
}

/// What the run has to say of a student without a report.
fn notification(entry: &ClassEntry, language: Language) -> Option<Value> {
    let (level, text) = match &entry.outcome {
        Outcome::Graded(_) => return None,
        Outcome::NotGraded(_) => ("warning", wording::explanation(entry, language)),
        Outcome::Fault(_) => ("error", wording::fault(entry, language).unwrap_or_default()),
    };
    let text = format!("{}: {text}", visible(&entry.student.name));
    Some(json!({ "level": level, "message": { "text": text } }))
}

#[cfg(test)]
mod tests;
