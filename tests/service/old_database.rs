//! A database of an earlier version opens, and all is there.

use crate::bench::Bench;
use crate::cluster::Database;
use crate::roster::{get, roster};

/// Makes a database as version 0.1.0 left it: its tables, a student, a graded file, and an archive with an entry.
macro_rules! old_database {
    ($pool:expr, $kind:literal) => {{
        let pool = $pool.await.expect("a database");
        let folder = tempfile::tempdir().expect("a folder");
        let name = "0001_service.sql";
        let from = std::path::Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("src/service/store/migrations")
            .join($kind)
            .join(name);
        std::fs::copy(from, folder.path().join(name)).expect("the first migration");
        let migrator = sqlx::migrate::Migrator::new(folder.path()).await.expect("a migration");
        migrator.run(&pool).await.expect("the tables of 0.1.0");
        for sql in OLD_ROWS {
            sqlx::query(*sql).execute(&pool).await.unwrap_or_else(|error| panic!("{sql}: {error}"));
        }
        pool.close().await;
    }};
}

const OLD_ROWS: &[&str] = &[
    "INSERT INTO assignments (id, seed, hints, audience) VALUES ('ggsample06', 7, 'full', 'open')",
    "INSERT INTO students (id, number, name, on_roster, created_at) VALUES ('st', 'S1', '和田 花子', 1, 5)",
    "INSERT INTO batches (id, assignment, title, refused, created_at) VALUES ('ba', 'ggsample06', 'old', '[]', 6)",
    "INSERT INTO uploads (sha256, bytes) VALUES ('00', '')",
    "INSERT INTO submissions (id, assignment, sha256, name, student_id, via, seed, hints, received_at, state, tries, \
     priority, claimed_until) VALUES ('gr', 'ggsample06', '00', 'b.vert', 'st', 'page', 7, 'full', 7, 'graded', 0, 0, 0)",
    // As 0.1.0 wrote it: one `source`, and no file in a diagnostic.
    "INSERT INTO reports (submission_id, graded_at, verdict, score, max_score, mistakes, report, ggrade, reused) VALUES \
     ('gr', 8, 'rejected', 0, 100, '[]', '{\"cross_check\":null,\"assignment\":\"ggsample06\",\"source\":{\"name\":\
     \"b.vert\",\"sha256\":\"00\",\"bytes\":0,\"encoding\":\"utf-8\"},\"verdict\":\"rejected\",\"score\":0.0,\
     \"max_score\":100.0,\"rubric\":[],\"mistakes\":[],\"explanation\":null,\"diagnostics\":[{\"severity\":\"error\",\
     \"stage\":\"compile\",\"line\":3,\"column\":1,\"length\":1,\"message\":{\"en\":\"no\",\"ja\":\"否\"},\
     \"hint\":null}],\"frames\":[],\"probes\":{\"seed\":7,\"samples\":0,\"mismatched\":0,\"max_difference\":null},\
     \"environment\":{\"ggrade\":\"0.1.0\",\"renderer\":\"\",\"driver\":\"\"},\"elapsed_ms\":1.0}', '0.1.0', 0)",
    "INSERT INTO portraits (assignment, sha256, png) VALUES ('ggsample06', '00', NULL)",
    "INSERT INTO submissions (id, assignment, sha256, name, batch_id, via, seed, hints, received_at, state, tries, \
     priority, claimed_until) VALUES ('su', 'ggsample06', '00', 'a.vert', 'ba', 'batch', 7, 'full', 6, 'failed', 9, 0, 0)",
    "INSERT INTO batch_entries (batch_id, position, student, path, submission_id) VALUES ('ba', 0, \
     '{\"key\":\"11\",\"name\":\"花子 和田\",\"moodle\":{\"name\":\"花子 和田\",\"number\":11}}', 'old.zip/x', 'su')",
];

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_database_of_0_1_0_opens_and_loses_nothing() {
    for database in [Database::sqlite(), Database::postgres().await] {
        if database.location.starts_with("postgres") {
            old_database!(sqlx::PgPool::connect(&database.location), "postgres");
        } else {
            let options =
                sqlx::sqlite::SqliteConnectOptions::new().filename(&database.location).create_if_missing(true);
            old_database!(sqlx::SqlitePool::connect_with(options), "sqlite");
        }
        let bench = Bench::new(database).await;
        assert_eq!(bench.state.store.assignment("ggsample06").await.expect("a store").seed, 7);
        // A row of one file reads as a hand-in of one file.
        let store = &bench.state.store;
        let hand_in = store.hand_in("gr").await.expect("a store").expect("its file");
        assert_eq!(hand_in, ggrade::hand_in::HandIn::of_one("b.vert", ""));
        let stored = store.stored("gr").await.expect("a store").expect("a submission");
        assert_eq!((stored.submission.sha256.as_str(), stored.submission.name.as_str()), ("00", "b.vert"));
        let report = bench.get("/api/v1/submissions/gr").await.json()["report"].take();
        assert_eq!(report["source"]["name"], "b.vert");
        assert_eq!(report["sources"].as_array().map(Vec::len), Some(1));
        assert_eq!(
            (&report["diagnostics"][0]["file"], &report["diagnostics"][0]["line"]),
            (&"b.vert".into(), &3.into())
        );
        // Nobody knows under which version of the homework the old picture was drawn: it is drawn again for who looks.
        let digest = &bench.state.assignment.digest;
        assert_eq!(store.portrait(digest, "00").await.expect("a store"), None);
        let entries = bench.state.store.batch_entries("ba").await.expect("a store");
        assert_eq!((entries.len(), entries[0].student.name.as_str(), &entries[0].student_id), (1, "花子 和田", &None));
        // Its archive is matched to a roster as a new one is.
        roster(&bench, "S1,和田 花子\n").await;
        let page = get(&bench, "/teacher").await;
        assert_eq!(page.all(".people tbody th"), ["S1 和田 花子"]);
        assert_eq!(page.all(".people tbody td:nth-child(6)"), ["2"], "one by the page, one in the archive");
        bench.finish().await;
    }
}
