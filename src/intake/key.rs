//! Keys that tell students apart and are safe as names of files on every system.

use super::Student;
use super::moodle;
use super::students::Who;
use crate::hand_in::hexadecimal;
use sha2::{Digest, Sha256};
use std::collections::HashMap;

/// Longest key, in bytes: room for `-` and an extension within every file system's limit, and short enough to read.
const MAX_BYTES: usize = 64;
/// Hexadecimal digits of a hash in a key: among 1,000 students two agree with probability 10⁻⁶·⁶.
const HASH_DIGITS: usize = 12;
/// Names that Windows gives to devices, with any extension.
const DEVICES: [&str; 4] = ["con", "prn", "aux", "nul"];

/// Everyone with a key: Moodle's number, a name that is safe as it is, or else what is safe of it and a hash of where
/// the student was found. Keys differ in more than upper and lower case.
pub(super) fn students<'a>(everyone: impl Iterator<Item = &'a Who>) -> Vec<Student> {
    let everyone: Vec<_> = everyone.collect();
    let plain: Vec<String> = everyone.iter().map(|who| plain(who)).collect();
    let mut count: HashMap<String, usize> = HashMap::new();
    for key in &plain {
        *count.entry(key.to_ascii_lowercase()).or_default() += 1;
    }
    let mut taken: HashMap<String, usize> = HashMap::new();
    everyone
        .iter()
        .zip(plain)
        .map(|(who, plain)| {
            let is_plain = !plain.is_empty() && count[&plain.to_ascii_lowercase()] == 1;
            let key = if is_plain { plain } else { hashed(who) };
            // Hashes of one place can only be equal where one input was named twice.
            let times = taken.entry(key.to_ascii_lowercase()).or_default();
            *times += 1;
            let key = if *times == 1 { key } else { format!("{key}.{times}") };
            Student { key, name: who.name.clone(), moodle: who.moodle.clone(), email: None }
        })
        .collect()
}

/// The key that needs no hash; empty where there is none.
fn plain(who: &Who) -> String {
    match who.moodle.as_ref().and_then(|participant| participant.number) {
        Some(number) => number.to_string(),
        None if is_safe(&who.name) => who.name.clone(),
        None => String::new(),
    }
}

/// A name without signs that some system refuses, as every system takes it for that of a file or a folder: Windows takes no device and
/// drops a dot or a space at the end, and two dots are the folder above.
pub fn portable(name: &str) -> String {
    let start = if is_device(name) { "_" } else { "" };
    let end = if name.ends_with(['.', ' ']) { "_" } else { "" };
    format!("{start}{name}{end}")
}

fn is_device(name: &str) -> bool {
    let stem = name.split('.').next().unwrap_or_default().trim_end().to_ascii_lowercase();
    let is_port = |device| stem.strip_prefix(device).is_some_and(|n: &str| n.len() == 1);
    DEVICES.contains(&stem.as_str()) || is_port("com") || is_port("lpt")
}

fn is_safe(name: &str) -> bool {
    // Those with a hash end as a hash does; a name must not pass for one.
    let is_like_hashed = name.rsplit('-').next().is_some_and(|end| {
        end.split('.').next().is_some_and(|end| end.len() == HASH_DIGITS && end.bytes().all(|b| b.is_ascii_hexdigit()))
    });
    !name.is_empty()
        && name.len() <= MAX_BYTES
        && name.bytes().all(|byte| byte.is_ascii_alphanumeric() || b"-_.".contains(&byte))
        && !name.starts_with(['.', '-'])
        && !name.ends_with('.')
        && !is_device(name)
        && !is_like_hashed
}

fn hashed(who: &Who) -> String {
    let name = who.moodle.as_ref().map_or_else(|| who.name.clone(), moodle::shown);
    let kept: String = name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '-' }).collect();
    let words: Vec<&str> = kept.split('-').filter(|word| !word.is_empty()).collect();
    let mut start = words.join("-");
    start.truncate(MAX_BYTES - HASH_DIGITS - 1 - 4);
    if start.is_empty() {
        start.push_str("student");
    }
    let digest = Sha256::digest(who.place.as_bytes());
    let hash = hexadecimal(&digest);
    format!("{start}-{}", &hash[..HASH_DIGITS])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::intake::Participant;

    fn who(name: &str, place: &str) -> Who {
        Who { name: name.into(), moodle: None, place: place.into() }
    }

    fn keys(everyone: &[Who]) -> Vec<String> {
        students(everyone.iter()).into_iter().map(|student| student.key).collect()
    }

    #[test]
    fn a_safe_name_is_its_own_key_and_a_participant_the_number() {
        let taro = Participant { name: "山田 太郎".into(), number: Some(1234) };
        let moodle = Who { name: "山田 太郎".into(), moodle: Some(taro), place: "a.zip/x".into() };
        assert_eq!(keys(&[who("s2012345", "c/s2012345"), moodle]), ["s2012345", "1234"]);
    }

    #[test]
    fn every_system_takes_a_portable_name() {
        for (name, portable_name) in [
            ("S1", "S1"),
            ("T1.", "T1._"),
            (".", "._"),
            ("..", ".._"),
            ("CON", "_CON"),
            ("nul.x", "_nul.x"),
            ("aux .x", "_aux .x"),
            ("x ", "x _"),
            ("COM1", "_COM1"),
            ("COMA2", "COMA2"),
        ] {
            assert_eq!(portable(name), portable_name);
        }
    }

    #[test]
    fn unsafe_names_get_keys_that_are_safe_and_differ() {
        let names = ["山田 太郎", "山田 次郎", "con", "COM1.x", "..", "-rf", "a/b", "", "a\u{202e}b", "x.", "Zoë"];
        let everyone: Vec<Who> = names.iter().map(|name| who(name, &format!("class/{name}"))).collect();
        let found = keys(&everyone);
        for key in &found {
            assert!(key.len() <= MAX_BYTES && key.starts_with(|c: char| c.is_ascii_alphanumeric()), "{key}");
            assert!(key.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'-'), "{key}");
        }
        let distinct: std::collections::HashSet<_> = found.iter().collect();
        assert_eq!(distinct.len(), names.len());
        assert_eq!(found, keys(&everyone), "the same in every run");
    }

    #[test]
    fn nobody_shares_a_key_not_even_where_case_is_ignored() {
        let everyone =
            [who("alice", "A/alice"), who("alice", "B/alice"), who("Alice", "C/Alice"), who("alice", "A/alice")];
        let found: Vec<_> = keys(&everyone).iter().map(|key| key.to_ascii_lowercase()).collect();
        let distinct: std::collections::HashSet<_> = found.iter().collect();
        assert_eq!(distinct.len(), 4, "{found:?}");
    }

    #[test]
    fn a_name_cannot_be_chosen_to_take_the_key_of_another() {
        let japanese = who("山田", "class/山田");
        let key = keys(std::slice::from_ref(&japanese)).remove(0);
        let found = keys(&[who(&key, "class/impostor"), japanese]);
        assert_eq!(found[1], key);
        assert_ne!(found[0], key);
    }
}
