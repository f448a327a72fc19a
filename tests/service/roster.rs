//! The class is the roster: who counts, who does not, and how a teacher gets a roster in.

use crate::bench::{Bench, Reply, TEACHER};
use crate::cluster::Database;
use crate::codes::Guest;
use crate::{on_both, right, right_and_new, sample};
use axum::body::Body;
use axum::http::{Request, StatusCode, header};
use ggrade::service::identity::{course_secret, personal_code};
use scraper::{Html, Selector};
use std::io::{Cursor, Write};
use std::time::Duration;

on_both!(
    the_class_is_the_roster,
    columns_that_are_not_taken_are_named,
    numbers_that_are_not_on_the_roster_are_refused,
    what_cannot_be_read_leads_back_to_its_form,
    three_hundred_students_and_an_archive,
);

pub const WRONG: &str = "wrong/specular-half-unnormalized--average.vert";
const BOUNDARY: &str = "xxxxxxxxxx";

/// A request of the teacher's.
pub fn request(method: &str, address: &str, kind: &str, body: impl Into<Body>) -> Request<Body> {
    Request::builder()
        .method(method)
        .uri(address)
        .header(header::AUTHORIZATION, format!("Bearer {TEACHER}"))
        .header(header::CONTENT_TYPE, kind)
        .header(header::ACCEPT, "text/html")
        .header(header::ACCEPT_LANGUAGE, "en")
        .body(body.into())
        .expect("a request")
}

/// A page or a file of the teacher's.
pub async fn get(bench: &Bench, address: &str) -> Reply {
    bench.send(request("GET", address, "", Body::empty())).await
}

/// A form of a page.
pub async fn form(bench: &Bench, address: &str, fields: &str) -> Reply {
    bench.send(request("POST", address, "application/x-www-form-urlencoded", fields.to_owned())).await
}

/// A form with a file.
pub async fn file(bench: &Bench, address: &str, field: &str, name: &str, bytes: &[u8]) -> Reply {
    let mut body =
        format!("--{BOUNDARY}\r\nContent-Disposition: form-data; name=\"{field}\"; filename=\"{name}\"\r\n\r\n")
            .into_bytes();
    body.extend(bytes);
    body.extend(format!("\r\n--{BOUNDARY}--\r\n").bytes());
    bench.send(request("POST", address, &format!("multipart/form-data; boundary={BOUNDARY}"), body)).await
}

/// The page of a download that was begun, when its file is ready, and the file.
pub async fn made(bench: &Bench, begun: Reply) -> (Reply, Reply) {
    let address = begun.header("location").to_owned();
    assert!(begun.status == StatusCode::SEE_OTHER && address.starts_with("/teacher/downloads/"), "{begun:?}");
    for _ in 0..1200 {
        let page = get(bench, &address).await;
        if page.text().contains("/file\"") {
            let saved = get(bench, &format!("{address}/file")).await;
            assert_eq!(saved.status, StatusCode::OK, "{saved:?}");
            return (page, saved);
        }
        tokio::time::sleep(Duration::from_millis(50)).await;
    }
    panic!("{address} is never ready")
}

pub fn zip(members: &[(String, Vec<u8>)]) -> Vec<u8> {
    let mut zip = zip::ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in members {
        zip.start_file(name.as_str(), zip::write::SimpleFileOptions::default()).expect("a member");
        zip.write_all(bytes).expect("written");
    }
    zip.finish().expect("an archive").into_inner()
}

impl Reply {
    /// The body as text.
    pub fn text(&self) -> String {
        String::from_utf8(self.body.clone()).expect("text")
    }

    /// The text of every element that a selector finds.
    pub fn all(&self, css: &str) -> Vec<String> {
        let (page, css) = (Html::parse_document(&self.text()), Selector::parse(css).expect("a selector"));
        let text = |element: scraper::ElementRef<'_>| {
            element.text().collect::<String>().split_whitespace().collect::<Vec<_>>().join(" ")
        };
        page.select(&css).map(text).collect()
    }
}

/// Uploads an archive and waits until it is graded; its id.
pub async fn archive(bench: &Bench, bytes: Vec<u8>) -> String {
    let reply = file(bench, "/teacher/batches", "file", "class.zip", &bytes).await;
    assert_eq!(reply.status, StatusCode::SEE_OTHER, "{reply:?}");
    let id = reply.header("location").rsplit('/').next().expect("an id").to_owned();
    for _ in 0..1200 {
        if bench.state.store.progress(&id).await.expect("progress").is_done() {
            return id;
        }
        tokio::time::sleep(Duration::from_millis(50)).await;
    }
    panic!("the archive was not graded");
}

