//! Several courses in one service: each has homeworks, people and a gradebook of its own, and none sees another.

mod terms;

use crate::bench::{Bench, TEACHER};
use crate::cluster::Database;
use crate::staff::{Browser, administrator, bench};
use crate::{on_both, right_and_new};
use axum::body::Body;
use axum::http::{Request, StatusCode, header};
use ggrade::service::Service;
use ggrade::service::clock::Clock;
use ggrade::service::identity::{course_secret, personal_code};
use ggrade::service::store::RosterLine;
use reference::assignment;

on_both!(
    a_course_grades_and_counts_for_itself,
    who_teaches_one_course_sees_no_other,
    a_student_of_one_course_is_nobody_in_another,
    what_is_not_shown_is_not_found,
);

/// The second homework of the courses here.
const OTHER: &str = "phong";

/// Everything that a lecturer changes here goes by this page.
const PLAN: &str = "/c/cg-2027/teacher/plan";

/// Lets the teacher's program do something.
async fn program(bench: &Bench, method: &str, address: &str, kind: &str, body: impl Into<Body>) -> crate::bench::Reply {
    let request = Request::builder().method(method).uri(address).header(header::CONTENT_TYPE, kind);
    let request = request.header(header::AUTHORIZATION, format!("Bearer {TEACHER}"));
    bench.send(request.header(header::ACCEPT_LANGUAGE, "en").body(body.into()).expect("a request")).await
}

/// A form that the teacher's program sends.
async fn form(bench: &Bench, address: &str, fields: &str) -> crate::bench::Reply {
    program(bench, "POST", address, "application/x-www-form-urlencoded", fields.to_owned()).await
}

/// Makes the course of these tests, with a homework.
pub async fn made(bench: &Bench) -> Service {
    let made = form(bench, "/teacher/courses", "wish=make&id=cg-2027&title=Graphics+2027").await;
    assert_eq!((made.status, made.header("location")), (StatusCode::SEE_OTHER, PLAN));
    let planned = form(bench, PLAN, "add.ggsample06=on").await;
    assert_eq!((planned.status, planned.header("location")), (StatusCode::SEE_OTHER, PLAN));
    bench.state.course("cg-2027").expect("a course")
}

/// Sets a roster of a course.
async fn enrol(course: &Service, numbers: &[&str]) {
    let line =
        |number: &&str| RosterLine { number: (*number).to_owned(), name: "N".to_owned(), ..RosterLine::default() };
    let roster: Vec<RosterLine> = numbers.iter().map(line).collect();
    course.store.set_roster(&roster, 1).await.expect("a roster");
}

async fn a_course_grades_and_counts_for_itself(database: Database) {
    let bench = Bench::new(database).await;
    for wrong in ["wish=make&id=CG&title=T", "wish=make&id=..&title=T", "wish=copy&id=x&title=T&of=&days=many"] {
        assert_eq!(form(&bench, "/teacher/courses", wrong).await.status, StatusCode::UNPROCESSABLE_ENTITY, "{wrong}");
    }
    let course = made(&bench).await;
    let again = form(&bench, "/teacher/courses", "wish=make&id=cg-2027&title=T").await;
    assert_eq!(again.status, StatusCode::UNPROCESSABLE_ENTITY);
    assert!(assignment(OTHER).is_some(), "built in");
    let fields = format!("add.{OTHER}=on&position.ggsample06=1&points.ggsample06=40&seen.ggsample06=shown");
    assert_eq!(form(&bench, PLAN, &fields).await.status, StatusCode::SEE_OTHER);
    let fields = format!("position.ggsample06=2&position.{OTHER}=1&points.{OTHER}=10");
    assert_eq!(form(&bench, PLAN, &fields).await.status, StatusCode::SEE_OTHER);
    assert_eq!(course.ids(), [OTHER, "ggsample06"]);
    let wrong = form(&bench, PLAN, "points.ggsample06=many").await;
    assert_eq!(wrong.status, StatusCode::UNPROCESSABLE_ENTITY);
    enrol(&course, &["S1", "S2"]).await;

    // What is handed in there is graded there, stands there, and leads to addresses there.
    let address = "/c/cg-2027/api/v1/submissions?assignment=ggsample06&student=S1";
    let graded = program(&bench, "POST", address, "text/plain", right_and_new()).await;
    assert_eq!(graded.json()["report"]["verdict"], "correct", "{graded:?}");
    let links = graded.json()["links"].clone();
    let page = format!("/c/cg-2027/r/{}", graded.id());
    assert_eq!(links["page"], page.as_str());
    assert!(links["frames"].as_str().expect("a link").starts_with("/c/cg-2027/api/v1/submissions/"), "{links}");
    let shown = bench.get(&page).await;
    assert_eq!(shown.status, StatusCode::OK);
    for link in ["href=\"/c/cg-2027/privacy\"", "href=\"/c/cg-2027/\"", "hreflang=\"en\""] {
        assert!(shown.text().contains(link), "{link}");
    }
    let outside = ["href=\"/r/", "href=\"/a/", "action=\"/r/", "action=\"/a/", "src=\"/r/"];
    assert_eq!(outside.into_iter().find(|link| shown.text().contains(link)), None);
    assert_eq!(bench.get(&format!("/r/{}", graded.id())).await.status, StatusCode::NOT_FOUND);
    assert_eq!(program(&bench, "GET", "/teacher/gradebook/file", "", "").await.text().lines().count(), 2);

    let book = program(&bench, "GET", "/c/cg-2027/teacher/gradebook/file", "", "").await;
    let lines: Vec<String> = book.text().trim_start_matches('\u{feff}').lines().map(str::to_owned).collect();
    let head = format!("student,name,{OTHER},ggsample06,total");
    assert_eq!(lines, [head.as_str(), ",,10,40,50", "S1,N,,40,40", "S2,N,,,0"]);
    let table = program(&bench, "GET", "/c/cg-2027/teacher/gradebook", "", "").await;
    assert_eq!(table.all("tbody tr").len(), 2);

    // All of it is there after a restart, and the first course is what it was.
    drop(course);
    let sample = vec![std::sync::Arc::clone(assignment("ggsample06").expect("built in"))];
    let bench = bench.restarted(sample).await;
    let course = bench.state.course("cg-2027").expect("a course");
    assert_eq!(course.ids(), [OTHER, "ggsample06"]);
    assert_eq!(course.store.course().await.expect("a course").title, "Graphics 2027");
    assert_eq!(bench.get(&page).await.status, StatusCode::OK);
    assert!(bench.state.store.students().await.expect("students").is_empty());
    assert_eq!(bench.get("/c/nowhere/").await.status, StatusCode::NOT_FOUND);
    drop(course);
    bench.finish().await;
}

