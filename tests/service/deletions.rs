//! What a teacher deletes is gone, with everything that belongs to it, and nothing else.

use crate::bench::{Bench, Reply};
use crate::cluster::Database;
use crate::roster::{archive, file, form, get, made, request, zip};
use crate::{on_both, right_and_new, sample};
use axum::body::Body;
use axum::http::{Request, StatusCode, header};
use std::io::{Cursor, Read};

on_both!(
    a_student_goes_with_everything_of_theirs,
    an_archive_and_a_submission_go_alone,
    a_download_that_takes_long_is_made_behind_a_page,
);

const WRONG: &str = "wrong/specular-half-unnormalized--average.vert";

async fn hand_in(bench: &Bench, student: &str, bytes: Vec<u8>) -> String {
    let address = format!("/api/v1/submissions?student={student}");
    bench.send(request("POST", &address, "text/plain", bytes)).await.id()
}

async fn status(bench: &Bench, address: &str) -> StatusCode {
    get(bench, address).await.status
}

fn moodle(name: &str, number: u32, file: &str, bytes: Vec<u8>) -> (String, Vec<u8>) {
    (format!("{name}_{number}_assignsubmission_file_/{file}"), bytes)
}

async fn a_student_goes_with_everything_of_theirs(database: Database) {
    let bench = Bench::new(database).await;
    let store = &bench.state.store;
    file(&bench, "/teacher/roster", "roster", "r.csv", "S1,和田 花子\nS2,山本 次郎\n".as_bytes()).await;
    let (theirs, shared) = (right_and_new(), sample(WRONG));
    let first = hand_in(&bench, "s1", theirs.clone()).await;
    hand_in(&bench, "s1", shared.clone()).await;
    let others = hand_in(&bench, "s2", shared.clone()).await;
    let batch = archive(
        &bench,
        zip(&[moodle("和田 花子", 11, "ggsample06.vert", theirs), moodle("山本 次郎", 12, "ggsample06.vert", shared)]),
    )
    .await;
    // Its pictures are kept here and there.
    for address in
        [format!("/r/{first}/portrait.png"), format!("/r/{first}/yours.png"), format!("/r/{first}/frames/3.png")]
    {
        assert_eq!(status(&bench, &address).await, StatusCode::OK, "{address}");
    }
    let submission = store.submission(&first).await.expect("a store").expect("a submission");
    let student = submission.student_id.clone().expect("a student");
    assert!(store.portrait(&bench.state.assignment.digest, &submission.sha256).await.expect("a store").is_some());

    let page = get(&bench, &format!("/teacher/delete?person={student}")).await;
    assert_eq!(
        page.all(".goes li"),
        ["3 submissions with their reports and pictures", "1 entry of an archive", "the line of the roster",]
    );
    assert!(page.all(".file")[0].contains("S1 和田 花子"));
    assert_eq!(status(&bench, &format!("/r/{first}")).await, StatusCode::OK, "a page that asks deletes nothing");

    let done = form(&bench, "/teacher/delete", &format!("person={student}")).await;
    assert_eq!(done.status, StatusCode::SEE_OTHER, "{done:?}");
    for address in [
        format!("/r/{first}"),
        format!("/r/{first}/portrait.png"),
        format!("/r/{first}/yours.png"),
        format!("/r/{first}/source"),
        format!("/api/v1/submissions/{first}"),
        format!("/teacher/person?key={student}"),
    ] {
        assert_eq!(status(&bench, &address).await, StatusCode::NOT_FOUND, "{address}");
    }
    assert!(!store.has_file(&submission.sha256).await.expect("a store"));
    assert!(store.portrait(&bench.state.assignment.digest, &submission.sha256).await.expect("a store").is_none());
    assert!(store.student_by_id(&student).await.expect("a store").is_none());
    for address in ["/teacher", &format!("/teacher/batches/{batch}"), "/teacher/settings"] {
        let page = get(&bench, address).await.text();
        assert!(!page.contains("和田") && !page.contains("S1<"), "{address}");
    }
    // The other one has the same file, and everything of theirs.
    assert_eq!(status(&bench, &format!("/r/{others}")).await, StatusCode::OK);
    assert_eq!(get(&bench, "/teacher").await.all(".people tbody th"), ["S2 山本 次郎"]);
    let log = get(&bench, "/teacher/settings").await.all("[aria-labelledby=deletions] li");
    assert_eq!(log.len(), 1);
    assert!(
        log[0].ends_with("A student: 3 submissions with their reports and pictures, 1 entry of an archive"),
        "{log:?}"
    );
    bench.finish().await;
}

#[tokio::test(flavor = "multi_thread")]
async fn nothing_of_who_is_deleted_stays_in_the_file() {
    let database = Database::sqlite();
    let location = database.location.clone();
    let bench = Bench::new(database).await;
    let roster = "number,name,email\nB0071234,Kuroneko Yamato,kuroneko@campus.example\nB0079999,Stays Here,\n";
    file(&bench, "/teacher/roster", "roster", "r.csv", roster.as_bytes()).await;
    let mut theirs = right_and_new();
    theirs.extend(b"// a text of their own: ultramarine\n");
    let id = hand_in(&bench, "b0071234", theirs).await;
    let reason = "line=specular&points=3&reason=because+of+vermilion";
    assert_eq!(form(&bench, &format!("/r/{id}/override"), reason).await.status, StatusCode::SEE_OTHER);
    let written = || -> Vec<u8> {
        let files = ["", "-wal"].map(|end| std::fs::read(format!("{location}{end}")).unwrap_or_default());
        files.concat()
    };
    let has = |text: &str| written().windows(text.len()).any(|window| window == text.as_bytes());
    let of_them = ["B0071234", "Kuroneko", "kuroneko@campus", "vermilion"];
    for text in of_them {
        assert!(has(text), "{text} is not in the file before");
    }
    let deleted = request("DELETE", "/api/v1/students/B0071234", "", Body::empty());
    assert_eq!(bench.send(deleted).await.status, StatusCode::OK);
    for text in of_them {
        assert!(!has(text), "{text} is in the file");
    }
    assert!(has("B0079999"));
    bench.finish().await;
}

