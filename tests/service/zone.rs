//! Zone and language are the course's, whoever looks.

use crate::bench::Bench;
use crate::cluster::Database;
use crate::roster::{WRONG, archive, file, form, get, made, request, zip};
use crate::{on_both, sample};
use axum::http::StatusCode;
use serde_json::json;

on_both!(
    zone_and_language_are_the_courses,
    a_date_that_comes_back_as_it_was_shown_does_not_move,
    a_time_that_the_clocks_leave_out_or_repeat_is_said,
);

async fn zone_and_language_are_the_courses(database: Database) {
    let bench = Bench::new(database).await;
    assert_eq!(
        form(&bench, "/teacher/settings", "closes=2099-07-01T12%3A00&hints=full&audience=open").await.status,
        303
    );
    let page = get(&bench, "/teacher/settings").await.text();
    assert!(page.contains("2099-07-01T12:00") && page.contains("Asia/Tokyo"), "whatever TZ says");
    let wrong = form(&bench, "/teacher/course", "zone=Asia%2FNowhere&language=en").await;
    assert_eq!(wrong.status, StatusCode::UNPROCESSABLE_ENTITY);
    assert!(wrong.all("[role=alert]")[0].contains("`Asia/Nowhere`") && wrong.text().contains("value=\"Asia/Nowhere\""));
    let batch =
        archive(&bench, zip(&[("和田 花子_11_assignsubmission_file_/ggsample06.vert".into(), sample(WRONG))])).await;
    // A teacher who reads English gives comments in the course's language.
    let sheet = "Identifier,Full name,Grade,Maximum Grade,Grade can be changed,Feedback comments\n\
                 Participant 11,和田 花子,,100,Yes,\n";
    let fill = async || {
        let address = format!("/teacher/batches/{batch}/worksheet");
        made(&bench, file(&bench, &address, "sheet", "g.csv", sheet.as_bytes()).await).await.1.text()
    };
    assert!(fill().await.contains("鏡面反射光"), "the usual language is Japanese");
    let asked = format!("/api/v1/batches/{batch}/files/moodle-worksheet?lang=en");
    let asked = bench.send(request("POST", &asked, "text/csv", sheet)).await.text();
    assert!(asked.contains("Specular"), "a program that asks for a language gets it");
    assert!(get(&bench, &format!("/api/v1/batches/{batch}/files/csv")).await.text().contains("Half vector"));

    assert_eq!(form(&bench, "/teacher/course", "zone=America%2FNew_York&language=en").await.status, 303);
    assert!(fill().await.contains("Specular"));
    // The deadline is the same moment: noon in Tokyo is eleven at night in New York.
    assert!(get(&bench, "/teacher/settings").await.text().contains("2099-06-30T23:00"));
    let desk = bench.get("/?lang=en").await;
    assert!(
        desk.all(".terms-of-hand-in").concat().contains("30 Jun 2099, 23:00"),
        "{:?}",
        desk.all(".terms-of-hand-in")
    );
    bench.finish().await;
}

async fn a_date_that_comes_back_as_it_was_shown_does_not_move(database: Database) {
    let bench = Bench::new(database).await;
    assert_eq!(form(&bench, "/teacher/course", "zone=Europe%2FBerlin&language=en").await.status, 303);
    let settings = "/api/v1/assignments/ggsample06/settings";
    let set = async |due_at: &str| {
        let wish = json!({ "due_at": due_at }).to_string();
        assert_eq!(bench.send(request("PATCH", settings, "application/json", wish)).await.status, StatusCode::OK);
    };
    // A second before midnight, and the second half past two of the night in which summer time ends.
    for (due_at, shown) in [("2026-12-11T22:59:59Z", "2026-12-11T23:59"), ("2027-10-31T01:30:00Z", "2027-10-31T02:30")]
    {
        set(due_at).await;
        assert!(get(&bench, "/teacher/settings").await.text().contains(&format!("value=\"{shown}\"")));
        let fields = format!("closes={}&attempts=3&hints=full&audience=open", shown.replace(':', "%3A"));
        assert_eq!(form(&bench, "/teacher/settings", &fields).await.status, 303);
        assert_eq!(get(&bench, settings).await.json()["due_at"], due_at);
    }
    // The log tells the two apart.
    set("2027-10-31T00:30:00Z").await;
    let log = get(&bench, "/teacher/log").await.all(".people tbody tr");
    assert!(log[0].contains("closes: 2027-10-31T02:30+01:00 → 2027-10-31T02:30+02:00"), "{log:?}");

    bench.state.store.student("S1", 0).await.expect("a store").expect("a student");
    let own = json!({ "whose": "S1", "due_at": "2027-11-01T22:59:59Z", "reason": "ill" }).to_string();
    assert_eq!(bench.send(request("PUT", "/api/v1/extensions", "application/json", own)).await.status, 204);
    let fields = "whose=S1&closes=2027-11-01T23%3A59&reason=well";
    assert_eq!(form(&bench, "/teacher/extensions", fields).await.status, 303);
    let extensions = get(&bench, "/api/v1/extensions").await.json();
    assert_eq!(extensions["extensions"][0]["due_at"], "2027-11-01T22:59:59Z");
    assert_eq!(extensions["extensions"][0]["reason"], "well");
    bench.finish().await;
}

async fn a_time_that_the_clocks_leave_out_or_repeat_is_said(database: Database) {
    let bench = Bench::new(database).await;
    assert_eq!(form(&bench, "/teacher/course", "zone=Europe%2FBerlin&language=en").await.status, 303);
    bench.state.store.student("S1", 0).await.expect("a store").expect("a student");
    let said = async |address: &str, fields: &str| {
        let done = form(&bench, address, fields).await;
        assert_eq!(done.status, 303, "{done:?}");
        get(&bench, done.header("location")).await.all(".unclear-times").concat()
    };
    let skipped = "There is no 2027-03-28 02:30, because the clocks are set forward: 28 Mar 2027, 03:30 CEST is taken.";
    let twice =
        "2027-10-31 02:30 comes twice, because the clocks are set back: the first, 31 Oct 2027, 02:30 CEST, is taken.";
    let rules = "hints=full&audience=open&closes=2027-03-28T02%3A30";
    assert_eq!(said("/teacher/settings", rules).await, skipped);
    let extension = "whose=S1&reason=ill&closes=2027-10-31T02%3A30";
    assert_eq!(said("/teacher/extensions", extension).await, twice);
    assert_eq!(said("/teacher/extensions", extension).await, "", "it is not typed anew");
    let shown = "seen.ggsample06=from&from.ggsample06=2027-03-28T02%3A30";
    assert_eq!(said("/teacher/plan", shown).await, skipped);
    let page = get(&bench, "/teacher/settings?unclear=2027-03-28T02:30&lang=ja").await;
    assert!(page.all(".unclear-times")[0].contains("2027年3月28日 03:30 CEST として設定しました"), "{page:?}");
    // What is no such time is not repeated.
    assert!(get(&bench, "/teacher/settings?unclear=Hello").await.all(".unclear-times").is_empty());
    bench.finish().await;
}
