//! Who somebody of a platform is here, as the platform and the course change.

use super::launch::{answer, begin, bench, cookie, hand_in, launch, registered, with_cookie};
use crate::bench::Reply;
use crate::cluster::Database;
use crate::roster::{file, form};
use crate::{on_both, right};
use axum::body::Body;
use axum::http::{Request, StatusCode, header};
use ggrade::service::clock::Clock;
use ggrade::service::identity;
use serde_json::{Value, json};
use std::time::Duration;

on_both!(
    only_who_learns_is_a_student,
    what_a_platform_need_not_say_may_be_anything,
    whoever_the_platform_has_stands_on_a_roster_that_came_later,
    a_number_that_somebody_holds_is_given_for_its_code_alone,
    a_role_is_the_one_that_the_platform_says_unless_a_person_gave_it,
);

async fn only_who_learns_is_a_student(database: Database) {
    let (bench, platform) = bench(database, Clock::system()).await;
    registered(&bench, &platform).await;
    let launch_as = async |subject: &str, roles: Value| {
        let begun = begin(&bench, &platform, false).await;
        let mut claims = platform.claims(&begun.query["nonce"], subject, "Learner");
        claims["https://purl.imsglobal.org/spec/lti/claim/roles"] = roles;
        answer(&bench, &begun, &platform.sign(&claims)).await
    };
    let role = |name: &str| format!("http://purl.imsglobal.org/vocab/lis/v2/{name}");
    // A parent who observes, and who is something elsewhere than in the course.
    for (subject, roles) in [
        ("s1", json!([role("membership#Mentor")])),
        ("s2", json!([role("membership#ContentDeveloper")])),
        ("s3", json!([role("institution/person#Administrator"), role("system/person#Administrator")])),
        ("s4", json!([])),
    ] {
        let refused = launch_as(subject, roles).await;
        assert_eq!(refused.status, StatusCode::FORBIDDEN, "{subject}");
        assert!(refused.text().contains("neither a student nor one of those who teach"), "{}", refused.text());
    }
    assert!(bench.state.store.students().await.expect("students").is_empty());
    for (subject, roles) in [
        ("s5", json!([role("membership/Learner#Instructor")])),
        ("s6", json!([role("membership#Learner"), role("institution/person#Instructor")])),
        ("s7", json!([role("membership#Mentor"), role("membership#Learner")])),
    ] {
        let opened = launch_as(subject, roles).await;
        assert_eq!(opened.header("location"), "/a/ggsample06", "{subject}: {}", opened.text());
    }
    bench.finish().await;
}

async fn what_a_platform_need_not_say_may_be_anything(database: Database) {
    let (bench, platform) = bench(database, Clock::system()).await;
    registered(&bench, &platform).await;
    let claim = |name: &str| format!("https://purl.imsglobal.org/spec/lti/claim/{name}");
    for (number, (name, value)) in [
        (claim("custom"), json!([])),
        (claim("custom"), Value::Null),
        (claim("lis"), json!([])),
        (claim("lis"), json!({ "person_sourcedid": 14 })),
        (claim("ext"), json!({ "user_username": ["x"] })),
        (claim("target_link_uri"), json!(5)),
        (claim("context"), json!({ "id": "course-2", "title": 5, "label": [] })),
        ("name".to_owned(), json!({})),
        ("https://purl.imsglobal.org/spec/lti-ags/claim/endpoint".to_owned(), json!([])),
        ("https://purl.imsglobal.org/spec/lti-nrps/claim/namesroleservice".to_owned(), json!("")),
    ]
    .into_iter()
    .enumerate()
    {
        let begun = begin(&bench, &platform, false).await;
        let mut claims = platform.claims(&begun.query["nonce"], &format!("s{number}"), "Learner");
        claims[&name] = value;
        let opened = answer(&bench, &begun, &platform.sign(&claims)).await;
        assert_eq!(opened.header("location"), "/a/ggsample06", "{name}: {}", opened.text());
    }
    let begun = begin(&bench, &platform, false).await;
    let mut claims = platform.claims(&begun.query["nonce"], "s99", "Learner");
    claims[claim("roles")] = Value::Null;
    let refused = answer(&bench, &begun, &platform.sign(&claims)).await;
    assert!(refused.text().contains("neither a student nor one of those who teach"), "{}", refused.text());
    bench.finish().await;
}

