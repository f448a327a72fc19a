//! Programs come in by tokens of people: as far as the token goes, in its owner's name, until it ends.

use crate::bench::{Bench, Reply};
use crate::cluster::Database;
use crate::on_both;
use crate::staff::{Browser, OWN, administrator, bench};
use axum::body::Body;
use axum::http::{Method, Request, StatusCode, header};
use ggrade::service::clock::Clock;
use std::time::Duration;

on_both!(
    a_token_is_of_the_course_where_it_was_made,
    a_token_of_an_administrator_is_good_in_every_course,
    a_token_does_what_its_scope_says_in_its_owners_name,
    a_token_ends_by_its_day_by_its_owner_and_with_the_account,
    a_token_is_refused_where_it_makes_no_sense,
);

const DAY: Duration = Duration::from_secs(24 * 3600);

/// What a program gets that sends a token.
async fn program(bench: &Bench, token: &str, method: Method, address: &str) -> Reply {
    let request =
        Request::builder().method(method).uri(address).header(header::AUTHORIZATION, format!("Bearer {token}"));
    let request = request.header(header::CONTENT_TYPE, "text/plain");
    bench.send(request.body(Body::from("a shader")).expect("a request")).await
}

async fn a_token_is_of_the_course_where_it_was_made(database: Database) {
    let bench = bench(database, Clock::system()).await;
    crate::courses::made(&bench).await;
    let mut first = administrator(&bench).await;
    let page = "/c/cg-2027/teacher/tokens";
    let shown = first.form(page, page, "name=figures&scope=all&days=30").await;
    assert!(first.get(page).await.text().contains("prof@example.ac.jp"));
    let secret = shown.all(".notice .link code")[0].clone();
    let class = "/api/v1/class/files/csv";
    for (course, status) in [("/c/cg-2027", StatusCode::OK), ("", StatusCode::UNAUTHORIZED)] {
        assert_eq!(program(&bench, &secret, Method::GET, &format!("{course}{class}")).await.status, status, "{course}");
    }
}

async fn a_token_of_an_administrator_is_good_in_every_course(database: Database) {
    let bench = bench(database, Clock::system()).await;
    crate::courses::made(&bench).await;
    let mut first = administrator(&bench).await;
    let mut lecturer = first.let_in("hanako", "lecturer").await;
    let all = make(&mut first, "name=term&scope=all&days=30").await;
    let read = make(&mut first, "name=figures&scope=read&days=30").await;
    let one = make(&mut first, "name=one&scope=all&days=30&assignment=ggsample06").await;
    let lecturers = make(&mut lecturer, "name=mine&scope=all&days=30").await;
    let plan = "/c/cg-2027/api/v1/plan";
    for (token, status) in [(&all, 200), (&read, 401), (&one, 401), (&lecturers, 401)] {
        let reply = program(&bench, token, Method::GET, plan).await;
        assert_eq!(reply.status.as_u16(), status, "{}", reply.text());
    }
    let made = program(&bench, &all, Method::POST, "/c/cg-2027/api/v1/course/link").await;
    assert_eq!(made.status, StatusCode::OK, "{}", made.text());
    let rows = first.get("/c/cg-2027/teacher/log").await.all(".people tbody tr");
    assert!(rows[0].contains("prof@example.ac.jp (by a token)"), "{rows:?}");
    // With the token it ends there as well.
    let id = program(&bench, &all, Method::GET, "/api/v1/tokens").await.json()["tokens"]
        .as_array()
        .and_then(|tokens| tokens.iter().find(|token| token["name"] == "term").cloned())
        .expect("a token")["id"]
        .as_str()
        .expect("an id")
        .to_owned();
    assert_eq!(first.form("/teacher/tokens", &format!("/teacher/tokens/{id}"), "").await.status, StatusCode::SEE_OTHER);
    assert_eq!(program(&bench, &all, Method::GET, plan).await.status, StatusCode::UNAUTHORIZED);
    bench.finish().await;
}

/// Makes a token by the page.
async fn make(browser: &mut Browser<'_>, fields: &str) -> String {
    let page = browser.form("/teacher/tokens", "/teacher/tokens", fields).await;
    assert_eq!(page.status, StatusCode::OK, "{}", page.text());
    let secret = page.all(".notice .link code")[0].clone();
    assert!(secret.starts_with("ggrade_"), "{secret}");
    assert!(!browser.get("/teacher/tokens").await.text().contains(&secret), "it is shown once");
    secret
}

