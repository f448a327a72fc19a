//! A program sets a term up and runs it, by the API alone.

mod plan;
mod words;

use crate::bench::{Bench, Reply, TEACHER, config};
use crate::cluster::Database;
use crate::{on_both, right, sample};
use axum::body::Body;
use axum::http::{Method, Request, StatusCode, header};
use ggrade::service::Config;
use ggrade::service::clock::Clock;
use serde_json::{Value, json};
use std::time::Duration;

on_both!(
    a_program_sets_a_course_up_and_runs_it,
    a_program_lets_nobody_in_who_may_do_more_than_it_says,
    what_makes_no_sense_changes_nothing,
);

const WRONG: &str = "wrong/specular-half-unnormalized--average.vert";

async fn bench(database: Database) -> Bench {
    let config = Config { public_url: Some("http://ggrade.example".into()), ..config() };
    Bench::with(database, config, crate::pool(), Clock::system()).await
}

/// What a program gets that sends something as JSON.
async fn api(bench: &Bench, token: &str, method: Method, address: &str, body: &Value) -> Reply {
    let request = Request::builder().method(method).uri(address).header(header::CONTENT_TYPE, "application/json");
    let request = request.header(header::AUTHORIZATION, format!("Bearer {token}"));
    bench.send(request.body(Body::from(body.to_string())).expect("a request")).await
}

async fn done(bench: &Bench, method: Method, address: &str, body: Value) -> Value {
    let reply = api(bench, TEACHER, method, address, &body).await;
    assert!(reply.status.is_success(), "{address}: {} {}", reply.status, String::from_utf8_lossy(&reply.body));
    if reply.body.is_empty() { Value::Null } else { reply.json() }
}

async fn read(bench: &Bench, address: &str) -> Value {
    done(bench, Method::GET, address, Value::Null).await
}

/// Hands in for a student of the course.
async fn hand_in(bench: &Bench, student: &str, bytes: Vec<u8>) -> Value {
    let address = format!("/c/cg/api/v1/submissions?assignment=ggsample06&student={student}");
    let request = Request::post(address).header(header::CONTENT_TYPE, "text/plain");
    let request = request.header(header::AUTHORIZATION, format!("Bearer {TEACHER}"));
    bench.send(request.body(Body::from(bytes)).expect("a request")).await.json()
}

