//! What is kept of people: the page that says it, everything of one student as a file, and assistants who read pseudonyms.

use crate::bench::Bench;
use crate::cluster::Database;
use crate::on_both;
use crate::roster::{archive, get, request, zip};
use crate::staff::{self, administrator};
use crate::{right, sample};
use axum::http::StatusCode;
use ggrade::service::clock::Clock;
use ggrade::service::store::RosterLine;
use serde_json::{Value, json};
use std::io::{Cursor, Read};

/// Due at the end of 2029.
const RULES: &str =
    "closes=2029-12-31T08%3A00&grace=10&late_until=&late_percent=0&late_span=day&late_floor=0&hints=full&audience=open";

on_both!(everything_of_a_student_is_one_zip, assistants_read_pseudonyms, anybody_reads_what_is_kept);

async fn class(bench: &Bench) {
    let line =
        |number: &str, name: &str| RosterLine { number: number.into(), name: name.into(), ..RosterLine::default() };
    let roster = [line("S1", "和田 花子"), line("S2", "山本 次郎")];
    bench.state.store.set_roster(&roster, 0).await.expect("a roster");
}

async fn hand_in(bench: &Bench, number: &str, bytes: Vec<u8>) -> String {
    let reply =
        bench.send(request("POST", &format!("/api/v1/submissions?student={number}"), "text/plain", bytes)).await;
    assert_eq!(reply.status, StatusCode::CREATED, "{reply:?}");
    reply.id()
}

async fn everything_of_a_student_is_one_zip(database: Database) {
    let bench = staff::bench(database, Clock::fixed(1_700_000_000_000)).await;
    class(&bench).await;
    let id = hand_in(&bench, "S1", right()).await;
    let other = hand_in(&bench, "S2", sample("accepted/answers/dot-by-hand.vert")).await;
    let name = "和田 花子_11_assignsubmission_file_/ggsample06.vert".to_owned();
    archive(&bench, zip(&[(name, b"#version 410\nvoid main() {}\n".to_vec())])).await;
    let extension = json!({ "whose": "S1", "due_at": "2030-01-01T00:00:00Z", "reason": "ill" });
    let settings = crate::roster::form(&bench, "/teacher/settings", RULES).await;
    assert_eq!(settings.status, StatusCode::SEE_OTHER, "{settings:?}");
    let set = bench.send(request("PUT", "/api/v1/extensions", "application/json", extension.to_string())).await;
    assert!(set.status.is_success(), "{set:?}");

    let reply = get(&bench, "/api/v1/students/s1/export").await;
    assert_eq!((reply.status, reply.header("content-type")), (StatusCode::OK, "application/zip"));
    let mut zip = zip::ZipArchive::new(Cursor::new(reply.body)).expect("an archive");
    let names: Vec<String> = zip.file_names().map(|name| name.expect("a name").into_owned()).collect();
    let mut read = |name: &str| {
        let mut text = Vec::new();
        zip.by_name(name).unwrap_or_else(|_| panic!("{name} of {names:?}")).read_to_end(&mut text).expect("a file");
        text
    };
    let about: Value = serde_json::from_slice(&read("student.json")).expect("JSON");
    assert_eq!((&about["number"], &about["name"]), (&json!("S1"), &json!("和田 花子")));
    let hand_ins = about["hand_ins"].as_array().expect("a list");
    assert_eq!(hand_ins.len(), 2, "{about}");
    let own = hand_ins.iter().find(|it| it["id"] == id).expect("the hand-in");
    let folder = own["folder"].as_str().expect("a folder");
    assert_eq!(read(&format!("{folder}/files/1-ggsample06.vert")), right());
    let report: Value = serde_json::from_slice(&read(&format!("{folder}/report.json"))).expect("JSON");
    assert_eq!(report["schema"], "ggrade/report/v1");
    assert!(!read(&format!("{folder}/report.txt")).is_empty() && !read("README.txt").is_empty());
    assert_eq!(about["extensions"][0]["reason"], "ill");
    assert_eq!(about["extensions"][0]["closes_at"], "2030-01-01T00:00:00Z");
    assert_eq!(about["archives"][0]["archive"], "class");
    assert!(about["acts_about_you"].as_array().unwrap().iter().any(|act| act["act"] == "extension"), "{about}");
    assert!(!about.to_string().contains(&other) && !about.to_string().contains("山本"), "{about}");

    assert_eq!(get(&bench, "/api/v1/students/s9/export").await.problem(), "not-found");
    assert_eq!(bench.get("/api/v1/students/s1/export").await.status, StatusCode::UNAUTHORIZED);
    let mut admin = administrator(&bench).await;
    let mut assistant = admin.let_in("ta", "assistant").await;
    assert_eq!(assistant.get("/api/v1/students/s1/export").await.problem(), "role");
    let saved = admin.form("/teacher/data", "/teacher/data/export", "number=s1").await;
    assert_eq!((saved.status, saved.header("content-type")), (StatusCode::OK, "application/zip"));
    let log = admin.get("/teacher/log?lang=en").await;
    assert!(log.all("main").concat().contains("Saved everything of a student"), "{log:?}");
}