/// Imports a roster; what the page says of it then.
pub async fn roster(bench: &Bench, csv: &str) -> String {
    let reply = file(bench, "/teacher/roster", "roster", "roster.csv", csv.as_bytes()).await;
    let next = reply.header("location").to_owned();
    assert!(reply.status == StatusCode::SEE_OTHER && next.starts_with("/teacher/settings?done=roster&"), "{reply:?}");
    get(bench, &next).await.all("[role=status]").concat()
}

async fn hand_in(bench: &Bench, query: &str, bytes: Vec<u8>) -> Reply {
    bench.send(request("POST", &format!("/api/v1/submissions{query}"), "text/plain", bytes)).await
}

async fn the_class_is_the_roster(database: Database) {
    let bench = Bench::new(database).await;
    for _ in 0..3 {
        assert_eq!(hand_in(&bench, "", right()).await.status, StatusCode::CREATED);
    }
    // Without a roster the class is whoever handed in as somebody; a program's anonymous posts never count.
    assert_eq!(hand_in(&bench, "?student=s1", sample(WRONG)).await.status, StatusCode::CREATED);
    let page = get(&bench, "/teacher").await;
    assert_eq!(page.all(".overview .lead"), ["1 of 1 have handed in"]);
    assert!(page.all(".aside")[0].starts_with("3 hand-ins of nobody in the class"));
    assert_eq!(page.all(".overview .score"), ["Mean of the points that count 80 mean"]);

    // The archive comes before the roster, with names in another order, width and case.
    let members = [
        ("花子　和田_11_assignsubmission_file_/ggsample06.vert".to_owned(), right()),
        ("SMITH Ｊｏｈｎ_12_assignsubmission_file_/ggsample06.vert".to_owned(), right_and_new()),
        ("他人 太郎_13_assignsubmission_file_/ggsample06.vert".to_owned(), sample(WRONG)),
        ("鈴木 一郎_14_assignsubmission_file_/report.pdf".to_owned(), b"%PDF-1.4".to_vec()),
    ];
    let batch = archive(&bench, zip(&members)).await;
    roster(&bench, "学籍番号,氏名\nS1,和田 花子\nS2,\"Smith, John\"\nS3,鈴木 一郎\nS4,山本 次郎\nS5,Nobody Yet\n")
        .await;
    let page = get(&bench, "/teacher").await;
    assert_eq!(page.all(".overview .lead"), ["2 of 5 have handed in"]);
    assert!(page.all(".aside")[0].starts_with("4 hand-ins of nobody in the class"), "{:?}", page.all(".aside"));
    assert_eq!(page.all(".overview .score"), ["Mean of the points that count 100 mean"]);
    // What could not be graded stands first, then everyone by number.
    let students = page.all(".people tbody th");
    assert_eq!(students, ["S3 鈴木 一郎", "S1 和田 花子", "S2 Smith, John", "S4 山本 次郎", "S5 Nobody Yet"],);
    let verdicts = page.all(".people .verdict-cell");
    assert_eq!(verdicts, ["Nothing to grade", "Correct", "Correct", "Nothing handed in", "Nothing handed in"]);
    // Who has handed in twice, by hand and in the archive, is one student.
    assert_eq!(page.all(".people tbody tr:nth-child(2) td.number"), ["100 / 100", "2"]);
    let apart = get(&bench, "/teacher?apart=on").await;
    assert_eq!(apart.all(".people tbody tr").len(), 4);
    assert!(apart.all(".people tbody th").contains(&"13 他人 太郎".to_owned()));
    // The archive's own page has everybody in it, the roster's students by number.
    let one = get(&bench, &format!("/teacher/batches/{batch}")).await;
    let everyone = one.all(".people tbody th");
    assert_eq!(everyone.len(), 4);
    assert!(everyone.contains(&"S1 和田 花子".to_owned()) && everyone.contains(&"13 他人 太郎".to_owned()));

    let csv = get(&bench, "/api/v1/class/files/csv").await.text();
    let rows: Vec<&str> = csv.lines().skip(1).map(|line| line.split(',').next().expect("a cell")).collect();
    assert_eq!(rows, ["S1", "S2", "S3", "S4", "S5"], "{csv}");
    // Another roster: who is on it now is the class, and nothing is lost.
    let said = roster(&bench, "S13,他人 太郎\n").await;
    assert!(said.contains("1 on it, 1 of them new; 5 of the roster before are no longer on it"), "{said}");
    assert!(said.ends_with("0 of 1 have a group. It begins with S13 他人 太郎."), "{said}");
    let page = get(&bench, "/teacher").await;
    assert_eq!(page.all(".people tbody th"), ["S13 他人 太郎"]);
    assert_eq!(page.all(".people .mistakes span"), ["Half vector not normalised"]);
    let page = get(&bench, "/teacher?lang=ja").await;
    assert_eq!(page.all(".people .mistakes span"), ["中間ベクトルが正規化されていない"]);
    bench.finish().await;
}

