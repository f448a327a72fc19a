//! Everything that is kept of one student, as one ZIP that opens without ggrade.

use super::Service;
use super::clock::rfc3339;
use super::download::plain_name;
use super::errors::Problem;
use super::store::{StudentRecord, Submission, word};
use crate::language::Language;
use crate::report::{json, text};
use serde_json::{Value, json};
use std::io::Write;
use zip::write::SimpleFileOptions;

/// A file of an export: its path, and its bytes.
type ExportedFile = (String, Vec<u8>);

/// The ZIP: who they are, each hand-in with its files and its report, and whatever else names them.
pub async fn of_student(service: &Service, student: &StudentRecord) -> Result<Vec<u8>, Problem> {
    let language = service.store.course().await?.language;
    let mut entries: Vec<ExportedFile> = Vec::new();
    let mut hand_ins: Vec<Value> = Vec::new();
    for (number, submission) in service.store.submissions_of_student(&student.id).await?.into_iter().enumerate() {
        let folder = format!("hand-ins/{}/{:03}-{}", submission.assignment, number + 1, word(&submission.via));
        hand_ins.push(hand_in(service, &submission, &folder, language, &mut entries).await?);
    }
    let mut about = json!({
        "schema": "ggrade/student/v1",
        "exported_at": rfc3339(service.clock.now()),
        "number": student.number,
        "name": student.name,
        "group": student.group_name,
        "email": student.email,
        "moodle": student.moodle,
        "is_on_roster": student.is_on_roster(),
        "hand_ins": hand_ins,
    });
    if let Value::Object(about) = &mut about {
        about.extend(service.store.kept_of_student(&student.id).await?);
    }
    let about = serde_json::to_vec_pretty(&about).map_err(|error| Problem::internal(&error))?;
    entries.insert(0, ("README.txt".into(), README.into()));
    entries.insert(1, ("student.json".into(), about));
    zipped(&entries).map_err(|error| Problem::internal(&error))
}

const README: &str = "Everything that ggrade keeps of one student.\n\
    student.json  who they are, a list of all hand-ins, and what else names them: extensions of theirs and of their\n\
    \x20             group, requests for another look, browsers, archives, learning platforms, the log of what teachers did\n\
    hand-ins/     the files as they were handed in, each with its report (report.json, report.txt)\n\n\
    ggrade が 1 人の学生について保存しているすべてのデータです。\n\
    student.json  氏名・番号、提出の一覧、締切の延長（グループのものを含む）、再確認の依頼、ブラウザ、アーカイブ、学習プラットフォーム、操作記録\n\
    hand-ins/     提出されたファイルと採点結果（report.json、report.txt）\n";

/// A hand-in's line in the list; its files and its report go to `entries`.
async fn hand_in(
    service: &Service,
    submission: &Submission,
    folder: &str,
    language: Language,
    entries: &mut Vec<ExportedFile>,
) -> Result<Value, Problem> {
    let files = service.store.hand_in(&submission.id).await?.unwrap_or_default();
    for (place, file) in files.files.iter().enumerate() {
        let name = plain_name(&file.name);
        entries.push((format!("{folder}/files/{}-{name}", place + 1), file.bytes.clone()));
    }
    let report = service.store.stored(&submission.id).await?.and_then(|stored| stored.report);
    if let Some(report) = &report {
        entries.push((format!("{folder}/report.json"), json::render(report, language).into_bytes()));
        // In words as well, where the homework is still served.
        if let Some(state) = service.homework(&submission.assignment) {
            let assignment = &state.assignment;
            let options = text::TextOptions { assignment, language, width: 100, colour: false, excerpts: None };
            entries.push((format!("{folder}/report.txt"), text::render(report, &options).into_bytes()));
        }
    }
    Ok(json!({
        "id": submission.id,
        "assignment": submission.assignment,
        "folder": folder,
        "via": word(&submission.via),
        "received_at": rfc3339(submission.received_at),
        "sha256": submission.sha256,
        "chosen_at": service.store.chosen_at(&submission.id).await?.map(rfc3339),
        "score": report.as_ref().map(|report| report.score),
        "total": report.as_ref().map(|report| report.total()),
    }))
}

/// A ZIP of these files.
fn zipped(entries: &[ExportedFile]) -> zip::result::ZipResult<Vec<u8>> {
    let mut zip = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    for (path, bytes) in entries {
        zip.start_file(path, SimpleFileOptions::default())?;
        zip.write_all(bytes)?;
    }
    Ok(zip.finish()?.into_inner())
}
