//! Whole classes: a teacher's archive, its formats, and grading everything again.

use crate::bench::{Bench, Reply, TEACHER};
use crate::cluster::Database;
use crate::{on_both, right, right_and_new, sample};
use axum::body::Body;
use axum::http::{Request, StatusCode, header};
use clap::ValueEnum;
use ggrade::class::formats::ClassFormat;
use ggrade::report::Verdict;
use ggrade::service::regrade;
use ggrade::service::store::RosterLine;
use std::io::{Cursor, Read, Write};
use std::time::Duration;

on_both!(
    a_moodle_archive_is_graded_behind_the_scenes,
    what_is_no_archive_is_said_to_be_none,
    students_own_files_come_in_every_format,
    gradescope_knows_students_by_the_rosters_mail_addresses,
    everything_graded_again_stands_beside_until_it_is_adopted,
);

fn request(method: &str, address: &str, kind: &str, body: impl Into<Body>) -> Request<Body> {
    Request::builder()
        .method(method)
        .uri(address)
        .header(header::AUTHORIZATION, format!("Bearer {TEACHER}"))
        .header(header::CONTENT_TYPE, kind)
        .body(body.into())
        .expect("a request")
}

async fn get(bench: &Bench, address: &str) -> Reply {
    bench.send(request("GET", address, "", Body::empty())).await
}

fn zip(members: &[(&str, &[u8])]) -> Vec<u8> {
    let mut zip = zip::ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in members {
        zip.start_file(*name, zip::write::SimpleFileOptions::default()).expect("a member");
        zip.write_all(bytes).expect("written");
    }
    zip.finish().expect("an archive").into_inner()
}

async fn a_moodle_archive_is_graded_behind_the_scenes(database: Database) {
    let bench = Bench::new(database).await;
    let archive = zip(&[
        ("山田 太郎_101_assignsubmission_file_/ggsample06.vert", &right_and_new()),
        ("佐藤 花子_102_assignsubmission_file_/ggsample06.vert", &sample("rejected/brace-missing-at-end.vert")),
        ("鈴木 一郎_103_assignsubmission_file_/レポート.pdf", b"%PDF-1.4"),
    ]);
    let stranger = Request::post("/api/v1/batches").header(header::CONTENT_TYPE, "application/zip");
    let refused = bench.send(stranger.body(Body::from(archive.clone())).expect("a request")).await;
    assert_eq!((refused.status, refused.problem().as_str()), (StatusCode::UNAUTHORIZED, "unauthorized"));

    let reply = bench.send(request("POST", "/api/v1/batches", "application/zip", archive)).await;
    assert_eq!(reply.status, StatusCode::ACCEPTED, "{reply:?}");
    let location = reply.header("location").to_owned();
    let events = get(&bench, &format!("{location}/events")).await;
    // The stream ends with the batch.
    let text = String::from_utf8(events.body).expect("text");
    assert!(text.contains("event: done"), "{text}");
    let json = get(&bench, &location).await.json();
    let progress = &json["progress"];
    assert_eq!((&progress["entries"], &progress["files"], &progress["graded"]), (&3.into(), &2.into(), &2.into()));
    let names: Vec<_> = json["students"].as_array().expect("students").iter().map(|s| s["name"].as_str()).collect();
    assert!(names.contains(&Some("山田 太郎")), "{names:?}");
    let nothing: Vec<_> =
        json["students"].as_array().expect("students").iter().filter(|s| !s["note"].is_null()).collect();
    assert_eq!(nothing.len(), 1);

    for format in ClassFormat::value_variants() {
        let reply = get(&bench, &format!("{location}/files/{}", format.id())).await;
        if *format == ClassFormat::MoodleWorksheet {
            assert_eq!(reply.problem(), "unprocessable");
            continue;
        }
        assert_eq!(reply.status, StatusCode::OK, "{format:?}: {reply:?}");
        assert!(reply.header("content-disposition").starts_with("attachment;"), "{format:?}");
        assert!(!reply.body.is_empty(), "{format:?}");
    }
    let csv = get(&bench, &format!("{location}/files/csv?lang=ja")).await;
    assert!(String::from_utf8_lossy(&csv.body).contains("山田 太郎"));
    let grades = get(&bench, &format!("{location}/files/json?lang=en")).await;
    assert!(grades.header("content-disposition").contains("grades.json"), "{grades:?}");
    let grades = grades.json();
    let first = grades.as_array().expect("students").iter().find(|student| student["name"] == "山田 太郎");
    let first = first.expect("a student");
    assert_eq!((&first["moodle_id"], &first["max_score"]), (&101.into(), &100.0.into()), "{first}");
    assert!(first["rubric"][0]["max_points"].is_number() && first["feedback"].is_string(), "{first}");
    // Every column of the table is a key.
    let csv = String::from_utf8_lossy(&csv.body).into_owned();
    let columns = csv.trim_start_matches('\u{feff}').lines().next().expect("a heading").split(',');
    let lines: Vec<&str> =
        first["rubric"].as_array().expect("lines").iter().filter_map(|it| it["id"].as_str()).collect();
    for column in columns.filter(|column| !lines.contains(column)) {
        assert!(first.get(column).is_some(), "{column} of {first}");
    }
    let feedback = get(&bench, &format!("{location}/files/moodle-feedback")).await;
    let mut feedback = zip::ZipArchive::new(Cursor::new(feedback.body)).expect("an archive");
    let names: Vec<String> = feedback.file_names().map(|name| name.expect("a name").into_owned()).collect();
    let name = names.iter().find(|name| name.contains("_101_")).expect("a page");
    let mut page = String::new();
    feedback.by_name(name).expect("a page").read_to_string(&mut page).expect("text");
    assert!(page.contains("data:image/png"), "a page without pictures");
    let fill = |sheet: &'static str| {
        bench.send(request("POST", &format!("{location}/files/moodle-worksheet"), "text/csv", sheet))
    };
    assert_eq!(fill("a,b\n1,2\n").await.problem(), "unprocessable");
    let filled = fill(
        "Identifier,Full name,Grade,Maximum Grade,Grade can be changed,Feedback comments\n\
         Participant 101,山田 太郎,,100,Yes,\nParticipant 102,佐藤 花子,,100,Yes,\n",
    )
    .await;
    assert_eq!(filled.status, StatusCode::OK, "{filled:?}");
    assert!(String::from_utf8_lossy(&filled.body).contains("100"));
    // Where groups hand in, the numbers are groups', and the worksheet says whose the reports are.
    let sheet = "Identifier,Full name,Status,Group,Grade,Maximum Grade,Feedback comments\n\
                 Participant 101,木村 春,,佐藤 花子,,100,\nParticipant 7,林 夏,,山田 太郎,,100,\n\
                 Participant 8,森 秋,,山田 太郎,,100,\n";
    let post = request("POST", &format!("{location}/files/moodle-feedback"), "text/csv", sheet);
    let feedback = bench.send(post).await;
    let feedback = zip::ZipArchive::new(Cursor::new(feedback.body)).expect("an archive");
    let mut names: Vec<String> = feedback.file_names().map(|name| name.expect("a name").into_owned()).collect();
    names.sort();
    let people = ["木村 春_101", "林 夏_7", "森 秋_8"];
    assert_eq!(names, people.map(|name| format!("{name}_assignfeedback_file_/feedback.html")));
    bench.finish().await;
}

