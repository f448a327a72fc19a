//! The API as its description says.

use crate::bench::{Bench, Reply};
use crate::cluster::Database;
use crate::{on_both, right, right_and_new, sample};
use axum::body::Body;
use axum::http::{Request, StatusCode, header};
use reference::{Assignment, Folder};
use serde_json::json;
use std::sync::Arc;

on_both!(
    a_file_comes_back_as_its_report,
    the_same_file_is_answered_from_the_store_in_its_own_name,
    a_changed_folder_is_another_assignment,
    a_form_is_taken_as_well,
    pictures_can_be_seen_later,
    every_error_is_a_problem_in_both_languages,
);

async fn a_file_comes_back_as_its_report(database: Database) {
    let bench = Bench::new(database).await;
    let bytes = sample("wrong/specular-half-unnormalized--average.vert");
    let reply = bench.hand_in("?name=a/b%5Cmine.vert&lang=ja", bytes.clone()).await;
    assert_eq!(reply.status, StatusCode::CREATED, "{reply:?}");
    let json = reply.json();
    assert_eq!(json["state"], "graded");
    assert_eq!(json["name"], "mine.vert");
    assert_eq!(json["report"]["schema"], "ggrade/report/v1");
    assert_eq!(json["report"]["verdict"], "wrong");
    assert_eq!(json["report"]["score"], 80);
    assert_eq!(json["report"]["mistakes"], json!(["specular-half-unnormalized"]));
    assert_eq!(json["report"]["rubric"][3]["label"], "鏡面反射光");
    assert_eq!(json["report"]["source"]["name"], "mine.vert");

    let location = reply.header("location").to_owned();
    assert_eq!(location, json["links"]["self"]);
    let again = bench.get(&format!("{location}?lang=ja")).await;
    assert_eq!(again.status, StatusCode::OK);
    assert_eq!(again.json(), json);
    let english = bench.get(&location).await.json();
    assert_eq!(english["report"]["rubric"][3]["label"], "Specular");

    let source = bench.get(&format!("{location}/source")).await;
    assert_eq!(source.body, bytes);
    assert_eq!(source.header("content-type"), "application/octet-stream");
    assert!(source.header("content-disposition").starts_with("attachment;"));
    bench.finish().await;
}

async fn the_same_file_is_answered_from_the_store_in_its_own_name(database: Database) {
    let bench = Bench::new(database).await;
    let bytes = right_and_new();
    let first = bench.hand_in("?name=first.vert", bytes.clone()).await.json();
    let second = bench.hand_in("?name=second.vert", bytes.clone()).await.json();
    assert_ne!(first["id"], second["id"]);
    assert_eq!(second["report"]["source"]["name"], "second.vert");
    // No two gradings take the same time to the last digit.
    assert_eq!(first["report"]["elapsed_ms"], second["report"]["elapsed_ms"]);
    let gentle = bench.hand_in("?hints=gentle", bytes).await.json();
    assert_ne!(first["report"]["elapsed_ms"], gentle["report"]["elapsed_ms"]);
    bench.finish().await;
}

async fn a_changed_folder_is_another_assignment(database: Database) {
    let bench = Bench::new(database).await;
    let bytes = right_and_new();
    let first = bench.hand_in("?name=first.vert", bytes.clone()).await.json();
    assert_eq!(first["report"]["max_score"], 100);
    let built_in = &first["report"]["assignment_digest"];

    let mut folder = Folder::clone(&bench.state.assignment.folder);
    let manifest = folder.text("assignment.toml").expect("text").replacen("points = 10", "points = 60", 1);
    folder.files.insert("assignment.toml".into(), manifest.into());
    let changed = Arc::new(Assignment::load(folder).expect("an assignment"));
    let digest = changed.digest.clone();
    let bench = bench.restarted(vec![changed]).await;
    let second = bench.hand_in("?name=second.vert", bytes.clone()).await.json();
    assert_eq!(second["report"]["max_score"], 150, "the report of the folder as it was");
    assert_eq!(second["report"]["assignment_digest"], digest);
    assert_ne!(*built_in, digest);
    // What was said before the change stays what it was.
    let before = bench.get(first["links"]["self"].as_str().expect("a link")).await.json();
    assert_eq!(before["report"]["max_score"], 100);
    bench.finish().await;
}

