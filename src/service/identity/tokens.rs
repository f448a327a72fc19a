//! Tokens by which programs act for somebody who teaches: made on a page, by a person, and shown once.

use super::{Teacher, new_id, new_token, token_hash};
use crate::service::Service;
use crate::service::clock::{Millis, millis};
use crate::service::errors::Problem;
use crate::service::store::{AccessToken, OwnedToken, StaffMember, StaffRole, TokenScope};
use axum::http::StatusCode;
use std::time::Duration;

/// What every token begins with, so that a scanner of leaked secrets knows it.
const PREFIX: &str = "ggrade_";

/// Longest life of a token, in days: a year.
pub const LONGEST_DAYS: u32 = 366;

/// Longest name of a token, in characters.
const LONGEST_NAME: usize = 100;

/// Most tokens of one person.
const MOST: usize = 50;

/// A token that somebody wants.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WantedToken {
    /// What they call it.
    pub name: String,
    /// What it shall be good for.
    pub scope: TokenScope,
    /// The homework that it shall be for; none: all that they see.
    pub assignment: Option<String>,
    /// How long it shall hold, in days.
    pub days: u32,
}

/// Makes a token for somebody who is logged in by their own account; the second is its secret, which is kept nowhere.
pub async fn make_token(
    service: &Service,
    teacher: &Teacher,
    wanted: WantedToken,
) -> Result<(AccessToken, String), Problem> {
    let owner = person(teacher)?;
    let name = wanted.name.trim();
    if name.is_empty() || name.chars().count() > LONGEST_NAME {
        return Err(Problem::unprocessable(
            format!("Give the token a name of at most {LONGEST_NAME} characters: say what uses it."),
            format!("トークンの名前（何に使うか）を {LONGEST_NAME} 文字以内で入力してください。"),
        ));
    }
    check_wanted_scope(teacher, wanted.scope)?;
    if !(1..=LONGEST_DAYS).contains(&wanted.days) {
        return Err(Problem::unprocessable(
            format!("A token holds from 1 to {LONGEST_DAYS} days."),
            format!("トークンの有効期間は 1～{LONGEST_DAYS} 日です。"),
        ));
    }
    if let Some(id) = &wanted.assignment {
        service.homework_of(id)?;
    }
    let now = service.clock.now();
    if service.store.tokens(Some(&owner.id), now).await?.len() >= MOST {
        return Err(Problem::unprocessable(
            format!("You have {MOST} tokens. End one that is not used any more."),
            format!("トークンは {MOST} 個までです。使っていないものを無効にしてください。"),
        ));
    }
    let secret = format!("{PREFIX}{}", new_token());
    let token = AccessToken {
        id: new_id(),
        staff_id: owner.id.clone(),
        name: name.to_owned(),
        scope: wanted.scope,
        assignment: wanted.assignment,
        created_at: now,
        expires_at: now + life(wanted.days),
        last_used_at: None,
    };
    service.store.add_token(&token, &token_hash(&secret)).await?;
    Ok((token, secret))
}

/// Lets a scope pass that opens something for its owner: assistants hand in for nobody.
pub fn check_wanted_scope(teacher: &Teacher, scope: TokenScope) -> Result<(), Problem> {
    if scope == TokenScope::Submit { teacher.check_role(StaffRole::Lecturer) } else { Ok(()) }
}

/// The tokens that somebody sees: their own, an administrator everybody's.
pub async fn tokens_for(service: &Service, teacher: &Teacher) -> Result<Vec<OwnedToken>, Problem> {
    teacher.check_course()?;
    let everybodys = teacher.role() == StaffRole::Administrator;
    let owner = match (everybodys, teacher.staff()) {
        (true, _) => None,
        (false, Some(member)) => Some(member.id.as_str()),
        (false, None) => return Ok(Vec::new()),
    };
    Ok(service.store.tokens(owner, service.clock.now()).await?)
}

/// Ends a token that somebody sees.
pub async fn end_token(service: &Service, teacher: &Teacher, id: &str) -> Result<OwnedToken, Problem> {
    let seen = tokens_for(service, teacher).await?;
    let token = seen.into_iter().find(|owned| owned.token.id == id).ok_or_else(Problem::not_found)?;
    service.store.remove_token(id).await?;
    Ok(token)
}

fn life(days: u32) -> Millis {
    millis(Duration::from_secs(u64::from(days) * 24 * 3600))
}

/// Who is logged in by an account of their own. A program makes no tokens: one that leaks would last for ever.
fn person(teacher: &Teacher) -> Result<&StaffMember, Problem> {
    teacher.check_course()?;
    teacher.staff().filter(|_| teacher.session().is_some()).ok_or_else(|| {
        Problem::new(
            StatusCode::FORBIDDEN,
            "account",
            "A token belongs to a person: log in by your own account to make one.",
            "トークンは個人のものです。自分のアカウントでログインして作成してください。",
        )
    })
}