async fn whoever_the_platform_has_stands_on_a_roster_that_came_later(database: Database) {
    let (bench, platform) = bench(database, Clock::system()).await;
    registered(&bench, &platform).await;
    let before = cookie(&launch(&bench, &platform, "s1", "Learner").await, "ggrade");
    file(&bench, "/teacher/roster", "roster", "r.csv", b"number,name\nS9,Ito\n").await;
    let refused = hand_in(&bench, &before, right()).await;
    assert_eq!(refused.problem(), "not-on-roster");
    assert!(refused.text().contains("learning platform"), "nobody typed a number: {}", refused.text());
    // Whether they were there before or not, they are let in from the platform.
    for student in ["s1", "s2"] {
        let theirs = cookie(&launch(&bench, &platform, student, "Learner").await, "ggrade");
        assert_eq!(hand_in(&bench, &theirs, right()).await.status, StatusCode::CREATED, "{student}");
    }
    let roster = bench.state.store.roster().await.expect("a roster");
    let numbers: Vec<&str> = roster.iter().map(|student| student.number.as_str()).collect();
    assert_eq!(numbers, ["S1", "S2", "S9"]);
    bench.finish().await;
}

async fn a_number_that_somebody_holds_is_given_for_its_code_alone(database: Database) {
    let now = i64::try_from(jsonwebtoken::get_current_timestamp()).expect("a time") * 1000;
    let clock = Clock::fixed(now);
    let (bench, platform) = bench(database, clock.clone()).await;
    registered(&bench, &platform).await;
    launch(&bench, &platform, "teacher", "Instructor").await;
    file(&bench, "/teacher/roster", "roster", "r.csv", b"number,name\nS1,Ito\nS2,Abe\nS3,Oka\n").await;
    let secret = identity::course_secret(&bench.state).await.expect("a link");
    let mut codes = Vec::new();
    for number in ["S1", "S2"] {
        let student = bench.state.store.student_by_number(number).await.expect("a store").expect("a student");
        let code = identity::personal_code(&bench.state, &student);
        let query = format!("?student={number}&course={secret}&code={code}");
        assert_eq!(bench.hand_in(&query, right()).await.status, StatusCode::CREATED, "{number}");
        codes.push(code);
    }
    // Nothing of it shows to who says the number at the platform, where people may write it themselves.
    let send = async |page: &Reply, wish: &str, site: &str| {
        let text = page.text();
        let field = |name: &str| text.split(&format!("name=\"{name}\" value=\"")).nth(1)?.split('"').next();
        let (claim, csrf) = (field("claim").expect("a claim"), field("csrf").expect("a token"));
        let request = Request::post("/lti/number").header(header::CONTENT_TYPE, "application/x-www-form-urlencoded");
        let request = request.header("sec-fetch-site", site).header(header::ACCEPT_LANGUAGE, "en");
        let request = request.header(header::ACCEPT, "text/html");
        let body = Body::from(format!("claim={claim}&csrf={csrf}&{wish}"));
        bench.send(request.body(body).expect("a request")).await
    };
    let number = async |reply: &Reply| {
        assert_eq!(reply.header("location"), "/a/ggsample06", "{}", reply.text());
        with_cookie(&bench, "/a/ggsample06", &cookie(reply, "ggrade")).await.all(".top .who bdi").remove(0)
    };
    let asked = launch(&bench, &platform, "s1", "Learner").await;
    assert_eq!((asked.status, asked.all("h1")), (StatusCode::OK, vec!["Is this number yours?".to_owned()]));
    let wrong = send(&asked, &format!("wish=code&code={}", codes[1]), "same-origin").await;
    assert_eq!((wrong.status, wrong.all("h1")), (StatusCode::FORBIDDEN, vec!["Is this number yours?".to_owned()]));
    assert!(wrong.all("[role=alert]")[0].contains("not the personal code of S1"), "{}", wrong.text());
    let right_code = format!("wish=code&code={}", codes[0]);
    assert_eq!(send(&wrong, &right_code, "cross-site").await.status, StatusCode::FORBIDDEN);
    assert_eq!(number(&send(&wrong, &right_code, "same-origin").await).await, "S1");
    // It is asked once.
    assert_eq!(number(&launch(&bench, &platform, "s1", "Learner").await).await, "S1");
    // Whoever has no code goes on under a number that is nobody else's.
    let asked = launch(&bench, &platform, "s2", "Learner").await;
    let own = number(&send(&asked, "wish=own", "same-origin").await).await;
    assert!(own.starts_with("LTI-"), "{own}");
    assert_eq!(number(&launch(&bench, &platform, "s2", "Learner").await).await, own);
    assert_eq!(number(&launch(&bench, &platform, "s3", "Learner").await).await, "S3", "nobody holds it");
    // A page that was left open is good for nothing.
    clock.advance(Duration::from_secs(601));
    assert!(send(&asked, "wish=own", "same-origin").await.text().contains("older than ten minutes"));
    bench.finish().await;
}

