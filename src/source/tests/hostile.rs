//! Input at the limits, and input from someone who tries.

use super::*;
use nix::sys::resource::{UsageWho, getrusage};

/// Code that makes up `bytes` bytes with white space.
fn of_size(bytes: usize) -> Vec<u8> {
    let mut text = b"void main() { gl_Position = vec4(0); }".to_vec();
    text.resize(bytes, b' ');
    text
}

#[test]
fn the_limit_is_sixty_four_kibibytes() {
    assert_eq!(accept(of_size(65_536)).facts.bytes, 65_536);
    let refusal = refuse(of_size(65_537));
    assert!(refusal.diagnostics[0].message.en.contains("at most 64 KiB"));
    assert_eq!((refusal.facts.bytes, refusal.source), (65_537, None));
}

#[test]
fn ten_thousand_combining_marks_are_one_place() {
    let marks = "\u{301}".repeat(10_000);
    let refusal = refuse(shader("", "", &format!("a{marks} = b;")));
    assert_eq!(places(&refusal.diagnostics), [(6, 4, 10_000)]);
    assert!(refusal.diagnostics[0].message.en.chars().count() < 400);
    accept(shader(&marks, "", ""));
}

#[test]
fn no_bytes_panic_and_no_place_is_outside_the_text() {
    // A linear congruential generator (Knuth's MMIX constants) is random enough here, and repeats.
    let mut state = 1_u64;
    let mut next = move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize
    };
    let pieces: [&[u8]; 24] = [
        b"/",
        b"*",
        b"\\",
        b"\n",
        b"\r",
        b"\r\n",
        b"#if 0",
        b"#endif",
        b"#else",
        b"#define X ",
        b"X",
        b"\x1B$B",
        b"\x1B(B",
        b"\x93\xFA",
        b"\xC6\xFC",
        b"\xE6\x97\xA5",
        b"\xE3\x80\x80",
        b"\xFF",
        b"\xFF\xFE",
        b"\xEF\xBB\xBF",
        b"\x8E\xB1",
        b" ",
        b"\xD8",
        b"gl_Position",
    ];
    for _ in 0..3000 {
        let bytes: Vec<u8> = (0..next() % 40).flat_map(|_| pieces[next() % pieces.len()]).copied().collect();
        let (source, diagnostics) = match read("a.vert", &bytes) {
            Ok(source) => (Some(source.clone()), source.notes),
            Err(refusal) => {
                assert_eq!(refusal.diagnostics[0].severity, Severity::Error, "{bytes:?}");
                (refusal.source, refusal.diagnostics)
            }
        };
        let Some(source) = source else { continue };
        assert_eq!(source.code().len(), source.text.len(), "{bytes:?}");
        for diagnostic in diagnostics {
            let Some(line) = diagnostic.line else {
                continue;
            };
            let column = diagnostic.column.unwrap_or(1) + diagnostic.length - 1;
            assert!(source.offset(line, column).is_some(), "{bytes:?}: {diagnostic:?}");
        }
    }
}

#[test]
fn broken_utf16_is_refused_where_it_stands() {
    // A lone low surrogate (DC00) as the second character of the second line.
    let mut bytes: Vec<u8> = "\u{FEFF}void main() {}\na".encode_utf16().flat_map(u16::to_le_bytes).collect();
    bytes.extend_from_slice(&[0x00, 0xDC]);
    assert_eq!(places(&refuse(&bytes).diagnostics)[0], (2, 2, 1));
}

#[test]
fn an_odd_byte_ends_utf16_in_a_comment_without_harm() {
    let mut bytes: Vec<u8> = "\u{FEFF}void main() {} // a".encode_utf16().flat_map(u16::to_le_bytes).collect();
    bytes.push(b'b');
    assert_eq!(accept(bytes).code_line(1).trim_end(), "void main() {}");
}

#[test]
fn a_nul_is_refused_in_any_disguise() {
    for bytes in [&b"void main() {}\0"[..], b"// a\0b\nvoid main() {}", b"\0", b"\xFF\xFEa\0\0\0"] {
        assert_eq!(refuse(bytes).diagnostics[0].severity, Severity::Error, "{bytes:?}");
    }
}

// Reading is linear: the worst file of the largest size takes some milliseconds; a quadratic pass takes seconds.
#[test]
fn the_largest_files_are_read_in_no_time() {
    let begin = processor_time();
    for piece in [
        "；",
        "；a ",
        "\n",
        "/*光*/",
        "#define A ；\n",
        "#if 0\n",
        "\\\n",
        "/\\\n",
        "\u{202E}//\n",
        "//\u{202E}",
        "é ",
        "a\u{301}",
    ] {
        let text = format!("x\n{}", piece.repeat((MAX_BYTES - 2) / piece.len()));
        // Whatever comes of it, it comes soon.
        drop(read("a.vert", text.as_bytes()));
        drop(read("a.vert", &[text.as_bytes(), b"\xFF"].concat()[..MAX_BYTES.min(text.len() + 1)]));
    }
    let spent = processor_time() - begin;
    assert!(spent < 5, "{spent} s of processor time");
}

/// Seconds of processor time that this thread has had: what else the machine does is not in it.
fn processor_time() -> i64 {
    let usage = getrusage(UsageWho::RUSAGE_THREAD).unwrap();
    usage.user_time().tv_sec() + usage.system_time().tv_sec()
}
