//! What a homework shows of its class, as a page and as CSV.

use crate::bench::{Bench, config};
use crate::cluster::Database;
use crate::judgement::Lenient;
use crate::on_both;
use crate::roster::{get, request};
use axum::http::StatusCode;
use ggrade::service::clock::Clock;
use ggrade::service::store::RosterLine;
use std::sync::Arc;
use std::time::Duration;

on_both!(attempts_mistakes_and_messages_are_counted);

async fn attempts_mistakes_and_messages_are_counted(database: Database) {
    let clock = Clock::fixed(1_700_000_000_000);
    let bench = Bench::with(database, config(), Arc::new(Lenient::default()), clock.clone()).await;
    let line = |number: &str| RosterLine { number: number.into(), ..RosterLine::default() };
    let numbers = ["S1", "S2", "S3", "S4"];
    bench.state.store.set_roster(&numbers.map(line), 0).await.expect("a roster");
    let empty = get(&bench, "/teacher/insights?lang=en").await;
    assert!(empty.all("main").concat().contains("Nothing has been graded yet"));
    // S1 is right at the third attempt, S2 at the first, S3 tries twice, S4 hands in nothing.
    for (number, points) in [("S1", 10), ("S1", 60), ("S2", 100), ("S3", 20), ("S1", 100), ("S3", 20)] {
        clock.advance(Duration::from_secs(600));
        let text = format!("{points}\nvoid main() {{}}\n// {}", ggrade::service::identity::new_id());
        let reply =
            bench.send(request("POST", &format!("/api/v1/submissions?student={number}"), "text/plain", text)).await;
        assert_eq!(reply.status, StatusCode::CREATED, "{reply:?}");
    }
    let table = async |name: &str| {
        let reply = get(&bench, &format!("/api/v1/insights/{name}?lang=en")).await;
        assert_eq!(reply.header("content-type"), "text/csv; charset=utf-8");
        assert!(reply.header("content-disposition").contains(&format!("ggsample06-{name}.csv")));
        String::from_utf8(reply.body).expect("UTF-8")
    };
    let attempts = table("attempts").await;
    assert_eq!(
        attempts,
        "\u{feff}outcome,attempts,students\r\nright,1,1\r\nright,3,1\r\nnot right,2,1\r\nnothing,0,1\r\n"
    );
    assert!(table("mistakes").await.starts_with("\u{feff}from,to,hand_ins,right,mistake,title,count\r\n"));
    assert!(table("messages").await.starts_with("\u{feff}mistake,message,said,students,next_right,"));
    let page = get(&bench, "/teacher/insights?lang=en").await;
    assert_eq!(
        page.all("section[aria-labelledby=attempts] td"),
        ["1", "0", "1", "0", "0", "0", "0", "0", "0", "0", "1"]
    );
    let body = String::from_utf8(page.body.clone()).expect("UTF-8");
    assert!(!body.contains("S1"), "nobody is named");
    assert_eq!(get(&bench, "/api/v1/insights/names").await.problem(), "not-found");
    assert_eq!(bench.get("/api/v1/insights/attempts").await.status, StatusCode::UNAUTHORIZED);
}
