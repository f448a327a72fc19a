//! What issuers say elsewhere than in an id token, or leave out of it.

use super::{assert_refused, back, begin, bench, cookies, get, signed_in};
use crate::cluster::Database;
use crate::on_both;
use axum::http::StatusCode;
use ggrade::service::clock::Clock;
use serde_json::{Value, json};

on_both!(what_the_token_does_not_say_is_asked_of_the_issuer, a_token_without_a_keys_id_is_of_the_only_key_that_fits);

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

async fn a_token_without_a_keys_id_is_of_the_only_key_that_fits(database: Database) {
    let (bench, issuer) = bench(database, Clock::system()).await;
    let unnamed = async || {
        let begun = begin(&bench).await;
        let token = issuer.unnamed(&issuer.claims(&begun.asked, "s1@example.ac.jp"));
        let code = issuer.code(&begun.asked, &token);
        back(&bench, &begun, &code, "").await
    };
    // The other key that is published is of a curve, and cannot have signed it.
    let reply = unnamed().await;
    assert_eq!((reply.status, reply.header("location")), (StatusCode::SEE_OTHER, "/a/ggsample06"), "{reply:?}");
    bench.finish().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_token_without_a_keys_id_is_of_nobody_where_several_keys_fit() {
    let (bench, issuer) = bench(Database::sqlite(), Clock::system()).await;
    issuer.seen().has_successor = true;
    let begun = begin(&bench).await;
    let token = issuer.unnamed(&issuer.claims(&begun.asked, "s1@example.ac.jp"));
    let code = issuer.code(&begun.asked, &token);
    assert_refused(&back(&bench, &begun, &code, "").await, "names no key");
    bench.finish().await;
}
