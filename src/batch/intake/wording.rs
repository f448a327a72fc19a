//! What a student is told whose hand-in has no file to grade.

use super::moodle;
use crate::batch::class::Participant;
use crate::language::Text;

/// How many file names a message lists.
const LISTED: usize = 4;
/// How many characters of a name a message shows.
const SHOWN: usize = 60;

/// Several files are as good as each other.
pub(super) fn several(names: &[String], wanted: &str) -> Text {
    let list = list(names);
    Text::new(
        format!("Several files could be the one to grade: {}. Hand in one file, `{wanted}`.", list.en),
        format!("採点するファイルの候補が複数あります: {}。`{wanted}` を 1 つだけ提出してください。", list.ja),
    )
}

/// None of the files can be graded.
pub(super) fn none_fits(names: &[String], has_online_text: bool, wanted: &str) -> Text {
    if names.is_empty() {
        return if has_online_text {
            Text::new(
                format!("Only text typed into Moodle was handed in. Hand in the file `{wanted}`."),
                format!("オンラインテキストだけが提出されています。ファイル `{wanted}` を提出してください。"),
            )
        } else {
            Text::new(
                format!("No file was handed in. `{wanted}` is what is graded."),
                format!("ファイルが提出されていません。採点するのは `{wanted}` です。"),
            )
        };
    }
    let list = list(names);
    let hint = hint(names);
    Text::new(
        format!("There is no `{wanted}`, only {}.{}", list.en, hint.en),
        format!("`{wanted}` がありません。提出されているのは {} です。{}", list.ja, hint.ja),
    )
}

/// A name in a Moodle download that is one of several students'.
pub(super) fn unclear(participants: &[Participant]) -> Text {
    let names: Vec<String> = participants.iter().map(moodle::numbered).collect();
    let list = list(&names);
    Text::new(
        format!(
            "Its name can be read as that of a file of each of these: {}. It is not graded for any of them. Download the \
             submissions with \"Download submissions in folders\" on, which leaves no doubt.",
            list.en
        ),
        format!(
            "この名前は、次のどの提出者のファイルとも読めます: {}。だれの提出としても採点していません。Moodle の\
             「提出をフォルダに入れてダウンロードする」を有効にしてダウンロードし直すと、区別できます。",
            list.ja
        ),
    )
}

/// What may have gone wrong.
fn hint(names: &[String]) -> Text {
    let ends = |extensions: &[&str]| {
        names.iter().any(|name| {
            let name = name.to_lowercase();
            extensions.iter().any(|extension| name.ends_with(extension))
        })
    };
    if ends(&[".rar", ".7z", ".lzh", ".tar", ".gz", ".tgz", ".xz", ".bz2"]) {
        Text::new(
            " Of archives only ZIP is opened: hand in the file itself.",
            "展開できる圧縮ファイルは ZIP だけです。ファイルそのものを提出してください。",
        )
    } else if ends(&[".frag", ".fs", ".fsh"]) {
        Text::new(
            " That is the fragment shader; this homework is about the vertex shader.",
            "それはフラグメントシェーダです。この課題で書くのは頂点シェーダです。",
        )
    } else if ends(&[".docx", ".doc", ".pdf", ".rtf", ".odt", ".pages"]) {
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

/// The first of the names, and how many more there are.
fn list(names: &[String]) -> Text {
    let shown = |name: &String| {
        let mut short: String = name.chars().take(SHOWN).collect();
        if short.len() < name.len() {
            short.push('…');
        }
        format!("`{short}`")
    };
    let listed: Vec<String> = names.iter().take(LISTED).map(shown).collect();
    match names.len().checked_sub(LISTED) {
        None | Some(0) => Text::new(listed.join(", "), listed.join("、")),
        Some(more) => {
            Text::new(format!("{} and {more} more", listed.join(", ")), format!("{} ほか {more} 個", listed.join("、")))
        }
    }
}
