//! What is said of a course that a program sets up: what is wrong with what it sent, in both languages.

use super::{api, bench};
use crate::bench::TEACHER;
use crate::cluster::Database;
use crate::on_both;
use axum::http::{Method, StatusCode};
use serde_json::{Value, json};

on_both!(a_refusal_names_the_member_and_what_it_takes,);

async fn a_refusal_names_the_member_and_what_it_takes(database: Database) {
    let bench = bench(database).await;
    let settings = "/api/v1/assignments/ggsample06/settings";
    let detail = async |method: &Method, address: &str, body: &Value, language: &str| {
        let reply = api(&bench, TEACHER, method.clone(), &format!("{address}?lang={language}"), body).await;
        assert_eq!(reply.status, StatusCode::UNPROCESSABLE_ENTITY, "{body}");
        reply.json()["detail"].as_str().expect("a detail").to_owned()
    };
    let (patch, put, post) = (Method::PATCH, Method::PUT, Method::POST);
    for (method, address, body, en, ja) in [
        (
            &patch,
            settings,
            json!({ "attempts": -1 }),
            "`attempts` takes a whole number from 0 or null, not -1.",
            "`attempts` に -1 は指定できません。指定できる値: 0 以上の整数、null",
        ),
        (
            &patch,
            settings,
            json!({ "counting": "most" }),
            "`counting` takes `best` or `last` or `chosen`, not \"most\".",
            "`counting` に \"most\" は指定できません。指定できる値: `best`、`last`、`chosen` のいずれか",
        ),
        (
            &patch,
            settings,
            json!({ "due_at": "tomorrow" }),
            "`due_at` takes a time such as 2027-06-01T23:59:00+09:00 or null, not \"tomorrow\".",
            "`due_at` に \"tomorrow\" は指定できません。指定できる値: 2027-06-01T23:59:00+09:00 の形式の日時、null",
        ),
        (
            &patch,
            settings,
            json!({ "late_percent": 101 }),
            "Deduction: a number from 0 to 100, in percent of all points.",
            "減点は 0 から 100 までの数（満点に対する %）で入力してください。",
        ),
        (
            &patch,
            "/api/v1/course",
            json!({ "language": "fr" }),
            "`language` takes `ja` or `en`, not \"fr\".",
            "`language` に \"fr\" は指定できません。指定できる値: `ja`、`en` のいずれか",
        ),
        (
            &post,
            "/api/v1/staff",
            json!({ "login": "ta", "role": "boss" }),
            "`role` takes `assistant` or `lecturer` or `administrator`, not \"boss\".",
            "`role` に \"boss\" は指定できません。指定できる値: `assistant`、`lecturer`、`administrator` のいずれか",
        ),
        (
            &post,
            "/api/v1/courses",
            json!({ "title": "X" }),
            "`id` is missing: it takes a text.",
            "`id` がありません。指定できる値: 文字列",
        ),
        (
            &put,
            "/api/v1/plan",
            json!({ "assignments": "ggsample06" }),
            "`assignments` takes a list, not \"ggsample06\".",
            "`assignments` に \"ggsample06\" は指定できません。指定できる値: リスト",
        ),
    ] {
        assert_eq!(detail(method, address, &body, "en").await, en);
        assert_eq!(detail(method, address, &body, "ja").await, ja);
    }
    let unknown = detail(&patch, settings, &json!({ "due": null }), "en").await;
    assert!(unknown.starts_with("There is no `due` here. There are `opens_at`, `due_at`, "), "{unknown}");
    bench.finish().await;
}
