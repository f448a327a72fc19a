//! Accounts and courses: everybody has one account, with the first course, and teaches in the courses that let them in.
//!
//! Each course knows its own people and what they may do there. An administrator is one in every course.

use super::Teacher;
use crate::service::Service;
use crate::service::errors::Problem;
use crate::service::store::{StaffMember, StaffRole};

/// Somebody with an account as a course knows them; none where they do not teach there.
pub(super) async fn in_course(service: &Service, account: StaffMember) -> Result<Option<StaffMember>, Problem> {
    let own = service.store.course_member(&account.id).await?;
    if account.role == StaffRole::Administrator {
        if own.is_none() {
            // What they do here is logged under their name.
            service.store.keep_account(&account, service.clock.now()).await?;
        }
        return Ok(Some(account));
    }
    Ok(own.filter(|member| member.is_active))
}

/// Lets somebody teach in a course who has an account, or gets one now; none where they teach there already.
pub(super) async fn added(service: &Service, new: &StaffMember) -> Result<Option<StaffMember>, Problem> {
    let now = service.clock.now();
    let (accounts, store) = (service.accounts(), &service.store);
    let account = match accounts.account(&new.login).await? {
        Some(account) => account,
        None if service.is_beside() => {
            accounts.keep_account(new, now).await?;
            accounts
                .account(&new.login)
                .await?
                .ok_or_else(|| Problem::internal(&"an account that was made is not there"))?
        }
        None => return Ok(store.add_staff(new, now).await?.then(|| new.clone())),
    };
    if store.course_member(&account.id).await?.is_some()
        || account.role == StaffRole::Administrator
        || !account.is_active
    {
        return Ok(None);
    }
    store.keep_account(&account, now).await?;
    store.let_teach(&account.id, new.role).await?;
    Ok(Some(StaffMember { role: new.role, ..account }))
}

/// Somebody of whom a learning platform says that they teach in this course: their account, which they get by that, with the role that
/// the platform says now, unless a person gave them theirs; none where it is closed.
pub(in crate::service) async fn vouched_for(
    service: &Service,
    new: &StaffMember,
) -> Result<Option<StaffMember>, Problem> {
    if let Some(member) = added(service, new).await? {
        service.store.vouch(&member.id).await?;
        return Ok(Some(member));
    }
    let Some(account) = service.accounts().account(&new.login).await?.filter(|account| account.is_active) else {
        return Ok(None);
    };
    service.store.follow_platform(&account.id, Some(new.role)).await?;
    // In the first course the account itself has the role.
    match service.accounts().staff_member(&account.id).await? {
        Some(account) => in_course(service, account).await,
        None => Ok(None),
    }
}

/// Everybody who teaches in a course, with what is true of their accounts.
pub async fn people(service: &Service) -> Result<Vec<StaffMember>, Problem> {
    let mut people = service.store.staff().await?;
    if service.is_beside() {
        for member in &mut people {
            let account = service.accounts().staff_member(&member.id).await?;
            member.has_password = account.as_ref().is_some_and(|account| account.has_password);
            member.is_active &= account.is_some_and(|account| account.is_active);
        }
    }
    Ok(people)
}

/// Lets who may give somebody else a new way into their account pass. Where there are several courses that may be the way into
/// another one, so that it takes an administrator.
pub async fn check_may_invite(service: &Service, teacher: &Teacher) -> Result<(), Problem> {
    if service.is_beside() || !service.store.courses().await?.is_empty() {
        teacher.check_role(StaffRole::Administrator)?;
    }
    Ok(())
}
