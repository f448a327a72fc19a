//! Whole files through [`read`].

use super::*;
use crate::diagnostic::Severity;
use encoding_rs::{EUC_JP, SHIFT_JIS};

mod hostile;
mod stray_characters;
mod wrong_files;

/// A vertex shader with a comment at the end of line 1, a declaration after line 3 and code inside `main` on line 6.
fn shader(comment: &str, declaration: &str, code: &str) -> String {
    format!(
        "#version 410 core // {comment}\nin vec4 pv;\nout vec4 vc;\n{declaration}\nvoid main() {{\n  {code}\n  vc = pv;\n  gl_Position = pv;\n}}\n"
    )
}

fn accept(bytes: impl AsRef<[u8]>) -> Source {
    read("a.vert", bytes.as_ref()).unwrap_or_else(|refusal| panic!("{:?}", refusal.diagnostics))
}

fn refuse(bytes: impl AsRef<[u8]>) -> SourceRefusal {
    *read("a.vert", bytes.as_ref()).expect_err("the file must be refused")
}

/// Line, column and length of each diagnostic.
fn places(diagnostics: &[Diagnostic]) -> Vec<(u32, u32, u32)> {
    diagnostics.iter().map(|d| (d.line.unwrap_or(0), d.column.unwrap_or(0), d.length)).collect()
}

#[test]
fn the_facts_are_those_of_the_bytes() {
    let source = accept("void main() {}");
    // printf 'void main() {}' | sha256sum
    let sha256 = "340c8ac2b0e649293267ee27410a6ec6904b9e6244717604f851f1191dab59c5";
    assert_eq!(source.facts.sha256, sha256);
    assert_eq!((source.facts.name.as_str(), source.facts.bytes), ("a.vert", 14));
    assert_eq!(source.facts.encoding, Some(Encoding::Utf8));
    assert_eq!(source.text, "void main() {}\n");
    assert_eq!(source.notes, []);
}

#[test]
fn every_line_end_counts_once() {
    for (bytes, lines) in [
        ("a\nb\n", &["a", "b"][..]),
        ("a\r\nb\r\n", &["a", "b"]),
        ("a\rb\r", &["a", "b"]),
        ("a\r\nb\nc\rd", &["a", "b", "c", "d"]),
        ("a\n\nb", &["a", "", "b"]),
        ("a\r\r\nb", &["a", "", "b"]),
        ("a\n\rb", &["a", "", "b"]),
    ] {
        let source = accept(bytes);
        assert_eq!(source.line_count() as usize, lines.len(), "{bytes:?}");
        for (line, number) in lines.iter().zip(1..) {
            assert_eq!(source.line(number), *line, "{bytes:?}");
        }
        assert!(source.text.ends_with('\n') && !source.text.contains('\r'));
    }
}

#[test]
fn lines_that_are_not_there_are_empty() {
    let source = accept("a\n");
    assert_eq!((source.line(0), source.line(2), source.line(u32::MAX)), ("", "", ""));
    assert_eq!(
        (source.offset(0, 1), source.offset(1, 0), source.offset(2, 1), source.offset(1, 3)),
        (None, None, None, None)
    );
}

#[test]
fn positions_count_characters() {
    let source = accept("ab\n/*光*/ x\n");
    // Line 2 begins at byte 3; 光 is bytes 5 to 7, the x is byte 11 and the seventh character.
    for (offset, line, column) in
        [(0, 1, 1), (1, 1, 2), (2, 1, 3), (3, 2, 1), (5, 2, 3), (8, 2, 4), (11, 2, 7), (12, 2, 8)]
    {
        assert_eq!(source.position(offset), (line, column), "byte {offset}");
        assert_eq!(source.offset(line, column), Some(offset), "{line}:{column}");
    }
    assert_eq!(source.position(6), (2, 3));
    assert_eq!(source.position(1000), (2, 8));
}

#[test]
fn an_empty_line_has_one_position() {
    let source = accept("a\n\nb\n");
    assert_eq!((source.position(2), source.offset(2, 1)), ((2, 1), Some(2)));
}

