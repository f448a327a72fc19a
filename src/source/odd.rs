//! Characters that do not belong into GLSL, told by their name before a compiler complains of what comes after them.

use super::Source;
use super::directives::{Standing, standings};
use super::encoding::Encoding;
use super::lookalikes::{ascii_for, is_bidi, is_invisible, is_space, name};
use crate::diagnostic::{Diagnostic, Severity, Stage};
use crate::language::Text;

/// How many places are told one by one.
const MAX_PLACES: usize = 20;
/// How many characters of one place are told by name.
const MAX_NAMES: usize = 4;

/// Neighbouring odd characters of one kind on one line.
struct Run<'a> {
    line: u32,
    /// Where it begins in the text, in bytes.
    offset: usize,
    text: &'a str,
}

/// Errors and warnings about the code of `source`.
pub(super) fn in_code(source: &Source) -> (Vec<Diagnostic>, Vec<Diagnostic>) {
    let standings = standings(source.code());
    let standing = |run: &Run| {
        standings
            .get(run.line as usize - 1)
            .copied()
            .unwrap_or(Standing::Compiled)
    };
    let (errors, mut warnings): (Vec<_>, Vec<_>) = runs(source)
        .into_iter()
        .partition(|run| standing(run) == Standing::Compiled);
    // One word a line is enough where nothing is wrong.
    warnings.dedup_by(|next, run| standing(run) == Standing::Skipped && next.line == run.line);
    let errors = bounded(Severity::Error, &errors, |run| told(run));
    let warnings = bounded(Severity::Warning, &warnings, |run| match standing(run) {
        Standing::Skipped => skipped(run),
        _ => told(run),
    });
    let place = |diagnostics: Vec<(Option<usize>, Diagnostic)>| {
        let placed = diagnostics
            .into_iter()
            .map(|(offset, diagnostic)| match offset {
                Some(offset) => at(source, offset, diagnostic),
                None => diagnostic,
            });
        placed.collect()
    };
    (place(errors), place(warnings))
}

/// `diagnostic` at a byte offset of the text.
fn at(source: &Source, offset: usize, diagnostic: Diagnostic) -> Diagnostic {
    let (line, column) = source.position(offset);
    diagnostic.at(line, Some(column))
}

/// Warnings about the comments of `source`: what cannot be read, what misleads the eye, what a driver reads otherwise.
pub(super) fn in_comments(source: &Source) -> Vec<Diagnostic> {
    let comments = || {
        source
            .comments
            .iter()
            .map(|comment| (comment, &source.text[comment.range.clone()]))
    };
    let characters = || {
        comments().flat_map(|(comment, text)| {
            text.char_indices()
                .map(|(at, c)| (comment.range.start + at, c))
        })
    };
    let mut notes = Vec::new();
    if source.facts.encoding == Some(Encoding::ShiftJis) {
        let ends = comments()
            .filter(|(comment, _)| comment.to_line_end)
            .map(|(comment, _)| comment.range.end);
        notes.extend(
            ends.filter_map(|end| hidden_backslash(source, end))
                .take(MAX_PLACES),
        );
    }
    let turning = characters().filter(|&(_, c)| is_bidi(c)).take(MAX_PLACES);
    notes.extend(turning.map(|(offset, c)| at(source, offset, turned(c))));
    let mut unreadable = characters().filter(|&(_, c)| c == '\u{FFFD}');
    if let Some((offset, _)) = unreadable.next() {
        notes.push(at(
            source,
            offset,
            unreadable_comment(1 + unreadable.count()),
        ));
    }
    notes
}

fn runs(source: &Source) -> Vec<Run<'_>> {
    let mut runs = Vec::new();
    for (line, &start) in (1..).zip(&source.line_starts) {
        let code = source.code_line(line);
        let mut at = 0;
        while let Some(found) = code[at..].find(is_odd) {
            let begin = at + found;
            let first = code[begin..].chars().next().map_or(Kind::Foreign, kind);
            let ends = |c: char| !is_odd(c) || kind(c) != first;
            at = code[begin..]
                .find(ends)
                .map_or(code.len(), |length| begin + length);
            runs.push(Run {
                line,
                offset: start + begin,
                text: &code[begin..at],
            });
        }
    }
    runs
}

