//! Courses of a platform and courses of the service.

use super::launch::{answer, begin, bench, cookie, encoded, launch, registered, with_cookie};
use super::platform::Platform;
use crate::bench::{Bench, Reply};
use crate::cluster::Database;
use crate::roster::{form, get};
use crate::{on_both, right};
use axum::body::Body;
use axum::http::{Request, StatusCode, header};
use ggrade::service::clock::Clock;
use ggrade::service::lti::scores::send_due;
use serde_json::{Value, json};

on_both!(
    nobody_comes_in_from_a_course_that_nobody_connected,
    a_course_that_is_in_use_is_connected_by_an_administrator_alone,
    a_platforms_course_leads_to_its_course_here,
    why_a_platform_is_not_reached_is_said,
);

/// A launch from another course of the platform.
async fn launch_from(bench: &Bench, platform: &Platform, (subject, role): (&str, &str), context: Value) -> Reply {
    let begun = begin(bench, platform, false).await;
    let mut claims = platform.claims(&begun.query["nonce"], subject, role);
    claims["https://purl.imsglobal.org/spec/lti/claim/context"] = context;
    answer(bench, &begun, &platform.sign(&claims)).await
}

/// Says to which course here a platform's course belongs.
async fn connect(bench: &Bench, context: &str, course: &str) -> Reply {
    let id = bench.state.store.platforms().await.expect("platforms")[0].id.clone();
    form(bench, "/teacher/platforms", &format!("wish=connect&platform={id}&context={context}&course={course}")).await
}

async fn nobody_comes_in_from_a_course_that_nobody_connected(database: Database) {
    let (bench, platform) = bench(database, Clock::system()).await;
    registered(&bench, &platform).await;
    let own = launch(&bench, &platform, "teacher", "Instructor").await;
    assert_eq!(own.status, StatusCode::SEE_OTHER, "the first course is connected by itself");
    // Whoever teaches something else at the same platform can link here, and comes in neither as a lecturer nor as a student.
    let theirs = json!({ "id": 9, "title": "Knitting" });
    for role in ["Instructor", "Learner"] {
        let refused = launch_from(&bench, &platform, ("mallory", role), theirs.clone()).await;
        assert_eq!(refused.status, StatusCode::FORBIDDEN, "{role}");
        assert!(refused.text().contains("The course “Knitting”"), "{}", refused.text());
        assert!(
            refused
                .headers
                .get_all(header::SET_COOKIE)
                .iter()
                .all(|line| !line.as_bytes().starts_with(b"ggrade_teacher="))
        );
    }
    assert!(bench.state.store.students().await.expect("students").is_empty());
    let page = get(&bench, "/teacher/platforms").await;
    assert!(page.all(".panel li").iter().any(|line| line.contains("Knitting")), "{}", page.text());
    assert_eq!(connect(&bench, "9", "").await.status, StatusCode::SEE_OTHER);
    let let_in = launch_from(&bench, &platform, ("mallory", "Learner"), theirs.clone()).await;
    assert_eq!(let_in.header("location"), "/a/ggsample06");
    assert_eq!(connect(&bench, "9", "-").await.status, StatusCode::SEE_OTHER);
    assert_eq!(launch_from(&bench, &platform, ("mallory", "Learner"), theirs).await.status, StatusCode::FORBIDDEN);
    bench.finish().await;
}

async fn a_course_that_is_in_use_is_connected_by_an_administrator_alone(database: Database) {
    let (bench, platform) = bench(database, Clock::system()).await;
    registered(&bench, &platform).await;
    assert_eq!(bench.hand_in("", right()).await.status, StatusCode::CREATED);
    // Whoever comes first may teach anything at the platform: the class is not theirs.
    for role in ["Instructor", "TeachingAssistant", "Learner"] {
        let refused = launch(&bench, &platform, "mallory", role).await;
        assert_eq!(refused.status, StatusCode::FORBIDDEN, "{role}");
        let text = refused.text();
        assert!(text.contains("course-2") && text.contains("http://ggrade.example/teacher/platforms"), "{text}");
    }
    assert!(bench.state.store.staff().await.expect("staff").is_empty());
    assert_eq!(connect(&bench, "course-2", "").await.status, StatusCode::SEE_OTHER);
    assert_eq!(launch(&bench, &platform, "teacher", "Instructor").await.header("location"), "/teacher");
    bench.finish().await;
}

