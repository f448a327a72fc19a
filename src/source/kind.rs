//! What a file is that is no vertex shader. A wrong refusal is worse than a compiler's puzzled message, so only what
//! cannot be a vertex shader is refused, and only code outside comments is looked at.

mod binary;
mod prose;

pub(super) use binary::{binary, no_sense};
pub use prose::fragment_shader;
pub(super) use prose::wrong_text;

use crate::diagnostic::{Diagnostic, Stage};
use crate::language::Text;

/// The refusal of a file that seems to be `en`, `ja`.
fn looks_like(en: &str, ja: &str) -> Diagnostic {
    Diagnostic::error(
        Stage::Source,
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
