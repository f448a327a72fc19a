//! A term as one file that opens without ggrade.

use crate::bench::Bench;
use crate::cluster::Database;
use crate::roster::{file, form, get, made, request};
use crate::{on_both, right, sample};
use axum::http::StatusCode;
use serde_json::Value;
use std::collections::BTreeMap;
use std::io::{Cursor, Read};

on_both!(a_term_is_one_file);

fn unpacked(bytes: Vec<u8>) -> BTreeMap<String, Vec<u8>> {
    let mut zip = zip::ZipArchive::new(Cursor::new(bytes)).expect("an archive");
    let mut files = BTreeMap::new();
    for index in 0..zip.len() {
        let mut member = zip.by_index(index).expect("a member");
        let mut bytes = Vec::new();
        member.read_to_end(&mut bytes).expect("its bytes");
        files.insert(member.name().expect("a name").into_owned(), bytes);
    }
    files
}

async fn a_term_is_one_file(database: Database) {
    let bench = Bench::new(database).await;
    file(&bench, "/teacher/roster", "roster", "r.csv", "S1,和田 花子\nS2,山本 次郎\n".as_bytes()).await;
    let wrong = sample("wrong/specular-half-unnormalized--average.vert");
    let mut ids = Vec::new();
    // What a name has in it that Windows does not take is replaced.
    for (name, bytes) in [("aux%3A%3F.vert", wrong), ("ggsample06.vert", right())] {
        let address = format!("/api/v1/submissions?student=S1&name={name}");
        ids.push(bench.send(request("POST", &address, "text/plain", bytes)).await.id());
    }
    let set = form(&bench, &format!("/r/{}/override", ids[1]), "line=specular&points=30&reason=by+hand").await;
    assert_eq!(set.status, StatusCode::SEE_OTHER);

    let course = "zone=America%2FNew_York&language=en&title=Computer+Graphics";
    assert_eq!(form(&bench, "/teacher/course", course).await.status, StatusCode::SEE_OTHER);

    let (_, zip) = made(&bench, form(&bench, "/teacher/data/archive", "").await).await;
    let files = unpacked(zip.body);
    let text = |name: &str| {
        let bytes = files.get(name).unwrap_or_else(|| panic!("{name} of {:?}", files.keys()));
        String::from_utf8(bytes.clone()).expect("UTF-8")
    };
    let index = text("index.html");
    // Each address in it is a file of the archive.
    let page = scraper::Html::parse_document(&index);
    let links = scraper::Selector::parse("a[href]").expect("a selector");
    let links: Vec<&str> = page.select(&links).filter_map(|link| link.value().attr("href")).collect();
    assert!(links.len() > 6, "{links:?}");
    for link in links.iter().filter(|link| !link.starts_with('#')) {
        let link = percent_encoding::percent_decode_str(link).decode_utf8().expect("UTF-8");
        assert!(files.contains_key(&*link), "{link}");
    }
    assert!(index.contains("和田 花子") && index.contains("山本 次郎") && !index.contains("src=\"http"), "{index}");
    // It is of this course, with its times, and everybody has a sum.
    assert!(index.contains("<title>Computer Graphics · ") && index.contains("<bdi>Computer Graphics</bdi>"), "{index}");
    let times = scraper::Selector::parse("time").expect("a selector");
    let times: Vec<String> = page.select(&times).map(|time| time.text().collect()).collect();
    assert!(times.len() > 2 && times.iter().all(|time| time.ends_with(" EST") || time.ends_with(" EDT")), "{times:?}");
    let sums = scraper::Selector::parse("#gradebook tbody tr").expect("a selector");
    let sums: Vec<String> = page.select(&sums).map(|line| line.text().collect()).collect();
    assert_eq!(sums, ["S1 和田 花子9090", "S2 山本 次郎–0"]);
    assert!(text("gradebook.csv").contains("\nS1,和田 花子,90,90\r\n"), "{}", text("gradebook.csv"));
    assert!(files.contains_key("ggsample06/hand-ins/S1/01/aux__.vert"), "{:?}", files.keys());
    assert_eq!(files["ggsample06/hand-ins/S1/02/ggsample06.vert"], right());
    let page = text("ggsample06/students/S1.html");
    assert!(
        page.contains("by hand") && page.contains("data:image/"),
        "a feedback page has what was judged, and its pictures"
    );
    let grades: Value = serde_json::from_str(&text("ggsample06/grades.json")).expect("JSON");
    assert_eq!((&grades[0]["key"], &grades[0]["total"]), (&Value::from("S1"), &Value::from(90.0)), "{grades}");
    assert!(grades[1]["total"].is_null(), "{grades}");
    assert!(text("ggsample06/grades.csv").contains("\nS1,和田 花子,"));
    assert!(text("log.csv").contains(",override,ggsample06,S1,"), "{}", text("log.csv"));

    // The same by the API.
    let begun = bench.send(request("POST", "/api/v1/archive", "", "")).await;
    assert_eq!(begun.status, StatusCode::ACCEPTED);
    let address = begun.header("location").to_owned();
    for _ in 0..1200 {
        let reply = get(&bench, &address).await;
        if reply.status == StatusCode::OK {
            assert_eq!(unpacked(reply.body).len(), files.len());
            assert_eq!(bench.get(&address).await.status, StatusCode::UNAUTHORIZED);
            return;
        }
        assert_eq!(reply.status, StatusCode::ACCEPTED);
        tokio::time::sleep(std::time::Duration::from_millis(50)).await;
    }
    panic!("it is never made");
}