async fn a_form_is_taken_as_well(database: Database) {
    let bench = Bench::new(database).await;
    let body = [
        b"--x\r\nContent-Disposition: form-data; name=\"hints\"\r\n\r\nnone\r\n\
          --x\r\nContent-Disposition: form-data; name=\"file\"; filename=\"\xe8\xaa\xb2\xe9\xa1\x8c.vert\"\r\n\r\n"
            .as_slice(),
        &right(),
        b"\r\n--x--\r\n",
    ]
    .concat();
    let request = Request::post("/api/v1/submissions").header(header::CONTENT_TYPE, "multipart/form-data; boundary=x");
    let reply = bench.send(request.body(Body::from(body)).expect("a request")).await;
    assert_eq!(reply.status, StatusCode::CREATED, "{reply:?}");
    assert_eq!(reply.json()["name"], "課題.vert");
    assert_eq!(reply.json()["report"]["verdict"], "correct");
    bench.finish().await;
}

async fn pictures_can_be_seen_later(database: Database) {
    let bench = Bench::new(database).await;
    let json = bench.hand_in("", sample("wrong/specular-half-unnormalized--average.vert")).await.json();
    let list = bench.get(json["links"]["frames"].as_str().expect("a link")).await.json();
    let frames = list["frames"].as_array().expect("frames");
    assert_eq!(frames.len(), 25);
    let mut pictures = Vec::new();
    for view in ["yours", "expected", "difference"] {
        let reply = bench.get(frames[0][view].as_str().expect("a link")).await;
        assert_eq!((reply.status, reply.header("content-type")), (StatusCode::OK, "image/png"));
        let picture = image::load_from_memory(&reply.body).expect("a PNG");
        assert_eq!((picture.width(), picture.height()), (640, 480));
        pictures.push(picture.to_rgb8().into_raw());
    }
    // The mistake shows at t = 0; the difference shows where.
    assert_ne!(pictures[0], pictures[1]);
    assert_ne!(pictures[2], pictures[0]);
    let animation = json["links"]["animation"].as_str().expect("a link");
    for (view, width) in [("yours", 640), ("all", 3 * 640 + 16)] {
        let reply = bench.get(&format!("{animation}?view={view}")).await;
        let decoder = png::Decoder::new(std::io::Cursor::new(&reply.body));
        let reader = decoder.read_info().expect("a PNG");
        assert_eq!(reader.info().width, width);
        assert_eq!(reader.info().animation_control.expect("an animation").num_frames, 25);
    }
    let outside = bench.get(&frames[0]["yours"].as_str().expect("a link").replace("/0.png", "/25.png")).await;
    assert_eq!(outside.status, StatusCode::NOT_FOUND);

    let rejected = bench.hand_in("", sample("rejected/brace-missing-at-end.vert")).await.json();
    assert_eq!(rejected["report"]["verdict"], "rejected");
    let list = bench.get(rejected["links"]["frames"].as_str().expect("a link")).await.json();
    assert_eq!(list, json!({"frames": []}));
    let nothing = bench.get(rejected["links"]["animation"].as_str().expect("a link")).await;
    assert_eq!(nothing.status, StatusCode::NOT_FOUND);
    bench.finish().await;
}

