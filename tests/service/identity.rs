//! Who sees what: students their own, teachers the class, nobody anybody else's.

use crate::bench::{Bench, Fake, TEACHER, config};
use crate::cluster::Database;
use crate::on_both;
use axum::body::Body;
use axum::extract::{Form, State as Shared};
use axum::http::{Request, StatusCode, header};
use axum::response::{IntoResponse, Response};
use axum::routing::{get, post};
use axum::{Router, middleware};
use ggrade::service::clock::Clock;
use ggrade::service::errors::Problem;
use ggrade::service::identity::{
    LoginForm, Teacher, TeacherPage, Visitor, course_secret, hash_password, join, login, logout, personal_code, visit,
};
use ggrade::service::limits::Client;
use ggrade::service::{Config, Service, layered};
use std::sync::Arc;
use std::time::Duration;

on_both!(
    a_history_belongs_to_its_browser,
    an_older_browser_tells_the_origin_of_its_page,
    the_next_student_at_a_machine_sees_nothing,
    a_session_opens_the_teachers_part_and_ends,
    forms_of_other_pages_are_refused,
);

async fn bench(database: Database, config: Config, clock: Clock) -> (Bench, Router) {
    let bench = Bench::with(database, config, Arc::new(Fake(|| Ok(()))), clock).await;
    let service = bench.state.service().clone();
    let routes = Router::new()
        .route("/csrf", get(async |Shared(service): Shared<Service>, visitor: Visitor| visitor.csrf(&service)))
        .route("/login", post(try_login))
        .route("/logout", post(try_logout))
        .route(
            "/class",
            get(async |TeacherPage(teacher): TeacherPage, Shared(service): Shared<Service>| teacher.csrf(&service)),
        )
        .route("/data", get(async |_: Teacher| "the class"))
        .layer(middleware::from_fn_with_state(service.clone(), visit));
    (bench, layered(service, routes))
}

async fn try_login(
    Shared(service): Shared<Service>,
    client: Client,
    visitor: Visitor,
    Form(form): Form<LoginForm>,
) -> Result<Response, Problem> {
    login(&service, &client, &visitor, None, &form).await
}

async fn try_logout(Shared(service): Shared<Service>, teacher: Teacher, csrf: String) -> Result<Response, Problem> {
    logout(&service, &teacher, &csrf).await
}

/// A new browser: its visitor as the layer around pages makes it, and its cookie.
async fn browser(app: &Router) -> (String, String) {
    let request = Request::get("/csrf").body(Body::empty()).expect("a request");
    let reply = crate::bench::send(app, request).await;
    let cookie = reply.header("set-cookie").to_owned();
    assert!(cookie.contains("HttpOnly") && cookie.contains("SameSite=Lax"), "{cookie}");
    let cookie = cookie.split(';').next().expect("a cookie").to_owned();
    (cookie, String::from_utf8(reply.body).expect("text"))
}

fn with_cookie(method: &str, address: &str, cookie: &str, body: String) -> Request<Body> {
    Request::builder()
        .method(method)
        .uri(address)
        .header(header::COOKIE, cookie)
        .header(header::CONTENT_TYPE, "application/x-www-form-urlencoded")
        .body(Body::from(body))
        .expect("a request")
}

/// The visitor that a cookie stands for.
async fn visitor(state: &Service, cookie: &str) -> Visitor {
    use axum::extract::FromRequestParts;
    let (mut parts, ()) = Request::get("/").header(header::COOKIE, cookie).body(()).expect("a request").into_parts();
    Visitor::from_request_parts(&mut parts, state).await.expect("a visitor")
}

fn cookie_of(state: &Service, visitor: &Visitor) -> String {
    let mut response = ().into_response();
    visitor.set_cookie(state, &mut response);
    let cookie = response.headers()[header::SET_COOKIE].to_str().expect("text").to_owned();
    cookie.split(';').next().expect("a cookie").to_owned()
}

async fn hand_in(bench: &Bench, cookie: &str, site: &str, text: &str) -> String {
    let request = Request::post("/api/v1/submissions")
        .header(header::CONTENT_TYPE, "text/plain")
        .header(header::COOKIE, cookie)
        .header("sec-fetch-site", site);
    bench.send(request.body(Body::from(text.to_owned())).expect("a request")).await.id()
}

/// The same from a browser that says nothing of the site, by the origin of the page.
async fn hand_in_from(bench: &Bench, cookie: &str, origin: &str) -> String {
    let request = Request::post("/api/v1/submissions")
        .header(header::CONTENT_TYPE, "text/plain")
        .header(header::COOKIE, cookie)
        .header(header::HOST, "ggrade.example")
        .header(header::ORIGIN, origin);
    bench.send(request.body(Body::from(origin.to_owned())).expect("a request")).await.id()
}

