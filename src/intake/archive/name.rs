//! Names of members: in which encoding they are, and which of them are safe.

use crate::language::Text;
use encoding_rs::{SHIFT_JIS, WINDOWS_1252};
use unicode_normalization::UnicodeNormalization;

/// A name whose encoding the archive does not state: UTF-8 as macOS and Linux write it, else Shift_JIS as Windows does
/// in Japan, else the Latin letters of Windows elsewhere.
pub(super) fn decode(raw: &[u8]) -> String {
    if let Ok(text) = std::str::from_utf8(raw) {
        return composed(text);
    }
    match SHIFT_JIS.decode_without_bom_handling_and_without_replacement(raw) {
        Some(text) => composed(&text),
        None => composed(&WINDOWS_1252.decode_without_bom_handling(raw).0),
    }
}

/// macOS stores が as か with a mark; everybody else as one letter. The same name is to be the same text.
pub(super) fn composed(text: &str) -> String {
    text.nfc().collect()
}

/// The folders and the file of a member's name, or why it is refused. A member is never written to the disk; but a
/// name that tries to leave its folder shows that the archive is not what it seems.
pub(super) fn path(name: &str) -> Result<Vec<String>, Text> {
    let has_drive = name.as_bytes().first().is_some_and(u8::is_ascii_alphabetic) && name[1..].starts_with(':');
    if name.contains('\0') {
        return Err(Text::new("Its name has a NUL character.", "名前に NUL 文字が含まれています。"));
    }
    if name.contains('\\') {
        return Err(Text::new(
            "Its name has a backslash, which some systems take for a folder.",
            "名前にバックスラッシュが含まれています (フォルダの区切りと解釈するシステムがあります)。",
        ));
    }
    if name.starts_with('/') || has_drive {
        return Err(Text::new(
            "Its name is an absolute path, outside the archive.",
            "名前が絶対パスで、アーカイブの外を指しています。",
        ));
    }
    let parts: Vec<String> =
        name.split('/').filter(|part| !part.is_empty() && *part != ".").map(str::to_owned).collect();
    if parts.iter().any(|part| part == "..") {
        return Err(Text::new(
            "Its name leads out of the archive (`..`).",
            "名前の `..` がアーカイブの外を指しています。",
        ));
    }
    if parts.is_empty() {
        return Err(Text::new("It has no name.", "名前がありません。"));
    }
    Ok(parts)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_without_a_stated_encoding_are_read() {
        // 表 is 0x95 0x5C in Shift_JIS: its second byte is a backslash in ASCII.
        assert_eq!(decode(b"\x95\x5c.vert"), "表.vert");
        assert_eq!(decode("山田/課題.vert".as_bytes()), "山田/課題.vert");
        assert_eq!(decode("か\u{3099}.vert".as_bytes()), "が.vert");
        // ü is 0xFC in Windows-1252, and 0xFC 0x2E begins nothing in Shift_JIS.
        assert_eq!(decode(b"\xfc.vert"), "ü.vert");
    }

    #[test]
    fn names_that_lead_elsewhere_are_refused() {
        for name in [
            "../x.vert",
            "a/../../x.vert",
            "..",
            "/etc/passwd",
            "//host/x",
            "C:x",
            "c:/x",
            "a\\b",
            "..\\x",
            "a\0b",
            "",
            "./",
            "/",
        ] {
            assert!(path(name).is_err(), "{name:?}");
        }
    }

    #[test]
    fn ordinary_names_are_taken_apart() {
        assert_eq!(path("./a//b/..c.vert").unwrap(), ["a", "b", "..c.vert"]);
        assert_eq!(path("課題: 6.vert").unwrap(), ["課題: 6.vert"]);
    }
}