async fn every_error_is_a_problem_in_both_languages(database: Database) {
    let bench = Bench::new(database).await;
    let post = |kind: &str, body: Vec<u8>| {
        let request = Request::post("/api/v1/submissions").header(header::CONTENT_TYPE, kind);
        request.body(Body::from(body)).expect("a request")
    };
    let check = |reply: Reply, status: u16, kind: &str| {
        assert_eq!(reply.status.as_u16(), status, "{reply:?}");
        assert_eq!(reply.problem(), kind);
        reply
    };
    check(bench.get("/api/v1/nothing").await, 404, "not-found");
    check(bench.get("/api/v1/submissions/12345").await, 404, "not-found");
    check(bench.get("/api/v1/submissions/a%2Fb%00c%ff").await, 400, "bad-request");
    let reply = check(bench.get("/api/v1/submissions").await, 405, "method-not-allowed");
    assert_eq!(reply.header("allow"), "POST");
    check(bench.hand_in("?hints=everything", right()).await, 400, "bad-request");
    check(bench.hand_in("?assignment=ggsample99", right()).await, 404, "not-found");
    check(bench.hand_in("", "").await, 422, "unprocessable");
    check(bench.hand_in("", vec![b'x'; 300 * 1024]).await, 413, "too-large");
    check(bench.hand_in("", vec![b'x'; 5 << 20]).await, 413, "too-large");
    check(bench.hand_in("", vec![b'x'; 65 * 1024]).await, 413, "too-large");
    let reply = check(bench.hand_in("", b"\x89PNG\r\n\x1A\n\0\0\0\x0DIHDR".to_vec()).await, 422, "not-text");
    let detail = reply.json()["detail"].as_str().expect("a detail").to_owned();
    assert!(detail.contains("picture (PNG)") && detail.contains("the .vert file itself"), "{detail}");
    check(bench.send(post("application/json", b"{}".to_vec())).await, 415, "unsupported-media-type");
    check(bench.send(post("multipart/form-data", b"".to_vec())).await, 400, "bad-request");
    check(bench.send(post("multipart/form-data; boundary=x", b"--x\r\nnonsense".to_vec())).await, 400, "bad-request");
    check(bench.send(post("multipart/form-data; boundary=x", b"--x--\r\n".to_vec())).await, 422, "unprocessable");
    check(bench.hand_in("?student=123", right()).await, 401, "unauthorized");

    let japanese = bench.get("/api/v1/nothing?lang=ja").await.json();
    assert!(japanese["detail"].as_str().expect("a detail").contains("ありません"), "{japanese}");
    // Who comes with a browser sees a page.
    let request = Request::get("/nothing").header(header::ACCEPT, "text/html,*/*;q=0.8");
    let page = bench.send(request.body(Body::empty()).expect("a request")).await;
    assert_eq!(page.status, StatusCode::NOT_FOUND);
    assert!(page.header("content-type").starts_with("text/html"));
    bench.finish().await;
}

#[tokio::test]
async fn who_is_not_let_in_is_told_how_to_ask() {
    let bench = Bench::new(Database::sqlite()).await;
    let get = |token: Option<&str>| {
        let mut request = Request::get("/api/v1/batches/1");
        if let Some(token) = token {
            request = request.header(header::AUTHORIZATION, format!("Bearer {token}"));
        }
        bench.send(request.body(Body::empty()).expect("a request"))
    };
    let without = get(None).await;
    assert_eq!(without.status, StatusCode::UNAUTHORIZED);
    assert_eq!(without.header("www-authenticate"), "Bearer realm=\"ggrade\"");
    let wrong = get(Some("guessed")).await;
    assert_eq!(wrong.status, StatusCode::UNAUTHORIZED);
    assert_eq!(wrong.header("www-authenticate"), "Bearer realm=\"ggrade\", error=\"invalid_token\"");
    assert_eq!(get(Some(crate::bench::TEACHER)).await.header("www-authenticate"), "");
    bench.finish().await;
}

#[tokio::test]
async fn every_answer_has_its_security_headers() {
    let bench = Bench::new(Database::sqlite()).await;
    for address in ["/healthz", "/api/v1/openapi.json", "/api/docs/", "/nothing"] {
        let reply = bench.get(address).await;
        let policy = reply.header("content-security-policy");
        assert!(policy.contains("default-src 'none'") && policy.contains("script-src 'self';"), "{address}: {policy}");
        assert_eq!(reply.header("x-content-type-options"), "nosniff", "{address}");
        assert_eq!(reply.header("x-frame-options"), "DENY", "{address}");
    }
    bench.finish().await;
}