async fn a_role_is_the_one_that_the_platform_says_unless_a_person_gave_it(database: Database) {
    let (bench, platform) = bench(database, Clock::system()).await;
    registered(&bench, &platform).await;
    // What whoever launches with this role gets of the settings, which a lecturer sees and an assistant does not.
    let settings = async |subject: &str, role: &str| {
        let session = cookie(&launch(&bench, &platform, subject, role).await, "ggrade_teacher");
        with_cookie(&bench, "/teacher/settings", &session).await.status
    };
    for (role, status) in [("Instructor", 200), ("TeachingAssistant", 403), ("Instructor", 200)] {
        assert_eq!(settings("s1", role).await.as_u16(), status, "{role}");
    }
    let session = cookie(&launch(&bench, &platform, "ta", "TeachingAssistant").await, "ggrade_teacher");
    let staff = bench.state.store.staff().await.expect("staff");
    let id = &staff.iter().find(|member| member.name == "Name of ta").expect("an account").id;
    let given = form(&bench, &format!("/teacher/people/{id}"), "change=lecturer").await;
    assert_eq!(given.status, StatusCode::SEE_OTHER);
    assert_eq!(settings("ta", "TeachingAssistant").await, StatusCode::OK, "an administrator gave it");
    // Who comes without a role teaches no more by the platform's word; a person's word stays.
    for subject in ["s1", "ta"] {
        assert_eq!(launch(&bench, &platform, subject, "Mentor").await.status, StatusCode::FORBIDDEN);
    }
    let members = async || {
        let staff = bench.state.store.staff().await.expect("staff");
        staff.into_iter().map(|member| member.name).collect::<Vec<_>>()
    };
    assert_eq!(members().await, ["Name of ta"]);
    assert_eq!(with_cookie(&bench, "/teacher/settings", &session).await.status, StatusCode::OK);
    // Nor does whom the platform's list has as a student.
    assert_eq!(settings("s1", "Instructor").await, StatusCode::OK);
    let platform_id = bench.state.store.platforms().await.expect("platforms")[0].id.clone();
    let fetched = form(&bench, "/teacher/platforms", &format!("wish=roster&platform={platform_id}&link=3")).await;
    assert!(fetched.text().contains("2 students are on the roster now."), "{}", fetched.text());
    assert_eq!(members().await, ["Name of ta"]);
    bench.finish().await;
}
