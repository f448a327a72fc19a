//! Scores on their way to platforms.

use super::WRONG;
use super::launch::{answer, begin, bench, cookie, encoded, hand_in, launch, registered};
use super::platform::{CLIENT, DEPLOYMENT, Platform};
use crate::bench::{Bench, config};
use crate::cluster::Database;
use crate::roster::{form, get, request};
use crate::several_homeworks::{waves, waves_and_new};
use crate::{on_both, right, sample};
use axum::body::Body;
use axum::http::{Request, StatusCode, header};
use ggrade::service::Config;
use ggrade::service::clock::Clock;
use ggrade::service::lti::scores::send_due;
use ggrade::service::store::{AssignmentSettings, LateRules};
use serde_json::{Value, json};
use std::time::Duration;

on_both!(
    scores_go_home_until_they_arrive,
    what_changed_does_not_wait_for_the_next_try,
    a_platform_that_hangs_holds_up_no_other,
    no_score_goes_home_twice,
    what_is_handed_in_without_its_link_goes_home_as_well,
    a_platform_names_to_whom_requests_for_tokens_are_addressed,
);

/// The time, which stands: a platform refuses what is signed at another one.
fn now() -> Clock {
    Clock::fixed(i64::try_from(jsonwebtoken::get_current_timestamp()).expect("a time") * 1000)
}

