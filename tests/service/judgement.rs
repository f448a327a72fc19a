//! What people judge beside the grading: overridden lines, comments, and students who ask for another look.

use crate::bench::{Bench, Reply, config};
use crate::cluster::Database;
use crate::codes::Guest;
use crate::late::{graded, points};
use crate::on_both;
use crate::roster::{form, get, request};
use crate::staff;
use axum::body::Body;
use axum::http::{StatusCode, header};
use ggrade::fault::Fault;
use ggrade::sandbox::{GradedSubmission, GradingTask};
use ggrade::service::clock::Clock;
use ggrade::service::grading::Judge;
use ggrade::service::identity::personal_code;
use ggrade::service::regrade;
use ggrade::service::store::{Regrading, RosterLine};
use serde_json::{Value, json};
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::Duration;

on_both!(
    an_overridden_line_counts_and_its_reason_is_read,
    what_is_overridden_survives_a_regrading_which_says_where_it_changes,
    comments_stand_at_their_lines,
    a_student_asks_once_and_sees_who_is_handling_it,
);

/// Gives the points that stand in the file's first line, and some more that a test chooses.
#[derive(Debug, Default)]
pub struct Lenient(AtomicU32);

impl Judge for Lenient {
    fn grade(&self, submission: GradingTask<'_>) -> Result<GradedSubmission, Fault> {
        let more = f64::from(self.0.load(Ordering::SeqCst));
        Ok(graded(submission.hand_in, points(submission.hand_in) + more))
    }
}

async fn bench(database: Database) -> (Bench, Arc<Lenient>) {
    let judge = Arc::new(Lenient::default());
    let bench = Bench::with(database, config(), judge.clone(), Clock::system()).await;
    let line =
        |number: &str| RosterLine { number: number.into(), name: "和田 花子".into(), ..RosterLine::default() };
    bench.state.store.set_roster(&[line("S1"), line("S2")], 0).await.expect("a roster");
    (bench, judge)
}

/// Hands in a file of three lines that gets these points.
pub async fn hand_in(bench: &Bench, number: &str, points: u32) -> String {
    let text = format!("{points}\nvoid main() {{}}\n// {}", ggrade::service::identity::new_id());
    let address = format!("/api/v1/submissions?student={number}");
    let reply = bench.send(request("POST", &address, "text/plain", text)).await;
    assert_eq!(reply.status, StatusCode::CREATED, "{reply:?}");
    reply.id()
}

pub async fn api(bench: &Bench, method: &str, address: &str, body: Value) -> Reply {
    bench.send(request(method, address, "application/json", body.to_string())).await
}

pub async fn report(bench: &Bench, id: &str) -> Value {
    bench.get(&format!("/api/v1/submissions/{id}?lang=en")).await.json()["report"].clone()
}

/// The cells of a student in the class's CSV file: score, points of the specular line.
pub async fn cells(bench: &Bench, number: &str) -> [String; 2] {
    let bytes = get(bench, "/api/v1/class/files/csv").await.body;
    let mut reader = csv::Reader::from_reader(bytes.strip_prefix(b"\xef\xbb\xbf").expect("a mark"));
    let headings = reader.headers().expect("headings").clone();
    let line = reader.records().map(|line| line.expect("a line")).find(|line| line[0] == *number).expect("a student");
    let cell = |name: &str| line[headings.iter().position(|it| it == name).expect("a column")].to_owned();
    [cell("score"), cell("specular")]
}