async fn assistants_read_pseudonyms(database: Database) {
    let bench = staff::bench(database, Clock::system()).await;
    class(&bench).await;
    let text = String::from_utf8(sample("accepted/answers/half-angle-squared-forty-times.vert")).expect("UTF-8");
    let one = hand_in(&bench, "S1", text.clone().into_bytes()).await;
    let two = hand_in(&bench, "S2", text.replace("nlv", "x").into_bytes()).await;
    let mut admin = administrator(&bench).await;
    let mut assistant = admin.let_in("ta", "assistant").await;
    let names = ["S1", "S2", "和田", "山本"];
    let shows = |page: &crate::bench::Reply| names.iter().any(|name| page.all("main").concat().contains(name));
    assert!(shows(&assistant.get("/teacher").await));

    let set = admin.form("/teacher/data", "/teacher/data", "pseudonyms=on").await;
    assert_eq!(set.header("location"), "/teacher/data");
    let student = bench.state.store.student_by_number("S1").await.unwrap().unwrap().id;
    let pair = format!("/teacher/likeness/pair?one={one}&other={two}");
    let person = format!("/teacher/person?key={student}");
    for page in [
        "/teacher?lang=en",
        "/teacher?q=S1",
        &person,
        "/teacher/appeals",
        "/teacher/likeness",
        &pair,
        "/teacher/insights",
    ] {
        let reply = assistant.get(page).await;
        assert_eq!(reply.status, StatusCode::OK, "{page}");
        assert!(!shows(&reply), "{page}: {}", reply.text());
    }
    assert_eq!(assistant.get("/teacher/likeness?lang=en").await.all("tbody th a").len(), 2);
    for page in [
        "/teacher/batches",
        "/teacher/downloads/x",
        "/api/v1/class/files/csv",
        "/api/v1/likeness",
        "/api/v1/appeals",
        "/api/v1/extensions",
    ] {
        let reply = assistant.get(page).await;
        assert_eq!(reply.status, StatusCode::FORBIDDEN, "{page}");
        assert!(!shows(&reply), "{page}");
    }
    // Lecturers and programs read names as ever; so do assistants, when it is taken back.
    assert!(shows(&admin.get("/teacher").await));
    assert_eq!(get(&bench, "/api/v1/class/files/csv").await.status, StatusCode::OK);
    admin.form("/teacher/data", "/teacher/data", "").await;
    assert!(shows(&assistant.get("/teacher").await));
}

async fn anybody_reads_what_is_kept(database: Database) {
    let bench = staff::bench(database, Clock::system()).await;
    let page = bench.get("/privacy?lang=en").await;
    assert_eq!(page.status, StatusCode::OK);
    assert!(page.all("main").concat().contains("Until a lecturer deletes it"), "{page:?}");
    assert!(bench.get("/").await.text().contains("href=\"/privacy\""));
    assert!(bench.get("/privacy?lang=ja").await.all("h1")[0].contains("保存するデータ"));
}
