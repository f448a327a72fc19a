//! Launches that are not what they say.

use super::launch::{Begun, answer, begin, bench, registered};
use super::platform::{self, CLIENT};
use crate::cluster::Database;
use crate::on_both;
use crate::roster::{form, get};
use axum::http::{StatusCode, header};
use ggrade::service::clock::Clock;
use jsonwebtoken::{Algorithm, EncodingKey, Header};
use serde_json::{Value, json};

on_both!(every_forged_launch_is_refused,);

async fn every_forged_launch_is_refused(database: Database) {
    let (bench, platform) = bench(database, Clock::system()).await;
    registered(&bench, &platform).await;
    let now = jsonwebtoken::get_current_timestamp();
    let deployment = "https://purl.imsglobal.org/spec/lti/claim/deployment_id";
    let version = "https://purl.imsglobal.org/spec/lti/claim/version";
    let kind = "https://purl.imsglobal.org/spec/lti/claim/message_type";
    let changes: [(&str, Value, &str); 13] = [
        ("iss", json!("https://evil.example"), "another issuer"),
        ("aud", json!("another-client"), "another client"),
        ("aud", json!([CLIENT, "another-client"]), "another client"),
        ("azp", json!("another-client"), "another client"),
        ("nonce", json!("another nonce"), "not the answer to this launch"),
        ("nonce", Value::Null, "not the answer to this launch"),
        ("exp", json!(now - 120), "too old"),
        ("nbf", json!(now + 3600), "not valid yet"),
        ("iat", json!(now + 3600), "of the future"),
        (version, json!("1.1"), "not of LTI 1.3.0"),
        (kind, json!("LtiSubmissionReviewRequest"), "kind of LTI message"),
        (deployment, json!("foreign"), "not approved"),
        ("sub", Value::Null, "does not say who you are"),
    ];
    for (claim, value, said) in changes {
        let begun = begin(&bench, &platform, false).await;
        let mut claims = platform.claims(&begun.query["nonce"], "s1", "Learner");
        claims[claim] = value.clone();
        let reply = answer(&bench, &begun, &platform.sign(&claims)).await;
        assert_eq!(reply.status, StatusCode::FORBIDDEN, "{claim}: {value}: {}", reply.text());
        assert!(reply.text().contains(said), "{claim}: {value}: {}", reply.text());
        assert!(
            reply
                .headers
                .get_all(header::SET_COOKIE)
                .iter()
                .all(|line| !line.as_bytes().starts_with(b"ggrade_teacher"))
        );
    }
    // Tokens that are not what they say: unsigned, of another key, with the public key as a secret.
    let begun = begin(&bench, &platform, false).await;
    let claims = platform.claims(&begun.query["nonce"], "s1", "Learner");
    let part = |json: &Value| {
        use base64::Engine;
        base64::prelude::BASE64_URL_SAFE_NO_PAD.encode(json.to_string())
    };
    let honest = platform.sign(&claims);
    let body = honest.split('.').nth(1).expect("a body").to_owned();
    let header = |alg: &str| json!({ "alg": alg, "typ": "JWT", "kid": "platform-key" });
    let by = |alg, key: &EncodingKey, id: &str| {
        let header = Header { kid: Some(id.to_owned()), ..Header::new(alg) };
        jsonwebtoken::encode(&header, &claims, key).expect("a token")
    };
    let confused = EncodingKey::from_secret(platform.public_modulus().as_bytes());
    let forged = [
        (format!("{}.{body}.", part(&header("none"))), "no signed token"),
        (
            format!("{}.{body}.{}", part(&header("none")), honest.rsplit('.').next().expect("a signature")),
            "no signed token",
        ),
        (format!("{}.{body}.", part(&header("RS256"))), "signature is wrong"),
        (by(Algorithm::HS256, &confused, "platform-key"), "not signed with RS256"),
        (by(Algorithm::RS256, &platform::key(), "platform-key"), "signature is wrong"),
        (by(Algorithm::RS256, &platform::key(), "unknown-key"), "no key"),
        ("nonsense".to_owned(), "no signed token"),
        (String::new(), "no signed token"),
    ];
    for (token, said) in forged {
        let begun = Begun { cookie_line: String::new(), ..begin(&bench, &platform, false).await };
        let reply = answer(&bench, &begun, &token).await;
        assert_eq!(reply.status, StatusCode::FORBIDDEN, "{token}");
        assert!(reply.text().contains(said), "{token}: {}", reply.text());
    }
    // Several audiences are right where it says which of them is meant; a list of one is as good as its member.
    for (aud, azp) in [(json!([CLIENT]), Value::Null), (json!([CLIENT, "another"]), json!(CLIENT))] {
        let begun = begin(&bench, &platform, false).await;
        let mut claims = platform.claims(&begun.query["nonce"], "s1", "Learner");
        (claims["aud"], claims["azp"]) = (aud, azp);
        let token = platform.sign(&claims);
        assert_eq!(answer(&bench, &begun, &token).await.status, StatusCode::SEE_OTHER);
        // The same again, and the same with the state of another launch: its nonce was used.
        assert!(answer(&bench, &begun, &token).await.text().contains("has been used"));
        let other = begin(&bench, &platform, false).await;
        assert!(answer(&bench, &other, &token).await.text().contains("not the answer to this launch"));
    }
    // Another browser brings the answer: it is told to open a window of its own, and is nobody.
    let begun = begin(&bench, &platform, false).await;
    let token = platform.sign(&platform.claims(&begun.query["nonce"], "s1", "Learner"));
    let stolen = Begun { cookie: "ggrade_launch_x=y".to_owned(), ..begun };
    let lost = answer(&bench, &stolen, &token).await;
    assert_eq!(lost.status, StatusCode::FORBIDDEN);
    assert!(lost.text().contains("target=\"_blank\"") && lost.text().contains("/lti/login?iss="), "{}", lost.text());
    // The foreign deployment waits for an administrator, who approves it.
    let id = bench.state.store.platforms().await.expect("platforms")[0].id.clone();
    let page = get(&bench, "/teacher/platforms").await;
    assert!(page.all(".panel li").iter().any(|line| line.contains("foreign") && line.contains("Approve")));
    let wish = format!("wish=approve&platform={id}&deployment=foreign");
    assert_eq!(form(&bench, "/teacher/platforms", &wish).await.status, StatusCode::SEE_OTHER);
    let begun = begin(&bench, &platform, false).await;
    let mut claims = platform.claims(&begun.query["nonce"], "s1", "Learner");
    claims[deployment] = json!("foreign");
    assert_eq!(answer(&bench, &begun, &platform.sign(&claims)).await.status, StatusCode::SEE_OTHER);
    bench.finish().await;
}