/// A lecturer of a course, let in there by an administrator.
async fn let_in<'a>(bench: &'a Bench, admin: &mut Browser<'_>, course: &str, login: &str) -> Browser<'a> {
    let people = format!("{course}/teacher/people");
    let page = admin.form(&people, &people, &format!("login={login}&name=N&role=lecturer")).await;
    let link = page.all(".link code")[0].clone();
    let address = &link[link.find(&format!("{course}/teacher/welcome/")).expect("a link")..];
    let mut browser = Browser::new(bench);
    let chosen = browser.form(address, address, "password=my+own+long+password").await;
    assert_eq!(
        (chosen.status, chosen.header("location")),
        (StatusCode::SEE_OTHER, format!("{course}/teacher").as_str())
    );
    browser
}

async fn who_teaches_one_course_sees_no_other(database: Database) {
    let bench = bench(database, Clock::fixed(1_801_436_400_000)).await;
    made(&bench).await;
    assert_eq!(form(&bench, "/teacher/courses", "wish=make&id=art&title=Art").await.status, StatusCode::SEE_OTHER);
    let mut admin = administrator(&bench).await;
    let mut of_graphics = let_in(&bench, &mut admin, "/c/cg-2027", "wada").await;
    let mut of_first = admin.let_in("mori", "lecturer").await;

    let own = of_graphics.get("/teacher/courses").await;
    assert_eq!(own.all("tbody th bdi"), ["Graphics 2027"]);
    assert_eq!(of_graphics.get("/c/cg-2027/teacher/people").await.status, StatusCode::OK);
    for (browser, others) in [(&mut of_graphics, ["", "/c/art"]), (&mut of_first, ["/c/cg-2027", "/c/art"])] {
        for course in others {
            for page in ["/teacher", "/teacher/people", "/teacher/log", "/teacher/gradebook/file", "/teacher/plan"] {
                let page = format!("{course}{page}");
                let seen = browser.get(&page).await;
                let login = format!("{course}/teacher/login");
                assert_eq!((seen.status, seen.header("location")), (StatusCode::SEE_OTHER, login.as_str()), "{page}");
            }
            let api = browser.get(&format!("{course}/api/v1/appeals?assignment=ggsample06")).await;
            assert_eq!(api.status, StatusCode::UNAUTHORIZED);
        }
    }
    // Nor do they make courses, administrators, or a way into somebody else's account.
    let page = "/c/cg-2027/teacher/people";
    let fields = "login=x&name=X&role=administrator";
    assert_eq!(of_graphics.form(page, page, fields).await.status, StatusCode::FORBIDDEN);
    assert_eq!(admin.form(page, page, fields).await.status, StatusCode::UNPROCESSABLE_ENTITY);
    let theirs = of_graphics.form(page, page, "login=mori&name=X&role=assistant").await;
    assert_eq!((theirs.status, theirs.header("location")), (StatusCode::SEE_OTHER, page));
    let mori = bench.state.store.account("mori").await.expect("an account").expect("an account").id;
    let link = of_graphics.form(page, &format!("{page}/{mori}"), "change=link").await;
    assert_eq!(link.status, StatusCode::FORBIDDEN);
    assert_eq!(
        of_graphics.form(page, "/teacher/courses", "wish=make&id=mine&title=M").await.status,
        StatusCode::SEE_OTHER
    );
    assert!(bench.state.course("mine").is_none());
    // One account teaches in both now, in each by its own role, and is an administrator in none.
    assert_eq!(of_first.get("/teacher/settings").await.status, StatusCode::OK);
    assert_eq!(of_first.get("/c/cg-2027/a/ggsample06/teacher").await.status, StatusCode::OK);
    assert_eq!(of_first.get(PLAN).await.status, StatusCode::FORBIDDEN);
    let closed = of_graphics.form(page, &format!("{page}/{mori}"), "change=close").await;
    assert_eq!(closed.header("location"), page);
    assert_eq!(of_first.get("/c/cg-2027/a/ggsample06/teacher").await.status, StatusCode::SEE_OTHER);
    assert_eq!(of_first.get("/teacher/settings").await.status, StatusCode::OK);
    // An administrator is one everywhere; each course has a log of its own.
    assert_eq!(admin.get("/c/art/teacher/people").await.status, StatusCode::OK);
    let log = admin.get("/c/cg-2027/teacher/log").await;
    assert!(log.text().contains("wada") && !admin.get("/c/art/teacher/log").await.text().contains("wada"));
    // So many logins of one address have to wait.
    bench.state.clock.advance(std::time::Duration::from_secs(120));
    // Who teaches elsewhere only is led there when they log in at the first course.
    let mut again = Browser::new(&bench);
    let entered = again.login("wada", "my own long password").await;
    assert_eq!(entered.header("location"), "/teacher/courses", "{entered:?}");
    bench.finish().await;
}

