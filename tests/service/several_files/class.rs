//! A class whose hand-ins are of several files each, in pages and in downloads.

use super::{bench, both};
use crate::cluster::Database;
use crate::on_both;
use crate::roster::{archive, get, zip};
use clap::ValueEnum;
use ggrade::class::formats::ClassFormat;
use serde_json::json;

on_both!(a_class_of_several_files_each_is_shown_and_downloaded);

async fn a_class_of_several_files_each_is_shown_and_downloaded(database: Database) {
    let (bench, _) = bench(database).await;
    let own = |folder: &str, (name, bytes): (&str, &[u8])| (format!("{folder}/{name}"), bytes.to_vec());
    let members = [
        own("Smith, Ann_101_assignsubmission_file_", both()[0]),
        own("Smith, Ann_101_assignsubmission_file_", both()[1]),
        own("佐藤 花子_102_assignsubmission_file_", both()[1]),
    ];
    let id = archive(&bench, zip(&members)).await;
    let batch = get(&bench, &format!("/teacher/batches/{id}")).await;
    assert_eq!(batch.all(".people tbody th"), ["102 佐藤 花子", "101 Smith, Ann"]);
    assert!(batch.text().contains("There is no ggsample11.frag, only ggsample11.vert."), "{}", batch.text());
    let json = get(&bench, &format!("/api/v1/batches/{id}")).await.json();
    let folder = "Smith, Ann_101_assignsubmission_file_";
    let paths = format!("{folder}/ggsample11.vert, {folder}/ggsample11.frag");
    assert_eq!(json["students"][0]["path"], json!(paths));
    let report = get(&bench, json["students"][0]["submission"].as_str().expect("a submission")).await.json();
    let page = bench.get(report["links"]["page"].as_str().expect("a page")).await;
    assert_eq!(page.all(".listing").len(), 2);
    // Every format says in which of the files the mistake is.
    for format in ClassFormat::value_variants() {
        let reply = get(&bench, &format!("/api/v1/batches/{id}/files/{}?lang=en", format.id())).await;
        let said = match format {
            // One needs a worksheet, the other one is written in base64.
            ClassFormat::MoodleWorksheet | ClassFormat::ClassroomLegacy => continue,
            ClassFormat::Nbgrader | ClassFormat::Canvas | ClassFormat::GradescopeGrades => "Smith, Ann",
            ClassFormat::Sarif => "Smith%2C%20Ann_101_assignsubmission_file_/ggsample11.frag",
            _ => "ggsample11.frag",
        };
        let text = unpacked(&reply.body);
        assert!(text.contains(said), "{format:?}: {text}");
    }
    bench.finish().await;
}

/// The text of a file, or of all files in an archive.
fn unpacked(bytes: &[u8]) -> String {
    let Ok(mut archive) = ::zip::ZipArchive::new(std::io::Cursor::new(bytes)) else {
        return String::from_utf8_lossy(bytes).into_owned();
    };
    let count = archive.len();
    let member = |index| std::io::read_to_string(archive.by_index(index).expect("a member")).expect("a text");
    (0..count).map(member).collect()
}
