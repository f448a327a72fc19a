//! What is said of odd characters.

use super::{CharacterKind, CharacterRun, kind};
use crate::diagnostic::{Diagnostic, DiagnosticStage};
use crate::language::Text;
use crate::source::lookalikes::{ascii_for, name};

/// How many characters of one place are told by name.
const MAX_NAMES: usize = 3;
/// How many characters of one place are shown.
const MAX_SHOWN: usize = 20;

/// The error for a run in code.
pub(super) fn diagnostic(run: &CharacterRun) -> Diagnostic {
    let (message, hint) = match run.text.chars().next().map_or(CharacterKind::Foreign, kind) {
        CharacterKind::Space => {
            (space(run), Text::new("Type an ordinary space instead.", "半角スペースに直してください。"))
        }
        CharacterKind::Unseen => (
            unseen(run),
            Text::new(
                "Delete it: where nothing is to be seen, retype the characters around it.",
                "削除してください。見つけにくいときは、前後の文字ごと打ち直すと消えます。",
            ),
        ),
        CharacterKind::Unreadable => (
            unreadable(),
            Text::new(
                "Retype this place and save the file as UTF-8.",
                "この部分を打ち直し、UTF-8 で保存してください。",
            ),
        ),
        CharacterKind::LookAlike => (look_alike(run), instead(run.text)),
        CharacterKind::Foreign => (foreign(run), foreign_hint(run.text)),
    };
    Diagnostic::error(DiagnosticStage::Source, message).spanning(run.text.chars().count()).hint(hint)
}

/// The characters of a run with code point and name: `「；」(U+FF1B FULLWIDTH SEMICOLON)`.
fn listing(text: &str) -> Text {
    let mut different: Vec<char> = Vec::new();
    for c in text.chars() {
        if different.len() <= MAX_NAMES && !different.contains(&c) {
            different.push(c);
        }
    }
    let seen = different
        .iter()
        .all(|&c| !matches!(kind(c), CharacterKind::Space | CharacterKind::Unseen | CharacterKind::Unreadable));
    let mut names: Vec<_> = different.iter().map(|&c| format!("U+{:04X} {}", u32::from(c), name(c))).collect();
    // In words of another script the first character stands for all.
    let told = if different.iter().all(|&c| kind(c) == CharacterKind::Foreign) { 1 } else { MAX_NAMES };
    if names.len() > told {
        names.truncate(told);
        names.push("…".to_owned());
    }
    let names = names.join(", ");
    if seen {
        let shown: String = text.chars().take(MAX_SHOWN).collect();
        let more = if shown.len() < text.len() { "…" } else { "" };
        return Text::new(format!("`{shown}{more}` ({names})"), format!("「{shown}{more}」（{names}）"));
    }
    Text::verbatim(names)
}

fn space(run: &CharacterRun) -> Text {
    let names = listing(run.text);
    let (width_en, width_ja) = match run.text.contains('\u{3000}') {
        true => ("A full-width space", "全角スペース"),
        false => ("A blank that is no ordinary space", "半角スペースではない空白文字"),
    };
    Text::new(
        format!("{width_en} stands in the code: {}. GLSL does not take it for a space.", names.en),
        format!("プログラムの中に{width_ja}（{}）があります。GLSL では空白として扱われません。", names.ja),
    )
}

fn unseen(run: &CharacterRun) -> Text {
    let names = listing(run.text);
    Text::new(
        format!("An invisible character stands in the code: {}.", names.en),
        format!("プログラムの中に目に見えない文字（{}）があります。", names.ja),
    )
}

fn unreadable() -> Text {
    Text::new(
        "Bytes in the code cannot be read as characters: they are valid in none of the encodings that this file may have.",
        "プログラムの中に文字として読み取れないバイトがあります。文字コードが壊れているようです。",
    )
}

fn look_alike(run: &CharacterRun) -> Text {
    let names = listing(run.text);
    let full_width = run.text.chars().all(|c| matches!(c, '\u{FF01}'..='\u{FF5E}'));
    let (kind_en, kind_ja) = if full_width {
        ("Full-width", "全角文字")
    } else {
        ("Non-ASCII", "半角英数字・記号ではない文字")
    };
    Text::new(
        format!("{kind_en} {} in the code: GLSL does not know it.", names.en),
        format!("プログラムの中に{kind_ja}{}があります。GLSL では使えません。", names.ja),
    )
}

