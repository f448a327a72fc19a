//! What students do with what they handed in: they let it count, and ask for another look.

use crate::bench::Bench;
use crate::cluster::Database;
use crate::codes::Guest;
use crate::judgement::api;
use crate::late::{MINUTE, RULES, bench, csv, rules};
use crate::on_both;
use crate::roster::{file, get};
use axum::body::Body;
use axum::http::{Request, StatusCode, header};
use ggrade::service::identity::{course_secret, personal_code};
use serde_json::{Value, json};

on_both!(
    who_is_not_in_the_class_lets_nothing_count_and_asks_nothing,
    a_student_lets_something_count_and_asks_by_a_program,
);

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
    // What was typed is not lost, and the way leads back to the report.
    let request = mine.request("POST", &format!("/r/{id}/appeal")).header(header::ACCEPT, "text/html");
    let request = request.header(header::CONTENT_TYPE, "application/x-www-form-urlencoded");
    let typed = format!("csrf={}&line=specular&question=Why+not%3F", mine.csrf(&bench).await);
    let page = bench.send(request.body(Body::from(typed)).expect("a request")).await;
    assert_eq!(page.all("#typed"), ["Why not?"]);
    assert!(page.text().contains(&format!("href=\"/r/{id}#judgement\"")), "{}", page.text());
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

async fn a_student_lets_something_count_and_asks_by_a_program(database: Database) {
    let (bench, clock) = bench(database).await;
    rules(&bench, &format!("{RULES}&counting=chosen")).await;
    let course = course_secret(&bench.state).await.expect("a secret");
    let who = async |number: &str| format!("student={number}&course={course}&code={}", code(&bench, number).await);
    let (mine, others) = (who("S1").await, who("S2").await);
    let send = async |method: &str, address: String, body: Value| {
        let request = Request::builder().method(method).uri(address).header(header::CONTENT_TYPE, "application/json");
        bench.send(request.body(Body::from(body.to_string())).expect("a request")).await
    };
    let mut ids = Vec::new();
    for points in ["90", "70"] {
        clock.advance(MINUTE);
        ids.push(bench.hand_in(&format!("?{mine}"), points).await.id());
    }
    let id = &ids[0];
    let choice = format!("/api/v1/submissions/{id}/choice");
    let total = async || csv(&bench, "S1").await("total");
    assert_eq!(total().await, "70");
    let wrong = mine.replace("code=", "code=0");
    let elsewhere = mine.replace("course=", "course=0");
    for (query, status) in [("", 404), (others.as_str(), 404), (wrong.as_str(), 403), (elsewhere.as_str(), 401)] {
        let refused = send("POST", format!("{choice}?{query}"), Value::Null).await;
        assert_eq!(refused.status.as_u16(), status, "{query}: {}", refused.text());
    }
    assert_eq!(send("POST", format!("{choice}?{mine}"), Value::Null).await.status, StatusCode::NO_CONTENT);
    assert_eq!(total().await, "90");

    let address = format!("/api/v1/submissions/{id}/appeal");
    let question = json!({ "line": "specular", "question": "Why?" });
    assert_eq!(send("POST", format!("{address}?{others}"), question.clone()).await.status, StatusCode::NOT_FOUND);
    assert_eq!(send("GET", format!("{address}?{mine}"), Value::Null).await.status, StatusCode::NOT_FOUND);
    // Nothing is asked, or too much, of which nothing is cut off.
    for (long, said) in [(String::new(), "There is no question"), ("x".repeat(2001), "2001 characters")] {
        let wrong = json!({ "line": "specular", "question": long });
        let refused = send("POST", format!("{address}?{mine}&lang=en"), wrong).await;
        assert_eq!(refused.status, StatusCode::UNPROCESSABLE_ENTITY);
        assert!(refused.text().contains(said), "{}", refused.text());
    }
    let title = api(&bench, "PATCH", "/api/v1/course", json!({ "title": "x".repeat(101) })).await;
    assert!(title.status == 422 && title.text().contains("101 characters"), "{}", title.text());
    let asked = send("POST", format!("{address}?{mine}"), question.clone()).await;
    assert_eq!((asked.status, &asked.json()["question"]), (StatusCode::CREATED, &json!("Why?")), "{}", asked.text());
    assert_eq!(send("POST", format!("{address}?{mine}"), question).await.status, StatusCode::CONFLICT);
    // Somebody takes it, gives it back, takes it and answers; the student reads how far it is.
    let read = async || send("GET", format!("{address}?{mine}"), Value::Null).await.json();
    let appeal = asked.id();
    let handler = format!("/api/v1/appeals/{appeal}/handler");
    assert_eq!(send("PUT", handler.clone(), Value::Null).await.status, StatusCode::UNAUTHORIZED);
    for (method, is_taken) in [("PUT", true), ("DELETE", false), ("PUT", true)] {
        assert_eq!(api(&bench, method, &handler, Value::Null).await.status, StatusCode::NO_CONTENT);
        assert_eq!(read().await["taken_at"].is_string(), is_taken);
    }
    let answer = format!("/api/v1/appeals/{appeal}/answer");
    assert_eq!(api(&bench, "PUT", &answer, json!({ "answer": "So." })).await.status, StatusCode::NO_CONTENT);
    assert_eq!(read().await["answer"], "So.");
    assert_eq!(send("GET", format!("{address}?{others}"), Value::Null).await.status, StatusCode::NOT_FOUND);
    let log = get(&bench, "/teacher/log").await.all(".people tbody tr");
    assert_eq!(log.iter().filter(|row| row.contains("Handled a request")).count(), 4, "{log:?}");
    bench.finish().await;
}
