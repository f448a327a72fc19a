//! Courses of one term after the other: copies, archives, and who is alike over the terms.

use super::{OTHER, PLAN, enrol, form, let_in, made, program};
use crate::bench::Bench;
use crate::cluster::Database;
use crate::likeness::{ANSWER, disguised, text};
use crate::staff::{administrator, bench};
use crate::{on_both, right_and_new};
use axum::http::StatusCode;
use ggrade::service::clock::Clock;
use ggrade::service::store::{AssignmentSettings, Audience, RosterLine};
use reference::assignment;
use sqlx::{ConnectOptions, Connection};

on_both!(
    a_course_goes_on_in_the_next_term,
    a_copy_that_fails_in_the_middle_is_no_course,
    data_of_an_earlier_course_are_not_written_over,
    likeness_looks_at_last_terms_course_where_one_teaches_it,
);

async fn a_course_goes_on_in_the_next_term(database: Database) {
    let bench = Bench::new(database).await;
    let course = made(&bench).await;
    let day = 24 * 3_600_000;
    let fields = format!("add.{OTHER}=on&points.ggsample06=40&position.ggsample06=1");
    assert_eq!(form(&bench, PLAN, &fields).await.status, StatusCode::SEE_OTHER);
    assert_eq!(form(&bench, PLAN, &format!("position.{OTHER}=0")).await.status, StatusCode::SEE_OTHER);
    let rules = course.store.assignment("ggsample06").await.expect("rules");
    let (opens_at, closes_at) = (Some(1_700_000_000_000), Some(4_000_000_000_000));
    let rules = AssignmentSettings { opens_at, closes_at, practice: false, ..rules };
    course.store.set_assignment(&rules).await.expect("rules");
    enrol(&course, &["S1"]).await;
    let address = "/c/cg-2027/api/v1/submissions?assignment=ggsample06&student=S1";
    let graded = program(&bench, "POST", address, "text/plain", right_and_new()).await;

    let fields = "wish=copy&of=cg-2027&id=cg-2028&title=Graphics+2028&days=364";
    assert_eq!(form(&bench, "/teacher/courses", fields).await.header("location"), "/c/cg-2028/teacher/plan");
    let copy = bench.state.course("cg-2028").expect("a course");
    assert_eq!(copy.ids(), [OTHER, "ggsample06"]);
    let copied = copy.store.assignment("ggsample06").await.expect("rules");
    let shifted = |at: Option<i64>| at.map(|at| at + 364 * day);
    let expected = (shifted(opens_at), shifted(closes_at), false, rules.hints);
    assert_eq!((copied.opens_at, copied.closes_at, copied.practice, copied.hints), expected);
    assert_ne!(copied.seed, rules.seed, "another draw of the probes");
    let places = copy.store.places().await.expect("places");
    assert_eq!(places.iter().find(|place| place.id == "ggsample06").and_then(|place| place.points), Some(40.0));
    assert!(copy.store.students().await.expect("students").is_empty());
    assert_eq!(copied.audience, Audience::Number, "as in the course with a roster");
    assert_eq!(bench.get(&format!("/c/cg-2028/r/{}", graded.id())).await.status, StatusCode::NOT_FOUND);
    let fields = "wish=copy&of=cg-2027&id=dateless&title=D&days=";
    assert_eq!(form(&bench, "/teacher/courses", fields).await.status, StatusCode::SEE_OTHER);
    let dateless = bench.state.course("dateless").expect("a course");
    let rules = dateless.store.assignment("ggsample06").await.expect("rules");
    assert_eq!((rules.opens_at, rules.closes_at), (None, None));

    // The old one is archived: read, and no more, also where anybody may hand in.
    let rules = course.store.assignment("ggsample06").await.expect("rules");
    let open = AssignmentSettings { audience: Audience::Open, ..rules };
    course.store.set_assignment(&open).await.expect("rules");
    let page = format!("/c/cg-2027/r/{}", graded.id());
    assert!(bench.get("/c/cg-2027/a/ggsample06").await.text().contains("data-draft="));
    assert_eq!(form(&bench, "/teacher/courses", "wish=archive&of=cg-2027").await.status, StatusCode::SEE_OTHER);
    let late = program(&bench, "POST", address, "text/plain", right_and_new()).await;
    assert_eq!((late.status, late.problem().as_str()), (StatusCode::FORBIDDEN, "archived"));
    assert_eq!(bench.get(&page).await.status, StatusCode::OK);
    let desk = bench.get("/c/cg-2027/a/ggsample06").await;
    assert_eq!(desk.status, StatusCode::OK);
    assert!(desk.text().contains("archived") && !desk.text().contains("data-draft="), "{}", desk.text());
    for page in ["/c/cg-2027/a/ggsample06/teacher", "/c/cg-2027/teacher/gradebook", PLAN] {
        assert_eq!(program(&bench, "GET", page, "", "").await.status, StatusCode::OK, "{page}");
    }
    let changed = form(&bench, PLAN, "points.ggsample06=1").await;
    assert_eq!((changed.status, changed.problem().as_str()), (StatusCode::FORBIDDEN, "archived"));
    assert_eq!(form(&bench, "/teacher/courses", "wish=open&of=cg-2027").await.status, StatusCode::SEE_OTHER);
    assert_eq!(form(&bench, PLAN, "points.ggsample06=1").await.status, StatusCode::SEE_OTHER);
    drop((course, copy, dateless));
    bench.finish().await;
}