#[test]
fn code_is_the_text_without_comments_in_the_same_places() {
    let source = accept("a /* 光 */ b // c\nd\n");
    assert_eq!(source.code().len(), source.text.len());
    assert_eq!(source.code().find('b'), source.text.find('b'));
    assert_eq!(source.code_line(1).trim_end(), format!("a{}b", " ".repeat(" /* 光 */ ".len())));
    assert_eq!(source.words().map(|(_, word)| word).collect::<Vec<_>>(), ["a", "b", "d"]);
}

#[test]
fn a_right_shader_is_accepted_in_every_encoding() {
    let text = shader("環境光 ＋ 拡散反射光；", "", "");
    let utf16 = |to_bytes: fn(u16) -> [u8; 2]| -> Vec<u8> {
        format!("\u{FEFF}{text}").encode_utf16().flat_map(to_bytes).collect()
    };
    for (bytes, encoding) in [
        (text.clone().into_bytes(), Encoding::Utf8),
        (SHIFT_JIS.encode(&text).0.into_owned(), Encoding::ShiftJis),
        (EUC_JP.encode(&text).0.into_owned(), Encoding::EucJp),
        (utf16(u16::to_le_bytes), Encoding::Utf16Le),
        (utf16(u16::to_be_bytes), Encoding::Utf16Be),
    ] {
        let source = accept(bytes);
        assert_eq!((source.facts.encoding, &source.text), (Some(encoding), &text));
    }
}

#[test]
fn a_byte_order_mark_is_left_out_with_a_warning() {
    let source = accept("\u{FEFF}#version 410 core\nvoid main() { gl_Position = vec4(0); }\n");
    assert!(source.text.starts_with("#version"));
    assert_eq!(source.notes[0].severity, Severity::Warning);
    assert!(source.notes[0].message.en.contains("byte-order mark"));
}

#[test]
fn bytes_in_comments_never_refuse_a_file() {
    for comment in [&b"caf\xE9"[..], b"\xFF\xFE\x80", b"\x93", b"\xC3(", b"\xF0\x9F", b"\x1B[31m"] {
        let mut bytes = b"void main() { gl_Position = vec4(0); } // ".to_vec();
        bytes.extend_from_slice(comment);
        let source = accept(&bytes);
        assert_eq!(source.code().trim_end(), "void main() { gl_Position = vec4(0); }", "{comment:?}");
        // Also where code follows.
        bytes.extend_from_slice(b"\nvoid f() {}\n");
        assert_eq!(accept(&bytes).code_line(2), "void f() {}", "{comment:?}");
    }
}

#[test]
fn what_cannot_be_read_in_a_comment_is_a_warning_with_its_place() {
    let source = accept(b"// \xE7\x92\xB0\xE5\xA2\x83\xE5\x85\x89 \xFF\nvoid main() {}\n");
    assert_eq!(source.facts.encoding, Some(Encoding::Utf8));
    // "// 環境光 " are seven characters.
    assert_eq!(places(&source.notes), [(1, 8, 1)]);
    assert_eq!(source.notes[0].severity, Severity::Warning);
}

#[test]
fn what_cannot_be_read_in_code_is_refused_at_its_place() {
    let refusal = refuse(b"// \xE7\x92\xB0\xE5\xA2\x83\nvoid m\xFFain() {}\n");
    assert_eq!(places(&refusal.diagnostics), [(2, 7, 1)]);
    assert!(refusal.diagnostics[0].message.en.contains("cannot be read"));
}

#[test]
fn the_backslash_inside_a_shift_jis_character_is_told() {
    // 表 is 95 5C in Shift_JIS, and 5C is the backslash.
    let bytes = SHIFT_JIS.encode(&shader("光源の色の表", "", "")).0.into_owned();
    let notes = accept(bytes).notes;
    // "#version 410 core // 光源の色の" are 26 characters.
    assert_eq!(places(&notes), [(1, 27, 1)]);
    assert_eq!(accept(shader("光源の色の表", "", "")).notes, []);
    assert_eq!(accept(SHIFT_JIS.encode(&shader("光源の表。", "", "")).0).notes, []);
}
