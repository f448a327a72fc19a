//! Answers that are alike: over HTTP, as a teacher's page and in the API.

use crate::bench::{Bench, config};
use crate::cluster::Database;
use crate::judgement::Lenient;
use crate::on_both;
use crate::roster::{get, request};
use crate::sample;
use axum::http::StatusCode;
use ggrade::service::clock::Clock;
use ggrade::service::store::RosterLine;
use serde_json::json;
use std::sync::Arc;

on_both!(who_is_alike_is_told_with_what_they_share, an_earlier_term_is_held_against_the_class);

pub const ANSWER: &str = "accepted/answers/half-angle-squared-forty-times.vert";
const OTHER: &str = "accepted/answers/if-instead-of-max.vert";

fn line(number: &str) -> RosterLine {
    RosterLine { number: number.into(), name: format!("name of {number}"), ..RosterLine::default() }
}

async fn hand_in(bench: &Bench, number: &str, text: &str) -> String {
    let address = format!("/api/v1/submissions?student={number}");
    let reply = bench.send(request("POST", &address, "text/plain", text.to_owned())).await;
    assert_eq!(reply.status, StatusCode::CREATED, "{reply:?}");
    reply.id()
}

pub fn text(name: &str) -> String {
    String::from_utf8(sample(name)).expect("UTF-8")
}

/// The same in other names and with other comments.
pub fn disguised() -> String {
    let names = ["lv", "nlv", "nh2"];
    let text = text(ANSWER).replace("//", "// well:");
    names.iter().fold(text, |text, name| {
        let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let mut out = String::new();
        let mut rest = text.as_str();
        while let Some(at) = rest.find(name) {
            let is_whole = !rest[..at].ends_with(is_word) && !rest[at + name.len()..].starts_with(is_word);
            out += &rest[..at];
            out += &if is_whole { format!("x_{name}") } else { (*name).to_owned() };
            rest = &rest[at + name.len()..];
        }
        out + rest
    })
}

async fn who_is_alike_is_told_with_what_they_share(database: Database) {
    let bench = Bench::with(database, config(), Arc::new(Lenient::default()), Clock::system()).await;
    bench.state.store.set_roster(&[line("S1"), line("S2"), line("S3")], 0).await.expect("a roster");
    assert!(get(&bench, "/teacher/likeness?lang=en").await.all("main").concat().contains("No two answers are alike"));
    let one = hand_in(&bench, "S1", &text(ANSWER)).await;
    let other = hand_in(&bench, "S2", &disguised()).await;
    let third = hand_in(&bench, "S3", &text(OTHER)).await;

    let found = get(&bench, "/api/v1/likeness").await.json();
    assert_eq!((&found["class"], &found["others"], &found["left_out"]), (&json!(3), &json!(0), &json!(0)));
    let pairs = found["pairs"].as_array().expect("pairs");
    assert_eq!(pairs.len(), 1, "{found}");
    let students: Vec<_> =
        pairs[0]["members"].as_array().unwrap().iter().map(|it| it["student"].as_str().unwrap()).collect();
    assert_eq!(students, ["S1", "S2"]);
    assert!(pairs[0]["percent"].as_u64().unwrap() >= 90, "{found}");
    assert_eq!(pairs[0]["is_same_text"], false);

    let sides = get(&bench, pairs[0]["comparison"].as_str().unwrap()).await.json();
    let shared = |side: usize| -> String {
        let lines = sides["sides"][side][0]["lines"].as_array().unwrap();
        let pieces = lines.iter().flat_map(|line| line.as_array().unwrap());
        pieces.filter(|piece| piece["is_shared"] == true).map(|piece| piece["text"].as_str().unwrap()).collect()
    };
    assert!(shared(0).len() > 100 && !shared(0).contains("uniform"), "{}", shared(0));
    assert!(!shared(1).contains("well:"), "comments are left aside: {}", shared(1));

    let page = get(&bench, "/teacher/likeness?lang=en").await;
    assert_eq!(page.all(".people tbody th a"), ["S1 name of S1", "S2 name of S2"]);
    assert!(page.all("h1 + .lead")[0].contains("no verdict"), "{page:?}");
    let page = get(&bench, &format!("/teacher/likeness/pair?one={one}&other={other}&lang=en")).await;
    assert_eq!(page.all(".side-by-side h3"), ["S1 name of S1", "S2 name of S2"]);
    assert!(page.all(".side-by-side mark").len() > 4, "{page:?}");
    // Two that are not alike can be looked at as well; what is marked is little.
    let apart = get(&bench, &format!("/api/v1/submissions/{one}/likeness/{third}")).await.json();
    assert!(apart["percent"].as_u64().unwrap() < 40, "{apart}");

    // Teachers only, and of one homework.
    assert_eq!(bench.get("/api/v1/likeness").await.status, StatusCode::UNAUTHORIZED);
    assert_eq!(
        bench.get(&format!("/api/v1/submissions/{one}/likeness/{other}")).await.status,
        StatusCode::UNAUTHORIZED
    );
    assert_eq!(bench.get("/teacher/likeness").await.status, StatusCode::SEE_OTHER);
    let nobody = get(&bench, &format!("/teacher/likeness/pair?one={one}&other=nobody")).await;
    assert_eq!(nobody.status, StatusCode::NOT_FOUND);
}

async fn an_earlier_term_is_held_against_the_class(database: Database) {
    let bench = Bench::with(database, config(), Arc::new(Lenient::default()), Clock::system()).await;
    bench.state.store.set_roster(&[line("E1"), line("E2")], 0).await.expect("a roster");
    hand_in(&bench, "E1", &text(ANSWER)).await;
    hand_in(&bench, "E2", &text(ANSWER)).await;
    bench.state.store.set_roster(&[line("N1")], 1).await.expect("a roster");
    hand_in(&bench, "N1", &disguised()).await;
    let found = get(&bench, "/api/v1/likeness").await.json();
    assert_eq!((&found["class"], &found["others"]), (&json!(1), &json!(2)));
    let pairs = found["pairs"].as_array().expect("pairs");
    // What the two of the earlier term share is nobody's matter any more.
    assert_eq!(pairs.len(), 2, "{found}");
    for pair in pairs {
        assert_eq!((&pair["members"][0]["student"], &pair["members"][0]["is_of_class"]), (&json!("N1"), &json!(true)));
        assert_eq!(pair["members"][1]["is_of_class"], false);
    }
    assert!(get(&bench, "/teacher/likeness?lang=en").await.all("main").concat().contains("not of this class"));
}
