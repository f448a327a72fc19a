//! What a student is told whose files do not fill the homework's slots.

use super::fit::tells;
use super::{Slot, SlotProblem};
use crate::language::Text;
use reference::interpreter::Stage;

/// How many file names a message lists.
const LISTED: usize = 4;
/// How many characters of a name a message shows.
const SHOWN: usize = 60;

/// What is missing or double among the files with these names.
pub(crate) fn unfilled(slots: &[Slot], names: &[String], problems: &[SlotProblem]) -> Text {
    let missing: Vec<&Slot> = problems
        .iter()
        .filter_map(|problem| match problem {
            SlotProblem::Missing { slot } => Some(&slots[*slot]),
            SlotProblem::Several { .. } => None,
        })
        .collect();
    let several = problems.iter().filter_map(|problem| match problem {
        SlotProblem::Several { slot, files } => Some(several(slots, *slot, files, names)),
        SlotProblem::Missing { .. } => None,
    });
    let absent = (!missing.is_empty()).then(|| absent(slots, &missing, names));
    let texts: Vec<Text> = several.chain(absent).collect();
    let join = |of: fn(&Text) -> &str, between| texts.iter().map(of).collect::<Vec<_>>().join(between);
    Text::new(join(|text| &text.en, " "), join(|text| &text.ja, ""))
}

/// The names of all slots, as a homework asks for them.
pub(crate) fn wanted<'a>(slots: impl IntoIterator<Item = &'a Slot>) -> Text {
    let names: Vec<String> = slots.into_iter().map(|slot| format!("`{}`", slot.name)).collect();
    Text::new(joined(&names, "and"), names.join(" と "))
}

/// English names in a row.
fn joined(names: &[String], and: &str) -> String {
    match names {
        [others @ .., last] if !others.is_empty() => format!("{} {and} {last}", others.join(", ")),
        names => names.concat(),
    }
}

/// Several files are as good as each other.
fn several(slots: &[Slot], slot: usize, files: &[usize], names: &[String]) -> Text {
    let names: Vec<String> = files.iter().map(|&file| names[file].clone()).collect();
    let (list, name) = (list(&names), &slots[slot].name);
    if let [_] = slots {
        return Text::new(
            format!("Several files could be the one to grade: {}. Hand in one file, `{name}`.", list.en),
            format!("採点するファイルの候補が複数あります: {}。`{name}` を 1 つだけ提出してください。", list.ja),
        );
    }
    let wanted = wanted(slots);
    Text::new(
        format!("It is not clear which file is `{name}`: {}. Hand in {} under these names.", list.en, wanted.en),
        format!(
            "どれが `{name}` なのか分かりません: {}。{} をこの名前で 1 つずつ提出してください。",
            list.ja, wanted.ja
        ),
    )
}

/// No file is for these slots.
fn absent(slots: &[Slot], missing: &[&Slot], names: &[String]) -> Text {
    let gone = wanted(missing.iter().copied());
    if names.is_empty() {
        let verb = if slots.len() == 1 { "is" } else { "are" };
        return Text::new(
            format!("No file was handed in. {} {verb} what is graded.", gone.en),
            format!("ファイルが提出されていません。採点するのは {} です。", gone.ja),
        );
    }
    let (list, hint) = (list(names), hint(slots, names));
    let together = match slots {
        [_] => Text::default(),
        _ => {
            let wanted = wanted(slots);
            Text::new(
                format!(" Hand in {} together.", wanted.en),
                format!("{} をいっしょに提出してください。", wanted.ja),
            )
        }
    };
    let quoted: Vec<String> = missing.iter().map(|slot| format!("`{}`", slot.name)).collect();
    let none = joined(&quoted, "and no");
    Text::new(
        format!("There is no {none}, only {}.{}{}", list.en, hint.en, together.en),
        format!("{} がありません。提出されているのは {} です。{}{}", gone.ja, list.ja, hint.ja, together.ja),
    )
}

/// What may have gone wrong.
fn hint(slots: &[Slot], names: &[String]) -> Text {
    let ends = |extensions: &[&str]| {
        names.iter().any(|name| {
            let name = name.to_lowercase();
            extensions.iter().any(|extension| name.ends_with(extension))
        })
    };
    if ends(&[".rar", ".7z", ".lzh", ".tar", ".gz", ".tgz", ".xz", ".bz2"]) {
        return Text::new(
            " Of archives only ZIP is opened: hand in the file itself.",
            "展開できる圧縮ファイルは ZIP だけです。ファイルそのものを提出してください。",
        );
    }
    for stage in [Stage::Vertex, Stage::Fragment] {
        let is_wanted = slots.iter().any(|slot| slot.stage == stage);
        if let ([slot, ..], false) = (slots, is_wanted)
            && names.iter().any(|name| tells(name, stage))
        {
            return other_stage(stage, slot.stage);
        }
    }
    if ends(&[".docx", ".doc", ".pdf", ".rtf", ".odt", ".pages"]) {
        Text::new(
            " A document cannot be compiled: hand in the shader's source file.",
            "文書ファイルはコンパイルできません。シェーダのソースファイルを提出してください。",
        )
    } else if ends(&[".png", ".jpg", ".jpeg", ".heic", ".bmp", ".gif", ".mp4", ".mov"]) {
        Text::new(
            " A picture cannot be compiled: hand in the shader's source file.",
            "画像はコンパイルできません。シェーダのソースファイルを提出してください。",
        )
    } else {
        Text::default()
    }
}

fn other_stage(found: Stage, wanted: Stage) -> Text {
    let word = |stage| match stage {
        Stage::Vertex => ("vertex", "頂点シェーダ"),
        Stage::Fragment => ("fragment", "フラグメントシェーダ"),
    };
    let (found, wanted) = (word(found), word(wanted));
    Text::new(
        format!(" That is the {} shader; this homework is about the {} shader.", found.0, wanted.0),
        format!("それは{}です。この課題で書くのは{}です。", found.1, wanted.1),
    )
}

/// The first of the names, and how many more there are.
pub(crate) fn list(names: &[String]) -> Text {
    let shown = |name: &String| {
        let mut short: String = name.chars().take(SHOWN).collect();
        if short.len() < name.len() {
            short.push('…');
        }
        format!("`{short}`")
    };
    let mut once: Vec<(&String, usize)> = Vec::new();
    for name in names {
        match once.iter_mut().find(|(known, _)| *known == name) {
            Some((_, count)) => *count += 1,
            None => once.push((name, 1)),
        }
    }
    let counted = |(name, count): &(&String, usize)| match count {
        1 => shown(name),
        _ => format!("{} × {count}", shown(name)),
    };
    let listed: Vec<String> = once.iter().take(LISTED).map(counted).collect();
    match once.len().checked_sub(LISTED) {
        None | Some(0) => Text::new(listed.join(", "), listed.join("、")),
        Some(more) => {
            Text::new(format!("{} and {more} more", listed.join(", ")), format!("{} ほか {more} 個", listed.join("、")))
        }
    }
}
