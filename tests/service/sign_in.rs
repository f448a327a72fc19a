//! Students and staff come in by the word of an OpenID issuer, and by nobody else's.

mod claims;
pub mod issuer;

use crate::bench::{Bench, Fake, Reply, config};
use crate::cluster::Database;
use crate::lti::{self, platform::key};
use crate::on_both;
use axum::body::Body;
use axum::http::{Request, StatusCode, header};
use ggrade::service::Config;
use ggrade::service::clock::Clock;
use ggrade::service::identity::{add_staff, choose_password, invite};
use ggrade::service::sign_in::Provider;
use ggrade::service::store::{RosterLine, StaffRole};
use issuer::{CLIENT, Issuer, SECRET};
use jsonwebtoken::{Algorithm, EncodingKey, Header};
use serde_json::{Value, json};
use std::collections::HashMap;
use std::sync::Arc;
use std::time::Duration;

on_both!(
    students_and_staff_come_in_by_the_issuers_word,
    every_forged_answer_is_refused,
    an_issuer_that_lies_is_not_used,
    issuers_sign_by_what_they_publish_and_take_secrets_where_they_say,
    an_issuer_of_many_tenants_lets_those_in_that_are_named,
);

/// A service of a course with two students, and an issuer for it.
async fn bench(database: Database, clock: Clock) -> (Bench, Issuer) {
    with_provider(database, clock, |_| ()).await
}

async fn with_provider(database: Database, clock: Clock, change: impl Fn(&mut Provider)) -> (Bench, Issuer) {
    let issuer = Issuer::start().await;
    let mut provider = Provider {
        id: "university".into(),
        name: "Example University".into(),
        issuer: issuer.address.clone(),
        client_id: CLIENT.into(),
        client_secret: Some(SECRET.into()),
        claim: "email".into(),
        domain: Some("example.ac.jp".into()),
        tenants: Vec::new(),
    };
    change(&mut provider);
    let public_url = Some("http://ggrade.example".into());
    let config = Config { sign_in: vec![provider], public_url, ..config() };
    let bench = Bench::with(database, config, Arc::new(Fake(|| Ok(()))), clock).await;
    let line = |number: &str| RosterLine { number: number.into(), ..RosterLine::default() };
    bench.state.store.set_roster(&[line("S1"), line("S2")], 0).await.expect("a roster");
    let state = bench.state.clone();
    let member = add_staff(&state, "prof@example.ac.jp", "Prof", StaffRole::Administrator).await.expect("an account");
    let link = invite(&state, &member).await.expect("a link");
    choose_password(&state, &link, "a long password").await.expect("a password");
    (bench, issuer)
}

/// A sign-in under way: what the issuer is asked, and the browser's cookies.
struct Begun {
    asked: HashMap<String, String>,
    cookies: String,
}

fn cookies(reply: &Reply) -> Vec<String> {
    let lines = reply.headers.get_all(header::SET_COOKIE).iter().map(|line| line.to_str().expect("text"));
    lines.map(|line| line.split(';').next().expect("a cookie").to_owned()).collect()
}

async fn get(bench: &Bench, address: &str, cookies: &str) -> Reply {
    let request = Request::get(address).header(header::ACCEPT, "text/html").header(header::ACCEPT_LANGUAGE, "en");
    bench.send(request.header(header::COOKIE, cookies).body(Body::empty()).expect("a request")).await
}

async fn begin(bench: &Bench) -> Begun {
    let reply = get(bench, "/sign-in/university?homework=ggsample06", "").await;
    assert_eq!(reply.status, StatusCode::SEE_OTHER, "{reply:?}");
    let next = reqwest::Url::parse(reply.header("location")).expect("an address");
    let asked: HashMap<String, String> = next.query_pairs().into_owned().collect();
    assert_eq!(
        (next.path(), asked["theme"].as_str()),
        ("/realm/authorize", "dark"),
        "what stands in the address stays"
    );
    Begun { asked, cookies: cookies(&reply).join("; ") }
}

/// Comes back with a code and the state.
async fn back(bench: &Bench, begun: &Begun, code: &str, more: &str) -> Reply {
    get(bench, &format!("/signed-in?code={code}&state={}{more}", begun.asked["state"]), &begun.cookies).await
}

