use super::*;
use crate::diagnostic::DiagnosticStage;
use crate::language::Text;
use crate::source::read;

fn source(text: &str) -> Source {
    match read("a.vert", text.as_bytes()) {
        Ok(source) => source,
        Err(refusal) => refusal.source.expect("a text"),
    }
}

fn error() -> Diagnostic {
    Diagnostic::error(DiagnosticStage::Compile, Text::new("wrong", "間違い"))
}

fn shown(text: &str, diagnostic: Diagnostic) -> String {
    excerpt(&[source(text)], &[diagnostic], Language::En, false)
}

#[test]
fn the_line_is_quoted_with_the_place_marked() {
    let hint = Text::new("look here", "ここを見る");
    let diagnostic = error().at(2, Some(3)).spanning(4).hint(hint);
    let expected = "\
error: wrong
 --> a.vert:2:3
  |
2 |   b = c;
  |   ^^^^
  |
  = hint: look here
";
    assert_eq!(shown("a;\n  b = c;\nd;\n", diagnostic.clone()), expected);
    let japanese = excerpt(&[source("a;\n  b = c;\nd;\n")], &[diagnostic], Language::Ja, false);
    assert!(japanese.starts_with("エラー: 間違い\n --> a.vert:2:3\n"), "{japanese}");
    assert!(japanese.ends_with("= ヒント: ここを見る\n"), "{japanese}");
}

#[test]
fn severities_have_their_words() {
    for (severity, en, ja) in
        [(Severity::Error, "error", "エラー"), (Severity::Warning, "warning", "警告"), (Severity::Note, "note", "注意")]
    {
        let diagnostic = Diagnostic { severity, ..error() };
        assert_eq!(excerpt(&[], std::slice::from_ref(&diagnostic), Language::En, false), format!("{en}: wrong\n"));
        assert_eq!(excerpt(&[], &[diagnostic], Language::Ja, false), format!("{ja}: 間違い\n"));
    }
}

/// Columns of the terminal before the mark, and in it; both from the start of the quoted line.
fn mark(text: &str, line: u32, column: u32, length: usize) -> (usize, usize) {
    let shown = shown(text, error().at(line, Some(column)).spanning(length));
    let marked = shown.lines().find(|line| line.contains('^')).expect("a mark");
    let marked = marked.strip_prefix("  | ").expect("a margin");
    (marked.find('^').expect("a mark"), marked.matches('^').count())
}

#[test]
fn the_mark_counts_columns_of_the_terminal() {
    // Two columns for each of 光 and は and for the signs of full width, four for a tab, one for half-width katakana.
    assert_eq!(mark("/*光は*/ a;\n", 1, 8, 1), (9, 1));
    assert_eq!(mark("a；b\n", 1, 2, 1), (1, 2));
    assert_eq!(mark("\ta;\n", 1, 2, 1), (4, 1));
    assert_eq!(mark("\t\t/*ﾗｲﾄ*/ a;\n", 1, 11, 1), (16, 1));
    // か and a voiced mark that takes no room.
    assert_eq!(mark("/*か\u{3099}*/ a;\n", 1, 8, 1), (7, 1));
}

#[test]
fn without_a_column_the_whole_line_is_marked() {
    let shown = shown("  ab c;\n", error().at(1, None));
    assert!(shown.contains("\n1 |   ab c;\n  |   ^^^^^\n"), "{shown}");
}

#[test]
fn a_place_after_the_end_is_told_without_a_quotation() {
    assert_eq!(shown("a;\n", error().at(2, Some(1))), "error: wrong\n--> a.vert:2:1\n");
    // After the last character of a line is still in it.
    assert!(shown("a;\n", error().at(1, Some(3))).contains("\n1 | a;\n  |   ^\n"));
    assert!(shown("a;\n", error().at(1, Some(500))).contains("\n1 | a;\n  |   ^\n"));
}

#[test]
fn without_a_place_there_are_plain_lines() {
    let hint = Text::verbatim("again");
    assert_eq!(shown("a;\n", error().hint(hint)), "error: wrong\nhint: again\n");
    assert_eq!(excerpt(&[], &[error().at(3, Some(1))], Language::En, false), "error: wrong\n");
    assert_eq!(excerpt(&[], &[], Language::En, false), "");
}

#[test]
fn several_are_kept_apart() {
    let two = [error().at(1, Some(1)), error().at(1, Some(1))];
    let shown = excerpt(&[source("a;\n")], &two, Language::En, false);
    assert_eq!(shown.split("\n\n").count(), 2, "{shown}");
}

#[test]
fn nothing_of_the_student_reaches_the_terminal_as_a_command() {
    let hostile = "\x1B[31m\x07\x08\x7F\u{9B}31m\u{202E}\u{2066}\u{200F}\u{61C}\u{200B}\u{FEFF}\u{2028}\u{E0041}";
    let mut source = source(&format!("// {hostile}\n"));
    source.facts.name = format!("a{hostile}\n.vert");
    let text = Text::verbatim(format!("bad {hostile}"));
    let diagnostic = Diagnostic::error(DiagnosticStage::Compile, text.clone()).at(1, Some(4)).hint(text);
    for colour in [false, true] {
        let shown = excerpt(std::slice::from_ref(&source), std::slice::from_ref(&diagnostic), Language::En, colour);
        let plain = shown
            .replace("\x1B[0m", "")
            .replace("\x1B[1m", "")
            .replace("\x1B[94m", "")
            .replace("\x1B[91m", "")
            .replace("\x1B[96m", "");
        assert!(plain.chars().all(|c| c == '\n' || !(c.is_control() || is_bidi(c) || is_invisible(c))), "{plain:?}");
        assert!(plain.contains("␛[31m␇␈␡\u{FFFD}31m"), "{plain}");
        assert_eq!(shown != plain, colour);
    }
}

#[test]
fn pictures_replace_one_character_by_one() {
    assert_eq!(pictured("a\x1Bb\u{202E}c").into_iter().collect::<String>(), "a␛b\u{FFFD}c");
    // One accent on a letter is text; a pile of them is not.
    assert_eq!(pictured("e\u{301}\u{301}\u{301}").into_iter().collect::<String>(), "e\u{301}\u{FFFD}\u{FFFD}");
    assert_eq!(pictured("\u{301}").into_iter().collect::<String>(), "\u{FFFD}");
}

#[test]
fn a_line_without_end_is_cut_around_the_place() {
    let text = format!("{} ； {}\n", "a+".repeat(9000), "b+".repeat(9000));
    let shown = shown(&text, error().at(1, Some(18_002)).spanning(30_000));
    assert!(shown.contains("a.vert:1:18002\n"), "{shown}");
    assert!(shown.lines().all(|line| line.chars().count() < WIDTH + 20), "{shown}");
    assert!(shown.contains('；') && shown.contains("^^"));
}
