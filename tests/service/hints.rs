//! Where a teacher lets messages say only what is seen, nothing that students get says more.

use crate::bench::{Bench, Reply};
use crate::cluster::Database;
use crate::roster::{archive, file, form, get, made, zip};
use crate::{on_both, sample};
use std::io::{Cursor, Read};

on_both!(without_hints_nothing_for_students_names_the_mistake,);

const WRONG: &str = "wrong/specular-half-unnormalized--average.vert";
const BROKEN: &str = "rejected/undeclared-capital-max.vert";

/// The name of the mistake, and the line at which it is.
const ANSWERS: [&str; 5] = [
    "specular-half-unnormalized",
    "Half vector not normalised",
    "中間ベクトルが正規化されていない",
    "line 33",
    "33 行目",
];
/// The hint at the error, in both languages.
const HINTS: [&str; 2] = ["Did you mean", "間違いではありませんか"];

/// All text of an answer: of a ZIP, that of all its files.
fn text(reply: &Reply) -> String {
    let Ok(mut archive) = zip::ZipArchive::new(Cursor::new(&reply.body)) else { return reply.text() };
    let mut all = String::new();
    for index in 0..archive.len() {
        let mut bytes = Vec::new();
        archive.by_index(index).expect("a member").read_to_end(&mut bytes).expect("its bytes");
        all += &String::from_utf8_lossy(&bytes);
    }
    all
}

async fn without_hints_nothing_for_students_names_the_mistake(database: Database) {
    let bench = Bench::new(database).await;
    let formats = ["gradescope", "github", "classroom-legacy", "vpl", "coderunner"];
    for (hints, tells) in [("full", true), ("none", false)] {
        assert_eq!(form(&bench, "/teacher/settings", &format!("hints={hints}&audience=open")).await.status, 303);
        let named = |said: &str| ANSWERS.iter().any(|answer| said.contains(answer));
        let member = |number: u32, path| (format!("A B_{number}_assignsubmission_file_/ggsample06.vert"), sample(path));
        let batch = archive(&bench, zip(&[member(11, WRONG), member(12, BROKEN)])).await;
        let wrong = bench.hand_in("?name=a.vert", sample(WRONG)).await.id();
        let broken = bench.hand_in("?name=a.vert", sample(BROKEN)).await.id();
        for language in ["en", "ja"] {
            for (address, telling) in [
                (format!("/r/{wrong}?lang={language}"), &ANSWERS[..]),
                (format!("/r/{wrong}/part?lang={language}"), &ANSWERS),
                (format!("/r/{wrong}/receipt?lang={language}"), &ANSWERS),
                (format!("/api/v1/submissions/{wrong}?lang={language}"), &ANSWERS),
                (format!("/r/{broken}?lang={language}"), &HINTS),
                (format!("/api/v1/submissions/{broken}?lang={language}"), &HINTS),
            ] {
                let page = bench.get(&address).await.text();
                assert_eq!(telling.iter().any(|words| page.contains(words)), tells, "{hints} {address}: {page}");
            }
            for format in formats {
                let address = format!("/api/v1/batches/{batch}/files/{format}?lang={language}");
                let made = text(&get(&bench, &address).await);
                assert!(tells || !named(&made), "{address}: {made}");
            }
        }
        let sheet = "Identifier,Full name,Grade,Maximum Grade,Grade can be changed,Feedback comments\n\
                     Participant 11,A B,,100,Yes,\n";
        let address = format!("/teacher/batches/{batch}/worksheet");
        let (_, filled) = made(&bench, file(&bench, &address, "sheet", "g.csv", sheet.as_bytes()).await).await;
        assert!(filled.text().contains(",80,") && named(&filled.text()) == tells, "{hints}: {}", filled.text());
        let feedback = get(&bench, &format!("/api/v1/batches/{batch}/files/moodle-feedback")).await;
        assert_eq!(named(&text(&feedback)), tells, "{hints}");
        // The teacher's own page and table have the names all the same.
        let page = get(&bench, &format!("/teacher/batches/{batch}")).await.text();
        assert!(page.contains("Half vector not normalised"), "{page}");
        assert!(get(&bench, &format!("/api/v1/batches/{batch}/files/csv")).await.text().contains(ANSWERS[0]));
    }
    bench.finish().await;
}