async fn a_platforms_course_leads_to_its_course_here(database: Database) {
    let now = i64::try_from(jsonwebtoken::get_current_timestamp()).expect("a time") * 1000;
    let (bench, platform) = bench(database, Clock::fixed(now)).await;
    let course = crate::courses::made(&bench).await;
    registered(&bench, &platform).await;
    // With several courses somebody has to say which one it is.
    assert_eq!(launch(&bench, &platform, "teacher", "Instructor").await.status, StatusCode::FORBIDDEN);
    assert_eq!(connect(&bench, "course-2", "nowhere").await.status, StatusCode::NOT_FOUND);
    assert_eq!(connect(&bench, "course-2", "cg-2027").await.status, StatusCode::SEE_OTHER);

    let teacher = launch(&bench, &platform, "teacher", "Instructor").await;
    assert_eq!(teacher.header("location"), "/c/cg-2027/a/ggsample06/teacher", "{}", teacher.text());
    let session = cookie(&teacher, "ggrade_teacher");
    assert_eq!(with_cookie(&bench, "/c/cg-2027/a/ggsample06/teacher/settings", &session).await.status, StatusCode::OK);
    assert_eq!(with_cookie(&bench, "/teacher/settings", &session).await.header("location"), "/teacher/login");

    let begun = begin(&bench, &platform, false).await;
    let mut claims = platform.claims(&begun.query["nonce"], "teacher", "Instructor");
    claims["https://purl.imsglobal.org/spec/lti/claim/message_type"] = json!("LtiDeepLinkingRequest");
    claims["https://purl.imsglobal.org/spec/lti-dl/claim/deep_linking_settings"] =
        json!({ "deep_link_return_url": format!("{}/return", platform.issuer), "accept_multiple": true });
    let choice = answer(&bench, &begun, &platform.sign(&claims)).await;
    let text = choice.text();
    let token = text.split("name=\"JWT\" value=\"").nth(1).and_then(|rest| rest.split('"').next()).expect("a token");
    let chosen = platform.checked(token, &platform.issuer);
    let item = &chosen["https://purl.imsglobal.org/spec/lti-dl/claim/content_items"][0];
    assert_eq!(item["url"], "http://ggrade.example/c/cg-2027/a/ggsample06");

    let student = launch(&bench, &platform, "s1", "Learner").await;
    assert_eq!(student.header("location"), "/c/cg-2027/a/ggsample06");
    let theirs = cookie(&student, "ggrade_cg-2027");
    let request = Request::post("/c/cg-2027/api/v1/submissions?assignment=ggsample06").header(header::COOKIE, &theirs);
    let request = request.header(header::CONTENT_TYPE, "text/plain").header("sec-fetch-site", "same-origin");
    let handed_in = bench.send(request.body(Body::from(right())).expect("a request")).await;
    assert_eq!(handed_in.status, StatusCode::CREATED, "{handed_in:?}");
    // An administrator sees what waits where the platform is registered, whatever course it is of.
    platform.seen().failing = Some(StatusCode::SERVICE_UNAVAILABLE);
    send_due(&course).await;
    for page in ["/teacher/platforms", "/c/cg-2027/teacher/platforms"] {
        let page = get(&bench, page).await;
        assert!(page.text().contains("1 score has not arrived") && page.text().contains("503"), "{}", page.text());
    }
    platform.seen().failing = None;
    course.clock.advance(std::time::Duration::from_secs(6));
    send_due(&course).await;
    let scores = platform.seen().scores.clone();
    assert_eq!((scores.len(), &scores[0]["scoreGiven"]), (1, &json!(100.0)));
    assert!(scores[0]["comment"].as_str().expect("a comment").contains("http://ggrade.example/c/cg-2027/r/"));
    assert!(bench.state.store.students().await.expect("students").is_empty(), "nobody is in the first course");
    let id = bench.state.store.platforms().await.expect("platforms")[0].id.clone();
    let page = form(&bench, "/c/cg-2027/teacher/platforms", &format!("wish=roster&platform={id}&link=3")).await;
    assert!(page.text().contains("2 students are on the roster now."), "{}", page.text());
    // The course itself switches nothing of it, and begins no launch of its own.
    let off = form(&bench, "/c/cg-2027/teacher/platforms", &format!("wish=off&platform={id}")).await;
    assert_eq!(off.status, StatusCode::NOT_FOUND);
    let login = bench.get(&format!("/c/cg-2027/lti/login?iss={}&login_hint=1", encoded(&platform.issuer))).await;
    assert_eq!(login.problem(), "lti");
    // Connected with another course, its grades come from there alone.
    assert_eq!(connect(&bench, "course-2", "").await.status, StatusCode::SEE_OTHER);
    assert_eq!(launch(&bench, &platform, "s1", "Learner").await.header("location"), "/a/ggsample06");
    assert!(course.store.links().await.expect("links").is_empty());
    drop(course);
    bench.finish().await;
}

async fn why_a_platform_is_not_reached_is_said(database: Database) {
    let (bench, _platform) = bench(database, Clock::system()).await;
    let page = form(&bench, "/teacher/platforms", "wish=link").await;
    let link = page.all(".link code")[0].replace("http://ggrade.example", "");
    let nobody = encoded("http://127.0.0.1:1/openid-configuration");
    let refused = get(&bench, &format!("{link}?openid_configuration={nobody}")).await;
    assert_eq!(refused.status, StatusCode::FORBIDDEN);
    assert!(refused.text().contains("Connection refused"), "{}", refused.text());
    bench.finish().await;
}
