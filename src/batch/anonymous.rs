//! Pseudonyms in place of everything that names a student.
//!
//! A pseudonym is an HMAC of the student's key under a random key of the output folder: the same folder gives the same
//! pseudonyms again, another folder gives others, and without the key nobody can try names until one fits. What a student
//! wrote inside the file stays as it is: a name in a comment is still there.

use crate::class::folder::OutputFolder;
use crate::class::formats::plain::cell;
use crate::fault::Fault;
use crate::hand_in::hexadecimal;
use crate::intake::{FileLocation, HandInContent, Intake, Refused, Student, StudentWork};
use crate::language::Text;
use crate::slots::Slot;
use hmac::{Hmac, KeyInit, Mac};
use sha2::Sha256;
use std::collections::HashSet;

/// Name of the key's file in the output folder.
pub const KEY_FILE: &str = "pseudonyms.key";

const KEY_BYTES: usize = 32;

/// What stands in the key's file above the key.
const WARNING: &str = "# Whoever has this file and a list of names can find out whose pseudonym is whose.\n\
                       # このファイルと名簿があれば、仮名から本人が分かります。ほかの人に渡さないでください。\n";

/// The alphabet of pseudonyms: digits and letters without those that are read as another (Crockford's base 32).
const ALPHABET: &[u8; 32] = b"0123456789ABCDEFGHJKMNPQRSTVWXYZ";

/// Letters of a pseudonym: 40 bits, so that two of 1,000 students agree with probability 5 × 10⁻⁷.
const LETTERS: usize = 8;

/// Gives pseudonyms.
#[derive(Clone)]
pub struct Pseudonyms {
    key: Hmac<Sha256>,
}

/// Who is behind a pseudonym.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NamedStudent {
    /// The pseudonym.
    pub pseudonym: String,
    /// The name.
    pub name: String,
    /// Where the file was.
    pub path: Option<String>,
}

impl std::fmt::Debug for Pseudonyms {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Pseudonyms")
    }
}

impl Pseudonyms {
    /// The pseudonyms of this folder; a key is made where there is none.
    pub fn of(folder: &OutputFolder) -> Result<Self, Fault> {
        let bytes = match folder.read(KEY_FILE)? {
            Some(text) => parsed(&text).ok_or_else(|| broken(folder))?,
            None => {
                let mut bytes = [0; KEY_BYTES];
                getrandom::fill(&mut bytes).map_err(|error| no_random(&error))?;
                let digits = hexadecimal(&bytes);
                folder.write_private(KEY_FILE, format!("{WARNING}{digits}\n").as_bytes())?;
                bytes
            }
        };
        Self::with_key(&bytes).ok_or_else(|| broken(folder))
    }

    fn with_key(key: &[u8]) -> Option<Self> {
        Hmac::new_from_slice(key).ok().map(|key| Self { key })
    }

    /// The pseudonym of a student: `K7QF-2M9D`, say. `round` tells students apart who would have the same one.
    fn letters(&self, student: &str, round: u32) -> String {
        let mut mac = self.key.clone();
        mac.update(&round.to_le_bytes());
        mac.update(student.as_bytes());
        let digest = mac.finalize().into_bytes();
        let letters = digest.iter().take(LETTERS).map(|byte| char::from(ALPHABET[usize::from(byte % 32)]));
        letters.collect()
    }

    /// The intake with pseudonyms for names, in the order of the pseudonyms, and whom they stand for. Every file gets
    /// the name of its slot.
    pub fn hide(&self, intake: Intake, slots: &[Slot]) -> (Intake, Vec<NamedStudent>) {
        let mut taken = HashSet::new();
        let mut hidden: Vec<(StudentWork, NamedStudent)> = Vec::new();
        for hand_in in intake.hand_ins {
            let mut round = 0;
            let letters = loop {
                let letters = self.letters(&hand_in.student.key, round);
                if taken.insert(letters.clone()) {
                    break letters;
                }
                round += 1;
            };
            let (start, end) = letters.split_at(LETTERS / 2);
            let pseudonym = format!("{start}-{end}");
            let path = hand_in.path();
            let StudentWork { student, content } = hand_in;
            let named = NamedStudent { pseudonym: pseudonym.clone(), name: student.name, path };
            let content = match content {
                HandInContent::Files { mut hand_in, .. } => {
                    for (file, slot) in hand_in.files.iter_mut().zip(slots) {
                        slot.name.clone_into(&mut file.name);
                    }
                    let place = |slot: &Slot| FileLocation { path: format!("{pseudonym}/{}", slot.name), local: None };
                    HandInContent::Files { hand_in, places: slots.iter().map(place).collect() }
                }
                HandInContent::Nothing(_) => HandInContent::Nothing(nothing()),
            };
            let hand_in = StudentWork {
                student: Student {
                    key: letters.to_ascii_lowercase(),
                    name: pseudonym.clone(),
                    moodle: None,
                    email: None,
                },
                content,
            };
            hidden.push((hand_in, named));
        }
        hidden.sort_by(|(_, a), (_, b)| a.pseudonym.cmp(&b.pseudonym));
        let (hand_ins, named) = hidden.into_iter().unzip();
        let refused = intake.refused.iter().zip(1..).map(|(_, number)| left_out(number)).collect();
        (Intake { title: String::new(), hand_ins, refused }, named)
    }
}