async fn scores_go_home_until_they_arrive(database: Database) {
    let clock = now();
    let now = clock.now();
    let (bench, platform) = bench(database, clock.clone()).await;
    registered(&bench, &platform).await;
    let student = cookie(&launch(&bench, &platform, "s1", "Learner").await, "ggrade");
    send_due(&bench.state).await;
    assert!(platform.seen().scores.is_empty(), "nothing is handed in");
    assert_eq!(hand_in(&bench, &student, sample(WRONG)).await.status, StatusCode::CREATED);
    // The platform is down for a while.
    platform.seen().failing = Some(StatusCode::SERVICE_UNAVAILABLE);
    send_due(&bench.state).await;
    let page = get(&bench, "/teacher/platforms").await;
    assert!(
        page.text().contains("1 score has not arrived; it is sent again by itself.") && page.text().contains("503"),
        "{}",
        page.text()
    );
    platform.seen().failing = None;
    send_due(&bench.state).await;
    assert!(platform.seen().scores.is_empty(), "it is not asked again at once");
    clock.advance(Duration::from_secs(6));
    send_due(&bench.state).await;
    let first = platform.seen().scores.last().cloned().expect("a score");
    assert_eq!(
        (&first["userId"], &first["scoreGiven"], &first["scoreMaximum"]),
        (&json!("s1"), &json!(80.0), &json!(100.0))
    );
    assert_eq!((&first["activityProgress"], &first["gradingProgress"]), (&json!("Submitted"), &json!("FullyGraded")));
    let comment = first["comment"].as_str().expect("a comment");
    assert!(comment.contains("鏡面反射光 20 / 40") && comment.contains("http://ggrade.example/r/"), "{comment}");
    assert!(!comment.contains('<') && !comment.contains('`'), "plain text: {comment}");
    assert!(get(&bench, "/teacher/platforms").await.all(".panel .notice").is_empty());

    // What is worse changes nothing; what is better comes with a later time, even within one tick of the clock.
    hand_in(&bench, &student, sample("rejected/brace-missing-at-end.vert")).await;
    send_due(&bench.state).await;
    assert_eq!(platform.seen().scores.len(), 1);
    let counts = hand_in(&bench, &student, right()).await.id();
    send_due(&bench.state).await;
    send_due(&bench.state).await;
    let scores = platform.seen().scores.clone();
    assert_eq!((scores.len(), &scores[1]["scoreGiven"]), (2, &json!(100.0)));
    let second = |score: &Value| score["timestamp"].as_str().map(|at| at[..19].to_owned());
    assert!(second(&scores[1]) > second(&scores[0]), "Moodle counts whole seconds: {scores:?}");
    // So does what people say of it, and that they take it back, with equal points.
    let comments = format!("/api/v1/submissions/{counts}/comments");
    let wish = json!({ "line": 3, "text": "Why so?" }).to_string();
    let said = bench.send(request("POST", &comments, "application/json", wish)).await;
    for (is_said, address) in [(true, String::new()), (false, format!("{comments}/{}", said.id()))] {
        if !is_said {
            let removed = bench.send(request("DELETE", &address, "", Body::empty())).await;
            assert_eq!(removed.status, StatusCode::NO_CONTENT);
        }
        send_due(&bench.state).await;
        send_due(&bench.state).await;
        let score = platform.seen().scores.pop().expect("a score");
        assert_eq!(score["comment"].as_str().expect("a comment").contains("Why so?"), is_said, "{score}");
        assert_eq!(platform.seen().scores.len(), 2, "each is sent once");
    }
    // What lateness takes off goes home as well, and is said.
    let rules = bench.state.store.assignment("ggsample06").await.expect("rules");
    let late = LateRules { until: Some(now + 86_400_000), percent: 15.0, ..LateRules::default() };
    let strict = AssignmentSettings { closes_at: Some(now - 1000), late, ..rules.clone() };
    bench.state.store.set_assignment(&strict).await.expect("set");
    send_due(&bench.state).await;
    let late = platform.seen().scores.pop().expect("a score");
    assert_eq!(late["scoreGiven"], json!(85.0));
    assert!(late["comment"].as_str().expect("a comment").contains("−15\n成績に入る得点: 85 / 100"), "{late}");
    bench.state.store.set_assignment(&rules).await.expect("set");
    send_due(&bench.state).await;
    assert_eq!(platform.seen().scores.pop().expect("a score")["scoreGiven"], json!(100.0));
    // What is deleted is not replaced by something lower: the gradebook keeps what it has.
    let best = bench.state.store.class("ggsample06", None).await.expect("a class");
    let best = best.iter().find(|row| row.row.score == Some(100.0)).expect("the best").row.submission.id.clone();
    let deleted = request("DELETE", &format!("/api/v1/submissions/{best}"), "", Body::empty());
    assert_eq!(bench.send(deleted).await.status, StatusCode::OK);
    send_due(&bench.state).await;
    assert_eq!(platform.seen().scores.len(), 2);
    // A platform that is switched off gets nothing, and launches from it are refused.
    let id = bench.state.store.platforms().await.expect("platforms")[0].id.clone();
    assert_eq!(
        form(&bench, "/teacher/platforms", &format!("wish=off&platform={id}")).await.status,
        StatusCode::SEE_OTHER
    );
    let refused = bench.get(&format!("/lti/login?iss={}&login_hint=1", encoded(&platform.issuer))).await;
    assert_eq!(refused.problem(), "lti");
    bench.finish().await;
}

async fn what_changed_does_not_wait_for_the_next_try(database: Database) {
    let (bench, platform) = bench(database, now()).await;
    registered(&bench, &platform).await;
    let browsers = [
        cookie(&launch(&bench, &platform, "s1", "Learner").await, "ggrade"),
        cookie(&launch(&bench, &platform, "s2", "Learner").await, "ggrade"),
    ];
    for browser in &browsers {
        assert_eq!(hand_in(&bench, browser, sample(WRONG)).await.status, StatusCode::CREATED);
    }
    // The clock stands: by itself none is tried again.
    platform.seen().failing = Some(StatusCode::SERVICE_UNAVAILABLE);
    send_due(&bench.state).await;
    assert!(get(&bench, "/teacher/platforms").await.text().contains("2 scores have not arrived; they are"));
    platform.seen().failing = None;
    send_due(&bench.state).await;
    assert!(platform.seen().scores.is_empty(), "nothing has changed");
    assert_eq!(hand_in(&bench, &browsers[0], right()).await.status, StatusCode::CREATED);
    send_due(&bench.state).await;
    let arrived = |of: usize| {
        let score = platform.seen().scores.get(of).cloned().unwrap_or_default();
        (score["userId"].clone(), score["scoreGiven"].clone())
    };
    assert_eq!(arrived(0), (json!("s1"), json!(100.0)));
    // The platform takes scores again: the other one does not wait any longer either.
    send_due(&bench.state).await;
    assert_eq!((arrived(1), platform.seen().scores.len()), ((json!("s2"), json!(80.0)), 2));
    assert!(get(&bench, "/teacher/platforms").await.all(".panel .notice").is_empty());
    bench.finish().await;
}

