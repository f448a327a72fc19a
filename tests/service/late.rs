//! Due dates, grace, late hand-ins and what they lose, and deadlines of groups.

use crate::bench::{Bench, Reply, config};
use crate::cluster::Database;
use crate::on_both;
use crate::roster::{file, form, get, request};
use axum::http::StatusCode;
use ggrade::fault::Fault;
use ggrade::hand_in::HandIn;
use ggrade::report::{Report, Verdict};
use ggrade::sandbox::{GradedSubmission, GradingTask};
use ggrade::service::clock::Clock;
use ggrade::service::grading::Judge;
use serde_json::{Value, json};
use std::sync::Arc;
use std::time::Duration;

on_both!(
    a_late_hand_in_loses_what_the_rules_say,
    what_is_wrong_with_the_rules_is_said,
    groups_and_students_have_later_deadlines,
    a_late_day_is_one_of_the_calendar,
);

/// Gives the points that stand in the file's first line.
#[derive(Debug)]
struct Points;

impl Judge for Points {
    fn grade(&self, submission: GradingTask<'_>) -> Result<GradedSubmission, Fault> {
        Ok(graded(submission.hand_in, points(submission.hand_in)))
    }
}

/// The points that stand in the first line of a file.
pub fn points(hand_in: &HandIn) -> f64 {
    let text = String::from_utf8_lossy(&hand_in.files[0].bytes).into_owned();
    text.lines().next().and_then(|line| line.trim().parse().ok()).unwrap_or(0.0)
}

/// A report with this score; the first lines of the rubric have their points first.
pub fn graded(hand_in: &HandIn, score: f64) -> GradedSubmission {
    let assignment = reference::assignment("ggsample06").expect("built in");
    let sources = ggrade::grade::sources(assignment, hand_in);
    let verdict = if score >= 100.0 { Verdict::Correct } else { Verdict::Wrong };
    let report = ggrade::grade::unfinished(assignment, sources, verdict, Vec::new(), Default::default());
    let mut left = score;
    let mut rubric = report.rubric;
    for line in &mut rubric {
        line.points = left.min(line.max_points);
        left -= line.points;
    }
    GradedSubmission { report: Report { score, rubric, ..report }, frames: Arc::default() }
}

/// 2023-11-15 07:13:20 in Tokyo. The homework is due at 08:00.
const NOW: i64 = 1_700_000_000_000;
pub const MINUTE: Duration = Duration::from_secs(60);
const HOUR: Duration = Duration::from_secs(3600);
pub const DAY: Duration = Duration::from_secs(86_400);

const ROSTER: &str = "number,name,グループ\nS1,和田 花子,Tue\nS2,B,Wed\nS3,C,Tue\n";
pub const RULES: &str = "closes=2023-11-15T08%3A00&grace=10&late_until=2023-11-30T08%3A00&late_percent=10&late_span=day\
                     &late_floor=50&hints=full&audience=open";

pub async fn bench(database: Database) -> (Bench, Clock) {
    let clock = Clock::fixed(NOW);
    let bench = Bench::with(database, config(), Arc::new(Points), clock.clone()).await;
    file(&bench, "/teacher/roster", "roster", "r.csv", ROSTER.as_bytes()).await;
    (bench, clock)
}

pub async fn rules(bench: &Bench, rules: &str) {
    assert_eq!(form(bench, "/teacher/settings", rules).await.status, StatusCode::SEE_OTHER, "{rules}");
}

/// Hands in a file that gets these points, for a student.
async fn hand_in(bench: &Bench, number: &str, points: u32) -> Reply {
    let address = format!("/api/v1/submissions?student={number}");
    // No two are the same file.
    let text = format!("{points}\n{}", ggrade::service::identity::new_id());
    bench.send(request("POST", &address, "text/plain", text)).await
}

/// What its report says of lateness: minutes, points that go, points that count.
fn late(reply: &Reply) -> (Value, Value, Value) {
    assert_eq!(reply.status, StatusCode::CREATED, "{reply:?}");
    let report = &reply.json()["report"];
    let minutes = report["lateness"]["milliseconds"].as_u64().map(|late| late / 60_000);
    (json!(minutes), report["lateness"]["penalty"].clone(), report["total"].clone())
}

