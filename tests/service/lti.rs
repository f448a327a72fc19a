//! Learning platforms: registration, launches, choosing a homework, scores, the roster.

mod courses;
mod forged;
mod launch;
mod people;
pub mod platform;
mod scores;

use crate::bench::{Bench, config};
use crate::cluster::Database;
use crate::roster::{form, get, request};
use crate::{on_both, right, sample};
use axum::body::Body;
use axum::http::{Request, StatusCode, header};
use ggrade::service::Config;
use ggrade::service::clock::Clock;
use launch::{answer, begin, bench, cookie, encoded, hand_in, launch, registered, visit, with_cookie};
use platform::{CLIENT, DEPLOYMENT, Platform};
use serde_json::json;

on_both!(
    a_platform_is_registered_and_a_homework_chosen,
    whoever_launches_is_who_the_platform_says,
    the_roster_is_the_platforms,
    no_address_is_told_by_which_nobody_reaches_the_service,
    a_platform_shows_homeworks_wherever_it_has_its_pages,
);

const WRONG: &str = "wrong/specular-half-unnormalized--average.vert";

async fn a_platform_is_registered_and_a_homework_chosen(database: Database) {
    let (bench, platform) = bench(database, Clock::system()).await;
    let unknown = bench.get(&format!("/lti/login?iss={}&login_hint=1", encoded(&platform.issuer))).await;
    assert_eq!(unknown.problem(), "lti");
    let page = registered(&bench, &platform).await;
    assert_eq!(page.all("h1"), ["Registered"], "{}", page.text());
    let asked = platform.seen().registration.clone();
    assert_eq!(asked["initiate_login_uri"], "http://ggrade.example/lti/login");
    assert_eq!(asked["redirect_uris"], json!(["http://ggrade.example/lti/launch"]));
    assert_eq!(asked["token_endpoint_auth_method"], "private_key_jwt");
    assert!(asked["scope"].as_str().expect("scopes").contains("lti-ags/scope/score"));

    let points = request("PATCH", "/api/v1/assignments/ggsample06/settings", "application/json", "{\"points\": 40}");
    assert_eq!(bench.send(points).await.status, StatusCode::OK);
    let begun = begin(&bench, &platform, false).await;
    for (name, value) in [
        ("response_type", "id_token"),
        ("response_mode", "form_post"),
        ("scope", "openid"),
        ("prompt", "none"),
        ("client_id", CLIENT),
        ("login_hint", "42"),
        ("lti_message_hint", "hint"),
        ("redirect_uri", "http://ggrade.example/lti/launch"),
    ] {
        assert_eq!(begun.query[name], value, "{name}");
    }
    let mut claims = platform.claims(&begun.query["nonce"], "teacher", "Instructor");
    claims["https://purl.imsglobal.org/spec/lti/claim/message_type"] = json!("LtiDeepLinkingRequest");
    claims["https://purl.imsglobal.org/spec/lti-dl/claim/deep_linking_settings"] =
        json!({ "deep_link_return_url": format!("{}/return?id=1", platform.issuer), "data": "opaque" });
    let choice = answer(&bench, &begun, &platform.sign(&claims)).await;
    assert_eq!(choice.status, StatusCode::OK, "{}", choice.text());
    assert_eq!(choice.all("main button"), ["Gouraud shading"]);
    let policy = choice.header("content-security-policy");
    assert!(policy.contains(&format!("form-action {0};", platform.issuer)), "{policy}");
    let text = choice.text();
    assert!(text.contains(&format!("action=\"{}/return?id=1\"", platform.issuer)));
    let token = text.split("name=\"JWT\" value=\"").nth(1).and_then(|rest| rest.split('"').next()).expect("a token");
    let chosen = platform.checked(token, &platform.issuer);
    assert_eq!(chosen["https://purl.imsglobal.org/spec/lti-dl/claim/data"], "opaque");
    assert_eq!(chosen["https://purl.imsglobal.org/spec/lti/claim/deployment_id"], DEPLOYMENT);
    let item = &chosen["https://purl.imsglobal.org/spec/lti-dl/claim/content_items"][0];
    assert_eq!((&item["type"], &item["custom"]["assignment"]), (&json!("ltiResourceLink"), &json!("ggsample06")));
    assert_eq!(
        (&item["url"], &item["lineItem"]["scoreMaximum"]),
        (&json!("http://ggrade.example/a/ggsample06"), &json!(40.0))
    );
    bench.finish().await;
}

