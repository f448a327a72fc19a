//! How well a file's name fits a slot.

use super::Slot;
use reference::interpreter::Stage;

/// How well a file's name fits, the best first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum NameFit {
    /// The slot's file name.
    Exact,
    /// That name with the mark of a copy.
    Copy,
    /// Another shader of the slot's stage.
    Shader,
    /// The slot's file, or some shader, with another extension behind it or in its place.
    Renamed,
    /// A text, which may be a shader.
    Text,
    /// Anything else.
    Other,
}

impl NameFit {
    /// The ranks of files that may be chosen.
    pub const CHOSEN: [Self; 5] = [Self::Exact, Self::Copy, Self::Shader, Self::Renamed, Self::Text];

    /// The best fit of a name to any slot.
    pub fn best(name: &str, slots: &[Slot]) -> Self {
        slots.iter().map(|slot| fit(name, slot)).min().unwrap_or(Self::Other)
    }
}

/// Extensions that tools give to a shader of any stage.
const OF_ANY: [&str; 2] = ["glsl", "shader"];

/// The extensions of programs in C++.
pub(crate) const OF_PROGRAMS: (&str, &[&str]) = ("cpp", &["cc", "cxx", "c++"]);

/// The extensions of what a slot is for.
fn of_slot(slot: &Slot) -> (&'static str, &'static [&'static str]) {
    if slot.program.is_some() { OF_PROGRAMS } else { extensions(slot.stage) }
}

/// The extensions of a stage: the homework's own, and those that other tools give.
fn extensions(stage: Stage) -> (&'static str, &'static [&'static str]) {
    match stage {
        Stage::Vertex => ("vert", &["vs", "vsh", "vertex", "vshader"]),
        Stage::Fragment => ("frag", &["fs", "fsh", "fragment", "fshader"]),
    }
}

/// How well `name` fits the slot.
pub fn fit(name: &str, slot: &Slot) -> NameFit {
    let name = name.trim().to_lowercase();
    let wanted = slot.name.to_lowercase();
    if name == wanted {
        return NameFit::Exact;
    }
    let (own, others) = of_slot(slot);
    let is_text = |extension: &str| ["", "txt", "text"].contains(&extension) || OF_ANY.contains(&extension);
    // `vertex.glsl`, `a.vs.txt`, `a.cpp.txt`.
    let tells_slot = |stem: &str| match slot.program {
        Some(_) => stem.strip_suffix(own).is_some_and(|rest| rest.ends_with('.')),
        None => tells(stem, slot.stage),
    };
    let wanted_stem = wanted.rsplit_once('.').map_or(wanted.as_str(), |(stem, _)| stem);
    let (stem, extension) = name.rsplit_once('.').unwrap_or((&name, ""));
    let is_wanted_stem = without_copy_mark(stem) == wanted_stem;
    match extension {
        _ if extension == own && is_wanted_stem => NameFit::Copy,
        _ if extension == own => NameFit::Shader,
        _ if stem == wanted || is_wanted_stem && (is_text(extension) || others.contains(&extension)) => {
            NameFit::Renamed
        }
        _ if others.contains(&extension) || is_text(extension) && tells_slot(stem) => NameFit::Renamed,
        // What has another stage in its name is none of this one.
        _ if is_text(extension) && tells_stage(stem) => NameFit::Other,
        _ if OF_ANY.contains(&extension) => NameFit::Renamed,
        "txt" | "" => NameFit::Text,
        _ => NameFit::Other,
    }
}

/// Whether a name tells the stage of its file.
pub(super) fn tells_stage(name: &str) -> bool {
    [Stage::Vertex, Stage::Fragment].into_iter().any(|stage| tells(name, stage))
}

/// Whether a name tells by one of its last two words, `.` between them, that the file is of this stage.
pub(crate) fn tells(name: &str, stage: Stage) -> bool {
    let name = name.trim().to_lowercase();
    let (own, others) = extensions(stage);
    name.rsplit('.').take(2).any(|extension| extension == own || others.contains(&extension))
}

/// `stem` without what browsers and systems put behind the name of a copy: ` (1)`, ` - Copy`, ` - コピー (2)`, ` 2`, and
/// the number that upload pages append (`_1234567890`, `-1`).
fn without_copy_mark(stem: &str) -> &str {
    let mut stem = stem;
    loop {
        let rest = stem.trim_end();
        let in_brackets = rest
            .strip_suffix(')')
            .and_then(|rest| rest.trim_end_matches(|c: char| c.is_ascii_digit()).strip_suffix('('));
        let word = ["copy", "コピー"].iter().find_map(|word| rest.strip_suffix(word));
        let word = word.map(|rest| rest.trim_end().trim_end_matches(['-', 'の']));
        let number = rest.trim_end_matches(|c: char| c.is_ascii_digit());
        let numbered =
            (number.len() < rest.len()).then_some(number).and_then(|rest| rest.strip_suffix([' ', '_', '-']));
        match in_brackets.or(word).or(numbered) {
            Some(shorter) if !shorter.trim_end().is_empty() => stem = shorter.trim_end(),
            _ => return rest,
        }
    }
}
