//! What a student hands in: a set of files, each with its name and its bytes.
//!
//! Nothing is known of them yet. Which file is for which of the homework's slots is decided in [`crate::slots`], and what
//! each says in [`crate::source`].

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

/// The files of one hand-in. A homework of one file has hand-ins of one file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct HandIn {
    /// The files, in the order of the homework's slots where that is known.
    pub files: Vec<HandedInFile>,
}

/// A file of a hand-in.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct HandedInFile {
    /// Its name as handed in, without folders.
    pub name: String,
    /// Its bytes.
    pub bytes: Vec<u8>,
}

impl HandedInFile {
    /// A file with this name and these bytes.
    pub fn new(name: impl Into<String>, bytes: impl Into<Vec<u8>>) -> Self {
        Self { name: name.into(), bytes: bytes.into() }
    }

    /// SHA-256 of its bytes, in hexadecimal.
    pub fn sha256(&self) -> String {
        hexadecimal(Sha256::digest(&self.bytes).as_slice())
    }
}

impl HandIn {
    /// A hand-in of one file.
    pub fn of_one(name: impl Into<String>, bytes: impl Into<Vec<u8>>) -> Self {
        Self { files: vec![HandedInFile::new(name, bytes)] }
    }

    /// Its digest, in hexadecimal, see [`digest`].
    pub fn sha256(&self) -> String {
        let files: Vec<_> = self.files.iter().map(|file| (file.name.as_str(), file.sha256())).collect();
        digest(&files)
    }

    /// The names of the files, joined for a person.
    pub fn names(&self) -> String {
        self.files.iter().map(|file| file.name.as_str()).collect::<Vec<_>>().join(", ")
    }

    /// The bytes of all files, one behind the other.
    pub fn concatenated(&self) -> Vec<u8> {
        self.files.iter().flat_map(|file| &file.bytes).copied().collect()
    }
}

/// The digest of a hand-in by the names of its files and the SHA-256 of each, in hexadecimal. That of one file is the
/// file's own: its name does not change what it is. That of several depends on which file has which name, not on their
/// order.
pub fn digest(files: &[(&str, String)]) -> String {
    if let [(_, sha256)] = files {
        return sha256.clone();
    }
    let mut files: Vec<_> = files.iter().collect();
    files.sort();
    let mut digest = Sha256::new();
    for (name, sha256) in files {
        digest.update((name.len() as u64).to_le_bytes());
        digest.update(name);
        digest.update(sha256);
    }
    hexadecimal(digest.finalize().as_slice())
}

/// Bytes as hexadecimal digits, two for each.
pub fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn two(first: (&str, &str), second: (&str, &str)) -> HandIn {
        HandIn { files: [first, second].map(|(name, text)| HandedInFile::new(name, text)).into() }
    }

    #[test]
    fn one_file_has_its_own_digest_under_any_name() {
        // SHA-256 of no bytes, from FIPS 180-4's examples.
        let empty = "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";
        for name in ["a.vert", "b.vert"] {
            assert_eq!(HandIn::of_one(name, "").sha256(), empty);
        }
    }

    #[test]
    fn several_files_have_a_digest_of_names_and_contents() {
        let right = two(("a.vert", "1"), ("a.frag", "2"));
        assert_eq!(right.sha256(), two(("a.frag", "2"), ("a.vert", "1")).sha256(), "the order does not count");
        for other in [
            two(("a.vert", "2"), ("a.frag", "1")),
            two(("a.vert", "1"), ("b.frag", "2")),
            two(("a.vert", "1"), ("a.frag", "3")),
            HandIn::of_one("a.vert", "1"),
            HandIn::default(),
        ] {
            assert_ne!(right.sha256(), other.sha256(), "{}", other.names());
        }
    }
}
