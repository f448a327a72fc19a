//! `Idempotency-Key`: what is sent twice is carried out once, and answered twice.
//!
//! After draft-ietf-httpapi-idempotency-key-header: the client makes up a key for what it is about to send, and sends it
//! again with the same key where no answer came. A key stands beside what came of it, in the same transaction; two
//! requests at once cannot both store something. The second one waits as the first one does, and gets its answer.
//! A key belongs to whoever sent it: nobody gets at another's submission by guessing.

use super::errors::Problem;
use super::limits::Client;
use super::store::{KeyResult, StoredKey};
use super::{Service, identity::Identity, submit::sha256};
use axum::http::{HeaderMap, StatusCode};
use std::time::Duration;

/// Name of the header.
pub const HEADER: &str = "idempotency-key";

/// Name of the field of a form that is sent without a script.
pub const FIELD: &str = "idempotency_key";

/// How long a key is known.
pub const KEPT: Duration = Duration::from_secs(24 * 3600);

/// Longest key, in characters.
const LONGEST: usize = 255;

/// A key as a client gives it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RequestKey {
    text: String,
    /// By which somebody is told from others who is known by nothing else.
    address: String,
}

impl RequestKey {
    /// The key of a request, in its header or else in a field of its form; none where it has none.
    ///
    /// The draft has it in quotes, as a structured field's string. Most clients leave them out, and are understood.
    pub fn read(headers: &HeaderMap, field: Option<&str>, client: &Client) -> Result<Option<Self>, Problem> {
        let mut values = headers.get_all(HEADER).iter();
        let text = match (values.next(), values.next()) {
            (Some(value), None) => value.to_str().map_err(|_| malformed())?,
            (None, _) => match field {
                Some(field) => field,
                None => return Ok(None),
            },
            (Some(_), Some(_)) => return Err(malformed()),
        };
        let text = text.trim();
        let text = text.strip_prefix('"').and_then(|text| text.strip_suffix('"')).unwrap_or(text);
        let is_sound = (1..=LONGEST).contains(&text.len()) && text.bytes().all(|byte| (0x20..0x7f).contains(&byte));
        if !is_sound {
            return Err(malformed());
        }
        Ok(Some(Self { text: text.to_owned(), address: client.address.to_string() }))
    }

    /// The key of what `identity` sends; `parts` are all that makes the request another one.
    pub(super) fn of_student(&self, identity: &Identity, parts: &[&str]) -> StoredKey {
        let who = match (identity, identity.owner_id(), identity.student()) {
            (Identity::OnBehalf(_), _, Some(student)) => format!("student {}", student.id),
            (_, Some(owner), _) => format!("browser {owner}"),
            _ => format!("address {}", self.address),
        };
        self.of(&who, parts)
    }

    /// The key of what a teacher sends.
    pub(super) fn of_teacher(&self, parts: &[&str]) -> StoredKey {
        self.of("teacher", parts)
    }

    fn of(&self, who: &str, parts: &[&str]) -> StoredKey {
        // A name may have anything in it: hashed, no part passes for two.
        let hashes: Vec<String> = parts.iter().map(|part| sha256(part.as_bytes())).collect();
        let fingerprint = sha256(hashes.concat().as_bytes());
        StoredKey { id: sha256([who, &self.text].join("\0").as_bytes()), fingerprint }
    }
}

/// What came of an earlier request with this key; a problem where that was another request.
pub(super) async fn earlier(service: &Service, key: Option<&StoredKey>) -> Result<Option<KeyResult>, Problem> {
    let Some(key) = key else { return Ok(None) };
    let Some(found) = service.store.result_of_key(&key.id).await? else { return Ok(None) };
    if found.fingerprint == key.fingerprint { Ok(Some(found)) } else { Err(reused()) }
}

fn malformed() -> Problem {
    Problem::bad_request(
        "Idempotency-Key takes one key of 1 to 255 ASCII characters, such as a UUID in quotes.",
        "Idempotency-Key には、引用符で囲んだ UUID など、255 文字以内の ASCII 文字列を 1 つ指定してください。",
    )
}

fn reused() -> Problem {
    Problem::new(
        StatusCode::UNPROCESSABLE_ENTITY,
        "idempotency-key-reused",
        "This Idempotency-Key was sent before with something else. Make up a new key for each file; send the same key \
         only to repeat the very same request.",
        "この Idempotency-Key は、以前に別の内容で使われています。ファイルごとに新しいキーを使い、同じキーは\
         まったく同じリクエストを再送するときだけ使ってください。",
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use axum::http::HeaderValue;

    fn read(values: &[&'static str], field: Option<&str>) -> Result<Option<String>, Problem> {
        let mut headers = HeaderMap::new();
        for value in values {
            headers.append(HEADER, HeaderValue::from_static(value));
        }
        let client = Client { address: [192, 0, 2, 1].into(), is_local: false };
        RequestKey::read(&headers, field, &client).map(|given| given.map(|given| given.text))
    }

    #[test]
    fn a_key_is_read_with_and_without_its_quotes_and_the_header_goes_before_the_form() {
        assert_eq!(read(&[], None), Ok(None));
        assert_eq!(read(&["\"8e03978e\""], None), Ok(Some("8e03978e".into())));
        assert_eq!(read(&[" 8e03978e "], Some("form")), Ok(Some("8e03978e".into())));
        assert_eq!(read(&[], Some("form")), Ok(Some("form".into())));
    }

    #[test]
    fn what_is_no_key_is_refused() {
        let long = "x".repeat(LONGEST + 1);
        for field in ["", "\"\"", "鍵", &long] {
            assert_eq!(read(&[], Some(field)).unwrap_err().status, StatusCode::BAD_REQUEST, "{field}");
        }
        read(&["a", "b"], None).unwrap_err();
    }
}