/// The line of a student in a file of the class, by its headings.
async fn line(bench: &Bench, address: &str, key: &str, number: &str) -> impl Fn(&str) -> String + use<> {
    let bytes = get(bench, address).await.body;
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&bytes).to_vec();
    let mut reader = csv::Reader::from_reader(bytes.as_slice());
    let headings = reader.headers().expect("headings").clone();
    let place = move |name: &str| headings.iter().position(|heading| heading == name).expect("a column");
    let at = place(key);
    let line = reader.records().map(|line| line.expect("a line")).find(|line| line[at] == *number).expect("a student");
    move |name| line[place(name)].to_owned()
}

pub async fn csv(bench: &Bench, number: &str) -> impl Fn(&str) -> String + use<> {
    line(bench, "/api/v1/class/files/csv", "key", number).await
}

async fn a_late_hand_in_loses_what_the_rules_say(database: Database) {
    let (bench, clock) = bench(database).await;
    rules(&bench, RULES).await;
    let in_time = (Value::Null, Value::Null, Value::Null);
    assert_eq!(late(&hand_in(&bench, "S1", 60).await), in_time);
    let desk = get(&bench, "/").await.all(".terms-of-hand-in li").concat();
    assert!(desk.contains("Due 15 Nov 2023, 08:00 JST") && desk.contains("46 minutes left"), "{desk}");
    let said = "Late until 30 Nov 2023, 08:00: −10 % of the points for each day begun, never below 50 %";
    assert!(desk.contains(said), "{desk}");
    // Within the grace nothing goes.
    clock.advance(MINUTE * 50);
    assert_eq!(late(&hand_in(&bench, "S1", 70).await), in_time);
    let desk = get(&bench, "/").await.all(".terms-of-hand-in li").concat();
    assert!(desk.contains("Not late until 15 Nov 2023, 08:10 JST"), "{desk}");
    // 08:03:20, and a day and an hour later: the second day has begun.
    clock.advance(DAY + HOUR);
    let desk = get(&bench, "/").await.all(".terms-of-hand-in li").concat();
    assert!(desk.contains("Late hand-ins until 30 Nov 2023, 08:00 JST"), "{desk}");
    let second = hand_in(&bench, "S1", 90).await;
    let minutes = 24 * 60 + 60 + 3;
    assert_eq!(late(&second), (json!(minutes), json!(20.0), json!(70)));
    assert_eq!(second.json()["report"]["score"], 90, "the score stays in sight");
    let page = get(&bench, &format!("/r/{}", second.id())).await;
    assert_eq!(page.all(".head .score"), ["Score 90 / 100"]);
    assert_eq!(page.all(".lateness span"), ["Late by 1 day 1 hour: −20", "Counts: 70 / 100"]);
    // Of equals the first counts: that of the grace.
    let of = csv(&bench, "S1").await;
    assert_eq!([of("score"), of("late_minutes"), of("late_penalty"), of("total")], ["70", "", "", "70"]);
    clock.advance(Duration::from_secs(1));
    hand_in(&bench, "S1", 100).await;
    let of = csv(&bench, "S1").await;
    assert_eq!([of("score"), of("late_minutes"), of("late_penalty"), of("total")], ["100", "1504", "20", "80"]);
    let of = line(&bench, "/api/v1/class/files/nbgrader", "student_id", "S1").await;
    assert_eq!([of("raw_score"), of("late_submission_penalty"), of("score")], ["100.0", "20.0", "80.0"]);
    let of_latest = line(&bench, "/api/v1/class/files/csv?pick=latest", "key", "S1").await;
    assert_eq!(of_latest("total"), "80");
    let table = get(&bench, "/teacher?q=S1").await;
    assert!(table.all(".people tbody td.number").concat().starts_with("80 / 100100 − 20"), "{table:?}");
    let id = bench.state.store.student_by_number("S1").await.expect("a store").expect("a student").id;
    let cards = get(&bench, &format!("/teacher/person?key={id}")).await.all(".attempts li");
    assert!(cards[0].starts_with("100 / 100best 1 day 1 hour late: −20 → 80"), "{cards:?}");
    assert!(!cards[2].contains("late"), "{cards:?}");
    // Eight days: the floor holds at 50, and who has fewer points loses none.
    clock.advance(DAY * 7);
    assert_eq!(late(&hand_in(&bench, "S2", 85).await).1, json!(35.0));
    assert_eq!(late(&hand_in(&bench, "S2", 40).await), (json!(minutes + 7 * 1440), json!(0.0), json!(40)));
    // Another rule changes what is there already: an hour, and no floor.
    let by_hours = RULES.replace("=day", "=hour").replace("floor=50", "floor=0").replace("percent=10", "percent=0.5");
    rules(&bench, &by_hours).await;
    let shown = bench.get(&format!("/api/v1/submissions/{}", second.id())).await.json();
    // 25 hours and some minutes: 26 have begun.
    assert_eq!(shown["report"]["lateness"]["penalty"], 13.0, "{shown}");
    clock.advance(DAY * 7);
    assert_eq!(hand_in(&bench, "S2", 100).await.problem(), "closed");
    let assignment = &bench.get("/api/v1/assignments").await.json()["assignments"][0];
    assert_eq!(
        [&assignment["due_at"], &assignment["ends_at"], &assignment["late_span"], &assignment["counting"]],
        [&json!("2023-11-14T23:00:00Z"), &json!("2023-11-29T23:00:00Z"), &json!("hour"), &json!("best")]
    );
    assert_eq!((&assignment["grace_minutes"], &assignment["late_percent"]), (&json!(10.0), &json!(0.5)));
    bench.finish().await;
}

