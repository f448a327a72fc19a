//! The homeworks of a course are those that a program asked for, whatever happened to an earlier request.

use super::{api, bench, done};
use crate::bench::TEACHER;
use crate::cluster::Database;
use crate::on_both;
use axum::http::Method;
use ggrade::service::Service;
use serde_json::json;
use std::time::Duration;

on_both!(a_plan_is_what_was_asked_for_also_after_one_that_was_cut_off,);

const PLAN: &str = "/c/cg/api/v1/plan";

/// What the course chose by its tables, and what it serves, in its order.
async fn standing(course: &Service) -> (Vec<String>, Vec<String>) {
    let places = course.store.places().await.expect("places");
    let chosen = places.into_iter().filter(|place| place.is_chosen != 0).map(|place| place.id);
    (chosen.collect(), course.ids())
}

async fn a_plan_is_what_was_asked_for_also_after_one_that_was_cut_off(database: Database) {
    let bench = bench(database).await;
    done(&bench, Method::POST, "/api/v1/courses", json!({ "id": "cg", "title": "Graphics" })).await;
    let course = bench.state.course("cg").expect("a course");
    // Whenever a request is given up, all of it is done in the end, or nothing.
    let asked = ["spot-soft", "ggsample06", "threshold", "falloff-linear"];
    for milliseconds in [0, 5, 20, 100, 500] {
        let wish = json!({ "assignments": asked });
        let request = api(&bench, TEACHER, Method::PUT, PLAN, &wish);
        let _ = tokio::time::timeout(Duration::from_millis(milliseconds), request).await;
        let mut found = standing(&course).await;
        for _ in 0..200 {
            if found.0 == found.1 {
                break;
            }
            tokio::time::sleep(Duration::from_millis(50)).await;
            found = standing(&course).await;
        }
        assert_eq!(found.0, found.1, "cut off after {milliseconds} ms");
        assert!(found.0.is_empty() || found.0 == asked, "{found:?}");
    }
    done(&bench, Method::PUT, PLAN, json!({ "assignments": asked })).await;
    let log = done(&bench, Method::GET, "/c/cg/api/v1/log", json!(null)).await;
    assert!(log["acts"].as_array().expect("acts").iter().any(|act| act["act"] == "plan"), "{log}");

    // As a process leaves it that ended in the middle: `phong` is chosen and not served, `threshold` the other way round.
    course.store.assignment("phong").await.expect("a row");
    let mut places = course.store.places().await.expect("places");
    for place in &mut places {
        place.is_chosen = i64::from(place.id != "threshold");
    }
    course.store.set_places(&places).await.expect("set");
    let plan = done(&bench, Method::PUT, PLAN, json!({ "assignments": ["threshold", "ggsample06"] })).await;
    assert_eq!(plan["assignments"], json!(["threshold", "ggsample06"]));
    let (chosen, served) = standing(&course).await;
    assert_eq!((chosen, served), (vec!["threshold".to_owned(), "ggsample06".to_owned()], course.ids()));
    drop(course);
    bench.finish().await;
}