async fn an_overridden_line_counts_and_its_reason_is_read(database: Database) {
    let (bench, _) = bench(database).await;
    // Shape 10, ambient 20, diffuse 30, specular 0 of 40.
    let id = hand_in(&bench, "S1", 60).await;
    hand_in(&bench, "S1", 80).await;
    let at = format!("/r/{id}/override");
    let reason = "reason=%E5%BC%8F%E3%81%AF%E6%AD%A3%E3%81%97%E3%81%84";
    for wrong in [format!("line=specular&points=41&{reason}"), "line=specular&points=35&reason=+".to_owned()] {
        assert_eq!(form(&bench, &at, &wrong).await.status, StatusCode::UNPROCESSABLE_ENTITY, "{wrong}");
    }
    assert_eq!(form(&bench, &at, &format!("line=gloss&points=1&{reason}")).await.status, 422);
    let set = form(&bench, &at, &format!("line=specular&points=35&{reason}")).await;
    assert_eq!((set.status, set.header("location")), (StatusCode::SEE_OTHER, &*format!("/r/{id}#judgement")));

    let page = bench.get(&format!("/r/{id}?lang=en")).await;
    let line = page.all("#rubric-specular").concat();
    let said = "Set to 35 points by the course's staff; the grading gave 0. 式は正しい";
    assert!(line.contains("35 / 40") && line.contains(said), "{line}");
    assert_eq!(page.all(".head .score"), ["Score 95 / 100"]);
    assert!(page.all(".judgement form.override").is_empty(), "students override nothing");
    let desk = get(&bench, &format!("/r/{id}")).await;
    assert!(desk.all("form.override p").contains(&"Specular 35 / 40 graded: 0".to_owned()), "{desk:?}");
    let report = report(&bench, &id).await;
    assert_eq!((&report["score"], &report["verdict"]), (&json!(95), &json!("wrong")));
    assert_eq!((&report["rubric"][3]["points"], &report["rubric"][3]["graded_points"]), (&json!(35), &json!(0)));
    assert!(report["rubric"][2].get("graded_points").is_none(), "{report}");
    // It is the best now, everywhere.
    assert_eq!(cells(&bench, "S1").await, ["95", "35"]);
    assert!(get(&bench, "/teacher?q=S1").await.all(".people tbody td.number")[0].starts_with("95"));
    let gradescope = get(&bench, "/api/v1/class/files/gradescope").await.body;
    let mut zip = zip::ZipArchive::new(std::io::Cursor::new(gradescope)).expect("an archive");
    let file = zip.by_name("gradescope/S1.json").expect("a file");
    let results: Value = serde_json::from_reader(file).expect("JSON");
    assert_eq!((&results["score"], &results["tests"][3]["score"]), (&json!(95.0), &json!(35.0)));

    // Back again, and by the API.
    let address = format!("/api/v1/submissions/{id}/rubric/specular");
    assert_eq!(api(&bench, "DELETE", &address, json!({})).await.status, StatusCode::NO_CONTENT);
    assert_eq!(cells(&bench, "S1").await, ["80", "20"]);
    assert_eq!(api(&bench, "PUT", &address, json!({ "points": 40, "reason": "x" })).await.status, 204);
    assert_eq!(cells(&bench, "S1").await, ["100", "40"]);
    for (line, wrong) in
        [("specular", json!({ "points": -1, "reason": "x" })), ("x", json!({ "points": 1, "reason": "x" }))]
    {
        let refused = api(&bench, "PUT", &format!("/api/v1/submissions/{id}/rubric/{line}"), wrong).await;
        assert_eq!(refused.status, StatusCode::UNPROCESSABLE_ENTITY);
    }
    let stranger = bench.send(axum::http::Request::put(&address).body(Body::from("{}")).expect("a request")).await;
    assert_eq!(stranger.status, StatusCode::UNAUTHORIZED);
    let log = get(&bench, "/teacher/log").await.all(".people tbody tr");
    let acts = log.iter().filter(|row| row.contains("Overrode points") && row.contains("S1")).count();
    assert_eq!(acts, 3, "{log:?}");
    for said in ["specular: 0 → 35, 式は正しい", "specular: 35 → 0", "specular: 0 → 40, x"] {
        assert!(log.concat().contains(said), "{said}: {log:?}");
    }
    bench.finish().await;
}

