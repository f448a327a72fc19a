//! What is said of a course that a program sets up: what is wrong with what it sent, and the log, in both languages.

use super::{api, bench, done};
use crate::bench::TEACHER;
use crate::cluster::Database;
use crate::on_both;
use crate::roster::{form, get};
use axum::http::{Method, StatusCode};
use ggrade::service::store::{StaffMember, StaffRole};
use serde_json::{Value, json};

on_both!(a_refusal_names_the_member_and_what_it_takes, the_log_says_what_changed_and_from_what,);

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

async fn the_log_says_what_changed_and_from_what(database: Database) {
    let bench = bench(database).await;
    let settings = "/api/v1/assignments/ggsample06/settings";
    let rules = json!({ "due_at": "2030-06-01T00:00:00Z", "attempts": 3, "hints": "none", "points": 40 });
    done(&bench, Method::PATCH, settings, rules).await;
    done(&bench, Method::PATCH, "/api/v1/course", json!({ "language": "en", "title": "Graphics, full" })).await;
    form(&bench, "/teacher/plan", "points.ggsample06=&seen.ggsample06=hidden").await;
    let assistant = StaffMember {
        id: "ta".into(),
        login: "ta".into(),
        name: "TA".into(),
        role: StaffRole::Assistant,
        has_password: false,
        is_active: true,
    };
    assert!(bench.state.store.add_staff(&assistant, 0).await.expect("a store"));
    done(&bench, Method::PATCH, "/api/v1/staff/ta", json!({ "role": "lecturer", "is_active": false })).await;
    let lines = async |language: &str| {
        let all = get(&bench, &format!("/teacher/log?lang={language}")).await.all(".people tbody td.mistakes");
        all.into_iter().rev().collect::<Vec<_>>()
    };
    let en = [
        "closes: – → 2030-06-01T09:00, attempts: – → 3, hints: full → none, points: – → 40",
        "language: ja → en, title: – → Graphics, full",
        "ggsample06 points: 40 → –, ggsample06 shown: now → hidden",
        "ta role: assistant → lecturer, login: on → off",
    ];
    assert_eq!(lines("en").await, en);
    let ja = [
        "締切: – → 2030-06-01T09:00、提出回数: – → 3、ヒント: 行まで → なし、配点: – → 40",
        "言語: 日本語 → 英語、授業名: – → Graphics, full",
        "ggsample06 配点: 40 → –、ggsample06 公開: 公開中 → 非公開",
        "ta 権限: アシスタント → 担当教員、ログイン: オン → オフ",
    ];
    assert_eq!(lines("ja").await, ja);
    bench.finish().await;
}
