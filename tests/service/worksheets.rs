//! Moodle's worksheet by the pages: filled in, and what could not be.

use crate::bench::Bench;
use crate::cluster::Database;
use crate::roster::{archive, file, get, made, request, roster, zip};
use crate::{on_both, right};
use axum::http::StatusCode;

on_both!(what_a_worksheet_lacks_is_told_beside_it, a_worksheet_is_filled_in_with_what_was_handed_in_here,);

async fn what_a_worksheet_lacks_is_told_beside_it(database: Database) {
    let bench = Bench::new(database).await;
    let member = |name: &str, number: u32| (format!("{name}_{number}_assignsubmission_file_/ggsample06.vert"), right());
    let batch = archive(&bench, zip(&[member("和田 花子", 11), member("山本 次郎", 12), member("林 空", 13)])).await;
    let sheet = "Identifier,Full name,Grade,Maximum Grade,Grade can be changed,Feedback comments\n\
                 Participant 11,和田 花子,,100,Yes,\nParticipant 12,山本 次郎,,100,No,\nParticipant 99,Nobody,,100,Yes,\n";
    for (language, notes) in [
        (
            "en",
            [
                "Not in the worksheet: 林 空.",
                "In the worksheet without a submission in the class, left as they are: Participant 99.",
                "Moodle says that these grades cannot be changed, left as they are: 山本 次郎.",
            ],
        ),
        (
            "ja",
            [
                "ワークシートに行がありません：林 空",
                "ワークシートにありますが提出がないため、行をそのまま残しました：Participant 99",
                "Moodle で評定の変更が許可されていないため、行をそのまま残しました：山本 次郎",
            ],
        ),
    ] {
        let address = format!("/teacher/batches/{batch}/worksheet?lang={language}");
        let begun = file(&bench, &address, "sheet", "g.csv", sheet.as_bytes()).await;
        let address = format!("{}?lang={language}", begun.header("location"));
        let (_, saved) = made(&bench, begun).await;
        assert!(saved.text().contains("Participant 11,和田 花子,100,"), "{}", saved.text());
        assert_eq!(get(&bench, &address).await.all(".remarks li"), notes);
    }
    bench.finish().await;
}

/// Students hand in here, and Moodle has the grades: its worksheet knows them by other numbers.
async fn a_worksheet_is_filled_in_with_what_was_handed_in_here(database: Database) {
    let bench = Bench::new(database).await;
    roster(
        &bench,
        "ID number,Full name,Identifier\nS1,和田 花子,\nS2,山本 次郎,\nS3,林 空,\nS4,Kim Min,Participant 14\n",
    )
    .await;
    for number in ["S1", "S2", "S4"] {
        let address = format!("/api/v1/submissions?student={number}");
        let reply = bench.send(request("POST", &address, "text/plain", right())).await;
        assert_eq!(reply.status, StatusCode::CREATED, "{reply:?}");
    }
    // By name, by number, and by Moodle's number, whatever the name.
    let sheet = "Identifier,Full name,ID number,Grade,Maximum Grade,Grade can be changed,Feedback comments\n\
                 Participant 11,花子 和田,,,100,Yes,\nParticipant 12,J. Yamamoto,S2,,100,Yes,\n\
                 Participant 13,林 空,,,100,Yes,\nParticipant 14,Kim Min,,,100,Yes,\nParticipant 99,Nobody,,,100,Yes,\n";
    let address = "/api/v1/class/files/moodle-worksheet";
    let filled = bench.send(request("POST", address, "text/csv", sheet)).await;
    assert_eq!(filled.status, StatusCode::OK, "{}", filled.text());
    let rows = filled.text();
    for row in ["Participant 11,花子 和田,,100,", "12,J. Yamamoto,S2,100,", "13,林 空,,,100,", "14,Kim Min,,100,"]
    {
        assert!(rows.contains(row), "{row}: {rows}");
    }
    assert!(rows.contains("Participant 99,Nobody,,,100,Yes,\n"), "{rows}");
    // By the page of the class as well, which says whose row nobody handed in for.
    let begun = file(&bench, "/teacher/worksheet?lang=en", "sheet", "g.csv", sheet.as_bytes()).await;
    let page = format!("{}?lang=en", begun.header("location"));
    let (_, saved) = made(&bench, begun).await;
    assert!(saved.text().contains("12,J. Yamamoto,S2,100,"), "{}", saved.text());
    assert!(get(&bench, &page).await.all(".remarks li").concat().contains("Participant 99"));
    let wrong = file(&bench, "/teacher/worksheet", "sheet", "g.csv", b"no,worksheet\n").await;
    assert_eq!((wrong.status, wrong.all("#sheet-wrong").len()), (StatusCode::UNPROCESSABLE_ENTITY, 1));

    // Feedback goes to the participants of the worksheet; where none is known, there is no empty archive.
    let address = "/api/v1/class/files/moodle-feedback";
    let feedback = bench.send(request("POST", address, "text/csv", sheet)).await;
    let zip = zip::ZipArchive::new(std::io::Cursor::new(feedback.body)).expect("an archive");
    let names: Vec<String> = zip.file_names().map(|name| name.expect("a name").into_owned()).collect();
    assert_eq!(names.len(), 4, "{names:?}");
    assert!(names.iter().any(|name| name.contains("_12_assignfeedback_file")), "{names:?}");
    let others = "Identifier,Full name,Grade,Maximum Grade\nParticipant 99,Nobody,,100\n";
    for empty in [get(&bench, address).await, bench.send(request("POST", address, "text/csv", others)).await] {
        assert_eq!((empty.status, empty.problem().as_str()), (StatusCode::UNPROCESSABLE_ENTITY, "unprocessable"));
    }
    bench.finish().await;
}