async fn columns_that_are_not_taken_are_named(database: Database) {
    let bench = Bench::new(database).await;
    let file = "Matrikelnummer;Nachname;Vorname;Gruppe;Studiengang & <Jahr>\nS1;Wada;Hanako;A;X\nS2;Ito;Ken;;Y\n";
    let said = roster(&bench, file).await;
    let expected =
        "1 of 2 have a group. Columns that were not taken: Studiengang & <Jahr>. It begins with S1 Wada Hanako";
    assert!(said.contains(expected), "{said}");
    let put = request("PUT", "/api/v1/roster", "text/csv", "ID,Name,Year\nS1,Wada,3\n");
    let answer = bench.send(put).await.json();
    assert_eq!((&answer["columns_left_aside"], &answer["with_group"]), (&serde_json::json!(["Year"]), &0.into()));
    bench.finish().await;
}

async fn numbers_that_are_not_on_the_roster_are_refused(database: Database) {
    let bench = Bench::new(database).await;
    let secret = course_secret(&bench.state).await.expect("a secret");
    // A browser gives a number before there is a roster.
    let guest = Guest::new(&bench).await;
    let join = async |number: &str| guest.join(&bench, number, "").await;
    assert_eq!(join("s9").await.status, StatusCode::SEE_OTHER);
    roster(&bench, "S1,和田 花子\n").await;

    let refused = hand_in(&bench, "?student=s8&lang=en", right()).await;
    assert_eq!((refused.status, refused.problem().as_str()), (StatusCode::UNPROCESSABLE_ENTITY, "not-on-roster"));
    assert!(refused.json()["detail"].as_str().expect("text").contains("S8"));
    let course = format!("?student=s8&course={secret}");
    assert_eq!(bench.hand_in(&course, right()).await.problem(), "not-on-roster");
    assert_eq!(hand_in(&bench, "?student=%EF%BD%93%EF%BC%91", right()).await.status, StatusCode::CREATED);

    let page_of_join = join("s7").await;
    assert_eq!(page_of_join.status, StatusCode::UNPROCESSABLE_ENTITY);
    assert!(page_of_join.all("[role=alert]")[0].contains("S7 is not on the class's roster"));

    // The browser from before is told, and its files are refused rather than lost in silence.
    let desk = guest.get(&bench, "/").await;
    assert!(desk.all("[role=alert]")[0].contains("S9 is not on the class's roster"), "{:?}", desk.all("[role=alert]"));
    let own = guest.request("POST", "/api/v1/submissions").header(header::CONTENT_TYPE, "text/plain");
    assert_eq!(bench.send(own.body(Body::from(right())).expect("a request")).await.problem(), "not-on-roster");
    // The right number goes on from there, with its code.
    assert_eq!(join("S1").await.status, StatusCode::FORBIDDEN);
    let student = bench.state.store.student_by_number("S1").await.expect("a store").expect("a student");
    let joined = guest.join(&bench, "S1", &personal_code(&bench.state, &student)).await;
    assert_eq!((joined.status, joined.header("location")), (StatusCode::SEE_OTHER, "/a/ggsample06"));
    bench.finish().await;
}