async fn an_archive_and_a_submission_go_alone(database: Database) {
    let bench = Bench::new(database).await;
    let kept = hand_in(&bench, "s1", sample(WRONG)).await;
    let gone = hand_in(&bench, "s1", right_and_new()).await;
    let batch = archive(&bench, zip(&[moodle("和田 花子", 11, "ggsample06.vert", right_and_new())])).await;
    let entries = bench.state.store.batch_entries(&batch).await.expect("entries");
    let in_batch = entries[0].submission_id.clone().expect("a file");

    // A stranger deletes nothing, and no other page makes a teacher do it.
    let request_of = |method: &str, address: String| Request::builder().method(method).uri(address).body(Body::empty());
    let refused = bench.send(request_of("DELETE", format!("/api/v1/submissions/{gone}")).expect("a request")).await;
    assert_eq!((refused.status, refused.problem().as_str()), (StatusCode::UNAUTHORIZED, "unauthorized"));
    let session = ggrade::service::identity::new_token();
    let hash = ggrade::service::identity::token_hash(&session);
    let open = ggrade::service::store::TeacherSession::default();
    bench.state.store.open_session(&hash, &open, 0, i64::MAX).await.expect("a session");
    let forged = Request::post("/teacher/delete")
        .header(header::COOKIE, format!("ggrade_teacher={session}"))
        .header(header::CONTENT_TYPE, "application/x-www-form-urlencoded");
    let forged = bench.send(forged.body(Body::from(format!("csrf=x&submission={gone}"))).expect("a request")).await;
    assert_eq!((forged.status, forged.problem().as_str()), (StatusCode::FORBIDDEN, "csrf"));
    assert_eq!(status(&bench, &format!("/r/{gone}")).await, StatusCode::OK);

    let delete = async |address: String| bench.send(request("DELETE", &address, "", Body::empty())).await;
    let reply: Reply = delete(format!("/api/v1/submissions/{gone}")).await;
    assert_eq!(reply.status, StatusCode::OK, "{reply:?}");
    assert_eq!(reply.json()["submissions"], 1);
    assert_eq!(delete(format!("/api/v1/submissions/{gone}")).await.problem(), "not-found");
    // A file out of an archive leaves a note in its place.
    assert_eq!(delete(format!("/api/v1/submissions/{in_batch}")).await.status, StatusCode::OK);
    let page = get(&bench, &format!("/teacher/batches/{batch}")).await;
    assert_eq!(page.all(".people .mistakes"), ["deleted by the teacher"]);

    let page = get(&bench, &format!("/teacher/delete?batch={batch}")).await;
    assert_eq!(page.all(".goes li"), ["1 entry of an archive"]);
    assert_eq!(delete(format!("/api/v1/batches/{batch}")).await.json()["entries"], 1);
    assert_eq!(status(&bench, &format!("/teacher/batches/{batch}")).await, StatusCode::NOT_FOUND);
    assert_eq!(status(&bench, &format!("/r/{kept}")).await, StatusCode::OK);
    assert_eq!(delete("/api/v1/students/%EF%BD%93%EF%BC%91".into()).await.json()["submissions"], 1);
    assert_eq!(delete("/api/v1/students/s1".into()).await.problem(), "not-found");
    assert_eq!(status(&bench, &format!("/r/{kept}")).await, StatusCode::NOT_FOUND);
    bench.finish().await;
}

async fn a_download_that_takes_long_is_made_behind_a_page(database: Database) {
    let bench = Bench::new(database).await;
    hand_in(&bench, "s1", sample(WRONG)).await;
    let (_, saved) = made(&bench, form(&bench, "/teacher/downloads", "format=html").await).await;
    assert!(saved.header("content-disposition").starts_with("attachment;"));
    let mut archive = zip::ZipArchive::new(Cursor::new(saved.body)).expect("an archive");
    let mut page = String::new();
    archive.by_name("report.html").expect("the page").read_to_string(&mut page).expect("text");
    assert!(page.contains("Half vector not normalised") && page.contains("href=\"students/S1.html\""));
    assert!(archive.by_name("students/S1.html").is_ok(), "the page links to a file that is there");
    // Alone it links to nothing.
    let alone = get(&bench, "/api/v1/class/files/html").await.text();
    assert!(alone.contains("Half vector not normalised") && !alone.contains("href=\"students/"));
    assert_eq!(status(&bench, "/teacher/downloads/none").await, StatusCode::NOT_FOUND);
    assert_eq!(form(&bench, "/teacher/downloads", "format=none").await.status, StatusCode::NOT_FOUND);
    bench.finish().await;
}
