//! The student's page of a version that is looked at before it is published.

use super::{bench, first, get, post, publish, uploaded};
use crate::cluster::Database;
use crate::on_both;
use axum::http::StatusCode;
use std::path::Path;

on_both!(a_version_is_looked_at_as_students_will_see_it,);

/// What differs between the page of a version that is looked at and the page that students have once it is published.
fn without_marks(page: &str, id: &str) -> String {
    let page =
        page.replace(&format!("/teacher/folders/{id}/page"), "/a/waves").replace(&format!("waves {id}"), "waves");
    let mark = page.find("<aside class=\"preview\"").map(|from| from..page.find("</aside>").expect("an end") + 9);
    let page = mark.map_or(page.clone(), |mark| page.replace(&page[mark], ""));
    let is_of_this_page = |line: &&str| {
        [
            "csrf",
            "data-now",
            "/api/docs",
            "idempotency_key",
            "<footer",
            "/teacher",
            "?lang=",
            "formaction=\"/a/waves/draft\"",
        ]
        .iter()
        .any(|word| line.contains(word))
    };
    let lines = page
        .lines()
        .filter(|line| !is_of_this_page(line))
        .map(|line| line.replace(" data-draft=\"/a/waves/draft\"", ""));
    lines.filter(|line| !line.trim().is_empty()).collect::<Vec<_>>().join("\n")
}

async fn a_version_is_looked_at_as_students_will_see_it(database: Database) {
    let bench = bench(database).await;
    let id = uploaded(&bench, first()).await;
    let address = format!("/teacher/folders/{id}/page");
    assert!(get(&bench, &format!("/teacher/folders/{id}")).await.text().contains(&format!("href=\"{address}\"")));
    let seen = get(&bench, &address).await;
    assert_eq!((seen.status, seen.all("h1")), (StatusCode::OK, vec!["Waves".to_owned()]));
    assert!(seen.all("aside.preview")[0].contains("Nobody else sees it"), "{}", seen.text());
    // Nothing is handed in or graded there, and what is loaded by it is there.
    let sent = post(&bench, &address, "").await;
    assert_eq!((sent.status, sent.problem().as_str()), (StatusCode::CONFLICT, "preview"));
    assert!(!seen.text().contains("data-draft="), "nothing that is typed is sent");
    let starter = get(&bench, &format!("{address}/starter")).await;
    let published = std::fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/homeworks/waves/starter.vert"));
    assert_eq!((starter.status, starter.body), (StatusCode::OK, published.expect("a file")));
    assert_eq!(bench.get("/a/waves").await.status, StatusCode::NOT_FOUND);
    assert_eq!(publish(&bench, &id).await.status, StatusCode::OK);
    // Beside the page that is published, with the same homeworks in the navigation.
    let (seen, published) = (get(&bench, &address).await, get(&bench, "/a/waves").await);
    let (before, after) = (without_marks(&seen.text(), &id), without_marks(&published.text(), &id));
    assert!(before.len() > 3000);
    for (before, after) in before.lines().zip(after.lines()) {
        assert_eq!(before, after);
    }
    assert_eq!(before.lines().count(), after.lines().count());
    bench.finish().await;
}
