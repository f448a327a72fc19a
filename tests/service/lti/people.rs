//! Who somebody of a platform is here, as the platform and the course change.

use super::launch::{bench, cookie, hand_in, launch, registered};
use crate::cluster::Database;
use crate::roster::file;
use crate::{on_both, right};
use axum::http::StatusCode;
use ggrade::service::clock::Clock;

on_both!(whoever_the_platform_has_stands_on_a_roster_that_came_later,);

async fn whoever_the_platform_has_stands_on_a_roster_that_came_later(database: Database) {
    let (bench, platform) = bench(database, Clock::system()).await;
    registered(&bench, &platform).await;
    let before = cookie(&launch(&bench, &platform, "s1", "Learner").await, "ggrade");
    file(&bench, "/teacher/roster", "roster", "r.csv", b"number,name\nS9,Ito\n").await;
    let refused = hand_in(&bench, &before, right()).await;
    assert_eq!(refused.problem(), "not-on-roster");
    assert!(refused.text().contains("learning platform"), "nobody typed a number: {}", refused.text());
    // Whether they were there before or not, they are let in from the platform.
    for student in ["s1", "s2"] {
        let theirs = cookie(&launch(&bench, &platform, student, "Learner").await, "ggrade");
        assert_eq!(hand_in(&bench, &theirs, right()).await.status, StatusCode::CREATED, "{student}");
    }
    let roster = bench.state.store.roster().await.expect("a roster");
    let numbers: Vec<&str> = roster.iter().map(|student| student.number.as_str()).collect();
    assert_eq!(numbers, ["S1", "S2", "S9"]);
    bench.finish().await;
}
