//! Ids, tokens, hashes.

use crate::fault::Fault;
use crate::hand_in::hexadecimal;
use crate::language::Text;
use argon2::Argon2;
use argon2::password_hash::phc::PasswordHash;
use argon2::password_hash::{PasswordHasher, PasswordVerifier};
use sha2::{Digest, Sha256};
use subtle::ConstantTimeEq;

/// An id that nobody can guess: 122 random bits.
pub fn new_id() -> String {
    uuid::Uuid::new_v4().to_string()
}

/// Characters of a secret.
pub(super) const TOKEN_LENGTH: usize = 96;

/// A secret of 366 random bits, in hexadecimal.
pub fn new_token() -> String {
    [new_id(), new_id(), new_id()].concat().replace('-', "")
}

/// What is stored of a secret that has too many bits to be guessed.
pub fn token_hash(token: &str) -> String {
    hexadecimal(&Sha256::digest(token.as_bytes()))
}

/// Whether two secrets are the same; the time that it takes tells nothing of where they differ.
pub(in crate::service) fn equal_secrets(a: &str, b: &str) -> bool {
    Sha256::digest(a.as_bytes()).ct_eq(&Sha256::digest(b.as_bytes())).into()
}

/// The hash of a password, for the configuration or the database.
pub fn hash_password(password: &str) -> Result<String, Fault> {
    let hash = Argon2::default().hash_password(password.as_bytes());
    hash.map(|hash| hash.to_string()).map_err(|error| Fault::new(Text::verbatim(error.to_string())))
}

/// Whether a password has this hash. Takes tens of milliseconds and 19 MiB.
pub(super) fn password_matches(password: &str, hash: &str) -> bool {
    PasswordHash::new(hash).is_ok_and(|hash| Argon2::default().verify_password(password.as_bytes(), &hash).is_ok())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_password_matches_its_own_hash_only() {
        let hash = hash_password("環境光 ambient").expect("a hash");
        assert!(hash.starts_with("$argon2id$"));
        assert!(password_matches("環境光 ambient", &hash));
        assert!(!password_matches("環境光 ambient ", &hash));
        assert!(!password_matches("環境光 ambient", "not a hash"));
    }

    #[test]
    fn secrets_are_long_and_never_twice_the_same() {
        assert_eq!(new_token().len(), TOKEN_LENGTH);
        assert_ne!(new_token(), new_token());
        assert!(equal_secrets("abc", "abc") && !equal_secrets("abc", "abd") && !equal_secrets("abc", "abcd"));
    }
}