async fn what_is_wrong_with_the_rules_is_said(database: Database) {
    let (bench, clock) = bench(database).await;
    for (wrong, said) in [
        (RULES.replace("late_until=2023-11-30", "late_until=2023-11-15"), "after the due date"),
        (RULES.replace("closes=2023-11-15T08%3A00", "closes="), "after the due date"),
        (RULES.replace("percent=10", "percent=101"), "from 0 to 100"),
        (RULES.replace("floor=50", "floor=half"), "from 0 to 100"),
        (RULES.replace("grace=10", "grace=-1"), "number of minutes"),
    ] {
        let refused = form(&bench, "/teacher/settings", &wrong).await;
        assert_eq!(refused.status, StatusCode::UNPROCESSABLE_ENTITY, "{wrong}");
        assert!(refused.all("[role=alert]")[0].contains(said), "{wrong}: {:?}", refused.all("[role=alert]"));
    }
    rules(&bench, RULES).await;
    let log = get(&bench, "/teacher/log").await.all(".people tbody tr").concat();
    assert!(log.contains("grace: 0 → 10") && log.contains("late percent: 0 → 10"), "{log}");
    // Without late hand-ins the grace is the end.
    rules(&bench, &RULES.replace("late_until=2023-11-30T08%3A00", "late_until=")).await;
    clock.advance(MINUTE * 56);
    assert_eq!(hand_in(&bench, "S1", 50).await.status, StatusCode::CREATED);
    clock.advance(MINUTE);
    assert_eq!(hand_in(&bench, "S1", 50).await.problem(), "closed");
    bench.finish().await;
}

