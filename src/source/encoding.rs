//! Bytes → text, in whatever encoding an editor of the last thirty years in Japan would have saved it.
//!
//! A driver sees bytes and skips comments, so a file must never be refused for the encoding of its comments. UTF-8 is
//! taken where it fits exactly; otherwise the readings are weighed against each other by [`plausibility`].

mod plausibility;
#[cfg(test)]
mod tests;

use crate::diagnostic::{Diagnostic, DiagnosticStage, Severity};
use crate::language::Text;
use encoding_rs::{EUC_JP, ISO_2022_JP, SHIFT_JIS, UTF_8, UTF_16BE, UTF_16LE, WINDOWS_1252};
use serde::{Deserialize, Serialize};

/// How the characters of a file are written as bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Encoding {
    /// UTF-8, plain ASCII included.
    #[serde(rename = "utf-8")]
    Utf8,
    /// Shift_JIS with Microsoft's extensions (code page 932).
    #[serde(rename = "shift_jis")]
    ShiftJis,
    /// EUC-JP.
    EucJp,
    /// ISO-2022-JP ("JIS"), seven bits with escape sequences.
    #[serde(rename = "iso-2022-jp")]
    Iso2022Jp,
    /// UTF-16, low byte first.
    #[serde(rename = "utf-16le")]
    Utf16Le,
    /// UTF-16, high byte first.
    #[serde(rename = "utf-16be")]
    Utf16Be,
    /// Windows-1252, which holds ISO-8859-1: western European.
    #[serde(rename = "windows-1252")]
    Windows1252,
}

impl Encoding {
    /// Its registered name in lower case, such as `shift_jis`.
    pub fn label(self) -> &'static str {
        match self {
            Self::Utf8 => "utf-8",
            Self::ShiftJis => "shift_jis",
            Self::EucJp => "euc-jp",
            Self::Iso2022Jp => "iso-2022-jp",
            Self::Utf16Le => "utf-16le",
            Self::Utf16Be => "utf-16be",
            Self::Windows1252 => "windows-1252",
        }
    }

    /// Whether its characters are pairs of bytes.
    pub(super) fn is_utf16(self) -> bool {
        matches!(self, Self::Utf16Le | Self::Utf16Be)
    }

    fn codec(self) -> &'static encoding_rs::Encoding {
        match self {
            Self::Utf8 => UTF_8,
            Self::ShiftJis => SHIFT_JIS,
            Self::EucJp => EUC_JP,
            Self::Iso2022Jp => ISO_2022_JP,
            Self::Utf16Le => UTF_16LE,
            Self::Utf16Be => UTF_16BE,
            Self::Windows1252 => WINDOWS_1252,
        }
    }

    /// The text of `bytes`, U+FFFD where they mean nothing.
    fn read(self, bytes: &[u8]) -> String {
        self.codec().decode_without_bom_handling(bytes).0.into_owned()
    }
}

/// The result of [`decode`].
pub(super) struct Decoded {
    /// The text, with the line ends of the file and without its byte-order mark.
    pub text: String,
    /// What it was read as.
    pub encoding: Encoding,
    /// What there is to say about it.
    pub notes: Vec<Diagnostic>,
}

/// Reads any bytes as text.
pub(super) fn decode(bytes: &[u8]) -> Decoded {
    let marked = match bytes {
        [0xEF, 0xBB, 0xBF, rest @ ..] => Some((detect(rest), rest, utf8_mark())),
        [0xFF, 0xFE, rest @ ..] => Some((Encoding::Utf16Le, rest, utf16())),
        [0xFE, 0xFF, rest @ ..] => Some((Encoding::Utf16Be, rest, utf16())),
        _ => None,
    };
    if let Some((encoding, rest, note)) = marked {
        return Decoded { text: encoding.read(rest), encoding, notes: vec![note] };
    }
    let encoding = detect(bytes);
    let notes = if encoding == Encoding::Windows1252 { vec![western()] } else { Vec::new() };
    Decoded { text: encoding.read(bytes), encoding, notes }
}

/// The most plausible encoding of bytes without a mark.
fn detect(bytes: &[u8]) -> Encoding {
    if bytes.is_ascii() && has_jis_escape(bytes) && !ISO_2022_JP.decode_without_bom_handling(bytes).1 {
        return Encoding::Iso2022Jp;
    }
    match std::str::from_utf8(bytes) {
        Ok(text) if plausibility::is_utf8_by_chance(text) => Encoding::EucJp,
        Ok(_) => Encoding::Utf8,
        Err(_) => plausibility::best(bytes),
    }
}

/// Whether there is an escape sequence that opens JIS X 0208, the one thing every ISO-2022-JP text has.
fn has_jis_escape(bytes: &[u8]) -> bool {
    bytes.windows(3).any(|three| matches!(three, [0x1B, b'$', b'B' | b'@']))
}

fn utf8_mark() -> Diagnostic {
    Diagnostic::warning(
        DiagnosticStage::Source,
        Text::new(
            "The file begins with a byte-order mark (U+FEFF). It is left out here, but some OpenGL drivers, Mesa 22.3 \
             among them, refuse a shader that begins with one.",
            "ファイルの先頭に BOM（U+FEFF）があります。採点では取り除きますが、Mesa 22.3 のように、BOM \
             で始まるシェーダをコンパイルエラーにする OpenGL ドライバもあります。",
        ),
    )
    .hint(Text::new(
        "Save the file as UTF-8 without a byte-order mark.",
        "「UTF-8（BOM なし）」で保存しておくと安心です。",
    ))
}

fn utf16() -> Diagnostic {
    Diagnostic::warning(
        DiagnosticStage::Source,
        Text::new(
            "The file is written in UTF-16. It is read here, but an OpenGL driver cannot compile it as it is.",
            "ファイルが UTF-16 で書かれています。採点では読み取りますが、OpenGL ドライバはこのままではコンパイルできません。",
        ),
    )
    .hint(Text::new("Save the file as UTF-8.", "UTF-8 で保存し直してください。"))
}

fn western() -> Diagnostic {
    let message = Text::new(
        "The file is neither UTF-8 nor a Japanese encoding; it is read as Windows-1252 (western European).",
        "ファイルが UTF-8 でも日本語の文字コードでもないため、Windows-1252（西欧）として読み取りました。",
    );
    Diagnostic { severity: Severity::Note, ..Diagnostic::warning(DiagnosticStage::Source, message) }
}