async fn a_program_sets_a_course_up_and_runs_it(database: Database) {
    let bench = bench(database).await;
    let made = done(&bench, Method::POST, "/api/v1/courses", json!({ "id": "cg", "title": "Graphics" })).await;
    assert_eq!((&made["root"], &made["assignments"]), (&json!("/c/cg"), &json!([])));
    let plan = done(&bench, Method::PUT, "/c/cg/api/v1/plan", json!({ "assignments": ["phong", "ggsample06"] })).await;
    assert_eq!(plan["assignments"], json!(["phong", "ggsample06"]));
    let plan = done(&bench, Method::PUT, "/c/cg/api/v1/plan", json!({ "assignments": ["ggsample06"] })).await;
    assert!(plan["offered"].as_array().expect("ids").contains(&json!("phong")), "{plan}");
    let course = json!({ "language": "en", "zone": "Europe/Berlin", "pseudonyms": true });
    let course = done(&bench, Method::PATCH, "/c/cg/api/v1/course", course).await;
    assert_eq!((&course["title"], &course["zone"]), (&json!("Graphics"), &json!("Europe/Berlin")));
    let settings = "/c/cg/api/v1/assignments/ggsample06/settings";
    let due = json!({ "due_at": "2030-06-01T00:00:00Z", "attempts": 3, "points": 40, "late_percent": 10 });
    let set = done(&bench, Method::PATCH, settings, due).await;
    assert_eq!((&set["due_at"], &set["counting"]), (&json!("2030-06-01T00:00:00Z"), &json!("best")));
    let set = done(&bench, Method::PATCH, settings, json!({ "attempts": null })).await;
    assert_eq!((&set["attempts"], &set["points"]), (&Value::Null, &json!(40.0)));

    let roster = Request::put("/c/cg/api/v1/roster").header(header::AUTHORIZATION, format!("Bearer {TEACHER}"));
    let roster =
        roster.header(header::CONTENT_TYPE, "text/csv").body(Body::from("number,name,group\nS1,Wada,A\nS2,Ito,\n"));
    let roster = bench.send(roster.expect("a request")).await;
    assert_eq!(
        roster.json()["students"][0],
        json!({ "number": "S1", "name": "Wada", "group": "A", "email": "", "moodle": null })
    );
    let codes = read(&bench, "/c/cg/api/v1/codes").await;
    let code = codes["codes"][0]["code"].as_str().expect("a code").to_owned();
    assert!(codes["codes"][0]["link"].as_str().expect("a link").starts_with("http://ggrade.example/c/cg/join/"));
    let renewed = done(&bench, Method::POST, "/c/cg/api/v1/codes/S1", Value::Null).await;
    assert_ne!(renewed["code"], json!(code));
    let link = read(&bench, "/c/cg/api/v1/course").await["link"].clone();
    assert_ne!(done(&bench, Method::POST, "/c/cg/api/v1/course/link", Value::Null).await["link"], link);

    // A term: two students, an override, everything graded again, the gradebook.
    assert_eq!(hand_in(&bench, "S1", right()).await["report"]["score"], 100);
    let wrong = hand_in(&bench, "S2", sample(WRONG)).await;
    let line = format!("/c/cg/api/v1/submissions/{}/rubric/specular", wrong["id"].as_str().expect("an id"));
    done(&bench, Method::PUT, &line, json!({ "points": 30, "reason": "nearly" })).await;
    let begun = done(&bench, Method::POST, "/c/cg/api/v1/regradings?new_seed=true", Value::Null).await;
    let regrading = format!("/c/cg/api/v1/regradings/{}", begun["id"].as_str().expect("an id"));
    let again = loop {
        let again = read(&bench, &regrading).await;
        if again["progress"]["graded"] == again["progress"]["files"] {
            break again;
        }
        tokio::time::sleep(Duration::from_millis(50)).await;
    };
    assert_eq!((&again["changes"], &again["overridden"]), (&json!([]), &json!([])));
    let adopted = done(&bench, Method::POST, &format!("{regrading}/adoption"), Value::Null).await;
    assert!(adopted["adopted_at"].is_string(), "{adopted}");
    let book = read(&bench, "/c/cg/api/v1/gradebook").await;
    assert_eq!(book["assignments"][0]["points"], json!(40.0));
    let totals: Vec<_> = book["students"].as_array().expect("students").iter().map(|one| &one["total"]).collect();
    assert_eq!(totals, [&json!(40.0), &json!(36.0)], "{book}");

    // The next term, and the end of this one.
    let copy = json!({ "id": "cg-2", "title": "Graphics II", "copy_of": "cg", "days": 364 });
    done(&bench, Method::POST, "/api/v1/courses", copy).await;
    let copied = read(&bench, "/c/cg-2/api/v1/assignments/ggsample06/settings").await;
    assert_eq!((&copied["due_at"], &copied["points"]), (&json!("2031-05-31T00:00:00Z"), &json!(40.0)));
    // Half a year later it is winter in Berlin: two in the morning is one hour later in UTC.
    let copy = json!({ "id": "cg-w", "title": "Graphics", "copy_of": "cg", "days": 182 });
    done(&bench, Method::POST, "/api/v1/courses", copy).await;
    let copied = read(&bench, "/c/cg-w/api/v1/assignments/ggsample06/settings").await;
    assert_eq!(copied["due_at"], "2030-11-30T01:00:00Z");
    done(&bench, Method::PATCH, "/c/cg/api/v1/course", json!({ "is_archived": true })).await;
    let refused = api(&bench, TEACHER, Method::PATCH, "/c/cg/api/v1/course", &json!({ "title": "X" })).await;
    assert_eq!(refused.problem(), "archived");
    let refused = api(&bench, TEACHER, Method::PATCH, settings, &json!({ "attempts": 1 })).await;
    assert_eq!(refused.problem(), "archived");
    done(&bench, Method::PATCH, "/c/cg/api/v1/course", json!({ "is_archived": false })).await;
    let courses = read(&bench, "/api/v1/courses").await;
    let roots: Vec<_> = courses["courses"].as_array().expect("courses").iter().map(|one| &one["root"]).collect();
    assert_eq!(roots, [&json!(""), &json!("/c/cg"), &json!("/c/cg-2"), &json!("/c/cg-w")]);

    // Each of these stands in the log of its course.
    let log = read(&bench, "/c/cg/api/v1/log").await;
    let acts: Vec<&str> = log["acts"].as_array().expect("acts").iter().filter_map(|one| one["act"].as_str()).collect();
    for act in ["plan", "course", "settings", "roster", "code", "link", "override", "regrading", "adopted", "handed-in"]
    {
        assert!(acts.contains(&act), "{act} is not in {acts:?}");
    }
    bench.finish().await;
}