/// Signs in with claims that are changed.
async fn signed_in(bench: &Bench, issuer: &Issuer, email: &str, change: impl Fn(&mut Value)) -> Reply {
    let begun = begin(bench).await;
    let mut claims = issuer.claims(&begun.asked, email);
    change(&mut claims);
    let code = issuer.code(&begun.asked, &issuer.sign(&claims));
    back(bench, &begun, &code, "").await
}

/// That nobody came in.
fn assert_refused(reply: &Reply, said: &str) {
    assert_eq!((reply.status, reply.text().contains(said)), (StatusCode::FORBIDDEN, true), "{said}: {}", reply.text());
    assert!(cookies(reply).iter().all(|cookie| !cookie.starts_with("ggrade_teacher=")), "{reply:?}");
}

async fn students_and_staff_come_in_by_the_issuers_word(database: Database) {
    let (bench, issuer) = bench(database, Clock::system()).await;
    let desk = get(&bench, "/a/ggsample06", "").await;
    let link = "/sign-in/university?homework=ggsample06";
    assert!(desk.text().contains(&format!("href=\"{link}\"")), "{}", desk.text());
    assert!(get(&bench, "/teacher/login", "").await.text().contains("Log in with Example University"));
    for _ in 0..2 {
        let reply = signed_in(&bench, &issuer, "S1@Example.ac.jp", |_| ()).await;
        assert_eq!((reply.status, reply.header("location")), (StatusCode::SEE_OTHER, "/a/ggsample06"), "{reply:?}");
        let page = get(&bench, "/a/ggsample06", &cookies(&reply).join("; ")).await;
        assert_eq!(page.all(".top .who bdi"), ["S1"]);
    }
    assert_eq!(issuer.seen().discovered, 1, "what it is is not asked at each sign-in");
    assert_eq!(begin(&bench).await.asked["prompt"], "select_account", "the next one may be somebody else");
    // Another student at the same browser is another browser, in which nothing of the first is seen.
    let first = signed_in(&bench, &issuer, "s1@example.ac.jp", |_| ()).await;
    let begun = begin(&bench).await;
    let code = issuer.code(&begun.asked, &issuer.sign(&issuer.claims(&begun.asked, "s2@example.ac.jp")));
    let both = Begun { cookies: format!("{}; {}", begun.cookies, cookies(&first).join("; ")), ..begun };
    let second = back(&bench, &both, &code, &format!("&iss={}", issuer.address)).await;
    assert_eq!(second.status, StatusCode::SEE_OTHER, "{second:?}");
    assert_ne!(cookies(&first), cookies(&second));
    assert!(cookies(&second).contains(&"ggrade_teacher=".to_owned()), "whoever taught there has left: {second:?}");
    assert_eq!(get(&bench, "/", &cookies(&second).join("; ")).await.all(".top .who bdi"), ["S2"]);
    // Who teaches has an account with this login.
    let staff = signed_in(&bench, &issuer, "prof@example.ac.jp", |_| ()).await;
    assert_eq!((staff.status, staff.header("location")), (StatusCode::SEE_OTHER, "/teacher"), "{staff:?}");
    let class = get(&bench, "/teacher", &cookies(&staff).join("; ")).await;
    assert_eq!(class.all(".top .who bdi"), ["Prof"]);
    // Their session is over when a student signs in there: nothing is left that a copy of the cookie opens.
    let begun = begin(&bench).await;
    let code = issuer.code(&begun.asked, &issuer.sign(&issuer.claims(&begun.asked, "s1@example.ac.jp")));
    let theirs = cookies(&staff).join("; ");
    let both = Begun { cookies: format!("{}; {theirs}", begun.cookies), ..begun };
    assert_eq!(back(&bench, &both, &code, "").await.header("location"), "/a/ggsample06");
    assert_eq!(get(&bench, "/teacher", &theirs).await.header("location"), "/teacher/login");
    bench.finish().await;
}