async fn what_is_no_archive_is_said_to_be_none(database: Database) {
    let bench = Bench::new(database).await;
    let post = |kind: &'static str, body: Vec<u8>| bench.send(request("POST", "/api/v1/batches", kind, body));
    assert_eq!(post("application/zip", b"no archive".to_vec()).await.problem(), "unprocessable");
    assert_eq!(post("application/zip", zip(&[])).await.problem(), "unprocessable");
    assert_eq!(post("text/plain", right()).await.problem(), "unsupported-media-type");
    let form = b"--x\r\nContent-Disposition: form-data; name=\"other\"\r\n\r\n1\r\n--x--\r\n".to_vec();
    assert_eq!(post("multipart/form-data; boundary=x", form).await.problem(), "unprocessable");
    assert_eq!(get(&bench, "/api/v1/batches/1").await.problem(), "not-found");
    assert_eq!(get(&bench, "/api/v1/class/files/excel").await.problem(), "not-found");
    // Paths that lead out of the archive are left out, and said to be.
    let evil = zip(&[("../../../../tmp/evil.vert", &right()), ("a/ggsample06.vert", &right())]);
    let reply = post("application/zip", evil).await;
    assert_eq!(reply.status, StatusCode::ACCEPTED, "{reply:?}");
    assert_eq!(reply.json()["refused"].as_array().map(Vec::len), Some(1));
    bench.finish().await;
}

/// Hands a file in for a student.
async fn hand_in(bench: &Bench, student: &str, bytes: Vec<u8>) -> Reply {
    bench.send(request("POST", &format!("/api/v1/submissions?student={student}"), "text/plain", bytes)).await
}