/// Whether `c` is neither ASCII nor white space that GLSL takes.
fn is_odd(c: char) -> bool {
    !c.is_ascii() || (c.is_ascii_control() && !matches!(c, '\t' | '\n' | '\u{B}' | '\u{C}'))
}

/// What a run consists of.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Space,
    Unseen,
    Unreadable,
    LookAlike,
    Foreign,
}

fn kind(c: char) -> Kind {
    match c {
        '\u{FFFD}' => Kind::Unreadable,
        _ if is_space(c) => Kind::Space,
        _ if is_invisible(c) || is_bidi(c) || c.is_control() => Kind::Unseen,
        // A long vowel inside Japanese text is no minus sign, so it stays with the text.
        'ー' | 'ｰ' | '・' | '･' | '、' | '。' | '「' | '」' => Kind::Foreign,
        _ if ascii_for(c).is_some() => Kind::LookAlike,
        _ => Kind::Foreign,
    }
}

/// The error for a run in code.
fn told(run: &Run) -> Diagnostic {
    let (message, hint) = match run.text.chars().next().map_or(Kind::Foreign, kind) {
        Kind::Space => (
            space(run),
            Text::new(
                "Type an ordinary space instead.",
                "半角スペースに直してください。",
            ),
        ),
        Kind::Unseen => (
            unseen(run),
            Text::new(
                "Delete it: where nothing is to be seen, retype the characters around it.",
                "削除してください。見つけにくいときは、前後の文字ごと打ち直すと消えます。",
            ),
        ),
        Kind::Unreadable => (
            unreadable(),
            Text::new(
                "Retype this place and save the file as UTF-8.",
                "この部分を打ち直し、UTF-8 で保存してください。",
            ),
        ),
        Kind::LookAlike => (look_alike(run), instead(run.text)),
        Kind::Foreign => (foreign(run), foreign_hint(run.text)),
    };
    Diagnostic::error(Stage::Source, message)
        .spanning(run.text.chars().count())
        .hint(hint)
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
        .all(|&c| !matches!(kind(c), Kind::Space | Kind::Unseen | Kind::Unreadable));
    let mut names: Vec<_> = different
        .iter()
        .map(|&c| format!("U+{:04X} {}", u32::from(c), name(c)))
        .collect();
    if names.len() > MAX_NAMES {
        names[MAX_NAMES] = "…".to_owned();
    }
    let names = names.join(", ");
    if seen {
        let shown: String = text.chars().take(MAX_PLACES).collect();
        let more = if shown.len() < text.len() { "…" } else { "" };
        return Text::new(
            format!("“{shown}{more}” ({names})"),
            format!("「{shown}{more}」（{names}）"),
        );
    }
    Text::verbatim(names)
}

fn space(run: &Run) -> Text {
    let names = listing(run.text);
    let (width_en, width_ja) = match run.text.contains('\u{3000}') {
        true => ("A full-width space", "全角スペース"),
        false => (
            "A blank that is no ordinary space",
            "半角スペースではない空白文字",
        ),
    };
    Text::new(
        format!(
            "{width_en} stands in the code: {}. GLSL does not take it for a space.",
            names.en
        ),
        format!(
            "プログラムの中に{width_ja}（{}）があります。GLSL では空白として扱われません。",
            names.ja
        ),
    )
}

fn unseen(run: &Run) -> Text {
    let names = listing(run.text);
    Text::new(
        format!("An invisible character stands in the code: {}.", names.en),
        format!(
            "プログラムの中に目に見えない文字（{}）があります。",
            names.ja
        ),
    )
}

fn unreadable() -> Text {
    Text::new(
        "Bytes in the code cannot be read as characters: they are valid in none of the encodings that this file may have.",
        "プログラムの中に文字として読み取れないバイトがあります。文字コードが壊れているようです。",
    )
}

fn look_alike(run: &Run) -> Text {
    let names = listing(run.text);
    let full_width = run
        .text
        .chars()
        .all(|c| matches!(c, '\u{FF01}'..='\u{FF5E}'));
    let (kind_en, kind_ja) = if full_width {
        ("Full-width", "全角文字")
    } else {
        ("Non-ASCII", "半角英数字・記号ではない文字")
    };
    Text::new(
        format!("{kind_en} {} in the code: GLSL does not know it.", names.en),
        format!(
            "プログラムの中に{kind_ja}{}があります。GLSL では使えません。",
            names.ja
        ),
    )
}

