//! What is overridden, when a new version of the homework has another rubric.

use crate::bench::{Bench, config};
use crate::cluster::Database;
use crate::judgement::{again, api, cells, hand_in, report};
use crate::late::{graded, points};
use crate::on_both;
use crate::roster::{form, get};
use axum::http::StatusCode;
use ggrade::fault::Fault;
use ggrade::sandbox::{GradedSubmission, GradingTask};
use ggrade::service::clock::Clock;
use ggrade::service::grading::Judge;
use ggrade::service::regrade;
use ggrade::service::store::RosterLine;
use serde_json::json;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

on_both!(what_is_overridden_is_the_same_share_of_a_line_and_is_told_where_the_line_is_gone);

/// Gives the points that stand in the first line of the file. In the new version the specular line gives 20 points at most in place
/// of 40, and the first line is gone.
#[derive(Debug, Default)]
struct Versions(AtomicBool);

impl Judge for Versions {
    fn grade(&self, submission: GradingTask<'_>) -> Result<GradedSubmission, Fault> {
        let mut done = graded(submission.hand_in, points(submission.hand_in));
        if self.0.load(Ordering::SeqCst) {
            let report = &mut done.report;
            report.rubric.remove(0);
            for line in report.rubric.iter_mut().filter(|line| line.id == "specular") {
                (line.points, line.max_points) = (line.points / 2.0, 20.0);
            }
            report.score = report.rubric.iter().map(|line| line.points).sum();
            report.max_score = report.rubric.iter().map(|line| line.max_points).sum();
        }
        Ok(done)
    }
}

async fn what_is_overridden_is_the_same_share_of_a_line_and_is_told_where_the_line_is_gone(database: Database) {
    let judge = Arc::new(Versions::default());
    let bench = Bench::with(database, config(), judge.clone(), Clock::system()).await;
    let line = RosterLine { number: "S1".into(), name: "和田 花子".into(), ..RosterLine::default() };
    bench.state.store.set_roster(&[line], 0).await.expect("a roster");
    // Shape 10, ambient 20, diffuse 30, specular 0 of 40.
    let id = hand_in(&bench, "S1", 60).await;
    for (line, points) in [("specular", 40), ("shape", 5)] {
        let set =
            form(&bench, &format!("/r/{id}/override"), &format!("line={line}&points={points}&reason=by+hand")).await;
        assert_eq!(set.status, StatusCode::SEE_OTHER);
    }
    assert_eq!(cells(&bench, "S1").await, ["95", "40"]);
    judge.0.store(true, Ordering::SeqCst);
    let regrading = again(&bench).await;

    // Before anybody adopts it, the page says what becomes of each.
    let address = format!("/teacher/regradings/{}", regrading.id);
    let page = get(&bench, &address).await;
    let found = page.all(".overridden tbody td");
    let lines: Vec<&[String]> = found.chunks(5).collect();
    let shape = ["Shape", "5 / 10 → –", "by hand", "10", "no such line"];
    let specular = ["Specular", "40 / 40 → 20 / 20", "by hand", "0", "0"];
    assert_eq!(lines.len(), 2, "{lines:?}");
    for expected in [shape, specular] {
        assert!(lines.contains(&expected.map(str::to_owned).as_slice()), "{lines:?}");
    }
    let change = page.all("section[aria-labelledby=people] td.number");
    assert_eq!(change, ["-25"], "20 of ambient, 30 of diffuse, 20 given in specular");
    let listed = api(&bench, "GET", &format!("/api/v1/regradings/{}", regrading.id), json!({})).await.json();
    let of = |line: &str| {
        let all = listed["overridden"].as_array().expect("a list");
        all.iter().find(|it| it["line"] == line).expect("a line").clone()
    };
    assert_eq!(of("shape")["points_again"], json!(null));
    assert_eq!([&of("specular")["max_points"], &of("specular")["points_again"]], [&json!(40.0), &json!(20.0)]);

    regrade::adopt(&bench.state, &regrading.id).await.expect("adopted");
    let stored = report(&bench, &id).await;
    assert_eq!([&stored["score"], &stored["max_score"]], [&json!(70), &json!(90 - 20)]);
    let line = |id: &str| {
        let all = stored["rubric"].as_array().expect("lines");
        all.iter().find(|it| it["id"] == id).expect("a line").clone()
    };
    assert_eq!([&line("specular")["points"], &line("specular")["max_points"]], [&json!(20), &json!(20)]);
    let said = line("specular")["message"].as_str().expect("text").to_owned();
    assert!(said.starts_with("Set to 20 points (40 of 40 before the line's maximum changed)"), "{said}");
    assert_eq!([&line("shape")["points"], &line("shape")["max_points"]], [&json!(0), &json!(0)]);
    let said = line("shape")["message"].as_str().expect("text").to_owned();
    assert!(said.starts_with("Set to 5 of 10 points by the course's staff. by hand"), "{said}");
    assert!(said.contains("no such line any more"), "{said}");
    assert_eq!(cells(&bench, "S1").await, ["70", "20"]);
    let adopted = get(&bench, &address).await;
    assert_eq!(adopted.all("section[aria-labelledby=people] td"), page.all("section[aria-labelledby=people] td"));
    let gradebook = api(&bench, "GET", "/api/v1/gradebook", json!({})).await.text();
    assert!(gradebook.contains("70"), "{gradebook}");
    assert!(bench.get(&format!("/r/{id}?lang=en")).await.all("#rubric-shape").concat().contains("by hand"));

    // Nobody gives points in a line that is gone, and what was given there can be taken back.
    let at = format!("/api/v1/submissions/{id}/rubric/shape");
    let refused = api(&bench, "PUT", &at, json!({ "points": 0, "reason": "x" })).await;
    assert_eq!(refused.status, StatusCode::UNPROCESSABLE_ENTITY);
    let acts = async || get(&bench, "/teacher/log").await.all(".people tbody tr").len();
    let before = acts().await;
    assert_eq!(api(&bench, "DELETE", &at, json!({})).await.status, StatusCode::NO_CONTENT);
    assert_eq!(acts().await, before + 1);
    // What is not there any more is no act.
    assert_eq!(api(&bench, "DELETE", &at, json!({})).await.status, StatusCode::NO_CONTENT);
    assert_eq!(form(&bench, &format!("/r/{id}/override"), "line=shape&wish=clear").await.status, StatusCode::SEE_OTHER);
    assert_eq!(acts().await, before + 1);
    let stored = report(&bench, &id).await;
    assert!(stored["rubric"].as_array().expect("lines").iter().all(|it| it["id"] != "shape"), "{stored}");
    bench.finish().await;
}
