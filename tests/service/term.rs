//! A term, played by a script over HTTP: 300 students, 8 homeworks, late hand-ins, extensions, overrides, a regrade. What each
//! student ends up with is computed here a second time. The grading itself is not the point: a judge gives the points that
//! stand in the file.

use crate::bench::{Bench, config};
use crate::cluster::Database;
use crate::roster::{form, get, request};
use axum::http::StatusCode;
use ggrade::fault::Fault;
use ggrade::report::{Report, Verdict};
use ggrade::sandbox::{GradedSubmission, GradingTask};
use ggrade::service::clock::Clock;
use ggrade::service::grading::Judge;
use ggrade::service::regrade;
use ggrade::service::store::RosterLine;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::Duration;

const STUDENTS: usize = 300;
const HOMEWORKS: [&str; 8] =
    ["lambert", "phong", "ggsample06", "blinn", "schlick", "threshold", "falloff-linear", "spot-soft"];

/// 2023-11-15 07:13:20 in Tokyo.
const NOW: i64 = 1_700_000_000_000;
const DAY: u64 = 86_400;

/// Gives the percentage that stands in the file's first line, and some more that the test chooses.
#[derive(Debug, Default)]
struct Percent(AtomicU32);

impl Judge for Percent {
    fn grade(&self, submission: GradingTask<'_>) -> Result<GradedSubmission, Fault> {
        let text = String::from_utf8_lossy(&submission.hand_in.files[0].bytes).into_owned();
        let percent: f64 = text.lines().next().and_then(|line| line.trim().parse().ok()).unwrap_or(0.0);
        let percent = (percent + f64::from(self.0.load(Ordering::SeqCst))).min(100.0);
        let sources = ggrade::grade::sources(submission.assignment, submission.hand_in);
        let verdict = if percent >= 100.0 { Verdict::Correct } else { Verdict::Wrong };
        let report = ggrade::grade::unfinished(submission.assignment, sources, verdict, Vec::new(), Default::default());
        let mut left = report.max_score * percent / 100.0;
        let score = left;
        let mut rubric = report.rubric;
        for line in &mut rubric {
            line.points = left.min(line.max_points);
            left -= line.points;
        }
        Ok(GradedSubmission { report: Report { score, rubric, ..report }, frames: Arc::default() })
    }
}

fn number(student: usize) -> String {
    format!("S{student:03}")
}

/// The percentage that a student's file gets in a homework; none where they hand in nothing.
fn percent(student: usize, homework: usize) -> Option<usize> {
    (!(student + homework).is_multiple_of(20)).then_some(40 + (7 * student + 13 * homework) % 61)
}

/// Who hands in half a day late; of these every fifth has a later deadline of their own.
fn is_late(student: usize) -> bool {
    student % 10 == 3
}

fn is_extended(student: usize) -> bool {
    student % 50 == 3
}

/// Whose first line somebody gives 0 points by hand.
fn is_overridden(student: usize) -> bool {
    student % 100 == 7
}

async fn hand_in(bench: &Bench, homework: usize, student: usize) -> Option<String> {
    let text = format!("{}\nvoid main() {{}}\n// {homework} {student}\n", percent(student, homework)?);
    let address = format!("/api/v1/submissions?assignment={}&student={}", HOMEWORKS[homework], number(student));
    let reply = bench.send(request("POST", &address, "text/plain", text)).await;
    assert_eq!(reply.status, StatusCode::CREATED, "{reply:?}");
    Some(reply.id())
}

/// The column of a homework's table, by student.
async fn column(bench: &Bench, homework: &str, name: &str) -> BTreeMap<String, String> {
    let bytes = get(bench, &format!("/api/v1/class/files/csv?assignment={homework}")).await.body;
    let mut reader = csv::Reader::from_reader(bytes.strip_prefix(b"\xef\xbb\xbf").expect("a mark"));
    let at = reader.headers().expect("headings").iter().position(|it| it == name).expect("a column");
    reader.records().map(|line| line.expect("a line")).map(|line| (line[0].to_owned(), line[at].to_owned())).collect()
}

