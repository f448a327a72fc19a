//! Moodle's worksheet by the pages: filled in, and what could not be.

use crate::bench::Bench;
use crate::cluster::Database;
use crate::roster::{archive, file, get, made, zip};
use crate::{on_both, right};

on_both!(what_a_worksheet_lacks_is_told_beside_it,);

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
