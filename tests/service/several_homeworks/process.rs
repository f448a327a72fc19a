//! The program that serves several homeworks: what it is told at its start, and what it refuses.

use super::{folder, waves_and_new};
use crate::cluster::Database;
use crate::process::{Server, command};
use crate::right_and_new;
use serde_json::json;
use std::process::Command;

/// What `ggrade serve` says and how it ends.
fn refusal(arguments: &[&str]) -> (Option<i32>, String) {
    let folder = tempfile::tempdir().expect("a folder");
    let output = Command::new(env!("CARGO_BIN_EXE_ggrade"))
        .args(["serve", "--listen", "127.0.0.1:0", "--database"])
        .arg(folder.path().join("ggrade.db"))
        .args(arguments)
        .env("LANG", "C")
        .env_remove("GGRADE_LANG")
        .output()
        .expect("the program");
    (output.status.code(), String::from_utf8(output.stderr).expect("text"))
}

#[test]
fn two_homeworks_of_one_id_are_refused_at_the_start() {
    let copy = tempfile::tempdir().expect("a folder");
    for entry in std::fs::read_dir(folder()).expect("a folder").flatten() {
        std::fs::copy(entry.path(), copy.path().join(entry.file_name())).expect("a copy");
    }
    let (waves, copied) = (folder().display().to_string(), copy.path().display().to_string());
    let starter = copy.path().join("starter.vert");
    let text = std::fs::read_to_string(&starter).expect("a text");
    std::fs::write(&starter, text + "// another\n").expect("written");
    let (code, said) = refusal(&["--assignment", &waves, "--assignment", &copied]);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains(&copied) && said.contains("the same id, `waves`"), "{said}");
    let (code, said) = refusal(&["--assignment", "ggsample06", "--assignment", "nothing"]);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("--assignment nothing: there is no built-in assignment"), "{said}");
    let (code, said) = refusal(&["--assignment", &waves, "--homework-token", "wave=0123456789abcdef"]);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("`wave`, which is not served. Served: waves."), "{said}");
    let (code, said) = refusal(&["--homework-token", "ggsample06=short"]);
    assert_eq!(code, Some(2), "{said}");
    assert!(said.contains("homework_tokens takes at least 16 characters"), "{said}");
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn one_program_serves_several() {
    let database = Database::sqlite();
    let waves = folder().display().to_string();
    // Named twice, it is there once.
    let mut serve = command(&database);
    serve.args(["--assignment", "ggsample06", "--assignment", &waves, "--assignment", &waves]);
    let client = reqwest::Client::new();
    let mut ids = Vec::new();
    for round in 0..2 {
        let server = Server::of(&mut serve);
        for (assignment, bytes) in [("ggsample06", right_and_new()), ("waves", waves_and_new())] {
            let address = format!("{}/api/v1/submissions?assignment={assignment}", server.address);
            let answer = client.post(address).header("content-type", "text/plain").body(bytes).send().await;
            let json: serde_json::Value = answer.expect("an answer").json().await.expect("JSON");
            assert_eq!((&json["assignment"], &json["report"]["verdict"]), (&json!(assignment), &json!("correct")));
            ids.push((json["id"].as_str().expect("an id").to_owned(), assignment));
        }
        for (id, assignment) in &ids {
            let json = crate::process::look_up(&client, &server.address, id).await;
            assert_eq!((&json["assignment"], &json["report"]["verdict"]), (&json!(assignment), &json!("correct")));
        }
        let figures = client.get(format!("{}/metrics", server.address)).send().await.expect("an answer");
        let figures = figures.text().await.expect("text");
        for assignment in ["ggsample06", "waves"] {
            let line =
                format!("ggrade_gradings_total{{assignment=\"{assignment}\",via=\"api\",verdict=\"correct\"}} 1");
            assert!(figures.contains(&line), "round {round}: {figures}");
        }
        // A crash in one round, an orderly end in the other.
        if round == 0 {
            server.kill();
        } else {
            assert!(server.terminate().success());
        }
    }
    // The file of a configuration names them in a list, or the only one as it always did.
    let settings = tempfile::NamedTempFile::new().expect("a file");
    for (line, several) in
        [(format!("assignment = [\"ggsample06\", {waves:?}]"), true), ("assignment = \"ggsample06\"".into(), false)]
    {
        std::fs::write(settings.path(), line).expect("written");
        let database = Database::sqlite();
        let server = Server::of(command(&database).arg("--config").arg(settings.path()));
        let page = client.get(&server.address).send().await.expect("an answer").text().await.expect("text");
        assert_eq!(page.contains("class=\"homeworks\""), several, "{page}");
    }
}
