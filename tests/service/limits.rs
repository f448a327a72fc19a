//! Rates, and what a panic costs.

use crate::bench::{Bench, Fake, config, send};
use crate::cluster::Database;
use crate::staff::{self, Browser, OWN, administrator};
use axum::Router;
use axum::body::Body;
use axum::http::{Request, StatusCode, header};
use axum::routing::get;
use ggrade::service::clock::Clock;
use ggrade::service::limits::Peer;
use ggrade::service::{Config, layered};
use std::sync::Arc;
use std::time::Duration;

async fn bench(config: Config) -> Bench {
    timed(config, Clock::fixed(1_700_000_000_000)).await
}

async fn timed(config: Config, clock: Clock) -> Bench {
    Bench::with(Database::sqlite(), config, Arc::new(Fake(|| Ok(()))), clock).await
}

fn from(peer: &str, forwarded: &str) -> Request<Body> {
    let request = Request::post("/api/v1/submissions")
        .header(header::CONTENT_TYPE, "text/plain")
        .header("x-forwarded-for", forwarded)
        .extension(Peer(peer.parse().expect("an address")));
    request.body(Body::from("file")).expect("a request")
}

#[tokio::test]
async fn an_address_has_its_rate_and_others_have_theirs() {
    let config = Config { uploads_per_address: 3, trusted_proxies: vec!["192.0.2.1".into()], ..config() };
    let bench = bench(config).await;
    let mut statuses = Vec::new();
    for _ in 0..4 {
        statuses.push(bench.send(from("198.51.100.1:1000", "203.0.113.5")).await);
    }
    let last = statuses.pop().expect("a reply");
    assert!(statuses.iter().all(|reply| reply.status == StatusCode::CREATED), "{statuses:?}");
    assert_eq!((last.status, last.problem().as_str()), (StatusCode::TOO_MANY_REQUESTS, "rate-address"));
    assert!(last.header("retry-after").parse::<u64>().expect("seconds") >= 1);
    // Another one, and the same one as a trusted proxy saw it: what it wrote itself was not believed.
    assert_eq!(bench.send(from("198.51.100.2:1000", "198.51.100.1")).await.status, StatusCode::CREATED);
    assert_eq!(bench.send(from("192.0.2.1:1000", "203.0.113.5")).await.status, StatusCode::CREATED);
    assert_eq!(
        bench.send(from("192.0.2.1:1000", "203.0.113.5, 198.51.100.1")).await.status,
        StatusCode::TOO_MANY_REQUESTS
    );
    bench.finish().await;
}

/// A request with a file, out of a browser that is known by this cookie; from none where it is empty.
fn by(peer: &str, cookie: &str) -> Request<Body> {
    let request = Request::post("/api/v1/submissions")
        .header(header::CONTENT_TYPE, "text/plain")
        .extension(Peer(peer.parse().expect("an address")));
    let request = if cookie.is_empty() { request } else { request.header(header::COOKIE, format!("ggrade={cookie}")) };
    request.body(Body::from("file")).expect("a request")
}

#[tokio::test]
async fn who_brings_no_cookie_is_limited_by_address_and_a_class_behind_one_is_not() {
    let clock = Clock::fixed(1_700_000_000_000);
    let bench = timed(Config { uploads_per_student: 3, uploads_per_address: 50, ..config() }, clock.clone()).await;
    let cookie = |number: usize| format!("{number:096x}");
    let (class, other) = ("198.51.100.1:1", "198.51.100.2:1");
    for left in [2, 1, 0] {
        let reply = bench.send(by(class, "")).await;
        assert_eq!(reply.status, StatusCode::CREATED, "{reply:?}");
        assert_eq!(reply.header("ratelimit-policy"), "\"address\";q=50;w=60, \"visitor\";q=3;w=60");
        assert!(reply.header("ratelimit").contains(&format!("\"visitor\";r={left};t=")), "{reply:?}");
    }
    let refused = bench.send(by(class, "")).await;
    assert_eq!((refused.status, refused.problem().as_str()), (StatusCode::TOO_MANY_REQUESTS, "rate-student"));
    assert!(refused.header("ratelimit").contains("\"visitor\";r=0;t="), "{refused:?}");
    assert!(refused.header("retry-after").parse::<u64>().expect("seconds") >= 1);
    // Ten browsers of the same address hand in three times each.
    for number in 1..=10 {
        for _ in 0..3 {
            assert_eq!(bench.send(by(class, &cookie(number))).await.status, StatusCode::CREATED, "{number}");
        }
        assert_eq!(bench.send(by(class, &cookie(number))).await.problem(), "rate-student");
    }
    // Then the address has had its share, whatever cookie is made up; others have theirs.
    // 4 without a cookie and 40 with one are counted, so that 6 are left.
    for number in 11..=16 {
        assert_eq!(bench.send(by(class, &cookie(number))).await.status, StatusCode::CREATED, "{number}");
    }
    assert_eq!(bench.send(by(class, &cookie(17))).await.problem(), "rate-address");
    assert_eq!(bench.send(by(other, &cookie(99))).await.status, StatusCode::CREATED);
    // One of 50 a minute comes back after 1.2 s, one of 3 after 20 s.
    clock.advance(Duration::from_millis(1200));
    assert_eq!(bench.send(by(class, &cookie(17))).await.status, StatusCode::CREATED);
    clock.advance(Duration::from_secs(20));
    assert_eq!(bench.send(by(class, "")).await.status, StatusCode::CREATED);
    assert_eq!(bench.send(by(class, "")).await.problem(), "rate-student");
    bench.finish().await;
}

