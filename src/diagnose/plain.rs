//! Of explanations that come to the same, the one that the text bears out.
//!
//! A factor of 3.5 equals `kspec + lspec` in place of their product. Only the text tells which of the two it is.

use crate::source::{Source, words};
use reference::Assignment;
use reference::fit::{Fit, explain_by};
use reference::interpreter::Stage;
use reference::mistake::{FoundMistake, Mistake};
use reference::probes::ProbeSet;
use std::ops::RangeInclusive;

/// The explanation of the samples by so many mistakes; where the text refutes a part of it, another one that needs no more mistakes, if
/// there is one.
pub fn explained(
    counts: RangeInclusive<usize>,
    assignment: &Assignment,
    sources: &[(Stage, &Source)],
    probes: &ProbeSet,
    samples: &[[f64; 3]],
    tolerance: f64,
) -> Fit {
    let fit = explain_by(counts.clone(), assignment, probes, samples, tolerance);
    let Fit::Explained(found) = &fit else { return fit };
    let Some(rest) = without_refuted(assignment, sources, found) else { return fit };
    match explain_by(counts, &rest, probes, samples, tolerance) {
        Fit::Explained(other) if other.len() <= found.len() => Fit::Explained(other),
        _ => fit,
    }
}

/// Whether the text has what each of these mistakes needs.
pub fn is_borne_out(assignment: &Assignment, sources: &[(Stage, &Source)], found: &[FoundMistake]) -> bool {
    let squeezed = squeezed(&statements(sources));
    let needed = found.iter().filter_map(|found| Some(&assignment.mistake(&found.id)?.needs));
    needed.filter(|needs| !needs.is_empty()).all(|needs| needs.iter().any(|part| squeezed.contains(part)))
}

/// The assignment without the found mistakes that the text refutes, if there are any.
fn without_refuted(
    assignment: &Assignment,
    sources: &[(Stage, &Source)],
    found: &[FoundMistake],
) -> Option<Assignment> {
    let statements = statements(sources);
    let is_refuted = |mistake: &Mistake| {
        let is_found = found.iter().any(|found| found.id == mistake.id && found.parameter.is_none());
        let squeezed = squeezed(&statements);
        let misses = !mistake.needs.is_empty() && !mistake.needs.iter().any(|part| squeezed.contains(part));
        is_found && (misses || mistake.lacks.iter().any(|name| words(&statements).any(|(_, word)| word == name)))
    };
    let refuted: Vec<usize> = (0..assignment.mistakes.len()).filter(|i| is_refuted(&assignment.mistakes[*i])).collect();
    (!refuted.is_empty()).then(|| {
        let mut rest = assignment.clone();
        refuted.iter().for_each(|index| rest.mistakes[*index].forms.clear());
        rest
    })
}

/// The code of all files without the declarations of constants.
fn statements(sources: &[(Stage, &Source)]) -> String {
    let lines =
        sources.iter().flat_map(|(_, source)| (1..=source.line_count()).map(move |number| source.code_line(number)));
    let is_constant = |line: &&str| {
        let line = line.trim_start();
        line.starts_with("const ") || line.starts_with('#')
    };
    lines.filter(|line| !is_constant(line)).collect::<Vec<_>>().join("\n")
}

/// The text without spaces, parentheses, constructors of vectors and swizzles.
fn squeezed(text: &str) -> String {
    let mut squeezed: String = text.chars().filter(|c| !c.is_whitespace() && !"()".contains(*c)).collect();
    for part in [".rgba", ".xyzw", ".rgb", ".xyz", "vec3", "vec4"] {
        squeezed = squeezed.replace(part, "");
    }
    squeezed
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source;

    fn refuted(statement: &str, id: &str) -> bool {
        let code =
            format!("const vec4 kspec = vec4(0.4);\nconst vec4 lspec = vec4(1);\nvoid main() {{\n  {statement}\n}}\n");
        let source = source::read("a.vert", code.as_bytes()).expect("a vertex shader");
        let found = [FoundMistake { id: id.into(), form: 0, parameter: None }];
        without_refuted(reference::assignment("ggsample06").unwrap(), &[(Stage::Vertex, &source)], &found).is_some()
    }

    #[test]
    fn a_sum_of_constants_is_one_only_where_it_is_written() {
        assert!(!refuted("gl_Position = s * (lspec.rgb + kspec.rgb);", "specular-added"));
        assert!(!refuted("gl_Position = s * (vec3(kspec) + vec3(lspec));", "specular-added"));
        assert!(refuted("gl_Position = 3.5 * s * kspec * lspec;", "specular-added"));
    }

    #[test]
    fn another_light_is_used_only_where_the_right_one_is_not() {
        assert!(!refuted("gl_Position = s * kspec * lamb;", "specular-uses-ambient-light"));
        assert!(refuted("gl_Position = 0.2 * s * kspec * lspec;", "specular-uses-ambient-light"));
        assert!(!refuted("gl_Position = 0.2 * s * kspec * lspec;", "specular-no-exponent"));
    }
}
