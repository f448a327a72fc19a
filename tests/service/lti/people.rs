//! Who somebody of a platform is here, as the platform and the course change.

use super::launch::{answer, begin, bench, cookie, hand_in, launch, registered};
use crate::cluster::Database;
use crate::roster::file;
use crate::{on_both, right};
use axum::http::StatusCode;
use ggrade::service::clock::Clock;
use serde_json::{Value, json};

on_both!(only_who_learns_is_a_student, whoever_the_platform_has_stands_on_a_roster_that_came_later,);

async fn only_who_learns_is_a_student(database: Database) {
    let (bench, platform) = bench(database, Clock::system()).await;
    registered(&bench, &platform).await;
    let launch_as = async |subject: &str, roles: Value| {
        let begun = begin(&bench, &platform, false).await;
        let mut claims = platform.claims(&begun.query["nonce"], subject, "Learner");
        claims["https://purl.imsglobal.org/spec/lti/claim/roles"] = roles;
        answer(&bench, &begun, &platform.sign(&claims)).await
    };
    let role = |name: &str| format!("http://purl.imsglobal.org/vocab/lis/v2/{name}");
    // A parent who observes, and who is something elsewhere than in the course.
    for (subject, roles) in [
        ("s1", json!([role("membership#Mentor")])),
        ("s2", json!([role("membership#ContentDeveloper")])),
        ("s3", json!([role("institution/person#Administrator"), role("system/person#Administrator")])),
        ("s4", json!([])),
    ] {
        let refused = launch_as(subject, roles).await;
        assert_eq!(refused.status, StatusCode::FORBIDDEN, "{subject}");
        assert!(refused.text().contains("neither a student nor one of those who teach"), "{}", refused.text());
    }
    assert!(bench.state.store.students().await.expect("students").is_empty());
    for (subject, roles) in [
        ("s5", json!([role("membership/Learner#Instructor")])),
        ("s6", json!([role("membership#Learner"), role("institution/person#Instructor")])),
        ("s7", json!([role("membership#Mentor"), role("membership#Learner")])),
    ] {
        let opened = launch_as(subject, roles).await;
        assert_eq!(opened.header("location"), "/a/ggsample06", "{subject}: {}", opened.text());
    }
    bench.finish().await;
}

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
