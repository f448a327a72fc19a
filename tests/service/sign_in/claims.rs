//! What issuers say elsewhere than in an id token, or leave out of it.

use super::{assert_refused, bench, cookies, get, signed_in};
use crate::cluster::Database;
use crate::on_both;
use axum::http::StatusCode;
use ggrade::service::clock::Clock;
use serde_json::{Value, json};

on_both!(what_the_token_does_not_say_is_asked_of_the_issuer);

async fn what_the_token_does_not_say_is_asked_of_the_issuer(database: Database) {
    let (bench, issuer) = bench(database, Clock::system()).await;
    let about = |subject: &str, email: &str| json!({ "sub": subject, "email": email, "email_verified": true });
    const SUBJECT: &str = "248289761001";
    issuer.seen().userinfo = Some(about(SUBJECT, "s1@example.ac.jp"));
    let silent = async || {
        signed_in(&bench, &issuer, "", |claims| {
            let claims = claims.as_object_mut().expect("claims");
            claims.retain(|name, _| !name.starts_with("email"));
        })
        .await
    };
    let reply = silent().await;
    assert_eq!((reply.status, reply.header("location")), (StatusCode::SEE_OTHER, "/a/ggsample06"), "{reply:?}");
    assert_eq!(get(&bench, "/", &cookies(&reply).join("; ")).await.all(".top .who bdi"), ["S1"]);
    for (said, why) in [
        (about("another", "s1@example.ac.jp"), "of somebody else"),
        (json!({ "email": "s1@example.ac.jp", "email_verified": true }), "of somebody else"),
        (json!({ "sub": SUBJECT }), "no claim"),
        (json!({ "sub": SUBJECT, "email": "s1@example.ac.jp" }), "not verified"),
    ] {
        issuer.seen().userinfo = Some(said);
        assert_refused(&silent().await, why);
    }
    // That one address is verified says nothing of another one.
    issuer.seen().userinfo = Some(about(SUBJECT, "s2@example.ac.jp"));
    let unverified = |claims: &mut Value| {
        claims.as_object_mut().expect("claims").remove("email_verified");
    };
    let reply = signed_in(&bench, &issuer, "s1@example.ac.jp", unverified).await;
    assert_eq!(get(&bench, "/", &cookies(&reply).join("; ")).await.all(".top .who bdi"), ["S2"]);
    // What the token says itself is not asked for.
    issuer.seen().userinfo = Some(about("another", "s2@example.ac.jp"));
    let reply = signed_in(&bench, &issuer, "s1@example.ac.jp", |_| ()).await;
    assert_eq!(reply.header("location"), "/a/ggsample06", "{reply:?}");
    bench.finish().await;
}