async fn a_token_does_what_its_scope_says_in_its_owners_name(database: Database) {
    let bench = bench(database, Clock::system()).await;
    let handed_in = bench.hand_in("", "x").await.id();
    let mut first = administrator(&bench).await;
    let mut lecturer = first.let_in("hanako", "lecturer").await;
    let mut assistant = lecturer.let_in("taro", "assistant").await;
    let refused = assistant.form("/teacher/tokens", "/teacher/tokens", "name=x&scope=submit&days=3").await;
    assert_eq!(refused.status, StatusCode::FORBIDDEN);
    let offered = assistant.get("/teacher/tokens").await.all("#scope option").len();
    assert_eq!((offered, lecturer.get("/teacher/tokens").await.all("#scope option").len()), (2, 3));
    let read = make(&mut lecturer, "name=figures&scope=read&days=30").await;
    let submit = make(&mut lecturer, "name=CI&scope=submit&days=30").await;
    let all = make(&mut lecturer, "name=script&scope=all&days=30").await;
    let assistants = make(&mut assistant, "name=mine&scope=all&days=30").await;

    let class = "/api/v1/class/files/csv";
    let delete = format!("/api/v1/submissions/{handed_in}");
    let hand_in = "/api/v1/submissions?student=s1";
    let cases = [
        (&read, Method::GET, class, 200),
        (&read, Method::POST, hand_in, 403),
        (&read, Method::DELETE, &delete, 403),
        (&submit, Method::GET, class, 200),
        (&submit, Method::POST, hand_in, 201),
        (&submit, Method::DELETE, &delete, 403),
        // With the secrets of students it would do more than read.
        (&read, Method::GET, "/api/v1/codes", 403),
        (&submit, Method::GET, "/teacher/codes/file", 403),
        (&read, Method::GET, "/teacher/settings", 403),
        (&read, Method::GET, "/api/v1/course", 200),
        (&all, Method::GET, "/api/v1/codes", 200),
        // Never more than its owner may do.
        (&assistants, Method::GET, class, 200),
        (&assistants, Method::POST, hand_in, 403),
        (&assistants, Method::DELETE, &delete, 403),
        (&all, Method::DELETE, &delete, 200),
    ];
    for (token, method, address, status) in cases {
        let reply = program(&bench, token, method.clone(), address).await;
        assert_eq!(reply.status.as_u16(), status, "{method} {address}: {}", reply.text());
        assert!(status != 403 || ["scope", "role"].contains(&reply.problem().as_str()), "{}", reply.text());
    }
    let link = async |token: &str| program(&bench, token, Method::GET, "/api/v1/course").await.json()["link"].clone();
    assert!(link(&read).await.is_null() && link(&submit).await.is_null() && link(&all).await.is_string());
    let rows = lecturer.get("/teacher/log").await.all(".people tbody tr");
    assert!(rows[0].contains("hanako (by a token)") && rows[0].contains("Deleted"), "{rows:?}");
    assert!(rows[1].contains("hanako (by a token)") && rows[1].contains("S1"), "{rows:?}");
    assert!(rows.iter().any(|row| row.contains("Made or ended a token") && row.contains("CI (submit)")), "{rows:?}");
    // Assistants who read pseudonyms read no names by a token either.
    let saved = first.form("/teacher/data", "/teacher/data", "pseudonyms=on").await;
    assert_eq!(saved.status, StatusCode::SEE_OTHER);
    let refused = program(&bench, &assistants, Method::GET, class).await;
    assert_eq!((refused.status, refused.problem().as_str()), (StatusCode::FORBIDDEN, "names"));
    assert_eq!(program(&bench, &assistants, Method::GET, "/api/v1/tokens").await.status, StatusCode::OK);
    bench.finish().await;
}