async fn whoever_launches_is_who_the_platform_says(database: Database) {
    let (bench, platform) = bench(database, Clock::system()).await;
    registered(&bench, &platform).await;
    let teacher = launch(&bench, &platform, "teacher", "Instructor").await;
    assert_eq!((teacher.status, teacher.header("location")), (StatusCode::SEE_OTHER, "/teacher"), "{}", teacher.text());
    let session = cookie(&teacher, "ggrade_teacher");
    let page = with_cookie(&bench, "/teacher", &session).await;
    assert_eq!((page.status, page.all("nav .who")), (StatusCode::OK, vec!["Logged in: Name of teacher".to_owned()]));
    assert_eq!(with_cookie(&bench, "/teacher/settings", &session).await.status, StatusCode::OK);
    let assistant = cookie(&launch(&bench, &platform, "ta", "TeachingAssistant").await, "ggrade_teacher");
    assert_eq!(with_cookie(&bench, "/teacher/settings", &assistant).await.status, StatusCode::FORBIDDEN);
    let student = launch(&bench, &platform, "s1", "Learner").await;
    assert_eq!((student.status, student.header("location")), (StatusCode::SEE_OTHER, "/a/ggsample06"));
    // Whoever taught at the same browser has left; who teaches and looks at the homework as a student does has not.
    assert_eq!(cookie(&student, "ggrade_teacher"), "ggrade_teacher=");
    let switched = launch(&bench, &platform, "teacher", "Learner").await;
    let set = switched.headers.get_all(header::SET_COOKIE).iter();
    assert!(set.into_iter().all(|line| !line.as_bytes().starts_with(b"ggrade_teacher")), "{switched:?}");
    let theirs = cookie(&student, "ggrade");
    assert_eq!(with_cookie(&bench, "/teacher", &theirs).await.header("location"), "/teacher/login");
    assert_eq!(hand_in(&bench, &theirs, right()).await.status, StatusCode::CREATED);
    let class = get(&bench, "/teacher").await;
    assert_eq!(class.all(".people tbody th"), ["S1 Name of s1"]);
    // A platform that counts its people sends their ids as numbers.
    let begun = begin(&bench, &platform, false).await;
    let mut claims = platform.claims(&begun.query["nonce"], "s7", "Learner");
    claims["sub"] = json!(7);
    let seventh = answer(&bench, &begun, &platform.sign(&claims)).await;
    assert_eq!((seventh.status, seventh.header("location")), (StatusCode::SEE_OTHER, "/a/ggsample06"));
    // The same person in another browser has their history; somebody else who says the same number is not them.
    let again = cookie(&launch(&bench, &platform, "s1", "Learner").await, "ggrade");
    assert!(with_cookie(&bench, "/", &again).await.text().contains("100"));
    let begun = begin(&bench, &platform, false).await;
    let mut claims = platform.claims(&begun.query["nonce"], "mallory", "Learner");
    claims["https://purl.imsglobal.org/spec/lti/claim/lis"]["person_sourcedid"] = json!("s1");
    let other = cookie(&answer(&bench, &begun, &platform.sign(&claims)).await, "ggrade");
    assert_eq!(hand_in(&bench, &other, sample(WRONG)).await.status, StatusCode::CREATED);
    let rows = get(&bench, "/teacher").await.all(".people tbody th");
    assert!(rows.len() == 2 && rows.iter().any(|row| row.starts_with("LTI-")), "{rows:?}");
    bench.finish().await;
}