async fn a_platform_that_hangs_holds_up_no_other(database: Database) {
    let (bench, hanging) = bench(database, now()).await;
    let others = [Platform::start().await, Platform::start().await, Platform::start().await];
    for (index, platform) in std::iter::once(&hanging).chain(&others).enumerate() {
        registered(&bench, platform).await;
        // Only the first platform's course is connected by itself.
        if index > 0 {
            assert_eq!(launch(&bench, platform, "early", "Learner").await.status, StatusCode::FORBIDDEN);
            let known = bench.state.store.platforms().await.expect("platforms");
            let id = known.iter().find(|known| known.issuer == platform.issuer).map(|known| &known.id).expect("it");
            let wish = format!("wish=connect&platform={id}&context=course-2&course=");
            assert_eq!(form(&bench, "/teacher/platforms", &wish).await.status, StatusCode::SEE_OTHER);
        }
        let student = cookie(&launch(&bench, platform, &format!("s{index}"), "Learner").await, "ggrade");
        assert_eq!(hand_in(&bench, &student, right()).await.status, StatusCode::CREATED);
    }
    hanging.seen().is_hanging = true;
    let service = bench.state.service().clone();
    let sending = tokio::spawn(async move { send_due(&service).await });
    let arrived = || others.iter().all(|platform| platform.seen().scores.len() == 1);
    for _ in 0..300 {
        if arrived() {
            break;
        }
        tokio::time::sleep(Duration::from_millis(20)).await;
    }
    assert!(arrived() && !sending.is_finished(), "the others wait for the one that hangs");
    sending.abort();
    bench.finish().await;
}

async fn no_score_goes_home_twice(database: Database) {
    let is_shared = database.location.starts_with("postgres");
    let again = database.again();
    let clock = now();
    let (bench, platform) = bench(database, clock.clone()).await;
    registered(&bench, &platform).await;
    for who in 1..=6 {
        let student = cookie(&launch(&bench, &platform, &format!("s{who}"), "Learner").await, "ggrade");
        assert_eq!(hand_in(&bench, &student, right()).await.status, StatusCode::CREATED);
    }
    // An SQLite file has one process; its rounds may come at once all the same.
    let config = Config { public_url: Some("http://ggrade.example".into()), ..config() };
    let other = match is_shared {
        true => Some(Bench::with(again, config, crate::pool(), clock).await),
        false => None,
    };
    let beside = other.as_ref().map_or(&bench.state, |other| &other.state);
    tokio::join!(send_due(&bench.state), send_due(beside));
    {
        let seen = platform.seen();
        assert_eq!((seen.scores.len(), seen.posts), (6, 6));
    }
    if let Some(other) = other {
        other.finish().await;
    }
    bench.finish().await;
}