async fn a_token_ends_by_its_day_by_its_owner_and_with_the_account(database: Database) {
    let clock = Clock::fixed(1_700_000_000_000);
    let bench = bench(database, clock.clone()).await;
    let mut first = administrator(&bench).await;
    let mut lecturer = first.let_in("hanako", "lecturer").await;
    clock.advance(Duration::from_secs(60));
    let mut other = first.let_in("jiro", "lecturer").await;
    let short = make(&mut lecturer, "name=short&scope=read&days=1").await;
    let ended = make(&mut lecturer, "name=ended&scope=read&days=30").await;
    let kept = make(&mut lecturer, "name=kept&scope=all&days=30").await;
    let works =
        async |token: &str| program(&bench, token, Method::GET, "/api/v1/tokens").await.status == StatusCode::OK;
    assert!(works(&short).await && works(&ended).await);
    clock.advance(DAY - Duration::from_secs(1));
    assert!(works(&short).await);
    clock.advance(Duration::from_secs(1));
    assert!(!works(&short).await);

    // Sessions have ended meanwhile.
    for (browser, login) in [(&mut first, "prof@example.ac.jp"), (&mut other, "jiro")] {
        assert_eq!(browser.login(login, OWN).await.status, StatusCode::SEE_OTHER);
    }
    // Its owner sees which there are, and when each was used; another lecturer sees none of them, an administrator all.
    let list = async |token: &str| {
        let list = program(&bench, token, Method::GET, "/api/v1/tokens").await.json();
        list["tokens"].as_array().expect("a list").clone()
    };
    let tokens = list(&kept).await;
    let of = |name: &str| tokens.iter().find(|token| token["name"] == name).expect("a token").clone();
    assert_eq!(tokens.len(), 2, "{tokens:?}");
    assert_eq!((&of("ended")["owner"], &of("ended")["scope"]), (&"hanako".into(), &"read".into()));
    assert_eq!(of("ended")["last_used_at"], "2023-11-14T22:14:20Z", "used a day ago");
    let of_other = make(&mut other, "name=o&scope=all&days=366").await;
    assert_eq!(list(&of_other).await.len(), 1);
    let id = of("ended")["id"].as_str().expect("an id").to_owned();
    let address = format!("/api/v1/tokens/{id}");
    assert_eq!(program(&bench, &of_other, Method::DELETE, &address).await.status, StatusCode::NOT_FOUND);
    assert_eq!(program(&bench, &ended, Method::DELETE, &address).await.status, StatusCode::FORBIDDEN, "it reads only");
    assert_eq!(first.get("/teacher/tokens").await.all(".people tbody tr").len(), 3);
    assert_eq!(first.form("/teacher/tokens", &format!("/teacher/tokens/{id}"), "").await.status, StatusCode::SEE_OTHER);
    assert!(!works(&ended).await && works(&kept).await);

    // With the account every token of its owner ends, and opening it again revives none.
    let staff = bench.state.store.staff().await.expect("staff");
    let member = staff.iter().find(|member| member.login == "hanako").expect("a member");
    for change in ["change=close", "change=open"] {
        let done = first.form("/teacher/people", &format!("/teacher/people/{}", member.id), change).await;
        assert_eq!(done.status, StatusCode::SEE_OTHER);
        assert!(!works(&kept).await, "{change}");
    }
    bench.finish().await;
}

async fn a_token_is_refused_where_it_makes_no_sense(database: Database) {
    let bench = bench(database, Clock::system()).await;
    let mut first = administrator(&bench).await;
    let wrong = [
        ("name=&scope=read&days=3", "Give the token a name"),
        ("name=x&scope=read&days=0", "from 1 to 366 days"),
        ("name=x&scope=read&days=367", "from 1 to 366 days"),
        ("name=x&scope=read&days=ever", "from 1 to 366 days"),
    ];
    for (fields, said) in wrong {
        let page = first.form("/teacher/tokens", "/teacher/tokens", fields).await;
        assert_eq!(page.status, StatusCode::UNPROCESSABLE_ENTITY, "{fields}");
        assert!(page.all("[role=alert]")[0].contains(said), "{fields}: {:?}", page.all("[role=alert]"));
    }
    let nowhere = first.form("/teacher/tokens", "/teacher/tokens", "name=x&assignment=nowhere&days=3").await;
    assert_eq!(nowhere.status, StatusCode::NOT_FOUND);
    // A program makes no tokens, and a token of one homework opens nothing of the whole course.
    let all = make(&mut first, "name=all&scope=all&days=3").await;
    let refused = program(&bench, &all, Method::POST, "/teacher/tokens").await;
    assert!(refused.status.is_client_error(), "{}", refused.status);
    let one = make(&mut first, "name=one&scope=all&days=3&assignment=ggsample06").await;
    assert_eq!(program(&bench, &one, Method::GET, "/api/v1/class/files/csv").await.status, StatusCode::OK);
    assert_eq!(program(&bench, &one, Method::GET, "/teacher/people").await.status, StatusCode::FORBIDDEN);
    assert_eq!(program(&bench, "ggrade_0", Method::GET, "/api/v1/class/files/csv").await.status, 401);
    bench.finish().await;
}
