//! The classes of several homeworks: each homework has one, and who teaches one sees no other.

use super::{OF_WAVES, bench, page, request, waves_and_new};
use crate::bench::{Bench, Reply, TEACHER};
use crate::cluster::Database;
use crate::roster::zip;
use crate::{on_both, right_and_new};
use axum::body::Body;
use axum::http::{Request, StatusCode, header};

on_both!(a_class_is_of_one_homework, the_teacher_of_one_homework_sees_no_other_class,);

/// Pages of the teacher's that belong to the course, below `/teacher`.
const OF_COURSE: [&str; 9] = ["codes", "courses", "data", "folders", "gradebook", "people", "plan", "platforms", "log"];

async fn get(bench: &Bench, token: &str, address: &str) -> Reply {
    bench.send(request("GET", address, token, "", Body::empty())).await
}

/// An archive of two students.
fn archive(first: &[u8], second: &[u8]) -> Vec<u8> {
    let member = |name: &str, bytes: &[u8]| (format!("{name}/mine.vert"), bytes.to_vec());
    zip(&[member("alice", first), member("bob", second)])
}

async fn uploaded(bench: &Bench, token: &str, query: &str, bytes: Vec<u8>) -> Reply {
    bench.send(request("POST", &format!("/api/v1/batches{query}"), token, "application/zip", bytes)).await
}

async fn graded(bench: &Bench, id: &str) {
    for _ in 0..1200 {
        if bench.state.store.progress(id).await.expect("progress").is_done() {
            return;
        }
        tokio::time::sleep(std::time::Duration::from_millis(50)).await;
    }
    panic!("the archive was not graded");
}

async fn a_class_is_of_one_homework(database: Database) {
    let bench = bench(database).await;
    let classes = get(&bench, TEACHER, "/teacher").await;
    assert_eq!(classes.all(".homeworks h2").len(), 2, "{}", classes.text());
    let of_waves = uploaded(&bench, TEACHER, "?assignment=waves", archive(&waves_and_new(), &right_and_new())).await;
    assert_eq!(of_waves.status, StatusCode::ACCEPTED, "{of_waves:?}");
    let id = of_waves.id();
    graded(&bench, &id).await;
    let unsaid = uploaded(&bench, TEACHER, "", archive(&right_and_new(), &right_and_new())).await;
    assert_eq!(unsaid.status, StatusCode::UNPROCESSABLE_ENTITY);

    let csv = get(&bench, TEACHER, "/api/v1/class/files/csv?assignment=waves").await.text();
    assert!(csv.contains("alice") && csv.contains("bob"), "{csv}");
    let verdicts: Vec<bool> = csv.lines().skip(1).map(|line| line.contains("correct")).collect();
    assert_eq!(verdicts, [true, false], "{csv}");
    let csv = get(&bench, TEACHER, "/api/v1/class/files/csv?assignment=ggsample06").await.text();
    assert!(!csv.contains("alice"), "{csv}");

    for (base, is_its_own) in [("/a/waves", true), ("/a/ggsample06", false)] {
        let class = get(&bench, TEACHER, &format!("{base}/teacher")).await;
        assert_eq!(class.status, StatusCode::OK);
        assert_eq!(class.text().contains("alice"), is_its_own);
        // What belongs to the course is the same for all homeworks; everything else stays in its own.
        let text = class.text();
        let leaves = text.split("href=\"/teacher/").skip(1).filter_map(|rest| rest.split('"').next());
        let leaves: Vec<&str> = leaves.filter(|page| !OF_COURSE.contains(page)).collect();
        assert!(leaves.is_empty(), "links leave the homework: {leaves:?}");
        let list = get(&bench, TEACHER, &format!("{base}/teacher/batches")).await;
        assert_eq!(list.text().contains(&id), is_its_own);
        let one = get(&bench, TEACHER, &format!("{base}/teacher/batches/{id}")).await;
        assert_eq!(one.status, if is_its_own { StatusCode::OK } else { StatusCode::NOT_FOUND });
        let settings = get(&bench, TEACHER, &format!("{base}/teacher/settings")).await;
        assert_eq!(settings.status, StatusCode::OK);
    }
    // Each has its own rules.
    let form = "application/x-www-form-urlencoded";
    let rules = "attempts=3&hints=full&audience=open&practice=on";
    let saved = bench.send(request("POST", "/a/waves/teacher/settings", TEACHER, form, rules)).await;
    assert_eq!(saved.header("location"), "/a/waves/teacher/settings?done=saved");
    let attempts = async |id: &str| bench.state.store.assignment(id).await.expect("settings").attempts;
    assert_eq!((attempts("waves").await, attempts("ggsample06").await), (Some(3), None));
    // Grading again is of one class as well.
    let again = bench.send(request("POST", "/a/waves/teacher/regradings", TEACHER, form, "")).await;
    let address = again.header("location").to_owned();
    assert!(address.starts_with("/a/waves/teacher/regradings/"), "{again:?}");
    assert_eq!(get(&bench, TEACHER, &address).await.status, StatusCode::OK);
    let elsewhere = address.replace("waves", "ggsample06");
    assert_eq!(get(&bench, TEACHER, &elsewhere).await.status, StatusCode::NOT_FOUND);
    bench.finish().await;
}