async fn the_roster_is_the_platforms(database: Database) {
    let (bench, platform) = bench(database, Clock::system()).await;
    registered(&bench, &platform).await;
    launch(&bench, &platform, "teacher", "Instructor").await;
    let id = bench.state.store.platforms().await.expect("platforms")[0].id.clone();
    // A platform that shares no names takes none away.
    for is_nameless in [false, true] {
        platform.seen().is_nameless = is_nameless;
        let page = form(&bench, "/teacher/platforms", &format!("wish=roster&platform={id}&link=3")).await;
        assert!(page.text().contains("2 students are on the roster now."), "{}", page.text());
        let roster = bench.state.store.roster().await.expect("a roster");
        let lines: Vec<(&str, &str)> = roster.iter().map(|who| (who.number.as_str(), who.name.as_str())).collect();
        assert_eq!(lines, [("S1", "Name of s1"), ("S2", "Name of s2")]);
    }
    // It says both how many the platform lists and how many there are, and the roster's own addresses stay.
    assert_eq!(bench.state.store.roster().await.expect("a roster")[1].email, "s2@example.org");
    let file = "number,name,email\nS1,A,own@example.org\nS2,B,\nS9,C,\n";
    let put = request("PUT", "/api/v1/roster", "text/csv", file);
    assert_eq!(bench.send(put).await.status, StatusCode::OK);
    platform.seen().is_nameless = false;
    let page = form(&bench, "/teacher/platforms", &format!("wish=roster&platform={id}&link=3")).await;
    assert!(page.text().contains("The platform lists 2 students. 3 students are on the roster now."), "{page:?}");
    let japanese = form(&bench, "/teacher/platforms?lang=ja", &format!("wish=roster&platform={id}&link=3")).await;
    assert!(japanese.text().contains("学生は 2 人です。名簿は 3 人になりました。"), "{japanese:?}");
    let mails: Vec<String> =
        bench.state.store.roster().await.expect("a roster").into_iter().map(|student| student.email).collect();
    assert_eq!(mails, ["own@example.org", "s2@example.org", ""]);
    let put = request("PUT", "/api/v1/roster", "text/csv", "number,name\nS1,Name of s1\nS2,Name of s2\n");
    assert_eq!(bench.send(put).await.status, StatusCode::OK);
    // However its pages are named, the list is read to its end, or not at all.
    let fetch = async |next: &str| {
        platform.seen().next_page = Some(next.to_owned());
        form(&bench, "/teacher/platforms", &format!("wish=roster&platform={id}&link=3")).await.text()
    };
    for next in [
        "</memberships?page=2,50&x=a;b>; rel=\"next last\"",
        "</memberships?page=1>; rel=prev, <?page=2>; title=\"a, b\"; REL=\"next\"",
    ] {
        let page = fetch(next).await;
        assert!(page.contains("2 students are on the roster now."), "{next}: {page}");
    }
    for (next, why) in [("<http://127.0.0.1:1/>; rel=next", "another host"), ("<?x>; rel=next", "more than 100 pages")]
    {
        let page = fetch(next).await;
        assert!(page.contains(why) && page.contains("The roster was not changed."), "{next}: {page}");
    }
    // Who comes later is the one of the roster, and is let in without a code.
    let student = cookie(&launch(&bench, &platform, "s2", "Learner").await, "ggrade");
    assert_eq!(hand_in(&bench, &student, right()).await.status, StatusCode::CREATED);
    assert_eq!(get(&bench, "/teacher").await.all(".overview .lead"), ["1 of 2 have handed in"]);
    bench.finish().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn inside_a_platforms_page_cookies_are_its_own_and_nobody_else_shows_pages() {
    let config = Config { public_url: Some("https://ggrade.example".into()), ..config() };
    let bench = Bench::with(Database::sqlite(), config, crate::pool(), Clock::system()).await;
    let platform = Platform::start().await;
    let (issuer, at) = (encoded(&platform.issuer), |path: &str| encoded(&format!("{}/{path}", platform.issuer)));
    let wish = format!(
        "wish=add&name=M&issuer={issuer}&client_id={CLIENT}&deployment={DEPLOYMENT}&auth_url={}&token_url={}&keys_url={}",
        at("auth"),
        at("token"),
        at("jwks")
    );
    assert_eq!(form(&bench, "/teacher/platforms", &wish).await.status, StatusCode::SEE_OTHER);
    let insecure = wish.replace(&at("token"), "http%3A%2F%2Flms.example%2Ftoken");
    assert_eq!(form(&bench, "/teacher/platforms", &insecure).await.status, StatusCode::UNPROCESSABLE_ENTITY);
    for (framed, rest) in [(true, "SameSite=None; Secure; Partitioned"), (false, "SameSite=None; Secure")] {
        let begun = begin(&bench, &platform, framed).await;
        assert!(
            begun.cookie_line.starts_with("__Host-ggrade_launch_") && begun.cookie_line.ends_with(rest),
            "{}",
            begun.cookie_line
        );
        let token = platform.sign(&platform.claims(&begun.query["nonce"], "s1", "Learner"));
        let body = format!("id_token={}&state={}", encoded(&token), begun.query["state"]);
        let request = Request::post("/lti/launch")
            .header(header::CONTENT_TYPE, "application/x-www-form-urlencoded")
            .header("sec-fetch-dest", if framed { "iframe" } else { "document" })
            .header(header::COOKIE, &begun.cookie);
        let reply = bench.send(request.body(Body::from(body)).expect("a request")).await;
        assert_eq!(reply.status, StatusCode::SEE_OTHER, "{reply:?}");
        let lines: Vec<&str> =
            reply.headers.get_all(header::SET_COOKIE).iter().map(|line| line.to_str().expect("text")).collect();
        let ends = if framed { "SameSite=None; Secure; Partitioned" } else { "SameSite=Lax; Secure" };
        assert!(lines.iter().any(|line| line.starts_with("__Host-ggrade=") && line.ends_with(ends)), "{lines:?}");
    }
    // Who does not know its own address makes no link.
    let nameless = Bench::with(Database::sqlite(), crate::bench::config(), crate::pool(), Clock::system()).await;
    let refused = form(&nameless, "/teacher/platforms", "wish=link").await;
    assert_eq!(refused.status, StatusCode::UNPROCESSABLE_ENTITY);
    assert!(refused.all("[role=alert]")[0].contains("--public-url"), "{}", refused.text());
    nameless.finish().await;
    let framed = Request::get("/").header("sec-fetch-dest", "iframe").body(Body::empty()).expect("a request");
    let policy = bench.send(framed).await.header("content-security-policy").to_owned();
    assert!(policy.contains(&format!("frame-ancestors 'self' {}", platform.issuer)), "{policy}");
    assert!(bench.get("/").await.header("content-security-policy").contains("frame-ancestors 'none'"));
    // So are the pages that say that there is nothing, at whatever address.
    for address in ["/r/none", "/a/none", "/nothing/here"] {
        let lost = visit(&bench, address, "iframe", "").await;
        let policy = lost.header("content-security-policy");
        assert_eq!(lost.status, StatusCode::NOT_FOUND, "{address}");
        assert!(policy.contains(&format!("frame-ancestors 'self' {}", platform.issuer)), "{address}: {policy}");
        let policy = bench.get(address).await.header("content-security-policy").to_owned();
        assert!(policy.contains("frame-ancestors 'none'"), "{address}: {policy}");
    }
    bench.finish().await;
}

async fn a_platform_shows_homeworks_wherever_it_has_its_pages(database: Database) {
    let (bench, platform) = bench(database, Clock::system()).await;
    registered(&bench, &platform).await;
    let shown_by = async || {
        let framed = Request::get("/a/ggsample06").header("sec-fetch-dest", "iframe").body(Body::empty());
        let policy = bench.send(framed.expect("a request")).await.header("content-security-policy").to_owned();
        let origins = policy.split_once("frame-ancestors 'self' ").expect("who may show it").1;
        origins.split([' ', ';']).map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(shown_by().await, std::slice::from_ref(&platform.issuer));
    // One that signs people in elsewhere than where its pages are, as its links say.
    let begun = begin(&bench, &platform, false).await;
    let mut claims = platform.claims(&begun.query["nonce"], "s1", "Learner");
    claims["https://purl.imsglobal.org/spec/lti-nrps/claim/namesroleservice"]["context_memberships_url"] =
        json!("https://school.lms.example/api/members");
    let opened = answer(&bench, &begun, &platform.sign(&claims)).await;
    assert_eq!(opened.status, StatusCode::SEE_OTHER, "{}", opened.text());
    let at = |host: &str| encoded(&format!("https://{host}.example/x"));
    let wish = format!(
        "wish=add&issuer={}&client_id=c&auth_url={1}&token_url={1}&keys_url={1}",
        encoded("https://lms-of-another.example"),
        at("sso-of-another")
    );
    assert_eq!(form(&bench, "/teacher/platforms", &wish).await.status, StatusCode::SEE_OTHER);
    let origins = shown_by().await;
    let (own, pages) = (platform.issuer.as_str(), "https://school.lms.example");
    assert_eq!(origins, [own, "https://lms-of-another.example", pages, "https://sso-of-another.example"]);
    let platforms = bench.state.store.platforms().await.expect("platforms");
    let first = &platforms.iter().find(|known| known.issuer == platform.issuer).expect("the first").id;
    form(&bench, "/teacher/platforms", &format!("wish=off&platform={first}")).await;
    assert_eq!(shown_by().await, ["https://lms-of-another.example", "https://sso-of-another.example"]);
    bench.finish().await;
}

async fn no_address_is_told_by_which_nobody_reaches_the_service(database: Database) {
    let bench = Bench::with(database, config(), crate::pool(), Clock::system()).await;
    let page = get(&bench, "/teacher/platforms?lang=en").await;
    assert!(page.text().contains("--public-url") && !page.text().contains("/lti/login"), "{}", page.text());
    let refused = form(&bench, "/teacher/platforms", "wish=link").await;
    assert_eq!(refused.status, StatusCode::UNPROCESSABLE_ENTITY);
    assert!(!refused.text().contains("<details open>"), "nothing was typed: {}", refused.text());
    let plain = "wish=add&issuer=x&client_id=x&auth_url=http%3A%2F%2Fmoodle.example&token_url=x&keys_url=x";
    let refused = form(&bench, "/teacher/platforms?lang=ja", plain).await;
    assert_eq!(refused.all("#wrong"), ["http://moodle.example は https のアドレスではありません。"]);
    // A platform that was known before is not told of an address that whoever asks made up.
    let known =
        plain.replace("http%3A%2F%2Fmoodle", "https%3A%2F%2Fmoodle").replace("=x&", "=https%3A%2F%2Fx.example&");
    let known = known.replace("keys_url=x", "keys_url=https%3A%2F%2Fx.example");
    assert_eq!(form(&bench, "/teacher/platforms", &known).await.status, StatusCode::SEE_OTHER);
    let launch = bench.get(&format!("/lti/login?iss={}&login_hint=1", encoded("https://x.example"))).await;
    assert_eq!(launch.status, StatusCode::UNPROCESSABLE_ENTITY);
    assert!(launch.header("location").is_empty() && launch.text().contains("--public-url"), "{}", launch.text());
}