fn foreign(run: &CharacterRun) -> Text {
    let names = listing(run.text);
    Text::new(
        format!("{} in the code: outside comments, GLSL consists of ASCII characters only.", names.en),
        format!("プログラムの中に{}があります。コメントの外では半角の英数字と記号しか使えません。", names.ja),
    )
}

/// What to type for a run of look-alikes.
fn instead(text: &str) -> Text {
    let typed: String = text.chars().filter_map(ascii_for).collect();
    if typed.contains(['"', '\'']) {
        return Text::new("GLSL has no quotation marks: delete it.", "GLSL に引用符はありません。削除してください。");
    }
    Text::new(format!("Type `{typed}` in ASCII (half-width)."), format!("半角の `{typed}` に直してください。"))
}

fn foreign_hint(text: &str) -> Text {
    let typed: Option<String> = text.chars().map(ascii_for).collect();
    match typed {
        Some(typed) if text.chars().count() == 1 => Text::new(
            format!("If `{typed}` is meant, type it in ASCII (half-width)."),
            format!("`{typed}` のつもりなら、半角で打ち直してください。"),
        ),
        _ if text.chars().count() > 1 => Text::new(
            "If this is a comment, put // before it. Names consist of a–z, A–Z, 0–9 and _.",
            "コメントなら前に // を付けてください。変数名に使えるのは半角の a–z、A–Z、0–9、_ だけです。",
        ),
        _ => Text::new("Names consist of a–z, A–Z, 0–9 and _.", "変数名に使えるのは半角の a–z、A–Z、0–9、_ だけです。"),
    }
}

/// The warning for a run where no compiler looks.
pub(super) fn skipped(run: &CharacterRun) -> Diagnostic {
    let names = listing(run.text);
    let message = Text::new(
        format!("{} stands outside a comment, in a line that the compiler skips.", names.en),
        format!("コメントの外に{}があります。コンパイラが読み飛ばす行なので採点には影響しません。", names.ja),
    );
    Diagnostic::warning(DiagnosticStage::Source, message).spanning(run.text.chars().count())
}

pub(super) fn turned(c: char) -> Diagnostic {
    let name = format!("U+{:04X} {}", u32::from(c), name(c));
    let message = Text::new(
        format!("A comment holds {name}, which changes the order in which the text is shown."),
        format!("コメントの中に、文字の表示順を変える制御文字（{name}）があります。"),
    );
    Diagnostic::warning(DiagnosticStage::Source, message).hint(Text::new(
        "Delete it: the code may not read as it runs.",
        "削除してください。見た目と実際のプログラムの順序が食い違うことがあります。",
    ))
}

pub(super) fn unreadable_comment(count: usize) -> Diagnostic {
    let message = Text::new(
        format!(
            "{count} place(s) in comments cannot be read as characters. Comments are not compiled, so this changes nothing."
        ),
        format!(
            "コメントの中に文字として読み取れないところが {count} か所あります。コメントなので採点には影響しません。"
        ),
    );
    Diagnostic::warning(DiagnosticStage::Source, message)
}

/// The warning for a comment that a driver continues on the next line.
pub(super) fn joined(last: char) -> Diagnostic {
    let message = Text::new(
        format!(
            "In Shift_JIS, “{last}” ends with the byte of a backslash. An OpenGL driver that reads this file takes the next line for a part of the comment."
        ),
        format!(
            "Shift_JIS の「{last}」は 2 バイト目が `\\` と同じです。このファイルをそのまま読む OpenGL ドライバでは、次の行までコメントとして扱われます。"
        ),
    );
    let hint = Text::new(
        "Save the file as UTF-8, or end the comment with another character.",
        "UTF-8 で保存し直すか、コメントの最後に句点などを付けてください。",
    );
    Diagnostic::warning(DiagnosticStage::Source, message).hint(hint)
}

/// What stands for `more` places that are not told one by one.
pub(super) fn more(more: usize) -> Diagnostic {
    let message = Text::new(
        format!("And {more} more places of this kind."),
        format!("同じような箇所がほかに {more} か所あります。"),
    );
    Diagnostic::error(DiagnosticStage::Source, message)
}
