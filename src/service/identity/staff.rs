//! Who teaches in a course: let in by an administrator, opened by a link with which their owner chooses a password.
//!
//! A secret of the whole service (the password, the token of the start) is the way in of the first administrator. With an
//! administrator it opens pages no more; whoever has the machine can set another password for that, and so get in again.

use super::accounts;
use super::secrets::hash_password;
use super::{Teacher, new_id, new_token, token_hash};
use crate::service::Service;
use crate::service::blocking::aside;
use crate::service::clock::{Millis, millis};
use crate::service::courses::public_address;
use crate::service::errors::Problem;
use crate::service::store::{StaffMember, StaffRole};
use crate::service::texts::check_length;
use axum::http::HeaderMap;
use std::time::Duration;

/// Name of the setting that holds the hash of the service's password.
pub(in crate::service) const PASSWORD_SETTING: &str = "teacher_password_hash";

/// Shortest password of a teacher, in characters, and the longest that is looked at, in bytes.
pub(crate) const SHORTEST_PASSWORD: usize = 10;
pub(super) const LONGEST_PASSWORD: usize = 1024;

/// How long a link to choose a password holds.
const INVITATION: Duration = Duration::from_secs(7 * 24 * 3600);

/// Longest name by which somebody logs in, and longest name, in characters.
const LONGEST_LOGIN: usize = 64;
const LONGEST_NAME: usize = 100;

/// Lets a teacher pass who may let somebody of this role in, or keep them out.
pub fn check_may_manage(teacher: &Teacher, role: StaffRole) -> Result<(), Problem> {
    teacher.check_course()?;
    teacher.check_role(if role == StaffRole::Assistant { StaffRole::Lecturer } else { StaffRole::Administrator })
}

/// The name by which somebody logs in, as it is kept; none where that is none.
pub(super) fn normal_login(text: &str) -> Option<String> {
    // Other alphabets have letters whose small form is an ASCII letter: they make another login.
    let login = text.trim().to_ascii_lowercase();
    let is_plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_' | '.' | '@' | '+');
    (!login.is_empty() && login.len() <= LONGEST_LOGIN && login.chars().all(is_plain)).then_some(login)
}

/// Whose account this login is, where it is open; a reverse proxy has checked who they are.
pub async fn member_of(service: &Service, login: &str) -> Result<Option<StaffMember>, Problem> {
    let Some(login) = normal_login(login) else { return Ok(None) };
    let staff = service.store.staff().await?;
    Ok(staff.into_iter().find(|member| member.login == login && member.is_active))
}

/// Adds somebody who has still to choose a password.
pub async fn add_staff(service: &Service, login: &str, name: &str, role: StaffRole) -> Result<StaffMember, Problem> {
    let login = normal_login(login).ok_or_else(|| {
        Problem::unprocessable(
            format!("A login has 1 to {LONGEST_LOGIN} letters, digits, `-`, `_`, `.`, `@` or `+`; a mail address is one."),
            format!("ログイン名は {LONGEST_LOGIN} 文字以内の英数字と `-`、`_`、`.`、`@`、`+` で入力してください。メールアドレスも使えます。"),
        )
    })?;
    check_length(name, LONGEST_NAME, ("The name", "氏名"))?;
    let name: String = name.trim().chars().filter(|c| !c.is_control()).collect();
    if role == StaffRole::Administrator && service.is_beside() {
        return Err(only_in_the_first());
    }
    if role != StaffRole::Administrator && !service.accounts().has_administrator().await? {
        return Err(Problem::unprocessable(
            "The first account is an administrator's: make your own, and then those of the others.",
            "最初のアカウントは管理者のものです。先に自分のアカウントを作成し、その後でほかの人を追加してください。",
        ));
    }
    let member = StaffMember { id: new_id(), login, name, role, has_password: false, is_active: true };
    if let Some(member) = accounts::added(service, &member).await? {
        return Ok(member);
    }
    Err(Problem::unprocessable(
        format!("There is an account `{}` already. Choose another login, or open that account again.", member.login),
        format!(
            "「{}」というアカウントはすでにあります。別のログイン名にするか、既存のアカウントを使ってください。",
            member.login
        ),
    ))
}