async fn what_is_handed_in_without_its_link_goes_home_as_well(database: Database) {
    let config = Config { public_url: Some("http://ggrade.example".into()), ..config() };
    let homeworks = vec![reference::assignment("ggsample06").expect("built in").clone(), waves()];
    let bench = Bench::serving_several(homeworks, database, config, crate::pool(), now()).await;
    let platform = Platform::start().await;
    registered(&bench, &platform).await;
    let opened = async |who: &str, context: &str, link: &str, homework: &str| {
        let begun = begin(&bench, &platform, false).await;
        let mut claims = platform.claims(&begun.query["nonce"], who, "Learner");
        claims["https://purl.imsglobal.org/spec/lti/claim/context"] = json!({ "id": context });
        claims["https://purl.imsglobal.org/spec/lti/claim/resource_link"] = json!({ "id": link });
        claims["https://purl.imsglobal.org/spec/lti/claim/custom"] = json!({ "assignment": homework });
        answer(&bench, &begun, &platform.sign(&claims)).await
    };
    let of_waves = async |browser: &str| {
        let request = Request::post("/api/v1/submissions?assignment=waves").header(header::COOKIE, browser);
        let request = request.header(header::CONTENT_TYPE, "text/plain").header("sec-fetch-site", "same-origin");
        let reply = bench.send(request.body(Body::from(waves_and_new())).expect("a request")).await;
        assert_eq!(reply.status, StatusCode::CREATED, "{reply:?}");
    };
    let one = cookie(&opened("s1", "course-2", "3", "ggsample06").await, "ggrade");
    of_waves(&one).await;
    send_due(&bench.state).await;
    assert!(platform.seen().scores.is_empty(), "nobody has made a link for it");
    // Somebody opens the link of the other homework; the first one never does.
    assert_eq!(opened("s2", "course-2", "4", "waves").await.status, StatusCode::SEE_OTHER);
    // Who is in another course of the platform is not in that one.
    assert_eq!(opened("s3", "course-9", "9", "ggsample06").await.status, StatusCode::FORBIDDEN);
    let id = bench.state.store.platforms().await.expect("platforms")[0].id.clone();
    let connected = form(&bench, "/teacher/platforms", &format!("wish=connect&platform={id}&context=course-9")).await;
    assert_eq!(connected.status, StatusCode::SEE_OTHER);
    of_waves(&cookie(&opened("s3", "course-9", "9", "ggsample06").await, "ggrade")).await;
    for _ in 0..2 {
        send_due(&bench.state).await;
        let scores = platform.seen().scores.clone();
        let told: Vec<_> = scores.iter().map(|score| (&score["userId"], &score["scoreGiven"])).collect();
        assert_eq!(told, [(&json!("s1"), &json!(100.0))]);
    }
    bench.finish().await;
}

async fn a_platform_names_to_whom_requests_for_tokens_are_addressed(database: Database) {
    let (bench, platform) = bench(database, now()).await;
    let at = |path: &str| format!("{}/{path}", platform.issuer);
    let mut wish = json!({
        "issuer": platform.issuer, "client_id": CLIENT, "deployment": DEPLOYMENT, "auth_url": at("auth"),
        "token_url": at("token"), "keys_url": at("jwks"), "token_audience": "https://api.brightspace.example/auth/token",
    });
    let added = bench.send(request("POST", "/api/v1/platforms", "application/json", wish.to_string())).await;
    assert_eq!(added.status, StatusCode::CREATED, "{added:?}");
    platform.seen().tools_keys = Some(serde_json::from_slice(&bench.get("/lti/jwks.json").await.body).expect("keys"));
    platform.seen().audience = Some("https://api.brightspace.example/auth/token".to_owned());
    let student = cookie(&launch(&bench, &platform, "s1", "Learner").await, "ggrade");
    assert_eq!(hand_in(&bench, &student, right()).await.status, StatusCode::CREATED);
    send_due(&bench.state).await;
    let page = get(&bench, "/teacher/platforms").await;
    assert_eq!(platform.seen().scores.len(), 1, "{}", page.text());
    // The form has a field for it; an empty one stands for the address of tokens.
    for (typed, kept) in [("urn:of-the-form", Some("urn:of-the-form")), (" ", None)] {
        wish["token_audience"] = json!(typed);
        let fields = wish.as_object().expect("fields").iter();
        let fields = fields.map(|(name, value)| format!("{name}={}", encoded(value.as_str().expect("text"))));
        let fields = fields.collect::<Vec<_>>().join("&");
        let added = form(&bench, "/teacher/platforms", &format!("wish=add&{fields}")).await;
        assert_eq!(added.status, StatusCode::SEE_OTHER, "{}", added.text());
        let platforms = bench.state.store.platforms().await.expect("platforms");
        assert_eq!((platforms.len(), platforms[0].token_audience.as_deref()), (1, kept));
    }
    bench.finish().await;
}
