//! The course link: who has it may say by which number they are known, and prove it by their personal code.

use super::codes::{code_needed, is_code_of, wrong_code};
use super::secrets::equal_secrets;
use super::{Identity, Visitor, new_token};
use crate::service::Service;
use crate::service::courses::public_address;
use crate::service::errors::Problem;
use crate::service::roster::not_on_roster;
use crate::service::store::{Proof, StudentRecord};
use axum::http::HeaderMap;

/// Name of the setting that holds the secret of the course link.
const SETTING: &str = "course_secret";

/// Longest student number, in characters.
const LONGEST_NUMBER: usize = 32;

/// The secret of the course link, `/join/{secret}`.
pub async fn course_secret(service: &Service) -> Result<String, Problem> {
    Ok(service.store.setting_or(SETTING, &new_token()[..32]).await?)
}

/// The course link, for whoever asks.
pub async fn course_link(service: &Service, headers: &HeaderMap) -> Result<String, Problem> {
    Ok(format!("{}/join/{}", public_address(service, headers), course_secret(service).await?))
}

/// A new secret; the old link opens nothing any more.
pub async fn renew_course_secret(service: &Service) -> Result<String, Problem> {
    let secret = new_token()[..32].to_owned();
    service.store.set_setting(SETTING, &secret).await?;
    Ok(secret)
}

/// Whether this is the secret of the course link.
pub async fn check_course_link(service: &Service, secret: &str) -> Result<(), Problem> {
    if equal_secrets(secret, &course_secret(service).await?) { Ok(()) } else { Err(Problem::not_found()) }
}

/// The student with a number that somebody typed.
pub async fn student_of(service: &Service, number: &str) -> Result<StudentRecord, Problem> {
    let number = normal_number(number).ok_or_else(|| {
        Problem::unprocessable(
            format!("A student number has 1 to {LONGEST_NUMBER} letters, digits, `-`, `_` or `.`, and not dots alone."),
            format!(
                "学籍番号は {LONGEST_NUMBER} 文字以内の英数字、`-`、`_`、`.` で入力してください。`.` だけの番号は使えません。"
            ),
        )
    })?;
    let student = service.store.student(&number, service.clock.now()).await?;
    student.ok_or_else(|| not_on_roster(&number))
}

/// Lets a program pass that brings a student's personal code.
pub async fn with_code(service: &Service, number: &str, code: &str) -> Result<StudentRecord, Problem> {
    let student = student_of(service, number).await?;
    check_code(service, &student, code)?;
    Ok(student)
}

/// Lets whoever brings a student's personal code pass.
pub(in crate::service) fn check_code(service: &Service, student: &StudentRecord, code: &str) -> Result<(), Problem> {
    match code.trim() {
        "" => Err(code_needed(student)),
        code if is_code_of(service, student, code) => Ok(()),
        _ => Err(wrong_code(student)),
    }
}

/// Says that the student with `number` sits at this browser, who proves it by their personal code. Without a code: where no
/// roster has the student, the first browser that gives the number. The answer may be another browser in the place of this
/// one: set its cookie ([`Visitor::set_cookie`]).
pub async fn join(
    service: &Service,
    visitor: Visitor,
    secret: &str,
    number: &str,
    code: &str,
) -> Result<Visitor, Problem> {
    check_course_link(service, secret).await?;
    let student = student_of(service, number).await?;
    let proof = match code.trim() {
        "" if visitor.identity.student_id() == Some(student.id.as_str()) => return Ok(visitor),
        "" if student.is_on_roster() => return Err(code_needed(&student)),
        "" => Proof::First,
        code if is_code_of(service, &student, code) => Proof::Code,
        _ => return Err(wrong_code(&student)),
    };
    become_student(service, visitor, student, proof).await
}

/// Makes a browser, or another one in its place, that of a student.
pub(in crate::service) async fn become_student(
    service: &Service,
    visitor: Visitor,
    student: StudentRecord,
    proof: Proof,
) -> Result<Visitor, Problem> {
    // What another student handed in at this machine is nobody else's to see.
    let visitor = match &visitor.identity {
        Identity::Student(_, before) | Identity::Claimed(_, before) if before.id != student.id => Visitor::replaced(),
        _ => visitor,
    };
    let is_theirs = visitor.identity.student_id() == Some(student.id.as_str());
    let visitor = visitor.known(service).await?;
    // Whoever sat here before may have noted the cookie: it is worth nothing from now on.
    let mut visitor = if is_theirs { visitor } else { visitor.renamed() };
    let owner_id = visitor.identity.owner_id().unwrap_or_default().to_owned();
    let owner = service.store.bind_owner((&owner_id, &visitor.token_hash()), &student, proof).await?;
    visitor.identity = Identity::Student(owner.ok_or_else(|| code_needed(&student))?, student);
    Ok(visitor)
}

/// Leaves this browser to the next student: a new cookie, whose history is empty.
pub fn leave() -> Visitor {
    Visitor::replaced()
}

/// A student number as it is kept: without spaces around it, full-width letters as the usual ones, in capitals. Dots alone are none: in
/// an address or a path they are the place itself or the one above.
pub fn normal_number(text: &str) -> Option<String> {
    let narrow = |c: char| match c {
        '\u{ff01}'..='\u{ff5e}' => char::from_u32(u32::from(c) - 0xfee0).unwrap_or(c),
        c => c,
    };
    let number: String = text.trim().chars().map(narrow).map(|c| c.to_ascii_uppercase()).collect();
    let is_plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_' | '.');
    let is_number = number.len() <= LONGEST_NUMBER && number.chars().all(is_plain) && number.chars().any(|c| c != '.');
    is_number.then_some(number)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_is_the_same_however_it_is_typed() {
        assert_eq!(normal_number(" s１２３４Ａ\n").as_deref(), Some("S1234A"));
        assert_eq!(normal_number("60-256_001").as_deref(), Some("60-256_001"));
        for wrong in ["", "  ", "a b", "山田", "<script>", ".", "..", "．．", &"1".repeat(33)] {
            assert_eq!(normal_number(wrong), None, "{wrong}");
        }
    }
}
