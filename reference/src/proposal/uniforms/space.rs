//! The space in which solutions compute, and the signs that they take.

use crate::interpreter::{Stage, Type};
use crate::proposal::names::{self, NameWords, Space};
use crate::proposal::source::SolutionFile;

/// The space in which the solutions compute.
pub(in crate::proposal) fn usual_space(sources: &[SolutionFile]) -> Space {
    let uniforms = || sources.iter().flat_map(|source| source.program.uniforms());
    if uniforms().any(|uniform| NameWords::of(&uniform.name).is_eye() && matches!(uniform.kind, Type::Vector(_, 3 | 4)))
    {
        return Space::World;
    }
    let matrices = |role: &str| {
        uniforms().any(|uniform| {
            names::matrix(&NameWords::of(&uniform.name), &uniform.kind, Space::Eye)
                .is_some_and(|(_, said)| said == role)
        })
    };
    let is_negated = |source: &SolutionFile| {
        let inputs = source.program.inputs().iter().filter(|input| NameWords::of(&input.name).is_position());
        inputs.filter(|_| source.stage == Stage::Fragment).any(|input| negated(source, &input.name))
    };
    let is_of_eye = matrices("model-view") || sources.iter().any(is_negated);
    // Where model and view come apart and no eye is given, light is usually computed in the world.
    if is_of_eye || (matrices("normal-matrix") && !matrices("model")) { Space::Eye } else { Space::World }
}

/// Whether a file takes the negative of a variable or member.
pub(super) fn negated(source: &SolutionFile, path: &str) -> bool {
    let last = path.rsplit('.').next().unwrap_or(path);
    let words = source.words();
    let is_value = |word: &str| word.ends_with(|c: char| c.is_ascii_alphanumeric() || matches!(c, ')' | ']' | '_'));
    (2..words.len()).any(|at| {
        // Back over `lights[i].` to what stands before the whole of it.
        let mut first = at;
        while first >= 2 && words[first - 1].text == "." {
            first -= 2;
            if words[first].text == "]" {
                first =
                    words[..first].iter().rposition(|word| word.text == "[").map_or(0, |open| open.saturating_sub(1));
            }
        }
        words[at].text == last
            && first >= 2
            && words[first - 1].text == "-"
            && (!is_value(&words[first - 2].text) || words[first - 2].text == "return")
    })
}