async fn every_forged_answer_is_refused(database: Database) {
    let clock = Clock::fixed(i64::try_from(jsonwebtoken::get_current_timestamp()).expect("a time") * 1000);
    let (bench, issuer) = bench(database, clock.clone()).await;
    let now = jsonwebtoken::get_current_timestamp();
    let changes: [(&str, Value, &str); 18] = [
        ("iss", json!("https://evil.example"), "another issuer"),
        ("aud", json!("another-client"), "another client"),
        ("aud", json!([CLIENT, "another-client"]), "another client"),
        ("azp", json!("another-client"), "another client"),
        ("nonce", json!("another nonce"), "not the answer to this sign-in"),
        ("nonce", Value::Null, "not the answer to this sign-in"),
        ("sub", Value::Null, "does not say who"),
        ("sub", json!(""), "does not say who"),
        ("sub", json!(7), "does not say who"),
        ("exp", json!(now - 120), "too old"),
        ("iat", json!(now + 3600), "of the future"),
        ("iat", Value::Null, "has no time"),
        ("email", Value::Null, "no claim"),
        ("email", json!("s1@evil.example"), "Only addresses of example.ac.jp"),
        ("email", json!("s1@example.ac.jp@evil.example"), "Only addresses of example.ac.jp"),
        ("email", json!("s3@example.ac.jp"), "not on the roster"),
        ("email_verified", json!(false), "not verified"),
        ("email_verified", Value::Null, "not verified"),
    ];
    for (claim, value, said) in changes {
        let reply = signed_in(&bench, &issuer, "s1@example.ac.jp", |claims| claims[claim] = value.clone()).await;
        assert_refused(&reply, said);
    }
    // Tokens that are not what they say: unsigned, of another key, with the public key as a secret.
    let begun = begin(&bench).await;
    let claims = issuer.claims(&begun.asked, "s1@example.ac.jp");
    let part = |json: &Value| {
        use base64::Engine;
        base64::prelude::BASE64_URL_SAFE_NO_PAD.encode(json.to_string())
    };
    let by = |alg, key: &EncodingKey, id: &str| {
        let header = Header { kid: Some(id.to_owned()), ..Header::new(alg) };
        jsonwebtoken::encode(&header, &claims, key).expect("a token")
    };
    let body = part(&claims);
    let unsigned = |alg: &str| format!("{}.{body}.", part(&json!({ "alg": alg, "typ": "JWT", "kid": "issuer-key" })));
    let confused = EncodingKey::from_secret(issuer.public_modulus().as_bytes());
    for (token, said) in [
        (unsigned("none"), "no signed token"),
        (unsigned("RS256"), "signature is wrong"),
        (by(Algorithm::HS256, &confused, "issuer-key"), "not signed with RS256"),
        (by(Algorithm::RS256, &key(), "issuer-key"), "signature is wrong"),
        (by(Algorithm::RS256, &key(), "unknown-key"), "no key"),
        ("nonsense".to_owned(), "no signed token"),
    ] {
        let begun = begin(&bench).await;
        let code = issuer.code(&begun.asked, &token);
        assert_refused(&back(&bench, &begun, &code, "").await, said);
    }
    // A code that is none, and one that belongs to another sign-in: the verifier does not fit.
    let (one, other) = (begin(&bench).await, begin(&bench).await);
    assert_refused(&back(&bench, &one, "guessed", "").await, "code is not taken");
    let stolen = issuer.code(&one.asked, &issuer.sign(&issuer.claims(&other.asked, "s1@example.ac.jp")));
    assert_refused(&back(&bench, &other, &stolen, "").await, "code is not taken");
    // An answer comes once, in time, from this issuer, and to the browser in which it began.
    let honest = async || {
        let begun = begin(&bench).await;
        let code = issuer.code(&begun.asked, &issuer.sign(&issuer.claims(&begun.asked, "s1@example.ac.jp")));
        (begun, code)
    };
    let (begun, code) = honest().await;
    assert_eq!(back(&bench, &begun, &code, "").await.status, StatusCode::SEE_OTHER);
    assert_refused(&back(&bench, &begun, &code, "").await, "has been used");
    let (begun, code) = honest().await;
    assert_refused(&back(&bench, &begun, &code, "&iss=https://evil.example").await, "another issuer");
    let (begun, code) = honest().await;
    let elsewhere = Begun { cookies: begin(&bench).await.cookies, ..begun };
    assert_refused(&back(&bench, &elsewhere, &code, "").await, "another browser");
    let (begun, _) = honest().await;
    let denied = format!("/signed-in?error=access_denied&error_description=no&state={}", begun.asked["state"]);
    assert_refused(&get(&bench, &denied, &begun.cookies).await, "does not let you in: access_denied no");
    let (begun, code) = honest().await;
    clock.advance(Duration::from_secs(601));
    assert_refused(&back(&bench, &begun, &code, "").await, "longer than ten minutes");
    assert_refused(&get(&bench, "/signed-in", "").await, "has been used");
    assert_eq!(get(&bench, "/sign-in/nobody", "").await.status, StatusCode::NOT_FOUND);
    bench.finish().await;
}