/// Has everything graded again, and waits until it is.
pub async fn again(bench: &Bench) -> Regrading {
    let regrading = regrade::start(&bench.state, true, None).await.expect("begun");
    for _ in 0..600 {
        if bench.state.store.regrading_progress(&regrading.id).await.expect("progress").is_done() {
            return regrading;
        }
        tokio::time::sleep(Duration::from_millis(50)).await;
    }
    panic!("it is never done")
}

async fn what_is_overridden_survives_a_regrading_which_says_where_it_changes(database: Database) {
    let (bench, judge) = bench(database).await;
    let ids = [hand_in(&bench, "S1", 60).await, hand_in(&bench, "S2", 60).await];
    for (id, points) in [(&ids[0], 35), (&ids[1], 20)] {
        let set = format!("line=specular&points={points}&reason=by+hand");
        assert_eq!(form(&bench, &format!("/r/{id}/override"), &set).await.status, StatusCode::SEE_OTHER);
    }
    assert_eq!(form(&bench, &format!("/r/{}/override", ids[1]), "line=shape&points=5&reason=y").await.status, 303);
    // The same grading: nothing changes, and nothing is said.
    let same = get(&bench, &format!("/teacher/regradings/{}", again(&bench).await.id)).await;
    assert!(
        same.all(".overridden").is_empty() && same.all(".lead")[0].starts_with("0 gain points, 0 lose"),
        "{same:?}"
    );
    // The next gives 20 more, all for the specular line.
    judge.0.store(20, Ordering::SeqCst);
    let regrading = again(&bench).await;
    let page = get(&bench, &format!("/teacher/regradings/{}", regrading.id)).await;
    let found = page.all(".overridden tbody td");
    let lines: Vec<&[String]> = found.chunks(5).collect();
    assert_eq!(lines.len(), 2, "{lines:?}");
    assert!(lines.contains(&["Specular", "35", "by hand", "0", "20"].map(str::to_owned).as_slice()), "{lines:?}");
    assert!(page.all(".lead")[0].starts_with("0 gain points, 0 lose points"), "what is given stays: {page:?}");
    regrade::adopt(&bench.state, &regrading.id).await.expect("adopted");
    assert_eq!(cells(&bench, "S1").await, ["95", "35"]);
    assert_eq!(cells(&bench, "S2").await, ["75", "20"]);
    let lead = get(&bench, &format!("/teacher/regradings/{}", regrading.id)).await.all(".lead");
    assert_eq!(lead, page.all(".lead"), "what was changed is known afterwards");
    let report = report(&bench, &ids[0]).await;
    assert_eq!((&report["score"], &report["rubric"][3]["graded_points"]), (&json!(95), &json!(20)));
    // Without the override it is the new grading that counts.
    form(&bench, &format!("/r/{}/override", ids[0]), "line=specular&wish=clear").await;
    assert_eq!(cells(&bench, "S1").await, ["80", "20"]);
    let lead = get(&bench, &format!("/teacher/regradings/{}", regrading.id)).await.all(".lead");
    assert_eq!(lead, page.all(".lead"), "and stays, whatever comes later");
    bench.finish().await;
}

