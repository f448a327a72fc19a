//! Lists of students in messages.

use super::plain::one_line;
use crate::class::ClassEntry;
use crate::language::Text;

/// As many are named; the rest is counted.
const NAMED: usize = 10;

/// What is said of some students; `None` when there are none.
pub(super) fn note(entries: &[&ClassEntry], en: &str, ja: &str) -> Option<Text> {
    list(entries.iter().map(|entry| one_line(&entry.student.name)).collect(), en, ja)
}

/// The same of anything with a name.
pub(super) fn list(names: Vec<String>, en: &str, ja: &str) -> Option<Text> {
    let (count, more) = (names.len(), names.len().saturating_sub(NAMED));
    let (named_en, named_ja) = (names[..count - more].join(", "), names[..count - more].join("、"));
    match (count, more) {
        (0, _) => None,
        (_, 0) => Some(Text::new(format!("{en}: {named_en}."), format!("{ja}：{named_ja}"))),
        _ => Some(Text::new(format!("{en}: {named_en} and {more} more."), format!("{ja}：{named_ja}、ほか {more} 名"))),
    }
}