/// Whose pseudonym is whose, as a table for spreadsheets.
pub fn table(named: &[NamedStudent]) -> Result<Vec<u8>, Fault> {
    let mut bytes = "\u{feff}".as_bytes().to_vec();
    let mut writer = csv::WriterBuilder::new().terminator(csv::Terminator::CRLF).from_writer(&mut bytes);
    let rows = named.iter().map(|n| [cell(&n.pseudonym), cell(&n.name), cell(n.path.as_deref().unwrap_or_default())]);
    let header = ["pseudonym", "name", "path"].map(str::to_owned);
    let written = std::iter::once(header).chain(rows).try_for_each(|row| writer.write_record(row));
    written.and_then(|()| writer.flush().map_err(csv::Error::from)).map_err(|error| {
        Fault::new(Text::new(
            format!("the names cannot be written: {error}"),
            format!("氏名の表を作成できません: {error}"),
        ))
    })?;
    drop(writer);
    Ok(bytes)
}

fn parsed(text: &[u8]) -> Option<[u8; KEY_BYTES]> {
    let text = std::str::from_utf8(text).ok()?;
    let hex = text.lines().map(str::trim).find(|line| !line.is_empty() && !line.starts_with('#'))?;
    let digits: Vec<u8> =
        hex.chars().map(|c| c.to_digit(16).and_then(|d| u8::try_from(d).ok())).collect::<Option<_>>()?;
    let bytes: Vec<u8> = digits.chunks_exact(2).map(|pair| pair[0] << 4 | pair[1]).collect();
    (digits.len() == 2 * KEY_BYTES).then(|| bytes.try_into().ok())?
}

/// The usual reason names files.
fn nothing() -> Text {
    Text::new(
        "There is no single file that could be graded (which files there are is not shown with --anonymous).",
        "採点できるファイルが 1 つに定まりません (--anonymous を付けたときは、ファイル名を表示しません)。",
    )
}

fn left_out(number: usize) -> Refused {
    Refused {
        path: format!("({number})"),
        reason: Text::new(
            "left out; where it was and why is not shown with --anonymous",
            "読み込みませんでした (--anonymous を付けたときは、場所と理由を表示しません)",
        ),
    }
}

fn broken(folder: &OutputFolder) -> Fault {
    let path = folder.at(KEY_FILE);
    let path = path.display();
    Fault::new(Text::new(
        format!("{path} holds no key: 64 hexadecimal digits were expected"),
        format!("{path} に鍵がありません (64 桁の 16 進数が必要です)"),
    ))
    .remedy(Text::new(
        "Put back the key that this folder was begun with, or begin a new folder.",
        "このフォルダを作ったときの鍵を戻すか、別のフォルダを指定してください。",
    ))
}

fn no_random(error: &getrandom::Error) -> Fault {
    Fault::new(Text::new(
        format!("this machine gives no random numbers for the pseudonyms: {error}"),
        format!("仮名に使う乱数が得られません: {error}"),
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hand_in::HandIn;

    fn hand_in(key: &str, name: &str) -> StudentWork {
        StudentWork {
            student: Student { key: key.into(), name: name.into(), moodle: None, email: None },
            content: HandInContent::Files {
                hand_in: HandIn::of_one(format!("{name}.vert"), "void main() {}"),
                places: vec![FileLocation {
                    path: format!("class.zip/{name}/{name}.vert"),
                    local: Some(format!("{name}.vert").into()),
                }],
            },
        }
    }

    fn slots() -> Vec<Slot> {
        reference::assignment("ggsample06").unwrap().files.clone()
    }

    fn intake() -> Intake {
        let mut hand_ins: Vec<_> = (0..50).map(|n| hand_in(&format!("s{n}"), &format!("tanaka{n}"))).collect();
        hand_ins[3].content = HandInContent::Nothing(Text::verbatim("tanaka3.docx is no shader"));
        let refused = vec![Refused { path: "tanaka.zip".into(), reason: Text::verbatim("tanaka") }];
        Intake { title: "tanaka".into(), hand_ins, refused }
    }

    #[test]
    fn no_name_is_left_and_everyone_is_there() {
        let (hidden, named) = Pseudonyms::with_key(&[1; 32]).unwrap().hide(intake(), &slots());
        assert!(!format!("{hidden:?}").contains("tanaka"));
        let keys: HashSet<_> = hidden.hand_ins.iter().map(|hand_in| hand_in.student.key.as_str()).collect();
        assert_eq!((keys.len(), named.len()), (50, 50));
        assert!(keys.iter().all(|key| key.bytes().all(|b| b.is_ascii_lowercase() || b.is_ascii_digit())));
        // The order says nothing of the names.
        let names: Vec<_> = named.iter().map(|named| named.name.as_str()).collect();
        assert_ne!(names, (0..50).map(|n| format!("tanaka{n}")).collect::<Vec<_>>());
        for (hand_in, named) in hidden.hand_ins.iter().zip(&named) {
            assert_eq!(hand_in.student.name, named.pseudonym);
        }
    }

    #[test]
    fn a_folder_keeps_its_pseudonyms_and_another_has_others() {
        let place = tempfile::tempdir().unwrap();
        let folder = OutputFolder::open(place.path()).unwrap();
        let of = |folder: &OutputFolder| Pseudonyms::of(folder).unwrap().hide(intake(), &slots()).1;
        let first = of(&folder);
        assert_eq!(of(&folder), first);
        let other = tempfile::tempdir().unwrap();
        assert_ne!(of(&OutputFolder::open(other.path()).unwrap()), first);
    }

    #[test]
    fn a_broken_key_is_no_key() {
        let place = tempfile::tempdir().unwrap();
        let folder = OutputFolder::open(place.path()).unwrap();
        for text in ["", "# nothing\n", "00", &"g".repeat(64), &"0".repeat(63), &"0".repeat(66)] {
            folder.write(KEY_FILE, text.as_bytes()).unwrap();
            assert!(Pseudonyms::of(&folder).is_err(), "{text}");
        }
    }
}