/// Lets somebody in: their account, and the last part of a link by which they choose a password. Whoever has an account already
/// comes in by that; a new way into one that others may have made is not given here.
pub async fn let_in(
    service: &Service,
    teacher: &Teacher,
    (login, name): (&str, &str),
    role: StaffRole,
) -> Result<(StaffMember, Option<String>), Problem> {
    let is_new = service.accounts().account(&login.trim().to_lowercase()).await?.is_none();
    let member = add_staff(service, login, name, role).await?;
    let may_invite = is_new || (!member.has_password && teacher.check_role(StaffRole::Administrator).is_ok());
    let secret = if may_invite { Some(invite(service, &member).await?) } else { None };
    Ok((member, secret))
}

/// The refusal to make somebody an administrator by way of one course.
fn only_in_the_first() -> Problem {
    Problem::unprocessable(
        "Administrators are of all courses: they are let in on the page of the first course's staff.",
        "管理者はすべての授業の管理者です。最初の授業の担当者ページから追加してください。",
    )
}

/// Gives somebody a link by which they choose a password: its last part.
pub async fn invite(service: &Service, member: &StaffMember) -> Result<String, Problem> {
    let secret = new_token()[..32].to_owned();
    service.accounts().invite(&member.id, &token_hash(&secret), service.clock.now() + invitation()).await?;
    Ok(secret)
}

/// The link by which somebody chooses a password.
pub fn invitation_link(service: &Service, headers: &HeaderMap, secret: &str) -> String {
    format!("{}/teacher/welcome/{secret}", public_address(service, headers))
}

fn invitation() -> Millis {
    millis(INVITATION)
}

/// Whose link this is.
pub async fn invited(service: &Service, secret: &str) -> Result<StaffMember, Problem> {
    let found = service.accounts().invited(&token_hash(secret), service.clock.now()).await?;
    found.ok_or_else(|| {
        Problem::new(
            axum::http::StatusCode::NOT_FOUND,
            "not-found",
            "This link opens nothing: it has been used, it is older than a week, or there is a newer one. Ask for another.",
            "このリンクは無効です。使用済みか、1 週間を過ぎたか、新しいリンクが発行されています。再発行を依頼してください。",
        )
    })
}

/// Sets the password of somebody who has a link, and uses the link up. With the first administrator, secrets of the whole
/// service open pages no more.
pub async fn choose_password(service: &Service, secret: &str, password: &str) -> Result<StaffMember, Problem> {
    let member = invited(service, secret).await?;
    if password.chars().count() < SHORTEST_PASSWORD || password.len() > LONGEST_PASSWORD {
        return Err(Problem::unprocessable(
            format!("A password has at least {SHORTEST_PASSWORD} characters."),
            format!("パスワードは {SHORTEST_PASSWORD} 文字以上にしてください。"),
        ));
    }
    let _turn = service.login_turn.acquire().await;
    let password = password.to_owned();
    let hash = aside(move || hash_password(&password)).await?.map_err(|fault| Problem::of_fault(&fault))?;
    service.accounts().set_staff_password(&member.id, &hash).await?;
    if member.role == StaffRole::Administrator {
        service.accounts().close_shared_way(PASSWORD_SETTING).await?;
    }
    Ok(member)
}

/// Sets what somebody may do, and whether they may log in. The last administrator stays one.
pub async fn set_staff(
    service: &Service,
    member: &StaffMember,
    role: StaffRole,
    is_active: bool,
) -> Result<(), Problem> {
    if role == StaffRole::Administrator && service.is_beside() {
        return Err(only_in_the_first());
    }
    let stays = role == StaffRole::Administrator && is_active;
    if member.role == StaffRole::Administrator && !stays {
        let staff = service.store.staff().await?;
        let is_other = |other: &&StaffMember| {
            other.role == StaffRole::Administrator && other.is_active && other.has_password && other.id != member.id
        };
        if !staff.iter().any(|other| is_other(&other)) {
            return Err(Problem::unprocessable(
                "This is the only administrator who can log in. Let another one in first.",
                "ログインできる管理者がほかにいません。先に別の管理者を追加してください。",
            ));
        }
    }
    Ok(service.store.set_staff(&member.id, role, is_active).await?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_login_is_the_same_however_it_is_typed() {
        assert_eq!(normal_login(" Hanako.Wada@Example.ac.jp ").as_deref(), Some("hanako.wada@example.ac.jp"));
        for wrong in ["", "  ", "a b", "和田", "<script>", "\u{212a}ato", &"x".repeat(65)] {
            assert_eq!(normal_login(wrong), None, "{wrong}");
        }
    }
}
