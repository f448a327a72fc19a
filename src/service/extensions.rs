//! Deadlines of students and of groups in place of that of the class.

use super::State;
use super::clock::Millis;
use super::errors::Problem;
use super::identity::normal_number;
use super::rules::check_date;
use super::store::{Beneficiary, Extension};
use super::texts::check_length;
use axum::http::StatusCode;

/// Longest reason, in characters.
const LONGEST_REASON: usize = 500;

/// Whose deadline is meant: a group of the roster by its name, or a student by their number. A name that is both is refused, so that
/// nobody gets what somebody else was meant to get.
pub async fn beneficiary(state: &State, named: &str) -> Result<Beneficiary, Problem> {
    let named = named.trim();
    let student = match normal_number(named) {
        Some(number) => state.store.student_by_number(&number).await?,
        None => None,
    };
    let is_group = state.store.groups().await?.iter().any(|group| group == named);
    match (student, is_group) {
        (Some(student), false) => Ok(Beneficiary::Student(student.id)),
        (None, true) => Ok(Beneficiary::Group(named.to_owned())),
        (Some(_), true) => Err(Problem::new(
            StatusCode::UNPROCESSABLE_ENTITY,
            "ambiguous",
            format!(
                "`{named}` is a group and a student number. Set the student's deadline on their page of the class; for the group, give it \
                 another name in the roster first."
            ),
            format!(
                "「{named}」はグループ名でもあり、学籍番号でもあります。学生の締切はクラスの学生のページで設定してください。グループの場合は、先に名簿のグループ名を変更してください。"
            ),
        )),
        (None, false) => Err(Problem::new(
            StatusCode::UNPROCESSABLE_ENTITY,
            "nobody",
            format!("There is no group and no student `{named}`. Groups are those of the roster's column “Group”."),
            format!("「{named}」というグループも学籍番号もありません。グループは名簿の「グループ」列の値です。"),
        )),
    }
}

/// Gives somebody a deadline of their own, or takes it away. Returns the reason as it is kept.
pub async fn grant(
    state: &State,
    to: &Beneficiary,
    closes_at: Option<Millis>,
    reason: &str,
) -> Result<String, Problem> {
    check_date(closes_at).map_err(|wrong| Problem::unprocessable(wrong.en, wrong.ja))?;
    let id = &state.assignment.id;
    let of_class = state.store.assignment(id).await?.closes_at;
    if closes_at.is_some_and(|own| of_class.is_none_or(|class| own <= class)) {
        return Err(Problem::unprocessable(
            "An extension ends after the deadline of the class; without a date it is taken away.",
            "延長後の締切は、クラスの締切より後にしてください。空欄にすると延長を取り消します。",
        ));
    }
    check_length(reason, LONGEST_REASON, ("The reason", "理由"))?;
    let reason = reason.trim().to_owned();
    let own = closes_at.map(|closes_at| Extension { closes_at, reason: reason.clone() });
    state.store.set_extension(id, to, own.as_ref()).await?;
    Ok(reason)
}