async fn students_own_files_come_in_every_format(database: Database) {
    let bench = Bench::new(database).await;
    let line =
        |number: &str, name: &str| RosterLine { number: number.into(), name: name.into(), ..RosterLine::default() };
    let roster = [line("S1", "山田 <太郎>"), line("S2", "=cmd()")];
    bench.state.store.set_roster(&roster, 0).await.expect("a roster");
    assert_eq!(hand_in(&bench, "s1", right()).await.json()["report"]["score"], 100);
    assert_eq!(hand_in(&bench, "s1", sample("rejected/brace-missing-at-end.vert")).await.json()["report"]["score"], 0);
    let csv = async |pick: &str| {
        let reply = get(&bench, &format!("/api/v1/class/files/csv?pick={pick}")).await;
        assert_eq!(reply.status, StatusCode::OK, "{reply:?}");
        String::from_utf8(reply.body).expect("text")
    };
    let line = |csv: &str| csv.lines().find(|line| line.contains("S1")).expect("a line").to_owned();
    let (best, latest) = (csv("best").await, csv("latest").await);
    assert!(line(&best).contains("100"), "{best}");
    assert!(line(&latest).contains("rejected"), "{latest}");
    // Who has handed in nothing is there as well, and no name becomes a formula.
    let second = best.lines().find(|line| line.contains("S2")).expect("a line");
    assert!(!second.contains(",=cmd"), "{second}");
    let html = get(&bench, "/api/v1/class/files/html").await;
    let html = String::from_utf8(html.body).expect("text");
    assert!(html.contains("山田 &lt;太郎&gt;") || html.contains("山田 &#60;太郎&#62;"), "no escaped name");
    assert!(!html.contains("山田 <太郎>"));
    bench.finish().await;
}

async fn everything_graded_again_stands_beside_until_it_is_adopted(database: Database) {
    let bench = Bench::new(database).await;
    let id = hand_in(&bench, "s1", right_and_new()).await.id();
    hand_in(&bench, "s2", sample("rejected/brace-missing-at-end.vert")).await;
    let before = bench.state.store.stored(&id).await.expect("a store").expect("a submission");
    let regrading = regrade::start(&bench.state, true, None).await.expect("begun");
    assert_ne!(regrading.seed, before.submission.seed);
    for _ in 0..600 {
        if bench.state.store.regrading_progress(&regrading.id).await.expect("progress").is_done() {
            break;
        }
        tokio::time::sleep(Duration::from_millis(50)).await;
    }
    let rows = bench.state.store.compared(&regrading.id).await.expect("rows");
    assert_eq!(rows.len(), 2);
    for row in &rows {
        assert_eq!(Some(&row.before), row.after.as_ref());
    }
    assert!(rows.iter().any(|row| row.before == (Verdict::Correct, 100.0, Vec::new())));
    // Nothing has changed yet.
    let stored = bench.state.store.stored(&id).await.expect("a store").expect("a submission");
    assert_eq!(stored, before);
    regrade::adopt(&bench.state, &regrading.id).await.expect("adopted");
    let stored = bench.state.store.stored(&id).await.expect("a store").expect("a submission");
    assert_eq!(stored.report.expect("a report").probes.seed, regrading.seed);
    let assignment = bench.state.store.assignment("ggsample06").await.expect("an assignment");
    assert_eq!(assignment.seed, regrading.seed);
    bench.finish().await;
}

async fn gradescope_knows_students_by_the_rosters_mail_addresses(database: Database) {
    let bench = Bench::new(database).await;
    let roster = "ID number,Full name,Email address\nS1,和田 花子,s1@example.ac.jp\nS2,B,\n";
    assert_eq!(bench.send(request("PUT", "/api/v1/roster", "text/csv", roster)).await.status, StatusCode::OK);
    let address = "/api/v1/submissions?student=S1";
    assert_eq!(bench.send(request("POST", address, "text/plain", right())).await.status, StatusCode::CREATED);
    let table = bench.send(request("GET", "/api/v1/class/files/gradescope-grades", "", "")).await;
    let table = String::from_utf8(table.body).expect("text");
    assert!(table.contains("\n和田 花子,S1,s1@example.ac.jp,100.0,100.0,Graded,"), "{table}");
    assert!(table.contains("\nB,S2,,"), "{table}");
    // It goes with another roster.
    let listed = bench.send(request("GET", "/api/v1/roster", "", "")).await.json();
    assert_eq!(listed["students"][0]["email"], "s1@example.ac.jp");
    let roster = bench.send(request("PUT", "/api/v1/roster", "text/csv", "ID number,Full name\nS1,A\n")).await;
    assert_eq!(roster.json()["students"][0]["email"], "");
    bench.finish().await;
}