async fn an_issuer_that_lies_is_not_used(database: Database) {
    let (bench, issuer) = bench(database, Clock::system()).await;
    issuer.seen().alias = Some("https://accounts.example".into());
    let reply = get(&bench, "/sign-in/university", "").await;
    assert_eq!(reply.status, StatusCode::BAD_GATEWAY, "{}", reply.text());
    assert!(reply.text().contains("Example University does not answer as it should"), "{}", reply.text());
    bench.finish().await;
}

async fn issuers_sign_by_what_they_publish_and_take_secrets_where_they_say(database: Database) {
    let (bench, issuer) = bench(database, Clock::system()).await;
    (issuer.seen().takes_post, issuer.seen().signs_by_curve) = (true, true);
    let reply = signed_in(&bench, &issuer, "s1@example.ac.jp", |_| ()).await;
    assert_eq!((reply.status, reply.header("location")), (StatusCode::SEE_OTHER, "/a/ggsample06"), "{reply:?}");
    // That it names them makes no algorithm good whose key is no public one.
    let begun = begin(&bench).await;
    let claims = issuer.claims(&begun.asked, "s1@example.ac.jp");
    let header = Header { kid: Some("issuer-key".to_owned()), ..Header::new(Algorithm::HS256) };
    let confused = EncodingKey::from_secret(issuer.public_modulus().as_bytes());
    let forged = jsonwebtoken::encode(&header, &claims, &confused).expect("a token");
    let code = issuer.code(&begun.asked, &forged);
    assert_refused(&back(&bench, &begun, &code, "").await, "not signed with RS256, ES256");
    bench.finish().await;
}

async fn an_issuer_of_many_tenants_lets_those_in_that_are_named(database: Database) {
    const OWN: &str = "9188040d-6c67-4c5b-b112-36a304b66dad";
    let (bench, issuer) =
        with_provider(database, Clock::system(), |provider| provider.tenants = vec![OWN.to_owned()]).await;
    let template = issuer.address.replace("realm", "{tenantid}");
    issuer.seen().alias = Some(template.clone());
    let of = |tenant: &str| template.replace("{tenantid}", tenant);
    let from = async |tenant: &str, iss: String| {
        signed_in(&bench, &issuer, "s1@example.ac.jp", |claims| {
            claims["tid"] = json!(tenant);
            claims["iss"] = json!(iss);
        })
        .await
    };
    let reply = from(OWN, of(OWN)).await;
    assert_eq!((reply.status, reply.header("location")), (StatusCode::SEE_OTHER, "/a/ggsample06"), "{reply:?}");
    assert_refused(&from("another", of("another")).await, "tenant that is not let in");
    assert_refused(&from(OWN, of("another")).await, "another issuer");
    assert_refused(&from(OWN, template.clone()).await, "another issuer");
    bench.finish().await;
    // Where no tenant is named, everybody's own tenant could vouch for anybody.
    let (open, issuer) = self::bench(Database::sqlite(), Clock::system()).await;
    issuer.seen().alias = Some(issuer.address.replace("realm", "{tenantid}"));
    assert_eq!(get(&open, "/sign-in/university", "").await.status, StatusCode::BAD_GATEWAY);
    open.finish().await;
}
