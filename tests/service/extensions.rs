//! A student's own deadline.

use crate::bench::{Bench, Fake, Reply, config};
use crate::cluster::Database;
use crate::codes::Guest;
use crate::on_both;
use crate::roster::{file, form, get, request};

use axum::http::StatusCode;
use ggrade::service::clock::Clock;
use ggrade::service::identity::personal_code;
use std::sync::Arc;
use std::time::Duration;

on_both!(
    a_student_has_a_deadline_of_their_own,
    a_groups_deadline_stands_with_each_of_its_students,
    a_name_of_a_group_and_of_a_student_is_nobodys
);

/// 2023-11-15 07:13:20 in Tokyo.
const NOW: i64 = 1_700_000_000_000;
const HOUR: Duration = Duration::from_secs(3600);

async fn hand_in(bench: &Bench, number: &str) -> Reply {
    let address = format!("/api/v1/submissions?student={number}");
    bench.send(request("POST", &address, "text/plain", format!("of {number}"))).await
}

/// The desk of a student who has joined.
async fn desk(bench: &Bench, number: &str) -> Reply {
    let student = bench.state.store.student_by_number(number).await.expect("a store").expect("a student");
    let guest = Guest::new(bench).await;
    let joined = guest.join(bench, number, &personal_code(&bench.state, &student)).await;
    assert_eq!(joined.status, StatusCode::SEE_OTHER);
    guest.get(bench, "/").await
}

async fn a_student_has_a_deadline_of_their_own(database: Database) {
    let clock = Clock::fixed(NOW);
    let bench = Bench::with(database, config(), Arc::new(Fake(|| Ok(()))), clock.clone()).await;
    file(&bench, "/teacher/roster", "roster", "r.csv", "S1,和田 花子\nS2,B\n".as_bytes()).await;
    let rules = "closes=2023-11-15T08%3A00&hints=full&audience=open";
    assert_eq!(form(&bench, "/teacher/settings", rules).await.status, StatusCode::SEE_OTHER);
    let id = bench.state.store.student_by_number("S1").await.expect("a store").expect("a student").id;
    let extend = async |closes: &str| {
        form(&bench, "/teacher/extension", &format!("student={id}&closes={closes}&reason=%E7%97%85%E6%B0%97")).await
    };
    // One that ends before the class's does is none.
    let wrong = extend("2023-11-15T07%3A59").await;
    assert_eq!(wrong.status, StatusCode::UNPROCESSABLE_ENTITY);
    assert!(wrong.all("[role=alert]")[0].contains("after the deadline of the class"));
    assert!(
        wrong.text().contains("value=\"2023-11-15T07:59\"") && wrong.text().contains("病気"),
        "what was typed stays"
    );
    let set = extend("2023-11-15T10%3A00").await;
    let person = get(&bench, set.header("location")).await;
    assert!(
        person.text().contains("value=\"2023-11-15T10:00\"") && person.text().contains("病気"),
        "{}",
        person.text()
    );

    clock.advance(HOUR);
    assert_eq!(hand_in(&bench, "S2").await.problem(), "closed");
    assert_eq!(hand_in(&bench, "S1").await.status, StatusCode::CREATED);
    let facts = desk(&bench, "S1").await.all(".terms-of-hand-in li").concat();
    assert!(facts.contains("Due 15 Nov 2023, 10:00") && facts.contains("extended for you"), "{facts}");
    let facts = desk(&bench, "S2").await.all(".terms-of-hand-in li").concat();
    assert!(facts.contains("Closed since 15 Nov 2023, 08:00") && !facts.contains("extended"), "{facts}");
    // The class's deadline moves behind it: the later one counts.
    let rules = "closes=2023-11-15T12%3A00&hints=full&audience=open";
    assert_eq!(form(&bench, "/teacher/settings", rules).await.status, StatusCode::SEE_OTHER);
    assert!(!desk(&bench, "S1").await.text().contains("extended for you"));
    clock.advance(HOUR * 2);
    assert_eq!(hand_in(&bench, "S1").await.status, StatusCode::CREATED);
    clock.advance(HOUR * 2);
    assert_eq!(hand_in(&bench, "S1").await.problem(), "closed");
    // It is taken away again; the log has both.
    assert_eq!(extend("2023-11-15T23%3A00").await.status, StatusCode::SEE_OTHER);
    assert_eq!(hand_in(&bench, "S1").await.status, StatusCode::CREATED);
    assert_eq!(extend("").await.status, StatusCode::SEE_OTHER);
    assert_eq!(hand_in(&bench, "S1").await.problem(), "closed");
    let log = get(&bench, "/teacher/log").await.all(".people tbody tr");
    let own: Vec<&String> = log.iter().filter(|row| row.contains("own deadline")).collect();
    let has = |text: &str| own.iter().any(|row| row.contains("S1") && row.contains(text));
    assert!(own.len() == 3 && has("– 病気") && has("2023-11-15T23:00") && has("2023-11-15T10:00"), "{log:?}");
    bench.finish().await;
}