fn in_tokyo(seconds: u64) -> String {
    let at = jiff::Timestamp::from_millisecond(NOW).expect("a time") + Duration::from_secs(seconds);
    at.in_tz("Asia/Tokyo").expect("a zone").strftime("%Y-%m-%dT%H%%3A%M").to_string()
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_term_of_300_students_and_8_homeworks() {
    let (clock, judge) = (Clock::fixed(NOW), Arc::new(Percent::default()));
    let assignments: Vec<_> =
        HOMEWORKS.iter().map(|name| Arc::clone(reference::assignment(name).expect("built in"))).collect();
    assert!(assignments.iter().all(|assignment| assignment.files.len() == 1));
    let bench =
        Bench::serving_several(assignments.clone(), Database::sqlite(), config(), judge.clone(), clock.clone()).await;
    let line = |student: usize| RosterLine {
        number: number(student),
        name: format!("学生 {student}"),
        group: format!("T{}", student % 10),
        ..RosterLine::default()
    };
    bench.state.store.set_roster(&(0..STUDENTS).map(line).collect::<Vec<_>>(), NOW).await.expect("a roster");

    let mut expected: Vec<BTreeMap<String, f64>> = Vec::new();
    for (homework, assignment) in assignments.iter().enumerate() {
        let (id, most) = (&assignment.id, assignment.max_score());
        let week = 7 * DAY * homework as u64;
        let rules = format!(
            "closes={}&grace=10&late_until={}&late_percent=10&late_span=day&late_floor=50&hints=full&audience=open",
            in_tokyo(week + 5 * DAY),
            in_tokyo(week + 6 * DAY),
        );
        let set = form(&bench, &format!("/a/{id}/teacher/settings"), &rules).await;
        assert_eq!(set.status, StatusCode::SEE_OTHER, "{set:?}");
        for student in (0..STUDENTS).filter(|student| is_extended(*student)) {
            let due = jiff::Timestamp::from_millisecond(NOW).expect("a time") + Duration::from_secs(week + 6 * DAY);
            let wish = json!({ "whose": number(student), "due_at": due.to_string(), "reason": "ill" }).to_string();
            let address = format!("/api/v1/extensions?assignment={id}");
            assert_eq!(bench.send(request("PUT", &address, "application/json", wish)).await.status, 204);
        }
        let mut totals = BTreeMap::new();
        for late in [false, true] {
            clock.advance(Duration::from_secs(if late { 11 * DAY / 2 - DAY } else { DAY }));
            for student in (0..STUDENTS).filter(|student| is_late(*student) == late) {
                let Some(submission) = hand_in(&bench, homework, student).await else { continue };
                let share = percent(student, homework).expect("handed in") as f64 / 100.0;
                let mut score = share * most;
                if is_overridden(student) {
                    let line = &assignment.rubric[0];
                    score -= line.points.min(score);
                    let address = format!("/api/v1/submissions/{submission}/rubric/{}", line.id);
                    let wish = json!({ "points": 0, "reason": "copied" }).to_string();
                    assert_eq!(bench.send(request("PUT", &address, "application/json", wish)).await.status, 204);
                }
                // A tenth of all for the day that has begun, and never below half of all.
                let is_deducted = late && !is_extended(student);
                let penalty = if is_deducted { (0.1 * most).min(score - 0.5 * most).max(0.0) } else { 0.0 };
                totals.insert(number(student), score - penalty);
            }
        }
        expected.push(totals);
        clock.advance(Duration::from_secs(7 * DAY - 11 * DAY / 2));
    }
    assert_eq!(expected.iter().map(BTreeMap::len).sum::<usize>(), 8 * STUDENTS * 19 / 20);

    let check = async |homework: usize, more: f64| {
        let id = &assignments[homework].id;
        let totals = column(&bench, id, "total").await;
        assert_eq!(totals.len(), STUDENTS, "everybody of the roster has a line");
        for (student, total) in totals {
            let wanted = expected[homework].get(&student);
            let found: Option<f64> = total.parse().ok();
            let is_equal = match (wanted, found) {
                (Some(wanted), Some(found)) => (wanted + more - found).abs() < 1e-6,
                (wanted, found) => wanted.is_none() && found.is_none(),
            };
            assert!(is_equal, "{id} {student}: {wanted:?} + {more}, {found:?}");
        }
    };
    for homework in 0..HOMEWORKS.len() {
        check(homework, 0.0).await;
    }

    // Everything of one homework is graded again, by a judge who finds nothing new: nothing changes, and what was overridden stays.
    let state = bench.state.homework("ggsample06").expect("served");
    let regrading = regrade::start(&state, true, None).await.expect("begun");
    for _ in 0..1200 {
        if state.store.regrading_progress(&regrading.id).await.expect("progress").is_done() {
            break;
        }
        tokio::time::sleep(Duration::from_millis(50)).await;
    }
    regrade::adopt(&state, &regrading.id).await.expect("adopted");
    check(2, 0.0).await;

    // What a course learns, who is alike, and everything of one student, of such a class.
    let attempts = get(&bench, "/api/v1/insights/attempts?assignment=falloff-linear").await.text();
    assert!(attempts.contains("nothing,0,15"), "{attempts}");
    let likeness = get(&bench, "/api/v1/likeness?assignment=falloff-linear").await.json();
    assert_eq!((&likeness["class"], &likeness["pairs"]), (&json!(285), &json!([])));
    let page = get(&bench, "/a/falloff-linear/teacher?lang=en").await;
    assert!(page.all(".lead").concat().contains("285 of 300 have handed in"), "{page:?}");
    let export = get(&bench, "/api/v1/students/S007/export").await.body;
    let mut zip = zip::ZipArchive::new(std::io::Cursor::new(export)).expect("an archive");
    let about: Value = serde_json::from_reader(zip.by_name("student.json").expect("a file")).expect("JSON");
    assert_eq!(about["hand_ins"].as_array().map(Vec::len), Some(8));
    bench.finish().await;
}
