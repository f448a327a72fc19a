//! Zone and language are the course's, whoever looks.

use crate::bench::Bench;
use crate::cluster::Database;
use crate::roster::{WRONG, archive, file, form, get, made, request, zip};
use crate::{on_both, sample};
use axum::http::StatusCode;

on_both!(zone_and_language_are_the_courses);

async fn zone_and_language_are_the_courses(database: Database) {
    let bench = Bench::new(database).await;
    assert_eq!(
        form(&bench, "/teacher/settings", "closes=2099-07-01T12%3A00&hints=full&audience=open").await.status,
        303
    );
    let page = get(&bench, "/teacher/settings").await.text();
    assert!(page.contains("2099-07-01T12:00") && page.contains("Asia/Tokyo"), "whatever TZ says");
    let wrong = form(&bench, "/teacher/course", "zone=Asia%2FNowhere&language=en").await;
    assert_eq!(wrong.status, StatusCode::UNPROCESSABLE_ENTITY);
    assert!(wrong.all("[role=alert]")[0].contains("`Asia/Nowhere`") && wrong.text().contains("value=\"Asia/Nowhere\""));
    let batch =
        archive(&bench, zip(&[("和田 花子_11_assignsubmission_file_/ggsample06.vert".into(), sample(WRONG))])).await;
    // A teacher who reads English gives comments in the course's language.
    let sheet = "Identifier,Full name,Grade,Maximum Grade,Grade can be changed,Feedback comments\n\
                 Participant 11,和田 花子,,100,Yes,\n";
    let fill = async || {
        let address = format!("/teacher/batches/{batch}/worksheet");
        made(&bench, file(&bench, &address, "sheet", "g.csv", sheet.as_bytes()).await).await.1.text()
    };
    assert!(fill().await.contains("鏡面反射光"), "the usual language is Japanese");
    let asked = format!("/api/v1/batches/{batch}/files/moodle-worksheet?lang=en");
    let asked = bench.send(request("POST", &asked, "text/csv", sheet)).await.text();
    assert!(asked.contains("Specular"), "a program that asks for a language gets it");
    assert!(get(&bench, &format!("/api/v1/batches/{batch}/files/csv")).await.text().contains("Half vector"));

    assert_eq!(form(&bench, "/teacher/course", "zone=America%2FNew_York&language=en").await.status, 303);
    assert!(fill().await.contains("Specular"));
    // The deadline is the same moment: noon in Tokyo is eleven at night in New York.
    assert!(get(&bench, "/teacher/settings").await.text().contains("2099-06-30T23:00"));
    let desk = bench.get("/?lang=en").await;
    assert!(
        desk.all(".terms-of-hand-in").concat().contains("30 Jun 2099, 23:00"),
        "{:?}",
        desk.all(".terms-of-hand-in")
    );
    bench.finish().await;
}