async fn comments_stand_at_their_lines(database: Database) {
    let (bench, _) = bench(database).await;
    let id = hand_in(&bench, "S1", 60).await;
    let at = format!("/r/{id}/comments");
    for wrong in ["line=4&text=x", "line=0&text=x", "line=2&text=+", "line=2&file=other.vert&text=x"] {
        assert_eq!(form(&bench, &at, wrong).await.status, StatusCode::UNPROCESSABLE_ENTITY, "{wrong}");
    }
    let said = "line=2&text=What+does+%60main%60+%3Cb%3Ewrite%3C%2Fb%3E%3F";
    assert_eq!(form(&bench, &at, said).await.status, StatusCode::SEE_OTHER);
    let page = bench.get(&format!("/r/{id}?lang=en")).await;
    assert_eq!(page.all("#L2 .note.comment"), ["Comment What does main <b>write</b>?"]);
    assert!(page.text().contains("<code>main</code>"));
    let address = format!("/api/v1/submissions/{id}/comments");
    let added = api(&bench, "POST", &address, json!({ "line": 1, "text": "!" })).await;
    assert_eq!(added.status, StatusCode::CREATED);
    let comments = report(&bench, &id).await["comments"].clone();
    assert_eq!(comments[0], json!({ "file": "ggsample06.vert", "line": 1, "text": "!", "author": null }));
    assert_eq!(comments[1]["text"], "What does `main` <b>write</b>?");
    // Other systems have it as well.
    let vpl = get(&bench, "/api/v1/class/files/vpl?lang=en").await.body;
    let mut zip = zip::ZipArchive::new(std::io::Cursor::new(vpl)).expect("an archive");
    let text = std::io::read_to_string(zip.by_name("vpl/S1.txt").expect("a file")).expect("text");
    assert!(text.contains("ggsample06.vert, line 1: !"), "{text}");

    let comment = format!("/api/v1/submissions/{id}/comments/{}", added.id());
    assert_eq!(api(&bench, "DELETE", &comment, json!({})).await.status, StatusCode::NO_CONTENT);
    assert_eq!(api(&bench, "DELETE", &comment, json!({})).await.status, StatusCode::NOT_FOUND);
    assert!(bench.get(&format!("/r/{id}")).await.all("#L1 .note").is_empty());
    let deleted = bench.send(request("DELETE", &format!("/api/v1/submissions/{id}"), "", Body::empty())).await;
    assert_eq!(deleted.status, StatusCode::OK);
    assert!(bench.state.store.comments(&id).await.expect("comments").is_empty());
    bench.finish().await;
}

