//! What students do with what they handed in: they let it count, and ask for another look.

use crate::bench::Bench;
use crate::cluster::Database;
use crate::codes::Guest;
use crate::judgement::api;
use crate::late::{RULES, bench, rules};
use crate::on_both;
use crate::roster::file;
use axum::body::Body;
use axum::http::{StatusCode, header};
use ggrade::service::identity::personal_code;
use serde_json::json;

on_both!(who_is_not_in_the_class_lets_nothing_count_and_asks_nothing);

async fn code(bench: &Bench, number: &str) -> String {
    let student = bench.state.store.student_by_number(number).await.expect("a store").expect("a student");
    personal_code(&bench.state, &student)
}

/// Lets a hand-in count, and asks about it; what both are answered.
async fn both(bench: &Bench, guest: &Guest, id: &str) -> [StatusCode; 2] {
    let csrf = guest.csrf(bench).await;
    let send = async |address: &str, fields: String| {
        let request = guest.request("POST", address).header(header::ACCEPT, "text/html");
        let request = request.header(header::CONTENT_TYPE, "application/x-www-form-urlencoded");
        bench.send(request.body(Body::from(fields)).expect("a request")).await.status
    };
    [
        send("/a/ggsample06/choose", format!("csrf={csrf}&submission={id}")).await,
        send(&format!("/r/{id}/appeal"), format!("csrf={csrf}&line=specular&question=Why")).await,
    ]
}

async fn who_is_not_in_the_class_lets_nothing_count_and_asks_nothing(database: Database) {
    let (bench, _) = bench(database).await;
    rules(&bench, &format!("{RULES}&counting=chosen")).await;
    let mine = Guest::new(&bench).await;
    mine.join(&bench, "S1", &code(&bench, "S1").await).await;
    let id = mine.hand_in(&bench, "60").await.id();
    mine.hand_in(&bench, "70").await;
    let shown = async || {
        let report = mine.get(&bench, &format!("/r/{id}")).await.all(".judgement details").len();
        (report, mine.get(&bench, "/a/ggsample06").await.all(".attempts form").len())
    };
    assert_eq!(shown().await, (1, 1));

    // Another roster is imported, and the student is not on it.
    let roster = async |csv: &str| file(&bench, "/teacher/roster", "roster", "r.csv", csv.as_bytes()).await;
    roster("number,name\nS2,B\n").await;
    assert_eq!(both(&bench, &mine, &id).await, [StatusCode::UNPROCESSABLE_ENTITY; 2]);
    assert_eq!(shown().await, (0, 0));
    // On it again, they see no homework any more.
    roster("number,name\nS1,A\nS2,B\n").await;
    let settings = "/api/v1/assignments/ggsample06/settings";
    let hidden = async |is_hidden| api(&bench, "PATCH", settings, json!({ "is_hidden": is_hidden })).await.status;
    assert_eq!(hidden(true).await, StatusCode::OK);
    assert_eq!(both(&bench, &mine, &id).await, [StatusCode::NOT_FOUND; 2]);
    assert_eq!(hidden(false).await, StatusCode::OK);
    assert_eq!(both(&bench, &mine, &id).await, [StatusCode::SEE_OTHER; 2]);
    bench.finish().await;
}
