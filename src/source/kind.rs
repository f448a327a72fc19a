//! Recognises files that cannot be a shader of the stage that is asked for. A wrong refusal is worse than a compiler's puzzled
//! message, so only what cannot be one is refused, and only code outside comments is looked at.

mod binary;
mod prose;

pub(super) use binary::{binary, no_sense};
pub use prose::fragment_shader;
pub(super) use prose::wrong_text;

use crate::diagnostic::{Diagnostic, DiagnosticStage};
use crate::language::Text;

/// The refusal in the words of a homework that asks for a fragment shader.
pub(super) fn of_fragment_shader(mut refusal: Diagnostic) -> Diagnostic {
    let own = |text: Text| {
        let asked = text
            .en
            .replace("not a vertex shader", "not a fragment shader")
            .replace("your vertex shader", "your fragment shader");
        let japanese = |text: String| match text.strip_prefix("頂点シェーダ") {
            Some(rest) => format!("フラグメントシェーダ{rest}"),
            None => text,
        };
        Text::new(
            asked.replace(".vert file", ".frag file"),
            japanese(text.ja).replace(".vert ", ".frag ").replace(" .vert", " .frag"),
        )
    };
    refusal.hint = refusal.hint.map(own);
    Diagnostic { message: own(refusal.message), ..refusal }
}

/// The refusal in the words of a homework that asks for a program in C++.
pub(super) fn of_program(mut refusal: Diagnostic) -> Diagnostic {
    let own = |text: Text| {
        Text::new(
            text.en
                .replace("not a vertex shader", "not a C++ program")
                .replace("your vertex shader", "your program")
                .replace("A vertex shader", "Such a program")
                .replace(".vert file", ".cpp file"),
            text.ja.replace("頂点シェーダ", "C++ プログラム").replace(".vert", ".cpp"),
        )
    };
    refusal.hint = refusal.hint.map(own);
    Diagnostic { message: own(refusal.message), ..refusal }
}

/// The refusal of a file that seems to be `en`, `ja`.
fn looks_like(en: &str, ja: &str) -> Diagnostic {
    Diagnostic::error(
        DiagnosticStage::Source,
        Text::new(
            format!("This is not a vertex shader: the file seems to be {en}."),
            format!("頂点シェーダではありません。{ja}のようです。"),
        ),
    )
    .hint(Text::new(
        "Hand in the source text of your vertex shader: the .vert file itself.",
        "頂点シェーダのソースファイル（拡張子が .vert のファイル）をそのまま提出してください。",
    ))
}