async fn a_student_asks_once_and_sees_who_is_handling_it(database: Database) {
    let bench = staff::bench(database, Clock::system()).await;
    let line = RosterLine { number: "S1".into(), name: "和田 花子".into(), ..RosterLine::default() };
    bench.state.store.set_roster(&[line], 0).await.expect("a roster");
    let mut first = staff::administrator(&bench).await;
    let mut assistant = first.let_in("taro", "assistant").await;
    let (mine, other) = (Guest::new(&bench).await, Guest::new(&bench).await);
    let student = bench.state.store.student_by_number("S1").await.expect("a store").expect("a student");
    mine.join(&bench, "S1", &personal_code(&bench.state, &student)).await;
    let id = mine.hand_in(&bench, "void main() {}").await.id();
    let second = mine.hand_in(&bench, "void main() { }").await.id();
    let page = format!("/r/{id}");
    assert_eq!(mine.get(&bench, &page).await.all(".judgement details select option").len(), 4);
    assert!(other.get(&bench, &page).await.all(".judgement").is_empty(), "whoever has the address asks nothing");
    let ask = async |guest: &Guest, id: &str, fields: &str| {
        let request = guest.request("POST", &format!("/r/{id}/appeal")).header(header::ACCEPT, "text/html");
        let request = request.header(header::CONTENT_TYPE, "application/x-www-form-urlencoded");
        let body = format!("csrf={}&{fields}", guest.csrf(&bench).await);
        bench.send(request.body(Body::from(body)).expect("a request")).await.status
    };
    assert_eq!(ask(&other, &id, "line=specular&question=mine").await, StatusCode::NOT_FOUND);
    assert_eq!(ask(&mine, &id, "line=specular&question=+").await, StatusCode::UNPROCESSABLE_ENTITY);
    assert_eq!(ask(&mine, &id, "line=gloss&question=why").await, StatusCode::UNPROCESSABLE_ENTITY);
    assert_eq!(ask(&mine, &id, "line=specular&question=Is+slide+21+not+the+same%3F").await, StatusCode::SEE_OTHER);
    for id in [&id, &second] {
        assert_eq!(ask(&mine, id, "line=shape&question=again").await, StatusCode::CONFLICT, "once in a homework");
        assert!(mine.get(&bench, &format!("/r/{id}")).await.all(".judgement details").is_empty());
    }
    let said = mine.get(&bench, &page).await.all(".judgement h3 small").concat();
    assert_eq!(said, "nobody is handling it yet");

    // An assistant finds it, takes it, and is seen to handle it.
    assert!(assistant.get("/teacher").await.text().contains("1 request for another look"));
    let row = assistant.get("/teacher/appeals").await.all(".people tbody :is(th, td)");
    assert_eq!(row[..3], ["S1 和田 花子", "Specular", "Is slide 21 not the same?"]);
    assert!(row[3].starts_with("nobody"), "{row:?}");
    let appeal = bench.state.store.appeals("ggsample06").await.expect("appeals")[0].id.clone();
    let at = format!("/teacher/appeals/{appeal}");
    assert_eq!(assistant.form("/teacher", &at, "wish=take").await.status, StatusCode::SEE_OTHER);
    let desk = mine.get(&bench, "/").await.all(".terms-of-hand-in li");
    assert!(desk.contains(&"Another look: N is handling it".to_owned()), "{desk:?}");
    assert!(assistant.get("/teacher/appeals").await.all(".people tbody tr").concat().contains("N is handling it"));
    assert_eq!(assistant.form("/teacher", &at, "wish=release").await.status, StatusCode::SEE_OTHER);
    assert_eq!(mine.get(&bench, &page).await.all(".judgement h3 small"), ["nobody is handling it yet"]);
    // They override, comment and answer; the student reads it all.
    let set = assistant.form(&page, &format!("{page}/override"), "line=specular&points=40&reason=You+are+right").await;
    assert_eq!(set.status, StatusCode::SEE_OTHER);
    assert_eq!(assistant.form(&page, &at, "wish=answer&answer=").await.status, StatusCode::UNPROCESSABLE_ENTITY);
    assert_eq!(assistant.form(&page, &at, "wish=answer&answer=It+is.").await.status, StatusCode::SEE_OTHER);
    let read = mine.get(&bench, &page).await;
    assert_eq!(read.all(".judgement .said"), ["Is slide 21 not the same?", "It is."]);
    assert!(read.all("#rubric-specular").concat().contains("You are right"), "also where nothing was drawn");
    assert!(read.all(".judgement form").is_empty(), "{read:?}");
    // A program reads and answers as well.
    let listed = get(&bench, "/api/v1/appeals").await.json()["appeals"][0].clone();
    assert_eq!(
        [&listed["student"], &listed["line"], &listed["answer"], &listed["handler"]],
        ["S1", "specular", "It is.", "N"]
    );
    let answered =
        api(&bench, "PUT", &format!("/api/v1/appeals/{appeal}/answer"), json!({ "answer": "Indeed." })).await;
    assert_eq!(answered.status, StatusCode::NO_CONTENT);
    assert_eq!(mine.get(&bench, &page).await.all(".judgement .said")[1], "Indeed.");
    assert_eq!(bench.get("/api/v1/appeals").await.status, StatusCode::UNAUTHORIZED);
    let log = first.get("/teacher/log").await.all(".people tbody tr");
    let by_taro = |act: &str| log.iter().filter(|row| row.contains("taro") && row.contains(act)).count();
    assert_eq!((by_taro("Handled a request"), by_taro("Overrode points")), (3, 1), "{log:?}");
    // With the student goes what they asked.
    let gone = bench.send(request("DELETE", "/api/v1/students/S1", "", Body::empty())).await;
    assert_eq!(gone.status, StatusCode::OK);
    assert!(bench.state.store.appeals("ggsample06").await.expect("appeals").is_empty());
    bench.finish().await;
}