async fn a_groups_deadline_stands_with_each_of_its_students(database: Database) {
    let bench = Bench::with(database, config(), Arc::new(Fake(|| Ok(()))), Clock::fixed(NOW)).await;
    file(&bench, "/teacher/roster", "roster", "r.csv", b"number,name,group\nS1,A,Tue\nS2,B,Wed\n").await;
    let rules = "closes=2023-11-15T08%3A00&hints=full&audience=open";
    assert_eq!(form(&bench, "/teacher/settings", rules).await.status, StatusCode::SEE_OTHER);
    let set = form(&bench, "/teacher/extensions", "whose=Tue&closes=2023-11-15T12%3A00&reason=strike").await;
    assert_eq!(set.status, StatusCode::SEE_OTHER);
    let page = async |number: &str, language: &str| {
        let id = bench.state.store.student_by_number(number).await.expect("a store").expect("a student").id;
        get(&bench, &format!("/teacher/person?key={id}&lang={language}")).await.all(".of-group").concat()
    };
    let said = page("S1", "en").await;
    assert!(said.starts_with("Extension of the group Tue: 15 Nov 2023, 12:00") && said.contains("(strike)"), "{said}");
    assert!(page("S1", "ja").await.contains("グループの延長 Tue"), "{}", page("S1", "ja").await);
    assert_eq!(page("S2", "en").await, "");
    let export = async |number: &str| {
        let zip = get(&bench, &format!("/api/v1/students/{number}/export")).await.body;
        let mut zip = zip::ZipArchive::new(std::io::Cursor::new(zip)).expect("an archive");
        let about = zip.by_name("student.json").expect("a file");
        serde_json::from_reader::<_, serde_json::Value>(about).expect("JSON")["extensions_of_group"].clone()
    };
    let expected = serde_json::json!([{
        "assignment": "ggsample06", "group": "Tue", "closes_at": "2023-11-15T03:00:00Z", "reason": "strike",
    }]);
    assert_eq!(export("S1").await, expected);
    assert_eq!(export("S2").await, serde_json::json!([]));
    bench.finish().await;
}

async fn a_name_of_a_group_and_of_a_student_is_nobodys(database: Database) {
    let bench = Bench::with(database, config(), Arc::new(Fake(|| Ok(()))), Clock::fixed(NOW)).await;
    file(&bench, "/teacher/roster", "roster", "r.csv", b"number,name,group\nS1,A,S2\nS2,B,Tue\n").await;
    let rules = "closes=2023-11-15T08%3A00&hints=full&audience=open";
    assert_eq!(form(&bench, "/teacher/settings", rules).await.status, StatusCode::SEE_OTHER);
    let set = async |whose: &str| {
        let body = serde_json::json!({ "whose": whose, "due_at": "2023-11-15T12:00:00+09:00" }).to_string();
        bench.send(request("PUT", "/api/v1/extensions", "application/json", body)).await
    };
    assert_eq!(set("S2").await.problem(), "ambiguous");
    let refused = form(&bench, "/teacher/extensions", "whose=S2&closes=2023-11-15T12%3A00&reason=").await;
    assert_eq!(refused.status, StatusCode::UNPROCESSABLE_ENTITY);
    assert!(refused.all("[role=alert]")[0].contains("S2 is a group and a student number"), "{}", refused.text());
    for whose in ["S1", "Tue"] {
        assert_eq!(set(whose).await.status, StatusCode::NO_CONTENT, "{whose}");
    }
    bench.finish().await;
}
