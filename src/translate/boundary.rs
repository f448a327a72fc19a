//! What the vertex stage hands over and the fragment stage takes: by name and type, or by location where both give one.
//!
//! A driver says of it what it likes, without a line, and takes a fragment stage that reads what nobody writes.

use super::entry::StageVariable;
use super::interface::place;
use super::module::Shader;
use super::{TranslationRefusal, spirv::InputInterpolation};
use crate::diagnostic::{Diagnostic, DiagnosticStage};
use crate::language::Text;
use crate::source::Source;

/// From this version on the fragment stage's qualifiers count, and the vertex stage's do not matter.
const FREE_INTERPOLATION: i32 = 440;

/// So many numbers go from stage to stage on drivers, Mesa's among them.
const MOST_COMPONENTS: usize = 128;

/// Holds the inputs of the fragment stage against the outputs of the vertex stage, at GLSL version `version`.
pub(super) fn check(
    vertex: &Shader,
    fragment: &Shader,
    source: &Source,
    version: i32,
) -> Result<(), TranslationRefusal> {
    let mut errors: Vec<Diagnostic> =
        fragment.inputs.iter().filter_map(|input| error(input, &vertex.outputs, source, version)).collect();
    errors.extend(too_many(fragment, source));
    // Columns and elements of one variable stand in one place, and are wrong together.
    errors.dedup_by_key(|error| (error.line, error.column));
    if errors.is_empty() { Ok(()) } else { Err(TranslationRefusal::Rejected(errors)) }
}

/// More than drivers hand over.
fn too_many(fragment: &Shader, source: &Source) -> Option<Diagnostic> {
    let mut components = 0;
    let first = fragment.inputs.iter().find(|input| {
        components += usize::from(input.size) * usize::from(input.width) / 4;
        components > MOST_COMPONENTS
    })?;
    let message = Text::new(
        format!("More than {MOST_COMPONENTS} numbers go to the fragment shader; drivers refuse to link that."),
        format!("フラグメントシェーダに渡る値が {MOST_COMPONENTS} 個を超えています。ドライバはリンクを拒否します。"),
    );
    Some(place(Diagnostic::error(DiagnosticStage::Link, message), source, &first.name))
}

fn error(input: &StageVariable, outputs: &[StageVariable], source: &Source, version: i32) -> Option<Diagnostic> {
    let name = &input.name;
    let at = |message| Some(place(Diagnostic::error(DiagnosticStage::Link, message), source, name));
    let Some(output) = outputs.iter().find(|output| output.name == *name) else {
        let diagnostic = at(Text::new(
            format!("The fragment shader reads `{name}`, and the vertex shader has no output of this name."),
            format!("フラグメントシェーダが `{name}` を読みますが、頂点シェーダにこの名前の出力変数がありません。"),
        ))?;
        let written: Vec<_> = outputs.iter().map(|output| format!("`{} {}`", output.ty, output.name)).collect();
        return Some(if written.is_empty() {
            diagnostic
        } else {
            diagnostic.hint(Text::new(
                format!("The vertex shader writes {}.", written.join(", ")),
                format!("頂点シェーダが出力するのは {} です。", written.join("、")),
            ))
        });
    };
    if (output.kind, output.width, output.size) != (input.kind, input.width, input.size) {
        return at(Text::new(
            format!("`{name}` has type {} here, but the vertex shader writes {}.", input.ty, output.ty),
            format!("`{name}` はここでは {} 型ですが、頂点シェーダが出力するのは {} 型です。", input.ty, output.ty),
        ));
    }
    // `centroid` on one side alone is linked, by Mesa at least.
    let of = |attribute: &StageVariable| (attribute.qualifiers.interpolation, attribute.qualifiers.sample);
    let differs = version < FREE_INTERPOLATION && of(output) != of(input);
    let word = |attribute: &StageVariable| match of(attribute) {
        (InputInterpolation::Smooth, true) => "sample",
        (InputInterpolation::NoPerspective, true) => "noperspective sample",
        (InputInterpolation::Flat, true) => "flat sample",
        (InputInterpolation::Smooth, false) => "smooth",
        (InputInterpolation::NoPerspective, false) => "noperspective",
        (InputInterpolation::Flat, false) => "flat",
    };
    differs.then(|| {
        at(Text::new(
            format!(
                "`{name}` is `{}` here and `{}` in the vertex shader; before GLSL 4.40 drivers refuse to link the two.",
                word(input),
                word(output)
            ),
            format!(
                "`{name}` はここでは `{}`、頂点シェーダでは `{}` です。GLSL 4.40 より前ではドライバがリンクを拒否します。",
                word(input),
                word(output)
            ),
        ))
    })?
}
