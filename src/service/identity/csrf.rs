//! Tokens in forms, which only pages of ours can know: a keyed hash of the cookie that the form comes with.

use super::secrets::equal_secrets;
use crate::hand_in::hexadecimal;
use crate::service::Service;
use crate::service::errors::Problem;
use axum::http::StatusCode;
use hmac::{Hmac, KeyInit, Mac};
use sha2::Sha256;

/// The token of the forms of one cookie, or of one text that goes to a browser and back.
pub(in crate::service) fn token(service: &Service, cookie: &str) -> String {
    // A key of any length is taken: there is nothing that could fail.
    let Ok(mut mac) = Hmac::<Sha256>::new_from_slice(&service.key) else { return String::new() };
    mac.update(b"csrf ");
    mac.update(cookie.as_bytes());
    hexadecimal(&mac.finalize().into_bytes())
}

/// Lets a form pass that has its cookie's token.
pub(in crate::service) fn check(service: &Service, cookie: &str, given: &str) -> Result<(), Problem> {
    let expected = token(service, cookie);
    if !expected.is_empty() && equal_secrets(&expected, given) {
        return Ok(());
    }
    Err(Problem::new(
        StatusCode::FORBIDDEN,
        "csrf",
        "This form does not come from a page of this service, or it is old. Open the page again and send it from there.",
        "このフォームはこのサービスのページから送られたものではないか、古くなっています。ページを開き直して送信してください。",
    ))
}
