//! The log of what teachers did, for lecturers to read.

mod words;

use super::super::datetime::TimeElement;
use super::super::frame::PageFrame;
use super::super::shown;
use super::Tab;
use super::pager::Pager;
use crate::language::Language;
use crate::service::Service;
use crate::service::errors::Problem;
use crate::service::identity::LecturerPage;
use crate::service::store::NamedAct;
use askama::Template;
use axum::extract::{Query, State as Shared};
use axum::response::Response;
use serde::Deserialize;

#[derive(Template)]
#[template(path = "service/pages/templates/acts.html")]
struct ActsPage {
    frame: PageFrame,
    place: Tab,
    csrf: String,
    acts: Vec<ActLine>,
    pager: Pager,
}

/// A line of the log.
struct ActLine {
    at: TimeElement,
    who: String,
    act: String,
    homework: String,
    student: String,
    detail: String,
}

/// Which page.
#[derive(Debug, Default, Deserialize)]
#[serde(default)]
pub(in crate::service::pages) struct LogPageQuery {
    page: String,
}

/// What an act is called; one without a name by its own word.
fn named(frame: &PageFrame, act: &str) -> String {
    let known = match act {
        "login" => frame.say("Logged in", "ログイン"),
        "logout" => frame.say("Logged out", "ログアウト"),
        "settings" => frame.say("Changed how handing in works", "提出の条件を変更"),
        "course" => frame.say("Changed the course", "授業の設定を変更"),
        "link" => frame.say("Made a new course link", "授業リンクを再発行"),
        "courses" => frame.say("Made or archived a course", "授業を作成・アーカイブ"),
        "plan" => frame.say("Changed the course's homeworks", "授業の課題を変更"),
        "folder" => frame.say("Changed a homework's folder", "課題のフォルダを変更"),
        "roster" => frame.say("Imported a roster", "名簿を取り込み"),
        "code" => frame.say("Replaced a personal code", "個人コードを再発行"),
        "person-added" => frame.say("Let somebody in", "担当者を追加"),
        "pseudonyms" => frame.say("Set what assistants read", "アシスタントへの氏名の表示を変更"),
        "exported" => frame.say("Saved everything of a student", "学生のデータを一括保存"),
        "person" => frame.say("Changed an account", "アカウントを変更"),
        "platform" => frame.say("Changed a learning platform", "学習プラットフォームを変更"),
        "token" => frame.say("Made or ended a token", "トークンを作成または無効化"),
        "extension" => frame.say("Set an own deadline", "締切の延長を変更"),
        "choice" => frame.say("Chose which hand-in counts", "成績に反映する提出を変更"),
        "override" => frame.say("Overrode points", "得点を変更"),
        "comment" => frame.say("Commented on a line", "行にコメント"),
        "appeal" => frame.say("Handled a request", "再確認の依頼に対応"),
        "archive" => frame.say("Uploaded an archive", "アーカイブを採点"),
        "download" => frame.say("Made a download", "ダウンロードを作成"),
        "regrading" => frame.say("Had everything graded again", "再採点を開始"),
        "adopted" => frame.say("Adopted new results", "再採点の結果を採用"),
        "deleted" => frame.say("Deleted", "削除"),
        "handed-in" => frame.say("Handed in for a student", "学生の代わりに提出"),
        other => return other.to_owned(),
    };
    known.to_owned()
}

fn who(frame: &PageFrame, act: &NamedAct) -> String {
    match (&act.login, act.act.way.as_str()) {
        (Some(login), "token") => format!("{login} ({})", frame.say("by a token", "トークン")),
        (Some(login), _) => login.clone(),
        (None, "token") => frame.say("a program, by a token", "プログラム（トークン）").to_owned(),
        (None, _) => frame.say("by a secret of the service", "サービス共通のパスワード").to_owned(),
    }
}

/// `GET /teacher/log`.
pub(in crate::service::pages) async fn page(
    Shared(service): Shared<Service>,
    LecturerPage(teacher): LecturerPage,
    Query(LogPageQuery { page }): Query<LogPageQuery>,
    frame: PageFrame,
) -> Result<Response, Problem> {
    let total = service.store.count_acts(teacher.homework()).await?;
    let pager = Pager::new(total, &page, |page| format!("?page={page}"));
    let acts = service.store.acts(teacher.homework(), pager.from, pager.to - pager.from).await?;
    let detail = |act: &str, detail: String| match frame.language {
        Language::En => detail,
        Language::Ja => words::in_japanese(act, &detail),
    };
    let line = |act: NamedAct| ActLine {
        at: frame.exact_datetime(act.act.at),
        who: who(&frame, &act),
        act: named(&frame, &act.act.act),
        homework: act.act.assignment.unwrap_or_default(),
        student: act.number.unwrap_or_default(),
        detail: detail(&act.act.act, act.act.detail),
    };
    let acts = acts.into_iter().map(line).collect();
    shown(ActsPage { place: Tab::Acts, csrf: teacher.csrf(&service), acts, pager, frame }.render())
}
