//! A browser on its way from a platform into the service.

use super::platform::{CLIENT, Platform};
use crate::bench::{Bench, Reply, config};
use crate::cluster::Database;
use crate::roster::form;
use axum::body::Body;
use axum::http::{Request, StatusCode, header};
use ggrade::service::Config;
use ggrade::service::clock::Clock;
use std::collections::HashMap;

pub fn encoded(text: &str) -> String {
    percent_encoding::utf8_percent_encode(text, percent_encoding::NON_ALPHANUMERIC).to_string()
}

pub async fn bench(database: Database, clock: Clock) -> (Bench, Platform) {
    let config = Config { public_url: Some("http://ggrade.example".into()), ..config() };
    let bench = Bench::with(database, config, crate::pool(), clock).await;
    let platform = Platform::start().await;
    (bench, platform)
}

/// Registers the two with each other as an administrator does.
pub async fn registered(bench: &Bench, platform: &Platform) -> Reply {
    let page = form(bench, "/teacher/platforms", "wish=link").await;
    let link = page.all(".link code")[0].clone();
    let path = link.strip_prefix("http://ggrade.example").expect("an address of the service").to_owned();
    let configuration = encoded(&format!("{}/openid-configuration", platform.issuer));
    let address = format!("{path}?openid_configuration={configuration}&registration_token=one-time&lang=en");
    let reply = bench.get(&address).await;
    let framed = Request::get(&address).header("sec-fetch-dest", "iframe").header(header::ACCEPT, "text/html");
    let again = bench.send(framed.body(Body::empty()).expect("a request")).await;
    assert_eq!(again.status, StatusCode::FORBIDDEN, "a link works once");
    let policy = again.header("content-security-policy");
    let shown_by = policy.split_once("frame-ancestors 'self' ").expect("who may show it").1;
    assert!(shown_by.split(' ').any(|origin| origin == platform.issuer), "the platform shows it: {policy}");
    let keys = bench.get("/lti/jwks.json").await;
    platform.seen().tools_keys = Some(serde_json::from_slice(&keys.body).expect("keys"));
    reply
}

/// A launch under way: what the platform is asked, and the browser's cookie.
pub struct Begun {
    pub query: HashMap<String, String>,
    pub cookie: String,
    pub cookie_line: String,
}

pub async fn begin(bench: &Bench, platform: &Platform, framed: bool) -> Begun {
    let address = format!(
        "/lti/login?iss={}&login_hint=42&client_id={CLIENT}&lti_message_hint=hint&target_link_uri=x",
        encoded(&platform.issuer)
    );
    let reply = match framed {
        true => with_trial(bench, &address).await,
        false => visit(bench, &address, "document", "").await,
    };
    assert_eq!(reply.status, StatusCode::SEE_OTHER, "{reply:?}");
    let next = reqwest::Url::parse(reply.header("location")).expect("an address");
    assert_eq!(next.path(), "/auth");
    let lines = reply.headers.get_all(header::SET_COOKIE).iter().map(|line| line.to_str().expect("text"));
    let line = lines.into_iter().find(|line| line.contains("ggrade_launch_")).expect("a cookie").to_owned();
    Begun {
        query: next.query_pairs().into_owned().collect(),
        cookie: line.split(';').next().expect("a cookie").to_owned(),
        cookie_line: line,
    }
}

pub async fn visit(bench: &Bench, address: &str, dest: &str, cookie: &str) -> Reply {
    let request = Request::get(address).header("sec-fetch-dest", dest).header(header::COOKIE, cookie);
    let request = request.header(header::ACCEPT, "text/html").header(header::ACCEPT_LANGUAGE, "en");
    bench.send(request.body(Body::empty()).expect("a request")).await
}

/// Somebody comes in a frame: the browser is given a cookie to keep first, and comes again with it.
pub async fn with_trial(bench: &Bench, address: &str) -> Reply {
    let reply = visit(bench, address, "iframe", "").await;
    let again = reply.header("location").to_owned();
    assert!(again.starts_with("/lti/login?iss=") && again.ends_with("&tried=1"), "{reply:?}");
    let trial = reply.header("set-cookie").split(';').next().expect("a cookie").to_owned();
    // One that keeps none is shown a new window before the platform is asked, which answers once for each time that somebody comes.
    let without = visit(bench, &again, "iframe", "").await;
    assert_eq!(without.all("h1"), ["Open it in a new window"], "{}", without.text());
    let link = again.trim_end_matches("&tried=1").replace('&', "&#38;");
    assert!(without.text().contains(&format!("href=\"{link}\" target=\"_blank\"")), "{}", without.text());
    visit(bench, &again, "iframe", &trial).await
}

/// The platform's answer, sent by the browser.
pub async fn answer(bench: &Bench, begun: &Begun, token: &str) -> Reply {
    let body = format!("id_token={}&state={}", encoded(token), begun.query["state"]);
    let request = Request::post("/lti/launch")
        .header(header::CONTENT_TYPE, "application/x-www-form-urlencoded")
        .header(header::ACCEPT, "text/html")
        .header(header::ACCEPT_LANGUAGE, "en")
        .header(header::COOKIE, &begun.cookie);
    bench.send(request.body(Body::from(body)).expect("a request")).await
}

pub async fn launch(bench: &Bench, platform: &Platform, subject: &str, role: &str) -> Reply {
    let begun = begin(bench, platform, false).await;
    let claims = platform.claims(&begun.query["nonce"], subject, role);
    answer(bench, &begun, &platform.sign(&claims)).await
}

pub fn cookie(reply: &Reply, name: &str) -> String {
    let lines = reply.headers.get_all(header::SET_COOKIE).iter().map(|line| line.to_str().expect("text"));
    let mut found =
        lines.filter_map(|line| line.split(';').next()).filter(|pair| pair.starts_with(&format!("{name}=")));
    found.next_back().unwrap_or_else(|| panic!("no {name} in {reply:?}")).to_owned()
}

pub async fn with_cookie(bench: &Bench, address: &str, cookie: &str) -> Reply {
    let request = Request::get(address).header(header::COOKIE, cookie).header(header::ACCEPT_LANGUAGE, "en");
    bench.send(request.header(header::ACCEPT, "text/html").body(Body::empty()).expect("a request")).await
}

pub async fn hand_in(bench: &Bench, cookie: &str, bytes: Vec<u8>) -> Reply {
    let request = Request::post("/api/v1/submissions").header(header::COOKIE, cookie);
    let request = request.header(header::CONTENT_TYPE, "text/plain").header("sec-fetch-site", "same-origin");
    bench.send(request.body(Body::from(bytes)).expect("a request")).await
}