fn foreign(run: &Run) -> Text {
    let names = listing(run.text);
    Text::new(
        format!(
            "{} in the code: outside comments, GLSL consists of ASCII characters only.",
            names.en
        ),
        format!(
            "プログラムの中に{}があります。コメントの外では半角の英数字と記号しか使えません。",
            names.ja
        ),
    )
}

/// What to type for a run of look-alikes.
fn instead(text: &str) -> Text {
    let typed: String = text.chars().filter_map(ascii_for).collect();
    if typed.contains(['"', '\'']) {
        return Text::new(
            "GLSL has no quotation marks: delete it.",
            "GLSL に引用符はありません。削除してください。",
        );
    }
    Text::new(
        format!("Type `{typed}` in ASCII (half-width)."),
        format!("半角の `{typed}` に直してください。"),
    )
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
        _ => Text::new(
            "Names consist of a–z, A–Z, 0–9 and _.",
            "変数名に使えるのは半角の a–z、A–Z、0–9、_ だけです。",
        ),
    }
}

/// The warning for a run where no compiler looks.
fn skipped(run: &Run) -> Diagnostic {
    let names = listing(run.text);
    let message = Text::new(
        format!(
            "{} stands outside a comment, in a line that the compiler skips.",
            names.en
        ),
        format!(
            "コメントの外に{}があります。コンパイラが読み飛ばす行なので採点には影響しません。",
            names.ja
        ),
    );
    Diagnostic::warning(Stage::Source, message).spanning(run.text.chars().count())
}

fn turned(c: char) -> Diagnostic {
    let name = format!("U+{:04X} {}", u32::from(c), name(c));
    let message = Text::new(
        format!("A comment holds {name}, which changes the order in which the text is shown."),
        format!("コメントの中に、文字の表示順を変える制御文字（{name}）があります。"),
    );
    Diagnostic::warning(Stage::Source, message).hint(Text::new(
        "Delete it: the code may not read as it runs.",
        "削除してください。見た目と実際のプログラムの順序が食い違うことがあります。",
    ))
}

fn unreadable_comment(count: usize) -> Diagnostic {
    let message = Text::new(
        format!(
            "{count} place(s) in comments cannot be read as characters. Comments are not compiled, so this changes nothing."
        ),
        format!(
            "コメントの中に文字として読み取れないところが {count} か所あります。コメントなので採点には影響しません。"
        ),
    );
    Diagnostic::warning(Stage::Source, message)
}

/// A `//` comment whose last character ends, in Shift_JIS, with the byte of a backslash: a driver that gets these bytes
/// joins the next line to the comment.
fn hidden_backslash(source: &Source, end: usize) -> Option<Diagnostic> {
    let last = source.text[..end].chars().next_back()?;
    let mut buffer = [0; 4];
    let (bytes, _, _) = encoding_rs::SHIFT_JIS.encode(last.encode_utf8(&mut buffer));
    if !matches!(*bytes, [_, b'\\']) {
        return None;
    }
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
    Some(at(
        source,
        end - last.len_utf8(),
        Diagnostic::warning(Stage::Source, message).hint(hint),
    ))
}

/// What `tell` says of the first places, each with its offset, and how many more there are.
fn bounded(
    severity: Severity,
    runs: &[Run],
    tell: impl Fn(&Run) -> Diagnostic,
) -> Vec<(Option<usize>, Diagnostic)> {
    let first = runs.iter().take(MAX_PLACES);
    let mut told: Vec<_> = first
        .map(|run| {
            (
                Some(run.offset),
                Diagnostic {
                    severity,
                    ..tell(run)
                },
            )
        })
        .collect();
    let more = runs.len() - told.len();
    if more > 0 {
        let message = Text::new(
            format!("And {more} more places of this kind."),
            format!("同じような箇所がほかに {more} か所あります。"),
        );
        told.push((
            None,
            Diagnostic {
                severity,
                ..Diagnostic::error(Stage::Source, message)
            },
        ));
    }
    told
}
