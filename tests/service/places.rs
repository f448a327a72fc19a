//! Nothing that is handed out says where this machine keeps what.

use crate::bench::{Bench, Reply, TEACHER};
use crate::cluster::Database;
use crate::{on_both, right_and_new, sample};
use axum::body::Body;
use axum::http::{Request, StatusCode, header};
use base64::Engine;
use clap::ValueEnum;
use ggrade::class::formats::ClassFormat;
use std::io::{Cursor, Read, Write};

on_both!(nothing_of_an_uploaded_archive_names_a_folder_of_the_machine);

/// What no answer may contain: the folders for temporary files, of the database, of the program and of its user.
fn folders(database: &str) -> Vec<String> {
    let folder = |path: &std::path::Path| path.display().to_string();
    let mut folders = vec![
        ".tmp".to_owned(),
        folder(&std::env::temp_dir().join("")),
        folder(&std::env::current_dir().expect("a folder")),
        env!("CARGO_MANIFEST_DIR").to_owned(),
        database.to_owned(),
    ];
    folders.extend(std::env::var("HOME").ok().filter(|home| home.len() > 1).map(|home| format!("{home}/")));
    folders
}

/// Every text in a file: of an archive that of its members, without the pictures, whose letters are chance.
fn texts(bytes: &[u8]) -> Vec<String> {
    if bytes.starts_with(b"PK\x03\x04") {
        let mut archive = zip::ZipArchive::new(Cursor::new(bytes)).expect("an archive");
        let members = (0..archive.len()).flat_map(|index| {
            let mut member = archive.by_index(index).expect("a member");
            let mut bytes = Vec::new();
            member.read_to_end(&mut bytes).expect("a file");
            let name = member.name().expect("a name").into_owned();
            [vec![name], texts(&bytes)].concat()
        });
        return members.collect();
    }
    let text = String::from_utf8_lossy(bytes).into_owned();
    // One format is base64 as a whole.
    if let Ok(bytes) = base64::engine::general_purpose::STANDARD.decode(text.trim()) {
        return vec![String::from_utf8_lossy(&bytes).into_owned()];
    }
    let mut parts = text.split(";base64,");
    let first = parts.next().unwrap_or_default().to_owned();
    let is_base64 = |c: char| c.is_ascii_alphanumeric() || "+/=".contains(c);
    vec![parts.fold(first, |whole, part| whole + part.trim_start_matches(is_base64))]
}

fn check(what: &str, reply: &Reply, folders: &[String]) {
    assert!(!reply.body.is_empty(), "{what}: {reply:?}");
    let head =
        reply.headers.iter().map(|(name, value)| format!("{name}: {}\n", value.to_str().expect("text"))).collect();
    for text in texts(&reply.body).into_iter().chain([head]) {
        for folder in folders {
            let found = text.find(folder.as_str()).map(|at| {
                text.chars().skip(text[..at].chars().count().saturating_sub(40)).take(160).collect::<String>()
            });
            assert_eq!(found, None, "{what} says {folder}");
        }
    }
}

fn zip(members: &[(&str, &[u8])]) -> Vec<u8> {
    let mut zip = zip::ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in members {
        zip.start_file(*name, zip::write::SimpleFileOptions::default()).expect("a member");
        zip.write_all(bytes).expect("written");
    }
    zip.finish().expect("an archive").into_inner()
}

async fn ask(bench: &Bench, method: &str, address: &str, kind: &str, body: impl Into<Body>) -> Reply {
    let request = Request::builder()
        .method(method)
        .uri(address)
        .header(header::AUTHORIZATION, format!("Bearer {TEACHER}"))
        .header(header::CONTENT_TYPE, kind);
    bench.send(request.body(body.into()).expect("a request")).await
}

async fn nothing_of_an_uploaded_archive_names_a_folder_of_the_machine(database: Database) {
    let folders = folders(&database.location);
    let bench = Bench::new(database).await;
    let archive = zip(&[
        ("山田 太郎_101_assignsubmission_file_/ggsample06.vert", &right_and_new()),
        ("佐藤 花子_102_assignsubmission_file_/sub/x.vert", &sample("rejected/brace-missing-at-end.vert")),
        (
            "田中 次郎_104_assignsubmission_file_/ggsample06.vert",
            &sample("wrong/specular-half-unnormalized--average.vert"),
        ),
        ("鈴木 一郎_103_assignsubmission_file_/レポート.pdf", b"%PDF-1.4"),
        ("鈴木 一郎_103_assignsubmission_file_/inner.zip", b"no archive"),
        ("../../evil_105_assignsubmission_file_/ggsample06.vert", b"x"),
    ]);
    // The end of the archive is missing: that is said of the archive itself.
    let whole = ask(&bench, "POST", "/api/v1/batches", "application/zip", archive.clone()).await;
    let cut = ask(&bench, "POST", "/api/v1/batches", "application/zip", archive[..archive.len() - 30].to_vec()).await;
    for reply in [whole, cut] {
        assert_eq!(reply.status, StatusCode::ACCEPTED, "{reply:?}");
        check("the batch", &reply, &folders);
        let json = reply.json();
        let paths: Vec<_> = json["students"].as_array().expect("students").iter().map(|s| s["path"].clone()).collect();
        assert!(paths.contains(&"佐藤 花子_102_assignsubmission_file_/sub/x.vert".into()), "{paths:?}");
        let refused: Vec<_> = json["refused"].as_array().expect("refused").iter().map(|r| r["path"].clone()).collect();
        assert!(refused.contains(&"../../evil_105_assignsubmission_file_/ggsample06.vert".into()), "{refused:?}");
        let address = reply.header("location").to_owned();
        check("its events", &ask(&bench, "GET", &format!("{address}/events"), "", Body::empty()).await, &folders);
        for format in ClassFormat::value_variants() {
            let address = format!("{address}/files/{}", format.id());
            let sheet = "Identifier,Full name,Grade,Maximum Grade,Grade can be changed,Feedback comments\n\
                         Participant 101,山田 太郎,,100,Yes,\nParticipant 103,鈴木 一郎,,100,Yes,\n";
            let reply = match format {
                ClassFormat::MoodleWorksheet => ask(&bench, "POST", &address, "text/csv", sheet).await,
                _ => ask(&bench, "GET", &address, "", Body::empty()).await,
            };
            assert_eq!(reply.status, StatusCode::OK, "{format:?}: {reply:?}");
            check(format.id(), &reply, &folders);
        }
        let id = json["id"].as_str().expect("an id");
        for page in [format!("/teacher/batches/{id}"), "/teacher/batches".into(), "/teacher".into()] {
            check(&page, &ask(&bench, "GET", &page, "", Body::empty()).await, &folders);
        }
        for student in json["students"].as_array().expect("students") {
            let Some(address) = student["submission"].as_str() else { continue };
            check(address, &bench.get(address).await, &folders);
            check(address, &bench.get(&address.replace("/api/v1/submissions/", "/r/")).await, &folders);
        }
    }
    // What is wrong is said without them as well.
    for (what, kind, body) in [
        ("no archive", "application/zip", b"no archive".to_vec()),
        ("an empty one", "application/zip", zip(&[])),
        ("nobody's files", "application/zip", zip(&[("a.docx", b"x"), ("b.pdf", b"y")])),
    ] {
        let reply = ask(&bench, "POST", "/api/v1/batches", kind, body).await;
        assert_eq!(reply.status, StatusCode::UNPROCESSABLE_ENTITY, "{what}: {reply:?}");
        check(what, &reply, &folders);
    }
    bench.finish().await;
}
