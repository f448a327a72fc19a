//! Who may hand in where nobody chose it, and what is said to whoever hands in without a number.

use crate::bench::{Bench, Fake, config};
use crate::cluster::Database;
use crate::codes::Guest;
use crate::on_both;
use crate::roster::{form, get, roster};
use axum::http::StatusCode;
use ggrade::service::clock::Clock;
use ggrade::service::identity::personal_code;
use std::sync::Arc;

on_both!(with_a_roster_a_number_is_needed_unless_somebody_says_otherwise, a_hand_in_without_a_number_says_so);

const OPEN: &str = "hints=full&practice=on&audience=open";

async fn chosen(bench: &Bench) -> String {
    get(bench, "/teacher/settings").await.all("#audience option[selected]").concat()
}

async fn with_a_roster_a_number_is_needed_unless_somebody_says_otherwise(database: Database) {
    let bench = Bench::with(database, config(), Arc::new(Fake(|| Ok(()))), Clock::system()).await;
    let guest = Guest::new(&bench).await;
    assert_eq!(guest.hand_in(&bench, "practice").await.status, StatusCode::CREATED);
    // Saving what the form shows is no choice.
    assert_eq!(form(&bench, "/teacher/settings", OPEN).await.status, StatusCode::SEE_OTHER);
    assert_eq!(chosen(&bench).await, "anybody (open practice)");
    roster(&bench, "S1,A\n").await;
    assert_eq!(chosen(&bench).await, "whoever came by the course link and gave a student number");
    assert_eq!(guest.hand_in(&bench, "for nobody").await.problem(), "no-number");
    assert_eq!(form(&bench, "/teacher/settings", OPEN).await.status, StatusCode::SEE_OTHER);
    assert_eq!(chosen(&bench).await, "anybody (open practice)");
    assert_eq!(guest.hand_in(&bench, "open practice").await.status, StatusCode::CREATED);
    bench.finish().await;
}

const RIGHT: &str = include_str!("../../submissions/ggsample06/accepted/answers/all-in-one-expression.vert");

async fn a_hand_in_without_a_number_says_so(database: Database) {
    let bench = Bench::new(database).await;
    let guest = Guest::new(&bench).await;
    let said = async |address: &str| guest.get(&bench, address).await.all("main .notice").concat();
    let alone = guest.hand_in(&bench, "void main() { gl_Position = vec4(0.0); }").await.id();
    // Where there is no roster, nothing is missing.
    assert_eq!(said("/a/ggsample06").await, "");
    assert!(!said(&format!("/r/{alone}")).await.contains("counts for nobody"));
    roster(&bench, "S1,A\n").await;
    form(&bench, "/teacher/settings", OPEN).await;
    let without = guest.hand_in(&bench, RIGHT).await.id();
    for address in ["/a/ggsample06".to_owned(), format!("/r/{without}")] {
        assert!(said(&address).await.contains("it counts for nobody"), "{address}");
        let japanese = said(&format!("{address}?lang=ja")).await;
        assert!(japanese.contains("だれの成績にもなりません"), "{japanese}");
    }
    let facts = async || guest.get(&bench, "/a/ggsample06").await.all("#facts li").concat();
    assert!(facts().await.contains("Best so far 100 / 100"), "{}", facts().await);

    // Once a number is there, what was handed in without it is listed and is not the best.
    let student = bench.state.store.student_by_number("S1").await.expect("a store").expect("a student");
    guest.join(&bench, "S1", &personal_code(&bench.state, &student)).await;
    assert!(!facts().await.contains("Best so far"), "{}", facts().await);
    let desk = guest.get(&bench, "/a/ggsample06").await;
    assert_eq!((desk.all(".attempts li").len(), desk.all(".attempts .best").len()), (2, 0));
    assert_eq!(said("/a/ggsample06").await, "");
    let counts = guest.hand_in(&bench, "void main() { gl_Position = vec4(1.0); }").await.id();
    assert!(facts().await.contains("Best so far 0 / 100"), "{}", facts().await);
    assert!(!said(&format!("/r/{counts}")).await.contains("counts for nobody"));
    bench.finish().await;
}