async fn history(bench: &Bench, cookie: &str) -> Vec<String> {
    let visitor = visitor(&bench.state, cookie).await;
    let Some(owner) = visitor.identity.owner_id() else { return Vec::new() };
    let student = visitor.identity.student_id();
    let rows = bench.state.store.history("ggsample06", owner, student, 100).await.expect("a history");
    rows.into_iter().map(|row| row.submission.id).collect()
}

async fn a_history_belongs_to_its_browser(database: Database) {
    let (bench, app) = bench(database, config(), Clock::system()).await;
    let ((mine, _), (theirs, _)) = (browser(&app).await, browser(&app).await);
    let secret = course_secret(&bench.state).await.expect("a secret");
    assert!(join(&bench.state, visitor(&bench.state, &mine).await, "guessed", "s1", "").await.is_err());
    let joined = join(&bench.state, visitor(&bench.state, &mine).await, &secret, "s1", "").await.expect("joined");
    let mine = cookie_of(&bench.state, &joined);
    // Another browser says that it is the same student, and is not believed.
    for (code, kind) in [("", "code-needed"), ("00000-00000", "wrong-code")] {
        let refused = join(&bench.state, visitor(&bench.state, &theirs).await, &secret, "s1", code).await;
        assert_eq!(refused.expect_err("a problem").kind, kind);
    }
    let first = hand_in(&bench, &mine, "same-origin", "mine").await;
    assert_eq!(history(&bench, &mine).await, std::slice::from_ref(&first));
    assert!(history(&bench, &theirs).await.is_empty());
    // Drafts are in no history, and a page of another site hands in under nobody's name.
    hand_in(&bench, &mine, "cross-site", "forged").await;
    hand_in(&bench, &mine, "same-site", "forged by a neighbour").await;
    assert_eq!(history(&bench, &mine).await, std::slice::from_ref(&first));
    // The class table has the student by number.
    let class = bench.state.store.class("ggsample06", None).await.expect("a class");
    let numbers: Vec<_> = class.iter().filter_map(|row| row.number.as_deref()).collect();
    assert_eq!(numbers, ["S1"]);
    // With the personal code it is the student's as well, and has their history.
    let student = bench.state.store.student_by_number("S1").await.expect("a store").expect("a student");
    let code = personal_code(&bench.state, &student).to_lowercase();
    let joined = join(&bench.state, visitor(&bench.state, &theirs).await, &secret, "s1", &code).await.expect("joined");
    assert_eq!(history(&bench, &cookie_of(&bench.state, &joined)).await, [first]);
    assert!(history(&bench, &theirs).await.is_empty(), "the cookie from before is worth nothing");
    bench.finish().await;
}

async fn an_older_browser_tells_the_origin_of_its_page(database: Database) {
    let (bench, app) = bench(database, config(), Clock::system()).await;
    let (cookie, _) = browser(&app).await;
    let secret = course_secret(&bench.state).await.expect("a secret");
    let joined = join(&bench.state, visitor(&bench.state, &cookie).await, &secret, "s1", "").await.expect("joined");
    let mine = cookie_of(&bench.state, &joined);
    for origin in ["https://elsewhere.example", "http://ggrade.example.elsewhere.example", "null"] {
        hand_in_from(&bench, &mine, origin).await;
        assert!(history(&bench, &mine).await.is_empty(), "{origin}");
    }
    let own = hand_in_from(&bench, &mine, "http://ggrade.example").await;
    assert_eq!(history(&bench, &mine).await, [own]);
    bench.finish().await;
}

async fn the_next_student_at_a_machine_sees_nothing(database: Database) {
    let (bench, app) = bench(database, config(), Clock::system()).await;
    let (cookie, _) = browser(&app).await;
    let secret = course_secret(&bench.state).await.expect("a secret");
    let first = join(&bench.state, visitor(&bench.state, &cookie).await, &secret, "s1", "").await.expect("joined");
    hand_in(&bench, &cookie_of(&bench.state, &first), "same-origin", "of the first").await;
    let second = join(&bench.state, first.clone(), &secret, "s2", "").await.expect("joined");
    let new_cookie = cookie_of(&bench.state, &second);
    assert_ne!(new_cookie, cookie_of(&bench.state, &first));
    assert!(history(&bench, &new_cookie).await.is_empty());
    assert_eq!(second.identity.student().map(|student| student.number.as_str()), Some("S2"));
    // The same student again keeps the history.
    let again = join(&bench.state, first, &secret, " ｓ１ ", "").await.expect("joined");
    assert_eq!(history(&bench, &cookie_of(&bench.state, &again)).await.len(), 1);
    bench.finish().await;
}