async fn what_cannot_be_read_leads_back_to_its_form(database: Database) {
    let bench = Bench::new(database).await;
    roster(&bench, "S1,和田 花子\n").await;
    let held = async |reply: &Reply, action: &str, said: &str| {
        assert_eq!(reply.status, StatusCode::UNPROCESSABLE_ENTITY, "{action}");
        let alerts = reply.all(&format!(
            ".panel:has(form[action='{action}']) [role=alert], section:has(form[action='{action}']) > [role=alert]"
        ));
        assert!(alerts.first().is_some_and(|alert| alert.contains(said)), "{action}: {alerts:?}");
    };
    let wrong = file(&bench, "/teacher/roster", "roster", "r.csv", b"S1,A\nS2,B\nno number here\n").await;
    held(&wrong, "/teacher/roster", "Line 3 of the file has no student number").await;
    assert_eq!(wrong.all("#roster small"), ["1 students"], "the roster stays");
    let wrong = file(&bench, "/teacher/roster", "roster", "r.xlsx", b"PK\x03\x04").await;
    held(&wrong, "/teacher/roster", "CSV UTF-8").await;
    let huge = file(&bench, "/teacher/roster", "roster", "r.csv", &vec![b'x'; 5 << 20]).await;
    assert_eq!((huge.status, huge.all("#roster").len()), (StatusCode::PAYLOAD_TOO_LARGE, 1));

    let wrong = file(&bench, "/teacher/batches", "file", "class.zip", b"no archive").await;
    held(&wrong, "/teacher/batches", "nothing to grade in this archive").await;
    let empty = file(&bench, "/teacher/batches", "other", "class.zip", b"").await;
    held(&empty, "/teacher/batches", "file").await;

    let batch = archive(&bench, zip(&[("和田 花子_11_assignsubmission_file_/ggsample06.vert".into(), right())])).await;
    let address = format!("/teacher/batches/{batch}/worksheet");
    let wrong = file(&bench, &address, "sheet", "grades.csv", b"a,b\n1,2\n").await;
    held(&wrong, &address, "").await;
    assert_eq!(wrong.all(".people tbody tr").len(), 1, "the page is the archive's own");

    let wrong = form(&bench, "/teacher/settings", "attempts=none&opens=&closes=2026-12-24T18%3A00").await;
    held(&wrong, "/teacher/settings", "Attempts").await;
    assert!(wrong.text().contains("2026-12-24T18:00"), "what was typed stays");
    for (fields, said) in [
        ("attempts=99999999999", "a whole number from 1 to 1000000"),
        ("closes=0001-01-01T00%3A00", "A date is in the years 2000 to 2999."),
    ] {
        held(&form(&bench, "/teacher/settings", fields).await, "/teacher/settings", said).await;
    }
    // What leads nowhere else leads to the class.
    let lost = get(&bench, "/teacher/batches/none").await;
    assert!(lost.text().contains("href=\"/teacher\"") && lost.status == StatusCode::NOT_FOUND);
    bench.finish().await;
}

async fn three_hundred_students_and_an_archive(database: Database) {
    let bench = Bench::new(database).await;
    let name = |n: usize| format!("学生 {n:03}");
    let lines: String = (0..300).map(|n| format!("S{n:03},{}\n", name(n))).collect();
    roster(&bench, &lines).await;
    let files = [right(), sample(WRONG), sample("rejected/brace-missing-at-end.vert")];
    let members: Vec<_> = (0..60)
        .map(|n| (format!("{}_{}_assignsubmission_file_/ggsample06.vert", name(n * 5), 900 + n), files[n % 3].clone()))
        .collect();
    archive(&bench, zip(&members)).await;
    let page = get(&bench, "/teacher").await;
    assert_eq!(page.all(".overview .lead"), ["60 of 300 have handed in"]);
    assert_eq!(page.all(".people tbody tr").len(), 50);
    assert_eq!(page.all(".pager a"), ["1", "2", "3", "4", "5", "6"]);
    assert_eq!(get(&bench, "/teacher?page=6").await.all(".people tbody tr").len(), 50);
    // Twenty each of 100, 80 and 0.
    assert_eq!(page.all(".overview .score"), ["Mean of the points that count 60 mean"]);
    let sorted = get(&bench, "/teacher?sort=-score").await;
    assert_eq!(sorted.all("th[aria-sort=descending]"), ["Score"]);
    assert_eq!(sorted.all(".people tbody tr:first-child th"), ["S000 学生 000"]);
    assert_eq!(sorted.all(".people tbody tr:nth-child(21) td.number")[0], "80 / 100");
    let csv = get(&bench, "/api/v1/class/files/csv").await.text();
    assert_eq!(csv.lines().count(), 301);
    bench.finish().await;
}