async fn a_student_of_one_course_is_nobody_in_another(database: Database) {
    let bench = Bench::new(database).await;
    let course = made(&bench).await;
    enrol(&course, &["S1"]).await;
    enrol(bench.state.service(), &["S1"]).await;
    let own = course.store.student_by_number("S1").await.expect("a student").expect("a student");
    let code = personal_code(&course, &own);
    let secret = course_secret(&course).await.expect("a secret");
    let mut browser = Browser::new(&bench);
    assert_eq!(
        browser.get(&format!("/join/{secret}")).await.status,
        StatusCode::NOT_FOUND,
        "the link of another course"
    );
    let link = format!("/c/cg-2027/join/{secret}");
    let joined = browser.form(&link, &link, &format!("number=S1&code={code}")).await;
    assert_eq!((joined.status, joined.header("location")), (StatusCode::SEE_OTHER, "/c/cg-2027/a/ggsample06"));
    assert!(browser.get("/c/cg-2027/").await.text().contains("S1"));
    assert!(!browser.get("/").await.text().contains("S1"), "the first course knows nobody there");
    // The code of one course proves nothing in another.
    let first = course_secret(bench.state.service()).await.expect("a secret");
    let link = format!("/join/{first}");
    let refused = browser.form(&link, &link, &format!("number=S1&code={code}")).await;
    assert_eq!(refused.status, StatusCode::FORBIDDEN);
    drop(course);
    bench.finish().await;
}

async fn what_is_not_shown_is_not_found(database: Database) {
    // 2027-02-01 08:00 in Tokyo.
    let clock = Clock::fixed(1_801_436_400_000);
    let bench = Bench::with(database, crate::bench::config(), crate::pool(), clock).await;
    made(&bench).await;
    let hidden = format!("seen.ggsample06=from&from.ggsample06=2027-02-01T09:00&add.{OTHER}=on");
    assert_eq!(form(&bench, PLAN, &hidden).await.status, StatusCode::SEE_OTHER);
    let page = "/c/cg-2027/a/ggsample06";
    let listed = async || bench.get("/c/cg-2027/").await.text().contains(page);
    let in_api = async || bench.get("/c/cg-2027/api/v1/assignments").await.text().contains("ggsample06");
    let submissions = "/c/cg-2027/api/v1/submissions?assignment=ggsample06";
    assert!(!listed().await && !in_api().await);
    assert_eq!(bench.get(page).await.status, StatusCode::NOT_FOUND);
    assert_eq!(bench.get(&format!("{page}/starter")).await.status, StatusCode::NOT_FOUND);
    let early = Request::post(submissions).header(header::CONTENT_TYPE, "text/plain");
    let early = bench.send(early.body(Body::from(right_and_new())).expect("a request")).await;
    assert_eq!((early.status, early.problem().as_str()), (StatusCode::NOT_FOUND, "not-shown"));
    assert_eq!(program(&bench, "GET", page, "", "").await.status, StatusCode::OK, "its teacher sees it");
    bench.state.clock.advance(std::time::Duration::from_secs(3600));
    assert!(listed().await && in_api().await);
    assert_eq!(bench.get(page).await.status, StatusCode::OK);
    let missing = form(&bench, PLAN, "seen.ggsample06=from&from.ggsample06=").await;
    assert_eq!(missing.status, StatusCode::UNPROCESSABLE_ENTITY);
    bench.finish().await;
}
