//! Characters that are no GLSL.

use super::*;

fn only(refusal: &SourceRefusal) -> &Diagnostic {
    assert_eq!(refusal.diagnostics.len(), 1, "{:?}", refusal.diagnostics);
    &refusal.diagnostics[0]
}

#[test]
fn each_is_told_at_its_place_by_its_name_and_with_what_to_type() {
    for (code, column, length, name, hint) in [
        ("float　a;", 8, 1, "U+3000 IDEOGRAPHIC SPACE", "ordinary space"),
        ("float a；", 10, 1, "U+FF1B FULLWIDTH SEMICOLON", "`;`"),
        ("float a ＝ 1;", 11, 1, "U+FF1D FULLWIDTH EQUALS SIGN", "`=`"),
        ("f（1);", 4, 1, "U+FF08 FULLWIDTH LEFT PARENTHESIS", "`(`"),
        ("ｖｅｃ４ a;", 3, 4, "U+FF56 FULLWIDTH LATIN SMALL LETTER V", "`vec4`"),
        ("a = b − c;", 9, 1, "U+2212 MINUS SIGN", "`-`"),
        ("a = b × c;", 9, 1, "U+00D7 MULTIPLICATION SIGN", "`*`"),
        ("a = “b;", 7, 1, "U+201C LEFT DOUBLE QUOTATION MARK", "delete it"),
        ("a\u{A0}= b;", 4, 1, "U+00A0 NO-BREAK SPACE", "ordinary space"),
        ("a\u{200B}= b;", 4, 1, "U+200B ZERO WIDTH SPACE", "Delete it"),
        ("a\u{FEFF}= b;", 4, 1, "U+FEFF ZERO WIDTH NO-BREAK SPACE", "Delete it"),
        ("a\u{AD}= b;", 4, 1, "U+00AD SOFT HYPHEN", "Delete it"),
        ("a\u{202E}= b;", 4, 1, "U+202E RIGHT-TO-LEFT OVERRIDE", "Delete it"),
        ("v\u{435}c4 a;", 4, 1, "U+0435 CYRILLIC SMALL LETTER IE", "`e`"),
        ("a = π;", 7, 1, "U+03C0 GREEK SMALL LETTER PI", "Names consist"),
        ("a\u{37E}", 4, 1, "U+037E GREEK QUESTION MARK", "`;`"),
        ("a = 2 ー b;", 9, 1, "U+30FC KATAKANA-HIRAGANA PROLONGED SOUND MARK", "`-`"),
        ("a\u{1A}", 4, 1, "U+001A SUBSTITUTE", "Delete it"),
        ("ここで光を足す", 3, 7, "U+3053 HIRAGANA LETTER KO", "put // before it"),
    ] {
        let refusal = refuse(shader("", "", code));
        let error = only(&refusal);
        assert_eq!((error.severity, error.stage), (Severity::Error, crate::diagnostic::DiagnosticStage::Source));
        assert_eq!((error.line, error.column, error.length), (Some(6), Some(column), length), "{code}");
        assert!(error.message.en.contains(name), "{}", error.message.en);
        assert!(error.message.ja.contains(name), "{}", error.message.ja);
        assert!(error.hint.as_ref().is_some_and(|text| text.en.contains(hint)), "{:?}", error.hint);
    }
}

#[test]
fn columns_are_right_after_a_comment_in_japanese() {
    let refusal = refuse(shader("", "", "/* 光 */ a；"));
    // Two spaces, seven characters of comment, a space and the a: the semicolon is the twelfth.
    assert_eq!(places(&refusal.diagnostics), [(6, 12, 1)]);
}

#[test]
fn neighbours_of_one_kind_are_one_place() {
    let refusal = refuse(shader("", "", "f（）；　　a；"));
    assert_eq!(places(&refusal.diagnostics), [(6, 4, 3), (6, 7, 2), (6, 10, 1)]);
}

#[test]
fn the_first_twenty_places_are_told_and_the_rest_counted() {
    let refusal = refuse(shader("", &"a；\n".repeat(25), ""));
    assert_eq!(refusal.diagnostics.len(), 21);
    assert!(refusal.diagnostics[20].message.en.contains('5'));
    assert_eq!(refusal.diagnostics[20].line, None);
    assert_eq!(refuse(shader("", &"a；\n".repeat(20), "")).diagnostics.len(), 20);
}

#[test]
fn the_refusal_keeps_the_text_for_the_excerpt() {
    let refusal = refuse(shader("", "", "a；"));
    assert_eq!(refusal.source.as_ref().map(|source| source.line(6)), Some("  a；"));
    assert_eq!(refusal.facts.encoding, Some(Encoding::Utf8));
}

#[test]
fn comments_may_hold_anything() {
    for text in [
        shader("全角　（）；", "", "/* ｖｅｃ４\n　；*/"),
        shader("a \\\n続き；", "", ""),
        shader("", "/\\\n/ 続き；", ""),
        shader("", "#define X 1 // 光；\n", "float a = X;"),
    ] {
        assert_eq!(accept(text).notes, []);
    }
}

// Mesa compiles each of these.
#[test]
fn what_a_driver_skips_is_a_warning() {
    for (declaration, line, column) in [
        ("#if 0\nここは使わない；\n#endif", 5, 1),
        ("#if 0\n#error 未対応\n#endif", 5, 8),
        ("#pragma 日本語", 4, 9),
        ("#define UNUSED 日本語", 4, 16),
        ("#ifdef NEVER\nａ\n#endif", 5, 1),
    ] {
        let source = accept(shader("", declaration, ""));
        assert_eq!(source.notes.len(), 1, "{declaration}");
        assert_eq!((source.notes[0].line, source.notes[0].column), (Some(line), Some(column)), "{declaration}");
        assert_eq!(source.notes[0].severity, Severity::Warning);
    }
}

// Mesa refuses each of these.
#[test]
fn what_a_driver_reads_is_an_error() {
    for declaration in [
        "#if 1\na；\n#endif",
        "#define USED 1　",
        "#define　BROKEN",
        "#if 0\n#endif　日本語",
        "#if 0\n#else　日本語\n#endif",
        "#undef 日本語",
        "#extension　GL_ARB_gpu_shader5 : enable",
    ] {
        let refusal = refuse(shader("", declaration, "float a = USED;"));
        assert_eq!(refusal.diagnostics[0].severity, Severity::Error, "{declaration}");
    }
}

#[test]
fn only_the_compiler_can_decide_on_its_own_macros() {
    let source = accept(shader("", "#if __VERSION__ < 410\na；\n#endif", ""));
    assert_eq!((source.notes[0].severity, source.notes[0].line), (Severity::Warning, Some(5)));
}

#[test]
fn a_turned_comment_is_a_warning() {
    let source = accept(shader("a \u{202E}b", "", ""));
    // "#version 410 core // a " are 23 characters.
    assert_eq!(places(&source.notes), [(1, 24, 1)]);
    assert!(source.notes[0].message.en.contains("U+202E"));
}