async fn a_session_opens_the_teachers_part_and_ends(database: Database) {
    let clock = Clock::fixed(1_700_000_000_000);
    let password = "正しい password";
    let config = Config { teacher_password_hash: Some(hash_password(password).expect("a hash")), ..config() };
    let (bench, app) = bench(database, config, clock.clone()).await;
    let send = async |request| crate::bench::send(&app, request).await;
    let (cookie, csrf) = browser(&app).await;
    let form = |password: &str| format!("csrf={csrf}&password={}", password.replace(' ', "+"));
    let closed = send(with_cookie("GET", "/class", &cookie, String::new())).await;
    assert_eq!((closed.status, closed.header("location")), (StatusCode::SEE_OTHER, "/teacher/login"));
    assert_eq!(send(with_cookie("GET", "/data", &cookie, String::new())).await.problem(), "unauthorized");
    assert_eq!(send(with_cookie("POST", "/login", &cookie, form("wrong"))).await.problem(), "login");

    for (secret, number) in [(password, 1), (TEACHER, 2)] {
        let reply = send(with_cookie("POST", "/login", &cookie, form(secret))).await;
        assert_eq!((reply.status, reply.header("location")), (StatusCode::SEE_OTHER, "/teacher"), "{number}");
        let session = reply.header("set-cookie").split(';').next().expect("a cookie").to_owned();
        let page = send(with_cookie("GET", "/class", &session, String::new())).await;
        assert_eq!(page.status, StatusCode::OK);
        let token = String::from_utf8(page.body).expect("text");
        // Logging out needs the page's token; afterwards the cookie opens nothing.
        assert_eq!(send(with_cookie("POST", "/logout", &session, "x".into())).await.problem(), "csrf");
        assert_eq!(send(with_cookie("GET", "/data", &session, String::new())).await.status, StatusCode::OK);
        if number == 1 {
            assert_eq!(send(with_cookie("POST", "/logout", &session, token)).await.status, StatusCode::SEE_OTHER);
        } else {
            clock.advance(Duration::from_secs(12 * 3600));
        }
        assert_eq!(send(with_cookie("GET", "/data", &session, String::new())).await.problem(), "unauthorized");
    }
    // A program needs no session; a wrong token opens nothing.
    for (token, status) in [(TEACHER, StatusCode::OK), ("the-teacher-of-the-testz", StatusCode::UNAUTHORIZED)] {
        let request = Request::get("/data").header(header::AUTHORIZATION, format!("Bearer {token}"));
        assert_eq!(send(request.body(Body::empty()).expect("a request")).await.status, status);
    }
    // Guessing is slow: five attempts at once, which half a day brought back, and then one every twelve seconds.
    let mut refused = Vec::new();
    for _ in 0..6 {
        refused.push(send(with_cookie("POST", "/login", &cookie, form("wrong"))).await.problem());
    }
    assert_eq!(refused, ["login", "login", "login", "login", "login", "rate-login"]);
    clock.advance(Duration::from_secs(12));
    assert_eq!(send(with_cookie("POST", "/login", &cookie, form("wrong"))).await.problem(), "login");
    bench.finish().await;
}

async fn forms_of_other_pages_are_refused(database: Database) {
    let (bench, app) = bench(database, config(), Clock::system()).await;
    let ((mine, _), (_, of_another)) = (browser(&app).await, browser(&app).await);
    for csrf in ["", "0", of_another.as_str()] {
        let request = with_cookie("POST", "/login", &mine, format!("csrf={csrf}&password={TEACHER}"));
        let reply = crate::bench::send(&app, request).await;
        assert_eq!((reply.status, reply.problem().as_str()), (StatusCode::FORBIDDEN, "csrf"));
    }
    bench.finish().await;
}

#[tokio::test]
async fn behind_https_cookies_are_bound_to_the_host() {
    let config = Config { public_url: Some("https://ggrade.example.ac.jp".into()), ..config() };
    let (bench, app) = bench(Database::sqlite(), config, Clock::system()).await;
    let reply = crate::bench::send(&app, Request::get("/csrf").body(Body::empty()).expect("a request")).await;
    let cookie = reply.header("set-cookie");
    assert!(
        cookie.starts_with("__Host-ggrade=") && cookie.contains("; Secure") && cookie.contains("Path=/;"),
        "{cookie}"
    );
    bench.finish().await;
}
