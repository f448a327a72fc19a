//! Killed at random moments under load: what was acknowledged is graded, once.

use crate::cluster::Database;
use crate::on_both;
use crate::process::{Server, command, hand_in, look_up};
use ggrade::service::identity::new_token;
use ggrade::service::store::Store;
use std::collections::HashMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

on_both!(nothing_acknowledged_is_lost_and_nothing_is_doubled);

/// How often the server is killed, the people who hand in meanwhile, and how many files each of them has at most.
const KILLS: usize = 4;
const PEOPLE: usize = 6;
const FILES: usize = 4;

async fn nothing_acknowledged_is_lost_and_nothing_is_doubled(database: Database) {
    // Some are graded at once, some take a while, some are refused.
    let files: Arc<Vec<(Vec<u8>, &str)>> = Arc::new(vec![
        (crate::right(), "correct"),
        (crate::sample("wrong/specular-half-unnormalized--average.vert"), "wrong"),
        (crate::sample("rejected/brace-missing-at-end.vert"), "rejected"),
    ]);
    let mut acknowledged: HashMap<String, (String, &str)> = HashMap::new();
    let mut sent = 0;
    for round in 0..KILLS {
        // Uploads are acknowledged long before they are graded.
        let server = Server::of(command(&database).env("GGRADE_WAIT", "0.1"));
        let acknowledgements = Arc::new(AtomicUsize::new(0));
        let mut people = tokio::task::JoinSet::new();
        for person in 0..PEOPLE {
            let (files, address) = (Arc::clone(&files), server.address.clone());
            let acknowledgements = Arc::clone(&acknowledgements);
            people.spawn(async move {
                let client = reqwest::Client::new();
                let mut told = Vec::new();
                let mut sent = 0;
                for number in 0..FILES {
                    let (bytes, verdict) = &files[(person + number) % files.len()];
                    let mark = format!("\n// round {round}, person {person}, file {number}\n");
                    sent += 1;
                    let answer = hand_in(&client, &address, [bytes, mark.as_bytes()].concat()).await;
                    let Some((status, json)) = answer else { break };
                    assert!(matches!(status, 201 | 202), "{status}: {json}");
                    acknowledgements.fetch_add(1, Ordering::SeqCst);
                    told.push((json["id"].as_str().expect("an id").to_owned(), (mark, *verdict)));
                }
                (told, sent)
            });
        }
        // Any moment will do after the first answers: while files are stored, wait, are graded.
        let give_up = Instant::now() + Duration::from_secs(60);
        while acknowledgements.load(Ordering::SeqCst) <= 2 * round && Instant::now() < give_up {
            tokio::time::sleep(Duration::from_millis(5)).await;
        }
        let moment = u64::from_str_radix(&new_token()[..2], 16).expect("hex");
        tokio::time::sleep(Duration::from_millis(moment)).await;
        server.kill();
        while let Some(person) = people.join_next().await {
            let (told, count) = person.expect("a person");
            acknowledged.extend(told);
            sent += count;
        }
    }
    let server = Server::start(&database);
    let client = reqwest::Client::new();
    for (id, (mark, verdict)) in &acknowledged {
        let mut json = look_up(&client, &server.address, id).await;
        for _ in 0..600 {
            if json["state"] == "graded" {
                break;
            }
            tokio::time::sleep(Duration::from_millis(100)).await;
            json = look_up(&client, &server.address, id).await;
        }
        assert_eq!(json["report"]["verdict"], *verdict, "{id}: {json}");
        let source = client.get(format!("{}/api/v1/submissions/{id}/source", server.address)).send().await;
        let source = source.expect("an answer").text().await.expect("a file");
        assert!(source.ends_with(mark.as_str()), "{id} is another file");
    }
    // What was stored and never acknowledged is graded as well.
    for _ in 0..600 {
        let figures = client.get(format!("{}/metrics", server.address)).send().await.expect("an answer");
        if figures.text().await.expect("text").contains("\nggrade_submissions_waiting 0\n") {
            break;
        }
        tokio::time::sleep(Duration::from_millis(100)).await;
    }
    assert!(server.terminate().success());
    assert!(acknowledged.len() > 2 * KILLS, "too few to prove anything: {}", acknowledged.len());

    let store = Store::open(&database.location.parse().expect("a location")).await.expect("a database");
    let class = store.class("ggsample06", None).await.expect("a class");
    // Every file was marked, so a file that stands twice was stored twice.
    let mut files: Vec<_> = class.iter().map(|row| &row.row.submission.sha256).collect();
    files.sort();
    files.dedup();
    assert_eq!(files.len(), class.len());
    assert!((acknowledged.len()..=sent).contains(&class.len()), "{} of {sent}", class.len());
    assert!(class.iter().all(|row| row.row.verdict.is_some()), "some were never graded");
    store.close().await;
}

/// What docs/service.md says of two processes: the second one takes over what the first one left, and nothing is doubled.
#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn what_a_process_leaves_is_graded_by_another_one_on_the_same_database() {
    let database = Database::postgres().await;
    let [first, second] = [0; 2].map(|_| Server::of(command(&database).env("GGRADE_WAIT", "0.1")));
    let client = reqwest::Client::new();
    let mut ids = Vec::new();
    for number in 0..8 {
        let bytes = [crate::right(), format!("\n// {number}\n").into_bytes()].concat();
        let (status, json) = hand_in(&client, &first.address, bytes).await.expect("an answer");
        assert!(matches!(status, 201 | 202), "{status}: {json}");
        ids.push(json["id"].as_str().expect("an id").to_owned());
    }
    first.kill();
    for id in &ids {
        let mut json = look_up(&client, &second.address, id).await;
        for _ in 0..600 {
            if json["state"] == "graded" {
                break;
            }
            tokio::time::sleep(Duration::from_millis(100)).await;
            json = look_up(&client, &second.address, id).await;
        }
        assert_eq!(json["report"]["verdict"], "correct", "{id}: {json}");
    }
    assert!(second.terminate().success());
    let store = Store::open(&database.location.parse().expect("a location")).await.expect("a database");
    assert_eq!(store.class("ggsample06", None).await.expect("a class").len(), ids.len());
    store.close().await;
}
