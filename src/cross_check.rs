//! A second opinion: what the interpreter of `reference` computes for a file, held against what the driver computed.
//!
//! The two share no compiler and no translator. The driver's values are what is judged; where the interpreter has
//! others, a teacher is told. It meets the student's text, and is called in a worker only.

mod compare;
mod program;
mod vertices;

use crate::render::{DrawCall, Sample};
use crate::report::CrossCheck;
pub use compare::{DriverOutput, compare};
pub use program::check_program;
use reference::assignment::Interface;
use reference::interpreter::{Program, Stage};
use reference::pipeline::POSITION;
use vertices::VertexColumns;

/// Runs the file's text on the vertices that the driver had, and compares colours and positions. The uniforms of the draws stand in the
/// order of the interface.
pub fn check(
    text: &str,
    output: &str,
    interface: &Interface,
    batches: &[&DrawCall],
    samples: &[&[Sample]],
) -> CrossCheck {
    let program = match Program::compile(text, Stage::Vertex) {
        Ok(program) => program,
        Err(refusal) => return CrossCheck::not_run(refusal.what().clone(), Some(refusal.line)),
    };
    let vertices = VertexColumns::new(batches);
    let samples = || samples.iter().copied().flatten();
    let colours = samples().map(|sample| sample.colour).collect();
    let positions = samples().map(|sample| sample.position).collect();
    let drawn = DriverOutput { outputs: vec![(output, colours), (POSITION, positions)], discarded: Vec::new() };
    compare(&drawn, |precision| vertices.run(&program, interface, precision))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::Opinion;
    use glam::DMat4;
    use reference::Values;
    use reference::assignment::{Feed, Uniform};
    use reference::interpreter::Type;

    fn batch(x: &[f32]) -> DrawCall {
        DrawCall {
            uniforms: vec![("m".into(), DMat4::from_cols_array(&std::array::from_fn(|n| n as f64)).into())],
            attributes: vec![(
                "p".into(),
                Values { kind: Type::vector(3), numbers: x.iter().flat_map(|&x| [f64::from(x), 2.0, 3.0]).collect() },
            )],
            ..DrawCall::default()
        }
    }

    fn interface() -> Interface {
        let value = DMat4::IDENTITY.into();
        let matrix =
            Uniform { path: "m".into(), kind: Type::MAT4, feed: Feed::Constant(value), probe: None, place: None };
        Interface { uniforms: vec![matrix], ..Interface::default() }
    }

    fn sample(colour: [f32; 4]) -> Sample {
        Sample { position: [0.0; 4], colour }
    }

    const TEXT: &str = "in vec4 p; uniform mat4 m; out vec4 c;\n\
        void main() { c = vec4(p.x, m[1].x, p.w, gl_VertexID); gl_Position = vec4(0.0); }";

    #[test]
    fn vertices_have_their_attributes_matrices_and_numbers() {
        let batches = [batch(&[5.0, 6.0]), batch(&[7.0])];
        let samples =
            [vec![sample([5.0, 4.0, 1.0, 0.0]), sample([6.0, 4.0, 1.0, 1.0])], vec![sample([7.0, 4.0, 1.0, 0.0])]];
        let found = check(TEXT, "c", &interface(), &batches.each_ref(), &samples.each_ref().map(Vec::as_slice));
        assert_eq!((found.opinion, found.agreeing, found.message), (Opinion::Agrees, 3, None));
    }

    #[test]
    fn a_value_that_differs_is_named() {
        let found = check(TEXT, "c", &interface(), &[&batch(&[5.0])], &[&[sample([5.0, 4.5, 1.0, 0.0])]]);
        assert_eq!((found.opinion, found.differing), (Opinion::Differs, 1));
        assert_eq!(found.message.unwrap().en, "vertex 0: c[1] is 4.5 for the driver and 4 for the interpreter");
    }

    #[test]
    fn what_is_undefined_or_not_known_is_no_difference() {
        let text = "in vec4 p; out vec4 c; void main() { float u; c = vec4(u); gl_Position = vec4(0.0); }";
        let found = check(text, "c", &Interface::default(), &[&batch(&[5.0])], &[&[sample([1.0; 4])]]);
        assert_eq!((found.opinion, found.undefined), (Opinion::Agrees, 1));
        let found = check("out vec4 c;\nvoid main() {\n c = noise4(1.0); }", "c", &Interface::default(), &[], &[]);
        assert_eq!((found.opinion, found.line), (Opinion::NotRun, Some(3)));
        let text = "out vec4 c; void main() { while (true) ; }";
        assert_eq!(
            check(text, "c", &Interface::default(), &[&batch(&[5.0])], &[&[sample([0.0; 4])]]).opinion,
            Opinion::NotRun
        );
    }

    #[test]
    fn what_hangs_on_the_last_bits_is_no_difference() {
        let text = "in vec4 p; out vec4 c; void main() { c = vec4(sin(p.x * 1e9)); gl_Position = vec4(0.0); }";
        let found = check(text, "c", &Interface::default(), &[&batch(&[1.7])], &[&[sample([0.25; 4])]]);
        assert_eq!((found.opinion, found.unsettled), (Opinion::Agrees, 1));
    }

    #[test]
    fn numbers_below_the_least_normal_float_may_be_zero() {
        // A driver that keeps them has 1, one that does not has 0.
        let text = "in vec4 p; out vec4 c; void main() { c = vec4(p.x * 1e-30 * 1e-10 * 1e38 * 100.0); gl_Position = vec4(0.0); }";
        let found = check(text, "c", &Interface::default(), &[&batch(&[1.0])], &[&[sample([0.0; 4])]]);
        assert_eq!((found.opinion, found.unsettled), (Opinion::Agrees, 1), "{found:?}");
    }
}
