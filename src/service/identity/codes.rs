//! A student's personal code: by it a browser is known to be theirs, and nobody else hands in under their number.
//!
//! It is computed from the service's key, the student and the generation of their code, so that a lecturer can look it up
//! again, and a lost one is replaced by raising the generation. It has 50 bits, which no rate of requests makes guessable.

use super::secrets::equal_secrets;
use crate::service::Service;
use crate::service::errors::Problem;
use crate::service::store::StudentRecord;
use axum::http::StatusCode;
use hmac::{Hmac, KeyInit, Mac};
use sha2::Sha256;

/// Crockford's alphabet: no letter in it is taken for a digit or for another letter.
const ALPHABET: [u8; 32] = *b"0123456789ABCDEFGHJKMNPQRSTVWXYZ";

/// Letters of a code, and of each half of it.
const LETTERS: usize = 10;
const HALF: usize = 5;

/// The personal code of a student, as it is handed out: `7KQ4M-2XR9T`.
pub fn personal_code(service: &Service, student: &StudentRecord) -> String {
    // A key of any length is taken: there is nothing that could fail.
    let Ok(mut mac) = Hmac::<Sha256>::new_from_slice(&service.key) else { return String::new() };
    mac.update(format!("personal code {} {}", student.id, student.code_generation).as_bytes());
    let bytes = mac.finalize().into_bytes();
    let letters: String = bytes.iter().take(LETTERS).map(|byte| char::from(ALPHABET[usize::from(byte % 32)])).collect();
    format!("{}-{}", &letters[..HALF], &letters[HALF..])
}

/// The course link with a student's number and code filled in.
pub fn personal_link(course_link: &str, student: &StudentRecord, code: &str) -> String {
    format!("{course_link}?number={}&code={code}", student.number)
}

/// Whether somebody typed this student's code, however they wrote it.
pub(super) fn is_code_of(service: &Service, student: &StudentRecord, typed: &str) -> bool {
    let code = personal_code(service, student);
    !code.is_empty() && equal_secrets(&normal(&code), &normal(typed))
}

/// A code without what people add to it, and with the letters that they meant.
fn normal(typed: &str) -> String {
    let narrow = |c: char| match c {
        '\u{ff01}'..='\u{ff5e}' => char::from_u32(u32::from(c) - 0xfee0).unwrap_or(c),
        c => c,
    };
    let letters = typed.chars().map(narrow).filter(char::is_ascii_alphanumeric).map(|c| c.to_ascii_uppercase());
    letters
        .map(|c| match c {
            'O' => '0',
            'I' | 'L' => '1',
            c => c,
        })
        .collect()
}

/// The answer to a number without its personal code.
pub fn code_needed(student: &StudentRecord) -> Problem {
    let number = &student.number;
    let (en, ja) = if student.is_on_roster() {
        (
            "Your teacher has it; if you lost it, ask for a new one.",
            "コードは担当教員が配布します。分からない場合は再発行を依頼してください。",
        )
    } else {
        (
            "Another browser has given this number before, and showed the code then. If that was not you, tell your teacher.",
            "この番号は別のブラウザですでに登録されており、コードはそのときに表示されています。心当たりがない場合は担当教員に連絡してください。",
        )
    };
    Problem::new(
        StatusCode::FORBIDDEN,
        "code-needed",
        format!("The student number {number} needs its personal code. {en}"),
        format!("学籍番号 {number} には個人コードが必要です。{ja}"),
    )
}

/// The answer to a code that is not this student's.
pub(super) fn wrong_code(student: &StudentRecord) -> Problem {
    Problem::new(
        StatusCode::FORBIDDEN,
        "wrong-code",
        format!(
            "This is not the personal code of {}. Check number and code for typing errors; an old code ends when your \
             teacher gives you a new one.",
            student.number
        ),
        format!(
            "{} の個人コードではありません。学籍番号とコードに誤りがないか確認してください。再発行された場合、以前のコードは使えません。",
            student.number
        ),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_code_is_the_same_however_it_is_typed() {
        for typed in ["7KQ4M-2XR9T", "7kq4m 2xr9t", " ７ＫＱ４Ｍ２ＸＲ９Ｔ "] {
            assert_eq!(normal(typed), "7KQ4M2XR9T", "{typed}");
        }
        assert_eq!(normal("OIL"), "011");
        assert!(ALPHABET.iter().all(|c| normal(&char::from(*c).to_string()) == char::from(*c).to_string()));
    }
}
