use super::*;

/// Words of a lighting homework, alone in a file but for ASCII.
const WORDS: [&str; 20] = [
    "色",
    "光",
    "法線",
    "頂点",
    "視線",
    "位置",
    "中間ベクトル",
    "環境光",
    "拡散反射光",
    "鏡面反射光",
    "輝き係数",
    "光源の位置",
    "ここを書く",
    "課題",
    "提出",
    "正規化する",
    "座標変換",
    "表",
    "ソ",
    "陰影付け",
];

fn shader(comment: &str) -> String {
    format!("#version 410 core // {comment}\nin vec4 pv;\nvoid main() {{ gl_Position = pv; }}\n")
}

#[test]
fn one_short_japanese_comment_decides() {
    for encoding in [Encoding::ShiftJis, Encoding::EucJp, Encoding::Iso2022Jp] {
        for word in WORDS {
            let text = shader(word);
            let (bytes, _, lossy) = encoding.codec().encode(&text);
            assert!(!lossy);
            let decoded = decode(&bytes);
            assert_eq!((decoded.encoding, decoded.text), (encoding, text), "{word}");
            assert!(decoded.notes.is_empty());
        }
    }
}

#[test]
fn half_width_katakana_is_shift_jis() {
    for word in ["ｶﾗｰ", "ﾗｲﾄ", "ﾍﾞｸﾄﾙ", "ｼｪｰﾀﾞ", "ｺﾒﾝﾄ", "ﾃﾞｰﾀ", "ｶﾗｰ ﾃﾞｰﾀ ﾌﾟﾛｸﾞﾗﾑ"]
    {
        let text = shader(word);
        let decoded = decode(&SHIFT_JIS.encode(&text).0);
        assert_eq!((decoded.encoding, decoded.text), (Encoding::ShiftJis, text), "{word}");
    }
}

#[test]
fn western_comments_are_read_with_a_note() {
    for word in ["café", "événement", "créée", "größe", "für", "ação", "déjà vu", "x² + y²", "45°", "© 2025"]
    {
        let text = shader(word);
        let decoded = decode(&WINDOWS_1252.encode(&text).0);
        assert_eq!((decoded.encoding, decoded.text), (Encoding::Windows1252, text), "{word}");
        assert_eq!(decoded.notes[0].severity, Severity::Note);
    }
}

#[test]
fn letters_of_europe_in_utf8_stay_utf8() {
    for word in ["α", "π/2", "ñ", "Tōkyō", "×", "表", "法線", "Å ŋ"] {
        let text = shader(word);
        let decoded = decode(text.as_bytes());
        assert_eq!((decoded.encoding, decoded.text), (Encoding::Utf8, text), "{word}");
    }
}

#[test]
fn utf8_with_one_stray_byte_stays_utf8() {
    let mut bytes = shader("環境光と拡散反射光").into_bytes();
    bytes.extend(b"// \xE9\n");
    let decoded = decode(&bytes);
    assert_eq!(decoded.encoding, Encoding::Utf8);
    assert!(decoded.text.contains("環境光と拡散反射光") && decoded.text.ends_with("// \u{FFFD}\n"));
}

#[test]
fn a_character_cut_off_at_the_end_does_not_change_the_encoding() {
    let bytes = SHIFT_JIS.encode("x // 環境光").0.into_owned();
    let decoded = decode(&bytes[..bytes.len() - 1]);
    assert_eq!((decoded.encoding, decoded.text.as_str()), (Encoding::ShiftJis, "x // 環境\u{FFFD}"));
}

#[test]
fn a_mark_is_removed_and_named() {
    let decoded = decode("\u{FEFF}x // 光".as_bytes());
    assert_eq!((decoded.encoding, decoded.text.as_str()), (Encoding::Utf8, "x // 光"));
    assert_eq!(decoded.notes[0].severity, Severity::Warning);
    let mut bytes = vec![0xEF, 0xBB, 0xBF];
    bytes.extend_from_slice(&SHIFT_JIS.encode("x // 拡散反射光").0);
    let decoded = decode(&bytes);
    assert_eq!((decoded.encoding, decoded.text.as_str()), (Encoding::ShiftJis, "x // 拡散反射光"));
}

#[test]
fn utf16_is_read_in_both_orders() {
    let little: Vec<u8> = "\u{FEFF}x 光😀".encode_utf16().flat_map(u16::to_le_bytes).collect();
    let big: Vec<u8> = "\u{FEFF}x 光😀".encode_utf16().flat_map(u16::to_be_bytes).collect();
    for (bytes, encoding) in [(little, Encoding::Utf16Le), (big, Encoding::Utf16Be)] {
        let decoded = decode(&bytes);
        assert_eq!((decoded.encoding, decoded.text.as_str()), (encoding, "x 光😀"));
    }
}

#[test]
fn broken_utf16_keeps_its_place() {
    // A lone high surrogate (D83D), then "a"; and an odd byte at the end.
    assert_eq!(decode(b"\xFF\xFE\x3D\xD8a\0").text, "\u{FFFD}a");
    assert_eq!(decode(b"\xFF\xFEa\0b").text, "a\u{FFFD}");
}

#[test]
fn the_label_is_what_the_report_says() {
    for encoding in [Encoding::Utf8, Encoding::ShiftJis, Encoding::EucJp, Encoding::Utf16Le] {
        // The WHATWG names of encoding_rs, in lower case.
        assert_eq!(encoding.label(), encoding.codec().name().to_lowercase());
    }
}