/// Makes the tables of a course in which no homework gets a place: what fills them fails in the middle.
async fn break_places(bench: &Bench, id: &str) {
    bench.state.store.open_course(id).await.expect("tables").close().await;
    let without =
        "CREATE TRIGGER no_places BEFORE UPDATE OF position ON assignments BEGIN SELECT RAISE(ABORT, 'no'); END";
    let refusing = "ALTER TABLE assignments ADD CONSTRAINT no_places CHECK (position IS NULL)";
    in_course(bench, id, [without, refusing]).await;
}

async fn mend_places(bench: &Bench, id: &str) {
    in_course(bench, id, ["DROP TRIGGER no_places", "ALTER TABLE assignments DROP CONSTRAINT no_places"]).await;
}

/// Runs a statement in the tables of a course that no service has open: of the two the one for the database that it is.
async fn in_course(bench: &Bench, id: &str, [sqlite, postgres]: [&'static str; 2]) {
    let location = &bench.state.config.database;
    if location.starts_with("postgres") {
        let options: sqlx::postgres::PgConnectOptions = location.parse().expect("an address");
        let schema = format!("ggrade_course_{}", id.replace('-', "_"));
        let mut database = options.options([("search_path", schema)]).connect().await.expect("a connection");
        sqlx::query(postgres).execute(&mut database).await.expect("done");
    } else {
        let file = sqlx::sqlite::SqliteConnectOptions::new().filename(format!("{location}.courses/{id}.db"));
        let mut database = file.connect().await.expect("a file");
        sqlx::query(sqlite).execute(&mut database).await.expect("done");
        database.close().await.expect("closed");
    }
}

async fn a_copy_that_fails_in_the_middle_is_no_course(database: Database) {
    let bench = Bench::new(database).await;
    made(&bench).await;
    assert_eq!(form(&bench, PLAN, &format!("add.{OTHER}=on")).await.status, StatusCode::SEE_OTHER);
    assert_eq!(form(&bench, PLAN, "points.ggsample06=40").await.status, StatusCode::SEE_OTHER);
    break_places(&bench, "cg-2028").await;
    let wish = "wish=copy&of=cg-2027&id=cg-2028&title=Graphics+2028&days=364";
    let failed = form(&bench, "/teacher/courses", wish).await;
    assert_eq!(failed.status, StatusCode::SERVICE_UNAVAILABLE, "{failed:?}");
    let listed = program(&bench, "GET", "/api/v1/courses", "", "").await.text();
    assert!(listed.contains("cg-2027") && !listed.contains("cg-2028"), "{listed}");
    assert_eq!(bench.get("/c/cg-2028/").await.status, StatusCode::NOT_FOUND);
    // Nor after a start, and what is left of it is in nobody's way.
    let bench = bench.restarted(vec![std::sync::Arc::clone(assignment("ggsample06").expect("built in"))]).await;
    assert!(bench.state.course("cg-2028").is_none() && bench.state.course("cg-2027").is_some());
    mend_places(&bench, "cg-2028").await;
    let done = form(&bench, "/teacher/courses", wish).await;
    assert_eq!(done.header("location"), "/c/cg-2028/teacher/plan", "{done:?}");
    let copy = bench.state.course("cg-2028").expect("a course");
    let places = copy.store.places().await.expect("places");
    assert_eq!(places.iter().find(|place| place.id == "ggsample06").and_then(|place| place.points), Some(40.0));
    assert!(copy.ids().contains(&OTHER.to_owned()), "{:?}", copy.ids());
    assert_eq!(bench.get("/c/cg-2028/a/ggsample06").await.status, StatusCode::OK);
    drop(copy);
    bench.finish().await;
}

async fn data_of_an_earlier_course_are_not_written_over(database: Database) {
    let bench = Bench::new(database).await;
    // As where a backup of the service is older than the course.
    let tables = bench.state.store.open_course("cg-2028").await.expect("tables");
    let line = RosterLine { number: "S1".to_owned(), ..RosterLine::default() };
    tables.set_roster(&[line], 1).await.expect("a roster");
    tables.close().await;
    drop(tables);
    let refused = form(&bench, "/teacher/courses", "wish=make&id=cg-2028&title=Graphics").await;
    assert_eq!(refused.status, StatusCode::UNPROCESSABLE_ENTITY);
    assert!(refused.text().contains("an earlier course"), "{}", refused.text());
    let tables = bench.state.store.open_course("cg-2028").await.expect("tables");
    assert!(tables.student_by_number("S1").await.expect("students").is_some());
    tables.close().await;
    drop(tables);
    bench.finish().await;
}

/// Hands in for a student of a course: the id of the submission.
async fn hand_in(bench: &Bench, course: &str, number: &str, text: String) -> String {
    let address = format!("/c/{course}/api/v1/submissions?assignment=ggsample06&student={number}");
    let reply = program(bench, "POST", &address, "text/plain", text).await;
    assert_eq!(reply.status, StatusCode::CREATED, "{reply:?}");
    reply.id()
}

async fn likeness_looks_at_last_terms_course_where_one_teaches_it(database: Database) {
    let bench = bench(database, Clock::fixed(1_801_436_400_000)).await;
    let last = made(&bench).await;
    enrol(&last, &["E1", "R1"]).await;
    let first = hand_in(&bench, "cg-2027", "E1", text(ANSWER)).await;
    hand_in(&bench, "cg-2027", "R1", disguised()).await;
    let fields = "wish=copy&of=cg-2027&id=cg-2028&title=Graphics+2028&days=364";
    assert_eq!(form(&bench, "/teacher/courses", fields).await.status, StatusCode::SEE_OTHER);
    let now = bench.state.course("cg-2028").expect("a course");
    enrol(&now, &["N1", "R1"]).await;
    let copied = hand_in(&bench, "cg-2028", "N1", disguised() + "// mine\n").await;
    // Who takes the course again hands in what is their own; R1 and E1 are both of last term.
    hand_in(&bench, "cg-2028", "R1", disguised()).await;

    let found = program(&bench, "GET", "/c/cg-2028/api/v1/likeness?assignment=ggsample06", "", "").await.json();
    assert_eq!((&found["class"], &found["others"]), (&2.into(), &2.into()), "{found}");
    let member = |pair: &serde_json::Value, place: usize| {
        let member = &pair["members"][place];
        (member["student"].as_str().expect("a number").to_owned(), member["course"].as_str().map(str::to_owned))
    };
    let pairs = found["pairs"].as_array().expect("pairs");
    let mut told: Vec<_> = pairs.iter().map(|pair| (member(pair, 0).0, member(pair, 1))).collect();
    told.sort();
    let of =
        |one: &str, other: &str, course: Option<&str>| (one.to_owned(), (other.to_owned(), course.map(str::to_owned)));
    let course = Some("/c/cg-2027");
    let expected = [of("N1", "E1", course), of("N1", "R1", None), of("N1", "R1", course), of("R1", "E1", course)];
    assert_eq!(told, expected, "{found}");
    let pair = pairs.iter().find(|pair| member(pair, 1).0 == "E1" && member(pair, 0).0 == "N1").expect("a pair");
    assert_eq!(pair["members"][1]["submission"], format!("/c/cg-2027/api/v1/submissions/{first}"));
    let address = pair["comparison"].as_str().expect("an address").to_owned();
    let sides = program(&bench, "GET", &address, "", "").await.json();
    assert!(sides["percent"].as_u64().expect("a share") > 80, "{sides}");

    // Who teaches both courses sees it; who teaches this one only learns nothing of the other.
    let mut admin = administrator(&bench).await;
    let mut of_both = let_in(&bench, &mut admin, "/c/cg-2028", "wada").await;
    let mut of_this = let_in(&bench, &mut admin, "/c/cg-2028", "mori").await;
    let people = "/c/cg-2027/teacher/people";
    let known = admin.form(people, people, "login=wada&name=N&role=assistant").await;
    assert_eq!(known.status, StatusCode::SEE_OTHER);
    let page = "/c/cg-2028/a/ggsample06/teacher/likeness";
    let pair = format!("{page}/pair?one={copied}&other={first}&course=%2Fc%2Fcg-2027");
    let seen = of_both.get(&format!("{page}?lang=en")).await;
    assert!(seen.text().contains(&format!("href=\"/c/cg-2027/r/{first}\"")), "{}", seen.text());
    assert!(seen.text().contains("Graphics 2027"), "{}", seen.text());
    let both = of_both.get(&pair).await;
    assert_eq!(both.all(".side-by-side h3"), ["N1 N", "E1 N"], "{}", both.text());
    let unseen = of_this.get(&format!("{page}?lang=en")).await;
    assert_eq!(unseen.status, StatusCode::OK);
    assert!(!unseen.text().contains(&first) && !unseen.text().contains("E1"), "{}", unseen.text());
    assert_eq!(of_this.get(&pair).await.status, StatusCode::NOT_FOUND);
    assert_eq!(of_this.get(&address).await.status, StatusCode::NOT_FOUND);
    // Where assistants read pseudonyms, who is of last term has no name.
    last.store.set_pseudonyms(true).await.expect("set");
    let seen = of_both.get(&format!("{page}?lang=en")).await;
    assert!(seen.text().contains(&first) && !seen.text().contains("E1"), "{}", seen.text());
    assert!(!of_both.get(&pair).await.text().contains("E1 N"));
    drop((last, now));
    bench.finish().await;
}
