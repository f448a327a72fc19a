//! Which of somebody's hand-ins counts: the last one, or the one that they choose.

use crate::cluster::Database;
use crate::codes::Guest;
use crate::late::{DAY, MINUTE, RULES, bench, csv, rules};
use crate::on_both;
use crate::roster::{form, get, request};
use axum::body::Body;
use axum::http::{StatusCode, header};
use ggrade::service::identity::personal_code;

on_both!(the_last_or_the_chosen_one_counts);

async fn the_last_or_the_chosen_one_counts(database: Database) {
    let (bench, clock) = bench(database).await;
    rules(&bench, &format!("{RULES}&counting=last")).await;
    let student = bench.state.store.student_by_number("S1").await.expect("a store").expect("a student");
    let (mine, other) = (Guest::new(&bench).await, Guest::new(&bench).await);
    mine.join(&bench, "S1", &personal_code(&bench.state, &student)).await;
    let mut ids = Vec::new();
    for points in ["90", "70", "80"] {
        clock.advance(MINUTE);
        ids.push(mine.hand_in(&bench, points).await.id());
    }
    let total = async || csv(&bench, "S1").await("total");
    assert_eq!(total().await, "80");
    let desk = mine.get(&bench, "/").await;
    assert!(desk.all(".terms-of-hand-in li").contains(&"Counts so far 80 / 100".to_owned()), "{desk:?}");
    assert!(desk.all(".attempts .best")[0].starts_with("80 / 100counts") && desk.all(".attempts form").is_empty());
    let choose = async |guest: &Guest, id: &str| {
        let request = guest.request("POST", "/a/ggsample06/choose").header(header::ACCEPT, "text/html");
        let request = request.header(header::CONTENT_TYPE, "application/x-www-form-urlencoded");
        let body = format!("csrf={}&submission={id}", guest.csrf(&bench).await);
        bench.send(request.body(Body::from(body)).expect("a request")).await.status
    };
    assert_eq!(choose(&mine, &ids[0]).await, StatusCode::CONFLICT, "nobody chooses here");

    rules(&bench, &format!("{RULES}&counting=chosen")).await;
    assert_eq!(total().await, "80", "until somebody chooses");
    let desk = mine.get(&bench, "/").await;
    assert_eq!(desk.all(".attempts form"), ["Let this one count", "Let this one count"]);
    assert_eq!(choose(&mine, &ids[0]).await, StatusCode::SEE_OTHER);
    assert_eq!(total().await, "90");
    assert_eq!(choose(&other, &ids[1]).await, StatusCode::NOT_FOUND, "of somebody else");
    assert_eq!(total().await, "90");
    clock.advance(MINUTE);
    mine.hand_in(&bench, "60").await;
    assert_eq!(total().await, "90", "the choice stays");
    // When handing in is over, a lecturer may choose still.
    clock.advance(DAY * 20);
    assert_eq!(choose(&mine, &ids[1]).await, StatusCode::FORBIDDEN);
    let chosen = form(&bench, "/teacher/choice", &format!("submission={}", ids[1])).await;
    let person = get(&bench, chosen.header("location")).await;
    assert!(person.all(".attempts .best")[0].starts_with("70 / 100counts"), "{person:?}");
    assert_eq!(total().await, "70");
    clock.advance(MINUTE);
    let by_api = request("POST", &format!("/api/v1/submissions/{}/choice", ids[2]), "", Body::empty());
    assert_eq!(bench.send(by_api).await.status, StatusCode::NO_CONTENT);
    assert_eq!(total().await, "80");
    let log = get(&bench, "/teacher/log").await.all(".people tbody tr");
    assert_eq!(log.iter().filter(|row| row.contains("Chose which hand-in counts") && row.contains("S1")).count(), 2);
    bench.finish().await;
}
