//! The contract, field by field.

use super::*;
use crate::report::samples;
use serde_json::{Value, json};

fn parsed(report: &Report, language: Language) -> Value {
    serde_json::from_str(&render(report, language)).expect("one JSON object")
}

fn keys(value: &Value) -> Vec<&str> {
    let object = value.as_object().expect("an object");
    object.keys().map(String::as_str).collect()
}

#[test]
fn fields_stand_in_the_order_of_the_contract() {
    let value = parsed(&samples::wrong(), Language::En);
    let top = "schema assignment assignment_digest source sources verdict score max_score rubric mistakes advice diagnostics \
               frames probes environment elapsed_ms";
    assert_eq!(keys(&value), top.split_whitespace().collect::<Vec<_>>());
    assert_eq!(keys(&value["source"]), ["name", "stage", "sha256", "bytes", "encoding"]);
    assert_eq!(value["sources"], json!([value["source"]]));
    let rubric = ["id", "points", "max_points", "mistake", "message", "label", "file", "line"];
    assert_eq!(keys(&value["rubric"][3]), rubric);
    let diagnostic = ["severity", "stage", "file", "line", "column", "message", "hint"];
    assert_eq!(keys(&value["diagnostics"][0]), diagnostic);
    let frame = "t coverage_mismatches max_difference mean_difference mismatched_pixels";
    assert_eq!(keys(&value["frames"][0]), frame.split_whitespace().collect::<Vec<_>>());
    assert_eq!(keys(&value["probes"]), ["seed", "samples", "mismatched", "max_difference"]);
    assert_eq!(keys(&value["environment"]), ["ggrade", "renderer", "driver"]);
}

#[test]
fn values_are_those_of_the_report() {
    let value = parsed(&samples::wrong(), Language::En);
    assert_eq!(value["schema"], "ggrade/report/v1");
    assert_eq!(value["verdict"], "wrong");
    assert_eq!((&value["score"], &value["max_score"]), (&json!(80), &json!(100)));
    assert_eq!(value["rubric"][3]["mistake"], "specular-half-unnormalized");
    assert_eq!(value["rubric"][0]["mistake"], Value::Null);
    assert_eq!(value["mistakes"], json!(["specular-half-unnormalized"]));
    assert_eq!(value["frames"].as_array().map(Vec::len), Some(25));
    assert_eq!(value["frames"][1]["t"], json!(0.04));
    assert_eq!(value["diagnostics"][0]["severity"], "warning");
    assert_eq!(value["probes"]["seed"], json!(20_240_613));
}

#[test]
fn a_place_names_its_file_and_what_has_no_line_names_none() {
    let mut report = samples::wrong();
    let files = |report: &Report| {
        let value = parsed(report, Language::En);
        [&value["rubric"][3]["file"], &value["rubric"][0]["file"], &value["diagnostics"][0]["file"]].map(Value::clone)
    };
    // As a report of the first version has them: nowhere.
    let file = || json!("ggsample06.vert");
    assert_eq!(files(&report), [file(), Value::Null, file()]);
    report.name_file();
    assert_eq!(files(&report), [file(), Value::Null, file()]);
    let other = SourceInfo { name: "other.vert".into(), ..SourceInfo::default() };
    report.of_files(vec![other]);
    assert_eq!(files(&report), [json!("other.vert"), Value::Null, json!("other.vert")]);
}

#[test]
fn a_stored_report_of_the_first_version_is_read() {
    let report = samples::wrong();
    let mut stored = serde_json::to_value(&report).unwrap();
    let mut source = stored.as_object_mut().unwrap().remove("sources").unwrap()[0].take();
    source.as_object_mut().unwrap().remove("stage");
    stored["source"] = source;
    stored["rubric"][3].as_object_mut().unwrap().remove("file");
    stored["diagnostics"][0].as_object_mut().unwrap().remove("file");
    let read: Report = serde_json::from_value(stored).unwrap();
    let expected = SourceInfo { stage: None, ..report.source().clone() };
    assert_eq!(read, Report { sources: vec![expected], ..report });
}

#[test]
fn every_verdict_has_its_word() {
    let words = samples::all().map(|report| parsed(&report, Language::En)["verdict"].clone());
    assert_eq!(words, ["correct", "wrong", "rejected", "stopped"].map(Value::from));
}

#[test]
fn messages_are_in_the_chosen_language() {
    let report = samples::wrong();
    let english = parsed(&report, Language::En);
    let japanese = parsed(&report, Language::Ja);
    assert_eq!(english["rubric"][3]["label"], "Specular");
    assert_eq!(japanese["rubric"][3]["label"], "鏡面反射光");
    assert_eq!(japanese["rubric"][3]["message"], report.rubric[3].message.ja.as_str());
    assert_eq!(japanese["diagnostics"][0]["message"], report.diagnostics[0].message.ja.as_str());
}

#[test]
fn what_is_not_finite_is_null() {
    let mut report = samples::wrong();
    report.frames[0].max_difference = f64::NAN;
    report.frames[0].mean_difference = f64::INFINITY;
    report.probes.max_difference = Some(f64::NEG_INFINITY);
    let value = parsed(&report, Language::En);
    assert_eq!(value["frames"][0]["max_difference"], Value::Null);
    assert_eq!(value["frames"][0]["mean_difference"], Value::Null);
    assert_eq!(value["probes"]["max_difference"], Value::Null);
}

#[test]
fn an_embedded_view_is_the_same_object() {
    let report = samples::rejected();
    let embedded = serde_json::to_value(view(&report, Language::Ja)).expect("a value");
    assert_eq!(embedded, parsed(&report, Language::Ja));
}

#[test]
fn own_values_stand_by_line_and_place() {
    let report = Report { own_values: Some(samples::own_values()), ..samples::wrong() };
    let value = parsed(&report, Language::Ja);
    let values = &value["own_values"];
    let of_place = ["frame", "at", "pixel", "yours", "right", "agrees"];
    assert_eq!(keys(&values["places"][0]), of_place);
    let of_line = ["file", "line", "name", "function", "times", "means", "values"];
    assert_eq!(keys(&values["lines"][1]), of_line);
    assert_eq!(
        (&values["lines"][1]["file"], &values["lines"][1]["means"]),
        (&json!("ggsample06.vert"), &json!("中間ベクトル"))
    );
    assert_eq!(values["lines"][1]["values"][0], json!({ "value": [0.75], "right": [1.0], "agrees": false }));
    // What is no number is null, and so is what is not reached.
    assert_eq!(values["lines"][0]["values"], json!([{ "value": [null, -2.0] }, null]));
    // A report is stored and read again.
    let stored = serde_json::to_string(&report).unwrap();
    assert_eq!(serde_json::from_str::<Report>(&stored).unwrap(), report);
}
