//! Files that are no text, told by their first bytes.

use super::looks_like;
use crate::diagnostic::{Diagnostic, DiagnosticStage};
use crate::language::Text;
use crate::source::Encoding;

/// First bytes that the crate `infer` does not know, with what they mean in English and Japanese.
const SIGNATURES: [(&[u8], &str, &str); 9] = [
    (b"%PDF-", "a PDF document", "PDF 文書"),
    (b"{\\rtf", "a Rich Text (RTF) document", "リッチテキスト（RTF）文書"),
    (b"\x03\x02\x23\x07", "a compiled shader (SPIR-V)", "コンパイル済みのシェーダ（SPIR-V）"),
    (b"\x07\x23\x02\x03", "a compiled shader (SPIR-V)", "コンパイル済みのシェーダ（SPIR-V）"),
    (b"\x00\x05\x16\x07", "a “._” file that macOS adds to archives", "macOS が作る「._」で始まる付属ファイル"),
    (b"\x00\x00\x00\x01Bud1", "a .DS_Store file of macOS", "macOS の .DS_Store ファイル"),
    (b"L\0\0\0\x01\x14\x02\0", "a Windows shortcut", "Windows のショートカット"),
    (b"bplist00", "a property list of macOS", "macOS のプロパティリスト"),
    (b"\xFF\xFE\0\0", "text in UTF-32", "UTF-32 のテキスト"),
];

/// Why `bytes` are no text, where they are not.
pub(in crate::source) fn binary(bytes: &[u8]) -> Option<Diagnostic> {
    if let Some((_, en, ja)) = SIGNATURES.iter().find(|(signature, ..)| bytes.starts_with(signature)) {
        return Some(looks_like(en, ja));
    }
    if bytes.starts_with(b"\xFF\xFE") || bytes.starts_with(b"\xFE\xFF") {
        return None;
    }
    // Text is full of pairs of letters that open some binary format, so the guess needs a byte that text never has.
    let nul = bytes.iter().position(|&byte| byte == 0)?;
    if let Some((en, ja)) = infer::get(bytes).map(describe) {
        return Some(looks_like(&en, &ja));
    }
    if is_utf16(bytes) {
        return Some(utf16_without_mark());
    }
    Some(with_nul(bytes, nul))
}

/// The refusal of text that makes no sense: a binary format that nobody knows, without a NUL, or with the byte-order
/// mark of UTF-16 by chance.
pub(in crate::source) fn no_sense(text: &str, encoding: Encoding) -> Option<Diagnostic> {
    if let Some(at) = text.find('\0') {
        return Some(with_nul(text.as_bytes(), at));
    }
    let is_private = |c: char| matches!(c, '\u{E000}'..='\u{F8FF}' | '\u{F0000}'..);
    let is_strange = |c: char| match c {
        '\t' | '\n' | '\r' | '\u{B}' | '\u{C}' => false,
        char::REPLACEMENT_CHARACTER => encoding.is_utf16(),
        c => c.is_control() || is_private(c),
    };
    let (all, strange) = (text.chars().count(), text.chars().filter(|&c| is_strange(c)).count());
    // A stray escape or end-of-file character is told at its place; one in sixteen is no text.
    if strange > 8 && strange * 16 > all {
        return Some(looks_like("binary data", "バイナリファイル"));
    }
    // Code is ASCII, and so are the line ends of any text; read with the wrong byte first, there is none of it.
    let ascii = text.chars().filter(char::is_ascii).count();
    (encoding.is_utf16() && all > 16 && ascii * 64 < all).then(utf16_without_sense)
}

/// The kind that `infer` found, in words.
fn describe(kind: infer::Type) -> (String, String) {
    let by_extension = match kind.extension() {
        "docx" | "doc" | "odt" => Some(("a word processor's document", "ワープロの文書（Word など）")),
        "zip" => Some(("a ZIP archive", "ZIP ファイル")),
        "exe" | "dll" | "elf" | "mach" | "obj" => Some(("a compiled program", "実行ファイル")),
        _ => None,
    };
    if let Some((en, ja)) = by_extension {
        return (en.to_owned(), ja.to_owned());
    }
    let format = kind.extension().to_uppercase();
    let (en, ja) = match kind.matcher_type() {
        infer::MatcherType::Image => ("picture", "画像"),
        infer::MatcherType::Video => ("film", "動画ファイル"),
        infer::MatcherType::Audio => ("sound file", "音声ファイル"),
        infer::MatcherType::Archive => ("archive", "圧縮ファイル"),
        infer::MatcherType::Doc | infer::MatcherType::Book => ("document", "文書ファイル"),
        _ => ("binary file", "バイナリファイル"),
    };
    (format!("a {en} ({format})"), format!("{ja}（{format}）"))
}

/// Whether at least half of the characters are ASCII in UTF-16: a NUL in every second byte, always on the same side.
fn is_utf16(bytes: &[u8]) -> bool {
    let nuls = |side: usize| bytes.iter().skip(side).step_by(2).filter(|&&byte| byte == 0).count();
    let (even, odd) = (nuls(0), nuls(1));
    even.min(odd) == 0 && even.max(odd) * 4 >= bytes.len()
}

fn utf16_without_mark() -> Diagnostic {
    Diagnostic::error(
        DiagnosticStage::Source,
        Text::new(
            "The file seems to be text in UTF-16 without a byte-order mark. OpenGL drivers cannot compile that.",
            "BOM のない UTF-16 で書かれたテキストのようです。OpenGL ドライバではコンパイルできません。",
        ),
    )
    .hint(Text::new("Save the file as UTF-8.", "UTF-8 で保存し直してください。"))
}