async fn the_teacher_of_one_homework_sees_no_other_class(database: Database) {
    let bench = bench(database).await;
    let batch = uploaded(&bench, TEACHER, "?assignment=ggsample06", archive(&right_and_new(), &right_and_new())).await;
    let id = batch.id();
    graded(&bench, &id).await;
    let wave = bench.hand_in("?assignment=waves", waves_and_new()).await.id();
    let lambert = bench.hand_in("?assignment=ggsample06", right_and_new()).await.id();

    // Their only class is where they are led.
    let led = get(&bench, OF_WAVES, "/teacher").await;
    assert_eq!((led.status, led.header("location")), (StatusCode::SEE_OTHER, "/a/waves/teacher"));
    for address in ["/a/waves/teacher", "/a/waves/teacher/settings", "/api/v1/class/files/csv?assignment=waves"] {
        let own = get(&bench, OF_WAVES, address).await;
        assert_eq!(own.status, StatusCode::OK, "{address}");
        assert!(!own.text().contains("alice"), "{address}");
    }
    for address in [
        "/a/ggsample06/teacher",
        "/a/ggsample06/teacher/settings",
        "/a/ggsample06/teacher/batches",
        "/a/ggsample06/teacher/events",
        "/api/v1/class/files/csv?assignment=ggsample06",
        &format!("/api/v1/batches/{id}"),
        &format!("/api/v1/batches/{id}/events"),
        &format!("/api/v1/batches/{id}/files/csv"),
    ] {
        let foreign = get(&bench, OF_WAVES, address).await;
        assert_eq!(foreign.status, StatusCode::FORBIDDEN, "{address}");
        assert!(!foreign.text().contains("alice"), "{address}");
    }
    // Nor do they change it, nor what belongs to the whole course.
    let form = "application/x-www-form-urlencoded";
    for (method, address, kind) in [
        ("POST", "/a/ggsample06/teacher/settings", form),
        ("POST", "/a/ggsample06/teacher/regradings", form),
        ("POST", "/a/waves/teacher/course", form),
        ("POST", "/a/waves/teacher/settings/link", form),
        ("POST", "/api/v1/batches?assignment=ggsample06", "application/zip"),
        ("POST", "/api/v1/submissions?assignment=ggsample06&student=S1", "text/plain"),
        ("DELETE", &format!("/api/v1/batches/{id}"), ""),
        ("DELETE", &format!("/api/v1/submissions/{lambert}"), ""),
    ] {
        let body = if kind == form { "zone=UTC&language=en" } else { "" };
        let foreign = bench.send(request(method, address, OF_WAVES, kind, body)).await;
        assert_eq!(foreign.status, StatusCode::FORBIDDEN, "{method} {address}: {foreign:?}");
    }
    let student = bench.state.store.student("S1", 0).await.expect("a store").expect("a student");
    let refused = bench.send(request("DELETE", "/api/v1/students/S1", OF_WAVES, "", "")).await;
    assert_eq!(refused.status, StatusCode::FORBIDDEN, "{refused:?}");
    assert!(bench.state.store.student_by_id(&student.id).await.expect("a store").is_some());
    let delete = |address: String| request("POST", &address, OF_WAVES, form, format!("submission={lambert}"));
    let lost = bench.send(delete("/a/waves/teacher/delete".into())).await;
    assert_eq!(lost.status, StatusCode::NOT_FOUND, "found by the pages of another homework: {lost:?}");
    assert!(bench.state.store.submission(&lambert).await.expect("a store").is_some());
    let shown = get(&bench, OF_WAVES, "/a/waves/teacher/settings").await;
    assert!(!shown.text().contains("/join/") && !shown.text().contains("/teacher/roster"), "{}", shown.text());
    let gone = bench.send(request("DELETE", &format!("/api/v1/submissions/{wave}"), OF_WAVES, "", "")).await;
    assert_eq!(gone.status, StatusCode::OK, "{gone:?}");

    // The same by a session.
    let (_, cookie, csrf) = page(&bench, "/teacher/login").await;
    let login = Request::post("/teacher/login").header(header::COOKIE, &cookie).header(header::CONTENT_TYPE, form);
    let login = login.body(Body::from(format!("csrf={csrf}&password={OF_WAVES}"))).expect("a request");
    let login = bench.send(login).await;
    assert_eq!((login.status, login.header("location")), (StatusCode::SEE_OTHER, "/teacher"));
    let session = login.header("set-cookie").split(';').next().expect("a cookie").to_owned();
    for (address, status) in [("/a/waves/teacher", StatusCode::OK), ("/a/ggsample06/teacher", StatusCode::FORBIDDEN)] {
        let request = Request::get(address).header(header::COOKIE, &session).body(Body::empty()).expect("a request");
        assert_eq!(bench.send(request).await.status, status, "{address}");
    }
    bench.finish().await;
}