#[tokio::test]
async fn a_network_of_ipv6_is_one_visitor_and_the_teachers_program_none() {
    let bench = bench(Config { uploads_per_student: 2, uploads_per_address: 4, ..config() }).await;
    for (peer, status) in [
        ("[2001:db8:1:2::1]:1", StatusCode::CREATED),
        ("[2001:db8:1:2:ffff::2]:1", StatusCode::CREATED),
        ("[2001:db8:1:2::3]:1", StatusCode::TOO_MANY_REQUESTS),
        ("[2001:db8:1:3::1]:1", StatusCode::CREATED),
    ] {
        let reply = bench.send(by(peer, "")).await;
        assert_eq!(reply.status, status, "{peer}");
        let names_it = reply.json()["detail"].as_str().is_some_and(|detail| detail.contains("2001:db8:1:2::"));
        assert_eq!(names_it, status == StatusCode::TOO_MANY_REQUESTS, "{reply:?}");
    }
    let with = |token: &str| {
        let mut request = by("192.0.2.1:1", "");
        request.headers_mut().insert(header::AUTHORIZATION, format!("Bearer {token}").parse().expect("a header"));
        bench.send(request)
    };
    for _ in 0..10 {
        let reply = with(crate::bench::TEACHER).await;
        assert_eq!((reply.status, reply.header("ratelimit")), (StatusCode::CREATED, ""), "{reply:?}");
    }
    // A token that is none opens nothing.
    let mut statuses = Vec::new();
    for _ in 0..3 {
        statuses.push(with("guessed").await.status);
    }
    assert_eq!(statuses, [StatusCode::CREATED, StatusCode::CREATED, StatusCode::TOO_MANY_REQUESTS]);
    bench.finish().await;
}

#[tokio::test]
async fn wrong_passwords_lock_their_own_login_alone() {
    let clock = Clock::fixed(1_700_000_000_000);
    let bench = staff::bench(Database::sqlite(), clock.clone()).await;
    administrator(&bench).await;
    clock.advance(Duration::from_secs(60));
    let mut browser = Browser::new(&bench);
    // All come from one address.
    for _ in 0..5 {
        assert_eq!(browser.login("ta", "a wrong one").await.status, StatusCode::FORBIDDEN);
    }
    for login in ["ta", " TA"] {
        assert_eq!(browser.login(login, "a wrong one").await.status, StatusCode::TOO_MANY_REQUESTS);
    }
    assert_eq!(browser.login("prof@example.ac.jp", OWN).await.status, StatusCode::SEE_OTHER);
    // Whoever tries many names is stopped by the address.
    let mut statuses = Vec::new();
    for number in 0..60 {
        statuses.push(browser.login(&format!("guess{number}"), "a wrong one").await.status);
    }
    assert_eq!((statuses[0], statuses[59]), (StatusCode::FORBIDDEN, StatusCode::TOO_MANY_REQUESTS));
    bench.finish().await;
}

#[tokio::test]
async fn a_panic_in_a_handler_costs_one_answer() {
    let bench = bench(config()).await;
    let routes = Router::new().route("/panic", get(async || -> &'static str { panic!("a bug of ours") }));
    let app = layered(bench.state.service().clone(), routes);
    for _ in 0..3 {
        let reply = send(&app, Request::get("/panic").body(Body::empty()).expect("a request")).await;
        assert_eq!((reply.status, reply.problem().as_str()), (StatusCode::INTERNAL_SERVER_ERROR, "internal"));
        // Nobody learns what the bug is.
        assert!(!String::from_utf8_lossy(&reply.body).contains("a bug of ours"));
    }
    assert_eq!(bench.hand_in("", "file").await.status, StatusCode::CREATED);
    bench.finish().await;
}

#[tokio::test]
async fn figures_are_for_this_machine_or_for_who_has_the_token() {
    let bench = bench(Config { metrics_token: Some("sixteen-characters".into()), ..config() }).await;
    let get = |peer: &str, forwarded: Option<&str>, token: Option<&str>| {
        let mut request = Request::get("/metrics").extension(Peer(peer.parse().expect("an address")));
        if let Some(forwarded) = forwarded {
            request = request.header("x-forwarded-for", forwarded);
        }
        if let Some(token) = token {
            request = request.header(header::AUTHORIZATION, format!("Bearer {token}"));
        }
        bench.send(request.body(Body::empty()).expect("a request"))
    };
    assert_eq!(get("127.0.0.1:1", None, None).await.status, StatusCode::OK);
    assert_eq!(get("127.0.0.1:1", Some("198.51.100.1"), None).await.status, StatusCode::FORBIDDEN);
    assert_eq!(get("198.51.100.1:1", None, None).await.status, StatusCode::FORBIDDEN);
    assert_eq!(get("198.51.100.1:1", None, Some("sixteen-characterz")).await.status, StatusCode::FORBIDDEN);
    assert_eq!(get("198.51.100.1:1", None, Some("sixteen-characters")).await.status, StatusCode::OK);
    bench.finish().await;
}