async fn groups_and_students_have_later_deadlines(database: Database) {
    let (bench, clock) = bench(database).await;
    assert!(get(&bench, "/teacher/extensions").await.text().contains("no deadline that could be put off"));
    rules(&bench, RULES).await;
    clock.advance(HOUR);
    let ids = [hand_in(&bench, "S1", 100).await.id(), hand_in(&bench, "S2", 100).await.id()];
    let penalties = async || {
        let mut all = Vec::new();
        for id in &ids {
            let report = bench.get(&format!("/api/v1/submissions/{id}")).await.json();
            all.push(report["report"]["lateness"]["penalty"].as_f64());
        }
        all
    };
    assert_eq!(penalties().await, [Some(10.0), Some(10.0)]);
    let set = async |whose: &str, closes: &str| {
        form(&bench, "/teacher/extensions", &format!("whose={whose}&closes={closes}&reason=%E5%81%9C%E9%9B%BB")).await
    };
    let refused = set("Thu", "2023-11-16T08%3A00").await;
    assert_eq!(refused.status, StatusCode::UNPROCESSABLE_ENTITY);
    assert!(refused.all("[role=alert]")[0].contains("no group and no student Thu"), "{refused:?}");
    assert!(refused.text().contains("value=\"Thu\"") && refused.text().contains("停電"), "what was typed stays");
    // What was late is in time, as soon as the group's deadline is later.
    assert_eq!(set("Tue", "2023-11-16T08%3A00").await.status, StatusCode::SEE_OTHER);
    assert_eq!(penalties().await, [None, Some(10.0)]);
    let rows = get(&bench, "/teacher/extensions").await.all(".people tbody tr");
    assert_eq!(rows.len(), 1);
    assert!(rows[0].contains("Group Tue") && rows[0].contains("停電"), "{rows:?}");

    // By the API, for a student.
    let put = async |body: Value| {
        bench.send(request("PUT", "/api/v1/extensions", "application/json", body.to_string())).await
    };
    let asked = json!({ "whose": "s2", "due_at": "2023-11-15T12:00:00+09:00", "reason": "ill" });
    assert_eq!(put(asked).await.status, StatusCode::NO_CONTENT);
    assert_eq!(penalties().await, [None, None]);
    let listed = get(&bench, "/api/v1/extensions").await.json();
    assert_eq!(
        listed["extensions"],
        json!([
            { "student": null, "group": "Tue", "due_at": "2023-11-15T23:00:00Z", "reason": "停電" },
            { "student": "S2", "group": null, "due_at": "2023-11-15T03:00:00Z", "reason": "ill" },
        ])
    );
    assert_eq!(put(json!({ "whose": "S9", "due_at": null })).await.problem(), "nobody");
    assert_eq!(put(json!({ "whose": "S2", "due_at": "2023-11-15T07:00:00+09:00" })).await.problem(), "unprocessable");
    assert_eq!(put(json!({ "whose": "S2" })).await.status, StatusCode::NO_CONTENT);
    assert_eq!(penalties().await, [None, Some(10.0)]);
    let stranger = bench.get("/api/v1/extensions").await;
    assert_eq!(stranger.status, StatusCode::UNAUTHORIZED);
    let log = get(&bench, "/teacher/log").await.all(".people tbody tr").concat();
    assert!(log.contains("Tue: 2023-11-16T08:00 停電") && log.contains("2023-11-15T03:00:00Z ill"), "{log}");
    // Whoever changes groups has the deadline of the new one.
    file(&bench, "/teacher/roster", "roster", "r.csv", ROSTER.replace("B,Wed", "B,Tue").as_bytes()).await;
    assert_eq!(penalties().await, [None, None]);
    bench.finish().await;
}

async fn a_late_day_is_one_of_the_calendar(database: Database) {
    // Sunday, 25 October 2026, 23:30 in Berlin: the clocks went back in the night before.
    let clock = Clock::fixed(1_792_967_400_000);
    let bench = Bench::with(database, config(), Arc::new(Points), clock.clone()).await;
    assert_eq!(form(&bench, "/teacher/course", "zone=Europe%2FBerlin&language=en").await.status, StatusCode::SEE_OTHER);
    let due = |day: &str, rule: &str| {
        format!("closes={day}T23%3A59&late_until=2027-06-01T08%3A00&{rule}&late_floor=0&hints=full&audience=open")
    };
    let by_days = "late_percent=10&late_span=day";
    rules(&bench, &due("2026-10-24", by_days)).await;
    // 24 hours and 31 minutes after Saturday, 23:59, on the clock a day but for 29 minutes.
    let sunday = hand_in(&bench, "S1", 100).await;
    assert_eq!(late(&sunday), (json!(24 * 60 + 31), json!(10.0), json!(90)));
    clock.advance(HOUR);
    assert_eq!(late(&hand_in(&bench, "S1", 100).await).1, json!(20.0));
    // An hour is an hour.
    rules(&bench, &due("2026-10-24", "late_percent=1&late_span=hour")).await;
    let report = bench.get(&format!("/api/v1/submissions/{}", sunday.id())).await.json();
    assert_eq!(report["report"]["lateness"]["penalty"], 25.0, "{report}");
    // Monday, 29 March 2027, 00:30: the clocks went forward, 23 hours and 31 minutes after Saturday, 23:59.
    clock.advance(DAY * 154 - HOUR);
    rules(&bench, &due("2027-03-27", by_days)).await;
    assert_eq!(late(&hand_in(&bench, "S1", 100).await), (json!(23 * 60 + 31), json!(20.0), json!(80)));
    bench.finish().await;
}