async fn a_program_lets_nobody_in_who_may_do_more_than_it_says(database: Database) {
    let bench = crate::staff::bench(database, Clock::system()).await;
    let mut admin = crate::staff::administrator(&bench).await;
    let mut token = async |scope: &str| {
        let page = admin.form("/teacher/tokens", "/teacher/tokens", &format!("name=t&scope={scope}&days=1")).await;
        page.all(".notice .link code")[0].clone()
    };
    let (all, only_reads) = (token("all").await, token("read").await);
    let ta = json!({ "login": "ta", "name": "TA", "role": "assistant" });
    let refused = api(&bench, &only_reads, Method::POST, "/api/v1/staff", &ta).await;
    assert_eq!(refused.problem(), "scope");
    let made = api(&bench, &all, Method::POST, "/api/v1/staff", &ta).await;
    assert_eq!((made.status, made.json()["has_password"].clone()), (StatusCode::CREATED, json!(false)));
    let id = made.id();
    assert!(made.json()["link"].as_str().expect("a link").contains("/teacher/welcome/"));
    let again = api(&bench, &all, Method::POST, &format!("/api/v1/staff/{id}/invitation"), &Value::Null).await;
    assert_ne!(again.json()["link"], made.json()["link"]);
    let lecturer =
        api(&bench, &all, Method::PATCH, &format!("/api/v1/staff/{id}"), &json!({ "role": "lecturer" })).await;
    assert_eq!(lecturer.json()["role"], "lecturer");
    // A token that leaks leaves no administrator behind, and opens no account that somebody uses.
    let boss = json!({ "login": "boss", "role": "administrator" });
    assert_eq!(api(&bench, &all, Method::POST, "/api/v1/staff", &boss).await.problem(), "role");
    let up = json!({ "role": "administrator" });
    assert_eq!(api(&bench, &all, Method::PATCH, &format!("/api/v1/staff/{id}"), &up).await.problem(), "role");
    let staff = api(&bench, &all, Method::GET, "/api/v1/staff", &Value::Null).await.json();
    let own = staff["staff"].as_array().expect("staff").iter().find(|one| one["role"] == "administrator");
    let own = own.expect("an administrator")["id"].as_str().expect("an id").to_owned();
    let link = api(&bench, &all, Method::POST, &format!("/api/v1/staff/{own}/invitation"), &Value::Null).await;
    assert_eq!(link.problem(), "role");
    bench.finish().await;
}

async fn what_makes_no_sense_changes_nothing(database: Database) {
    let bench = bench(database).await;
    let settings = "/api/v1/assignments/ggsample06/settings";
    let before = read(&bench, settings).await;
    for wrong in [
        json!({ "due_at": "2030-01-01T00:00:00Z", "opens_at": "2031-01-01T00:00:00Z" }),
        json!({ "due_at": "-000001-01-01T00:00:00Z" }),
        json!({ "due_at": "0001-01-01T00:00:00Z" }),
        json!({ "shown_from": "3000-01-01T00:00:00Z" }),
        json!({ "attempts": 0 }),
        json!({ "attempts": 99_999_999_999_u64 }),
        json!({ "attempts": -1 }),
        json!({ "late_percent": 101 }),
        json!({ "late_until": "2030-01-01T00:00:00Z" }),
        json!({ "grace_minutes": 20000 }),
        json!({ "points": -1 }),
        json!({ "due": "2030-01-01T00:00:00Z" }),
        json!(["due_at"]),
    ] {
        let reply = api(&bench, TEACHER, Method::PATCH, settings, &wrong).await;
        assert_eq!(reply.status, StatusCode::UNPROCESSABLE_ENTITY, "{wrong}");
        assert_eq!(read(&bench, settings).await, before, "{wrong}");
    }
    for wrong in [
        json!({ "assignments": [] }),
        json!({ "assignments": ["ggsample06", "ggsample06"] }),
        json!({ "assignments": ["ggsample06", "phong"] }),
    ] {
        let reply = api(&bench, TEACHER, Method::PUT, "/api/v1/plan", &wrong).await;
        assert_eq!(reply.status, StatusCode::UNPROCESSABLE_ENTITY, "{wrong}");
    }
    for (method, address) in [
        (Method::GET, "/api/v1/courses"),
        (Method::GET, "/api/v1/course"),
        (Method::GET, settings),
        (Method::GET, "/api/v1/staff"),
        (Method::GET, "/api/v1/platforms"),
        (Method::GET, "/api/v1/roster"),
        (Method::GET, "/api/v1/codes"),
        (Method::GET, "/api/v1/gradebook"),
        (Method::GET, "/api/v1/log"),
        (Method::POST, "/api/v1/course/link"),
        (Method::POST, "/api/v1/regradings"),
    ] {
        let reply = api(&bench, "guessed", method, address, &Value::Null).await;
        assert_eq!(reply.status, StatusCode::UNAUTHORIZED, "{address}");
    }
    bench.finish().await;
}
