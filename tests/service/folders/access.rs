//! Who may upload, look at and publish the folder of a homework.

use super::{OF_GGSAMPLE06, OF_WAVES, bench, first, get, ids, publish, request, second, uploaded, waves};
use crate::cluster::Database;
use crate::on_both;
use axum::http::StatusCode;
use serde_json::json;

on_both!(whoever_may_not_is_kept_out, a_token_of_a_homework_opens_one_that_was_published,);

async fn whoever_may_not_is_kept_out(database: Database) {
    let bench = bench(database).await;
    let id = uploaded(&bench, first()).await;
    // Who teaches another homework sees nothing of it.
    let list = request(&bench, ("GET", "/api/v1/folders"), OF_GGSAMPLE06, Vec::new()).await;
    assert_eq!((list.status, list.json()), (StatusCode::OK, json!({"folders": []})));
    assert_eq!(bench.get("/api/v1/folders").await.status, StatusCode::UNAUTHORIZED);
    let page = request(&bench, ("GET", "/teacher/folders"), OF_GGSAMPLE06, Vec::new()).await;
    assert!(page.status == StatusCode::OK && !page.text().contains("waves"), "{page:?}");
    for (token, status) in [(OF_GGSAMPLE06, StatusCode::FORBIDDEN), ("wrong", StatusCode::UNAUTHORIZED)] {
        for target in [
            ("GET", format!("/api/v1/folders/{id}")),
            ("DELETE", format!("/api/v1/folders/{id}")),
            ("POST", "/api/v1/folders".to_owned()),
            ("POST", format!("/api/v1/folders/{id}/publication")),
            ("DELETE", format!("/api/v1/folders/{id}/publication")),
        ] {
            let reply = request(&bench, (target.0, &target.1), token, first()).await;
            assert_eq!(reply.status, status, "{target:?}");
        }
    }
    for below in ["", "/page", "/page/starter"] {
        let address = format!("/teacher/folders/{id}{below}");
        let reply = request(&bench, ("GET", &address), OF_GGSAMPLE06, Vec::new()).await;
        assert_eq!(reply.status, StatusCode::FORBIDDEN, "{address}");
        assert_eq!(bench.get(&address).await.header("location"), "/teacher/login", "{address}");
    }
    assert_eq!(bench.get("/teacher/folders").await.header("location"), "/teacher/login");
    assert_eq!(get(&bench, "/api/v1/folders").await.json()["folders"].as_array().expect("a list").len(), 1);
    assert_eq!(ids(&bench).await, ["ggsample06"]);
    let missing = publish(&bench, "00000000-0000-0000-0000-000000000000").await;
    assert_eq!(missing.status, StatusCode::NOT_FOUND);
    bench.finish().await;
}

async fn a_token_of_a_homework_opens_one_that_was_published(database: Database) {
    let bench = bench(database).await;
    let before = uploaded(&bench, first()).await;
    assert_eq!(publish(&bench, &before).await.status, StatusCode::OK);
    // By its token another version of the homework is uploaded and published, and nothing else.
    let sent = request(&bench, ("POST", "/api/v1/folders"), OF_WAVES, second()).await;
    assert_eq!(sent.status, StatusCode::CREATED, "{sent:?}");
    let folder = format!("/api/v1/folders/{}", sent.id());
    let read = request(&bench, ("GET", &folder), OF_WAVES, Vec::new()).await;
    assert_eq!((read.status, &read.json()["assignment"]), (StatusCode::OK, &json!("waves")));
    let published = request(&bench, ("POST", &format!("{folder}/publication")), OF_WAVES, Vec::new()).await;
    assert_eq!((published.status, &published.json()["is_served"]), (StatusCode::OK, &json!(true)));
    let class = request(&bench, ("GET", "/api/v1/class/files/csv?assignment=waves"), OF_WAVES, Vec::new()).await;
    assert_eq!(class.status, StatusCode::OK, "{class:?}");
    for other in ["/api/v1/class/files/csv?assignment=ggsample06", "/api/v1/gradebook", "/api/v1/staff"] {
        assert_eq!(
            request(&bench, ("GET", other), OF_WAVES, Vec::new()).await.status,
            StatusCode::FORBIDDEN,
            "{other}"
        );
    }
    let kept = request(&bench, ("DELETE", &folder), OF_WAVES, Vec::new()).await;
    assert_eq!((kept.status, kept.problem().as_str()), (StatusCode::CONFLICT, "in-use"));
    let third = waves(|_, text| text.replace("Waves", "More waves"));
    let next = request(&bench, ("POST", "/api/v1/folders"), OF_WAVES, third).await.id();
    let gone = request(&bench, ("DELETE", &format!("/api/v1/folders/{next}")), OF_WAVES, Vec::new()).await;
    assert_eq!(gone.status, StatusCode::NO_CONTENT);
    assert_eq!(get(&bench, &format!("/api/v1/folders/{next}")).await.status, StatusCode::NOT_FOUND);
    bench.finish().await;
}