fn utf16_without_sense() -> Diagnostic {
    Diagnostic::error(
        DiagnosticStage::Source,
        Text::new(
            "The file begins with the byte-order mark of UTF-16, and read as UTF-16 it makes no sense: it is damaged, or \
             no text.",
            "ファイルの先頭に UTF-16 の BOM がありますが、UTF-16 として読むと意味をなしません。壊れているか、テキストではありません。",
        ),
    )
    .hint(open_and_save())
}

fn open_and_save() -> Text {
    Text::new(
        "Open it in a text editor, check that it is your shader, and save it as UTF-8.",
        "テキストエディタで開いてシェーダのソースであることを確かめ、UTF-8 で保存し直してください。",
    )
}

fn with_nul(bytes: &[u8], at: usize) -> Diagnostic {
    let line = 1 + bytes[..at].iter().filter(|&&byte| byte == b'\n').count();
    Diagnostic::error(
        DiagnosticStage::Source,
        Text::new(
            format!("Line {line} holds a NUL byte (00). Text never does: the file is binary or damaged."),
            format!("{line} 行目に NUL バイト（00）があります。バイナリファイルか、壊れたファイルのようです。"),
        ),
    )
    .hint(open_and_save())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn english(bytes: &[u8]) -> Option<String> {
        binary(bytes).map(|refusal| refusal.message.en)
    }

    #[test]
    fn common_files_are_told_by_name() {
        let png = b"\x89PNG\r\n\x1A\n\0\0\0\x0DIHDR\0\0\0\x01";
        let jpeg = b"\xFF\xD8\xFF\xE0\0\x10JFIF\0\x01";
        let gif = b"GIF89a\x01\0\x01\0\x80\0\0";
        let zip = b"PK\x03\x04\x14\0\0\0\x08\0";
        let elf = b"\x7FELF\x02\x01\x01\0\0\0\0\0\0\0\0\0\x03\0\x3E\0\x01\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0";
        let gzip = b"\x1F\x8B\x08\0\0\0\0\0\0\x03";
        for (bytes, word) in [
            (&png[..], "a picture (PNG)"),
            (jpeg, "a picture (JPG)"),
            (gif, "a picture (GIF)"),
            (zip, "a ZIP archive"),
            (elf, "a compiled program"),
            (gzip, "an archive"),
            (b"%PDF-1.7\n", "a PDF document"),
            (b"{\\rtf1\\ansi", "a Rich Text"),
            (b"\x03\x02\x23\x07\0\0\x01\0", "SPIR-V"),
            (b"\0\x05\x16\x07\0\x02\0\0", "macOS"),
            (b"\xFF\xFE\0\0v\0\0\0", "UTF-32"),
        ] {
            let message = english(bytes).unwrap_or_default();
            assert!(message.contains(&word.replace("an archive", "archive (GZ)")), "{word}: {message}");
        }
    }

    #[test]
    fn utf16_without_a_mark_is_told_as_such() {
        let bytes: Vec<u8> = "void main() {}\n".encode_utf16().flat_map(u16::to_le_bytes).collect();
        assert!(english(&bytes).is_some_and(|message| message.contains("UTF-16")));
    }

    #[test]
    fn a_nul_in_text_is_told_with_its_line() {
        assert!(english(b"a\nb\0\n").is_some_and(|message| message.starts_with("Line 2 ")));
        assert!(no_sense("a\0", Encoding::Utf8).is_some());
    }

    #[test]
    fn text_that_opens_like_a_binary_format_is_text() {
        for text in ["BM", "MZ = 1;", "ID3", "GIF89a", "II*", "PK", "Rar!", "OTTO", "#version 410 core"] {
            assert_eq!(english(text.as_bytes()), None, "{text}");
        }
    }

    #[test]
    fn noise_is_binary_and_one_escape_is_not() {
        assert!(no_sense(&"\u{1}\u{2}a".repeat(20), Encoding::Utf8).is_some());
        assert!(no_sense("void main() {}\u{1A}", Encoding::Utf8).is_none());
    }

    #[test]
    fn utf16_has_to_make_sense() {
        let read = |text: &str| no_sense(text, Encoding::Utf16Le);
        let shader =
            "#version 410 core\n// 次の行を, 陰影付けの式で頂点の色を求めるように書き換えてください.\nvoid main() {}\n";
        assert_eq!(read(shader), None);
        // Every pair of bytes in the wrong order.
        let swapped: Vec<u16> = shader.encode_utf16().map(u16::swap_bytes).collect();
        assert!(read(&String::from_utf16_lossy(&swapped)).is_some());
        // Noise: the squares of odd numbers modulo 65,521, a prime, scatter over all code units.
        let noise: Vec<u16> =
            (0..2000_u64).map(|i| u16::try_from((2 * i + 12_345).pow(2) % 65_521).unwrap_or(1)).collect();
        let noise: Vec<u16> = noise.into_iter().filter(|&unit| unit != 0).collect();
        assert!(read(&String::from_utf16_lossy(&noise)).is_some());
        // Characters of one's own (gaiji) in a comment are no reason.
        assert_eq!(no_sense("// \u{E000}\u{E001}\nvoid main() {}\n", Encoding::ShiftJis), None);
    }
}
