//! Rates, and what a panic costs.

use crate::bench::{Bench, Fake, config, send};
use crate::cluster::Database;
use axum::Router;
use axum::body::Body;
use axum::http::{Request, StatusCode, header};
use axum::routing::get;
use ggrade::service::clock::Clock;
use ggrade::service::limits::Peer;
use ggrade::service::{Config, layered};
use std::sync::Arc;

async fn bench(config: Config) -> Bench {
    Bench::with(Database::sqlite(), config, Arc::new(Fake(|| Ok(()))), Clock::system()).await
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

#[tokio::test]
async fn a_panic_in_a_handler_costs_one_answer() {
    let bench = bench(config()).await;
    let routes = Router::new().route("/panic", get(async || -> &'static str { panic!("a bug of ours") }));
    let app = layered(bench.state.clone(), routes);
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
